package io.troupe.broker;

import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.Timer;
import io.troupe.bus.Address;
import java.time.Duration;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Objects;
import java.util.Set;
import java.util.function.Consumer;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * A registered provider, and the state machine of its lives: it is started, checked, restarted and stopped here, and
 * nowhere else, whether it is an actor, a component or a provider of another process. Used on the broker's space.
 *
 * <pre>
 *                  start                 started               stop
 *   NOT_STARTED ----------&gt; STARTING ----------&gt; RUNNING ----------&gt; STOPPING ----------&gt; STOPPED
 *                              |                    |                    |
 *                              +--------------------+--------------------+---&gt; FAILED
 * </pre>
 *
 * <p><b>Order.</b> There is one current life. A start during a start shares it; a start during a stop waits for it; a
 * stop waits for a start or stop in progress. A life that fails is stopped if a part of it may still run.
 *
 * <p><b>One object for all lives, or one for each.</b> If a provider is one object in all its lives, a start that
 * completes late counts as the current life if there is one, and a stop that is over its limit does not keep the next
 * life from beginning: the object has to decide. If each life has a separate object, a late start is stopped by itself,
 * and no life begins before all earlier ones have been stopped, which each start tries again.
 *
 * <p><b>Reentrancy.</b> The listener of the context may start other providers, and this one again. So it is called
 * after the fields have been updated.
 */
final class ManagedProvider {
    /** The state of the current or last life. */
    enum State {
        NOT_STARTED,
        STARTING,
        RUNNING,
        STOPPING,
        STOPPED,
        /** The life could not be started, has failed, or could not be stopped. */
        FAILED
    }

    /**
     * Where the provider of the next life comes from.
     *
     * @param identity is the same object if two registrations have the same provider
     * @param isShared whether all lives are of one object
     */
    record Source(Object identity, Supplier<? extends Provider> next, boolean isShared) {
        static Source of(Provider provider) {
            Objects.requireNonNull(provider, "provider");
            return new Source(provider, () -> provider, true);
        }

        static Source of(Supplier<? extends Provider> lives) {
            Objects.requireNonNull(lives, "lives");
            return new Source(lives, lives, false);
        }
    }

    /** An object that is started and stopped, in one life or in several. */
    private static final class Instance {
        final Provider provider;

        /**
         * Whether a start that had been given up completed after the last call of stop, so that it may run although it
         * should not.
         */
        boolean startedLate;

        /** Counts starts, failures and stops: a late answer to a stop counts only if there was none since. */
        int changes;

        /** The number of stops in progress. */
        int stops;

        Instance(Provider provider) {
            this.provider = provider;
        }
    }

    /** One life, with its health checks. */
    private static final class Life {
        final Instance instance;
        int missedChecks;

        @Nullable
        Timer nextCheck;

        @Nullable
        Timer restartPauseEnd;

        Life(Instance instance) {
            this.instance = instance;
        }

        void cancelTimers() {
            if (nextCheck != null) {
                nextCheck.cancel();
            }
            if (restartPauseEnd != null) {
                restartPauseEnd.cancel();
            }
        }
    }

    final String service;
    final List<String> capabilities;
    final Address address;
    final Source source;
    private final @Nullable OfferedProvider offered; // a provider of another process
    private final BrokerContext context;

    private State state = State.NOT_STARTED;
    private @Nullable Instance shared; // the one object, once it has been started
    private @Nullable Life current; // from the beginning of its start to the end of its stop, or its failure
    private @Nullable Life latest;
    private long life; // the number of starts
    private @Nullable Throwable why; // the cause of its last failure

    /** Settled when the most recent start or stop has completed. */
    private Deferred<@Nullable Void> change = new Deferred<>();

    /** The start that waits for the end of earlier lives, or of another provider; or null. */
    private @Nullable Deferred<@Nullable Void> pendingStart;

    /** What may run: from the beginning of a start until it has reported that it stopped, ended, or could not start. */
    private final Set<Instance> mayRun = new LinkedHashSet<>();

    /** To be stopped before the next life begins: those being stopped, and those whose stop failed. */
    private final Set<Instance> unstopped = new LinkedHashSet<>();

    /** The number of stops in progress, what is fulfilled when there is none any more, and the error of the last. */
    private int stops;

    private @Nullable Deferred<@Nullable Void> allStopped;
    private @Nullable Throwable stopError;

    private @Nullable Timer nextRestart;
    private @Nullable Duration restartPause; // the last pause; null = none yet, or reset after a long life

