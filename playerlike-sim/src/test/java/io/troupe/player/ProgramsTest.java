package io.troupe.player;

import static io.troupe.sim.TestWorlds.BLACK;
import static io.troupe.sim.TestWorlds.RED;
import static io.troupe.sim.TestWorlds.robot;
import static io.troupe.sim.TestWorlds.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.player.programs.BlobSeeker;
import io.troupe.player.programs.GoalDriver;
import io.troupe.player.programs.LaserDriver;
import io.troupe.player.programs.MyRobot;
import io.troupe.player.programs.PullReader;
import io.troupe.player.programs.PullThread;
import io.troupe.player.programs.ReadAllWanderer;
import io.troupe.player.programs.SpaceWanderer;
import io.troupe.player.programs.Speeder;
import io.troupe.player.programs.TwoPorts;
import io.troupe.player.programs.TwoRobots;
import io.troupe.player.programs.WallFollower;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.wire.TcpServer;
import io.troupe.sim.Pace;
import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import io.troupe.sim.Snapshot;
import io.troupe.sim.Specs;
import io.troupe.sim.TestWorlds;
import io.troupe.sim.UnansweredTickException;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeNoise;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.Scenario;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.parallel.Isolated;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/**
 * Programs as students write them against a world that runs by itself: those of the package {@code programs}, written
 * for javaclient3 with only the import prefix changed, in this JVM and over a socket; and programs of unpredictable
 * speed.
 */
@Tag("threads")
@Timeout(120)
@Isolated("looks at all threads")
class ProgramsTest implements PlayerConstants {
    private static final int PORT = 6740;
    private static final String HOST = "localhost";

    /** Ends with a {@link PlayerException} when the server closes. */
    interface Program {
        void run() throws Exception;
    }

    /** Runs programs until the world has ticked so many times; closes the world and returns its snapshots. */
    static List<Snapshot> run(Simulation simulation, Pace pace, int clients, int ticks, List<Program> programs)
            throws InterruptedException {
        var snapshots = new ArrayList<Snapshot>();
        var enough = new CountDownLatch(1);
        var failures = new ConcurrentLinkedQueue<Exception>();
        var threads = new ArrayList<Thread>();
        try (simulation;
                var runner = SimulationRunner.start(
                        simulation,
                        clients,
                        snapshot -> {
                            if (snapshots.size() < ticks) {
                                snapshots.add(snapshot);
                            } else {
                                enough.countDown();
                            }
                        },
                        pace)) {
            assertThat(runner.isRunning()).isTrue();
            for (var program : programs) {
                threads.add(Thread.ofPlatform().daemon().start(() -> {
                    try {
                        program.run();
                    } catch (PlayerException serverHasGone) {
                        // ends every endless program
                    } catch (Exception e) {
                        failures.add(e);
                        enough.countDown();
                    }
                }));
            }
            assertThat(enough.await(100, TimeUnit.SECONDS)).isTrue();
        }
        for (var thread : threads) {
            thread.join();
        }
        assertThat(failures).isEmpty();
        return snapshots;
    }

    // ---- the package programs

    private interface Main {
        void run(String[] args) throws Exception;
    }

    /** A program: its run time, its number of clients, and how far its first robot drives in that time, in metres. */
    enum Corpus {
        WALL_FOLLOWER(WallFollower::main, 600, 1, false, 3),
        SPACE_WANDERER(SpaceWanderer::main, 300, 1, false, 3),
        READ_ALL_WANDERER(ReadAllWanderer::main, 300, 1, false, 3),
        MY_ROBOT(MyRobot::main, 300, 1, false, 2),
        TWO_ROBOTS(TwoRobots::main, 300, 1, false, 3),
        TWO_PORTS(TwoPorts::main, 300, 2, false, 3),
        PULL_READER(PullReader::main, 300, 1, true, 3),
        PULL_THREAD(PullThread::main, 300, 1, true, 3),
        GOAL_DRIVER(GoalDriver::main, 300, 1, true, 2),
        LASER_DRIVER(LaserDriver::main, 200, 1, true, 2),
        BLOB_SEEKER(BlobSeeker::main, 200, 1, true, 1),
        SPEEDER(Speeder::main, 100, 1, true, 1);

        private final Main main;
        private final int ticks;
        private final int clients;
        private final boolean pulls;
        private final double atLeastM;

        Corpus(Main main, int ticks, int clients, boolean pulls, double atLeastM) {
            this.main = main;
            this.ticks = ticks;
            this.clients = clients;
            this.pulls = pulls;
            this.atLeastM = atLeastM;
        }

