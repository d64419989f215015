package io.troupe.services.component;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.params.provider.Arguments.arguments;

import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.broker.Health;
import io.troupe.broker.ProviderException;
import io.troupe.bus.Address;
import io.troupe.bus.BusTopic;
import io.troupe.bus.Operation;
import io.troupe.bus.RemoteFailure;
import io.troupe.services.component.DataConversion.Losses;
import io.troupe.services.component.ScriptedComponent.Number;
import java.lang.reflect.Proxy;
import java.time.Duration;
import java.util.Collections;
import java.util.List;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.Arguments;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.MethodSource;
import org.junit.jupiter.params.provider.NullSource;
import org.junit.jupiter.params.provider.ValueSource;

/** The three units of a component interface, with a scripted component on a manually driven space. */
class ComponentInterfaceTest extends ComponentBench {
    private static final Duration LIMIT = Duration.ofSeconds(1);
    private static final Duration START_LIMIT = Duration.ofSeconds(10);
    private static final Buffering TWO = new Buffering(2, false);

    private final ScriptedComponent<String, String> script = ScriptedComponent.counter();
    private final List<Number> heard = listenTo(ScriptedComponent.OUT);

    private Component<String, String> component() {
        return script.component("counting", ScriptedComponent.IN, ScriptedComponent.OUT);
    }

    private ComponentBroker.Registered<String, String> opened() {
        return open("counter", component(), notes);
    }

    private ComponentBroker.Registered<String, String> running() {
        return start("counter", component());
    }

    private Deferred<@Nullable Void> slowInvocation() {
        var slow = ScriptedComponent.later();
        script.invoke = () -> slow;
        return slow;
    }

    private Deferred<@Nullable Void> slowTermination() {
        var slow = ScriptedComponent.later();
        script.terminate = () -> slow;
        return slow;
    }

    private void publish(int... values) {
        test.run(() -> {
            for (int value : values) {
                user.publish(ScriptedComponent.IN, new Number(value));
            }
        });
    }

    private void output(String... values) {
        test.run(() -> List.of(values).forEach(script.signals()::data));
    }

    private void fail(String why) {
        test.run(() -> script.signals().failed(new IllegalStateException(why)));
    }

    private void assertHeard(Integer... values) {
        assertThat(heard).extracting(Number::value).containsExactly(values);
    }

    private void assertState(ComponentBroker.Registered<?, ?> provider, Health health) {
        assertThat(test.get(provider.health())).isEqualTo(health);
    }

    private void assertError(Promise<?> promise, String message) {
        assertThat(test.error(promise)).isInstanceOf(ProviderException.class).hasMessage(message);
    }

    private <A extends Record, Q extends Record> Promise<A> ask(Operation<Q, A> operation, Q question) {
        return user.ask(new Address("here", "counter"), operation, question, LIMIT);
    }

    // ---- the three units

    @Test
    void component_isInvoked_takesData_givesData_answersRequests_andIsTerminated() {
        var half = new Operation<>("half", Number.class, Number.class, Operation.Kind.DATA);
        var provider = opened();
        test.run(() -> provider.answer(half, number -> Promise.of(new Number(number.value() / 2))));
        assertState(provider, Health.NOT_STARTED);
        assertThat(test.error(ask(half, new Number(8))))
                .isInstanceOf(RemoteFailure.class)
                .hasMessageContaining("here/counter has not been invoked");
        test.get(provider.start());
        publish(1, 2);
        output("3");
        assertThat(test.get(ask(half, new Number(8)))).isEqualTo(new Number(4));
        test.get(provider.check());
        test.get(provider.stop());
        assertThat(script.calls).containsExactly("invoke", "1", "2", "terminate");
        assertHeard(3);
        assertThat(notes.take()).containsExactly("counter Starting", "counter Started", "counter Stopped");
    }

    @ParameterizedTest
    @NullSource
    @ValueSource(strings = {"", " ", "out of numbers"})
    void checkThatFails_isAFailure_alsoWithoutAMessage(@Nullable String message) {
        var provider = running();
        script.health = () -> Promise.failed(new IllegalStateException(message));
        test.advance(Duration.ofSeconds(1));
        assertState(provider, Health.FAILED);
        assertThat(script.calls).containsExactly("invoke", "terminate");
        script.health = Promise::done;
        test.get(provider.start());
        assertState(provider, Health.WELL);
    }

    // ---- the buffer

