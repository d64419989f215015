package io.troupe.actor;

import java.time.Duration;
import java.util.Objects;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * Settings of an actor space.
 *
 * <p>A handler may call actors of the same space. It does not receive what it has caused itself, which might be without
 * end: a dead letter in a turn that began with a call of the dead-letter handler is only counted, an error in one of
 * the error handler is logged, and the calls that an observer sends are not observed.
 *
 * {@snippet :
 * SpaceSettings settings = SpaceSettings.named("shop")
 *         .withOnError(onError)
 *         .withOnDeadLetter(onDeadLetter)
 *         .withOnStall(Duration.ofSeconds(30), onStall);
 * ActorSpace space = ActorSpace.create(settings);
 * }
 */
public final class SpaceSettings extends Settings<SpaceSettings> {
    private String name;
    private Clock clock = Clock.system();
    private ErrorHandler onError = SpaceLog::error;
    private Consumer<DeadLetter> onDeadLetter = SpaceLog::deadLetter;
    private @Nullable Duration stallLimit = Duration.ofSeconds(1);
    private Consumer<Stall> onStall = SpaceLog::stall;
    private int offloadLimit = 256;
    private boolean threadless;
    private @Nullable Integer actorQuota;
    private @Nullable TurnContext<?> context;
    private @Nullable CallObserver callObserver;

    private SpaceSettings(String name) {
        this.name = name;
    }

    /**
     * Default settings: a daemon thread on the machine's clock that logs errors, dead letters, and messages that take
     * longer than a second.
     *
     * @param name of the space and its thread
     */
    public static SpaceSettings named(String name) {
        return new SpaceSettings(Objects.requireNonNull(name, "name"));
    }

    @Override
    protected void check() {
        if (stallLimit != null && (stallLimit.isNegative() || stallLimit.isZero())) {
            throw new IllegalArgumentException(
                    "stallLimit is " + stallLimit + ", expected more than zero, or withoutStallLimit()");
        }
        if (offloadLimit < 1) {
            throw new IllegalArgumentException("offloadLimit is " + offloadLimit + ", expected 1 or more");
        }
        if (actorQuota != null && actorQuota < 1) {
            throw new IllegalArgumentException(
                    "actorQuota is " + actorQuota + ", expected 1 or more, or withoutActorQuota()");
        }
    }

    SpaceSettings withName(String newName) {
        return with(copy -> copy.name = newName);
    }

    /** The clock of its timers; by default the machine's. */
    public SpaceSettings withClock(Clock newClock) {
        Objects.requireNonNull(newClock, "clock");
        return with(copy -> copy.clock = newClock);
    }

    /** Receives errors that have no caller; by default they are logged. */
    public SpaceSettings withOnError(ErrorHandler handler) {
        Objects.requireNonNull(handler, "onError");
        return with(copy -> copy.onError = handler);
    }

    /** Receives messages that were not delivered, on the thread that detected this; by default they are logged. */
    public SpaceSettings withOnDeadLetter(Consumer<DeadLetter> handler) {
        Objects.requireNonNull(handler, "onDeadLetter");
        return with(copy -> copy.onDeadLetter = handler);
    }

    /**
     * Reports a message that takes too long. A space without a thread reports none.
     *
     * @param limit by the machine's clock; by default one second
     * @param handler receives the report, on a helper thread that it may block; by default it is logged
     */
    public SpaceSettings withOnStall(Duration limit, Consumer<Stall> handler) {
        Objects.requireNonNull(limit, "stallLimit");
        Objects.requireNonNull(handler, "onStall");
        return with(copy -> {
            copy.stallLimit = limit;
            copy.onStall = handler;
        });
    }

    /** A message may take any time: no stall is reported. */
    public SpaceSettings withoutStallLimit() {
        return with(copy -> copy.stallLimit = null);
    }

    /** A space without a thread, which runs only in {@link ActorSpace#runQueued}. */
    public SpaceSettings withoutThread() {
        return with(copy -> copy.threadless = true);
    }

    /** The number of concurrent runs of {@link ActorSpace#offload}; by default 256. */
    public SpaceSettings withOffloadLimit(int limit) {
        return with(copy -> copy.offloadLimit = limit);
    }

    /**
     * Handles at most so many calls of an actor before the calls of others that are queued meanwhile. So an actor that
     * gets very many calls does not keep the others waiting. The calls of each actor keep their order. By default there
     * is no quota: all calls are handled in the order of arrival.
     *
     * <p><b>Cost.</b> Some 10 ns for each call in this space; nothing in others.
     */
    public SpaceSettings withActorQuota(int calls) {
        return with(copy -> copy.actorQuota = calls);
    }

    /** All calls are handled in the order of arrival; the default. */
    public SpaceSettings withoutActorQuota() {
        return with(copy -> copy.actorQuota = null);
    }

    /**
     * Carries the context of a caller: captured on the calling thread with each call of an actor of this space, and
     * with each listener that will run in this space, and restored for that turn. Not with timers, tasks, sequential
     * bodies and callbacks. By default there is none.
     *
     * <p><b>Cost.</b> Two objects for each call and listener in this space; nothing in others.
     */
    public SpaceSettings withContext(TurnContext<?> newContext) {
        Objects.requireNonNull(newContext, "newContext");
        return with(copy -> copy.context = newContext);
    }

    /**
     * Observes the calls in this space, and the turns of its actors; by default there is no observer. Several spaces
     * may have the same observer; {@link CallObserver#and} joins two.
     */
    public SpaceSettings withCallObserver(CallObserver observer) {
        Objects.requireNonNull(observer, "observer");
        return with(copy -> copy.callObserver = observer);
    }

    public String name() {
        return name;
    }

    public Clock clock() {
        return clock;
    }

    public ErrorHandler onError() {
        return onError;
    }

    public Consumer<DeadLetter> onDeadLetter() {
        return onDeadLetter;
    }

    /** See {@link #withOnStall}; null = none. */
    public @Nullable Duration stallLimit() {
        return stallLimit;
    }

    public Consumer<Stall> onStall() {
        return onStall;
    }

    public int offloadLimit() {
        return offloadLimit;
    }

    public boolean threadless() {
        return threadless;
    }

    /** See {@link #withActorQuota}; null = none. */
    public @Nullable Integer actorQuota() {
        return actorQuota;
    }

    public @Nullable TurnContext<?> context() {
        return context;
    }

    public @Nullable CallObserver callObserver() {
        return callObserver;
    }
}

/**
 * The default handlers, which write to the log. Methods, not lambdas: a log line gives the name of the method as its
 * source.
 */
final class SpaceLog {
    private static final System.Logger LOG = System.getLogger(ActorSpace.class.getName());

    private SpaceLog() {}

    static void error(String where, Throwable error) {
        LOG.log(System.Logger.Level.ERROR, "in " + where, error);
    }

    static void deadLetter(DeadLetter letter) {
        LOG.log(System.Logger.Level.WARNING, "dead letter: " + letter);
    }

    static void stall(Stall stall) {
        LOG.log(System.Logger.Level.WARNING, stall.toString());
    }
}
