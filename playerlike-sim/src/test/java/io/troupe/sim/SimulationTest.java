package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ManualClock;
import io.troupe.player.PlayerPorts;
import io.troupe.player.WireClient;
import io.troupe.player.wire.DataSink;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.Frame;
import io.troupe.player.wire.Interfaces;
import io.troupe.player.wire.PlayerConnection;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.Scenario;
import java.io.FilterWriter;
import java.io.IOException;
import java.io.StringReader;
import java.io.UncheckedIOException;
import java.io.Writer;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.function.Consumer;
import org.assertj.core.api.AbstractThrowableAssert;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** The pace of a simulation, clients that do not answer, pauses, and how errors end a run. */
@Timeout(60)
class SimulationTest {
    private static final int PORT = 6795;
    private static final double NEVER = Double.POSITIVE_INFINITY;

    private final Simulation simulation = Simulation.open(scenario(), Arena.seed(2));
    private final ManualClock wall = new ManualClock(); // moves only during sleeps and work
    private final List<Long> sleptMillis = new ArrayList<>();
    private final RealTimePacer pacer = new RealTimePacer(wall, nanos -> {
        sleptMillis.add(nanos / 1_000_000);
        wall.advance(Duration.ofNanos(nanos));
    });
    private long micros;

    private static Scenario scenario() {
        var world = Arena.spec(3);
        var devices = new ArrayList<>(TestWorlds.scenario(PORT, world).devices());
        for (int i = 0; i < 3; i++) {
            devices.add(new DeviceBinding(PORT, "laser", i, "r" + i, 0, TestWorlds.NOWHERE));
        }
        devices.add(new DeviceBinding(PORT, "simulation", 0, "", 0, TestWorlds.NOWHERE));
        return new Scenario(world, devices);
    }

    @AfterEach
    void close() {
        simulation.close();
    }

