package io.troupe.broker;

/**
 * No provider can meet a need. The message names the service, the client, what is registered (the first 20 and the
 * number of others), and a similar name.
 *
 * <p>Users meet it as the error of {@link Broker#require} and {@link Broker#connect}, and in
 * {@link Broker.Connection#lost}.
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
