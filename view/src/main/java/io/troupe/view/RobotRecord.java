package io.troupe.view;

import io.troupe.services.subsumption.Service;
import io.troupe.sim.Contact;
import io.troupe.sim.RobotReading;
import io.troupe.sim.model.Pose;
import io.troupe.sim.physics.Physics;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import org.jspecify.annotations.Nullable;

/**
 * What one robot did in a run.
 *
 * <p><b>Units and shapes.</b> Metres, microseconds of simulated time.
 */
public final class RobotRecord {
    /** A robot that stays within this distance of a point, while a service is in charge, makes no progress. */
    public static final double STAY_M = 0.05;
    /** Shorter times without progress are not reported: turning at a corner takes a few seconds. */
    public static final long STUCK_MICROS = 10_000_000;

    /** Pose and service in charge at a tick. */
    public record Sample(long timeMicros, Pose pose, String service) {}

    /** An uninterrupted time without progress. It ends at the last reading at which the robot had still made none. */
    public record Stay(long fromMicros, long toMicros, String service) {
        static final Stay NONE = new Stay(0, 0, "none");

        public long micros() {
            return toMicros - fromMicros;
        }

        public boolean isStuck() {
            return micros() >= STUCK_MICROS;
        }
    }

    /** From then on a node drives the robot; null = none does. */
    public record Driver(long fromMicros, @Nullable String node) {}

    private final int index;
    private final double pathStepM;
    private final List<Service> inCharge = new ArrayList<>();
    private final List<Sample> path = new ArrayList<>();
    private final Map<String, Long> loops = new TreeMap<>();
    private final List<Driver> drivers = new ArrayList<>();
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

    /** @param pathStepM points closer than this to the previous one are left out of the path; 0 keeps all */
    RobotRecord(int index, double pathStepM) {
        this.index = index;
        this.pathStepM = pathStepM;
    }

    void began(Service service) {
        inCharge.add(service);
        if (followsWalls(service) && gapM <= Physics.SKIN_M) {
            followingContacts++; // the service starts while the robot touches an obstacle
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

    void drivenBy(long timeMicros, @Nullable String node) {
        drivers.add(new Driver(timeMicros, node));
    }

    /** The services that have not reported their end drive it no more. */
    void lostDriver() {
        inCharge.clear();
    }

    /** The node that drives it; null if none does, or in a run inside one process. */
    @Nullable
    String node() {
        return drivers.isEmpty() ? null : drivers.getLast().node();
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

    /**
     * Whether the last point of the path can be dropped: same service as the previous point, and closer than the path
     * step.
     */
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

    /** Its number, from 0. */
    public int index() {
        return index;
    }

    List<Service> servicesInCharge() {
        return Collections.unmodifiableList(inCharge);
    }

    /** Name of the service in charge, or "none" or "several". */
    public String serviceName() {
        return inCharge.size() == 1 ? inCharge.getFirst().name() : inCharge.isEmpty() ? "none" : "several";
    }

    /** Where it was at each reading; of a robot in a crowd, points less than 25 cm apart are left out. */
    public List<Sample> path() {
        return Collections.unmodifiableList(path);
    }

    /** The changes of its driver in a run over hosts, in their order. */
    public List<Driver> drivers() {
        return Collections.unmodifiableList(drivers);
    }

    /** The number of cycles of each service, by name. */
    public Map<String, Long> loops() {
        return Collections.unmodifiableMap(loops);
    }

    public double distanceM() {
        return distanceM;
    }

    /**
     * The longest time in which the robot's centre stayed within {@value #STAY_M} m of a point while a service was in
     * charge.
     */
    public Stay longestStay() {
        return longestStay;
    }

    /** Smallest distance from the edge of the body to an obstacle. */
    public double closestM() {
        return closestM;
    }

    public int wallContacts() {
        return wallContacts;
    }

    /** Wall contacts during wall following. */
    public int followingContacts() {
        return followingContacts;
    }

    public int robotContacts() {
        return robotContacts;
    }

    /** Number of ticks with no service in charge, or with more than one. */
    public int chargeFaults() {
        return chargeFaults;
    }

    /** Number of ticks without a command from any service: the robot stood still, or kept its previous speed. */
    public int ticksWithoutCycle() {
        return ticksWithoutCycle;
    }
}
