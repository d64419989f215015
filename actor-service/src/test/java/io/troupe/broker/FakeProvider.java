package io.troupe.broker;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.util.ArrayDeque;
import java.util.Deque;
import java.util.List;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/** A provider scripted by a test; records its calls. */
final class FakeProvider implements Provider {
    private final String name;
    private final List<String> diary;
    final Deque<Deferred<@Nullable Void>> unanswered = new ArrayDeque<>();
    Supplier<Promise<@Nullable Void>> start = Promise::done;
    Supplier<Promise<@Nullable Void>> stop = Promise::done;
    Supplier<Promise<@Nullable Void>> check = Promise::done;
    Deferred<@Nullable Void> end = new Deferred<>(null);

    FakeProvider(String name, List<String> diary) {
        this.name = name;
        this.diary = diary;
    }

    /** Returns a promise that only the test settles. */
    Promise<@Nullable Void> hang() {
        var answer = new Deferred<@Nullable Void>(null);
        unanswered.add(answer);
        return answer;
    }

    Promise<@Nullable Void> fail() {
        return Promise.failed(new IllegalStateException(name + " is broken"));
    }

    Promise<@Nullable Void> explode() {
        throw new IllegalStateException(name + " exploded");
    }

    /** Ends the current run with an error. */
    void die(String why) {
        end.reject(new IllegalStateException(why));
    }

    @Override
    public Promise<@Nullable Void> start() {
        diary.add("start " + name);
        end = new Deferred<>(null);
        return start.get();
    }

    @Override
    public Promise<@Nullable Void> stop() {
        diary.add("stop " + name);
        return stop.get();
    }

    @Override
    public Promise<@Nullable Void> check() {
        return check.get();
    }

    @Override
    public Promise<@Nullable Void> whenEnded() {
        return end;
    }
}
