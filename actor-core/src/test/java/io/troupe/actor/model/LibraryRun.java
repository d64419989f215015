package io.troupe.actor.model;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.Callback;
import io.troupe.actor.DeadLetter;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.time.ManualClock;
import io.troupe.actor.time.Timer;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import org.jspecify.annotations.Nullable;

/** Runs a program on the library. */
final class LibraryRun {
    final History history = new History();
    final LibraryPromises promises = new LibraryPromises(this);
    final LibraryStreams streams = new LibraryStreams(this);
    private final Map<Integer, Timer> timers = new HashMap<>();
    private final Map<Integer, Peer> actors = new HashMap<>();
    private final Map<Integer, Integer> instances = new HashMap<>();
    private final ManualClock clock = new ManualClock();
    private final ActorSpace space = ActorSpace.create(SpaceSettings.named("space")
            .withClock(clock)
            .withOnError((where, error) -> failed("", where, error))
            .withOnDeadLetter(this::died)
            .withHandCrank());

    static History of(List<Act> program) {
        var run = new LibraryRun();
        run.play(program, null);
        run.space.crank();
        run.promises.tell();
        return run.history;
    }

    private void failed(String who, String where, Throwable error) {
        boolean unheard = where.startsWith("a promise nobody listens to");
        String what = unheard ? "unheard" : "failed " + where.substring(where.lastIndexOf(' ') + 1);
        history.add(who + what + " " + History.name(error));
    }

    private void died(DeadLetter letter) {
        String reason = letter.reason();
        String why = reason.contains("full") ? "full" : reason.contains("closed") ? "closed" : "stopped";
        history.add("dead letter " + letter.message().replaceAll("[^0-9]*([0-9]+).*", "$1") + " to " + letter.actor()
                + ": " + why);
    }

    void play(List<Act> acts, @Nullable Peer self) {
        for (Act act : acts) {
            if (!history.isFull()) {
                play(act, self);
            }
        }
    }

    private void play(Act act, @Nullable Peer self) {
        switch (act.kind()) {
            case CRANK -> space.crank();
            case ADVANCE -> clock.advance(Cast.ticks(act.number()));
            case READER -> {}
            case THROW -> throw new History.Boom(act.id());
            case CLOSE -> space.close();
            case EXECUTE, ON_IDLE, SPAWN -> begin(act);
            case DELAY -> promises.put(act.id(), LibraryPromises.open(space.delay(Cast.ticks(act.number()))));
            case STOP, WATCH, TELL, ASK, OPEN, FORWARD -> send(act, self);
            case STOP_SELF, AFTER, EVERY, CANCEL_TIMER -> playAsActor(act, self);
            case NEXT, FINISH, FAIL, CANCEL_STREAM, LOOK_AT_STREAM -> streams.play(act);
            default -> promises.play(act, self);
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

    private void spawn(Act act) {
        Cast cast = Cast.of(act.number());
        String name = "A" + act.target();
        ActorSettings settings = cast.settings(name);
        actors.put(
                act.target(),
                space.spawn(
                        Peer.class,
                        () -> {
                            int instance = instances.merge(act.target(), 1, Integer::sum);
                            if (instance == cast.failingInstance()) {
                                throw new History.Boom(act.id());
                            }
                            return new Peer(this, act, name + "#" + instance);
                        },
                        cast.ownHandler()
                                ? settings.withOnError((where, error) -> failed("own handler: ", where, error))
                                : settings));
    }

    private void send(Act act, @Nullable Peer self) {
        Peer actor = actors.get(act.target());
        if (actor == null) {
            return;
        }
        var letter = new Peer.Letter(act.id(), act);
        switch (act.kind()) {
            case STOP -> space.stop(actor);
            case WATCH -> promises.put(act.id(), LibraryPromises.open(space.whenStopped(actor)));
            case TELL -> actor.tell(letter);
            case ASK -> promises.put(act.id(), actor.ask(letter));
            case OPEN -> {
                var callback = streams.reader(act, self);
                if (act.isRequest()) {
                    promises.put(act.id(), actor.streamAndAnswer(letter, callback));
                } else {
                    actor.stream(letter, callback);
                }
            }
            default -> {
                Callback<Integer> handle = streams.handle(act.id());
                if (handle != null) {
                    actor.stream(letter, handle);
                }
            }
        }
    }

    private void playAsActor(Act act, @Nullable Peer self) {
        if (self == null) {
            return;
        }
        switch (act.kind()) {
            case STOP_SELF -> self.end();
            case AFTER -> timers.put(act.id(), self.once(Cast.ticks(act.number()), () -> tick(act, self)));
            case EVERY -> timers.put(act.id(), self.again(Cast.ticks(act.number()), () -> tick(act, self)));
            default -> {
                Timer timer = timers.get(act.target());
                if (timer != null) {
                    history.add("timer " + act.target() + " cancelled: " + timer.cancel());
                }
            }
        }
    }

    private void tick(Act act, Peer self) {
        history.add("timer " + act.id() + " of " + self.name());
        play(act.script(), self);
    }

    static String name(@Nullable Peer self) {
        return self == null ? "nobody" : self.name();
    }
}
