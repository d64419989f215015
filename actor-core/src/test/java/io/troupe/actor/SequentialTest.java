package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CancellationException;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

class SequentialTest {
    private final TestSpace test = new TestSpace();
    private final List<String> log = new ArrayList<>();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    /** Makes two requests in a row, and can do other work meanwhile. */
    public static class Asker extends Actor {
        private final List<String> log;
        private final List<Deferred<String>> questions = new ArrayList<>();

        Asker(List<String> log) {
            this.log = log;
        }

        public Promise<String> askTwice() {
            return space().sequential(() -> {
                String first = firstAnswer();
                log.add("heard " + first);
                String second = question().await();
                after(Duration.ofSeconds(1), () -> log.add("timer of the actor"));
                return first + " " + second;
            });
        }

        public void answer(String text) {
            log.add("answers " + text);
            questions.removeFirst().resolve(text);
        }

        public void end() {
            stop();
        }

        private String firstAnswer() {
            try {
                return question().await();
            } catch (CancellationException cancelled) {
                log.add("cancelled: " + cancelled.getMessage());
                throw cancelled;
            }
        }

        private Promise<String> question() {
            var question = new Deferred<String>();
            questions.add(question);
            return question;
        }
    }

    @Test
    void body_waitsWhileOthersAreServed_andGoesOnOnBehalfOfItsActor() {
        Asker asker = test.spawn(Asker.class, () -> new Asker(log));
        Promise<String> both = asker.askTwice();
        test.crank();
        assertThat(both.isDone()).isFalse();
        asker.answer("one");
        test.crank();
        asker.answer("two");
        assertThat(test.get(both)).isEqualTo("one two");
        test.advance(Duration.ofSeconds(1));
        assertThat(log).containsExactly("answers one", "heard one", "answers two", "timer of the actor");
    }

    @Test
    void body_thatIsCancelledBeforeItBegins_neverBegins() {
        Promise<Boolean> answer = test.space().sequential(() -> log.add("begun"));
        answer.cancel();
        test.crank();
        assertThat(log).isEmpty();
    }

    @Test
    void await_throwsWhatThePromiseWasRejectedWith_unwrapped() {
        var failing = new Deferred<String>(test.space());
        Promise<String> answer = test.space().sequential(() -> {
            try {
                return failing.await();
            } catch (Exception e) {
                return "caught " + e.getMessage();
            }
        });
        test.crank();
        failing.reject(new IOException("no map"));
        assertThat(test.get(answer)).isEqualTo("caught no map");
    }

    @Test
    void body_thatWaitsInAListenerOfAFuture_isResumed_andOthersAreServed() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("future"))) {
            Promise<String> answer = space.sequential(() -> {
                var first = new Deferred<String>();
                var second = new Deferred<String>();
                var both = first.toCompletableFuture().thenApply(text -> text + second.await());
                space.execute(() -> second.resolve("late")); // runs while the body waits in the listener
                first.resolve("soon, ");
                return both.join();
            });
            assertThat(answer.get(Duration.ofSeconds(60))).isEqualTo("soon, late");
        }
    }

    @Test
    void body_thatThrows_rejectsItsPromise() {
        Promise<Integer> answer = test.space().sequential(() -> {
            Promise.done().await();
            throw new IOException("out of paper");
        });
        assertThat(test.error(answer)).isInstanceOf(IOException.class).hasMessage("out of paper");
    }

    @Test
    void await_onTheSpacesThreadOrOutside_throwsAndNamesTheAlternative() {
        var never = new Deferred<String>(test.space());
        test.run(() -> assertThatThrownBy(never::await)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContainingAll(
                        "would stop the whole space", "then(..)", "thenCompose(..)", "sequential(..)"));
        assertThatThrownBy(never::await)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContainingAll("sequential(..)", "get(Duration)");
    }

    @Test
    void body_ofAnActorThatStops_isCancelledWhereItWaits() {
        Asker asker = test.spawn(Asker.class, () -> new Asker(log));
        Promise<String> both = asker.askTwice();
        test.crank();
        asker.end();
        assertThat(test.error(both))
                .isInstanceOf(ActorStoppedException.class)
                .hasMessageContaining("Asker#1 has stopped");
        assertThat(log).containsExactly("cancelled: the actor Asker#1 has stopped while a body of it waited");
    }

    @Test
    void body_inASpaceThatIsClosed_isCancelledWhereItWaits_andCounted() {
        var space = ActorSpace.create(SpaceSettings.named("short-lived").withHandCrank());
        var never = new Deferred<String>(space);
        var ending = new ArrayList<@Nullable Throwable>();
        Promise<String> answer = space.sequential(() -> {
            try {
                return never.await();
            } finally {
                log.add("finally");
            }
        });
        answer.whenComplete((value, error) -> ending.add(error));
        space.crank();
        Leftovers leftovers = space.close(Duration.ofSeconds(1));
        assertThat(leftovers.sequences()).isEqualTo(1);
        assertThat(log).containsExactly("finally");
        assertThat(answer.error()).isInstanceOf(CancellationException.class).hasMessageContaining("short-lived");
    }

    @Test
    void bodies_takeTurns_eachFromOneWaitToTheNext() {
        var gates = List.of(new Deferred<Integer>(test.space()), new Deferred<Integer>(test.space()));
        for (int index = 0; index < 2; index++) {
            int number = index;
            test.space().sequential(() -> {
                log.add("begin " + number);
                log.add(number + " got " + gates.get(number).await());
                return null;
            });
        }
        test.crank();
        gates.get(1).resolve(10);
        gates.get(0).resolve(20);
        test.crank();
        assertThat(log).containsExactly("begin 0", "begin 1", "1 got 10", "0 got 20");
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void bodies_ofASpaceWithAThread_neverRunTwoAtATime() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("sequential"))) {
            var counter = new int[1]; // without a lock on purpose
            var ends = new ArrayList<Promise<Integer>>();
            for (int body = 0; body < 50; body++) {
                ends.add(space.sequential(() -> {
                    for (int round = 0; round < 40; round++) {
                        int before = counter[0];
                        Thread.yield();
                        counter[0] = before + 1;
                        space.offload(() -> 1).await();
                    }
                    return 1;
                }));
            }
            assertThat(Promise.all(ends).get(Duration.ofSeconds(50))).hasSize(50);
            assertThat(counter[0]).isEqualTo(2000);
        }
    }

    @Test
    void threadOfABody_thatHasEnded_isNotTheSpacesAnyMore() throws Exception {
        SpaceHome space = test.space().home;
        var end = new Deferred<Boolean>();
        new SequentialBodies.Body<>(space, space.owner(), space::isCurrent, end).run();
        assertThat(end.get(Duration.ofSeconds(50))).isTrue();
        assertThat(space.isCurrent()).isFalse(); // though no other thread has taken control
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void bodiesOfTwoSpaces_onTheSameThreads_eachBelongToTheirOwnSpace() throws Exception {
        try (var first = ActorSpace.create(SpaceSettings.named("first"));
                var second = ActorSpace.create(SpaceSettings.named("second"))) {
            for (int round = 0; round < 100; round++) {
                var own = new ArrayList<Promise<Boolean>>();
                for (int body = 0; body < 20; body++) {
                    first.sequential(() -> true);
                    own.add(second.sequential(() -> !first.home.isCurrent()));
                }
                assertThat(Promise.all(own).get(Duration.ofSeconds(50))).containsOnly(true);
            }
        }
    }
}
