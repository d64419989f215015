package io.troupe.services.component;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.broker.ProviderException;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusSettings;
import io.troupe.bus.BusTopic;
import io.troupe.bus.Operation;
import io.troupe.bus.RemoteFailure;
import io.troupe.services.component.Buffering.OverflowPolicy;
import io.troupe.services.component.ScriptedComponent.Number;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

/**
 * The three units of a component interface, with a scripted component on a manually driven space.
 *
 * <p>The file is long because the same component is used for all tests: a run without faults and its control by bus
 * messages; the buffer between component and bus; each failure of a run (invocation, data, conversion, a hanging
 * component, termination); overlapping runs (start, stop and restart during one another); and closing.
 */
class ComponentInterfaceTest {
    private static final Duration LIMIT = Duration.ofSeconds(1);

    private final TestSpace test = new TestSpace();
    private final Bus bus = Bus.inProcess("here", BusSettings.on(test.space()));
    private final ScriptedComponent script = new ScriptedComponent();
    private final RecordingObserver notes = new RecordingObserver();
    private final List<Integer> heard = new ArrayList<>();
    private @Nullable BusPort user;

    @BeforeEach
    void aUserHearsTheComponent() {
        test.run(() -> {
            user = bus.attach("user");
            user.subscribe(ScriptedComponent.OUT, (number, from) -> heard.add(number.value()));
        });
    }

    @AfterEach
    void nothingIsLeft() {
        bus.close();
        test.crank();
        test.close();
    }

    private ComponentInterface<String, String> open(Component<String, String> component) {
        var opened = new ArrayList<ComponentInterface<String, String>>();
        test.run(() -> opened.add(ComponentInterface.open(bus, "counter", component, notes)));
        return opened.getFirst();
    }

    private ComponentInterface<String, String> running() {
        var provider = open(script.component());
        test.get(provider.start().thenApply(runs -> true));
        notes.take();
        return provider;
    }

    private void publish(int... values) {
        test.run(() -> {
            for (int value : values) {
                user.publish(ScriptedComponent.IN, new Number(value));
            }
        });
    }

    private <A extends Record, Q extends Record> Promise<A> ask(Operation<Q, A> operation, Q question) {
        return user.ask(new Address("here", "counter"), operation, question, LIMIT);
    }

    // ---- the three units

    @Test
    void component_isInvoked_takesData_givesData_andIsTerminated() {
        var provider = open(script.component());
        assertThat(provider.state()).isEqualTo(ComponentState.NOT_INVOKED);
        test.get(provider.start().thenApply(runs -> true));
        publish(1, 2);
        test.run(() -> script.signals().data("3"));
        test.get(provider.check().thenApply(well -> true));
        test.get(provider.stop().thenApply(ended -> true));
        assertThat(script.calls).containsExactly("invoke", "1", "2", "terminate");
        assertThat(heard).containsExactly(3);
        assertThat(notes.take())
                .containsExactly("counter INVOKING", "counter RUNNING", "counter TERMINATING", "counter TERMINATED");
    }

    @Test
    void control_comesAsMessagesOverTheBus() {
        var provider = open(script.component());
        assertThat(test.get(ask(Control.HEALTH, new Control.AskHealth("user"))))
                .isEqualTo(new Control.HealthReport("counter", "NOT_INVOKED", "here/counter has not been invoked"));
        assertThat(test.get(ask(Control.INVOKE, new Control.Invoke("user"))))
                .isEqualTo(new Control.Done("counter", "RUNNING"));
        assertThat(test.get(ask(Control.HEALTH, new Control.AskHealth("user"))).isHealthy())
                .isTrue();
        assertThat(test.get(ask(Control.TERMINATE, new Control.Terminate("user"))))
                .isEqualTo(new Control.Done("counter", "TERMINATED"));
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
    }

    @Test
    void remoteProvider_controlsTheComponentByMessages_andHearsWhatIsWrong() {
        var provider = open(script.component());
        var remote = new RemoteProvider(user, provider.address(), LIMIT);
        test.get(remote.start().thenApply(runs -> true));
        test.get(remote.check().thenApply(well -> true));
        script.health = () -> Promise.failed(new IllegalStateException("out of numbers"));
        assertThat(test.error(remote.check()))
                .isInstanceOf(ProviderException.class)
                .hasMessage("out of numbers");
        test.get(remote.stop().thenApply(ended -> true));
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
    }

