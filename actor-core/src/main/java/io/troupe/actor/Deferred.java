package io.troupe.actor;

import io.troupe.actor.internal.loop.Home;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * A promise that is settled by hand.
 *
 * <p><b>Role.</b> Answers a request later than the call returns: return the promise, keep the deferred. Until it is
 * settled, the actor retains the request with its arguments. If the actor ends first, the request is rejected, and
 * settling the deferred then has no effect on the request.
 *
 * {@snippet :
 * public Promise<Boolean> waitForCoin() {
 *     coin = new Deferred<>();
 *     return coin; // answered later
 * }
 *
 * public void insertCoin() {
 *     if (coin != null) {
 *         coin.resolve(true);
 *     }
 * }
 * }
 *
 * <p><b>Threads.</b> Any thread may settle it; the first call wins.
 *
 * <p>There are three ways to create one. They differ in its space, where listeners run that are registered outside
 * every space:
 *
 * <ul>
 *   <li>{@code new Deferred<>()}: the space whose thread is calling, and none outside every space. For actors.
 *   <li>{@code space.deferred()}: that space, whichever thread is calling. For tests, and for code between threads.
 *   <li>{@link #unbound}: none, whichever thread is calling. For code that hands every outcome to a reader itself.
 * </ul>
 *
 * <p><b>Errors.</b> A rejection without a listener is reported to the error handler of the promise's space. That of a
 * deferred without a space is not reported.
 */
public final class Deferred<T extends @Nullable Object> extends Promise<T> {
    private final @Nullable Home home;
    private final boolean madeOutside;
    private final @Nullable Runnable ifCancelled;

    /** Creates a deferred of the space whose thread is calling; outside every space, of none. */
    public Deferred() {
        this(Home.current(), null);
    }

    /**
     * Creates a deferred of an event loop, or of none.
     *
     * @param ifCancelled runs on the thread that cancels the promise
     */
    Deferred(@Nullable Home home, @Nullable Runnable ifCancelled) {
        this.home = home;
        this.madeOutside = home != null && !home.isCurrent();
        this.ifCancelled = ifCancelled;
    }

    /**
     * Creates a deferred of no space, on whichever thread it is called: a listener that is registered outside every
     * space runs on the thread that settles it, and a rejection without a listener is not reported.
     */
    public static <T extends @Nullable Object> Deferred<T> unbound() {
        return new Deferred<>(null, null);
    }

    @Override
    void cancelled() {
        if (ifCancelled != null) {
            ifCancelled.run();
        }
    }

    boolean isForOneCaller() {
        return ifCancelled instanceof LibraryAccess.Work;
    }

    @Override
    boolean madeOutside() {
        return madeOutside;
    }

    /** Fulfils the promise; false if it was already settled. */
    public boolean resolve(T value) {
        return settleValue(value);
    }

    /** Rejects the promise; false if it was already settled. */
    public boolean reject(Throwable error) {
        return settleError(error);
    }

    /**
     * True if no caller waits for the outcome any more, so that the work for it can be dropped: it is settled, or the
     * callers of each request that it answers have cancelled or timed out, and there is no other listener. Callers may
     * cancel at any time: an actor with a queue of jobs asks before it begins each of them. Any thread.
     */
    public boolean isAbandoned() {
        return isGivenUp();
    }

    /** Settles this promise with the outcome of another one, as soon as that is settled. */
    public void resolveFrom(Promise<? extends T> other) {
        follow(Objects.requireNonNull(other, "other"));
    }

    @Override
    @Nullable
    Home home() {
        return home;
    }

    @Override
    String name() {
        return isForOneCaller() ? String.valueOf(ifCancelled) : PromiseText.describe(this);
    }

    @Override
    public String toString() {
        return PromiseText.withOutcome(isForOneCaller() ? name() : "promise", this);
    }
}
