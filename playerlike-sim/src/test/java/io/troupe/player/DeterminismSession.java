package io.troupe.player;

import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.PlayerPose2d;
import io.troupe.player.wire.TcpServer;
import io.troupe.sim.Arena;
import io.troupe.sim.Pace;
import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import io.troupe.sim.SnapshotHash;
import io.troupe.sim.Specs;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.CargoSpec;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.WorldSpec;
import java.net.InetAddress;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/**
 * A program in pull mode that drives four robots by their lasers, sonars and cameras. The robots carry objects through
 * a world with sensor noise.
 */
final class DeterminismSession {
    static final WorldSettings SETTINGS =
            WorldSettings.DEFAULT.withSeed(11).withJitter(0.02, 0.03).withLimits(1, 2);

    private static final int PORT = 6790;
    private static final int ROBOTS = 4;

    /** The outcome of a session. */
    record Result(String hash, int contacts, double wayM, String recording) {}

    private DeterminismSession() {}

    /** Every robot carries a red object in front; every second robot also carries one behind that bumps into walls. */
    static Scenario scenario() {
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

    static Result inProcess(int threads, int ticks) throws Exception {
        try (var simulation = Simulation.open(scenario(), SETTINGS.withSensingThreads(threads))) {
            return run(simulation, ticks, new Pace.Unlimited(), "localhost", PORT);
        }
    }

    /** 127.0.0.2 forces the client to use the socket. */
    static Result overTcp(int ticks) throws Exception {
        String host = "127.0.0.2";
        try (var simulation = Simulation.open(scenario(), SETTINGS);
                var server = TcpServer.open(PlayerPorts.find(PORT).orElseThrow(), 0, InetAddress.getByName(host))) {
            return run(simulation, ticks, new Pace.OfAnswers(), host, server.port());
        }
    }

    private static Result run(Simulation simulation, int ticks, Pace pace, String host, int port)
            throws InterruptedException {
        var recording = new StringBuilder();
        simulation.record(recording);
        var hash = new SnapshotHash();
        var failure = new AtomicReference<@Nullable Exception>();
        var enough = new CountDownLatch(1);
        var contacts = new int[1];
        var way = new double[1];
        Thread program;
        try (var runner = SimulationRunner.start(
                simulation,
                1,
                snapshot -> {
                    if (snapshot.tick() <= ticks) {
                        hash.update(snapshot);
                        contacts[0] += snapshot.contacts().size();
                        way[0] += snapshot.robots().stream()
                                .mapToDouble(robot -> robot.odometry().forwardMps() / 10)
                                .sum();
                    } else {
                        enough.countDown();
                    }
                },
                pace)) {
            program = Thread.ofPlatform().daemon().start(() -> {
                try {
                    drive(host, port);
                } catch (PlayerException serverHasGone) {
                    // ends an endless program
                } catch (Exception thrown) {
                    failure.set(thrown);
                    enough.countDown();
                }
            });
            if (!enough.await(100, TimeUnit.SECONDS)) {
                throw new IllegalStateException("fewer than " + ticks + " ticks, runner alive: " + runner.isRunning());
            }
        }
        simulation.close();
        program.join();
        Exception thrown = failure.get();
        if (thrown != null) {
            throw new IllegalStateException("the program failed", thrown);
        }
        return new Result(hash.toString(), contacts[0], way[0], recording.toString());
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
    private static final class Driver {
        private final int robot;
        private final Position2DInterface wheels;
        private final SonarInterface sonar;
        private final LaserInterface laser;
        private final BlobfinderInterface camera;

        Driver(PlayerClient client, int robot) {
            this.robot = robot;
            wheels = client.requestInterfacePosition2D(robot, PlayerConstants.PLAYER_OPEN_MODE);
            sonar = client.requestInterfaceSonar(robot, PlayerConstants.PLAYER_OPEN_MODE);
            laser = client.requestInterfaceLaser(robot, PlayerConstants.PLAYER_OPEN_MODE);
            camera = client.requestInterfaceBlobfinder(robot, PlayerConstants.PLAYER_OPEN_MODE);
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

    /** Main method of a separate JVM: prints the checksum after the given number of ticks. */
    public static void main(String[] args) throws Exception {
        System.out.println(inProcess(1, Integer.parseInt(args[0])).hash());
    }
}
