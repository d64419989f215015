package io.troupe.faults.history;

import io.troupe.faults.history.Event.Closed;
import io.troupe.faults.history.Event.StreamEnded;
import io.troupe.faults.history.Event.StreamItem;
import io.troupe.faults.history.Event.StreamOpened;
import io.troupe.faults.history.History.Entry;
import io.troupe.faults.history.Violation.Rule;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/** Streams: items from 1 in order, then one end; all streams of a process that was closed have ended. */
final class StreamRules {
    private static final class State {
        final Entry opened;
        long items;
        boolean hasEnded;

        State(Entry opened) {
            this.opened = opened;
        }
    }

    private final Map<String, State> streams = new LinkedHashMap<>();
    private final Set<String> closed = new HashSet<>();
    private final History history;
    private final Consumer<Violation> violations;

    StreamRules(History history, Consumer<Violation> violations) {
        this.history = history;
        this.violations = violations;
    }

    void check() {
        for (Entry entry : history.entries()) {
            switch (entry.event()) {
                case StreamOpened(String stream, String target, long items) -> streams.put(stream, new State(entry));
                case StreamItem(String stream, long number) -> item(stream, number, entry);
                case StreamEnded(String stream, boolean completely, String outcome) -> ended(stream, completely, entry);
                case Closed last -> closed.add(entry.process());
                default -> {}
            }
        }
        streams.forEach((stream, state) -> {
            if (!state.hasEnded && closed.contains(state.opened.process())) {
                violate(stream, "has no end", List.of(state.opened));
            }
        });
    }

    private void item(String stream, long number, Entry entry) {
        State state = streams.get(stream);
        if (state == null || state.hasEnded || number != state.items + 1) {
            violate(stream, "has item " + number + " at the wrong place", evidence(state, entry));
        }
        if (state != null) {
            state.items = number;
        }
    }

    private void ended(String stream, boolean completely, Entry entry) {
        State state = streams.get(stream);
        if (state == null || state.hasEnded) {
            violate(stream, "has ended twice, or has not begun", evidence(state, entry));
            return;
        }
        state.hasEnded = true;
        long items = ((StreamOpened) state.opened.event()).items();
        if (completely && state.items != items) {
            violate(stream, "ends after " + state.items + " items of " + items, evidence(state, entry));
        }
    }

    private static List<Entry> evidence(@Nullable State state, Entry entry) {
        return state == null ? List.of(entry) : List.of(state.opened, entry);
    }

    private void violate(String stream, String what, List<Entry> evidence) {
        violations.accept(new Violation(Rule.STREAM, "stream " + stream + " " + what, evidence));
    }
}
