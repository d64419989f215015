package io.troupe.sim;

import static io.troupe.sim.Specs.R1;
import static io.troupe.sim.Specs.driven;
import static io.troupe.sim.Specs.first;
import static io.troupe.sim.Specs.robot;
import static io.troupe.sim.Specs.run;
import static io.troupe.sim.Specs.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.device.Outline;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.physics.Physics;
import io.troupe.sim.worldfile.WorldFileException;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.SplittableRandom;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;

/** Start poses with jitter, and robots that overlap something at the start: as in Stage they stall until a teleport. */
class StartPosesTest {
    private static final Pose FIRST = new Pose(1, -1, 0.5);
    private static final WorldSpec ALONE = Specs.world(robot("r1", FIRST));

    private static WorldSettings jitter(long seed) {
        return WorldSettings.defaults().withSeed(seed).withJitter(0.02, 0.03);
    }

    private static RobotReading reading(WorldSpec world, WorldSettings settings, int robot) {
        return World.create(world, settings).latest().robots().get(robot);
    }

    private static Pose start(WorldSpec world, WorldSettings settings, int robot) {
        return reading(world, settings, robot).pose();
    }

    @Test
    void jitter_staysWithinItsBounds_andUsesThem_butIsOffByDefault() {
        assertThat(start(ALONE, WorldSettings.defaults().withSeed(99), 0)).isEqualTo(FIRST);
        List<Double> offsets = new ArrayList<>();
        for (long seed = 0; seed < 500; seed++) {
            Pose start = start(ALONE, jitter(seed), 0);
            assertThat(start.x() - FIRST.x()).as("x, seed %d", seed).isBetween(-0.02, 0.02);
            assertThat(start.y() - FIRST.y()).as("y, seed %d", seed).isBetween(-0.02, 0.02);
            assertThat(start.headingRad() - FIRST.headingRad())
                    .as("heading, seed %d", seed)
                    .isBetween(-0.03, 0.03);
            offsets.add(start.x() - FIRST.x());
        }
        assertThat(offsets)
                .anyMatch(offset -> offset < -0.019)
                .anyMatch(offset -> offset > 0.019)
                .doesNotHaveDuplicates();
        assertThat(offsets.stream().mapToDouble(offset -> offset).average().orElseThrow())
                .isBetween(-0.002, 0.002);
    }

    @Test
    void jitter_ofARobot_dependsOnSeedAndRobotOnly_andOdometryStartsFromIt() {
        Pose alone = start(ALONE, jitter(5), 0);
        RobotSpec one = robot("r1", FIRST);
        RobotSpec other = robot("r2", -2, 2, -3);
        assertThat(start(Specs.world(List.of(one, other)), jitter(5), 0)).isEqualTo(alone);
        assertThat(start(Specs.world(List.of(other, one)), jitter(5), 1)).isEqualTo(alone);
        assertThat(start(ALONE, jitter(6), 0)).isNotEqualTo(alone);
        WorldSpec world = Specs.world(List.of(R1, robot("r2", 0, 2, 0)));
        assertThat(start(world, jitter(5), 1).x())
                .isNotEqualTo(start(world, jitter(5), 0).x());
        RobotReading reading = reading(ALONE, jitter(3), 0);
        assertThat(reading.pose()).isNotEqualTo(FIRST);
        assertThat(reading.odometry().pose()).isEqualTo(Pose.ORIGIN);
    }

    private static WorldSpec between(double distanceM) {
        return Specs.world(R1, wall("left", 0, distanceM, 2, 1), wall("right", 0, -distanceM, 2, 1));
    }

    @Test
    void jitter_neverStartsWithATouch_andWithoutRoomSaysSo() {
        // 3 cm of room to each side: about half of all draws would touch
        for (long seed = 0; seed < 200; seed++) {
            assertThat(reading(between(0.72), jitter(seed), 0).wallGapM())
                    .as("seed %d", seed)
                    .isGreaterThan(Physics.SKIN_M);
        }
        assertThatThrownBy(() -> World.create(between(0.70), jitter(4)))
                .isInstanceOf(WorldFileException.class)
                .hasMessageContainingAll(
                        "test.world:7:1: robot 'r1' has no room to start up to 0.02 m", "seed 4", "obstacle 'left'");
    }