    @Test
    void dataOperation_isAnsweredWhileTheComponentRuns() {
        var half = new Operation<>("half", Number.class, Number.class, Operation.Kind.DATA);
        var provider = open(script.component());
        test.run(() -> provider.answer(half, number -> Promise.of(new Number(number.value() / 2))));
        assertThat(test.error(ask(half, new Number(8))))
                .isInstanceOf(RemoteFailure.class)
                .hasMessageContaining("here/counter has not been invoked");
        test.get(provider.start().thenApply(runs -> true));
        assertThat(test.get(ask(half, new Number(8)))).isEqualTo(new Number(4));
    }

    // ---- the buffer

    @Test
    void whatComesWhileTheComponentIsBeingInvoked_waitsForIt() {
        var slow = ScriptedComponent.later();
        script.invoke = () -> slow;
        var provider = open(script.component());
        var started = provider.start();
        publish(1, 2);
        assertThat(script.calls).containsExactly("invoke");
        test.run(() -> slow.resolve(null));
        assertThat(started.isDone()).isTrue();
        assertThat(script.calls).containsExactly("invoke", "1", "2");
    }

    @Test
    void failureOnTheFirstBufferedValue_isAFailureOfARunningComponent() {
        var slow = ScriptedComponent.later();
        script.invoke = () -> slow;
        var provider = open(script.component());
        var started = provider.start();
        publish(13);
        test.run(() -> slow.resolve(null));
        test.get(started.thenApply(runs -> true)); // it did start
        assertThat(provider.state()).isEqualTo(ComponentState.FAILED);
        assertThat(notes.take()).anySatisfy(note -> assertThat(note).contains("has failed"));
    }

    @Test
    void fullBuffer_losesTheOldest_countsIt_andTells() {
        var slow = ScriptedComponent.later();
        script.invoke = () -> slow;
        var provider =
                open(script.component().buffered(new Buffering(2, OverflowPolicy.DROP_OLDEST), Buffering.STREAM));
        var started = provider.start();
        publish(1, 2, 3);
        test.run(() -> slow.resolve(null));
        assertThat(started.isDone()).isTrue();
        assertThat(script.calls).containsExactly("invoke", "2", "3");
        assertThat(notes.take()).contains("counter dropped Number[value=1], 1 so far");
        assertThat(provider.conversion().losses()).isEqualTo(new DataConversion.Losses(1, 0, 0));
    }

    @Test
    void latestOfEachTopic_keepsTheNewest_andCountsTheRest() {
        var slow = ScriptedComponent.later();
        script.invoke = () -> slow;
        var provider = open(script.component().buffered(Buffering.LATEST, Buffering.STREAM));
        var started = provider.start();
        publish(1, 2, 3);
        test.run(() -> slow.resolve(null));
        assertThat(started.isDone()).isTrue();
        assertThat(script.calls).containsExactly("invoke", "3");
        assertThat(provider.conversion().losses()).isEqualTo(new DataConversion.Losses(0, 2, 0));
    }

    @Test
    void burstFromTheComponent_overflowsItsOwnBufferOnly() {
        var provider =
                open(script.component().buffered(Buffering.STREAM, new Buffering(2, OverflowPolicy.DROP_OLDEST)));
        test.get(provider.start().thenApply(runs -> true));
        test.run(() ->
                List.of("1", "2", "3", "4").forEach(each -> script.signals().data(each)));
        assertThat(heard).containsExactly(3, 4);
        assertThat(provider.conversion().losses().dropped()).isEqualTo(2);
    }

    @Test
    void conversionThatFails_costsThatValueOnly_andIsTold() {
        var provider = running();
        publish(1, -1, 2);
        test.run(
                () -> List.of("3", "four", "5").forEach(each -> script.signals().data(each)));
        assertThat(script.calls).containsExactly("invoke", "1", "2");
        assertThat(heard).containsExactly(3, 5);
        assertThat(notes.take())
                .containsExactly(
                        "counter could not convert counter/in Number[value=-1]: a count is -1, expected 0 or more",
                        "counter could not convert four: For input string: \"four\"");
        assertThat(provider.conversion().losses().refused()).isEqualTo(2);
        test.get(provider.check().thenApply(well -> true));
    }

