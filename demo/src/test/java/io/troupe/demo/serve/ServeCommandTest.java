package io.troupe.demo.serve;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assumptions.assumeThat;

import io.troupe.common.measure.ProgressLine;
import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerException;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.sim.Pace;
import io.troupe.sim.Replay;
import io.troupe.sim.SnapshotHash;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.worldfile.ScenarioReader;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.io.UncheckedIOException;
import java.net.InetAddress;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine;

@Tag("threads")
@Timeout(60)
class ServeCommandTest {
    private static final Path WORLDS = Path.of("worlds");

    @TempDir
    private Path directory;

    private final StringWriter out = new StringWriter();

    private int serve(String... arguments) {
        return execute(new ServeCommand(), arguments);
    }

    private int execute(Object command, String... arguments) {
        return new CommandLine(command)
                .setOut(new PrintWriter(out))
                .setErr(new PrintWriter(out))
                .setExecutionExceptionHandler((thrown, line, parsed) -> {
                    out.write(thrown.getMessage());
                    return 1;
                })
                .execute(arguments);
    }

    /** A client on TCP: for {@code localhost} it would find the world in the same process, without a socket. */
    private static PlayerClient client(Serving serving) {
        return new PlayerClient("127.0.0.2", serving.ports().getFirst());
    }

    @Test
    void push_client_drivesAndTheRecordingReplays() throws Exception {
        Scenario scenario = ScenarioReader.read(WORLDS.resolve("paper-arena.cfg"));
        Path file = directory.resolve("session.txt");
        var failure = new AtomicReference<@Nullable Throwable>();
        try (var serving =
                Serving.open(scenario, WorldSettings.DEFAULT, InetAddress.getByName("127.0.0.2"), 0, false)) {
            serving.record(file);
            Thread driver = Thread.ofPlatform().start(() -> {
                try {
                    drive(serving);
                } catch (Throwable thrown) {
                    failure.set(thrown);
                } finally {
                    serving.stop();
                }
            });
            serving.run(new Pace.RealTime(50), 1, Long.MAX_VALUE, ProgressLine.hidden());
            driver.join();
        }
        assertThat(failure.get()).isNull();

        try (var reader = Files.newBufferedReader(file)) {
            Replay replay = Replay.read(reader);
            var hash = new SnapshotHash();
            replay.play(scenario.world(), hash::update);
            assertThat(replay.ticks())
                    .as(
                            "ticks recorded while the client had 20 readings, the first of which may be older than the recording")
                    .isGreaterThanOrEqualTo(19);
        }
        assertThat(Files.readString(file)).contains(" velocity 0 0.3 0.0");

        assertThat(replay(
                        file.toString(),
                        "--world",
                        WORLDS.resolve("paper-arena.cfg").toString()))
                .isZero();
        assertThat(out.toString()).contains("the same bit for bit", "robot1: ", " contacts");
        assertThat(replay(
                        file.toString(), "--world", WORLDS.resolve("office.cfg").toString()))
                .isEqualTo(1);
        assertThat(out.toString()).contains("made in another world");
    }

    @Test
    void fileThatIsNoRecording_isStatus2() throws Exception {
        Path file = directory.resolve("session.txt");
        String world = WORLDS.resolve("paper-arena.cfg").toString();
        Files.writeString(file, "troupe-recording 1\nworld x\nsettings y\n");
        assertThat(replay(file.toString(), "--world", world)).isEqualTo(2);
        assertThat(out.toString()).contains(file + ": line 3 of the recording: settings 'y'");

        Files.write(file, new byte[] {(byte) 0xFF, (byte) 0xFE});
        assertThat(replay(file.toString(), "--world", world)).isEqualTo(2);
        assertThat(out.toString()).contains(file + " is not a recording: it is not text");
    }

    private int replay(String... arguments) {
        return execute(new ReplayCommand(), arguments);
    }

    private static void drive(Serving serving) {
        var robot = client(serving);
        var wheels = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
        robot.runThreaded(-1, -1);
        for (int cycle = 0; cycle < 20; cycle++) {
            while (!wheels.isDataReady())
                ;
            wheels.setSpeed(0.3, 0);
        }
        assertThat(wheels.getX()).isPositive();
        robot.close();
    }

    @Test
    void lockStep_pullClientsAreWaitedFor_andTimeEndsTheServer() throws Exception {
        Scenario scenario = ScenarioReader.read(WORLDS.resolve("track.cfg"));
        var seen = new AtomicReference<Double>();
        try (var serving = Serving.open(scenario, WorldSettings.DEFAULT, InetAddress.getByName("127.0.0.2"), 0, true)) {
            Thread driver = Thread.ofPlatform().start(() -> {
                var robot = client(serving);
                robot.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
                var wheels = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
                for (int cycle = 0; cycle < 100; cycle++) {
                    robot.readAll();
                }
                seen.set(wheels.getTimestamp());
                robot.close();
                serving.stop();
            });
            serving.run(new Pace.OfAnswers(), 1, Long.MAX_VALUE, ProgressLine.hidden());
            driver.join();
        }
        assertThat(seen.get()).isEqualTo(9.9); // one frame per readAll, the first at time 0
    }