    /** Each interval has a pace, as a multiple of real time, and milliseconds of work. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            real time sleeps for what the work has left over | 1+0 1+30 1+99 | 100 70 1 | 0
            a factor divides the interval | 4+0 4+5 0.5+0 | 25 20 200 | 0
            after 0.2 s of delay the fourth deadline is where it was | 1+0 1+300 1+0 1+0 | 100 | 0
            a small delay is caught up | 1+0 1+300 1+0 1+0 1+0 | 100 100 | 0
            a delay of 2 s is dropped, except for a quarter of a second | 1+0 1+2100 | 100 | 1750000
            that quarter is not caught up after two intervals | 1+0 1+2100 1+0 1+0 | 100 | 1750000
            the 250 ms are caught up after three, of 300 ms | 1+0 1+2100 1+0 1+0 1+0 | 100 50 | 1750000
            of delays one after another a quarter of a second is left each time | 1+0 1+2100 1+500 1+2000 | 100 | 4050000
            one second on the wall clock at a double pace is two simulated ones | 2+0 2+1050 | 50 | 1750000
            no limit never sleeps and owes nothing afterwards | 1+0 Infinity+0 Infinity+5000 1+0 | 100 100 | 0
            """)
    void pacer_sleepsUntilTheEndOfTheInterval(String name, String intervals, String slept, long droppedMicros) {
        long workMillis = 0;
        for (String interval : intervals.split(" ")) {
            String[] parts = interval.split("\\+");
            workMillis += Integer.parseInt(parts[1]);
            tick(Double.parseDouble(parts[0]), Integer.parseInt(parts[1]));
        }
        assertThat(sleptMillis).map(String::valueOf).containsExactly(slept.split(" "));
        assertThat(pacer.droppedMicros()).isEqualTo(droppedMicros);
        long millis =
                workMillis + sleptMillis.stream().mapToLong(Long::longValue).sum();
        assertThat(wall.nanos()).isEqualTo(millis * 1_000_000);
    }

    private void tick(double factor, int workMillis) {
        wall.advance(Duration.ofMillis(workMillis));
        pacer.await(micros, micros + 100_000, factor);
        micros += 100_000;
    }

    @Test
    void restart_forgetsThatTimeStoodStill() {
        tick(1, 0);
        pacer.restart();
        tick(1, 60_000);
        assertThat(sleptMillis).containsExactly(100L, 100L);
        assertThat(pacer.droppedMicros()).isZero();
    }

    @Test
    void pace_knowsWhoWaitsForWhom_andNextToNothingIsNeverLate() {
        assertThat(new Pace.OfAnswers().factor(false)).isEqualTo(NEVER);
        assertThat(new Pace.OfAnswers().factor(true)).isEqualTo(1);
        assertThat(new Pace.RealTime(3).factor(false)).isEqualTo(3);
        assertThat(new Pace.Unlimited().factor(true)).isEqualTo(NEVER);
        assertThatThrownBy(() -> new Pace.RealTime(0)).hasMessage("pace is 0.0 times real time, expected more than 0");
        var left = new ArrayList<Long>();
        var slow = new RealTimePacer(wall, nanos -> {
            left.add(nanos);
            wall.advance(Duration.ofNanos(nanos));
        });
        slow.await(0, 100_000, 1e-15);
        assertThat(left).as("nanoseconds").containsExactly(1L << 61);
        slow.await(100_000, 200_000, Double.MIN_VALUE);
        assertThat(left).as("nanoseconds").hasSize(2);
        assertThat(slow.droppedMicros()).isZero();
    }

    // ---- clients that do not answer

    private static WireClient silent() {
        return new WireClient(PORT, (self, frame) -> {}).subscribe(Interfaces.SONAR, 1);
    }

    private static WireClient push() {
        var client = new WireClient(PORT, (self, frame) -> {}).subscribe(Interfaces.LASER, 0);
        client.line.answers(false);
        return client;
    }

    private static WireClient answering(Interfaces type, int index) {
        return new WireClient(PORT, WireClient.ANSWER).subscribe(type, index);
    }

    private void tick(Pace pace) {
        simulation.tick(pacer, pace);
    }

    private AbstractThrowableAssert<?, ? extends Throwable> assertUnanswered() {
        return assertThatThrownBy(simulation::tick).isInstanceOf(UnansweredTickException.class);
    }

    @Test
    @Timeout(120)
    void pace_isThatOfRealTime_whileAClientNeverAnswers() {
        answering(Interfaces.SONAR, 1);
        tick(new Pace.OfAnswers());
        assertThat(sleptMillis).isEmpty();
        WireClient push = push();
        tick(new Pace.OfAnswers());
        wall.advance(Duration.ofMillis(40));
        tick(new Pace.OfAnswers());
        assertThat(sleptMillis).containsExactly(100L, 60L);
        push.line.close();
        tick(new Pace.OfAnswers());
        assertThat(sleptMillis).as("back to lock step").hasSize(2);
        tick(new Pace.RealTime(2));
        assertThat(sleptMillis).as("lock step, but not too fast").containsExactly(100L, 60L, 50L);
        push();
        tick(new Pace.Unlimited());
        assertThat(sleptMillis).hasSize(3);
    }

    @Test
    @Timeout(120)
    void pushClientsCommand_countsInTheTickInWhichItComes() {
        WireClient push = new WireClient(
                        PORT, (self, frame) -> self.tell(Interfaces.POSITION2D, 0, new DeviceCommand.Car(0.3, 0)))
                .subscribe(Interfaces.POSITION2D, 0);
        push.line.answered(-1);
        push.line.answers(false);
        assertThat(Specs.first(simulation.tick()).odometry().forwardMps()).isEqualTo(0.3);
    }

    @Test
    @Timeout(120)
    void pushClient_isNotWaitedFor_unlessItAnswersAgain_butOthersAre() {
        WireClient client = push();
        simulation.tick();
        client.line.answers(true);
        client.line.answered(0);
        simulation.answerLimit(Duration.ofMillis(1));
        assertUnanswered();
        client.line.answers(false);
        simulation.tick();
        simulation.tick();
        assertThat(client.frames).hasSize(4);
        silent(); // but not for ever
        assertUnanswered().hasMessageContaining("sonar:1").hasMessageNotContaining("laser:0");
    }

    @Test
    @Timeout(120)
    void silentClient_isDisconnectedIfThatIsWanted_andTheOthersGoOn() {
        WireClient silent = silent();
        WireClient good = answering(Interfaces.SONAR, 0);
        simulation.answerLimit(Duration.ofMillis(1));
        simulation.disconnectSilentClients(true);
        for (int i = 0; i < 5; i++) {
            simulation.tick();
        }
        assertThat(good.frames).hasSize(5);
        assertThat(silent.frames).hasSize(1);
        assertThatThrownBy(() -> silent.line.devices()).hasMessageContaining("tick 0 was not answered within PT0.001S");
    }

    @Test
    @Timeout(120)
    void worldOutOfLockStep_waitsForNobody_andKeepsPace() {
        WireClient silent = silent();
        simulation.lockStep(false);
        tick(new Pace.OfAnswers());
        tick(new Pace.OfAnswers());
        assertThat(silent.frames).hasSize(2);
        assertThat(sleptMillis).containsExactly(100L, 100L);
    }

    @Test
    @Timeout(120)
    void timeThatStoodStill_isNotLate() {
        push();
        tick(new Pace.OfAnswers());
        simulation.pause();
        wall.advance(Duration.ofSeconds(20));
        simulation.step();
        tick(new Pace.OfAnswers());
        assertThat(sleptMillis).containsExactly(100L, 100L);
        assertThat(pacer.droppedMicros()).isZero();
    }

    /** The runner's ticks and the client's commands interleave randomly; the recording must contain the right ticks. */
    @Test
    @Timeout(120)
    void recordedSession_ofAPushClient_replaysBitForBit() throws Exception {
        var out = new StringBuilder();
        var hash = new SnapshotHash();
        hash.update(simulation.latest());
        Recording recording = simulation.record(out);
        var enough = new CountDownLatch(150);
        var said = new CountDownLatch(600);
        var stop = new AtomicBoolean();
        WireClient push = push();
        for (int i = 0; i < 3; i++) {
            push.subscribe(Interfaces.POSITION2D, i);
        }
        Consumer<Snapshot> observer = snapshot -> {
            hash.update(snapshot);
            enough.countDown();
        };
        var talker = Thread.ofPlatform().start(() -> talk(push, stop, said));
        try (var runner = SimulationRunner.start(simulation, 1, observer, new Pace.Unlimited())) {
            assertThat(enough.await(60, TimeUnit.SECONDS)).isTrue();
            assertThat(said.await(60, TimeUnit.SECONDS)).isTrue();
            assertThat(runner.isRunning()).isTrue();
        } finally {
            stop.set(true);
            talker.join();
        }
        recording.close();
        Replay replay = Replay.read(new StringReader(out.toString()));
        var replayed = new SnapshotHash();
        replay.play(Arena.spec(3), replayed::update);
        assertThat(out).contains(" velocity ", " goto ", " teleport ");
        assertThat(replay.ticks()).isEqualTo(simulation.latest().tick());
        assertThat(replayed.toString()).isEqualTo(hash.toString());
    }

