package io.troupe.actor;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.util.concurrent.Callable;
import java.util.concurrent.Semaphore;
import org.jspecify.annotations.Nullable;

/** Runs blocking work on virtual threads, with a limit on concurrent runs; the result is a promise. */
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
                if (!answer.isDone()) { // else it was cancelled before it began
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
