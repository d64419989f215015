package io.troupe.actor.promise;

import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * The listeners of a pending promise that has more than a few. When their number has doubled, listeners that are no
 * longer needed are removed. So a long-lived promise keeps at most about twice as many as are needed.
 *
 * <p><b>Threads.</b> Guarded by its own monitor. <b>Cost.</b> Amortized constant time per listener.
 */
final class Listeners extends Node {
    private static final int FEW = 8;

    private final List<Node> nodes = new ArrayList<>(2 * FEW); // oldest first
    private int sweepAt = 2 * FEW;
    private boolean closed;

    /**
     * Takes over a linked list for which {@link #isMany} holds, and adds one listener. Does not change the links,
     * because another thread may be settling the list.
     */
    Listeners(@Nullable Node newest, Node more) {
        Node node = newest;
        for (int count = 0; count < FEW && node != null; count++) {
            nodes.addFirst(node);
            node = node.next;
        }
        nodes.add(more);
    }

    /** True if a linked list is long enough to be replaced by this class. */
    static boolean isMany(@Nullable Node newest) {
        Node node = newest;
        int count = 0;
        while (node != null && count < FEW) {
            node = node.next;
            count++;
        }
        return count == FEW;
    }

    /**
     * True if no listener of a short linked list (not {@link #isMany}) needs the outcome. The result is valid only if
     * the list was not settled meanwhile.
     */
    static boolean areGivenUp(Node newest) {
        Node node = newest;
        for (int count = 0;
                count < FEW && node != null;
                count++) { // bounded: the links of a list that is being settled may change
            if (!isGivenUp(node)) {
                return false;
            }
            node = node.next;
        }
        return true;
    }

    /** A thread whose wait timed out may wait again, so it does not count as gone. */
    private static boolean isGivenUp(Node listener) {
        return listener.isIdle() && !(listener instanceof Waiter);
    }

    /** True if no listener needs the outcome, or if the promise has been settled. */
    synchronized boolean areGivenUp() {
        return closed || nodes.stream().allMatch(Listeners::isGivenUp);
    }

    /** Adds a listener; false if the promise has been settled. */
    synchronized boolean add(Node listener) {
        if (closed) {
            return false;
        }
        while (!nodes.isEmpty() && nodes.getLast().isIdle()) {
            nodes.removeLast();
        }
        if (nodes.size() >= sweepAt) {
            nodes.removeIf(Node::isIdle);
            sweepAt = Math.max(2 * FEW, 2 * nodes.size());
        }
        nodes.add(listener);
        return true;
    }

    /** Links the listeners; returns the newest. */
    synchronized Node link() {
        Node newest = nodes.getFirst();
        newest.next = null;
        for (Node node : nodes.subList(1, nodes.size())) {
            node.next = newest;
            newest = node;
        }
        return newest;
    }

    synchronized boolean isClosed() {
        return closed;
    }

    /** Rejects further listeners. */
    synchronized void close() {
        closed = true;
    }

    @Override
    protected void run() {
        throw new IllegalStateException("a list of listeners is never run");
    }
}
