package io.troupe.services.subsumption;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.broker.ActorServices;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerObserver;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.ServiceRecord;
import io.troupe.broker.Sharing;
import io.troupe.bus.Bus;
import io.troupe.bus.internal.OwnName;
import java.time.Duration;
import java.util.Collection;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/**
 * A process that drives robots together with others: it publishes robot services for an arbitrator elsewhere, or runs
 * the arbitrator ({@link SubsumptionRun#overHosts}), or both.
 *
 * {@snippet :
 * var node = RobotNode.open(bus, space, BrokerObserver.logging(), 0);
 * var robots = RobotServicesActor.Settings.defaults().withPort(port);
 * var offer = node.offer(driving, robots, List.of("wallFollower", "spaceWanderer"));
 * }
 *
 * <p><b>Role.</b> Once per bus. It opens a broker whose limits are those that the main job needs: a provider that is
 * killed, frozen or cut off is replaced within 5 s.
 *
 * <p><b>Threads.</b> Any thread.
 */
public final class RobotNode implements AutoCloseable {
    /**
     * A provider that does not answer is replaced after 2 to 3 s; then its leases are over. Restarts are quick, as
     * there may be no other provider.
     */
    private static final BrokerSettings BROKER = BrokerSettings.defaults()
            .withCheckEvery(Duration.ofMillis(500))
            .withCheckLimit(Duration.ofSeconds(1))
            .withMissedChecks(2)
            .withRestartPauses(Duration.ofMillis(500), Duration.ofSeconds(4));

    private static final OwnName REPORTS = new OwnName("$robots");

    private final Bus bus;
    private final Broker broker;
    private final ActorServices actors;

    private RobotNode(Bus bus, Broker broker, ActorServices actors) {
        this.bus = bus;
        this.broker = broker;
        this.actors = actors;
    }

    /**
     * Opens the broker of a process.
     *
     * @param space of the broker; the robots are driven on another one, so that the broker detects if that hangs
     * @param rank the lower, the earlier its providers are chosen among equals
     */
    public static RobotNode open(Bus bus, ActorSpace space, BrokerObserver observer, int rank) {
        var broker = Broker.over(
                bus, space, BROKER.withObserver(observer), Sharing.defaults().withRank(rank));
        return new RobotNode(bus, broker, broker.services());
    }

    Bus bus() {
        return bus;
    }

    Broker broker() {
        return broker;
    }

    ActorServices actors() {
        return actors;
    }

    /**
     * Publishes robot services, each as a capability of one actor. It connects to the robots when an arbitrator needs
     * it, and is replaced by another provider when it has lost them.
     *
     * @param space runs the services
     * @param services names of services of the table
     * @throws IllegalArgumentException if a service is not in the table
     */
    public Offer offer(ActorSpace space, RobotServicesActor.Settings robots, Collection<String> services) {
        Set<String> names = new LinkedHashSet<>(services);
        for (String name : names) {
            RobotServicesActor.named(robots.table(), name);
        }
        var reporting = robots.withObserver(new DriverReport.Publisher(bus.attach(REPORTS), robots.observer()));
        var current = new AtomicReference<@Nullable RobotServicesActor>();
        Promise<ServiceRecord> published =
                actors.publish(space, RobotServices.class, RobotServices.SERVICE, List.copyOf(names), () -> {
                    var actor = RobotServicesActor.forHosts(reporting, names);
                    current.set(actor);
                    return actor;
                });
        return new Offer(this, space, published, current);
    }

    /** Robot services that this process has published. */
    public static final class Offer {
        private final RobotNode node;
        private final ActorSpace space;
        private final Promise<ServiceRecord> published;
        private final AtomicReference<@Nullable RobotServicesActor> current;

        private Offer(
                RobotNode node,
                ActorSpace space,
                Promise<ServiceRecord> published,
                AtomicReference<@Nullable RobotServicesActor> current) {
            this.node = node;
            this.space = space;
            this.published = published;
            this.current = current;
        }

        /** Fulfilled when the services are registered. */
        public Promise<ServiceRecord> published() {
            return published;
        }

        /**
         * Stops the robots and withdraws the services; arbitrators get another provider at once.
         *
         * @return fulfilled when the robots have been stopped
         */
        public Promise<@Nullable Void> withdraw() {
            Deferred<@Nullable Void> left = Deferred.unbound();
            space.execute(() -> {
                RobotServicesActor actor = current.get();
                Promise<?> stopped = actor == null ? Promise.done() : actor.leave();
                stopped.onSettled((done, error) -> left.resolve(null));
            });
            return left.thenCompose(stopped -> published)
                    .thenCompose(record -> node.broker.withdraw(record.provider()));
        }
    }

    /** Closes the broker. Other processes notice it at once. */
    @Override
    public void close() {
        broker.closeAsync().handle((left, error) -> null);
    }
}
