package io.troupe.bus;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.LibraryAccess;
import io.troupe.actor.Promise;
import io.troupe.actor.internal.BoundedQueue;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.OwnerTask;
import io.troupe.actor.internal.loop.TurnOwner;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * The queue of messages to one subscriber or one request handler, and their delivery on its space.
 *
 * <p><b>Threads.</b> Any thread calls {@link #offer} and {@link #end}; {@link #handle} runs on the space, and on behalf
 * of the actor, that created the queue. <b>Order.</b> First in, first out.
 */
abstract class InboundQueue {
    private static final int BATCH = 8; // small, to limit the delay of the space's other callbacks and messages

    final Bus node;
    final BusPort port;
    private final ActorSpace space;
    private final TurnOwner owner; // the actor that created the queue, or its space
    private final BoundedQueue<MessageDelivery> waiting; // guarded by this
    private boolean signalled; // guarded by this: a drain is scheduled on the space
    private volatile @Nullable String ended; // the reason; written under this
    private volatile @Nullable Promise<@Nullable Void> watch;

    InboundQueue(BusPort port, BoundedQueue<MessageDelivery> waiting) {
        this.port = port;
        this.node = port.node;
        this.waiting = waiting;
        ActorSpace here = ActorSpace.current();
        this.space = here == null ? node.settings.space() : here;
        Home home = LibraryAccess.home(space);
        this.owner = here == null ? home.itself() : home.owner();
    }

    /** Starts delivery. Not in the constructor, because this publishes the queue to other threads. */
    final void open() {
        Promise<@Nullable Void> closed = space.whenClosed();
        watch = closed;
        closed.toCompletableFuture().thenRun(() -> end("space " + space + " was closed"));
    }

    /** Handles one message, on the space. */
    abstract void handle(MessageDelivery delivery);

    /** Handles the message for which there was no room; not under the lock. */
    abstract void overflow(MessageDelivery delivery);

    /** Called once, with the messages still queued at the end. */
    abstract void dropAtEnd(List<MessageDelivery> rest, String why);

    /**
     * Queues a message.
     *
     * @return null, or the reason why this queue has ended
     */
    final @Nullable String offer(MessageDelivery delivery) {
        MessageDelivery tooMany;
        boolean signal;
        synchronized (this) {
            if (ended != null) {
                return ended;
            }
            tooMany = waiting.offer(delivery);
            if (tooMany != delivery) {
                accepted();
            }
            signal = !signalled;
            signalled = true;
        }
        if (signal) { // before overflow(), which may throw
            signal();
        } else {
            hasEnded(); // the actor may have stopped before the scheduled drain, which then never runs
        }
        if (tooMany != null) {
            overflow(tooMany);
        }
        return null;
    }

    /** Removes a queued message; false if it is not queued. */
    final boolean remove(MessageDelivery.RequestId request) {
        synchronized (this) {
            return waiting.removeIf(each -> each.id().equals(request));
        }
    }

    /** Called under the lock when a message has been queued. */
    void accepted() {}

    /** Called under the lock when a message has been removed from the queue, before it is handled. */
    void taken(MessageDelivery delivery) {}

    private void signal() {
        if (!hasEnded()) {
            OwnerTask.enqueue(owner, this::drain);
        }
    }

    private void drain() {
        for (int count = 0; count < BATCH; count++) {
            MessageDelivery next;
            synchronized (this) {
                next = waiting.poll();
                if (next == null) {
                    signalled = false;
                    return;
                }
                taken(next);
            }
            handleOne(next);
        }
        signal();
    }

    /** If it throws, the space reports the exception, and the remaining messages are still delivered. */
    private void handleOne(MessageDelivery next) {
        boolean returned = false;
        try {
            handle(next);
            returned = true;
        } finally {
            if (!returned) {
                signal();
            }
        }
    }

    /** Returns whether delivery has ended, also because the actor has stopped. */
    final boolean hasEnded() {
        if (ended == null && owner.isOver()) {
            end("the actor that listened has stopped");
        }
        return ended != null;
    }

    final @Nullable String whyEnded() {
        return ended;
    }

    /** Ends delivery; the messages still queued are passed to {@link #dropAtEnd}. */
    final void end(String why) {
        List<MessageDelivery> rest;
        synchronized (this) {
            if (ended != null) {
                return;
            }
            ended = why;
            rest = waiting.drain();
        }
        Promise<?> watching = watch;
        if (watching != null) {
            watching.cancel();
        }
        port.forget(this);
        dropAtEnd(rest, why);
    }
}
