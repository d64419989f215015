package io.troupe.broker;

import io.troupe.actor.Unanswered;
import org.jspecify.annotations.Nullable;

/**
 * A provider failed to start, stop or pass a check. The message names the provider, the call and the problem.
 *
 * <p>Users meet it as the error of {@link Broker#replace} and {@link Broker#withdraw}, and in {@link BrokerEvent}s.
 */
public final class ProviderException extends RuntimeException implements Unanswered {
    private static final long serialVersionUID = 1L;

    private final boolean overdue;
    private final boolean mayStillRun;

    /** May be used by providers themselves: the broker's messages then show only the text, without a class name. */
    public ProviderException(String message) {
        this(message, null);
    }

    /** The same with a cause. */
    public ProviderException(String message, @Nullable Throwable cause) {
        this(message, cause, false, false);
    }

    private ProviderException(String message, @Nullable Throwable cause, boolean overdue, boolean mayStillRun) {
        super(message, cause);
        this.overdue = overdue;
        this.mayStillRun = mayStillRun;
    }

    /**
     * For providers with a time limit of their choice: the operation was not answered within it. Any other rejection
     * means that the operation was not carried out and will not be.
     */
    public static ProviderException overdue(String message, @Nullable Throwable cause) {
        return new ProviderException(message, cause, true, true);
    }

    /**
     * For a start that failed, or a provider that has failed while it ran, if a part of it may still run: the broker
     * stops it.
     */
    public static ProviderException mayStillRun(String message, @Nullable Throwable cause) {
        return new ProviderException(message, cause, false, true);
    }

    /** True if the operation timed out. */
    @Override
    public boolean mayHaveRun() {
        return overdue;
    }

    /**
     * Returns whether the provider may run although the operation failed: it timed out, or the provider has reported
     * that.
     */
    public boolean mayStillRun() {
        return mayStillRun;
    }
}
