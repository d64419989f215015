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

/** What one robot did in a run. */
final class RobotRecord {
    /** Where it was and which service drove it, at a tick. */
    record Sample(long timeMicros, Pose pose, String service) {}

    private final int index;
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

    RobotRecord(int index) {
        this.index = index;
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
        path.add(new Sample(timeMicros, pose, serviceName()));
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
