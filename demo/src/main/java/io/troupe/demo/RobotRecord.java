package io.troupe.demo;

import io.troupe.services.subsumption.Service;
import io.troupe.sim.Contact;
import io.troupe.sim.RobotReading;
import io.troupe.sim.physics.Physics;
import io.troupe.sim.scenario.Pose;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import org.jspecify.annotations.Nullable;

/** What one robot did in a run. */
final class RobotRecord {
    /** A robot that stays within so much of a point, while a service is in charge, makes no way. */
    static final double STAY_M = 0.05;
    /** From so long on that is worth telling: turning at a corner takes a few seconds. */
    static final long STUCK_MICROS = 10_000_000;

    /** Where it was and which service drove it, at a tick. */
    record Sample(long timeMicros, Pose pose, String service) {}

    /** A time without a break in which it made no way; it ends with a reading, at which that was still so. */
    record Stay(long fromMicros, long toMicros, String service) {
        static final Stay NONE = new Stay(0, 0, "none");

        long micros() {
            return toMicros - fromMicros;
        }

        boolean isStuck() {
            return micros() >= STUCK_MICROS;
        }
    }

    private final int index;
    private final double pathStepM;
    private final List<Service> inCharge = new ArrayList<>();
    private final List<Sample> path = new ArrayList<>();
    private final Map<String, Long> loops = new TreeMap<>();
    private double distanceM;
    private double gapM = Double.POSITIVE_INFINITY;
    private double closestM = Double.POSITIVE_INFINITY;
    private int wallContacts;
    private int followingContacts;
    private int robotContacts;
    private int chargeFaults;
    private boolean cycledThisTick;
    private int ticksWithoutCycle;
    private @Nullable Sample stayFrom;
    private Stay longestStay = Stay.NONE;

    /** @param pathStepM the path leaves out what is nearer to the point before; 0 = nothing */
    RobotRecord(int index, double pathStepM) {
        this.index = index;
        this.pathStepM = pathStepM;
    }

    void began(Service service) {
        inCharge.add(service);
        if (followsWalls(service) && gapM <= Physics.SKIN_M) {
            followingContacts++; // it takes over while the robot touches something
        }
    }

    private static boolean followsWalls(Service service) {
        return service.name().equals(Service.WALL_FOLLOWER.name());
    }

    void cycled(Service service) {
        loops.merge(service.name(), 1L, Long::sum);
        cycledThisTick = true;
    }

    void ended(Service service) {
        inCharge.remove(service);
    }

    void moved(long timeMicros, RobotReading reading) {
        Pose pose = reading.pose();
        if (!path.isEmpty()) {
            Pose before = path.getLast().pose();
            distanceM += StrictMath.hypot(pose.x() - before.x(), pose.y() - before.y());
        }
        gapM = reading.wallGapM();
        closestM = StrictMath.min(closestM, gapM);
        watchStay(timeMicros, pose);
        if (isPassing()) {
            path.removeLast();
        }
        path.add(new Sample(timeMicros, pose, serviceName()));
    }

    private void watchStay(long timeMicros, Pose pose) {
        Sample from = stayFrom;
        if (inCharge.size() != 1) {
            stayFrom = null;
        } else if (from == null
                || StrictMath.hypot(
                                pose.x() - from.pose().x(),
                                pose.y() - from.pose().y())
                        > STAY_M) {
            stayFrom = new Sample(timeMicros, pose, serviceName());
        } else if (timeMicros - from.timeMicros() > longestStay.micros()) {
            longestStay = new Stay(from.timeMicros(), timeMicros, serviceName());
        }
    }

    /** Whether the last point of the path is near the one before, which says as much. */
    private boolean isPassing() {
        if (path.size() < 2) {
            return false;
        }
        Sample last = path.getLast();
        Sample before = path.get(path.size() - 2);
        return last.service().equals(before.service())
                && StrictMath.hypot(
                                last.pose().x() - before.pose().x(),
                                last.pose().y() - before.pose().y())
                        < pathStepM;
    }

    void touched(Contact contact) {
        if (contact.otherRobot() >= 0) {
            robotContacts++;
        } else {
            wallContacts++;
            if (inCharge.stream().anyMatch(RobotRecord::followsWalls)) {
                followingContacts++;
            }
        }
    }

    void tickEnds() {
        if (!cycledThisTick) {
            ticksWithoutCycle++;
        }
        cycledThisTick = false;
    }

    void countChargeFault() {
        chargeFaults++;
    }

    int index() {
        return index;
    }

    List<Service> servicesInCharge() {
        return Collections.unmodifiableList(inCharge);
    }

    /** The service in charge, or what is wrong with that. */
    String serviceName() {
        return inCharge.size() == 1 ? inCharge.getFirst().name() : inCharge.isEmpty() ? "none" : "several";
    }

    List<Sample> path() {
        return Collections.unmodifiableList(path);
    }

    Map<String, Long> loops() {
        return Collections.unmodifiableMap(loops);
    }

    double distanceM() {
        return distanceM;
    }

    /** The longest time in which its centre stayed within {@value #STAY_M} m of a point, with a service in charge. */
    Stay longestStay() {
        return longestStay;
    }

    /** From the body's edge to the nearest obstacle. */
    double closestM() {
        return closestM;
    }

    int wallContacts() {
        return wallContacts;
    }

    /** Those of the wall contacts that happened while it followed a wall. */
    int followingContacts() {
        return followingContacts;
    }

    int robotContacts() {
        return robotContacts;
    }

    /** Ticks at which it had no service, or more than one. */
    int chargeFaults() {
        return chargeFaults;
    }

    /** Ticks at which no service told it anything: it stood, or rolled on as it was told before. */
    int ticksWithoutCycle() {
        return ticksWithoutCycle;
    }
}
