package io.troupe.services.broker;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Objects;
import java.util.Set;
import java.util.function.Consumer;
import java.util.function.Function;
import org.jspecify.annotations.Nullable;

/** Starts, checks and stops providers. Runs on the broker's space. */
final class Lifecycle {
    private final BrokerSettings settings;
    private final Limits limits;
    private final Events events;
    private final Function<Registration, List<Registration>> predecessors;
    private final Consumer<Registration> onStarted;
    private final Consumer<Registration> onFailed;
    private final Set<Registration> begun = new LinkedHashSet<>(); // those that may run, in the order of their starts
    private boolean closing;

    Lifecycle(
            BrokerSettings settings,
            Limits limits,
            Events events,
            Function<Registration, List<Registration>> predecessors,
            Consumer<Registration> onStarted,
            Consumer<Registration> onFailed) {
        this.settings = settings;
        this.limits = limits;
        this.events = events;
        this.predecessors = predecessors;
        this.onStarted = onStarted;
        this.onFailed = onFailed;
    }

    /** Starts a provider unless it runs; calls during a start share that start. */
    Promise<@Nullable Void> start(Registration it) {
        if (it.isRunning()) {
            return Promise.done();
        }
        if (it.starting != null) {
            return it.starting;
        }
        var done = new Deferred<@Nullable Void>();
        it.starting = done;
        beginWhenStopped(it, done);
        return done;
    }

    private void beginWhenStopped(Registration it, Deferred<@Nullable Void> done) {
        if (it.starting != done) {
            return; // rejected while it waited
        }
        List<Registration> before = predecessors.apply(it);
        if (!before.isEmpty()) {
            before.forEach(Registration::hurry);
            Promise.allSettled(before.stream()
                            .map(each -> Objects.requireNonNull(each.gone))
                            .toList())
                    .handle((stopped, error) -> {
                        beginWhenStopped(it, done);
                        return null;
                    });
            return;
        }
        if (it.startedLate) {
            giveUp(it);
        }
        if (it.stopping == null) {
            begin(it, done);
        } else {
            it.stopping.handle((stopped, error) -> {
                beginWhenStopped(it, done);
                return null;
            });
        }
    }

    /** The provider was withdrawn or replaced: a start that still waits for a stop is rejected. */
    void rejectWaitingStart(Registration it) {
        Deferred<@Nullable Void> waiting = it.starting;
        if (waiting != null && it.health != Health.STARTING) {
            it.starting = null;
            waiting.reject(
                    new ProviderException(it + " was not started: it was withdrawn or replaced before that", null));
        }
    }

    private void begin(Registration it, Deferred<@Nullable Void> done) {
        if (closing) {
            it.starting = null;
            done.reject(new ProviderException(it + " was not started: the broker is being closed", null));
            return;
        }
        int run = ++it.run;
        it.cancelTimers();
        it.health = Health.STARTING;
        it.mayRun = true;
        begun.remove(it);
        begun.add(it);
        events.tell(new BrokerEvent.Starting(it.toRecord()));
        limits.ask(it.provider::start, settings.startLimit(), it + " did not start", error -> startedLate(it, error))
                .handle((started, error) -> {
                    it.starting = null;
                    if (error == null) {
                        started(it, run, done);
                    } else {
                        notStarted(it, error, done);
                    }
                    return null;
                });
    }

    private void started(Registration it, int run, Deferred<@Nullable Void> done) {
        it.health = Health.WELL;
        it.why = null;
        it.startedLate = false; // both starts led to one running provider: stopping this run stops it
        it.missedChecks = 0;
        events.tell(new BrokerEvent.Started(it.toRecord()));
        endOf(it).handle((ended, error) -> {
            if (it.run == run && it.isRunning()) {
                remember(it, false);
                fail(it, error != null ? error : new ProviderException(it + " has ended by itself", null));
            }
            return null;
        });
        checkLater(it);
        // reset only after a long run: after one good check, a provider that keeps failing would be restarted at once
        if (it.restartPause != null) {
            it.restartPauseEnd = limits.after(settings.longestRestartPause(), () -> it.restartPause = null);
        }
        done.resolve(null);
        onStarted.accept(it);
    }

    private static Promise<?> endOf(Registration it) {
        try {
            return it.provider.whenEnded();
        } catch (RuntimeException | Error thrown) { // exception from a provider
            return Promise.failed(thrown);
        }
    }

    private void notStarted(Registration it, Throwable error, Deferred<@Nullable Void> done) {
        it.health = Health.FAILED;
        it.why = error;
        events.tell(new BrokerEvent.StartFailed(it.toRecord(), error));
        if (it.startedLate || error instanceof ProviderException overdue && overdue.isOverdue()) {
            giveUp(it);
        } else {
            remember(it, false);
        }
        done.reject(error);
    }

