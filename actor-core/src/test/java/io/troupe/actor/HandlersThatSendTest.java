package io.troupe.actor;

import static io.troupe.actor.Concurrently.LONG;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSettings.Overflow;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.Consumer;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** A handler may send to the space that calls it: it does not receive what it has caused itself, so that this ends. */
@Timeout(60)
class HandlersThatSendTest {
    private static final Duration SECOND = Duration.ofSeconds(1);
    private static final int MANY = 100;

    interface Monitor {
        void note(Object what);

        Promise<Integer> count();
    }

    interface Worker {
        void work();
    }

    private static final class Counting extends Actor implements Monitor {
        private int count;

        @Override
        public void note(Object what) {
            count++;
        }

        @Override
        public Promise<Integer> count() {
            return Promise.of(count);
        }
    }

    private final AtomicReference<Monitor> monitor = new AtomicReference<>();
    private final AtomicInteger told = new AtomicInteger();
    private final List<Throwable> errors = new ArrayList<>();

    private void tell(Object what) {
        told.incrementAndGet();
        monitor.get().note(what);
    }

    private static SpaceSettings settings() {
        return SpaceSettings.named("monitored").withoutThread();
    }

    private ActorSpace open(SpaceSettings settings) {
        var space = ActorSpace.create(settings);
        monitor.set(space.spawn(Monitor.class, Counting::new));
        return space;
    }

    private static Worker stopped(ActorSpace space) {
        Worker worker = space.spawn(Worker.class, () -> () -> {});
        space.stop(worker);
        return worker;
    }

    private static void times(int count, Runnable action) {
        for (int i = 0; i < count; i++) {
            action.run();
        }
    }

    /** Runs the space; more passes than all tests need, and fewer than one without end. */
    private static void assertQuiet(ActorSpace space) {
        assertThat(space.isQuiet()).isTrue();
    }

    @Test
    void deadLetters_areToldToAMonitor() throws Exception {
        var space = open(settings().withOnDeadLetter(this::tell));
        Worker worker = stopped(space);
        times(MANY, worker::work);
        Promise<Integer> noted =
                space.spawn(Doer.class, Doer::new).ask(me -> monitor.get().count());
        space.runQueued();
        assertThat(noted.getNow()).isEqualTo(MANY);
        assertThat(told).hasValue(MANY);
        space.close();
    }

    @Test
    void deadLetters_ofAMonitorThatHasStopped_areOnlyCounted() {
        var space = open(settings().withOnDeadLetter(this::tell));
        Worker worker = stopped(space);
        space.stop(monitor.get());
        times(MANY, worker::work);
        space.runQueued();
        assertQuiet(space);
        assertThat(told).hasValue(MANY);
        assertThat(space.metrics().deadLetters()).isEqualTo(2 * MANY);
        space.close();
    }

    @Test
    void deadLetters_ofAMonitorThatPassesThemOn_areOnlyCounted() {
        var space = ActorSpace.create(settings().withOnDeadLetter(this::tell));
        Worker worker = stopped(space);
        monitor.set(space.spawn(Monitor.class, () -> new Monitor() {
            @Override
            public void note(Object what) {
                worker.work(); // a dead letter, too
            }

            @Override
            public Promise<Integer> count() {
                return Promise.of(0);
            }
        }));
        times(MANY, worker::work);
        space.runQueued();
        assertThat(told).hasValue(MANY);
        assertThat(space.metrics().deadLetters()).isEqualTo(2 * MANY);
        space.close();
    }

    @Test
    void deadLetters_ofTwoSpacesThatTellEachOther_end() {
        var first = new AtomicReference<Worker>();
        var second = new AtomicReference<Worker>();
        var one = ActorSpace.create(
                settings().withOnDeadLetter(letter -> second.get().work()));
        var other = ActorSpace.create(settings().withOnDeadLetter(letter -> {
            told.incrementAndGet();
            first.get().work();
        }));
        first.set(stopped(one));
        second.set(stopped(other));
        one.runQueued();
        other.runQueued();
        one.close(SECOND);
        other.close(SECOND);
        first.get().work();
        assertThat(told).hasValue(1);
        assertThat(one.metrics().deadLetters()).isEqualTo(2);
    }

    @Test
    @Tag("threads")
    void deadLetters_ofTwoSpacesWithThreads_end() throws Exception {
        var first = new AtomicReference<Worker>();
        var second = new AtomicReference<Worker>();
        var one = ActorSpace.create(SpaceSettings.named("one")
                .withOnDeadLetter(letter -> second.get().work()));
        var other = ActorSpace.create(SpaceSettings.named("other").withOnDeadLetter(letter -> {
            told.incrementAndGet();
            first.get().work();
        }));
        try (one;
                other) {
            first.set(stopped(one));
            second.set(stopped(other));
            one.whenStopped(first.get()).get(LONG);
            other.whenStopped(second.get()).get(LONG);
            first.get().work();
            for (int round = 0; round < 10; round++) { // a lap of a letter takes one answer of each space
                one.spawn(Doer.class, Doer::new).ask(me -> Promise.of(1)).get(LONG);
                other.spawn(Doer.class, Doer::new).ask(me -> Promise.of(1)).get(LONG);
            }
            assertThat(told).hasValue(0);
            assertThat(other.metrics().deadLetters()).isEqualTo(1);
        }
    }

