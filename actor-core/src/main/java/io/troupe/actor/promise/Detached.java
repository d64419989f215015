package io.troupe.actor.promise;

import java.util.ArrayDeque;
import org.jspecify.annotations.Nullable;

/**
 * Runs listeners that belong to no home, and relays, on the thread that settles their promise, one after the other and
 * never inside each other, so that a chain of them may be of any length.
 */
final class Detached {
    private static final ThreadLocal<@Nullable ArrayDeque<Node>> WAITING = new ThreadLocal<>();

    private Detached() {}

    /** Whether the calling thread is running such a listener. */
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
