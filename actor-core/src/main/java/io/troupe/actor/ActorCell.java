package io.troupe.actor;

import io.troupe.actor.Reports.Trouble;
import io.troupe.actor.internal.ActorProxy;
import io.troupe.actor.internal.Forwarder;
import io.troupe.actor.internal.Message;
import io.troupe.actor.internal.Recipient;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.QueueEntries;
import io.troupe.actor.internal.loop.QueueEntry;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.IdentityHashMap;
import java.util.Map;
import java.util.Objects;
import java.util.concurrent.CancellationException;
import java.util.function.Function;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * The internal state of an actor: its mailbox, its implementation and its supervision.
 *
 * <p><b>Threads.</b> {@link #send} from any thread, everything else on the space's thread.
 *
 * <p>Long, because a call, a failure and an end meet here: each may find the actor not started, holding its calls back,
 * waiting for a restart, or stopped. What only few actors need is in {@link Exceptional}.
 */
final class ActorCell extends Recipient {
    private static final long FIRST_PAUSE_NANOS = 10_000_000;
    private static final long LONGEST_PAUSE_NANOS = 10_000_000_000L;
    private static final int FRAMES_FOR_QUEUEING = 48;
    private static final int COUNTED = 1_000; // bounds the cost of a time-out behind a long queue
    static final String NOT_ANSWERED = "begun and not answered";

    private final SpaceHome space;
    private final Class<?> type;
    private final int number;
    private @Nullable Supplier<?> factory; // null after the end: what it refers to must not stay behind
    private final ActorSettings settings;
    private final @Nullable Function<String, RuntimeException> unsent; // not null: a Forwarder passes its calls on
    private final @Nullable BoundedMailbox mailbox;
    private @Nullable Object implementation; // null if the slow path is to decide: calls are held back or bounded
    private @Nullable Object instance;
    private @Nullable Object proxy;
    private @Nullable Exceptional exceptional; // most actors have none
    private @Nullable Deferred<ActorEnd> ended; // guarded by this, as are writes of stopped
    private Incarnation life;
    private boolean starting;
    private boolean begun;
    private volatile boolean stopped;

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
        this.unsent = factory instanceof Forwarder.Factory link ? link.unsent() : null;
        this.settings = settings;
        Integer capacity = settings.mailboxCapacity();
        this.mailbox = capacity == null ? null : new BoundedMailbox(capacity, settings.overflow());
        Integer quota = space.settings.actorQuota();
        if (quota != null) {
            exceptional().share = new Share(this, quota);
        }
    }

    @Override
    public void send(Message message) {
        if (mailbox == null && Thread.currentThread() instanceof SpaceThread thread && thread.serves(space)) {
            thread.messages().add(message);
        } else {
            sendSlowly(message, space.captureCallers());
        }
    }

    @Override
    public void send(Request<?> request) {
        if (mailbox == null && Thread.currentThread() instanceof SpaceThread thread && thread.serves(space)) {
            request.noteCaller(true);
            thread.messages().add(request);
        } else {
            request.noteCaller(space.isCurrent());
            sendSlowly(request, contextOf(request));
        }
    }

    /**
     * For callers on other threads, for threads that only borrow the space (runQueued, sequential bodies), for bounded
     * mailboxes, and for spaces with contexts or a call observer.
     */
    private void sendSlowly(QueueEntry call, @Nullable Supplier<Runnable> context) {
        CallObserver observer = space.settings.callObserver();
        if (observer != null) {
            ObservedCalls.called(observer, this, call);
        }
        int handlers = HandlerTurn.ofSender(space);
        QueueEntry entry = context == null && handlers == 0 ? call : new CarriedCall(this, call, context, handlers);
        if (mailbox != null) {
            sendBounded(entry, mailbox);
        } else {
            space.enqueueMessage(entry);
        }
    }

    /** The context of a request, which shares the time limit of the turn in which it is sent. */
    private @Nullable Supplier<Runnable> contextOf(Request<?> request) {
        TimeLimit limit = TimeLimit.current();
        if (limit != null) {
            limit.add(request);
        }
        return space.capture(limit);
    }

    private void sendBounded(QueueEntry call, BoundedMailbox bounded) {
        // checked first, so that a stack overflow cannot lose an acquired permit
        checkStack(FRAMES_FOR_QUEUEING);
        // no switch: its table is a class, whose initialisation would fail for good in a caller with little stack left
        var admission = bounded.admit(call, this);
        if (admission == BoundedMailbox.Admission.QUEUED) {
            queue(call, bounded);
        } else if (admission == BoundedMailbox.Admission.REJECTED) {
            drop(call, bounded.reason());
        } else if (admission == BoundedMailbox.Admission.INTERRUPTED) {
            drop(call, bounded.reason() + ", and its caller was interrupted while it waited for room");
        }
    }

    /** Throws a StackOverflowError if the caller's stack has fewer frames left. */
    private static int checkStack(int frames) {
        return frames == 0 ? 0 : 1 + checkStack(frames - 1);
    }

    private void queue(QueueEntry call, BoundedMailbox bounded) {
        try {
            space.enqueueMessage(call);
        } catch (Throwable notQueued) { // the caller's stack overflowed: release the permit
            bounded.takeBack(call);
            throw notQueued;
        }
    }

    @Override
    public @Nullable Object returning(@Nullable Object callback) {
        if (callback instanceof BroadcastCallback<?> shared) {
            return shared.share();
        }
        return callback instanceof BroadcastCallback.Share<?> share
                ? share // the actor that received it passes it on
                : ReturningCallback.wrap((Callback<?>) callback, space);
    }

    @Override
    public Home home() {
        return space;
    }

    SpaceHome space() {
        return space;
    }

    /** True for a connection, which passes its calls on. */
    boolean forwards() {
        return unsent != null;
    }

    void bind(Object newProxy) {
        proxy = newProxy;
    }

    @Nullable
    Object proxy() {
        return proxy;
    }

    @Override
    public Incarnation life() {
        return life;
    }

    /** True when the actor has stopped, for ever; any thread. */
    boolean hasStopped() {
        return stopped;
    }

    /** Makes this cell one that never has an actor: it rejects the calls of a pool whose actors have all stopped. */
    void standForPool() {
        stopped = true;
        exceptional().standsForPool = true;
    }

    /** Fulfilled when the actor has stopped; any thread. */
    synchronized Promise<ActorEnd> ended() {
        if (ended == null) {
            if (stopped) {
                return Promise.of(ActorEnd.of(endedBy()));
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
        int failedBefore = exceptional == null ? 0 : exceptional.starts;
        starting = true;
        guard("the start", this::begin);
        starting = false;
        if (instance == null) {
            stop();
        } else if (exceptional != null) {
            hasBegun(exceptional, exceptional.starts > failedBefore);
        }
    }

    private void hasBegun(Exceptional state, boolean failed) {
        if (failed) {
            release(); // no longer held back by the actor, which might never release them
            return;
        }
        state.starts = 0;
        state.startedNanos = space.settings.clock().nanos();
        if (state.held != null) {
            releaseSoon(state);
        }
    }

    private void begin() {
        Object made = Objects.requireNonNull(factory).get();
        if (made == null) {
            throw new ActorException("the factory of " + this + " returned null, expected its implementation");
        }
        if (made instanceof ActorProxy) {
            throw new ActorException("the factory of " + this + " returned a proxy, expected a new implementation");
        }
        if (made instanceof Actor actor) {
            actor.join(this);
        }
        instance = made;
        implementation = held() == null ? direct(made) : null;
        if (made instanceof Actor actor) {
            actor.started();
        }
    }

    /** See {@link ActorContext#hold}. */
    void hold() {
        if (instance == null) {
            return; // it has stopped: nothing is delivered any more
        }
        Exceptional state = exceptional();
        state.hold();
        implementation = null;
        if (!state.byActor) {
            state.byActor = true;
            noteHold(true);
        }
    }

    private void noteHold(boolean isHeld) {
        CallObserver observer = space.settings.callObserver();
        if (observer != null && isHeld) {
            ObservedCalls.held(observer, this);
        } else if (observer != null) {
            ObservedCalls.released(observer, this);
        }
    }

    /** See {@link ActorContext#release}. */
    void release() {
        if (exceptional != null && exceptional.byActor) {
            exceptional.byActor = false;
            noteHold(false);
            releaseSoon(exceptional);
        }
    }

    /**
     * Stops the actor after the calls that are queued. During the pause before a restart it stops immediately, because
     * the actor may never start again; and while it holds its calls back, because it may never release them.
     */
    void stopBehindCalls() {
        Exceptional state = exceptional;
        if (state != null && state.held != null && instance != null && !state.byActor) {
            state.stopHeld = true;
            state.held.add(new Entry(this::stop));
        } else if (state != null && state.share != null && state.share.isUsed()) {
            state.share.waiting.add(new Entry(this::stop));
        } else {
            stop();
        }
    }

    void stop() {
        if (stopped) {
            return;
        }
        space.actors().remove(this);
        Deferred<ActorEnd> watched;
        synchronized (this) {
            stopped = true;
            watched = ended;
        }
        endLife(false);
        factory = null;
        try {
            queueWhatWaits();
        } catch (Throwable noMemory) {
            space.reports().error(Trouble.STOPPED, this, noMemory);
        }
        if (watched != null) {
            resolve(watched);
        }
    }

    /** Queues the calls that were held back, to be rejected like all others. */
    private void queueWhatWaits() {
        Exceptional state = exceptional;
        if (state == null) {
            return;
        }
        if (state.restartTimer != null) {
            state.restartTimer.cancel();
        }
        if (state.held != null) {
            queueAll(state.held);
            state.held = null;
        }
        if (state.share != null) {
            queueAll(state.share.waiting);
            state.share.due.clear();
        }
    }

    private void queueAll(ArrayDeque<QueueEntry> calls) {
        for (QueueEntry call = calls.peek(); call != null; call = calls.peek()) {
            space.enqueueMessage(call);
            calls.remove();
        }
    }

    private void resolve(Deferred<ActorEnd> watched) {
        try {
            watched.resolve(ActorEnd.of(endedBy()));
        } catch (Throwable broken) { // no memory, or a dependent of a future
            watched.reject(broken);
            space.reports().error(Trouble.STOPPED, this, broken);
        }
    }

    private void stopAfter(Throwable failure) {
        if (!stopped) {
            exceptional().endedBy = failure;
            stop();
        }
    }

    /** Ends the current instance; throws nothing. */
    private void endLife(boolean restarted) {
        if (instance instanceof Actor actor) {
            space.begin(life);
            try {
                actor.stopped();
            } catch (Throwable thrown) { // reported, and not counted as a failure of the next instance
                space.reports().report(Trouble.STOPPED, this, thrown, settings.onError());
            }
        }
        implementation = null;
        instance = null;
        boolean heldCalls = exceptional != null && exceptional.byActor;
        if (heldCalls) {
            exceptional.byActor = false;
        }
        life.endAll(restarted, endedBy());
        if (heldCalls) {
            noteHold(false);
        }
    }

    /** The failure that led to the end of the last instance, or null. */
    private @Nullable Throwable endedBy() {
        return exceptional == null ? null : exceptional.endedBy;
    }

    /** The calls held back, until all of them have been delivered; or null. */
    private @Nullable ArrayDeque<QueueEntry> held() {
        return exceptional == null ? null : exceptional.held;
    }

    private Exceptional exceptional() {
        if (exceptional == null) {
            exceptional = new Exceptional();
        }
        return exceptional;
    }

    /** The error of a request that was begun and not answered; never fails. */
    Throwable stoppedError(Request<?> request, boolean restarted, @Nullable Throwable cause) {
        try {
            String why = restarted ? "the actor " + this + " was restarted" : whyStopped();
            return new ActorStoppedException(request.name() + " was begun and not answered: " + why, cause, true);
        } catch (Throwable noMemory) {
            return ActorStoppedException.withoutMemory(true);
        }
    }

    private String whyStopped() {
        if (exceptional != null && exceptional.standsForPool) {
            return "all actors of the " + this + " have stopped";
        }
        return space.isStopping()
                ? "space " + space + " is closed"
                : (unsent == null ? "the actor " + this + " has stopped" : "the connection " + this + " is closed");
    }

    /** Restarts the actor, after a pause if its supervision or its failed starts require one. */
    private void restartAfter(Throwable failure) {
        if (stopped) {
            return;
        }
        Exceptional had = exceptional();
        had.endedBy = failure;
        endLife(true);
        had.endedBy = null;
        long pauseNanos = had.pauseNanos();
        if (pauseNanos == 0) {
            startAgain();
            return;
        }
        had.hold();
        if (had.stopHeld) {
            stop();
            return;
        }
        had.restartTimer = space.dispatcher.timers.set(this::startAgain, pauseNanos, 0);
    }

    private void startAgain() {
        if (!stopped && !space.isStopping()) {
            life = new Incarnation(this);
            startInstance();
        }
    }

    /** Delivers the held calls before those queued in the space, one per entry, so that other actors get their turn. */
    private void releaseSoon(Exceptional had) {
        if (!had.releasing) {
            had.releasing = true;
            space.enqueue(Entry.urgent(() -> deliverHeld(had), () -> deliverHeld(had)));
        }
    }

    private void deliverHeld(Exceptional had) {
        had.releasing = false;
        if (had.held == null || had.byActor || instance == null) {
            return; // it has stopped, or is waiting again
        }
        QueueEntry ticket = had.held.poll();
        if (ticket instanceof Entry) { // a stop, see stopBehindCalls()
            stop();
        } else if (ticket != null) {
            deliver(ticket);
        }
        if (had.held == null || had.byActor) {
            return;
        }
        if (had.held.isEmpty()) {
            had.held = null;
            implementation = direct(instance);
        } else {
            releaseSoon(had);
        }
    }

    /** Rejects a call for which the mailbox had no room, or which was dropped for a newer one. Any thread. */
    void drop(QueueEntry entry, String reason) {
        QueueEntry call = CarriedCall.callIn(entry);
        noteDropped(call);
        Throwable error;
        try {
            error = new MailboxFullException(nameOf(call) + " was not begun: " + reason);
        } catch (Throwable noMemory) {
            error = noMemory;
        }
        rejectCall(call, reason, error);
    }

    @Override
    public @Nullable Object target(Message message) {
        Object target = implementation;
        if (target == null) {
            deliverNext(message);
            return null;
        }
        return target;
    }

    @Override
    public @Nullable Object target(Request<?> request) {
        Object target = implementation;
        if (target == null || request.isDone() || request.mayBeGivenUp()) {
            deliverNext(request);
            return null;
        }
        return target;
    }

    /**
     * What calls may invoke without the slow path: the instance, unless calls are bounded, observed, passed on or have
     * a quota.
     */
    private @Nullable Object direct(@Nullable Object target) {
        boolean bounded = mailbox != null || share() != null;
        return unsent != null || bounded || space.settings.callObserver() != null ? null : target;
    }

    private @Nullable Share share() {
        return exceptional == null ? null : exceptional.share;
    }

    /** The slow path: the actor is not running, its mailbox is bounded, or the request is cancelled. */
    void deliverNext(QueueEntry ticket) {
        if (space.isStopping()) {
            deliver(ticket); // to be rejected
            return;
        }
        start();
        Share share = share();
        if (share != null && !stopped && !share.admits(ticket)) {
            return; // it waits for the next round
        }
        var held = held();
        if (held != null) {
            held.add(ticket);
        } else {
            deliver(ticket);
        }
    }

    private void deliver(QueueEntry ticket) {
        QueueEntry entry = mailbox == null ? ticket : mailbox.next(ticket);
        if (entry instanceof CarriedCall carried) {
            carried.run(() -> deliverCall(CarriedCall.callIn(carried)));
        } else {
            deliverCall(entry);
        }
    }

    private void deliverCall(QueueEntry call) {
        Object target = space.isStopping() ? null : instance; // no actor runs any more, whatever the end has left out
        if (call instanceof Request<?> request && (request.isDone() || request.dropIfAbandoned())) {
            noteDropped(call);
            space.reports().skip(request); // cancelled or given up while queued
            endBroadcasts(request, new CancellationException("a call was cancelled or given up before it began"));
        } else if (target == null) {
            noteDropped(call);
            reject(call);
        } else {
            space.begin(life);
            CallObserver observer = space.settings.callObserver();
            var observed = observer == null ? null : new ObservedCalls.ObservedCall(this, call);
            if (observed != null) {
                ObservedCalls.begun(observer, observed);
            }
            CallObserver.Turn turn = beginTurn();
            var servedBefore = space.served();
            try {
                if (observed != null) {
                    space.serve(observed);
                }
                if (target instanceof Forwarder forwarder) {
                    forward(call, forwarder);
                } else if (call instanceof Message message) {
                    message.serveWith(target);
                } else {
                    ((Request<?>) call).serveWith(target);
                }
            } catch (Throwable thrown) {
                space.dispatcher.fail(
                        call, thrown); // the failure belongs to this call, although the ticket was another's
            } finally {
                if (observer != null) {
                    space.serve(servedBefore);
                }
                if (turn != null) {
                    turn.end();
                }
            }
        }
    }

    private static void forward(QueueEntry call, Forwarder forwarder) {
        if (call instanceof Message message) {
            forwarder.forward(message);
        } else {
            ((Request<?>) call).serveBy(forwarder);
        }
    }

    private void noteDropped(QueueEntry call) {
        CallObserver observer = space.settings.callObserver();
        if (observer != null) {
            ObservedCalls.dropped(observer, this, call);
        }
    }

    private CallObserver.@Nullable Turn beginTurn() {
        CallObserver observer = space.settings.callObserver();
        return observer == null ? null : ObservedCalls.turnBegun(observer, space, life);
    }

    /** The call that would be delivered for this ticket. */
    QueueEntry callOf(QueueEntry ticket) {
        return CarriedCall.callIn(mailbox == null ? ticket : mailbox.peek(ticket));
    }

    /**
     * The number of calls ahead of this one in a mailbox that stores its calls, or among the held calls; -1 if it is
     * not among the first {@value #COUNTED}.
     */
    private int placeInMailbox(QueueEntry call) {
        int place = mailbox == null ? -1 : mailbox.placeOf(call, COUNTED);
        var held = held();
        if (place < 0 && held != null) {
            place = placeAmong(held, call);
        }
        Share share = share();
        return place < 0 && share != null ? placeAmong(share.waiting, call) : place;
    }

    private static int placeAmong(ArrayDeque<QueueEntry> held, QueueEntry call) {
        int place = 0;
        for (QueueEntry each : held) {
            if (QueueEntries.carries(each, call)) {
                return place;
            }
            if (++place == COUNTED) {
                break;
            }
        }
        return -1;
    }

    private void reject(QueueEntry call) {
        String reason = "";
        Throwable error;
        try {
            reason = whyStopped();
            error = notBegun(nameOf(call) + (unsent == null ? " was not begun: " : " was not sent: ") + reason);
        } catch (Throwable noMemory) {
            error = ActorStoppedException.withoutMemory(false);
        }
        rejectCall(call, reason, error);
    }

    private Throwable notBegun(String words) {
        return unsent == null ? new ActorStoppedException(words, endedBy(), false) : unsent.apply(words);
    }

    private void rejectCall(QueueEntry call, String reason, Throwable error) {
        space.reports().rejectCall(call, this, reason, error);
        endBroadcasts(call, error);
    }

    /** Ends the callbacks of broadcasts among the arguments of a call that is not begun; throws nothing. */
    private void endBroadcasts(QueueEntry call, Throwable error) {
        try {
            BroadcastCallback.abandon(call, error);
        } catch (Throwable broken) {
            space.reports().error(Trouble.THE_END_OF_A_CALLBACK, this, broken);
        }
    }

    private static Object nameOf(QueueEntry call) {
        return call instanceof Request<?> request ? request.name() : call;
    }

    /** Runs an action on behalf of this actor; an exception is a failure of the actor. */
    void guard(Object what, Runnable action) {
        space.begin(life);
        CallObserver.Turn turn = beginTurn();
        try {
            action.run();
        } catch (Throwable thrown) {
            failed(what, thrown);
        } finally {
            if (turn != null) {
                turn.end();
            }
        }
    }

    /**
     * Reports a failure and applies supervision. The directive is carried out when the failing turn has returned,
     * before anything else.
     */
    @Override
    public void failed(Object what, Throwable thrown) {
        space.reports().failed(what, this, thrown, settings.onError());
        if (stopped) {
            return;
        }
        Supervision supervision = settings.supervision().forError(thrown);
        try {
            supervise(supervision, thrown);
        } catch (Throwable noMemory) {
            space.reports().error(Trouble.THE_SUPERVISION, this, noMemory);
            if (supervision.directive() != Supervision.Directive.RESUME) {
                stop(); // at the end of the failing turn
            }
        }
    }

    private void supervise(Supervision supervision, Throwable thrown) {
        Exceptional had = exceptional();
        if (starting) {
            had.starts++;
        }
        Supervision.Directive directive =
                had.note(supervision, space.settings.clock().nanos(), starting);
        if (starting && directive != Supervision.Directive.RESUME) {
            had.hold(); // the call that caused the start is not delivered to this instance
        }
        if (instance == null) {
            had.endedBy = thrown; // the factory has thrown
        }
        switch (directive) {
            case RESUME -> {}
            case STOP -> space.dispatcher.afterTurn(() -> stopAfter(thrown));
            case RESTART -> space.dispatcher.afterTurn(() -> restartAfter(thrown));
        }
    }

    @Override
    public void requestFailed(Request<?> request, Throwable thrown, boolean isReported) {
        if (countsRequests(thrown)) {
            failed(request, thrown);
        } else if (isReported) {
            space.reports().failed(request, this, thrown, null);
        }
    }

    @Override
    public void cancelled(Request<?> request) {
        if (unsent != null) {
            space.enqueue(Entry.urgent(() -> abandoned(request), () -> {}));
        }
    }

    @Override
    public void timedOut(Request<?> request) {
        space.reports().logArgumentsOfLate(request);
        if (unsent != null && request.isAbandoned()) {
            request.cancel();
        }
    }

    private void abandoned(Request<?> request) {
        if (instance instanceof Forwarder forwarder) {
            guard("the end of a call", () -> forwarder.abandoned(request));
        }
    }

    /** True if an exception of a request or of a listener is a failure of the actor. */
    boolean countsRequests(Throwable thrown) {
        return settings.supervision().forError(thrown).requestsAndListeners();
    }

    @Override
    public RuntimeException answeredNull(String method) {
        return new ActorException(method + " of " + this + " returned null, expected a promise");
    }

    @Override
    public String progressOf(Request<?> request) {
        int inMailbox = placeInMailbox(request);
        int before = inMailbox >= 0 ? inMailbox : space.dispatcher.messagesBefore(request, COUNTED);
        if (before >= 0) {
            boolean isHeld = exceptional != null && exceptional.byActor;
            return ", which has not begun it: " + before + " calls come first" + (isHeld ? ", and it holds them" : "");
        }
        return space.dispatcher.isLongerThan(COUNTED)
                ? ", where more than " + COUNTED + " calls wait"
                : ", which has begun it";
    }

    Class<?> type() {
        return type;
    }

    /** Its name, or that of its type. */
    String label() {
        String name = settings.name();
        return name != null ? name : type.getSimpleName();
    }

    /** The number of an actor without a name; otherwise 0. */
    int unnamedNumber() {
        return settings.name() == null ? number : 0;
    }

    @Override
    public String toString() {
        String name = settings.name();
        return name != null ? name : type.getSimpleName() + "#" + number;
    }

    /**
     * The share of an actor in a space that has a quota: so many calls in a round. A round ends when all messages have
     * run that were queued in the space when the share was used up. Calls beyond the share wait here. On the space's
     * thread.
     */
    private static final class Share {
        private final ActorCell cell;
        private final int quota;
        private final ArrayDeque<QueueEntry> waiting = new ArrayDeque<>(); // for a later round
        private final ArrayDeque<QueueEntry> due = new ArrayDeque<>(); // queued once more, in this round
        private int left;

        Share(ActorCell cell, int quota) {
            this.cell = cell;
            this.quota = quota;
            this.left = quota;
        }

        /** True if a call is to be delivered now; otherwise it waits. */
        boolean admits(QueueEntry ticket) {
            if (due.peekFirst() == ticket) {
                due.removeFirst();
            } else if (left == 0 || isUsed()) {
                waiting.addLast(ticket); // behind the older ones
                return false;
            }
            if (--left == 0) {
                cell.space.enqueueMessageLast(Entry.urgent(this::begin, () -> {}));
            } else {
                queueNext();
            }
            return true;
        }

        /** True if calls wait that are older than the next one. */
        boolean isUsed() {
            return !due.isEmpty() || !waiting.isEmpty();
        }

        /** Begins a round. */
        private void begin() {
            left = quota;
            queueNext();
        }

        private void queueNext() {
            while (due.size() < left && !waiting.isEmpty()) {
                QueueEntry ticket = waiting.removeFirst();
                if (!(ticket instanceof Entry)) { // a stop, see stopBehindCalls()
                    due.addLast(ticket);
                }
                cell.space.enqueueMessage(ticket);
            }
        }
    }

    /** What an actor keeps once it has failed, or has held its calls back. On the space's thread. */
    private static final class Exceptional {
        private final Map<Supervision, Record> records = new IdentityHashMap<>(2);
        private int starts; // failed starts in a row
        private long startedNanos; // when the current instance started, if there was a failure before
        private @Nullable Record last; // of the last failure
        private @Nullable Throwable endedBy; // the failure that led to the end of the last instance
        // calls held back by the actor, or while a restart waits, until all of them have been delivered
        private @Nullable ArrayDeque<QueueEntry> held;
        private boolean byActor; // the actor holds its calls back
        private boolean stopHeld; // a stop is queued among the held calls
        private boolean releasing;
        private boolean standsForPool; // see standForPool()
        private @Nullable Timer restartTimer; // the timer of the pause before a restart
        private @Nullable Share share; // only if the space has a quota for its actors

        /** Holds calls back from now on. */
        void hold() {
            if (held == null) {
                held = new ArrayDeque<>();
            }
        }

        /** Counts a failure and returns the directive for it. */
        Supervision.Directive note(Supervision supervision, long nowNanos, boolean starting) {
            Record failures = records.computeIfAbsent(supervision, Record::new);
            last = failures;
            if (!starting && failures.isOver(nowNanos - startedNanos)) {
                failures.inARow = 0;
            }
            boolean isWithinLimit = failures.note(nowNanos) && starts <= supervision.limit();
            return isWithinLimit ? supervision.directive() : Supervision.Directive.STOP;
        }

        /**
         * The pause before a restart. Without pauses in the supervision, from the second failed start in a row, so that
         * an actor that cannot start leaves time for the others.
         */
        long pauseNanos() {
            var failures = Objects.requireNonNull(last);
            return failures.supervision.hasPauses()
                    ? doubled(
                            Home.nanosOf(failures.supervision.firstPause()),
                            failures.inARow - 1,
                            Home.nanosOf(failures.supervision.longestPause()))
                    : starts < 2 ? 0 : doubled(FIRST_PAUSE_NANOS, starts - 2, LONGEST_PAUSE_NANOS);
        }

        private static long doubled(long nanos, int times, long longest) {
            return times >= Long.numberOfLeadingZeros(nanos) - 1 ? longest : Math.min(longest, nanos << times);
        }
    }

    /** The failures of an actor that fall under one supervision. */
    private static final class Record {
        private final Supervision supervision;
        private final ArrayDeque<Long> recent = new ArrayDeque<>(); // those within the window
        private int inARow; // those without a run as long as the window in between

        Record(Supervision supervision) {
            this.supervision = supervision;
        }

        /** Counts a failure; false if it exceeds the limit. */
        boolean note(long nowNanos) {
            if (inARow < Integer.MAX_VALUE) {
                inARow++;
            }
            if (supervision.limit() == Integer.MAX_VALUE) {
                return true;
            }
            while (!recent.isEmpty() && isOver(nowNanos - recent.peekFirst())) {
                recent.removeFirst();
            }
            recent.addLast(nowNanos);
            boolean pausesCount = !supervision.hasPauses(); // else a long pause would hide the failures before it
            return (pausesCount ? recent.size() : inARow) <= supervision.limit();
        }

        /** Compares durations: a window may exceed the range of nanoseconds in a long. */
        boolean isOver(long agoNanos) {
            return Duration.ofNanos(agoNanos).compareTo(supervision.window()) >= 0;
        }
    }
}
