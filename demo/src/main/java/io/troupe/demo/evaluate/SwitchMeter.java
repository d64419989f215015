package io.troupe.demo.evaluate;

import io.troupe.demo.evaluate.Measurement.Quantity;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.State;
import java.util.HashMap;
import java.util.HashSet;
import java.util.Map;
import java.util.Set;
import org.jspecify.annotations.Nullable;

/** Measures the cost of state changes for a fixed time on the robots' clock. */
final class SwitchMeter implements Meter {
    private static final double NANOS_PER_MILLI = 1e6;
    private static final double NANOS_PER_MICRO = 1e3;

    /** Start of a cycle, on both clocks. */
    private record Moment(long machineNanos, long robotNanos) {}

    private final MessageMeter messages = new MessageMeter();
    private final RobotClock time;
    private final long endNanos;
    private final Map<Integer, Moment> cycles = new HashMap<>();
    private final Set<Integer> awaited = new HashSet<>();
    private final Durations computing = new Durations();
    private final Durations passing = new Durations();
    private @Nullable Moment seen;
    private int changes;

    SwitchMeter(double seconds, RobotClock time) {
        this.time = time;
        this.endNanos = time.nanos() + Math.round(seconds * 1e9);
    }

    @Override
    public boolean isDone() {
        return time.nanos() >= endNanos;
    }

    @Override
    public void stateStarted(State state, @Nullable Integer seenBy) {
        if (seenBy == null) {
            return;
        }
        changes++;
        seen = cycles.get(seenBy);
        awaited.clear();
        for (int robot = 0; robot < state.services().size(); robot++) {
            awaited.add(robot);
        }
    }

    @Override
    public void serviceStarted(int robot, Service service) {}

    @Override
    public void cycleStarted(int robot, Service service) {
        var now = new Moment(System.nanoTime(), time.nanos());
        cycles.put(robot, now);
        if (awaited.remove(robot) && awaited.isEmpty() && seen != null) {
            passing.add(now.robotNanos - seen.robotNanos);
            if (now.robotNanos == seen.robotNanos) { // else it includes computing by the world, or waiting
                computing.add(now.machineNanos - seen.machineNanos);
            }
        }
    }

    @Override
    public void cycleEnded(int robot, Service service) {}

    @Override
    public void serviceEnded(int robot, Service service) {}

    @Override
    public void colourSent(int robot, int colour) {
        messages.sent(robot);
    }

    @Override
    public void colourReceived(int robot, int colour) {
        messages.received(robot);
    }

    @Override
    public Job.Result result() {
        var result = new Job.Result.Builder().add(Measurement.BOTH, Quantity.STATE_CHANGES, changes);
        if (passing.count() > 0) {
            result.add(Measurement.BOTH, Quantity.SWITCH_TIME, passing.quantile(0.5, NANOS_PER_MILLI));
        }
        if (computing.count() > 0) {
            result.add(Measurement.BOTH, Quantity.SWITCH, computing.quantile(0.5, NANOS_PER_MICRO));
        }
        messages.addTo(result);
        return result.build();
    }
}