    /** A robot for goals alone: other speeds for it would replace them before the next tick. */
    private static void talk(WireClient push, AtomicBoolean stop, CountDownLatch said) {
        var random = new SplittableRandom(3);
        while (!stop.get()) {
            int robot = random.nextInt(3);
            switch (random.nextInt(20)) {
                case 0 -> {
                    var goal = new DeviceCommand.GoTo(random.nextDouble(2), random.nextDouble(2), 0, 0, 0, 0, true);
                    push.tell(Interfaces.POSITION2D, 2, goal);
                }
                case 1 -> push.ask(Interfaces.POSITION2D, robot, new DeviceRequest.SetOdometry(1, 2, 3));
                case 2 -> {
                    double x = random.nextDouble(-3, 3);
                    double y = random.nextDouble(-3, 3);
                    push.ask(Interfaces.SIMULATION, 0, new DeviceRequest.SetPose("r" + robot, x, y, 0));
                }
                case 3 -> push.ask(Interfaces.POSITION2D, robot, new DeviceRequest.Power(random.nextInt(4) > 0));
                case 4 -> push.tell(Interfaces.SIMULATION, 0, new DeviceCommand.Reset());
                default -> {
                    var speeds = new DeviceCommand.Car(random.nextDouble(0.6), random.nextDouble(-1, 1));
                    push.tell(Interfaces.POSITION2D, robot % 2, speeds);
                }
            }
            said.countDown();
            for (int i = random.nextInt(20_000); i > 0; i--) {
                Thread.onSpinWait();
            }
        }
    }

