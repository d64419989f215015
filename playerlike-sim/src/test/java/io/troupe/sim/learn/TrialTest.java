package io.troupe.sim.learn;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.SnapshotHash;
import io.troupe.sim.Specs;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.RandomWorld;
import java.util.List;
import java.util.Random;
import org.junit.jupiter.api.Test;

class TrialTest {
    /** A robot at the origin with sonars ahead and to both sides, and a wall whose face is 4 m ahead. */
    private static WorldSpec wallAhead() {
        RobotSpec robot = Specs.robot("r", Pose.ORIGIN, Specs.ORANGE, Specs.sonars(0, 90, -90), null);
        return Specs.world(robot, Specs.wall("wall", 4.5, 0, 1, 20));
    }

    @Test
    void sampleOfTrial_endsWithACollision() {
        var trial = Trial.of(seed -> RandomWorld.arena(seed, 8, 0.1).withRobots(1));
        Observation seen = trial.reset(42);
        while (!seen.collided(0)) {
            double turnRadps = seen.rangeM(0, 3) < 0.8 ? 1 : 0;
            seen = trial.step(new double[] {0.3, turnRadps});
        }
        assertThat(trial.steps()).isPositive();
        assertThat(seen.leastRangeM(0)).isLessThan(0.5);
    }

    @Test
    void sampleOfBatch_givesTheSameOnOneThread() {
        List<Double> drivenM = Batch.run(1_000, index -> {
            var trial = Trial.of(seed -> RandomWorld.maze(seed, 4, 4, 2).withRobots(1));
            Observation start = trial.reset(index);
            Observation end = trial.step(0.5, 0);
            return end.x(0) - start.x(0);
        });
        assertThat(drivenM).hasSize(1_000).allSatisfy(x -> assertThat(x).isBetween(-0.06, 0.06));
        List<Integer> squares = Batch.run(50, 3, index -> index * index);
        assertThat(squares).isEqualTo(Batch.run(50, 1, index -> index * index));
    }

    @Test
    void straightOn_atAConstantSpeed_rangesShrinkByTheWay() {
        var trial = Trial.of(seed -> wallAhead());
        assertThat(trial.reset(1).rangeM(0, 0)).isCloseTo(4, within(1e-12));
        for (int step = 1; step <= 20; step++) {
            Observation seen = trial.step(0.7, 0);
            assertThat(seen.timeS()).isCloseTo(0.1 * step, within(1e-9));
            assertThat(seen.x(0)).isCloseTo(0.07 * step, within(1e-9));
            assertThat(seen.rangeM(0, 0)).isCloseTo(4 - 0.07 * step, within(1e-9));
            assertThat(seen.y(0)).isZero();
            assertThat(seen.collided(0)).isFalse();
        }
    }

    @Test
    void arc_isACircleAroundItsCentre() {
        var trial = Trial.of(seed -> wallAhead());
        trial.reset(1);
        double radiusM = 0.5 / 0.8;
        for (int step = 1; step <= 30; step++) {
            Observation seen = trial.step(0.5, 0.8);
            double angleRad = 0.08 * step;
            assertThat(seen.x(0)).isCloseTo(radiusM * Math.sin(angleRad), within(1e-9));
            assertThat(seen.y(0)).isCloseTo(radiusM * (1 - Math.cos(angleRad)), within(1e-9));
            assertThat(seen.headingRad(0)).isCloseTo(angleRad, within(1e-9));
        }
    }

    @Test
    void againstTheWall_itCollidesOnce_andStalls() {
        var trial = Trial.of(seed -> wallAhead());
        Observation seen = trial.reset(1);
        int collisions = 0;
        for (int step = 0; step < 80; step++) {
            seen = trial.step(1, 0);
            collisions += seen.collided(0) ? 1 : 0;
        }
        assertThat(collisions).isEqualTo(1);
        assertThat(seen.stalled(0)).isTrue();
        assertThat(seen.x(0)).isCloseTo(4 - 0.18, within(0.03)); // the nose is 0.18 m ahead of the axle
    }

    /** The library and a world that is commanded from outside, as a server does it. */
    @Test
    void observations_areThoseOfTheWorld_bitForBit() {
        WorldSettings settings = WorldSettings.defaults().withJitter(0.02, 0.03);
        var trial = Trial.of(seed -> RandomWorld.office(seed, 3, 2).withRobots(6), settings);
        trial.reset(5);
        World world = World.create(RandomWorld.office(5, 3, 2).withRobots(6), settings.withSeed(5));
        var random = new Random(3);
        for (int step = 0; step < 100; step++) {
            double[] actions = random.doubles(12, -0.7, 0.7).toArray();
            trial.step(actions);
            for (int robot = 0; robot < 6; robot++) {
                world.command(robot, actions[2 * robot], actions[2 * robot + 1]);
            }
            world.advance();
            assertThat(SnapshotHash.of(trial.view().snapshot())).isEqualTo(SnapshotHash.of(world.latest()));
        }
    }

