package io.troupe.player;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.PlayerPose2d;
import io.troupe.player.wire.TcpServer;
import io.troupe.sim.Arena;
import io.troupe.sim.Pace;
import io.troupe.sim.Replay;
import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.SnapshotHash;
import io.troupe.sim.Specs;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.CargoSpec;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.WorldSpec;
import java.io.StringReader;
import java.net.InetAddress;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestInstance;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * Runs one session in every supported way: all must give the same snapshots, bit for bit. In it a program in pull mode
 * drives four robots by their lasers, sonars and cameras. The robots carry objects through a world with sensor noise.
 */
@Tag("threads")
@Timeout(120)
@TestInstance(TestInstance.Lifecycle.PER_CLASS)
class DeterminismTableTest {
    private static final WorldSettings SETTINGS =
            WorldSettings.defaults().withSeed(11).withJitter(0.02, 0.03).withLimits(1, 2);
    private static final int PORT = 6790;
    private static final int ROBOTS = 4;
    private static final int TICKS = 300;
    private static final int INTERPRETED_TICKS = 60;

    private record Session(List<Snapshot> snapshots, String recording) {
        String hash() {
            var hash = new SnapshotHash();
            snapshots.forEach(hash::update);
            return hash.toString();
        }
    }

    private Session first = new Session(List.of(), "");

