package io.troupe.actor;

import io.troupe.actor.Reports.Trouble;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.TurnOwner;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CancellationException;
import java.util.concurrent.TimeoutException;
import org.jspecify.annotations.Nullable;

/**
 * The time limit of a request and of all requests that are sent to answer it; see {@link ActorSpace#within}.
 *
 * <p>A turn with a limit passes it on to the requests that it sends and to the listeners that it registers. When the
 * limit is over, the requests that are not answered are rejected, so those that are still queued are not begun.
 *
 * <p><b>Threads.</b> Any thread; guarded by its own monitor. <b>Cost.</b> One timer, whatever the number of requests.
 */
final class TimeLimit {
    private static final int FEW = 8;

    private record Asked(Request<?> request, TurnOwner caller) {}

    private final SpaceHome home; // by whose clock
    private final Duration limit;
    private final long deadlineNanos;
    private final List<Deferred<?>> questions = new ArrayList<>(2); // guarded by this
    private @Nullable TurnOwner caller; // of the last request; guarded by this
    private List<Asked> open = new ArrayList<>(1);
    private int sweepAt = FEW;
    private @Nullable Runnable withdraw; // of the timer, while it is set
    private boolean over;

    private TimeLimit(SpaceHome home, Duration limit, long deadlineNanos) {
        this.home = home;
        this.limit = limit;
        this.deadlineNanos = deadlineNanos;
    }

    /**
     * Creates a limit.
     *
     * @param outer the limit of the current turn, which is not extended; or null
     */
    static TimeLimit of(SpaceHome home, Duration limit, @Nullable TimeLimit outer) {
        Duration shorter = outer == null || outer.left().compareTo(limit) > 0 ? limit : outer.left();
        long now = home.settings.clock().nanos();
        long deadline = now + Home.nanosOf(shorter);
        boolean overflows = !shorter.isNegative() && deadline < now;
        return new TimeLimit(home, limit, overflows ? Long.MAX_VALUE : deadline);
    }

    /** The limit of the turn in which the calling thread is, or null. */
    static @Nullable TimeLimit current() {
        if (Thread.currentThread() instanceof SpaceThread thread && thread.isDirect()) {
            return null; // the usual case, without a look at the thread-local
        }
        return Home.current() instanceof SpaceHome here ? here.limit() : null;
    }

    /** The time that is left; zero if the limit is over. */
    Duration left() {
        return Duration.ofNanos(
                Math.max(0, deadlineNanos - home.settings.clock().nanos()));
    }

    /**
     * Rejects this promise, too, when the limit is over: that of {@link ActorSpace#within}. On the thread of its
     * caller.
     */
    synchronized void limit(Deferred<?> question) {
        questions.add(question);
        caller = caller();
        setTimer();
    }

    private void setTimer() {
        if (withdraw == null) {
            withdraw = home.schedule(left().toNanos(), this::expire, this::abandon);
        }
    }

    /** Rejects this request when the limit is over, unless it is answered by then. On the thread of its caller. */
    void add(Request<?> request) {
        var asked = new Asked(request, caller());
        synchronized (this) {
            if (!over) {
                if (open.size() >= sweepAt) {
                    sweep();
                    sweepAt = Math.max(FEW, 2 * open.size());
                }
                open.add(asked);
                setTimer();
                return;
            }
        }
        reject(asked);
    }

    private TurnOwner caller() {
        Home here = Home.current();
        return here == null ? home.itself() : here.owner();
    }

    private void sweep() {
        open.removeIf(each -> each.request.isDone());
    }

    /** Called when the function's promise is settled: removes the timer, unless other requests still need it. */
    synchronized void answered() {
        if (over) {
            return;
        }
        sweep();
        if (open.isEmpty() && withdraw != null) {
            withdraw.run();
            withdraw = null;
        }
    }

    /** Rejects the requests that are not answered, if the limit is over: its timer may be late. */
    void check() {
        if (deadlineNanos - home.settings.clock().nanos() <= 0) {
            expire();
        }
    }

    private void expire() {
        List<Asked> expired;
        synchronized (this) {
            over = true;
            expired = open;
            open = List.of();
        }
        Throwable first = null;
        for (int index = 0; index < expired.size(); index++) {
            Throwable error = reject(expired.get(index));
            first = first == null ? error : first;
        }
        if (first == null && newestQuestion().isDone()) {
            return;
        }
        if (first == null) {
            home.limitExpired();
            first = pendingError();
        }
        rejectQuestions(first);
    }

    private synchronized Deferred<?> newestQuestion() {
        return questions.getLast();
    }

    private synchronized Throwable pendingError() {
        try {
            return new TimeoutException("no answer to " + caller + " within " + limit
                    + ": the promise of the function is still pending, and it waits for no request to an actor");
        } catch (Throwable noText) {
            return noText;
        }
    }

    /** Rejects the questions, the newest first: two if it was asked from outside, or one that is about to be asked. */
    private void rejectQuestions(Throwable why) {
        for (int index = 1; index >= 0; index--) {
            Deferred<?> question = question(index);
            try {
                if (question != null) {
                    question.reject(why);
                }
            } catch (Throwable broken) { // a dependent of a future: the other question is rejected all the same
                home.reports().error(Trouble.THE_END_OF_A_REQUEST, home, broken);
            }
        }
    }

    private synchronized @Nullable Deferred<?> question(int index) {
        return index < questions.size() ? questions.get(index) : null;
    }

    private void abandon() {
        rejectQuestions(closedError());
    }

    private Throwable closedError() {
        try {
            return new CancellationException("space " + home + " was closed before the request was answered");
        } catch (Throwable noText) {
            return noText;
        }
    }

    /**
     * Rejects a request whatever its text is, and whatever its listeners throw; returns the error, or null if it was
     * settled before.
     */
    private @Nullable Throwable reject(Asked asked) {
        Request<?> request = asked.request;
        if (request.isDone()) {
            return null;
        }
        Throwable error = lateError(asked);
        if (!home.reports().reject(request, error)) {
            return null;
        }
        home.limitExpired();
        home.reports().logArgumentsOfLate(request);
        return error;
    }

    private Throwable lateError(Asked asked) {
        Request<?> request = asked.request;
        try {
            return new TimeoutException("no answer to " + asked.caller + " within " + limit + " from " + request.name()
                    + request.progressNow());
        } catch (Throwable noText) {
            return noText;
        }
    }
}
