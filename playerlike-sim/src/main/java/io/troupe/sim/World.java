package io.troupe.sim;

import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.WorldSpec;

/** A world of robots that advances by fixed intervals of simulated time. */
public final class World {
    private World() {}

    public static World create(WorldSpec spec, WorldSettings settings) {
        throw new UnsupportedOperationException("World.create");
    }

    public WorldSpec spec() {
        throw new UnsupportedOperationException("World.spec");
    }

    /** The newest snapshot; that of tick 0 right after creation. Any thread. */
    public Snapshot latest() {
        throw new UnsupportedOperationException("World.latest");
    }

    /** Sets a robot's speed from the next {@link #advance()} on; the newest command wins. Any thread. */
    public void command(int robot, double forwardMps, double turnRadps) {
        throw new UnsupportedOperationException("World.command");
    }

    /** The same as {@code command(robot, 0, 0)}. */
    public void stop(int robot) {
        command(robot, 0, 0);
    }

    /** Makes odometry report this pose where the robot stands when the next {@link #advance()} begins. Any thread. */
    public void setOdometry(int robot, Pose pose) {
        throw new UnsupportedOperationException("World.setOdometry");
    }

    /** Advances by one interval: physics, then sensing. Always the same thread. */
    public Snapshot advance() {
        throw new UnsupportedOperationException("World.advance");
    }

    /** Simulated time of the newest snapshot. Any thread. */
    public long timeMicros() {
        return latest().timeMicros();
    }
}
