package io.troupe.actor;

import static io.troupe.actor.Concurrently.LONG;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.catchThrowable;

import io.troupe.actor.MailboxBound.Overflow;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.util.concurrent.atomic.AtomicReference;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** A caller whose stack overflows within a call, as that of an error logger may, does not harm the space. */
@Tag("threads")
@Timeout(120)
class EndOfTheStackTest {
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

    /** Calls where its stack is exhausted, and then from each frame further up until a call succeeds. */
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

    /** Calls where a small stack is exhausted; returns whether a call succeeded. */
    private static boolean callWhereTheStackEnds(Runnable call) throws InterruptedException {
        var failure = new AtomicReference<@Nullable Throwable>();
        var deep = new Deep(call);
        Runnable task = () -> failure.set(catchThrowable(deep::recurse));
        var thread = new Thread(null, task, "deep", SMALL_STACK_BYTES);
        thread.setDaemon(true);
        thread.start();
        thread.join();
        assertThat(failure.get()).isNull();
        return deep.done;
    }

    private static Thread threadOf(ActorSpace space) throws Exception {
        var thread = new Deferred<Thread>();
        space.execute(() -> thread.resolve(Thread.currentThread()));
        return thread.get(LONG);
    }

    private static void callWhileItSleeps(ActorSpace space, Counter counter, int rounds) throws Exception {
        Thread served = threadOf(space);
        for (int call = 0; call < 3; call++) { // the JVM never links what is first used where the stack is exhausted
            space.execute(counter::add);
        }
        threadOf(space);
        assertThat(counter.count().get(LONG)).isPositive();
        int least = 0;
        for (int round = 0; round < rounds; round++) {
            while (served.getState() == Thread.State.RUNNABLE) {
                Thread.onSpinWait(); // until it sleeps
            }
            least += callWhereTheStackEnds(counter::add) ? 1 : 0;
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
                space.execute(() -> gate.resolve(1)); // when the body has returned control to the space
                assertThat(body.get(LONG)).isTrue();
                assertThat(space.sequential(() -> 7).get(LONG)).isEqualTo(7);
            }
        }
    }

    private static ActorSpace quietSpace(String name) {
        return ActorSpace.create(
                SpaceSettings.named(name).withOnError((where, error) -> {}).withOnDeadLetter(letter -> {}));
    }

    @Test
    void callOfAClosedSpace_atTheEndOfTheCallersStack_leavesItRejectingTheNext() throws Exception {
        var space = quietSpace("closed");
        Counter counter = space.spawn(Counter.class, Counting::new);
        assertThat(counter.count().get(LONG)).isZero();
        space.close(LONG);
        assertThat(counter.count().isDone()).isTrue(); // and everything is linked
        for (int round = 0; round < 80; round++) {
            assertThat(callWhereTheStackEnds(counter::count)).isTrue();
            Promise<Integer> next = counter.count();
            assertThat(next.isDone())
                    .as("the request of the next caller, in round %s", round)
                    .isTrue();
            assertThat(next.error()).isInstanceOf(ActorStoppedException.class);
        }
    }

    @Test
    void queueingInAClosedSpace_atTheEndOfTheCallersStack_throwsOnlyIfNothingWasQueued() throws Exception {
        var space = quietSpace("closed-too");
        space.close(LONG);
        int most = 4_000;
        var refusals = new int[most];
        var returned = new boolean[most];
        var entries = IntStream.range(0, most)
                .mapToObj(number -> new Entry(() -> {}, () -> refusals[number]++))
                .toArray(Entry[]::new);
        space.home.enqueueMessage(entries[0]);
        assertThat(refusals[0]).isEqualTo(1);
        var attempts = new int[] {1};
        boolean done = callWhereTheStackEnds(() -> {
            int attempt = attempts[0]++;
            space.home.enqueueMessage(entries[attempt]);
            returned[attempt] = true;
        });
        assertThat(done).isTrue();
        assertThat(attempts[0]).isGreaterThan(2); // else the stack did not overflow within a call
        space.home.enqueueMessage(new Entry(() -> {}, () -> {})); // finds what was left
        for (int attempt = 1; attempt < attempts[0]; attempt++) {
            assertThat(refusals[attempt]).as("attempt %s", attempt).isEqualTo(returned[attempt] ? 1 : 0);
        }
    }
}
