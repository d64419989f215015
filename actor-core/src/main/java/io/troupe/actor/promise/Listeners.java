package io.troupe.actor.promise;

import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * The listeners of a pending promise that has more than a few. Listeners that have given up are dropped whenever the
 * number has doubled, so that a promise that lives long keeps at most about as many of them as there are others.
 *
 * <p><b>Threads.</b> Guarded by itself. <b>Cost.</b> Constant time for each listener, averaged over many.
 */
final class Listeners extends Node {
    private static final int FEW = 8;

    private final List<Node> nodes = new ArrayList<>(2 * FEW); // oldest first
    private int sweepAt = 2 * FEW;
    private boolean closed;

    /**
     * Takes over a linked list that {@link #isMany}, and one more. Changes no link, for the list may be settled by
     * another thread meanwhile.
     */
    Listeners(@Nullable Node newest, Node more) {
        Node node = newest;
        for (int count = 0; count < FEW && node != null; count++) {
            nodes.addFirst(node);
            node = node.next;
        }
        nodes.add(more);
    }

    /** Whether a linked list is so long that listeners should be counted. */
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
     * Whether no listener of a linked list that is not yet {@link #isMany} needs the outcome; of use only if the list
     * was not settled meanwhile.
     */
    static boolean areGivenUp(Node newest) {
        Node node = newest;
        for (int count = 0; count < FEW && node != null; count++) { // a list that is being settled may lead elsewhere
            if (!isGivenUp(node)) {
                return false;
            }
            node = node.next;
        }
        return true;
    }

    /** A thread whose wait is over may wait again. */
    private static boolean isGivenUp(Node listener) {
        return listener.isIdle() && !(listener instanceof Waiter);
    }

    /** Whether no listener needs the outcome, or the promise has been settled. */
    synchronized boolean areGivenUp() {
        return closed || nodes.stream().allMatch(Listeners::isGivenUp);
    }

    /** False if the promise has been settled. */
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

    /** Links the listeners; answers the newest. */
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

    /** Takes no more listeners. */
    synchronized void close() {
        closed = true;
    }

    @Override
    protected void run() {
        throw new IllegalStateException("a list of listeners is never run");
    }
}
