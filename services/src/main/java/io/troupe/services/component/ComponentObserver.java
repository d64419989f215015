package io.troupe.services.component;

import io.troupe.services.bus.Address;
import java.lang.System.Logger.Level;

/**
 * Hears what becomes of components: for people, for logs, for tests.
 *
 * <p><b>Threads.</b> Mostly the space of the interface; {@link #dropped}, {@link #problem} and {@link #told} may come
 * from a thread of the component.
 */
public interface ComponentObserver {
    /** Writes problems and losses to the log, and nothing else. */
    ComponentObserver LOG = new ComponentObserver() {
        @Override
        public void dropped(Address component, ApplicationData<?> lost, long total) {
            log().log(Level.WARNING, "{0}: its buffer is full, lost {1} ({2} so far)", component, lost, total);
        }

        @Override
        public void problem(Address component, String what, Throwable why) {
            log().log(Level.WARNING, component + ": " + what, why);
        }

        @Override
        public void told(Address component, String what) {
            log().log(Level.INFO, "{0}: {1}", component, what);
        }

        private System.Logger log() {
            return System.getLogger(ComponentObserver.class.getName());
        }
    };

    /** The component has come into another state. */
    default void changed(Address component, Lifecycle state) {}

    /** A buffer was full. */
    void dropped(Address component, ApplicationData<?> lost, long total);

    /** Something failed, and nobody waits for an answer that would say so. */
    void problem(Address component, String what, Throwable why);

    /** The component, or its interface, has something to say. */
    void told(Address component, String what);
}