    static Stream<Arguments> buffers() {
        return Stream.of(
                arguments("waits for it", Buffering.STREAM, List.of("1", "2", "3"), new Losses(0, 0, 0)),
                arguments("the oldest are lost", TWO, List.of("2", "3"), new Losses(1, 0, 0)),
                arguments("the newest of a topic is kept", Buffering.LATEST, List.of("3"), new Losses(0, 2, 0)));
    }

    @ParameterizedTest(name = "{0}")
    @MethodSource("buffers")
    void whatComesWhileTheComponentIsBeingInvoked_isBuffered(
            String row, Buffering input, List<String> taken, Losses losses) {
        var slow = slowInvocation();
        var provider = open("counter", component().buffered(input, Buffering.STREAM), notes);
        var started = provider.start();
        publish(1, 2, 3);
        assertThat(script.calls).containsExactly("invoke");
        test.run(() -> slow.resolve(null));
        assertThat(started.isDone()).isTrue();
        assertThat(script.calls.subList(1, script.calls.size())).isEqualTo(taken);
        assertThat(provider.conversion().losses()).isEqualTo(losses);
        assertThat(notes.take().contains("counter dropped Number[value=1], 1 so far"))
                .as("the loss is reported")
                .isEqualTo(losses.dropped() == 1);
    }

    @Test
    void failureOnTheFirstBufferedValue_isAFailureOfARunningComponent() {
        var slow = slowInvocation();
        var provider = opened();
        var started = provider.start();
        publish(13);
        test.run(() -> slow.resolve(null));
        test.get(started); // it did start
        assertState(provider, Health.FAILED);
        assertThat(notes.take()).contains("counter has failed: 13 is bad luck", "counter Started", "counter Failed");
    }

    @Test
    void burstFromTheComponent_overflowsItsOwnBufferOnly() {
        var provider = start("counter", component().buffered(Buffering.STREAM, TWO));
        output("1", "2", "3", "4");
        assertHeard(3, 4);
        assertThat(provider.conversion().losses().dropped()).isEqualTo(2);
    }

    @Test
    void conversionThatFails_costsThatValueOnly_andIsTold() {
        var toComponent = script.toComponent;
        script.toComponent = input -> not("7", toComponent.apply(input));
        var toApplication = script.toApplication;
        script.toApplication = output -> toApplication.apply(not("8", output));
        var provider = running();
        publish(1, -1, 7, 2);
        output("3", "four", "8", "5");
        assertThat(script.calls).containsExactly("invoke", "1", "2");
        assertHeard(3, 5);
        assertThat(notes.take())
                .containsExactly(
                        "counter could not convert counter/in Number[value=-1]: a count is -1, expected 0 or more",
                        "counter could not convert counter/in Number[value=7]: an error, not an exception",
                        "counter could not convert four: For input string: \"four\"",
                        "counter could not convert 8: an error, not an exception");
        assertThat(provider.conversion().losses().failed()).isEqualTo(4);
        test.get(provider.check());
    }

    private static String not(String bad, String text) {
        if (text.equals(bad)) {
            throw new AssertionError("an error, not an exception");
        }
        return text;
    }

    /** A record that a bus rejects if its list has a null element. */
    record Unfit(List<String> texts) {}

    @Test
    void lastWordsThatCannotBePublished_areReported_andTheStopIsSettled() {
        var other = new BusTopic<>("other", Unfit.class);
        var toApplication = script.toApplication;
        script.toApplication = output -> output.equals("bad")
                ? new ApplicationData<>(other, new Unfit(Collections.singletonList(null)))
                : toApplication.apply(output);
        script.terminate = () -> {
            List.of("1", "bad", "2").forEach(script.signals()::data);
            return Promise.done();
        };
        var provider = running();
        test.get(provider.stop());
        assertError(provider.check(), "here/counter has been terminated");
        assertHeard(1, 2);
        assertThat(notes.take()).anyMatch(note -> note.startsWith("counter could not publish other"));
        assertThat(provider.conversion().losses().failed()).isEqualTo(1);
    }

    // ---- components that fail

    private void assertInvocationFails(ComponentBroker.Registered<?, ?> provider, String why) {
        assertError(provider.start(), "here/counter has failed: " + why);
        assertError(provider.check(), "here/counter has failed: " + why);
        assertState(provider, Health.FAILED);
    }

