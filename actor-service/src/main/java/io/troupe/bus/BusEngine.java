package io.troupe.bus;

import org.jspecify.annotations.Nullable;

/**
 * Carries the messages of one node to other nodes, as bytes. For authors of engines; {@code actor-nats} has one.
 *
 * {@snippet :
 * try (Bus bus = Bus.open("robot", engine, BusSettings.on(space))) {
 *     bus.attach("sensor").publish(OUTSIDE, new Temperature(-3));
 * }
 * }
 *
 * <p><b>Role.</b> A node passes an engine to {@link Bus#open}, which starts it, and closes it with the bus. An engine
 * knows nodes, topics and frames, but neither ports nor types: the bus encodes and decodes the frames, and their format
 * is in {@code docs/wire-format.md}.
 *
 * <p><b>Threads.</b> The bus calls from any thread. No method but {@link #start} and {@link #close} may block; a frame
 * that cannot be passed on at once is rejected by an exception, or dropped and reported by {@link Listener#lost}.
 *
 * <p><b>Order.</b> Frames that one node sends to another arrive in the order in which they were sent, or not at all; so
 * do the frames of one node on one topic. Frames to a node and frames on topics may overtake each other.
 *
 * <p><b>Errors.</b> At most once: an engine never sends a frame twice, and never keeps a frame for later while it is
 * disconnected. A late velocity is a danger.
 */
public interface BusEngine {
    /**
     * Connects, and starts to receive the frames to this node.
     *
     * @param incarnation distinguishes this life of the node from earlier and later ones of the same name
     * @throws BusException if there is no connection, or another process has the name; the message names the remedy
     */
    void start(String node, long incarnation, Listener listener);

    /** Why no frame can be sent now, or null if it is connected. */
    @Nullable
    String whyDisconnected();

    /** The most bytes of a frame. */
    int maxFrameBytes();

    /**
     * Sends a frame to a node. If the engine learns that no such node receives frames now, it reports that number to
     * {@link Listener#unreachable}.
     */
    void send(String node, long number, byte[] frame);

    /**
     * Sends a reply to that life of a node only. If the engine learns that it receives frames no more, it calls
     * {@link Listener#gone}.
     *
     * @param number the number of the request
     */
    void reply(String node, long incarnation, long number, byte[] frame);

    /** Sends a frame to the nodes that have subscribed to the topic, except this one. */
    void publish(String topic, byte[] frame);

    /** This node has a subscriber of the topic now. */
    void subscribe(String topic);

    /** This node has no subscriber of the topic any more. */
    void unsubscribe(String topic);

    /** Disconnects. No frame is passed to the listener afterwards. */
    void close();

    /**
     * The receiving side of a node. Any thread may call it; it does not block.
     *
     * {@snippet :
     * listener.frame(received);
     * }
     */
    interface Listener {
        /** A frame for this node, or on a topic to which it subscribes. */
        void frame(byte[] frame);

        /** No node receives what was sent to this one under that number. */
        void unreachable(String node, long number, String why);

        /**
         * Frames of this node to that one are rejected until further notice, for example because a permission is
         * missing: nothing that was sent to it lately has arrived.
         */
        void rejected(String node, String why);

        /** That life of a node has ended, or is cut off: nothing receives replies to it. */
        void gone(String node, long incarnation);

        /** Frames from other nodes, or to them, were lost in the engine. */
        void lost(long frames, String why);

        /** The connection has ended; the engine connects again by itself. */
        void disconnected(String why);

        /** The connection is there again. */
        void connected();
    }
}
