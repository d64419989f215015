package io.troupe.sim;

import static io.troupe.sim.Specs.first;
import static io.troupe.sim.Specs.robot;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.api.Named.named;
import static org.junit.jupiter.params.provider.Arguments.arguments;

import io.troupe.sim.SensingThreads.Choice;
import io.troupe.sim.SensingThreads.MeasuredChoice;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeNoise;
import io.troupe.sim.model.WorldSpec;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;
import java.util.SplittableRandom;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicIntegerArray;
import java.util.function.Consumer;
import java.util.function.UnaryOperator;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import java.util.zip.CRC32;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.Arguments;
import org.junit.jupiter.params.provider.MethodSource;
import org.junit.jupiter.params.provider.ValueSource;

/** The same seed gives the same trajectories, bit for bit: in every JVM, on any number of threads, after a reset. */
class DeterminismTest {
    private static final int TICKS = 600;

    /** A checksum of snapshots over every bit of their numbers. */
    private static final class Fingerprint {
        private final CRC32 crc = new CRC32();

        void add(Snapshot snapshot) {
            add(snapshot.tick(), snapshot.timeMicros());
            for (RobotReading robot : snapshot.robots()) {
                Odometry odometry = robot.odometry();
                add(robot.pose());
                add(odometry.pose());
                add(odometry.forwardMps(), odometry.turnRadps());
                add(odometry.stalled() ? 1 : 0);
                add(robot.wallGapM());
                robot.sonarM().forEach(this::add);
                // of ints and a double: the same in every JVM
                robot.blobs().blobs().forEach(blob -> add((long) blob.hashCode()));
            }
            snapshot.contacts()
                    .forEach(contact -> add(
                            contact.timeMicros(),
                            contact.robot(),
                            contact.other().hashCode()));
        }

        private void add(Pose pose) {
            add(pose.x(), pose.y(), pose.headingRad());
        }

        private void add(double... values) {
            Arrays.stream(values).mapToLong(Double::doubleToRawLongBits).forEach(this::add);
        }

        private void add(long... values) {
            for (long bits : values) {
                crc.update(ByteBuffer.allocate(Long.BYTES).putLong(bits).flip());
            }
        }
    }

    /** The checksum of a run of intervals, before each of which the robots are commanded. */
    private static long run(World world, int ticks, Consumer<World> commands) {
        var fingerprint = new Fingerprint();
        fingerprint.add(world.latest());
        for (int tick = 0; tick < ticks; tick++) {
            commands.accept(world);
            fingerprint.add(world.advance());
        }
        return fingerprint.crc.getValue();
    }

    // ---- crowds whose checksums are known: a change of one changes all worlds' trajectories and must be documented

    private static final WorldSpec CROWD = Arena.crowd(50, 1, Specs.RED, Specs.GREEN, Specs.BLUE);
    private static final long WANDERING_CROWD = 0x1cd2381fL; // on any number of threads

    private static void wander(World world) {
        Arena.wander(world.view());
    }

    /** All robots drive on through every obstacle: piles of robots that push and rub. */
    private static void driveBlindly(World world) {
        for (int robot = 0; robot < world.spec().robots().size(); robot++) {
            world.command(robot, 0.4, 0.1 * (robot % 5 - 2));
        }
    }

    static Stream<Arguments> crowds() {
        return Stream.of(
                arguments(named("cameras for three colours", CROWD), 300, WANDERING_CROWD, 0x77280fb8L),
                arguments(named("cameras for all colours", Arena.crowd(50, 2)), 300, 0x92a140c4L, 0x48e21de2L),
                arguments(
                        named("cameras for robots", Arena.crowd(50, 3, Specs.RED, Specs.ORANGE)),
                        300,
                        0xcf6da478L,
                        0xf81338a5L),
                arguments(named("four tiles", Arena.crowd(200, 4, Specs.BLUE)), 100, 0x3dc478bdL, 0x08236865L));
    }

    @ParameterizedTest
    @MethodSource("crowds")
    void crowd_wanderingOrDrivingBlindly_hasItsChecksum(WorldSpec spec, int ticks, long wandering, long blind) {
        assertThat(run(World.create(spec, WorldSettings.defaults()), ticks, DeterminismTest::wander))
                .isEqualTo(wandering);
        assertThat(run(World.create(spec, WorldSettings.defaults()), ticks, DeterminismTest::driveBlindly))
                .isEqualTo(blind);
    }