    @Test
    void componentThatThrowsWhenInvoked_orAnswersNull_hasFailed_andCanBeInvokedAgain() {
        var provider = opened();
        script.invoke = () -> {
            throw new IllegalStateException("no power");
        };
        assertInvocationFails(provider, "no power");
        assertThat(script.calls).containsExactly("invoke", "terminate");
        script.invoke = () -> {
            throw new ExceptionInInitializerError("no such library");
        };
        assertInvocationFails(provider, "no such library");
        script.invoke = () -> null;
        assertInvocationFails(provider, "it returned null, expected a promise");
        script.communication = () -> {
            throw new NoClassDefFoundError("a/driver");
        };
        assertInvocationFails(provider, "a/driver");
        script.communication = () -> script;
        script.invoke = Promise::done;
        test.get(provider.start());
        test.get(provider.check());
    }

    @ParameterizedTest
    @CsvSource({"13, 13 is bad luck", "666, too deep"})
    void componentThatThrowsOnData_hasFailed_isTerminated_andHearsNothingMore(int value, String why) {
        var provider = running();
        publish(12, value, 14);
        assertThat(script.calls).containsExactly("invoke", "12", "" + value, "terminate");
        assertError(provider.check(), "here/counter has failed: " + why);
        publish(15);
        assertThat(script.calls).hasSize(4);
        assertThat(notes.take()).containsExactly("counter has failed: " + why, "counter Failed");
    }

    @Test
    void componentThatDies_hasFailed_andSaysSoAtOnce_itsLastWordsAreStillPublished() {
        var provider = running();
        notes.take();
        test.run(() -> {
            script.signals().data("7");
            script.signals().failed(new IllegalStateException("burnt out"));
        });
        assertHeard(7);
        assertError(provider.check(), "here/counter has failed: burnt out");
        assertThat(notes.take()).containsExactly("counter has failed: burnt out", "counter Failed");
        test.get(provider.stop());
        assertThat(script.calls).containsExactly("invoke", "terminate");
    }

    @Test
    void lifeThatIsNotTerminated_isTerminatedAgain_andNoneBeginsBesideIt() {
        script.terminate = () -> Promise.failed(new IllegalStateException("process still alive"));
        var provider = running();
        String stuck = "java.lang.IllegalStateException: process still alive";
        assertError(provider.stop(), "here/counter has not stopped: " + stuck);
        assertError(provider.start(), "here/counter cannot start: its previous life could not be stopped: " + stuck);
        assertThat(script.calls).containsExactly("invoke", "terminate", "terminate");
        script.terminate = Promise::done;
        test.get(provider.start());
        assertThat(script.calls.subList(3, script.calls.size())).containsExactly("terminate", "invoke");
        test.get(provider.stop());
        assertThat(notes.take()).contains("counter Stopped");
    }

    @Test
    void failedLifeThatIsNotTerminated_isTerminatedByTheNextStop() {
        script.terminate = () -> Promise.failed(new IllegalStateException("process still alive"));
        var provider = running();
        fail("burnt out");
        assertThat(test.error(provider.start())).hasMessageEndingWith("process still alive");
        script.terminate = Promise::done;
        test.get(provider.stop());
        assertThat(script.calls).containsExactly("invoke", "terminate", "terminate", "terminate");
        test.get(provider.start());
    }

    @Test
    void componentThatHangs_isGivenUp_andWhenItRunsAfterAll_isTerminatedAgain() {
        var late = slowInvocation();
        var provider = opened();
        var started = provider.start();
        test.runQueued();
        test.advance(START_LIMIT);
        assertError(started, "here/counter did not start within PT10S");
        notes.take();
        test.run(() -> late.resolve(null));
        assertThat(script.calls).containsExactly("invoke", "terminate", "terminate");
        assertThat(notes.take())
                .containsExactly("counter ran only after it had been given up, and is terminated again");
        assertState(provider, Health.FAILED);
    }

    @Test
    void invocationThatIsCompletedDuringTheTermination_isTerminatedOnceMore() {
        var late = slowInvocation();
        var slow = slowTermination();
        var provider = opened();
        provider.start().handle((started, error) -> null);
        test.runQueued();
        test.advance(START_LIMIT);
        assertThat(script.calls).containsExactly("invoke", "terminate");
        test.run(() -> late.resolve(null));
        script.terminate = Promise::done;
        test.run(() -> slow.resolve(null));
        assertThat(script.calls).containsExactly("invoke", "terminate", "terminate");
    }