    @Test
    void overlap_isNotJitteredAway_andBodiesThatOnlyTouchDoNotOverlap() {
        StartPoses overlapping = StartPoses.of(Specs.world(R1, wall("wall", 0.6, 0, 1, 1)), jitter(4));
        assertThat(overlapping.poses()).containsExactly(Pose.ORIGIN);
        assertThat(overlapping.stuck().get(0)).isTrue();
        for (double x : new double[] {0.68, 0.68 - 1e-10}) { // also where a sum was rounded
            WorldSpec touching = Specs.world(R1, wall("wall", x, 0, 1, 1));
            assertThat(StartPoses.of(touching, WorldSettings.defaults()).stuck().isEmpty())
                    .as("wall at %s", x)
                    .isTrue();
        }
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
        var spec = Specs.world(List.of(R1, robot("r2", 0, gapM, 0)));
        int free = 0;
        for (int seed = 1; seed <= 50; seed++) {
            try {
                assertThat(StartPoses.of(spec, jitter(seed)).stuck().isEmpty())
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
        return new Outline(R1.collisionShape(), one).overlaps(new Outline(R1.collisionShape(), other));
    }

    // ---- stuck robots

    private static final Pose FREE = new Pose(-5, 0, 0);

    private static World world(Pose first, Pose second) {
        return World.create(
                Specs.world(List.of(robot("r1", first), robot("r2", second)), wall("wall", 0.6, 0, 1, 1)), jitter(3));
    }

    @Test
    void robotInAWall_staysThereAndStallsOnlyWhileItIsDriven() {
        World world = world(Pose.ORIGIN, FREE);
        assertThat(run(world, 5).odometry().stalled()).isFalse();
        world.command(0, 0.3, 0.5);
        RobotReading stuck = run(world, 20);
        assertThat(stuck.pose()).isEqualTo(Pose.ORIGIN);
        assertThat(stuck.odometry().pose()).isEqualTo(Pose.ORIGIN);
        assertThat(stuck.odometry().stalled()).isTrue();
        world.stop(0);
        assertThat(run(world, 20).odometry().stalled()).isFalse();
    }

    @Test
    void robotsInEachOther_stayBoth_andHoldBackOthers() {
        World world = driven(0.3, world(new Pose(-3, 0, 0), new Pose(-3.1, 0.1, 1)));
        assertThat(world.advance(20).robots())
                .allMatch(robot -> robot.odometry().stalled())
                .extracting(RobotReading::pose)
                .as("no jitter either")
                .containsExactly(new Pose(-3, 0, 0), new Pose(-3.1, 0.1, 1));
        World pushing = world(Pose.ORIGIN, new Pose(-1.5, 0, 0));
        pushing.command(1, 0.4, 0);
        Snapshot later = pushing.advance(50);
        assertThat(first(later).pose()).isEqualTo(Pose.ORIGIN);
        assertThat(later.robots().get(1).pose().x()).isLessThan(-0.4);
        assertThat(later.robots().get(1).odometry().stalled()).isTrue();
    }

    @Test
    void robotThatIsPutElsewhere_drivesLikeAnyOther_andIsStuckAgainAfterAReset() {
        World world = world(Pose.ORIGIN, FREE);
        world.teleport(0, new Pose(-5, 3, 0));
        world.command(0, 0.4, 0);
        RobotReading free = run(world, 10);
        assertThat(free.pose().x()).isCloseTo(-4.6, within(1e-9));
        assertThat(free.odometry().stalled()).isFalse();
        world.reset();
        world.advance();
        world.command(0, 0.4, 0);
        assertThat(run(world, 20).pose()).isEqualTo(Pose.ORIGIN);
    }

    @Test
    void robotThatWasFreed_isHeldBackByWallsAsOthersAre() {
        List<Pose> ends = Stream.of(Pose.ORIGIN, new Pose(-5, -3, 0))
                .map(start -> {
                    World world = world(start, FREE);
                    world.teleport(0, new Pose(-1, 0, 0));
                    world.command(0, 0.4, 0.1);
                    return run(world, 50).pose();
                })
                .toList();
        assertThat(ends.getFirst()).isEqualTo(ends.getLast());
    }

    // ---- room for a teleport

    private static List<Pose> rows(int count) {
        return IntStream.range(0, count)
                .mapToObj(i -> new Pose(i % 100 - 50, i / 100 - 50, i))
                .toList();
    }

    private static PlacementCheck room(List<Pose> poses) {
        return new PlacementCheck(Specs.world(IntStream.range(0, poses.size())
                .mapToObj(i -> Specs.robot("r" + i, poses.get(i)))
                .toList()));
    }

    /** Each check looks at the robots that are near, not at all robots. */
    @Test
    void teleportsOfAllRobots_lookAtAFewRobotsEach() {
        List<Pose> poses = new ArrayList<>(rows(4_000));
        var looks = new int[1];
        PlacementCheck.Occupancy occupancy = room(poses).occupancy(robot -> {
            looks[0]++;
            return poses.get(robot);
        });
        for (int robot = 0; robot < 4_000; robot++) {
            Pose to = new Pose(poses.get(robot).x() + 0.1, poses.get(robot).y(), 1);
            assertThat(occupancy.refusal(robot, to)).as("robot %d", robot).isNull();
            poses.set(robot, to);
            occupancy.moved(robot);
        }
        assertThat(looks[0]).isBetween(4_000, 20 * 4_000);
    }

    @Test
    void questionAboutAPlace_looksAtTheObstaclesNearby_andAtTheLargeOnes() {
        List<ObstacleSpec> obstacles = new ArrayList<>();
        rows(4_000).forEach(pose -> obstacles.add(Specs.box("o", pose, 0.2, 0.2, Specs.BLACK)));
        obstacles.add(Specs.box("wall", new Pose(0, 60, 0), 200, 0.1, Specs.BLACK));
        var room = new PlacementCheck(Specs.world(List.of(Specs.robot("r", 100, 0, 0)), obstacles));
        assertThat(room.obstaclesNear(new Pose(0, -40, 0)))
                .contains(1_050, 4_000)
                .hasSizeLessThan(30);
    }

    /** True if the place is refused: asserts that the answer names the first thing in the way. */
    private static boolean isRefused(@Nullable String answer, Optional<String> firstInTheWay, String question) {
        String expected = firstInTheWay.map(name -> "it would overlap " + name).orElse(null);
        if (expected == null) {
            assertThat(answer).as(question).isNull();
        } else {
            assertThat(answer).as(question).endsWith(expected);
        }
        return expected != null;
    }

    @Test
    void refusal_namesTheFirstRobotInTheWay_asAComparisonWithAllOfThemDoes() {
        long seed = 7;
        var random = new SplittableRandom(seed);
        List<Pose> poses = new ArrayList<>(rows(60));
        PlacementCheck.Occupancy occupancy = room(poses).occupancy(poses::get);
        Shape body = Specs.R1.shape();
        int refused = 0;
        for (int i = 0; i < 2_000; i++) {
            int robot = random.nextInt(60);
            Pose to = new Pose(random.nextDouble(-51, 11), random.nextDouble(-51, -48), random.nextDouble(6));
            var outline = new Outline(body, to);
            Optional<String> expected = IntStream.range(0, poses.size())
                    .filter(other -> other != robot && new Outline(body, poses.get(other)).overlaps(outline))
                    .mapToObj(other -> "robot 'r" + other + "'")
                    .findFirst();
            if (isRefused(occupancy.refusal(robot, to), expected, "seed " + seed + ", question " + i)) {
                refused++;
            } else {
                poses.set(robot, to);
                occupancy.moved(robot);
            }
        }
        assertThat(refused).isBetween(200, 1_800);
    }

    @Test
    void refusal_namesTheFirstObstacleInTheWay_asAComparisonWithAllOfThemDoes() {
        long seed = 11;
        var random = new SplittableRandom(seed);
        List<ObstacleSpec> obstacles = new ArrayList<>();
        for (int i = 0; i < 200; i++) { // some are in a few cells, some in many
            double length = random.nextInt(10) == 0 ? random.nextDouble(5, 20) : random.nextDouble(0.1, 2);
            var at = new Pose(random.nextDouble(-30, 30), random.nextDouble(-30, 30), random.nextDouble(6));
            obstacles.add(Specs.box("o" + i, at, length, 0.1, Specs.BLACK));
        }
        var robot = Specs.robot("r", 100, 0, 0);
        PlacementCheck.Occupancy occupancy =
                new PlacementCheck(Specs.world(List.of(robot), obstacles)).occupancy(each -> robot.pose());
        int refused = 0;
        for (int i = 0; i < 1_000; i++) {
            Pose to = new Pose(random.nextDouble(-31, 31), random.nextDouble(-31, 31), random.nextDouble(6));
            var outline = new Outline(robot.collisionShape(), to);
            Optional<String> expected = obstacles.stream()
                    .filter(each -> new Outline(each.shape(), each.pose()).overlaps(outline))
                    .map(each -> "obstacle '" + each.name() + "'")
                    .findFirst();
            if (isRefused(occupancy.refusal(0, to), expected, "seed " + seed + ", question " + i)) {
                refused++;
            }
        }
        assertThat(refused).isBetween(30, 970);
    }
}
