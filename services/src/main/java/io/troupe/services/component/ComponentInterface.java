package io.troupe.services.component;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.broker.Provider;
import io.troupe.broker.ProviderException;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import io.troupe.bus.Operation;
import java.util.Objects;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.function.Function;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * Connects a component with the bus and the broker: it consists of the CCU, the DCU and the BCU.
 *
 * <p><b>Role.</b> A broker with which it is registered starts and stops the component, counts its lives, and checks
 * them; each life is a separate {@link Provider}, which {@link #newLife} creates: {@code broker.register(service,
 * capabilities, component.address(), component::newLife)}.
 *
 * <p><b>Threads.</b> Belongs to one actor space and is opened and closed on its thread. {@link #newLife}, and the
 * methods of the provider that it returns, may be called from any thread.
 *
 * <p><b>Order.</b> A life lasts from invocation to termination. The component is subscribed to its topics from the
 * start of the invocation; values that arrive before it runs are buffered in the DCU. Output during the termination is
 * still published. Any later output or failure is only reported to the observer.
 *
 * <p><b>Errors.</b> A component that fails is terminated by the broker. If a termination fails, the component may still
 * be running: the broker begins no other life before a termination has succeeded, and repeats it with each start.
 *
 * <p><b>Source.</b> Paper, section 2.2.2 and Figure 6.
 */
public final class ComponentInterface<I, O> implements AutoCloseable {
    private final ActorSpace space;
    private final Component<I, O> component;
    private final ComponentObserver observer;
    private final BusCommunication bus;
    private final DataConversion<I, O> conversion;
    private final AtomicBoolean outputScheduled = new AtomicBoolean();
    private final AtomicBoolean inputScheduled = new AtomicBoolean();
    private @Nullable Life latest; // used on the space, as is closed
    private boolean closed;

    private ComponentInterface(
            ActorSpace space, BusCommunication bus, Component<I, O> component, ComponentObserver observer) {
        this.space = space;
        this.bus = bus;
        this.component = component;
        this.observer = new SafeObserver(observer);
        this.conversion = new DataConversion<>(bus.address(), component, this.observer);
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
        return new ComponentInterface<>(space, BusCommunication.attach(bus, name), component, observer);
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

    /** The next life of the component, for a broker. */
    public Provider newLife() {
        return new Life();
    }

    /** Checks the component now. Rejected with the problem if it does not run, or is not healthy. */
    public Promise<@Nullable Void> check() {
        return onSpace(() -> latest != null && latest.runs ? latest.health() : Promise.failed(notRunning()));
    }

    /**
     * Registers a handler for requests for data. Requests are rejected while the component does not run. Call on the
     * space of the interface.
     */
    public <Q extends Record, A extends Record> void answer(
            Operation<Q, A> operation, Function<? super Q, ? extends Promise<A>> answerer) {
        bus.answer(
                operation,
                request -> latest != null && latest.runs ? answerer.apply(request) : Promise.failed(notRunning()));
    }

    /** The error for requests that need a running component. */
    private ProviderException notRunning() {
        Life life = latest;
        if (life == null) {
            return new ProviderException(address() + " has not been invoked");
        }
        Throwable failure = life.failure;
        if (failure != null) {
            return failed(failure);
        }
        String state = life.over ? "has been terminated" : life.stopping ? "is being terminated" : "is being invoked";
        return new ProviderException(address() + " " + state);
    }

    private ProviderException failed(Throwable why) {
        return ProviderException.mayStillRun(address() + " has failed: " + messageOf(why), why);
    }

    /** The message of an error, or its class if the message is empty. */
    private static String messageOf(Throwable error) {
        String message = error.getMessage();
        if (message == null) {
            return error.toString();
        }
        return message.isBlank() ? error.getClass().getName() : message;
    }

    private Promise<@Nullable Void> onSpace(Supplier<Promise<@Nullable Void>> action) {
        if (ActorSpace.current() == space) {
            return action.get();
        }
        Deferred<@Nullable Void> answer = Deferred.unbound();
        space.execute(() -> {
            try {
                answer.resolveFrom(action.get());
            } catch (RuntimeException | Error thrown) { // for example: the port was closed
                answer.reject(thrown);
            }
        });
        return answer;
    }

    /**
     * Leaves the bus permanently and immediately, so that its name can be used again. A running component is
     * terminated. Its output during this termination is reported as not published, and a failed termination is reported
     * to the observer; stop the broker first to publish that output. Later starts are rejected.
     */
    @Override
    public void close() {
        closed = true;
        Life life = latest;
        Promise<@Nullable Void> ended = life == null ? Promise.done() : life.close();
        bus.close(); // does not wait for the termination, which may hang
        ended.exceptionally(error -> {
            observer.problem(address(), "could not be terminated", error);
            return null;
        });
    }

    /**
     * One life of the component: an instance of its CCU, and the path of the data from the bus through DCU and CCU to
     * the component, and back. Whether it starts, runs or has stopped is the broker's matter; it knows only when data
     * pass. Signals come on any thread.
     */
    private final class Life implements Provider, ComponentCommunication.Signals<O> {
        private final Deferred<@Nullable Void> started = Deferred.unbound();
        private final Deferred<@Nullable Void> ended = Deferred.unbound();
        private @Nullable ComponentCommunication<I, O> communication;
        private @Nullable Throwable failure;
        private boolean runs; // it gets data
        private boolean stopping;
        private boolean invokedLate; // since the last termination began
        private boolean terminated;
        private @Nullable Promise<@Nullable Void> terminating;
        private volatile boolean over; // its data and failures are ignored

        Life() {
            ended.onRejected(error -> {}); // there may be no broker any more
        }

        // ---- called by the broker

        @Override
        public Promise<@Nullable Void> start() {
            return onSpace(() -> {
                if (closed) {
                    return Promise.failed(
                            new ProviderException(address() + " has left the bus, expected an open interface"));
                }
                begin();
                return started;
            });
        }

        private void begin() {
            Life before = latest;
            if (before != null) {
                before.endData();
            }
            latest = this;
            try {
                communication = component.communication().get();
            } catch (RuntimeException | Error thrown) {
                fail(thrown);
                return;
            }
            int dropped = conversion.dropInput();
            if (dropped > 0) {
                observer.info(address(), dropped + " values for its last life were forgotten");
            }
            try {
                bus.subscribe(component.subscribes(), this::received);
            } catch (RuntimeException | Error thrown) { // a port that is closed, a topic of another type
                fail(thrown);
                return;
            }
            attempt(() -> communication().invoke(this)).onSettled((done, error) -> {
                invoked(error);
            });
        }

        private void invoked(@Nullable Throwable error) {
            boolean late = over || stopping;
            if (late && error != null) {
                observer.problem(address(), "failed to be invoked, after it had been given up", error);
                started.reject(error);
            } else if (late) {
                observer.info(address(), "ran only after it had been given up, and is terminated again");
                invokedLate = true;
                terminated = false;
                started.resolve(null); // the broker stops it again
            } else if (error != null) {
                fail(error);
            } else {
                runs = true;
                started.resolve(null); // first: a component that fails on its first value has started all the same
                drainInput();
            }
        }

        @Override
        public Promise<@Nullable Void> stop() {
            return onSpace(this::terminate);
        }

        private Promise<@Nullable Void> terminate() {
            if (terminated) {
                return Promise.done();
            }
            if (terminating != null) {
                return terminating;
            }
            runs = false;
            stopping = true;
            invokedLate = false;
            Promise<@Nullable Void> done = communication == null
                    ? Promise.done()
                    : attempt(() -> communication().terminate());
            terminating = done.handle((ended, error) -> {
                        if (!over) {
                            failure = error;
                            endData();
                        }
                        terminating = null;
                        terminated = error == null && !invokedLate;
                        return error;
                    })
                    .thenCompose(error -> error == null ? Promise.done() : Promise.failed(error));
            return terminating;
        }

        /** The interface leaves the bus. */
        Promise<@Nullable Void> close() {
            if (terminated || communication == null) {
                return Promise.done();
            }
            Promise<@Nullable Void> done = terminate();
            ended.reject(new ProviderException(address() + " has left the bus"));
            return done;
        }

        @Override
        public Promise<@Nullable Void> check() {
            return onSpace(this::health);
        }

        private Promise<@Nullable Void> health() {
            return attempt(() -> communication().health());
        }

        @Override
        public Promise<@Nullable Void> whenEnded() {
            return ended;
        }

        private ComponentCommunication<I, O> communication() {
            return Objects.requireNonNull(communication);
        }

        private static Promise<@Nullable Void> attempt(Supplier<? extends @Nullable Promise<@Nullable Void>> action) {
            try {
                return Objects.requireNonNull(action.get(), "it returned null, expected a promise");
            } catch (RuntimeException | Error thrown) {
                return Promise.failed(thrown);
            }
        }

        // ---- called by the component

        @Override
        public void data(O output) {
            if (over) {
                observer.info(address(), "gave data after its end: " + output);
                return;
            }
            try {
                conversion.fromComponent(output);
                if (outputScheduled.compareAndSet(false, true)) {
                    space.execute(ComponentInterface.this::publishOutput);
                }
            } catch (ActorStoppedException closedSpace) {
                observer.info(address(), "gave data after its space had been closed: " + output);
            }
        }

        @Override
        public void failed(Throwable error) {
            try {
                space.execute(() -> fail(error));
            } catch (ActorStoppedException closedSpace) {
                observer.info(address(), "failed after its space had been closed: " + error.getMessage());
            }
        }

        @Override
        public void info(String what) {
            observer.info(address(), what);
        }

        private void fail(Throwable error) {
            if (over || stopping) {
                return;
            }
            failure = error;
            boolean ran = runs;
            endData();
            if (ran) {
                observer.problem(address(), "has failed", error);
            }
            ProviderException reported = ComponentInterface.this.failed(error);
            if (!started.reject(reported)) {
                ended.reject(reported);
            }
        }

        // ---- data

        private void endData() {
            if (over) {
                return;
            }
            over = true;
            runs = false;
            bus.unsubscribeAll();
            publishOutput(); // output before and during the termination
        }

        private void received(ApplicationData<?> data) {
            conversion.fromBus(data);
            if (runs && inputScheduled.compareAndSet(false, true)) {
                space.execute(this::drainInput);
            }
        }

        private void drainInput() {
            inputScheduled.set(false);
            if (runs) {
                conversion.drainToComponent(this::pass);
            }
        }

        private void pass(I input) {
            if (!runs) {
                return; // it failed on an earlier value of the same drain
            }
            try {
                communication().data(input);
            } catch (RuntimeException | Error thrown) {
                fail(thrown);
            }
        }
    }

    private void publishOutput() {
        // cleared before draining: output that arrives during the drain schedules another one
        outputScheduled.set(false);
        conversion.drainToApplication(bus::publish);
    }

    /** Forwards to an observer and logs its exceptions, which have no other effect. */
    private record SafeObserver(ComponentObserver observer) implements ComponentObserver {
        private static final System.Logger LOG = System.getLogger(ComponentObserver.class.getName());

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
}
