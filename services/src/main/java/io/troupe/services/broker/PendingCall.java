package io.troupe.services.broker;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.Timer;
import org.jspecify.annotations.Nullable;

/** A call that is queued or waits for its answer. Used on the connection's space. */
final class PendingCall {
    final CallDispatcher.Call call;
    private final @Nullable Deferred<@Nullable Object> answer; // null: a one-way call
    ActorProvider.@Nullable Running sentTo;

    @Nullable
    Promise<?> sent; // the provider's promise

    private boolean cancelled;

    @Nullable
    Timer limit;

    PendingCall(CallDispatcher.Call call, @Nullable Deferred<@Nullable Object> answer) {
        this.call = call;
        this.answer = answer;
    }

    void resolve(@Nullable Object value) {
        cancelLimit();
        if (answer != null) {
            answer.resolve(value);
        }
    }

    /** Rejects the call. Returns false for a one-way call, whose error has to be reported in another way. */
    boolean reject(Throwable error) {
        cancelLimit();
        if (answer == null) {
            return false;
        }
        answer.reject(error);
        return true;
    }

    /** Cancels the call: a provider that has not begun it does not execute it. */
    void cancel() {
        cancelled = true;
        cancelLimit();
        if (sent != null) {
            sent.cancel();
        }
    }

    boolean isCancelled() {
        return cancelled;
    }

    void cancelLimit() {
        if (limit != null) {
            limit.cancel();
            limit = null;
        }
    }

    String receiver() {
        return sentTo == null ? "nobody" : sentTo.address().toString();
    }

    boolean receiverHasEnded() {
        return sentTo != null && sentTo.hasEnded();
    }

    @Override
    public String toString() {
        return call.toString();
    }
}
