package io.troupe.actor;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Home;
import io.troupe.actor.promise.Node;
import io.troupe.actor.promise.NodeQueue;
import io.troupe.actor.promise.Owner;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.Schedule;
import io.troupe.actor.time.Timer;
import io.troupe.actor.time.TimerWheel;
import java.time.Duration;
import java.util.function.BooleanSupplier;
import org.jspecify.annotations.Nullable;

/**
 * A space as the rest of this library sees it: the home of promises, the way into the queues of its thread, and on
 * whose behalf that thread runs. Users see it as an {@link ActorSpace}. What it is made of is put together here.
 *
 * <p><b>Threads.</b> Queueing, and asking for its state, from any thread; turns on the space's.
 */
abstract sealed class SpaceHome extends Home permits ActorSpace {
    // the space's own and not a part's, because every call from outside and every answer reads them
    private final NodeQueue inbox = new NodeQueue();
    private final NodeQueue callbackInbox = new NodeQueue();
    private final NodeRing callbacks = new NodeRing();
    private final NodeRing mails = new NodeRing();
    private final Lifeline lifeline = new Lifeline();
    private @Nullable Thread thread; // the one that serves now; a thread finds itself here only while it has the baton

    final SpaceSettings settings;
    final Dispatcher dispatcher;
    final Closing closing;
    final SpaceLoop loop;
    private final Reports reports;
    private final Rejections rejections;
    private final SpaceTimers timers;
    private final Probing figures;
    private final Sequences sequences = new Sequences(this);
    private final ActorList actors = new ActorList();

    SpaceHome(SpaceSettings settings) {
        this.settings = settings;
        var wheel = new TimerWheel(settings.clock(), this::isCurrent);
        reports = new Reports(this, settings);
        dispatcher = new Dispatcher(this, inbox, callbackInbox, callbacks, mails, wheel, settings.clock());
        timers = new SpaceTimers(this, settings.clock(), wheel);
        rejections = new Rejections(wheel, reports);
        figures = new Probing(this, dispatcher, reports);
        closing = new Closing(
                this, dispatcher, lifeline, rejections, settings.clock().onMove(lifeline::wake));
        loop = new SpaceLoop(this, settings, dispatcher, lifeline, rejections, closing);
    }

    final void startThread() {
        new SpaceThread(this, callbacks, mails, loop).start();
    }

    // ---- the way into the queues

    /** @hidden */
    @Override
    protected final boolean isCurrent() {
        return Thread.currentThread() == thread;
    }

    /** @hidden */
    @Override
    protected final void enqueue(Node node) {
        enqueueCallback(node);
    }

    final void enqueueCallback(Node node) {
        if (isCurrent()) {
            callbacks.add(node);
        } else {
            offer(node, callbackInbox);
        }
    }

    /** @hidden */
    @Override
    protected final void enqueueFromAfar(Node node) {
        offer(node, callbackInbox);
    }

    /** @hidden */
    @Override
    protected final void enqueueAtHome(Node node) {
        if (Thread.currentThread() instanceof SpaceThread own && own.serves(this)) {
            own.callbacks().add(node);
        } else {
            callbacks.add(node);
        }
    }

    /** @hidden */
    @Override
    protected final boolean isNextCallbackFirst() {
        return callbacks.isEmpty() && !callbackInbox.isReady();
    }

    final void enqueueMail(Node node) {
        if (isCurrent()) {
            mails.add(node);
        } else {
            offer(node, inbox);
        }
    }

    /** If this throws, nothing was queued. */
    private void offer(Node node, NodeQueue queue) {
        if (lifeline.phase == Lifeline.CLOSED) {
            closing.checkStack(); // for this caller has to turn the node away itself
        }
        queue.offer(node);
        try {
            if (!lifeline.wake()) {
                closing.refuseLeftovers();
            }
        } catch (StackOverflowError endOfTheCallersStack) {
            // it is queued: the space looks at its queues by itself within a second; if it is closed, the next caller
            // does
        }
    }

    // ---- what promises ask of their home

    /** @hidden */
    @Override
    protected final Runnable schedule(long delayNanos, Runnable task, Runnable ifClosed) {
        return timers.schedule(delayNanos, task, ifClosed);
    }

    /** @hidden */
    @Override
    protected final void rejected(Promise<?> promise, Throwable error) {
        if (lifeline.isClosed() && (isMadeOutside(promise) || error instanceof ActorStoppedException)) {
            return; // a late asker has the refusal in its hands, and the others are counted
        }
        if (!isCurrent()) {
            enqueueMail(new Entry(() -> rejected(promise, error), () -> rejected(promise, error)));
        } else if (isStopping() && error instanceof ActorStoppedException) {
            return; // counted among the leftovers
        } else if (isMadeOutside(promise)) {
            rejections.hold(promise, error);
        } else {
            rejections.add(promise, error);
        }
    }