        private List<Snapshot> run(Simulation simulation, int count, Pace pace, int port, int secondPort)
                throws InterruptedException {
            Program program = () -> main.run(new String[] {HOST, "" + port, "" + secondPort});
            return ProgramsTest.run(simulation, pace, clients, count, List.of(program));
        }
    }

    private static DeviceBinding binding(int port, String type, int index, String robot, int ranger) {
        return new DeviceBinding(port, type, index, robot, ranger, Specs.at(1));
    }

    /** Both robots at the first port; the second robot at the second port too. */
    private static Simulation open() {
        var one = Specs.robot("one", new Pose(0.5, 1.2, 0), Specs.ORANGE, Specs.pioneerFront(), Specs.camera(5))
                .withRangers(List.of(laser(RangerSpec.Kind.LASER), laser(RangerSpec.Kind.RANGER)));
        var two = Specs.robot("two", new Pose(-1, -2, 1), Specs.ORANGE, Specs.pioneerFront(), Specs.camera(5));
        var devices = new ArrayList<DeviceBinding>();
        for (String type : List.of("position2d", "sonar", "blobfinder")) {
            devices.add(binding(PORT, type, 0, "one", 0));
            devices.add(binding(PORT, type, 1, "two", 0));
            devices.add(binding(PORT + 1, type, 0, "two", 0));
        }
        devices.add(binding(PORT, "laser", 0, "one", 0));
        devices.add(binding(PORT, "ranger", 0, "one", 1));
        devices.add(binding(PORT, "simulation", 0, "", 0));
        var obstacles = new ArrayList<>(Specs.arena(8));
        obstacles.add(Specs.box("red", new Pose(-3.5, 3.5, 0), 0.4, 0.4, Specs.RED));
        var scenario = new Scenario(Specs.world(List.of(one, two), obstacles), devices);
        return Simulation.open(scenario, WorldSettings.defaults().withLimits(1, 2));
    }

    /** 37 beams over half a circle, without noise. */
    private static RangerSpec laser(RangerSpec.Kind kind) {
        var beam = new RangeSensorSpec(Pose.ORIGIN, 0, 8, Math.PI, 37, 0.1, 0.1, RangeNoise.NONE);
        return new RangerSpec(kind, Pose.ORIGIN, 0.1, 0.1, List.of(beam));
    }

    private static List<Snapshot> inProcess(Corpus program) throws InterruptedException {
        return program.run(open(), program.ticks, new Pace.Unlimited(), PORT, PORT + 1);
    }

    private static List<Snapshot> overTcp(Corpus program) throws InterruptedException {
        try (var simulation = open();
                var first = TcpServer.open(PlayerPorts.find(PORT).orElseThrow(), 0);
                var second = TcpServer.open(PlayerPorts.find(PORT + 1).orElseThrow(), 0)) {
            Pace pace = program.pulls ? new Pace.OfAnswers() : new Pace.RealTime(10);
            return program.run(simulation, program.pulls ? program.ticks : 100, pace, first.port(), second.port());
        }
    }

    private static double wayM(List<Snapshot> snapshots, int robot) {
        double way = 0;
        for (int tick = 1; tick < snapshots.size(); tick++) {
            Pose from = snapshots.get(tick - 1).robots().get(robot).pose();
            Pose to = snapshots.get(tick).robots().get(robot).pose();
            way += Math.hypot(to.x() - from.x(), to.y() - from.y());
        }
        return way;
    }

    /** Checks what the robots did in lock step. */
    private static void check(Corpus program, List<Snapshot> snapshots) {
        assertThat(snapshots).hasSize(program.ticks);
        assertThat(wayM(snapshots, 0)).as("way of robot one").isGreaterThan(program.atLeastM);
        if (program == Corpus.TWO_ROBOTS || program == Corpus.TWO_PORTS) {
            assertThat(wayM(snapshots, 1)).as("way of robot two").isGreaterThan(program.atLeastM);
        } else {
            assertThat(wayM(snapshots, 1)).as("way of robot two").isZero();
        }
        assertThat(snapshots)
                .as("nobody touched anything")
                .allSatisfy(each -> assertThat(each.contacts()).isEmpty());
        var robot = snapshots.getLast().robots().getFirst();
        Pose end = robot.pose();
        switch (program) {
            case GOAL_DRIVER -> // odometry was reset at the start
                assertThat(Math.hypot(end.x() - 2, end.y() - 2.2)).isLessThan(0.3);
            case WALL_FOLLOWER -> assertThat(robot.wallGapM()).isBetween(0.05, 0.5);
            case BLOB_SEEKER ->
                assertThat(Math.hypot(end.x() + 3.5, end.y() - 3.5))
                        .as("distance to the red box")
                        .isLessThan(1.3);
            default -> {}
        }
    }

