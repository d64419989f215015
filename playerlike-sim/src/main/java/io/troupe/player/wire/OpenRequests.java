package io.troupe.player.wire;

import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import org.jspecify.annotations.Nullable;

/**
 * The requests a client has sent and got no reply to.
 *
 * <p><b>Threads.</b> Any thread.
 * <p><b>Order.</b> A reply belongs to the oldest request of the same device and subtype; requests to several devices may be answered in any order, as
 * drivers of a real server take their time, and a request that a real server has dropped does not spoil those behind it.
 */
final class OpenRequests {
    private record Entry(int interfaceCode, int index, int subtype, CompletableFuture<Message> reply) {
        boolean isAnsweredBy(Header header) {
            return interfaceCode == header.address().interfaceCode()
                    && index == header.address().index()
                    && subtype == header.subtype();
        }
    }

    private final List<Entry> entries = new ArrayList<>();
    private @Nullable RuntimeException failure;

    /** What the reply will be given to; it fails at once after {@link #failAll}. */
    synchronized CompletableFuture<Message> add(DeviceAddress device, int subtype) {
        var reply = new CompletableFuture<Message>();
        if (failure != null) {
            reply.completeExceptionally(failure);
        } else {
            entries.add(new Entry(device.interfaceCode(), device.index(), subtype, reply));
        }
        return reply;
    }

    /** Nobody waits for it any more. */
    synchronized void drop(CompletableFuture<Message> reply) {
        entries.removeIf(each -> each.reply == reply);
    }

    /** False for a reply to nothing. */
    boolean answer(Message message) {
        CompletableFuture<Message> answered = take(message.header());
        return answered != null && answered.complete(message);
    }

    private synchronized @Nullable CompletableFuture<Message> take(Header header) {
        for (var each : entries) {
            if (each.isAnsweredBy(header)) {
                entries.remove(each);
                return each.reply;
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
