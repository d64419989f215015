package io.troupe.actor;

import io.troupe.actor.Reports.Trouble;
import io.troupe.actor.internal.loop.EntryQueue;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.QueueEntries;
import io.troupe.actor.internal.loop.QueueEntry;
import io.troupe.actor.internal.loop.TurnOwner;
import java.util.Objects;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * The internal side of an {@link ActorSpace}: its queues, its thread, and its other parts, which are created here.
 *
 * <p><b>Threads.</b> Queueing and reading the state from any thread; turns on the space's thread.
 */
final class SpaceHome extends Home {
    static {
        EarlyClasses.load();
    }

    // fields of the space itself, because every call from another thread and every answer reads them
    private final EntryQueue inbox = new EntryQueue();
    private final EntryQueue callbackInbox = new EntryQueue();
    private final EntryRing callbacks = new EntryRing(callbackInbox);
    private final EntryRing messages = new EntryRing();
    private final IdleStrategy idle = new IdleStrategy();
    private @Nullable Thread thread; // the thread that has control now; only that thread finds itself here
    private @Nullable TimeLimit limit; // of the current turn; most turns have none
    private ObservedCalls.@Nullable ObservedCall served; // by the current turn; only in spaces with an observer
    private @Nullable SpaceThread ownThread; // set once, before it is started
    private volatile @Nullable ClassLoader contextClassLoader; // null when the space has ended

    @Nullable
    ActorSpace facade; // set once, by its constructor

    int handlers; // those that run for this space on other threads than its own: see HandlerTurn

    final Object key = new Object(); // for observers: two spaces may have one name
    final SpaceSettings settings;
    final Dispatcher dispatcher;
    final Closing closing;
    final SpaceLoop loop;
    private final Reports reports;
    private final Reports.Rejections rejections;
    private final SpaceTimers timers;
    private final @Nullable Contexts<?> contexts; // most spaces have none
    private final ProbedMetrics figures;
    private final SequentialBodies sequences = new SequentialBodies(this);
    private final ActorList actors = new ActorList();

    /** @param loader the context class loader of the space's threads */
    SpaceHome(SpaceSettings settings, @Nullable ClassLoader loader) {
        this.settings = settings;
        this.contextClassLoader = loader;
        var wheel = new TimerWheel(settings.clock(), this::isCurrent);
        reports = new Reports(this, settings);
        dispatcher = new Dispatcher(this, inbox, callbackInbox, callbacks, messages, wheel, settings.clock());
        timers = new SpaceTimers(this, settings.clock(), wheel);
        contexts = settings.context() == null ? null : new Contexts<>(settings.context(), reports);
        rejections = new Reports.Rejections(wheel, reports);
        figures = new ProbedMetrics(this, dispatcher, reports);
        closing =
                new Closing(this, dispatcher, idle, rejections, settings.clock().onMove(idle::wake));
        loop = new SpaceLoop(this, settings, dispatcher, idle, rejections, closing);
    }

    void startThread() {
        boolean isDirect = contexts == null && settings.callObserver() == null;
        ownThread = CleanThreads.create(() -> new SpaceThread(this, isDirect, callbacks, messages, loop));
        ownThread.start();
    }

    // ---- queueing

    @Override
    public boolean isCurrent() {
        return Thread.currentThread() == thread;
    }

    @Override
    public void enqueue(QueueEntry node) {
        if (isCurrent()) {
            callbacks.add(node);
            messages.allow(0); // the callback comes first
        } else {
            offer(node, callbackInbox);
        }
    }

    /** Queues a callback behind those that other threads have queued so far; on this space's thread. */
    void enqueueBehindArrivals(QueueEntry node) {
        dispatcher.takeCallbacks();
        enqueue(node);
    }

    @Override
    public void enqueueAsRemote(QueueEntry node) {
        offer(node, callbackInbox);
    }

    /**
     * Queues a callback for a caller that may hold a lock, under which no code of a user may run.
     *
     * @return false if the space is closed: then the caller has to call {@link #rejectLeftovers}, not under the lock
     */
    boolean enqueueUnderLock(QueueEntry node) {
        if (isCurrent()) {
            enqueue(node);
            return true;
        }
        return offerOnly(node, callbackInbox);
    }

    @Override
    public void enqueueAtHome(QueueEntry node) {
        if (Thread.currentThread() instanceof SpaceThread own && own.serves(this)) {
            own.callbacks().add(node);
            own.messages().allow(0); // the callback comes first
        } else {
            callbacks.add(node);
            messages.allow(0);
        }
    }

    @Override
    public boolean isNextCallbackFirst() {
        return callbacks.isEmpty() && !callbackInbox.isReady();
    }

    void enqueueMessage(QueueEntry node) {
        if (isCurrent()) {
            messages.add(node);
        } else {
            offer(node, inbox);
        }
    }

    /** Queues an entry behind all messages that are queued, those of other threads included; on this space's thread. */
    void enqueueMessageLast(QueueEntry node) {
        offer(node, inbox);
    }

