package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.actor.time.Clock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** Callbacks run first, but messages and timers do not starve. */
class FairnessTest {
    private final TestSpace test = new TestSpace();
    private final List<String> log = new ArrayList<>();
    private int callbacks;

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    /** Sends a message to itself, and records the results of promises. */
    public static class Worker extends Actor {
        private final FairnessTest outer;

        Worker(FairnessTest outer) {
            this.outer = outer;
        }

        public void poke() {
            outer.log.add("poked after " + outer.callbacks + " callbacks");
        }

        public void startTimer() {
            after(Duration.ofSeconds(1), () -> outer.log.add("timer after " + outer.callbacks + " callbacks"));
        }
    }

    @Test
    void endlessCallbacks_letAMessageOfAnotherThreadIn_after256() {
        Worker worker = test.spawn(Worker.class, () -> new Worker(this));
        test.run(() -> callbacksWithoutEnd(() -> {
            try {
                Thread.ofPlatform().start(worker::poke).join();
            } catch (InterruptedException e) {
                throw new IllegalStateException(e);
            }
        }));
        assertThat(callbacks).isLessThanOrEqualTo(10 + 256);
    }

    @Test
    void messageOfTheInbox_waitsForNoneOfTheCallbacksThatAnEarlierOneLeadsTo() {
        Worker worker = test.spawn(Worker.class, () -> new Worker(this));
        var many = new Deferred<String>(test.space());
        var trigger = new Deferred<String>(test.space());
        test.run(() -> {
            for (int listener = 0; listener < 10_000; listener++) {
                many.thenRun(() -> callbacks++);
            }
            trigger.thenRun(() -> many.resolve("all"));
        });
        trigger.resolve("now"); // a callback from outside
        worker.poke(); // and a message behind it
        test.crank();
        assertThat(callbacks).isEqualTo(10_000);
        int before = Integer.parseInt(log.getFirst().replaceAll("\\D", ""));
        assertThat(before).isBetween(1, 256);
    }

