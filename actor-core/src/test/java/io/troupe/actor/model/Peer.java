package io.troupe.actor.model;

import io.troupe.actor.Actor;
import io.troupe.actor.Callback;
import io.troupe.actor.model.Act.Answer;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.Timer;
import java.time.Duration;
import org.jspecify.annotations.Nullable;

/** The actor of the programs: runs the script of each letter. */
public class Peer extends Actor {
    /** The content of a message. */
    public record Letter(int id, Act act) {
        @Override
        public String toString() {
            return String.valueOf(id);
        }
    }

    private final LibraryRun run;
    private final Act born;
    private final String name;

    Peer(LibraryRun run, Act born, String name) {
        this.run = run;
        this.born = born;
        this.name = name;
    }

    @Override
    protected void started() {
        run.history.add(name + " starts");
        run.play(born.script(), this);
    }

    @Override
    protected void stopped() {
        run.history.add(name + " ends");
    }

    /** A one-way message. */
    public void tell(Letter letter) {
        run.history.add(name + " is told " + letter);
        run.play(letter.act.script(), this);
    }

    /** A request. */
    public @Nullable Promise<@Nullable Object> ask(Letter letter) {
        Act act = letter.act;
        run.history.add(name + " is asked " + letter);
        run.play(act.script(), this);
        return switch (Answer.of(act.number())) {
            case VALUE -> Promise.of(act.id());
            case LATER -> {
                var later = new Deferred<@Nullable Object>();
                run.promises.put(act.id() + 1, later);
                yield later;
            }
            case FAILED -> Promise.failed(new History.Boom(act.id()));
            case NULL -> null;
            case OTHER -> run.promises.getOrDefault(act.promised(), Promise.of(act.id()));
        };
    }

    /** A one-way message with a callback. */
    public void stream(Letter letter, Callback<Integer> results) {
        run.history.add(name + " streams " + letter);
        run.streams.arrive(letter.id, results);
        run.play(letter.act.script(), this);
    }

    /** A request with a callback. */
    public Promise<@Nullable Object> streamAndAnswer(Letter letter, Callback<Integer> results) {
        run.history.add(name + " streams for " + letter);
        run.streams.arrive(letter.id, results);
        run.play(letter.act.script(), this);
        return Promise.of(letter.id);
    }

    void end() {
        stop();
    }

    Timer once(Duration delay, Runnable task) {
        return after(delay, task);
    }

    Timer again(Duration period, Runnable task) {
        return every(period, task);
    }

    String name() {
        return name;
    }
}
