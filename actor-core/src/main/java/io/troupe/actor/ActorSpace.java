package io.troupe.actor;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Home;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.Clock;
import java.time.Duration;
import java.util.Objects;
import java.util.concurrent.Callable;
import java.util.concurrent.CancellationException;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.BooleanSupplier;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * The one thread on which its actors live.
 *
 * <p><b>Role.</b> {@link #global()} is the space of the paper; {@link #create} makes further ones, for tests or one per
 * core. Ends with {@link #close}.
 *
 * {@snippet :
 * interface Greeter {
 *     Promise<String> greet(String name);
 * }
 *
 * try (ActorSpace space = ActorSpace.create(SpaceSettings.named("hello"))) {
 *     Greeter greeter = space.spawn(Greeter.class, () -> name -> Promise.of("Hello, " + name));
 *     greeter.greet("Ada").then(text -> log.add(text)); // on the thread of the space
 * } // close() serves what was queued
 * }
 *
 * <p><b>Threads.</b> Every method from any thread unless it says otherwise. An actor's code only ever runs on its
 * space's thread, so it needs no locks. Actors share the thread: one that interrupts it interrupts whatever comes next
 * there, until the space sleeps (clearing the flag at each message would cost as much as a fifth of a message).
 *
 * <p><b>Order.</b> Calls from one sender to one actor are handled in the order in which they were made. Answers and
 * other callbacks, from this and from other spaces, are handled before messages, but never more than 256 of them in a
 * row. A timer that is due waits for 16 messages at most, and for the answers that come before these.
 *
 * <p><b>Errors.</b> See {@link SpaceSettings}: nothing is swallowed. No error is fatal to a space: whatever an actor, a
 * listener or a handler throws, an {@link OutOfMemoryError} and an {@link InternalError} too, is reported, and the
 * others are served. If memory is too short even for the report, the error is counted. A caller whose stack ends within
 * a call gets its {@link StackOverflowError} or has its call queued, which is then served within a second.
 *
 * <p><b>Source.</b> Paper, section 1: mailbox and callback queue of each actor in a global actor space of a single
 * thread.
 */
public final class ActorSpace extends SpaceHome implements AutoCloseable {
    private static final Duration CLOSING_TIME = Duration.ofSeconds(10);

    private static final class Global {
        static final ActorSpace SPACE = open(new ActorSpace(SpaceSettings.named("actor-space"), false));
    }

    private final boolean closeable;
    private final Offload offload;
    private final AtomicInteger spawned = new AtomicInteger();

    private ActorSpace(SpaceSettings settings, boolean closeable) {
        super(settings);
        this.closeable = closeable;
        this.offload = new Offload(settings.offloadLimit());
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
        if (!space.isCrankedByHand()) {
            space.startThread();
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
     * @param type an interface, or a class that extends {@link Actor} and whose fields are private; its public methods
     *     return {@code void} or {@link Promise}
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
        Objects.requireNonNull(type, "type");
        Objects.requireNonNull(factory, "factory");
        Objects.requireNonNull(actorSettings, "actorSettings");
        checkOpen("spawn(" + type.getName() + ")");
        var proxies = ActorType.of(type);
        var cell = new ActorCell(this, type, spawned.incrementAndGet(), factory, actorSettings);
        A proxy = proxies.newProxy(cell);
        cell.bind(proxy);
        enqueueMail(new Entry(cell::start, cell::stop));
        return proxy;
    }

    /**
     * Stops the actor behind a proxy of this space after the messages already in its mailbox. One that waits for its
     * restart is stopped without another start, and those messages are turned away, as at each end of an actor:
     * messages become dead letters, requests are rejected.
     */
    public void stop(Object proxy) {
        ActorCell cell = cellOf(proxy);
        enqueueMail(new Entry(cell::stopBehindCalls, cell::stop));
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
     * @return fulfilled when it is closed, on its thread, after its actors have stopped; at once if it is closed. Each
     *     watcher may cancel its own
     */
    public Promise<@Nullable Void> whenClosed() {
        var own = new Deferred<@Nullable Void>((Home) null);
        own.resolveFrom(closing.closed());
        return own;
    }

    private ActorCell cellOf(Object proxy) {
        Objects.requireNonNull(proxy, "proxy");
        if (!(proxy instanceof ActorProxy actor) || actor.troupe$cell().space() != this) {
            throw new IllegalArgumentException("not a proxy of an actor in space " + this + ": "
                    + proxy.getClass().getName());
        }
        return actor.troupe$cell();
    }

    private void checkOpen(String call) {
        if (isClosing() && !isCurrent()) {
            throw new ActorStoppedException(call + " came too late: space " + this + " is closed");
        }
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
     * <p>For work that waits, for a file, a socket or a lock; not for computing. All virtual threads share a few
     * carriers, one for each processor, and one that computes keeps its carrier until it is done, so that the blocking
     * work of every space waits. Give computing to a pool of platform threads of your own:
     * {@code Promise.from(CompletableFuture.supplyAsync(work, pool))}; its listeners run on this space all the same.
     *
     * @return settled with what the work answers or throws
     */
    public <T extends @Nullable Object> Promise<T> offload(Callable<? extends T> work) {
        return offload.run(this, Objects.requireNonNull(work, "work"));
    }

    /**
     * Runs a body that may wait with {@link Promise#await()}, on a platform thread that counts as this space's while
     * the body runs: it sees and changes what an actor's code may. While it waits the space serves others, the same
     * actor included, so what it has read before may have changed after.
     *
     * <p>A body has its thread, with the memory of its stack, until it ends: thousands may wait at a time, but not
     * millions. The threads are daemons that later bodies use again, of other spaces too; so a body must not rely on
     * thread-locals, and removes those it has set.
     *
     * <p><b>Order.</b> The body begins in its turn among the messages, on behalf of the calling actor; what it waited
     * for is a callback. <b>Cost.</b> Two switches between threads for the beginning and for each {@code await()} that
     * really waits. <b>Errors.</b> If the machine has no further thread, the promise is rejected with the
     * {@link OutOfMemoryError} that says so.
     *
     * @return settled with what the body answers or throws
     */
    public <T extends @Nullable Object> Promise<T> sequential(Callable<? extends T> body) {
        Objects.requireNonNull(body, "body");
        checkOpen("sequential(..)");
        return sequences().start(body, isCurrent() ? owner() : itself());
    }

    /**
     * Fulfilled after a while, by this space's clock; rejected with {@link CancellationException} if the space is
     * closed before.
     */
    public Promise<@Nullable Void> delay(Duration duration) {
        return Delay.start(this, Objects.requireNonNull(duration, "duration"));
    }

    /**
     * Tries until a promise is fulfilled, or the promise that this answers is cancelled. The first try is made at once,
     * on the calling thread, the others on this space's.
     *
     * <p><b>Cost.</b> Keeps nothing of the tries that have failed, so it may go on for ever.
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
        return Retrial.start(this, tries, pause, attempt);
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
        Objects.requireNonNull(body, "body");
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
     * Serves what waits, and what comes of it, until nothing waits; only for a space that is cranked by hand. The
     * calling thread is the space's meanwhile.
     *
     * @throws IllegalStateException if the space has a thread of its own, or is being cranked already
     */
    public void crank() {
        loop.crank();
    }

    /** The clock by which this space's timers run. */
    public Clock clock() {
        return settings.clock();
    }

    /**
     * Whether nothing waits here: no entry in any queue, no timer due. Exact between cranks, and between two turns on
     * the space's thread.
     */
    public boolean isQuiet() {
        return dispatcher.isQuiet();
    }

    /**
     * A moment of this space's clock until which no timer is due; {@link Long#MAX_VALUE} if there is none. For whoever
     * moves the clock of a space that is cranked by hand; exact as {@link #isQuiet} is.
     */
    public long nextTimerNanos() {
        return dispatcher.timers.nextDeadline();
    }

    /** How much this space has done, and how far it is behind. */
    public SpaceMetrics metrics() {
        return figures();
    }

    /**
     * Serves what was queued before, stops every actor, turns what is left into dead letters, and ends the thread;
     * waits for that, up to ten seconds, unless it is called on the thread of a space, this one or another: such a
     * thread never waits, since two spaces that close each other would wait for ever; {@link #whenClosed()} tells it of
     * the end. Later calls to its actors become dead letters and rejections.
     *
     * @throws IllegalStateException if this is the {@link #global()} space
     * @throws ActorException if the thread is busy with something else all the time; it ends when it has done that
     */
    @Override
    public void close() {
        beginClosing();
        if (isCrankedByHand() ? !isCurrent() : Home.current() == null) {
            awaitEnd(CLOSING_TIME);
        }
    }

    /**
     * Closes the space as {@link #close()} does, and says what it had not done.
     *
     * @param patience how long to wait for the entry that is being served, and for what was queued before
     * @throws IllegalStateException if this is the {@link #global()} space, or on the thread of a space, this one or
     *     another
     * @throws ActorException if that takes longer; the text says what the thread is doing
     */
    public Leftovers close(Duration patience) {
        Objects.requireNonNull(patience, "patience");
        if (isCurrent()) {
            throw new IllegalStateException(
                    "close(" + patience + ") would wait for itself on the thread of space " + this + ": call close()");
        }
        Home here = Home.current();
        if (here != null && !isCrankedByHand()) {
            throw new IllegalStateException("close(" + patience + ") of space " + this + " would stop space " + here
                    + " while it waits: call close(), and whenClosed() to learn of the end");
        }
        beginClosing();
        awaitEnd(patience);
        return closing.leftovers();
    }

    private void beginClosing() {
        if (!closeable) {
            throw new IllegalStateException(
                    "the global actor space is everybody's and cannot be closed; use ActorSpace.create(..)");
        }
        closing.begin(loop::stop);
    }

    private void awaitEnd(Duration patience) {
        if (isCrankedByHand()) {
            crank();
        } else {
            closing.await(patience);
        }
    }

    @Override
    public String toString() {
        return settings.name();
    }
}