    /** Whether another provider is being started in its place. */
    private boolean isBeingReplaced;

    /** Set when it was withdrawn or replaced; settled when it may be stopped. */
    private @Nullable Deferred<@Nullable Void> leaving;

    /** Set when it was withdrawn or replaced; fulfilled when it has stopped, or the limit of its stop is over. */
    private @Nullable Promise<@Nullable Void> gone;

    ManagedProvider(String service, List<String> capabilities, Address address, Source source, BrokerContext context) {
        this.service = service;
        this.capabilities = capabilities;
        this.address = address;
        this.source = source;
        this.offered = source.identity() instanceof OfferedProvider far ? far : null;
        this.context = context;
    }

    // ---- what others see

    ServiceRecord toRecord() {
        return new ServiceRecord(service, capabilities, address, health());
    }

    Health health() {
        return offered == null ? healthHere() : offered.health(healthHere());
    }

    private Health healthHere() {
        return switch (state) {
            case NOT_STARTED -> Health.NOT_STARTED;
            case STARTING -> Health.STARTING;
            case RUNNING -> Objects.requireNonNull(current).missedChecks == 0 ? Health.WELL : Health.SUSPECT;
            case STOPPING, STOPPED -> Health.STOPPED;
            case FAILED -> Health.FAILED;
        };
    }

    boolean isRunning() {
        return state == State.RUNNING;
    }

    private boolean isRunning(Life one) {
        return one == current && state == State.RUNNING;
    }

    /** Returns whether it has been started and not been stopped, or may run for another reason. */
    boolean isInUse() {
        return inProgress() != null || !mayRun.isEmpty();
    }

    boolean hasFailed() {
        return state == State.FAILED;
    }

    /** Returns whether it may be chosen in the place of another one: a failed one only if that may be over. */
    boolean mayBeTried() {
        return !hasFailed() || offered != null && offered.mayBeTried();
    }

    /** The cause of its last failure, or null. */
    @Nullable
    Throwable why() {
        return why;
    }

    boolean meets(Need need) {
        return (need.service() == null || need.service().equals(service))
                && (need.capability() == null || capabilities.contains(need.capability()));
    }

    /** The provider of another process that this is, or null. */
    @Nullable
    OfferedProvider offered() {
        return offered;
    }

    /** The rank among equals of its process. */
    int configuredRank(Sharing local) {
        return offered == null ? local.rank(address.name()) : offered.rank();
    }

    /** Returns whether the other one is a registration of the same provider. */
    boolean hasProviderOf(ManagedProvider other) {
        return source.identity() == other.source.identity();
    }

    /** The number of its current or last life; 0 = it has never been started. */
    long life() {
        return life;
    }

    /** The lower, the earlier it is chosen. */
    int rank() {
        if (offered != null && offered.isSilent() && !isRunning()) {
            return 4; // as likely to fail as one that has failed
        }
        return switch (health()) {
            case WELL -> 0;
            case SUSPECT -> 1;
            case STARTING -> 2;
            case NOT_STARTED, STOPPED -> 3;
            case FAILED -> 4;
        };
    }

    @Override
    public String toString() {
        return address.toString();
    }

    // ---- withdrawal and replacement

    void checkNotBeingReplaced() {
        if (isBeingReplaced) {
            throw new IllegalStateException(address + " is being replaced already, expected one replacement at a time");
        }
    }

    void setBeingReplaced(boolean is) {
        isBeingReplaced = is;
    }

    /**
     * Stops it because it was withdrawn or replaced.
     *
     * @param notifyClients notifies its clients; the provider is stopped after that, or earlier if a successor has to
     *     be started
     */
    Promise<@Nullable Void> leave(Supplier<Promise<?>> notifyClients) {
        var mayStop = new Deferred<@Nullable Void>();
        Promise<@Nullable Void> stopped = mayStop.thenCompose(notified -> stop());
        leaving = mayStop;
        gone = stopped.handle((nothing, error) -> {
            if (source.isShared() || mayRun.isEmpty()) {
                context.listener.onGone(this);
            } // else a successor has to stop it
            return null;
        }); // set before its clients look for another provider, which may be a successor
        cancelTimers();
        rejectPendingStart(
                new ProviderException(this + " was not started: it was withdrawn or replaced before that", null));
        notifyClients.get().onSettled((notified, error) -> mayStop.resolve(null));
        return stopped;
    }