    @Test
    void clients_timeBeginsWhenAllHaveBegun() throws Exception {
        Scenario scenario = ScenarioReader.read(WORLDS.resolve("paper-arena.cfg"));
        var seen = new ConcurrentLinkedQueue<Double>();
        try (var serving = Serving.open(scenario, WorldSettings.DEFAULT, InetAddress.getByName("127.0.0.2"), 0, true)) {
            var reading = new AtomicInteger(2);
            for (int robot = 0; robot < 2; robot++) {
                int index = robot;
                Thread.ofPlatform().start(() -> {
                    try {
                        readOnce(serving, index, seen);
                    } finally {
                        if (reading.decrementAndGet() == 0) {
                            serving.stop();
                        }
                    }
                });
            }
            serving.run(new Pace.OfAnswers(), 2, Long.MAX_VALUE, ProgressLine.hidden());
        }
        assertThat(seen).containsExactly(0.0, 0.0);
    }

    private static void readOnce(Serving serving, int robotIndex, Queue<Double> seenSeconds) {
        var robot = client(serving);
        robot.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
        var wheels = robot.requestInterfacePosition2D(robotIndex, PlayerConstants.PLAYER_OPEN_MODE);
        robot.readAll();
        seenSeconds.add(wheels.getTimestamp());
        robot.close();
    }

    @Test
    void recordingThatCannotBeWritten_endsTheServer_andNamesTheFile() throws Exception {
        Path full = Path.of("/dev/full");
        assumeThat(full).exists();
        Scenario scenario = ScenarioReader.read(WORLDS.resolve("track.cfg"));
        var serving = Serving.open(scenario, WorldSettings.DEFAULT, InetAddress.getByName("127.0.0.2"), 0, true);
        serving.record(full);
        Thread driver = Thread.ofPlatform().daemon().start(() -> {
            var robot = client(serving);
            robot.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
            var wheels = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
            try {
                for (int cycle = 0; ; cycle++) {
                    robot.readAll();
                    wheels.setSpeed(0.01 * (cycle % 7), 0);
                }
            } catch (PlayerException serverHasGone) {
                // expected
            }
        });
        try (serving) {
            assertThatThrownBy(() -> serving.run(new Pace.OfAnswers(), 1, Long.MAX_VALUE, ProgressLine.hidden()))
                    .isInstanceOf(UncheckedIOException.class)
                    .hasMessageContaining("/dev/full: ");
        }
        driver.join();
    }

    @Test
    void maxClients_moreAreDisconnected() throws Exception {
        Scenario scenario = ScenarioReader.read(WORLDS.resolve("track.cfg"));
        try (var serving =
                Serving.open(scenario, WorldSettings.DEFAULT, InetAddress.getByName("127.0.0.2"), 0, true, 1)) {
            var first = client(serving);
            assertThatThrownBy(() -> client(serving))
                    .isInstanceOf(PlayerException.class)
                    .hasMessageContaining("it closed the connection instead of greeting");
            first.requestDeviceList();
            first.close();
        }
    }

    @Test
    void wrongNumbers_areRefusedInOneLine() {
        assertThat(serve("--max-clients", "-1")).isEqualTo(2);
        assertThat(out.toString()).contains("--max-clients is -1, expected a number of at least 0");
        assertThat(serve("--speed", "0")).isEqualTo(2);
        assertThat(out.toString()).contains("--speed is 0.0, expected a number above 0");
        assertThat(serve("--crowd", "0")).isEqualTo(2);
        assertThat(out.toString()).contains("--crowd is 0, expected a number from 1 to 20000");
        assertThat(serve("--clients", "0")).isEqualTo(2);
        assertThat(out.toString()).contains("--clients is 0, expected a number of at least 1");
        assertThat(serve("--port", "70000")).isEqualTo(2);
        assertThat(out.toString()).contains("--port is 70000, expected a number from 0 to 65535");
        assertThat(serve("--bind", "no such host!")).isEqualTo(2);
        assertThat(out.toString()).contains("--bind is no such host!, expected an address of this machine");
        assertThat(serve("--realtime", "--speed", "2")).isEqualTo(2);
    }

    @Test
    void portInUse_isSaid() throws Exception {
        try (var taken = new java.net.ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            assertThat(serve("--world", WORLDS.resolve("track.cfg").toString(), "--port", "" + taken.getLocalPort()))
                    .isEqualTo(1);
            assertThat(out.toString()).contains("cannot listen on", "" + taken.getLocalPort());
        }
    }
}
