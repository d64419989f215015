package io.troupe.demo.learn;

import io.troupe.demo.terminal.Interruption;
import io.troupe.sim.learn.Batch;
import io.troupe.tools.ProgressLine;
import java.util.List;
import java.util.Locale;
import java.util.concurrent.atomic.AtomicInteger;

/**
 * Runs trials on all cores, with a progress line, and counts their steps.
 *
 * <p><b>Errors.</b> After Ctrl-C, {@link Interruption.InterruptedCommand}.
 */
final class TrialRunner implements AutoCloseable {
    private final Interruption interruption = Interruption.open();
    private final ProgressLine line = ProgressLine.open();
    private final int stepsPerTrial;
    private final int trials;
    private final AtomicInteger done = new AtomicInteger();
    private final long beginNanos = System.nanoTime();

    /** @param trials number of trials of all calls of {@link #run} together */
    TrialRunner(int trials, int stepsPerTrial) {
        this.trials = trials;
        this.stepsPerTrial = stepsPerTrial;
    }

    /** Runs a trial for each index from 0. */
    <T> List<T> run(String what, int count, Batch.Job<T> trial) {
        return Batch.run(count, index -> {
            interruption.check();
            T result = trial.run(index);
            int finished = done.incrementAndGet();
            line.show(what, ProgressLine.bar((double) finished / trials) + " " + what + ", " + speed());
            return result;
        });
    }

    /** Steps of the trials that have ended, in a second of the wall clock. */
    String speed() {
        double seconds = (System.nanoTime() - beginNanos) / 1e9;
        return String.format(Locale.ROOT, "%,.0f steps a second", (double) done.get() * stepsPerTrial / seconds);
    }

    /** The whole work, and how fast it was. */
    String summary() {
        double seconds = (System.nanoTime() - beginNanos) / 1e9;
        return String.format(
                Locale.ROOT, "%,d trials of %,d steps in %.1f s: %s", done.get(), stepsPerTrial, seconds, speed());
    }

    @Override
    public void close() {
        line.close();
        interruption.close();
    }
}
