package io.troupe.actor.testkit;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorTypeException;
import io.troupe.actor.Callback;
import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeoutException;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;

class ProbeTest {
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

    /** The code under test: calls the greeter, and once more if that fails. */
    static final class Porter implements Door {
        private final Greeter greeter;

        Porter(Greeter greeter) {
            this.greeter = greeter;
        }

        @Override
        public Promise<String> enter(String name) {
            greeter.wave();
            return greeter.greet(name).exceptionallyCompose(error -> greeter.greet(error.getMessage()));
        }
    }

    private static final String LEFTOVER = "probe of Greeter: requests were never answered: ";

    @Test
    void callsOfTheCodeUnderTest_areRecorded_andAnsweredOnDemand() {
        try (var test = new TestSpace()) {
            Probe<Greeter> greeter = test.probe(Greeter.class);
            Door door = test.spawn(Door.class, () -> new Porter(greeter.actor()));
            Promise<String> first = door.enter("Ann");
            greeter.expectCall("wave()");
            greeter.expectCall("greet(Ann)");
            greeter.expectNoCall();
            assertThat(first.isDone()).isFalse();
            greeter.reject(new IllegalStateException("who?"));
            greeter.expectCall("greet(who?)");
            greeter.answer("hello");
            assertThat(first.getNow()).isEqualTo("hello");
            greeter.expectNoCall();
        }
    }

    @Test
    void calls_areWrittenAsInDeadLetters_withArraysNullsAndCallbacksReadable() {
        try (var test = new TestSpace()) {
            Probe<Greeter> greeter = test.probe(Greeter.class);
            greeter.actor().point(null, 1, 2);
            greeter.actor().listen((number, error) -> {});
            greeter.actor().greetAnn();
            assertThat(greeter.calls()).containsExactly("point(null, [1, 2])", "listen(callback)", "greetAnn()");
            greeter.answer("hello");
        }
    }

    @Test
    void expectCall_answersTheArguments_soThatTheTestCanUseThem() {
        try (var test = new TestSpace()) {
            Probe<Greeter> greeter = test.probe(Greeter.class);
            CallbackProbe<Integer> numbers = test.callback();
            greeter.actor().listen(numbers);
            @SuppressWarnings("unchecked")
            var given =
                    (Callback<Integer>) greeter.expectCall("listen(callback)").getFirst();
            given.next(5);
            given.finish();
            assertThat(numbers.results()).containsExactly(5);
            numbers.expectFinished();
        }
    }

    @Test
    void requests_areAnsweredOldestFirst() {
        try (var test = new TestSpace()) {
            Probe<Greeter> greeter = test.probe(Greeter.class);
            Promise<String> first = greeter.actor().greet("Ann");
            Promise<List<String>> second = greeter.actor().names();
            greeter.answer("hello");
            greeter.answer(List.of("Ann"));
            assertThat(first.getNow()).isEqualTo("hello");
            assertThat(second.getNow()).containsExactly("Ann");
        }
    }

    @Test
    void nullIsAnAnswer_andATypeVariableTakesAnything() {
        try (var test = new TestSpace()) {
            Probe<Greeter> greeter = test.probe(Greeter.class);
            Promise<String> nothing = greeter.actor().greet("Ann");
            greeter.answer(null);
            assertThat(nothing.isDone()).isTrue();
            assertThat(nothing.getNow()).isNull();
            @SuppressWarnings("unchecked")
            Probe<Box<Integer>> box = (Probe<Box<Integer>>) (Probe<?>) test.probe(Box.class);
            Promise<Integer> content = box.actor().open();
            box.answer(7);
            assertThat(content.getNow()).isEqualTo(7);
        }
    }

    @Test
    void probe_isAnActorOfItsSpace() {
        try (var test = new TestSpace()) {
            Probe<Greeter> greeter = test.probe(Greeter.class);
            Promise<String> limited = greeter.actor().greet("Ann").orTimeout(Duration.ofSeconds(1));
            test.advance(Duration.ofSeconds(1));
            assertThat(test.error(limited)).isInstanceOf(TimeoutException.class);
            assertThat(greeter.takeUnanswered()).containsExactly("greet(Ann)");
            test.space().stop(greeter.actor());
            greeter.actor().wave();
            test.crank();
            assertThat(test.takeDeadLetters()).hasSize(1);
            assertThat(greeter.calls()).containsExactly("greet(Ann)");
        }
    }

