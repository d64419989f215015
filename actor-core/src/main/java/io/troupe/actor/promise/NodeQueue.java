package io.troupe.actor.promise;

import java.lang.invoke.MethodHandles;
import java.lang.invoke.VarHandle;
import org.jspecify.annotations.Nullable;

/**
 * An unbounded queue of nodes, from many threads to one.
 *
 * <p><b>Role.</b> A space's inbox; for the rooms of this library.
 * <p><b>Threads.</b> {@link #offer} from any thread; {@link #poll} and {@link #isEmpty} from one thread at a time.
 * What a thread did before {@code offer} is visible to the thread whose {@code poll} returns the node.
 * <p><b>Order.</b> First in, first out per offering thread; between threads, the order of their atomic exchanges.
 * <p><b>Cost.</b> One atomic exchange per offer, no allocation.
 */
public final class NodeQueue {
    /*
     * A linked queue whose links are the nodes themselves. The node returned last stays in the queue as its stub, so it must not be
     * linked into anything else while it is; its own link is cleared when the next one is taken, so that a kept node keeps nothing alive.
     */
    private static final VarHandle TAIL;
    private static final VarHandle NEXT;

    static {
        try {
            var lookup = MethodHandles.lookup();
            TAIL = lookup.findVarHandle(NodeQueue.class, "tail", Node.class);
            NEXT = lookup.findVarHandle(Node.class, "next", Node.class);
        } catch (ReflectiveOperationException e) {
            throw new ExceptionInInitializerError(e);
        }
    }

    private Node head;
    private volatile Node tail;

    public NodeQueue() {
        head = new Stub();
        tail = head;
    }

    /** Appends a node that is in no queue. The exchange orders it before whatever the caller reads next. */
    public void offer(Node node) {
        NEXT.setRelease(node, null);
        var before = (Node) TAIL.getAndSet(this, node);
        NEXT.setRelease(before, node);
    }

    /** Takes the oldest node, or null if there is none. */
    public @Nullable Node poll() {
        Node stub = head;
        var first = (Node) NEXT.getAcquire(stub);
        if (first == null) {
            if (stub == tail) {
                return null;
            }
            first = awaitLink(stub);
        }
        head = first;
        NEXT.setOpaque(stub, null);
        return first;
    }

    /** Whether nothing has been offered that was not taken. */
    public boolean isEmpty() {
        return head == tail;
    }

    /** An offer has exchanged the tail and is about to set the link. */
    private static Node awaitLink(Node stub) {
        while (true) {
            var next = (Node) NEXT.getAcquire(stub);
            if (next != null) {
                return next;
            }
            Thread.onSpinWait();
        }
    }

    private static final class Stub extends Node {
        @Override
        protected void run() {
            throw new IllegalStateException("a stub is never run");
        }
    }
}
