package io.troupe.actor.model;

import io.troupe.actor.ActorSettings.Overflow;
import io.troupe.actor.model.Act.Answer;
import io.troupe.actor.model.Act.Cast;
import io.troupe.actor.model.Act.Directive;
import io.troupe.actor.model.Act.Kind;
import io.troupe.actor.model.ModelSpace.Task;
import io.troupe.actor.model.ModelSpace.Timer;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/** Runs a program on the model. */
final class ModelRun {
    private final ModelSpace space = new ModelSpace();
    private final Map<Integer, ModelPromise> promises = new TreeMap<>();
    private final Set<Integer> byHand = new HashSet<>();
    private final Map<ModelPromise, Timer> delays = new HashMap<>();
    private final Map<Integer, ModelStream> handles = new HashMap<>();
    private final Map<Integer, ModelStream> readers = new HashMap<>();
    private final Map<Integer, Timer> timers = new HashMap<>();
    private final Map<Integer, ModelActor> actors = new HashMap<>();
    private final Map<Integer, Integer> instances = new HashMap<>();

    private ModelRun() {}

    static History of(List<Act> program) {
        var run = new ModelRun();
        run.play(program, null);
        run.space.runQueued();
        run.promises.forEach((id, promise) ->
                run.space.history.add("promise " + id + " " + (promise.isDone() ? promise.outcome : "pending")));
        return run.space.history;
    }

    private void play(List<Act> acts, @Nullable Instance self) {
        for (Act act : acts) {
            if (!space.history.isFull()) {
                play(act, self);
            }
        }
    }

