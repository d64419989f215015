package io.troupe.bus;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.LibraryAccess;
import io.troupe.actor.Promise;
import io.troupe.bus.BusMessage.Purpose;
import java.time.Duration;
import java.time.temporal.ChronoUnit;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.LongAdder;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/** The pending requests of one node. */
final class PendingRequests {
    private static final Duration FOREVER = ChronoUnit.FOREVER.getDuration();

    private final Bus node;
    private final Map<Long, PendingRequest<?>> pending = new ConcurrentHashMap<>(); // by sequence number

    PendingRequests(Bus node) {
        this.node = node;
    }

    <Q extends Record, A extends Record> Promise<A> ask(
            BusPort requester, Address to, Operation<Q, A> operation, Q request, @Nullable Duration longest) {
        if (longest != null && (longest.isNegative() || longest.isZero())) {
            throw new IllegalArgumentException(
                    "the limit for " + operation.name() + " is " + longest + ", expected more than zero");
        }
        Duration left = ActorSpace.timeLeft();
        Duration limit = left == null || longest != null && left.compareTo(longest) > 0 ? longest : left;
        var message = BusMessage.of(
                operation.kind(),
                requester.address(),
                new Purpose.Request(to, operation.name()),
                node.nextNumber(),
                node.copy(operation.request().cast(Objects.requireNonNull(request, "request"))));
        ActorSpace here = ActorSpace.current();
        var waiting =
                new PendingRequest<A>(requester, to, operation, message, here == null ? node.settings.space() : here);
        long number = message.sequence();
        node.counters.asked.increment();
        pending.put(number, waiting);
        waiting.whenCancelled(() -> takeCancelled(number));
        // read after put(): either this thread or close() sees the other's change
        String closed = requester.whyClosed();
        if (closed != null) {
            reject(number, "the port of the requester was closed: " + closed, false);
        } else {
            node.request(message, limit, left != null);
        }
        if (!waiting.answer().isDone()) {
            waiting.limit(limit, inTime -> expire(number, inTime, limit));
        }
        return waiting.answer();
    }

    /** Removes a pending request; null if it was no longer pending. */
    private @Nullable PendingRequest<?> takeCancelled(long number) {
        PendingRequest<?> asked = pending.remove(number);
        if (asked != null) {
            node.requestCancelled(asked.request());
        }
        return asked;
    }

    /** The type that the reply to a request must have; null if the request is not pending. */
    @Nullable
    Class<? extends Record> replyType(long number) {
        PendingRequest<?> asked = pending.get(number);
        return asked == null ? null : asked.operation.reply();
    }

    /** Returns whether its requester, on this node, still waits for the reply. */
    boolean isAwaited(BusMessage request) {
        return pending.containsKey(request.sequence());
    }

    private void expire(long number, boolean timeIsOver, @Nullable Duration limit) {
        PendingRequest<?> late = takeCancelled(number);
        if (late != null && timeIsOver) {
            PendingRequest.counted(node.counters.timedOut, late.reject(late.timeout(limit)));
        } else if (late != null) {
            reject(late, "the space of the requester was closed", true);
        }
    }

    /** A reply or a rejection has arrived. */
    void settle(BusMessage reply, long request) {
        PendingRequest<?> asked = pending.get(request);
        if (asked != null && !asked.isAnsweredBy(reply)) {
            node.notifier.late(reply, "it is for another request of that number, of an earlier life of this node");
        } else if (asked == null || !pending.remove(request, asked)) {
            node.notifier.late(reply, "no caller waits for it any more");
        } else if (!asked.settle(reply, node.counters)) {
            node.notifier.late(reply, "the requester has cancelled");
        }
    }

    /** Rejects a request because the bus cannot get a reply. */
    void reject(long number, String why, boolean mayHaveRun) {
        PendingRequest<?> asked = takeCancelled(number);
        if (asked != null) {
            reject(asked, why, mayHaveRun);
        }
    }

    /**
     * Like {@link #reject}, for a request that has not arrived anywhere, so that it need not be cancelled there.
     *
     * @return the request, or null if it was not pending
     */
    @Nullable
    BusMessage rejectUnreachable(long number, String why) {
        PendingRequest<?> asked = pending.remove(number);
        if (asked == null) {
            return null;
        }
        reject(asked, why, false);
        return asked.request();
    }

    /** The numbers of the requests to a node. */
    List<Long> numbersTo(String node) {
        return pending.entrySet().stream()
                .filter(each -> each.getValue().to.node().equals(node))
                .map(Map.Entry::getKey)
                .toList();
    }

