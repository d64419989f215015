package io.troupe.services.component.application;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerEvent;
import io.troupe.broker.MissingServiceException;
import io.troupe.broker.Need;
import io.troupe.broker.ServiceRecord;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import io.troupe.bus.BusPort;
import io.troupe.services.component.Component;
import io.troupe.services.component.ComponentInterface;
import io.troupe.services.component.application.ApplicationPlan.Replacement;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.Iterator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Set;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.TimeoutException;
import org.jspecify.annotations.Nullable;

/**
 * A running application.
 *
 * <p><b>Role.</b> Attaches the components of its plan to the bus, registers them with a broker that it opens, and
 * requests all needs of the plan from the broker. The broker starts the components, and only those that are needed. The
 * application then connects each user with the provider that the broker selects. Components of other nodes are offered
 * by the brokers of these nodes ({@link ApplicationNode}), and are found, started, checked and lost like other
 * providers of other processes.
 *
 * <p><b>Threads.</b> One actor space, on which it is started, and on which it notifies its observers. The bus is left
 * open.
 *
 * <p><b>Order.</b> Needs are met one after the other, in the order of the plan. The times of replacements count from
 * the moment when all needs are met. When one provider replaces another, their wires are exchanged in one turn of the
 * space.
 *
 * <p><b>Errors.</b> A need that no provider can meet, or that stays unmet for longer than
 * {@link ApplicationSettings#reconnectLimit}, ends the application: everything that was started is stopped, and then
 * {@link #started} or {@link #ended} is rejected with the broker's {@link MissingServiceException}. Two needs that
 * would feed one topic end it in the same way, with an {@link ApplicationException}. {@link #replace} and {@link #add}
 * are rejected with an {@link ApplicationException} once the application is being stopped.
 *
 * <p><b>Source.</b> Paper, sections 1 ("terminate gracefully with proper error messages"), 2.1.3 and 2.2.4.
 */
public final class Application implements AutoCloseable {
    private static final Duration NODE_LIMIT = Duration.ofSeconds(5);

    private final ActorSpace space;
    private final ApplicationPlan plan;
    private final Bus bus;
    private final Broker broker;
    private final ApplicationSettings settings;
    private final BusPort port;
    private final TopicWiring wiring;
    private final Map<String, Offer> offers = new LinkedHashMap<>();
    private final Set<Address> offered = new HashSet<>(); // by any node, so far
    private final List<Address> awaited = new ArrayList<>(); // of the other nodes, before the start
    private final Deferred<@Nullable Void> allOffered = new Deferred<>();
    private final List<NeedConnection> connections = new ArrayList<>();
    private final Deferred<@Nullable Void> started = new Deferred<>();
    private final Deferred<@Nullable Void> ended = new Deferred<>();
    private final CompletableFuture<@Nullable Void> spaceEnd;
    private boolean ending;

    /** A component of the plan; {@code here} is null if it runs on another node, whose broker offers it. */
    private record Offer(
            Component<?, ?> component,
            Address address,
            @Nullable ComponentInterface<?, ?> here) {}

    private Application(ActorSpace space, ApplicationPlan plan, Bus bus, ApplicationSettings settings) {
        this.space = space;
        this.plan = plan;
        this.bus = bus;
        this.settings = settings;
        this.spaceEnd = space.whenClosed().toCompletableFuture();
        var limits = settings.broker();
        this.port = bus.attach(plan.name() + ":application");
        try {
            this.broker = plan.nodes().isEmpty()
                    ? Broker.open(bus.node(), space, limits)
                    : Broker.over(bus, space, limits.withObserver(this::onBroker), plan.sharing());
        } catch (RuntimeException | Error thrown) { // for example: another broker of this node is on the bus
            port.close();
            throw thrown;
        }
        this.wiring = new TopicWiring(port, plan.components(), settings.events());
    }

