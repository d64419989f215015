package io.troupe.demo.learn;

import io.troupe.services.behaviour.SonarRing;
import io.troupe.services.behaviour.WallFollower;
import io.troupe.sim.learn.Observation;
import io.troupe.sim.learn.Trial;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.RandomWorld;
import java.util.ArrayList;
import java.util.List;

/** Drives a wall follower through the random arena of a seed, as long as a number of steps takes. */
final class FollowerTrial {
    /** The follower is at a wall if a body is nearer than this to its edge. */
    private static final double AT_WALL_M = 0.6;

    private static final double SIDE_M = 8;
    private static final double BOXES_PER_M2 = 0.1;

    /**
     * What the follower did.
     *
     * @param alongM how far it drove while it was at a wall
     * @param touches how often it began to touch something
     * @param heldS how long something held it back
     */
    record Result(double seconds, double drivenM, double alongM, int touches, double heldS) {
        /** Metres along walls in a minute, of which each touch takes one. */
        double score() {
            return (alongM - touches) * 60 / seconds;
        }
    }

    /**
     * Where the follower was.
     *
     * @param touches where it began to touch something
     */
    record Way(List<Point> path, List<Point> touches) {}

    private FollowerTrial() {}

    static WorldSpec arena(long seed) {
        return RandomWorld.arena(seed, SIDE_M, BOXES_PER_M2).withRobots(1);
    }

    static Result run(long seed, int steps, WallFollower law) {
        return run(seed, steps, law, new Way(new ArrayList<>(), new ArrayList<>()));
    }

    /** As {@link #run(long, int, WallFollower)}; adds where the robot was to {@code way}. */
    static Result run(long seed, int steps, WallFollower law, Way way) {
        var trial = Trial.of(FollowerTrial::arena);
        Observation seen = trial.reset(seed);
        WallFollower.Memory memory = WallFollower.START;
        double drivenM = 0;
        double alongM = 0;
        int touches = 0;
        int heldSteps = 0;
        way.path().add(new Point(seen.x(0), seen.y(0)));
        for (int i = 0; i < steps; i++) {
            WallFollower.Step next = law.step(memory, ring(seen));
            memory = next.memory();
            Observation before = seen;
            seen = trial.step(next.velocity().forwardMps(), next.velocity().turnRadps());
            double movedM = StrictMath.hypot(seen.x(0) - before.x(0), seen.y(0) - before.y(0));
            drivenM += movedM;
            alongM += trial.view().wallGapM(0) < AT_WALL_M ? movedM : 0;
            heldSteps += seen.stalled(0) ? 1 : 0;
            var place = new Point(seen.x(0), seen.y(0));
            way.path().add(place);
            if (seen.collided(0)) {
                touches++;
                way.touches().add(place);
            }
        }
        double stepS = seen.timeS() / steps;
        return new Result(seen.timeS(), drivenM, alongM, touches, heldSteps * stepS);
    }

    private static SonarRing ring(Observation seen) {
        double[] rangesM = seen.rangesM(0);
        var readings = new float[rangesM.length];
        for (int i = 0; i < readings.length; i++) {
            readings[i] = (float) rangesM[i];
        }
        return SonarRing.of(readings);
    }
}
