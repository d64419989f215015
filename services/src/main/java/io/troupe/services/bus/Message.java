package io.troupe.services.bus;

/**
 * What crosses the bus: this, and nothing else.
 *
 * <p><b>Role.</b> A bus between processes writes exactly these records; all in them are names, numbers and records of
 * values.
 *
 * <p><b>Source.</b> Paper, section 2.2.3: control messages manage services, data messages are their input and output.
 */
public sealed interface Message permits DataMessage, ControlMessage {
    Address from();

    Purpose purpose();

    /** Counts the messages of one node, all ports together, upward from 1. */
    long sequence();

    /** A value of the topic or the operation; a {@link Failure} in a refusal. */
    Record payload();

    /** A message of that kind. */
    static Message of(Operation.Kind kind, Address from, Purpose purpose, long sequence, Record payload) {
        return switch (kind) {
            case DATA -> new DataMessage(from, purpose, sequence, payload);
            case CONTROL -> new ControlMessage(from, purpose, sequence, payload);
        };
    }

    /** The kind of operation that it belongs to; publications are data. */
    default Operation.Kind kind() {
        return switch (this) {
            case DataMessage data -> Operation.Kind.DATA;
            case ControlMessage control -> Operation.Kind.CONTROL;
        };
    }

    /** What a message is for, and with that to whom it goes. */
    sealed interface Purpose {
        /** For all who subscribe to the topic. */
        record Publication(String topic) implements Purpose {
            @Override
            public String toString() {
                return "publication on " + topic;
            }
        }

        /** For one, who is to answer. */
        record Question(Address to, String operation) implements Purpose {
            @Override
            public String toString() {
                return "question to " + to + " for " + operation;
            }
        }

        /**
         * For the one who asked.
         *
         * @param question the sequence number of the question
         */
        record Answer(Address to, String operation, long question) implements Purpose {
            @Override
            public String toString() {
                return "answer to " + to + " for " + operation;
            }
        }

        /** For the one who asked, in place of an answer. */
        record Refusal(Address to, String operation, long question) implements Purpose {
            @Override
            public String toString() {
                return "refusal to " + to + " for " + operation;
            }
        }
    }

    /** Why there is no answer. */
    sealed interface Failure {
        /** The bus could not bring the question to somebody who answers. */
        record NotDelivered(String why) implements Failure {}

        /** The answerer failed: the class name and the message of its error. */
        record Failed(String type, String message) implements Failure {}
    }
}