    /**
     * Starts an application.
     *
     * @param plan if it has several nodes, the bus has the name of the first one, and the others have to be there
     *     within 5 s ({@link ApplicationNode})
     * @throws IllegalStateException if the current thread is not that of an actor space
     * @throws IllegalArgumentException if another node runs the application
     */
    public static Application start(ApplicationPlan plan, Bus bus, ApplicationSettings settings) {
        ActorSpace space = ActorSpace.current();
        if (space == null) {
            throw new IllegalStateException("application " + plan.name()
                    + " was started on no actor space, expected the one it is to live on: use space.execute(..)");
        }
        if (!plan.nodes().isEmpty() && !plan.nodes().getFirst().equals(bus.node())) {
            throw new IllegalArgumentException("node " + plan.nodes().getFirst() + " runs " + plan.name()
                    + ", and this is node " + bus.node() + ", which serves components: use ApplicationNode");
        }
        var application = new Application(space, plan, bus, settings);
        application.begin();
        return application;
    }

    /** Fulfilled when all needs are met; rejected if a need cannot be met, after everything has been stopped. */
    public Promise<@Nullable Void> started() {
        return started;
    }

    /** Fulfilled when the application has been stopped; rejected with the error that has ended it. */
    public Promise<@Nullable Void> ended() {
        return ended;
    }

    private void begin() {
        // by the thread that closes it: nothing of this space runs any more
        spaceEnd.thenRun(() ->
                settle(new ApplicationException("application " + plan.name() + " ended with its space " + space)));
        ended.exceptionally(error -> null); // a failed start is reported by started(); ended() needs no listener
        try {
            plan.components().forEach(this::open);
            wiring.claim(null, plan.wires());
            wiring.open(plan.wires());
        } catch (RuntimeException refused) {
            end(refused);
            return;
        }
        awaitNodes()
                .thenCompose(present -> register())
                .thenCompose(all -> meetNeeds(plan.needs().iterator()))
                .thenAccept(met -> run())
                .exceptionally(error -> {
                    end(error);
                    return null;
                });
    }

    private void open(String name, Component<?, ?> component) {
        if (plan.nodes().isEmpty() || plan.componentsOn(bus.node()).contains(name)) {
            var opened = ComponentInterface.open(bus, name, component, settings.components());
            offers.put(name, new Offer(component, opened.address(), opened));
        } else {
            offers.put(name, new Offer(component, new Address(plan.places().get(name), name), null));
        }
    }

    // ---- the other nodes

    /** Fulfilled when the other nodes have offered all their components; rejected if a node is missing. */
    private Promise<@Nullable Void> awaitNodes() {
        offers.values().stream()
                .filter(each -> each.here() == null)
                .map(Offer::address)
                .filter(each -> !offered.contains(each))
                .forEach(awaited::add);
        if (awaited.isEmpty()) {
            return Promise.done();
        }
        space.delay(NODE_LIMIT).onSettled((elapsed, closed) -> {
            if (!awaited.isEmpty()) {
                allOffered.reject(missingNode(awaited.getFirst()));
            }
        });
        return allOffered;
    }

    private void onBroker(BrokerEvent event) {
        if (event instanceof BrokerEvent.Registered(ServiceRecord provider)) {
            offered.add(provider.provider());
            if (awaited.remove(provider.provider()) && awaited.isEmpty()) {
                allOffered.resolve(null);
            }
        }
        settings.broker().observer().on(event);
    }

    private MissingServiceException missingNode(Address component) {
        var need =
                Need.ofService(plan.name(), offer(component.name()).component().service());
        return new MissingServiceException(
                need,
                "\"" + plan.name() + "\" needs node \"" + component.node() + "\" for "
                        + String.join(", ", plan.componentsOn(component.node())) + ", and has not found it within "
                        + NODE_LIMIT.toSeconds() + " s: it does not offer " + component.name()
                        + "; start the same application there");
    }

    // ---- components and needs

    private Promise<?> register() {
        Promise<?> registered = Promise.done();
        for (var each : offers.entrySet()) {
            if (!ending && each.getValue().here() != null && plan.isRegisteredAtStart(each.getKey())) {
                registered = combine(registered, register(each.getValue()));
            }
        }
        return registered;
    }

