package io.troupe.bus;

/**
 * Sends messages to other nodes; the only part in which kinds of bus differ. Passes incoming messages to
 * {@link BusNode#receive}.
 *
 * <p><b>Role.</b> A node that is opened again under the same name numbers its messages from 1 again. A transport must
 * not deliver to it messages that were sent to, or by, the earlier node of that name. One way is to put the incarnation
 * of each node into its frames.
 *
 * <p><b>Threads.</b> Called from any thread; must not block. <b>Order.</b> Messages of one sender to one node arrive in
 * the order in which they were sent, or not at all.
 */
interface Transport {
    /** Returns whether a node of that name is known. */
    boolean reaches(String node);

    /** Sends a message to one node. */
    void send(String node, BusMessage message);

    /** Sends a publication to all other nodes. */
    void broadcast(BusMessage publication);

    /** Called when the node is closed: no message follows. */
    void close();
}
