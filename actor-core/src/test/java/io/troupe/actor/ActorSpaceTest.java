package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.util.ArrayList;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

class ActorSpaceTest {
    interface Greeter {
        Promise<String> greet(String name);
    }

    private final TestSpace test = new TestSpace();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    @Test
    void request_isAnsweredThroughAPromise() {
        Greeter greeter = test.spawn(Greeter.class, () -> name -> Promise.of("Hello, " + name));
        Promise<String> answer = greeter.greet("Ada");
        assertThat(answer.isDone()).isFalse();
        assertThat(test.get(answer)).isEqualTo("Hello, Ada");
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
    void crank_ofASpaceWithAThread_isRejected() {
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
}