    private Promise<ServiceRecord> register(Offer offer) {
        var component = offer.component();
        var here = Objects.requireNonNull(offer.here());
        return broker.register(component.service(), component.capabilities(), offer.address(), here::newLife);
    }

    private static Promise<?> combine(Promise<?> first, Promise<?> second) {
        return first.thenCombine(second, (one, other) -> one);
    }

    private Promise<?> meetNeeds(Iterator<Need> needs) {
        if (ending || !needs.hasNext()) {
            return Promise.done();
        }
        var connection = new NeedConnection(needs.next());
        connections.add(connection);
        return broker.connect(connection.need, connection).thenCompose(provider -> meetNeeds(needs));
    }

    private void run() {
        if (ending) {
            return;
        }
        started.resolve(null);
        for (var replacement : plan.replacements()) {
            space.delay(replacement.after()).onSettled((elapsed, closed) -> {
                if (closed == null && !ending) {
                    replace(replacement);
                }
            });
        }
    }

    private void replace(Replacement what) {
        replace(what.old(), what.by()).onSettled((done, error) -> {
            settings.events()
                    .accept(
                            error == null
                                    ? new ApplicationEvent.Replaced(what)
                                    : new ApplicationEvent.NotReplaced(what, error));
        });
    }

    /**
     * Replaces a component by another while the application runs. The new component is registered for the service of
     * the old one.
     *
     * @param old the component that is replaced
     * @param by a component of the plan that is not in use
     */
    public Promise<@Nullable Void> replace(String old, String by) {
        if (ending) {
            return Promise.failed(stoppedError("replaces nothing"));
        }
        var before = offer(old);
        var next = offer(by);
        return broker.registered()
                .thenCompose(all -> {
                    var offer = offerOf(before, all);
                    var capabilities = new ArrayList<>(offer.capabilities());
                    next.component().capabilities().stream()
                            .filter(each -> !capabilities.contains(each))
                            .forEach(capabilities::add);
                    var here = next.here();
                    return here == null
                            ? broker.replace(before.address(), offer.service(), capabilities, next.address())
                            : broker.replace(
                                    before.address(), offer.service(), capabilities, next.address(), here::newLife);
                })
                .thenAccept(replaced -> {});
    }

    /**
     * The service for which a component is registered, which is not its original one if it has replaced another
     * component.
     */
    private ServiceRecord offerOf(Offer component, List<ServiceRecord> all) {
        return all.stream()
                .filter(each -> each.provider().equals(component.address()))
                .findFirst()
                .orElseThrow(() -> new ApplicationException(component.address().name()
                        + " offers nothing now, expected a component in whose place another can be put"));
    }

    /**
     * Adds a component at run time: registers it, so that the broker starts it when it is needed.
     *
     * @param name name of the component, with which it was also created
     * @throws IllegalArgumentException if there already is a component of that name
     */
    public Promise<ServiceRecord> add(String name, Component<?, ?> component) {
        if (ending) {
            return Promise.failed(stoppedError("takes no component " + name));
        }
        var opened = ComponentInterface.open(bus, name, component, settings.components());
        wiring.addComponent(name, component);
        var offer = new Offer(component, opened.address(), opened);
        offers.put(name, offer);
        return register(offer);
    }

    private ApplicationException stoppedError(String what) {
        return new ApplicationException(plan.name() + " has been stopped, and " + what);
    }

    /**
     * The interface of a component of this process.
     *
     * @throws IllegalArgumentException if there is no such component
     */
    public ComponentInterface<?, ?> componentInterface(String component) {
        var found = offer(component);
        if (found.here() == null) {
            throw new IllegalArgumentException(
                    component + " runs on node " + found.address().node() + ", expected one of "
                            + offers.keySet().stream()
                                    .filter(each -> offer(each).here() != null)
                                    .toList());
        }
        return found.here();
    }

