package io.troupe.sim;

import io.troupe.sim.device.Device;
import io.troupe.sim.device.GripperDevice;
import io.troupe.sim.device.Scene;
import io.troupe.sim.device.Scratch;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.physics.Physics;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.SortedMap;
import java.util.TreeMap;
import org.jspecify.annotations.Nullable;

/**
 * The obstacles that may move, and the grippers that hold them.
 *
 * <p>A thing that is held is moved with the robot, and its body is parked where it touches nothing. Things come and go
 * like robots: they keep their bodies, which touch nothing while they are away.
 *
 * <p><b>Threads.</b> The thread that advances the world.
 */
final class Grippers {
    /** Far beyond every wall; each body has a separate place there. */
    private static final double PARKED_M = 20_000;

    private static final int NOBODY = -1;

    private final List<Integer> indices; // of the things, among the obstacles
    private final List<ObstacleSpec> things;
    private final int robotCount;
    private final double intervalS;
    private final WorldContents contents;
    private Scene scene;
    private Physics physics;
    private final int[] heldBy; // by thing, the robot
    private final Pose[] heldAt; // in the frame of the robot
    private final @Nullable Pose[] takenAt; // in the world, of those that were taken after devices were read
    private final List<Gripper> grippers = new ArrayList<>();

    private record Gripper(int robot, GripperDevice device) {}

    Grippers(WorldSpec spec, WorldContents contents, Scene scene, Physics physics, List<SimulatedDevices> devices) {
        this.contents = contents;
        indices = spec.movingObstacles();
        things = indices.stream().map(spec.obstacles()::get).toList();
        robotCount = spec.robots().size();
        intervalS = spec.intervalMillis() / 1000.0;
        this.scene = scene;
        this.physics = physics;
        heldBy = new int[things.size()];
        heldAt = new Pose[things.size()];
        Arrays.fill(heldBy, NOBODY);
        Arrays.fill(heldAt, Pose.ORIGIN);
        takenAt = new @Nullable Pose[things.size()];
        show();
        for (int robot = 0; robot < devices.size(); robot++) {
            for (Device device : devices.get(robot).others()) {
                if (device instanceof GripperDevice gripper) {
                    grippers.add(new Gripper(robot, gripper));
                }
            }
        }
    }

    private void show() {
        for (int i = 0; i < things.size(); i++) {
            scene.carry(i, heldBy[i]);
            scene.show(i, contents.holds(indices.get(i)));
        }
    }

    /** Continues with a scene and a physics that were built anew, in which the things are at their {@link #poses}. */
    void continueIn(Scene newScene, Physics newPhysics) {
        scene = newScene;
        show();
        if (newPhysics != physics) {
            physics = newPhysics;
            for (int i = 0; i < things.size(); i++) {
                if (!contents.holds(indices.get(i))) {
                    physics.removeRobot(robotCount + i);
                } else if (heldBy[i] != NOBODY) {
                    park(i);
                }
            }
        }
    }

    /** True if an obstacle may move. */
    boolean moves(int obstacle) {
        return indices.contains(obstacle);
    }

    /** Takes an obstacle that moves out of the world; a gripper that holds it loses it. */
    void remove(int obstacle) {
        int thing = indices.indexOf(obstacle);
        loseIfHeld(thing);
        physics.removeRobot(robotCount + thing);
        scene.show(thing, false);
    }

    /** Puts an obstacle that moves at a pose; a gripper that holds it loses it. */
    void put(int obstacle, Pose pose) {
        int thing = indices.indexOf(obstacle);
        loseIfHeld(thing);
        place(thing, pose);
        scene.show(thing, true);
    }

    /** Puts down what the grippers of a robot hold, which leaves. */
    void putDownAll(int robot) {
        for (int i = 0; i < heldBy.length; i++) {
            if (heldBy[i] == robot) {
                loseIfHeld(i);
            }
        }
    }

    private void loseIfHeld(int thing) {
        if (heldBy[thing] != NOBODY) {
            for (Gripper gripper : grippers) {
                gripper.device.lose(thing);
            }
            putDown(thing);
        }
    }

    /** Places the things in the scene. */
    void place() {
        for (int i = 0; i < heldBy.length; i++) {
            takenAt[i] = null;
            scene.place(robotCount + i, pose(i));
        }
    }

    /** Where a thing is. */
    Pose pose(int thing) {
        return heldBy[thing] == NOBODY
                ? physics.pose(robotCount + thing)
                : physics.pose(heldBy[thing]).compose(heldAt[thing]);
    }

    /** Where all things are. */
    List<Pose> poses() {
        List<Pose> poses = new ArrayList<>(heldBy.length);
        for (int i = 0; i < heldBy.length; i++) {
            poses.add(pose(i));
        }
        return poses;
    }

    /**
     * Where all things are in the scene. This differs from {@link #poses} by rounding for a thing that has just been
     * taken, whose place relative to the robot was computed after devices were read.
     */
    List<Pose> sensedPoses() {
        List<Pose> poses = new ArrayList<>(heldBy.length);
        for (int i = 0; i < heldBy.length; i++) {
            Pose taken = takenAt[i];
            poses.add(taken == null ? pose(i) : taken);
        }
        return poses;
    }

    /** The things that are held, by their index among the obstacles: the robot. */
    SortedMap<Integer, Integer> held() {
        SortedMap<Integer, Integer> held = new TreeMap<>();
        for (int i = 0; i < heldBy.length; i++) {
            if (heldBy[i] != NOBODY) {
                held.put(indices.get(i), heldBy[i]);
            }
        }
        return held;
    }

    /** Updates all grippers at the end of an interval. */
    void update(Scratch scratch) {
        for (int i = 0; i < grippers.size(); i++) { // an iterator would be allocated in each interval
            Gripper gripper = grippers.get(i);
            if (contents.isAway(gripper.robot)) {
                continue;
            }
            gripper.device.update(scene, gripper.robot, intervalS, scratch, new GripperDevice.Holder() {
                @Override
                public boolean hold(int thing) {
                    return take(thing, gripper.robot);
                }

                @Override
                public void release(int thing) {
                    putDown(thing);
                }
            });
        }
    }

    private boolean take(int thing, int robot) {
        if (heldBy[thing] != NOBODY) {
            return false;
        }
        Pose at = physics.pose(robotCount + thing);
        Pose robotAt = physics.pose(robot);
        heldAt[thing] = new Pose(0, 0, -robotAt.headingRad())
                .compose(new Pose(at.x() - robotAt.x(), at.y() - robotAt.y(), at.headingRad()));
        heldBy[thing] = robot;
        takenAt[thing] = at;
        scene.carry(thing, robot);
        park(thing);
        return true;
    }

    private void park(int thing) {
        physics.teleport(robotCount + thing, new Pose(PARKED_M + 100.0 * thing, PARKED_M, 0));
        physics.hold(robotCount + thing);
    }

    private void putDown(int thing) {
        Pose at = pose(thing);
        heldBy[thing] = NOBODY;
        scene.carry(thing, NOBODY);
        place(thing, at);
    }

    private void place(int thing, Pose pose) {
        physics.teleport(robotCount + thing, pose);
        if (things.get(thing).traits().pushableKg() == 0) {
            physics.hold(robotCount + thing);
        }
    }
}
