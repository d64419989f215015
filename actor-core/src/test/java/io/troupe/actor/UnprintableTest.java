package io.troupe.actor;

import static io.troupe.actor.Concurrently.LONG;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSettings.Overflow;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CancellationException;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.logging.Handler;
import java.util.logging.Level;
import java.util.logging.LogRecord;
import java.util.logging.Logger;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/** Whatever the texts of arguments, values and errors do, every promise is settled and every callback ended. */
@Timeout(60)
class UnprintableTest {
    private static final Duration SECOND = Duration.ofSeconds(1);
    private static final String SECRET = "hunter2";

    /** What {@code toString} does. */
    enum Kind {
        NULL {
            @Override
            @Nullable
            String text() {
                return null;
            }
        },
        THROWS {
            @Override
            String text() {
                throw new IllegalStateException("no text");
            }
        },
        OVERFLOWS {
            @Override
            String text() {
                return SECRET + text();
            }
        },
        HUGE {
            @Override
            String text() {
                return SECRET.repeat(10_000);
            }
        },
        NOT_LINKED {
            @Override
            String text() {
                throw new NoClassDefFoundError("on purpose");
            }
        };

        abstract @Nullable String text();
    }

    /** An argument without a text; counts who has asked for it. */
    private static final class Order {
        private final Kind kind;
        private final AtomicInteger asked = new AtomicInteger();

        Order(Kind kind) {
            this.kind = kind;
        }

        @Override
        @SuppressWarnings("NullAway")
        public String toString() {
            asked.incrementAndGet();
            return kind.text();
        }
    }

    private static final class Failure extends RuntimeException {
        private static final long serialVersionUID = 1L;

        private final transient Order order;

        Failure(Order order) {
            this.order = order;
        }

        @Override
        public String getMessage() {
            return order.toString();
        }

        @Override
        public String toString() {
            return order.toString();
        }
    }

    public interface Shop {
        Promise<String> open(Object order);

        Promise<String> buy(Object order);

        void note(Object order);

        void watch(Object order, Callback<String> progress);

        void fail();
    }

    private static class Corner extends Actor implements Shop {
        @Override
        public Promise<String> open(Object order) {
            return new Deferred<>();
        }

        @Override
        public Promise<String> buy(Object order) {
            return Promise.of("bought");
        }

        @Override
        public void note(Object order) {}

        @Override
        public void watch(Object order, Callback<String> progress) {}

        @Override
        public void fail() {
            throw new IllegalStateException("planned");
        }
    }

    private final ManualClock clock = new ManualClock();
    private final List<Throwable> errors = new ArrayList<>();
    private final List<DeadLetter> letters = new ArrayList<>();

    private final ActorSpace space = ActorSpace.create(SpaceSettings.named("mall")
            .withoutThread()
            .withClock(clock)
            .withOnError((where, error) -> errors.add(error))
            .withOnDeadLetter(letters::add));

    private Shop shop() {
        return shop(ActorSettings.defaults());
    }

    private Shop shop(ActorSettings settings) {
        Shop shop = space.spawn(Shop.class, Corner::new, settings);
        space.runQueued();
        return shop;
    }

    private void advance() {
        clock.advance(SECOND.multipliedBy(2));
        space.runQueued();
    }

    private Promise<String> inside(java.util.function.Supplier<Promise<String>> question) {
        var asked = new ArrayList<Promise<String>>();
        space.execute(() -> asked.add(question.get()));
        space.runQueued();
        return asked.getFirst();
    }

    @ParameterizedTest
    @EnumSource(Kind.class)
    void timeLimit_onACallWithoutAText_expires(Kind kind) {
        Shop shop = shop();
        var order = new Order(kind);
        Promise<String> outside = shop.open(order).orTimeout(SECOND);
        Promise<String> inside = inside(() -> shop.open(order).orTimeout(SECOND));
        Promise<String> instead = shop.open(order).completeOnTimeout("instead", SECOND);
        Promise<String> within = space.within(SECOND, () -> shop.open(order));
        Promise<String> stage = shop.open(order).thenApply(text -> text).orTimeout(SECOND);
        space.runQueued();
        advance();
        assertThat(List.of(outside, inside, within, stage))
                .allSatisfy(late -> assertThat(late.error()).isInstanceOf(TimeoutException.class));
        assertThat(outside.error()).hasMessageContaining("Shop.open(Object) of Shop#1");
        assertThat(instead.getNow()).isEqualTo("instead");
        assertThat(order.asked).hasValue(0);
    }