    /** Fulfilled when it has stopped after it was withdrawn or replaced; null if it was not. */
    @Nullable
    Promise<@Nullable Void> whenGone() {
        return gone;
    }

    /** Ends the wait for notified clients, so that the provider is stopped now: a successor has to be started. */
    private void stopNow() {
        if (leaving != null) {
            leaving.resolve(null);
        }
    }

    // ---- start

    /** A start or a stop in progress, also a start that waits; null if there is none. */
    private @Nullable Promise<@Nullable Void> inProgress() {
        if (pendingStart != null) {
            return pendingStart;
        }
        return state == State.STARTING || state == State.STOPPING ? change : allStopped;
    }

    /** Returns whether a start is in progress or waits. */
    private boolean isStarting() {
        return pendingStart != null || state == State.STARTING;
    }

    /** Starts a life unless one runs or is being started. */
    Promise<@Nullable Void> start() {
        if (isRunning()) {
            return Promise.done();
        }
        if (isStarting()) {
            return Objects.requireNonNull(inProgress());
        }
        var start = new Deferred<@Nullable Void>();
        pendingStart = start;
        startPending();
        return start;
    }

    /** Rejects a start that waits for the end of earlier lives. */
    private void rejectPendingStart(Throwable error) {
        Deferred<@Nullable Void> start = pendingStart;
        if (start != null) {
            pendingStart = null;
            start.reject(error);
        }
    }

    private void startPending() {
        Deferred<@Nullable Void> start = pendingStart;
        if (start == null) {
            return;
        }
        List<ManagedProvider> before = context.listener.predecessors(this);
        before.forEach(ManagedProvider::stopNow); // also while this one is being stopped itself
        if (stops > 0) {
            return; // called again when the last stop has completed
        }
        List<Promise<@Nullable Void>> ends = before.stream()
                .map(each -> Objects.requireNonNull(each.gone))
                .filter(each -> !each.isDone())
                .toList();
        if (!ends.isEmpty()) {
            Promise.allSettled(ends).onSettled((ended, error) -> {
                if (start == pendingStart) {
                    startPending();
                }
            });
            return;
        }
        before.forEach(this::takeOverUnstopped);
        if (unstopped.isEmpty()) {
            begin(start);
        } else {
            stopUnstopped();
        }
    }

    /** Lives of a provider before this one, at the same address or of the same source, that could not be stopped. */
    private void takeOverUnstopped(ManagedProvider before) {
        before.mayRun.forEach(each -> {
            unstopped.add(each);
            setMayRun(each, true);
        });
        before.mayRun.clear();
        before.unstopped.clear();
        context.setMayRun(before, false);
        context.listener.onGone(before);
    }

    private void begin(Deferred<@Nullable Void> start) {
        pendingStart = null;
        if (context.isClosing()) {
            start.reject(new ProviderException(this + " was not started: the broker is being closed", null));
            return;
        }
        cancelTimers();
        change = start;
        state = State.STARTING;
        life++;
        Life begun;
        try {
            begun = new Life(nextInstance());
        } catch (RuntimeException | Error thrown) { // by the source of the provider
            fail(thrown);
            return;
        }
        current = begun;
        latest = begun;
        begun.instance.changes++;
        setMayRun(begun.instance, true);
        context.events.publish(new BrokerEvent.Starting(toRecord()));
        context.timeouts
                .call(
                        begun.instance.provider::start,
                        context.settings.startLimit(),
                        this + " did not start",
                        error -> startedLate(begun, error))
                .onSettled((started, error) -> {
                    if (error != null) {
                        fail(error);
                    } else {
                        state = State.RUNNING;
                        start.resolve(null); // first: a life that fails now has started all the same
                        hasStarted(begun);
                    }
                });
    }

    private Instance nextInstance() {
        Instance known = shared;
        if (known == null) {
            known = new Instance(Objects.requireNonNull(source.next().get(), "the source returned null"));
            shared = source.isShared() ? known : null;
        }
        return known;
    }

    private void hasStarted(Life begun) {
        why = null;
        begun.instance.startedLate = false; // both starts led to one running provider: stopping this life stops it
        context.events.publish(new BrokerEvent.Started(toRecord()));
        whenEnded(begun).onSettled((ended, error) -> {
            if (isRunning(begun)) {
                if (!mayStillRun(error)) {
                    setMayRun(begun.instance, false);
                }
                fail(error != null ? error : new ProviderException(this + " has ended by itself", null));
            }
        });
        checkLater(begun);
        // reset only after a long life: one good check is not enough for a provider that keeps failing
        if (restartPause != null) {
            begun.restartPauseEnd =
                    context.timeouts.after(context.settings.longestRestartPause(), () -> restartPause = null);
        }
        context.listener.onStarted(this);
    }

