package io.troupe.broker;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.Timer;
import io.troupe.bus.Address;
import java.time.Duration;
import java.util.List;
import org.jspecify.annotations.Nullable;

/** A registered provider and its state. Used on the broker's space. */
final class Registration {
    final String service;
    final List<String> capabilities;
    final Address address;
    final Provider provider;

    Health health = Health.NOT_STARTED;

    /** Counts starts and ends; distinguishes events of the current run from those of earlier runs. */
    int run;

    /**
     * Whether it may run: from the beginning of a start until it has reported that it stopped, ended, or could not
     * start.
     */
    boolean mayRun;

    /**
     * Whether a start of an earlier run completed after the last call of stop, so that the provider may run although it
     * should not.
     */
    boolean startedLate;

    /** Whether another provider is being started in its place. */
    boolean isBeingReplaced;

    /** Set when it was withdrawn or replaced; settled when it may be stopped. */
    @Nullable
    Deferred<@Nullable Void> leaving;

    /** Set when it was withdrawn or replaced; fulfilled when it has stopped, or the limit of its stop is over. */
    @Nullable
    Promise<@Nullable Void> gone;

    int missedChecks;

    @Nullable
    Throwable why; // the cause of its failure

    /** A requested start, which may wait for a stop. */
    @Nullable
    Deferred<@Nullable Void> starting;

    @Nullable
    Promise<@Nullable Void> stopping;

    @Nullable
    Timer nextCheck;

    @Nullable
    Timer nextRestart;

    @Nullable
    Duration restartPause; // the last pause; null = none yet, or reset after a long run

    @Nullable
    Timer restartPauseEnd;

    Registration(String service, List<String> capabilities, Address address, Provider provider) {
        this.service = service;
        this.capabilities = List.copyOf(capabilities);
        this.address = address;
        this.provider = provider;
    }

    ServiceRecord toRecord() {
        return new ServiceRecord(service, capabilities, address, health);
    }

    boolean isRunning() {
        return health == Health.WELL || health == Health.SUSPECT;
    }

    boolean meets(Need need) {
        return (need.service() == null || need.service().equals(service))
                && (need.capability() == null || capabilities.contains(need.capability()));
    }

    /** The lower, the earlier it is chosen. */
    int rank() {
        return switch (health) {
            case WELL -> 0;
            case SUSPECT -> 1;
            case STARTING -> 2;
            case NOT_STARTED, STOPPED -> 3;
            case FAILED -> 4;
        };
    }

    /** Ends the wait for notified clients, so that the provider is stopped now: a successor has to be started. */
    void stopNow() {
        if (leaving != null) {
            leaving.resolve(null);
        }
    }

    void cancelTimers() {
        if (nextCheck != null) {
            nextCheck.cancel();
            nextCheck = null;
        }
        if (nextRestart != null) {
            nextRestart.cancel();
            nextRestart = null;
        }
        if (restartPauseEnd != null) {
            restartPauseEnd.cancel();
            restartPauseEnd = null;
        }
    }

    @Override
    public String toString() {
        return address.toString();
    }
}
