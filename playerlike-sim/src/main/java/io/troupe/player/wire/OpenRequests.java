package io.troupe.player.wire;

import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import org.jspecify.annotations.Nullable;

/**
 * The requests a client has sent and got no reply to.
 *
 * <p><b>Threads.</b> Any thread.
 * <p><b>Order.</b> A reply belongs to the request whose sequence number it repeats. The drivers of a real server send 0 instead: such a reply belongs to the oldest request of the same
 * device and subtype, requests that were given up included, as a driver answers in order. So a late reply never goes to a later request; if the server had dropped the request that was
 * given up, the next one of the same kind is given up too, but no more.
 */
final class OpenRequests {
    /** Requests that were given up are forgotten, the oldest first, when there are more. */
    private static final int MOST_GIVEN_UP = 256;

    private static final class Entry {
        final DeviceAddress device;
        final int subtype;
        final int sequence;
        final CompletableFuture<Message> reply = new CompletableFuture<>();
        boolean givenUp;
        boolean mayBeAnswered; // a reply without a number, which went to a request that had been given up before

        Entry(DeviceAddress device, int subtype, int sequence) {
            this.device = device;
            this.subtype = subtype;
            this.sequence = sequence;
        }

        boolean isLike(Header header) {
            return device.interfaceCode() == header.address().interfaceCode()
                    && device.index() == header.address().index()
                    && subtype == header.subtype();
        }

        boolean isAnsweredBy(Header header) {
            return isLike(header) && (header.sequence() == 0 || header.sequence() == sequence);
        }
    }

    /**
     * A request that is to be sent.
     *
     * @param sequence its number, never 0
     * @param reply is given the reply; it has failed already after {@link #failAll}
     */
    record Request(int sequence, CompletableFuture<Message> reply) {}

    private final List<Entry> entries = new ArrayList<>();
    private int lastSequence;
    private @Nullable RuntimeException failure;

    synchronized Request add(DeviceAddress device, int subtype) {
        lastSequence = lastSequence == Integer.MAX_VALUE ? 1 : lastSequence + 1;
        var entry = new Entry(device, subtype, lastSequence);
        if (failure != null) {
            entry.reply.completeExceptionally(failure);
        } else {
            entries.add(entry);
        }
        return new Request(entry.sequence, entry.reply);
    }

    /** It was not sent. */
    synchronized void drop(Request request) {
        entries.removeIf(each -> each.reply == request.reply());
    }

    /** Its caller waits no more, but its reply may come. */
    synchronized void giveUp(Request request) {
        entries.removeIf(each -> each.reply == request.reply() && each.mayBeAnswered);
        for (var each : entries) {
            if (each.reply == request.reply()) {
                each.givenUp = true;
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
                if (!each.givenUp) {
                    return each.reply;
                }
                if (header.sequence() == 0) {
                    entries.stream()
                            .filter(other -> other.isLike(header) && !other.mayBeAnswered)
                            .findFirst()
                            .ifPresent(other -> other.mayBeAnswered = true);
                }
                return null;
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
