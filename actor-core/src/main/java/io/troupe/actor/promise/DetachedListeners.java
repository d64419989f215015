package io.troupe.actor.promise;

import java.util.ArrayDeque;
import org.jspecify.annotations.Nullable;

/**
 * Runs relays, and listeners without a home, on the thread that settles their promise. They run one after the other,
 * never nested, so a chain of them may have any length.
 *
 * <p><b>Cost.</b> The thread of a home keeps its queue. Any other thread gets a queue for each outermost listener, so
 * that nothing of this library stays behind in the threads of others.
 */
final class DetachedListeners {
    /** The queue of a thread that is no home's; present while it runs a listener. */
    private static final ThreadLocal<@Nullable DetachedListeners> RUNNING = new ThreadLocal<>();

    private final ArrayDeque<Node> waiting = new ArrayDeque<>(4);
    private boolean running;

    /** True if the calling thread is running such a listener. */
    static boolean isRunning() {
        Home here = Home.current();
        return here == null ? RUNNING.get() != null : here.detachedListeners.running;
    }

    static void run(Node listener) {
        Home here = Home.current();
        if (here != null) {
            here.detachedListeners.runInTurn(listener);
            return;
        }
        DetachedListeners current = RUNNING.get();
        if (current != null) {
            current.runInTurn(listener);
            return;
        }
        current = new DetachedListeners();
        RUNNING.set(current);
        try {
            current.runInTurn(listener);
        } finally {
            RUNNING.remove();
        }
    }

    private void runInTurn(Node listener) {
        if (running) {
            waiting.add(listener);
            return;
        }
        running = true;
        try {
            for (Node each = listener; each != null; each = waiting.poll()) {
                runOne(each);
            }
        } finally {
            running = false;
        }
    }

    private static void runOne(Node listener) {
        try {
            listener.run();
        } catch (Throwable thrown) {
            listener.threw(thrown);
        }
    }
}
