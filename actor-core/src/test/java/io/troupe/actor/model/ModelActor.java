package io.troupe.actor.model;

import io.troupe.actor.MailboxBound.Overflow;
import io.troupe.actor.Supervision.Directive;
import io.troupe.actor.model.Act.Cast;
import io.troupe.actor.model.ModelSpace.Task;
import io.troupe.actor.model.ModelSpace.Timer;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;
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
        final List<Timer> timers = new ArrayList<>();
        final List<OpenRequest> openRequests = new ArrayList<>();
        boolean over;

        Instance(ModelActor actor, String name) {
            this.actor = actor;
            this.name = name;
        }
    }

    /**
     * A queued call.
     *
     * @param answer of a request
     * @param callback among its arguments
     * @param handler what the actor does with it
     */
    record Call(
            int id, @Nullable ModelPromise answer, @Nullable ModelStream callback, Consumer<Instance> handler) {
        void failCallback(String error) {
            if (callback != null) {
                callback.abandon(error);
            }
        }
    }

    private final ModelRun run;
    private final ModelSpace space;
    private final Act born;
    private final Cast cast;
    private final String name;
    private final List<Call> mailbox = new ArrayList<>();
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
        this.ended = ModelPromise.shared(space, true);
    }

    private boolean dropsOldest() {
        return cast.capacity() > 0 && cast.overflow() == Overflow.DROP_OLDEST;
    }

    void send(Call call) {
        if (cast.capacity() == 0 || mailbox.size() < cast.capacity()) {
            mailbox.add(call);
            space.enqueue(Task.call(() -> deliver(call)));
        } else if (dropsOldest()) {
            mailbox.add(call); // delivered for the entry of another call
            turnAway(mailbox.removeFirst(), "MailboxFullException", "full");
        } else {
            turnAway(call, "MailboxFullException", "full");
        }
    }

    private void deliver(Call queued) {
        begin();
        Call call = dropsOldest() ? mailbox.removeFirst() : queued;
        mailbox.removeIf(each -> each == call);
        Instance now = instance;
        if (call.answer != null && call.answer.isDone()) {
            call.failCallback("CancellationException");
        } else if (now == null) {
            turnAway(call, "ActorStoppedException", space.stopping ? "closed" : "stopped");
        } else {
            guarded(now, () -> call.handler.accept(now));
        }
    }

    /** Rejects a call: notifies its sender and its callback. */
    private void turnAway(Call call, String error, String reason) {
        if (call.answer != null) {
            call.answer.settle("!" + error);
        } else {
            space.history.add("dead letter " + call.id + " to " + name + ": " + reason);
        }
        call.failCallback(error);
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
        long now = space.now;
        failures.removeIf(each -> each <= now - cast.windowTicks());
        failures.add(now);
        if (cast.limit() >= 0 && failures.size() > cast.limit() || cast.directive() == Directive.STOP) {
            space.ends.add(this::stop);
        } else if (cast.directive() == Directive.RESTART) {
            space.ends.add(this::restart);
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
            instance.timers.forEach(Timer::cancel);
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
