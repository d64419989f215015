package io.troupe.actor;

import java.lang.invoke.VarHandle;
import java.time.Duration;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/** The metrics of one space, measured by a probe in its message queue. */
final class ProbedMetrics implements SpaceMetrics {
    private record Probe(long sentNanos, long servedBefore) {}

    private record Finding(long waiting, Duration latency) {}

    private final SpaceHome space;
    private final Dispatcher dispatcher;
    private final Reports reports;
    private final Clock clock = Clock.system();
    private final AtomicReference<@Nullable Probe> underWay = new AtomicReference<>();
    private volatile Finding found = new Finding(0, Duration.ZERO);

    ProbedMetrics(SpaceHome space, Dispatcher dispatcher, Reports reports) {
        this.space = space;
        this.dispatcher = dispatcher;
        this.reports = reports;
    }

    private void send() {
        var probe = new Probe(clock.nanos(), dispatcher.served());
        if (!space.isClosing() && underWay.compareAndSet(null, probe)) {
            space.enqueueMessage(new Entry(() -> arrive(probe), () -> underWay.set(null)));
        }
    }

    private void arrive(Probe probe) {
        found = new Finding(
                Math.max(0, dispatcher.served() - probe.servedBefore - 1),
                Duration.ofNanos(clock.nanos() - probe.sentNanos));
        underWay.set(null);
    }

    @Override
    public long served() {
        return dispatcher.served();
    }

    @Override
    public long waiting() {
        if (space.isThreadless()) {
            return dispatcher.waiting();
        }
        Finding last = found; // read before the next probe can arrive
        send();
        return last.waiting;
    }

    @Override
    public Duration latency() {
        if (space.isThreadless()) {
            return Duration.ZERO;
        }
        Duration last = found.latency; // read before the next probe can arrive
        send();
        Probe probe = underWay.get();
        if (probe == null) {
            return last;
        }
        Duration sofar = Duration.ofNanos(clock.nanos() - probe.sentNanos);
        return sofar.compareTo(last) > 0 ? sofar : last;
    }

    /** The fence makes repeated calls see new values. */
    @Override
    public int actors() {
        VarHandle.acquireFence();
        return space.actors().size();
    }

    @Override
    public int timers() {
        VarHandle.acquireFence();
        return space.timers().size();
    }

    @Override
    public long errors() {
        return reports.errors();
    }

    @Override
    public long deadLetters() {
        return reports.deadLetters();
    }

    @Override
    public long abandoned() {
        return reports.abandoned();
    }

    @Override
    public long expired() {
        return reports.expired();
    }

    /** Calls the other methods, and so sends a probe. */
    @Override
    public String toString() {
        return "served %d, waiting %d, latency %s, actors %d, timers %d, errors %d, dead letters %d, abandoned %d, expired %d"
                .formatted(
                        served(),
                        waiting(),
                        latency(),
                        actors(),
                        timers(),
                        errors(),
                        deadLetters(),
                        abandoned(),
                        expired());
    }
}
