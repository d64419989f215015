package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.NoSuchElementException;
import java.util.concurrent.CancellationException;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.TimeoutException;
import java.util.function.BiConsumer;
import java.util.function.Consumer;
import java.util.function.Supplier;
import org.assertj.core.api.ThrowableAssert.ThrowingCallable;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;

/** Promises outside every space, where listeners run on the settling thread; and long chains of promises. */
class PromiseTest extends InTestSpace {
    private static final Duration AT_ONCE = Duration.ZERO;
    private static final Duration SECOND = Duration.ofSeconds(1);

    private final Deferred<String> deferred = new Deferred<>();

    @Test
    void promise_asText_includesItsOutcome() {
        var deferred = new Deferred<Integer>();
        assertThat(deferred).hasToString("promise");
        Promise<Integer> next = deferred.thenApply(number -> number + 1);
        assertThat(next).hasToString("promise after promise");
        deferred.resolve(41);
        assertThat(deferred).hasToString("promise, fulfilled with 41");
        assertThat(next.toString()).startsWith("promise").endsWith(", fulfilled with 42");
        assertThat(Promise.failed(new IllegalStateException("broken")))
                .hasToString("promise, rejected with java.lang.IllegalStateException: broken");
        assertThat(Promise.of("x".repeat(100))).hasToString("promise, fulfilled with " + "x".repeat(77) + "...");
    }

    interface Echo {
        Promise<String> say(String word);
    }

    @Test
    void requestTimerAndStream_asText_sayHowTheyAre() {
        Echo echo = test.spawn(
                Echo.class,
                () -> word -> word.isEmpty() ? Promise.failed(new IOException("no word")) : Promise.of(word));
        Promise<String> request = echo.say("hello");
        Promise<String> failing = echo.say("");
        failing.exceptionally(error -> "");
        assertThat(request).hasToString("Echo.say(String) of Echo#1");
        test.runQueued();
        assertThat(request).hasToString("Echo.say(String) of Echo#1, fulfilled with hello");
        assertThat(failing).hasToString("Echo.say(String) of Echo#1, rejected with java.io.IOException: no word");
        Promise<String> cancelled = echo.say("late");
        cancelled.cancel();
        test.runQueued();
        assertThat(cancelled)
                .asString()
                .startsWith("Echo.say(String) of Echo#1, rejected with java.util.concurrent.CancellationException: ");
        var stream = new Callback.Stream<String>(1, value -> {}, end -> {});
        assertThat(stream).hasToString("stream");
        Topic<String> topic = Topic.of(test.space(), "words");
        topic.subscribe(stream);
        topic.publish("a");
        topic.publish("b");
        topic.finish();
        test.runQueued();
        assertThat(stream).hasToString("stream, ended, dropped 1");
    }

    // ---- time limits and the last action

    @Test
    void completeOnTimeout_fulfilsWithTheValue_onlyIfItTakesLonger() {
        test.run(() -> {
            deferred.completeOnTimeout("instead", SECOND).then(value -> log.add("late " + value));
            var quick = new Deferred<@Nullable String>();
            quick.completeOnTimeout("instead", SECOND).then(value -> log.add("quick " + value));
            quick.resolve(null);
            var failing = new Deferred<String>();
            failing.completeOnTimeout("instead", SECOND).exceptionally(error -> {
                log.add("failed " + error.getMessage());
                return "";
            });
            failing.reject(new IOException("broken"));
        });
        assertThat(log).containsExactly("quick null", "failed broken");
        test.advance(SECOND);
        assertThat(log).endsWith("late instead");
        deferred.reject(new IOException("too late"));
        test.runQueued();
    }

    @Test
    void eventually_runsAfterEitherOutcome_andKeepsIt() {
        var end = Promise.of("value").eventually(() -> {
            log.add("done");
        });
        assertThat(test.get(end)).isEqualTo("value");
        var failed = Promise.<String>failed(new IOException("broken")).eventually(() -> {
            log.add("done too");
        });
        assertThat(test.error(failed)).hasMessage("broken");
        assertThat(log).containsExactly("done", "done too");
    }

    @Test
    void eventually_waitsForThePromiseOfTheAction() {
        var closing = new Deferred<@Nullable Void>();
        var end = deferred.eventually(() -> closing);
        var error = new Deferred<String>();
        var failed = error.eventually(() -> closing);
        deferred.resolve("value");
        error.reject(new IOException("broken"));
        test.runQueued();
        assertThat(List.of(end.isDone(), failed.isDone())).containsOnly(false);
        closing.resolve(null);
        assertThat(test.get(end)).isEqualTo("value");
        assertThat(test.error(failed)).hasMessage("broken");
    }

