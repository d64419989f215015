package io.troupe.services.component;

import io.troupe.bus.Address;
import java.lang.System.Logger.Level;

/**
 * Listener for losses and problems of components; used for logs, reports and tests. Their starts, failures and stops
 * are events of the broker.
 *
 * <p><b>Threads.</b> Usually the space of the interface. {@link #dropped}, {@link #problem} and {@link #info} may be
 * called on a thread of the component.
 */
public interface ComponentObserver {
    /**
     * A full buffer has dropped a value.
     *
     * @param total number of values dropped by this buffer so far
     */
    void dropped(Address component, ApplicationData<?> lost, long total);

    /** An operation has failed, and no caller waits for a promise that would report the error. */
    void problem(Address component, String what, Throwable why);

    /** A message from the component or its interface that is not a failure. */
    void info(Address component, String what);

    /** Logs problems, losses and messages. */
    static ComponentObserver logging() {
        var log = System.getLogger(ComponentObserver.class.getName());
        return new ComponentObserver() {
            @Override
            public void dropped(Address component, ApplicationData<?> lost, long total) {
                log.log(Level.WARNING, "{0}: its buffer is full, lost {1} ({2} so far)", component, lost, total);
            }

            @Override
            public void problem(Address component, String what, Throwable why) {
                log.log(Level.WARNING, component + ": " + what, why);
            }

            @Override
            public void info(Address component, String what) {
                log.log(Level.INFO, "{0}: {1}", component, what);
            }
        };
    }
}
