package io.troupe.actor;

import static io.troupe.actor.Concurrently.onAnotherThread;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.time.temporal.ChronoUnit;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.IntUnaryOperator;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

@Timeout(60)
class ActorSpaceTest extends InTestSpace {
    private static final Duration FOREVER = ChronoUnit.FOREVER.getDuration();

    private final Doer doer = test.spawn(Doer.class, Doer::new);

    @Test
    void listener_ofAStoppedActor_isNotCalled() {
        var promise = new Deferred<String>();
        doer.run(me -> promise.thenAccept(log::add));
        stop(doer);
        promise.resolve("late");
        test.runQueued();
        assertThat(log).isEmpty();
    }

    private Promise<Integer> countDown(int from) {
        return from == 0
                ? Promise.of(0)
                : Promise.of(1).thenCompose(one -> countDown(from - one)).thenApply(depth -> depth + 1);
    }

    @Test
    void recursionThroughPromises_mayBeOfAnyDepth() {
        assertThat(values(doer.ask(me -> countDown(100_000)))).containsExactly(100_000);
    }

    private void pass(int left) {
        log.add("pass " + left);
        if (left > 0) {
            doer.run(me -> pass(left - 1));
        }
    }

    @Test
    void onIdle_waitsForEverythingThatComesOfWhatWaits() {
        test.space().onIdle(() -> log.add("idle"));
        doer.run(me -> pass(2));
        test.runQueued();
        assertThat(log).containsExactly("pass 2", "pass 1", "pass 0", "idle");
    }

    @Test
    void spacesRunInsideEachOther_knowWhoseTurnItIs() {
        try (var inner = new TestSpace()) {
            var seen = new ArrayList<ActorSpace>();
            test.run(() -> {
                seen.add(ActorSpace.current());
                inner.run(() -> seen.add(ActorSpace.current()));
                seen.add(ActorSpace.current());
            });
            assertThat(seen).containsExactly(test.space(), inner.space(), test.space());
            assertThat(ActorSpace.current()).isNull();
        }
    }

    @Test
    void runQueued_ofASpaceWithAThread_isRejected() {
        try (var space = ActorSpace.create(SpaceSettings.named("threaded"))) {
            assertThatThrownBy(space::runQueued)
                    .isInstanceOf(IllegalStateException.class)
                    .hasMessageContainingAll("threaded", "has a thread");
        }
    }

    @Test
    void globalSpace_cannotBeClosed() {
        assertThatThrownBy(() -> ActorSpace.global().close()).hasMessageContaining("cannot be closed");
    }

