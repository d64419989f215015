package io.troupe.services.bus;

/** A message that was not heard or not wanted any more; told to the bus's observer once each. */
public sealed interface Loss {
    /**
     * A subscriber had as many values waiting as its queue holds, and the oldest made room.
     *
     * @param soFar how many this subscription has lost in this way, this one included
     */
    record Dropped(Address subscriber, Message oldest, long soFar) implements Loss {
        @Override
        public String toString() {
            return subscriber + " is too slow: its oldest " + describe(oldest) + " was dropped, " + soFar + " so far";
        }
    }

    /** A subscription ended with values waiting that it will not hear. */
    record Discarded(Address subscriber, String topic, int count, String why) implements Loss {
        @Override
        public String toString() {
            return subscriber + " does not hear " + count + " values of " + topic + " that waited: " + why;
        }
    }

    /** An answer, or a refusal, for which nobody waits any more. */
    record Late(Message answer, String why) implements Loss {
        @Override
        public String toString() {
            return describe(answer) + " is late: " + why;
        }
    }

    /** There is no way to whom it is for; the sender of a question is told, too. */
    record Undeliverable(Message message, String why) implements Loss {
        @Override
        public String toString() {
            return describe(message) + " cannot be delivered: " + why;
        }
    }

    /** A subscriber threw; the others have heard the value all the same. */
    record SubscriberFailed(Address subscriber, Message message, Throwable error) implements Loss {
        @Override
        public String toString() {
            return subscriber + " failed to hear " + describe(message) + ": " + error;
        }
    }

    private static String describe(Message message) {
        return message.purpose() + " from " + message.from() + " (number " + message.sequence() + ")";
    }
}
