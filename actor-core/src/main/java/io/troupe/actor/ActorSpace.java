package io.troupe.actor;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Home;
import io.troupe.actor.promise.Node;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.Clock;
import io.troupe.actor.time.Timer;
import io.troupe.actor.time.TimerWheel;
import java.time.Duration;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Objects;
import java.util.Set;
import java.util.concurrent.Callable;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicLong;
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
    private static final int OFFLOAD_LIMIT = 256;
    private static final long GRACE_NANOS = 1_000_000_000;
    private static final Duration CLOSING_TIME = Duration.ofSeconds(10);

    private static final class Global {
        static final ActorSpace SPACE = open(new ActorSpace(SpaceSettings.named("actor-space"), false));
    }

    private final SpaceSettings settings;
    private final Dispatcher dispatcher;
    private final Lifeline lifeline = new Lifeline();
    private final Rejections rejections = new Rejections();
    private final Set<ActorCell> actors = new LinkedHashSet<>();
    private final AtomicLong spawned = new AtomicLong();
    private final AtomicBoolean closing = new AtomicBoolean();
    private final boolean closeable;
    private final Offload offload = new Offload(OFFLOAD_LIMIT);
    private final CountDownLatch ended = new CountDownLatch(1);
    private final Runnable clockRegistration;
    private @Nullable Thread thread; // the one that serves now; only ever equal to a reader that set it itself
    private @Nullable ActorCell current;
    private boolean stopping;

    private ActorSpace(SpaceSettings settings, boolean closeable) {
        this.settings = settings;
        this.closeable = closeable;
        this.dispatcher = new Dispatcher(this, new TimerWheel(settings.clock()));
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
            Thread.ofPlatform().name(space.settings.name()).daemon().start(space::live);
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
        String given = actorSettings.name();
        String name = given != null ? given : type.getSimpleName() + "#" + spawned.incrementAndGet();
        var cell = new ActorCell(this, name, factory, actorSettings);
        A proxy = proxies.newProxy(cell);
        cell.bind(proxy);
        enqueue(new Entry(cell::start));
        return proxy;
    }

    /** Stops the actor behind a proxy of this space after the messages already in its mailbox. */
    public void stop(Object proxy) {
        enqueue(new Entry(cellOf(proxy)::stop));
    }

    /**
     * Watches an actor of this space.
     *
     * @return fulfilled when the actor has stopped, for whatever reason; at once if it has
     */
    public Promise<@Nullable Void> whenStopped(Object proxy) {
        return cellOf(proxy).ended();
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
        enqueue(new Entry(() -> runGuarded(task)));
    }

    /**
     * Runs blocking work on a virtual thread, {@value #OFFLOAD_LIMIT} at a time in one space.
     *
     * @return settled with what the work answers or throws
     */
    public <T extends @Nullable Object> Promise<T> offload(Callable<? extends T> work) {
        return offload.run(this, Objects.requireNonNull(work, "work"));
    }

    /** Fulfilled after a while, by this space's clock. */
    public Promise<@Nullable Void> delay(Duration duration) {
        var over = new Deferred<@Nullable Void>(this);
        schedule(duration.toNanos(), () -> over.resolve(null));
        return over;
    }

    /**
     * Tries until a promise is fulfilled.
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
        enqueue(new Entry(() -> dispatcher.addIdleAction(action)));
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

    /** Whether nothing waits here: no entry in any queue, no timer due. Exact only on the space's thread, or between cranks. */
    public boolean isQuiet() {
        return dispatcher.isQuiet();
    }

    /**
     * Serves what was queued before, stops every actor, turns what is left into dead letters, and ends the thread; waits for that, unless it
     * is called on the space's own thread. Later calls to its actors become dead letters and rejections.
     *
     * @throws IllegalStateException if this is the {@link #global()} space
     */
    @Override
    public void close() {
        if (!closeable) {
            throw new IllegalStateException(
                    "the global actor space is everybody's and cannot be closed; use ActorSpace.create(..)");
        }
        if (closing.compareAndSet(false, true)) {
            enqueue(new Entry(() -> stopping = true));
        }
        if (settings.handCranked()) {
            if (!isCurrent() && ended.getCount() > 0) {
                crank();
            }
        } else if (!isCurrent()) {
            awaitEnd();
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
        if (isCurrent()) {
            if (isMail(node)) {
                dispatcher.addMail(node);
            } else {
                dispatcher.addCallback(node);
            }
            return;
        }
        dispatcher.inbox.offer(node);
        if (!lifeline.wake()) {
            refuseLeftovers();
        }
    }

    @Override
    protected Runnable schedule(long delayNanos, Runnable task) {
        if (isCurrent()) {
            Timer timer = dispatcher.timers.set(task, delayNanos, 0);
            return () -> onThread(timer::cancel);
        }
        var pending = new Timer[1]; // both touched on the space's thread only
        var withdrawn = new boolean[1];
        long deadline = settings.clock().nanos() + delayNanos;
        enqueue(new Entry(() -> {
            if (!withdrawn[0]) {
                pending[0] =
                        dispatcher.timers.set(task, deadline - settings.clock().nanos(), 0);
            }
        }));
        return () -> onThread(() -> {
            withdrawn[0] = true;
            if (pending[0] != null) {
                pending[0].cancel();
            }
        });
    }

    @Override
    protected @Nullable Object owner() {
        return current == null ? null : current.life();
    }

    @Override
    protected boolean runFor(Object owner, Runnable listener) {
        return ((Life) owner).run("a listener", listener);
    }

    @Override
    protected void rejected(Promise<?> promise, Throwable error) {
        if (lifeline.isClosed()) {
            return; // a late asker has the refusal in its hands
        }
        if (!isCurrent()) {
            enqueue(new Entry(() -> rejected(promise, error)));
        } else if (isMadeOutside(promise)) {
            rejections.hold(promise, error);
            dispatcher.timers.set(() -> rejections.release(promise), GRACE_NANOS, 0);
        } else {
            rejections.add(promise, error);
        }
    }

    // ---- for this room, on the space's thread

    Set<ActorCell> actors() {
        return actors;
    }

    /** The one place where anything that is thrown ends: whatever an entry does, the thread goes on. */
    void serve(Node node) {
        try {
            run(node);
        } catch (Throwable thrown) {
            report("an entry of space " + this, thrown, null);
        }
    }

    static boolean goesToMailbox(Node node) {
        return isMail(node);
    }

    @Nullable
    ActorCell enter(ActorCell cell) {
        ActorCell before = current;
        current = cell;
        return before;
    }

    void leave(@Nullable ActorCell before) {
        current = before;
    }

    Timer timer(ActorCell cell, Duration delay, Duration period, Runnable task) {
        var self = new Timer[1];
        Life life = cell.life();
        self[0] = dispatcher.timers.set(
                () -> {
                    if (!life.run("a timer", task)) {
                        self[0].cancel();
                    }
                },
                delay.toNanos(),
                period.toNanos());
        return self[0];
    }

    /** Before whatever waits in the mailboxes. */
    void runNext(Runnable task) {
        enqueue(Entry.urgent(task));
    }

    void runTimer(Runnable task) {
        runGuarded(task);
    }

    void runGuarded(Runnable task) {
        try {
            task.run();
        } catch (Throwable thrown) {
            report("a task of space " + this, thrown, null);
        }
    }

    /** A turn of its own, on behalf of the actor that is running now. */
    void nextTurn(Runnable task, Runnable ifStopped) {
        Life life = current == null ? null : current.life();
        enqueue(new Entry(() -> {
            if (life == null) {
                runGuarded(task);
            } else if (!life.run("a repetition", task)) {
                ifStopped.run();
            }
        }));
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

    String whyStopped(ActorCell cell) {
        return closing.get() ? "space " + this + " is closed" : "the actor " + cell + " has stopped";
    }

    void deadLetter(ActorCell cell, String message, String reason) {
        tellOfDeadLetter(new DeadLetter(cell.toString(), message, reason));
    }

    private void tellOfDeadLetter(DeadLetter letter) {
        try {
            settings.onDeadLetter().accept(letter);
        } catch (RuntimeException broken) {
            report("the dead-letter handler of space " + this + ", about " + letter, broken, null);
        }
    }

    void report(String where, Throwable error, @Nullable ErrorHandler first) {
        try {
            (first != null ? first : settings.onError()).handle(where, error);
        } catch (Throwable broken) {
            broken.addSuppressed(error);
            System.getLogger(ActorSpace.class.getName())
                    .log(
                            System.Logger.Level.ERROR,
                            "the error handler of space " + this + " threw about " + where,
                            broken);
        }
        if (error instanceof VirtualMachineError fatal && !(error instanceof StackOverflowError)) {
            throw fatal;
        }
    }

    // ---- the thread

    private void live() {
        Home before = enter();
        Watchdog.watch(settings, Thread.currentThread(), lifeline, dispatcher);
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
        rejections.report((promise, error) -> report("a promise nobody listens to: " + promise, error, null));
        return dispatcher.isQuiet() ? dispatcher.runIdleActions() : true;
    }

    private @Nullable Home enter() {
        thread = Thread.currentThread();
        return enterThread();
    }

    private void shut() {
        try {
            List.copyOf(actors).forEach(ActorCell::stop);
            clockRegistration.run();
            lifeline.close();
            refuseLeftovers();
            rejections.releaseAll();
            rejections.report((promise, error) -> report("a promise nobody listens to: " + promise, error, null));
        } finally {
            lifeline.close();
            ended.countDown();
        }
    }

    /** After the end: whoever finds entries in the queues turns them away, on its own thread. */
    private void refuseLeftovers() {
        for (Node node = takeLeftover(); node != null; node = takeLeftover()) {
            if (node instanceof Entry) {
                tellOfDeadLetter(new DeadLetter(settings.name(), "a task", "space " + this + " is closed"));
            } else {
                serve(node);
            }
        }
    }

    private @Nullable Node takeLeftover() {
        synchronized (ended) {
            return dispatcher.pollLeftover();
        }
    }

    private void onThread(Runnable task) {
        if (isCurrent()) {
            task.run();
        } else {
            enqueue(new Entry(task));
        }
    }

    private void awaitEnd() {
        try {
            if (!ended.await(CLOSING_TIME.toSeconds(), TimeUnit.SECONDS)) {
                throw new ActorException(
                        "space " + this + " did not end within " + CLOSING_TIME + ": its thread is busy");
            }
        } catch (InterruptedException interrupted) {
            Thread.currentThread().interrupt();
        }
    }
}
