package io.troupe.actor.promise;

import java.time.Duration;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

/** The listener of a thread outside every space that waits for a promise. */
final class Waiter extends Node {
    private final CountDownLatch settled = new CountDownLatch(1);
    private volatile boolean gone;

    private Waiter() {}

    static void await(Promise<?> promise, Duration timeout) throws TimeoutException, InterruptedException {
        if (Home.current() != null) {
            throw new IllegalStateException(
                    "get() would stop the whole space, and with it whoever could settle "
                            + promise
                            + ": register what comes next with then(..), return thenCompose(..), or write await() in the body of sequential(..)");
        }
        if (DetachedListeners.isRunning()) {
            throw new IllegalStateException(
                    "get() in a listener would keep the other listeners of this thread from running, and with them whoever could settle "
                            + promise + ": register what comes next with then(..)");
        }
        if (promise.isDone()) {
            promise.markHandled();
            return;
        }
        var waiter = new Waiter();
        promise.register(waiter);
        try {
            if (!waiter.settled.await(Home.nanosOf(timeout), TimeUnit.NANOSECONDS)) {
                throw new TimeoutException("no answer within " + timeout + " from " + promise);
            }
        } finally {
            waiter.gone = true;
        }
    }

    @Override
    protected void run() {
        settled.countDown();
    }

    @Override
    boolean isIdle() {
        return gone;
    }

    @Override
    boolean hasTimedOut() {
        return gone;
    }
}
