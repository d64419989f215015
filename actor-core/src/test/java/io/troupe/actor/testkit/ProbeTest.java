package io.troupe.actor.testkit;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorTypeException;
import io.troupe.actor.Callback;
import io.troupe.actor.InTestSpace;
import io.troupe.actor.Promise;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeoutException;
import org.assertj.core.api.ThrowableAssert.ThrowingCallable;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;

/** Probes of actors and of callbacks. */
class ProbeTest extends InTestSpace {
    interface Greeter {
        void wave();

        void point(@Nullable String at, int... steps);

        void listen(Callback<Integer> numbers);

        Promise<String> greet(String name);

        Promise<List<String>> names();

        default Promise<String> greetAnn() {
            return greet("Ann");
        }
    }

    interface Box<T> {
        Promise<T> open();

        boolean equals(Object other);
    }

    interface Door {
        Promise<String> enter(String name);
    }

    interface Counter {
        void count(int from, int to, @Nullable String error, Callback<Integer> numbers);
    }

    private final Probe<Greeter> probe = test.probe(Greeter.class);
    private final Greeter greeter = probe.actor();
    private final Counter counter = test.spawn(Counter.class, () -> ProbeTest::count);
    private final CallbackProbe<Integer> numbers = test.callback();

    private static void assertMistake(ThrowingCallable code, String message) {
        assertThatThrownBy(code).isInstanceOf(AssertionError.class).hasMessage(message);
    }

    @Test
    void callsOfTheCodeUnderTest_areRecorded_andAnsweredOnDemand() {
        Door door = test.spawn(Door.class, () -> name -> {
            greeter.wave();
            return greeter.greet(name).exceptionallyCompose(error -> greeter.greet(error.getMessage())); // once more
        });
        Promise<String> first = door.enter("Ann");
        probe.expectCall("wave()");
        probe.expectCall("greet(Ann)");
        probe.expectNoCall();
        assertThat(first.isDone()).isFalse();
        probe.reject(new IllegalStateException("who?"));
        probe.expectCall("greet(who?)");
        probe.answer("hello");
        assertThat(first.getNow()).isEqualTo("hello");
        probe.expectNoCall();
    }

    @Test
    void calls_areWrittenWithTheirArguments_arraysNullsAndCallbacksReadable() {
        greeter.point(null, 1, 2);
        greeter.listen((number, error) -> {});
        greeter.greetAnn();
        assertThat(probe.calls()).containsExactly("point(null, [1, 2])", "listen(callback)", "greetAnn()");
        probe.answer("hello");
    }

    private static final class Unprintable {
        @Override
        public String toString() {
            throw new UnsupportedOperationException();
        }
    }

    interface Sink {
        Promise<Object> take(Object what);
    }

    @Test
    void valuesWhoseTextThrowsOrIsHuge_areRecordedAndAnswered() {
        var sink = test.probe(Sink.class);
        String unprintable = "what cannot be printed: java.lang.UnsupportedOperationException";
        String huge = "x".repeat(997) + "...";
        for (Object value : List.of(new Unprintable(), "x".repeat(100_000))) {
            var answer = sink.actor().take(value);
            String text = value instanceof String ? huge : unprintable;
            assertThat(sink.calls()).last().isEqualTo("take(" + text + ")");
            sink.answer(value);
            assertThat(test.get(answer)).isSameAs(value);
        }
        sink.actor().take(new Object[] {new Unprintable()});
        assertThat(sink.takeUnanswered()).containsExactly("take(" + unprintable + ")");

        CallbackProbe<Object> probe = test.callback();
        probe.accept(new Unprintable(), null);
        probe.fail(new IllegalStateException("x".repeat(100_000)));
        assertThatThrownBy(probe::expectOpen)
                .hasMessageContaining("results so far: [" + unprintable + "]")
                .satisfies(error -> assertThat(error.getMessage()).hasSizeLessThan(2_000));
    }

    @Test
    void expectCall_answersTheArguments_soThatTheTestCanUseThem() {
        greeter.listen(numbers);
        @SuppressWarnings("unchecked")
        var given = (Callback<Integer>) probe.expectCall("listen(callback)").getFirst();
        given.next(5);
        given.finish();
        assertThat(numbers.results()).containsExactly(5);
        numbers.expectFinished();
    }

    @Test
    void requests_areAnsweredOldestFirst() {
        Promise<String> first = greeter.greet("Ann");
        Promise<List<String>> second = greeter.names();
        probe.answer("hello");
        probe.answer(List.of("Ann"));
        assertThat(first.getNow()).isEqualTo("hello");
        assertThat(second.getNow()).containsExactly("Ann");
    }

    @Test
    void nullIsAnAnswer_andATypeVariableTakesAnything() {
        Promise<String> nothing = greeter.greet("Ann");
        probe.answer(null);
        assertThat(nothing.isDone()).isTrue();
        assertThat(nothing.getNow()).isNull();
        @SuppressWarnings("unchecked")
        Probe<Box<Integer>> box = (Probe<Box<Integer>>) (Probe<?>) test.probe(Box.class);
        Promise<Integer> content = box.actor().open();
        box.answer(7);
        assertThat(content.getNow()).isEqualTo(7);
    }

    @Test
    void probe_isAnActorOfItsSpace() {
        Promise<String> limited = greeter.greet("Ann").orTimeout(Duration.ofSeconds(1));
        test.advance(Duration.ofSeconds(1));
        assertThat(test.error(limited)).isInstanceOf(TimeoutException.class);
        assertThat(probe.takeUnanswered()).containsExactly("greet(Ann)");
        test.space().stop(greeter);
        greeter.wave();
        test.runQueued();
        assertThat(test.takeDeadLetters()).hasSize(1);
        assertThat(probe.calls()).containsExactly("greet(Ann)");
    }