    // ---- six robots that wander by their sonars and sometimes collide, for a minute

    private static final WorldSpec ARENA = Arena.spec(6, UnaryOperator.identity());

    /** Robot 0 ignores its sensors and drives straight on, so that there are contacts. */
    private static void avoid(World world) {
        List<RobotReading> robots = world.latest().robots();
        world.command(0, 0.4, 0.05);
        for (int i = 1; i < robots.size(); i++) {
            List<Double> sonar = robots.get(i).sonarM();
            double left = Collections.min(sonar.subList(1, 4));
            double right = Collections.min(sonar.subList(4, 7));
            if (Math.min(left, right) > 0.5) {
                world.command(i, Math.min(0.5, (left + right) / 4), (left - right) / 5);
            } else {
                world.command(i, 0, left < right ? -0.5 : 0.5);
            }
        }
    }

    private static long minute(WorldSettings settings) {
        return run(World.create(ARENA, settings), TICKS, DeterminismTest::avoid);
    }

    @Test
    void seed_decidesARun_butNothingWithoutJitterAndNoise() {
        assertThat(minute(Arena.seed(7))).isEqualTo(minute(Arena.seed(7))).isNotEqualTo(minute(Arena.seed(8)));
        assertThat(minute(WorldSettings.defaults().withSeed(8)))
                .isEqualTo(minute(WorldSettings.defaults().withSeed(7)));
        var plain = robot("r", Pose.ORIGIN).withRangers(List.of(Arena.laser(RangeNoise.NONE)));
        WorldSpec spec = Specs.world(plain, Specs.wall("ahead", 3, 0, 1, 5));
        World one = World.create(spec, WorldSettings.defaults().withSeed(1));
        World other = World.create(spec, WorldSettings.defaults().withSeed(2));
        assertThat(SnapshotHash.of(one.latest())).isEqualTo(SnapshotHash.of(other.latest()));
    }

    @Test
    void bodies_collideAndMove_butNeverOverlap() {
        World world = World.create(ARENA, Arena.seed(7));
        int contacts = 0;
        for (int tick = 0; tick < TICKS; tick++) {
            avoid(world);
            Snapshot snapshot = world.advance();
            contacts += snapshot.contacts().size();
            for (RobotReading robot : snapshot.robots()) {
                assertThat(robot.wallGapM()).isGreaterThan(0);
                assertThat(Math.abs(robot.pose().x())).isLessThan(4);
                assertThat(Math.abs(robot.pose().y())).isLessThan(4);
            }
        }
        assertThat(contacts).as("something must have been hit").isPositive();
        assertThat(world.latest().robots())
                .as("and everybody must have moved")
                .extracting(robot -> robot.odometry().pose())
                .allSatisfy(
                        pose -> assertThat(StrictMath.hypot(pose.x(), pose.y())).isGreaterThan(0.1));
    }

    // ---- every device and all noise

    @Test
    @Timeout(300)
    void sameSeed_givesTheSameChecksum_withAllDevicesAndNoise_inAnInterpretedJvmToo() throws Exception {
        String once = Arena.minute(7).toString();
        assertThat(Arena.minute(7).toString()).isEqualTo(once);
        assertThat(Arena.minute(8).toString()).isNotEqualTo(once);
        String java = Path.of(System.getProperty("java.home"), "bin", "java").toString();
        String classPath = System.getProperty("java.class.path");
        Process process = new ProcessBuilder(java, "-Xint", "-cp", classPath, Arena.class.getName(), "7")
                .redirectErrorStream(true)
                .start();
        String said = new String(process.getInputStream().readAllBytes(), StandardCharsets.UTF_8);
        assertThat(process.waitFor(200, TimeUnit.SECONDS)).isTrue();
        assertThat(said.strip()).isEqualTo(once);
    }

    @Test
    void oneBitAnywhere_changesTheChecksum() {
        Snapshot snapshot = World.create(Arena.spec(2), Arena.seed(1)).latest();
        RobotReading first = first(snapshot);
        List<List<Double>> rangers = new ArrayList<>(first.rangersM());
        List<Double> scan = new ArrayList<>(rangers.getLast());
        scan.set(3, Math.nextUp(scan.get(3)));
        rangers.set(1, scan);
        var changed = new RobotReading(
                first.pose(), first.odometry(), first.sonarM(), first.blobs(), rangers, first.wallGapM());
        var contact = new Contact(0, 0, "wall", -1);
        long expected = SnapshotHash.of(snapshot);
        assertThat(SnapshotHash.of(with(snapshot, changed))).isNotEqualTo(expected);
        assertThat(SnapshotHash.of(with(snapshot, first))).isEqualTo(expected);
        assertThat(SnapshotHash.of(new Snapshot(0, 0, snapshot.robots(), List.of(contact))))
                .isNotEqualTo(expected);
    }

