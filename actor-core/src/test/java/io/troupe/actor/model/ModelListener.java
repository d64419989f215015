package io.troupe.actor.model;

import io.troupe.actor.model.Act.Kind;
import io.troupe.actor.model.ModelActor.Instance;
import org.jspecify.annotations.Nullable;

/** A listener of the model and the promise of its result. */
final class ModelListener implements ModelPromise.Listener {
    private final ModelRun run;
    private final ModelSpace space;
    private final ModelPromise source;
    private final Act act;
    private final @Nullable Instance self;
    private final @Nullable Instance owner;
    final ModelPromise result;

    ModelListener(ModelRun run, ModelPromise source, Act act, @Nullable Instance self) {
        this.run = run;
        this.space = run.space;
        this.source = source;
        this.act = act;
        this.self = self;
        this.owner = space.inside ? space.current : null;
        this.result = ModelPromise.local(space, space.inside || source.atHome);
    }

    /**
     * The source is settled: from now on the listener is in its callback queue. A listener without a space is queued in
     * the space of the thread that settles the source, if there is one.
     */
    @Override
    public void tell() {
        if (result.atHome || space.inside) {
            space.enqueue(ModelTask.callback(this::takeTurn));
        } else {
            space.runDetached(this::takeTurn);
        }
    }

    @Override
    public void tellBehind() {
        if (result.atHome) {
            space.enqueueBehind(ModelTask.callback(this::takeTurn));
        } else {
            tell();
        }
    }

    @Override
    public boolean hasTurn() {
        return true;
    }

    @Override
    public boolean isIdle() {
        return result.isDone();
    }

    @Override
    public boolean isAtHome() {
        return result.atHome;
    }

    private void takeTurn() {
        source.arrived();
        if (result.isDone()) {
            return;
        }
        String outcome = String.valueOf(source.outcome());
        if (owner == null) {
            hear(outcome);
        } else if (owner.over) {
            result.settle(ModelPromise.isError(outcome) ? outcome : "!CancellationException");
        } else {
            space.as(owner, () -> hear(outcome));
        }
    }

    private void hear(String outcome) {
        boolean error = ModelPromise.isError(outcome);
        boolean passesBy = error ? act.kind() == Kind.THEN || act.kind() == Kind.COMPOSE : act.kind() == Kind.RESCUE;
        if (passesBy) {
            result.settle(outcome);
            return;
        }
        try {
            space.history.add("listener " + act.id() + " of " + ModelRun.name(self) + " hears " + outcome);
            run.play(act.script(), self);
        } catch (History.Boom boom) {
            result.settle("!" + boom.getMessage());
            return;
        }
        switch (act.kind()) {
            case WHEN -> result.settle(outcome);
            case COMPOSE -> run.promises.follow(result, act.number(), act.id());
            default -> result.settle("=" + act.id());
        }
    }
}
