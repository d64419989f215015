package io.troupe.actor.promise;

/** What stands in a promise's state and is not the value itself. */
abstract class Special {
    /** A value that would be mistaken for something else. */
    static final class Boxed extends Special {
        private final Object value;

        Boxed(Object value) {
            this.value = value;
        }

        Object value() {
            return value;
        }
    }
}
