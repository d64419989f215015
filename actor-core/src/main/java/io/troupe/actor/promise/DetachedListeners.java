package io.troupe.actor.promise;

import java.util.ArrayDeque;
import org.jspecify.annotations.Nullable;

/**
 * Runs relays, and listeners without a home, on the thread that settles their promise. They run one after the other,
 * never nested, so a chain of them may have any length.
 */
final class DetachedListeners {
    private static final ThreadLocal<@Nullable ArrayDeque<Node>> WAITING = new ThreadLocal<>();

    private DetachedListeners() {}

    /** True if the calling thread is running such a listener. */
    static boolean isRunning() {
        return WAITING.get() != null;
    }

    private static void runOne(Node listener) {
        try {
            listener.run();
        } catch (Throwable thrown) {
            listener.threw(thrown);
        }
    }

    static void run(Node listener) {
        ArrayDeque<Node> waiting = WAITING.get();
        if (waiting != null) {
            waiting.add(listener);
            return;
        }
        waiting = new ArrayDeque<>();
        WAITING.set(waiting);
        try {
            for (Node each = listener; each != null; each = waiting.poll()) {
                runOne(each);
            }
        } finally {
            WAITING.remove();
        }
    }
}
