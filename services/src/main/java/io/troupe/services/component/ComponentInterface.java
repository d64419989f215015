package io.troupe.services.component;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.broker.Provider;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import io.troupe.bus.Operation;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.function.Function;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * Connects a component with the bus and the broker: it consists of the CCU, the DCU and the BCU, and manages the
 * component's lifecycle.
 *
 * <p><b>Role.</b> A {@link Provider}: a broker with which it is registered starts it when its service is required. The
 * messages of {@link Control} control it as well.
 *
 * <p><b>Threads.</b> Belongs to one actor space and is opened and closed on its thread. The methods of {@link Provider}
 * may be called from any thread.
 *
 * <p><b>Order.</b> A run lasts from invocation to termination. The component is subscribed to its topics from the start
 * of the invocation; values that arrive before it runs are buffered in the DCU. Output during the termination by
 * {@link #stop} is still published. Any later output or failure is only reported to the observer.
 *
 * <p><b>Errors.</b> A component that fails is terminated, and {@link #check} is rejected with the error until the
 * component is started again. If a termination fails, the component may still be running: {@link #start} and
 * {@link #stop} repeat the termination, and are rejected until it succeeds.
 *
 * <p><b>Source.</b> Paper, section 2.2.2 and Figure 6.
 */
public final class ComponentInterface<I, O> implements Provider, AutoCloseable {
    private final ActorSpace space;
    private final Component<I, O> component;
    private final ComponentObserver observer;
    private final BusCommunication bus;
    private final DataConversion<I, O> conversion;
    private final ComponentLifecycle<I, O> lifecycle;
    private final AtomicBoolean outputScheduled = new AtomicBoolean();
    private final AtomicBoolean inputScheduled = new AtomicBoolean();

    private ComponentInterface(
            ActorSpace space, BusCommunication bus, Component<I, O> component, ComponentObserver observer) {
        this.space = space;
        this.bus = bus;
        this.component = component;
        this.observer = new SafeObserver(observer);
        this.conversion = new DataConversion<>(bus.address(), component, this.observer);
        this.lifecycle = new ComponentLifecycle<>(
                space, bus.address(), component.communication(), this.observer, new DataPath());
    }

    /**
     * Attaches a component to the bus without starting it.
     *
     * @param name the component's name on the bus
     * @throws IllegalStateException if the current thread is not that of an actor space
     */
    public static <I, O> ComponentInterface<I, O> open(
            Bus bus, String name, Component<I, O> component, ComponentObserver observer) {
        ActorSpace space = ActorSpace.current();
        if (space == null) {
            throw new IllegalStateException("the interface of " + name
                    + " was opened on no actor space, expected the one it is to live on: use space.execute(..)");
        }
        var opened = new ComponentInterface<>(space, BusCommunication.attach(bus, name), component, observer);
        opened.answerControl();
        return opened;
    }

    private void answerControl() {
        bus.answer(Control.INVOKE, invoke -> lifecycle.invoke().thenApply(running -> done()));
        bus.answer(
                Control.TERMINATE,
                terminate -> lifecycle.terminate(terminate.life()).thenApply(ended -> done()));
        bus.answer(Control.HEALTH, ask -> lifecycle.health(ask.life()).handle((well, wrong) -> report(wrong)));
    }

    private Control.Done done() {
        return new Control.Done(address().name(), lifecycle.componentState().name(), lifecycle.life());
    }

    private Control.HealthReport report(@Nullable Throwable wrong) {
        String problem = wrong == null ? "" : ComponentLifecycle.messageOf(wrong);
        return new Control.HealthReport(
                address().name(), lifecycle.componentState().name(), problem, lifecycle.life());
    }

    /** The address of the component on the bus. */
    public Address address() {
        return bus.address();
    }

    /** The description of the component. */
    public Component<I, O> component() {
        return component;
    }

    /** The DCU, which counts lost values. */
    public DataConversion<I, O> conversion() {
        return conversion;
    }

    /** The current state of the component. Call on the space of the interface. */
    public ComponentState state() {
        return lifecycle.componentState();
    }

    /**
     * Registers a handler for requests for data. Requests are rejected while the component does not run. Call on the
     * space of the interface.
     */
    public <Q extends Record, A extends Record> void answer(
            Operation<Q, A> operation, Function<? super Q, ? extends Promise<A>> answerer) {
        bus.answer(
                operation,
                question -> lifecycle.componentState() == ComponentState.RUNNING
                        ? answerer.apply(question)
                        : Promise.failed(lifecycle.notRunning()));
    }

    @Override
    public Promise<@Nullable Void> start() {
        return onSpace(lifecycle::invoke);
    }

    @Override
    public Promise<@Nullable Void> stop() {
        return onSpace(lifecycle::terminate);
    }

    @Override
    public Promise<@Nullable Void> check() {
        return onSpace(lifecycle::health);
    }

    @Override
    public Promise<@Nullable Void> whenEnded() {
        return onSpace(lifecycle::whenEnded);
    }

    private Promise<@Nullable Void> onSpace(Supplier<Promise<@Nullable Void>> action) {
        if (ActorSpace.current() == space) {
            return action.get();
        }
        var answer = new Deferred<@Nullable Void>();
        space.execute(() -> answer.resolveFrom(action.get()));
        return answer;
    }

    /**
     * Leaves the bus permanently and immediately, so that its name can be used again. A running component is
     * terminated. Its output during this termination is reported as not published, and a failed termination is reported
     * to the observer; call {@link #stop} first to publish that output. Later calls of {@link #start} are rejected.
     */
    @Override
    public void close() {
        Promise<@Nullable Void> ended = lifecycle.close();
        bus.close(); // does not wait for the termination, which may hang
        ended.exceptionally(error -> {
            observer.problem(address(), "could not be terminated", error);
            return null;
        });
    }

    /** Forwards to an observer and logs its exceptions, which have no other effect. */
    private record SafeObserver(ComponentObserver observer) implements ComponentObserver {
        private static final System.Logger LOG = System.getLogger(ComponentObserver.class.getName());

        @Override
        public void changed(Address component, ComponentState state) {
            call(() -> observer.changed(component, state));
        }

        @Override
        public void dropped(Address component, ApplicationData<?> lost, long total) {
            call(() -> observer.dropped(component, lost, total));
        }

        @Override
        public void problem(Address component, String what, Throwable why) {
            call(() -> observer.problem(component, what, why));
        }

        @Override
        public void info(Address component, String what) {
            call(() -> observer.info(component, what));
        }

        private static void call(Runnable callback) {
            try {
                callback.run();
            } catch (RuntimeException | Error failure) {
                LOG.log(System.Logger.Level.ERROR, "the observer of a component failed", failure);
            }
        }
    }

    /** The path of the data: from the bus through DCU and CCU to the component, and back. */
    private final class DataPath implements ComponentLifecycle.Listener<O> {
        @Override
        public void invoking() {
            int discarded = conversion.discardInput();
            if (discarded > 0) {
                observer.info(address(), discarded + " values for its last life were forgotten");
            }
            bus.subscribe(component.subscribes(), this::received);
        }

        @Override
        public void running() {
            drainInput();
        }

        @Override
        public void ended() {
            bus.unsubscribeAll();
            publishOutput(); // output before and during the termination
        }

        @Override
        public void output(O output) {
            conversion.fromComponent(output);
            if (outputScheduled.compareAndSet(false, true)) {
                space.execute(this::publishOutput);
            }
        }

        private void publishOutput() {
            // cleared before draining: output that arrives during the drain schedules another one
            outputScheduled.set(false);
            conversion.drainToApplication(bus::publish);
        }

        private void received(ApplicationData<?> data) {
            conversion.fromBus(data);
            if (lifecycle.componentState() == ComponentState.RUNNING && inputScheduled.compareAndSet(false, true)) {
                space.execute(this::drainInput);
            }
        }

        private void drainInput() {
            inputScheduled.set(false);
            if (lifecycle.componentState() == ComponentState.RUNNING) {
                conversion.drainToComponent(lifecycle::data);
            }
        }
    }
}
