package io.troupe.services.component;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.services.broker.Provider;
import io.troupe.services.bus.Address;
import io.troupe.services.bus.Bus;
import io.troupe.services.bus.Operation;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.function.Function;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * The interface that makes a component fit the architecture: its CCU, its DCU and its BCU, and the component's life.
 *
 * <p><b>Role.</b> A {@link Provider}: registered with a broker, it is started when somebody needs its service. It can
 * be controlled by the messages of {@link Control} just as well.
 *
 * <p><b>Threads.</b> It lives on one actor space, on whose thread it is opened and closed; what {@link Provider} has
 * may be called from any.
 *
 * <p><b>Order.</b> From invocation to termination is one life. A component hears its topics from the moment it is being
 * invoked: what comes before it runs waits in the DCU. What it says while {@link #stop} terminates it is still
 * published. What it says or does after that is told to the observer and has no other effect.
 *
 * <p><b>Errors.</b> A component that fails is terminated, and {@link #check} is rejected with what it failed of until
 * it is started again. One whose termination fails may still be alive: {@link #start} and {@link #stop} terminate it
 * again, and are rejected until this succeeds.
 *
 * <p><b>Source.</b> Paper, section 2.2.2 and Figure 6.
 */
public final class ComponentInterface<I, O> implements Provider, AutoCloseable {
    private final ActorSpace space;
    private final Component<I, O> component;
    private final ComponentObserver observer;
    private final BusCommunication bus;
    private final DataConversion<I, O> conversion;
    private final Lives<I, O> lives;
    private final AtomicBoolean outputWaits = new AtomicBoolean();
    private final AtomicBoolean inputWaits = new AtomicBoolean();

    private ComponentInterface(
            ActorSpace space, BusCommunication bus, Component<I, O> component, ComponentObserver observer) {
        this.space = space;
        this.bus = bus;
        this.component = component;
        this.observer = new SafeObserver(observer);
        this.conversion = new DataConversion<>(bus.address(), component, this.observer);
        this.lives = new Lives<>(space, bus.address(), component.communication(), this.observer, new DataPath());
    }

    /**
     * Puts a component on the bus, without starting it.
     *
     * @param name its name on the bus
     * @throws IllegalStateException on any thread but that of an actor space
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
        bus.answer(Control.INVOKE, invoke -> lives.invoke().thenApply(runs -> done()));
        bus.answer(Control.TERMINATE, terminate -> lives.terminate().thenApply(ended -> done()));
        bus.answer(Control.HEALTH, ask -> lives.health().handle((well, wrong) -> report(wrong)));
    }

    private Control.Done done() {
        return new Control.Done(address().name(), lives.state().name());
    }

    private Control.HealthReport report(@Nullable Throwable wrong) {
        String problem = wrong == null ? "" : Lives.words(wrong);
        return new Control.HealthReport(address().name(), lives.state().name(), problem);
    }

    /** Where the component is on the bus. */
    public Address address() {
        return bus.address();
    }

    /** What this is the interface of. */
    public Component<I, O> component() {
        return component;
    }

    /** The DCU, for what it has to say of losses. */
    public DataConversion<I, O> conversion() {
        return conversion;
    }

    /** Where the component stands, on the space of its interface. */
    public Lifecycle state() {
        return lives.state();
    }

    /** Answers questions for data from now on, while the component runs; on the space of the interface. */
    public <Q extends Record, A extends Record> void answer(
            Operation<Q, A> operation, Function<? super Q, ? extends Promise<A>> answerer) {
        bus.answer(
                operation,
                question -> lives.state() == Lifecycle.RUNNING
                        ? answerer.apply(question)
                        : Promise.failed(lives.notRunning()));
    }

    @Override
    public Promise<@Nullable Void> start() {
        return onSpace(lives::invoke);
    }

    @Override
    public Promise<@Nullable Void> stop() {
        return onSpace(lives::terminate);
    }

    @Override
    public Promise<@Nullable Void> check() {
        return onSpace(lives::health);
    }

    @Override
    public Promise<@Nullable Void> whenEnded() {
        return onSpace(lives::whenEnded);
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
     * Leaves the bus for good, at once, so that its name is free. A component that runs is terminated: what it says
     * while that lasts is reported as not published, and so is a termination that fails; {@link #stop} first publishes
     * it. Calls of {@link #start} are rejected from now on.
     */
    @Override
    public void close() {
        Promise<@Nullable Void> ended = lives.close();
        bus.close(); // not when it has ended: a termination may hang
        ended.exceptionally(error -> {
            observer.problem(address(), "could not be terminated", error);
            return null;
        });
    }

    /** An observer that throws is reported to the log, and changes nothing. */
    private record SafeObserver(ComponentObserver observer) implements ComponentObserver {
        private static final System.Logger LOG = System.getLogger(ComponentObserver.class.getName());

        @Override
        public void changed(Address component, Lifecycle state) {
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
        public void told(Address component, String what) {
            call(() -> observer.told(component, what));
        }

        private static void call(Runnable callback) {
            try {
                callback.run();
            } catch (RuntimeException | Error failure) {
                LOG.log(System.Logger.Level.ERROR, "the observer of a component failed", failure);
            }
        }
    }

    /** The way of the data: bus, DCU, CCU, and back. */
    private final class DataPath implements Lives.Turns<O> {
        @Override
        public void begins() {
            int forgotten = conversion.forgetInput();
            if (forgotten > 0) {
                observer.told(address(), forgotten + " values for its last life were forgotten");
            }
            bus.hear(component.hears(), this::heard);
        }

        @Override
        public void runs() {
            handInput();
        }

        @Override
        public void ends() {
            bus.hearNothing();
            publishOutput(); // its last words
        }

        @Override
        public void output(O output) {
            conversion.fromComponent(output);
            if (outputWaits.compareAndSet(false, true)) {
                space.execute(this::publishOutput);
            }
        }

        private void publishOutput() {
            outputWaits.set(false); // before taking: what comes while it publishes has a turn of its own
            conversion.drainToApplication(bus::publish);
        }

        private void heard(ApplicationData<?> data) {
            conversion.fromBus(data);
            if (lives.state() == Lifecycle.RUNNING && inputWaits.compareAndSet(false, true)) {
                space.execute(this::handInput);
            }
        }

        private void handInput() {
            inputWaits.set(false);
            if (lives.state() == Lifecycle.RUNNING) {
                conversion.drainToComponent(lives::data);
            }
        }
    }
}
