package io.troupe.actor.model;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.util.Map;
import java.util.TreeMap;
import org.jspecify.annotations.Nullable;

/** The promises of a program that runs on the library. */
final class LibraryPromises {
    private final LibraryRun run;
    private final Map<Integer, Promise<@Nullable Object>> promises = new TreeMap<>();

    LibraryPromises(LibraryRun run) {
        this.run = run;
    }

    void put(int id, Promise<@Nullable Object> promise) {
        promises.put(id, promise);
    }

    Promise<@Nullable Object> getOrDefault(int id, Promise<@Nullable Object> other) {
        return promises.getOrDefault(id, other);
    }

    /** Adds the state of all promises to the history. */
    void tell() {
        promises.forEach((id, promise) -> run.history.add("promise " + id + " " + History.outcome(promise)));
    }

    @SuppressWarnings({"unchecked", "rawtypes"}) // a promise of Void, used as one of any type
    static Promise<@Nullable Object> open(Promise<?> promise) {
        return (Promise) promise;
    }

    void play(Act act, @Nullable Peer self) {
        if (act.kind() == Act.Kind.DEFER) {
            promises.put(act.id(), new Deferred<>());
            return;
        }
        Promise<@Nullable Object> promise = promises.get(act.target());
        if (promise == null) {
            return;
        }
        String told = act.kind() + " " + act.id() + ": ";
        switch (act.kind()) {
            case RESOLVE -> {
                if (promise instanceof Deferred<@Nullable Object> deferred) {
                    run.history.add(told + deferred.resolve(act.id()));
                }
            }
            case REJECT -> {
                if (promise instanceof Deferred<@Nullable Object> deferred) {
                    run.history.add(told + deferred.reject(new History.Boom(act.id())));
                }
            }
            case CANCEL -> run.history.add(told + promise.cancel());
            default -> promises.put(act.id(), listen(promise, act, self));
        }
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
        run.history.add(
                "listener " + act.id() + " of " + LibraryRun.name(self) + " hears " + History.outcome(value, error));
        run.play(act.script(), self);
        return act.id();
    }
}
