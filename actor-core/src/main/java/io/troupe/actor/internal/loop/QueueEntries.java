package io.troupe.actor.internal.loop;

import org.jspecify.annotations.Nullable;

/**
 * Access to entries for promises and queues. Internal to this library.
 *
 * <p>A promise is a {@link QueueEntry}: as public methods of an entry, these would be methods of every user's promises.
 */
public final class QueueEntries {
    private QueueEntries() {}

    /** The entry behind this one in the list that holds it, or null. */
    public static @Nullable QueueEntry next(QueueEntry node) {
        return node.next;
    }

    public static void link(QueueEntry node, @Nullable QueueEntry next) {
        node.next = next;
    }

    /** Runs a queued entry; see {@link QueueEntry#serve}. */
    public static @Nullable QueueEntry serve(QueueEntry node) throws Throwable {
        return node.serve();
    }

    /** Passes an exception that an entry has thrown to the entry's handler. */
    public static void threw(QueueEntry node, Throwable thrown) {
        node.threw(thrown);
    }

    /** See {@link QueueEntry#isMessage}. */
    public static boolean isMessage(QueueEntry node) {
        return node.isMessage();
    }

    /** See {@link QueueEntry#turnOwner}. */
    public static @Nullable TurnOwner turnOwner(QueueEntry message) {
        return message.turnOwner();
    }

    /** See {@link QueueEntry#carries}. */
    public static boolean carries(QueueEntry entry, QueueEntry wanted) {
        return entry.carries(wanted);
    }

    /** See {@link QueueEntry#isIdle}. */
    public static boolean isIdle(QueueEntry listener) {
        return listener.isIdle();
    }

    /** See {@link QueueEntry#hasTimedOut}. */
    public static boolean hasTimedOut(QueueEntry listener) {
        return listener.hasTimedOut();
    }

    /** Throws the error unchanged; the return type lets the caller write {@code throw}. */
    public static RuntimeException rethrow(Throwable error) {
        return QueueEntries.<RuntimeException>sneak(error);
    }

    @SuppressWarnings("unchecked")
    private static <E extends Throwable> E sneak(Throwable error) throws E {
        throw (E) error;
    }
}
