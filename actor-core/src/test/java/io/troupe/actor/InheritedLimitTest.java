package io.troupe.actor;

import static io.troupe.actor.Concurrently.await;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSettings.Overflow;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.concurrent.CancellationException;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeoutException;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The time limit of a question is that of the questions that are asked to answer it. */
class InheritedLimitTest extends InTestSpace {
    private static final Duration LIMIT = Duration.ofSeconds(2);
    private static final Duration SECOND = Duration.ofSeconds(1);
    private static final Duration LONG = Duration.ofSeconds(30);

    private final Doer shop = test.spawn(Doer.class, Doer::new, ActorSettings.named("shop"));
    private final Doer store = test.spawn(Doer.class, Doer::new, ActorSettings.named("store"));

    private static Promise<@Nullable Duration> left() {
        return Promise.of(ActorSpace.timeLeft());
    }

    /** A question that is never answered. */
    private static Promise<String> never() {
        return new Deferred<>();
    }

    private <T extends @Nullable Object> Promise<T> within(Supplier<Promise<T>> question) {
        return test.space().within(LIMIT, question);
    }

    @Test
    void limit_isInheritedByTurns_theirListeners_andTheQuestionsOfThese() {
        Promise<@Nullable Duration> deep =
                within(() -> shop.ask(me -> store.ask(again -> left()).thenCompose(first -> {
                    log.add("listener " + ActorSpace.timeLeft());
                    return store.ask(again -> left());
                })));
        assertThat(test.get(deep)).isEqualTo(LIMIT);
        assertThat(log).containsExactly("listener " + LIMIT);
        assertThat(ActorSpace.timeLeft()).isNull();
        Promise<@Nullable Duration> free = shop.ask(me -> store.ask(again -> left()));
        assertThat(values(free)).containsOnlyNulls();
    }

    @Test
    void limit_isNotInheritedByMessagesTimersAndTasks() {
        test.get(within(() -> shop.ask(me -> {
            store.run(other -> log.add("message " + ActorSpace.timeLeft()));
            me.context().after(Duration.ZERO, () -> log.add("timer " + ActorSpace.timeLeft()));
            me.context().space().execute(() -> log.add("task " + ActorSpace.timeLeft()));
            return Promise.done();
        })));
        test.runQueued();
        assertThat(log).containsExactlyInAnyOrder("message null", "timer null", "task null");
    }

    @Test
    void questionsWithoutAnswer_areRejectedTogether_andThoseThatWaitAreNotBegun() {
        List<Promise<String>> asked = new ArrayList<>();
        Promise<String> answer = within(() -> shop.ask(me -> {
            asked.add(store.ask(other -> never()));
            store.run(other -> {
                other.context().hold();
                other.context().after(LIMIT.multipliedBy(2), other.context()::release);
            });
            asked.add(store.ask(other -> {
                log.add("begun");
                return Promise.of("too late");
            }));
            asked.getLast().exceptionally(late -> "");
            return asked.getFirst();
        }));
        test.advance(LIMIT.minusNanos(1));
        assertThat(answer.isDone()).isFalse();
        test.advance(Duration.ofNanos(1));
        assertThat(test.error(answer))
                .isInstanceOf(TimeoutException.class)
                .hasMessageStartingWith("no answer to test-space within PT2S from Doer.ask(");
        assertThat(asked)
                .allSatisfy(each -> assertThat(test.error(each))
                        .isInstanceOf(TimeoutException.class)
                        .hasMessageContaining("no answer to shop within PT2S from Doer.ask(")
                        .hasMessageContaining(" of store"));
        test.advance(LIMIT);
        assertThat(log).isEmpty();
        assertThat(test.space().metrics().expired()).isEqualTo(3);
        assertThat(test.space().metrics().abandoned()).isEqualTo(1);
        assertThat(test.space().metrics().timers()).isZero();
    }

    @Test
    void answerInTime_leavesNoTimer() {
        Promise<String> answer = within(() -> shop.ask(me -> store.ask(other -> Promise.of("lamp"))));
        assertThat(test.get(answer)).isEqualTo("lamp");
        assertThat(test.space().metrics().timers()).isZero();
        test.advance(LIMIT);
        assertThat(test.space().metrics().expired()).isZero();
    }

    @Test
    void manyQuestionsOfOneLimit_costOneTimer_andTheAnsweredOnesAreReleased() {
        Promise<String> answer = within(() -> shop.ask(me -> {
            for (int question = 0; question < 1_000; question++) {
                store.ask(other -> Promise.of("lamp"));
            }
            return never();
        }));
        test.runQueued();
        assertThat(test.space().metrics().timers()).isEqualTo(1);
        test.advance(LIMIT);
        assertThat(test.error(answer)).isInstanceOf(TimeoutException.class);
        assertThat(test.space().metrics().expired()).isEqualTo(1);
    }

