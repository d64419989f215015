package io.troupe.actor;

import io.troupe.actor.Listeners.Follower;
import io.troupe.actor.Listeners.Many;
import io.troupe.actor.SettledState.PendingNotification;
import io.troupe.actor.SettledState.Rejection;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.QueueEntries;
import io.troupe.actor.internal.loop.QueueEntry;
import io.troupe.actor.internal.loop.TurnOwner;
import java.lang.invoke.MethodHandles;
import java.lang.invoke.VarHandle;
import java.util.Objects;
import java.util.concurrent.CancellationException;
import java.util.function.BooleanSupplier;
import org.jspecify.annotations.Nullable;

/**
 * The state of a promise: pending with its listeners, or settled.
 *
 * <p><b>Threads.</b> A <i>local</i> promise was made on its home's thread and changes only there, by plain stores;
 * operations of other threads are posted to its home. A <i>shared</i> promise changes on any thread, by
 * compare-and-set. Both may be read on any thread.
 */
abstract class Settleable<T extends @Nullable Object> extends QueueEntry {
    /*
     * One field holds the whole state, so that one compare-and-set decides between "settle" and "register":
     *   null                   pending, without listeners
     *   a QueueEntry                 pending, with listeners: the newest, linked to the older ones,
     *                          or Many if there are more than a few
     *   a PendingNotification  settled by a thread other than that of some listener, which may not have run yet
     *   anything else          settled: the value itself, NULL, a Rejection, or a Boxed value (one that would be
     *                          mistaken for one of the above)
     */
    private static final Object NULL = new Object();
    private static final Rejection WITHOUT_MEMORY = new Rejection(new NoMemory());
    /** Without a stack trace, which would keep the classes of the first caller. */
    private static final class NoMemory extends OutOfMemoryError {
        private static final long serialVersionUID = 1;

        NoMemory() {
            super("there is no memory for the error of this promise");
        }

        @Override
        public Throwable fillInStackTrace() {
            return this;
        }
    }

    private static final VarHandle STATE;

    static {
        try {
            STATE = MethodHandles.lookup().findVarHandle(Settleable.class, "state", Object.class);
        } catch (ReflectiveOperationException e) {
            throw new ExceptionInInitializerError(e);
        }
    }

    private @Nullable Object state;

    Settleable() {}

    /** Creates a settled promise; the fence publishes it safely. */
    Settleable(Object outcome) {
        state = outcome;
        VarHandle.storeStoreFence();
    }

    /**
     * The home where listeners from outside every space run, and where an unhandled rejection is reported; null if
     * there is none.
     */
    abstract @Nullable Home home();

    /** True if it changes on its home's thread only. */
    boolean isLocal() {
        return false;
    }

    /** True if it was made by a thread outside its home, which may need a moment to register a listener. */
    boolean madeOutside() {
        return false;
    }

    // ---- reading

    public final boolean isDone() {
        return isSettled(STATE.getAcquire(this));
    }

    private static boolean isSettled(@Nullable Object state) {
        return state != null && !(state instanceof QueueEntry);
    }

    /** The outcome, or null while pending. */
    final @Nullable Object outcomeNow() {
        Object now = STATE.getAcquire(this);
        return now instanceof PendingNotification notification ? notification.outcome() : isSettled(now) ? now : null;
    }

    /** The outcome, for a listener that is about to run. */
    final Object outcomeForListener() {
        Object now = STATE.getAcquire(this);
        if (now instanceof PendingNotification notification) {
            notification.listenerRuns();
            return notification.outcome();
        }
        return Objects.requireNonNull(now);
    }

    static Object asOutcome(@Nullable Object value) {
        if (value == null) {
            return NULL;
        }
        return value instanceof QueueEntry || value instanceof SettledState ? new SettledState.Boxed(value) : value;
    }

    @SuppressWarnings("unchecked") // only asOutcome stores values
    final T valueOf(Object outcome) {
        return (T) Stage.present(plainValue(outcome));
    }

