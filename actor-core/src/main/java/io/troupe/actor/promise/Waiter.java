package io.troupe.actor.promise;

import java.time.Duration;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

/** A thread that waits for a promise from outside. */
final class Waiter {
    private Waiter() {}

    static void await(Promise<?> promise, Duration timeout) throws TimeoutException, InterruptedException {
        if (Home.current() != null) {
            throw new IllegalStateException("get() would stop the whole space, and with it whoever could settle "
                    + promise + ": register what comes next with then(..), or return thenCompose(..)");
        }
        if (promise.isDone()) {
            promise.register(new Relay(() -> {}));
            return;
        }
        var settled = new CountDownLatch(1);
        promise.register(new Relay(settled::countDown));
        if (!settled.await(timeout.toNanos(), TimeUnit.NANOSECONDS)) {
            throw new TimeoutException("no answer within " + timeout + " from " + promise);
        }
    }
}
