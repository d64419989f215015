package io.troupe.bus;

import io.troupe.actor.ActorSpace;

/**
 * A bus inside one process.
 *
 * <p><b>Role.</b> Created by {@link #open}, ended by {@link #close}. It carries the same {@link BusMessage} records as
 * a bus between processes, so its users cannot depend on object identity: lists and maps in a value are copied unless
 * they are immutable.
 *
 * <p><b>Threads.</b> A subscriber or a request handler runs on the actor space, and on behalf of the actor, that
 * registered it; if it was registered outside every space, on the space of the settings. Messages are entries of the
 * callback queue.
 *
 * <p><b>Order.</b> Values of one port reach a subscriber in the order in which they were published. Concurrent calls of
 * {@code publish} on several threads are delivered in either order. At most once: nothing is repeated.
 *
 * <p><b>Cost.</b> Publishing takes one short lock per subscriber. At most {@link BusSettings#capacity} messages are
 * queued for one subscriber; when the queue is full, the oldest is dropped. When the queue of a request handler is
 * full, or it has that many requests begun without a reply, the newest request is rejected instead; requests whose
 * requester on this node has cancelled do not count.
 *
 * <p><b>Errors.</b> {@link BusPort#ask} rejects with a {@link BusException} that names the requester, the receiver and
 * the operation. Causes: no port at the address, no handler for the operation, another value type than expected, too
 * many queued requests, the time limit, or that one of both ports or its space was closed. If an actor stops and its
 * port stays open, the bus detects this at the next message to it. An exception from one subscriber does not affect the
 * others. Methods of a closed port throw a {@link BusException}.
 */
public final class InProcessBus implements Bus {
    private static final Transport NOWHERE = new Transport() {
        @Override
        public boolean reaches(String node) {
            return false;
        }

        @Override
        public void send(String node, BusMessage message) {
            throw new IllegalStateException("there is no way to node " + node);
        }

        @Override
        public void broadcast(BusMessage publication) {}

        @Override
        public void close() {}
    };

    private final BusNode node;

    private InProcessBus(BusNode node) {
        this.node = node;
    }

    /** A bus that uses {@link ActorSpace#global()} for code outside every actor space. */
    public static InProcessBus open(String node) {
        return open(node, BusSettings.on(ActorSpace.global()));
    }

    /** A bus with the given settings. */
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

    /** The message counts since the bus was opened. */
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
