package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CancellationException;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

class ActorSpaceTest {
    interface Greeter {
        Promise<String> greet(String name);

        void remember(String name);

        Promise<List<String>> remembered();
    }

    static final class Politely extends Actor implements Greeter {
        private final List<String> names = new ArrayList<>();

        @Override
        public Promise<String> greet(String name) {
            return Promise.of("Hello, " + name);
        }

        @Override
        public void remember(String name) {
            names.add(name);
        }

        @Override
        public Promise<List<String>> remembered() {
            return Promise.of(List.copyOf(names));
        }
    }

    interface Counter {
        Promise<Integer> add(int amount);

        void fail(String why);

        Promise<Integer> failing(String why);
    }

    private final TestSpace test = new TestSpace();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    @Test
    void request_isAnsweredThroughAPromise() {
        Greeter greeter = test.spawn(Greeter.class, Politely::new);
        Promise<String> answer = greeter.greet("Ada");
        assertThat(answer.isDone()).isFalse();
        assertThat(test.get(answer)).isEqualTo("Hello, Ada");
    }

    @Test
    void messages_ofOneSender_keepTheirOrder() {
        Greeter greeter = test.spawn(Greeter.class, Politely::new);
        for (int i = 0; i < 1000; i++) {
            greeter.remember("n" + i);
        }
        List<String> names = test.get(greeter.remembered());
        assertThat(names).hasSize(1000).startsWith("n0", "n1").endsWith("n999");
    }

    @Test
    void call_fromInside_isNeverServedOnTheCallersStack() {
        var log = new ArrayList<String>();
        interface Node {
            void poke();
        }
        Node second = test.spawn(Node.class, () -> () -> log.add("second"));
        Node first = test.spawn(Node.class, () -> () -> {
            log.add("first begins");
            second.poke();
            log.add("first ends");
        });
        first.poke();
        test.crank();
        assertThat(log).containsExactly("first begins", "first ends", "second");
    }

    @Test
    void callback_comesBeforeTheMailsThatWait() {
        var log = new ArrayList<String>();
        interface Worker {
            Promise<String> work();

            void mail(int number);
        }
        var promise = new Deferred<String>();
        Worker worker = test.spawn(Worker.class, () -> new Worker() {
            @Override
            public Promise<String> work() {
                promise.then(result -> {
                    log.add("callback");
                });
                return promise;
            }

            @Override
            public void mail(int number) {
                log.add("mail " + number);
                if (number == 1) {
                    promise.resolve("done");
                }
            }
        });
        worker.work();
        worker.mail(1);
        worker.mail(2);
        test.crank();
        assertThat(log).containsExactly("mail 1", "callback", "mail 2");
    }

    @Test
    void endlessCallbacks_doNotStarveTheMailbox() {
        var rounds = new int[1];
        var seen = new ArrayList<Integer>();
        interface Worker {
            void spin();

            void mail();
        }
        Worker worker = test.spawn(Worker.class, () -> new Worker() {
            @Override
            public void spin() {
                if (rounds[0]++ < 10_000) {
                    Promise.of(1).then(one -> {
                        spin();
                    });
                }
            }

            @Override
            public void mail() {
                seen.add(rounds[0]);
            }
        });
        test.space().execute(() -> {
            worker.spin();
            worker.mail();
        });
        test.crank();
        assertThat(seen).hasSize(1);
        assertThat(seen.getFirst()).isLessThanOrEqualTo(300);
    }

    @Test
    void exception_inARequest_rejectsItsPromiseUnwrapped() {
        Counter counter = test.spawn(Counter.class, FailingCounter::new);
        Throwable error = test.error(counter.failing("no reason"));
        assertThat(error).isExactlyInstanceOf(IllegalArgumentException.class).hasMessage("no reason");
    }