    private static Snapshot with(Snapshot snapshot, RobotReading first) {
        List<RobotReading> robots = List.of(first, snapshot.robots().get(1));
        return new Snapshot(snapshot.tick(), snapshot.timeMicros(), robots, List.of());
    }

    @Test
    void anotherRobot_changesNobodyElsesNoise() {
        assertThat(firstReadings(Arena.spec(2))).isEqualTo(firstReadings(Arena.spec(1)));
    }

    /** Laser and odometry of the first robot, which turns on the spot and sees no other robot. */
    private static List<Object> firstReadings(WorldSpec spec) {
        World world = World.create(spec, WorldSettings.defaults().withSeed(3));
        var readings = new ArrayList<Object>();
        for (int tick = 0; tick < 5; tick++) {
            world.command(0, 0, -1);
            RobotReading reading = first(world.advance());
            readings.add(reading.odometry());
            readings.add(reading.rangersM().getFirst().subList(0, 10)); // to its right
        }
        return readings;
    }

    @Test
    void reset_repeatsWhatFollowedTheStart_bitForBit_withAControllerToo() {
        World world = World.create(Arena.spec(6), Arena.seed(5));
        List<Object> fromStart = readings(world);
        world.reset();
        assertThat(readings(world).equals(fromStart)).isTrue(); // too long to print
        assertThat(world.latest().tick()).as("time goes on").isEqualTo(400);
        assertThat(world.latest().timeMicros()).isEqualTo(40_000_000);
        World steered = World.create(Arena.spec(6), Arena.seed(5));
        List<Object> steeredFromStart = controlled(steered);
        steered.reset();
        assertThat(controlled(steered).equals(steeredFromStart)).isTrue();
    }

    private static List<Object> readings(World world) {
        long start = world.timeMicros();
        var random = new SplittableRandom(9);
        var readings = new ArrayList<Object>();
        int contacts = 0;
        for (int tick = 0; tick < 200; tick++) {
            Arena.drive(world, random);
            Snapshot snapshot = world.advance();
            readings.add(snapshot.robots());
            for (Contact contact : snapshot.contacts()) {
                readings.add(new Contact(
                        contact.timeMicros() - start, contact.robot(), contact.other(), contact.otherRobot()));
                contacts++;
            }
        }
        assertThat(contacts).as("something must have been hit").isPositive();
        return readings;
    }

    /** Commands the robots by their sensor readings, from the first interval on. */
    private static List<Object> controlled(World world) {
        var readings = new ArrayList<Object>();
        for (int tick = 0; tick < 100; tick++) {
            readings.add(world.advance(1, view -> {
                        for (int robot = 0; robot < view.robotCount(); robot++) {
                            view.command(robot, view.rangeM(robot, 3) / 10, view.rangeM(robot, 0) / 10);
                        }
                    })
                    .robots());
        }
        return readings;
    }

    @Test
    void reset_forgetsWhatWasSaidBefore_andKeepsWhatIsSaidAfter() {
        WorldSpec spec = Specs.world(List.of(robot("a", Pose.ORIGIN), robot("b", 20, 0, 0)));
        World world = World.create(spec, Arena.seed(1));
        Pose start = first(world.latest()).pose();
        world.command(0, 0.5, 0);
        world.setOdometry(0, new Pose(7, 7, 0));
        world.teleport(0, new Pose(5, 5, 0));
        world.reset();
        world.command(1, 0.5, 0);
        Snapshot after = world.advance();
        assertThat(first(after).pose()).isEqualTo(start);
        assertThat(first(after).odometry().pose().x()).isZero();
        assertThat(after.robots().get(1).odometry().forwardMps()).isEqualTo(0.5);
    }

    @ParameterizedTest
    @ValueSource(ints = {2, 4})
    @Timeout(60)
    void threads_changeNoBit(int threads) {
        try (World world = World.create(CROWD, WorldSettings.defaults().withSensingThreads(threads), Choice.ALL)) {
            assertThat(run(world, 300, DeterminismTest::wander))
                    .as("as on one thread")
                    .isEqualTo(WANDERING_CROWD);
        }
    }

