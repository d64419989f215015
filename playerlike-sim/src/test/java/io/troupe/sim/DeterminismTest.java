package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;

/** Six robots that wander by their sonars and sometimes collide, for a minute. */
class DeterminismTest {
    private static final int TICKS = 600;

    private record Run(long crc, int contacts, double shortestWayM) {}

    private static WorldSpec arena() {
        List<ObstacleSpec> obstacles = new ArrayList<>(Specs.arena(8));
        obstacles.add(Specs.box("red", new Pose(2, 2, 0.3), 0.6, 0.6, Specs.RED));
        obstacles.add(Specs.box("green", new Pose(-2, 1, 1), 0.5, 0.8, Specs.GREEN));
        obstacles.add(Specs.box("blue", new Pose(0, -2, 2), 0.7, 0.4, Specs.BLUE));
        List<RobotSpec> robots = new ArrayList<>();
        for (int i = 0; i < 6; i++) {
            var start = new Pose(-2.5 + i, i % 2 == 0 ? 0 : 3, i);
            robots.add(Specs.robot("r" + i, start, Specs.ORANGE, Specs.pioneerFront(), Specs.camera(8)));
        }
        return Specs.world(robots, obstacles);
    }

    private static WorldSettings seed(long seed) {
        return WorldSettings.DEFAULT.withSeed(seed).withJitter(0.02, 0.035);
    }

    /** Robot 0 ignores its sensors and drives straight on, so that there are contacts. */
    private static void wander(World world, Snapshot snapshot) {
        world.command(0, 0.4, 0.05);
        for (int i = 1; i < snapshot.robots().size(); i++) {
            List<Double> sonar = snapshot.robots().get(i).sonarM();
            double left = Math.min(sonar.get(1), Math.min(sonar.get(2), sonar.get(3)));
            double right = Math.min(sonar.get(4), Math.min(sonar.get(5), sonar.get(6)));
            if (Math.min(left, right) > 0.5) {
                world.command(i, Math.min(0.5, (left + right) / 4), (left - right) / 5);
            } else {
                world.command(i, 0, left < right ? -0.5 : 0.5);
            }
        }
    }

    private static Run run(WorldSpec spec, WorldSettings settings) {
        World world = World.create(spec, settings);
        var fingerprint = new Fingerprint();
        int contacts = 0;
        fingerprint.add(world.latest());
        for (int tick = 0; tick < TICKS; tick++) {
            wander(world, world.latest());
            Snapshot snapshot = world.advance();
            fingerprint.add(snapshot);
            contacts += snapshot.contacts().size();
        }
        double shortestWayM = world.latest().robots().stream()
                .mapToDouble(robot -> StrictMath.hypot(
                        robot.odometry().pose().x(), robot.odometry().pose().y()))
                .min()
                .orElseThrow();
        return new Run(fingerprint.value(), contacts, shortestWayM);
    }

    @Test
    void sameSeed_givesTheSameSnapshots_bitForBit() {
        Run first = run(arena(), seed(7));
        Run second = run(arena(), seed(7));

        assertThat(second).isEqualTo(first);
        assertThat(first.contacts()).as("something must have been hit").isPositive();
        assertThat(first.shortestWayM()).as("and everybody must have moved").isGreaterThan(0.1);
    }

    @Test
    void otherSeed_givesOtherSnapshots() {
        assertThat(run(arena(), seed(8)).crc())
                .isNotEqualTo(run(arena(), seed(7)).crc());
    }

    @Test
    void seed_withoutJitter_changesNothing() {
        assertThat(run(arena(), WorldSettings.DEFAULT.withSeed(8)))
                .isEqualTo(run(arena(), WorldSettings.DEFAULT.withSeed(7)));
    }

    @Test
    void bodies_neverOverlap() {
        World world = World.create(arena(), seed(7));
        for (int tick = 0; tick < TICKS; tick++) {
            wander(world, world.latest());
            for (RobotReading robot : world.advance().robots()) {
                assertThat(robot.wallGapM()).isGreaterThan(0);
                assertThat(Math.abs(robot.pose().x())).isLessThan(4);
                assertThat(Math.abs(robot.pose().y())).isLessThan(4);
            }
        }
    }
}
