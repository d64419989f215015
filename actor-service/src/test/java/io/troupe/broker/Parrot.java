package io.troupe.broker;

import io.troupe.actor.Callback;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import java.util.ArrayDeque;
import java.util.Deque;
import java.util.List;
import org.jspecify.annotations.Nullable;

/** An actor type with every kind of method. */
interface Parrot {
    Promise<String> say(String text);

    Promise<String> sayLater(String text);

    Promise<@Nullable Void> fail(String why);

    void hear(String text);

    void count(int to, Callback<Integer> callback);

    default Promise<String> sayTwice(String text) {
        return say(text).thenCombine(say(text), (a, b) -> a + ", " + b);
    }

    /** A parrot that records its calls together with its name. */
    record Grey(String name, List<String> diary, Deque<Deferred<String>> later) implements Parrot {
        Grey(String name, List<String> diary) {
            this(name, diary, new ArrayDeque<>());
        }

        @Override
        public Promise<String> say(String text) {
            diary.add(name + " says " + text);
            return Promise.of(name + ": " + text);
        }

        @Override
        public Promise<String> sayLater(String text) {
            diary.add(name + " begins " + text);
            later.add(Deferred.unbound());
            return later.getLast();
        }

        @Override
        public Promise<@Nullable Void> fail(String why) {
            throw new UnsupportedOperationException(why);
        }

        @Override
        public void hear(String text) {
            diary.add(name + " hears " + text);
        }

        @Override
        public void count(int to, Callback<Integer> callback) {
            for (int i = 1; i <= to; i++) {
                callback.next(i);
            }
            callback.finish();
        }
    }
}