    @Test
    void whatIsSaidAfterTheEnd_isToldAndNotPublished_andDoesNotTouchTheNextLife() {
        var provider = running();
        var past = script.signals();
        test.get(provider.stop());
        output("9");
        fail("too late to fail");
        assertThat(heard).isEmpty();
        assertThat(notes.take()).contains("counter gave data after its end: 9");
        assertError(provider.check(), "here/counter has been terminated");
        test.get(provider.start());
        test.run(() -> past.failed(new IllegalStateException("from the grave")));
        test.get(provider.check());
        output("1");
        assertHeard(1);
    }

    // ---- observers

    @Test
    void observerThatThrows_changesNothing() {
        var throwing = Proxy.newProxyInstance(
                getClass().getClassLoader(), new Class<?>[] {ComponentObserver.class}, (proxy, method, arguments) -> {
                    throw method.getName().equals("info")
                            ? new AssertionError("info")
                            : new IllegalStateException(method.getName());
                });
        var provider = open("counter", component(), (ComponentObserver) throwing);
        test.get(provider.start());
        publish(-1, 1);
        test.run(() -> script.signals().info("something"));
        test.get(provider.stop());
        assertThat(script.calls).containsExactly("invoke", "1", "terminate");
        assertThat(notes.take()).contains("counter Stopped");
    }

    // ---- calls that meet

    @Test
    void startDuringAStart_waitsForTheSame_andStopIsIdempotent() {
        var slow = slowInvocation();
        var provider = opened();
        var first = provider.start();
        var second = provider.start();
        test.run(() -> slow.resolve(null));
        assertThat(first.isDone() && second.isDone()).isTrue();
        test.get(provider.stop());
        test.get(provider.stop());
        assertThat(script.calls).containsExactly("invoke", "terminate");
    }

    @ParameterizedTest
    @ValueSource(booleans = {false, true})
    void startDuringATermination_begins_whenThatIsOver(boolean failed) {
        var slow = slowTermination();
        var provider = running();
        if (failed) {
            fail("burnt out");
        }
        Promise<?> stopped = failed ? Promise.done() : provider.stop();
        var first = provider.start();
        var second = provider.start();
        test.runQueued();
        assertThat(script.calls).containsExactly("invoke", "terminate");
        test.run(() -> slow.resolve(null));
        assertThat(stopped.isDone() && first.isDone() && second.isDone()).isTrue();
        assertThat(script.calls).containsExactly("invoke", "terminate", "invoke");
        test.get(provider.check());
    }

    @Test
    void stopDuringAStop_givesUpTheStartThatWaits() {
        var slow = slowTermination();
        var provider = running();
        provider.stop();
        var started = provider.start();
        var stopped = provider.stop();
        assertError(started, "here/counter was not started: it was withdrawn or replaced before that");
        test.run(() -> slow.resolve(null));
        assertThat(stopped.isDone()).isTrue();
        assertThat(script.calls).containsExactly("invoke", "terminate");
    }

    @Test
    void stopOfAFailedComponent_waitsForItsTermination_andGivesUpTheStartThatWaits() {
        var slow = slowTermination();
        var provider = running();
        fail("burnt out");
        var started = provider.start();
        var stopped = provider.stop();
        assertError(started, "here/counter was not started: it was withdrawn or replaced before that");
        assertThat(stopped.isDone()).isFalse();
        test.run(() -> slow.resolve(null));
        test.get(stopped);
        assertThat(script.calls).containsExactly("invoke", "terminate");
    }

    @Test
    void closedInterface_startsNothing_andItsUsersAreNotifiedAtOnce() {
        var slow = slowTermination();
        var provider = running();
        test.run(provider::close);
        assertThat(notes.take()).contains("counter Failed");
        provider.stop();
        assertError(provider.start(), "here/counter has left the bus, expected an open interface");
        test.run(() -> slow.resolve(null));
        assertThat(script.calls).containsExactly("invoke", "terminate");
    }

    @Test
    void close_terminatesWhatRuns_freesTheNameAtOnce_andReportsATerminationThatFailsLater() {
        test.run(running()::close);
        assertThat(script.calls).containsExactly("invoke", "terminate");
        var slow = slowTermination();
        test.run(running()::close);
        opened();
        notes.take();
        test.run(() -> slow.reject(new IllegalStateException("stuck")));
        assertThat(notes.take()).contains("counter could not be terminated: stuck");
    }

    @Test
    void interfaceOpenedOffEverySpace_isRefusedByName() {
        assertThatThrownBy(() -> ComponentInterface.open(bus, "counter", component(), notes))
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("the interface of counter was opened on no actor space");
    }
}