    @Test
    void limitWithinAnother_isTheShorterOne() {
        Promise<@Nullable Duration> shorter =
                within(() -> shop.ask(me -> me.context().space().within(SECOND, () -> store.ask(it -> left()))));
        Promise<@Nullable Duration> longer =
                within(() -> shop.ask(me -> me.context().space().within(LONG, () -> store.ask(it -> left()))));
        assertThat(values(shorter, longer)).containsExactly(SECOND, LIMIT);
        Promise<@Nullable Duration> later = within(() -> shop.ask(me -> test.space()
                .delay(SECOND)
                .thenCompose(over -> me.context().space().within(LONG, () -> store.ask(it -> left())))));
        test.advance(SECOND);
        assertThat(test.get(later)).isEqualTo(LIMIT.minus(SECOND));
    }

    @Test
    void functionThatThrowsOrAnswersNothing_orSomethingElse_isLimitedAllTheSame() {
        assertThat(test.error(within(() -> {
                    throw new IllegalStateException("broken");
                })))
                .hasMessage("broken");
        Promise<String> foreign = within(InheritedLimitTest::never);
        test.advance(LIMIT);
        assertThat(test.error(foreign)).isInstanceOf(TimeoutException.class);
    }

    @Test
    void functionThatWaitsForNoRequest_namesWhoHasAsked() {
        Promise<String> byTheShop = shop.ask(me -> within(InheritedLimitTest::never));
        test.advance(LIMIT);
        assertThat(test.error(byTheShop))
                .isInstanceOf(TimeoutException.class)
                .hasMessage("no answer to shop within PT2S: the promise of the function is still pending, and it waits"
                        + " for no request to an actor");
    }

    @Test
    void calledOutside_timeInTheQueueCounts_andTheFunctionIsNotCalledTooLate() {
        test.clock().advance(SECOND);
        Promise<String> answer = within(() -> {
            log.add("asked");
            return never();
        });
        test.clock().advance(LIMIT);
        test.runQueued();
        assertThat(test.error(answer)).isInstanceOf(TimeoutException.class);
        assertThat(log).isEmpty();
    }

    @Test
    void boundedMailboxAndQuota_keepTheLimitWithItsCall() {
        var settings = SpaceSettings.named("other")
                .withClock(test.clock())
                .withoutThread()
                .withActorQuota(1);
        var other = ActorSpace.create(settings);
        Doer quoted = other.spawn(Doer.class, Doer::new);
        Doer bounded =
                other.spawn(Doer.class, Doer::new, ActorSettings.defaults().withMailbox(2, Overflow.DROP_OLDEST));
        List<Promise<@Nullable Duration>> answers = new ArrayList<>();
        for (Doer each : List.of(quoted, bounded)) {
            answers.add(each.ask(me -> left()));
            answers.add(other.within(LIMIT, () -> each.ask(me -> left())));
        }
        other.runQueued();
        assertThat(answers).extracting(Promise::getNow).containsExactly(null, LIMIT, null, LIMIT);
        other.close();
    }

    @Test
    void limit_goesAlongWithTheContextOfACaller() {
        var user = new ThreadLocal<@Nullable String>();
        var other = ActorSpace.create(SpaceSettings.named("other")
                .withClock(test.clock())
                .withoutThread()
                .withContext(new TurnContext<String>() {
                    @Override
                    public @Nullable String capture() {
                        return user.get();
                    }

                    @Override
                    public Runnable restore(String captured) {
                        user.set(captured);
                        return user::remove;
                    }
                }));
        Doer far = other.spawn(Doer.class, Doer::new);
        user.set("ann");
        Promise<String> answer = within(() -> far.ask(me -> Promise.of(user.get() + " has " + ActorSpace.timeLeft())));
        test.runQueued();
        other.runQueued();
        user.remove();
        assertThat(test.get(answer)).isEqualTo("ann has " + LIMIT);
        other.close();
    }

    @Test
    void questionsToAnotherSpace_areLimitedByTheClockOfTheFirst() {
        var clock = new ManualClock();
        clock.advance(LONG);
        var other =
                ActorSpace.create(SpaceSettings.named("other").withClock(clock).withoutThread());
        Doer far = other.spawn(Doer.class, Doer::new, ActorSettings.named("far"));
        List<Promise<String>> asked = new ArrayList<>();
        Promise<@Nullable Duration> back = within(() -> far.ask(me -> {
            asked.add(far.ask(again -> never()));
            asked.getFirst().exceptionally(late -> "");
            return store.ask(here -> left());
        }));
        test.runQueued();
        other.runQueued();
        assertThat(test.get(back)).isEqualTo(LIMIT);
        clock.advance(LONG);
        other.runQueued();
        assertThat(asked.getFirst().isDone()).isFalse();
        test.advance(LIMIT);
        other.runQueued();
        assertThat(asked.getFirst().error())
                .isInstanceOf(TimeoutException.class)
                .hasMessageContaining("no answer to far within PT2S from Doer.ask(");
        other.close();
    }

