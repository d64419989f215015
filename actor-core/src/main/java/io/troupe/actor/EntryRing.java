package io.troupe.actor;

import io.troupe.actor.internal.loop.EntryQueue;
import io.troupe.actor.internal.loop.QueueEntry;
import java.lang.invoke.MethodHandles;
import java.lang.invoke.VarHandle;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/** A first-in-first-out ring of entries for one thread. It grows on demand, and shrinks when it is renewed. */
final class EntryRing {
    private static final int SMALL = 256;
    private static final VarHandle HEAD;

    static {
        try {
            HEAD = MethodHandles.lookup().findVarHandle(EntryRing.class, "head", long.class);
        } catch (ReflectiveOperationException e) {
            throw new ExceptionInInitializerError(e);
        }
    }

    private final @Nullable EntryQueue overflow;
    private @Nullable QueueEntry[] entries = new QueueEntry[SMALL];
    private long head; // both only increase; the low bits are the index
    private long tail;
    private long end;
    private long limit = SMALL - 1; // the tail from which on there may be no room; less than the head and the length

    /** A ring that throws an {@link OutOfMemoryError} where there is no memory to grow: nothing was added. */
    EntryRing() {
        this(null);
    }

    /**
     * A ring that grows on demand.
     *
     * @param overflow gets the entries for which there is no memory to grow; read by the same thread, which adds to the
     *     ring what it finds there
     */
    EntryRing(@Nullable EntryQueue overflow) {
        this.overflow = overflow;
    }

    void add(QueueEntry node) {
        long place = tail;
        if (place >= limit && !makesRoomFor(node)) {
            return;
        }
        @Nullable QueueEntry[] places = entries;
        places[indexOf(place, places)] = node;
        tail = place + 1;
    }

    /**
     * Makes room for an entry; if there is no memory for that, the entry goes to where it needs none, or this throws.
     */
    private boolean makesRoomFor(QueueEntry node) {
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
        if (tail - head >= entries.length - 1) { // one place is for the entry that is kept
            moveTo(new QueueEntry[entries.length * 2]);
        }
        limit = head + entries.length - 1;
    }

    @Nullable
    QueueEntry poll() {
        long place = head;
        if (place == tail) {
            return null;
        }
        @Nullable QueueEntry[] places = entries;
        int index = indexOf(place, places);
        QueueEntry node = places[index];
        places[index] = null;
        HEAD.setOpaque(this, place + 1);
        return node;
    }

    /** Like {@link #poll}, but the entry remains the one that is {@link #kept} until the next call. */
    @Nullable
    QueueEntry pollAndKeep() {
        long place = head;
        return place == tail ? null : takeAndKeep(place);
    }

    /** Like {@link #pollAndKeep}, but returns null also after as many entries as {@link #allow} has set. */
    @Nullable
    QueueEntry pollAllowed() {
        long place = head;
        return place == tail || place >= end ? null : takeAndKeep(place);
    }

    private @Nullable QueueEntry takeAndKeep(long place) {
        @Nullable QueueEntry[] places = entries;
        places[indexOf(place - 1, places)] = null;
        QueueEntry node = places[indexOf(place, places)];
        HEAD.setOpaque(this, place + 1);
        return node;
    }

    /** Lets {@link #pollAllowed} return so many entries. */
    void allow(int nodes) {
        end = head + nodes;
    }

    /** The entry that {@link #pollAndKeep} has returned last, or null. */
    @Nullable
    QueueEntry kept() {
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

    /** The number of entries taken since the ring was created; from any thread, slightly delayed. */
    long taken() {
        return (long) HEAD.getOpaque(this);
    }

    /** The number of entries added since the ring was created. */
    long added() {
        return tail;
    }

    private static int indexOf(long place, @Nullable QueueEntry[] places) {
        return (int) place & (places.length - 1);
    }

    /** The entry at this index, counted from the first one. */
    QueueEntry get(int index) {
        return Objects.requireNonNull(entries[indexOf(head + index, entries)]);
    }

    /**
     * Replaces the array if the ring holds few entries. Called periodically: storing a reference to a young entry into
     * an array of the old generation costs a fence under G1 (until JEP 522, JDK 26), which is more than the rest of
     * queueing.
     */
    void renew() {
        if (size() < SMALL - 1) {
            moveTo(new QueueEntry[SMALL]);
        }
    }

    private void moveTo(@Nullable QueueEntry[] fresh) {
        for (long place = head - 1; place < tail; place++) { // with the entry that is kept
            fresh[indexOf(place, fresh)] = entries[indexOf(place, entries)];
        }
        entries = fresh;
        limit = head + fresh.length - 1;
    }
}
