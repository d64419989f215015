package io.troupe.actor.promise;

import java.util.concurrent.CompletionException;

/** Utilities for throwables. */
final class Errors {
    private Errors() {}

    static Throwable unwrapCompletion(Throwable error) {
        return error instanceof CompletionException && error.getCause() != null ? error.getCause() : error;
    }

    /**
     * Rethrows an error of the virtual machine, except a stack overflow or an out-of-memory error: it is reported
     * although it also rejects a promise.
     */
    static void rethrowIfOfTheMachine(Throwable error) {
        if (error instanceof VirtualMachineError broken
                && !(error instanceof StackOverflowError)
                && !(error instanceof OutOfMemoryError)) {
            throw broken;
        }
    }

    /** Throws the error unchanged; the return type lets the caller write {@code throw}. */
    static RuntimeException rethrow(Throwable error) {
        return Errors.<RuntimeException>sneak(error);
    }

    @SuppressWarnings("unchecked")
    private static <E extends Throwable> E sneak(Throwable error) throws E {
        throw (E) error;
    }
}
