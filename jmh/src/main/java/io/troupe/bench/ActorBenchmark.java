package io.troupe.bench;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.ThreadFactory;
import java.util.concurrent.TimeUnit;
import org.openjdk.jmh.annotations.Benchmark;
import org.openjdk.jmh.annotations.BenchmarkMode;
import org.openjdk.jmh.annotations.Fork;
import org.openjdk.jmh.annotations.Measurement;
import org.openjdk.jmh.annotations.Mode;
import org.openjdk.jmh.annotations.OperationsPerInvocation;
import org.openjdk.jmh.annotations.OutputTimeUnit;
import org.openjdk.jmh.annotations.Scope;
import org.openjdk.jmh.annotations.Setup;
import org.openjdk.jmh.annotations.State;
import org.openjdk.jmh.annotations.TearDown;
import org.openjdk.jmh.annotations.Warmup;

/**
 * Typed calls against the plainest thing that does the same: a single-thread executor with {@code CompletableFuture}. One operation is one message
 * or one answer.
 */
@State(Scope.Benchmark)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.NANOSECONDS)
@Fork(1)
@Warmup(iterations = 4, time = 500, timeUnit = TimeUnit.MILLISECONDS)
@Measurement(iterations = 5, time = 500, timeUnit = TimeUnit.MILLISECONDS)
public class ActorBenchmark {
    private static final int MESSAGES = 20_000;
    private static final Duration LONG = Duration.ofSeconds(30);

    /** Counts what it is sent. */
    public interface Counter {
        void add(int amount);

        Promise<Integer> sum();

        /** Asks another counter so many times, one after the other. */
        Promise<Integer> askInTurn(Counter other, int times);
    }

    private static final class PlainCounter implements Counter {
        private int sum;

        @Override
        public void add(int amount) {
            sum += amount;
        }

        @Override
        public Promise<Integer> sum() {
            return Promise.of(sum);
        }

        @Override
        public Promise<Integer> askInTurn(Counter other, int times) {
            return times == 0 ? sum() : other.sum().thenCompose(ignored -> askInTurn(other, times - 1));
        }
    }

    private ActorSpace space;
    private Counter counter;
    private Counter other;
    private ExecutorService executor;
    private int executorSum;

    @Setup
    public void open() {
        space = ActorSpace.create(SpaceSettings.named("bench"));
        counter = space.spawn(Counter.class, PlainCounter::new);
        other = space.spawn(Counter.class, PlainCounter::new);
        ThreadFactory daemon = Thread.ofPlatform().daemon().factory();
        executor = Executors.newSingleThreadExecutor(daemon);
    }

    @TearDown
    public void close() {
        space.close();
        executor.close();
    }

    @Benchmark
    @OperationsPerInvocation(MESSAGES)
    public int tellFromOutside_troupe() throws Exception {
        for (int i = 0; i < MESSAGES; i++) {
            counter.add(i);
        }
        return counter.sum().get(LONG);
    }

    @Benchmark
    @OperationsPerInvocation(MESSAGES)
    public int tellFromOutside_executor() throws Exception {
        for (int i = 0; i < MESSAGES; i++) {
            int amount = i;
            executor.execute(() -> executorSum += amount);
        }
        return CompletableFuture.supplyAsync(() -> executorSum, executor).get(30, TimeUnit.SECONDS);
    }

    @Benchmark
    @OperationsPerInvocation(MESSAGES)
    public int askInTurn_troupe() throws Exception {
        return counter.askInTurn(other, MESSAGES).get(LONG);
    }

    @Benchmark
    @OperationsPerInvocation(MESSAGES)
    public int askInTurn_executor() throws Exception {
        return CompletableFuture.supplyAsync(() -> askExecutor(MESSAGES), executor)
                .thenCompose(answer -> answer)
                .get(30, TimeUnit.SECONDS);
    }

    private CompletableFuture<Integer> askExecutor(int times) {
        var answer = CompletableFuture.supplyAsync(() -> executorSum, executor);
        return times == 0 ? answer : answer.thenComposeAsync(ignored -> askExecutor(times - 1), executor);
    }
}
