package io.troupe.broker;

import io.troupe.actor.Actor;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.Schedule;
import io.troupe.actor.Timer;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import io.troupe.bus.BusException;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusTopic;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import org.jspecify.annotations.Nullable;

/**
 * Exchanges offers with the brokers of other processes: publishes the providers of this process each second and at once
 * after a change, and registers theirs with the broker of this one. On the broker's space.
 *
 * <p>A process whose offers are not renewed for 3 s is suspect; after 10 s its providers are withdrawn. A pause of this
 * process, as by its garbage collector, does not count.
 */
final class OfferExchange extends Actor implements ActorServices.Exchange {
    private static final Duration PERIOD = Duration.ofSeconds(1);
    private static final Duration SUSPECT_AFTER = Duration.ofSeconds(3);
    private static final Duration WITHDRAWN_AFTER = Duration.ofSeconds(10);

    private static final Comparator<ServiceOffer> BY_SERVICE = Comparator.comparing(
                    (ServiceOffer offer) -> offer.provider().service())
            .thenComparingInt(ServiceOffer::rank)
            .thenComparing(offer -> offer.provider().provider().toString());

    private final Bus bus;
    private final BusPort port;
    private final BrokerActor broker;
    private final LocalActors actors;
    private final OfferedProvider.Context context;
    private final OfferMessages messages;
    private final Map<String, User> users = new HashMap<>(); // by the name of the provider; only if these are stopped
    private final Map<String, Peer> peers = new HashMap<>();
    private List<OfferMessages.Offer> published = List.of();
    private long count;
    private long lastTickNanos;
    private boolean asked; // the broker, for changes
    private boolean closed;
    private boolean brokerEnded;
    private @Nullable Timer ticking;

    /** The process that has had a provider started. */
    private record User(String node, long incarnation, long sinceNanos) {}

    OfferExchange(OfferedProvider.Context context, BrokerActor broker, LocalActors actors) {
        this.bus = context.bus();
        this.port = context.port();
        this.context = context;
        this.messages = context.messages();
        this.broker = broker;
        this.actors = actors;
    }

    @Override
    protected void started() {
        port.answer(OfferMessages.START, this::start);
        if (context.sharing().stopsUnused()) {
            port.answer(OfferMessages.STOP, this::stop);
        }
        port.answer(
                OfferMessages.CHECK,
                check -> broker.healthOf(at(check.name()), check.life())
                        .thenApply(health -> new OfferMessages.Checked(health == Health.SUSPECT)));
        port.subscribe(messages.offers, this::receive);
        port.subscribe(messages.ask, (ask, from) -> {
            if (!isOwn(from)) {
                publish(true);
            }
        });
        broker.share(bus.node(), context.sharing(), () -> publish(false));
        lastTickNanos = nowNanos();
        send(messages.ask, new OfferMessages.AskOffers());
        publish(true);
        ticking = context().every(PERIOD, Schedule.FIXED_DELAY, this::tick);
    }

    private Address at(String name) {
        return new Address(bus.node(), name);
    }

    private boolean isOwn(Address from) {
        return from.node().equals(bus.node());
    }

    private long nowNanos() {
        return context().space().clock().nanos();
    }

    // ---- the offers of this process

    /** @param always false to publish only what has changed */
    private void publish(boolean always) {
        if (!closed && (always || !asked)) {
            asked = !always || asked;
            broker.offerings().onSettled((offerings, error) -> {
                asked = asked && always;
                if (offerings != null) {
                    publish(offerings, always);
                }
            });
        }
    }

    private void publish(BrokerActor.Offerings offerings, boolean always) {
        if (closed) {
            return;
        }
        List<OfferMessages.Offer> now =
                offerings.all().stream().map(this::offer).toList();
        if (always || !now.equals(published)) {
            published = now;
            send(messages.offers, new OfferMessages.Offers(context.incarnation(), ++count, now));
        }
        if (offerings.closing() && !closed) {
            stopUsing("the broker of this process was closed");
        }
    }

    private <T extends Record> void send(BusTopic<T> topic, T value) {
        try {
            port.publish(topic, value);
        } catch (BusException busClosed) {
            end("the bus of this process was closed");
        }
    }

    private void end(String why) {
        stopUsing(why);
        port.close();
    }

