package io.troupe.broker;

import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.Timer;
import io.troupe.broker.internal.Lifecycle;
import io.troupe.bus.Address;
import java.time.Duration;
import java.util.List;
import java.util.Objects;
import java.util.function.Consumer;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * A registered provider: starts, checks, restarts and stops it. Used on the broker's space.
 *
 * <p>All runs of a provider share one object. So a start that completes late counts as the current run if there is one,
 * and a stop that is over its limit does not block the next run.
 */
final class Registration extends Lifecycle<Registration.Run> {
    /** One run of the provider, with its health checks. */
    static final class Run {
        private int missedChecks;
        private @Nullable Timer nextCheck;
        private @Nullable Timer restartPauseEnd;

        private void cancelTimers() {
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
    final Provider provider;
    private final BrokerContext context;
    private Run latest = new Run();
    private long life; // the number of starts

    /** Counts starts, failures and stops: a late answer to a stop counts only if there was none since. */
    private int changes;

    /**
     * Whether it may run: from the beginning of a start until it has reported that it stopped, ended, or could not
     * start.
     */
    private boolean mayRun;

    /**
     * Whether a start of an earlier run completed after the last call of stop, so that the provider may run although it
     * should not.
     */
    private boolean startedLate;

    private @Nullable Throwable why; // the cause of its failure
    private @Nullable Timer nextRestart;
    private @Nullable Duration restartPause; // the last pause; null = none yet, or reset after a long run

    /** Whether another provider is being started in its place. */
    private boolean isBeingReplaced;

    /** Set when it was withdrawn or replaced; settled when it may be stopped. */
    private @Nullable Deferred<@Nullable Void> leaving;

    /** Set when it was withdrawn or replaced; fulfilled when it has stopped, or the limit of its stop is over. */
    private @Nullable Promise<@Nullable Void> gone;

    Registration(String service, List<String> capabilities, Address address, Provider provider, BrokerContext context) {
        this.service = service;
        this.capabilities = capabilities;
        this.address = address;
        this.provider = provider;
        this.context = context;
    }

    // ---- what others see

    ServiceRecord toRecord() {
        return new ServiceRecord(service, capabilities, address, health());
    }

    Health health() {
        return provider instanceof OfferedProvider offered ? offered.health(healthHere()) : healthHere();
    }

    private Health healthHere() {
        return switch (state()) {
            case NOT_STARTED -> Health.NOT_STARTED;
            case STARTING -> Health.STARTING;
            case RUNNING -> latest.missedChecks == 0 ? Health.WELL : Health.SUSPECT;
            case STOPPING, STOPPED -> Health.STOPPED;
            case FAILED -> Health.FAILED;
        };
    }

    boolean isRunning() {
        return state() == State.RUNNING;
    }

    boolean hasFailed() {
        return state() == State.FAILED;
    }

    /** Returns whether it may be chosen in the place of another one: a failed one only if that may be over. */
    boolean mayBeTried() {
        return !hasFailed() || provider instanceof OfferedProvider offered && offered.mayBeTried();
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

    /** Returns whether it is a provider of another process. */
    boolean isOffered() {
        return provider instanceof OfferedProvider;
    }

    /** @param local the rank of the providers of this process */
    int configuredRank(int local) {
        return provider instanceof OfferedProvider offered ? offered.rank() : local;
    }

    /** The number of its current or last life; 0 = it has never been started. */
    long life() {
        return life;
    }

    /** The lower, the earlier it is chosen. */
    int rank() {
        if (provider instanceof OfferedProvider offered && offered.isSilent() && !isRunning()) {
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
     * @param onGone called when it has stopped, or the limit of its stop is over
     */
    Promise<@Nullable Void> leave(Supplier<Promise<?>> notifyClients, Runnable onGone) {
        var mayStop = new Deferred<@Nullable Void>();
        Promise<@Nullable Void> stopped = mayStop.thenCompose(notified -> stop());
        leaving = mayStop;
        gone = stopped.handle((nothing, error) -> {
            onGone.run();
            return null;
        }); // set before its clients look for another provider, which may be a successor
        cancelTimers();
        rejectPendingStart(
                new ProviderException(this + " was not started: it was withdrawn or replaced before that", null));
        notifyClients.get().handle((notified, error) -> mayStop.resolve(null));
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

    @Override
    protected @Nullable Promise<?> waitsFor() {
        List<Registration> before = context.listener.predecessors(this);
        if (!before.isEmpty()) {
            before.forEach(Registration::stopNow);
            return Promise.allSettled(before.stream()
                    .map(each -> Objects.requireNonNull(each.gone))
                    .toList());
        }
        return null;
    }

    @Override
    protected @Nullable Throwable refusal() {
        return context.isClosing()
                ? new ProviderException(this + " was not started: the broker is being closed", null)
                : null;
    }

    @Override
    protected Throwable interrupted() {
        return new ProviderException(this + " was stopped while it was being started", null);
    }

    @Override
    protected Run newRun() {
        cancelTimers();
        changes++;
        latest = new Run();
        life++;
        setMayRun(true);
        return latest;
    }

    @Override
    protected Promise<@Nullable Void> startRun(Run run) {
        return context.timeouts.call(
                provider::start,
                context.settings.startLimit(),
                this + " did not start",
                error -> startedLate(run, error));
    }

    @Override
    protected void changed(State now, State before) {
        switch (now) {
            case STARTING -> context.events.publish(new BrokerEvent.Starting(toRecord()));
            case RUNNING -> hasStarted(latest);
            case FAILED -> {
                if (before == State.RUNNING) {
                    context.listener.onFailed(this);
                }
            }
            case STOPPED -> {
                if (before == State.STOPPING) {
                    setMayRun(false);
                    context.events.publish(new BrokerEvent.Stopped(toRecord()));
                }
            }
            case NOT_STARTED, STOPPING -> {}
        }
    }

    private void hasStarted(Run run) {
        why = null;
        startedLate = false; // both starts led to one running provider: stopping this run stops it
        context.events.publish(new BrokerEvent.Started(toRecord()));
        whenEnded().handle((ended, error) -> {
            if (isRunning(run)) {
                setMayRun(false);
                fail(error != null ? error : new ProviderException(this + " has ended by itself", null));
            }
            return null;
        });
        checkLater(run);
        // reset only after a long run: one good check is not enough for a provider that keeps failing
        if (restartPause != null) {
            run.restartPauseEnd =
                    context.timeouts.after(context.settings.longestRestartPause(), () -> restartPause = null);
        }
        context.listener.onStarted(this);
    }

    private Promise<?> whenEnded() {
        try {
            return provider.whenEnded();
        } catch (RuntimeException | Error thrown) { // exception from a provider
            return Promise.failed(thrown);
        }
    }

    /**
     * A start completed after its time limit. The provider is stopped, unless a later start succeeded meanwhile: then
     * both count as one run. During a start or stop in progress, this is only recorded and handled afterwards.
     */
    @Override
    protected void startedLate(Run run, @Nullable Throwable error) {
        context.events.publish(new BrokerEvent.Late(toString(), "start", error));
        if (error == null && !isRunning()) {
            startedLate = true;
            setMayRun(true);
            if (!isStarting()) {
                changes++; // an answer to an earlier stop does not count for this start
            }
            if (inProgress() == null) {
                stopAgain(latest);
            } else if (isStarting() && state() != State.STARTING && !isStopping()) {
                mustStop(latest); // it waits for another provider
            }
        }
    }

    // ---- health checks

    private void checkLater(Run run) {
        Duration pause = context.settings.checkEvery();
        if (pause != null && !context.isClosing()) {
            run.nextCheck = context.timeouts.after(pause, () -> check(run));
        }
    }

    private void check(Run run) {
        context.timeouts
                .call(
                        provider::check,
                        context.settings.checkLimit(),
                        this + " did not answer the question for its health",
                        error -> context.events.publish(new BrokerEvent.Late(toString(), "check", error)))
                .handle((well, error) -> {
                    if (isRunning(run)) {
                        checked(run, error);
                    }
                    return null;
                });
    }

    private void checked(Run run, @Nullable Throwable error) {
        if (error == null) {
            boolean wasSuspect = run.missedChecks > 0;
            run.missedChecks = 0;
            if (wasSuspect) {
                context.events.publish(new BrokerEvent.Recovered(toRecord()));
            }
            checkLater(run);
        } else if (isOverdue(error) && run.missedChecks + 1 < context.settings.missedChecks()) {
            if (++run.missedChecks == 1) {
                context.events.publish(new BrokerEvent.Suspect(toRecord(), error));
            }
            checkLater(run);
        } else {
            fail(error);
        }
    }

    private static boolean isOverdue(Throwable error) {
        return error instanceof ProviderException overdue && overdue.mayHaveRun();
    }

    void cancelTimers() {
        latest.cancelTimers();
        if (nextRestart != null) {
            nextRestart.cancel();
            nextRestart = null;
        }
    }

    // ---- failure and stop

    @Override
    protected Throwable failed(@Nullable Run run, State during, Throwable error) {
        why = error;
        if (provider instanceof OfferedProvider offered) {
            offered.hasFailed();
        }
        if (during == State.STARTING) {
            context.events.publish(new BrokerEvent.StartFailed(toRecord(), error));
            if (!startedLate && !isOverdue(error)) {
                setMayRun(false);
            }
            return error;
        }
        if (during == State.STOPPING) {
            context.events.publish(new BrokerEvent.StopFailed(toRecord(), error));
            return new ProviderException(this + " has not stopped: " + Reasons.of(error), error);
        }
        changes++;
        cancelTimers();
        context.events.publish(new BrokerEvent.Failed(toRecord(), error));
        return error;
    }

    @Override
    protected boolean mayStillRun(Throwable error) {
        return mayRun;
    }

    @Override
    protected void stopFailed(Throwable error) {
        if (state() != State.STOPPING) {
            context.events.publish(new BrokerEvent.StopFailed(toRecord(), error));
        }
    }

    @Override
    protected @Nullable Throwable blocked(Throwable whyUnstopped) {
        return null;
    }

    /** Stops a provider if it may run; waits for a start or stop in progress first. */
    Promise<@Nullable Void> stop() {
        cancelTimers();
        Promise<@Nullable Void> inProgress = inProgress();
        if (inProgress != null) {
            return inProgress.handle((done, error) -> null).thenCompose(over -> stop());
        }
        if (!mayRun) {
            return Promise.done();
        }
        changes++;
        if (!isRunning()) {
            mustStop(latest); // an earlier stop has failed
        }
        return endRun();
    }

    /**
     * Calls stop, and once more if a late start completed meanwhile: the provider may have started after the first
     * stop.
     */
    @Override
    protected Promise<@Nullable Void> stopRun(Run run) {
        var over = new Deferred<@Nullable Void>();
        stopAll(error -> {
            if (error == null) {
                setMayRun(false);
                over.resolve(null);
            } else {
                over.reject(error);
            }
        });
        return over;
    }

    private void stopAll(Consumer<@Nullable Throwable> over) {
        startedLate = false;
        int asked = changes;
        context.timeouts
                .call(provider::stop, context.settings.stopLimit(), this + " did not stop", error -> {
                    if (error == null && changes == asked && !isStarting()) {
                        setMayRun(false);
                    }
                    context.events.publish(new BrokerEvent.Late(toString(), "stop", error));
                })
                .handle((stopped, error) -> {
                    if (startedLate) {
                        stopAll(over);
                    } else {
                        over.accept(error);
                    }
                    return null;
                });
    }

    private void setMayRun(boolean may) {
        mayRun = may;
        context.setMayRun(this, may);
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
                start().handle((started, error) -> {
                    considerRestart();
                    return null;
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
