package io.troupe.actor.model;

import io.troupe.actor.model.Act.Kind;
import io.troupe.actor.model.ModelActor.Instance;
import java.util.HashMap;
import java.util.Map;
import org.jspecify.annotations.Nullable;

/** The callbacks of a program that runs on the model. */
final class ModelStreams {
    private final ModelRun run;
    private final Map<Integer, ModelStream> handles = new HashMap<>();
    private final Map<Integer, ModelStream> readers = new HashMap<>();

    ModelStreams(ModelRun run) {
        this.run = run;
    }

    @Nullable
    ModelStream handle(int id) {
        return handles.get(id);
    }

    /** The callback has arrived at the actor. */
    void arrive(int id, ModelStream handle) {
        handles.put(id, handle);
    }

    ModelStream reader(Act act, @Nullable Instance self) {
        String who = "stream " + act.id() + " of " + ModelRun.name(self);
        var stream = new ModelStream(
                run.space, act.isCancellable(), who, () -> run.play(act.reader().script(), self));
        if (act.isCancellable()) {
            readers.put(act.id(), stream);
        }
        return stream;
    }

    void play(Act act) {
        if (act.kind() == Kind.CANCEL_STREAM) {
            ModelStream reader = readers.get(act.target());
            if (reader != null) {
                reader.cancel();
            }
            return;
        }
        ModelStream handle = handles.get(act.target());
        if (handle == null) {
            return;
        }
        if (act.kind() == Kind.LOOK_AT_STREAM) {
            run.space.history.add("stream " + act.target() + " cancelled: " + handle.isCancelled());
            return;
        }
        int times = act.kind() == Kind.NEXT ? act.number() : 1;
        for (int i = 0; i < times; i++) {
            if (handle.hasEnded()) {
                run.space.history.add("stream " + act.target() + " refuses " + act.id());
                return;
            }
            switch (act.kind()) {
                case NEXT -> handle.next(i);
                case FINISH -> handle.finish();
                default -> handle.fail("Boom" + act.id());
            }
        }
    }
}
