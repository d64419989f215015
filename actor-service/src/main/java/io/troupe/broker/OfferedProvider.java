package io.troupe.broker;

import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import io.troupe.bus.BusException;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusTimeoutException;
import io.troupe.bus.Operation;
import io.troupe.bus.RemoteFailure;
import java.time.Duration;
import org.jspecify.annotations.Nullable;

/**
 * A provider that another process offers, as the broker of this process runs it. On the broker's space.
 *
 * <p><b>Role.</b> The broker of the process that offers it starts it, once, however many processes ask; others use it.
 * So a stop here ends only the use, unless the brokers have agreed to stop what is not used
 * ({@link Sharing#withUnusedStopped}).
 *
 * <p><b>Errors.</b> Its requests have three quarters of the broker's limits, so that they end first. A request that was
 * rejected soon after a reconnection is overdue rather than failed: the other process may not be connected again yet.
 */
final class OfferedProvider implements Provider {
    private static final Duration ASK_AGAIN = Duration.ofSeconds(1);
    private static final Duration RECONNECTING = Duration.ofSeconds(2);

    /** What the offers of one broker share. */
    record Context(
            Bus bus,
            BusPort port,
            BrokerSettings settings,
            Sharing sharing,
            RemoteActors actors,
            OfferMessages messages,
            long incarnation) {
        Address portOf(String node) {
            return new Address(node, messages.port);
        }
    }

    private final Context context;
    private final Address address;
    private OfferMessages.Offer offer;
    private boolean silent;
    private boolean withdrawn;
    private boolean isCheckPending;
    private boolean mayBeTried; // although it has failed
    private @Nullable Use use;

    /** The use of one life of the provider. */
    private record Use(long life, RemoteActor actor, Deferred<@Nullable Void> ended) {}

    OfferedProvider(Context context, Address address, OfferMessages.Offer offer) {
        this.context = context;
        this.address = address;
        this.offer = offer;
    }

    Address address() {
        return address;
    }

    // ---- what its process reports

    /** Returns whether only its state or rank differs, so that it is the same provider. */
    boolean isSame(OfferMessages.Offer other) {
        return other.service().equals(offer.service())
                && other.capabilities().equals(offer.capabilities())
                && other.methods().equals(offer.methods());
    }

    /** What has changed for those who may use it. */
    enum Change {
        NONE,
        /** Its process can be reached, and has not reported that it failed there: a failure here was one of the way. */
        REACHABLE,
        /** It runs, and did not run when its process was last known to be well. */
        REVIVED
    }

    Change update(OfferMessages.Offer now) {
        boolean revived = now.isRunning() && (silent || !offer.isRunning() || now.life() != offer.life());
        offer = now;
        silent = false;
        mayBeTried = true; // its process starts it again when asked, even if it has failed there
        Use used = use;
        if (used != null && hasEnded(used.life)) {
            end(used, new ProviderException(address + " has ended", null));
        }
        return revived ? Change.REVIVED : now.health() == Health.FAILED ? Change.NONE : Change.REACHABLE;
    }

    /** It has failed, for this process: it is tried again after the next report of its process. */
    void hasFailed() {
        mayBeTried = false;
    }

    /** Returns whether it may be tried again after a failure. */
    boolean mayBeTried() {
        return mayBeTried;
    }

    private boolean hasEnded(long life) {
        return offer.life() > life || offer.life() == life && !offer.isRunning() && offer.health() != Health.STARTING;
    }

    private void end(Use used, ProviderException why) {
        use = null;
        context.actors.leave(used.actor);
        used.actor.end();
        used.ended.reject(why);
    }

    /** Its process has been silent for a while, or is not any more. */
    void setSilent(boolean is) {
        silent = is;
    }

    /**
     * Its process does not offer it any more.
     *
     * @return the actor that gets no further calls from now on, but may answer earlier ones; null if it was not in use
     */
    @Nullable
    RemoteActor withdraw() {
        withdrawn = true;
        return use == null ? null : use.actor;
    }

    /** Its process is gone. */
    void endUse(String why) {
        Use used = use;
        if (used != null) {
            end(used, new ProviderException(why, null));
        }
    }

    boolean uses(RemoteActor actor) {
        return use != null && use.actor == actor;
    }

    int rank() {
        return offer.rank();
    }

    boolean isSilent() {
        return silent;
    }

    /** Its health, from what the broker of this process knows and from what its own process reports. */
    Health health(Health here) {
        return switch (here) {
            case NOT_STARTED, STOPPED -> silent ? Health.SUSPECT : offer.health();
            case WELL -> silent || offer.health() == Health.SUSPECT ? Health.SUSPECT : Health.WELL;
            case STARTING, SUSPECT, FAILED -> here;
        };
    }