    /** Queues an entry of another thread; if this throws, nothing was queued. */
    private void offer(QueueEntry node, EntryQueue queue) {
        if (!offerOnly(node, queue)) {
            rejectLeftovers();
        }
    }

    /**
     * Like {@link #offer}, but leaves it to the caller to reject the entry if the space is closed: this returns false.
     */
    private boolean offerOnly(QueueEntry node, EntryQueue queue) {
        if (idle.phase == IdleStrategy.CLOSED) {
            closing.checkStack(); // because this caller must reject the entry itself
        }
        queue.offer(node);
        try {
            return idle.wake();
        } catch (StackOverflowError endOfTheCallersStack) {
            return true; // it is queued: the space checks its queues by itself within a second
        }
    }

    /** Rejects what this thread has queued in a closed space. */
    void rejectLeftovers() {
        try {
            closing.rejectLeftovers();
        } catch (StackOverflowError endOfTheCallersStack) {
            // the next caller does
        }
    }

    // ---- services for promises

    @Override
    public Runnable schedule(long delayNanos, Runnable task, Runnable ifClosed) {
        return timers.schedule(delayNanos, task, ifClosed);
    }

    @Override
    public void rejected(QueueEntry node, Throwable error) {
        var promise = (Promise<?>) node;
        try {
            noteRejected(promise, error);
        } catch (Throwable noMemory) { // the promise is settled: its listeners come first
            reports.rejected(promise, error);
        }
    }

    private void noteRejected(Promise<?> promise, Throwable error) {
        if (idle.isClosed() && (Promise.isMadeOutside(promise) || error instanceof ActorStoppedException)) {
            return; // a late caller gets the rejection, and the other requests are counted
        }
        if (!isCurrent()) {
            enqueueMessage(new Entry(() -> rejected(promise, error), () -> rejected(promise, error)));
        } else if (isStopping() && error instanceof ActorStoppedException) {
            return; // counted among the leftovers
        } else if ((HandlerTurn.now() & HandlerTurn.ERROR) != 0) {
            reports.rejected(promise, error); // sent by the error handler
        } else if (Promise.isMadeOutside(promise)) {
            rejections.hold(promise, error);
        } else {
            rejections.add(promise, error);
        }
    }

    @Override
    public void rejectedTooLate(QueueEntry promise, Throwable error) {
        if (!(error instanceof ActorStoppedException)) { // a caller that has timed out does not need this error
            rejected(promise, error);
        }
    }

    @Override
    public void limitExpired() {
        reports.limitExpired();
    }

    @Override
    public void await(QueueEntry promise) {
        sequences.await((Promise<?>) promise);
    }

    @Override
    public @Nullable Supplier<Runnable> captureContext() {
        TimeLimit now = limit; // a guess on other threads
        var context = now == null ? captureCallers() : capture(isCurrent() ? now : null);
        CallObserver observer = settings.callObserver();
        return observer == null ? context : observed(observer, context);
    }

    /** Captures the context of the calling thread, without its time limit; null if there is nothing to carry. */
    @Nullable
    Supplier<Runnable> captureCallers() {
        return contexts == null ? null : contexts.capture();
    }

    /** Captures the context of the calling thread, with that time limit, for a turn of this space. */
    @Nullable
    Supplier<Runnable> capture(@Nullable TimeLimit captured) {
        Supplier<Runnable> callers = captureCallers();
        return captured == null ? callers : () -> enterLimit(captured, callers);
    }

    private Runnable enterLimit(TimeLimit captured, @Nullable Supplier<Runnable> callers) {
        captured.check();
        TimeLimit before = limit;
        setLimit(captured);
        Runnable end = callers == null ? () -> {} : callers.get();
        return () -> {
            end.run();
            setLimit(before);
        };
    }

    /** The time limit of the current turn, or null; on this space's thread. */
    @Nullable
    TimeLimit limit() {
        return limit;
    }

    /** Sets the time limit of the current turn; on this space's thread. */
    void setLimit(@Nullable TimeLimit next) {
        limit = next;
        if (ownThread != null) {
            ownThread.setHasLimit(next != null);
        }
    }

    /** See {@link CallObserver#servedCall}; on this space's thread. */
    ObservedCalls.@Nullable ObservedCall served() {
        return served;
    }

    /** Sets the call that is served, and returns the one before; on this space's thread. */
    ObservedCalls.@Nullable ObservedCall serve(ObservedCalls.@Nullable ObservedCall next) {
        var before = served;
        served = next;
        return before;
    }

    private Supplier<Runnable> observed(CallObserver observer, @Nullable Supplier<Runnable> context) {
        var captured = isCurrent() ? served : null;
        return () -> {
            Runnable end = context == null ? () -> {} : context.get();
            if (!isCurrent()) {
                return end; // it is closed
            }
            CallObserver.Turn turn = ObservedCalls.turnBegun(observer, this, owner());
            var before = serve(captured);
            return () -> {
                serve(before);
                turn.end();
                end.run();
            };
        };
    }

    // ---- thread

    /**
     * Makes the calling thread this space's thread.
     *
     * @return for {@link #leaveThread}
     */
    @Nullable
    Home enter() {
        takeThread();
        beginForItself();
        return enterThread();
    }

