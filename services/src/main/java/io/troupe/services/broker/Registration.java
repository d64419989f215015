package io.troupe.services.broker;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.Timer;
import io.troupe.services.bus.Address;
import java.time.Duration;
import java.util.List;
import org.jspecify.annotations.Nullable;

/** One provider as the broker knows it. On the broker's space. */
final class Registration {
    final String service;
    final List<String> capabilities;
    final Address address;
    final Provider provider;

    Health health = Health.NOT_STARTED;

    /** Counts starts and ends, so that what belongs to an earlier run can be told. */
    int run;

    /**
     * Whether it may run: from the beginning of a start until it has said that it stopped, ended, or could not start.
     */
    boolean mayRun;

    /**
     * Whether a start of an earlier run has been answered since it was last asked to stop, so that it may run although
     * it should not.
     */
    boolean startedLate;

    /** Whether another is being started in its place. */
    boolean isBeingReplaced;

    /** It was withdrawn or replaced; to be stopped when this is settled. */
    @Nullable
    Deferred<@Nullable Void> leaving;

    /** It was withdrawn or replaced; fulfilled when it has stopped, or its limit is over. */
    @Nullable
    Promise<@Nullable Void> gone;

    int missedChecks;

    @Nullable
    Throwable why; // it failed

    /** A start that was asked for, which may wait for a stop. */
    @Nullable
    Deferred<@Nullable Void> starting;

    @Nullable
    Promise<@Nullable Void> stopping;

    @Nullable
    Timer nextCheck;

    @Nullable
    Timer nextRestart;

    @Nullable
    Duration restartPause; // the last one; null = none yet, or it has run for long since

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

    /** The smaller, the sooner it is chosen. */
    int rank() {
        return switch (health) {
            case WELL -> 0;
            case SUSPECT -> 1;
            case STARTING -> 2;
            case NOT_STARTED, STOPPED -> 3;
            case FAILED -> 4;
        };
    }

    /** Stops waiting until users have been notified that it leaves: a successor is to be started. */
    void hurry() {
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
