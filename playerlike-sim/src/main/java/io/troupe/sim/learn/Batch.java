package io.troupe.sim.learn;

import java.util.List;
import java.util.concurrent.ForkJoinPool;
import java.util.stream.IntStream;

/**
 * Runs independent jobs, such as trials of many seeds or of many parameters, on all cores.
 *
 * {@snippet :
 * List<Double> drivenM = Batch.run(1_000, index -> {
 *     var trial = Trial.of(seed -> RandomWorld.maze(seed, 4, 4, 2).withRobots(1));
 *     Observation start = trial.reset(index);
 *     Observation end = trial.step(0.5, 0);
 *     return end.x(0) - start.x(0);
 * });
 * }
 *
 * <p><b>Order.</b> The results are in the order of the indices, and do not depend on the number of cores.
 *
 * <p><b>Errors.</b> The exception of a job is thrown to the caller.
 */
public final class Batch {
    private Batch() {}

    /** A job of a batch; called by several threads at once, with different indices. */
    @FunctionalInterface
    public interface Job<T> {
        T run(int index);
    }

    /** Runs a job for each index from 0 on all available cores. */
    public static <T> List<T> run(int count, Job<T> job) {
        return run(count, Runtime.getRuntime().availableProcessors(), job);
    }

    /** Runs a job for each index from 0. */
    public static <T> List<T> run(int count, int threads, Job<T> job) {
        try (var pool = new ForkJoinPool(threads)) {
            return pool.submit(() -> IntStream.range(0, count)
                            .parallel()
                            .mapToObj(job::run)
                            .toList())
                    .join();
        }
    }
}
