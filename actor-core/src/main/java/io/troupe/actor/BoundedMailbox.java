package io.troupe.actor;

import io.troupe.actor.promise.Home;
import io.troupe.actor.promise.Node;
import java.util.concurrent.ConcurrentLinkedDeque;
import java.util.concurrent.Semaphore;

/**
 * Keeps count of the calls that wait for one actor.
 *
 * <p><b>Threads.</b> {@link #admit} from any thread, {@link #leave} from the space's. A call is in the deque from before it is queued until it is delivered
 * or dropped; whoever removes it from there, once, gives its permit back.
 */
final class BoundedMailbox {
    private final MailboxBound bound;
    private final Semaphore room;
    private final ConcurrentLinkedDeque<Node> waiting = new ConcurrentLinkedDeque<>();

    BoundedMailbox(MailboxBound bound) {
        this.bound = bound;
        this.room = new Semaphore(bound.capacity());
    }

    /** Makes room for a call, by waiting or by dropping another if that is the rule; false if there is none. */
    boolean admit(Node call, ActorCell cell) {
        while (!room.tryAcquire()) {
            switch (bound.overflow()) {
                case REJECT -> {
                    return false;
                }
                case BLOCK -> {
                    if (Home.current() != null || cell.space().isCrankedByHand()) {
                        return false;
                    }
                    room.acquireUninterruptibly();
                    waiting.addLast(call);
                    return true;
                }
                case DROP_OLDEST -> {
                    Node oldest = waiting.pollFirst();
                    if (oldest != null) {
                        room.release();
                        cell.drop(oldest, reason());
                    } else {
                        Thread.onSpinWait(); // another sender has the permit and is about to add its call
                    }
                }
            }
        }
        waiting.addLast(call);
        return true;
    }

    /** A call is about to be delivered; false if it has been dropped before. */
    boolean leave(Node call) {
        boolean waited = waiting.removeFirstOccurrence(call);
        if (waited) {
            room.release();
        }
        return waited;
    }

    String reason() {
        return "its mailbox is full (" + bound.capacity() + " calls, " + bound.overflow() + ")";
    }
}
