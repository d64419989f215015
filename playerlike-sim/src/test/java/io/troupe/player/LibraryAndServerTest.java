package io.troupe.player;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.wire.TcpServer;
import io.troupe.sim.Pace;
import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.SnapshotHash;
import io.troupe.sim.Specs;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.learn.Observation;
import io.troupe.sim.learn.Trial;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.RandomWorld;
import java.net.InetAddress;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * A world that is stepped as a library, beside the same world behind a server over TCP: one control law drives all
 * robots by their sonars, and each tick is the same, bit for bit.
 */
@Tag("threads")
@Timeout(120)
class LibraryAndServerTest {
    private static final WorldSettings SETTINGS = WorldSettings.defaults().withJitter(0.02, 0.03);
    private static final int PORT = 6799;
    private static final int ROBOTS = 5;
    private static final int TICKS = 400;

    private static WorldSpec office(long seed) {
        return RandomWorld.office(seed, 2, 2).withRobots(ROBOTS);
    }

    /** Speed and turn rate by the ranges in single precision, as Player sends them; different for each robot. */
    private static double[] law(int robot, float[] ranges) {
        double left = ranges[1] + ranges[2];
        double right = ranges[5] + ranges[6];
        boolean free = ranges[3] > 0.4 && ranges[4] > 0.4;
        return new double[] {free ? 0.5 : robot == 0 ? 0.2 : 0, (0.3 + 0.1 * robot) * (left - right) + 0.01};
    }

    @ParameterizedTest
    @ValueSource(longs = {1, 2, 3})
    void ticksOfTheServer_areThoseOfTheLibrary_bitForBit(long seed) throws Exception {
        List<Snapshot> served = served(seed);
        var trial = Trial.of(LibraryAndServerTest::office, SETTINGS);
        Observation seen = trial.reset(seed);
        int contacts = 0;
        for (int tick = 0; tick < TICKS; tick++) {
            seen = trial.step(actions(seen));
            Snapshot snapshot = trial.view().snapshot();
            assertThat(SnapshotHash.of(served.get(tick)))
                    .as("seed %d, tick %d", seed, tick + 1)
                    .isEqualTo(SnapshotHash.of(snapshot));
            contacts += snapshot.contacts().size();
        }
        assertThat(contacts).as("something must have been hit").isPositive();
    }

    private static double[] actions(Observation seen) {
        var actions = new double[2 * ROBOTS];
        for (int robot = 0; robot < ROBOTS; robot++) {
            var ranges = new float[seen.sonarCount(robot)];
            for (int sonar = 0; sonar < ranges.length; sonar++) {
                ranges[sonar] = (float) seen.rangeM(robot, sonar);
            }
            System.arraycopy(law(robot, ranges), 0, actions, 2 * robot, 2);
        }
        return actions;
    }

    /** 127.0.0.2 forces the client to use the socket. */
    private static List<Snapshot> served(long seed) throws Exception {
        WorldSpec world = office(seed);
        var devices = new ArrayList<DeviceBinding>();
        for (int i = 0; i < ROBOTS; i++) {
            for (String type : List.of("position2d", "sonar")) {
                devices.add(
                        new DeviceBinding(PORT, type, i, world.robots().get(i).name(), 0, Specs.at(1)));
            }
        }
        String host = "127.0.0.2";
        try (var simulation = Simulation.open(new Scenario(world, devices), SETTINGS.withSeed(seed));
                var server = TcpServer.open(PlayerPorts.find(PORT).orElseThrow(), 0, InetAddress.getByName(host))) {
            int port = server.port();
            return ProgramsTest.run(simulation, new Pace.OfAnswers(), 1, TICKS, List.of(() -> drive(host, port)));
        }
    }

    private static void drive(String host, int port) {
        var client = new PlayerClient(host, port);
        client.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
        var wheels = new ArrayList<Position2DInterface>();
        var sonars = new ArrayList<SonarInterface>();
        for (int i = 0; i < ROBOTS; i++) {
            wheels.add(client.requestInterfacePosition2D(i, PlayerConstants.PLAYER_OPEN_MODE));
            sonars.add(client.requestInterfaceSonar(i, PlayerConstants.PLAYER_OPEN_MODE));
        }
        while (true) {
            client.readAll();
            for (int i = 0; i < ROBOTS; i++) {
                double[] speeds = law(i, sonars.get(i).getData().getRanges());
                wheels.get(i).setSpeed(speeds[0], speeds[1]);
            }
        }
    }
}
