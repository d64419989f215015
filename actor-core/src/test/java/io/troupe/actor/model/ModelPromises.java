package io.troupe.actor.model;

import io.troupe.actor.model.Act.Answer;
import io.troupe.actor.model.Act.Kind;
import io.troupe.actor.model.ModelActor.Instance;
import java.util.Map;
import java.util.TreeMap;
import org.jspecify.annotations.Nullable;

/** The promises of a program that runs on the model. */
final class ModelPromises {
    private final ModelRun run;
    private final Map<Integer, ModelPromise> promises = new TreeMap<>();

    ModelPromises(ModelRun run) {
        this.run = run;
    }

    void put(int id, ModelPromise promise) {
        promises.put(id, promise);
    }

    /** The promise of that id, or one that is there already. */
    ModelPromise getOrDefault(int id, int value) {
        ModelPromise promise = promises.get(id);
        return promise != null ? promise : ModelPromise.settled(run.space, "=" + value);
    }

    /** How they all stand. */
    void tell() {
        promises.forEach((id, promise) ->
                run.space.history.add("promise " + id + " " + (promise.isDone() ? promise.outcome() : "pending")));
    }

    void delay(Act act) {
        var promise = new ModelPromise(run.space, true, false);
        promises.put(act.id(), promise);
        long deadline = run.space.timers.now + act.number();
        run.space.pendingDelays++;
        Runnable set = () -> run.space.timers.set(deadline - run.space.timers.now, 0, () -> {
            run.space.pendingDelays--;
            promise.settle("=null");
        });
        if (run.space.inside) {
            set.run();
        } else {
            run.space.enqueue(ModelSpace.Task.entry(set));
        }
    }

    void answer(Act act, ModelPromise request) {
        switch (Answer.of(act.number())) {
            case VALUE -> request.settle("=" + act.id());
            case FAILED -> request.settle("!Boom" + act.id());
            case NULL -> request.settle("!ActorException");
            case LATER -> {
                var later = new ModelPromise(run.space, run.space.inside, true);
                promises.put(act.id() + 1, later);
                request.follow(later);
            }
            case OTHER -> request.follow(getOrDefault(act.promised(), act.id()));
        }
    }

    void play(Act act, @Nullable Instance self) {
        if (act.kind() == Kind.DEFER) {
            promises.put(act.id(), new ModelPromise(run.space, run.space.inside, true));
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
                    run.space.history.add(told + promise.settle(outcome));
                }
            }
            case CANCEL -> run.space.history.add(told + promise.settle("!CancellationException"));
            default -> {
                var listener = new ModelListener(run, promise, act, self);
                promise.whenDone(listener::arrive);
                promises.put(act.id(), listener.result);
            }
        }
    }
}
