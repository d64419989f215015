package io.troupe.bus.internal;

/**
 * A promise that a request handler of this library answers one request with. The bus cancels it, and with it the work,
 * when no requester waits for it any more.
 */
public interface CancellableAnswer {
    /** Cancels the promise. */
    boolean cancel();
}
