package io.troupe.actor.model;

import io.troupe.actor.MailboxBound.Overflow;
import io.troupe.actor.model.ModelActor.Instance;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/** The queued calls of an actor. */
final class ModelMailbox {
    /**
     * A queued call.
     *
     * @param answer of a request
     * @param callback among its arguments
     * @param handler what the actor does with it
     */
    record Call(
            int id, @Nullable ModelPromise answer, @Nullable ModelStream callback, Consumer<Instance> handler) {
        boolean isCancelled() {
            return answer != null && answer.isDone();
        }

        /** Rejects a call: notifies its sender and its callback. */
        void turnAway(ModelSpace space, String actor, String error, String reason) {
            if (answer != null) {
                answer.settle("!" + error);
            } else {
                space.history.add("dead letter " + id + " to " + actor + ": " + reason);
            }
            failCallback(error);
        }

        void failCallback(String error) {
            if (callback != null) {
                callback.abandon(error);
            }
        }
    }

    private final int capacity;
    private final boolean dropsOldest;
    private final List<Call> waiting = new ArrayList<>();

    ModelMailbox(Cast cast) {
        this.capacity = cast.capacity();
        this.dropsOldest = capacity > 0 && cast.overflow() == Overflow.DROP_OLDEST;
    }

    private boolean isFull() {
        return capacity > 0 && waiting.size() >= capacity;
    }

    /**
     * Adds a call.
     *
     * @param ticket what is to be queued if there is room
     */
    void add(Call call, Runnable ticket, Consumer<Call> drop) {
        if (!isFull()) {
            waiting.add(call);
            ticket.run();
        } else if (dropsOldest) {
            waiting.add(call); // delivered for the ticket of another call
            drop.accept(waiting.removeFirst());
        } else {
            drop.accept(call);
        }
    }

    /** The call to be delivered for the ticket that was queued for the given one. */
    Call take(Call queued) {
        if (dropsOldest) {
            return waiting.removeFirst();
        }
        waiting.removeIf(each -> each == queued);
        return queued;
    }
}
