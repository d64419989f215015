package io.troupe.player;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.player.wire.DataMessage;
import io.troupe.player.wire.DataSink;
import io.troupe.player.wire.Frame;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.List;
import java.util.Queue;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * What the server has sent and the client has not dispatched to its devices yet.
 *
 * <p><b>Threads.</b> Any thread. A tick counts as delivered only after all its messages are dispatched, and {@link #deliveredTick} is read before a
 * device is asked for news: whoever then finds none has seen everything up to that tick, so answering for it never answers for data unseen.
 */
final class Incoming implements DataSink {
    /** A message; the last of its frame says which tick it completes. */
    private record Arrival(DataMessage message, long completedTick) {}

    private static final long NO_TICK = -1;

    private final Object lock = new Object();
    private final Queue<Arrival> queue = new ArrayDeque<>();
    private final List<Deferred<@Nullable Void>> waiting = new ArrayList<>();
    private final Consumer<DataMessage> dispatcher;
    private final boolean dispatchAtOnce;
    private volatile long deliveredTick = NO_TICK;
    private @Nullable String lost;

    /**
     * @param dispatcher hands a message to its device
     * @param dispatchAtOnce true on an actor space, where frames arrive as a turn of their own
     */
    Incoming(Consumer<DataMessage> dispatcher, boolean dispatchAtOnce) {
        this.dispatcher = dispatcher;
        this.dispatchAtOnce = dispatchAtOnce;
    }

    @Override
    public void frame(Frame frame) {
        synchronized (lock) {
            var messages = frame.messages();
            for (int index = 0; index < messages.size(); index++) {
                queue.add(new Arrival(messages.get(index), index == messages.size() - 1 ? frame.tick() : NO_TICK));
            }
            lock.notifyAll();
        }
        if (dispatchAtOnce) {
            while (dispatchNext()) {
                // the whole frame is this turn's
            }
        }
    }

    @Override
    public void lost(String reason) {
        List<Deferred<@Nullable Void>> ended;
        synchronized (lock) {
            if (lost != null) {
                return;
            }
            lost = reason;
            ended = List.copyOf(waiting);
            waiting.clear();
            lock.notifyAll();
        }
        ended.forEach(each -> each.reject(new PlayerException(reason)));
    }

    /** The newest tick all of whose messages are with their devices. */
    long deliveredTick() {
        return deliveredTick;
    }

    /** Fulfilled with the next complete frame. */
    Promise<@Nullable Void> next() {
        var next = new Deferred<@Nullable Void>();
        synchronized (lock) {
            if (lost == null) {
                waiting.add(next);
                return next;
            }
        }
        next.reject(new PlayerException(lost));
        return next;
    }

    /** Dispatches the oldest message; false if there is none. */
    boolean dispatchNext() {
        Arrival arrival;
        synchronized (lock) {
            arrival = queue.poll();
        }
        if (arrival == null) {
            return false;
        }
        dispatcher.accept(arrival.message);
        if (arrival.completedTick != NO_TICK) {
            complete(arrival.completedTick);
        }
        return true;
    }

    boolean isEmpty() {
        synchronized (lock) {
            return queue.isEmpty();
        }
    }

    /**
     * Waits until a message is there or {@code goOn} is false.
     *
     * @throws PlayerException if the server has gone and nothing is left
     */
    void awaitMessage(java.util.function.BooleanSupplier goOn) {
        synchronized (lock) {
            while (queue.isEmpty() && goOn.getAsBoolean()) {
                throwIfLost();
                await(0);
            }
        }
    }

    /** Waits a little for a tick after that one. */
    void awaitTickAfter(long tick, long millis) {
        synchronized (lock) {
            throwIfLost();
            if (deliveredTick == tick) {
                await(millis);
            }
        }
    }

    /** Lets whoever waits look again. */
    void wakeAll() {
        synchronized (lock) {
            lock.notifyAll();
        }
    }

    private void complete(long tick) {
        List<Deferred<@Nullable Void>> ready;
        synchronized (lock) {
            deliveredTick = tick;
            ready = List.copyOf(waiting);
            waiting.clear();
            lock.notifyAll();
        }
        ready.forEach(each -> each.resolve(null));
    }

    private void throwIfLost() {
        if (lost != null) {
            throw new PlayerException(lost);
        }
    }

    private void await(long millis) {
        try {
            lock.wait(millis);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new PlayerException("interrupted while waiting for the Player server", e);
        }
    }
}