    @Test
    void eventually_whoseActionFails_endsWithThatError_andTheFirstSuppressed() {
        var value = Promise.of("value").eventually(() -> Promise.failed(new IOException("not closed")));
        assertThat(test.error(value)).hasMessage("not closed").hasNoSuppressedExceptions();
        for (Supplier<Promise<?>> action :
                List.<Supplier<Promise<?>>>of(() -> Promise.failed(new IOException("not closed")), () -> {
                    throw new IllegalStateException("not closed");
                })) {
            var failed = Promise.<String>failed(new IOException("broken")).eventually(action);
            Throwable error = test.error(failed);
            assertThat(error).hasMessage("not closed");
            assertThat(error.getSuppressed()).extracting(Throwable::getMessage).containsExactly("broken");
        }
    }

    @Test
    void listeners_runInTheOrderOfRegistration_alsoLateOnes() {
        for (int i = 0; i < 5; i++) {
            int number = i;
            deferred.then(value -> log.add(value + number));
        }
        deferred.resolve("x");
        deferred.thenAccept(log::add);
        assertThat(log).containsExactly("x0", "x1", "x2", "x3", "x4", "x");
    }

    @Test
    void settling_happensOnce() throws Exception {
        assertThat(deferred.resolve("first")).isTrue();
        assertThat(deferred.resolve("second")).isFalse();
        assertThat(deferred.reject(new IOException())).isFalse();
        assertThat(deferred.cancel()).isFalse();
        assertThat(deferred.get(AT_ONCE)).isEqualTo("first");
    }

    @Test
    void values_nullAndPromisesAmongThem_comeBackAsTheyAre() throws Exception {
        assertThat(Promise.of(null).get(AT_ONCE)).isNull();
        Promise<String> inner = Promise.of("inner");
        assertThat(Promise.of(inner).get(AT_ONCE)).isSameAs(inner);
        assertThat(Promise.of(inner).isDone()).isTrue();
    }

    @Test
    void vocabulary_ofCompletableFuture() throws Exception {
        Promise<Integer> length = deferred.thenApply(String::length);
        Promise<String> composed = deferred.thenCompose(value -> Promise.of(value + "!"));
        Promise<String> combined = deferred.thenCombine(length, (text, number) -> text + number);
        Promise<String> handled = deferred.handle((value, error) -> value + error);
        deferred.thenRun(() -> log.add("ran"));
        deferred.whenComplete((value, error) -> log.add(value + error));
        deferred.resolve("abc");
        assertThat(length.get(AT_ONCE)).isEqualTo(3);
        assertThat(composed.get(AT_ONCE)).isEqualTo("abc!");
        assertThat(combined.get(AT_ONCE)).isEqualTo("abc3");
        assertThat(handled.get(AT_ONCE)).isEqualTo("abcnull");
        assertThat(log).containsExactly("ran", "abcnull");
    }

    @Test
    void error_travelsUnwrappedUntilItIsHandled() throws Exception {
        var boom = new IOException("boom");
        Promise<String> rescued =
                deferred.thenApply(String::length).thenApply(n -> "n" + n).exceptionally(Throwable::getMessage);
        Promise<String> replaced =
                deferred.exceptionallyCompose(error -> Promise.of("instead of " + error.getMessage()));
        deferred.then((result, error) -> log.add(result + "/" + error.getMessage())); // as the paper has it
        deferred.reject(boom);
        assertThat(rescued.get(AT_ONCE)).isEqualTo("boom");
        assertThat(replaced.get(AT_ONCE)).isEqualTo("instead of boom");
        assertThat(log).containsExactly("null/boom");
        assertThat(deferred.error()).isSameAs(boom);
        assertThatThrownBy(() -> deferred.get(AT_ONCE)).isSameAs(boom);
    }

    @Test
    void listenerThatThrows_rejectsWhatThenAnswered() {
        Promise<String> next = deferred.then(value -> {
            throw new IllegalStateException("listener");
        });
        deferred.resolve("x");
        assertThat(next.error()).hasMessage("listener");
    }

    @Test
    void observerThatThrowsOnAnError_keepsTheFirstErrorAsSuppressed() {
        Promise<String> next = deferred.whenComplete((value, error) -> {
            throw new IllegalStateException("second");
        });
        deferred.reject(new IOException("first"));
        assertThat(next.error()).hasMessage("second");
        assertThat(next.error().getSuppressed())
                .singleElement()
                .satisfies(first -> assertThat(first).hasMessage("first"));
    }

    @Test
    void onSettled_isCalledWithTheValueOrTheError() {
        deferred.onSettled((value, error) -> log.add(value + ", " + error));
        deferred.resolve("x");
        Promise.<String>failed(new IllegalStateException("on purpose"))
                .onSettled((value, error) -> log.add(value + ", " + error.getMessage()));
        assertThat(log).containsExactly("x, null", "null, on purpose");
    }

