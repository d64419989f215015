package io.troupe.services.component;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.params.provider.Arguments.arguments;

import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.broker.ProviderException;
import io.troupe.bus.Address;
import io.troupe.bus.BusTopic;
import io.troupe.bus.Operation;
import io.troupe.bus.RemoteFailure;
import io.troupe.services.component.Buffering.OverflowPolicy;
import io.troupe.services.component.DataConversion.Losses;
import io.troupe.services.component.ScriptedComponent.Number;
import java.lang.reflect.Proxy;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.function.Consumer;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.Arguments;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.MethodSource;
import org.junit.jupiter.params.provider.ValueSource;

/** The three units of a component interface, with a scripted component on a manually driven space. */
class ComponentInterfaceTest extends ComponentBench {
    private static final Duration LIMIT = Duration.ofSeconds(1);
    private static final Buffering TWO = new Buffering(2, OverflowPolicy.DROP_OLDEST);

    private final ScriptedComponent<String, String> script = ScriptedComponent.counter();
    private final List<Number> heard = listenTo(ScriptedComponent.OUT);

    private Component<String, String> component() {
        return script.component("counting", ScriptedComponent.IN, ScriptedComponent.OUT);
    }

    private ComponentInterface<String, String> opened() {
        return open("counter", component(), notes);
    }

    private ComponentInterface<String, String> running() {
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
        assertThat(provider.state()).isEqualTo(ComponentState.NOT_INVOKED);
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
        assertThat(notes.take())
                .containsExactly("counter INVOKING", "counter RUNNING", "counter TERMINATING", "counter TERMINATED");
    }

    @Test
    void control_comesAsMessagesOverTheBus_alsoFromARemoteProvider_whichHearsWhatIsWrong() {
        var provider = opened();
        assertThat(test.get(ask(Control.HEALTH, new Control.AskHealth("user"))))
                .isEqualTo(new Control.HealthReport("counter", "NOT_INVOKED", "here/counter has not been invoked", 0));
        assertThat(test.get(ask(Control.INVOKE, new Control.Invoke("user"))))
                .isEqualTo(new Control.Done("counter", "RUNNING", 1));
        var healthy = test.get(ask(Control.HEALTH, new Control.AskHealth("user")));
        assertThat(healthy.isHealthy()).isTrue();
        assertThat(test.get(ask(Control.TERMINATE, new Control.Terminate("user"))))
                .isEqualTo(new Control.Done("counter", "TERMINATED", 1));
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
        var remote = new RemoteProvider(user, provider.address(), LIMIT);
        test.get(remote.start());
        test.get(remote.check());
        script.health = () -> Promise.failed(new IllegalStateException("out of numbers"));
        assertError(remote.check(), "out of numbers");
        script.health = () -> Promise.failed(new IllegalStateException(""));
        assertError(remote.check(), "java.lang.IllegalStateException");
        test.get(remote.stop());
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
    }

    @Test
    void lateControl_ofAnEarlierLife_doesNotHitALaterOne() {
        var provider = opened();
        var remote = new RemoteProvider(user, provider.address(), LIMIT);
        test.get(remote.start());
        fail("power");
        assertError(remote.check(), "here/counter has failed: power");
        var again = new RemoteProvider(user, provider.address(), LIMIT);
        test.get(again.start());
        test.get(remote.stop());
        assertThat(provider.state()).as("after the end of life 1").isEqualTo(ComponentState.RUNNING);
        assertError(remote.check(), "life 1 of here/counter has ended, and life 2 runs");
        test.get(again.check());
        assertThat(test.get(ask(Control.TERMINATE, new Control.Terminate("user", 2))))
                .isEqualTo(new Control.Done("counter", "TERMINATED", 2));
        notes.take();
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
        assertThat(provider.state()).isEqualTo(ComponentState.FAILED);
        assertThat(notes.take()).anySatisfy(note -> assertThat(note).contains("has failed"));
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
        assertThat(provider.conversion().losses().refused()).isEqualTo(4);
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
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
        assertHeard(1, 2);
        assertThat(notes.take()).anyMatch(note -> note.startsWith("counter could not publish other"));
        assertThat(provider.conversion().losses().refused()).isEqualTo(1);
    }

    // ---- components that fail

    private void assertInvocationFails(ComponentInterface<?, ?> provider, String why) {
        assertError(provider.start(), "here/counter has failed: " + why);
        assertError(provider.check(), "here/counter has failed: " + why);
        assertThat(provider.state()).isEqualTo(ComponentState.FAILED);
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
        assertThat(notes.take()).containsExactly("counter FAILED", "counter has failed: " + why);
    }

    @Test
    void componentThatDies_hasFailed_andSaysSoAtOnce_itsLastWordsAreStillPublished() {
        var provider = running();
        var end = provider.whenEnded();
        end.handle((ended, error) -> null);
        test.runQueued();
        test.run(() -> {
            script.signals().data("7");
            script.signals().failed(new IllegalStateException("burnt out"));
        });
        assertHeard(7);
        assertError(provider.check(), "here/counter has failed: burnt out");
        assertError(end, "here/counter has failed: burnt out");
        test.get(provider.stop());
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
    }

    @Test
    void lifeThatIsNotTerminated_isTerminatedAgain_andNoneBeginsBesideIt() {
        script.terminate = () -> Promise.failed(new IllegalStateException("process still alive"));
        var provider = running();
        assertError(provider.stop(), "here/counter has failed: process still alive");
        assertError(provider.stop(), "here/counter has failed: process still alive");
        assertError(
                provider.start(), "here/counter cannot be invoked: its life before has not ended: process still alive");
        assertThat(provider.state()).isEqualTo(ComponentState.FAILED);
        assertThat(script.calls).containsExactly("invoke", "terminate", "terminate", "terminate");
        script.terminate = Promise::done;
        test.get(provider.start());
        assertThat(script.calls.subList(4, script.calls.size())).containsExactly("terminate", "invoke");
        test.get(provider.stop());
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
    }

