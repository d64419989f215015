package io.troupe.actor.model;

import io.troupe.actor.Supervision.Directive;
import io.troupe.actor.model.ModelMailbox.Call;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/** An actor of the model: its mailbox, its instances and its failures. */
final class ModelActor {
    /** A request that has begun; if its result was settled outside, the outcome may still be queued. */
    record OpenRequest(ModelPromise request, ModelPromise answer) {
        void reject() {
            if (!answer.isDone()) {
                request.settle("!ActorStoppedException");
            }
        }
    }

    /** One instance, from its start to its end. */
    static final class Instance {
        final ModelActor actor;
        final String name;
        final List<ModelTimers.Timer> timers = new ArrayList<>();
        final List<OpenRequest> openRequests = new ArrayList<>();
        boolean over;

        Instance(ModelActor actor, String name) {
            this.actor = actor;
            this.name = name;
        }
    }

    private final ModelRun run;
    private final ModelSpace space;
    private final Act born;
    private final Cast cast;
    private final String name;
    private final ModelMailbox mailbox;
    private final List<Long> failures = new ArrayList<>();
    private final ModelPromise ended;
    private @Nullable Instance instance;
    private boolean begun;
    private boolean stopped;

    ModelActor(ModelRun run, Act born) {
        this.run = run;
        this.space = run.space;
        this.born = born;
        this.cast = Cast.of(born.number());
        this.name = "A" + born.target();
        this.mailbox = new ModelMailbox(cast);
        this.ended = ModelPromise.shared(space, true);
    }

    void send(Call call) {
        mailbox.add(
                call,
                () -> space.enqueue(ModelTask.call(() -> deliver(call))),
                dropped -> dropped.turnAway(space, name, "MailboxFullException", "full"));
    }

    private void deliver(Call queued) {
        begin();
        Call call = mailbox.take(queued);
        Instance now = instance;
        if (call.isCancelled()) {
            call.failCallback("CancellationException");
        } else if (now == null) {
            call.turnAway(space, name, "ActorStoppedException", space.stopping ? "closed" : "stopped");
        } else {
            guarded(now, () -> call.handler().accept(now));
        }
    }

    /** Each watcher has a separate promise. */
    ModelPromise watch() {
        var own = ModelPromise.shared(space, true);
        own.follow(ended);
        return own;
    }

    /** Runs an action; an exception is a failure. */
    void guarded(Instance who, Runnable action) {
        space.as(who, () -> {
            try {
                action.run();
            } catch (History.Boom boom) {
                failed(String.valueOf(boom.getMessage()));
            }
        });
    }

    private void failed(String error) {
        space.history.add((cast.ownHandler() ? "own handler: failed " : "failed ") + name + " " + error);
        if (stopped) {
            return;
        }
        long now = space.timers.now;
        failures.removeIf(each -> each <= now - cast.windowTicks());
        failures.add(now);
        if (cast.limit() >= 0 && failures.size() > cast.limit() || cast.directive() == Directive.STOP) {
            space.afterTurn(this::stop);
        } else if (cast.directive() == Directive.RESTART) {
            space.afterTurn(this::restart);
        }
    }

    /**
     * Starts the actor in the turn of its spawn or of an earlier call, whichever comes first; starts nothing after the
     * space has stopped.
     */
    void begin() {
        if (!begun && !stopped && !space.stopping) {
            begun = true;
            start();
        }
    }

    private void start() {
        space.living.add(this);
        int number = run.nextInstance(born.target());
        var fresh = new Instance(this, name + "#" + number);
        if (number == cast.failingInstance()) {
            failed("Boom" + born.id());
            stop();
            return;
        }
        instance = fresh;
        space.history.add(fresh.name + " starts");
        guarded(fresh, () -> run.play(born.script(), fresh));
    }

    void stop() {
        if (!stopped) {
            stopped = true;
            space.living.remove(this);
            endInstance();
            ended.settle("=null");
        }
    }

    private void endInstance() {
        if (instance != null) {
            space.history.add(instance.name + " ends");
            instance.over = true;
            instance.timers.forEach(ModelTimers.Timer::cancel);
            instance.openRequests.forEach(OpenRequest::reject);
            instance = null;
        }
    }

    private void restart() {
        if (!stopped) {
            endInstance();
            start();
        }
    }
}