    @Test
    void unexpectedCall_isReportedWithTheCallsSoFar() {
        try (var test = new TestSpace()) {
            Probe<Greeter> greeter = test.probe(Greeter.class);
            assertThatThrownBy(() -> greeter.expectCall("wave()"))
                    .isInstanceOf(AssertionError.class)
                    .hasMessage(
                            "probe of Greeter: expected the call wave(), but no further one came; calls so far: []");
            greeter.actor().wave();
            assertThatThrownBy(() -> greeter.expectCall("greet(Ann)"))
                    .isInstanceOf(AssertionError.class)
                    .hasMessage("probe of Greeter: expected the call greet(Ann), but the next one was wave();"
                            + " calls so far: [wave()]");
            assertThatThrownBy(greeter::expectNoCall)
                    .isInstanceOf(AssertionError.class)
                    .hasMessage("probe of Greeter: expected no further call, but wave() came; calls so far: [wave()]");
            greeter.expectCall("wave()");
        }
    }

    @Test
    void answerWithoutARequest_isAMistakeOfTheTest() {
        try (var test = new TestSpace()) {
            Probe<Greeter> greeter = test.probe(Greeter.class);
            greeter.actor().wave();
            assertThatThrownBy(() -> greeter.answer("hello"))
                    .isInstanceOf(AssertionError.class)
                    .hasMessage("probe of Greeter: answer(hello) came when no request waited for an answer;"
                            + " calls so far: [wave()]");
            assertThatThrownBy(() -> greeter.reject(new IllegalStateException("no")))
                    .isInstanceOf(AssertionError.class)
                    .hasMessageContaining("reject(java.lang.IllegalStateException: no) came when no request waited");
        }
    }

    @Test
    void answerOfTheWrongType_isAMistakeOfTheTest_andTheRequestStillWaits() {
        try (var test = new TestSpace()) {
            Probe<Greeter> greeter = test.probe(Greeter.class);
            Promise<String> greeting = greeter.actor().greet("Ann");
            assertThatThrownBy(() -> greeter.answer(5))
                    .isInstanceOf(AssertionError.class)
                    .hasMessage("probe of Greeter: answer(5) is a java.lang.Integer, and greet(Ann) answers a"
                            + " java.lang.String; calls so far: [greet(Ann)]");
            greeter.answer("hello");
            Promise<List<String>> names = greeter.actor().names();
            assertThatThrownBy(() -> greeter.answer(Map.of()))
                    .isInstanceOf(AssertionError.class)
                    .hasMessageContaining("names() answers a java.util.List");
            greeter.answer(List.of());
            assertThat(greeting.isDone() && names.isDone()).isTrue();
        }
    }

    @Test
    void unansweredRequest_failsTheTestAtTheEnd() {
        var test = new TestSpace();
        Probe<Greeter> greeter = test.probe(Greeter.class);
        greeter.actor().wave();
        greeter.actor().greet("Ann");
        greeter.actor().greet("Bob");
        test.crank();
        greeter.answer("hello");
        assertThatThrownBy(test::close)
                .isInstanceOf(AssertionError.class)
                .hasMessage(LEFTOVER + "[greet(Bob)]; answer(..) them, or takeUnanswered()");
    }

    @Test
    void unansweredRequest_thatTheTestTook_isExpected() {
        try (var test = new TestSpace()) {
            Probe<Greeter> greeter = test.probe(Greeter.class);
            greeter.actor().greet("Ann");
            assertThat(greeter.takeUnanswered()).containsExactly("greet(Ann)");
            assertThat(greeter.takeUnanswered()).isEmpty();
        }
    }

    @Test
    void typeThatCannotBeStoodInFor_isRejected() {
        interface NoActor {
            int count();
        }
        try (var test = new TestSpace()) {
            assertThatThrownBy(() -> test.probe(Clerk.class))
                    .isInstanceOf(IllegalArgumentException.class)
                    .hasMessage("a probe stands in for an interface, and " + Clerk.class.getName()
                            + " is a class: spawn a subclass of it");
            assertThatThrownBy(() -> test.probe(NoActor.class))
                    .isInstanceOf(ActorTypeException.class)
                    .hasMessageContaining("count()");
        }
    }

    public static class Clerk extends Actor {}
}
