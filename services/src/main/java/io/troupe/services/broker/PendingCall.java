package io.troupe.services.broker;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.Timer;
import org.jspecify.annotations.Nullable;

/** A call on its way. On the connection's space. */
final class PendingCall {
    final Caller.Call call;
    private final @Nullable Deferred<@Nullable Object> answer; // null: nobody waits for one
    ActorProvider.@Nullable Running sentTo;

    @Nullable
    Promise<?> sent; // the provider's promise

    private boolean givenUp;

    @Nullable
    Timer limit;

    PendingCall(Caller.Call call, @Nullable Deferred<@Nullable Object> answer) {
        this.call = call;
        this.answer = answer;
    }

    void resolve(@Nullable Object value) {
        cancelLimit();
        if (answer != null) {
            answer.resolve(value);
        }
    }

    /** False if nobody waits for an answer, so that somebody else has to be told. */
    boolean reject(Throwable error) {
        cancelLimit();
        if (answer == null) {
            return false;
        }
        answer.reject(error);
        return true;
    }

    /** A provider that has not begun it does not begin it any more. */
    void giveUp() {
        givenUp = true;
        cancelLimit();
        if (sent != null) {
            sent.cancel();
        }
    }

    boolean wasGivenUp() {
        return givenUp;
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
