package io.troupe.services.bus;

/**
 * The way from one node to the others; what a bus between processes has of its own. It hands what arrives to
 * {@link BusNode#receive}.
 *
 * <p><b>Role.</b> A node that is opened again under its name counts its messages from 1 again: a transport must bring
 * it nothing that was sent to an earlier life, or that this sent, for example by the incarnation of each node in its
 * frames.
 *
 * <p><b>Threads.</b> Any thread calls, none waits. <b>Order.</b> Messages of one sender to one node arrive in the order
 * in which they were sent, or not at all.
 */
interface Transport {
    /** Whether there is a node of that name. */
    boolean reaches(String node);

    /** Takes a message to one node. */
    void send(String node, Message message);

    /** Takes a publication to all other nodes. */
    void broadcast(Message publication);

    /** Nothing comes any more. */
    void close();
}
