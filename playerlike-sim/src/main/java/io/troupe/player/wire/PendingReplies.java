package io.troupe.player.wire;

import io.troupe.actor.Clock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import org.jspecify.annotations.Nullable;

/**
 * The requests that a client has sent and that have no reply yet.
 *
 * <p><b>Threads.</b> Any thread.
 *
 * <p><b>Order.</b> A reply belongs to the request whose sequence number it repeats. The drivers of a real server send 0
 * instead. Such a reply belongs to the oldest request of the same device and subtype, including requests that were
 * given up, because a driver replies in order. So a late reply is never matched to a later request. If such a server
 * drops a request, each later request of the same kind fails, because its reply cannot be distinguished from the late
 * reply to the request before. That ends when there has been no request of this kind, and no reply to one, for
 * {@link #QUIET}: then the requests that were given up are forgotten. A reply may be matched to a wrong request if it
 * is later than that, or if more than {@value #MAX_GIVEN_UP} requests were given up after its own.
 */
final class PendingReplies {
    /** Bound of requests that were given up and are still remembered; the oldest is forgotten first. */
    private static final int MAX_GIVEN_UP = 256;

    static final Duration QUIET = Duration.ofSeconds(30);

    private static final class Entry {
        final DeviceAddress device;
        final int subtype;
        final int sequence;
        final CompletableFuture<WireMessage> reply = new CompletableFuture<>();
        boolean givenUp;
        long touchedNanos; // time of the latest event of its kind

        Entry(DeviceAddress device, int subtype, int sequence) {
            this.device = device;
            this.subtype = subtype;
            this.sequence = sequence;
        }

        boolean isOf(DeviceAddress other, int otherSubtype) {
            return device.interfaceCode() == other.interfaceCode()
                    && device.index() == other.index()
                    && subtype == otherSubtype;
        }

        boolean isAnsweredBy(Header header) {
            return isOf(header.address(), header.subtype())
                    && (header.sequence() == 0 || header.sequence() == sequence);
        }
    }

    /**
     * A request to be sent.
     *
     * @param sequence its number, never 0
     * @param reply completes with the reply; already failed after {@link #failAll}
     */
    record Request(int sequence, CompletableFuture<WireMessage> reply) {}

    private final Clock clock;
    private final List<Entry> entries = new ArrayList<>();
    private int lastSequence;
    private @Nullable RuntimeException failure;

    PendingReplies(Clock clock) {
        this.clock = clock;
    }

    synchronized Request add(DeviceAddress device, int subtype) {
        long now = clock.nanos();
        entries.removeIf(
                each -> each.givenUp && each.isOf(device, subtype) && now - each.touchedNanos >= QUIET.toNanos());
        lastSequence = lastSequence == Integer.MAX_VALUE ? 1 : lastSequence + 1;
        var entry = new Entry(device, subtype, lastSequence);
        if (failure != null) {
            entry.reply.completeExceptionally(failure);
        } else {
            entries.add(entry);
            touch(device, subtype);
        }
        return new Request(entry.sequence, entry.reply);
    }

    /** Adds a request whose reply is not needed: it counts as given up from the start. */
    synchronized Request addUnawaited(DeviceAddress device, int subtype) {
        Request request = add(device, subtype);
        giveUp(request);
        return request;
    }

    private void touch(DeviceAddress device, int subtype) {
        long now = clock.nanos();
        for (var each : entries) {
            if (each.isOf(device, subtype)) {
                each.touchedNanos = now;
            }
        }
    }

    /** Removes a request that was not sent. */
    synchronized void drop(Request request) {
        entries.removeIf(each -> each.reply == request.reply());
    }

    /** The caller stops waiting, but the reply may still arrive. */
    synchronized void giveUp(Request request) {
        for (var each : entries) {
            if (each.reply == request.reply()) {
                each.givenUp = true;
                touch(each.device, each.subtype);
            }
        }
        if (entries.stream().filter(each -> each.givenUp).count() > MAX_GIVEN_UP) {
            entries.stream().filter(each -> each.givenUp).findFirst().ifPresent(entries::remove);
        }
    }

    /** False if no caller waits for this reply. */
    boolean answer(WireMessage message) {
        CompletableFuture<WireMessage> answered = take(message.header());
        return answered != null && answered.complete(message);
    }

    private synchronized @Nullable CompletableFuture<WireMessage> take(Header header) {
        for (var each : entries) {
            if (each.isAnsweredBy(header)) {
                entries.remove(each);
                touch(each.device, each.subtype);
                return each.givenUp ? null : each.reply;
            }
        }
        return null;
    }

    void failAll(RuntimeException reason) {
        List<Entry> failed;
        synchronized (this) {
            failure = reason;
            failed = List.copyOf(entries);
            entries.clear();
        }
        failed.forEach(each -> each.reply.completeExceptionally(reason));
    }
}
