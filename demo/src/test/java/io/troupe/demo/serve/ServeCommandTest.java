package io.troupe.demo.serve;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assumptions.assumeThat;

import io.troupe.demo.CommandLineBench;
import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerException;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.sim.Pace;
import io.troupe.sim.Replay;
import io.troupe.sim.SnapshotHash;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.tools.ProgressLine;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.io.Writer;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.TimeUnit;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.assertj.core.api.ThrowableAssert.ThrowingCallable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** {@code troupe serve} and {@code troupe replay}. */
@Tag("threads")
@Timeout(60)
class ServeCommandTest extends CommandLineBench {
    private final ExecutorService threads = Executors.newCachedThreadPool();

    @AfterEach
    void endThreads() throws InterruptedException {
        threads.shutdown();
        assertThat(threads.awaitTermination(1, TimeUnit.MINUTES))
                .as("all clients have ended")
                .isTrue();
    }

    private static Scenario scenario(String name) {
        return ScenarioReader.read(Path.of("worlds", name));
    }

    private static InetAddress address() throws IOException {
        return InetAddress.getByName("127.0.0.2");
    }

    private static Serving open(String world, boolean lockStep) throws IOException {
        return Serving.open(scenario(world), WorldSettings.defaults(), address(), 0, lockStep);
    }

    /** A client on TCP: for {@code localhost} it would find the world in the same process, without a socket. */
    private static PlayerClient client(Serving serving) {
        return new PlayerClient("127.0.0.2", serving.ports().getFirst());
    }

    private static PlayerClient pullingClient(Serving serving) {
        var robot = client(serving);
        robot.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
        return robot;
    }

    /** Runs the server until all its clients, each on a separate thread, have ended. */
    private void serve(Serving serving, Pace pace, Runnable... clients) throws InterruptedException {
        var ended = CompletableFuture.allOf(Stream.of(clients)
                .map(client -> CompletableFuture.runAsync(client, threads))
                .toArray(CompletableFuture<?>[]::new));
        var stopped = ended.whenComplete((done, failure) -> serving.stop());
        serving.run(pace, clients.length, Long.MAX_VALUE, ProgressLine.hidden());
        stopped.join();
    }