    @Nullable
    ClassLoader contextClassLoader() {
        return contextClassLoader;
    }

    void dropContextClassLoader() {
        contextClassLoader = null;
    }

    void giveUpThread() {
        thread = null;
    }

    /** The thread that has control now; this may change at any time. */
    @Nullable
    Thread servingThread() {
        return thread;
    }

    /** Makes the calling thread the one that has control. */
    void takeThread() {
        thread = Thread.currentThread();
    }

    /** Passes control from the calling thread to another one. */
    void handThreadTo(@Nullable Thread next) {
        thread = next;
    }

    /** Runs a body on a thread that has control. */
    void runOnLoan(Runnable body) {
        Home before = enterThread();
        try {
            body.run();
        } finally {
            leaveThread(before);
        }
    }

    // ---- turns, on the space's thread

    @Override
    protected TurnOwner keptOwner() {
        QueueEntry kept = messages.kept();
        TurnOwner owner = kept == null ? null : QueueEntries.turnOwner(kept);
        return owner == null ? itself() : owner;
    }

    /** Begins the turn of a message that is in no ring. */
    void beginFor(QueueEntry message) {
        TurnOwner owner = QueueEntries.turnOwner(message);
        begin(owner == null ? itself() : owner);
    }

    /** Runs a task on the space's own behalf and reports what it throws. */
    @Override
    protected void runGuarded(Runnable task) {
        beginForItself();
        try {
            task.run();
        } catch (Throwable thrown) {
            reports.error(Trouble.A_TASK, this, thrown);
        }
    }

    // ---- parts and state

    /** The user's side of this home. */
    ActorSpace facade() {
        return Objects.requireNonNull(facade);
    }

    ActorList actors() {
        return actors;
    }

    Reports reports() {
        return reports;
    }

    SequentialBodies sequences() {
        return sequences;
    }

    SpaceMetrics figures() {
        return figures;
    }

    SpaceTimers timers() {
        return timers;
    }

    boolean isThreadless() {
        return settings.threadless();
    }

    boolean isClosing() {
        return closing.hasBegun();
    }

    /** True once the space is closed; callers must then reject their own entries. */
    boolean hasEnded() {
        return idle.isClosed();
    }

    /** True once the space processes no further entries; on its thread. */
    boolean isStopping() {
        return loop.isStopping();
    }

    @Override
    public boolean isEnding() {
        return hasEnded() || isCurrent() && isStopping();
    }

    void checkCurrent(String call) {
        if (!isCurrent()) {
            throw new IllegalStateException(call + " belongs on the thread of space " + this + ", and was called on "
                    + Thread.currentThread().getName() + ": call the actor through its proxy, or use execute(..)");
        }
    }

    @Override
    public String toString() {
        return settings.name();
    }

    /** Captures and restores the contexts of callers; what the hook throws is reported. From any thread. */
    private static final class Contexts<C> {
        private static final Runnable NOTHING = () -> {};

        private final TurnContext<C> hook;
        private final Reports reports;

        Contexts(TurnContext<C> hook, Reports reports) {
            this.hook = hook;
            this.reports = reports;
        }

        @Nullable
        Supplier<Runnable> capture() {
            try {
                C captured = hook.capture();
                return captured == null ? null : () -> restore(captured);
            } catch (Throwable thrown) {
                report("capture", thrown);
                return null;
            }
        }

        private Runnable restore(C captured) {
            try {
                Runnable end = hook.restore(captured);
                return () -> end(end);
            } catch (Throwable thrown) {
                report("restore", thrown);
                return NOTHING;
            }
        }

        private void end(Runnable end) {
            try {
                end.run();
            } catch (Throwable thrown) {
                report("end", thrown);
            }
        }

        private void report(String step, Throwable thrown) {
            reports.error(step.concat(" of"), hook, thrown);
        }
    }

    /**
     * The actors of a space that have started and not stopped, in the order of their start. The list is linked through
     * the cells, so that an actor needs no list entry.
     */
    static final class ActorList {
        private @Nullable ActorCell first;
        private @Nullable ActorCell last;
        private int size;

        int size() {
            return size;
        }

        /** Appends a cell. No effect if it is already in the list: a restarted actor keeps its position. */
        void add(ActorCell cell) {
            if (contains(cell)) {
                return;
            }
            cell.before = last;
            if (last == null) {
                first = cell;
            } else {
                last.after = cell;
            }
            last = cell;
            size++;
        }

        void remove(ActorCell cell) {
            if (!contains(cell)) {
                return;
            }
            if (cell.before == null) {
                first = cell.after;
            } else {
                cell.before.after = cell.after;
            }
            if (cell.after == null) {
                last = cell.before;
            } else {
                cell.after.before = cell.before;
            }
            cell.before = null;
            cell.after = null;
            size--;
        }

        private boolean contains(ActorCell cell) {
            return cell.before != null || first == cell;
        }

        /** The actor that has started first, or null. */
        @Nullable
        ActorCell first() {
            return first;
        }
    }
}
