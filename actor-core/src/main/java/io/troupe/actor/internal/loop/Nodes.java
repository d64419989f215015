package io.troupe.actor.internal.loop;

import org.jspecify.annotations.Nullable;

/**
 * Access to nodes for promises and queues. Internal to this library.
 *
 * <p>A promise is a {@link Node}: as public methods of a node, these would be methods of every user's promises.
 */
public final class Nodes {
    private Nodes() {}

    /** The node behind this one in the list that holds it, or null. */
    public static @Nullable Node next(Node node) {
        return node.next;
    }

    public static void link(Node node, @Nullable Node next) {
        node.next = next;
    }

    /** Runs a queued node; see {@link Node#serve}. */
    public static @Nullable Node serve(Node node) throws Throwable {
        return node.serve();
    }

    /** Passes an exception that a node has thrown to the node's handler. */
    public static void threw(Node node, Throwable thrown) {
        node.threw(thrown);
    }

    /** See {@link Node#isMessage}. */
    public static boolean isMessage(Node node) {
        return node.isMessage();
    }

    /** See {@link Node#turnOwner}. */
    public static @Nullable Owner turnOwner(Node message) {
        return message.turnOwner();
    }

    /** See {@link Node#carries}. */
    public static boolean carries(Node entry, Node wanted) {
        return entry.carries(wanted);
    }

    /** See {@link Node#isIdle}. */
    public static boolean isIdle(Node listener) {
        return listener.isIdle();
    }

    /** See {@link Node#hasTimedOut}. */
    public static boolean hasTimedOut(Node listener) {
        return listener.hasTimedOut();
    }

    /** Throws the error unchanged; the return type lets the caller write {@code throw}. */
    public static RuntimeException rethrow(Throwable error) {
        return Nodes.<RuntimeException>sneak(error);
    }

    @SuppressWarnings("unchecked")
    private static <E extends Throwable> E sneak(Throwable error) throws E {
        throw (E) error;
    }
}
