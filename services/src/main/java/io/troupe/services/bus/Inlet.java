package io.troupe.services.bus;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.promise.Promise;
import java.util.ArrayDeque;
import java.util.List;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * The messages that wait before one subscriber or one answerer, and their way to its space.
 *
 * <p><b>Threads.</b> Any thread offers and ends; {@link #handle} runs on the space, on behalf of the actor, that made
 * the inlet. <b>Order.</b> First in, first out.
 */
abstract class Inlet {
    private static final int BATCH = 8; // so few that a space's other callbacks, and its mails, have their turns

    final BusNode node;
    final Port port;
    private final int capacity;
    private final ActorSpace space;
    private final io.troupe.actor.Topic<Inlet> door; // brings a signal to the space; tells when the actor is gone
    private final ArrayDeque<Message> waiting = new ArrayDeque<>(); // guarded by this
    private boolean signalled; // guarded by this: the space is going to look
    private volatile @Nullable String ended; // written under this: why
    private volatile @Nullable Promise<@Nullable Void> watch;

    Inlet(Port port, String name) {
        this.port = port;
        this.node = port.node;
        this.capacity = node.settings.capacity();
        ActorSpace here = ActorSpace.current();
        this.space = here == null ? node.settings.space() : here;
        this.door = io.troupe.actor.Topic.of(space, name);
    }

    /** Begins to hear; not in the constructor, because other threads learn of this inlet here. */
    final void open() {
        door.subscribe(new Signal());
        Promise<@Nullable Void> closed = space.whenClosed();
        watch = closed;
        closed.toCompletableFuture().thenRun(() -> end("space " + space + " was closed"));
    }

    /** Deals with one message, on the space. */
    abstract void handle(Message message);

    /** There are as many as may wait: says which of both goes, and deals with that one outside the lock. */
    abstract boolean dropsOldest();

    abstract void overflow(Message message);

    /** It has ended with these waiting; called once. */
    abstract void leftOver(List<Message> rest, String why);

    /**
     * Queues a message.
     *
     * @return null, or why it will not be heard here
     */
    final @Nullable String offer(Message message) {
        Message tooMany = null;
        boolean signal;
        synchronized (this) {
            if (ended != null) {
                return ended;
            }
            if (waiting.size() >= capacity) {
                tooMany = dropsOldest() ? waiting.remove() : message;
            }
            if (tooMany != message) {
                waiting.add(message);
                accepted();
            }
            signal = !signalled;
            signalled = true;
        }
        if (signal) { // first: what follows may throw
            signal();
        } else {
            isOver(); // the actor may have stopped with the signal on its way, and would never look
        }
        if (tooMany != null) {
            overflow(tooMany);
        }
        return null;
    }

    /** A message is in the queue; under the lock. */
    void accepted() {}

    private void signal() {
        if (door.publish(this) == 0) {
            end("the actor that listened has stopped");
        }
    }

    private void drain() {
        for (int count = 0; count < BATCH; count++) {
            Message next;
            synchronized (this) {
                next = waiting.poll();
                if (next == null) {
                    signalled = false;
                    return;
                }
            }
            handleOne(next);
        }
        signal();
    }

    /** What it throws is reported by the space, and the others have their turn. */
    private void handleOne(Message next) {
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

    /** Whether nothing will be heard here any more. */
    final boolean isOver() {
        if (ended == null && door.subscribers() == 0) {
            end("the actor that listened has stopped");
        }
        return ended != null;
    }

    final @Nullable String whyEnded() {
        return ended;
    }

    /** Ends it; what waits is lost. */
    final void end(String why) {
        List<Message> rest;
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
        leftOver(rest, why);
    }

    private final class Signal implements Callback<Inlet> {
        @Override
        public void accept(@Nullable Inlet inlet, @Nullable Throwable error) {
            Objects.requireNonNull(inlet).drain();
        }

        @Override
        public boolean isCancelled() {
            return ended != null;
        }
    }
}
