package io.troupe.sim;

import static io.troupe.sim.TestWorlds.robot;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.time.ManualClock;
import io.troupe.player.PlayerPorts;
import io.troupe.player.WireClient;
import io.troupe.player.wire.DataSink;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.Frame;
import io.troupe.player.wire.Interfaces;
import io.troupe.player.wire.PlayerConnection;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.Scenario;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.io.Writer;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.function.Consumer;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** How errors end a run, and that pauses do not. */
@Timeout(60)
class SimulationEndTest {
    private static final int PORT = 6793;

    private final Simulation simulation = Simulation.open(scenario(), WorldSettings.DEFAULT);

    private static Scenario scenario() {
        var plain = TestWorlds.scenario(PORT, TestWorlds.world(List.of(robot("one", 0, 0, 0), robot("two", 0, 3, 0))));
        var devices = new ArrayList<>(plain.devices());
        devices.add(new DeviceBinding(PORT, "simulation", 0, "", 0, TestWorlds.NOWHERE));
        return new Scenario(plain.world(), devices);
    }

    @AfterEach
    void close() {
        simulation.close();
    }

    /** A client that answers and stores the reason of its disconnection. */
    private static final class Answering implements DataSink {
        final CompletableFuture<String> lost = new CompletableFuture<>();
        private final PlayerConnection line;

        Answering() {
            line = PlayerPorts.find(PORT).orElseThrow().connect(this, null);
            line.subscribe(line.devices().stream()
                    .filter(device -> device.interfaceCode() == Interfaces.SONAR.code())
                    .findFirst()
                    .orElseThrow());
            line.answered(PlayerConnection.NO_TICK);
        }

        @Override
        public void frame(Frame frame) {
            line.answered(frame.tick());
        }

        @Override
        public void lost(String reason) {
            lost.complete(reason);
        }
    }

    private void runEndsBy(Consumer<Snapshot> observer, String reason) throws Exception {
        var client = new Answering();
        var runner = SimulationRunner.start(simulation, 1, observer);
        assertThat(client.lost.get()).isEqualTo("the simulation has ended: " + reason);
        assertThatThrownBy(() -> runner.ended().toCompletableFuture().get())
                .isInstanceOf(ExecutionException.class)
                .hasStackTraceContaining(reason);
        assertThatThrownBy(runner::close).hasMessage(reason);
    }

    @Test
    void errorOfTheObserver_endsTheRun_andItsClientsLearnWhy() throws Exception {
        runEndsBy(
                snapshot -> {
                    throw new NoClassDefFoundError("io/troupe/Unread");
                },
                "java.lang.NoClassDefFoundError: io/troupe/Unread");
    }

    @Test
    void exceptionOfTheObserver_endsTheRun_andItsClientsLearnWhy() throws Exception {
        runEndsBy(
                snapshot -> {
                    throw new IllegalArgumentException("not like that");
                },
                "not like that");
    }

    @Test
    void interruptOfTheRunner_whileItWaitsForClients_endsTheRun() {
        var client = new Answering();
        var runner = SimulationRunner.start(simulation, 1, snapshot -> {
            client.line.close();
            Thread.currentThread().interrupt();
        });
        assertThatThrownBy(() -> runner.ended().toCompletableFuture().get()).hasStackTraceContaining("was interrupted");
        assertThatThrownBy(runner::close).hasMessage("the thread that ticks the simulation was interrupted");
        assertThat(simulation.isClosed()).isTrue();
    }

    @Test
    void runThatIsStopped_endsWell() throws Exception {
        var client = new Answering();
        var ticked = new CompletableFuture<Snapshot>();
        SimulationRunner runner = SimulationRunner.start(simulation, 1, ticked::complete);
        ticked.get();
        runner.close();
        runner.ended().toCompletableFuture().get();
        assertThat(client.lost).isNotDone();
        assertThat(simulation.isClosed()).isFalse();
    }

    // ---- a recording that cannot be written

    /** A writer that always fails, and records whether it was closed. */
    private static final class FullDisk extends Writer {
        boolean closed;

        @Override
        public void write(char[] text, int offset, int length) throws IOException {
            if (new String(text, offset, length).contains(" end ")) {
                throw new IOException("/dev/full: No space left on device");
            }
        }

        @Override
        public void flush() {}

        @Override
        public void close() {
            closed = true;
        }
    }