    @Test
    void endlessCallbacks_letATimerIn_after256() {
        Worker worker = test.spawn(Worker.class, () -> new Worker(this));
        worker.startTimer();
        test.crank();
        test.run(() -> callbacksWithoutEnd(() -> test.clock().advance(Duration.ofSeconds(1))));
        assertThat(callbacks).isLessThanOrEqualTo(10 + 256);
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

    /** Runs by itself from the space's point of view; moved by the test. */
    private static final class SteppedClock implements Clock {
        private long nanos;

        @Override
        public long nanos() {
            return nanos;
        }

        @Override
        public Runnable onMove(Runnable wake) {
            return () -> {};
        }

        @Override
        public boolean runsByItself() {
            return true;
        }
    }

    private static ActorSpace spaceOn(SteppedClock clock) {
        return ActorSpace.create(SpaceSettings.named("stepped").withClock(clock).withHandCrank());
    }

    @Test
    void timer_thatFallsDueAmongManyMessages_waitsForSixteenAtMost() {
        var clock = new SteppedClock();
        try (var space = spaceOn(clock)) {
            var served = new int[1];
            var servedBefore = new ArrayList<Integer>();
            space.execute(() -> space.delay(Duration.ofMillis(1)).thenRun(() -> servedBefore.add(served[0])));
            space.crank();
            for (int mail = 0; mail < 200; mail++) {
                boolean hundredth = mail == 99;
                space.execute(() -> {
                    served[0]++;
                    if (hundredth) {
                        clock.nanos += 1_000_000;
                    }
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
        var clock = new SteppedClock();
        try (var space = spaceOn(clock)) {
            var servedBefore = new ArrayList<Integer>();
            var served = new int[1];
            space.execute(() -> {
                for (int millis = 100; millis < 300; millis += 10) {
                    space.delay(Duration.ofMillis(millis)).thenRun(() -> servedBefore.add(served[0]));
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
            var expected = new ArrayList<Integer>();
            for (int millis = 100; millis < 300; millis += 10) {
                expected.add(millis / 2);
            }
            assertThat(servedBefore).isEqualTo(expected);
        }
    }

    private static void onAnotherThread(Runnable task) {
        try {
            Thread.ofPlatform().start(task).join();
        } catch (InterruptedException interrupted) {
            throw new IllegalStateException(interrupted);
        }
    }

    @Test
    void answerOfAnotherThread_waitsForNoMessageFromOutside() {
        var answer = new Deferred<Integer>(test.space());
        test.run(() -> answer.then(value -> log.add("answer")));
        Worker worker = test.spawn(Worker.class, () -> new Worker(this));
        for (int mail = 0; mail < 200; mail++) {
            worker.poke();
        }
        answer.resolve(1); // queued behind 200 messages in the inbox
        test.crank();
        assertThat(log).hasSize(201).startsWith("answer");
    }

    @Test
    void answerOfAnotherThread_comesBeforeTheNextMessageFromInside() {
        var answer = new Deferred<Integer>(test.space());
        test.run(() -> {
            answer.then(value -> log.add("answer"));
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
        var answer = new Deferred<Integer>(test.space());
        Worker worker = test.spawn(Worker.class, () -> new Worker(this));
        worker.poke(); // also from the inbox, so that the space is in the middle of it
        test.run(() -> answer.then(value -> log.add("answer")));
        log.clear();
        test.space()
                .execute(() -> onAnotherThread(() -> {
                    answer.resolve(1);
                    worker.poke();
                }));
        test.crank();
        assertThat(log).containsExactly("answer", "poked after 0 callbacks");
    }

    @Test
    void messageOfAnotherThread_doesNotOvertakeMoreCallbacksOfThatThreadThanRunInARow() {
        Worker worker = test.spawn(Worker.class, () -> new Worker(this));
        var answers = new ArrayList<Deferred<Integer>>();
        for (int count = 0; count < 2_000; count++) {
            answers.add(new Deferred<>(test.space()));
        }
        test.run(() -> answers.forEach(answer -> answer.then(value -> ++callbacks)));
        int answered = 0;
        for (int more : List.of(300, 1, 256, 700, 743)) {
            for (var answer : answers.subList(answered, answered + more)) {
                answer.resolve(1);
            }
            worker.poke();
            answered += more;
        }
        test.crank();
        assertThat(log).hasSize(5).allSatisfy(entry -> assertThat(entry).isEqualTo("poked after 2000 callbacks"));
    }

    @Test
    void messagesOfAnotherThread_amongItsCallbacks_runWhenThoseBeforeThemHaveRun() {
        Worker worker = test.spawn(Worker.class, () -> new Worker(this));
        var answers = new ArrayList<Deferred<Integer>>();
        for (int count = 0; count < 400; count++) {
            answers.add(new Deferred<>(test.space()));
        }
        test.run(() -> answers.forEach(answer -> answer.then(value -> {
            callbacks++;
            if (callbacks < 300) { // more arrive while it runs
                Promise.done().thenRun(() -> callbacks++);
            }
        })));
        test.space()
                .execute(() -> onAnotherThread(() -> {
                    answers.forEach(answer -> answer.resolve(1));
                    worker.poke();
                }));
        test.crank();
        assertThat(log)
                .singleElement()
                .satisfies(entry -> assertThat(Integer.parseInt(entry.replaceAll("\\D", "")))
                        .isGreaterThanOrEqualTo(400));
    }

    @Test
    void timeOut_amongManyMessages_reportsThatTheRequestBehindThemHasNotBegun() {
        var clock = new SteppedClock();
        try (var space = spaceOn(clock)) {
            Desk desk = space.spawn(Desk.class, () -> () -> Promise.of(1));
            space.crank();
            var requests = new ArrayList<Promise<Integer>>();
            var failures = new ArrayList<String>();
            space.execute(() -> requests.getFirst()
                    .orTimeout(Duration.ofMillis(1))
                    .exceptionally(late -> {
                        failures.add(String.valueOf(late.getMessage()));
                        return 0;
                    }));
            for (int mail = 0; mail < 60; mail++) {
                space.execute(() -> clock.nanos += 200_000);
            }
            requests.add(desk.ask());
            space.crank();
            assertThat(failures)
                    .singleElement()
                    .satisfies(text -> assertThat(text).contains("which has not begun it: "));
        }
    }

    /** Answers immediately. */
    public interface Desk {
        Promise<Integer> ask();
    }
}