    private void play(Act act, @Nullable Instance self) {
        switch (act.kind()) {
            case RUN -> space.runQueued();
            case ADVANCE -> space.now += act.number();
            case READER -> {}
            case THROW -> throw new History.Boom(act.id());
            case CLOSE -> space.close();
            case EXECUTE, ON_IDLE, SPAWN -> begin(act);
            case DEFER -> defer(act.id());
            case DELAY -> delay(act);
            case STOP, WATCH, TELL, ASK, OPEN, FORWARD -> send(act, self);
            case STOP_SELF, HOLD, RELEASE, AFTER, EVERY, CANCEL_TIMER -> {
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
            case ON_IDLE -> space.execute(() -> space.idle.add(() -> task("is idle for " + act.id(), act)));
            default -> {
                var fresh = new ModelActor(act);
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

    /**
     * What an actor holds back.
     *
     * @param call null for a stop
     */
    private record Held(@Nullable Call call) {}

    /** An actor of the model: its mailbox, its instances and its failures. */
    final class ModelActor {
        private final Act born;
        private final Cast cast;
        private final String name;
        private final List<Call> mailbox = new ArrayList<>();
        private final List<Long> failures = new ArrayList<>();
        private final ModelPromise ended = ModelPromise.shared(space, true);
        private @Nullable Instance instance;
        private @Nullable List<Held> held; // until all have been delivered
        private boolean holds;
        private boolean releasing;
        private @Nullable Timer restartTimer;
        private long startedAt;
        private int failuresInARow; // without a run as long as the window in between
        private @Nullable String endedBy;
        private boolean begun;
        private boolean stopped;

        ModelActor(Act born) {
            this.born = born;
            this.cast = Cast.of(born.number());
            this.name = "A" + born.target();
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
            if (held == null) {
                handle(queued);
            } else {
                held.add(new Held(queued));
            }
        }

        private void handle(Call queued) {
            Call call = dropsOldest() ? mailbox.removeFirst() : queued;
            mailbox.removeIf(each -> each == call);
            Instance now = instance;
            if (call.answer != null && (call.answer.isDone() || call.answer.isShed())) {
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
            failuresInARow = now - startedAt >= cast.windowTicks() ? 1 : failuresInARow + 1;
            int counted = cast.firstPauseTicks() > 0 ? failuresInARow : failures.size();
            if (cast.limit() >= 0 && counted > cast.limit() || cast.directive() == Directive.STOP) {
                space.ends.add(() -> stopAfter(error));
            } else if (cast.directive() == Directive.RESTART) {
                space.ends.add(this::restart);
            }
        }

        /**
         * Starts the actor in the turn of its spawn or of an earlier call, whichever comes first; starts nothing after
         * the space has stopped.
         */
        void begin() {
            if (!begun && !stopped && !space.stopping) {
                begun = true;
                start();
            }
        }

        private void start() {
            space.living.add(this);
            int number = instances.merge(born.target(), 1, Integer::sum);
            var fresh = new Instance(this, name + "#" + number);
            if (number == cast.failingInstance()) {
                failed("Boom" + born.id());
                stopAfter("Boom" + born.id());
                return;
            }
            instance = fresh;
            startedAt = space.now;
            space.history.add(fresh.name + " starts");
            guarded(fresh, () -> play(born.script(), fresh));
        }

        void hold() {
            if (instance != null) {
                held = held == null ? new ArrayList<>() : held;
                holds = true;
            }
        }

        void release() {
            if (holds) {
                holds = false;
                releaseSoon();
            }
        }

        private void releaseSoon() {
            if (!releasing) {
                releasing = true;
                space.enqueue(Task.callback(this::deliverHeld));
            }
        }

        /** One in each turn, before other messages; then those that come are handled at once again. */
        private void deliverHeld() {
            releasing = false;
            if (held == null || holds || instance == null) {
                return;
            }
            if (!held.isEmpty()) {
                Call call = held.removeFirst().call;
                if (call == null) {
                    stop();
                } else {
                    handle(call);
                }
            }
            if (held != null && !holds) {
                if (held.isEmpty()) {
                    held = null;
                } else {
                    releaseSoon();
                }
            }
        }

        /** The calls that are being delivered come first; those that the actor holds back do not. */
        void stopBehindCalls() {
            if (held != null && instance != null && !holds) {
                held.add(new Held(null));
            } else {
                stop();
            }
        }

        private void stopAfter(String error) {
            if (!stopped) {
                endedBy = error;
                stop();
            }
        }

        void stop() {
            if (!stopped) {
                if (restartTimer != null) {
                    restartTimer.cancel();
                }
                stopped = true;
                space.living.remove(this);
                endInstance();
                if (held != null) {
                    for (Held each : held) {
                        Call call = each.call;
                        space.enqueue(Task.call(call == null ? () -> {} : () -> deliver(call)));
                    }
                    held = null;
                }
                ended.settle("=" + (endedBy == null ? "stopped" : "failed with " + endedBy));
            }
        }

        private void endInstance() {
            if (instance != null) {
                space.history.add(instance.name + " ends");
                instance.over = true;
                instance.timers.forEach(Timer::cancel);
                instance.openRequests.forEach(OpenRequest::reject);
                instance = null;
                holds = false;
            }
        }

        private void restart() {
            if (stopped) {
                return;
            }
            endInstance();
            if (cast.firstPauseTicks() == 0) {
                startAgain();
                return;
            }
            held = held == null ? new ArrayList<>() : held;
            if (held.stream().anyMatch(each -> each.call == null)) {
                stop();
                return;
            }
            int pauseTicks = Math.min(Cast.LONGEST_PAUSE_TICKS, cast.firstPauseTicks() << (failuresInARow - 1));
            restartTimer = new Timer(this::startAgain, () -> {}, space.now + pauseTicks, 0);
            space.begin(restartTimer);
        }

        private void startAgain() {
            if (!stopped && !space.stopping) {
                start();
                if (instance != null && held != null) {
                    releaseSoon();
                }
            }
        }
    }

    private void send(Act act, @Nullable Instance self) {
        ModelActor actor = actors.get(act.target());
        if (actor == null) {
            return;
        }
        switch (act.kind()) {
            case STOP -> space.enqueue(Task.entry(actor::stopBehindCalls, actor::stop));
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
            case STOP_SELF -> space.ends.add(self.actor::stop);
            case HOLD -> self.actor.hold();
            case RELEASE -> self.actor.release();
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
        Runnable tick = () -> self.actor.guarded(self, () -> {
            space.history.add("timer " + act.id() + " of " + self.name);
            play(act.script(), self);
        });
        var timer = new Timer(tick, () -> {}, space.now + act.number(), period);
        space.begin(timer);
        timers.put(act.id(), timer);
        self.timers.add(timer);
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
            actor.openRequests.add(new OpenRequest(request, answer));
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
            case LIMIT, INSTEAD -> {
                if (space.inside || promise.atHome) {
                    limit(promise, act);
                } else {
                    space.history.add(told + "no clock");
                }
            }
            default -> promises.put(act.id(), listen(promise, act, self));
        }
    }

    /** Cancels a promise. A cancelled delay cancels its timer; if cancelled outside, when the space processes that. */
    private boolean cancel(ModelPromise promise) {
        boolean done = promise.settle("!CancellationException");
        Timer delay = delays.get(promise);
        if (done && delay != null) {
            withdraw(delay);
        }
        return done;
    }

    private void withdraw(Timer timer) {
        if (space.inside) {
            timer.cancel();
        } else {
            space.enqueue(Task.entry(timer::cancel, () -> {}));
        }
    }

    private void delay(Act act) {
        var promise = ModelPromise.shared(space, true);
        Runnable drop = () -> promise.settle("!CancellationException");
        var timer = new Timer(() -> promise.settle("=null"), drop, space.now + act.number(), 0);
        promises.put(act.id(), promise);
        schedule(promise, timer, drop);
    }

    private void schedule(ModelPromise promise, Timer timer, Runnable ifClosed) {
        delays.put(promise, timer);
        if (!space.inside) {
            space.enqueue(Task.entry(() -> space.begin(timer), ifClosed));
        } else if (space.closed) {
            ifClosed.run();
        } else {
            space.begin(timer);
        }
    }

    /** A promise that follows the source, unless the time is over first. */
    private void limit(ModelPromise source, Act act) {
        var limited = ModelPromise.shared(space, true);
        Runnable expire = () -> limited.expire(act.kind() == Kind.LIMIT ? "!TimeoutException" : "=" + act.id(), source);
        Runnable drop = () -> limited.settle("!CancellationException");
        var timer = new Timer(expire, drop, space.now + act.number(), 0);
        promises.put(act.id(), limited);
        schedule(limited, timer, drop);
        source.register(new ModelPromise.Listener(limited, false, behind -> {
            withdraw(timer);
            limited.settle(String.valueOf(source.outcome));
        }));
    }

    /** Registers a listener that plays a script, and returns the promise of its result. */
    private ModelPromise listen(ModelPromise source, Act act, @Nullable Instance self) {
        var result = ModelPromise.local(space, space.inside || source.atHome);
        var owner = space.inside ? space.current : null;
        Runnable turn = () -> {
            source.arrived();
            if (!result.isDone()) {
                hear(String.valueOf(source.outcome), result, act, self, owner);
            }
        };
        source.register(new ModelPromise.Listener(result, true, behind -> notify(source, result, turn, behind)));
        return result;
    }

    /**
     * The source is settled: from now on the listener is in its callback queue. A listener without a space is queued in
     * the space of the thread that settles the source, if there is one.
     */
    private void notify(ModelPromise source, ModelPromise result, Runnable turn, boolean behind) {
        if (behind && result.atHome) {
            space.enqueueBehind(Task.callback(turn));
        } else if (result.atHome || space.inside) {
            space.enqueue(source.tellsOnlyListener ? Task.onlyListener(turn) : Task.callback(turn));
        } else {
            space.runDetached(turn);
        }
    }

    private void hear(String outcome, ModelPromise result, Act act, @Nullable Instance self, @Nullable Instance owner) {
        boolean error = ModelPromise.isError(outcome);
        boolean thenOnly = act.kind() == Kind.THEN || act.kind() == Kind.COMPOSE;
        if (owner != null && owner.over) {
            result.settle(error ? outcome : "!CancellationException");
        } else if (error ? thenOnly : act.kind() == Kind.RESCUE) {
            result.settle(outcome);
        } else {
            space.as(owner, () -> {
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
                    result.heard |= act.kind() == Kind.WHEN; // by the listener
                }
            });
        }
    }

    // ---- callbacks

    private ModelStream reader(Act act, @Nullable Instance self) {
        String who = "stream " + act.id() + " of " + name(self);
        Runnable onNext = () -> play(act.reader().script(), self);
        var stream = new ModelStream(space, act.isCancellable(), act.most(), who, onNext);
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
            var reader = readers.get(act.target());
            space.history.add("stream " + act.target() + " cancelled: " + handle.isCancelled() + ", skipped: "
                    + (reader == null ? 0 : reader.skipped));
            return;
        }
        int times = act.kind() == Kind.NEXT ? act.number() : 1;
        for (int i = 0; i < times; i++) {
            if (handle.ended) {
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
