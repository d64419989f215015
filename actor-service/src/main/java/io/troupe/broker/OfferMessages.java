package io.troupe.broker;

import io.troupe.bus.BusTopic;
import io.troupe.bus.Operation;
import java.util.List;

/** The messages between the brokers of several processes, in the form of {@code docs/wire-format.md}. */
final class OfferMessages {
    /**
     * A provider that a process offers.
     *
     * @param name the name in its address
     * @param rank the lower, the earlier it is chosen among equals
     * @param life counts the starts of the provider; 0 = it has never been started
     * @param methods the names of the methods of an actor; empty for another provider
     */
    record Offer(
            String name,
            String service,
            List<String> capabilities,
            Health health,
            int rank,
            long life,
            List<String> methods) {
        boolean isRunning() {
            return health == Health.WELL || health == Health.SUSPECT;
        }
    }

    /**
     * All providers that a process offers.
     *
     * @param incarnation differs between the lives of a process
     * @param count increases with each message of one incarnation
     */
    record Offers(long incarnation, long count, List<Offer> offers) {}

    /** Asks all processes to publish their offers now. */
    record AskOffers() {}

    /**
     * Starts a provider unless it runs.
     *
     * @param by the node that asks, and {@code incarnation} that of its offers
     */
    record Start(String name, String by, long incarnation) {}

    /** @param life the number of the life that runs */
    record Started(long life) {}

    /**
     * Stops a provider that runs only while another process uses it.
     *
     * @param life stops that life only; 0 = whichever runs
     */
    record Stop(String name, long life) {}

    /** Confirms a stop. */
    record Stopped() {}

    /** Asks whether that life of a provider runs. */
    record Check(String name, long life) {}

    /** @param suspect whether it runs, but has not answered its last health check */
    record Checked(boolean suspect) {}

    static final Operation<Start, Started> START =
            new Operation<>("start", Start.class, Started.class, Operation.Kind.CONTROL);
    static final Operation<Stop, Stopped> STOP =
            new Operation<>("stop", Stop.class, Stopped.class, Operation.Kind.CONTROL);
    static final Operation<Check, Checked> CHECK =
            new Operation<>("check", Check.class, Checked.class, Operation.Kind.CONTROL);

    /** The name of the port that has the operations. */
    final String port;

    /** The names of the ports of connections begin with it. */
    final String caller;

    final BusTopic<Offers> offers;
    final BusTopic<AskOffers> ask;

    /** @param group of brokers; empty = those that have none */
    OfferMessages(String group) {
        String suffix = group.isEmpty() ? "" : ":" + group;
        port = "$broker" + suffix;
        caller = "$caller" + suffix;
        offers = new BusTopic<>(port + "/offers", Offers.class);
        ask = new BusTopic<>(port + "/offers?", AskOffers.class);
    }
}
