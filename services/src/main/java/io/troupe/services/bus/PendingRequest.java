package io.troupe.services.bus;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Home;
import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.LongAdder;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/** A request that waits for its reply. */
final class PendingRequest<A extends Record> {
    final Port requester;
    private final Address to;
    private final Operation<?, A> operation;
    private final BusMessage request;
    private final Reply answer;
    private final Deferred<@Nullable Void> over;

    PendingRequest(Port requester, Address to, Operation<?, A> operation, BusMessage request, Home home) {
        this.requester = requester;
        this.to = to;
        this.operation = operation;
        this.request = request;
        this.answer = new Reply(home);
        this.over = new Deferred<>(home);
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
            case BusMessage.Purpose.Publication none -> "";
            case BusMessage.Purpose.Request none -> "";
        };
        return reply.from().equals(to) && replied.equals(operation.name());
    }

    /**
     * Calls the consumer when the limit is over (with true) or the requester's space is closed (with false). Never
     * called once this request is settled.
     */
    void limit(Duration limit, Consumer<Boolean> onEnd) {
        over.orTimeout(limit).toCompletableFuture().whenComplete((nothing, error) -> {
            if (error != null) {
                onEnd.accept(error instanceof TimeoutException);
            }
        });
    }

    /** Settles the request by a reply and counts the outcome; false if it was settled before. */
    boolean settle(BusMessage reply, Counters counters) {
        if (reply.payload() instanceof BusMessage.Failure failure) {
            return counted(counters.refused, reject(errorOf(failure)));
        }
        if (operation.reply().isInstance(reply.payload())) {
            return counted(counters.answered, resolve(operation.reply().cast(reply.payload())));
        }
        return counted(
                counters.refused,
                reject(error("the answer is a " + reply.payload().getClass().getName() + ", expected a "
                        + operation.reply().getName())));
    }

    private RuntimeException errorOf(BusMessage.Failure failure) {
        return switch (failure) {
            case BusMessage.Failure.NotDelivered(String why) -> error(why);
            case BusMessage.Failure.Failed(String type, String message) ->
                new RemoteFailure(to, operation.name(), type, message);
        };
    }

    BusException error(String why) {
        return new BusException(about(why));
    }

    private String about(String why) {
        return requester.address() + " asked " + to + " for " + operation.name() + ": " + why;
    }

    BusTimeoutException timeout(Duration limit) {
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
        answer.whenCancelled = () -> {
            action.run();
            over.resolve(null);
        };
    }

    /** The promise that the requester gets. */
    private final class Reply extends Promise<A> {
        private final Home home;
        private final boolean madeOutside;
        private volatile Runnable whenCancelled = () -> {};

        Reply(Home home) {
            this.home = home;
            this.madeOutside = Home.current() != home;
        }

        boolean resolve(A value) {
            return settleValue(value);
        }

        boolean reject(Throwable error) {
            return settleError(error);
        }

        @Override
        protected void cancelled() {
            whenCancelled.run();
        }

        @Override
        protected Home home() {
            return home;
        }

        @Override
        protected boolean isLocal() {
            return false;
        }

        @Override
        protected boolean madeOutside() {
            return madeOutside;
        }

        @Override
        protected void run() {
            throw new IllegalStateException("an answer is never queued");
        }

        @Override
        public String toString() {
            return requester.address() + "'s question to " + to + " for " + operation.name();
        }
    }
}
