package io.troupe.actor;

import io.troupe.actor.internal.loop.Home;
import java.time.Duration;
import java.util.Objects;
import java.util.concurrent.CancellationException;
import java.util.concurrent.TimeoutException;
import org.jspecify.annotations.Nullable;

/** A promise with a time limit: follows another promise, or is rejected when the limit is over first. */
final class TimeLimitedPromise<T extends @Nullable Object> extends Promise<T> {
    private static final Runnable NOTHING = () -> {};

    private final Home home;
    private final Promise<T> source;
    private final Duration timeout;
    private final Outcome.@Nullable Fulfilled<T> instead; // null: a time-out rejects it
    private final String caller;
    private final boolean madeOutside;
    private volatile Runnable withdraw = NOTHING;
    private volatile boolean expired;

    private TimeLimitedPromise(Home home, Promise<T> source, Duration timeout, Outcome.@Nullable Fulfilled<T> instead) {
        this.home = home;
        this.source = source;
        this.timeout = timeout;
        this.instead = instead;
        this.madeOutside = !home.isCurrent();
        this.caller = caller();
    }

    /** @param instead the outcome when the limit is over; null = a {@link TimeoutException} */
    static <T extends @Nullable Object> Promise<T> start(
            Promise<T> source, Duration timeout, Outcome.@Nullable Fulfilled<T> instead) {
        Objects.requireNonNull(timeout, "timeout");
        Home here = Home.current();
        Home home = here != null ? here : source.home();
        if (home == null) {
            throw new IllegalStateException(
                    "a time limit needs a clock: call it in an actor space, or on a promise of one");
        }
        var limited = new TimeLimitedPromise<>(home, source, timeout, instead);
        limited.withdraw = home.schedule(Home.nanosOf(timeout), limited::expire, limited::abandon);
        source.register(new Ending(limited));
        return limited;
    }

    private static String caller() {
        Home here = Home.current();
        return here == null
                ? "thread " + Thread.currentThread().getName()
                : here.owner().toString();
    }

    private void expire() {
        expired = true; // set before settling: a failure of the source must be reported from the moment this is settled
        if (instead != null ? settleValue(instead.value()) : settleError(timedOutError())) {
            source.timedOut();
            home.limitExpired();
        } else {
            expired = false;
        }
    }

    /** The error of the time-out; what makes it impossible is the error instead: the outcome must not depend on it. */
    private Throwable timedOutError() {
        try {
            return new TimeoutException("no answer to " + caller + " within " + timeout + " from " + source.name()
                    + PromiseText.progress(source));
        } catch (Throwable noText) {
            return noText;
        }
    }

    private void abandon() {
        settleError(closedError());
    }

    private Throwable closedError() {
        try {
            return new CancellationException("space " + home + " was closed before " + source.name() + " was settled");
        } catch (Throwable noText) {
            return noText;
        }
    }

    @Override
    void cancelled() {
        withdraw.run();
    }

    @Override
    Home home() {
        return home;
    }

    @Override
    boolean madeOutside() {
        return madeOutside;
    }

    @Override
    Promise<T> source() {
        return source;
    }

    Duration timeout() {
        return timeout;
    }

    @Override
    public String toString() {
        return PromiseText.describe(this);
    }

    /** Cancels the timer and passes the outcome on. */
    private static final class Ending extends Listeners.Follower {
        private final TimeLimitedPromise<?> limited;

        Ending(TimeLimitedPromise<?> limited) {
            super(limited);
            this.limited = limited;
        }

        @Override
        void beforeSettling() {
            limited.withdraw.run();
        }

        @Override
        protected boolean hasTimedOut() {
            return limited.expired;
        }
    }
}
