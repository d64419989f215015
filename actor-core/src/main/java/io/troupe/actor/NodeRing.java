package io.troupe.actor;

import io.troupe.actor.internal.loop.Node;
import io.troupe.actor.internal.loop.NodeQueue;
import java.lang.invoke.MethodHandles;
import java.lang.invoke.VarHandle;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/** A first-in-first-out ring of nodes for one thread. It grows on demand, and shrinks when it is renewed. */
final class NodeRing {
    private static final int SMALL = 256;
    private static final VarHandle HEAD;

    static {
        try {
            HEAD = MethodHandles.lookup().findVarHandle(NodeRing.class, "head", long.class);
        } catch (ReflectiveOperationException e) {
            throw new ExceptionInInitializerError(e);
        }
    }

    private final @Nullable NodeQueue overflow;
    private @Nullable Node[] entries = new Node[SMALL];
    private long head; // both only increase; the low bits are the index
    private long tail;
    private long end;
    private long limit = SMALL - 1; // the tail from which on there may be no room; less than the head and the length

    /** A ring that throws an {@link OutOfMemoryError} where there is no memory to grow: nothing was added. */
    NodeRing() {
        this(null);
    }

    /**
     * A ring that grows on demand.
     *
     * @param overflow gets the nodes for which there is no memory to grow; read by the same thread, which adds to the
     *     ring what it finds there
     */
    NodeRing(@Nullable NodeQueue overflow) {
        this.overflow = overflow;
    }

    void add(Node node) {
        long place = tail;
        if (place >= limit && !makesRoomFor(node)) {
            return;
        }
        @Nullable Node[] places = entries;
        places[indexOf(place, places)] = node;
        tail = place + 1;
    }

    /** Makes room for a node; if there is no memory for that, the node goes to where it needs none, or this throws. */
    private boolean makesRoomFor(Node node) {
        try {
            makeRoom();
            return true;
        } catch (OutOfMemoryError full) {
            if (overflow == null) {
                throw full;
            }
            overflow.offer(node);
            return false;
        }
    }

    /** Like {@link #makeRoom}; false if there is no memory for it. */
    boolean hasRoom() {
        try {
            makeRoom();
            return true;
        } catch (OutOfMemoryError full) {
            return false;
        }
    }

    /** Ensures that the next {@link #add} does not allocate. */
    void makeRoom() {
        if (tail - head >= entries.length - 1) { // one place is for the node that is kept
            moveTo(new Node[entries.length * 2]);
        }
        limit = head + entries.length - 1;
    }

    @Nullable
    Node poll() {
        long place = head;
        if (place == tail) {
            return null;
        }
        @Nullable Node[] places = entries;
        int index = indexOf(place, places);
        Node node = places[index];
        places[index] = null;
        HEAD.setOpaque(this, place + 1);
        return node;
    }

    /** Like {@link #poll}, but the node remains the one that is {@link #kept} until the next call. */
    @Nullable
    Node pollAndKeep() {
        long place = head;
        return place == tail ? null : takeAndKeep(place);
    }

    /** Like {@link #pollAndKeep}, but returns null also after as many nodes as {@link #allow} has set. */
    @Nullable
    Node pollAllowed() {
        long place = head;
        return place == tail || place >= end ? null : takeAndKeep(place);
    }

    private @Nullable Node takeAndKeep(long place) {
        @Nullable Node[] places = entries;
        places[indexOf(place - 1, places)] = null;
        Node node = places[indexOf(place, places)];
        HEAD.setOpaque(this, place + 1);
        return node;
    }

    /** Lets {@link #pollAllowed} return so many nodes. */
    void allow(int nodes) {
        end = head + nodes;
    }

    /** The node that {@link #pollAndKeep} has returned last, or null. */
    @Nullable
    Node kept() {
        return entries[indexOf(head - 1, entries)];
    }

    void forgetKept() {
        entries[indexOf(head - 1, entries)] = null;
    }

    boolean isEmpty() {
        return head == tail;
    }

    int size() {
        return (int) (tail - head);
    }

    /** The number of nodes taken since the ring was created; from any thread, slightly delayed. */
    long taken() {
        return (long) HEAD.getOpaque(this);
    }

    /** The number of nodes added since the ring was created. */
    long added() {
        return tail;
    }

    private static int indexOf(long place, @Nullable Node[] places) {
        return (int) place & (places.length - 1);
    }

    /** The node at this index, counted from the first one. */
    Node get(int index) {
        return Objects.requireNonNull(entries[indexOf(head + index, entries)]);
    }

    /**
     * Replaces the array if the ring holds few nodes. Called periodically: storing a reference to a young node into an
     * array of the old generation costs a fence under G1 (until JEP 522, JDK 26), which is more than the rest of
     * queueing.
     */
    void renew() {
        if (size() < SMALL - 1) {
            moveTo(new Node[SMALL]);
        }
    }

    private void moveTo(@Nullable Node[] fresh) {
        for (long place = head - 1; place < tail; place++) { // with the node that is kept
            fresh[indexOf(place, fresh)] = entries[indexOf(place, entries)];
        }
        entries = fresh;
        limit = head + fresh.length - 1;
    }
}
