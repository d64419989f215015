package io.troupe.services.broker;

import org.jspecify.annotations.Nullable;

/** A provider did not do what it was asked for; the message names it, what it was asked, and what came instead. */
public final class ProviderException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final boolean overdue;

    /** For providers themselves, too: their users are told the message without the name of a class. */
    public ProviderException(String message) {
        this(message, null);
    }

    /** The same with a cause. */
    public ProviderException(String message, @Nullable Throwable cause) {
        this(message, cause, false);
    }

    private ProviderException(String message, @Nullable Throwable cause, boolean overdue) {
        super(message, cause);
        this.overdue = overdue;
    }

    /**
     * For providers with a time limit of their own: one that has not answered within it. Any other rejection says that
     * it has not done it, and will not.
     */
    public static ProviderException overdue(String message, @Nullable Throwable cause) {
        return new ProviderException(message, cause, true);
    }

    /** Whether it has simply not answered in time, so that it may have done it, or do it later. */
    public boolean isOverdue() {
        return overdue;
    }
}
