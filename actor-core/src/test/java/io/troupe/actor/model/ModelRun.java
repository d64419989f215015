package io.troupe.actor.model;

import io.troupe.actor.model.Act.Answer;
import io.troupe.actor.model.Act.Kind;
import io.troupe.actor.model.ModelActor.Instance;
import io.troupe.actor.model.ModelSpace.Task;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import org.jspecify.annotations.Nullable;

/** Runs a program on the model. */
final class ModelRun {
    final ModelSpace space;
    private final Map<Integer, ModelPromise> promises = new TreeMap<>();
    private final Map<Integer, ModelStream> handles = new HashMap<>();
    private final Map<Integer, ModelStream> readers = new HashMap<>();
    private final Map<Integer, ModelTimers.Timer> timers = new HashMap<>();
    private final Map<Integer, ModelActor> actors = new HashMap<>();
    private final Map<Integer, Integer> instances = new HashMap<>();

    private ModelRun(ModelSpace.End end) {
        space = new ModelSpace(end);
    }

    static History of(List<Act> program, ModelSpace.End end) {
        var run = new ModelRun(end);
        run.play(program, null);
        run.space.crank();
        run.promises.forEach((id, promise) ->
                run.space.history.add("promise " + id + " " + (promise.isDone() ? promise.outcome() : "pending")));
        run.space.history.add("close");
        run.space.close();
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
            case EXECUTE -> space.enqueue(Task.entry(() -> space.guarded(() -> task("executes " + act.id(), act))));
            case ON_IDLE -> space.enqueue(Task.entry(() -> space.whenIdle(() -> task("is idle for " + act.id(), act))));
            case DELAY -> delay(act);
            case SPAWN, STOP, WATCH, TELL, ASK, OPEN, FORWARD -> actor(act, self);
            case STOP_SELF, AFTER, EVERY, CANCEL_TIMER -> playAsActor(act, self);
            case NEXT, FINISH, FAIL, CANCEL_STREAM, LOOK_AT_STREAM -> stream(act);
            default -> promise(act, self);
        }
    }

    private void task(String what, Act act) {
        space.history.add("space " + what);
        play(act.script(), null);
    }

    private void delay(Act act) {
        var promise = new ModelPromise(space, true, false);
        promises.put(act.id(), promise);
        long deadline = space.timers.now + act.number();
        space.pendingDelays++;
        Runnable set = () -> space.timers.set(deadline - space.timers.now, 0, () -> {
            space.pendingDelays--;
            promise.settle("=null");
        });
        if (space.inside) {
            set.run();
        } else {
            space.enqueue(Task.entry(set));
        }
    }

    private void actor(Act act, @Nullable Instance self) {
        if (act.kind() == Kind.SPAWN) {
            var fresh = new ModelActor(this, act);
            actors.put(act.target(), fresh);
            space.enqueue(Task.entry(fresh::begin));
            return;
        }
        ModelActor actor = actors.get(act.target());
        if (actor == null) {
            return;
        }
        switch (act.kind()) {
            case STOP -> space.enqueue(Task.entry(actor::stop));
            case WATCH -> promises.put(act.id(), actor.ended);
            case TELL ->
                actor.send(act.id(), null, instance -> {
                    space.history.add(instance.name + " is told " + act.id());
                    play(act.script(), instance);
                });
            case ASK -> ask(act, actor);
            case OPEN -> sendStream(act, actor, reader(act, self));
            default -> {
                ModelStream handle = handles.get(act.id());
                if (handle != null) {
                    sendStream(act, actor, handle);
                }
            }
        }
    }

    private void sendStream(Act act, ModelActor actor, ModelStream stream) {
        actor.send(act.id(), null, instance -> {
            space.history.add(instance.name + " streams " + act.id());
            handles.put(act.id(), stream);
            play(act.script(), instance);
        });
    }

    private ModelStream reader(Act act, @Nullable Instance self) {
        String who = "stream " + act.id() + " of " + name(self);
        var stream = new ModelStream(
                space, act.number() == 1, who, () -> play(act.reader().script(), self));
        if (act.number() == 1) {
            readers.put(act.id(), stream);
        }
        return stream;
    }

    private void ask(Act act, ModelActor actor) {
        var request = new ModelPromise(space, true, false);
        actor.send(act.id(), request, instance -> {
            space.history.add(instance.name + " is asked " + act.id());
            try {
                play(act.script(), instance);
                answer(act, request);
            } catch (History.Boom boom) {
                request.settle("!" + boom.getMessage());
            }
        });
        promises.put(act.id(), request);
    }

    private void answer(Act act, ModelPromise request) {
        switch (Answer.of(act.number())) {
            case VALUE -> request.settle("=" + act.id());
            case FAILED -> request.settle("!Boom" + act.id());
            case NULL -> request.settle("!ActorException");
            case LATER -> {
                var later = new ModelPromise(space, space.inside, true);
                promises.put(act.id() + 1, later);
                request.follow(later);
            }
            case OTHER -> {
                ModelPromise other = promises.get(act.promised());
                request.follow(other != null ? other : ModelPromise.settled(space, "=" + act.id()));
            }
        }
    }

    private void stream(Act act) {
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
            space.history.add("stream " + act.target() + " cancelled: " + handle.isCancelled());
        } else if (handle.hasEnded()) {
            space.history.add("stream " + act.target() + " refuses " + act.id());
        } else if (act.kind() == Kind.NEXT) {
            for (int i = 0; i < act.number(); i++) {
                handle.next(i);
            }
        } else if (act.kind() == Kind.FINISH) {
            handle.finish();
        } else {
            handle.fail("Boom" + act.id());
        }
    }

    private void playAsActor(Act act, @Nullable Instance self) {
        if (self == null) {
            return;
        }
        switch (act.kind()) {
            case STOP_SELF -> space.atTheEnd(self.actor::stop);
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
        timer[0] = space.timers.set(act.number(), period, () -> {
            if (self.over) {
                timer[0].cancel();
                return;
            }
            self.actor.guarded(self, () -> {
                space.history.add("timer " + act.id() + " of " + self.name);
                play(act.script(), self);
            });
        });
        timers.put(act.id(), timer[0]);
    }

    private void promise(Act act, @Nullable Instance self) {
        if (act.kind() == Kind.DEFER) {
            promises.put(act.id(), new ModelPromise(space, space.inside, true));
            return;
        }
        ModelPromise promise = promises.get(act.target());
        if (promise == null) {
            return;
        }
        String told = act.kind() + " " + act.id() + ": ";
        switch (act.kind()) {
            case RESOLVE, REJECT -> {
                if (promise.byHand) {
                    String outcome = act.kind() == Kind.RESOLVE ? "=" + act.id() : "!Boom" + act.id();
                    space.history.add(told + promise.settle(outcome));
                }
            }
            case CANCEL -> space.history.add(told + promise.settle("!CancellationException"));
            default -> {
                var listener = new ModelListener(this, promise, act, self);
                promise.whenDone(listener::arrive);
                promises.put(act.id(), listener.result);
            }
        }
    }

    @Nullable
    ModelPromise promise(int id) {
        return promises.get(id);
    }

    static String name(@Nullable Instance self) {
        return self == null ? "nobody" : self.name;
    }
}
