package io.troupe.player.wire;

import io.troupe.actor.time.Clock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import org.jspecify.annotations.Nullable;

/**
 * The requests a client has sent and got no reply to.
 *
 * <p><b>Threads.</b> Any thread.
 *
 * <p><b>Order.</b> A reply belongs to the request whose sequence number it repeats. The drivers of a real server send 0
 * instead: such a reply belongs to the oldest request of the same device and subtype, requests that were given up
 * included, as a driver answers in order. So a late reply goes to no later request. If such a server has dropped a
 * request, each later one of the same kind fails, since its reply cannot be told from the late one of the request
 * before, until there has been none of them, and no reply to one, for {@link #QUIET}: then those that were given up are
 * forgotten. A reply that is later than that, or that more than {@value #MOST_GIVEN_UP} later failures have outlived,
 * may go to a wrong request.
 */
final class OpenRequests {
    /** Requests that were given up are forgotten, the oldest first, when there are more. */
    private static final int MOST_GIVEN_UP = 256;

    static final Duration QUIET = Duration.ofSeconds(30);

    private static final class Entry {
        final DeviceAddress device;
        final int subtype;
        final int sequence;
        final CompletableFuture<Message> reply = new CompletableFuture<>();
        boolean givenUp;
        long touchedNanos; // the newest event of its kind

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
     * A request that is to be sent.
     *
     * @param sequence its number, never 0
     * @param reply is given the reply; it has failed already after {@link #failAll}
     */
    record Request(int sequence, CompletableFuture<Message> reply) {}

    private final Clock clock;
    private final List<Entry> entries = new ArrayList<>();
    private int lastSequence;
    private @Nullable RuntimeException failure;

    OpenRequests(Clock clock) {
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

    /** A request whose reply is of no interest: it is given up from the beginning. */
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

    /** It was not sent. */
    synchronized void drop(Request request) {
        entries.removeIf(each -> each.reply == request.reply());
    }

    /** Its caller waits no more, but its reply may come. */
    synchronized void giveUp(Request request) {
        for (var each : entries) {
            if (each.reply == request.reply()) {
                each.givenUp = true;
                touch(each.device, each.subtype);
            }
        }
        if (entries.stream().filter(each -> each.givenUp).count() > MOST_GIVEN_UP) {
            entries.stream().filter(each -> each.givenUp).findFirst().ifPresent(entries::remove);
        }
    }

    /** False for a reply that no request waits for. */
    boolean answer(Message message) {
        CompletableFuture<Message> answered = take(message.header());
        return answered != null && answered.complete(message);
    }

    private synchronized @Nullable CompletableFuture<Message> take(Header header) {
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