    /**
     * A start completed after its time limit. The provider is stopped, unless a later start succeeded meanwhile: then
     * both count as one run. During a start or stop in progress, this is only recorded and handled afterwards.
     */
    private void startedLate(Registration it, @Nullable Throwable error) {
        events.tell(new BrokerEvent.Late(it.toString(), "start", error));
        if (error == null && !it.isRunning()) {
            it.startedLate = true;
            remember(it, true);
            if (it.starting == null) {
                it.run++;
                giveUp(it);
            }
        }
    }

    private void checkLater(Registration it) {
        if (!closing) {
            it.nextCheck = limits.after(settings.checkEvery(), () -> check(it));
        }
    }

    private void check(Registration it) {
        int run = it.run;
        limits.ask(
                        it.provider::check,
                        settings.checkLimit(),
                        it + " did not answer the question for its health",
                        error -> events.tell(new BrokerEvent.Late(it.toString(), "check", error)))
                .handle((well, error) -> {
                    if (it.run == run && it.isRunning()) {
                        checked(it, error);
                    }
                    return null;
                });
    }

    private void checked(Registration it, @Nullable Throwable error) {
        if (error == null) {
            it.missedChecks = 0;
            if (it.health == Health.SUSPECT) {
                it.health = Health.WELL;
                events.tell(new BrokerEvent.Recovered(it.toRecord()));
            }
            checkLater(it);
        } else if (error instanceof ProviderException overdue
                && overdue.isOverdue()
                && ++it.missedChecks < settings.missedChecks()) {
            if (it.health == Health.WELL) {
                it.health = Health.SUSPECT;
                events.tell(new BrokerEvent.Suspect(it.toRecord(), error));
            }
            checkLater(it);
        } else {
            fail(it, error);
        }
    }

    private void fail(Registration it, Throwable why) {
        it.run++;
        it.cancelTimers();
        it.health = Health.FAILED;
        it.why = why;
        events.tell(new BrokerEvent.Failed(it.toRecord(), why));
        if (it.mayRun) {
            giveUp(it);
        }
        onFailed.accept(it);
    }

    /** Stops a failed provider, because it may still run. Only its next start waits for this stop. */
    private void giveUp(Registration it) {
        if (it.stopping == null) {
            var done = new Deferred<@Nullable Void>();
            it.stopping = done;
            stopAll(it, error -> {
                it.stopping = null;
                if (error == null) {
                    remember(it, false);
                } else {
                    events.tell(new BrokerEvent.StopFailed(it.toRecord(), error));
                }
                done.resolve(null);
            });
        }
    }

    /**
     * Calls stop, and once more if a late start completed meanwhile: the provider may have started after the first
     * stop.
     */
    private void stopAll(Registration it, Consumer<@Nullable Throwable> over) {
        it.startedLate = false;
        askToStop(it).handle((stopped, error) -> {
            if (it.startedLate) {
                stopAll(it, over);
            } else {
                over.accept(error);
            }
            return null;
        });
    }

    /** Stops a provider if it may run; waits for a start or stop in progress first. */
    Promise<@Nullable Void> stop(Registration it) {
        it.cancelTimers();
        Promise<@Nullable Void> underWay = it.starting != null ? it.starting : it.stopping;
        if (underWay != null) {
            return underWay.handle((done, error) -> null).thenCompose(over -> stop(it));
        }
        if (!it.mayRun) {
            it.health = it.health == Health.FAILED ? Health.FAILED : Health.STOPPED;
            return Promise.done();
        }
        it.run++;
        it.health = Health.STOPPED; // from now on it is not chosen any more
        var done = new Deferred<@Nullable Void>();
        it.stopping = done;
        stopAll(it, error -> {
            it.stopping = null;
            if (error == null) {
                remember(it, false);
                events.tell(new BrokerEvent.Stopped(it.toRecord()));
                done.resolve(null);
                return;
            }
            it.health = Health.FAILED;
            it.why = error;
            events.tell(new BrokerEvent.StopFailed(it.toRecord(), error));
            done.reject(new ProviderException(it + " has not stopped: " + Reasons.of(error), error));
        });
        return done;
    }

    private Promise<@Nullable Void> askToStop(Registration it) {
        int run = it.run;
        return limits.ask(it.provider::stop, settings.stopLimit(), it + " did not stop", error -> {
            if (error == null && it.run == run && it.starting == null) {
                remember(it, false);
            }
            events.tell(new BrokerEvent.Late(it.toString(), "stop", error));
        });
    }

    private void remember(Registration it, boolean mayRun) {
        it.mayRun = mayRun;
        begun.remove(it);
        if (mayRun) {
            begun.add(it);
        }
    }

    void beginClosing() {
        closing = true;
        begun.forEach(Registration::cancelTimers);
    }

    boolean isClosing() {
        return closing;
    }

    /** Providers that may run, in the order of their starts. */
    List<Registration> begun() {
        return List.copyOf(begun);
    }
}