    private void stopUsing(String why) {
        closed = true;
        if (ticking != null) {
            ticking.cancel();
        }
        peers.values().forEach(peer -> peer.end(why));
        peers.clear();
    }

    private OfferMessages.Offer offer(BrokerActor.Offering offering) {
        ServiceRecord record = offering.record();
        return new OfferMessages.Offer(
                record.provider().name(),
                record.service(),
                record.capabilities(),
                record.health(),
                rankOf(record),
                offering.life(),
                actors.methods(record.provider()));
    }

    private int rankOf(ServiceRecord record) {
        return context.sharing().rank(record.provider().name());
    }

    // ---- the use of the providers of this process

    private Promise<OfferMessages.Started> start(OfferMessages.Start start) {
        if (context.sharing().stopsUnused()) {
            users.put(start.name(), new User(start.by(), start.incarnation(), nowNanos()));
        }
        return broker.startAt(at(start.name())).thenApply(offering -> new OfferMessages.Started(offering.life()));
    }

    private Promise<OfferMessages.Stopped> stop(OfferMessages.Stop stop) {
        users.remove(stop.name());
        return broker.stopAt(at(stop.name()), stop.life()).thenApply(stopped -> new OfferMessages.Stopped());
    }

    /** Stops what runs for a process that has been silent. */
    private void stopUnused(long nowNanos) {
        users.entrySet().removeIf(each -> {
            boolean isSilent = nowNanos - seenNanos(each.getValue()) > SUSPECT_AFTER.toNanos();
            if (isSilent) {
                broker.stopUnused(
                        at(each.getKey()),
                        "nothing has come from " + each.getValue().node() + " for " + SUSPECT_AFTER.toSeconds() + " s");
            }
            return isSilent;
        });
    }

    private long seenNanos(User user) {
        Peer peer = peers.get(user.node());
        return peer != null && peer.incarnation == user.incarnation() && peer.seenNanos > user.sinceNanos()
                ? peer.seenNanos
                : user.sinceNanos();
    }

    // ---- the offers of others

    /** Another process with a broker. */
    private final class Peer {
        final String node;
        final long incarnation;
        final long before; // the incarnation before this one; 0 = unknown
        final Map<String, OfferedProvider> offered = new HashMap<>();
        private final Set<RemoteActor> retired = new HashSet<>(); // they may answer earlier calls
        long count;
        long seenNanos;

        Peer(String node, long incarnation, long before) {
            this.node = node;
            this.incarnation = incarnation;
            this.before = before;
        }

        void update(List<OfferMessages.Offer> offers) {
            Set<String> names = new HashSet<>();
            for (OfferMessages.Offer offer : offers) {
                if (names.add(offer.name())) {
                    update(offer);
                }
            }
            List.copyOf(offered.keySet()).stream()
                    .filter(name -> !names.contains(name))
                    .forEach(this::withdraw);
        }

        private void update(OfferMessages.Offer offer) {
            OfferedProvider known = offered.get(offer.name());
            if (known != null && known.isSame(offer)) {
                switch (known.update(offer)) {
                    case REVIVED -> broker.revive(known.address(), true);
                    case REACHABLE -> broker.revive(known.address(), false);
                    case NONE -> {}
                }
                return;
            }
            if (known != null) {
                withdraw(offer.name());
            }
            var provider = new OfferedProvider(context, new Address(node, offer.name()), offer);
            offered.put(offer.name(), provider);
            broker.offer(offer.service(), List.copyOf(offer.capabilities()), provider);
        }

        private void withdraw(String name) {
            OfferedProvider provider = offered.remove(name);
            if (provider != null) {
                RemoteActor used = provider.withdraw();
                if (used != null) {
                    retired.add(used);
                }
                if (!brokerEnded) {
                    broker.withdrawOffered(provider);
                }
            }
        }

        /** The process is gone: withdraws all that it has offered. */
        void end(String why) {
            List.copyOf(offered.values()).forEach(provider -> {
                if (!brokerEnded) { // it has no listeners any more
                    provider.endUse(provider.address() + " has ended: " + why);
                }
                withdraw(provider.address().name());
            });
            retired.forEach(RemoteActor::end);
            retired.clear();
        }

        void setSilent(boolean is) {
            offered.values().forEach(provider -> provider.setSilent(is));
        }
    }

