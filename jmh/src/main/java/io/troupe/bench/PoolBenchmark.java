package io.troupe.bench;

import io.troupe.actor.ActorPool;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import org.openjdk.jmh.annotations.Benchmark;
import org.openjdk.jmh.annotations.BenchmarkMode;
import org.openjdk.jmh.annotations.Fork;
import org.openjdk.jmh.annotations.Measurement;
import org.openjdk.jmh.annotations.Mode;
import org.openjdk.jmh.annotations.OperationsPerInvocation;
import org.openjdk.jmh.annotations.OutputTimeUnit;
import org.openjdk.jmh.annotations.Param;
import org.openjdk.jmh.annotations.Scope;
import org.openjdk.jmh.annotations.Setup;
import org.openjdk.jmh.annotations.State;
import org.openjdk.jmh.annotations.TearDown;
import org.openjdk.jmh.annotations.Warmup;

/**
 * What a pool gains: requests that compute for some 20 microseconds each, on one actor or several. The time is that of
 * the whole batch for each request, so two actors on two free processors halve it at best.
 */
@State(Scope.Benchmark)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.MICROSECONDS)
@Fork(1)
@Warmup(iterations = 4, time = 500, timeUnit = TimeUnit.MILLISECONDS)
@Measurement(iterations = 5, time = 500, timeUnit = TimeUnit.MILLISECONDS)
public class PoolBenchmark {
    private static final int REQUESTS = 256;
    private static final int STEPS = 10_000;
    private static final Duration LONG = Duration.ofSeconds(30);

    /** Computes. */
    public interface Worker {
        Promise<Long> compute(long seed);
    }

    /** The number of actors. */
    @Param({"1", "2"})
    public int actors;

    private ActorPool<Worker> pool;

    private static Promise<Long> compute(long seed) {
        long value = seed;
        for (int step = 0; step < STEPS; step++) {
            value ^= value << 13; // a xorshift: the compiler cannot merge its steps
            value ^= value >>> 7;
            value ^= value << 17;
        }
        return Promise.of(value);
    }

    @Setup
    public void open() {
        pool = ActorPool.create(actors, SpaceSettings.named("worker"), Worker.class, () -> PoolBenchmark::compute);
    }

    @TearDown
    public void close() {
        pool.close();
    }

    @Benchmark
    @OperationsPerInvocation(REQUESTS)
    public List<Long> compute_roundRobin() throws Exception {
        return compute(pool.roundRobin());
    }

    @Benchmark
    @OperationsPerInvocation(REQUESTS)
    public List<Long> compute_byFirstArgument() throws Exception {
        return compute(pool.byFirstArgument());
    }

    private static List<Long> compute(Worker worker) throws Exception {
        List<Promise<Long>> results = new ArrayList<>(REQUESTS);
        for (long seed = 1; seed <= REQUESTS; seed++) {
            results.add(worker.compute(seed));
        }
        return Promise.all(results).get(LONG);
    }
}
