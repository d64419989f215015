package io.troupe.services.component.application;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Promise;
import io.troupe.bus.Bus;
import io.troupe.bus.BusPort;
import io.troupe.services.component.ComponentInterface;
import io.troupe.services.component.ComponentObserver;
import io.troupe.services.component.ComponentState;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * Serves the components that a plan places on a node other than the first.
 *
 * {@snippet :
 * node = ApplicationNode.open(plan, laptop, observer);
 * }
 *
 * <p><b>Role.</b> Attaches the components to the bus; the application, which runs on the first node, starts and ends
 * them. They may be started again, by the same application or by a later one.
 *
 * <p><b>Threads.</b> One actor space, on which it is opened and stopped. The bus is left open.
 *
 * <p><b>Errors.</b> If nothing has come from the application for 3 s, it has ended, or is cut off: the components that
 * run are terminated, which is reported to the observer. A pause of this process does not count.
 */
public final class ApplicationNode {
    private static final Duration SILENCE_LIMIT = Duration.ofSeconds(3);

    private final ActorSpace space;
    private final String application;
    private final ComponentObserver observer;
    private final List<ComponentInterface<?, ?>> components = new ArrayList<>();
    private final BusPort port;
    private long seenNanos;
    private long lastCheckNanos;
    private boolean stopped;

    private ApplicationNode(ActorSpace space, ApplicationPlan plan, BusPort port, ComponentObserver observer) {
        this.space = space;
        this.application = plan.name();
        this.port = port;
        this.observer = observer;
        this.seenNanos = space.clock().nanos();
        this.lastCheckNanos = seenNanos;
    }

    /**
     * Attaches the components of a node.
     *
     * @param bus has the name of the node
     * @throws IllegalStateException if the current thread is not that of an actor space
     * @throws IllegalArgumentException if the plan places no components on this node, or it runs the application
     */
    public static ApplicationNode open(ApplicationPlan plan, Bus bus, ComponentObserver observer) {
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
        var node = new ApplicationNode(space, plan, bus.attach(plan.name() + ":node"), observer);
        for (String name : names) {
            node.components.add(
                    ComponentInterface.open(bus, name, plan.components().get(name), observer));
        }
        node.port.subscribe(
                OtherNodes.alive(plan),
                (alive, from) -> node.seenNanos = space.clock().nanos());
        node.checkLater();
        return node;
    }

    private void checkLater() {
        space.delay(OtherNodes.ALIVE_PERIOD).handle((elapsed, closed) -> {
            if (closed == null && !stopped) {
                check();
                checkLater();
            }
            return null;
        });
    }

    private void check() {
        long nowNanos = space.clock().nanos();
        long pausedNanos = nowNanos - lastCheckNanos - OtherNodes.ALIVE_PERIOD.toNanos();
        lastCheckNanos = nowNanos;
        if (pausedNanos > OtherNodes.ALIVE_PERIOD.toNanos()) {
            seenNanos += pausedNanos; // what came in the meantime has not been received yet
        } else if (nowNanos - seenNanos > SILENCE_LIMIT.toNanos()) {
            components.stream()
                    .filter(each -> each.state() == ComponentState.RUNNING)
                    .forEach(each -> {
                        observer.info(
                                each.address(),
                                "nothing has come from " + application + " for " + SILENCE_LIMIT.toSeconds()
                                        + " s: this component is ended");
                        each.stop().exceptionally(error -> {
                            observer.problem(each.address(), "could not be terminated", error);
                            return null;
                        });
                    });
        }
    }

    /** Ends the components and leaves the bus. */
    public Promise<@Nullable Void> stop() {
        stopped = true;
        port.close();
        Promise<@Nullable Void> all = Promise.done();
        for (var component : components) {
            all = all.thenCompose(before -> component.stop()).handle((ended, error) -> {
                component.close(); // reports a failed termination
                return null;
            });
        }
        return all;
    }
}
