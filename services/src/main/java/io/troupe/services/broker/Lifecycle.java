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

/** Starts, watches and stops providers. On the broker's space. */
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

    /** Starts it, unless it runs; those who call while it starts wait for the same start. */
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

    /** It has lost its place: a start that waits for a stop is not begun any more. */
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
        it.startedLate = false; // one life: the stop of this run is that of the other, too
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
        if (it.restartPause
                != null) { // one good check is not enough, else what fails again and again is restarted as often
            it.restartPauseEnd = limits.after(settings.longestRestartPause(), () -> it.restartPause = null);
        }
        done.resolve(null);
        onStarted.accept(it);
    }

    private static Promise<?> endOf(Registration it) {
        try {
            return it.provider.whenEnded();
        } catch (RuntimeException | Error thrown) { // a provider's code
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
     * A start of an earlier run has been answered when its limit was over. It is stopped, unless a later run goes on by
     * now: then both are one life. While it is being started or stopped, what is to be done follows when that is over.
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

    /** Tells what has failed to stop, in case it lives; nobody waits for that but its own next start. */
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
     * Asks it to stop, and once more if a late start was answered meanwhile: it may have begun to run after the stop.
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

    /** Stops it, if it may run: after the start, or the stop, that is under way. */
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
        it.health = Health.STOPPED; // from now on nobody is sent to it
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

    /** Those that may run, in the order of their starts. */
    List<Registration> begun() {
        return List.copyOf(begun);
    }
}
