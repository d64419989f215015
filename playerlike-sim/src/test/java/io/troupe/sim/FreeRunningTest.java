package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.time.ManualClock;
import io.troupe.player.WireClient;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.Interfaces;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.Scenario;
import java.io.StringReader;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Worlds with clients that do not answer. */
@Timeout(120)
class FreeRunningTest {
    private static final int PORT = 6795;

    private final Simulation simulation = Simulation.open(scenario(), Arena.seed(2));
    private final ManualClock wall = new ManualClock();
    private final List<Long> sleptMillis = new ArrayList<>();
    private final RealTimePacer pacer = new RealTimePacer(wall, nanos -> {
        sleptMillis.add(nanos / 1_000_000);
        wall.advance(Duration.ofNanos(nanos));
    });

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

    private static WireClient push() {
        var client = new WireClient(PORT, (self, frame) -> {}).subscribe(Interfaces.LASER, 0);
        client.line.answers(false);
        return client;
    }

    private void tick(Pace pace) {
        simulation.tick(pacer, pace);
    }

    @Test
    void pushClient_isNotWaitedFor_butOthersAre() {
        WireClient push = push();
        simulation.tick();
        simulation.tick();
        assertThat(push.frames).hasSize(2);

        new WireClient(PORT, (self, frame) -> {}).subscribe(Interfaces.SONAR, 1); // silent, but not for ever
        simulation.answerLimit(Duration.ofMillis(1));
        assertThatThrownBy(simulation::tick)
                .isInstanceOf(UnansweredTickException.class)
                .hasMessageContaining("sonar:1")
                .hasMessageNotContaining("laser:0");
    }

    @Test
    void pace_isThatOfRealTime_whileAClientNeverAnswers() {
        new WireClient(PORT, WireClient.ANSWER).subscribe(Interfaces.SONAR, 1);
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
    void pushClientsCommand_countsInTheTickInWhichItComes() {
        WireClient push = new WireClient(
                        PORT, (self, frame) -> self.tell(Interfaces.POSITION2D, 0, new DeviceCommand.Car(0.3, 0)))
                .subscribe(Interfaces.POSITION2D, 0);
        push.line.answered(-1);
        push.line.answers(false);
        assertThat(simulation.tick().robots().getFirst().odometry().forwardMps())
                .isEqualTo(0.3);
    }

    @Test
    void clientThatAnswersAgain_isWaitedFor() {
        WireClient client = push();
        simulation.tick();
        client.line.answers(true);
        client.line.answered(0);
        simulation.answerLimit(Duration.ofMillis(1));
        assertThatThrownBy(simulation::tick).isInstanceOf(UnansweredTickException.class);
        client.line.answers(false);
        simulation.tick();
        assertThat(client.frames).hasSize(3);
    }

    @Test
    void silentClient_isDisconnectedIfThatIsWanted_andTheOthersGoOn() {
        WireClient silent = new WireClient(PORT, (self, frame) -> {}).subscribe(Interfaces.SONAR, 1);
        WireClient good = new WireClient(PORT, WireClient.ANSWER).subscribe(Interfaces.SONAR, 0);
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
    void worldOutOfLockStep_waitsForNobody_andKeepsPace() {
        var silent = new WireClient(PORT, (self, frame) -> {}).subscribe(Interfaces.SONAR, 1);
        simulation.lockStep(false);
        tick(new Pace.OfAnswers());
        tick(new Pace.OfAnswers());
        assertThat(silent.frames).hasSize(2);
        assertThat(sleptMillis).containsExactly(100L, 100L);
    }

    @Test
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
        var talker = Thread.ofPlatform().start(() -> talk(push, stop, said));
        try (var runner = SimulationRunner.start(
                simulation,
                1,
                snapshot -> {
                    hash.update(snapshot);
                    enough.countDown();
                },
                new Pace.Unlimited())) {
            assertThat(enough.await(60, TimeUnit.SECONDS)).isTrue();
            assertThat(said.await(60, TimeUnit.SECONDS)).isTrue();
            assertThat(runner.isRunning()).isTrue();
        } finally {
            stop.set(true);
            talker.join();
        }
        recording.close();
        long ticks = simulation.latest().tick();

        String text = out.toString();
        Replay replay = Replay.read(new StringReader(text));
        var replayed = new SnapshotHash();
        replay.play(Arena.spec(3), replayed::update);

        assertThat(text).contains(" velocity ").contains(" goto ").contains(" teleport ");
        assertThat(replay.ticks()).isEqualTo(ticks);
        assertThat(replayed.toString()).isEqualTo(hash.toString());
    }

    private static void talk(WireClient push, AtomicBoolean stop, CountDownLatch said) {
        var random = new SplittableRandom(3);
        while (!stop.get()) {
            int robot = random.nextInt(3);
            switch (random.nextInt(20)) {
                case 0 ->
                    push.tell(
                            Interfaces.POSITION2D,
                            robot,
                            new DeviceCommand.GoTo(random.nextDouble(2), random.nextDouble(2), 0, 0, 0, 0, true));
                case 1 -> push.ask(Interfaces.POSITION2D, robot, new DeviceRequest.SetOdometry(1, 2, 3));
                case 2 ->
                    push.ask(
                            Interfaces.SIMULATION,
                            0,
                            new DeviceRequest.SetPose(
                                    "r" + robot, random.nextDouble(-3, 3), random.nextDouble(-3, 3), 0));
                case 3 -> push.ask(Interfaces.POSITION2D, robot, new DeviceRequest.Power(random.nextInt(4) > 0));
                case 4 -> push.tell(Interfaces.SIMULATION, 0, new DeviceCommand.Reset());
                default ->
                    push.tell(
                            Interfaces.POSITION2D,
                            robot,
                            new DeviceCommand.Car(random.nextDouble(0.6), random.nextDouble(-1, 1)));
            }
            said.countDown();
            for (int i = random.nextInt(20_000); i > 0; i--) {
                Thread.onSpinWait();
            }
        }
    }

    @Test
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
}
