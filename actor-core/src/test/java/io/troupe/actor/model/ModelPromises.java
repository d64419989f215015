package io.troupe.actor.model;

import io.troupe.actor.model.Act.Answer;
import io.troupe.actor.model.Act.Kind;
import io.troupe.actor.model.ModelActor.Instance;
import io.troupe.actor.model.ModelTimers.Timer;
import java.util.HashMap;
import java.util.HashSet;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import org.jspecify.annotations.Nullable;

/** The promises of a program that runs on the model. */
final class ModelPromises {
    private final ModelRun run;
    private final Map<Integer, ModelPromise> promises = new TreeMap<>();
    private final Set<Integer> byHand = new HashSet<>();
    private final Map<ModelPromise, Delay> delays = new HashMap<>();

    ModelPromises(ModelRun run) {
        this.run = run;
    }

    void put(int id, ModelPromise promise) {
        promises.put(id, promise);
    }

    private ModelPromise defer(int id) {
        var promise = ModelPromise.shared(run.space, run.space.inside);
        promises.put(id, promise);
        byHand.add(id);
        return promise;
    }

    /** Makes a promise follow the one with the id or, if there is none, fulfils it with the value. */
    void follow(ModelPromise follower, int id, int value) {
        ModelPromise leader = promises.get(id);
        if (leader == null) {
            follower.settle("=" + value);
        } else {
            follower.follow(leader);
        }
    }

    /** Adds the state of all promises to the history. */
    void tell() {
        promises.forEach((id, promise) ->
                run.space.history.add("promise " + id + " " + (promise.isDone() ? promise.outcome() : "pending")));
    }

    void delay(Act act) {
        var promise = ModelPromise.shared(run.space, true);
        promises.put(act.id(), promise);
        var delay = new Delay(run.space.timers, promise, run.space.timers.now + act.number());
        delays.put(promise, delay);
        if (!run.space.inside) {
            run.space.enqueue(ModelTask.entry(delay::begin, delay::drop));
        } else if (run.space.closed) {
            delay.drop();
        } else {
            delay.begin();
        }
    }

    private static final class Delay {
        private final ModelTimers timers;
        private final ModelPromise promise;
        private final long deadline;
        private @Nullable Timer timer;
        private boolean withdrawn;

        Delay(ModelTimers timers, ModelPromise promise, long deadline) {
            this.timers = timers;
            this.promise = promise;
            this.deadline = deadline;
        }

        void begin() {
            if (!withdrawn) {
                timer = timers.set(deadline - timers.now, 0, () -> promise.settle("=null"), this::drop);
            }
        }

        void drop() {
            promise.settle("!CancellationException");
        }

        void withdraw() {
            withdrawn = true;
            if (timer != null) {
                timer.cancel();
            }
        }
    }

    /** Cancels a promise. A cancelled delay cancels its timer; if cancelled outside, when the space processes that. */
    private boolean cancel(ModelPromise promise) {
        boolean done = promise.settle("!CancellationException");
        Delay delay = delays.get(promise);
        if (done && delay != null) {
            if (run.space.inside) {
                delay.withdraw();
            } else {
                run.space.enqueue(ModelTask.entry(delay::withdraw, () -> {}));
            }
        }
        return done;
    }

    void answer(Act act, ModelPromise request, Instance actor) {
        switch (act.kind() == Kind.OPEN ? Answer.VALUE : Answer.of(act.number())) {
            case VALUE -> request.settle("=" + act.id());
            case FAILED -> request.settle("!Boom" + act.id());
            case NULL -> request.settle("!ActorException");
            case LATER -> answerLater(request, defer(act.id() + 1), actor);
            case OTHER -> {
                ModelPromise other = promises.get(act.promised());
                if (other == null) {
                    request.settle("=" + act.id());
                } else {
                    answerLater(request, other, actor);
                }
            }
        }
    }

    /**
     * Follows a promise. Unless that is the promise of another request, it belongs to the instance: if the instance
     * ends first, the request is rejected.
     */
    private static void answerLater(ModelPromise request, ModelPromise answer, Instance actor) {
        if (!answer.isDone() && !answer.isRequest) {
            actor.openRequests.add(new ModelActor.OpenRequest(request, answer));
        }
        request.follow(answer);
    }

    void play(Act act, @Nullable Instance self) {
        if (act.kind() == Kind.DEFER) {
            defer(act.id());
            return;
        }
        ModelPromise promise = promises.get(act.target());
        if (promise == null) {
            return;
        }
        String told = act.kind() + " " + act.id() + ": ";
        switch (act.kind()) {
            case RESOLVE, REJECT -> {
                if (byHand.contains(act.target())) {
                    String outcome = act.kind() == Kind.RESOLVE ? "=" + act.id() : "!Boom" + act.id();
                    run.space.history.add(told + promise.settle(outcome));
                }
            }
            case CANCEL -> run.space.history.add(told + cancel(promise));
            default -> {
                var listener = new ModelListener(run, promise, act, self);
                promise.register(listener);
                promises.put(act.id(), listener.result);
            }
        }
    }
}