    @Test
    @Timeout(60)
    void everyRobot_isInOneRange_eachOfWhichHasItsOwnThread() {
        for (int robots : new int[] {3, 10, 1000}) {
            var visits = new AtomicIntegerArray(robots);
            var threads = new Thread[3];
            try (var sensing = new SensingThreads("test", 3, robots, Choice.ALL, (range, from, to) -> {
                threads[range] = Thread.currentThread();
                IntStream.range(from, to).forEach(visits::incrementAndGet);
            })) {
                for (int round = 1; round <= 50; round++) {
                    sensing.run();
                    for (int i = 0; i < robots; i++) {
                        assertThat(visits.get(i))
                                .as("robot %d of %d", i, robots)
                                .isEqualTo(round);
                    }
                }
                assertThat(threads[0]).isSameAs(Thread.currentThread());
                assertThat(Arrays.asList(threads).subList(1, 3)).isEqualTo(sensing.helpers());
            }
        }
    }

    /** Runs rounds that take so long with all threads, and alone; counts those with all threads. */
    private static long roundsTogether(MeasuredChoice choice, int rounds, long togetherNanos, long aloneNanos) {
        int together = 0;
        for (int round = 0; round < rounds; round++) {
            together += choice.isTogether() ? 1 : 0;
            boolean pause = round % 5 == 0; // another program had the processor
            choice.took(pause ? 20_000_000 : choice.isTogether() ? togetherNanos : aloneNanos);
        }
        return together;
    }

    @Test
    void threads_areUsedIfTheyAreFaster_alsoWhenThatChanges() {
        var choice = new MeasuredChoice();
        assertThat(roundsTogether(choice, 30_000, 60_000, 20_000))
                .as("only in trials, which become rare")
                .isLessThan(30_000 / 100);
        assertThat(roundsTogether(choice, 2 * MeasuredChoice.MOST_PAUSE_ROUNDS, 60_000, 100_000))
                .isGreaterThan(MeasuredChoice.MOST_PAUSE_ROUNDS / 2);
        assertThat(roundsTogether(choice, 30_000, 60_000, 100_000)).isGreaterThan(30_000 * 99 / 100);
        assertThat(roundsTogether(new MeasuredChoice(), 30_000, 95_000, 100_000))
                .as("hardly faster")
                .isLessThan(30_000 / 100);
    }

    @Test
    @Timeout(60)
    void threads_throwTheirFailures_runWholeAfterwards_andEndWithClose() throws InterruptedException {
        var fails = new boolean[] {true};
        try (var sensing = new SensingThreads("test", 2, 2, Choice.ALL, (range, from, to) -> {
            if (range == 1 && fails[0]) {
                throw new IllegalArgumentException("broken sonar");
            }
        })) {
            assertThatThrownBy(sensing::run).hasMessage("broken sonar");
            fails[0] = false;
            sensing.run();
        }
        var visits = new AtomicIntegerArray(5);
        var whole = new SensingThreads(
                "test",
                4,
                5,
                Choice.ALL,
                (range, from, to) -> IntStream.range(from, to).forEach(visits::incrementAndGet));
        whole.run();
        whole.close();
        for (Thread helper : whole.helpers()) {
            assertThat(helper.join(Duration.ofSeconds(30))).isTrue();
        }
        whole.run();
        assertThat(visits).hasToString("[2, 2, 2, 2, 2]");
    }

    @Test
    @Timeout(60)
    void world_closedOrInterrupted_keepsItsReadings() throws Exception {
        WorldSpec allColours = Arena.crowd(50, 1);
        World world = World.create(allColours, WorldSettings.defaults().withSensingThreads(2), Choice.ALL);
        World other = World.create(allColours, WorldSettings.defaults());
        Thread.currentThread().interrupt();
        Snapshot snapshot = world.advance();
        assertThat(Thread.interrupted()).isTrue();
        assertThat(snapshot).isEqualTo(other.advance());
        Snapshot last = world.advance();
        CompletableFuture.runAsync(world::close).get(30, TimeUnit.SECONDS);
        assertThatThrownBy(world::advance)
                .isInstanceOf(IllegalStateException.class)
                .hasMessage("world 'test' is closed");
        assertThat(world.latest()).isSameAs(last);
    }
}
