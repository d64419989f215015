package io.troupe.services.bus;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Promise;
import io.troupe.services.bus.Message.Purpose;
import java.time.Duration;
import java.util.Map;
import java.util.Objects;
import java.util.concurrent.ConcurrentHashMap;
import org.jspecify.annotations.Nullable;

/** The pending requests of one node. */
final class Questions {
    private final BusNode node;
    private final Map<Long, Pending<?>> pending = new ConcurrentHashMap<>(); // by the sequence number of the request

    Questions(BusNode node) {
        this.node = node;
    }

    <Q extends Record, A extends Record> Promise<A> ask(
            Port asker, Address to, Operation<Q, A> operation, Q question, Duration limit) {
        if (limit.isNegative() || limit.isZero()) {
            throw new IllegalArgumentException(
                    "the limit for " + operation.name() + " is " + limit + ", expected more than zero");
        }
        var message = Message.of(
                operation.kind(),
                asker.address(),
                new Purpose.Question(to, operation.name()),
                node.nextNumber(),
                node.detached(operation.question().cast(Objects.requireNonNull(question, "question"))));
        ActorSpace here = ActorSpace.current();
        var waiting = new Pending<A>(asker, to, operation, message, here == null ? node.settings.space() : here);
        long number = message.sequence();
        node.counters.asked.increment();
        pending.put(number, waiting);
        waiting.whenCancelled(() -> take(number));
        String closed = asker.whyClosed(); // read after put(): either this thread or close() sees the other's change
        if (closed != null) {
            refuse(number, "the asker has left: " + closed);
        } else {
            node.route(message);
        }
        if (!waiting.answer().isDone()) {
            waiting.limit(limit, inTime -> expire(number, inTime, limit));
        }
        return waiting.answer();
    }

    /** Removes a pending request; null if it was no longer pending. */
    private @Nullable Pending<?> take(long number) {
        Pending<?> asked = pending.remove(number);
        if (asked != null) {
            node.forgetQuestion(asked.question());
        }
        return asked;
    }

    /** Returns whether its requester, on this node, still waits for the reply. */
    boolean isAwaited(Message question) {
        return pending.containsKey(question.sequence());
    }

    private void expire(long number, boolean timeIsOver, Duration limit) {
        Pending<?> late = take(number);
        if (late != null && timeIsOver) {
            Pending.counted(node.counters.timedOut, late.reject(late.timeout(limit)));
        } else if (late != null) {
            refuse(late, "the space of the asker was closed");
        }
    }

    /** A reply or a refusal has arrived. */
    void settle(Message reply, long question) {
        Pending<?> asked = pending.get(question);
        if (asked != null && !asked.isOf(reply)) {
            node.telling.late(reply, "it is for another question of that number, of an earlier life of this node");
        } else if (asked == null || !pending.remove(question, asked)) {
            node.telling.late(reply, "nobody waits for it any more");
        } else if (!asked.settle(reply, node.counters)) {
            node.telling.late(reply, "the asker has cancelled");
        }
    }

    /** Rejects a request because the bus cannot get a reply. */
    void refuse(long number, String why) {
        Pending<?> asked = take(number);
        if (asked != null) {
            refuse(asked, why);
        }
    }

    void refuseAllOf(Port asker, String why) {
        pending.forEach((number, asked) -> {
            if (asked.asker == asker) {
                refuse(number, why);
            }
        });
    }

    private void refuse(Pending<?> asked, String why) {
        Pending.counted(node.counters.refused, asked.reject(asked.error(why)));
    }

    /** The number of pending requests. */
    int waiting() {
        return pending.size();
    }
}
