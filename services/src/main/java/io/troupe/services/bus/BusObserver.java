package io.troupe.services.bus;

/**
 * Watches a bus.
 *
 * <p><b>Threads.</b> Called on whichever thread sends, delivers, or finds out; it must not wait. <b>Errors.</b> What it
 * throws is logged, and the bus goes on.
 */
@FunctionalInterface
public interface BusObserver {
    /** A message was lost. */
    void lost(Loss loss);

    /** A message was sent from here, or has come here from another node; before it is delivered. */
    default void passed(Message message) {}

    /** An answerer failed. The asker is told the error's name and message; the error itself stays here. */
    default void failed(Message question, Throwable error) {}

    /**
     * Logs losses as warnings; of the values that a subscription drops the first, the second, the fourth, and so on.
     */
    static BusObserver logging() {
        return new LoggingObserver();
    }
}