    @Test
    void unexpectedCall_isReportedWithTheCallsSoFar() {
        assertMistake(
                () -> probe.expectCall("wave()"),
                "probe of Greeter: expected the call wave(), but no further one came; calls so far: []");
        greeter.wave();
        assertMistake(
                () -> probe.expectCall("greet(Ann)"),
                "probe of Greeter: expected the call greet(Ann), but the next one was wave(); calls so far: [wave()]");
        assertMistake(
                probe::expectNoCall,
                "probe of Greeter: expected no further call, but wave() came; calls so far: [wave()]");
        probe.expectCall("wave()");
    }

    @Test
    void answerWithoutARequest_isAMistakeOfTheTest() {
        greeter.wave();
        String reason = " came when no request waited for an answer; calls so far: [wave()]";
        assertMistake(() -> probe.answer("hello"), "probe of Greeter: answer(hello)" + reason);
        assertMistake(
                () -> probe.reject(new IllegalStateException("no")),
                "probe of Greeter: reject(java.lang.IllegalStateException: no)" + reason);
    }

    @Test
    void answerOfTheWrongType_isAMistakeOfTheTest_andTheRequestStillWaits() {
        Promise<String> greeting = greeter.greet("Ann");
        assertMistake(
                () -> probe.answer(5),
                "probe of Greeter: answer(5) is a java.lang.Integer, and greet(Ann) answers a java.lang.String;"
                        + " calls so far: [greet(Ann)]");
        probe.answer("hello");
        Promise<List<String>> names = greeter.names();
        assertThatThrownBy(() -> probe.answer(Map.of()))
                .isInstanceOf(AssertionError.class)
                .hasMessageContaining("names() answers a java.util.List");
        probe.answer(List.of());
        assertThat(greeting.isDone() && names.isDone()).isTrue();
    }

    @Test
    void unansweredRequest_failsTheTestAtTheEnd() {
        greeter.wave();
        greeter.greet("Ann");
        greeter.greet("Bob");
        test.runQueued();
        probe.answer("hello");
        assertMistake(
                test::close,
                "probe of Greeter: requests were never answered: [greet(Bob)]; answer(..) them, or takeUnanswered()");
    }

    @Test
    void unansweredRequest_thatTheTestTook_isExpected() {
        greeter.greet("Ann");
        assertThat(probe.takeUnanswered()).containsExactly("greet(Ann)");
        assertThat(probe.takeUnanswered()).isEmpty();
    }

    @Test
    void typeThatCannotBeStoodInFor_isRejected() {
        interface NoActor {
            int count();
        }
        assertThatThrownBy(() -> test.probe(Clerk.class))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("a probe stands in for an interface, and " + Clerk.class.getName()
                        + " is a class: spawn a subclass of it");
        assertThatThrownBy(() -> test.probe(NoActor.class))
                .isInstanceOf(ActorTypeException.class)
                .hasMessageContaining("count()");
    }

    public static class Clerk extends Actor {}

    // ---- of callbacks

    private static void count(int from, int to, @Nullable String error, Callback<Integer> numbers) {
        for (int number = from; number <= to && !numbers.isCancelled(); number++) {
            numbers.next(number);
        }
        if (error == null) {
            numbers.finish();
        } else {
            numbers.fail(new IllegalStateException(error));
        }
    }

    @Test
    void callback_resultsAndItsEnd_areRecorded() {
        numbers.expectOpen();
        counter.count(1, 3, null, numbers);
        assertThat(numbers.results()).containsExactly(1, 2, 3);
        numbers.expectFinished();
        CallbackProbe<Integer> failed = test.callback();
        counter.count(1, 1, "tired", failed);
        assertThat(failed.expectFailed()).hasMessage("tired");
        assertThat(failed.results()).containsExactly(1);
    }

    @Test
    void callbackThatIsCancelled_isSeenByTheSender_andReceivesNothing() {
        numbers.cancel();
        counter.count(1, 3, null, numbers);
        assertThat(numbers.results()).isEmpty();
        numbers.expectOpen();
    }

    @Test
    void callbackWithAnotherEnd_isReportedWithTheResultsSoFar() {
        assertMistake(numbers::expectFinished, "callback: expected finish(), but no end came; results so far: []");
        counter.count(1, 2, null, numbers);
        assertMistake(numbers::expectFailed, "callback: expected fail(..), but finish() came; results so far: [1, 2]");
        assertMistake(numbers::expectOpen, "callback: expected no end, but finish() came; results so far: [1, 2]");
        CallbackProbe<Integer> failed = test.callback();
        counter.count(1, 1, "tired", failed);
        assertMistake(
                failed::expectFinished,
                "callback: expected finish(), but fail(java.lang.IllegalStateException: tired) came;"
                        + " results so far: [1]");
    }

    @Test
    void senderThatGoesOnAfterTheEnd_isRejected() {
        numbers.next(1);
        numbers.finish();
        assertAfterTheEnd(() -> numbers.next(2), "next(2)");
        assertAfterTheEnd(numbers::finish, "finish()");
        assertAfterTheEnd(
                () -> numbers.fail(new IllegalStateException("no")), "fail(java.lang.IllegalStateException: no)");
        assertThat(numbers.results()).containsExactly(1);
    }

    private static void assertAfterTheEnd(ThrowingCallable code, String call) {
        assertThatThrownBy(code)
                .isInstanceOf(IllegalStateException.class)
                .hasMessage(call + " came after the end, finish()");
    }
}
