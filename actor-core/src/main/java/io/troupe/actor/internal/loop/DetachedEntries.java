package io.troupe.actor.internal.loop;

import java.util.ArrayDeque;
import org.jspecify.annotations.Nullable;

/**
 * Runs entries without a home on one thread: one after the other, never nested. Used by that thread only. The thread of
 * a space keeps one; on other threads it exists only while it runs, so that nothing of this library stays behind there.
 */
public final class DetachedEntries {
    /** A thread that keeps its detached entries: an event loop. */
    public interface Keeper {
        DetachedEntries detachedNodes();
    }

    private final ArrayDeque<QueueEntry> waiting = new ArrayDeque<>(4);
    private boolean running;

    /** Those of the calling thread if it keeps them, or null. */
    public static @Nullable DetachedEntries kept() {
        return Thread.currentThread() instanceof Keeper keeper ? keeper.detachedNodes() : null;
    }

    /**
     * Runs an entry, and those that it adds; at once, or after the one that is running. An error of an entry does not
     * keep the others from running; the first one is thrown at the end.
     */
    public void run(QueueEntry node) {
        if (running) {
            waiting.add(node);
            return;
        }
        running = true;
        Error first = null;
        try {
            for (QueueEntry each = node; each != null; each = waiting.poll()) {
                try {
                    runOne(each);
                } catch (Error error) {
                    first = first == null ? error : first;
                }
            }
        } finally {
            running = false;
        }
        if (first != null) {
            throw first;
        }
    }

    private static void runOne(QueueEntry node) {
        try {
            node.serve(); // a listener, which returns none
        } catch (Throwable thrown) {
            node.threw(thrown);
        }
    }
}