    @Test
    void requestWhoseTurnComesAfterTheLimit_isNotBegun_evenIfTheTimerIsLate() {
        var other = ActorSpace.create(
                SpaceSettings.named("other").withClock(test.clock()).withoutThread());
        Doer far = other.spawn(Doer.class, Doer::new);
        Promise<String> answer = within(() -> far.ask(me -> {
            log.add("begun");
            return Promise.of("too late");
        }));
        test.runQueued();
        test.clock().advance(LIMIT);
        other.runQueued(); // before the space with the timer
        assertThat(test.error(answer)).isInstanceOf(TimeoutException.class);
        assertThat(log).isEmpty();
        assertThat(other.metrics().abandoned()).isEqualTo(1);
        other.close();
    }

    @Test
    void stopOfTheAskedActor_rejectsAsEver_andClosedSpaceCancels() {
        Promise<String> answer = within(() -> shop.ask(me -> store.ask(other -> never())));
        test.runQueued();
        stop(store);
        assertThat(test.error(answer)).isInstanceOf(ActorStoppedException.class);
        var closing = ActorSpace.create(SpaceSettings.named("closing").withoutThread());
        Promise<String> late = closing.within(LIMIT, InheritedLimitTest::never);
        closing.close();
        assertThat(late.error()).isInstanceOf(CancellationException.class);
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void sequentialBody_hasTheLimit_alsoAfterItHasWaited_andOthersDoNotGetIt() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("limited"))) {
            Doer actor = space.spawn(Doer.class, Doer::new);
            Deferred<Boolean> gate = space.deferred();
            Promise<Boolean> answer = space.within(
                    LONG,
                    () -> space.sequential(() -> {
                        boolean before = ActorSpace.timeLeft() != null;
                        gate.await();
                        return before && ActorSpace.timeLeft() != null;
                    }));
            Promise<@Nullable Duration> between = actor.ask(me -> left());
            assertThat(between.get(LONG)).isNull();
            gate.resolve(true);
            assertThat(answer.get(LONG)).isTrue();
            assertThat(actor.ask(me -> left()).get(LONG)).isNull();
        }
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void questionsAmongThreads_haveTheLimit_andThoseOfOthersDoNot() throws Exception {
        try (var first = ActorSpace.create(SpaceSettings.named("first"));
                var second = ActorSpace.create(SpaceSettings.named("second"))) {
            Doer here = first.spawn(Doer.class, Doer::new);
            Doer there = second.spawn(Doer.class, Doer::new);
            List<Promise<Boolean>> limited = new ArrayList<>();
            List<Promise<Boolean>> free = new ArrayList<>();
            for (int round = 0; round < 1_000; round++) {
                limited.add(first.within(LONG, () -> here.ask(me -> there.ask(it -> here.ask(back -> isLimited())))));
                free.add(here.ask(me -> there.ask(it -> here.ask(back -> isLimited()))));
            }
            assertThat(Promise.all(limited).get(LONG)).containsOnly(true);
            assertThat(Promise.all(free).get(LONG)).containsOnly(false);
        }
    }

    private static Promise<Boolean> isLimited() {
        return Promise.of(ActorSpace.timeLeft() != null);
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void stalledSpace_doesNotKeepACallerOutsideWaiting() throws Exception {
        var release = new CountDownLatch(1);
        try (var space = ActorSpace.create(SpaceSettings.named("stalled").withoutStallLimit())) {
            space.execute(() -> await(release));
            Promise<String> answer = space.within(Duration.ofMillis(10), InheritedLimitTest::never);
            assertThat(answer.handle((value, error) -> error).toCompletableFuture())
                    .isNotNull();
            while (!answer.isDone()) {
                Thread.onSpinWait();
            }
            assertThat(answer.error()).isInstanceOf(TimeoutException.class);
            release.countDown();
        }
    }

    /** A question asks others, to a random depth, with shorter and longer limits on the way. */
    @Test
    void randomQuestions_haveTheShortestLimitOfTheirCallers() {
        for (long seed = 0; seed < 200; seed++) {
            var random = new Random(seed);
            Duration first = Duration.ofMillis(1 + random.nextInt(100));
            Promise<Boolean> answer = test.space().within(first, () -> step(random, first, 8));
            assertThat(test.get(answer)).as("seed %s", seed).isTrue();
            assertThat(test.space().metrics().timers()).as("seed %s", seed).isZero();
        }
    }

    private Promise<Boolean> step(Random random, Duration expected, int depth) {
        if (!expected.equals(ActorSpace.timeLeft())) {
            return Promise.of(false);
        }
        if (depth == 0) {
            return Promise.of(true);
        }
        return switch (random.nextInt(4)) {
            case 0 -> shop.ask(me -> step(random, expected, depth - 1));
            case 1 -> store.ask(me -> Promise.done()).thenCompose(done -> step(random, expected, depth - 1));
            case 2 -> {
                Duration other = Duration.ofMillis(1 + random.nextInt(100));
                Duration shorter = other.compareTo(expected) < 0 ? other : expected;
                yield test.space().within(other, () -> step(random, shorter, depth - 1));
            }
            default ->
                shop.ask(me -> Promise.all(
                                List.of(step(random, expected, depth / 2), step(random, expected, depth / 2)))
                        .thenApply(both -> both.get(0) && both.get(1)));
        };
    }
}
