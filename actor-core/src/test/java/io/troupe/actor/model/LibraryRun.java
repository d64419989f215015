package io.troupe.actor.model;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.Callback;
import io.troupe.actor.DeadLetter;
import io.troupe.actor.Deferred;
import io.troupe.actor.ManualClock;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.Timer;
import io.troupe.actor.model.Act.Answer;
import io.troupe.actor.model.Act.Cast;
import java.time.Duration;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/** Runs a program on the library. */
final class LibraryRun {
    private final History history = new History();
    private final Map<Integer, Promise<@Nullable Object>> promises = new TreeMap<>();
    private final Map<Integer, Callback<Integer>> handles = new HashMap<>();
    private final Map<Integer, Callback.Stream<Integer>> readers = new HashMap<>();
    private final Map<Integer, Timer> timers = new HashMap<>();
    private final Map<Integer, Peer> actors = new HashMap<>();
    private final Map<Integer, Integer> instances = new HashMap<>();
    private final ManualClock clock = new ManualClock();
    private final ActorSpace space = ActorSpace.create(SpaceSettings.named("space")
            .withClock(clock)
            .withOnError((where, error) -> failed("", where, error))
            .withOnDeadLetter(this::died)
            .withoutThread());

    static History of(List<Act> program) {
        var run = new LibraryRun();
        run.play(program, null);
        run.space.runQueued();
        run.promises.forEach((id, promise) -> run.history.add("promise " + id + " " + History.outcome(promise)));
        return run.history;
    }

    private void failed(String who, String where, Throwable error) {
        if (where.startsWith("a rejected promise without a listener")) {
            history.addUnheard(who + History.name(error));
        } else {
            history.add(who + "failed " + where.substring(where.lastIndexOf(' ') + 1) + " " + History.name(error));
        }
    }

    private void died(DeadLetter letter) {
        String reason = letter.reason();
        String why = reason.contains("full") ? "full" : reason.contains("closed") ? "closed" : "stopped";
        String id = letter.arguments().isEmpty()
                ? letter.message()
                : String.valueOf(letter.arguments().getFirst());
        history.add("dead letter " + id + " to " + letter.actor() + ": " + why);
    }

    private void play(List<Act> acts, @Nullable Peer self) {
        for (Act act : acts) {
            if (!history.isFull()) {
                play(act, self);
            }
        }
    }

    private void play(Act act, @Nullable Peer self) {
        switch (act.kind()) {
            case RUN -> space.runQueued();
            case ADVANCE -> clock.advance(Cast.ticks(act.number()));
            case READER -> {}
            case THROW -> throw new History.Boom(act.id());
            case CLOSE -> space.close();
            case EXECUTE, ON_IDLE, SPAWN -> begin(act);
            case DEFER -> promises.put(act.id(), new Deferred<>());
            case DELAY -> promises.put(act.id(), open(space.delay(Cast.ticks(act.number()))));
            case STOP, WATCH, TELL, ASK, OPEN, FORWARD -> send(act, self);
            case STOP_SELF, HOLD, RELEASE, AFTER, EVERY, CANCEL_TIMER -> {
                if (self != null) {
                    self.playAsActor(act);
                }
            }
            case NEXT, FINISH, FAIL, CANCEL_STREAM, LOOK_AT_STREAM -> playOnStream(act);
            default -> playOnPromise(act, self);
        }
    }

    private void begin(Act act) {
        try {
            switch (act.kind()) {
                case EXECUTE -> space.execute(() -> task("executes " + act.id(), act));
                case ON_IDLE -> space.onIdle(() -> task("is idle for " + act.id(), act));
                default -> spawn(act);
            }
        } catch (ActorStoppedException tooLate) {
            history.add("too late: " + act.id());
        }
    }

    private void task(String what, Act act) {
        history.add("space " + what);
        play(act.script(), null);
    }

    private static String name(@Nullable Peer self) {
        return self == null ? "nobody" : self.name;
    }