    @Test
    void exception_inAOneWayMessage_goesToTheErrorHandler() {
        Counter counter = test.spawn(Counter.class, FailingCounter::new);
        counter.fail("on purpose");
        test.crank();
        assertThat(test.takeProblems()).singleElement().satisfies(problem -> {
            assertThat(problem.where()).isEqualTo("Counter.fail(String) of Counter#1");
            assertThat(problem.error()).hasMessage("on purpose");
        });
        assertThat(test.get(counter.add(2))).isEqualTo(2);
    }

    @Test
    void exception_goesToTheActorsOwnHandlerFirst() {
        var own = new ArrayList<String>();
        Counter counter = test.space()
                .spawn(
                        Counter.class,
                        FailingCounter::new,
                        ActorSettings.named("tally")
                                .withOnError((where, error) -> own.add(where + ": " + error.getMessage())));
        counter.fail("mine");
        test.crank();
        assertThat(own).containsExactly("Counter.fail(String) of tally: mine");
    }

    @Test
    void rejection_nobodyListensTo_isReported() {
        Counter counter = test.spawn(Counter.class, FailingCounter::new);
        test.run(() -> counter.failing("unheard"));
        assertThat(test.takeProblems()).singleElement().satisfies(problem -> {
            assertThat(problem.where()).isEqualTo("a promise nobody listens to: Counter.failing(unheard) of Counter#1");
            assertThat(problem.error()).hasMessage("unheard");
        });
    }

    @Test
    void rejection_askedFromOutside_isReportedAfterAMoment() {
        Counter counter = test.spawn(Counter.class, FailingCounter::new);
        counter.failing("unheard");
        test.crank();
        assertThat(test.takeProblems()).isEmpty();
        test.advance(Duration.ofSeconds(1));
        assertThat(test.takeProblems()).hasSize(1);
    }

    @Test
    void cancel_reachesARequestThatWaits() {
        Counter counter = test.spawn(Counter.class, FailingCounter::new);
        counter.add(1);
        Promise<Integer> cancelled = counter.add(10);
        assertThat(cancelled.cancel()).isTrue();
        assertThat(test.get(counter.add(2))).isEqualTo(3);
        assertThat(cancelled.isCancelled()).isTrue();
        assertThat(test.error(cancelled))
                .isInstanceOf(CancellationException.class)
                .hasMessageContaining("Counter.add(10)");
    }

    @Test
    void stoppedActor_refusesRequestsAndMakesDeadLettersOfMessages() {
        Counter counter = test.spawn(Counter.class, FailingCounter::new);
        test.space().stop(counter);
        Throwable error = test.error(counter.add(1));
        assertThat(error)
                .isInstanceOf(ActorStoppedException.class)
                .hasMessage("Counter.add(1) of Counter#1 was not begun: the actor Counter#1 has stopped");
        counter.fail("into the void");
        test.crank();
        assertThat(test.takeDeadLetters())
                .containsExactly(
                        new DeadLetter("Counter#1", "Counter.fail(into the void)", "the actor Counter#1 has stopped"));
    }

    @Test
    void listener_ofAStoppedActor_isNotCalled() {
        var promise = new Deferred<String>();
        var calls = new ArrayList<String>();
        interface Waiter {
            void await();
        }
        Waiter waiter = test.spawn(Waiter.class, () -> () -> promise.thenAccept(calls::add));
        waiter.await();
        test.space().stop(waiter);
        test.crank();
        promise.resolve("late");
        test.crank();
        assertThat(calls).isEmpty();
    }

    @Test
    void factory_thatThrows_isReportedAndItsActorIsStopped() {
        Counter counter = test.space().spawn(Counter.class, () -> {
            throw new IllegalStateException("no counter today");
        });
        assertThat(test.error(counter.add(1))).isInstanceOf(ActorStoppedException.class);
        assertThat(test.takeProblems())
                .singleElement()
                .satisfies(problem -> assertThat(problem.error()).hasMessage("no counter today"));
    }

    @Test
    void requestThatAnswersNull_isRejectedByName() {
        interface Careless {
            Promise<String> ask();
        }
        Careless careless = test.spawn(Careless.class, () -> () -> null);
        assertThat(test.error(careless.ask()))
                .hasMessage("Careless.ask() of Careless#1 answered null, expected a promise");
    }

