package io.troupe.bench.bus;

import java.util.function.BooleanSupplier;

/** Two connections to the same server, one for each side. */
interface BusPair extends AutoCloseable {
    int RECORDS = 4 * PassingWindow.SIZE;

    /** Sends requests with a text of that many bytes, each after the reply to the one before, as long as asked to. */
    void askWhile(int payloadBytes, BooleanSupplier again) throws Exception;

    /** Publishes {@value #RECORDS} sonar records, and waits until the subscriber has received all. */
    void publishAll() throws Exception;

    @Override
    void close();
}
