package io.troupe.actor.promise;

/** A settled state that is not the value itself. */
abstract class SettledState {
    /** Wraps a value that would be mistaken for another state. */
    static final class Boxed extends SettledState {
        private final Object value;

        Boxed(Object value) {
            this.value = value;
        }

        Object value() {
            return value;
        }
    }
}