    static @Nullable Object plainValue(Object outcome) {
        if (outcome == NULL) {
            return null;
        }
        return outcome instanceof SettledState.Boxed boxed ? boxed.value() : outcome;
    }

    /** True if a listener has received, or will receive, the outcome. */
    final boolean isHandled() {
        Object now = STATE.getAcquire(this);
        Object outcome = now instanceof PendingNotification notification ? notification.outcome() : now;
        return outcome instanceof QueueEntry || outcome instanceof Rejection rejection && rejection.isHandled();
    }

    /**
     * True if it is settled, or if no listener registered so far still needs the outcome; a thread whose wait timed out
     * counts as a listener, because it may wait again. For promises that are not local.
     */
    final boolean isGivenUp() {
        while (true) {
            Object now = STATE.getAcquire(this);
            if (!(now instanceof QueueEntry newest)) {
                return now != null;
            }
            boolean givenUp = newest instanceof Many many ? many.areGivenUp() : Many.areGivenUp(newest);
            VarHandle.acquireFence();
            if (STATE.getAcquire(this) == now) {
                return givenUp;
            } // else another thread may have changed the links meanwhile
        }
    }

    /** True if a time limit on this promise has passed, perhaps not that of every listener; see {@link #isGivenUp}. */
    boolean mayBeGivenUp() {
        return false;
    }

    /** True if the promise was made by a thread outside its home; see {@link #madeOutside}. */
    static boolean isMadeOutside(Promise<?> promise) {
        return ((Settleable<?>) promise).madeOutside();
    }

    /** True if a listener of the promise has received, or will receive, the outcome. */
    static boolean isHandled(Promise<?> promise) {
        return ((Settleable<?>) promise).isHandled();
    }

    /**
     * Runs an action when the promise is settled, on the thread that settles it.
     *
     * @param isOver true once the action is no longer needed, so that the promise may drop it; called by any thread
     */
    static void whenSettled(Promise<?> promise, BooleanSupplier isOver, Runnable action) {
        promise.register(new Listeners.Inline(action, isOver));
    }

    /** Marks a rejection as received. */
    final void markHandled() {
        if (outcomeNow() instanceof Rejection rejection) {
            rejection.markHandled();
        }
    }

    // ---- settling

    /** A rejection; if there is no memory for it, one that all such promises share. */
    private static Rejection rejection(Throwable error) {
        try {
            return new Rejection(Objects.requireNonNull(error, "error"));
        } catch (OutOfMemoryError full) {
            return WITHOUT_MEMORY;
        }
    }

    /** Fulfils this promise, like {@link #settleValue}; on its home's thread, or if it has no home. */
    final boolean settleValueAtHome(T value) {
        return settleAtHome(asOutcome(value));
    }

    /** Rejects this promise, like {@link #settleError}; on its home's thread, or if it has no home. */
    final boolean settleErrorAtHome(Throwable error) {
        return settleAtHome(rejection(error));
    }

    /**
     * Settles this promise with the outcome of the other one, like {@link #follow}; on its home's thread.
     *
     * @return the listener that must be run next and is in no queue, or null
     */
    final @Nullable QueueEntry followAtHome(Promise<? extends T> other) {
        Object outcome = other.outcomeNow();
        if (outcome == null || other == this) {
            followPending(other);
            return null;
        }
        Object mine = copyOf(outcome);
        QueueEntry listeners = claimOnThisThread(mine);
        Home here = home();
        if (here != null && listeners instanceof Stage<?, ?> only && QueueEntries.next(only) == null) {
            return only.returnOrEnqueue(here); // the usual case, by the shortest path
        }
        finish(listeners, mine);
        return null;
    }

    /** The rest of {@link #followAtHome} if the other promise is still pending. */
    void followPending(Promise<? extends T> other) {
        follow(other);
    }