    // ---- actors

    /** The actor of the programs: runs the script of each act that it receives. */
    class Peer extends Actor {
        private final Act born;
        private final String name;

        Peer(Act born, String name) {
            this.born = born;
            this.name = name;
        }

        @Override
        protected void started() {
            history.add(name + " starts");
            play(born.script(), this);
        }

        @Override
        protected void stopped() {
            history.add(name + " ends");
        }

        public void tell(Act act) {
            history.add(name + " is told " + act);
            play(act.script(), this);
        }

        public @Nullable Promise<@Nullable Object> ask(Act act) {
            history.add(name + " is asked " + act);
            play(act.script(), this);
            return switch (Answer.of(act.number())) {
                case VALUE -> Promise.of(act.id());
                case LATER -> {
                    var later = new Deferred<@Nullable Object>();
                    promises.put(act.id() + 1, later);
                    yield later;
                }
                case FAILED -> Promise.failed(new History.Boom(act.id()));
                case NULL -> null;
                case OTHER -> promises.getOrDefault(act.promised(), Promise.of(act.id()));
            };
        }

        public void stream(Act act, Callback<Integer> results) {
            arrive("streams", act, results);
        }

        public Promise<@Nullable Object> streamAndAnswer(Act act, Callback<Integer> results) {
            arrive("streams for", act, results);
            return Promise.of(act.id());
        }

        private void arrive(String how, Act act, Callback<Integer> results) {
            history.add(name + " " + how + " " + act);
            handles.put(act.id(), results);
            play(act.script(), this);
        }

        private void playAsActor(Act act) {
            switch (act.kind()) {
                case STOP_SELF -> context().stop();
                case HOLD -> context().hold();
                case RELEASE -> context().release();
                case AFTER -> timers.put(act.id(), context().after(Cast.ticks(act.number()), () -> tick(act)));
                case EVERY -> timers.put(act.id(), context().every(Cast.ticks(act.number()), () -> tick(act)));
                default -> {
                    Timer timer = timers.get(act.target());
                    if (timer != null) {
                        history.add("timer " + act.target() + " cancelled: " + timer.cancel());
                    }
                }
            }
        }

        private void tick(Act act) {
            history.add("timer " + act.id() + " of " + name);
            play(act.script(), this);
        }
    }

    private void spawn(Act act) {
        Cast cast = Cast.of(act.number());
        String name = "A" + act.target();
        ActorSettings settings = cast.settings(name);
        if (cast.ownHandler()) {
            settings = settings.withOnError((where, error) -> failed("own handler: ", where, error));
        }
        Peer spawned = space.spawn(
                Peer.class,
                () -> {
                    int instance = instances.merge(act.target(), 1, Integer::sum);
                    if (instance == cast.failingInstance()) {
                        throw new History.Boom(act.id());
                    }
                    return new Peer(act, name + "#" + instance);
                },
                settings);
        actors.put(act.target(), spawned);
    }

    private void send(Act act, @Nullable Peer self) {
        Peer actor = actors.get(act.target());
        if (actor == null) {
            return;
        }
        switch (act.kind()) {
            case STOP -> space.stop(actor);
            case WATCH -> promises.put(act.id(), open(space.whenStopped(actor)));
            case TELL -> actor.tell(act);
            case ASK -> promises.put(act.id(), actor.ask(act));
            case OPEN -> {
                var callback = reader(act, self);
                if (act.isRequest()) {
                    promises.put(act.id(), actor.streamAndAnswer(act, callback));
                } else {
                    actor.stream(act, callback);
                }
            }
            default -> {
                Callback<Integer> handle = handles.get(act.id());
                if (handle != null) {
                    actor.stream(act, handle);
                }
            }
        }
    }

    // ---- promises

    @SuppressWarnings({"unchecked", "rawtypes"}) // a promise of Void, used as one of any type
    private static Promise<@Nullable Object> open(Promise<?> promise) {
        return (Promise) promise;
    }

