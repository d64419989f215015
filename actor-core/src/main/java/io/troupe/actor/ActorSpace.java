package io.troupe.actor;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Home;
import io.troupe.actor.promise.Node;
import io.troupe.actor.promise.NodeQueue;
import io.troupe.actor.promise.Owner;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.Clock;
import io.troupe.actor.time.Timer;
import io.troupe.actor.time.TimerWheel;
import java.time.Duration;
import java.util.Objects;
import java.util.concurrent.Callable;
import java.util.concurrent.CancellationException;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.BooleanSupplier;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * The one thread on which its actors live.
 *
 * <p><b>Role.</b> {@link #global()} is the space of the paper; {@link #create} makes further ones, for tests or one per core. Ends with
 * {@link #close}.
 * <p><b>Threads.</b> Every method from any thread unless it says otherwise. An actor's code only ever runs on its space's thread, so it
 * needs no locks.
 * <p><b>Order.</b> Calls from one sender to one actor are handled in the order in which they were made. Answers and other callbacks are
 * handled before messages, but never more than 256 of them in a row.
 * <p><b>Errors.</b> See {@link SpaceSettings}: nothing is swallowed.
 * <p><b>Source.</b> Paper, section 1: mailbox and callback queue of each actor in a global actor space of a single thread.
 */
public final class ActorSpace extends Home implements AutoCloseable {
    private static final long GRACE_NANOS = 1_000_000_000;
    private static final Duration CLOSING_TIME = Duration.ofSeconds(10);

    private static final class Global {
        static final ActorSpace SPACE = open(new ActorSpace(SpaceSettings.named("actor-space"), false));
    }

    private final SpaceSettings settings;
    private final Dispatcher dispatcher;
    private final NodeQueue inbox = new NodeQueue();
    private final NodeRing callbacks = new NodeRing();
    private final NodeRing mails = new NodeRing();
    private final Reports reports;
    private final Lifeline lifeline = new Lifeline();
    private final Rejections rejections = new Rejections();
    private final ActorList actors = new ActorList();
    private final AtomicInteger spawned = new AtomicInteger();
    private final AtomicBoolean closing = new AtomicBoolean();
    private final AtomicBoolean refusing = new AtomicBoolean();
    private final boolean closeable;
    private final Offload offload;
    private final Sequences sequences = new Sequences(this);
    private final Probing metrics;
    private final CountDownLatch ended = new CountDownLatch(1);
    private final Deferred<@Nullable Void> closed = new Deferred<>((Home) null);
    private final Runnable clockRegistration;
    private @Nullable Thread thread; // the one that serves now; only ever equal to a reader that set it itself
    private volatile @Nullable Leftovers leftovers;
    private boolean stopping;

    private ActorSpace(SpaceSettings settings, boolean closeable) {
        this.settings = settings;
        this.closeable = closeable;
        this.reports = new Reports(this, settings);
        this.dispatcher =
                new Dispatcher(this, inbox, callbacks, mails, new TimerWheel(settings.clock(), this::isCurrent));
        this.metrics = new Probing(this, dispatcher, reports);
        this.offload = new Offload(settings.offloadLimit());
        this.clockRegistration = settings.clock().onMove(lifeline::wake);
    }

    /** The space that everybody shares: one daemon thread, started on first use, never closed. */
    public static ActorSpace global() {
        return Global.SPACE;
    }

    /** A space of its own, on a new daemon thread unless it is to be cranked by hand. */
    public static ActorSpace create(SpaceSettings settings) {
        return open(new ActorSpace(settings, true));
    }

    private static ActorSpace open(ActorSpace space) {
        if (!space.settings.handCranked()) {
            new SpaceThread(space, space.callbacks, space.mails).start();
        }
        return space;
    }

    /** The space whose thread is calling, or null. */
    public static @Nullable ActorSpace current() {
        return Home.current() instanceof ActorSpace space ? space : null;
    }

    /**
     * Makes an actor.
     *
     * @param type an interface, or a class that extends {@link Actor}; its public methods return {@code void} or {@link Promise}
     * @param factory makes the implementation, on the space's thread, before the first message
     * @return a proxy, for any thread: calling it sends a message and returns at once
     * @throws ActorTypeException if the type has a method that cannot be a message, or cannot be reached
     * @throws ActorStoppedException if this space is closed
     */
    public <A> A spawn(Class<A> type, Supplier<? extends A> factory) {
        return spawn(type, factory, ActorSettings.DEFAULT);
    }

    /** Makes an actor with settings of its own; see {@link #spawn(Class, Supplier)}. */
    public <A> A spawn(Class<A> type, Supplier<? extends A> factory, ActorSettings actorSettings) {
        Objects.requireNonNull(factory, "factory");
        checkOpen("spawn(" + type.getName() + ")");
        var proxies = ActorType.of(type);
        var cell = new ActorCell(this, type, spawned.incrementAndGet(), factory, actorSettings);
        A proxy = proxies.newProxy(cell);
        cell.bind(proxy);
        enqueueMail(new Entry(cell::start, cell::stop));
        return proxy;
    }

    /** Stops the actor behind a proxy of this space after the messages already in its mailbox. */
    public void stop(Object proxy) {
        ActorCell cell = cellOf(proxy);
        enqueueMail(new Entry(cell::stop, cell::stop));
    }

    /**
     * Watches an actor of this space.
     *
     * @return fulfilled when the actor has stopped, for whatever reason; at once if it has
     */
    public Promise<@Nullable Void> whenStopped(Object proxy) {
        var own = new Deferred<@Nullable Void>(this); // each watcher may cancel its own
        own.resolveFrom(cellOf(proxy).ended());
        return own;
    }

    /**
     * Watches this space.
     *
     * @return fulfilled when it is closed, on its thread, after its actors have stopped; at once if it is closed. Each watcher may cancel its own
     */
    public Promise<@Nullable Void> whenClosed() {
        var own = new Deferred<@Nullable Void>((Home) null);
        own.resolveFrom(closed);
        return own;
    }

    private ActorCell cellOf(Object proxy) {
        if (!(proxy instanceof ActorProxy actor) || actor.troupe$cell().space() != this) {
            throw new IllegalArgumentException("not a proxy of an actor in space " + this + ": "
                    + proxy.getClass().getName());
        }
        return actor.troupe$cell();
    }

    /** Runs a task on the space's thread, in its turn. */
    public void execute(Runnable task) {
        Objects.requireNonNull(task, "task");
        checkOpen("execute(..)");
        enqueueMail(new Entry(() -> runGuarded(task)));
    }

    /**
     * Runs blocking work on a virtual thread, so many at a time as {@link SpaceSettings#offloadLimit} says.
     *
     * @return settled with what the work answers or throws
     */
    public <T extends @Nullable Object> Promise<T> offload(Callable<? extends T> work) {
        return offload.run(this, Objects.requireNonNull(work, "work"));
    }

    /**
     * Runs a body that may wait with {@link Promise#await()}, on a virtual thread that counts as this space's while the body runs: it sees and
     * changes what an actor's code may. While it waits the space serves others, the same actor included, so what it has read before may have changed after.
     *
     * <p><b>Order.</b> The body begins in its turn among the messages, on behalf of the calling actor; what it waited for is a callback. <b>Cost.</b> Two switches
     * between threads for the beginning and for each {@code await()} that really waits.
     *
     * @return settled with what the body answers or throws
     */
    public <T extends @Nullable Object> Promise<T> sequential(Callable<? extends T> body) {
        Objects.requireNonNull(body, "body");
        checkOpen("sequential(..)");
        return sequences.start(body, isCurrent() ? owner() : itself());
    }

    /** Fulfilled after a while, by this space's clock; rejected with {@link CancellationException} if the space is closed before. */
    public Promise<@Nullable Void> delay(Duration duration) {
        var over = new Deferred<@Nullable Void>(this);
        schedule(
                nanosOf(duration),
                () -> over.resolve(null),
                () -> over.reject(new CancellationException(
                        "space " + this + " was closed before the delay of " + duration + " was over")));
        return over;
    }

    /**
     * Tries until a promise is fulfilled. The first try is made at once, on the calling thread, the others on this space's.
     *
     * @param tries how often at the most
     * @param pause between the end of one try and the beginning of the next
     * @return the first value, or the error of the last try
     */
    public <T extends @Nullable Object> Promise<T> retry(
            int tries, Duration pause, Supplier<? extends Promise<? extends T>> attempt) {
        if (tries < 1) {
            throw new IllegalArgumentException("tries is " + tries + ", expected 1 or more");
        }
        Promise<T> first = Promise.done().thenCompose(begin -> attempt.get());
        return tries == 1
                ? first
                : first.exceptionallyCompose(
                        error -> delay(pause).thenCompose(over -> retry(tries - 1, pause, attempt)));
    }

    /** Runs an action on the space's thread as soon as nothing waits there: no entry in any queue, no timer due. */
    public void onIdle(Runnable action) {
        Objects.requireNonNull(action, "action");
        checkOpen("onIdle(..)");
        enqueueMail(new Entry(() -> dispatcher.addIdleAction(action)));
    }

    /**
     * Runs the body while the condition holds, one round a turn, so that others have theirs in between.
     *
     * @return fulfilled when the condition does not hold, rejected when condition or body throw
     */
    public Promise<@Nullable Void> repeatWhile(BooleanSupplier condition, Runnable body) {
        return Repetition.start(this, condition, () -> {
            body.run();
            return null;
        });
    }

    /** Runs the body while the condition holds; a round begins when the promise of the round before is fulfilled. */
    public Promise<@Nullable Void> repeatWhile(BooleanSupplier condition, Supplier<? extends Promise<?>> body) {
        return Repetition.start(this, condition, body);
    }

    /**
     * Serves what waits, and what comes of it, until nothing waits; only for a space that is cranked by hand. The calling thread is the space's meanwhile.
     *
     * @throws IllegalStateException if the space has a thread of its own, or is being cranked already
     */
    public void crank() {
        if (!settings.handCranked()) {
            throw new IllegalStateException("space " + this + " has a thread of its own and cannot be cranked by hand");
        }
        if (ended.getCount() == 0) {
            return; // it is closed, and whoever still calls it is turned away at once
        }
        if (thread != null) {
            throw new IllegalStateException("space " + this + " is being cranked already, by " + thread.getName());
        }
        Home before = enter();
        try {
            boolean working = true;
            while (working && !stopping) {
                working = dispatcher.pass() | settle();
            }
            if (stopping) {
                shut();
            }
        } finally {
            thread = null;
            leaveThread(before);
        }
    }

    boolean isCrankedByHand() {
        return settings.handCranked();
    }

    /** The clock by which this space's timers run. */
    public Clock clock() {
        return settings.clock();
    }

    /** Whether nothing waits here: no entry in any queue, no timer due. Exact between cranks, and between two turns on the space's thread. */
    public boolean isQuiet() {
        return dispatcher.isQuiet();
    }

    /** How much this space has done, and how far it is behind. */
    public SpaceMetrics metrics() {
        return metrics;
    }

    /**
     * Serves what was queued before, stops every actor, turns what is left into dead letters, and ends the thread; waits for that, up to ten seconds, unless
     * it is called on the space's own thread. Later calls to its actors become dead letters and rejections.
     *
     * @throws IllegalStateException if this is the {@link #global()} space
     * @throws ActorException if the thread is busy with something else all the time; it ends when it has done that
     */
    @Override
    public void close() {
        beginClosing();
        if (!isCurrent()) {
            awaitEnd(CLOSING_TIME);
        }
    }

    /**
     * Closes the space as {@link #close()} does, and says what it had not done.
     *
     * @param patience how long to wait for the entry that is being served, and for what was queued before
     * @throws IllegalStateException if this is the {@link #global()} space, or on the space's own thread
     * @throws ActorException if that takes longer; the text says what the thread is doing
     */
    public Leftovers close(Duration patience) {
        if (isCurrent()) {
            throw new IllegalStateException(
                    "close(" + patience + ") would wait for itself on the thread of space " + this + ": call close()");
        }
        beginClosing();
        awaitEnd(patience);
        return Objects.requireNonNull(leftovers);
    }

    private void beginClosing() {
        if (!closeable) {
            throw new IllegalStateException(
                    "the global actor space is everybody's and cannot be closed; use ActorSpace.create(..)");
        }
        if (closing.compareAndSet(false, true)) {
            Runnable stop = () -> {
                stopping = true;
                dispatcher.halt();
            };
            enqueueMail(new Entry(stop, stop));
        }
    }

    @Override
    public String toString() {
        return settings.name();
    }

    // ---- home

    @Override
    protected boolean isCurrent() {
        return Thread.currentThread() == thread;
    }

    @Override
    protected void enqueue(Node node) {
        enqueueCallback(node);
    }

    void enqueueCallback(Node node) {
        if (isCurrent()) {
            callbacks.add(node);
        } else {
            offer(node);
        }
    }

    @Override
    protected void enqueueFromAfar(Node node) {
        offer(node);
    }

    @Override
    protected void enqueueAtHome(Node node) {
        if (Thread.currentThread() instanceof SpaceThread own && own.serves(this)) {
            own.callbacks().add(node);
        } else {
            callbacks.add(node);
        }
    }

    void enqueueMail(Node node) {
        if (isCurrent()) {
            mails.add(node);
        } else {
            offer(node);
        }
    }

    private void offer(Node node) {
        inbox.offer(node);
        if (!lifeline.wake()) {
            refuseLeftovers();
        }
    }

    @Override
    protected Runnable schedule(long delayNanos, Runnable task, Runnable ifClosed) {
        var expiry = new Expiry(task, ifClosed);
        if (isCurrent() && hasEnded()) {
            ifClosed.run(); // nobody looks at the timers any more
            return () -> {};
        }
        if (isCurrent()) {
            Timer timer = dispatcher.timers.set(expiry, delayNanos, 0);
            return () -> onThread(timer::cancel);
        }
        var pending = new Timer[1]; // both touched on the space's thread only
        var withdrawn = new boolean[1];
        long deadline = settings.clock().nanos() + delayNanos;
        enqueueMail(new Entry(
                () -> {
                    if (!withdrawn[0]) {
                        pending[0] = dispatcher.timers.set(
                                expiry, deadline - settings.clock().nanos(), 0);
                    }
                },
                ifClosed));
        return () -> onThread(() -> {
            withdrawn[0] = true;
            if (pending[0] != null) {
                pending[0].cancel();
            }
        });
    }

    @Override
    protected void rejected(Promise<?> promise, Throwable error) {
        if (lifeline.isClosed() && (isMadeOutside(promise) || error instanceof ActorStoppedException)) {
            return; // a late asker has the refusal in its hands, and the others are counted
        }
        if (!isCurrent()) {
            enqueueMail(new Entry(() -> rejected(promise, error), () -> rejected(promise, error)));
        } else if (isMadeOutside(promise)) {
            rejections.hold(promise, error);
            dispatcher.timers.set(() -> rejections.release(promise), GRACE_NANOS, 0);
        } else {
            rejections.add(promise, error);
        }
    }

    @Override
    protected void await(Promise<?> promise) {
        sequences.await(promise);
    }

    // ---- for this room, on the space's thread

    ActorList actors() {
        return actors;
    }

    Reports reports() {
        return reports;
    }

    Sequences sequences() {
        return sequences;
    }

    static void runNode(Node node) throws Throwable {
        run(node);
    }

    /** Lets a node deal with what running it has thrown. */
    void fail(Node node, Throwable thrown) {
        try {
            threw(node, thrown);
        } catch (Throwable again) {
            reports.error("an entry of space " + this, again, null);
        }
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

    void whenPromiseSettled(Promise<?> promise, Runnable action) {
        whenSettled(promise, action);
    }

    void beginTurnOf(Owner owner) {
        begin(owner);
    }

    /** See {@link Home#renewTurn}. */
    void renewOwner() {
        renewTurn();
    }

    Owner currentOwner() {
        return owner();
    }

    /** Runs an action when the entry that is being served has returned, before anything else. */
    void afterTurn(Runnable action) {
        dispatcher.afterTurn(action);
    }

    /** How far a request has come, for a message about it. */
    String progressOf(Request<?> request) {
        if (!isCurrent()) {
            return "";
        }
        int inMailbox = request.receiver().placeInMailbox(request);
        int before = inMailbox >= 0 ? inMailbox : dispatcher.mailsBefore(request);
        return before < 0 ? ", which has begun it" : ", which has not begun it: " + before + " calls come first";
    }

    /** The sequence's thread is this space's until it gives the baton back. */
    void lendThreadTo(Sequence<?> sequence) {
        Thread mine = thread;
        thread = sequence.thread();
        try {
            sequence.go();
        } finally {
            thread = mine;
        }
    }

    /** Runs something on a thread that holds the baton. */
    void runOnLoan(Runnable body) {
        Home before = enterThread();
        try {
            body.run();
        } finally {
            leaveThread(before);
        }
    }

    Timer timer(ActorCell cell, Duration delay, Duration period, Runnable task) {
        Life life = cell.life();
        Timer timer = dispatcher.timers.set(() -> life.run("a timer", task), nanosOf(delay), nanosOf(period));
        life.own(timer);
        return timer;
    }

    /** On the space's own behalf, in the midst of whatever turn it is. */
    void asItself(Runnable action) {
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
    void runGuarded(Runnable task) {
        beginForItself();
        try {
            task.run();
        } catch (Throwable thrown) {
            reports.error("a task of space " + this, thrown, null);
        }
    }

    /** A turn of its own, on behalf of the actor that is running now. */
    void nextTurn(Runnable task, Runnable ifStopped) {
        Life life = owner() instanceof Life mine ? mine : null;
        enqueueMail(new Entry(
                () -> {
                    if (life == null) {
                        runGuarded(task);
                    } else if (!life.run("a repetition", task)) {
                        ifStopped.run();
                    }
                },
                ifStopped));
    }

    boolean isClosing() {
        return closing.get();
    }

    /** Whether it is closed, so that whoever still queues something turns that away himself. */
    boolean hasEnded() {
        return lifeline.isClosed();
    }

    /** Whether it has served what it will ever serve; on its thread. */
    boolean isStopping() {
        return stopping;
    }

    void checkOpen(String call) {
        if (closing.get() && !isCurrent()) {
            throw new ActorStoppedException(call + " came too late: space " + this + " is closed");
        }
    }

    void checkCurrent(String call) {
        if (!isCurrent()) {
            throw new IllegalStateException(call + " belongs on the thread of space " + this + ", and was called on "
                    + Thread.currentThread().getName() + ": call the actor through its proxy");
        }
    }

    // ---- the thread

    /** What the thread does until the space is closed. */
    void live() {
        Home before = enter();
        Watchdog.watch(this, settings, lifeline, dispatcher);
        try {
            while (!stopping) {
                if (!dispatcher.pass() & !settle()) {
                    lifeline.sleep(dispatcher, settings.clock());
                }
            }
        } finally {
            shut();
            leaveThread(before);
        }
    }

    /** Between two passes: lost rejections, then, if all is quiet, those who waited for that. */
    private boolean settle() {
        settleRejections();
        return stopping || !dispatcher.isQuiet() || dispatcher.runIdleActions();
    }

    private @Nullable Home enter() {
        thread = Thread.currentThread();
        beginForItself();
        return enterThread();
    }

    /** The one that holds the baton now; a moment later it may be another. */
    @Nullable
    Thread servingThread() {
        return thread;
    }

    private void shut() {
        stopping = true; // also if an error has ended the thread
        var last = new Closing(this, dispatcher);
        refusing.set(true); // nobody else turns leftovers away before this thread has
        int bodies = sequences.count();
        try {
            actors.all().forEach(ActorCell::stop);
            sequences.cancelAll();
            clockRegistration.run();
            lifeline.close();
            last.dropTimers(dispatcher.timers);
            last.dropIdleActions();
            last.refuseAll();
            closed.resolve(null);
            last.refuseAll(); // what those who watched have queued
            rejections.releaseAll();
            settleRejections();
            last.refuseAll(); // what the error handler has asked of actors
        } finally {
            leftovers = last.leftovers(bodies);
            lifeline.close();
            thread = null;
            refusing.set(false);
            ended.countDown();
        }
        refuseLeftovers();
    }

    private void settleRejections() {
        rejections.report((promise, error) -> reports.error("a promise nobody listens to: " + promise, error, null));
    }

    /** After the end: whoever finds entries in the queues turns them away; one at a time, and meanwhile it acts for the space. */
    private void refuseLeftovers() {
        while (!inbox.isEmpty() && refusing.compareAndSet(false, true)) {
            Home before = enter();
            try {
                new Closing(this, dispatcher).refuseAll();
                settleRejections();
            } finally {
                thread = null;
                leaveThread(before);
                refusing.set(false);
            }
        }
    }

    private void onThread(Runnable task) {
        if (isCurrent()) {
            task.run();
        } else {
            enqueueMail(new Entry(task, () -> {}));
        }
    }

    private void awaitEnd(Duration patience) {
        if (settings.handCranked()) {
            if (ended.getCount() > 0) {
                crank();
            }
            return;
        }
        try {
            if (!ended.await(nanosOf(patience), TimeUnit.NANOSECONDS)) {
                throw new ActorException(
                        "space " + this + " did not end within " + patience + ": its thread is busy" + whatItDoes());
            }
        } catch (InterruptedException interrupted) {
            Thread.currentThread().interrupt();
            if (ended.getCount() > 0) {
                throw new ActorException(
                        "interrupted while waiting for the end of space " + this + ": it ends when its thread is free",
                        interrupted);
            }
        }
    }

    private String whatItDoes() {
        Thread busy = thread;
        StackTraceElement[] stack = busy == null ? new StackTraceElement[0] : busy.getStackTrace();
        return stack.length == 0 ? "" : " at " + stack[0];
    }
}