    private void receive(OfferMessages.Offers offers, Address from) {
        if (isOwn(from)) {
            if (closed) {
                port.close(); // these are the last ones
            }
            return;
        }
        if (closed) {
            return;
        }
        String node = from.node();
        Peer peer = peers.get(node);
        if (peer != null && offers.incarnation() == peer.before) {
            return; // late, from an earlier life
        }
        if (peer == null || peer.incarnation != offers.incarnation()) {
            long before = 0;
            if (peer != null) {
                before = peer.incarnation;
                peer.end("the process " + node + " was started again");
            }
            peer = new Peer(node, offers.incarnation(), before);
            peers.put(node, peer);
        }
        if (offers.count() <= peer.count) {
            return;
        }
        peer.count = offers.count();
        peer.seenNanos = nowNanos();
        peer.update(offers.offers());
    }

    private void tick() {
        long nowNanos = nowNanos();
        long sinceLastNanos = nowNanos - lastTickNanos;
        lastTickNanos = nowNanos;
        long connectedNanos = bus.connectedFor().toNanos();
        if (connectedNanos > 0 && connectedNanos < sinceLastNanos && !closed) {
            send(messages.ask, new OfferMessages.AskOffers()); // connected again
        }
        publish(true);
        long pausedNanos = sinceLastNanos - PERIOD.toNanos();
        for (Peer peer : new ArrayList<>(peers.values())) {
            if (pausedNanos > PERIOD.toNanos()) {
                peer.seenNanos += pausedNanos; // what came in the meantime has not been received yet
            }
            long silentNanos = nowNanos - peer.seenNanos;
            if (silentNanos > WITHDRAWN_AFTER.toNanos()) {
                peers.remove(peer.node);
                peer.end("the process " + peer.node + " has been silent for " + WITHDRAWN_AFTER.toSeconds() + " s");
            } else {
                peer.setSilent(silentNanos > SUSPECT_AFTER.toNanos());
            }
        }
        if (pausedNanos > PERIOD.toNanos()) {
            users.replaceAll(
                    (name, user) -> new User(user.node(), user.incarnation(), user.sinceNanos() + pausedNanos));
        }
        stopUnused(nowNanos);
    }

    // ---- a survey of all offers

    @Override
    public Promise<List<ServiceOffer>> offers(Duration limit) {
        if (closed) {
            return Promise.failed(new IllegalStateException("the bus or the broker of this process is closed"));
        }
        send(messages.ask, new OfferMessages.AskOffers());
        var waited = new Deferred<@Nullable Void>();
        context().after(limit, () -> waited.resolve(null));
        return waited.thenCompose(done -> Promise.all(
                        peers.values().stream().map(peer -> survey(peer, limit)).toList()))
                .thenCompose(others -> own().thenApply(own -> {
                    var all = new ArrayList<>(own);
                    others.forEach(all::addAll);
                    return all.stream().sorted(BY_SERVICE).toList();
                }));
    }

    private Promise<List<ServiceOffer>> own() {
        return broker.offerings()
                .thenApply(offerings -> offerings.all().stream()
                        .map(each -> new ServiceOffer(
                                each.record(), rankOf(each.record()), each.life(), Duration.ZERO, Duration.ZERO))
                        .toList());
    }

    /** The offers of another process, with the time of a request to its broker. */
    private Promise<List<ServiceOffer>> survey(Peer peer, Duration limit) {
        List<OfferedProvider> offered = List.copyOf(peer.offered.values());
        if (offered.isEmpty()) {
            return Promise.of(List.of());
        }
        long beganNanos = nowNanos();
        return offered.getFirst().probe(limit).thenApply(answered -> {
            long endedNanos = nowNanos();
            Duration roundTrip = answered ? Duration.ofNanos(endedNanos - beganNanos) : null;
            Duration age = Duration.ofNanos(endedNanos - peer.seenNanos);
            return offered.stream().map(each -> each.toOffer(age, roundTrip)).toList();
        });
    }

    @Override
    public void checkNow(RemoteActor actor) {
        Peer peer = peers.get(actor.address().node());
        if (peer != null) {
            peer.offered.values().stream()
                    .filter(provider -> provider.uses(actor))
                    .forEach(OfferedProvider::checkNow);
        }
    }

    @Override
    protected void stopped() {
        brokerEnded = true;
        end("the broker of this process has ended");
    }
}
