package io.troupe.actor.model;

import io.troupe.actor.Callback;
import java.util.HashMap;
import java.util.Map;
import org.jspecify.annotations.Nullable;

/** The callbacks of a program that runs on the library. */
final class LibraryStreams {
    private final LibraryRun run;
    private final Map<Integer, Callback<Integer>> handles = new HashMap<>();
    private final Map<Integer, Callback.Stream<Integer>> readers = new HashMap<>();

    LibraryStreams(LibraryRun run) {
        this.run = run;
    }

    @Nullable
    Callback<Integer> handle(int id) {
        return handles.get(id);
    }

    /** The callback has arrived at the actor. */
    void arrive(int id, Callback<Integer> handle) {
        handles.put(id, handle);
    }

    Callback<Integer> reader(Act act, @Nullable Peer self) {
        String who = "stream " + act.id() + " of " + LibraryRun.name(self);
        var script = act.reader().script();
        if (!act.isCancellable()) {
            return (value, error) -> {
                run.history.add(who + " hears " + History.outcome(value, error));
                if (error == null) {
                    run.play(script, self);
                }
            };
        }
        var stream = new Callback.Stream<Integer>(
                value -> {
                    run.history.add(who + " hears =" + value);
                    run.play(script, self);
                },
                end -> run.history.add(who + " ends " + (end == null ? "well" : History.name(end))));
        readers.put(act.id(), stream);
        return stream;
    }

    void play(Act act) {
        Callback<Integer> handle = handles.get(act.target());
        Callback.Stream<Integer> reader = readers.get(act.target());
        if (act.kind() == Act.Kind.CANCEL_STREAM) {
            if (reader != null) {
                reader.cancel();
            }
            return;
        }
        if (handle == null) {
            return;
        }
        try {
            switch (act.kind()) {
                case NEXT -> {
                    for (int i = 0; i < act.number(); i++) {
                        handle.next(i);
                    }
                }
                case FINISH -> handle.finish();
                case FAIL -> handle.fail(new History.Boom(act.id()));
                default -> run.history.add("stream " + act.target() + " cancelled: " + handle.isCancelled());
            }
        } catch (IllegalStateException afterTheEnd) {
            run.history.add("stream " + act.target() + " refuses " + act.id());
        }
    }
}