    /** Like {@link #follow}; until it is settled, this promise is one of the owner's open requests. */
    final void follow(Promise<? extends T> other, TurnOwner owner) {
        Listeners.OpenRequests.follow(this, other, owner);
    }

    final boolean settleAtHome(Object outcome) {
        QueueEntry listeners = claimOnThisThread(outcome);
        Home here = home();
        if (here != null && listeners instanceof Stage<?, ?> only && QueueEntries.next(only) == null) {
            only.dispatch(here);
            return true;
        }
        return finish(listeners, outcome);
    }

    /** Fulfils this promise; false if it was already settled. */
    final boolean settleValue(T value) {
        return settle(asOutcome(value));
    }

    /** Rejects this promise; false if it was already settled. */
    final boolean settleError(Throwable error) {
        return settle(rejection(error));
    }

    /** Settles this promise with the outcome of the other one, as soon as that is settled. */
    final void follow(Promise<? extends T> other) {
        if (other == this) {
            settleError(new IllegalStateException("a promise cannot wait for itself: " + this));
            return;
        }
        Object outcome = other.outcomeNow();
        if (outcome == null) {
            other.register(new Follower(this));
        } else {
            settle(copyOf(outcome));
        }
    }

    /**
     * The outcome to settle a following promise with. Each promise has a separate rejection, since each has its own
     * listeners.
     */
    private static Object copyOf(Object outcome) {
        if (outcome instanceof Rejection rejection) {
            rejection.markHandled();
            return rejection(rejection.error());
        }
        return outcome;
    }

    /**
     * Settles this promise; false if it was already settled. For a local promise and a caller on another thread, true
     * means that it was pending, and it is settled a moment later.
     */
    private boolean settle(Object outcome) {
        return finish(claim(outcome), outcome);
    }

    private static boolean finish(@Nullable QueueEntry listeners, Object outcome) {
        if (listeners == AlreadySettled.INSTANCE) {
            return false;
        }
        if (listeners != null) {
            notifyListeners(listeners, outcome);
        }
        return true;
    }

    /**
     * Settles this promise and returns its listeners, newest first; {@link AlreadySettled#INSTANCE} if it was already
     * settled.
     */
    private @Nullable QueueEntry claim(Object outcome) {
        if (!isLocal()) {
            return claimShared(outcome);
        }
        Home home = Objects.requireNonNull(home());
        return home.isCurrent() ? claimAtHome(outcome) : claimRemotely(outcome, home);
    }

    /** Like {@link #claim}; on the home's thread, or if there is no home. */
    private @Nullable QueueEntry claimOnThisThread(Object outcome) {
        if (!isLocal()) {
            return claimShared(outcome);
        }
        if (state instanceof Stage<?, ?> only && QueueEntries.next(only) == null && !(outcome instanceof Rejection)) {
            STATE.setRelease(this, outcome);
            return only;
        }
        return claimAtHome(outcome);
    }

    private @Nullable QueueEntry claimAtHome(Object outcome) {
        Object now = state;
        if (isSettled(now)) {
            return AlreadySettled.INSTANCE;
        }
        var listeners = (QueueEntry) now;
        if (listeners instanceof Many many) {
            listeners = many.link();
        }
        STATE.setRelease(this, outcome);
        if (outcome instanceof Rejection rejection) {
            noteRejection(rejection, listeners);
        }
        return listeners;
    }

    private @Nullable QueueEntry claimRemotely(Object outcome, Home home) {
        if (isDone()) {
            return AlreadySettled.INSTANCE;
        }
        home.enqueue(new PostedAction(home, () -> settle(outcome)));
        return null;
    }

