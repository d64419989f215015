package io.troupe.actor.internal.loop;

import java.util.ArrayDeque;

/** Runs the nodes without a home of one thread: one after the other, never nested. Used by that thread only. */
public final class DetachedNodes {
    private final ArrayDeque<Node> waiting = new ArrayDeque<>(4);
    private boolean running;

    /** Runs a node, and those that it adds; at once, or after the one that is running. */
    public void run(Node node) {
        if (running) {
            waiting.add(node);
            return;
        }
        running = true;
        try {
            for (Node each = node; each != null; each = waiting.poll()) {
                runOne(each);
            }
        } finally {
            running = false;
        }
    }

    private static void runOne(Node node) {
        try {
            node.run();
        } catch (Throwable thrown) {
            node.threw(thrown);
        }
    }
}
