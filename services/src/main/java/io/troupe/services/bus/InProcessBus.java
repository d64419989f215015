package io.troupe.services.bus;

import io.troupe.actor.ActorSpace;

/**
 * A bus inside one process.
 *
 * <p><b>Role.</b> Made by {@link #open}; ends with {@link #close}. It moves the same {@link Message}s as a bus between
 * processes would, so nothing that uses it can come to depend on identity: lists and maps in a value are copied unless
 * they are immutable.
 *
 * <p><b>Threads.</b> A subscriber and an answerer run on the actor space, and on behalf of the actor, that registered
 * them; registered outside every space, on the space of the settings. Messages are entries of the callback queue.
 *
 * <p><b>Order.</b> Values of one port reach a subscriber in the order in which they were published. Calls of
 * {@code publish} that overlap on several threads are in either order. At most once: nothing is repeated.
 *
 * <p><b>Cost.</b> Publishing costs one short lock for each subscriber. At most {@link BusSettings#capacity} messages
 * wait before one subscriber: then the oldest is dropped. Before an answerer the newest question is refused instead,
 * and when so many are begun and not yet answered; those whose asker on this node has given up do not count.
 *
 * <p><b>Errors.</b> {@link BusPort#ask} rejects with a {@link BusException} that names asker, answerer and operation:
 * nobody is there, nobody answers that, other types were expected, too many questions wait, the time is over, or one of
 * both has left, or its space is closed. An actor that stops and leaves its port open is missed with the next message
 * to it. A subscriber that throws does not keep others from hearing. What a port is asked to do after it was closed
 * throws a {@link BusException}.
 */
public final class InProcessBus implements Bus {
    private static final Transport NOWHERE = new Transport() {
        @Override
        public boolean reaches(String node) {
            return false;
        }

        @Override
        public void send(String node, Message message) {
            throw new IllegalStateException("there is no way to node " + node);
        }

        @Override
        public void broadcast(Message publication) {}

        @Override
        public void close() {}
    };

    private final BusNode node;

    private InProcessBus(BusNode node) {
        this.node = node;
    }

    /** A bus whose outsiders live on the {@link ActorSpace#global()} space. */
    public static InProcessBus open(String node) {
        return open(node, BusSettings.on(ActorSpace.global()));
    }

    /** A bus with settings of its own. */
    public static InProcessBus open(String node, BusSettings settings) {
        return new InProcessBus(new BusNode(node, settings, NOWHERE));
    }

    @Override
    public String node() {
        return node.node();
    }

    @Override
    public BusPort attach(String name) {
        return node.attach(name);
    }

    /** How much it has carried. */
    public BusMetrics metrics() {
        return node.metrics();
    }

    @Override
    public void close() {
        node.close();
    }

    @Override
    public String toString() {
        return "bus " + node.node();
    }
}