    @Test
    void onRejected_isCalledWithTheErrorOnly() {
        deferred.onRejected(error -> log.add("not called"));
        deferred.resolve("x");
        Promise.failed(new IllegalStateException("on purpose")).onRejected(error -> log.add(error.getMessage()));
        assertThat(log).containsExactly("on purpose");
    }

    @Test
    void cancel_rejectsWithCancellation() {
        assertThat(deferred.cancel()).isTrue();
        assertThat(deferred.isCancelled()).isTrue();
        assertThat(deferred.error()).isInstanceOf(CancellationException.class);
        assertThat(deferred.resolve("late")).isFalse();
    }

    @Test
    void all_gathersInOrder_orFailsWithTheFirstError() throws Exception {
        var second = new Deferred<String>();
        Promise<List<String>> all = Promise.all(List.of(deferred, second));
        second.resolve("b");
        assertThat(all.isDone()).isFalse();
        deferred.resolve("a");
        assertThat(all.get(AT_ONCE)).containsExactly("a", "b");
        assertThat(Promise.all(List.of()).get(AT_ONCE)).isEmpty();
        Promise<String> failed = Promise.failed(new IOException("no"));
        assertThat(Promise.all(List.of(deferred, failed)).error()).hasMessage("no");
        Deferred<String> never = test.space().deferred();
        assertThat(test.error(failed.thenCombine(never, String::concat))).hasMessage("no");
    }

    @Test
    void allSettled_neverFails() throws Exception {
        var boom = new IOException("no");
        Promise<List<Outcome<String>>> settled = Promise.allSettled(List.of(deferred, Promise.failed(boom)));
        deferred.resolve("a");
        assertThat(settled.get(AT_ONCE)).containsExactly(new Outcome.Fulfilled<>("a"), new Outcome.Rejected<>(boom));
    }

    @Test
    void any_isTheFirstSuccess_andRaceTheFirstOutcome() throws Exception {
        Promise<String> failed = Promise.failed(new IOException("no"));
        Promise<String> any = Promise.any(List.of(failed, deferred));
        Promise<String> race = Promise.race(List.of(failed, deferred));
        deferred.resolve("yes");
        assertThat(any.get(AT_ONCE)).isEqualTo("yes");
        assertThat(race.error()).hasMessage("no");
        Promise<String> none = Promise.any(List.of(failed, Promise.failed(new IOException("neither"))));
        assertThat(none.error()).hasMessageContaining("none of 2");
        assertThat(none.error().getSuppressed()).hasSize(2);
        assertThat(Promise.any(List.of()).error()).isInstanceOf(NoSuchElementException.class);
        assertThat(Promise.race(List.of()).error()).hasMessage("race of no promises");
    }

    @Test
    void completionStages_convertBothWays() throws Exception {
        CompletableFuture<String> future = deferred.toCompletableFuture();
        Promise<Integer> back = Promise.from(future.thenApply(String::length));
        Promise<Integer> failing = Promise.from(future.thenApply(Integer::parseInt));
        deferred.resolve("four");
        assertThat(back.get(AT_ONCE)).isEqualTo(4);
        assertThat(failing.error()).isExactlyInstanceOf(NumberFormatException.class);
    }

    @Test
    void get_withoutAnAnswer_timesOut() {
        assertThatThrownBy(() -> deferred.get(Duration.ofMillis(1))).isInstanceOf(TimeoutException.class);
    }

    @Test
    void get_inAListenerOutsideEverySpace_throwsAndNamesTheAlternative() {
        Promise<Integer> outer = Promise.of(1).thenApply(one -> {
            try {
                return Promise.of(2).thenApply(two -> one + two).get(Duration.ofSeconds(2));
            } catch (Exception failed) {
                throw new IllegalStateException(failed);
            }
        });
        assertThat(outer.error())
                .hasRootCauseInstanceOf(IllegalStateException.class)
                .hasMessageContaining("get() in a listener");
    }

    /** Calls a method with null where an argument is required. */
    private static void refuses(String parameter, ThrowingCallable call) {
        assertThatThrownBy(call).isInstanceOf(NullPointerException.class).hasMessageStartingWith(parameter);
    }

