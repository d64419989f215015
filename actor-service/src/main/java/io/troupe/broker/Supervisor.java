package io.troupe.broker;

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
final class Supervisor {
    private final BrokerSettings settings;
    private final Timeouts timeouts;
    private final EventPublisher events;
    private final Function<Registration, List<Registration>> predecessors;
    private final Consumer<Registration> onStarted;
    private final Consumer<Registration> onFailed;
    private final Set<Registration> begun = new LinkedHashSet<>(); // those that may run, in the order of their starts
    private boolean closing;

    Supervisor(
            BrokerSettings settings,
            Timeouts timeouts,
            EventPublisher events,
            Function<Registration, List<Registration>> predecessors,
            Consumer<Registration> onStarted,
            Consumer<Registration> onFailed) {
        this.settings = settings;
        this.timeouts = timeouts;
        this.events = events;
        this.predecessors = predecessors;
        this.onStarted = onStarted;
        this.onFailed = onFailed;
    }

    /** Starts a provider unless it runs; calls during a start share that start. */
    Promise<@Nullable Void> start(Registration registration) {
        if (registration.isRunning()) {
            return Promise.done();
        }
        if (registration.starting != null) {
            return registration.starting;
        }
        var done = new Deferred<@Nullable Void>();
        registration.starting = done;
        beginWhenStopped(registration, done);
        return done;
    }

    private void beginWhenStopped(Registration registration, Deferred<@Nullable Void> done) {
        if (registration.starting != done) {
            return; // rejected while it waited
        }
        List<Registration> before = predecessors.apply(registration);
        if (!before.isEmpty()) {
            before.forEach(Registration::stopNow);
            Promise.allSettled(before.stream()
                            .map(each -> Objects.requireNonNull(each.gone))
                            .toList())
                    .handle((stopped, error) -> {
                        beginWhenStopped(registration, done);
                        return null;
                    });
            return;
        }
        if (registration.startedLate) {
            stopFailed(registration);
        }
        if (registration.stopping == null) {
            begin(registration, done);
        } else {
            registration.stopping.handle((stopped, error) -> {
                beginWhenStopped(registration, done);
                return null;
            });
        }
    }

    /** The provider was withdrawn or replaced: a start that still waits for a stop is rejected. */
    void rejectWaitingStart(Registration registration) {
        Deferred<@Nullable Void> waiting = registration.starting;
        if (waiting != null && registration.health != Health.STARTING) {
            registration.starting = null;
            waiting.reject(new ProviderException(
                    registration + " was not started: it was withdrawn or replaced before that", null));
        }
    }

    private void begin(Registration registration, Deferred<@Nullable Void> done) {
        if (closing) {
            registration.starting = null;
            done.reject(new ProviderException(registration + " was not started: the broker is being closed", null));
            return;
        }
        int run = ++registration.run;
        registration.cancelTimers();
        registration.health = Health.STARTING;
        registration.mayRun = true;
        begun.remove(registration);
        begun.add(registration);
        events.publish(new BrokerEvent.Starting(registration.toRecord()));
        timeouts.call(
                        registration.provider::start,
                        settings.startLimit(),
                        registration + " did not start",
                        error -> startedLate(registration, error))
                .handle((started, error) -> {
                    registration.starting = null;
                    if (error == null) {
                        started(registration, run, done);
                    } else {
                        notStarted(registration, error, done);
                    }
                    return null;
                });
    }

    private void started(Registration registration, int run, Deferred<@Nullable Void> done) {
        registration.health = Health.WELL;
        registration.why = null;
        registration.startedLate = false; // both starts led to one running provider: stopping this run stops it
        registration.missedChecks = 0;
        events.publish(new BrokerEvent.Started(registration.toRecord()));
        endOf(registration).handle((ended, error) -> {
            if (registration.run == run && registration.isRunning()) {
                setMayRun(registration, false);
                fail(
                        registration,
                        error != null ? error : new ProviderException(registration + " has ended by itself", null));
            }
            return null;
        });
        checkLater(registration);
        // reset only after a long run: one good check is not enough for a provider that keeps failing
        if (registration.restartPause != null) {
            registration.restartPauseEnd =
                    timeouts.after(settings.longestRestartPause(), () -> registration.restartPause = null);
        }
        done.resolve(null);
        onStarted.accept(registration);
    }

    private static Promise<?> endOf(Registration registration) {
        try {
            return registration.provider.whenEnded();
        } catch (RuntimeException | Error thrown) { // exception from a provider
            return Promise.failed(thrown);
        }
    }

    private void notStarted(Registration registration, Throwable error, Deferred<@Nullable Void> done) {
        registration.health = Health.FAILED;
        registration.why = error;
        events.publish(new BrokerEvent.StartFailed(registration.toRecord(), error));
        if (registration.startedLate || error instanceof ProviderException overdue && overdue.isOverdue()) {
            stopFailed(registration);
        } else {
            setMayRun(registration, false);
        }
        done.reject(error);
    }

