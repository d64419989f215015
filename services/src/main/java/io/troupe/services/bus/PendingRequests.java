package io.troupe.services.bus;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Promise;
import io.troupe.services.bus.BusMessage.Purpose;
import java.time.Duration;
import java.util.Map;
import java.util.Objects;
import java.util.concurrent.ConcurrentHashMap;
import org.jspecify.annotations.Nullable;

/** The pending requests of one node. */
final class PendingRequests {
    private final BusNode node;
    private final Map<Long, PendingRequest<?>> pending =
            new ConcurrentHashMap<>(); // by the sequence number of the request

    PendingRequests(BusNode node) {
        this.node = node;
    }

    <Q extends Record, A extends Record> Promise<A> ask(
            Port requester, Address to, Operation<Q, A> operation, Q request, Duration limit) {
        if (limit.isNegative() || limit.isZero()) {
            throw new IllegalArgumentException(
                    "the limit for " + operation.name() + " is " + limit + ", expected more than zero");
        }
        var message = BusMessage.of(
                operation.kind(),
                requester.address(),
                new Purpose.Request(to, operation.name()),
                node.nextNumber(),
                node.copy(operation.request().cast(Objects.requireNonNull(request, "question"))));
        ActorSpace here = ActorSpace.current();
        var waiting =
                new PendingRequest<A>(requester, to, operation, message, here == null ? node.settings.space() : here);
        long number = message.sequence();
        node.counters.asked.increment();
        pending.put(number, waiting);
        waiting.whenCancelled(() -> take(number));
        String closed =
                requester.whyClosed(); // read after put(): either this thread or close() sees the other's change
        if (closed != null) {
            reject(number, "the asker has left: " + closed);
        } else {
            node.route(message);
        }
        if (!waiting.answer().isDone()) {
            waiting.limit(limit, inTime -> expire(number, inTime, limit));
        }
        return waiting.answer();
    }

    /** Removes a pending request; null if it was no longer pending. */
    private @Nullable PendingRequest<?> take(long number) {
        PendingRequest<?> asked = pending.remove(number);
        if (asked != null) {
            node.requestCancelled(asked.request());
        }
        return asked;
    }

    /** Returns whether its requester, on this node, still waits for the reply. */
    boolean isAwaited(BusMessage request) {
        return pending.containsKey(request.sequence());
    }

    private void expire(long number, boolean timeIsOver, Duration limit) {
        PendingRequest<?> late = take(number);
        if (late != null && timeIsOver) {
            PendingRequest.counted(node.counters.timedOut, late.reject(late.timeout(limit)));
        } else if (late != null) {
            reject(late, "the space of the asker was closed");
        }
    }

    /** A reply or a refusal has arrived. */
    void settle(BusMessage reply, long request) {
        PendingRequest<?> asked = pending.get(request);
        if (asked != null && !asked.isAnsweredBy(reply)) {
            node.notifier.late(reply, "it is for another question of that number, of an earlier life of this node");
        } else if (asked == null || !pending.remove(request, asked)) {
            node.notifier.late(reply, "nobody waits for it any more");
        } else if (!asked.settle(reply, node.counters)) {
            node.notifier.late(reply, "the asker has cancelled");
        }
    }

    /** Rejects a request because the bus cannot get a reply. */
    void reject(long number, String why) {
        PendingRequest<?> asked = take(number);
        if (asked != null) {
            reject(asked, why);
        }
    }

    void rejectAllOf(Port requester, String why) {
        pending.forEach((number, asked) -> {
            if (asked.requester == requester) {
                reject(number, why);
            }
        });
    }

    private void reject(PendingRequest<?> asked, String why) {
        PendingRequest.counted(node.counters.refused, asked.reject(asked.error(why)));
    }

    /** The number of pending requests. */
    int waiting() {
        return pending.size();
    }
}
