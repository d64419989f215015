package io.troupe.actor.promise;

import java.lang.invoke.MethodHandles;
import java.lang.invoke.VarHandle;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * Keeps the producers' end and the consumer's end of a queue on different cache lines: fields of a superclass come
 * first.
 */
@SuppressWarnings("unused")
abstract class QueuePadding {
    private long p00, p01, p02, p03, p04, p05, p06, p07, p08, p09, p10, p11, p12, p13, p14, p15;
}

/** Written by the consumer. */
abstract class QueueHead extends QueuePadding {
    Node head = new Stub();

    private static final class Stub extends Node {
        @Override
        protected void run() {
            throw new IllegalStateException("a stub is never run");
        }
    }
}

/** More of it. */
@SuppressWarnings("unused")
abstract class QueueHeadPadding extends QueueHead {
    private long q00, q01, q02, q03, q04, q05, q06, q07, q08, q09, q10, q11, q12, q13, q14, q15;
}

/** Written by producers. */
abstract class QueueTail extends QueueHeadPadding {
    volatile Node tail = head;
}

/**
 * An unbounded queue of nodes, from many threads to one.
 *
 * <p><b>Role.</b> A space's inbox; for the rooms of this library.
 *
 * <p><b>Threads.</b> {@link #offer} from any thread; {@link #poll}, {@link #isEmpty} and the batch methods from one
 * thread at a time. What a thread did before {@code offer} is visible to the thread that is given the node.
 *
 * <p><b>Order.</b> First in, first out per offering thread; between threads, the order of their atomic exchanges.
 *
 * <p><b>Cost.</b> One atomic exchange per offer, no allocation.
 *
 * @hidden
 */
@SuppressWarnings("unused")
public final class NodeQueue extends QueueTail {
    /*
     * A linked queue whose links are the nodes themselves. The node returned last stays in the queue as its stub, so it
     * must not be linked into anything else while it is; its own link is cleared when the next one is taken, so that a
     * kept node keeps nothing alive.
     */
    private static final VarHandle TAIL;
    private static final VarHandle NEXT;

    private final Node idleStub =
            head; // as it was at first: nothing offers it, and it is in use only while it is the head

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
     * Appends a node that is in no queue. The exchange orders it before whatever the caller reads next. If this throws,
     * at the end of the caller's stack, the node was not appended.
     */
    public void offer(Node node) {
        node.next = null;
        VarHandle.releaseFence(); // what the node holds is written before the link below
        var before = (Node) TAIL.getAndSet(this, node);
        before.next =
                node; // no call: between the exchange and this store the stack must not overflow, or the link were lost
    }

    /**
     * Takes the oldest node, or null if there is none, or if its offer has not quite returned; only {@link #isEmpty}
     * tells which.
     */
    public @Nullable Node poll() {
        if (!isReadyAfter(head)) {
            return null;
        }
        Node first = takeAfter(head);
        head = first;
        return first;
    }

    /** Whether nothing has been offered that was not taken. */
    public boolean isEmpty() {
        return head == tail;
    }

    /** The node that was offered last, or null if the queue is empty. */
    public @Nullable Node newest() {
        Node last = tail;
        return last == head ? null : last;
    }

    /** Whether {@link #poll} would answer a node; unlike {@link #isEmpty} it does not look where producers write. */
    public boolean isReady() {
        return NEXT.getAcquire(head) != null;
    }

    /** How many nodes wait; takes time in their number, and counts only those that were there when it was called. */
    public int size() {
        int size = 0;
        Node last = tail;
        for (Node node = head; node != null && node != last; node = (Node) NEXT.getAcquire(node)) {
            size++;
        }
        return size;
    }

    /**
     * How many nodes would be taken before this one, or -1 if it is not among the first so many. Takes time in the
     * limit.
     */
    public int indexOf(Node wanted, int limit) {
        var node = (Node) NEXT.getAcquire(head);
        for (int index = 0; node != null && index < limit; index++) {
            if (node == wanted) {
                return index;
            }
            node = (Node) NEXT.getAcquire(node);
        }
        return -1;
    }

    /** Whether more nodes than that wait. Takes time in the limit. */
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
     * Where a batch begins: the node taken last. A batch is {@link #takeAfter} again and again, each time after the
     * node it answered last, and {@link #endBatch} with that node; it saves a store for every node.
     */
    public Node beginBatch() {
        return head;
    }

    /** Whether there is a node behind the one taken last. */
    public boolean isReadyAfter(Node last) {
        return NEXT.getAcquire(last) != null;
    }

    /** Takes the node behind the one taken last; to be called if {@link #isReadyAfter} says that there is one. */
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

    /** Lets go of the node that was taken last, if nothing waits behind it; to be called when the consumer is idle. */
    public void forgetLast() {
        Node last = head;
        if (last != idleStub && last == tail && TAIL.compareAndSet(this, last, idleStub)) {
            head = idleStub; // whose link is empty: the node behind it was taken
        }
    }
}
