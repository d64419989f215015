package io.troupe.actor;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.util.concurrent.Callable;
import java.util.concurrent.Semaphore;
import org.jspecify.annotations.Nullable;

/** Blocking work on virtual threads, so many at a time; the answer comes back as a promise. */
final class Offload {
    private final Semaphore places;

    Offload(int limit) {
        places = new Semaphore(limit, true);
    }

    <T extends @Nullable Object> Promise<T> run(ActorSpace space, Callable<? extends T> work) {
        var answer = new Deferred<T>(space);
        Thread.ofVirtual().name("offload").start(() -> {
            places.acquireUninterruptibly();
            try {
                if (!answer.isDone()) { // else cancelled before it began
                    answer.resolve(work.call());
                }
            } catch (Throwable thrown) {
                answer.reject(thrown);
            } finally {
                places.release();
            }
        });
        return answer;
    }
}
