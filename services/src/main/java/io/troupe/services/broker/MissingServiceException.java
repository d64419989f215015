package io.troupe.services.broker;

/**
 * Nobody offers what is needed. The message names the service, who needs it, what is registered (the first 20, and how
 * many more), and what is similar.
 */
public final class MissingServiceException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final transient Need need;

    public MissingServiceException(Need need, String message) {
        super(message);
        this.need = need;
    }

    public Need need() {
        return need;
    }
}
