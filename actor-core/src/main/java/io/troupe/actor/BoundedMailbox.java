package io.troupe.actor;

import io.troupe.actor.promise.Home;
import io.troupe.actor.promise.Node;
import java.util.concurrent.ConcurrentLinkedDeque;
import java.util.concurrent.Semaphore;
import org.jspecify.annotations.Nullable;

/**
 * Keeps count of the calls that wait for one actor, and of their order if the oldest may be dropped.
 *
 * <p><b>Threads.</b> {@link #admit} from any thread, {@link #next} from the space's.
 *
 * <p>With {@code DROP_OLDEST} the calls wait here, and those in the space's queues are no more than tickets: a call that takes the place of the oldest one
 * is not queued itself, it will be served with the ticket of another. So there are never more tickets than places, however many calls are dropped.
 */
final class BoundedMailbox {
    enum Admission {
        /** To be queued in the space. */
        QUEUED,
        /** It waits; nothing is to be queued. */
        TAKEN_IN,
        /** There is no room. */
        REFUSED
    }

    private final MailboxBound bound;
    private final Semaphore room;
    private final @Nullable ConcurrentLinkedDeque<Node> calls;

    BoundedMailbox(MailboxBound bound) {
        this.bound = bound;
        this.room = new Semaphore(bound.capacity());
        this.calls = bound.overflow() == MailboxBound.Overflow.DROP_OLDEST ? new ConcurrentLinkedDeque<>() : null;
    }

    /** Makes room for a call, by waiting or by dropping another if that is the rule. */
    Admission admit(Node call, ActorCell cell) {
        if (calls != null) {
            return admitDropping(call, cell, calls);
        }
        if (!room.tryAcquire()) {
            if (bound.overflow() != MailboxBound.Overflow.BLOCK
                    || Home.current() != null
                    || cell.space().isCrankedByHand()) {
                return Admission.REFUSED;
            }
            room.acquireUninterruptibly();
        }
        return Admission.QUEUED;
    }

    private Admission admitDropping(Node call, ActorCell cell, ConcurrentLinkedDeque<Node> waiting) {
        while (!room.tryAcquire()) {
            waiting.addLast(call); // first in, then one out: a ticket must never find nothing
            Node oldest = waiting.pollFirst();
            if (oldest != call) {
                if (oldest != null) {
                    cell.drop(oldest, reason());
                }
                return Admission.TAKEN_IN;
            }
        } // all that waited has been served meanwhile: there is room now
        waiting.addLast(call);
        return Admission.QUEUED;
    }

    /** The call to be served with this ticket. */
    Node next(Node ticket) {
        Node call =
                calls == null ? ticket : java.util.Objects.requireNonNull(calls.pollFirst(), "a ticket without a call");
        room.release();
        return call;
    }

    /** How many calls wait. */
    int size() {
        return bound.capacity() - room.availablePermits();
    }

    String reason() {
        return "its mailbox is full (" + bound.capacity() + " calls, " + bound.overflow() + ")";
    }
}
