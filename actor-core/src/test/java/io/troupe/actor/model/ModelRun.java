package io.troupe.actor.model;

import io.troupe.actor.model.Act.Answer;
import io.troupe.actor.model.Act.Kind;
import io.troupe.actor.model.ModelActor.Call;
import io.troupe.actor.model.ModelActor.Instance;
import io.troupe.actor.model.ModelSpace.Task;
import io.troupe.actor.model.ModelSpace.Timer;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import org.jspecify.annotations.Nullable;

/** Runs a program on the model. */
final class ModelRun {
    final ModelSpace space = new ModelSpace();
    private final Map<Integer, ModelPromise> promises = new TreeMap<>();
    private final Set<Integer> byHand = new HashSet<>();
    private final Map<ModelPromise, Delay> delays = new HashMap<>();
    private final Map<Integer, ModelStream> handles = new HashMap<>();
    private final Map<Integer, ModelStream> readers = new HashMap<>();
    private final Map<Integer, Timer> timers = new HashMap<>();
    private final Map<Integer, ModelActor> actors = new HashMap<>();
    private final Map<Integer, Integer> instances = new HashMap<>();

    private ModelRun() {}

    static History of(List<Act> program) {
        var run = new ModelRun();
        run.play(program, null);
        run.space.crank();
        run.promises.forEach((id, promise) ->
                run.space.history.add("promise " + id + " " + (promise.isDone() ? promise.outcome() : "pending")));
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
            case ADVANCE -> space.now += act.number();
            case READER -> {}
            case THROW -> throw new History.Boom(act.id());
            case CLOSE -> space.close();
            case EXECUTE, ON_IDLE, SPAWN -> begin(act);
            case DEFER -> defer(act.id());
            case DELAY -> delay(act);
            case STOP, WATCH, TELL, ASK, OPEN, FORWARD -> send(act, self);
            case STOP_SELF, AFTER, EVERY, CANCEL_TIMER -> {
                if (self != null) {
                    playAsActor(act, self);
                }
            }
            case NEXT, FINISH, FAIL, CANCEL_STREAM, LOOK_AT_STREAM -> playOnStream(act);
            default -> playOnPromise(act, self);
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
                space.enqueue(Task.entry(fresh::begin, fresh::stop));
            }
        }
    }

    private void task(String what, Act act) {
        space.history.add("space " + what);
        play(act.script(), null);
    }

    private static String name(@Nullable Instance self) {
        return self == null ? "nobody" : self.name;
    }

    // ---- actors

    private void send(Act act, @Nullable Instance self) {
        ModelActor actor = actors.get(act.target());
        if (actor == null) {
            return;
        }
        switch (act.kind()) {
            case STOP -> space.enqueue(Task.entry(actor::stop, actor::stop));
            case WATCH -> promises.put(act.id(), actor.watch());
            case TELL -> tell(act, actor, "is told", null);
            case ASK -> ask(act, actor, "is asked", null);
            case OPEN -> {
                var callback = reader(act, self);
                if (act.isRequest()) {
                    ask(act, actor, "streams for", callback);
                } else {
                    tell(act, actor, "streams", callback);
                }
            }
            default -> {
                ModelStream handle = handles.get(act.id());
                if (handle != null) {
                    tell(act, actor, "streams", handle);
                }
            }
        }
    }

    private void tell(Act act, ModelActor actor, String how, @Nullable ModelStream callback) {
        actor.send(new Call(act.id(), null, callback, instance -> arrive(instance, act, how, callback)));
    }

    private void ask(Act act, ModelActor actor, String how, @Nullable ModelStream callback) {
        var request = ModelPromise.request(space);
        actor.send(new Call(act.id(), request, callback, instance -> {
            try {
                arrive(instance, act, how, callback);
                answer(act, request, instance);
            } catch (History.Boom boom) {
                request.settle("!" + boom.getMessage());
            }
        }));
        promises.put(act.id(), request);
    }

    private void arrive(Instance instance, Act act, String how, @Nullable ModelStream callback) {
        space.history.add(instance.name + " " + how + " " + act.id());
        if (callback != null) {
            handles.put(act.id(), callback);
        }
        play(act.script(), instance);
    }

    private void playAsActor(Act act, Instance self) {
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
        var set = new Timer[1];
        Runnable tick = () -> {
            if (self.over) {
                set[0].cancel();
                return;
            }
            self.actor.guarded(self, () -> {
                space.history.add("timer " + act.id() + " of " + self.name);
                play(act.script(), self);
            });
        };
        set[0] = space.setTimer(act.number(), period, tick, () -> {});
        timers.put(act.id(), set[0]);
        self.timers.add(set[0]);
    }

    private void answer(Act act, ModelPromise request, Instance actor) {
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

    // ---- promises

    private ModelPromise defer(int id) {
        var promise = ModelPromise.shared(space, space.inside);
        promises.put(id, promise);
        byHand.add(id);
        return promise;
    }

    private void playOnPromise(Act act, @Nullable Instance self) {
        ModelPromise promise = promises.get(act.target());
        if (promise == null) {
            return;
        }
        String told = act.kind() + " " + act.id() + ": ";
        switch (act.kind()) {
            case RESOLVE, REJECT -> {
                if (byHand.contains(act.target())) {
                    String outcome = act.kind() == Kind.RESOLVE ? "=" + act.id() : "!Boom" + act.id();
                    space.history.add(told + promise.settle(outcome));
                }
            }
            case CANCEL -> space.history.add(told + cancel(promise));
            default -> {
                var listener = new Reaction(promise, act, self);
                promise.register(listener);
                promises.put(act.id(), listener.result);
            }
        }
    }

    /** Cancels a promise. A cancelled delay cancels its timer; if cancelled outside, when the space processes that. */
    private boolean cancel(ModelPromise promise) {
        boolean done = promise.settle("!CancellationException");
        Delay delay = delays.get(promise);
        if (done && delay != null) {
            if (space.inside) {
                delay.withdraw();
            } else {
                space.enqueue(Task.entry(delay::withdraw, () -> {}));
            }
        }
        return done;
    }

    private void delay(Act act) {
        var delay = new Delay(act.number());
        promises.put(act.id(), delay.promise);
        delays.put(delay.promise, delay);
        if (!space.inside) {
            space.enqueue(Task.entry(delay::begin, delay::drop));
        } else if (space.closed) {
            delay.drop();
        } else {
            delay.begin();
        }
    }

    private final class Delay {
        private final ModelPromise promise = ModelPromise.shared(space, true);
        private final long deadline;
        private @Nullable Timer timer;
        private boolean withdrawn;

        Delay(int ticks) {
            this.deadline = space.now + ticks;
        }

        void begin() {
            if (!withdrawn) {
                timer = space.setTimer(deadline - space.now, 0, () -> promise.settle("=null"), this::drop);
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

    /** A listener that plays a script, and the promise of its result. */
    private final class Reaction implements ModelPromise.Listener {
        private final ModelPromise source;
        private final Act act;
        private final @Nullable Instance self;
        private final @Nullable Instance owner = space.inside ? space.current : null;
        private final ModelPromise result;

        Reaction(ModelPromise source, Act act, @Nullable Instance self) {
            this.source = source;
            this.act = act;
            this.self = self;
            this.result = ModelPromise.local(space, space.inside || source.atHome);
        }

        /**
         * The source is settled: from now on the listener is in its callback queue. A listener without a space is
         * queued in the space of the thread that settles the source, if there is one.
         */
        @Override
        public void tell() {
            if (result.atHome || space.inside) {
                space.enqueue(Task.callback(this::takeTurn));
            } else {
                space.runDetached(this::takeTurn);
            }
        }

        @Override
        public void tellBehind() {
            if (result.atHome) {
                space.enqueueBehind(Task.callback(this::takeTurn));
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
            boolean thenOnly = act.kind() == Kind.THEN || act.kind() == Kind.COMPOSE;
            if (ModelPromise.isError(outcome) ? thenOnly : act.kind() == Kind.RESCUE) {
                result.settle(outcome);
                return;
            }
            try {
                space.history.add("listener " + act.id() + " of " + name(self) + " hears " + outcome);
                play(act.script(), self);
            } catch (History.Boom boom) {
                result.settle("!" + boom.getMessage());
                return;
            }
            ModelPromise leader = promises.get(act.number());
            if (act.kind() == Kind.COMPOSE && leader != null) {
                result.follow(leader);
            } else {
                result.settle(act.kind() == Kind.WHEN ? outcome : "=" + act.id());
            }
        }
    }

    // ---- callbacks

    private ModelStream reader(Act act, @Nullable Instance self) {
        String who = "stream " + act.id() + " of " + name(self);
        Runnable onNext = () -> play(act.reader().script(), self);
        var stream = new ModelStream(space, act.isCancellable(), who, onNext);
        if (act.isCancellable()) {
            readers.put(act.id(), stream);
        }
        return stream;
    }

    private void playOnStream(Act act) {
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
            return;
        }
        int times = act.kind() == Kind.NEXT ? act.number() : 1;
        for (int i = 0; i < times; i++) {
            if (handle.hasEnded()) {
                space.history.add("stream " + act.target() + " refuses " + act.id());
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