    /** Reports the first difference only: whole runs would fill pages. */
    private static void assertSame(List<Snapshot> snapshots, List<Snapshot> expected) {
        for (int tick = 0; tick < expected.size(); tick++) {
            assertThat(snapshots.get(tick)).isEqualTo(expected.get(tick));
        }
        assertThat(snapshots).hasSameSizeAs(expected);
    }

    @ParameterizedTest
    @EnumSource
    void program_inThisJvm_drives_theSameWayEveryTime(Corpus program) throws Exception {
        List<Snapshot> first = inProcess(program);
        check(program, first);
        assertSame(inProcess(program), first);
    }

    @ParameterizedTest
    @EnumSource
    void program_behindASocket_drives_andInPullModeTheSameWayAsInThisJvm(Corpus program) throws Exception {
        List<Snapshot> overTcp = overTcp(program);
        if (program.pulls) {
            check(program, overTcp);
            assertSame(overTcp, inProcess(program));
        } else {
            // The world does not wait for this client: how well it drives depends on the load of this machine.
            assertThat(wayM(overTcp, 0)).as("way of robot one").isGreaterThan(0.1);
        }
    }

    @Test
    void threads_ofClosedProgramsAndServers_areGone() throws Exception {
        overTcp(Corpus.PULL_READER);
        for (Thread each : Thread.getAllStackTraces().keySet()) {
            if (each.getName().startsWith("player-connection-")
                    || each.getName().startsWith("simulation-")) {
                each.join(Duration.ofMinutes(1)); // it has been asked to end, and ends once it gets a processor
                assertThat(each.isAlive()).as(each.getName()).isFalse();
            }
        }
    }

    // ---- programs of unpredictable speed

    /** The style in which a program reads its data. */
    enum Style {
        BUSY_WAIT {
            @Override
            void drive(int index, Random random) {
                var client = new PlayerClient(HOST, PORT);
                var pos = client.requestInterfacePosition2D(index, PLAYER_OPEN_MODE);
                var son = client.requestInterfaceSonar(index, PLAYER_OPEN_MODE);
                client.runThreaded(-1, -1);
                while (true) {
                    while (!son.isDataReady())
                        ;
                    float[] ranges = son.getData().getRanges();
                    for (int i = 0; i < ranges.length; i++) {
                        ranges[i] = Math.min(ranges[i], 2f);
                    }
                    dawdle(random);
                    pos.setSpeed(ranges[1] > 1 ? 0.4 : 0, ranges[1] > 1 ? 0.05 * pos.getX() : 0.3);
                }
            }
        },

        READ_ALL {
            @Override
            void drive(int index, Random random) {
                var client = new PlayerClient(HOST, PORT);
                var pos = client.requestInterfacePosition2D(index, PLAYER_OPEN_MODE);
                var son = client.requestInterfaceSonar(index, PLAYER_OPEN_MODE);
                double x = 0;
                while (true) {
                    client.requestData();
                    client.readAll();
                    if (pos.isDataReady()) {
                        x = pos.getX();
                    }
                    dawdle(random);
                    if (son.isDataReady()) {
                        dawdle(random);
                        pos.setSpeed(son.getData().getRanges()[1] > 1 ? 0.4 : 0, 0.1 - 0.05 * x);
                    }
                }
            }
        },

        SUBCLASS_THAT_ASKS_ONE_BY_ONE {
            /** Two reactions that contradict each other: the order of their commands matters. */
            @Override
            void drive(int index, Random random) {
                class Robot extends PlayerClient {
                    final Position2DInterface pos = requestInterfacePosition2D(index, PLAYER_OPEN_MODE);
                    final SonarInterface son = requestInterfaceSonar(index, PLAYER_OPEN_MODE);
                    final BlobfinderInterface blf = requestInterfaceBlobfinder(index, PLAYER_OPEN_MODE);

                    Robot() {
                        super(HOST, PORT);
                        runThreaded(-1, -1);
                    }
                }
                var robot = new Robot();
                while (true) {
                    if (robot.blf.isDataReady() && robot.blf.getData().getBlobs_count() > 0) {
                        robot.pos.setSpeed(0.1, 0.2);
                    }
                    dawdle(random);
                    if (robot.pos.isDataReady()) {
                        robot.pos.setSpeed(0.4, 0.1 * Math.sin(robot.pos.getX()));
                    }
                    dawdle(random);
                    if (robot.son.isDataReady() && robot.son.getData().getRanges()[1] < 1) {
                        robot.pos.setSpeed(0, 0.3);
                    }
                }
            }
        },

