package io.troupe.actor.internal.loop;

import java.lang.invoke.MethodHandles;
import java.lang.invoke.VarHandle;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * Padding that keeps the producers' end and the consumer's end of a queue on different cache lines: superclass fields
 * are laid out first.
 */
@SuppressWarnings("unused")
abstract class QueuePadding {
    private long p00, p01, p02, p03, p04, p05, p06, p07, p08, p09, p10, p11, p12, p13, p14, p15;
}

/** The field written by the consumer. */
abstract class QueueHead extends QueuePadding {
    Node head = new Stub();

    private static final class Stub extends Node {}
}

/** Padding between the consumer's field and the producers' field. */
@SuppressWarnings("unused")
abstract class QueueHeadPadding extends QueueHead {
    private long q00, q01, q02, q03, q04, q05, q06, q07, q08, q09, q10, q11, q12, q13, q14, q15;
}

/** The field written by producers. */
abstract class QueueTail extends QueueHeadPadding {
    volatile Node tail = head;
}

/**
 * An unbounded queue of nodes, from many threads to one.
 *
 * <p><b>Role.</b> A space's inbox. Internal to this library.
 *
 * <p><b>Threads.</b> {@link #offer} from any thread; {@link #poll}, {@link #isEmpty} and the batch methods from one
 * thread at a time. What a thread did before {@code offer} is visible to the thread that takes the node.
 *
 * <p><b>Order.</b> First in, first out per offering thread; between threads, the order of their atomic exchanges.
 *
 * <p><b>Cost.</b> One atomic exchange per offer, no allocation.
 */
@SuppressWarnings("unused")
public final class NodeQueue extends QueueTail {
    /*
     * A linked queue whose links are the nodes themselves. The node returned last stays in the queue as its stub, and
     * must not be linked into anything else meanwhile. Its own link is cleared when the next node is taken, so that a
     * retained node retains no other.
     */
    private static final VarHandle TAIL;
    private static final VarHandle NEXT;

    private final Node idleStub = head; // the first stub: never offered, and used only while it is the head

    private long r00, r01, r02, r03, r04, r05, r06, r07, r08, r09, r10, r11, r12, r13, r14, r15;

    static {
        try {
            var lookup = MethodHandles.lookup();
            TAIL = lookup.findVarHandle(QueueTail.class, "tail", Node.class);
            NEXT = lookup.findVarHandle(Node.class, "next", Node.class);
        } catch (ReflectiveOperationException e) {
            throw new ExceptionInInitializerError(e);
        }
    }

    /**
     * Appends a node that is in no queue. The atomic exchange is ordered before the caller's next read. If this throws
     * (a stack overflow), the node was not appended.
     */
    public void offer(Node node) {
        node.next = null;
        VarHandle.releaseFence(); // publishes the node's fields before the link below
        var before = (Node) TAIL.getAndSet(this, node);
        before.next = node; // no call here: a stack overflow between the exchange and this store would lose the link
    }

    /**
     * Takes the oldest node. Returns null if there is none, or if its offer has not yet completed; {@link #isEmpty}
     * distinguishes the two cases.
     */
    public @Nullable Node poll() {
        if (!isReadyAfter(head)) {
            return null;
        }
        Node first = takeAfter(head);
        head = first;
        return first;
    }

    /** True if every node that was offered has been taken. */
    public boolean isEmpty() {
        return head == tail;
    }

    /** The node that was offered last, or null if the queue is empty. */
    public @Nullable Node newest() {
        Node last = tail;
        return last == head ? null : last;
    }

    /**
     * True if {@link #poll} would return a node; unlike {@link #isEmpty} it does not read the producers' cache line.
     */
    public boolean isReady() {
        return NEXT.getAcquire(head) != null;
    }

    /** The number of queued nodes, without those offered during the call. Takes time proportional to the number. */
    public int size() {
        int size = 0;
        Node last = tail;
        for (Node node = head; node != null && node != last; node = (Node) NEXT.getAcquire(node)) {
            size++;
        }
        return size;
    }

    /**
     * The number of nodes ahead of this one, or -1 if it is not among the first {@code limit}. Takes time proportional
     * to the limit.
     */
    public int indexOf(Node wanted, int limit) {
        var node = (Node) NEXT.getAcquire(head);
        for (int index = 0; node != null && index < limit; index++) {
            if (node.carries(wanted)) {
                return index;
            }
            node = (Node) NEXT.getAcquire(node);
        }
        return -1;
    }

    /** True if more than {@code limit} nodes are queued. Takes time proportional to the limit. */
    public boolean isLongerThan(int limit) {
        int size = 0;
        for (var node = (Node) NEXT.getAcquire(head); node != null; node = (Node) NEXT.getAcquire(node)) {
            if (++size > limit) {
                return true;
            }
        }
        return false;
    }

    /**
     * Begins a batch and returns the node taken last. A batch is a sequence of {@link #takeAfter} calls, each with the
     * node that the call before returned, and one {@link #endBatch} with the last of them. It saves one store per node.
     */
    public Node beginBatch() {
        return head;
    }

    /** True if there is a node behind the one taken last. */
    public boolean isReadyAfter(Node last) {
        return NEXT.getAcquire(last) != null;
    }

    /** Takes the node behind the one taken last; requires {@link #isReadyAfter}. */
    public Node takeAfter(Node last) {
        Node first = Objects.requireNonNull(last.next);
        last.next = null;
        return first;
    }

    public void endBatch(Node last) {
        if (head != last) {
            head = last;
        }
    }

    /** Releases the node that was taken last, if the queue is empty; called when the consumer is idle. */
    public void forgetLast() {
        Node last = head;
        if (last != idleStub && last == tail && TAIL.compareAndSet(this, last, idleStub)) {
            head = idleStub; // its link is null: the node behind it was taken
        }
    }
}