    private void playOnPromise(Act act, @Nullable Peer self) {
        Promise<@Nullable Object> promise = promises.get(act.target());
        if (promise == null) {
            return;
        }
        String told = act.kind() + " " + act.id() + ": ";
        switch (act.kind()) {
            case RESOLVE, REJECT -> {
                if (promise instanceof Deferred<@Nullable Object> deferred) {
                    boolean resolves = act.kind() == Act.Kind.RESOLVE;
                    history.add(told
                            + (resolves ? deferred.resolve(act.id()) : deferred.reject(new History.Boom(act.id()))));
                }
            }
            case CANCEL -> history.add(told + promise.cancel());
            case LIMIT, INSTEAD -> {
                try {
                    promises.put(act.id(), limited(promise, act));
                } catch (IllegalStateException noClock) {
                    history.add(told + "no clock");
                }
            }
            default -> promises.put(act.id(), listen(promise, act, self));
        }
    }

    private static Promise<@Nullable Object> limited(Promise<@Nullable Object> promise, Act act) {
        Duration limit = Cast.ticks(act.number());
        return act.kind() == Act.Kind.LIMIT ? promise.orTimeout(limit) : promise.completeOnTimeout(act.id(), limit);
    }

    private Promise<@Nullable Object> listen(Promise<@Nullable Object> promise, Act act, @Nullable Peer self) {
        return switch (act.kind()) {
            case THEN -> promise.thenApply(value -> heard(act, self, value, null));
            case HANDLE -> promise.handle((value, error) -> heard(act, self, value, error));
            case WHEN -> promise.whenComplete((value, error) -> heard(act, self, value, error));
            case RESCUE -> promise.exceptionally(error -> heard(act, self, null, error));
            case COMPOSE ->
                promise.thenCompose(value -> {
                    heard(act, self, value, null);
                    return promises.getOrDefault(act.number(), Promise.of(act.id()));
                });
            default -> throw new IllegalArgumentException("no listener: " + act);
        };
    }

    private @Nullable Object heard(Act act, @Nullable Peer self, @Nullable Object value, @Nullable Throwable error) {
        history.add("listener " + act.id() + " of " + name(self) + " hears " + History.outcome(value, error));
        play(act.script(), self);
        return act.id();
    }

    // ---- callbacks

    private Callback<Integer> reader(Act act, @Nullable Peer self) {
        String who = "stream " + act.id() + " of " + name(self);
        var script = act.reader().script();
        if (!act.isCancellable()) {
            return (value, error) -> {
                history.add(who + " hears " + History.outcome(value, error));
                if (error == null) {
                    play(script, self);
                }
            };
        }
        var stream = new Callback.Stream<Integer>(
                act.most(),
                value -> {
                    history.add(who + " hears =" + value);
                    play(script, self);
                },
                end -> history.add(who + " ends " + (end == null ? "well" : History.name(end))));
        readers.put(act.id(), stream);
        return stream;
    }

    private void playOnStream(Act act) {
        Callback<Integer> handle = handles.get(act.target());
        Callback.Stream<Integer> reader = readers.get(act.target());
        if (act.kind() == Act.Kind.CANCEL_STREAM) {
            if (reader != null) {
                reader.cancel();
            }
            return;
        }
        if (handle == null) {
            return;
        }
        try {
            switch (act.kind()) {
                case NEXT -> IntStream.range(0, act.number()).forEach(handle::next);
                case FINISH -> handle.finish();
                case FAIL -> handle.fail(new History.Boom(act.id()));
                default ->
                    history.add("stream " + act.target() + " cancelled: " + handle.isCancelled() + ", skipped: "
                            + (reader == null ? 0 : reader.dropped()));
            }
        } catch (IllegalStateException afterTheEnd) {
            history.add("stream " + act.target() + " refuses " + act.id());
        }
    }
}
