package io.troupe.actor.model;

import io.troupe.actor.ActorEnd;
import io.troupe.actor.Promise;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/** The visible events of one run, in order, and what was reported meanwhile. */
final class History {
    /** Thrown by scripts. */
    static final class Boom extends RuntimeException {
        private static final long serialVersionUID = 1;

        Boom(int id) {
            super("Boom" + id, null, false, false);
        }
    }

    private static final int LIMIT = 4_000;

    private final List<String> events = new ArrayList<>();
    private final List<String> unheard = new ArrayList<>();

    void add(String event) {
        if (!isFull()) {
            events.add(event);
        }
    }

    /**
     * Adds the report of a rejection without a listener. Reports come between two passes of the space. Where a pass
     * ends is not part of the contract, so reports keep their order, but not their place among the other events.
     */
    void addUnheard(String what) {
        unheard.add("unheard " + what);
    }

    /** A program may grow without bound; from this point it does nothing more. */
    boolean isFull() {
        return events.size() >= LIMIT;
    }

    /** All events, then all reports. */
    List<String> events() {
        return Stream.concat(events.stream(), unheard.stream()).toList();
    }

    static String outcome(Promise<?> promise) {
        return !promise.isDone() ? "pending" : outcome(promise.getNow(), promise.error());
    }

    static String outcome(@Nullable Object value, @Nullable Throwable error) {
        return error == null ? "=" + text(value) : "!" + name(error);
    }

    private static @Nullable Object text(@Nullable Object value) {
        return value instanceof ActorEnd end
                ? end instanceof ActorEnd.Failed failed ? "failed with " + name(failed.error()) : "stopped"
                : value;
    }

    static String name(Throwable error) {
        return error instanceof Boom
                ? String.valueOf(error.getMessage())
                : error.getClass().getSimpleName();
    }
}
