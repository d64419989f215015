package io.troupe.actor;

import org.jspecify.annotations.Nullable;

/**
 * One reader of a topic.
 *
 * <p><b>Threads.</b> The topic's lock guards all methods; entries run on the reader's space.
 *
 * <p><b>Order.</b> As sent, whichever threads they were sent from.
 */
final class Subscription<T> {
    private final Object topic;
    private final ReturningCallback<T> reader;

    Subscription(Object topic, ReturningCallback<T> reader) {
        this.topic = topic;
        this.reader = reader;
    }

    /** Sends a value; false, and nothing is done, if nobody listens any more. */
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
     * Whether nobody listens any more. A callback of somebody's own making may throw when asked: its fault, and its
     * end.
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
