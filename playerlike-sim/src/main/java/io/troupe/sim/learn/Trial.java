package io.troupe.sim.learn;

import static java.util.Objects.requireNonNull;

import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.WorldView;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import java.util.Arrays;
import java.util.function.LongFunction;

/**
 * A world that is stepped by actions and answers with observations, and that each reset builds anew from a seed.
 *
 * {@snippet :
 * var trial = Trial.of(seed -> RandomWorld.arena(seed, 8, 0.1).withRobots(1));
 * Observation seen = trial.reset(42);
 * while (!seen.collided(0)) {
 *     double turnRadps = seen.rangeM(0, 3) < 0.8 ? 1 : 0;
 *     seen = trial.step(new double[] {0.3, turnRadps});
 * }
 * }
 *
 * <p><b>Role.</b> A {@link World} without server, clients and waiting, for learning and tuning. Equal seeds and actions
 * give equal observations, bit for bit, and those of the same world behind a server.
 *
 * <p><b>Units and shapes.</b> SI; robots count from 0. A step is one interval of the world, 0.1 s by default.
 *
 * <p><b>Threads.</b> Between two resets the thread that steps first; separate trials are independent.
 *
 * <p><b>Errors.</b> {@link IllegalStateException} for a step before the first reset, {@link IllegalArgumentException}
 * for actions of another number than two for each robot, or that are not finite.
 */
public final class Trial {
    private final LongFunction<WorldSpec> worlds;
    private final WorldSettings settings;
    private World world;
    private boolean begun;
    private long steps;

    private Trial(LongFunction<WorldSpec> worlds, WorldSettings settings) {
        this.worlds = worlds;
        this.settings = settings;
        world = World.create(worlds.apply(settings.seed()), settings);
    }

    /** A trial in a world for each seed; the robots have the default settings. */
    public static Trial of(LongFunction<WorldSpec> worlds) {
        return of(worlds, WorldSettings.defaults());
    }

    /**
     * A trial in a world for each seed.
     *
     * @param settings each reset replaces their seed
     */
    public static Trial of(LongFunction<WorldSpec> worlds, WorldSettings settings) {
        return new Trial(requireNonNull(worlds, "worlds"), requireNonNull(settings, "settings"));
    }

    /** Begins again in the world of a seed, which also seeds all noise. */
    public Observation reset(long seed) {
        world.close();
        world = World.create(worlds.apply(seed), settings.withSeed(seed));
        begun = true;
        return new Observation(world.view());
    }

    /**
     * Drives all robots for one interval.
     *
     * @param actions for each robot its speed in m/s and its turn rate in rad/s, left positive
     */
    public Observation step(double... actions) {
        int robots = robotCount();
        if (!begun) {
            throw new IllegalStateException("a step before the first reset, expected reset(seed) first");
        }
        if (actions.length != 2 * robots) {
            throw new IllegalArgumentException(
                    actions.length + " numbers for " + robots + " robots, expected two for each: speed and turn rate");
        }
        if (!Arrays.stream(actions).allMatch(Double::isFinite)) {
            throw new IllegalArgumentException(
                    "the actions are " + Arrays.toString(actions) + ", expected finite numbers");
        }
        world.advance(1, view -> {
            for (int robot = 0; robot < robots; robot++) {
                view.command(robot, actions[2 * robot], actions[2 * robot + 1]);
            }
        });
        steps++;
        return new Observation(world.view());
    }

    /** As {@link World#removeRobot}, at the beginning of the next step. */
    public void removeRobot(int robot) {
        world.removeRobot(robot);
    }

    /** As {@link World#teleport}, at the beginning of the next step; brings a robot back that was removed. */
    public void placeRobot(int robot, Pose pose) {
        world.teleport(robot, pose);
    }

    /** As {@link World#removeObstacle}, at the beginning of the next step. */
    public void removeObstacle(int obstacle) {
        world.removeObstacle(obstacle);
    }

    /** As {@link World#placeObstacle}, at the beginning of the next step. */
    public void placeObstacle(int obstacle, Pose pose) {
        world.placeObstacle(obstacle, pose);
    }

    /** Number of robots in the present world. */
    public int robotCount() {
        return world.spec().robots().size();
    }

    /** Number of steps since the trial was created, over all resets. */
    public long steps() {
        return steps;
    }

    /** The world that the last reset built, for what observations do not have. */
    public WorldView view() {
        return world.view();
    }
}
