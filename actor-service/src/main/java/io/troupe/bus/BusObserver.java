package io.troupe.bus;

/**
 * Observes the messages and losses of one node of a bus.
 *
 * {@snippet :
 * var settings = BusSettings.on(space).withCapacity(2).withObserver(loss -> show(loss));
 * }
 *
 * <p><b>Threads.</b> Called on the thread that sends, delivers or detects the event; it must not block. <b>Errors.</b>
 * Its exceptions are logged and do not affect the bus.
 */
@FunctionalInterface
public interface BusObserver {
    /** A message was lost. */
    void lost(Loss loss);

    /** A message was sent from this node, or has arrived from another node. Called before delivery. */
    default void passed(BusMessage message) {}

    /**
     * A request handler failed. The requester gets only the class name and message of the error; the error itself stays
     * on this node.
     */
    default void failed(BusMessage request, Throwable error) {}

    /** The connection to other nodes has ended. Called once until {@link #connected}. */
    default void disconnected(String why) {}

    /** The connection to other nodes is there again. */
    default void connected() {}

    /** Logs losses as warnings. Of the values that a subscription drops, it logs number 1, 2, 4, 8 and so on. */
    static BusObserver logging() {
        return new LoggingObserver();
    }
}