    // ---- components that fail

    @Test
    void componentThatThrowsWhenInvoked_hasFailed_andCanBeInvokedAgain() {
        script.invoke = () -> {
            throw new IllegalStateException("no power");
        };
        var provider = open(script.component());
        assertThat(test.error(provider.start()))
                .isInstanceOf(ProviderException.class)
                .hasMessage("here/counter has failed: no power");
        assertThat(test.error(provider.check())).hasMessage("here/counter has failed: no power");
        assertThat(script.calls).containsExactly("invoke", "terminate");
        script.invoke = Promise::done;
        test.get(provider.start().thenApply(runs -> true));
        test.get(provider.check().thenApply(well -> true));
    }

    @Test
    void componentThatThrowsOnData_hasFailed_isTerminated_andHearsNothingMore() {
        var provider = running();
        publish(12, 13, 14);
        assertThat(script.calls).containsExactly("invoke", "12", "13", "terminate");
        assertThat(test.error(provider.check())).hasMessage("here/counter has failed: 13 is bad luck");
        publish(15);
        assertThat(script.calls).hasSize(4);
        assertThat(notes.take()).containsExactly("counter FAILED", "counter has failed: 13 is bad luck");
    }

    @Test
    void componentThatDies_hasFailed_andSaysSoAtOnce_itsLastWordsAreStillPublished() {
        var provider = running();
        var end = provider.whenEnded();
        end.handle((ended, error) -> null);
        test.crank();
        test.run(() -> {
            script.signals().data("7");
            script.signals().failed(new IllegalStateException("burnt out"));
        });
        assertThat(heard).containsExactly(7);
        assertThat(test.error(provider.check())).hasMessage("here/counter has failed: burnt out");
        assertThat(test.error(end)).hasMessage("here/counter has failed: burnt out");
        test.get(provider.stop().thenApply(ended -> true));
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
    }

    @Test
    void componentThatIsNotTerminatedProperly_hasFailed() {
        script.terminate = () -> Promise.failed(new IllegalStateException("stuck"));
        var provider = running();
        assertThat(test.error(provider.stop())).hasMessage("here/counter has failed: stuck");
        assertThat(provider.state()).isEqualTo(ComponentState.FAILED);
    }

    @Test
    void lifeThatIsNotTerminated_isTerminatedAgain_andNoneBeginsBesideIt() {
        script.terminate = () -> Promise.failed(new IllegalStateException("process still alive"));
        var provider = running();
        assertThat(test.error(provider.stop())).hasMessage("here/counter has failed: process still alive");
        assertThat(test.error(provider.stop())).hasMessage("here/counter has failed: process still alive");
        assertThat(test.error(provider.start()))
                .isInstanceOf(ProviderException.class)
                .hasMessage("here/counter cannot be invoked: its life before has not ended: process still alive");
        assertThat(provider.state()).isEqualTo(ComponentState.FAILED);
        assertThat(script.calls).containsExactly("invoke", "terminate", "terminate", "terminate");
        script.terminate = Promise::done;
        test.get(provider.start().thenApply(runs -> true));
        assertThat(script.calls)
                .containsExactly("invoke", "terminate", "terminate", "terminate", "terminate", "invoke");
        test.get(provider.stop().thenApply(ended -> true));
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
    }

    @Test
    void failedLifeThatIsNotTerminated_isTerminatedByTheNextStop() {
        script.terminate = () -> Promise.failed(new IllegalStateException("process still alive"));
        var provider = running();
        test.run(() -> script.signals().failed(new IllegalStateException("burnt out")));
        assertThat(test.error(provider.start())).hasMessageEndingWith("has not ended: process still alive");
        script.terminate = Promise::done;
        test.get(provider.stop().thenApply(ended -> true));
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
        assertThat(script.calls).containsExactly("invoke", "terminate", "terminate", "terminate");
        test.get(provider.start().thenApply(runs -> true));
    }

    private ComponentInterface<String, String> watched(ComponentState when, Consumer<ComponentInterface<?, ?>> action) {
        var opened = new ArrayList<ComponentInterface<String, String>>();
        var once = new AtomicBoolean();
        var observer = new RecordingObserver() {
            @Override
            public void changed(Address component, ComponentState state) {
                if (state == when && once.compareAndSet(false, true)) {
                    action.accept(opened.getFirst());
                }
            }
        };
        test.run(() -> opened.add(ComponentInterface.open(bus, "counter", script.component(), observer)));
        return opened.getFirst();
    }

