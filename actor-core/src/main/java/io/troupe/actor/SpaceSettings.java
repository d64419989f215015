package io.troupe.actor;

import java.time.Duration;
import java.util.Objects;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * Settings of an actor space; immutable.
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
 *
 * @param name of the space and its thread
 * @param clock the clock of its timers
 * @param onError receives errors that have no caller
 * @param onDeadLetter receives messages that were not delivered, on the thread that detected this
 * @param stallLimit a message that takes longer, by the machine's clock, is reported; zero = off. A space without a
 *     thread reports none
 * @param onStall receives such a report, on a helper thread that it may block
 * @param offloadLimit the number of concurrent runs of {@link ActorSpace#offload}
 * @param threadless true for a space without a thread, which runs only in {@link ActorSpace#runQueued}
 * @param actorQuota after so many calls of one actor in a row, those of the others that are queued come first; zero =
 *     all calls are handled in the order of arrival
 * @param context carried from callers to turns; null = none
 * @param callObserver observes the calls in this space; null = none
 */
public record SpaceSettings(
        String name,
        Clock clock,
        ErrorHandler onError,
        Consumer<DeadLetter> onDeadLetter,
        Duration stallLimit,
        Consumer<Stall> onStall,
        int offloadLimit,
        boolean threadless,
        int actorQuota,
        @Nullable TurnContext<?> context,
        @Nullable CallObserver callObserver) {
    private static final int USUAL_OFFLOAD_LIMIT = 256;

    public SpaceSettings {
        Objects.requireNonNull(name, "name");
        Objects.requireNonNull(clock, "clock");
        Objects.requireNonNull(onError, "onError");
        Objects.requireNonNull(onDeadLetter, "onDeadLetter");
        Objects.requireNonNull(onStall, "onStall");
        if (stallLimit.isNegative()) {
            throw new IllegalArgumentException("stallLimit is " + stallLimit + ", expected zero (off) or more");
        }
        if (offloadLimit < 1) {
            throw new IllegalArgumentException("offloadLimit is " + offloadLimit + ", expected 1 or more");
        }
        if (actorQuota < 0) {
            throw new IllegalArgumentException("actorQuota is " + actorQuota + ", expected zero (off) or more");
        }
    }

    /**
     * Default settings: a daemon thread on the machine's clock that logs errors, dead letters, and messages that take
     * longer than a second.
     */
    public static SpaceSettings named(String name) {
        return new SpaceSettings(
                name,
                Clock.system(),
                SpaceLog::error,
                SpaceLog::deadLetter,
                Duration.ofSeconds(1),
                SpaceLog::stall,
                USUAL_OFFLOAD_LIMIT,
                false,
                0,
                null,
                null);
    }

    SpaceSettings withName(String newName) {
        return new SpaceSettings(
                newName,
                clock,
                onError,
                onDeadLetter,
                stallLimit,
                onStall,
                offloadLimit,
                threadless,
                actorQuota,
                context,
                callObserver);
    }

    public SpaceSettings withClock(Clock newClock) {
        return new SpaceSettings(
                name,
                newClock,
                onError,
                onDeadLetter,
                stallLimit,
                onStall,
                offloadLimit,
                threadless,
                actorQuota,
                context,
                callObserver);
    }

    public SpaceSettings withOnError(ErrorHandler handler) {
        return new SpaceSettings(
                name,
                clock,
                handler,
                onDeadLetter,
                stallLimit,
                onStall,
                offloadLimit,
                threadless,
                actorQuota,
                context,
                callObserver);
    }

    public SpaceSettings withOnDeadLetter(Consumer<DeadLetter> handler) {
        return new SpaceSettings(
                name,
                clock,
                onError,
                handler,
                stallLimit,
                onStall,
                offloadLimit,
                threadless,
                actorQuota,
                context,
                callObserver);
    }

    public SpaceSettings withOnStall(Duration limit, Consumer<Stall> handler) {
        return new SpaceSettings(
                name,
                clock,
                onError,
                onDeadLetter,
                limit,
                handler,
                offloadLimit,
                threadless,
                actorQuota,
                context,
                callObserver);
    }

    public SpaceSettings withoutThread() {
        return new SpaceSettings(
                name,
                clock,
                onError,
                onDeadLetter,
                stallLimit,
                onStall,
                offloadLimit,
                true,
                actorQuota,
                context,
                callObserver);
    }

    public SpaceSettings withOffloadLimit(int limit) {
        return new SpaceSettings(
                name,
                clock,
                onError,
                onDeadLetter,
                stallLimit,
                onStall,
                limit,
                threadless,
                actorQuota,
                context,
                callObserver);
    }

    /**
     * Handles at most so many calls of an actor before the calls of others that are queued meanwhile. So an actor that
     * gets very many calls does not keep the others waiting. The calls of each actor keep their order.
     *
     * <p><b>Cost.</b> Some 10 ns for each call in this space; nothing in others.
     */
    public SpaceSettings withActorQuota(int calls) {
        return new SpaceSettings(
                name,
                clock,
                onError,
                onDeadLetter,
                stallLimit,
                onStall,
                offloadLimit,
                threadless,
                calls,
                context,
                callObserver);
    }

    /**
     * Carries the context of a caller: captured on the calling thread with each call of an actor of this space, and
     * with each listener that will run in this space, and restored for that turn. Not with timers, tasks, sequential
     * bodies and callbacks.
     *
     * <p><b>Cost.</b> Two objects for each call and listener in this space; nothing in others.
     */
    public SpaceSettings withContext(TurnContext<?> newContext) {
        return new SpaceSettings(
                name,
                clock,
                onError,
                onDeadLetter,
                stallLimit,
                onStall,
                offloadLimit,
                threadless,
                actorQuota,
                Objects.requireNonNull(newContext, "newContext"),
                callObserver);
    }

    /**
     * Observes the calls in this space, and the turns of its actors. Several spaces may have the same observer;
     * {@link CallObserver#and} joins two.
     */
    public SpaceSettings withCallObserver(CallObserver observer) {
        return new SpaceSettings(
                name,
                clock,
                onError,
                onDeadLetter,
                stallLimit,
                onStall,
                offloadLimit,
                threadless,
                actorQuota,
                context,
                Objects.requireNonNull(observer, "observer"));
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