    private static Promise<?> whenEnded(Life begun) {
        try {
            return Objects.requireNonNull(begun.instance.provider.whenEnded(), "whenEnded() returned null");
        } catch (RuntimeException | Error thrown) { // exception from a provider
            return Promise.failed(thrown);
        }
    }

    /** A start completed after its limit: what runs now is stopped, unless it is a part of the current life. */
    private void startedLate(Life givenUp, @Nullable Throwable error) {
        context.events.publish(new BrokerEvent.Late(toString(), "start", error));
        Instance late = givenUp.instance;
        if (error != null || isRunning() && late == shared) {
            return;
        }
        late.startedLate = true;
        setMayRun(late, true);
        boolean startsAgain = late == shared && isStarting();
        if (!startsAgain) {
            late.changes++; // an answer to an earlier stop does not count for this start
        }
        if (late.stops > 0 || startsAgain && (state == State.STARTING || stops > 0)) {
            return; // considered when that is over
        }
        if (startsAgain) {
            unstopped.add(late); // its start waits for another provider
        } else {
            stop(late);
        }
    }

    // ---- health checks

    private void checkLater(Life running) {
        Duration pause = context.settings.checkEvery();
        if (pause != null && !context.isClosing()) {
            running.nextCheck = context.timeouts.after(pause, () -> check(running));
        }
    }

    private void check(Life running) {
        context.timeouts
                .call(
                        running.instance.provider::check,
                        context.settings.checkLimit(),
                        this + " did not answer the request for its health",
                        error -> context.events.publish(new BrokerEvent.Late(toString(), "check", error)))
                .onSettled((well, error) -> {
                    if (isRunning(running)) {
                        checked(running, error);
                    }
                });
    }

    private void checked(Life running, @Nullable Throwable error) {
        if (error == null) {
            boolean wasSuspect = running.missedChecks > 0;
            running.missedChecks = 0;
            if (wasSuspect) {
                context.events.publish(new BrokerEvent.Recovered(toRecord()));
            }
            checkLater(running);
        } else if (isOverdue(error) && running.missedChecks + 1 < context.settings.missedChecks()) {
            if (++running.missedChecks == 1) {
                context.events.publish(new BrokerEvent.Suspect(toRecord(), error));
            }
            checkLater(running);
        } else {
            fail(error);
        }
    }

    private static boolean isOverdue(Throwable error) {
        return error instanceof ProviderException overdue && overdue.mayHaveRun();
    }

    private static boolean mayStillRun(@Nullable Throwable error) {
        return error instanceof ProviderException failure && failure.mayStillRun();
    }

    void cancelTimers() {
        if (latest != null) {
            latest.cancelTimers();
        }
        if (nextRestart != null) {
            nextRestart.cancel();
            nextRestart = null;
        }
    }

    // ---- failure and stop

    /** The current life has failed, or could not be started or stopped: a part of it that may still run is stopped. */
    private void fail(Throwable error) {
        Life failed = current;
        State during = state;
        Deferred<@Nullable Void> waiting = change;
        why = error;
        current = null;
        state = State.FAILED;
        if (offered != null) {
            offered.hasFailed();
        }
        Throwable reported = error;
        switch (during) {
            case STARTING -> {
                context.events.publish(new BrokerEvent.StartFailed(toRecord(), error));
                if (failed != null && !failed.instance.startedLate && !mayStillRun(error)) {
                    setMayRun(failed.instance, false);
                }
            }
            case STOPPING -> {
                context.events.publish(new BrokerEvent.StopFailed(toRecord(), error));
                reported = new ProviderException(this + " has not stopped: " + Reasons.of(error), error);
            }
            default -> {
                Objects.requireNonNull(failed).instance.changes++;
                cancelTimers();
                context.events.publish(new BrokerEvent.Failed(toRecord(), error));
            }
        }
        if (failed != null && during != State.STOPPING && mayRun.contains(failed.instance)) {
            stop(failed.instance);
        }
        if (during == State.RUNNING) {
            context.listener.onFailed(this);
        }
        waiting.reject(reported);
    }

