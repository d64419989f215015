package io.troupe.broker;

import io.troupe.bus.BusException;
import io.troupe.bus.internal.BoundedText;

/** Formats errors as part of a sentence. */
final class Reasons {
    private Reasons() {}

    /** The error on one line; exceptions of the broker by their message only. */
    static String of(Throwable error) {
        boolean ours = error instanceof ProviderException
                || error instanceof MissingServiceException
                || error instanceof BusException;
        return oneLine(ours ? String.valueOf(error.getMessage()) : BoundedText.of(error));
    }

    static String oneLine(String text) {
        return text.replaceAll("\\s*\\R\\s*", " ");
    }
}