    private @Nullable QueueEntry claimShared(Object outcome) {
        while (true) {
            Object now = STATE.getAcquire(this);
            if (isSettled(now)) {
                return AlreadySettled.INSTANCE;
            }
            if (now instanceof Many many) {
                QueueEntry listeners;
                PendingNotification notification;
                synchronized (many) {
                    if (many.isClosed()) {
                        continue; // another thread has settled it
                    }
                    listeners = many.link();
                    notification = notificationFor(outcome, listeners);
                    many.close();
                    STATE.setVolatile(this, notification == null ? outcome : notification);
                }
                return claimed(outcome, listeners, notification); // outside the lock: it may call user handlers
            }
            var listeners = (QueueEntry) now;
            PendingNotification notification = notificationFor(outcome, listeners);
            if (STATE.compareAndSet(this, now, notification == null ? outcome : notification)) {
                return claimed(outcome, listeners, notification);
            }
        }
    }

    /** The notification that keeps late listeners behind the earlier ones; null if there is no memory for it. */
    private static @Nullable PendingNotification notificationFor(Object outcome, @Nullable QueueEntry listeners) {
        if (listeners == null || !PendingNotification.isNeeded(listeners)) {
            return null;
        }
        try {
            return new PendingNotification(outcome, listeners);
        } catch (OutOfMemoryError full) { // the outcome is more important than the order
            return null;
        }
    }

    private @Nullable QueueEntry claimed(
            Object outcome, @Nullable QueueEntry listeners, @Nullable PendingNotification notification) {
        if (outcome instanceof Rejection rejection) {
            noteRejection(rejection, listeners);
        }
        return notification == null || listeners == null ? listeners : notification.end(listeners);
    }

    private void noteRejection(Rejection rejection, @Nullable QueueEntry listeners) {
        Home place = home();
        if (isHandledBy(listeners)) {
            rejection.markHandled();
        } else if (place != null && !(rejection.error() instanceof CancellationException)) {
            if (listeners == null) {
                place.rejected(this, rejection.error());
            } else {
                place.rejectedTooLate(this, rejection.error());
            }
        }
    }

    private static boolean isHandledBy(@Nullable QueueEntry listeners) {
        for (QueueEntry node = listeners; node != null; node = QueueEntries.next(node)) {
            if (!QueueEntries.hasTimedOut(node)) {
                return true;
            }
        }
        return false;
    }

    /**
     * Notifies listeners, oldest first. Promises that only follow are settled in this loop, not recursively, so a chain
     * of them may have any length.
     */
    private static void notifyListeners(QueueEntry newest, Object outcome) {
        if (QueueEntries.next(newest) == null && newest instanceof Stage<?, ?> only) {
            only.dispatch();
            return;
        }
        QueueEntry waiting = reverse(newest, null);
        Throwable first = null;
        while (waiting != null) {
            QueueEntry listener = waiting;
            waiting = QueueEntries.next(listener);
            QueueEntries.link(listener, null);
            if (listener instanceof Follower follower) {
                follower.beforeSettling();
                QueueEntry more = follower.isIdle() ? AlreadySettled.INSTANCE : follower.promise.claim(copyOf(outcome));
                waiting = more == AlreadySettled.INSTANCE ? waiting : reverse(more, waiting);
            } else if (listener instanceof PendingNotification.End end) {
                waiting = reverse(end.closeOrTakeLate(), waiting);
            } else {
                try {
                    dispatch(listener);
                } catch (Throwable broken) { // the others are notified all the same
                    first = first == null ? broken : first;
                }
            }
        }
        if (first != null) {
            throw QueueEntries.rethrow(first);
        }
    }

    /** Puts a list (newest first) in front of another list (oldest first). */
    private static @Nullable QueueEntry reverse(@Nullable QueueEntry newest, @Nullable QueueEntry rest) {
        QueueEntry oldest = rest;
        for (QueueEntry node = newest; node != null; ) {
            QueueEntry before = QueueEntries.next(node);
            QueueEntries.link(node, oldest);
            oldest = node;
            node = before;
        }
        return oldest;
    }

    // ---- registering listeners

