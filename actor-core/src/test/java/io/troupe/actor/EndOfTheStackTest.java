package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.MailboxBound.Overflow;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** A caller whose stack ends somewhere within a call, as that of an error logger may, costs the space nothing. */
@Tag("threads")
@Timeout(120)
class EndOfTheStackTest {
    private static final Duration LONG = Duration.ofSeconds(30);
    private static final int SMALL_STACK_BYTES = 200_000;

    interface Counter {
        void add();

        Promise<Integer> count();
    }

    private static final class Counting implements Counter {
        private int count;

        @Override
        public void add() {
            count++;
        }

        @Override
        public Promise<Integer> count() {
            return Promise.of(count);
        }
    }

    /** Calls, at the end of its stack and then from each frame further up, until a call gets through. */
    private static final class Deep {
        private final Runnable call;
        private boolean done;

        Deep(Runnable call) {
            this.call = call;
        }

        private void recurse() {
            try {
                recurse();
            } catch (StackOverflowError end) {
                if (!done) {
                    call.run();
                    done = true;
                }
            }
        }
    }

    private static void onASmallStack(Runnable task) throws InterruptedException {
        var failure = new AtomicReference<@Nullable Throwable>();
        var thread = new Thread(
                null,
                () -> {
                    try {
                        task.run();
                    } catch (Throwable thrown) {
                        failure.set(thrown);
                    }
                },
                "deep",
                SMALL_STACK_BYTES);
        thread.setDaemon(true);
        thread.start();
        thread.join();
        assertThat(failure.get()).isNull();
    }

    private static Thread threadOf(ActorSpace space) throws Exception {
        var thread = new Deferred<Thread>();
        space.execute(() -> thread.resolve(Thread.currentThread()));
        return thread.get(LONG);
    }

    private static void callWhileItSleeps(ActorSpace space, Counter counter, int rounds) throws Exception {
        Thread served = threadOf(space);
        space.execute(
                () -> { // what is used for the first time at the end of a stack, the machine never links
                    for (int call = 0; call < 3; call++) {
                        counter.add();
                    }
                });
        threadOf(space);
        assertThat(counter.count().get(LONG)).isPositive();
        int least = 0;
        for (int round = 0; round < rounds; round++) {
            while (served.getState() == Thread.State.RUNNABLE) {
                Thread.onSpinWait(); // until it sleeps
            }
            var deep = new Deep(counter::add);
            onASmallStack(deep::recurse);
            least += deep.done ? 1 : 0;
            assertThat(counter.count().get(LONG)).isGreaterThanOrEqualTo(least);
        }
        assertThat(least).isPositive();
    }

    @Test
    void call_atTheEndOfTheCallersStack_leavesTheSpaceServing() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("deep"))) {
            Counter counter = space.spawn(Counter.class, Counting::new);
            callWhileItSleeps(space, counter, 60);
        }
    }

    @Test
    void call_ofABoundedMailbox_atTheEndOfTheCallersStack_losesNoPlace() throws Exception {
        for (Overflow overflow : new Overflow[] {Overflow.REJECT, Overflow.DROP_OLDEST}) {
            var settings = SpaceSettings.named("deep-" + overflow).withOnDeadLetter(letter -> {});
            try (var space = ActorSpace.create(settings)) {
                Counter counter =
                        space.spawn(Counter.class, Counting::new, ActorSettings.DEFAULT.withMailbox(2, overflow));
                callWhileItSleeps(space, counter, 10);
            }
        }
    }

    @Test
    void await_atTheEndOfTheBodysStack_keepsTheBatonInOneHand() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("deep-body"))) {
            for (int round = 0; round < 2; round++) {
                var gate = new Deferred<Integer>(space);
                Promise<Boolean> body = space.sequential(() -> {
                    var deep = new Deep(gate::await);
                    deep.recurse();
                    return deep.done;
                });
                space.execute(() -> gate.resolve(1)); // when the body has given the space back
                assertThat(body.get(LONG)).isTrue();
                assertThat(space.sequential(() -> 7).get(LONG)).isEqualTo(7);
            }
        }
    }
}