    @ParameterizedTest
    @EnumSource(Kind.class)
    void timeLimit_onSeveralRequests_rejectsThemAll(Kind kind) {
        Shop shop = shop();
        var asked = new ArrayList<Promise<String>>();
        Promise<String> whole = space.within(SECOND, () -> {
            asked.add(shop.open(new Order(kind)));
            asked.add(shop.open("bread"));
            return asked.getLast();
        });
        space.runQueued();
        advance();
        assertThat(asked)
                .hasSize(2)
                .allSatisfy(each -> assertThat(each.isRejected()).isTrue());
        assertThat(whole.error()).isInstanceOf(TimeoutException.class);
    }

    @ParameterizedTest
    @EnumSource(Kind.class)
    void stop_rejectsOpenAndLaterCalls_andEndsCallbacks(Kind kind) {
        Shop shop = shop();
        var order = new Order(kind);
        Promise<String> bad = shop.open(order);
        Promise<String> good = shop.open("bread");
        space.runQueued();
        space.stop(shop);
        Promise<String> late = shop.buy(order);
        var ends = new ArrayList<@Nullable Throwable>();
        shop.watch(order, (value, error) -> ends.add(error));
        Promise<ActorEnd> stopped = space.whenStopped(shop);
        space.runQueued();
        assertThat(List.of(bad, good, late))
                .allSatisfy(each -> assertThat(each.error()).isInstanceOf(ActorStoppedException.class));
        assertThat(stopped.isDone()).isTrue();
        assertThat(ends).singleElement().isInstanceOf(ActorStoppedException.class);
        assertThat(letters)
                .singleElement()
                .satisfies(letter -> assertThat(letter.arguments()).startsWith(order));
        assertThat(letters.getFirst())
                .hasToString("Shop.watch(Object, Callback) to Shop#1: the actor Shop#1 has stopped");
        assertThat(order.asked).hasValue(0);
    }

    @ParameterizedTest
    @EnumSource(Kind.class)
    void restart_withAnOpenCall_goesOn(Kind kind) {
        Shop shop = shop(ActorSettings.defaults().withSupervision(Supervision.restart(9, SECOND)));
        Promise<String> open = shop.open(new Order(kind));
        shop.fail();
        Promise<String> next = shop.buy("bread");
        space.runQueued();
        assertThat(open.error()).isInstanceOf(ActorStoppedException.class);
        assertThat(next.getNow()).isEqualTo("bought");
    }

    @ParameterizedTest
    @EnumSource(Kind.class)
    void close_rejectsOpenQueuedAndLaterCalls_andNoActorRunsAfterwards(Kind kind) {
        Shop first = shop();
        Shop second = shop();
        var order = new Order(kind);
        Promise<String> bad = first.open(order);
        Promise<String> good = second.open("bread");
        space.runQueued();
        var queued = new ArrayList<Promise<String>>();
        space.execute(() -> {
            space.close();
            queued.add(first.buy(order));
            first.note(order);
        });
        space.runQueued();
        Leftovers left = space.close(SECOND);
        Promise<String> late = second.buy(order);
        assertThat(List.of(bad, good, queued.getFirst(), late))
                .allSatisfy(each -> assertThat(each.error()).isInstanceOf(ActorStoppedException.class));
        assertThat(left).isEqualTo(new Leftovers(1, 1, 2, 0, 0, 0, left.examples()));
        assertThat(left.examples())
                .containsExactly(
                        "Shop.buy(Object) of Shop#1",
                        "Shop.note(Object) to Shop#1",
                        "Shop.open(Object) of Shop#1",
                        "Shop.open(Object) of Shop#2");
        assertThat(letters).hasSize(1);
        assertThat(errors).isEmpty();
        assertThat(order.asked).hasValue(0);
    }

    @ParameterizedTest
    @EnumSource(Kind.class)
    void otherEnds_ofACallWithoutAText_areRejections(Kind kind) {
        Shop small = shop(ActorSettings.defaults().withMailbox(1, Overflow.REJECT));
        var order = new Order(kind);
        Promise<String> cancelled = small.buy(order);
        Promise<String> refused = small.buy(order);
        cancelled.cancel();
        space.runQueued();
        assertThat(refused.error()).isInstanceOf(MailboxFullException.class);
        assertThat(cancelled.error()).isInstanceOf(CancellationException.class);
        Promise<String> given = small.open(order);
        Promise<String> limited = given.orTimeout(SECOND);
        clock.advance(SECOND.multipliedBy(2)); // before it is begun
        space.runQueued();
        assertThat(limited.error()).isInstanceOf(TimeoutException.class);
        assertThatThrownBy(() -> shop().open(order).get(Duration.ofMillis(1))).isInstanceOf(TimeoutException.class);
        assertThat(order.asked).hasValue(0);
    }

