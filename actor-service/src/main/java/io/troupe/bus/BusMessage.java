package io.troupe.bus;

import io.troupe.bus.internal.BoundedText;

/**
 * A message on the bus. Nothing else crosses it.
 *
 * <p>Users meet it as the argument of {@link BusObserver#passed}, and in a {@link Loss}.
 *
 * <p><b>Role.</b> A bus between processes encodes exactly these records. They contain only names, numbers and records
 * of values.
 *
 * <p><b>Source.</b> Paper, section 2.2.3: control messages manage services, data messages are their input and output.
 */
public sealed interface BusMessage {
    Address from();

    Purpose purpose();

    /** The sequence number of the message: one counter per node for all its ports, starting at 1. */
    long sequence();

    /** A value of the topic's or operation's type; a {@link Failure} in a rejection. */
    Record payload();

    /** Creates a message of that kind. */
    static BusMessage of(Operation.Kind kind, Address from, Purpose purpose, long sequence, Record payload) {
        return switch (kind) {
            case DATA -> new Data(from, purpose, sequence, payload);
            case CONTROL -> new Control(from, purpose, sequence, payload);
        };
    }

    /** The kind of the operation; publications are data. */
    default Operation.Kind kind() {
        return switch (this) {
            case Data data -> Operation.Kind.DATA;
            case Control control -> Operation.Kind.CONTROL;
        };
    }

    /** Input or output of a service. */
    record Data(Address from, Purpose purpose, long sequence, Record payload) implements BusMessage {}

    /** Manages a service: invokes it, terminates it, checks its health. */
    record Control(Address from, Purpose purpose, long sequence, Record payload) implements BusMessage {}

    /**
     * The purpose of a message, which also determines its receivers. There may be further kinds in later versions: an
     * observer's {@code switch} needs a {@code default}.
     */
    sealed interface Purpose {
        /** For all subscribers of the topic. */
        record Publication(String topic) implements Purpose {
            @Override
            public String toString() {
                return "publication on " + topic;
            }
        }

        /** A request to one address. */
        record Request(Address to, String operation) implements Purpose {
            @Override
            public String toString() {
                return "request to " + to + " for " + operation;
            }
        }

        /** A one-way message to one address. */
        record Notice(Address to, String operation) implements Purpose {
            @Override
            public String toString() {
                return "notice to " + to + " for " + operation;
            }
        }

        /**
         * The reply to a request.
         *
         * @param request the sequence number of the request
         */
        record Reply(Address to, String operation, long request) implements Purpose {
            @Override
            public String toString() {
                return "reply to " + to + " for " + operation;
            }
        }

        /** Rejects a request; sent in place of a reply. */
        record Rejection(Address to, String operation, long request) implements Purpose {
            @Override
            public String toString() {
                return "rejection to " + to + " for " + operation;
            }
        }
    }

    /**
     * The reason why a request has no reply; its texts are {@linkplain BoundedText bounded}. There may be further kinds
     * in later versions: an observer's {@code switch} needs a {@code default}.
     */
    sealed interface Failure {
        /** The bus could not deliver the request to a request handler. */
        record NotDelivered(String why) implements Failure {
            public NotDelivered {
                why = BoundedText.of(why);
            }
        }

        /** A request handler had received the request, but its reply did not come. */
        record Unanswered(String why) implements Failure {
            public Unanswered {
                why = BoundedText.of(why);
            }
        }

        /** The request handler failed with an error of this class name and message. */
        record Failed(String type, String message) implements Failure {
            public Failed {
                type = BoundedText.of(type);
                message = BoundedText.of(message);
            }
        }
    }
}
