package io.troupe.services.broker;

/** Errors in the midst of a sentence. */
final class Reasons {
    private Reasons() {}

    /** On one line; our own errors by their message alone. */
    static String of(Throwable error) {
        boolean ours = error instanceof ProviderException || error instanceof MissingServiceException;
        return oneLine(String.valueOf(ours ? error.getMessage() : error));
    }

    static String oneLine(String text) {
        return text.replaceAll("\\s*\\R\\s*", " ");
    }
}