    void rejectAllOf(BusPort requester, String why) {
        pending.forEach((number, asked) -> {
            if (asked.requester == requester) {
                reject(number, why, true);
            }
        });
    }

    private void reject(PendingRequest<?> asked, String why, boolean mayHaveRun) {
        PendingRequest.counted(node.counters.rejected, asked.reject(asked.error(why, mayHaveRun)));
    }

    /** The number of pending requests. */
    int waiting() {
        return pending.size();
    }

    /** A request that waits for its reply. */
    private static final class PendingRequest<A extends Record> implements LibraryAccess.Work {
        final BusPort requester;
        private final Address to;
        private final Operation<?, A> operation;
        private final BusMessage request;
        private final Deferred<A> answer; // the promise that the requester gets
        private final Deferred<@Nullable Void> over;
        private volatile Runnable whenCancelled = () -> {};

        PendingRequest(BusPort requester, Address to, Operation<?, A> operation, BusMessage request, ActorSpace home) {
            this.requester = requester;
            this.to = to;
            this.operation = operation;
            this.request = request;
            this.answer = LibraryAccess.deferred(LibraryAccess.home(home), this);
            this.over = home.deferred();
        }

        Promise<A> answer() {
            return answer;
        }

        BusMessage request() {
            return request;
        }

        /**
         * Returns whether a reply belongs to this request: it comes from the address that was asked, and names the same
         * operation.
         */
        boolean isAnsweredBy(BusMessage reply) {
            String replied = switch (reply.purpose()) {
                case BusMessage.Purpose.Reply is -> is.operation();
                case BusMessage.Purpose.Rejection is -> is.operation();
                default -> ""; // not a reply
            };
            return reply.from().equals(to) && replied.equals(operation.name());
        }

        /**
         * Calls the consumer when the limit is over (with true) or the requester's space is closed (with false). Never
         * called once this request is settled.
         */
        void limit(@Nullable Duration limit, Consumer<Boolean> onEnd) {
            over.orTimeout(limit == null ? FOREVER : limit)
                    .toCompletableFuture()
                    .whenComplete((nothing, error) -> {
                        if (error != null) {
                            onEnd.accept(error instanceof TimeoutException);
                        }
                    });
        }

        /** Settles the request by a reply and counts the outcome; false if it was settled before. */
        boolean settle(BusMessage reply, Counters counters) {
            if (reply.payload() instanceof BusMessage.Failure failure) {
                return counted(counters.rejected, reject(errorOf(failure)));
            }
            if (operation.reply().isInstance(reply.payload())) {
                return counted(counters.answered, resolve(operation.reply().cast(reply.payload())));
            }
            return counted(
                    counters.rejected,
                    reject(error(
                            "the answer is a " + reply.payload().getClass().getName() + ", expected a "
                                    + operation.reply().getName(),
                            true)));
        }

        private RuntimeException errorOf(BusMessage.Failure failure) {
            return switch (failure) {
                case BusMessage.Failure.NotDelivered(String why) -> error(why, false);
                case BusMessage.Failure.Unanswered(String why) -> error(why, true);
                case BusMessage.Failure.Failed(String type, String message) ->
                    new RemoteFailure(to, operation.name(), type, message);
            };
        }

        BusException error(String why, boolean mayHaveRun) {
            return new BusException(about(why), mayHaveRun);
        }

        private String about(String why) {
            return requester.address() + " asked " + to + " for " + operation.name() + ": " + why;
        }

        BusTimeoutException timeout(@Nullable Duration limit) {
            return new BusTimeoutException(about("no answer within " + limit));
        }

        static boolean counted(LongAdder counter, boolean done) {
            if (done) {
                counter.increment();
            }
            return done;
        }

        /** Returns false if it was settled before. */
        boolean resolve(A value) {
            boolean first = answer.resolve(value);
            over.resolve(null);
            return first;
        }

        /** Returns false if it was settled before. */
        boolean reject(RuntimeException error) {
            boolean first = answer.reject(error);
            over.resolve(null);
            return first;
        }

        /** Registers an action to run when the requester cancels. */
        void whenCancelled(Runnable action) {
            whenCancelled = action;
        }

        /** The requester has cancelled the promise. */
        @Override
        public void run() {
            whenCancelled.run();
            over.resolve(null);
        }

        /** The name of the promise. */
        @Override
        public String toString() {
            return requester.address() + "'s request to " + to + " for " + operation.name();
        }
    }
}
