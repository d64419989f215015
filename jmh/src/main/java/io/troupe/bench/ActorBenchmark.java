package io.troupe.bench;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import java.time.Duration;
import java.util.Objects;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.ThreadFactory;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;
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
 * Typed calls, compared with the simplest equivalent: a single-thread executor with {@code CompletableFuture}. One
 * operation is one message or one answer.
 */
@State(Scope.Benchmark)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.NANOSECONDS)
@Fork(1)
@Warmup(iterations = 4, time = 500, timeUnit = TimeUnit.MILLISECONDS)
@Measurement(iterations = 5, time = 500, timeUnit = TimeUnit.MILLISECONDS)
public class ActorBenchmark {
    private static final int MESSAGES = 20_000;
    private static final int ACTORS = 2_000;
    private static final Duration LONG = Duration.ofSeconds(30);

    /** Counts the messages that it receives. */
    public interface Counter {
        void add(int amount);

        Promise<Integer> sum();

        /** Asks another counter {@code times} times, one after the other. */
        Promise<Integer> askInTurn(Counter other, int times);

        /** The same with listeners instead of a chain of promises; {@code last} is resolved with the last answer. */
        void askAndListen(Counter other, int times, Deferred<Integer> last);
    }

    private static final class PlainCounter implements Counter {
        private final Consumer<Integer> listener = this::onAnswer; // made once, so that all bytes are the library's
        private @Nullable Counter partner;
        private @Nullable Deferred<Integer> end;
        private int left;
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

        @Override
        public void askAndListen(Counter asked, int times, Deferred<Integer> last) {
            partner = asked;
            left = times;
            end = last;
            ask();
        }

        private void ask() {
            Objects.requireNonNull(partner).sum().then(listener);
        }

        private void onAnswer(int answer) {
            if (--left == 0) {
                Objects.requireNonNull(end).resolve(answer);
            } else {
                ask();
            }
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

    /** A plain question: the caller registers a listener, and nothing depends on its promise. */
    @Benchmark
    @OperationsPerInvocation(MESSAGES)
    public int askAndListen_troupe() throws Exception {
        var last = new Deferred<Integer>();
        counter.askAndListen(other, MESSAGES, last);
        return last.get(LONG);
    }

    @Benchmark
    @OperationsPerInvocation(MESSAGES)
    public int askAndListen_executor() throws Exception {
        var last = new CompletableFuture<Integer>();
        executor.execute(() -> listenToExecutor(MESSAGES, last));
        return last.get(30, TimeUnit.SECONDS);
    }

    private void listenToExecutor(int times, CompletableFuture<Integer> last) {
        CompletableFuture.supplyAsync(() -> executorSum, executor)
                .thenAcceptAsync(
                        answer -> {
                            if (times == 1) {
                                last.complete(answer);
                            } else {
                                listenToExecutor(times - 1, last);
                            }
                        },
                        executor);
    }

    /** One operation is one actor: it is created, handles a message, answers another, and is stopped. */
    @Benchmark
    @OperationsPerInvocation(ACTORS)
    public int createAskAndStop_troupe() throws Exception {
        Promise<Integer> last = counter.sum();
        for (int i = 0; i < ACTORS; i++) {
            Counter newcomer = space.spawn(Counter.class, PlainCounter::new);
            last = newcomer.sum();
            space.stop(newcomer);
        }
        return last.get(LONG);
    }

    private CompletableFuture<Integer> askExecutor(int times) {
        var answer = CompletableFuture.supplyAsync(() -> executorSum, executor);
        return times == 0 ? answer : answer.thenComposeAsync(ignored -> askExecutor(times - 1), executor);
    }
}
