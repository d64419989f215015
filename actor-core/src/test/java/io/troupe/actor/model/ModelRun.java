package io.troupe.actor.model;

import io.troupe.actor.model.ModelActor.Instance;
import io.troupe.actor.model.ModelMailbox.Call;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import org.jspecify.annotations.Nullable;

/** Runs a program on the model. */
final class ModelRun {
    final ModelSpace space = new ModelSpace();
    final ModelPromises promises = new ModelPromises(this);
    private final ModelStreams streams = new ModelStreams(this);
    private final Map<Integer, ModelTimers.Timer> timers = new HashMap<>();
    private final Map<Integer, ModelActor> actors = new HashMap<>();
    private final Map<Integer, Integer> instances = new HashMap<>();

    private ModelRun() {}

    static History of(List<Act> program) {
        var run = new ModelRun();
        run.play(program, null);
        run.space.crank();
        run.promises.tell();
        return run.space.history;
    }

    int nextInstance(int actor) {
        return instances.merge(actor, 1, Integer::sum);
    }

    void play(List<Act> acts, @Nullable Instance self) {
        for (Act act : acts) {
            if (!space.history.isFull()) {
                play(act, self);
            }
        }
    }

    private void play(Act act, @Nullable Instance self) {
        switch (act.kind()) {
            case CRANK -> space.crank();
            case ADVANCE -> space.timers.now += act.number();
            case READER -> {}
            case THROW -> throw new History.Boom(act.id());
            case CLOSE -> space.close();
            case EXECUTE, ON_IDLE, SPAWN -> begin(act);
            case DELAY -> promises.delay(act);
            case STOP, WATCH, TELL, ASK, OPEN, FORWARD -> actor(act, self);
            case STOP_SELF, AFTER, EVERY, CANCEL_TIMER -> playAsActor(act, self);
            case NEXT, FINISH, FAIL, CANCEL_STREAM, LOOK_AT_STREAM -> streams.play(act);
            default -> promises.play(act, self);
        }
    }

    /** Begins an act, unless the space is closed and rejects it from outside. */
    private void begin(Act act) {
        if (space.closing && !space.inside) {
            space.history.add("too late: " + act.id());
            return;
        }
        switch (act.kind()) {
            case EXECUTE -> space.execute(() -> space.guarded(() -> task("executes " + act.id(), act)));
            case ON_IDLE -> space.execute(() -> space.whenIdle(() -> task("is idle for " + act.id(), act)));
            default -> {
                var fresh = new ModelActor(this, act);
                actors.put(act.target(), fresh);
                space.enqueue(ModelTask.entry(fresh::begin, fresh::stop));
            }
        }
    }

    private void task(String what, Act act) {
        space.history.add("space " + what);
        play(act.script(), null);
    }

    private void actor(Act act, @Nullable Instance self) {
        ModelActor actor = actors.get(act.target());
        if (actor == null) {
            return;
        }
        switch (act.kind()) {
            case STOP -> space.enqueue(ModelTask.entry(actor::stop, actor::stop));
            case WATCH -> promises.put(act.id(), actor.watch());
            case TELL ->
                actor.send(new Call(act.id(), null, null, instance -> {
                    space.history.add(instance.name + " is told " + act.id());
                    play(act.script(), instance);
                }));
            case ASK -> ask(act, actor, "is asked", null);
            case OPEN -> {
                var callback = streams.reader(act, self);
                if (act.isRequest()) {
                    ask(act, actor, "streams for", callback);
                } else {
                    sendStream(act, actor, callback);
                }
            }
            default -> {
                ModelStream handle = streams.handle(act.id());
                if (handle != null) {
                    sendStream(act, actor, handle);
                }
            }
        }
    }

    private void sendStream(Act act, ModelActor actor, ModelStream stream) {
        actor.send(new Call(act.id(), null, stream, instance -> {
            space.history.add(instance.name + " streams " + act.id());
            streams.arrive(act.id(), stream);
            play(act.script(), instance);
        }));
    }

    private void ask(Act act, ModelActor actor, String how, @Nullable ModelStream callback) {
        var request = ModelPromise.request(space);
        actor.send(new Call(act.id(), request, callback, instance -> {
            space.history.add(instance.name + " " + how + " " + act.id());
            if (callback != null) {
                streams.arrive(act.id(), callback);
            }
            try {
                play(act.script(), instance);
                promises.answer(act, request, instance);
            } catch (History.Boom boom) {
                request.settle("!" + boom.getMessage());
            }
        }));
        promises.put(act.id(), request);
    }

    private void playAsActor(Act act, @Nullable Instance self) {
        if (self == null) {
            return;
        }
        switch (act.kind()) {
            case STOP_SELF -> space.afterTurn(self.actor::stop);
            case AFTER -> setTimer(act, self, 0);
            case EVERY -> setTimer(act, self, act.number());
            default -> {
                var timer = timers.get(act.target());
                if (timer != null) {
                    space.history.add("timer " + act.target() + " cancelled: " + timer.cancel());
                }
            }
        }
    }

    private void setTimer(Act act, Instance self, int period) {
        var timer = new ModelTimers.Timer[1];
        timer[0] = space.timers.set(
                act.number(),
                period,
                () -> {
                    if (self.over) {
                        timer[0].cancel();
                        return;
                    }
                    self.actor.guarded(self, () -> {
                        space.history.add("timer " + act.id() + " of " + self.name);
                        play(act.script(), self);
                    });
                },
                () -> {});
        timers.put(act.id(), timer[0]);
        self.timers.add(timer[0]);
    }

    static String name(@Nullable Instance self) {
        return self == null ? "nobody" : self.name;
    }
}