    /** Stops what may run; waits for a start or stop in progress first. */
    Promise<@Nullable Void> stop() {
        cancelTimers();
        Promise<@Nullable Void> inProgress = inProgress();
        if (inProgress != null) {
            return inProgress.handle((done, error) -> null).thenCompose(over -> stop());
        }
        if (mayRun.isEmpty()) {
            return Promise.done();
        }
        mayRun.forEach(each -> each.changes++);
        change = new Deferred<>();
        state = State.STOPPING;
        Promise<@Nullable Void> stopped = change;
        List.copyOf(mayRun).forEach(this::stop);
        return stopped;
    }

    private void stopUnstopped() {
        List.copyOf(unstopped).forEach(this::stop);
    }

    /** Stops an instance; also one that is being stopped already. */
    private void stop(Instance instance) {
        unstopped.add(instance);
        instance.stops++;
        if (stops++ == 0) {
            allStopped = new Deferred<>();
        }
        callStop(instance, error -> {
            instance.stops--;
            if (error == null) {
                hasStopped(instance);
            } else {
                stopError = error;
                if (state != State.STOPPING) { // else it is reported at the end
                    context.events.publish(new BrokerEvent.StopFailed(toRecord(), error));
                }
            }
            if (--stops == 0) {
                stopsCompleted();
            }
        });
    }

    /** Calls stop, and once more if a late start completed meanwhile: it may have run only after the first stop. */
    private void callStop(Instance instance, Consumer<@Nullable Throwable> over) {
        instance.startedLate = false;
        int asked = instance.changes;
        context.timeouts
                .call(instance.provider::stop, context.settings.stopLimit(), this + " did not stop", error -> {
                    boolean startsAgain = instance == shared && isStarting();
                    if (error == null && instance.changes == asked && !startsAgain) {
                        hasStopped(instance);
                    }
                    context.events.publish(new BrokerEvent.Late(toString(), "stop", error));
                })
                .handle((stopped, error) -> {
                    if (instance.startedLate) {
                        callStop(instance, over);
                    } else {
                        over.accept(error);
                    }
                    return null;
                });
    }

    private void hasStopped(Instance instance) {
        unstopped.remove(instance);
        setMayRun(instance, false);
        if (gone != null && gone.isDone() && mayRun.isEmpty()) { // it left before all of it had been stopped
            context.listener.onGone(this);
        }
    }

    private void stopsCompleted() {
        Deferred<@Nullable Void> all = Objects.requireNonNull(allStopped);
        allStopped = null;
        Throwable whyUnstopped = unstopped.isEmpty() ? null : Objects.requireNonNull(stopError);
        if (state == State.STOPPING) {
            if (whyUnstopped != null) {
                fail(whyUnstopped);
            } else {
                current = null;
                state = State.STOPPED;
                context.events.publish(new BrokerEvent.Stopped(toRecord()));
                change.resolve(null);
            }
        }
        if (whyUnstopped != null && source.isShared()) {
            unstopped.clear(); // it is started all the same, and has to decide
        } else if (whyUnstopped != null) {
            rejectPendingStart(new ProviderException(
                    this + " cannot start: its previous life could not be stopped: " + Reasons.of(whyUnstopped),
                    whyUnstopped));
        }
        startPending();
        all.resolve(null);
    }

    private void setMayRun(Instance instance, boolean may) {
        if (may) {
            mayRun.add(instance);
        } else {
            mayRun.remove(instance);
        }
        if (may || mayRun.isEmpty()) {
            context.setMayRun(this, may);
        }
    }

    // ---- restart

    /** Restarts it after a pause, if it has failed and a connection waits for it; the pauses increase. */
    void considerRestart() {
        Duration first = context.settings.restartPause();
        if (first == null || nextRestart != null || !isRestartWanted()) {
            return;
        }
        Duration pause = nextRestartPause(first);
        restartPause = pause;
        nextRestart = context.timeouts.after(pause, () -> {
            nextRestart = null;
            if (isRestartWanted()) {
                start().onSettled((started, error) -> {
                    considerRestart();
                });
            }
        });
    }

    boolean isRestartWanted() {
        return hasFailed()
                && context.settings.restartPause() != null
                && !context.isClosing()
                && context.listener.isWanted(this);
    }

    private Duration nextRestartPause(Duration first) {
        if (restartPause == null) {
            return first;
        }
        Duration twice = restartPause.multipliedBy(2);
        Duration longest = context.settings.longestRestartPause();
        return twice.compareTo(longest) < 0 ? twice : longest;
    }
}
