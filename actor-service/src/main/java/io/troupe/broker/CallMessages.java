package io.troupe.broker;

import io.troupe.bus.Address;
import io.troupe.bus.Operation;
import io.troupe.bus.internal.BoundedText;
import io.troupe.bus.internal.CborItem;

/** The messages between a connection and an actor in another process, in the form of {@code docs/wire-format.md}. */
final class CallMessages {
    /**
     * A call of a method.
     *
     * @param caller the port that receives the streams of its callbacks
     * @param method its name and the simple names of its parameter types, for example {@code greet(String, List)}
     * @param arguments an array; in place of a callback a {@link StreamNumber}
     */
    record Call(Address caller, String method, CborItem arguments) {}

    /** The value of the promise that the method returned. */
    record Result(CborItem value) {}

    /** Takes the place of a callback among the arguments. */
    record StreamNumber(long stream) {}

    /** @param number counts the parts of the stream, from 1 */
    record StreamPart(long stream, long number, Part part) {}

    /** What a stream carries. */
    sealed interface Part {}

    record Item(CborItem value) implements Part {}

    record End() implements Part {}

    /** The end with an error of this class name and message, which are {@linkplain BoundedText bounded}. */
    record Failed(String type, String message) implements Part {
        Failed {
            type = BoundedText.of(type);
            message = BoundedText.of(message);
        }
    }

    /** @param wantsMore false if the stream has ended for its reader */
    record Received(boolean wantsMore) {}

    /** To the address of the actor. */
    static final Operation<Call, Result> CALL = new Operation<>("call", Call.class, Result.class, Operation.Kind.DATA);

    /** To the port of the caller. */
    static final Operation<StreamPart, Received> STREAM =
            new Operation<>("stream", StreamPart.class, Received.class, Operation.Kind.DATA);

    private CallMessages() {}
}
