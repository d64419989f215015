package io.troupe.actor;

import io.troupe.actor.internal.ActorProxy;
import io.troupe.actor.internal.loop.Home;
import java.lang.reflect.Method;
import java.time.Duration;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.Callable;
import java.util.concurrent.CancellationException;
import java.util.concurrent.Flow;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.BooleanSupplier;
import java.util.function.Consumer;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * The single thread on which its actors run.
 *
 * <p><b>Role.</b> {@link #global()} is the space of the paper; {@link #create} creates further ones, for tests or one
 * per core. Ends with {@link #close}.
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
 * <p><b>Threads.</b> Every method may be called from any thread, unless documented otherwise. An actor's code runs only
 * on its space's thread, so it needs no locks. The actors share the thread: an interrupt set by one affects the code
 * that runs next, until the space sleeps. (Clearing the flag after each message would cost a fifth of a message.)
 *
 * <p><b>Order.</b> Work arrives in two queues. A <i>message</i> is a call of an actor, one-way or a request. A
 * <i>callback</i> is the call of a promise's listener, or a result for a {@link Callback}. Processing one of them is a
 * <i>turn</i>. Messages from one sender to one actor are handled in the order in which they were sent. Callbacks, from
 * this and from other spaces, are handled before messages, but at most 256 of them in a row. A timer that is due waits
 * for at most 16 messages, and for the callbacks that come before these.
 *
 * <p><b>Errors.</b> See {@link SpaceSettings}: nothing is swallowed. No error ends a space: everything that an actor, a
 * listener or a handler throws is reported, even an {@link OutOfMemoryError} or an {@link InternalError}, and the space
 * goes on. If there is not enough memory for the report, the error is only counted; a promise whose error cannot be
 * made is rejected with the {@link OutOfMemoryError} instead. Texts of errors and dead letters name methods and
 * parameter types, not the values of arguments, which may be secret: those are logged at the level {@code DEBUG} only,
 * by the logger of this class, after the promise has been rejected. If the caller's stack overflows within a call, the
 * caller either gets a {@link StackOverflowError}, or the call is queued and handled within a second.
 *
 * <p><b>Source.</b> Paper, section 1: mailbox and callback queue of each actor in a global actor space of a single
 * thread.
 */
public final class ActorSpace implements AutoCloseable {
    private static final Duration CLOSING_TIME = Duration.ofSeconds(10);

    private static final class Global {
        static final ActorSpace SPACE =
                open(new SpaceHome(SpaceSettings.named("actor-space"), ClassLoader.getSystemClassLoader()), false);
    }

    final SpaceHome home;
    private final boolean closeable;
    private final DelaysAndRetries promises;
    private final AtomicInteger spawned = new AtomicInteger();

    private ActorSpace(SpaceHome home, boolean closeable) {
        this.home = home;
        home.facade = this;
        this.closeable = closeable;
        this.promises = new DelaysAndRetries(home);
    }

    /** The shared space: one daemon thread, started on first use, never closed. */
    public static ActorSpace global() {
        return Global.SPACE;
    }

    /**
     * Creates a space, with a new daemon thread unless it has none. Its threads have the context class loader of the
     * thread that creates it; those of {@link #global} have the system's.
     */
    public static ActorSpace create(SpaceSettings settings) {
        return open(new SpaceHome(settings, Thread.currentThread().getContextClassLoader()), true);
    }

    private static ActorSpace open(SpaceHome home, boolean closeable) {
        var space = new ActorSpace(home, closeable);
        if (!home.isThreadless()) {
            home.startThread();
        }
        return space;
    }

    /** The space whose thread is calling, or null. */
    public static @Nullable ActorSpace current() {
        return Home.current() instanceof SpaceHome here ? here.facade() : null;
    }

    /**
     * The methods of an actor type that are messages: for code that sends its calls elsewhere. Of an interface these
     * are the abstract methods, and the default methods that return {@code void} or a {@link Promise}, or suspend.
     *
     * @throws ActorTypeException if it cannot be an actor type, as by {@link #spawn}
     */
    public static List<Method> messages(Class<?> type) {
        ActorType.of(type);
        return List.copyOf(ActorMethods.of(type).messages());
    }

    /**
     * The space of an actor.
     *
     * {@snippet :
     * ActorSpace.of(greeter).stop(greeter); // whichever of the spaces it is in
     * }
     *
     * @param proxy what {@link #spawn} has returned, or one of {@link ActorPool#actors}
     * @throws IllegalArgumentException for anything else, such as an implementation, or a proxy that chooses among the
     *     actors of a pool
     */
    public static ActorSpace of(Object proxy) {
        ActorCell cell = cellBehind(proxy);
        if (cell == null) {
            throw new IllegalArgumentException(
                    "the value is a " + proxy.getClass().getName() + ", expected the proxy of an actor");
        }
        return cell.space().facade();
    }

    Home home() {
        return home;
    }

    /**
     * Creates a promise of this space that is settled by hand, on whichever thread it is called: listeners that are
     * registered outside every space run here, and a rejection without a listener is reported here. See
     * {@link Deferred} for the other ways to create one.
     */
    public <T extends @Nullable Object> Deferred<T> deferred() {
        return new Deferred<>(home, null);
    }

    /**
     * Creates an actor.
     *
     * @param type an interface, or a class that extends {@link Actor} and whose fields are private; its public methods
     *     return {@code void} or {@link Promise}
     * @param factory creates the implementation, on the space's thread, before the first message
     * @return a proxy for any thread: calling it sends a message and returns immediately
     * @throws ActorTypeException if the type has a method that cannot be a message, or cannot be accessed
     * @throws ActorStoppedException if this space is closed
     */
    public <A> A spawn(Class<A> type, Supplier<? extends A> factory) {
        return spawn(type, factory, ActorSettings.defaults());
    }

    /** Creates an actor with settings; see {@link #spawn(Class, Supplier)}. */
    public <A> A spawn(Class<A> type, Supplier<? extends A> factory, ActorSettings actorSettings) {
        Objects.requireNonNull(type, "type");
        Objects.requireNonNull(factory, "factory");
        Objects.requireNonNull(actorSettings, "actorSettings");
        checkOpen("spawn", type.getName());
        var proxies = ActorType.of(type);
        var cell = new ActorCell(home, type, spawned.incrementAndGet(), proxies.checked(type, factory), actorSettings);
        A proxy = proxies.newProxy(cell);
        cell.bind(proxy);
        home.enqueueMessage(new Entry(cell::start, cell::stop));
        return proxy;
    }

    /**
     * Stops the actor behind a proxy of this space after the messages already in its mailbox. An actor that is waiting
     * for its restart, or that holds its calls back, is stopped immediately in its turn, and those messages are
     * rejected, as whenever an actor stops: one-way messages become dead letters, requests are rejected.
     */
    public void stop(Object proxy) {
        ActorCell cell = cellOf(proxy);
        home.enqueueMessage(new Entry(cell::stopBehindCalls, cell::stop));
    }

    /**
     * Watches an actor of this space.
     *
     * @return fulfilled with the reason when the actor has stopped; immediately if it has stopped already
     */
    public Promise<ActorEnd> whenStopped(Object proxy) {
        Deferred<ActorEnd> own = this.deferred(); // a separate promise, so that each watcher may cancel its own
        own.resolveFrom(cellOf(proxy).ended());
        return own;
    }

    /**
     * Watches this space.
     *
     * @return fulfilled on this space's thread when it is closed, after its actors have stopped; immediately if it is
     *     closed already. Each call returns a separate promise, which may be cancelled
     */
    public Promise<@Nullable Void> whenClosed() {
        Deferred<@Nullable Void> own = Deferred.unbound();
        own.resolveFrom(home.closing.closed());
        return own;
    }

    private ActorCell cellOf(Object proxy) {
        ActorCell cell = cellBehind(proxy);
        if (cell == null || cell.space() != home) {
            throw new IllegalArgumentException("not a proxy of an actor in space " + this + ": "
                    + proxy.getClass().getName());
        }
        return cell;
    }

    private static @Nullable ActorCell cellBehind(Object proxy) {
        Objects.requireNonNull(proxy, "proxy");
        return proxy instanceof ActorProxy actor && actor.troupe$cell() instanceof ActorCell cell ? cell : null;
    }

    private void checkOpen(String method, String argument) {
        if (home.isClosing() && !home.isCurrent()) {
            String call = method + "(" + argument + ")";
            throw new ActorStoppedException(call + " came too late: space " + this + " is closed");
        }
    }

    /** Runs a task on the space's thread, queued like a message. */
    public void execute(Runnable task) {
        Objects.requireNonNull(task, "task");
        checkOpen("execute", "..");
        int handlers = HandlerTurn.ofSender(home);
        home.enqueueMessage(
                handlers == 0
                        ? new Entry(() -> home.runGuarded(task))
                        : new Entry(
                                () -> HandlerTurn.run(handlers, () -> home.runGuarded(task)),
                                () -> HandlerTurn.run(handlers, home.closing::rejectTask)));
    }

    /**
     * Runs blocking work on a virtual thread; {@link SpaceSettings#offloadLimit} bounds the number of concurrent runs.
     *
     * <p>For work that waits for a file, a socket or a lock, not for computation. All virtual threads share a few
     * carrier threads, one per processor. One that computes occupies its carrier until it is done, which delays the
     * blocking work of every space. Run computations on a pool of platform threads:
     * {@code Promise.from(CompletableFuture.supplyAsync(work, pool))}; listeners still run on this space.
     *
     * @return settled with what the work returns or throws; cancelling it interrupts the work
     */
    public <T extends @Nullable Object> Promise<T> offload(Callable<? extends T> work) {
        return promises.offload(Objects.requireNonNull(work, "work"));
    }

    /**
     * Runs a body that may wait with {@link Promise#await()}. It runs on a platform thread that counts as this space's
     * thread meanwhile: it may read and change the state of the actor. While it waits, the space runs other work,
     * including messages of the same actor, so state that was read before may have changed afterwards.
     *
     * <p>A body occupies its thread, with the memory of its stack, until it ends: thousands may wait at a time, but not
     * millions. The threads are daemons and are reused by later bodies, also of other spaces. So a body must not rely
     * on thread-locals, and must remove those it sets.
     *
     * <p><b>Order.</b> The start of the body is queued like a message, on behalf of the calling actor; what it waits
     * for arrives as a callback. <b>Cost.</b> Two thread switches for the start, and for each {@code await()} that
     * really waits. <b>Errors.</b> If no further thread can be created, the promise is rejected with the
     * {@link OutOfMemoryError}.
     *
     * @return settled with what the body returns or throws
     */
    public <T extends @Nullable Object> Promise<T> sequential(Callable<? extends T> body) {
        Objects.requireNonNull(body, "body");
        checkOpen("sequential", "..");
        return home.sequences().start(body, home.isCurrent() ? home.owner() : home.itself());
    }

    /**
     * Returns a promise that is fulfilled after a delay, by this space's clock. It is rejected with
     * {@link CancellationException} if the space is closed first.
     */
    public Promise<@Nullable Void> delay(Duration duration) {
        return promises.delay(Objects.requireNonNull(duration, "duration"));
    }

    /**
     * Repeats an attempt until its promise is fulfilled, or until the returned promise is cancelled. The first attempt
     * is made immediately on the calling thread, the others on this space's thread.
     *
     * <p><b>Cost.</b> Retains nothing of failed attempts, so it may go on indefinitely.
     *
     * @param tries the maximum number of attempts
     * @param pause the time between the end of one attempt and the start of the next
     * @return the first value, or the error of the last attempt
     */
    public <T extends @Nullable Object> Promise<T> retry(
            int tries, Duration pause, Supplier<? extends Promise<? extends T>> attempt) {
        if (tries < 1) {
            throw new IllegalArgumentException("tries is " + tries + ", expected 1 or more");
        }
        return promises.retry(tries, pause, attempt);
    }

    /**
     * Sends requests with a time limit that is inherited by the requests sent to answer them.
     *
     * {@snippet :
     * Promise<String> receipt = space.within(Duration.ofSeconds(2), () -> shop.buy("lamp", 20));
     * }
     *
     * <p>The function, the turns of the requests that it sends, and the listeners registered meanwhile share the limit,
     * and pass it on to the requests that they send in turn; also to other spaces, and to other hosts by a bus. When
     * the limit is over, those requests that are not answered are rejected with a
     * {@link java.util.concurrent.TimeoutException}, and those that still wait in a mailbox are not begun. Sequential
     * bodies and coroutines share it, too; one-way messages, timers, tasks and callbacks do not. A limit within a
     * longer one ends first; one within a shorter one ends with that.
     *
     * <p><b>Threads.</b> Any thread. On this space's thread the function runs immediately; otherwise it is queued like
     * a message.
     *
     * <p><b>Cost.</b> One timer for all, and two small objects for each request and listener that has a limit; nothing
     * for other requests of this space.
     *
     * @return as the promise of the function, if that is settled in time; rejected with what the function throws
     */
    public <T extends @Nullable Object> Promise<T> within(
            Duration limit, Supplier<? extends Promise<? extends T>> question) {
        Objects.requireNonNull(limit, "limit");
        return promises.within(limit, Objects.requireNonNull(question, "question"));
    }

    /**
     * The time that is left for the current turn, by the shortest limit of {@link #within} that it has inherited; zero
     * if that is over, null if there is none. For requests to others than actors.
     */
    public static @Nullable Duration timeLeft() {
        TimeLimit limit = TimeLimit.current();
        return limit == null ? null : limit.left();
    }

    /**
     * A publisher of Java's reactive streams, for libraries that have these: each subscriber calls the source once,
     * with a new callback, and receives its results.
     *
     * {@snippet :
     * Flow.Publisher<Integer> publisher = space.publisher(16, colours::subscribe); // of a topic
     * Flow.Publisher<Integer> watched = space.publisher(camera::watch); // of an actor
     * }
     *
     * <p><b>Threads.</b> Any thread may subscribe, request and cancel. The subscriber runs on this space, as entries of
     * its callback queue; if it subscribed in an actor of this space, on behalf of that actor, until that stops.
     *
     * <p><b>Order.</b> Senders do not wait for requests. The results that come before they are requested are queued;
     * the capacity limits them, in the callback queue and again in the queue of the subscription; one more result drops
     * the oldest. The end follows the results that were kept.
     *
     * <p><b>Errors.</b> A source that throws, or a null result, is the failure of the stream. If the space is closed
     * before the end, no further signal arrives.
     */
    public <T> Flow.Publisher<T> publisher(int capacity, Consumer<? super Callback<T>> source) {
        if (capacity < 1) {
            throw new IllegalArgumentException("capacity is " + capacity + ", expected 1 or more");
        }
        Objects.requireNonNull(source, "source");
        return new CallbackPublisher<>(home, capacity, source);
    }

    /** Like {@link #publisher(int, Consumer)} without a limit: every result is kept until it is requested. */
    public <T> Flow.Publisher<T> publisher(Consumer<? super Callback<T>> source) {
        return publisher(Integer.MAX_VALUE, source);
    }

    /** Runs an action on the space's thread as soon as it is idle: no entry in any queue, no timer due. */
    public void onIdle(Runnable action) {
        Objects.requireNonNull(action, "action");
        checkOpen("onIdle", "..");
        home.enqueueMessage(new Entry(() -> home.dispatcher.addIdleAction(action)));
    }

    /**
     * Runs the body while the condition holds, one round per turn, so that other work runs in between. The first round
     * is run at once.
     *
     * <p><b>Threads.</b> Only that of the space: call it from an actor, or in a task for {@link #execute}.
     *
     * @return fulfilled when the condition no longer holds, rejected when the condition or the body throws
     * @throws IllegalStateException on another thread
     */
    public Promise<@Nullable Void> repeatWhile(BooleanSupplier condition, Runnable body) {
        Objects.requireNonNull(body, "body");
        return promises.repeatWhile(condition, () -> {
            body.run();
            return null;
        });
    }

    /**
     * Runs the body while the condition holds; a round begins when the promise of the previous round is fulfilled.
     *
     * <p><b>Threads.</b> Only that of the space, as for {@link #repeatWhile(BooleanSupplier, Runnable)}.
     *
     * @return fulfilled when the condition no longer holds; rejected when the condition or the body throws, when a
     *     promise is rejected, or when the body returns null
     * @throws IllegalStateException on another thread
     */
    public Promise<@Nullable Void> repeatWhile(BooleanSupplier condition, Supplier<? extends Promise<?>> body) {
        Objects.requireNonNull(body, "body");
        return promises.repeatWhile(
                condition, () -> Objects.requireNonNull(body.get(), "the function returned null, not a promise"));
    }

    /**
     * Runs everything that is queued, and what follows from it, until nothing is queued; only for a space that is
     * without a thread. The calling thread is the space's thread meanwhile.
     *
     * @throws IllegalStateException if the space has its own thread, or is being run already
     */
    public void runQueued() {
        home.loop.runQueued();
    }

    /** The clock of this space's timers. */
    public Clock clock() {
        return home.settings.clock();
    }

    /**
     * True if the space is idle: no entry in any queue, no timer due. Exact between two runs, and between two turns on
     * the space's thread.
     */
    public boolean isQuiet() {
        return home.dispatcher.isQuiet();
    }

    /**
     * A moment of this space's clock before which no timer is due; {@link Long#MAX_VALUE} if there is none. For code
     * that moves the clock of a space without a thread; exact under the same conditions as {@link #isQuiet}.
     */
    public long nextTimerNanos() {
        return home.dispatcher.timers.nextDeadline();
    }

    /** Counters of the work done, and of the backlog. */
    public SpaceMetrics metrics() {
        return home.figures();
    }

    /**
     * Registers the figures of {@link #metrics} as a bean of JMX, {@code io.troupe:type=ActorSpace,name="hello"}, for
     * tools such as JConsole. The bean is removed when this space is closed.
     *
     * <p><b>Cost.</b> None while no attribute is read.
     *
     * @throws ActorException if there is a bean of that name, of another space
     */
    public void registerBean() {
        Runnable remove = SpaceBean.register(toString(), metrics());
        whenClosed().toCompletableFuture().thenRun(remove);
    }

    /**
     * Processes what was queued before, stops every actor, turns the remaining messages into dead letters, and ends the
     * thread. Waits for that, up to ten seconds. On the thread of a space, this one or another, it does not wait, since
     * two spaces that close each other would deadlock; use {@link #whenClosed()} there. Later calls of its actors
     * become dead letters or are rejected. In a shutdown hook, it does not wait for an actor of this space that has
     * called {@link System#exit}: that waits for the hook.
     *
     * @throws IllegalStateException if this is the {@link #global()} space
     * @throws ActorException if the thread is busy for all that time; it ends when it has finished that work
     */
    @Override
    public void close() {
        beginClosing();
        if (home.isThreadless() ? !home.isCurrent() : Home.current() == null) {
            awaitEnd(CLOSING_TIME);
        }
    }

    /**
     * Closes the space like {@link #close()}, and returns what was not done.
     *
     * @param patience the time limit for the entry that is being processed, and for what was queued before
     * @throws IllegalStateException if this is the {@link #global()} space, or if called on the thread of a space, this
     *     one or another
     * @throws ActorException if that takes longer; the message includes what the thread is doing
     */
    public Leftovers close(Duration patience) {
        Objects.requireNonNull(patience, "patience");
        if (home.isCurrent()) {
            throw new IllegalStateException(
                    "close(" + patience + ") would wait for itself on the thread of space " + this + ": call close()");
        }
        Home here = Home.current();
        if (here != null && !home.isThreadless()) {
            throw new IllegalStateException("close(" + patience + ") of space " + this + " would stop space " + here
                    + " while it waits: call close(), and whenClosed() to learn of the end");
        }
        beginClosing();
        if (!awaitEnd(patience)) {
            throw new ActorException("space " + this + " does not end: an actor of it has called System.exit");
        }
        return home.closing.leftovers();
    }

    private void beginClosing() {
        if (!closeable) {
            throw new IllegalStateException(
                    "the global actor space is shared by the whole JVM and cannot be closed; use ActorSpace.create(..)");
        }
        home.closing.begin(home.loop::stop);
    }

    private boolean awaitEnd(Duration patience) {
        if (home.isThreadless()) {
            runQueued();
            return true;
        }
        return home.closing.await(patience);
    }

    @Override
    public String toString() {
        return home.toString();
    }
}