    @Test
    void reset_withTheSameSeed_repeats_andWithAnother_buildsAnotherWorld() {
        var trial = Trial.of(seed -> RandomWorld.cave(seed, 12).withRobots(2));
        double[] first = ranges(trial, 3);
        assertThat(ranges(trial, 4)).isNotEqualTo(first);
        assertThat(ranges(trial, 3)).isEqualTo(first);
    }

    private static double[] ranges(Trial trial, long seed) {
        trial.reset(seed);
        trial.step(0.4, 0.3, 0.4, -0.3);
        return trial.step(0.4, 0.3, 0.4, -0.3).rangesM(1);
    }

    @Test
    void sampleOfComingAndGoing_movesABoxAndARobotInOneStep() {
        var trial = Trial.of(seed -> RandomWorld.arena(seed, 8, 0.1).withRobots(2));
        Observation seen = trial.reset(42);
        int box = 4; // after the four walls
        trial.removeObstacle(box);
        trial.removeRobot(1);
        seen = trial.step(0.3, 0, 0, 0);
        assertThat(trial.view().holdsObstacle(box)).isFalse();
        assertThat(trial.view().isAway(1)).isTrue();
        trial.placeRobot(1, new Pose(seen.x(0) + 0.8, seen.y(0), 0)); // or wherever there is room
        trial.placeObstacle(box, new Pose(3, -3, 0.4));
        trial.step(0, 0, 0, 0);
        assertThat(trial.view().holdsObstacle(box)).isTrue();
        assertThat(trial.view().isAway(1)).isFalse();
        assertThat(trial.view().x(1)).isCloseTo(seen.x(0) + 0.8, within(1e-9));
        trial.removeObstacle(box);
        trial.reset(42);
        assertThat(trial.view().holdsObstacle(box))
                .as("a reset builds the world anew")
                .isTrue();
    }

    @Test
    void wrongActions_areRefused() {
        var trial = Trial.of(seed -> wallAhead());
        assertThatThrownBy(() -> trial.step(0, 0))
                .hasMessage("a step before the first reset, expected reset(seed) first");
        trial.reset(1);
        assertThatThrownBy(() -> trial.step(1))
                .hasMessage("1 numbers for 1 robots, expected two for each: speed and turn rate");
        assertThatThrownBy(() -> trial.step(1, Double.NaN))
                .hasMessage("the actions are [1.0, NaN], expected finite numbers");
    }

    // ---- random worlds

    @Test
    void randomWorlds_areEqualForEqualSeeds_andRobotsStandFree() {
        for (long seed = 1; seed <= 20; seed++) {
            List<RandomWorld> worlds = List.of(
                    RandomWorld.arena(seed, 10, 0.3),
                    RandomWorld.maze(seed, 5, 4, 2),
                    RandomWorld.office(seed, 3, 3),
                    RandomWorld.cave(seed, 14));
            for (RandomWorld world : worlds) {
                World built = World.create(world.withRobots(4), WorldSettings.defaults());
                assertThat(built.latest().robots())
                        .as("%s, seed %d", built.spec().name(), seed)
                        .allSatisfy(robot -> assertThat(robot.wallGapM()).isGreaterThan(0.1));
            }
            WorldSpec once = RandomWorld.maze(seed, 5, 4, 2).withRobots(3);
            assertThat(RandomWorld.maze(seed, 5, 4, 2).withRobots(3)).isEqualTo(once);
            assertThat(RandomWorld.maze(seed + 1, 5, 4, 2).withRobots(3)).isNotEqualTo(once);
        }
    }

    @Test
    void impossibleRandomWorlds_areRefused() {
        assertThatThrownBy(() -> RandomWorld.arena(1, 1, 0))
                .hasMessage("a random arena is 1.0 m by 1.0 m, expected from 2 m to 900 m");
        assertThatThrownBy(() -> RandomWorld.arena(1, 9, 5))
                .hasMessage("5.0 boxes a square metre, expected from 0 to 4");
        assertThatThrownBy(() -> RandomWorld.arena(1, 2, 0).withRobots(9))
                .hasMessageStartingWith("found no free place for robot ");
    }
}
