package io.troupe.actor;

import static io.troupe.actor.Concurrently.LONG;
import static io.troupe.actor.Concurrently.onThreads;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSettings.Overflow;
import io.troupe.actor.internal.ActorProxy;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeoutException;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** An actor that holds its calls back until it is connected. */
class HoldTest extends InTestSpace {
    private final List<Deferred<String>> lines = new ArrayList<>();

    /** Holds its calls back until its line is there. */
    class Modem extends Actor {
        private String line = "none";

        @Override
        protected void started() {
            log.add("started");
            connect();
            context().every("beat", Duration.ofSeconds(1), () -> log.add("beat"));
        }

        private void connect() {
            context().hold();
            var mine = new Deferred<String>();
            lines.add(mine);
            mine.then(there -> {
                line = there;
                log.add("connected to " + there);
                context().release();
            });
        }

        public void say(int word) {
            log.add(line + " says " + word);
        }

        public Promise<String> ask(int question) {
            return Promise.of(line + " answers " + question);
        }

        public void hangUp() {
            connect();
        }

        public void releaseAgain() {
            context().release();
        }
    }

    private Modem spawn(ActorSettings settings) {
        return test.spawn(Modem.class, Modem::new, settings);
    }

    private void connect(String line) {
        lines.removeFirst().resolve(line);
        test.runQueued();
    }

    @Test
    void calls_waitInOrder_whileTimersAndListenersRun_andAreServedBeforeLaterOnes() {
        Modem modem = spawn(ActorSettings.defaults());
        modem.say(1);
        Promise<String> answer = modem.ask(2);
        modem.say(3);
        test.advance(Duration.ofSeconds(2));
        assertThat(log).containsExactly("started", "beat", "beat");
        lines.removeFirst().resolve("A");
        modem.say(4);
        assertThat(test.get(answer)).isEqualTo("A answers 2");
        assertThat(log.subList(3, log.size())).containsExactly("connected to A", "A says 1", "A says 3", "A says 4");
        modem.say(5);
        test.runQueued();
        assertThat(log).endsWith("A says 5");
    }

    @Test
    void holdAmongCallsThatWereHeld_holdsTheRestAgain() {
        Modem modem = spawn(ActorSettings.defaults());
        modem.say(1);
        modem.hangUp();
        modem.say(2);
        test.runQueued();
        connect("A");
        modem.say(3);
        test.runQueued();
        assertThat(log).containsExactly("started", "connected to A", "A says 1");
        connect("B");
        assertThat(log).endsWith("connected to B", "B says 2", "B says 3");
    }

    @Test
    void releaseWithoutAHold_changesNothing_andOneReleaseSuffices() {
        Modem modem = spawn(ActorSettings.defaults());
        test.runQueued();
        connect("A");
        modem.releaseAgain();
        modem.say(1);
        test.runQueued();
        assertThat(log).containsExactly("started", "connected to A", "A says 1");
    }

    @Test
    void heldCalls_areRejected_whenTheActorStops_alsoIfItIsStoppedFromOutside() {
        Modem modem = spawn(ActorSettings.defaults());
        Promise<String> answer = modem.ask(1);
        modem.say(2);
        test.space().stop(modem);
        assertThat(test.error(answer)).isInstanceOf(ActorStoppedException.class);
        assertThat(test.takeDeadLetters()).hasSize(1);
    }

    @Test
    void heldCalls_areCountedAsLeftovers_whenTheSpaceCloses() {
        var space =
                ActorSpace.create(SpaceSettings.named("closing").withoutThread().withOnDeadLetter(letter -> {}));
        Modem modem = space.spawn(Modem.class, Modem::new);
        Promise<String> answer = modem.ask(1);
        modem.say(2);
        space.runQueued();
        Leftovers left = space.close(LONG);
        assertThat(List.of(left.messages(), left.requests())).containsExactly(1, 1);
        assertThat(answer.error()).isInstanceOf(ActorStoppedException.class);
    }