    @Test
    void failedLifeThatIsNotTerminated_isTerminatedByTheNextStop() {
        script.terminate = () -> Promise.failed(new IllegalStateException("process still alive"));
        var provider = running();
        fail("burnt out");
        assertThat(test.error(provider.start())).hasMessageEndingWith("has not ended: process still alive");
        script.terminate = Promise::done;
        test.get(provider.stop());
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
        assertThat(script.calls).containsExactly("invoke", "terminate", "terminate", "terminate");
        test.get(provider.start());
    }

    @Test
    void componentThatHangs_isGivenUp_andWhenItRunsAfterAll_isTerminatedAgain() {
        var late = slowInvocation();
        var provider = opened();
        var started = provider.start();
        test.get(provider.stop());
        assertError(started, "here/counter was terminated while it was being invoked");
        notes.take();
        test.run(() -> late.resolve(null));
        assertThat(script.calls).containsExactly("invoke", "terminate", "terminate");
        assertThat(notes.take())
                .containsExactly("counter ran only after it had been given up, and is terminated again");
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
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
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
        test.get(provider.start());
        test.run(() -> past.failed(new IllegalStateException("from the grave")));
        test.get(provider.check());
        output("1");
        assertHeard(1);
    }

    // ---- observers that act

    private ComponentInterface<String, String> watched(ComponentState when, Consumer<ComponentInterface<?, ?>> action) {
        var watched = new ArrayList<ComponentInterface<String, String>>();
        var once = new AtomicBoolean();
        watched.add(open("counter", component(), new RecordingObserver() {
            @Override
            public void changed(Address component, ComponentState state) {
                if (state == when && once.compareAndSet(false, true)) {
                    action.accept(watched.getFirst());
                }
            }
        }));
        return watched.getFirst();
    }

    @Test
    void observerThatRestartsAFailedComponent_beginsTheNextLifeAfterTheFailedOne() {
        var provider = watched(ComponentState.FAILED, ComponentInterface::start);
        test.get(provider.start());
        fail("burnt out");
        assertThat(provider.state()).isEqualTo(ComponentState.RUNNING);
        publish(1);
        assertThat(script.calls).containsExactly("invoke", "terminate", "invoke", "1");
    }

    @Test
    void observerThatRestartsATerminatedComponent_beginsOneLife_alsoIfAStartWaits() {
        var slow = slowTermination();
        var provider = watched(ComponentState.TERMINATED, ComponentInterface::start);
        test.get(provider.start());
        var stopped = provider.stop();
        var started = provider.start();
        test.run(() -> slow.resolve(null));
        assertThat(stopped.isDone() && started.isDone()).isTrue();
        assertThat(provider.state()).isEqualTo(ComponentState.RUNNING);
        publish(1);
        assertThat(script.calls).containsExactly("invoke", "terminate", "invoke", "1");
    }

    @Test
    void observerThatStopsAComponentThatIsBeingInvoked_leavesNothingThatRuns() {
        var provider = watched(ComponentState.INVOKING, ComponentInterface::stop);
        assertError(provider.start(), "here/counter was terminated while it was being invoked");
        assertThat(script.calls).containsExactly("terminate");
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
    }

    @Test
    void observerThatThrows_changesNothing() {
        var throwing = Proxy.newProxyInstance(
                getClass().getClassLoader(), new Class<?>[] {ComponentObserver.class}, (proxy, method, arguments) -> {
                    throw method.getName().equals("changed")
                            ? new AssertionError("changed")
                            : new IllegalStateException(method.getName());
                });
        var provider = open("counter", component(), (ComponentObserver) throwing);
        test.get(provider.start());
        publish(-1, 1);
        test.run(() -> script.signals().info("something"));
        test.get(provider.stop());
        assertThat(script.calls).containsExactly("invoke", "1", "terminate");
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
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
        assertError(started, "here/counter was terminated while it waited to be invoked");
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
        assertError(started, "here/counter was terminated while it waited to be invoked");
        assertThat(stopped.isDone()).isFalse();
        test.run(() -> slow.reject(new IllegalStateException("stuck")));
        assertError(stopped, "here/counter has failed: stuck");
        assertThat(script.calls).containsExactly("invoke", "terminate");
        assertThat(provider.state()).isEqualTo(ComponentState.FAILED);
        assertThat(notes.take()).contains("counter could not be terminated after it had failed: stuck");
    }

    @Test
    void closedInterface_startsNothing_howeverItIsAsked() {
        var slow = slowTermination();
        var provider = running();
        test.run(provider::close);
        var overTheBus = ask(Control.INVOKE, new Control.Invoke("user"));
        assertError(provider.start(), "here/counter has left the bus, expected an open interface");
        assertThat(test.error(overTheBus))
                .hasMessageContaining("asked here/counter for component/invoke: there is no such port");
        test.run(() -> slow.resolve(null));
        assertThat(script.calls).containsExactly("invoke", "terminate");
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
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
        assertThat(notes.take()).contains("counter could not be terminated: here/counter has failed: stuck");
    }

    @Test
    void interfaceOpenedOffEverySpace_isRefusedByName() {
        assertThatThrownBy(() -> ComponentInterface.open(bus, "counter", component(), notes))
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("the interface of counter was opened on no actor space");
    }
}
