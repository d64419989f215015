package io.troupe.actor;

import org.jspecify.annotations.Nullable;

/**
 * One subscriber of a topic.
 *
 * <p><b>Threads.</b> The topic's lock guards all methods; entries run on the subscriber's space.
 *
 * <p><b>Order.</b> As sent, from whichever threads.
 */
final class Subscription<T> {
    private final Object topic;
    private final ReturningCallback<T> reader;

    Subscription(Object topic, ReturningCallback<T> reader) {
        this.topic = topic;
        this.reader = reader;
    }

    /** Sends a value; false, without effect, if the subscriber is gone. */
    boolean send(T value) {
        if (isGone()) {
            return false;
        }
        reader.sendTo(value);
        return true;
    }

    void end(@Nullable Throwable error) {
        reader.endOnce(error);
    }

    /**
     * True if the subscriber is gone. A user's {@code isCancelled} may throw: this is reported, and ends the
     * subscription.
     */
    boolean isGone() {
        try {
            return reader.isOver();
        } catch (Throwable broken) {
            reader.report("isCancelled() of a subscriber of", topic, broken);
            return true;
        }
    }
}