        ALWAYS_COMMANDING {
            @Override
            void drive(int index, Random random) {
                var client = new PlayerClient(HOST, PORT);
                var pos = client.requestInterfacePosition2D(index, PLAYER_OPEN_MODE);
                client.runThreaded(-1, -1);
                double speed = 0;
                while (true) {
                    if (pos.isDataReady()) {
                        speed = 0.2 + 0.1 * pos.getX();
                    }
                    dawdle(random);
                    pos.setSpeed(speed, 0.1); // also without new data: such a command counts for the next tick
                }
            }
        };

        abstract void drive(int index, Random random);

        /** Spends an unpredictable amount of time. */
        static void dawdle(Random random) {
            for (int turns = random.nextInt(2_000); turns > 0; turns--) {
                Thread.onSpinWait();
            }
        }
    }

    private static Simulation openTwoRobots() {
        var world = TestWorlds.world(
                List.of(robot("one", 0, 0, 0), robot("two", 0, 3, 0)),
                wall("east", 4.1, 0, 0.2, 10, BLACK),
                wall("box", 3, 1.5, 0.5, 0.5, RED));
        return Simulation.open(TestWorlds.scenario(PORT, world), WorldSettings.defaults());
    }

    /** Two robots, each driven by a program on a separate thread. */
    private static List<Snapshot> run(Style style, long seed) throws InterruptedException {
        List<Program> programs =
                List.of(() -> style.drive(0, new Random(seed)), () -> style.drive(1, new Random(seed + 1)));
        return run(openTwoRobots(), new Pace.OfAnswers(), 2, 150, programs);
    }

    @ParameterizedTest
    @EnumSource
    void programs_ofTwoRobots_driveTheSameWayEveryTime_whateverTimeTheyTake(Style style) throws Exception {
        List<Snapshot> first = run(style, 1);
        assertThat(first).hasSize(150);
        assertThat(first.getLast().robots())
                .allSatisfy(robot -> assertThat(robot.pose().x()).as("it drove").isGreaterThan(0.5));
        for (long seed = 2; seed <= 4; seed++) {
            assertThat(run(style, seed)).as("times of seed %d", seed).isEqualTo(first);
        }
    }

    // ---- the runner

    @Test
    void runner_standsStill_untilAllHaveBegun() throws Exception {
        var ticks = new CountDownLatch(3);
        try (var simulation = openTwoRobots();
                var runner = SimulationRunner.start(simulation, 2, snapshot -> ticks.countDown())) {
            assertThat(runner.isRunning()).isTrue();
            var clients = new ArrayList<PlayerClient>();
            for (int index = 0; index < 2; index++) {
                var client = new PlayerClient(HOST, PORT);
                var pos = client.requestInterfacePosition2D(index, PLAYER_OPEN_MODE);
                assertThat(simulation.latest().tick()).isZero();
                client.runThreaded(-1, -1);
                clients.add(client);
                Thread.ofPlatform().daemon().start(() -> {
                    try {
                        while (true) {
                            pos.isDataReady();
                        }
                    } catch (PlayerException closed) {
                        // ends the program
                    }
                });
            }
            assertThat(ticks.await(30, TimeUnit.SECONDS)).isTrue();
            clients.forEach(PlayerClient::close);
        }
    }

    @Test
    void runner_endsByAnUnansweredTick_andTellsEverybody() throws Exception {
        try (var simulation = openTwoRobots()) {
            simulation.answerLimit(Duration.ofMillis(20));
            var runner = SimulationRunner.start(simulation, 1, snapshot -> {});
            var silent = new PlayerClient(HOST, PORT);
            var son = silent.requestInterfaceSonar(1, PLAYER_OPEN_MODE);
            silent.runThreaded(-1, -1);
            silent.join(); // its thread ends when the server closes
            assertThat(son.isDataReady()).as("the first frame was for it").isTrue();
            assertThatThrownBy(son::isDataReady)
                    .isInstanceOf(PlayerException.class)
                    .hasMessageContainingAll("tick 0 was not answered", "sonar:1");
            assertThatThrownBy(runner::close).isInstanceOf(UnansweredTickException.class);
            assertThat(runner.isRunning()).isFalse();
        }
    }
}
