package io.troupe.broker;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.internal.BoundedQueue;
import io.troupe.actor.internal.CancellationFlag;
import io.troupe.bus.Address;
import io.troupe.bus.BusPort;
import io.troupe.bus.internal.BoundedText;
import io.troupe.bus.internal.CborItem;
import java.lang.reflect.Type;
import java.time.Duration;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * A callback whose reader is in another process, as an actor calls it: sends each result to the caller's port.
 *
 * <p><b>Threads.</b> Any thread. <b>Order.</b> Parts leave in the order of their numbers, under the lock.
 *
 * <p><b>Errors.</b> At most {@link #MOST_UNANSWERED} items are without an answer of the reader, and at most
 * {@link #CAPACITY} more are kept here; one more ends the stream with an error on both sides. So does an item that
 * cannot be encoded. A reader that has cancelled, is gone or does not answer ends it here, so that the actor sees
 * {@link #isCancelled}. The end is sent again until the reader has confirmed it, because a reader that has not got it
 * would wait for ever.
 */
final class OutgoingStream implements Callback<@Nullable Object>, CancellationFlag {
    static final int MOST_UNANSWERED = 256;
    static final int CAPACITY = 1_024;
    private static final Duration LIMIT = Duration.ofSeconds(10); // of the answer to an item
    private static final Duration END_LIMIT =
            Duration.ofSeconds(1); // of the answer to the end, and between two of them
    private static final int MOST_ENDS = 15; // for longer than the offers of a silent process count

    private final ActorSpace space;
    private final BusPort port;
    private final Address reader;
    private final long stream;
    private final Type type;
    private final CallableMethods.Values values;
    private final BoundedQueue<CborItem> buffered =
            BoundedQueue.rejecting(CAPACITY); // guarded by this, as all fields below
    private long last;
    private int unanswered;
    private CallMessages.@Nullable Part end; // behind the buffered items
    private volatile boolean over; // written under this

    OutgoingStream(
            ActorSpace space, BusPort port, Address reader, long stream, Type type, CallableMethods.Values values) {
        this.space = space;
        this.port = port;
        this.reader = reader;
        this.stream = stream;
        this.type = type;
        this.values = values;
    }

    @Override
    public void accept(@Nullable Object result, @Nullable Throwable error) {
        if (error != null) {
            end(failed(error));
            return;
        }
        CborItem item;
        try {
            item = values.encode(type, result);
        } catch (RuntimeException unfit) {
            end(failed(unfit));
            throw unfit;
        }
        add(item);
    }

    private static CallMessages.Failed failed(Throwable error) {
        return new CallMessages.Failed(error.getClass().getName(), BoundedText.ofMessage(error));
    }

    private synchronized void add(CborItem item) {
        if (over || end != null) {
            return;
        }
        if (buffered.offer(item) != null) {
            buffered.drain();
            finish(failed(new IllegalStateException("the reader is too slow: " + MOST_UNANSWERED
                    + " items have no answer, and " + CAPACITY + " more waited and are lost")));
            return;
        }
        sendBuffered();
    }

    @Override
    public void finish() {
        end(new CallMessages.End());
    }

    private synchronized void end(CallMessages.Part with) {
        if (!over && end == null) {
            end = with;
            sendBuffered();
        }
    }

    @Override
    public boolean isCancelled() {
        return over;
    }

    private synchronized void sendBuffered() {
        while (!over && unanswered < MOST_UNANSWERED && !buffered.isEmpty()) {
            send(new CallMessages.Item(Objects.requireNonNull(buffered.poll())));
        }
        if (!over && end != null && buffered.isEmpty()) {
            finish(end);
        }
    }

    private synchronized void finish(CallMessages.Part with) {
        over = true;
        sendEnd(new CallMessages.StreamPart(stream, ++last, with), MOST_ENDS);
    }

    private void sendEnd(CallMessages.StreamPart part, int attempts) {
        port.ask(reader, CallMessages.STREAM, part, END_LIMIT)
                .toCompletableFuture()
                .whenComplete((received, error) -> {
                    if (error != null && attempts > 1) {
                        space.delay(END_LIMIT).thenRun(() -> sendEnd(part, attempts - 1));
                    }
                });
    }

    private void send(CallMessages.Part part) {
        unanswered++;
        port.ask(reader, CallMessages.STREAM, new CallMessages.StreamPart(stream, ++last, part), LIMIT)
                .toCompletableFuture() // at once, on any thread
                .whenComplete((received, error) -> answered(received, error));
    }

    private synchronized void answered(CallMessages.@Nullable Received received, @Nullable Throwable error) {
        unanswered--;
        if (over) {
            return;
        }
        if (received != null && received.wantsMore()) {
            sendBuffered();
        } else {
            buffered.drain();
            if (error != null) { // the reader may still be there
                finish(failed(error));
            } else {
                over = true;
            }
        }
    }
}
