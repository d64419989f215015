package io.troupe.bus;

import io.troupe.bus.internal.BoundedText;
import java.time.Duration;

/**
 * A message that was not delivered, or a reply that was no longer awaited. Each is reported once to the bus's observer.
 * There may be further kinds in later versions: a {@code switch} needs a {@code default}.
 *
 * <p>Users meet it as the argument of {@link BusObserver#lost}.
 */
public interface Loss {
    /**
     * The queue of a subscriber was full, and its oldest value was removed.
     *
     * @param soFar the number of values that this subscription has dropped, including this one
     */
    record Dropped(Address subscriber, BusMessage oldest, long soFar) implements Loss {
        @Override
        public String toString() {
            return subscriber + " is too slow: its oldest " + describe(oldest) + " was dropped, " + soFar + " so far";
        }
    }

    /** A subscription ended with values still queued, which are not delivered. */
    record DroppedAtEnd(Address subscriber, String topic, int count, String why) implements Loss {
        @Override
        public String toString() {
            return count + " values of " + topic + " for " + subscriber + " were dropped: " + why;
        }
    }

    /** A reply or rejection arrived when its request was no longer pending. */
    record Late(BusMessage reply, String why) implements Loss {
        @Override
        public String toString() {
            return describe(reply) + " is late: " + why;
        }
    }

    /** The receiver of the message cannot be reached. If it is a request, the request is rejected as well. */
    record Undeliverable(BusMessage message, String why) implements Loss {
        @Override
        public String toString() {
            return describe(message) + " cannot be delivered: " + why;
        }
    }

    /** A subscriber threw an exception. Other subscribers received the value. */
    record SubscriberFailed(Address subscriber, BusMessage message, Throwable error) implements Loss {
        @Override
        public String toString() {
            return subscriber + " failed to receive " + describe(message) + ": " + BoundedText.of(error);
        }
    }

    /** A value was older than its topic permits when its subscriber would have received it. */
    record Stale(Address subscriber, BusMessage message, Duration age) implements Loss {
        @Override
        public String toString() {
            return subscriber + " does not receive " + describe(message) + ": it is " + age.toMillis() + " ms old";
        }
    }

    /** Values of a publisher on another node have not arrived. */
    record Missed(Address publisher, String topic, long count) implements Loss {
        @Override
        public String toString() {
            return count + " values of " + topic + " from " + publisher + " have not arrived";
        }
    }

    /** Bytes from another node are no message, or carry no value of the type that is expected here. */
    record Unreadable(String what, String why) implements Loss {
        @Override
        public String toString() {
            return what + " cannot be read: " + why;
        }
    }

    /**
     * The engine that carries messages to other nodes has lost some.
     *
     * @param messages how many; 0 if that is not known
     */
    record LostOnTheWay(long messages, String why) implements Loss {
        @Override
        public String toString() {
            String count = messages == 0
                    ? "messages may have been"
                    : messages == 1 ? "1 message was" : messages + " messages were";
            return count + " lost: " + why;
        }
    }

    private static String describe(BusMessage message) {
        return message.purpose() + " from " + message.from() + " (number " + message.sequence() + ")";
    }
}