    @Test
    void fullMailboxOfAMonitor_isToldOnce() {
        var space = ActorSpace.create(settings().withOnDeadLetter(this::tell));
        monitor.set(space.spawn(
                Monitor.class, Counting::new, ActorSettings.defaults().withMailbox(1, Overflow.REJECT)));
        monitor.get().note("1");
        monitor.get().note("2");
        assertThat(told).hasValue(1);
        assertThat(space.metrics().deadLetters()).isEqualTo(2);
        space.close();
    }

    /** Closes a space that has calls left, with a handler that does something at each of them. */
    private void closeWithCallsLeft(Consumer<ActorSpace> atEach) {
        var space = new AtomicReference<ActorSpace>();
        space.set(open(settings()
                .withOnDeadLetter(letter -> {
                    told.incrementAndGet();
                    atEach.accept(space.get());
                })
                .withOnError((where, error) -> errors.add(error))));
        Worker worker = space.get().spawn(Worker.class, () -> () -> {});
        space.get().execute(() -> {
            space.get().close();
            times(MANY, worker::work);
        });
        space.get().runQueued();
        assertThat(space.get().close(SECOND).messages()).isGreaterThanOrEqualTo(MANY);
        assertQuiet(space.get());
        int before = told.get();
        worker.work();
        assertThat(told).hasValue(before + 1);
    }

    @Test
    void close_withADeadLetterHandlerThatCalls_ends() {
        closeWithCallsLeft(space -> monitor.get().note("late"));
        assertThat(told).hasValue(MANY + 1);
        assertThat(errors).isEmpty();
    }

    @Test
    void close_withADeadLetterHandlerThatAsks_ends() {
        closeWithCallsLeft(space -> monitor.get().count());
        assertThat(told).hasValue(MANY + 1);
        assertThat(errors).isEmpty();
    }

    @Test
    void close_withADeadLetterHandlerThatExecutes_ends() {
        closeWithCallsLeft(space -> {
            if (ActorSpace.current() == space) {
                space.execute(() -> told.addAndGet(1_000_000));
            }
        });
        assertThat(told).hasValueLessThan(1_000_000);
        assertThat(errors).isEmpty();
    }

    private void again() {
        Promise.done().thenRun(this::again);
    }

    @Test
    void close_withListenersWithoutEnd_ends_andSaysSo() {
        var space = ActorSpace.create(settings().withOnError((where, error) -> errors.add(error)));
        Deferred<Integer> opened = space.deferred();
        opened.thenRun(this::again);
        space.execute(() -> {
            space.close();
            opened.resolve(1);
        });
        space.runQueued();
        assertThat(space.close(SECOND)).isNotNull();
        assertThat(errors).hasSize(1);
        assertThat(errors.getFirst()).hasMessageContaining("comes to no end");
    }

    @Test
    void errorHandler_thatCallsAnActorWhichFails_isNotToldOfThat() {
        var space = ActorSpace.create(settings().withOnError((where, error) -> {
            errors.add(error);
            monitor.get().note(error);
        }));
        monitor.set(space.spawn(Monitor.class, () -> new Monitor() {
            @Override
            public void note(Object what) {
                throw new IllegalStateException("the log is full");
            }

            @Override
            public Promise<Integer> count() {
                return Promise.of(0);
            }
        }));
        space.execute(() -> {
            throw new IllegalArgumentException("first");
        });
        space.runQueued();
        assertThat(errors).extracting(Throwable::getMessage).containsExactly("first");
        assertThat(space.metrics().errors()).isEqualTo(2);
        space.close();
    }

    @Test
    void errorHandler_thatAsksAStoppedActor_isNotToldOfThat() {
        var space = open(settings().withOnError((where, error) -> {
            errors.add(error);
            monitor.get().count();
        }));
        space.stop(monitor.get());
        space.execute(() -> {
            throw new IllegalArgumentException("first");
        });
        space.runQueued();
        assertThat(errors).extracting(Throwable::getMessage).containsExactly("first");
        assertThat(space.metrics().errors()).isEqualTo(2);
        space.close();
    }

    @Test
    void errorHandler_thatExecutesWhatFails_isNotToldOfThat() {
        var space = new AtomicReference<ActorSpace>();
        space.set(ActorSpace.create(settings().withOnError((where, error) -> {
            errors.add(error);
            space.get().execute(() -> {
                throw new IllegalStateException("again");
            });
        })));
        space.get().execute(() -> {
            throw new IllegalArgumentException("first");
        });
        space.get().runQueued();
        assertThat(errors).hasSize(1);
        space.get().close();
    }

    @Test
    void observer_thatCalls_doesNotObserveThat() {
        var calls = new ArrayList<String>();
        var space = open(settings().withCallObserver(new CallObserver() {
            @Override
            public void called(Party from, Party to, Call call) {
                calls.add(call.method());
                monitor.get().note(call.method());
            }

            @Override
            public void dropped(Party actor, Call call) {
                monitor.get().note(call.method());
            }
        }));
        Worker worker = stopped(space);
        worker.work();
        space.stop(monitor.get());
        worker.work();
        space.runQueued();
        assertThat(calls).containsExactly("work", "work");
        space.close();
        assertQuiet(space);
    }

    @Test
    void handler_leavesNoMarkBehind() {
        var space = open(settings().withOnDeadLetter(this::tell));
        Worker worker = stopped(space);
        worker.work();
        space.runQueued();
        worker.work();
        space.runQueued();
        assertThat(told).hasValue(2);
        space.close();
        worker.work();
        worker.work();
        assertThat(told).hasValue(4);
    }
}
