package io.troupe.actor;

import io.troupe.actor.promise.Node;
import org.jspecify.annotations.Nullable;

/** A growing first-in-first-out ring of nodes for one thread. */
final class NodeRing {
    private @Nullable Node[] entries = new Node[256];
    private int head;
    private int size;

    void add(Node node) {
        if (size == entries.length) {
            grow();
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

    private void grow() {
        var larger = new Node[entries.length * 2];
        int first = entries.length - head;
        System.arraycopy(entries, head, larger, 0, first);
        System.arraycopy(entries, 0, larger, first, head);
        entries = larger;
        head = 0;
    }
}
