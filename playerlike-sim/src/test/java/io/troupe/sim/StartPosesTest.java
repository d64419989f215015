package io.troupe.sim;

import static io.troupe.sim.Specs.robot;
import static io.troupe.sim.Specs.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.physics.Physics;
import io.troupe.sim.worldfile.WorldFileException;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;

class StartPosesTest {
    private static final Pose FIRST = new Pose(1, -1, 0.5);
    private static final Pose SECOND = new Pose(-2, 2, -3);

    private static WorldSettings jitter(long seed) {
        return WorldSettings.DEFAULT.withSeed(seed).withJitter(0.02, 0.03);
    }

    private static Pose start(WorldSpec world, WorldSettings settings, int robot) {
        return World.create(world, settings).latest().robots().get(robot).pose();
    }

    @Test
    void jitter_offByDefault() {
        assertThat(start(Specs.world(robot("r1", FIRST)), WorldSettings.DEFAULT.withSeed(99), 0))
                .isEqualTo(FIRST);
    }

    @Test
    void jitter_staysWithinItsBounds_andUsesThem() {
        List<Double> offsets = new ArrayList<>();
        for (long seed = 0; seed < 500; seed++) {
            Pose start = start(Specs.world(robot("r1", FIRST)), jitter(seed), 0);
            assertThat(start.x() - FIRST.x()).as("x, seed %d", seed).isBetween(-0.02, 0.02);
            assertThat(start.y() - FIRST.y()).as("y, seed %d", seed).isBetween(-0.02, 0.02);
            assertThat(start.headingRad() - FIRST.headingRad())
                    .as("heading, seed %d", seed)
                    .isBetween(-0.03, 0.03);
            offsets.add(start.x() - FIRST.x());
        }
        assertThat(offsets).anyMatch(offset -> offset < -0.019).anyMatch(offset -> offset > 0.019);
        assertThat(offsets.stream().mapToDouble(offset -> offset).average().orElseThrow())
                .isBetween(-0.002, 0.002);
        assertThat(offsets).doesNotHaveDuplicates();
    }

    @Test
    void odometry_startsFromTheJitteredPose() {
        RobotReading reading = World.create(Specs.world(robot("r1", FIRST)), jitter(3))
                .latest()
                .robots()
                .getFirst();

        assertThat(reading.pose()).isNotEqualTo(FIRST);
        assertThat(reading.odometry().pose()).isEqualTo(Pose.ORIGIN);
    }

    @Test
    void anotherRobot_doesNotShiftTheDrawsOfTheFirst_whereverItIsListed() {
        Pose alone = start(Specs.world(robot("r1", FIRST)), jitter(5), 0);

        assertThat(start(Specs.world(List.of(robot("r1", FIRST), robot("r2", SECOND))), jitter(5), 0))
                .isEqualTo(alone);
        assertThat(start(Specs.world(List.of(robot("r2", SECOND), robot("r1", FIRST))), jitter(5), 1))
                .isEqualTo(alone);
        assertThat(start(Specs.world(robot("r1", FIRST)), jitter(6), 0)).isNotEqualTo(alone);
    }

    @Test
    void robotsWithOneStart_areMovedDifferently() {
        WorldSpec world = Specs.world(List.of(robot("r1", new Pose(0, 0, 0)), robot("r2", new Pose(0, 2, 0))));

        assertThat(start(world, jitter(5), 1).x())
                .isNotEqualTo(start(world, jitter(5), 0).x());
    }

    @Test
    void jitter_neverStartsWithATouch() {
        // 3 cm of room to each side: about half of all draws would touch
        WorldSpec world =
                Specs.world(robot("r1", Pose.ORIGIN), wall("left", 0, 0.72, 2, 1), wall("right", 0, -0.72, 2, 1));
        for (long seed = 0; seed < 200; seed++) {
            RobotReading reading =
                    World.create(world, jitter(seed)).latest().robots().getFirst();
            assertThat(reading.wallGapM()).as("seed %d", seed).isGreaterThan(Physics.SKIN_M);
        }
    }

    @Test
    void jitter_withoutRoom_saysSo() {
        WorldSpec world =
                Specs.world(robot("r1", Pose.ORIGIN), wall("left", 0, 0.70, 2, 1), wall("right", 0, -0.70, 2, 1));

        assertThatThrownBy(() -> World.create(world, jitter(4)))
                .isInstanceOf(WorldFileException.class)
                .hasMessageContaining("test.world:7:1: robot 'r1' has no room to start up to 0.02 m")
                .hasMessageContaining("seed 4")
                .hasMessageContaining("obstacle 'left'");
    }

    @Test
    void overlap_atTheStart_isNotJitteredAway() {
        assertThat(start(Specs.world(robot("r1", Pose.ORIGIN), wall("wall", 0.6, 0, 1, 1)), jitter(4), 0))
                .isEqualTo(Pose.ORIGIN);
    }

    @Test
    void bodiesThatOnlyTouch_doNotOverlap() {
        assertThat(start(Specs.world(robot("r1", Pose.ORIGIN), wall("wall", 0.68, 0, 1, 1)), WorldSettings.DEFAULT, 0))
                .isEqualTo(Pose.ORIGIN);
    }
}
