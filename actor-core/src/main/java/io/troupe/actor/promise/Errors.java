package io.troupe.actor.promise;

import java.util.concurrent.CompletionException;

/** Small rules about throwables. */
final class Errors {
    private Errors() {}

    static Throwable unwrapCompletion(Throwable error) {
        return error instanceof CompletionException && error.getCause() != null ? error.getCause() : error;
    }

    /** An error of the virtual machine itself is reported, though it rejects a promise too. */
    static void rethrowIfOfTheMachine(Throwable error) {
        if (error instanceof VirtualMachineError broken
                && !(error instanceof StackOverflowError)
                && !(error instanceof OutOfMemoryError)) {
            throw broken;
        }
    }

    /** Throws the error as it is; the answer's type lets the caller write {@code throw}. */
    static RuntimeException rethrow(Throwable error) {
        return Errors.<RuntimeException>sneak(error);
    }

    @SuppressWarnings("unchecked")
    private static <E extends Throwable> E sneak(Throwable error) throws E {
        throw (E) error;
    }
}
