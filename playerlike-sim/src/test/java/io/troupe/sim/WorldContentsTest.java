package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.entry;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.RandomWorld;
import java.io.IOException;
import java.io.StringReader;
import java.io.StringWriter;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.Random;
import java.util.function.Supplier;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.parallel.Isolated;

/** Robots and obstacles that come and go. */
@Isolated("reads the log")
class WorldContentsTest {
    private static final int BOX = 0;
    private static final double NOSE_M = 0.18; // ahead of the axle

    /** A robot at the origin with a sonar ahead, another one behind it, and a box of 1 m whose face is 2 m ahead. */
    private static World boxAhead() {
        return World.create(
                Specs.world(
                        List.of(
                                Specs.robot("r", Pose.ORIGIN, Specs.ORANGE, Specs.sonars(0), null),
                                Specs.robot("s", new Pose(-2, 0, 0), Specs.ORANGE, Specs.sonars(0), null)),
                        Specs.wall("box", 2.5, 0, 1, 1),
                        Specs.wall("wall", 4.5, 0, 1, 20)),
                WorldSettings.defaults());
    }

    private static double aheadM(World world, int robot) {
        return world.view().rangeM(robot, 0);
    }

    private static void drive(World world, double forwardMps, int intervals) {
        world.command(0, forwardMps, 0);
        world.advance(intervals);
    }

    @Test
    void obstacleThatGoes_isNeitherSensedNorTouched_andStopsRobotsAgainWhenItIsBack() {
        World world = boxAhead();
        assertThat(aheadM(world, 0)).isCloseTo(2, within(1e-12));
        world.removeObstacle(BOX);
        assertThat(world.view().holdsObstacle(BOX)).isTrue();
        drive(world, 1, 30);
        assertThat(world.view().holdsObstacle(BOX)).isFalse();
        assertThat(world.latest().placed()).containsExactly(entry(BOX, Optional.empty()));
        assertThat(world.view().x(0)).isCloseTo(3, within(1e-6));
        assertThat(aheadM(world, 0)).isCloseTo(1, within(1e-6));
        assertThat(world.latest().contacts()).isEmpty();

        world.placeObstacle(BOX, new Pose(0, 0, 0)); // its faces are at -0.5 and 0.5
        drive(world, -1, 60);
        assertThat(world.latest().displaced(world.spec())).containsExactly(entry(BOX, Optional.of(Pose.ORIGIN)));
        double rear = world.view().x(0) - 0.26;
        assertThat(rear).isBetween(0.5, 0.5 + 2 * 0.02);
        assertThat(world.view().stalled(0)).isTrue();
        assertThat(aheadM(world, 1)).isCloseTo(1.5, within(1e-9));
    }

    @Test
    void obstacleThatMovesAwayFromARobotThatPushesIt_letsItGoOn() {
        World world = boxAhead();
        drive(world, 1, 40);
        assertThat(world.view().stalled(0)).isTrue();
        world.placeObstacle(BOX, new Pose(0, 5, 0.7));
        drive(world, 1, 5);
        assertThat(world.view().stalled(0)).isFalse();
        assertThat(world.view().x(0)).isCloseTo(2 - NOSE_M - 0.02 + 0.5, within(0.03));
    }

    /** Robots that glide past nothing have to notice an obstacle that is put in their way. */
    @Test
    void obstacleThatIsPutBeforeADrivingRobot_stopsIt() {
        World world = boxAhead();
        world.removeObstacle(BOX);
        drive(world, 0.5, 10);
        world.placeObstacle(BOX, new Pose(1.5, 0.2, 0.5));
        world.advance(40);
        assertThat(world.view().x(0)).isLessThan(1.5);
        assertThat(world.view().stalled(0)).isTrue();
    }

    @Test
    void robotThatGoes_isNeitherSensedNorTouched_keepsItsReadings_andComesBackByTeleport() {
        World world = boxAhead();
        assertThat(aheadM(world, 1)).isCloseTo(2 - 0.26, within(1e-9));
        world.removeRobot(0);
        world.command(0, 1, 1);
        world.command(1, 0.5, 0);
        world.advance(40);
        assertThat(world.view().isAway(0)).isTrue();
        assertThat(world.latest().away()).containsExactly(0);
        assertThat(world.view().x(0)).isZero();
        assertThat(aheadM(world, 0)).as("the last reading").isEqualTo(2);
        assertThat(world.view().forwardMps(0)).isZero();
        assertThat(world.view().stalled(0)).isFalse();
        assertThat(world.view().x(1)).as("it drove through its place").isCloseTo(0, within(1e-6));
        assertThat(aheadM(world, 1)).isCloseTo(2, within(1e-6));

        assertThatThrownBy(() -> world.teleport(0, Pose.ORIGIN)).hasMessageContaining("it would overlap robot 's'");
        world.teleport(0, new Pose(1, 0, 0));
        world.advance(30);
        assertThat(world.view().isAway(0)).isFalse();
        assertThat(world.latest().away()).isEmpty();
        assertThat(world.view().stalled(1)).as("robot s pushes robot r").isTrue();
        assertThat(aheadM(world, 0)).isLessThan(1);
    }

    @Test
    void reset_bringsEverythingBack() {
        World world = boxAhead();
        long start = SnapshotHash.of(world.latest());
        world.removeRobot(1);
        world.removeObstacle(BOX);
        world.advance(3);
        world.placeObstacle(1, new Pose(3, 0, 0));
        world.advance(3);
        assertThat(world.latest().placed()).hasSize(2);
        world.placeObstacle(1, world.spec().obstacles().get(1).pose());
        assertThat(world.advance().placed()).as("it is where it began").containsOnlyKeys(BOX);
        world.reset();
        world.advance();
        assertThat(world.latest().placed()).isEmpty();
        assertThat(world.latest().away()).isEmpty();
        World fresh = boxAhead();
        fresh.advance();
        assertThat(world.latest().robots()).isEqualTo(fresh.latest().robots());
        assertThat(start).isEqualTo(SnapshotHash.of(boxAhead().latest()));
        assertThat(world.view().holdsObstacle(BOX)).isTrue();
        assertThat(world.view().isAway(1)).isFalse();
    }