    @Test
    void repeatWhile_sharesTheThreadBetweenRounds() {
        var log = new ArrayList<String>();
        test.run(() -> {
            var left = new int[] {3};
            test.space().repeatWhile(() -> left[0] > 0, () -> {
                log.add("a" + left[0]--);
            });
            var right = new int[] {2};
            test.space().repeatWhile(() -> right[0] > 0, () -> {
                log.add("b" + right[0]--);
            });
        });
        assertThat(log).containsExactly("a3", "b2", "a2", "b1", "a1");
    }

    @Test
    void repeatWhile_waitsForThePromiseOfItsBody() {
        var steps = new ArrayList<Deferred<String>>();
        var end = new ArrayList<String>();
        test.run(() -> test.space()
                .repeatWhile(() -> steps.size() < 2, () -> {
                    var step = new Deferred<String>();
                    steps.add(step);
                    return step;
                })
                .thenRun(() -> end.add("over")));
        assertThat(steps).hasSize(1);
        steps.getFirst().resolve("first");
        test.crank();
        assertThat(steps).hasSize(2);
        assertThat(end).isEmpty();
        steps.getLast().resolve("second");
        test.crank();
        assertThat(end).containsExactly("over");
    }

    @Test
    void repeatWhile_thatThrows_rejectsItsPromise() {
        var errors = new ArrayList<String>();
        test.run(() -> test.space()
                .repeatWhile(() -> true, () -> {
                    throw new IllegalStateException("third time unlucky");
                })
                .exceptionally(error -> {
                    errors.add(error.getMessage());
                    return null;
                }));
        assertThat(errors).containsExactly("third time unlucky");
    }

    @Test
    void recursionThroughPromises_mayBeOfAnyDepth() {
        interface Counting {
            Promise<Integer> countDown(int from);

            Promise<Integer> one();
        }
        Counting counting = test.spawn(Counting.class, () -> new Counting() {
            @Override
            public Promise<Integer> countDown(int from) {
                return from == 0
                        ? Promise.of(0)
                        : one().thenCompose(one -> countDown(from - one)).thenApply(depth -> depth + 1);
            }

            @Override
            public Promise<Integer> one() {
                return Promise.of(1);
            }
        });
        assertThat(test.get(counting.countDown(100_000))).isEqualTo(100_000);
    }

    @Test
    void onIdle_waitsForEverythingThatComesOfWhatWaits() {
        var log = new ArrayList<String>();
        interface Relay {
            void pass(int left);
        }
        var relay = new Relay[1];
        relay[0] = test.spawn(Relay.class, () -> left -> {
            log.add("pass " + left);
            if (left > 0) {
                relay[0].pass(left - 1);
            }
        });
        test.space().onIdle(() -> log.add("idle"));
        relay[0].pass(2);
        test.crank();
        assertThat(log).containsExactly("pass 2", "pass 1", "pass 0", "idle");
    }

    @Test
    void spacesCrankedInsideEachOther_knowWhoseTurnItIs() {
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
    void crank_ofASpaceWithAThread_isRefused() {
        try (var space = ActorSpace.create(SpaceSettings.named("threaded"))) {
            assertThatThrownBy(space::crank)
                    .isInstanceOf(IllegalStateException.class)
                    .hasMessageContaining("threaded")
                    .hasMessageContaining("thread of its own");
        }
    }

    @Test
    void globalSpace_cannotBeClosed() {
        assertThatThrownBy(() -> ActorSpace.global().close()).hasMessageContaining("cannot be closed");
    }

    static final class FailingCounter implements Counter {
        private int sum;

        @Override
        public Promise<Integer> add(int amount) {
            sum += amount;
            return Promise.of(sum);
        }

        @Override
        public void fail(String why) {
            throw new IllegalArgumentException(why);
        }

        @Override
        public Promise<Integer> failing(String why) {
            throw new IllegalArgumentException(why);
        }
    }
}
