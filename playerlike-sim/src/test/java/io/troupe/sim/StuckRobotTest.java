package io.troupe.sim;

import static io.troupe.sim.Specs.robot;
import static io.troupe.sim.Specs.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.device.Outline;
import io.troupe.sim.model.Pose;
import io.troupe.sim.worldfile.WorldFileException;
import java.util.List;
import org.junit.jupiter.api.Test;

/** Robots that overlap something at the start: as in Stage they stall until they are teleported. */
class StuckRobotTest {
    private static final Pose FREE = new Pose(-5, 0, 0);

    private static World world(Pose first, Pose second) {
        return World.create(
                Specs.world(List.of(robot("r1", first), robot("r2", second)), wall("wall", 0.6, 0, 1, 1)),
                WorldSettings.DEFAULT.withSeed(3).withJitter(0.02, 0.03));
    }

    @Test
    void robotInAWall_staysThereAndStallsOnlyWhileItIsDriven() {
        World world = world(Pose.ORIGIN, FREE);

        assertThat(world.advance(5).robots().getFirst().odometry().stalled()).isFalse();
        world.command(0, 0.3, 0.5);
        RobotReading stuck = world.advance(20).robots().getFirst();

        assertThat(stuck.pose()).isEqualTo(Pose.ORIGIN);
        assertThat(stuck.odometry().pose()).isEqualTo(Pose.ORIGIN);
        assertThat(stuck.odometry().stalled()).isTrue();
        world.stop(0);
        assertThat(world.advance(20).robots().getFirst().odometry().stalled()).isFalse();
    }

    @Test
    void robotsInEachOther_stayBoth() {
        World world = world(new Pose(-3, 0, 0), new Pose(-3.1, 0.1, 1));
        world.command(0, 0.3, 0);
        world.command(1, 0.3, 0);

        Snapshot later = world.advance(20);

        assertThat(later.robots().get(0).pose()).isEqualTo(new Pose(-3, 0, 0)); // no jitter either
        assertThat(later.robots().get(1).pose()).isEqualTo(new Pose(-3.1, 0.1, 1));
        assertThat(later.robots()).allMatch(robot -> robot.odometry().stalled());
    }

    /**
     * For every seed, only robots that overlap in the file are stuck; without room for jitter the world is rejected.
     */
    @Test
    void robotsSideBySide_areMovedAtRandom_andNeverStuck() {
        double gapM = 0.2;
        while (overlap(Pose.ORIGIN, new Pose(0, gapM, 0))) {
            gapM += 0.005;
        }
        var spec = Specs.world(List.of(robot("r1", Pose.ORIGIN), robot("r2", new Pose(0, gapM, 0))));
        int free = 0;
        for (int seed = 1; seed <= 50; seed++) {
            var settings = WorldSettings.DEFAULT.withSeed(seed).withJitter(0.02, 0.03);
            try {
                assertThat(StartPoses.of(spec, settings).stuck().isEmpty())
                        .as("seed %d, %s m apart", seed, gapM)
                        .isTrue();
                free++;
            } catch (WorldFileException noRoom) {
                assertThat(noRoom).hasMessageContaining("has no room to start");
            }
        }
        assertThat(free).isGreaterThan(10);
    }

    private static boolean overlap(Pose one, Pose other) {
        var shape = robot("r", one).collisionShape();
        return new Outline(shape, one).overlaps(new Outline(shape, other));
    }

    @Test
    void robotThatIsPutElsewhere_drivesLikeAnyOther_andIsStuckAgainAfterAReset() {
        World world = world(Pose.ORIGIN, FREE);
        world.teleport(0, new Pose(-5, 3, 0));
        world.command(0, 0.4, 0);

        RobotReading free = world.advance(10).robots().getFirst();

        assertThat(free.pose().x()).isCloseTo(-4.6, within(1e-9));
        assertThat(free.odometry().stalled()).isFalse();
        world.reset();
        world.advance();
        world.command(0, 0.4, 0);
        assertThat(world.advance(20).robots().getFirst().pose()).isEqualTo(Pose.ORIGIN);
    }

    @Test
    void robotThatWasFreed_isHeldBackByWallsAsOthersAre() {
        World freed = world(Pose.ORIGIN, FREE);
        World other = world(new Pose(-5, -3, 0), FREE);
        freed.teleport(0, new Pose(-1, 0, 0));
        other.teleport(0, new Pose(-1, 0, 0));
        freed.command(0, 0.4, 0.1);
        other.command(0, 0.4, 0.1);

        assertThat(freed.advance(50).robots().getFirst().pose())
                .isEqualTo(other.advance(50).robots().getFirst().pose());
    }

    @Test
    void robotThatDrivesAgainstAStuckOne_isHeldBack() {
        World world = world(Pose.ORIGIN, new Pose(-1.5, 0, 0));
        world.command(1, 0.4, 0);

        Snapshot later = world.advance(50);

        assertThat(later.robots().get(0).pose()).isEqualTo(Pose.ORIGIN);
        assertThat(later.robots().get(1).pose().x()).isLessThan(-0.4);
        assertThat(later.robots().get(1).odometry().stalled()).isTrue();
    }
}