    @Test
    void observerThatRestartsAFailedComponent_beginsTheNextLifeAfterTheFailedOne() {
        var provider = watched(ComponentState.FAILED, ComponentInterface::start);
        test.get(provider.start().thenApply(runs -> true));
        test.run(() -> script.signals().failed(new IllegalStateException("burnt out")));
        assertThat(script.calls).containsExactly("invoke", "terminate", "invoke");
        assertThat(provider.state()).isEqualTo(ComponentState.RUNNING);
        publish(1);
        assertThat(script.calls).endsWith("invoke", "1");
    }

    @Test
    void observerThatRestartsATerminatedComponent_beginsOneLife_alsoIfAStartWaits() {
        var slow = ScriptedComponent.later();
        script.terminate = () -> slow;
        var provider = watched(ComponentState.TERMINATED, ComponentInterface::start);
        test.get(provider.start().thenApply(runs -> true));
        var stopped = provider.stop();
        var started = provider.start();
        test.run(() -> slow.resolve(null));
        assertThat(stopped.isDone() && started.isDone()).isTrue();
        assertThat(script.calls).containsExactly("invoke", "terminate", "invoke");
        assertThat(provider.state()).isEqualTo(ComponentState.RUNNING);
        publish(1);
        assertThat(script.calls).endsWith("invoke", "1");
    }

    @Test
    void observerThatStopsAComponentThatIsBeingInvoked_leavesNothingThatRuns() {
        var provider = watched(ComponentState.INVOKING, ComponentInterface::stop);
        assertThat(test.error(provider.start())).hasMessage("here/counter was terminated while it was being invoked");
        assertThat(script.calls).containsExactly("terminate");
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
    }

    @Test
    void componentThatHangs_isGivenUp_andWhenItRunsAfterAll_isTerminatedAgain() {
        var late = ScriptedComponent.later();
        script.invoke = () -> late;
        var provider = open(script.component());
        var started = provider.start();
        test.get(provider.stop().thenApply(ended -> true));
        assertThat(test.error(started)).hasMessage("here/counter was terminated while it was being invoked");
        notes.take();
        test.run(() -> late.resolve(null));
        assertThat(script.calls).containsExactly("invoke", "terminate", "terminate");
        assertThat(notes.take())
                .containsExactly("counter ran only after it had been given up, and is terminated again");
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
    }

    @Test
    void whatIsSaidAfterTheEnd_isToldAndNotPublished() {
        var provider = running();
        test.get(provider.stop().thenApply(ended -> true));
        test.run(() -> {
            script.signals().data("9");
            script.signals().failed(new IllegalStateException("too late to fail"));
        });
        assertThat(heard).isEmpty();
        assertThat(notes.take()).contains("counter gave data after its end: 9");
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
    }

    @Test
    void signalsOfAnEarlierLife_doNotTouchTheNext() {
        var provider = running();
        var past = script.signals();
        test.get(provider.stop().thenApply(ended -> true));
        test.get(provider.start().thenApply(runs -> true));
        test.run(() -> past.failed(new IllegalStateException("from the grave")));
        test.get(provider.check().thenApply(well -> true));
        test.run(() -> script.signals().data("1"));
        assertThat(heard).containsExactly(1);
    }

    @Test
    void nextLife_beginsWhenTheFailedOneHasBeenTerminated() {
        var slow = ScriptedComponent.later();
        script.terminate = () -> slow;
        var provider = running();
        test.run(() -> script.signals().failed(new IllegalStateException("burnt out")));
        var first = provider.start();
        var second = provider.start();
        test.crank();
        assertThat(script.calls).containsExactly("invoke", "terminate");
        test.run(() -> slow.resolve(null));
        assertThat(first.isDone() && second.isDone()).isTrue();
        assertThat(script.calls).containsExactly("invoke", "terminate", "invoke");
        test.get(provider.check().thenApply(well -> true));
    }