    @Test
    void stallLimitAndGet_longerThanNanosecondsCanCount_work() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("patient").withOnStall(FOREVER, stall -> {}))) {
            var served = new CountDownLatch(1);
            space.execute(served::countDown);
            assertThat(served.await(60, TimeUnit.SECONDS)).isTrue();
            assertThat(space.sequential(() -> 1).get(FOREVER)).isEqualTo(1);
        }
    }

    @Test
    void completableFuture_whatFollowsInIt_isNotOnBehalfOfTheLastActor() {
        var promise = new AtomicReference<Promise<Integer>>();
        var deferred = new Deferred<Integer>();
        test.run(() -> promise.set(deferred.thenApply(one -> one)));
        deferred.resolve(1);
        test.runQueued();
        doer.run(me -> {});
        promise.get()
                .toCompletableFuture()
                .thenAccept(one -> test.space().delay(Duration.ofSeconds(1)).thenRun(() -> log.add("alarm")));
        test.runQueued();
        stop(doer);
        test.advance(Duration.ofSeconds(2));
        assertThat(log).containsExactly("alarm");
    }

    @Test
    void factory_answersTheSameObjectForTwoActors_firstKeepsItsOwnSelf() {
        var one = new Doer();
        Doer first = test.spawn(Doer.class, () -> one);
        test.spawn(Doer.class, () -> one); // rejecting it would also be correct
        test.takeProblems();
        assertThat(values(first.ask(me -> Promise.of(me.self().toString())))).containsExactly(first.toString());
    }

    @Test
    void runningSpace_whoseWakerCouldNotUnparkIt_isNotTakenForAsleep_andIsWokenAgain() {
        var lifeline = new IdleStrategy();
        lifeline.noteNotWoken();
        assertThat(lifeline.isAsleep()).isFalse();
        assertThat(lifeline.wake()).isTrue();
        assertThat(lifeline.phase).isZero();
        lifeline.close();
        lifeline.noteNotWoken();
        assertThat(lifeline.isClosed()).isTrue();
    }

    // ---- the order in which a space runs: callbacks come first, but messages and timers do not starve

    interface Poked {
        void poke();
    }

    private int callbacks;
    private int spins; // messages that have run
    private final Poked poked = test.spawn(Poked.class, () -> () -> log.add("poked after " + callbacks));

    private int callbacksBeforeThePoke() {
        assertThat(log).hasSize(1);
        return Integer.parseInt(log.getFirst().replaceAll("\\D", ""));
    }

    /** Queues callback after callback until other work has run; the tenth runs an action. */
    private void callbacksWithoutEnd(Runnable atTheTenth) {
        Promise.done().thenRun(() -> {
            if (++callbacks == 10) {
                atTheTenth.run();
            }
            if (log.isEmpty() && callbacks < 1_000_000) {
                callbacksWithoutEnd(atTheTenth);
            }
        });
    }

    /** Calls itself 10,000 times through a proxy; the first call runs an action. */
    private void spin(Runnable atTheFirst) {
        if (spins++ == 0) {
            atTheFirst.run();
        }
        if (spins < 10_000) {
            doer.run(me -> spin(atTheFirst));
        }
    }

    /** Promises whose callbacks are counted, and run an action. */
    private List<Deferred<Integer>> countedAnswers(int count, Runnable action) {
        var answers = IntStream.range(0, count)
                .mapToObj(number -> test.space().<Integer>deferred())
                .toList();
        test.run(() -> answers.forEach(answer -> answer.thenRun(() -> {
            callbacks++;
            action.run();
        })));
        return answers;
    }

    private Deferred<Integer> loggedAnswer() {
        Deferred<Integer> answer = test.space().deferred();
        test.run(() -> answer.then(value -> log.add("answer")));
        return answer;
    }

    @Test
    void messages_ofOneSender_keepTheirOrder() {
        for (int i = 0; i < 1000; i++) {
            int number = i;
            doer.run(me -> log.add("n" + number));
        }
        List<String> names = test.get(doer.ask(me -> Promise.of(List.copyOf(log))));
        assertThat(names).hasSize(1000).startsWith("n0", "n1").endsWith("n999");
    }

    @Test
    void call_fromInside_isNeverServedOnTheCallersStack() {
        Doer second = test.spawn(Doer.class, Doer::new);
        doer.run(me -> {
            log.add("first begins");
            second.run(other -> log.add("second"));
            log.add("first ends");
        });
        test.runQueued();
        assertThat(log).containsExactly("first begins", "first ends", "second");
    }

    @Test
    void hotActor_doesNotStarveTheOthers() {
        Doer quiet = test.spawn(Doer.class, Doer::new);
        test.run(() -> {
            doer.run(me -> spin(() -> {}));
            quiet.run(me -> log.add("served after " + spins));
        });
        assertThat(log).containsExactly("served after 1");
    }

    @Test
    void callback_comesBeforeQueuedMessages() {
        var promise = new Deferred<String>();
        doer.ask(me -> {
            promise.then(result -> log.add("callback"));
            return promise;
        });
        doer.run(me -> {
            log.add("mail 1");
            promise.resolve("done");
        });
        doer.run(me -> log.add("mail 2"));
        test.runQueued();
        assertThat(log).containsExactly("mail 1", "callback", "mail 2");
    }

    @Test
    void callbacks_runAtMost256InARow_beforeAMessage() {
        test.run(() -> {
            poked.poke();
            for (int count = 0; count < 1_000; count++) {
                Promise.of(count).then(value -> ++callbacks);
            }
        });
        assertThat(callbacks).isEqualTo(1_000);
        assertThat(callbacksBeforeThePoke()).isEqualTo(256);
    }

    @Test
    void endlessMessages_doNotStarveTheCallbacks() {
        var answered = new Deferred<Integer>();
        doer.run(me -> spin(() -> {
            answered.then(value -> log.add("answered after " + spins));
            answered.resolve(1);
        }));
        test.runQueued();
        assertThat(log).containsExactly("answered after 1");
        assertThat(spins).isEqualTo(10_000);
    }

    @Test
    void endlessCallbacks_letMessagesAndTimersIn_after256() {
        doer.run(me -> me.context().after(Duration.ofSeconds(1), () -> log.add("timer")));
        test.runQueued();
        Runnable advance = () -> test.clock().advance(Duration.ofSeconds(1));
        for (Runnable other : List.<Runnable>of(poked::poke, () -> onAnotherThread(poked::poke), advance)) {
            callbacks = 0;
            log.clear();
            test.run(() -> callbacksWithoutEnd(other));
            assertThat(callbacks).isBetween(10, 10 + 256);
        }
        assertThat(log).containsExactly("timer");
    }

    @Test
    void messageOfTheInbox_waitsForNoneOfTheCallbacksThatAnEarlierOneLeadsTo() {
        Deferred<String> many = test.space().deferred();
        Deferred<String> trigger = test.space().deferred();
        test.run(() -> {
            for (int listener = 0; listener < 10_000; listener++) {
                many.thenRun(() -> callbacks++);
            }
            trigger.thenRun(() -> many.resolve("all"));
        });
        trigger.resolve("now"); // a callback from outside
        poked.poke(); // and a message behind it
        test.runQueued();
        assertThat(callbacks).isEqualTo(10_000);
        assertThat(callbacksBeforeThePoke()).isBetween(1, 256);
    }

    @Test
    void answerOfAnotherThread_waitsForNoMessageFromOutside() {
        var answer = loggedAnswer();
        for (int mail = 0; mail < 200; mail++) {
            poked.poke();
        }
        answer.resolve(1); // queued behind 200 messages in the inbox
        test.runQueued();
        assertThat(log).hasSize(201).startsWith("answer");
    }

    @Test
    void answerOfAnotherThread_comesBeforeTheNextMessageFromInside() {
        var answer = loggedAnswer();
        test.run(() -> {
            for (int mail = 0; mail < 200; mail++) {
                int number = mail;
                test.space().execute(() -> {
                    log.add("mail");
                    if (number == 9) {
                        onAnotherThread(() -> answer.resolve(1));
                    }
                });
            }
        });
        assertThat(log).hasSize(201);
        assertThat(log.indexOf("answer")).isEqualTo(10);
    }

    @Test
    void messageOfAnotherThread_doesNotOvertakeTheCallbackThatThreadQueuedBefore() {
        poked.poke(); // also from the inbox, so that the space is in the middle of it
        var answer = loggedAnswer();
        log.clear();
        test.run(() -> onAnotherThread(() -> {
            answer.resolve(1);
            poked.poke();
        }));
        assertThat(log).containsExactly("answer", "poked after 0");
    }

    @Test
    void messageOfAnotherThread_doesNotOvertakeMoreCallbacksOfThatThreadThanRunInARow() {
        var answers = countedAnswers(2_000, () -> {});
        int answered = 0;
        for (int more : List.of(300, 1, 256, 700, 743)) {
            answers.subList(answered, answered + more).forEach(answer -> answer.resolve(1));
            poked.poke();
            answered += more;
        }
        test.runQueued();
        assertThat(log).hasSize(5).containsOnly("poked after 2000");
    }

    @Test
    void messagesOfAnotherThread_amongItsCallbacks_runWhenThoseBeforeThemHaveRun() {
        var answers = countedAnswers(400, () -> {
            if (callbacks < 300) { // more arrive while it runs
                Promise.done().thenRun(() -> callbacks++);
            }
        });
        test.run(() -> onAnotherThread(() -> {
            answers.forEach(answer -> answer.resolve(1));
            poked.poke();
        }));
        assertThat(callbacksBeforeThePoke()).isGreaterThanOrEqualTo(400);
    }

    private final SteppedClock clock = new SteppedClock();

    private ActorSpace steppedSpace() {
        return ActorSpace.create(SpaceSettings.named("stepped").withClock(clock).withoutThread());
    }

    /** Queues messages, each of which is counted and moves the clock. */
    private void queue(ActorSpace space, int messages, IntUnaryOperator nanos) {
        for (int mail = 0; mail < messages; mail++) {
            int number = mail;
            space.execute(() -> {
                spins++;
                clock.nanos += nanos.applyAsInt(number);
            });
        }
    }

    @Test
    void timer_thatFallsDueAmongManyMessages_waitsForSixteenAtMost() {
        try (var space = steppedSpace()) {
            var servedBefore = new ArrayList<Integer>();
            space.execute(() -> space.delay(Duration.ofMillis(1)).thenRun(() -> servedBefore.add(spins)));
            space.runQueued();
            queue(space, 200, number -> number == 99 ? 1_000_000 : 0);
            space.runQueued();
            assertThat(servedBefore)
                    .singleElement()
                    .satisfies(count -> assertThat(count).isBetween(100, 116));
        }
    }

    @Test
    void timer_amongMessagesThatTakeLong_waitsForOneMessage() {
        try (var space = steppedSpace()) {
            var servedBefore = new ArrayList<Integer>();
            var expected = new ArrayList<Integer>();
            space.execute(() -> {
                for (int millis = 100; millis < 300; millis += 10) {
                    space.delay(Duration.ofMillis(millis)).thenRun(() -> servedBefore.add(spins));
                    expected.add(millis / 2);
                }
            });
            space.runQueued();
            queue(space, 200, number -> 2_000_000);
            space.runQueued();
            assertThat(servedBefore).hasSize(20).isEqualTo(expected);
        }
    }

    @Test
    void timeOut_amongManyMessages_reportsThatTheRequestBehindThemHasNotBegun() {
        try (var space = steppedSpace()) {
            Doer desk = space.spawn(Doer.class, Doer::new);
            space.runQueued();
            var requests = new ArrayList<Promise<Integer>>();
            space.execute(() -> requests.getFirst()
                    .orTimeout(Duration.ofMillis(1))
                    .exceptionally(late -> log.add(late.getMessage()) ? 0 : 1));
            queue(space, 60, number -> 200_000);
            requests.add(desk.ask(me -> Promise.of(1)));
            space.runQueued();
            assertThat(log).singleElement().asString().contains("which has not begun it: ");
        }
    }
}
