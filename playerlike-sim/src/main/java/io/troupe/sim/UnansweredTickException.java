package io.troupe.sim;

import java.time.Duration;
import java.util.List;
import java.util.stream.Collectors;

/** A client did not answer a tick in time, in lock step; the message names the client. */
public final class UnansweredTickException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    UnansweredTickException(long tick, Duration limit, List<ClientConnection> silent) {
        super("tick " + tick + " was not answered within " + limit + " by "
                + silent.stream().map(ClientConnection::toString).collect(Collectors.joining(", "))
                + ": a client answers by readAll(), by isDataReady() being false, or by its actor space becoming idle");
    }
}