    @Test
    @SuppressWarnings("NullAway") // passes null on purpose
    void nullArgument_isRejectedAtRegistration_byName() {
        Promise<Integer> promise = new Deferred<>();
        refuses("listener", () -> promise.then((Consumer<Integer>) null));
        refuses("listener", () -> promise.then((BiConsumer<Integer, Throwable>) null));
        refuses("listener", () -> promise.whenComplete(null));
        refuses("listener", () -> promise.onSettled(null));
        refuses("listener", () -> promise.onRejected(null));
        refuses("function", () -> promise.thenApply(null));
        refuses("consumer", () -> promise.thenAccept(null));
        refuses("action", () -> promise.thenRun(null));
        refuses("function", () -> promise.thenCompose(null));
        refuses("other", () -> promise.thenCombine(null, (mine, theirs) -> mine));
        refuses("function", () -> promise.thenCombine(promise, null));
        refuses("function", () -> promise.exceptionally(null));
        refuses("function", () -> promise.exceptionallyCompose(null));
        refuses("function", () -> promise.handle(null));
        refuses("timeout", () -> promise.orTimeout(null));
        refuses("timeout", () -> promise.get(null));
        refuses("error", () -> Promise.failed(null));
        refuses("stage", () -> Promise.from(null));
        refuses("promises", () -> Promise.all(null));
        refuses("promises[1]", () -> Promise.allSettled(Arrays.asList(promise, null)));
        refuses("promises[0]", () -> Promise.any(Arrays.asList(null, promise)));
        refuses("promises", () -> Promise.race(null));
        refuses("other", () -> new Deferred<Integer>().resolveFrom(null));
        refuses("error", () -> new Deferred<Integer>().reject(null));
    }

    // ---- long chains

    private static Promise<Integer> chain(Promise<Integer> first, int length) {
        Promise<Integer> last = first;
        for (int link = 0; link < length; link++) {
            last = last.thenApply(value -> value + 1);
        }
        return last;
    }

    @Test
    void longChain_isSettledAndRejected_inASpaceAndOutside() {
        for (ActorSpace home : Arrays.asList(test.space(), null)) {
            Deferred<Integer> fulfilled = home == null ? Deferred.unbound() : home.deferred();
            Promise<Integer> value = chain(fulfilled, 100_000);
            fulfilled.resolve(0);
            Deferred<Integer> rejected = home == null ? Deferred.unbound() : home.deferred();
            Promise<Integer> error = chain(rejected, 100_000);
            rejected.reject(new IllegalStateException("broken"));
            test.runQueued();
            assertThat(value.getNow()).isEqualTo(100_000);
            assertThat(test.error(error)).hasMessage("broken");
        }
        assertThat(chain(Promise.of(0), 100_000).getNow()).isEqualTo(100_000);
    }

    @Test
    void longChains_ofFollowersOrOfAll_doNotOverflowTheStack() {
        Deferred<String> last = deferred;
        Promise<?> all = deferred;
        for (int i = 0; i < 100_000; i++) {
            var next = new Deferred<String>();
            next.resolveFrom(last);
            last = next;
            all = Promise.all(List.of(all));
        }
        last.thenAccept(log::add);
        deferred.resolve("through");
        assertThat(log).containsExactly("through");
        assertThat(last.getNow()).isEqualTo("through");
        assertThat(all.isDone()).isTrue();
    }

    @Test
    void promiseBehindManyStages_canBeLimitedCancelledAndNamed_andItsTextIsShort() {
        Deferred<Integer> source = test.space().deferred();
        var limited = new ArrayList<Promise<Integer>>();
        test.run(() -> limited.add(chain(source, 50_000).orTimeout(SECOND)));
        Promise<Integer> cancelled = chain(source, 50_000);
        limited.getFirst().exceptionally(error -> 0);
        test.advance(SECOND);
        assertThat(limited.getFirst().error())
                .isInstanceOf(TimeoutException.class)
                .satisfies(error -> assertThat(error.getMessage()).hasSizeLessThan(400));
        assertThat(cancelled.cancel()).isTrue();
        assertThat(cancelled.isCancelled()).isTrue();
        assertThat(cancelled.error().getMessage()).hasSizeLessThan(400);
        source.resolve(0);
        test.runQueued();
    }

    @Test
    void manyTimeLimits_onTopOfEachOther_areSettledAndNamed() {
        Deferred<Integer> source = test.space().deferred();
        Promise<Integer> last = source;
        for (int limit = 0; limit < 20_000; limit++) {
            last = last.orTimeout(Duration.ofSeconds(30 + limit));
        }
        test.advance(Duration.ofSeconds(30));
        assertThat(test.error(last)).hasMessageContaining("within PT30S from promise");
        assertThat(last.toString()).hasSizeLessThan(400);
    }

    @Test
    void text_ofAChain_namesWhatItWaitsFor_andHowFarThatIs() {
        Deferred<Integer> source = test.space().deferred();
        assertThat(chain(source, 2)).hasToString("promise after promise after promise");
        assertThat(chain(source.orTimeout(Duration.ofSeconds(5)), 1).orTimeout(Duration.ofSeconds(7)))
                .hasToString("promise after promise within PT5S within PT7S");
        assertThat(chain(source, 50)).asString().endsWith("promise after 42 others after promise");
        assertThat(chain(source, 500)).asString().endsWith("promise after more than 92 others");
        source.resolve(0);
        test.runQueued();
    }
}
