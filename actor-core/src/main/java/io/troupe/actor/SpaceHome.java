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
 * The internal side of an {@link ActorSpace}: the home of promises, the queues of its thread, and the owner on whose
 * behalf the thread runs. The parts of a space are created here.
 *
 * <p><b>Threads.</b> Queueing and reading the state from any thread; turns on the space's thread.
 */
abstract sealed class SpaceHome extends Home permits ActorSpace {
    // fields of the space itself, because every call from another thread and every answer reads them
    private final NodeQueue inbox = new NodeQueue();
    private final NodeQueue callbackInbox = new NodeQueue();
    private final NodeRing callbacks = new NodeRing();
    private final NodeRing messages = new NodeRing();
    private final IdleStrategy idle = new IdleStrategy();
    private @Nullable Thread thread; // the thread that has control now; only that thread finds itself here

    final SpaceSettings settings;
    final Dispatcher dispatcher;
    final Closing closing;
    final SpaceLoop loop;
    private final Reports reports;
    private final Rejections rejections;
    private final SpaceTimers timers;
    private final ProbedMetrics figures;
    private final SequentialBodies sequences = new SequentialBodies(this);
    private final ActorList actors = new ActorList();

    SpaceHome(SpaceSettings settings) {
        this.settings = settings;
        var wheel = new TimerWheel(settings.clock(), this::isCurrent);
        reports = new Reports(this, settings);
        dispatcher = new Dispatcher(this, inbox, callbackInbox, callbacks, messages, wheel, settings.clock());
        timers = new SpaceTimers(this, settings.clock(), wheel);
        rejections = new Rejections(wheel, reports);
        figures = new ProbedMetrics(this, dispatcher, reports);
        closing =
                new Closing(this, dispatcher, idle, rejections, settings.clock().onMove(idle::wake));
        loop = new SpaceLoop(this, settings, dispatcher, idle, rejections, closing);
    }

    final void startThread() {
        new SpaceThread(this, callbacks, messages, loop).start();
    }

    // ---- queueing

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
    protected final void enqueueAsRemote(Node node) {
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

    final void enqueueMessage(Node node) {
        if (isCurrent()) {
            messages.add(node);
        } else {
            offer(node, inbox);
        }
    }

    /** Queues a node of another thread; if this throws, nothing was queued. */
    private void offer(Node node, NodeQueue queue) {
        if (idle.phase == IdleStrategy.CLOSED) {
            closing.checkStack(); // because this caller must reject the node itself
        }
        queue.offer(node);
        try {
            if (!idle.wake()) {
                closing.rejectLeftovers();
            }
        } catch (StackOverflowError endOfTheCallersStack) {
            // it is queued: the space checks its queues by itself within a second; if it is closed, the next caller
            // does
        }
    }

    // ---- services for promises

    /** @hidden */
    @Override
    protected final Runnable schedule(long delayNanos, Runnable task, Runnable ifClosed) {
        return timers.schedule(delayNanos, task, ifClosed);
    }

    /** @hidden */
    @Override
    protected final void rejected(Promise<?> promise, Throwable error) {
        if (idle.isClosed() && (isMadeOutside(promise) || error instanceof ActorStoppedException)) {
            return; // a late caller gets the rejection, and the other requests are counted
        }
        if (!isCurrent()) {
            enqueueMessage(new Entry(() -> rejected(promise, error), () -> rejected(promise, error)));
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
        if (!(error instanceof ActorStoppedException)) { // a caller that has timed out does not need this error
            rejected(promise, error);
        }
    }

    /** @hidden */
    @Override
    protected final void await(Promise<?> promise) {
        sequences.await(promise);
    }

    // ---- thread

    /**
     * Makes the calling thread this space's thread.
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

    /** The thread that has control now; this may change at any time. */
    final @Nullable Thread servingThread() {
        return thread;
    }

    /** Makes the calling thread the one that has control. */
    final void takeThread() {
        thread = Thread.currentThread();
    }

    /** Passes control from the calling thread to another one. */
    final void handThreadTo(@Nullable Thread next) {
        thread = next;
    }

    /** Runs a body on a thread that has control. */
    final void runOnLoan(Runnable body) {
        Home before = enterThread();
        try {
            body.run();
        } finally {
            leaveThread(before);
        }
    }

    // ---- turns, on the space's thread

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

    /** Runs an action when the current entry has returned, before anything else. */
    final void afterTurn(Runnable action) {
        dispatcher.afterTurn(action);
    }

    /** Runs an action on the space's own behalf within the current turn; from any thread. */
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

    /** Runs a task on the space's own behalf and reports what it throws. */
    final void runGuarded(Runnable task) {
        beginForItself();
        try {
            task.run();
        } catch (Throwable thrown) {
            reports.error("a task of space", this, thrown, null);
        }
    }

    /** Passes an exception thrown by a node to the node's handler. */
    final void fail(Node node, Throwable thrown) {
        try {
            threw(node, thrown);
        } catch (Throwable again) {
            reports.error("an entry of space", this, again, null);
        }
    }

    // ---- parts and state

    final ActorList actors() {
        return actors;
    }

    final Reports reports() {
        return reports;
    }

    final SequentialBodies sequences() {
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

    /** True once the space is closed; callers must then reject their own entries. */
    final boolean hasEnded() {
        return idle.isClosed();
    }

    /** True once the space processes no further entries; on its thread. */
    final boolean isStopping() {
        return loop.isStopping();
    }

    final void checkCurrent(String call) {
        if (!isCurrent()) {
            throw new IllegalStateException(call + " belongs on the thread of space " + this + ", and was called on "
                    + Thread.currentThread().getName() + ": call the actor through its proxy");
        }
    }

    // ---- access to nodes and promises for this package

    static @Nullable Node serveNode(Node node) throws Throwable {
        return serve(node);
    }

    static boolean goesToMailbox(Node node) {
        return isMessage(node);
    }

    static long countedNanos(Duration duration) {
        return nanosOf(duration);
    }

    static boolean isListenedTo(Promise<?> promise) {
        return isHandled(promise);
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