    /**
     * Sends a request to the broker of its process, whatever the reply.
     *
     * @return false if there was none in time
     */
    Promise<Boolean> probe(Duration limit) {
        return context.port
                .ask(
                        context.portOf(address.node()),
                        OfferMessages.CHECK,
                        new OfferMessages.Check(address.name(), offer.life()),
                        limit)
                .handle((checked, error) -> error == null || error instanceof RemoteFailure);
    }

    /** @param roundTrip of a request to its process; null if there was no answer */
    ServiceOffer toOffer(Duration age, @Nullable Duration roundTrip) {
        Health health = silent || roundTrip == null ? Health.SUSPECT : offer.health();
        var record = new ServiceRecord(offer.service(), offer.capabilities(), address, health);
        return new ServiceOffer(record, offer.rank(), offer.life(), age, roundTrip);
    }

    // ---- as a provider

    @Override
    public Promise<@Nullable Void> start() {
        Duration limit = context.settings.startLimit().multipliedBy(3).dividedBy(4);
        int times = Math.clamp(limit.dividedBy(ASK_AGAIN), 1, Integer.MAX_VALUE);
        return askToStart(limit.dividedBy(times), times).thenAccept(started -> hasStarted(started.life()));
    }

    /** Asks again if there is no reply: the request may be lost, and a provider that is being started is not again. */
    private Promise<OfferMessages.Started> askToStart(Duration limit, int times) {
        return ask(
                        OfferMessages.START,
                        new OfferMessages.Start(address.name(), context.bus.node(), context.incarnation),
                        limit)
                .exceptionallyCompose(error -> times > 1 && error.getCause() instanceof BusTimeoutException
                        ? askToStart(limit, times - 1)
                        : Promise.failed(error));
    }

    private void hasStarted(long life) {
        if (hasEnded(life)) { // the offers have overtaken the reply
            throw new ProviderException(address + " has ended", null);
        }
        use = new Use(life, context.actors.begin(address, offer.methods()), Deferred.unbound());
    }

    @Override
    public Promise<@Nullable Void> stop() {
        Use used = use;
        use = null;
        if (used != null) {
            context.actors.leave(used.actor);
            if (withdrawn) {
                used.actor.retire();
            } else {
                used.actor.end();
            }
        }
        return withdrawn || !context.sharing.stopsUnused() ? Promise.done() : stopThere(used == null ? 0 : used.life);
    }

    private Promise<@Nullable Void> stopThere(long life) {
        Duration limit = context.settings.stopLimit().multipliedBy(3).dividedBy(4);
        return ask(OfferMessages.STOP, new OfferMessages.Stop(address.name(), life), limit)
                .thenAccept(stopped -> {});
    }

    @Override
    public Promise<@Nullable Void> check() {
        Use used = use;
        if (used == null) {
            return Promise.failed(new ProviderException(address + " has ended", null));
        }
        Duration limit = context.settings.checkLimit().multipliedBy(3).dividedBy(4);
        return ask(OfferMessages.CHECK, new OfferMessages.Check(address.name(), used.life), limit)
                .thenAccept(checked -> {
                    if (checked.suspect()) {
                        throw ProviderException.overdue(address + " has not answered its own broker in time", null);
                    }
                });
    }

    @Override
    public Promise<@Nullable Void> whenEnded() {
        return use == null ? Promise.failed(new ProviderException(address + " has ended", null)) : use.ended;
    }

    /** A call could not be delivered: checks it now, rather than with the next check. */
    void checkNow() {
        Use used = use;
        if (used == null || isCheckPending) {
            return;
        }
        isCheckPending = true;
        check().onSettled((well, error) -> {
            isCheckPending = false;
            if (use == used && error instanceof ProviderException failed && !failed.mayHaveRun()) {
                end(used, failed);
            }
        });
    }

    private <Q extends Record, A extends Record> Promise<A> ask(Operation<Q, A> operation, Q request, Duration limit) {
        return context.port
                .ask(context.portOf(address.node()), operation, request, limit)
                .exceptionallyCompose(error -> Promise.failed(asProviderError(error)));
    }

    private Throwable asProviderError(Throwable error) {
        return switch (error) {
            case RemoteFailure failure -> new ProviderException(failure.problem(), failure);
            case BusTimeoutException timeout ->
                ProviderException.overdue(String.valueOf(timeout.getMessage()), timeout);
            case BusException undelivered
            when context.bus.connectedFor().compareTo(RECONNECTING) < 0 ->
                ProviderException.overdue(String.valueOf(undelivered.getMessage()), undelivered);
            case BusException undelivered ->
                new ProviderException(String.valueOf(undelivered.getMessage()), undelivered);
            default -> error;
        };
    }
}
