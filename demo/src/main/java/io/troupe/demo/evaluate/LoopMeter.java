package io.troupe.demo.evaluate;

import io.troupe.demo.evaluate.Measurement.Quantity;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.State;
import java.lang.management.ManagementFactory;
import java.lang.management.ThreadMXBean;
import java.util.List;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/**
 * Measures a fixed number of loops of each service, one service per robot. Time starts when all services are connected,
 * so that connecting is not counted.
 */
final class LoopMeter implements Meter {
    private static final double NANOS_PER_MILLI = 1e6;
    private static final double NANOS_PER_MICRO = 1e3;

    /** Measurements of one service. */
    private static final class Track {
        private final Durations intervals = new Durations();
        private final Durations cycles = new Durations();
        private final String service;
        private int loops;
        private long beganComputing;
        private long beganCycle;
        private long timeNanos;
        private long endedCycle;

        Track(String service) {
            this.service = service;
        }
    }

    private final ThreadMXBean threads = ManagementFactory.getThreadMXBean();
    private final MessageMeter messages = new MessageMeter();
    private final List<Track> tracks;
    private final int loops;
    private final boolean inTurn;
    private final RobotClock time;
    private final AtomicInteger unfinished;
    private final TurnTimer turns = new TurnTimer();
    private long beganNanos;
    private long lastEndNanos;
    private long processorBegan = -1;
    private long processorNanos;

    /**
     * Creates a meter for the services of a state, by robot.
     *
     * @param loops at least 2
     */
    LoopMeter(Mode mode, State state, int loops, RobotClock time) {
        this.tracks = state.services().stream()
                .map(service -> new Track(service.name()))
                .toList();
        this.loops = loops;
        this.inTurn = mode == Mode.SYNC;
        this.time = time;
        this.unfinished = new AtomicInteger(tracks.size());
    }

    @Override
    public boolean isDone() {
        return unfinished.get() == 0;
    }

    @Override
    public void stateStarted(State state, @Nullable Integer seenBy) {}

    @Override
    public void serviceStarted(int robot, Service service) {
        beganNanos = time.nanos();
        lastEndNanos = beganNanos;
        tracks.forEach(track -> track.endedCycle = beganNanos);
    }

    @Override
    public void cycleStarted(int robot, Service service) {
        Track track = tracks.get(robot);
        if (processorBegan < 0) {
            processorBegan = threads.getCurrentThreadCpuTime();
        }
        long now = time.nanos();
        if (track.loops > 0 && track.loops < loops) {
            track.intervals.add(now - track.beganCycle);
        }
        track.beganCycle = now;
        track.beganComputing = System.nanoTime();
        if (!isDone()) {
            turns.begin(now, track.beganComputing);
        }
    }

    @Override
    public void cycleEnded(int robot, Service service) {
        long computed = System.nanoTime();
        Track track = tracks.get(robot);
        long end = time.endOfCycleNanos();
        turns.extend(computed);
        if (track.loops < loops) {
            track.cycles.add(computed - track.beganComputing);
            // in turn a loop starts where the other service's loop ended, concurrently where its own previous one did
            track.timeNanos += end - (inTurn ? lastEndNanos : track.endedCycle);
            track.endedCycle = end;
            lastEndNanos = end;
            track.loops++;
            if (track.loops == loops) {
                processorNanos = threads.getCurrentThreadCpuTime() - processorBegan;
                unfinished.decrementAndGet();
            }
        }
    }

    @Override
    public void serviceEnded(int robot, Service service) {}

    @Override
    public void colourSent(int robot, int colour) {
        if (!isDone()) {
            messages.sent(robot);
        }
    }

    @Override
    public void colourReceived(int robot, int colour) {
        messages.received(robot);
        if (!isDone()) {
            turns.extend(System.nanoTime());
        }
    }

    @Override
    public Job.Result result() {
        var result = new Job.Result.Builder();
        for (Track track : tracks) {
            result.add(track.service, Quantity.TIME, track.timeNanos / NANOS_PER_MILLI)
                    .add(track.service, Quantity.CYCLE, track.cycles.trimmedMean(NANOS_PER_MICRO))
                    .add(track.service, Quantity.CYCLE_P99, track.cycles.quantile(0.99, NANOS_PER_MICRO))
                    .add(track.service, Quantity.INTERVAL, track.intervals.quantile(0.5, NANOS_PER_MILLI))
                    .add(track.service, Quantity.INTERVAL_P99, track.intervals.quantile(0.99, NANOS_PER_MILLI));
        }
        if (tracks.size() == 1) {
            return result.add(tracks.getFirst().service, Quantity.PROCESSOR, processorPerLoopMicros())
                    .build();
        }
        Durations each = turns.durations();
        long lastNanos = Stream.concat(Stream.of(lastEndNanos), tracks.stream().map(track -> track.endedCycle))
                .mapToLong(Long::longValue)
                .max()
                .orElseThrow();
        result.add(Measurement.BOTH, Quantity.TIME, (lastNanos - beganNanos) / NANOS_PER_MILLI)
                .add(Measurement.BOTH, Quantity.TURN, each.trimmedMean(NANOS_PER_MICRO) * each.count() / loops)
                .add(Measurement.BOTH, Quantity.PROCESSOR, processorPerLoopMicros());
        messages.addTo(result);
        return result.build();
    }

    private double processorPerLoopMicros() {
        return processorNanos / NANOS_PER_MICRO / loops;
    }

    /** Machine time of the work at each reading: from the first cycle to the last message that results from it. */
    private static final class TurnTimer {
        private final Durations durations = new Durations();
        private long readingNanos = Long.MIN_VALUE;
        private long began;
        private long last;

        /**
         * Starts a cycle.
         *
         * @param reading robot time of its reading
         * @param now machine time
         */
        void begin(long reading, long now) {
            if (reading != readingNanos) {
                end();
                readingNanos = reading;
                began = now;
                last = now;
            }
        }

        /** Extends the current turn up to {@code now}, in machine time. */
        void extend(long now) {
            last = now;
        }

        /** The durations of all turns so far. */
        Durations durations() {
            end();
            return durations;
        }

        private void end() {
            if (readingNanos != Long.MIN_VALUE) {
                durations.add(last - began);
                readingNanos = Long.MIN_VALUE;
            }
        }
    }
}