    /**
     * A start completed after its time limit. The provider is stopped, unless a later start succeeded meanwhile: then
     * both count as one run. During a start or stop in progress, this is only recorded and handled afterwards.
     */
    private void startedLate(Registration registration, @Nullable Throwable error) {
        events.publish(new BrokerEvent.Late(registration.toString(), "start", error));
        if (error == null && !registration.isRunning()) {
            registration.startedLate = true;
            setMayRun(registration, true);
            if (registration.starting == null) {
                registration.run++;
                stopFailed(registration);
            }
        }
    }

    private void checkLater(Registration registration) {
        if (!closing) {
            registration.nextCheck = timeouts.after(settings.checkEvery(), () -> check(registration));
        }
    }

    private void check(Registration registration) {
        int run = registration.run;
        timeouts.call(
                        registration.provider::check,
                        settings.checkLimit(),
                        registration + " did not answer the question for its health",
                        error -> events.publish(new BrokerEvent.Late(registration.toString(), "check", error)))
                .handle((well, error) -> {
                    if (registration.run == run && registration.isRunning()) {
                        checked(registration, error);
                    }
                    return null;
                });
    }

    private void checked(Registration registration, @Nullable Throwable error) {
        if (error == null) {
            registration.missedChecks = 0;
            if (registration.health == Health.SUSPECT) {
                registration.health = Health.WELL;
                events.publish(new BrokerEvent.Recovered(registration.toRecord()));
            }
            checkLater(registration);
        } else if (error instanceof ProviderException overdue
                && overdue.isOverdue()
                && ++registration.missedChecks < settings.missedChecks()) {
            if (registration.health == Health.WELL) {
                registration.health = Health.SUSPECT;
                events.publish(new BrokerEvent.Suspect(registration.toRecord(), error));
            }
            checkLater(registration);
        } else {
            fail(registration, error);
        }
    }

    private void fail(Registration registration, Throwable why) {
        registration.run++;
        registration.cancelTimers();
        registration.health = Health.FAILED;
        registration.why = why;
        events.publish(new BrokerEvent.Failed(registration.toRecord(), why));
        if (registration.mayRun) {
            stopFailed(registration);
        }
        onFailed.accept(registration);
    }

    /** Stops a failed provider, because it may still run. Only its next start waits for this stop. */
    private void stopFailed(Registration registration) {
        if (registration.stopping == null) {
            var done = new Deferred<@Nullable Void>();
            registration.stopping = done;
            stopAll(registration, error -> {
                registration.stopping = null;
                if (error == null) {
                    setMayRun(registration, false);
                } else {
                    events.publish(new BrokerEvent.StopFailed(registration.toRecord(), error));
                }
                done.resolve(null);
            });
        }
    }

    /**
     * Calls stop, and once more if a late start completed meanwhile: the provider may have started after the first
     * stop.
     */
    private void stopAll(Registration registration, Consumer<@Nullable Throwable> over) {
        registration.startedLate = false;
        askToStop(registration).handle((stopped, error) -> {
            if (registration.startedLate) {
                stopAll(registration, over);
            } else {
                over.accept(error);
            }
            return null;
        });
    }

    /** Stops a provider if it may run; waits for a start or stop in progress first. */
    Promise<@Nullable Void> stop(Registration registration) {
        registration.cancelTimers();
        Promise<@Nullable Void> underWay =
                registration.starting != null ? registration.starting : registration.stopping;
        if (underWay != null) {
            return underWay.handle((done, error) -> null).thenCompose(over -> stop(registration));
        }
        if (!registration.mayRun) {
            registration.health = registration.health == Health.FAILED ? Health.FAILED : Health.STOPPED;
            return Promise.done();
        }
        registration.run++;
        registration.health = Health.STOPPED; // from now on it is not chosen any more
        var done = new Deferred<@Nullable Void>();
        registration.stopping = done;
        stopAll(registration, error -> {
            registration.stopping = null;
            if (error == null) {
                setMayRun(registration, false);
                events.publish(new BrokerEvent.Stopped(registration.toRecord()));
                done.resolve(null);
                return;
            }
            registration.health = Health.FAILED;
            registration.why = error;
            events.publish(new BrokerEvent.StopFailed(registration.toRecord(), error));
            done.reject(new ProviderException(registration + " has not stopped: " + Reasons.of(error), error));
        });
        return done;
    }

    private Promise<@Nullable Void> askToStop(Registration registration) {
        int run = registration.run;
        return timeouts.call(
                registration.provider::stop, settings.stopLimit(), registration + " did not stop", error -> {
                    if (error == null && registration.run == run && registration.starting == null) {
                        setMayRun(registration, false);
                    }
                    events.publish(new BrokerEvent.Late(registration.toString(), "stop", error));
                });
    }

    private void setMayRun(Registration registration, boolean mayRun) {
        registration.mayRun = mayRun;
        begun.remove(registration);
        if (mayRun) {
            begun.add(registration);
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