    private Offer offer(String component) {
        var found = offers.get(component);
        if (found == null) {
            throw new IllegalArgumentException(
                    plan.name() + " has no component " + component + ", it has " + offers.keySet());
        }
        return found;
    }

    /**
     * Connection of one need: connects the topics of the user with those of the provider that the broker selects, and
     * ends the application if there is no provider for too long.
     */
    private final class NeedConnection implements Broker.Connection {
        private final Need need;
        private List<BusPort.Subscription> open = List.of();

        /** Number of providers so far; if it is the same as at a loss, there has been no provider since. */
        private int timesMet;

        NeedConnection(Need need) {
            this.need = need;
        }

        @Override
        public void use(ServiceRecord provider) {
            var wires = wiring.wiresBetween(need.by(), provider.provider().name());
            try {
                wiring.release(need);
                wiring.claim(need, wires);
            } catch (ApplicationException clash) {
                end(clash);
                return;
            }
            disconnect(); // in the same turn, so that every value sees exactly one provider
            open = wiring.open(wires);
            timesMet++;
            settings.events().accept(new ApplicationEvent.Connected(need, provider, wires));
        }

        @Override
        public void lost(MissingServiceException why) {
            disconnect();
            wiring.release(need);
            if (!ending) {
                awaitAnother(why);
            }
        }

        private void awaitAnother(MissingServiceException why) {
            settings.events().accept(new ApplicationEvent.Lost(need, why));
            int met = timesMet;
            space.delay(settings.reconnectLimit()).onSettled((elapsed, closed) -> {
                // a need that has been met since then has its own limit after the next loss
                if (closed == null && timesMet == met) {
                    end(why);
                }
            });
        }

        void disconnect() {
            open.forEach(BusPort.Subscription::close);
            open = List.of();
        }
    }

    // ---- the end

    /**
     * Stops everything that was started, in reverse order, and leaves the bus. From any thread.
     *
     * @return as {@link #ended}
     */
    public Promise<@Nullable Void> closeAsync() {
        if (ActorSpace.current() == space) {
            end(null);
        } else {
            try {
                space.execute(() -> end(null));
            } catch (ActorStoppedException over) {
                settle(new ApplicationException("application " + plan.name() + " ended with its space " + space));
            }
        }
        return ended;
    }

    /**
     * Like {@link #closeAsync}, and waits until that is done: for threads outside every space. On the thread of a space
     * it does not wait.
     *
     * @throws ApplicationException if it takes longer than a minute; it goes on
     */
    @Override
    public void close() {
        Waiting.until(closeAsync(), "the application " + plan.name());
    }

    /** Waits outside every space. */
    static final class Waiting {
        private static final Duration LIMIT = Duration.ofMinutes(1);

        private Waiting() {}

        static void until(Promise<?> closed, String what) {
            Promise<?> over = closed.handle((done, error) -> true); // its error was that of its end
            if (ActorSpace.current() != null) {
                return;
            }
            try {
                over.get(LIMIT);
            } catch (TimeoutException late) {
                throw new ApplicationException(what + " has not been closed within " + LIMIT + "; it goes on");
            } catch (InterruptedException interrupted) {
                Thread.currentThread().interrupt();
            }
        }
    }

    private void end(@Nullable Throwable why) {
        if (ending) {
            return;
        }
        ending = true;
        awaited.clear();
        allOffered.resolve(null);
        broker.closeAsync().onSettled((left, error) -> {
            connections.forEach(NeedConnection::disconnect);
            offers.values().stream().map(Offer::here).filter(Objects::nonNull).forEach(ComponentInterface::close);
            port.close();
            settle(why != null ? why : error);
        });
    }

    private void settle(@Nullable Throwable why) {
        spaceEnd.cancel(false); // else a space would keep every application that has ended
        if (why == null) {
            started.resolve(null); // also settles the start of an application that is stopped while it starts
            ended.resolve(null);
        } else {
            started.reject(why);
            ended.reject(why);
        }
    }
}
