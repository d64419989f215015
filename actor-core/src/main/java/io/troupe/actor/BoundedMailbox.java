package io.troupe.actor;

import io.troupe.actor.ActorSettings.Overflow;
import io.troupe.actor.internal.BoundedQueue;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.QueueEntries;
import io.troupe.actor.internal.loop.QueueEntry;
import java.util.Objects;
import java.util.concurrent.Semaphore;
import org.jspecify.annotations.Nullable;

/**
 * Counts the calls queued for one actor, and stores them in order if the oldest may be dropped.
 *
 * <p><b>Threads.</b> {@link #admit} from any thread, {@link #next} from the space's thread.
 *
 * <p>With {@code DROP_OLDEST} the calls are stored here, and the entries in the space's queues are only tickets. A call
 * that replaces the oldest one is not queued: it will be delivered for the ticket of another call. So there are never
 * more tickets than places, however many calls are dropped.
 */
final class BoundedMailbox {
    enum Admission {
        /** To be queued in the space. */
        QUEUED,
        /** Stored here; nothing is to be queued. */
        STORED,
        /** There is no room. */
        REJECTED,
        /** The caller was interrupted while waiting for room. */
        INTERRUPTED
    }

    private final int capacity;
    private final Overflow overflow;
    private final Semaphore room;
    private final @Nullable BoundedQueue<QueueEntry> calls; // guarded by itself

    BoundedMailbox(int capacity, Overflow overflow) {
        this.capacity = capacity;
        this.overflow = overflow;
        this.room = new Semaphore(capacity);
        this.calls = overflow == Overflow.DROP_OLDEST ? BoundedQueue.droppingOldest(capacity) : null;
    }

    /** Makes room for a call; depending on the overflow rule it waits, or drops another call. */
    Admission admit(QueueEntry call, ActorCell cell) {
        if (calls != null) {
            return admitDropping(call, cell, calls);
        }
        if (!room.tryAcquire()) {
            if (overflow != Overflow.BLOCK
                    || Home.current() != null
                    || cell.space().isThreadless()) {
                return Admission.REJECTED;
            }
            try {
                room.acquire();
            } catch (InterruptedException interrupted) {
                Thread.currentThread().interrupt();
                return Admission.INTERRUPTED;
            }
        }
        return Admission.QUEUED;
    }

    private Admission admitDropping(QueueEntry call, ActorCell cell, BoundedQueue<QueueEntry> waiting) {
        QueueEntry oldest;
        synchronized (waiting) {
            oldest = waiting.offer(call);
        }
        if (oldest == null) {
            return Admission.QUEUED;
        }
        cell.drop(oldest, reason());
        return Admission.STORED;
    }

    /** Takes the call that is to be delivered for this ticket. */
    QueueEntry next(QueueEntry ticket) {
        if (calls == null) {
            room.release();
            return ticket;
        }
        synchronized (calls) {
            return Objects.requireNonNull(calls.poll(), "a ticket without a call");
        }
    }

    /** Removes a call that was admitted but could not be queued. */
    void takeBack(QueueEntry call) {
        if (calls == null) {
            room.release();
            return;
        }
        synchronized (calls) {
            calls.removeLast(call);
        }
    }

    /** The call that would be delivered for this ticket. */
    QueueEntry peek(QueueEntry ticket) {
        if (calls == null) {
            return ticket;
        }
        synchronized (calls) {
            return Objects.requireNonNull(calls.peek(), "a ticket without a call");
        }
    }

    /** The number of calls stored here ahead of this one, or -1 if it is not among the first {@code limit}. */
    int placeOf(QueueEntry call, int limit) {
        if (calls == null) {
            return -1;
        }
        synchronized (calls) {
            return calls.placeOf(each -> QueueEntries.carries(each, call), limit);
        }
    }

    String reason() {
        return "its mailbox is full (" + capacity + " calls, " + overflow + ")";
    }
}
