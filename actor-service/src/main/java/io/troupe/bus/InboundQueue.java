package io.troupe.bus;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import io.troupe.actor.Topic;
import io.troupe.actor.internal.CancellationFlag;
import java.util.ArrayDeque;
import java.util.List;
import java.util.Objects;
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
    private final int capacity;
    private final ActorSpace space;
    private final Topic<InboundQueue> wakeUps; // wakes the space; shows whether the actor still exists
    private final ArrayDeque<MessageDelivery> waiting = new ArrayDeque<>(); // guarded by this
    private boolean signalled; // guarded by this: a drain is scheduled on the space
    private volatile @Nullable String ended; // the reason; written under this
    private volatile @Nullable Promise<@Nullable Void> watch;

    InboundQueue(BusPort port, String name, int capacity) {
        this.port = port;
        this.node = port.node;
        this.capacity = capacity;
        ActorSpace here = ActorSpace.current();
        this.space = here == null ? node.settings.space() : here;
        this.wakeUps = Topic.of(space, name);
    }

    /** Starts delivery. Not in the constructor, because this publishes the queue to other threads. */
    final void open() {
        wakeUps.subscribe(new Signal());
        Promise<@Nullable Void> closed = space.whenClosed();
        watch = closed;
        closed.toCompletableFuture().thenRun(() -> end("space " + space + " was closed"));
    }

    /** Handles one message, on the space. */
    abstract void handle(MessageDelivery delivery);

    /**
     * Overflow policy: true to drop the oldest message, false to reject the newest. {@link #overflow} handles that
     * message, outside the lock.
     */
    abstract boolean dropsOldest();

    abstract void overflow(MessageDelivery delivery);

    /** Called once, with the messages still queued at the end. */
    abstract void discard(List<MessageDelivery> rest, String why);

    /**
     * Queues a message.
     *
     * @return null, or the reason why this queue has ended
     */
    final @Nullable String offer(MessageDelivery delivery) {
        MessageDelivery tooMany = null;
        boolean signal;
        synchronized (this) {
            if (ended != null) {
                return ended;
            }
            if (waiting.size() >= capacity) {
                tooMany = dropsOldest() ? waiting.remove() : delivery;
            }
            if (tooMany != delivery) {
                waiting.add(delivery);
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
        if (wakeUps.publish(this) == 0) {
            end("the actor that listened has stopped");
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
        if (ended == null && wakeUps.subscribers() == 0) {
            end("the actor that listened has stopped");
        }
        return ended != null;
    }

    final @Nullable String whyEnded() {
        return ended;
    }

    /** Ends delivery; the messages still queued are passed to {@link #discard}. */
    final void end(String why) {
        List<MessageDelivery> rest;
        synchronized (this) {
            if (ended != null) {
                return;
            }
            ended = why;
            rest = List.copyOf(waiting);
            waiting.clear();
        }
        Promise<?> watching = watch;
        if (watching != null) {
            watching.cancel();
        }
        port.forget(this);
        discard(rest, why);
    }

    private final class Signal implements Callback<InboundQueue>, CancellationFlag {
        @Override
        public void accept(@Nullable InboundQueue queue, @Nullable Throwable error) {
            Objects.requireNonNull(queue).drain();
        }

        @Override
        public boolean isCancelled() {
            return ended != null;
        }
    }
}