    @Test
    void heldCalls_areServedByTheNextInstance_onceThatReleasesThem() {
        var settings = ActorSettings.defaults().withSupervision(Supervision.restart(3, Duration.ofSeconds(10)));
        Modem modem = spawn(settings);
        test.runQueued();
        connect("A");
        modem.hangUp();
        modem.say(1);
        test.runQueued();
        lines.clear();
        test.run(() -> log.add("--"));
        failInATimer(modem);
        assertThat(log).endsWith("--", "started");
        connect("B");
        assertThat(log).endsWith("connected to B", "B says 1");
    }

    /** The calls are held back, so that only something else can fail. */
    private void failInATimer(Modem modem) {
        test.run(() -> ((ActorCell) ((ActorProxy) modem).troupe$cell()).guard("a timer", () -> {
            throw new IllegalStateException("noise");
        }));
        assertThat(takeErrors()).containsExactly("noise");
    }

    @Test
    void startThatThrows_endsTheHold() {
        class Broken extends Actor {
            @Override
            protected void started() {
                context().hold();
                throw new IllegalStateException("no modem");
            }

            public void say(int word) {
                log.add("says " + word);
            }
        }
        Broken broken = test.spawn(Broken.class, Broken::new);
        broken.say(1);
        test.runQueued();
        assertThat(log).containsExactly("says 1");
        assertThat(takeErrors()).containsExactly("no modem");
    }

    @Test
    void failureWhileCallsAreHeld_isNoReasonOfALaterStop() {
        Modem modem = spawn(ActorSettings.defaults());
        test.runQueued();
        failInATimer(modem);
        stop(modem);
        assertThat(test.get(test.space().whenStopped(modem))).isEqualTo(new ActorEnd.Stopped());
    }

    @Test
    void heldCalls_occupyTheirPlacesInABoundedMailbox() {
        Modem modem = spawn(ActorSettings.defaults().withMailbox(2, Overflow.DROP_OLDEST));
        test.runQueued();
        IntStream.rangeClosed(1, 5).forEach(word -> {
            modem.say(word);
            test.runQueued();
        });
        assertThat(test.takeDeadLetters()).hasSize(3);
        connect("A");
        assertThat(log).containsExactly("started", "connected to A", "A says 4", "A says 5");
    }

    @Test
    void heldRequest_thatWasCancelled_isSkipped_andATimeOutSaysWhatItWaitsFor() {
        Modem modem = spawn(ActorSettings.defaults());
        Promise<String> first = modem.ask(1);
        var late = new ArrayList<Throwable>();
        test.run(() -> modem.ask(2).orTimeout(Duration.ofSeconds(1)).handle((text, error) -> late.add(error)));
        first.cancel();
        test.advance(Duration.ofSeconds(1));
        assertThat(late)
                .singleElement()
                .isInstanceOf(TimeoutException.class)
                .asString()
                .endsWith("of Modem#1, which has not begun it: 1 calls come first, and it holds them");
        connect("A");
        assertThat(first.isCancelled()).isTrue();
    }

    /** Counts what arrives, and holds its calls back again and again. */
    static class Gate extends Actor {
        private final List<List<Integer>> calls = new ArrayList<>();

        @Override
        protected void started() {
            pause();
        }

        private void pause() {
            context().hold();
            context().after(Duration.ofMillis(1), context()::release);
        }

        public void pass(int sender, int number) {
            calls.add(List.of(sender, number));
            if (number % 1_000 == 0) {
                pause();
            }
        }

        public Promise<List<List<Integer>>> calls() {
            return Promise.of(List.copyOf(calls));
        }
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void callsOfSeveralThreads_keepTheOrderOfEach_throughManyHolds() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("gate"))) {
            Gate gate = space.spawn(Gate.class, Gate::new);
            onThreads(3, sender -> IntStream.range(0, 10_000).forEach(number -> gate.pass(sender, number)));
            var calls = gate.calls().get(LONG);
            assertThat(calls).hasSize(30_000);
            for (int sender = 0; sender < 3; sender++) {
                int mine = sender;
                assertThat(calls.stream().filter(call -> call.get(0) == mine).map(call -> call.get(1)))
                        .containsExactlyElementsOf(
                                IntStream.range(0, 10_000).boxed().toList());
            }
        }
    }
}
