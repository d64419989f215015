package io.troupe.actor;

import static io.troupe.actor.Concurrently.LONG;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.catchThrowable;

import io.troupe.actor.ActorSettings.Overflow;
import java.time.Duration;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.Function;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/** Whatever one actor, handler or listener throws, the space runs all others, and the error is reported. */
@Tag("threads")
@Timeout(60)
class AnyThrowableTest {
    private final Queue<Throwable> reported = new ConcurrentLinkedQueue<>();

    enum Kind {
        OUT_OF_MEMORY(OutOfMemoryError::new),
        INTERNAL(InternalError::new),
        UNKNOWN(UnknownError::new),
        STACK_OVERFLOW(StackOverflowError::new),
        LINKAGE(NoClassDefFoundError::new),
        ASSERTION(AssertionError::new);

        private final Function<String, Error> constructor;

        Kind(Function<String, Error> constructor) {
            this.constructor = constructor;
        }

        void raise() {
            throw make();
        }

        Error make() {
            return constructor.apply("on purpose");
        }
    }

    /** Fails everywhere it can. */
    private static class Failing extends Doer {
        private final Kind kind;

        Failing(Kind kind) {
            this.kind = kind;
        }

        @Override
        protected void started() {
            context().after(Duration.ZERO, kind::raise);
            Promise.done().thenRun(kind::raise);
            kind.raise();
        }

        @Override
        protected void stopped() {
            kind.raise();
        }
    }

    private static Promise<Integer> answerOf(ActorSpace space) {
        return space.spawn(Doer.class, Doer::new).ask(steady -> Promise.of(1));
    }

    @ParameterizedTest
    @EnumSource(Kind.class)
    void error_thrownAnywhereInAnActor_isReported_andTheSpaceServesOthers(Kind kind) throws Exception {
        var settings = SpaceSettings.named("any-error")
                .withoutThread()
                .withClock(new ManualClock())
                .withOnError((where, error) -> reported.add(error));
        try (var space = ActorSpace.create(settings)) {
            Failing failing = space.spawn(Failing.class, () -> new Failing(kind));
            failing.run(me -> kind.raise());
            Promise<Integer> asked = failing.ask(me -> {
                throw kind.make();
            });
            space.execute(kind::raise);
            space.onIdle(kind::raise);
            space.runQueued();
            assertThat(asked.error()).isInstanceOf(kind.make().getClass());
            space.stop(failing);
            Promise<Integer> answer = answerOf(space);
            space.runQueued();
            assertThat(answer.getNow()).isEqualTo(1);
        }
        // started, timer, listener, message, task, idle action, stopped; an error of the virtual machine a second time
        // where it also rejects a promise
        assertThat(reported).hasSizeGreaterThanOrEqualTo(7).allMatch(kind.make().getClass()::isInstance);
    }

    @ParameterizedTest
    @EnumSource(Kind.class)
    void error_thrownByTheErrorHandlerToo_leavesTheSpaceServing(Kind kind) throws Exception {
        var settings = SpaceSettings.named("broken-handlers")
                .withOnError((where, error) -> {
                    reported.add(error);
                    kind.raise();
                })
                .withOnDeadLetter(letter -> kind.raise());
        try (var space = ActorSpace.create(settings)) {
            Failing failing = space.spawn(Failing.class, () -> new Failing(kind));
            failing.run(me -> kind.raise());
            space.stop(failing);
            failing.run(me -> kind.raise()); // a dead letter
            space.<Integer>deferred().reject(kind.make()); // without a listener
            assertThat(answerOf(space).get(LONG)).isEqualTo(1);
            assertThat(space.metrics().errors()).isPositive();
        }
        assertThat(reported).isNotEmpty();
    }

    /** Its registration cannot be removed. */
    private record StickyClock() implements Clock {
        @Override
        public long nanos() {
            return 0;
        }

        @Override
        public Runnable onMove(Runnable wake) {
            return () -> {
                throw new InternalError("on purpose");
            };
        }

        @Override
        public boolean runsByItself() {
            return false;
        }
    }

    @Test
    void error_whileTheSpaceEnds_leavesItClosed_andEveryRequestRejected() throws Exception {
        var settings = SpaceSettings.named("ends-badly")
                .withClock(new StickyClock())
                .withOnError((where, error) -> {
                    reported.add(error);
                    throw new OutOfMemoryError("on purpose");
                });
        var space = ActorSpace.create(settings);
        Doer steady = space.spawn(Doer.class, Doer::new);
        var waits = new Deferred<Promise<Integer>>();
        space.execute(() -> {
            space.close();
            waits.resolve(steady.ask(me -> Promise.of(1))); // behind the end
        });
        Promise<Integer> waiting = waits.get(LONG);
        assertThatThrownBy(() -> waiting.get(LONG)).isInstanceOf(ActorStoppedException.class);
        assertThat(space.close(LONG).requests()).isEqualTo(1);
        Promise<Integer> late = steady.ask(me -> Promise.of(1));
        assertThatThrownBy(() -> late.get(LONG)).isInstanceOf(ActorStoppedException.class);
        assertThat(reported).hasAtLeastOneElementOfType(InternalError.class);
    }

    // ---- a caller whose stack overflows within a call, as that of an error logger may, does not harm the space

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
        space.execute(
                () -> { // the JVM never links what is first used where the stack is exhausted
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
            least += callWhereTheStackEnds(counter::add) ? 1 : 0;
            assertThat(counter.count().get(LONG)).isGreaterThanOrEqualTo(least);
        }
        assertThat(least).isPositive();
    }

    @Test
    @Timeout(120)
    void call_atTheEndOfTheCallersStack_leavesTheSpaceServing() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("deep"))) {
            Counter counter = space.spawn(Counter.class, Counting::new);
            callWhileItSleeps(space, counter, 60);
        }
    }

    @Test
    @Timeout(120)
    void call_ofABoundedMailbox_atTheEndOfTheCallersStack_losesNoPlace() throws Exception {
        for (Overflow overflow : new Overflow[] {Overflow.REJECT, Overflow.DROP_OLDEST}) {
            var settings = SpaceSettings.named("deep-" + overflow).withOnDeadLetter(letter -> {});
            try (var space = ActorSpace.create(settings)) {
                Counter counter = space.spawn(
                        Counter.class, Counting::new, ActorSettings.defaults().withMailbox(2, overflow));
                callWhileItSleeps(space, counter, 10);
            }
        }
    }

    @Test
    @Timeout(120)
    void await_atTheEndOfTheBodysStack_keepsTheBatonInOneHand() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("deep-body"))) {
            for (int round = 0; round < 2; round++) {
                Deferred<Integer> gate = space.deferred();
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
    @Timeout(120)
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
    @Timeout(120)
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