    @ParameterizedTest
    @EnumSource(Kind.class)
    void valueOrErrorWithoutAText_isPassedOn_andReported(Kind kind) {
        var value = new Order(kind);
        var error = new Failure(new Order(kind));
        assertThat(Promise.of(value).toString()).startsWith("promise, fulfilled with ");
        assertThat(space.<Order>deferred().thenApply(same -> same).toString()).isEqualTo("promise after promise");
        space.<Order>deferred().reject(error);
        space.execute(() -> {
            throw error;
        });
        space.runQueued();
        advance(); // a caller outside may register a listener a moment later
        assertThat(errors.size()).isEqualTo(2);
        assertThat(errors.stream().allMatch(each -> each == error)).isTrue();
    }

    @ParameterizedTest
    @EnumSource(Kind.class)
    void arguments_areLoggedAtDebugOnly_afterEverythingIsDone(Kind kind) {
        var logger = Logger.getLogger(ActorSpace.class.getName());
        var lines = new ArrayList<String>();
        var handler = new Handler() {
            @Override
            public void publish(LogRecord line) {
                lines.add(line.getMessage());
            }

            @Override
            public void flush() {}

            @Override
            public void close() {}
        };
        Level before = logger.getLevel();
        boolean parents = logger.getUseParentHandlers();
        try {
            logger.addHandler(handler);
            logger.setUseParentHandlers(false);
            rejectThree(kind, logger, before);
            assertThat(lines).isEmpty();
            rejectThree(kind, logger, Level.FINE);
            assertThat(lines).hasSize(3).allMatch(line -> line.contains(": its arguments were "));
            assertThat(lines.getFirst()).startsWith("Shop.open(Object), not answered in time");
            assertThat(lines.getLast()).endsWith(": its arguments were " + SECRET);
        } finally {
            logger.removeHandler(handler);
            logger.setUseParentHandlers(parents);
            logger.setLevel(before);
        }
    }

    /** A call that is not answered in time, one that was open when its actor stopped, and one that came later. */
    private void rejectThree(Kind kind, Logger logger, @Nullable Level level) {
        logger.setLevel(level);
        Shop shop = shop();
        Promise<String> timed = shop.open(new Order(kind)).orTimeout(SECOND);
        space.runQueued();
        advance();
        space.stop(shop);
        Promise<String> late = shop.buy(SECRET);
        space.runQueued();
        assertThat(timed.error()).isInstanceOf(TimeoutException.class);
        assertThat(late.error()).isInstanceOf(ActorStoppedException.class);
    }

    @Test
    @Tag("threads")
    void timeLimitsOfOthers_doNotWaitForTheTextOfAnArgument() throws Exception {
        var locked = new Object();
        var begun = new CountDownLatch(1);
        var end = new CountDownLatch(1);
        Object argument = new Object() {
            @Override
            public String toString() {
                synchronized (locked) {
                    return "at last";
                }
            }
        };
        try (var threaded = ActorSpace.create(SpaceSettings.named("busy").withoutStallLimit())) {
            Doer doer = threaded.spawn(Doer.class, Doer::new);
            doer.run(me -> {
                synchronized (locked) {
                    begun.countDown();
                    Concurrently.await(end);
                }
            });
            Shop shop = threaded.spawn(Shop.class, Corner::new);
            Promise<String> limited = shop.buy(argument).orTimeout(Duration.ofMillis(20));
            Promise<Integer> other = threaded.<Integer>deferred().orTimeout(Duration.ofMillis(40));
            assertThat(begun.await(1, TimeUnit.MINUTES)).isTrue();
            try {
                assertThatThrownBy(() -> limited.get(LONG)).hasMessageContaining("Shop.buy(Object)");
                assertThatThrownBy(() -> other.get(LONG)).hasMessageContaining("within PT0.04S");
            } finally {
                end.countDown();
            }
        }
    }

    @Test
    void callbacks_ofOneCall_endEachWhateverTheOthersDo() {
        interface Source {
            void feed(Callback<String> first, Callback<String> second);
        }
        Source source = space.spawn(Source.class, () -> (first, second) -> {});
        space.stop(source);
        var ends = new ArrayList<@Nullable Throwable>();
        source.feed(
                new Callback<>() {
                    @Override
                    public void accept(@Nullable String value, @Nullable Throwable error) {}

                    @Override
                    public boolean isCancelled() {
                        throw new IllegalStateException("a broken reader");
                    }
                },
                (value, error) -> ends.add(error));
        space.runQueued();
        assertThat(ends).singleElement().isInstanceOf(ActorStoppedException.class);
        assertThat(errors).singleElement().hasFieldOrPropertyWithValue("message", "a broken reader");
    }
}