    /**
     * Registers a listener.
     *
     * @param atHome true if the calling thread is known to be that of this promise's home
     */
    final void register(QueueEntry listener, boolean atHome) {
        if (atHome && isLocal()) {
            registerAtHome(listener);
        } else {
            register(listener);
        }
    }

    /**
     * Registers an entry that is notified when this promise is settled, immediately if it is already settled. Stages go
     * to their home's queue, inline listeners run on the current thread.
     */
    final void register(QueueEntry listener) {
        if (!isLocal()) {
            registerShared(listener);
            return;
        }
        Home home = Objects.requireNonNull(home());
        if (home.isCurrent()) {
            registerAtHome(listener);
        } else {
            home.enqueue(new PostedAction(home, () -> registerAtHome(listener)));
        }
    }

    private void registerAtHome(QueueEntry listener) {
        Object now = state;
        if (now == null) {
            QueueEntries.link(listener, null);
            STATE.setRelease(this, listener);
        } else if (isSettled(now)) {
            notifyLate(listener, now);
        } else if (now instanceof Many many) {
            many.add(listener);
        } else {
            STATE.setRelease(this, with((QueueEntry) now, listener));
        }
    }

    private void registerShared(QueueEntry listener) {
        while (true) {
            Object now = STATE.getAcquire(this);
            if (now instanceof PendingNotification notification) {
                boolean behindOthers = notification.countListener(listener);
                if (!notification.append(listener)) {
                    notifyAfterwards(listener, notification.outcome(), behindOthers);
                }
                return;
            }
            if (isSettled(now)) {
                notifyLate(listener, now);
                return;
            }
            if (now instanceof Many many) {
                if (many.add(listener)) {
                    return;
                } // else it is settled now
            } else if (STATE.compareAndSet(this, now, with((QueueEntry) now, listener))) {
                return;
            }
        }
    }

    /**
     * Adds a listener to a list. Listeners at the head that are no longer needed are removed, so a long-lived promise
     * does not accumulate them.
     */
    private static QueueEntry with(@Nullable QueueEntry newest, QueueEntry listener) {
        QueueEntry first = firstWithUse(newest);
        if (Many.isMany(first)) {
            return new Many(first, listener);
        }
        QueueEntries.link(listener, first);
        return listener;
    }

    private static @Nullable QueueEntry firstWithUse(@Nullable QueueEntry newest) {
        QueueEntry node = newest;
        while (node != null && QueueEntries.isIdle(node)) {
            node = QueueEntries.next(node);
        }
        return node;
    }

    private static void notifyLate(QueueEntry listener, Object outcome) {
        if (outcome instanceof Rejection rejection) {
            rejection.markHandled();
        }
        QueueEntries.link(listener, null);
        notifyListeners(listener, outcome);
    }

    private static void notifyAfterwards(QueueEntry listener, Object outcome, boolean behindOthers) {
        if (behindOthers && listener instanceof Stage<?, ?> stage) {
            if (outcome instanceof Rejection rejection) {
                rejection.markHandled();
            }
            QueueEntries.link(stage, null);
            stage.dispatchAsRemote();
        } else {
            notifyLate(listener, outcome);
        }
    }

    private static void dispatch(QueueEntry listener) {
        if (listener instanceof Stage<?, ?> stage) {
            stage.dispatch();
        } else {
            Listeners.runDetached(listener);
        }
    }

    /** An operation on a local promise, posted by another thread to the promise's home. */
    private static final class PostedAction extends QueueEntry {
        private final Home home;
        private final Runnable action;

        PostedAction(Home home, Runnable action) {
            this.home = home;
            this.action = action;
        }

        @Override
        protected @Nullable QueueEntry serve() {
            home.beginForItself();
            action.run();
            return null;
        }
    }

    /** Sentinel: the promise was already settled. */
    static final class AlreadySettled extends QueueEntry {
        static final QueueEntry INSTANCE = new AlreadySettled();

        private AlreadySettled() {}
    }
}