    @Test
    void recordingThatCannotBeClosed_isSaid_andTheWorldIsClosedAllTheSame() {
        var disk = new FullDisk();
        simulation.record(disk);
        assertThatThrownBy(simulation::close)
                .isInstanceOf(UncheckedIOException.class)
                .hasMessage("the recording cannot be written at tick 0: /dev/full: No space left on device");
        assertThat(disk.closed).isTrue();
        assertThatThrownBy(() -> simulation.world().advance()).hasMessageContaining("is closed");
        simulation.close(); // throws only at the first close
    }

    @Test
    void errorThatEndsTheRun_isKept_thoughTheRecordingFailsToo() throws Exception {
        simulation.record(new FullDisk());
        runEndsBy(
                snapshot -> {
                    throw new IllegalArgumentException("not like that");
                },
                "not like that");
    }

    // ---- pauses

    @Test
    void pause_stopsTheAnswerLimit() {
        var wall = new ManualClock();
        simulation.wallClock(wall);
        simulation.answerLimit(Duration.ofSeconds(10));
        var client = new WireClient(PORT, (self, frame) -> {}).subscribe(Interfaces.SONAR, 0);
        wall.advance(Duration.ofSeconds(3));
        simulation.whileWaiting(
                () -> { // in the middle of a tick
                    simulation.pause();
                    wall.advance(Duration.ofHours(1));
                    simulation.resume();
                    wall.advance(Duration.ofSeconds(9));
                    simulation.whileWaiting(() -> client.line.answered(0));
                });
        assertThat(simulation.tick().tick()).isEqualTo(1);

        simulation.whileWaiting(() -> wall.advance(Duration.ofSeconds(1)));
        assertThatThrownBy(simulation::tick).isInstanceOf(UnansweredTickException.class);
        assertThat(simulation.latest().tick()).isEqualTo(1);
    }

    @Test
    void stepOfAPausedWorld_hasAnAnswerLimit_whichStopsAgainAfterIt() {
        var wall = new ManualClock();
        simulation.wallClock(wall);
        simulation.answerLimit(Duration.ofSeconds(10));
        var client = new WireClient(PORT, (self, frame) -> {}).subscribe(Interfaces.SONAR, 0);
        simulation.pause();
        wall.advance(Duration.ofHours(1));
        simulation.step();
        simulation.whileWaiting(() -> wall.advance(Duration.ofSeconds(1)));
        assertThatThrownBy(simulation::tick).isInstanceOf(UnansweredTickException.class);
        assertThat(simulation.isPaused()).isTrue();

        simulation.step();
        simulation.whileWaiting(
                () -> { // paused again in the middle of the stepped tick
                    wall.advance(Duration.ofSeconds(4));
                    simulation.resume();
                    simulation.pause();
                    wall.advance(Duration.ofHours(1));
                    simulation.resume();
                    wall.advance(Duration.ofSeconds(5));
                    simulation.whileWaiting(() -> client.line.answered(0));
                });
        assertThat(simulation.tick().tick()).isEqualTo(1);
    }

    @Test
    void pause_endsWithTheClientThatAskedForIt_andNotWithAnother() {
        var client = new WireClient(PORT, WireClient.ANSWER).subscribe(Interfaces.SONAR, 0);
        var pausing = new WireClient(PORT, WireClient.ANSWER);
        pausing.tell(Interfaces.SIMULATION, 0, new DeviceCommand.Pause());
        client.line.close();
        assertThat(simulation.isPaused()).isTrue();
        pausing.line.close();
        assertThat(simulation.isPaused()).isFalse();

        var other = new WireClient(PORT, WireClient.ANSWER);
        simulation.pause(); // not requested by a client
        other.line.close();
        assertThat(simulation.isPaused()).isTrue();
        simulation.resume();
    }

    // ---- two clients, one robot

    @Test
    void commandsOfTwoClientsToOneRobot_thatOfTheClientThatConnectedLaterCounts() {
        var first = new WireClient(PORT, WireClient.ANSWER).subscribe(Interfaces.POSITION2D, 0);
        var second = new WireClient(PORT, WireClient.ANSWER).subscribe(Interfaces.POSITION2D, 0);
        first.line.answered(PlayerConnection.NO_TICK);
        second.line.answered(PlayerConnection.NO_TICK);
        second.tell(Interfaces.POSITION2D, 0, new DeviceCommand.Car(0.2, 0));
        first.tell(Interfaces.POSITION2D, 0, new DeviceCommand.Car(0.1, 0));
        assertThat(simulation.tick().robots().getFirst().odometry().forwardMps())
                .isEqualTo(0.2);
    }
}
