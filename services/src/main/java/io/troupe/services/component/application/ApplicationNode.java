package io.troupe.services.component.application;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerEvent;
import io.troupe.broker.BrokerObserver;
import io.troupe.bus.Bus;
import io.troupe.services.component.Component;
import io.troupe.services.component.ComponentInterface;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * Serves the components that a plan places on a node other than the first.
 *
 * {@snippet :
 * node = ApplicationNode.open(plan, laptop, settings);
 * }
 *
 * <p><b>Role.</b> Attaches the components to the bus, and has a broker that offers them; the application, which runs on
 * the first node, starts and ends them. They may be started again, by the same application or by a later one.
 *
 * <p><b>Threads.</b> One actor space, on which it is opened. The bus is left open.
 *
 * <p><b>Errors.</b> If nothing has come from the application for 3 s, it has ended, or is cut off: the components that
 * run are terminated, which is reported to the observer. A pause of this process does not count.
 */
public final class ApplicationNode implements AutoCloseable {
    private final ActorSpace space;
    private final Broker broker;
    private final List<ComponentInterface<?, ?>> components;

    private ApplicationNode(ActorSpace space, Broker broker, List<ComponentInterface<?, ?>> components) {
        this.space = space;
        this.broker = broker;
        this.components = components;
    }

    /**
     * Attaches the components of a node.
     *
     * @param bus has the name of the node
     * @param settings the observers, and the limits and checks of the broker
     * @throws IllegalStateException if the current thread is not that of an actor space
     * @throws IllegalArgumentException if the plan places no components on this node, or it runs the application
     */
    public static ApplicationNode open(ApplicationPlan plan, Bus bus, ApplicationSettings settings) {
        ActorSpace space = ActorSpace.current();
        if (space == null) {
            throw new IllegalStateException("the components of node " + bus.node()
                    + " were opened on no actor space, expected the one they are to live on: use space.execute(..)");
        }
        List<String> names = plan.componentsOn(bus.node());
        if (names.isEmpty() || plan.nodes().getFirst().equals(bus.node())) {
            throw new IllegalArgumentException(
                    "node " + bus.node() + " has no components of " + plan.name() + " to serve, expected one of "
                            + plan.nodes().stream().skip(1).toList());
        }
        var limits = settings.broker();
        var broker =
                Broker.over(bus, space, limits.withObserver(observer(limits.observer(), settings)), plan.sharing());
        var node = new ApplicationNode(space, broker, new ArrayList<>());
        try {
            names.forEach(name -> node.offer(plan, name, bus, settings));
        } catch (RuntimeException | Error thrown) { // for example: the name of a component is taken
            node.closeAsync();
            throw thrown;
        }
        return node;
    }

    private void offer(ApplicationPlan plan, String name, Bus bus, ApplicationSettings settings) {
        Component<?, ?> component = plan.components().get(name);
        var opened = ComponentInterface.open(bus, name, component, settings.components());
        components.add(opened);
        broker.register(
                        plan.serviceAtStart(name),
                        plan.isRegisteredAtStart(name) ? component.capabilities() : List.of(),
                        opened.address(),
                        opened::newLife)
                .onRejected(taken -> settings.components().problem(opened.address(), "cannot be offered", taken));
    }

    private static BrokerObserver observer(BrokerObserver inner, ApplicationSettings settings) {
        return event -> {
            if (event instanceof BrokerEvent.Unused unused) {
                settings.components().info(unused.provider().provider(), unused.why() + ": this component is ended");
            }
            inner.on(event);
        };
    }

    /** Ends the components and leaves the bus. From any thread. */
    public Promise<@Nullable Void> closeAsync() {
        Deferred<@Nullable Void> closed = Deferred.unbound();
        Runnable end = () -> broker.closeAsync().onSettled((left, error) -> {
            components.forEach(ComponentInterface::close); // reports a failed termination
            closed.resolve(null);
        });
        if (ActorSpace.current() == space) {
            end.run();
        } else {
            try {
                space.execute(end);
            } catch (ActorStoppedException over) { // with the space, all of it has ended
                closed.reject(over);
            }
        }
        return closed;
    }

    /**
     * Like {@link #closeAsync}, and waits until that is done: for threads outside every space. On the thread of a space
     * it does not wait.
     *
     * @throws ApplicationException if it takes longer than a minute; it goes on
     */
    @Override
    public void close() {
        Application.Waiting.until(closeAsync(), "the node of an application");
    }
}