    @Test
    void wrongPlaces_areRefused() {
        World world = boxAhead();
        assertThatThrownBy(() -> world.placeObstacle(BOX, new Pose(-0.5, 0, 0)))
                .hasMessage("obstacle 'box' cannot be put at (-0.5 m, 0.0 m, 0.0 rad): it would overlap robot 'r'");
        assertThatThrownBy(() -> world.placeObstacle(BOX, new Pose(Double.NaN, 0, 0)))
                .hasMessageEndingWith("expected finite numbers");
        assertThatThrownBy(() -> world.placeObstacle(BOX, new Pose(600, 0, 0)))
                .hasMessageEndingWith("expected at most 500.0 m from the origin along x and y");
        assertThatThrownBy(() -> world.removeObstacle(2))
                .hasMessage("there is no obstacle 2, world 'test' has 2, counted from 0");
        assertThatThrownBy(() -> world.removeRobot(2)).hasMessageStartingWith("there is no robot 2");
    }

    @Test
    void ofRobotsThatComeToOnePlace_theFirstIsThere() {
        World world = boxAhead();
        world.removeRobot(0);
        world.removeRobot(1);
        world.advance();
        world.teleport(0, new Pose(-5, 0, 0));
        world.teleport(1, new Pose(-5, 0, 0));
        assertThat(LoggedWarnings.of(World.class, world::advance))
                .singleElement()
                .asString()
                .endsWith("it would overlap robot 'r'");
        assertThat(world.view().isAway(0)).isFalse();
        assertThat(world.view().isAway(1)).as("robot r was in the way").isTrue();
    }

    // ---- determinism

    private static final int TICKS = 300;

    private static WorldSpec arena() {
        return RandomWorld.arena(3, 8, 0.2).withRobots(8);
    }

    private static Pose somewhere(Random random) {
        return new Pose(random.nextDouble(-4, 4), random.nextDouble(-4, 4), random.nextDouble(-3, 3));
    }

    /** Random robots and obstacles go, come and move while all robots drive; hashes of all ticks. */
    private static List<Long> busyRun(World world, long seed) {
        var random = new Random(seed);
        int obstacles = world.spec().obstacles().size();
        List<Long> hashes = new ArrayList<>();
        for (int tick = 0; tick < TICKS; tick++) {
            for (int robot = 0; robot < 8; robot++) {
                world.command(robot, random.nextDouble(-0.2, 0.8), random.nextDouble(-0.8, 0.8));
            }
            switch (random.nextInt(8)) {
                case 0 -> world.removeRobot(random.nextInt(8));
                case 1 -> world.removeObstacle(4 + random.nextInt(obstacles - 4)); // not the walls around
                case 2, 3 -> world.placeObstacleLater(4 + random.nextInt(obstacles - 4), somewhere(random));
                case 4, 5 -> world.teleportLater(random.nextInt(8), somewhere(random));
                default -> {}
            }
            hashes.add(SnapshotHash.of(world.advance()));
        }
        return hashes;
    }

    /** Runs something without the warnings of places that are taken. */
    private static <T> T quietly(Supplier<T> run) {
        var result = new ArrayList<T>();
        LoggedWarnings.of(World.class, () -> result.add(run.get()));
        return result.getFirst();
    }

    @Test
    void runWithComingsAndGoings_repeatsBitForBit_onSeveralThreads_andFromItsRecording() throws IOException {
        for (long seed = 1; seed <= 3; seed++) {
            long run = seed;
            World world = World.create(arena(), WorldSettings.defaults());
            var text = new StringWriter();
            List<Long> hashes;
            long hash;
            try (Recording recording = world.record(text)) {
                hashes = quietly(() -> busyRun(world, run));
                hash = recording.hash();
            }
            assertThat(text.toString()).contains(" leave ", " remove ", " place ", " teleport ");
            try (World threaded =
                    World.create(arena(), WorldSettings.defaults().withSensingThreads(3), SensingThreads.Choice.ALL)) {
                assertThat(quietly(() -> busyRun(threaded, run)))
                        .as("seed %d", seed)
                        .isEqualTo(hashes);
            }
            assertThat(Replay.read(new StringReader(text.toString())).play(arena(), snapshot -> {}))
                    .isEqualTo(hash);
        }
    }

    /** A scene built anew gives the readings of one that was like that from the start. */
    @Test
    void readingsAfterAChange_areThoseOfAWorldThatBeganSo() {
        WorldSpec all = RandomWorld.office(5, 2, 2).withRobots(3);
        var less = new ArrayList<>(all.obstacles());
        less.remove(less.size() - 1);
        World changed = World.create(all, WorldSettings.defaults());
        changed.removeObstacle(all.obstacles().size() - 1);
        World begun = World.create(
                new WorldSpec(all.name(), all.file(), all.intervalMillis(), all.robots(), less),
                WorldSettings.defaults());
        changed.advance();
        begun.advance();
        for (int tick = 0; tick < 50; tick++) {
            for (int robot = 0; robot < 3; robot++) {
                changed.command(robot, 0.4, 0.3);
                begun.command(robot, 0.4, 0.3);
            }
            assertThat(changed.advance().robots()).isEqualTo(begun.advance().robots());
        }
    }
}
