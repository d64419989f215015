package io.troupe.actor;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Node;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.Timer;
import java.util.ArrayDeque;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * An actor as its space sees it: where its messages go and who handles them. For generated code.
 *
 * <p><b>Threads.</b> {@link #send} from any thread, everything else on the space's.
 *
 * @hidden
 */
public final class ActorCell {
    private static final long FIRST_PAUSE_NANOS = 10_000_000;
    private static final long LONGEST_PAUSE_NANOS = 10_000_000_000L;
    private static final int MOST_DOUBLINGS = 10;
    private static final int FRAMES_FOR_QUEUEING = 48;

    private final ActorSpace space;
    private final Class<?> type;
    private final int number;
    private final Supplier<?> factory;
    private final ActorSettings settings;
    private final @Nullable BoundedMailbox mailbox;
    private @Nullable Object implementation; // null also while calls are held back
    private @Nullable Object instance;
    private @Nullable Object proxy;
    private @Nullable FailureCount failures;
    private @Nullable Throwable endedBy; // the failure that led to the last end of an instance
    private @Nullable Deferred<@Nullable Void> ended; // guarded by this, as is stopped for other threads
    private Life life;
    private @Nullable ArrayDeque<Node>
            held; // since a restart has to wait, until those calls are served that came meanwhile
    private @Nullable Timer revival; // of the last pause before a restart
    private boolean releasing;
    private boolean stopHeld; // a stop waits among the calls held back
    private boolean starting;
    private int failedStarts; // in a row
    private boolean begun;
    private boolean stopped;

    @Nullable
    ActorCell before;

    @Nullable
    ActorCell after;

    /**
     * An actor that has not started.
     *
     * @param type what it is called by if it has no name of its own
     * @param number tells it from others of its type then
     */
    ActorCell(ActorSpace space, Class<?> type, int number, Supplier<?> factory, ActorSettings settings) {
        this.space = space;
        this.type = type;
        this.life = new Life(this);
        this.number = number;
        this.factory = factory;
        this.settings = settings;
        MailboxBound bound = settings.mailbox();
        this.mailbox = bound == null ? null : new BoundedMailbox(bound);
    }

    /** Puts a call into the actor's mailbox. */
    public void send(Message message) {
        if (mailbox != null) {
            sendBounded(message, mailbox);
        } else if (Thread.currentThread() instanceof SpaceThread thread && thread.serves(space)) {
            thread.mails().add(message);
        } else {
            space.enqueueMail(message);
        }
    }

    /** Puts a call into the actor's mailbox. */
    public void send(Request<?> request) {
        if (mailbox == null && Thread.currentThread() instanceof SpaceThread thread && thread.serves(space)) {
            request.noteAsker(true);
            thread.mails().add(request);
        } else {
            sendSlowly(request);
        }
    }

    /** From another thread, from one that cranks or has borrowed the space, or to a mailbox that may be full. */
    private void sendSlowly(Request<?> request) {
        request.noteAsker(space.isCurrent());
        if (mailbox != null) {
            sendBounded(request, mailbox);
        } else {
            space.enqueueMail(request);
        }
    }

    private void sendBounded(Node call, BoundedMailbox bounded) {
        checkStack(FRAMES_FOR_QUEUEING); // a place that was taken must not be lost where the stack ends
        // no switch: its table is a class, which a caller at the end of its stack could spoil for all
        var admission = bounded.admit(call, this);
        if (admission == BoundedMailbox.Admission.QUEUED) {
            queue(call, bounded);
        } else if (admission == BoundedMailbox.Admission.REFUSED) {
            drop(call, bounded.reason());
        } else if (admission == BoundedMailbox.Admission.INTERRUPTED) {
            drop(call, bounded.reason() + ", and its caller was interrupted while it waited for room");
        }
    }

    /** Throws a StackOverflowError where the caller's stack has not so many frames left. */
    private static int checkStack(int frames) {
        return frames == 0 ? 0 : 1 + checkStack(frames - 1);
    }

    private void queue(Node call, BoundedMailbox bounded) {
        try {
            space.enqueueMail(call);
        } catch (Throwable notQueued) { // the caller's stack has ended: the place is free again
            bounded.takeBack(call);
            throw notQueued;
        }
    }

    /** A callback argument as the actor gets it: what it sends comes back to the caller's callback queue. */
    public <T extends @Nullable Object> @Nullable Callback<T> returning(@Nullable Callback<T> callback) {
        return ReturningCallback.wrap(callback, space);
    }

    /** Identity, for the {@code equals} of a proxy. */
    public static boolean same(Object first, @Nullable Object second) {
        return first == second;
    }

    ActorSpace space() {
        return space;
    }

    void bind(Object newProxy) {
        proxy = newProxy;
    }

    @Nullable
    Object proxy() {
        return proxy;
    }

    Life life() {
        return life;
    }

    /** Fulfilled when the actor has stopped. Any thread. */
    synchronized Promise<@Nullable Void> ended() {
        if (ended == null) {
            if (stopped) {
                return Promise.done();
            }
            ended = new Deferred<>(space);
        }
        return ended;
    }

    /**
     * The entry that spawning has queued: starts the actor, unless a call that came another way has done so, or it was
     * stopped before.
     */
    void start() {
        if (!begun && !stopped && !space.isStopping()) {
            startInstance();
        }
    }

    private void startInstance() {
        begun = true;
        space.actors().add(this);
        int failedBefore = failedStarts;
        starting = true;
        guard("the start", this::begin);
        starting = false;
        if (instance == null) {
            stop();
        } else if (failedStarts == failedBefore) {
            failedStarts = 0;
            if (held != null) {
                releaseSoon();
            }
        }
    }

    private void begin() {
        Object made = factory.get();
        if (made == null) {
            throw new ActorException("the factory of " + this + " answered null, expected its implementation");
        }
        if (made instanceof ActorProxy) {
            throw new ActorException("the factory of " + this + " answered a proxy, expected a new implementation");
        }
        instance = made;
        implementation = held == null ? made : null;
        if (made instanceof Actor actor) {
            actor.join(this);
            actor.started();
        }
    }

    /** After the calls that came before; in the pause before a restart at once, for it may never start again. */
    void stopBehindCalls() {
        if (held != null && instance != null) {
            stopHeld = true;
            held.add(new Entry(this::stop));
        } else {
            stop();
        }
    }

    void stop() {
        if (stopped) {
            return;
        }
        if (revival != null) {
            revival.cancel();
        }
        space.actors().remove(this);
        Deferred<@Nullable Void> watched;
        synchronized (this) {
            stopped = true;
            watched = ended;
        }
        endLife(whyStopped());
        if (held != null) {
            held.forEach(space::enqueueMail); // to be turned away like all others
            held = null;
        }
        if (watched != null) {
            watched.resolve(null);
        }
    }

    /** The end of one instance. */
    private void endLife(String reason) {
        if (instance instanceof Actor actor) {
            space.beginTurnOf(life);
            try {
                actor.stopped();
            } catch (Throwable thrown) { // reported, and no failure of the instance that comes next
                space.reports().error("stopped() of", this, thrown, settings.onError());
            }
        }
        implementation = null;
        instance = null;
        life.end();
        life.rejectOpenRequests(reason, endedBy);
    }

    private String whyStopped() {
        return space.isStopping() ? "space " + space + " is closed" : "the actor " + this + " has stopped";
    }

    /**
     * At once, but after a second failed start in a row only after a pause, so that an actor that cannot start leaves
     * time for the others.
     */
    private void restart() {
        if (stopped) {
            return;
        }
        endLife("the actor " + this + " was restarted");
        endedBy = null;
        if (failedStarts < 2) {
            revive();
            return;
        }
        if (held == null) {
            held = new ArrayDeque<>();
        }
        if (stopHeld) {
            stop();
            return;
        }
        long pauseNanos =
                Math.min(LONGEST_PAUSE_NANOS, FIRST_PAUSE_NANOS << Math.min(failedStarts - 2, MOST_DOUBLINGS));
        revival = space.dispatcher.timers.set(this::revive, pauseNanos, 0);
    }

    private void revive() {
        if (!stopped && !space.isStopping()) {
            life = new Life(this);
            startInstance();
        }
    }

    /**
     * The calls that were held back come before those that wait in the space, one for each entry, so that others have
     * their turns.
     */
    private void releaseSoon() {
        if (!releasing) {
            releasing = true;
            space.enqueueCallback(Entry.urgent(this::release, this::release));
        }
    }

    private void release() {
        releasing = false;
        if (held == null || instance == null) {
            return; // it has stopped, or waits again
        }
        Node ticket = held.poll();
        if (ticket instanceof Entry) { // see stopBehindCalls()
            stop();
        } else if (ticket != null) {
            deliver(ticket);
        }
        if (held == null) {
            return;
        }
        if (held.isEmpty()) {
            held = null;
            implementation = instance;
        } else {
            releaseSoon();
        }
    }

    /** Turns a call away that found no room, or had to make room. Any thread. */
    void drop(Node call, String reason) {
        space.reports().turnAway(call, this, reason, new MailboxFullException(call + " was not begun: " + reason));
    }

    /**
     * Begins the turn of a one-way call: the implementation that is to handle it, or null if nobody is, or has done so.
     */
    @Nullable
    Object target(Message message) {
        Object target = implementation;
        if (target == null || mailbox != null) {
            deliverNext(message);
            return null;
        }
        space.beginTurnOf(life);
        return target;
    }

    /** Begins the turn of a request: the implementation that is to handle it, or null if nobody is, or has done so. */
    @Nullable
    Object target(Request<?> request) {
        Object target = implementation;
        if (target == null || mailbox != null || request.isDone()) {
            deliverNext(request);
            return null;
        }
        space.beginTurnOf(life);
        return target;
    }

    /** The slower way: of a call that may be another's ticket, may have been cancelled, or may find nobody. */
    private void deliverNext(Node ticket) {
        start();
        if (held != null) {
            held.add(ticket);
        } else {
            deliver(ticket);
        }
    }

    private void deliver(Node ticket) {
        Node call = mailbox == null ? ticket : mailbox.next(ticket);
        Object target = instance;
        if (call instanceof Request<?> request && request.isDone()) {
            space.reports().skip(request); // cancelled while it waited
        } else if (target == null) {
            refuse(call);
        } else {
            space.beginTurnOf(life);
            try {
                if (call instanceof Message message) {
                    message.invoke(target);
                } else {
                    ((Request<?>) call).serveWith(target);
                }
            } catch (Throwable thrown) {
                space.fail(call, thrown); // the call's own failure, though another was its ticket
            }
        }
    }

    /** The call that would be served with this ticket. */
    Node callOf(Node ticket) {
        return mailbox == null ? ticket : mailbox.peek(ticket);
    }

    /**
     * How many calls wait before this one in a mailbox that keeps them itself, or among those held back; -1 if it is
     * not among the first so many.
     */
    int placeInMailbox(Node call, int limit) {
        int place = mailbox == null ? -1 : mailbox.placeOf(call, limit);
        return place < 0 && held != null ? placeAmongHeld(call, limit) : place;
    }

    private int placeAmongHeld(Node call, int limit) {
        int place = 0;
        for (Node each : held) {
            if (each == call) {
                return place;
            }
            if (++place == limit) {
                break;
            }
        }
        return -1;
    }

    private void refuse(Node call) {
        String reason = whyStopped();
        var error = new ActorStoppedException(call + " was not begun: " + reason, endedBy, false);
        space.reports().turnAway(call, this, reason, error);
    }

    /** Runs something on behalf of this actor; what it throws is a failure of the actor. */
    void guard(String what, Runnable action) {
        space.beginTurnOf(life);
        try {
            action.run();
        } catch (Throwable thrown) {
            failed(what, thrown);
        }
    }

    /** What the failure leads to comes when the failing turn has returned, and before anything else. */
    void failed(String what, Throwable thrown) {
        space.reports().error(what + " of", this, thrown, settings.onError());
        if (stopped) {
            return;
        }
        if (starting) {
            failedStarts++;
        }
        if (failures == null) {
            failures = new FailureCount(settings.supervision());
        }
        Supervision.Directive directive = failures.note(space.clock().nanos());
        if (failedStarts > settings.supervision().limit()) { // the pauses between them may be longer than the window
            directive = Supervision.Directive.STOP;
        }
        if (starting && directive != Supervision.Directive.RESUME && held == null) {
            held = new ArrayDeque<>(); // the call that has led to the start does not reach this instance
        }
        if (directive != Supervision.Directive.RESUME || implementation == null) {
            endedBy = thrown;
        }
        switch (directive) {
            case RESUME -> {}
            case STOP -> space.afterTurn(this::stop);
            case RESTART -> space.afterTurn(this::restart);
        }
    }

    @Override
    public String toString() {
        String name = settings.name();
        return name != null ? name : type.getSimpleName() + "#" + number;
    }
}
