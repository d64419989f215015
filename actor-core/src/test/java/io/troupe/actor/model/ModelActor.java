package io.troupe.actor.model;

import io.troupe.actor.MailboxBound.Overflow;
import io.troupe.actor.Supervision.Directive;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/** An actor of the model: its mailbox bound, its instances and its failures. */
final class ModelActor {
    /** One instance, from its start to its end. */
    static final class Instance {
        final ModelActor actor;
        final String name;
        boolean over;

        Instance(ModelActor actor, String name) {
            this.actor = actor;
            this.name = name;
        }
    }

    /** A call that waits; a request has a promise. */
    private record Call(int id, @Nullable ModelPromise answer) {}

    private final ModelRun run;
    private final ModelSpace space;
    private final Act born;
    private final Cast cast;
    private final String name;
    private final List<Call> waiting = new ArrayList<>();
    private final List<Long> failures = new ArrayList<>();
    private @Nullable Instance instance;
    private boolean begun;
    private boolean stopped;
    final ModelPromise ended;

    ModelActor(ModelRun run, Act born) {
        this.run = run;
        this.space = run.space;
        this.born = born;
        this.cast = Cast.of(born.number());
        this.name = "A" + born.target();
        this.ended = new ModelPromise(space, true, false);
    }

    /** @param handler what the actor does with the call */
    void send(int id, @Nullable ModelPromise answer, java.util.function.Consumer<Instance> handler) {
        var call = new Call(id, answer);
        if (cast.capacity() > 0 && waiting.size() >= cast.capacity()) {
            if (cast.overflow() != Overflow.DROP_OLDEST) {
                drop(call);
                return;
            }
            space.history.unsettled();
            drop(waiting.removeFirst());
        }
        waiting.add(call);
        space.enqueue(new ModelSpace.Task(true, false, () -> deliver(call, handler)));
    }

    private void drop(Call call) {
        turnAway(call, "!MailboxFullException", "full");
    }

    private void turnAway(Call call, String error, String reason) {
        if (call.answer != null) {
            call.answer.settle(error);
        } else {
            space.history.add("dead letter " + call.id + " to " + name + ": " + reason);
        }
    }

    private void deliver(Call call, java.util.function.Consumer<Instance> handler) {
        if (!begun && !stopped) {
            space.history.knownError(); // is said to have stopped
        }
        boolean dropped = waiting.stream().noneMatch(each -> each == call);
        waiting.removeIf(each -> each == call);
        if (dropped || call.answer != null && call.answer.isDone()) {
            return;
        }
        begin();
        Instance now = instance;
        if (now == null) {
            turnAway(call, "!ActorStoppedException", space.closing ? "closed" : "stopped");
        } else {
            guarded(now, () -> handler.accept(now));
        }
    }

    /** What it throws is a failure. */
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
            space.atTheEnd(this::stop);
        } else if (cast.directive() == Directive.RESTART) {
            space.atTheEnd(this::restart);
        }
    }

    /** Whichever comes first, the turn of the spawn or, if the proxy was faster, that of a call. */
    void begin() {
        if (!begun && !stopped) {
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
            if (!begun) {
                space.history.knownError(); // is started nevertheless
            }
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