    @BeforeAll
    void play() throws Exception {
        first = inProcess(1, TICKS);
        assertThat(first.snapshots)
                .flatExtracting(Snapshot::contacts)
                .as("something must have been hit")
                .isNotEmpty();
        double wayM = first.snapshots.stream()
                .flatMap(snapshot -> snapshot.robots().stream())
                .mapToDouble(robot -> robot.odometry().forwardMps() / 10)
                .sum();
        assertThat(wayM).as("everybody's way").isGreaterThan(10);
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 2, 4})
    void sensingThreads_giveTheSameSnapshots(int threads) throws Exception {
        assertThat(inProcess(threads, TICKS).hash()).isEqualTo(first.hash());
    }

    /** 127.0.0.2 forces the client to use the socket. */
    @Test
    void tcpInPullMode_givesTheSameSnapshots() throws Exception {
        String host = "127.0.0.2";
        try (var simulation = Simulation.open(scenario(), SETTINGS);
                var server = TcpServer.open(PlayerPorts.find(PORT).orElseThrow(), 0, InetAddress.getByName(host))) {
            var overTcp = run(simulation, TICKS, new Pace.OfAnswers(), host, server.port());
            assertThat(overTcp.hash()).isEqualTo(first.hash());
        }
    }

    @Test
    void recording_givesTheSameSnapshots() throws Exception {
        var snapshots = new ArrayList<Snapshot>();
        Replay.read(new StringReader(first.recording)).play(scenario().world(), snapshots::add);
        assertThat(new Session(snapshots.subList(1, TICKS + 1), "").hash()).isEqualTo(first.hash());
    }

    @Test
    void interpretedJvm_givesTheSameSnapshots() throws Exception {
        String java = Path.of(System.getProperty("java.home"), "bin", "java").toString();
        String classPath = System.getProperty("java.class.path");
        Process process = new ProcessBuilder(java, "-Xint", "-cp", classPath, DeterminismTableTest.class.getName())
                .redirectErrorStream(true)
                .start();
        String said = new String(process.getInputStream().readAllBytes(), StandardCharsets.UTF_8);
        assertThat(process.waitFor(100, TimeUnit.SECONDS)).isTrue();
        assertThat(said.strip()).isEqualTo(inProcess(1, INTERPRETED_TICKS).hash());
    }

    /** Main method of a separate JVM: prints the checksum. */
    public static void main(String[] args) throws Exception {
        System.out.println(inProcess(1, INTERPRETED_TICKS).hash());
    }

    // ---- the session

    /** Every robot carries a red object in front; every second robot also carries one behind that bumps into walls. */
    private static Scenario scenario() {
        WorldSpec arena = Arena.spec(ROBOTS);
        var robots = new ArrayList<RobotSpec>();
        var devices = new ArrayList<DeviceBinding>();
        for (int i = 0; i < ROBOTS; i++) {
            var flag = new CargoSpec(Specs.box(0.1, 0.1, 0.2), Specs.RED, false, false, true);
            var trailer = new CargoSpec(Specs.box(0.2, 0.3, -0.4), Specs.BLUE, i % 2 == 0, true, true);
            RobotSpec robot = arena.robots().get(i);
            robots.add(Specs.carrying(robot, true, List.of(flag, trailer)));
            for (String type : List.of("position2d", "sonar", "blobfinder", "laser")) {
                devices.add(new DeviceBinding(PORT, type, i, robot.name(), 0, Specs.at(1)));
            }
        }
        return new Scenario(Specs.world(robots, arena.obstacles()), devices);
    }

    private static Session inProcess(int threads, int ticks) throws Exception {
        var simulation = Simulation.open(scenario(), SETTINGS.withSensingThreads(threads));
        return run(simulation, ticks, new Pace.Unlimited(), "localhost", PORT);
    }

    private static Session run(Simulation simulation, int ticks, Pace pace, String host, int port) throws Exception {
        var recording = new StringBuilder();
        simulation.record(recording);
        var snapshots = ProgramsTest.run(simulation, pace, 1, ticks, List.of(() -> drive(host, port)));
        return new Session(snapshots, recording.toString());
    }

    private static void drive(String host, int port) {
        var client = new PlayerClient(host, port);
        client.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
        var robots = new ArrayList<Driver>();
        for (int i = 0; i < ROBOTS; i++) {
            robots.add(new Driver(client, i));
        }
        for (int cycle = 0; true; cycle++) {
            client.readAll();
            for (Driver robot : robots) {
                robot.steer(cycle);
            }
        }
    }

    /** Drives each robot differently, so that every reading affects the path of a robot. */
    private static final class Driver implements PlayerConstants {
        private final int robot;
        private final Position2DInterface wheels;
        private final SonarInterface sonar;
        private final LaserInterface laser;
        private final BlobfinderInterface camera;

        Driver(PlayerClient client, int robot) {
            this.robot = robot;
            wheels = client.requestInterfacePosition2D(robot, PLAYER_OPEN_MODE);
            sonar = client.requestInterfaceSonar(robot, PLAYER_OPEN_MODE);
            laser = client.requestInterfaceLaser(robot, PLAYER_OPEN_MODE);
            camera = client.requestInterfaceBlobfinder(robot, PLAYER_OPEN_MODE);
        }

        void steer(int cycle) {
            switch (robot) {
                case 0 -> byLaser();
                case 1 -> bySonar();
                case 2 -> byCamera();
                default -> byOdometry(cycle);
            }
        }

        private void byLaser() {
            float[] scan = laser.getData().getRanges();
            int half = scan.length / 2;
            double right = 0;
            double left = 0;
            for (int i = 0; i < half; i++) {
                right += scan[i];
                left += scan[scan.length - 1 - i];
            }
            wheels.setSpeed(Math.min(0.5, scan[half] / 3), (left - right) / (left + right));
        }

        private void bySonar() {
            float[] ranges = sonar.getData().getRanges();
            double left = ranges[1] + ranges[2];
            double right = ranges[5] + ranges[6];
            wheels.setSpeed(ranges[3] > 0.6 && ranges[4] > 0.6 ? 0.4 : 0, 0.4 * (left - right));
        }

        /** Drives towards what the camera sees, without avoiding it. */
        private void byCamera() {
            var image = camera.getData();
            int count = image.getBlobs_count();
            double turn = count == 0 ? 0.3 : 0.02 * (image.getWidth() / 2 - image.getBlobs()[count / 2].getX());
            wheels.setSpeed(0.3, turn);
        }

        private void byOdometry(int cycle) {
            if (cycle % 50 == 0) {
                var goal = new PlayerPose2d(wheels.getX() + 1, wheels.getY() - 1, 0.5);
                wheels.setPosition(goal, new PlayerPose2d(0.3, 0, 0.4), 1);
            }
        }
    }
}
