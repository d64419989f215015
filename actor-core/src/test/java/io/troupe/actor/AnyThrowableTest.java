package io.troupe.actor;

import static io.troupe.actor.Concurrently.LONG;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.Clock;
import io.troupe.actor.time.ManualClock;
import java.time.Duration;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.function.Function;
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

        Error make() {
            return constructor.apply("on purpose");
        }
    }

    /** Fails everywhere it can. */
    public static class Failing extends Actor {
        private final Kind kind;

        Failing(Kind kind) {
            this.kind = kind;
        }

        @Override
        protected void started() {
            after(Duration.ZERO, () -> {
                throw kind.make();
            });
            Promise.done().thenRun(() -> {
                throw kind.make();
            });
            throw kind.make();
        }

        public void fail() {
            throw kind.make();
        }

        public Promise<Integer> failRequest() {
            throw kind.make();
        }

        @Override
        protected void stopped() {
            throw kind.make();
        }
    }

    private static Promise<Integer> answerOf(ActorSpace space) {
        return space.spawn(Doer.class, Doer::new).ask(steady -> Promise.of(1));
    }

    @ParameterizedTest
    @EnumSource(Kind.class)
    void error_thrownAnywhereInAnActor_isReported_andTheSpaceServesOthers(Kind kind) throws Exception {
        var settings = SpaceSettings.named("any-error")
                .withHandCrank()
                .withClock(new ManualClock())
                .withOnError((where, error) -> reported.add(error));
        try (var space = ActorSpace.create(settings)) {
            Failing failing = space.spawn(Failing.class, () -> new Failing(kind));
            failing.fail();
            Promise<Integer> asked = failing.failRequest();
            space.execute(() -> {
                throw kind.make();
            });
            space.onIdle(() -> {
                throw kind.make();
            });
            space.crank();
            assertThat(asked.error()).isInstanceOf(kind.make().getClass());
            space.stop(failing);
            Promise<Integer> answer = answerOf(space);
            space.crank();
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
                    throw kind.make();
                })
                .withOnDeadLetter(letter -> {
                    throw kind.make();
                });
        try (var space = ActorSpace.create(settings)) {
            Failing failing = space.spawn(Failing.class, () -> new Failing(kind));
            failing.fail();
            space.stop(failing);
            failing.fail(); // a dead letter
            new Deferred<Integer>(space).reject(kind.make()); // without a listener
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
}