    @Test
    @Timeout(120)
    void runner_waitsForTheClockOfTheMachine_andStopsInTheMiddleOfIt() throws Exception {
        var ticks = new CountDownLatch(3);
        WireClient push = push();
        var runner = SimulationRunner.start(simulation, 1, snapshot -> ticks.countDown(), new Pace.RealTime(20));
        assertThat(ticks.await(30, TimeUnit.SECONDS)).isTrue();
        runner.pace(new Pace.RealTime(1e-6)); // a tick takes a day
        long tick = simulation.latest().tick();
        runner.close();
        assertThat(runner.isRunning()).isFalse();
        assertThat(simulation.latest().tick()).isLessThan(tick + 3);
        assertThat(push.frames).isNotEmpty();
    }

    // ---- the end of a run

    /** A client that answers and stores the reason of its disconnection. */
    private static final class Answering implements DataSink {
        final CompletableFuture<String> lost = new CompletableFuture<>();
        private final PlayerConnection line =
                PlayerPorts.find(PORT).orElseThrow().connect(this, null);

        Answering() {
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

    /** An observer that rejects every snapshot. */
    private static void reject(Snapshot snapshot) {
        throw new IllegalArgumentException("not like that");
    }

    @Test
    void errorOfTheObserver_endsTheRun_andItsClientsLearnWhy() throws Exception {
        Consumer<Snapshot> broken = snapshot -> {
            throw new NoClassDefFoundError("io/troupe/Unread");
        };
        runEndsBy(broken, "java.lang.NoClassDefFoundError: io/troupe/Unread");
    }

    @Test
    void exceptionOfTheObserver_endsTheRun_andItsClientsLearnWhy() throws Exception {
        runEndsBy(SimulationTest::reject, "not like that");
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

    /** A writer to which the last line of a recording cannot be written. */
    private static Writer fullDisk(AtomicBoolean closed) {
        return new FilterWriter(Writer.nullWriter()) {
            @Override
            public void write(String text, int offset, int length) throws IOException {
                if (text.contains(" end ")) {
                    throw new IOException("/dev/full: No space left on device");
                }
            }

            @Override
            public void close() {
                closed.set(true);
            }
        };
    }

    @Test
    void recordingThatCannotBeClosed_isSaid_andTheWorldIsClosedAllTheSame() {
        var closed = new AtomicBoolean();
        simulation.record(fullDisk(closed));
        assertThatThrownBy(simulation::close)
                .isInstanceOf(UncheckedIOException.class)
                .hasMessage("the recording cannot be written at tick 0: /dev/full: No space left on device");
        assertThat(closed).isTrue();
        assertThatThrownBy(() -> simulation.world().advance()).hasMessageContaining("is closed");
        simulation.close(); // throws only at the first close
    }

    @Test
    void errorThatEndsTheRun_isKept_thoughTheRecordingFailsToo() throws Exception {
        simulation.record(fullDisk(new AtomicBoolean()));
        runEndsBy(SimulationTest::reject, "not like that");
    }

    private WireClient silentWithinTenSeconds() {
        simulation.wallClock(wall);
        simulation.answerLimit(Duration.ofSeconds(10));
        return silent();
    }

    @Test
    void pause_stopsTheAnswerLimit() {
        WireClient client = silentWithinTenSeconds();
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
        assertUnanswered();
        assertThat(simulation.latest().tick()).isEqualTo(1);
    }

    @Test
    void stepOfAPausedWorld_hasAnAnswerLimit_whichStopsAgainAfterIt() {
        WireClient client = silentWithinTenSeconds();
        simulation.pause();
        wall.advance(Duration.ofHours(1));
        simulation.step();
        simulation.whileWaiting(() -> wall.advance(Duration.ofSeconds(1)));
        assertUnanswered();
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
        WireClient client = answering(Interfaces.SONAR, 0);
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

    @Test
    void commandsOfTwoClientsToOneRobot_thatOfTheClientThatConnectedLaterCounts() {
        WireClient first = answering(Interfaces.POSITION2D, 0);
        WireClient second = answering(Interfaces.POSITION2D, 0);
        first.line.answered(PlayerConnection.NO_TICK);
        second.line.answered(PlayerConnection.NO_TICK);
        second.tell(Interfaces.POSITION2D, 0, new DeviceCommand.Car(0.2, 0));
        first.tell(Interfaces.POSITION2D, 0, new DeviceCommand.Car(0.1, 0));
        assertThat(Specs.first(simulation.tick()).odometry().forwardMps()).isEqualTo(0.2);
    }
}
