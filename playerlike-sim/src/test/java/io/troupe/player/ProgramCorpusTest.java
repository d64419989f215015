package io.troupe.player;

import static org.assertj.core.api.Assertions.assertThat;

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
import io.troupe.player.wire.TcpServer;
import io.troupe.sim.Pace;
import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import io.troupe.sim.Snapshot;
import io.troupe.sim.Specs;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeNoise;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Scenario;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/**
 * Programs as students wrote them for javaclient3, with only the import prefix changed, against a world in this JVM and
 * over a socket.
 */
@Tag("threads")
@Timeout(120)
class ProgramCorpusTest {
    private static final int PORT = 6740;
    private static final String HOST = "localhost";

    interface Main {
        void run(String[] args) throws Exception;
    }

    /** A program: its run time, its number of clients, and how far its first robot drives in that time, in metres. */
    enum Program {
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

        Program(Main main, int ticks, int clients, boolean pulls, double atLeastM) {
            this.main = main;
            this.ticks = ticks;
            this.clients = clients;
            this.pulls = pulls;
            this.atLeastM = atLeastM;
        }
    }

    /** Both robots at the first port; the second robot at the second port too. */
    private static Scenario scenario() {
        List<RobotSpec> robots = List.of(
                Specs.robot("one", new Pose(0.5, 1.2, 0), Specs.ORANGE, Specs.pioneerFront(), Specs.camera(5))
                        .withRangers(List.of(laser(RangerSpec.Kind.LASER), laser(RangerSpec.Kind.RANGER))),
                Specs.robot("two", new Pose(-1, -2, 1), Specs.ORANGE, Specs.pioneerFront(), Specs.camera(5)));
        var devices = new ArrayList<DeviceBinding>();
        for (String type : List.of("position2d", "sonar", "blobfinder")) {
            devices.add(new DeviceBinding(PORT, type, 0, "one", 0, Specs.at(1)));
            devices.add(new DeviceBinding(PORT, type, 1, "two", 0, Specs.at(1)));
            devices.add(new DeviceBinding(PORT + 1, type, 0, "two", 0, Specs.at(1)));
        }
        devices.add(new DeviceBinding(PORT, "laser", 0, "one", 0, Specs.at(1)));
        devices.add(new DeviceBinding(PORT, "ranger", 0, "one", 1, Specs.at(1)));
        devices.add(new DeviceBinding(PORT, "simulation", 0, "", 0, Specs.at(1)));
        var obstacles = new ArrayList<>(Specs.arena(8));
        obstacles.add(Specs.box("red", new Pose(-3.5, 3.5, 0), 0.4, 0.4, Specs.RED));
        return new Scenario(Specs.world(robots, obstacles), devices);
    }

    /** 37 beams over half a circle, without noise. */
    private static RangerSpec laser(RangerSpec.Kind kind) {
        var beam = new RangeSensorSpec(Pose.ORIGIN, 0, 8, Math.PI, 37, 0.1, 0.1, RangeNoise.NONE);
        return new RangerSpec(kind, Pose.ORIGIN, 0.1, 0.1, List.of(beam));
    }

    private static List<Snapshot> inProcess(Program program) throws InterruptedException {
        try (var simulation = Simulation.open(scenario(), WorldSettings.DEFAULT.withLimits(1, 2))) {
            return run(simulation, program, program.ticks, new Pace.Unlimited(), HOST, "" + PORT, "" + (PORT + 1));
        }
    }

    private static List<Snapshot> overTcp(Program program) throws InterruptedException {
        try (var simulation = Simulation.open(scenario(), WorldSettings.DEFAULT.withLimits(1, 2));
                var first = TcpServer.open(PlayerPorts.find(PORT).orElseThrow(), 0);
                var second = TcpServer.open(PlayerPorts.find(PORT + 1).orElseThrow(), 0)) {
            Pace pace = program.pulls ? new Pace.OfAnswers() : new Pace.RealTime(10);
            int ticks = program.pulls ? program.ticks : 100;
            return run(simulation, program, ticks, pace, HOST, "" + first.port(), "" + second.port());
        }
    }

    private static List<Snapshot> run(Simulation simulation, Program program, int ticks, Pace pace, String... args)
            throws InterruptedException {
        var snapshots = new ArrayList<Snapshot>();
        var enough = new CountDownLatch(1);
        var failures = new ArrayList<Exception>();
        Thread thread;
        try (var runner = SimulationRunner.start(
                simulation,
                program.clients,
                snapshot -> {
                    if (snapshots.size() < ticks) {
                        snapshots.add(snapshot);
                    } else {
                        enough.countDown();
                    }
                },
                pace)) {
            assertThat(runner.isRunning()).isTrue();
            thread = Thread.ofPlatform().daemon().start(() -> {
                try {
                    program.main.run(args);
                } catch (PlayerException serverHasGone) {
                    // ends every endless program
                } catch (Exception e) {
                    failures.add(e);
                    enough.countDown();
                }
            });
            assertThat(enough.await(100, TimeUnit.SECONDS)).isTrue();
        }
        simulation.close();
        thread.join();
        assertThat(failures).isEmpty();
        return snapshots;
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
    private static void check(Program program, List<Snapshot> snapshots) {
        assertThat(snapshots).hasSize(program.ticks);
        assertThat(wayM(snapshots, 0)).as("way of robot one").isGreaterThan(program.atLeastM);
        if (program == Program.TWO_ROBOTS || program == Program.TWO_PORTS) {
            assertThat(wayM(snapshots, 1)).as("way of robot two").isGreaterThan(program.atLeastM);
        } else {
            assertThat(wayM(snapshots, 1)).as("way of robot two").isZero();
        }
        assertThat(snapshots)
                .as("nobody touched anything")
                .allSatisfy(snapshot -> assertThat(snapshot.contacts()).isEmpty());
        Pose end = snapshots.getLast().robots().getFirst().pose();
        switch (program) {
            case GOAL_DRIVER -> // odometry was reset at the start
                assertThat(Math.hypot(end.x() - 2, end.y() - 2.2)).isLessThan(0.3);
            case WALL_FOLLOWER ->
                assertThat(snapshots.getLast().robots().getFirst().wallGapM()).isBetween(0.05, 0.5);
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
    void program_inThisJvm_drives_theSameWayEveryTime(Program program) throws Exception {
        List<Snapshot> first = inProcess(program);
        check(program, first);
        assertSame(inProcess(program), first);
    }

    @ParameterizedTest
    @EnumSource
    void program_behindASocket_drives_andInPullModeTheSameWayAsInThisJvm(Program program) throws Exception {
        List<Snapshot> overTcp = overTcp(program);
        if (program.pulls) {
            check(program, overTcp);
            assertSame(overTcp, inProcess(program));
        } else {
            // The world does not wait for this client: how well it drives depends on the load of this machine.
            assertThat(wayM(overTcp, 0)).as("way of robot one").isGreaterThan(0.1);
        }
    }

    @org.junit.jupiter.api.Test
    void threads_ofClosedProgramsAndServers_areGone() throws Exception {
        overTcp(Program.PULL_READER);
        for (Thread each : Thread.getAllStackTraces().keySet()) {
            if (each.getName().startsWith("player-line-") || each.getName().startsWith("simulation-")) {
                each.join(Duration.ofMinutes(1)); // it has been asked to end, and ends once it gets a processor
                assertThat(each.isAlive()).as(each.getName()).isFalse();
            }
        }
    }
}