    /** @hidden */
    @Override
    protected final void rejectedTooLate(Promise<?> promise, Throwable error) {
        if (!(error
                instanceof
                ActorStoppedException)) { // a caller that waits no longer need not know that no answer will come
            rejected(promise, error);
        }
    }

    /** @hidden */
    @Override
    protected final void await(Promise<?> promise) {
        sequences.await(promise);
    }

    // ---- its thread

    /**
     * The calling thread is this space's from now on.
     *
     * @return for {@link #leave}
     */
    final @Nullable Home enter() {
        takeThread();
        beginForItself();
        return enterThread();
    }

    final void giveUpThread() {
        thread = null;
    }

    static void leave(@Nullable Home before) {
        leaveThread(before);
    }

    /** The one that holds the baton now; a moment later it may be another. */
    final @Nullable Thread servingThread() {
        return thread;
    }

    /** The calling thread has the baton. */
    final void takeThread() {
        thread = Thread.currentThread();
    }

    /** The calling thread, which has the baton, is about to pass it to that one. */
    final void handThreadTo(@Nullable Thread next) {
        thread = next;
    }

    /** Runs something on a thread that holds the baton. */
    final void runOnLoan(Runnable body) {
        Home before = enterThread();
        try {
            body.run();
        } finally {
            leaveThread(before);
        }
    }

    // ---- turns, on its thread

    final void beginTurnOf(Owner owner) {
        begin(owner);
    }

    /** See {@link Home#renewTurn}. */
    final void renewOwner() {
        renewTurn();
    }

    final Owner currentOwner() {
        return owner();
    }

    /** Runs an action when the entry that is being served has returned, before anything else. */
    final void afterTurn(Runnable action) {
        dispatcher.afterTurn(action);
    }

    /** On the space's own behalf, in the midst of whatever turn it is; from any thread. */
    final void asItself(Runnable action) {
        if (!isCurrent()) {
            action.run();
            return;
        }
        Owner before = owner();
        beginForItself();
        try {
            action.run();
        } finally {
            begin(before);
        }
    }

    /** On the space's own behalf. */
    final void runGuarded(Runnable task) {
        beginForItself();
        try {
            task.run();
        } catch (Throwable thrown) {
            reports.error("a task of space", this, thrown, null);
        }
    }

    /** Lets a node deal with what running it has thrown. */
    final void fail(Node node, Throwable thrown) {
        try {
            threw(node, thrown);
        } catch (Throwable again) {
            reports.error("an entry of space", this, again, null);
        }
    }

    // ---- its parts and its state

    final ActorList actors() {
        return actors;
    }

    final Reports reports() {
        return reports;
    }

    final Sequences sequences() {
        return sequences;
    }

    final SpaceMetrics figures() {
        return figures;
    }

    final SpaceTimers timers() {
        return timers;
    }

    final Timer timer(ActorCell cell, Duration delay, Duration period, Schedule schedule, Runnable task) {
        return timers.set(cell, delay, period, schedule, task);
    }

    final boolean isCrankedByHand() {
        return settings.handCranked();
    }

    final boolean isClosing() {
        return closing.hasBegun();
    }

    /** Whether it is closed, so that whoever still queues something turns that away himself. */
    final boolean hasEnded() {
        return lifeline.isClosed();
    }

    /** Whether it has served what it will ever serve; on its thread. */
    final boolean isStopping() {
        return loop.isStopping();
    }

    final void checkCurrent(String call) {
        if (!isCurrent()) {
            throw new IllegalStateException(call + " belongs on the thread of space " + this + ", and was called on "
                    + Thread.currentThread().getName() + ": call the actor through its proxy");
        }
    }

    // ---- what only a home may ask of nodes and promises, for this room

    static @Nullable Node serveNode(Node node) throws Throwable {
        return serve(node);
    }

    static boolean goesToMailbox(Node node) {
        return isMail(node);
    }

    static long countedNanos(Duration duration) {
        return nanosOf(duration);
    }

    static boolean isListenedTo(Promise<?> promise) {
        return isHeard(promise);
    }

    /** See {@link Home#whenSettled}. */
    final void whenPromiseSettled(Promise<?> promise, BooleanSupplier isOver, Runnable action) {
        whenSettled(promise, isOver, action);
    }

    /** See {@link Home#cancellable}. */
    final <T extends @Nullable Object> Deferred<T> deferred(Runnable ifCancelled) {
        return cancellable(this, ifCancelled);
    }
}
