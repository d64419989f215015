package io.troupe.services.broker;

/** Errors in the midst of a sentence. */
final class Reasons {
    private Reasons() {}

    /** On one line; our own errors by their message alone. */
    static String of(Throwable error) {
        String text = error instanceof ProviderException && error.getMessage() != null
                ? error.getMessage()
                : error.toString();
        return oneLine(text);
    }

    static String oneLine(String text) {
        return text.replaceAll("\\s*\\R\\s*", " ");
    }
}