    @Test
    void stopOfAFailedComponent_waitsForItsTermination_andGivesUpTheStartThatWaits() {
        var slow = ScriptedComponent.later();
        script.terminate = () -> slow;
        var provider = running();
        test.run(() -> script.signals().failed(new IllegalStateException("burnt out")));
        var started = provider.start();
        var stopped = provider.stop();
        assertThat(test.error(started)).hasMessage("here/counter was terminated while it waited to be invoked");
        assertThat(stopped.isDone()).isFalse();
        test.run(() -> slow.reject(new IllegalStateException("stuck")));
        assertThat(test.error(stopped)).hasMessage("here/counter has failed: stuck");
        assertThat(script.calls).containsExactly("invoke", "terminate");
        assertThat(provider.state()).isEqualTo(ComponentState.FAILED);
        assertThat(notes.take()).contains("counter could not be terminated after it had failed: stuck");
    }

    @Test
    void lastWordsThatCannotBePublished_areReported_andTheStopIsSettled() {
        script.conversion = new ScriptedComponent.Texts() {
            @Override
            public List<ApplicationData<?>> toApplication(String output) {
                return output.equals("bad")
                        ? List.of(new ApplicationData<>(
                                new BusTopic<>("other", Unfit.class), new Unfit(Collections.singletonList(null))))
                        : super.toApplication(output);
            }
        };
        script.terminate = () -> {
            script.signals().data("1");
            script.signals().data("bad");
            script.signals().data("2");
            return Promise.done();
        };
        var provider = running();
        test.get(provider.stop().thenApply(ended -> true));
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
        assertThat(heard).containsExactly(1, 2);
        assertThat(notes.take()).anyMatch(note -> note.startsWith("counter could not publish other"));
        assertThat(provider.conversion().losses().refused()).isEqualTo(1);
    }

    /** A record that a bus rejects if its list has a null element. */
    record Unfit(List<String> texts) {}

    @Test
    void errorOfTheInvocation_isAFailure() {
        script.invoke = () -> {
            throw new ExceptionInInitializerError("no such library");
        };
        var provider = open(script.component());
        assertThat(test.error(provider.start())).hasMessage("here/counter has failed: no such library");
        assertThat(provider.state()).isEqualTo(ComponentState.FAILED);
    }

    @Test
    void errorOnTheWayToTheInvocation_isAFailure() {
        var whole = script.component();
        var provider = open(new Component<String, String>(
                whole.service(),
                whole.capabilities(),
                whole.subscribes(),
                whole.publishes(),
                () -> {
                    throw new NoClassDefFoundError("a/driver");
                },
                whole.conversion(),
                whole.input(),
                whole.output()));
        assertThat(test.error(provider.start())).hasMessage("here/counter has failed: a/driver");
        assertThat(provider.state()).isEqualTo(ComponentState.FAILED);
    }

    @Test
    void invocationThatAnswersNull_isAFailure() {
        script.invoke = () -> null;
        var provider = open(script.component());
        assertThat(test.error(provider.start())).hasMessageEndingWith("it answered null, expected a promise");
        assertThat(provider.state()).isEqualTo(ComponentState.FAILED);
    }

    @Test
    void errorOnData_isAFailure() {
        var provider = running();
        publish(666, 1);
        assertThat(test.error(provider.check())).hasMessage("here/counter has failed: too deep");
        assertThat(script.calls).containsExactly("invoke", "666", "terminate");
    }

    @Test
    void errorOfAConversion_costsThatValueOnly() {
        script.conversion = new ScriptedComponent.Texts() {
            @Override
            public String toComponent(ApplicationData<?> input) {
                var text = super.toComponent(input);
                assertNot(text, "7");
                return text;
            }

            @Override
            public List<ApplicationData<?>> toApplication(String output) {
                assertNot(output, "8");
                return super.toApplication(output);
            }

            private void assertNot(String text, String bad) {
                if (text.equals(bad)) {
                    throw new AssertionError(text);
                }
            }
        };
        var provider = running();
        publish(7, 1);
        test.run(() -> List.of("8", "2").forEach(each -> script.signals().data(each)));
        assertThat(script.calls).containsExactly("invoke", "1");
        assertThat(heard).containsExactly(2);
        assertThat(provider.conversion().losses().refused()).isEqualTo(2);
    }

