package io.troupe.actor;

import io.troupe.actor.internal.ActorProxy;
import io.troupe.actor.internal.Message;
import io.troupe.actor.internal.Recipient;
import io.troupe.actor.internal.Request;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.Node;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.Schedule;
import io.troupe.actor.time.Timer;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * The internal state of an actor: its mailbox, its implementation and its supervision.
 *
 * <p><b>Threads.</b> {@link #send} from any thread, everything else on the space's thread.
 */
final class ActorCell extends Recipient {
    private static final long FIRST_PAUSE_NANOS = 10_000_000;
    private static final long LONGEST_PAUSE_NANOS = 10_000_000_000L;
    private static final int MOST_DOUBLINGS = 10;
    private static final int FRAMES_FOR_QUEUEING = 48;
    private static final int COUNTED = 1_000; // bounds the cost of a time-out behind a long queue

    private final SpaceHome space;
    private final Class<?> type;
    private final int number;
    private final Supplier<?> factory;
    private final ActorSettings settings;
    private final @Nullable BoundedMailbox mailbox;
    private @Nullable Object implementation; // null if the slow path is to decide: calls are held back or bounded
    private @Nullable Object instance;
    private @Nullable Object proxy;
    private @Nullable Failures failures; // most actors have none
    private @Nullable Deferred<@Nullable Void> ended; // guarded by this, as are writes of stopped
    private Incarnation life;
    private boolean starting;
    private boolean begun;
    private boolean stopped;

    @Nullable
    ActorCell before;

    @Nullable
    ActorCell after;

    /**
     * Creates a cell of an actor that has not started.
     *
     * @param type the name of the actor's type is used if the settings name no other
     * @param number distinguishes unnamed actors of one type
     */
    ActorCell(SpaceHome space, Class<?> type, int number, Supplier<?> factory, ActorSettings settings) {
        this.space = space;
        this.type = type;
        this.life = new Incarnation(this);
        this.number = number;
        this.factory = factory;
        this.settings = settings;
        MailboxBound bound = settings.mailbox();
        this.mailbox = bound == null ? null : new BoundedMailbox(bound);
    }

    @Override
    public void send(Message message) {
        if (mailbox != null) {
            sendBounded(message, mailbox);
        } else if (Thread.currentThread() instanceof SpaceThread thread && thread.serves(space)) {
            thread.messages().add(message);
        } else {
            space.enqueueMessage(message);
        }
    }

    @Override
    public void send(Request<?> request) {
        if (mailbox == null && Thread.currentThread() instanceof SpaceThread thread && thread.serves(space)) {
            request.noteCaller(true);
            thread.messages().add(request);
        } else {
            sendSlowly(request);
        }
    }

    /**
     * For callers on other threads, for threads that only borrow the space (crank, sequential bodies), and for bounded
     * mailboxes.
     */
    private void sendSlowly(Request<?> request) {
        request.noteCaller(space.isCurrent());
        if (mailbox != null) {
            sendBounded(request, mailbox);
        } else {
            space.enqueueMessage(request);
        }
    }

    private void sendBounded(Node call, BoundedMailbox bounded) {
        // checked first, so that a stack overflow cannot lose an acquired permit
        checkStack(FRAMES_FOR_QUEUEING);
        // no switch: its table is a class, whose initialisation would fail for good in a caller with little stack left
        var admission = bounded.admit(call, this);
        if (admission == BoundedMailbox.Admission.QUEUED) {
            queue(call, bounded);
        } else if (admission == BoundedMailbox.Admission.REFUSED) {
            drop(call, bounded.reason());
        } else if (admission == BoundedMailbox.Admission.INTERRUPTED) {
            drop(call, bounded.reason() + ", and its caller was interrupted while it waited for room");
        }
    }

    /** Throws a StackOverflowError if the caller's stack has fewer frames left. */
    private static int checkStack(int frames) {
        return frames == 0 ? 0 : 1 + checkStack(frames - 1);
    }

    private void queue(Node call, BoundedMailbox bounded) {
        try {
            space.enqueueMessage(call);
        } catch (Throwable notQueued) { // the caller's stack overflowed: release the permit
            bounded.takeBack(call);
            throw notQueued;
        }
    }

    @Override
    public @Nullable Object returning(@Nullable Object callback) {
        return ReturningCallback.wrap((Callback<?>) callback, space);
    }

    @Override
    protected Home home() {
        return space;
    }

    SpaceHome space() {
        return space;
    }

    void bind(Object newProxy) {
        proxy = newProxy;
    }

    @Nullable
    Object proxy() {
        return proxy;
    }

    @Override
    protected Incarnation life() {
        return life;
    }

    /** Fulfilled when the actor has stopped; any thread. */
    synchronized Promise<@Nullable Void> ended() {
        if (ended == null) {
            if (stopped) {
                return Promise.done();
            }
            ended = new Deferred<>(space, null);
        }
        return ended;
    }

    /**
     * The entry queued by {@code spawn}: starts the actor, unless an earlier call has started it, or it was stopped
     * before.
     */
    void start() {
        if (!begun && !stopped && !space.isStopping()) {
            startInstance();
        }
    }

    private void startInstance() {
        begun = true;
        space.actors().add(this);
        int failedBefore = failures == null ? 0 : failures.starts;
        starting = true;
        guard("the start", this::begin);
        starting = false;
        if (instance == null) {
            stop();
        } else if (failures != null && failures.starts == failedBefore) {
            failures.starts = 0;
            if (failures.held != null) {
                releaseSoon(failures);
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
        implementation = held() == null && mailbox == null ? made : null;
        if (made instanceof Actor actor) {
            actor.join(this);
            actor.started();
        }
    }

    /**
     * Stops the actor after the calls that are queued. During the pause before a restart it stops immediately, because
     * the actor may never start again.
     */
    void stopBehindCalls() {
        if (failures != null && failures.held != null && instance != null) {
            failures.stopHeld = true;
            failures.held.add(new Entry(this::stop));
        } else {
            stop();
        }
    }

    void stop() {
        if (stopped) {
            return;
        }
        if (failures != null && failures.restartTimer != null) {
            failures.restartTimer.cancel();
        }
        space.actors().remove(this);
        Deferred<@Nullable Void> watched;
        synchronized (this) {
            stopped = true;
            watched = ended;
        }
        endLife(false);
        if (failures != null && failures.held != null) {
            failures.held.forEach(space::enqueueMessage); // to be rejected like all others
            failures.held = null;
        }
        if (watched != null) {
            watched.resolve(null);
        }
    }

    /** Ends the current instance. */
    private void endLife(boolean restarted) {
        if (instance instanceof Actor actor) {
            space.begin(life);
            try {
                actor.stopped();
            } catch (Throwable thrown) { // reported, and not counted as a failure of the next instance
                space.reports().error("stopped() of", this, thrown, settings.onError());
            }
        }
        implementation = null;
        instance = null;
        life.end();
        life.rejectOpenRequests(() -> restarted ? "the actor " + this + " was restarted" : whyStopped(), endedBy());
        life.endAttachment();
    }

    /** The failure that led to the end of the last instance, or null. */
    private @Nullable Throwable endedBy() {
        return failures == null ? null : failures.endedBy;
    }

    /** The calls held back while a restart waits, until all of them have been delivered; or null. */
    private @Nullable ArrayDeque<Node> held() {
        return failures == null ? null : failures.held;
    }

    private Failures failures() {
        if (failures == null) {
            failures = new Failures(settings.supervision());
        }
        return failures;
    }

    private String whyStopped() {
        return space.isStopping() ? "space " + space + " is closed" : "the actor " + this + " has stopped";
    }

    /**
     * Restarts the actor immediately. From the second failed start in a row it pauses first, so that an actor that
     * cannot start leaves time for the others.
     */
    private void restart() {
        if (stopped) {
            return;
        }
        endLife(true);
        Failures had = failures();
        had.endedBy = null;
        if (had.starts < 2) {
            startAgain();
            return;
        }
        had.hold();
        if (had.stopHeld) {
            stop();
            return;
        }
        long pauseNanos = Math.min(LONGEST_PAUSE_NANOS, FIRST_PAUSE_NANOS << Math.min(had.starts - 2, MOST_DOUBLINGS));
        had.restartTimer = space.dispatcher.timers.set(this::startAgain, pauseNanos, 0);
    }

    private void startAgain() {
        if (!stopped && !space.isStopping()) {
            life = new Incarnation(this);
            startInstance();
        }
    }

    /** Delivers the held calls before those queued in the space, one per entry, so that other actors get their turn. */
    private void releaseSoon(Failures had) {
        if (!had.releasing) {
            had.releasing = true;
            space.enqueue(Entry.urgent(() -> release(had), () -> release(had)));
        }
    }

    private void release(Failures had) {
        had.releasing = false;
        if (had.held == null || instance == null) {
            return; // it has stopped, or is waiting again
        }
        Node ticket = had.held.poll();
        if (ticket instanceof Entry) { // a stop, see stopBehindCalls()
            stop();
        } else if (ticket != null) {
            deliver(ticket);
        }
        if (had.held == null) {
            return;
        }
        if (had.held.isEmpty()) {
            had.held = null;
            implementation = mailbox == null ? instance : null;
        } else {
            releaseSoon(had);
        }
    }

    /** Rejects a call for which the mailbox had no room, or which was dropped for a newer one. Any thread. */
    void drop(Node call, String reason) {
        space.reports().rejectCall(call, this, reason, new MailboxFullException(call + " was not begun: " + reason));
    }

    @Override
    protected @Nullable Object target(Message message) {
        Object target = implementation;
        if (target == null) {
            deliverNext(message);
            return null;
        }
        return target;
    }

    @Override
    protected @Nullable Object target(Request<?> request) {
        Object target = implementation;
        if (target == null || request.isDone() || request.mayBeGivenUp()) {
            deliverNext(request);
            return null;
        }
        return target;
    }

    /** The slow path: the actor is not running, its mailbox is bounded, or the request is cancelled. */
    private void deliverNext(Node ticket) {
        start();
        var held = held();
        if (held != null) {
            held.add(ticket);
        } else {
            deliver(ticket);
        }
    }

    private void deliver(Node ticket) {
        Node call = mailbox == null ? ticket : mailbox.next(ticket);
        Object target = instance;
        if (call instanceof Request<?> request && (request.isDone() || request.shed())) {
            space.reports().skip(request); // cancelled or given up while queued
        } else if (target == null) {
            reject(call);
        } else {
            space.begin(life);
            try {
                if (call instanceof Message message) {
                    message.serveWith(target);
                } else {
                    ((Request<?>) call).serveWith(target);
                }
            } catch (Throwable thrown) {
                space.dispatcher.fail(
                        call, thrown); // the failure belongs to this call, although the ticket was another's
            }
        }
    }

    /** The call that would be delivered for this ticket. */
    Node callOf(Node ticket) {
        return mailbox == null ? ticket : mailbox.peek(ticket);
    }

    /**
     * The number of calls ahead of this one in a mailbox that stores its calls, or among the held calls; -1 if it is
     * not among the first {@value #COUNTED}.
     */
    private int placeInMailbox(Node call) {
        int place = mailbox == null ? -1 : mailbox.placeOf(call, COUNTED);
        var held = held();
        return place < 0 && held != null ? placeAmong(held, call) : place;
    }

    private static int placeAmong(ArrayDeque<Node> held, Node call) {
        int place = 0;
        for (Node each : held) {
            if (each == call) {
                return place;
            }
            if (++place == COUNTED) {
                break;
            }
        }
        return -1;
    }

    private void reject(Node call) {
        String reason = whyStopped();
        var error = new ActorStoppedException(call + " was not begun: " + reason, endedBy(), false);
        space.reports().rejectCall(call, this, reason, error);
    }

    /** Sets a timer that ends with the current instance. */
    Timer setTimer(Duration delay, Duration period, Schedule schedule, Runnable task) {
        return space.timers().set(life, delay, period, schedule, task);
    }

    /** Runs an action on behalf of this actor; an exception is a failure of the actor. */
    void guard(String what, Runnable action) {
        space.begin(life);
        try {
            action.run();
        } catch (Throwable thrown) {
            failed(what, thrown);
        }
    }

    /**
     * Reports a failure and applies supervision. The directive is carried out when the failing turn has returned,
     * before anything else.
     */
    @Override
    protected void failed(String what, Throwable thrown) {
        space.reports().error(what + " of", this, thrown, settings.onError());
        if (stopped) {
            return;
        }
        Failures had = failures();
        if (starting) {
            had.starts++;
        }
        Supervision.Directive directive = had.note(space.settings.clock().nanos());
        if (had.starts > settings.supervision().limit()) { // the pauses between them may be longer than the window
            directive = Supervision.Directive.STOP;
        }
        if (starting && directive != Supervision.Directive.RESUME) {
            had.hold(); // the call that caused the start is not delivered to this instance
        }
        if (directive != Supervision.Directive.RESUME || instance == null) {
            had.endedBy = thrown;
        }
        switch (directive) {
            case RESUME -> {}
            case STOP -> space.dispatcher.afterTurn(this::stop);
            case RESTART -> space.dispatcher.afterTurn(this::restart);
        }
    }

    @Override
    protected void reportError(String method, Throwable thrown) {
        space.reports().error(method + " of", this, thrown, null);
    }

    @Override
    protected RuntimeException answeredNull(String method) {
        return new ActorException(method + " of " + this + " answered null, expected a promise");
    }

    @Override
    protected String progressOf(Request<?> request) {
        int inMailbox = placeInMailbox(request);
        int before = inMailbox >= 0 ? inMailbox : space.dispatcher.messagesBefore(request, COUNTED);
        if (before >= 0) {
            return ", which has not begun it: " + before + " calls come first";
        }
        return space.dispatcher.isLongerThan(COUNTED)
                ? ", where more than " + COUNTED + " calls wait"
                : ", which has begun it";
    }

    @Override
    public String toString() {
        String name = settings.name();
        return name != null ? name : type.getSimpleName() + "#" + number;
    }

    /** What an actor keeps once it has failed. On the space's thread. */
    private static final class Failures {
        private final Supervision supervision;
        private final ArrayDeque<Long> recent = new ArrayDeque<>(); // those within the window of its supervision
        private int starts; // failed starts in a row
        private @Nullable Throwable endedBy; // the failure that led to the end of the last instance
        // calls held back while a restart waits, until all of them have been delivered
        private @Nullable ArrayDeque<Node> held;
        private boolean stopHeld; // a stop is queued among the held calls
        private boolean releasing;
        private @Nullable Timer restartTimer; // the timer of the pause before a restart

        Failures(Supervision supervision) {
            this.supervision = supervision;
        }

        /** Holds calls back from now on. */
        void hold() {
            if (held == null) {
                held = new ArrayDeque<>();
            }
        }

        /** Counts a failure and returns the directive for it. */
        Supervision.Directive note(long nowNanos) {
            if (supervision.limit() == Integer.MAX_VALUE) {
                return supervision.directive();
            }
            while (!recent.isEmpty() && isOver(nowNanos - recent.peekFirst())) {
                recent.removeFirst();
            }
            recent.addLast(nowNanos);
            return recent.size() > supervision.limit() ? Supervision.Directive.STOP : supervision.directive();
        }

        /** Compares durations: a window may exceed the range of nanoseconds in a long. */
        private boolean isOver(long agoNanos) {
            return Duration.ofNanos(agoNanos).compareTo(supervision.window()) >= 0;
        }
    }
}
