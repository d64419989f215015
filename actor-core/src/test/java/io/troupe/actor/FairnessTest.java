package io.troupe.actor;

import static io.troupe.actor.Concurrently.onAnotherThread;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.SteppedClock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;

/** The order in which a space runs: callbacks come first, but messages and timers do not starve. */
class FairnessTest extends InTestSpace {
    interface Poked {
        void poke();
    }

    private int callbacks;
    private int spins;
    private final Doer doer = test.spawn(Doer.class, Doer::new);
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
                .mapToObj(number -> new Deferred<Integer>(test.space()))
                .toList();
        test.run(() -> answers.forEach(answer -> answer.thenRun(() -> {
            callbacks++;
            action.run();
        })));
        return answers;
    }

    private Deferred<Integer> loggedAnswer() {
        var answer = new Deferred<Integer>(test.space());
        test.run(() -> answer.then(value -> log.add("answer")));
        return answer;
    }

    // ---- messages

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
        test.crank();
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

    // ---- callbacks and messages

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
        test.crank();
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
        test.crank();
        assertThat(log).containsExactly("answered after 1");
        assertThat(spins).isEqualTo(10_000);
    }

    @Test
    void endlessCallbacks_letMessagesAndTimersIn_after256() {
        doer.run(me -> me.after(Duration.ofSeconds(1), () -> log.add("timer")));
        test.crank();
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
        var many = new Deferred<String>(test.space());
        var trigger = new Deferred<String>(test.space());
        test.run(() -> {
            for (int listener = 0; listener < 10_000; listener++) {
                many.thenRun(() -> callbacks++);
            }
            trigger.thenRun(() -> many.resolve("all"));
        });
        trigger.resolve("now"); // a callback from outside
        poked.poke(); // and a message behind it
        test.crank();
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
        test.crank();
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
        test.crank();
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

    // ---- timers

    private final SteppedClock clock = new SteppedClock();

    private ActorSpace steppedSpace() {
        return ActorSpace.create(SpaceSettings.named("stepped").withClock(clock).withHandCrank());
    }

    @Test
    void timer_thatFallsDueAmongManyMessages_waitsForSixteenAtMost() {
        try (var space = steppedSpace()) {
            var served = new int[1];
            var servedBefore = new ArrayList<Integer>();
            space.execute(() -> space.delay(Duration.ofMillis(1)).thenRun(() -> servedBefore.add(served[0])));
            space.crank();
            for (int mail = 0; mail < 200; mail++) {
                boolean hundredth = mail == 99;
                space.execute(() -> {
                    served[0]++;
                    clock.nanos += hundredth ? 1_000_000 : 0;
                });
            }
            space.crank();
            assertThat(servedBefore)
                    .singleElement()
                    .satisfies(count -> assertThat(count).isBetween(100, 116));
        }
    }

    @Test
    void timer_amongMessagesThatTakeLong_waitsForOneMessage() {
        try (var space = steppedSpace()) {
            var served = new int[1];
            var servedBefore = new ArrayList<Integer>();
            var expected = new ArrayList<Integer>();
            space.execute(() -> {
                for (int millis = 100; millis < 300; millis += 10) {
                    space.delay(Duration.ofMillis(millis)).thenRun(() -> servedBefore.add(served[0]));
                    expected.add(millis / 2);
                }
            });
            space.crank();
            for (int mail = 0; mail < 200; mail++) {
                space.execute(() -> {
                    served[0]++;
                    clock.nanos += 2_000_000; // the duration of each
                });
            }
            space.crank();
            assertThat(servedBefore).hasSize(20).isEqualTo(expected);
        }
    }

    @Test
    void timeOut_amongManyMessages_reportsThatTheRequestBehindThemHasNotBegun() {
        try (var space = steppedSpace()) {
            Doer desk = space.spawn(Doer.class, Doer::new);
            space.crank();
            var requests = new ArrayList<Promise<Integer>>();
            space.execute(() -> requests.getFirst()
                    .orTimeout(Duration.ofMillis(1))
                    .exceptionally(late -> log.add(late.getMessage()) ? 0 : 1));
            for (int mail = 0; mail < 60; mail++) {
                space.execute(() -> clock.nanos += 200_000);
            }
            requests.add(desk.ask(me -> Promise.of(1)));
            space.crank();
            assertThat(log).singleElement().satisfies(text -> assertThat(text).contains("which has not begun it: "));
        }
    }
}