    @Test
    void observerThatThrows_changesNothing() {
        var throwing = new ComponentObserver() {
            @Override
            public void changed(Address component, ComponentState state) {
                throw new AssertionError("changed");
            }

            @Override
            public void dropped(Address component, ApplicationData<?> lost, long total) {
                throw new IllegalStateException("dropped");
            }

            @Override
            public void problem(Address component, String what, Throwable why) {
                throw new IllegalStateException("problem");
            }

            @Override
            public void info(Address component, String what) {
                throw new IllegalStateException("told");
            }
        };
        var opened = new ArrayList<ComponentInterface<String, String>>();
        test.run(() -> opened.add(ComponentInterface.open(bus, "counter", script.component(), throwing)));
        var provider = opened.getFirst();
        test.get(provider.start().thenApply(runs -> true));
        publish(-1, 1);
        test.run(() -> script.signals().info("something"));
        test.get(provider.stop().thenApply(ended -> true));
        assertThat(script.calls).containsExactly("invoke", "1", "terminate");
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
    }

    @Test
    void failureWithoutAMessage_isNotWell() {
        var provider = running();
        script.health = () -> Promise.failed(new IllegalStateException(""));
        assertThat(test.error(new RemoteProvider(user, provider.address(), LIMIT).check()))
                .isInstanceOf(ProviderException.class)
                .hasMessage("java.lang.IllegalStateException");
    }

    // ---- calls that meet

    @Test
    void startDuringAStart_waitsForTheSame_andStopIsIdempotent() {
        var slow = ScriptedComponent.later();
        script.invoke = () -> slow;
        var provider = open(script.component());
        var first = provider.start();
        var second = provider.start();
        test.run(() -> slow.resolve(null));
        assertThat(first.isDone() && second.isDone()).isTrue();
        test.get(provider.stop().thenApply(ended -> true));
        test.get(provider.stop().thenApply(ended -> true));
        assertThat(script.calls).containsExactly("invoke", "terminate");
    }

    @Test
    void startDuringAStop_begins_whenThatIsOver() {
        var slow = ScriptedComponent.later();
        script.terminate = () -> slow;
        var provider = running();
        var stopped = provider.stop();
        var started = provider.start();
        test.crank();
        assertThat(script.calls).containsExactly("invoke", "terminate");
        test.run(() -> slow.resolve(null));
        assertThat(stopped.isDone() && started.isDone()).isTrue();
        assertThat(script.calls).containsExactly("invoke", "terminate", "invoke");
    }

    @Test
    void stopDuringAStop_givesUpTheStartThatWaits() {
        var slow = ScriptedComponent.later();
        script.terminate = () -> slow;
        var provider = running();
        provider.stop();
        var started = provider.start();
        var stopped = provider.stop();
        assertThat(test.error(started)).hasMessage("here/counter was terminated while it waited to be invoked");
        test.run(() -> slow.resolve(null));
        assertThat(stopped.isDone()).isTrue();
        assertThat(script.calls).containsExactly("invoke", "terminate");
    }

    @Test
    void closedInterface_startsNothing_howeverItIsAsked() {
        var slow = ScriptedComponent.later();
        script.terminate = () -> slow;
        var provider = running();
        test.run(provider::close);
        var overTheBus = ask(Control.INVOKE, new Control.Invoke("user"));
        assertThat(test.error(provider.start()))
                .hasMessage("here/counter has left the bus, expected an open interface");
        assertThat(test.error(overTheBus))
                .hasMessageContaining("asked here/counter for component/invoke: nobody is there");
        test.run(() -> slow.resolve(null));
        assertThat(script.calls).containsExactly("invoke", "terminate");
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
    }

    @Test
    void close_freesTheNameAtOnce_andReportsATerminationThatFailsLater() {
        var slow = ScriptedComponent.later();
        script.terminate = () -> slow;
        var provider = running();
        test.run(provider::close);
        open(new ScriptedComponent().component());
        notes.take();
        test.run(() -> slow.reject(new IllegalStateException("stuck")));
        assertThat(notes.take()).contains("counter could not be terminated: here/counter has failed: stuck");
    }

    @Test
    void close_terminatesWhatRuns_andFreesTheName() {
        var provider = running();
        test.run(provider::close);
        assertThat(script.calls).containsExactly("invoke", "terminate");
        open(script.component());
    }

    @Test
    void interfaceOpenedOffEverySpace_isRefusedByName() {
        assertThatThrownBy(() -> ComponentInterface.open(bus, "counter", script.component(), notes))
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("the interface of counter was opened on no actor space");
    }
}
