package io.troupe.services.component.application;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Promise;
import io.troupe.broker.MissingServiceException;
import io.troupe.broker.Need;
import io.troupe.broker.Provider;
import io.troupe.bus.Address;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusTopic;
import io.troupe.services.component.Control;
import io.troupe.services.component.RemoteProvider;
import java.time.Duration;
import java.util.List;
import java.util.function.BooleanSupplier;
import org.jspecify.annotations.Nullable;

/**
 * The other nodes of an application, as the node that runs the application sees them: waits for them at the start, and
 * then notifies them each second that the application still runs.
 *
 * <p><b>Threads.</b> The application's space.
 */
final class OtherNodes {
    /** Published each second while the application runs. */
    record Alive(String application) {}

    static final Duration ALIVE_PERIOD = Duration.ofSeconds(1);

    private static final Duration START_LIMIT = Duration.ofSeconds(5);
    private static final Duration RETRY = Duration.ofMillis(250);
    // below the broker's limits, so that a request ends first
    private static final Duration CONTROL_LIMIT = Duration.ofSeconds(4);
    private static final Duration CHECK_LIMIT = Duration.ofMillis(750);

    private final ActorSpace space;
    private final ApplicationPlan plan;
    private final List<String> nodes;
    private final BusPort port;
    private final long beganNanos;
    private BooleanSupplier ended = () -> false;

    OtherNodes(ActorSpace space, ApplicationPlan plan, String node, BusPort port) {
        this.space = space;
        this.plan = plan;
        this.nodes = plan.nodes().stream()
                .filter(each -> !each.equals(node) && !plan.componentsOn(each).isEmpty())
                .toList();
        this.port = port;
        this.beganNanos = space.clock().nanos();
    }

    static BusTopic<Alive> alive(ApplicationPlan plan) {
        return new BusTopic<>(plan.name() + ":application/alive", Alive.class);
    }

    /** The address of a component on another node. */
    static Address address(ApplicationPlan plan, String component) {
        return new Address(plan.places().get(component), component);
    }

    static Provider provider(BusPort port, Address component) {
        return new RemoteProvider(port, component, CONTROL_LIMIT, CHECK_LIMIT);
    }

    /**
     * Fulfilled when all nodes have answered; rejected with a {@link MissingServiceException} if one is missing.
     *
     * @param hasEnded true when the application has ended
     */
    Promise<@Nullable Void> awaitAll(BooleanSupplier hasEnded) {
        ended = hasEnded;
        if (!nodes.isEmpty()) {
            publishAlive();
        }
        Promise<@Nullable Void> all = Promise.done();
        for (String node : nodes) {
            for (String component : plan.componentsOn(node)) {
                all = all.thenCompose(before -> await(new Address(node, component)));
            }
        }
        return all;
    }

    private Promise<@Nullable Void> await(Address component) {
        var question = new Control.AskHealth(port.address().toString());
        return port.ask(component, Control.HEALTH, question, CHECK_LIMIT)
                .<@Nullable Void>thenApply(present -> null)
                .exceptionallyCompose(error -> retry(component, error));
    }

    private Promise<@Nullable Void> retry(Address component, Throwable error) {
        if (ended.getAsBoolean()) {
            return Promise.failed(error);
        }
        if (space.clock().nanos() - beganNanos >= START_LIMIT.toNanos()) {
            var need = Need.ofService(
                    plan.name(), plan.components().get(component.name()).service());
            return Promise.failed(new MissingServiceException(
                    need,
                    "\"" + plan.name() + "\" needs node \"" + component.node() + "\" for "
                            + String.join(", ", plan.componentsOn(component.node())) + ", and has not found it within "
                            + START_LIMIT.toSeconds() + " s: " + error.getMessage()
                            + "; start the same application there"));
        }
        return space.delay(RETRY).thenCompose(later -> await(component));
    }

    private void publishAlive() {
        if (!ended.getAsBoolean()) {
            port.publish(alive(plan), new Alive(plan.name()));
            space.delay(ALIVE_PERIOD).handle((elapsed, closed) -> {
                if (closed == null) {
                    publishAlive();
                }
                return null;
            });
        }
    }
}
