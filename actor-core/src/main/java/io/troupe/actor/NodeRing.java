package io.troupe.actor;

import io.troupe.actor.promise.Node;
import org.jspecify.annotations.Nullable;

/**
 * A first-in-first-out ring of nodes for one thread, that grows and shrinks.
 *
 * <p>Its array is replaced now and then even when it need not grow: storing a young node into an array that has grown old costs a fence under G1 (until JEP
 * 522, JDK 26), which is more than all the rest of queueing.
 */
final class NodeRing {
    private static final int SMALL = 256;
    private static final int RENEWAL = 1 << 13;

    private @Nullable Node[] entries = new Node[SMALL];
    private int head;
    private int size;
    private int added;

    void add(Node node) {
        if (size == entries.length || ++added > RENEWAL) {
            renew();
        }
        entries[(head + size++) & (entries.length - 1)] = node;
    }

    @Nullable
    Node poll() {
        if (size == 0) {
            return null;
        }
        Node node = entries[head];
        entries[head] = null;
        head = (head + 1) & (entries.length - 1);
        size--;
        return node;
    }

    boolean isEmpty() {
        return size == 0;
    }

    int size() {
        return size;
    }

    /** The node that is so many places behind the first one. */
    Node get(int index) {
        return java.util.Objects.requireNonNull(entries[(head + index) & (entries.length - 1)]);
    }

    private void renew() {
        added = 0;
        if (size == entries.length) {
            moveTo(new Node[entries.length * 2]);
        } else if (size < SMALL) {
            moveTo(new Node[SMALL]);
        }
    }

    private void moveTo(@Nullable Node[] fresh) {
        int first = Math.min(size, entries.length - head);
        System.arraycopy(entries, head, fresh, 0, first);
        System.arraycopy(entries, 0, fresh, first, size - first);
        entries = fresh;
        head = 0;
    }
}