    @Test
    void push_client_drivesAndTheRecordingReplays() throws Exception {
        Path file = directory.resolve("session.txt");
        try (var serving = open("paper-arena.cfg", false)) {
            serving.record(file);
            serve(serving, new Pace.RealTime(50), () -> drive(serving));
        }

        try (var reader = Files.newBufferedReader(file)) {
            Replay replay = Replay.read(reader);
            replay.play(scenario("paper-arena.cfg").world(), new SnapshotHash()::update);
            assertThat(replay.ticks())
                    .as("ticks recorded while the client had 20 readings, the first of which may be older than the"
                            + " recording")
                    .isGreaterThanOrEqualTo(19);
        }
        assertThat(written("session.txt")).contains(" velocity 0 0.3 0.0");
        assertThat(printed("replay DIR/session.txt --world worlds/paper-arena.cfg --out DIR/o"))
                .contains("the same bit for bit", "robot1: ", " contacts", local("wrote DIR/o/trajectory.svg and"));
        assertThat(written("o/trajectory.svg")).contains("paper arena: 2 robots drive ");
        assertThat(written("o/run.jsonl")).contains("\"robot\":2,").contains("\"type\":\"summary\"");
        assertFails(1, "replay DIR/session.txt --world worlds/office.cfg", "made in another world");
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
    void fileThatIsNoRecording_isStatus2() throws IOException {
        Path file = file("session.txt", "troupe-recording 1\nworld x\nsettings y\n");
        String replay = "replay DIR/session.txt --world worlds/paper-arena.cfg";
        assertRefused(replay, "DIR/session.txt: line 3 of the recording: settings 'y'");

        Files.write(file, new byte[] {(byte) 0xFF, (byte) 0xFE});
        assertRefused(replay, "DIR/session.txt is not a recording: it is not text");
    }

    /** Returns the times of the last readings of clients that read so often. */
    private ConcurrentLinkedQueue<Double> timesOfPullingClients(String world, int clients, int readings)
            throws Exception {
        var seen = new ConcurrentLinkedQueue<Double>();
        try (var serving = open(world, true)) {
            var pulling = IntStream.range(0, clients).<Runnable>mapToObj(index -> () -> {
                var robot = pullingClient(serving);
                var wheels = robot.requestInterfacePosition2D(index, PlayerConstants.PLAYER_OPEN_MODE);
                for (int cycle = 0; cycle < readings; cycle++) {
                    robot.readAll();
                }
                seen.add(wheels.getTimestamp());
                robot.close();
            });
            serve(serving, new Pace.OfAnswers(), pulling.toArray(Runnable[]::new));
        }
        return seen;
    }

    @Test
    void lockStep_pullClientsAreWaitedFor_andTimeBeginsWhenAllHaveBegun() throws Exception {
        assertThat(timesOfPullingClients("track.cfg", 1, 100))
                .as("one frame per readAll, the first at time 0")
                .containsExactly(9.9);
        assertThat(timesOfPullingClients("paper-arena.cfg", 2, 1)).containsExactly(0.0, 0.0);
    }

    @Test
    void recordingThatCannotBeWritten_endsTheServer_andNamesTheFile() throws IOException {
        Path full = Path.of("/dev/full");
        assumeThat(full).exists();
        try (var serving = open("track.cfg", true)) {
            serving.record(full);
            Runnable driver = () -> {
                var robot = pullingClient(serving);
                var wheels = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
                try {
                    for (int cycle = 0; ; cycle++) {
                        robot.readAll();
                        wheels.setSpeed(0.01 * (cycle % 7), 0);
                    }
                } catch (PlayerException serverHasGone) {
                    // expected
                }
            };
            assertThatThrownBy(() -> serve(serving, new Pace.OfAnswers(), driver))
                    .isInstanceOf(UncheckedIOException.class)
                    .hasMessageContaining("/dev/full: ");
        }
    }

    @Test
    void wrongNumbers_areRefusedInOneLine() {
        assertRefused("serve --max-clients -1", "--max-clients is -1, expected a number of at least 0");
        assertRefused("serve --speed 0", "--speed is 0.0, expected a number above 0");
        assertRefused("serve --crowd 0", "--crowd is 0, expected a number from 1 to 20000");
        assertRefused("serve --clients 0", "--clients is 0, expected a number of at least 1");
        assertRefused("serve --port 70000", "--port is 70000, expected a number from 0 to 65535");
        assertRefused("serve --realtime --speed 2", "--realtime and --speed=N are given, expected one of them");
        assertThat(troupe("serve --bind", "no such host!")).isEqualTo(2);
        assertThat(err.toString()).contains("--bind is no such host!, expected an address of this machine");
    }

    @Test
    void portInUse_isSaid_andMoreThanTheMostClientsAreDisconnected() throws IOException {
        try (var taken = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            assertThat(troupe("serve --world worlds/track.cfg --port " + taken.getLocalPort()))
                    .isEqualTo(1);
            assertThat(err.toString()).contains("cannot listen on", "" + taken.getLocalPort());
        }

        try (var serving = Serving.open(scenario("track.cfg"), WorldSettings.defaults(), address(), 0, true, 1)) {
            var first = client(serving);
            assertThatThrownBy(() -> client(serving))
                    .isInstanceOf(PlayerException.class)
                    .hasMessageContaining("it closed the connection instead of greeting");
            first.requestDeviceList();
            first.close();
        }
    }

    private static final class FullDisk extends Writer {
        @Override
        public void write(char[] text, int offset, int length) throws IOException {
            throw new IOException("no space left");
        }

        @Override
        public void flush() throws IOException {
            write(new char[0], 0, 0);
        }

        @Override
        public void close() throws IOException {
            flush();
        }
    }

    @Test
    @SuppressWarnings("resource") // closing it fails
    void everyFailureOfARecording_namesTheFile() {
        var writer = new Serving.NamedWriter(Path.of("worlds", "run.jsonl"), new FullDisk());
        assertThat(Stream.<ThrowingCallable>of(
                        () -> writer.append("text"),
                        () -> writer.write("text".toCharArray()),
                        () -> writer.write('t'),
                        writer::flush,
                        writer::close))
                .allSatisfy(action -> assertThatThrownBy(action)
                        .isInstanceOf(IOException.class)
                        .hasMessage(Path.of("worlds", "run.jsonl") + ": no space left"));
    }
}
