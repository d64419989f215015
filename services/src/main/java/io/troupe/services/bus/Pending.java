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
final class Pending<A extends Record> {
    final Port asker;
    private final Address to;
    private final Operation<?, A> operation;
    private final Message question;
    private final Answer answer;
    private final Deferred<@Nullable Void> over;

    Pending(Port asker, Address to, Operation<?, A> operation, Message question, Home home) {
        this.asker = asker;
        this.to = to;
        this.operation = operation;
        this.question = question;
        this.answer = new Answer(home);
        this.over = new Deferred<>(home);
    }

    Promise<A> answer() {
        return answer;
    }

    Message question() {
        return question;
    }

    /**
     * Returns whether a reply belongs to this request: it comes from the address that was asked, and names the same
     * operation.
     */
    boolean isOf(Message reply) {
        String replied = switch (reply.purpose()) {
            case Message.Purpose.Answer is -> is.operation();
            case Message.Purpose.Refusal is -> is.operation();
            case Message.Purpose.Publication none -> "";
            case Message.Purpose.Question none -> "";
        };
        return reply.from().equals(to) && replied.equals(operation.name());
    }

    /**
     * Calls the consumer when the limit is over (with true) or the requester's space is closed (with false). Never
     * called once this request is settled.
     */
    void limit(Duration limit, Consumer<Boolean> tellInTime) {
        over.orTimeout(limit).toCompletableFuture().whenComplete((nothing, error) -> {
            if (error != null) {
                tellInTime.accept(error instanceof TimeoutException);
            }
        });
    }

    /** Settles the request by a reply and counts the outcome; false if it was settled before. */
    boolean settle(Message reply, Counters counters) {
        if (reply.payload() instanceof Message.Failure failure) {
            return counted(counters.refused, reject(errorOf(failure)));
        }
        if (operation.answer().isInstance(reply.payload())) {
            return counted(counters.answered, resolve(operation.answer().cast(reply.payload())));
        }
        return counted(
                counters.refused,
                reject(error("the answer is a " + reply.payload().getClass().getName() + ", expected a "
                        + operation.answer().getName())));
    }

    private RuntimeException errorOf(Message.Failure failure) {
        return switch (failure) {
            case Message.Failure.NotDelivered(String why) -> error(why);
            case Message.Failure.Failed(String type, String message) ->
                new RemoteFailure(to, operation.name(), type, message);
        };
    }

    BusException error(String why) {
        return new BusException(about(why));
    }

    private String about(String why) {
        return asker.address() + " asked " + to + " for " + operation.name() + ": " + why;
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
    private final class Answer extends Promise<A> {
        private final Home home;
        private final boolean madeOutside;
        private volatile Runnable whenCancelled = () -> {};

        Answer(Home home) {
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
            return asker.address() + "'s question to " + to + " for " + operation.name();
        }
    }
}
