package io.troupe.bench;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import java.time.Duration;
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

/** What a result of a callback costs, from its sender to its reader, within a space and between two. */
@State(Scope.Benchmark)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.NANOSECONDS)
@Fork(3)
@Warmup(iterations = 4, time = 500, timeUnit = TimeUnit.MILLISECONDS)
@Measurement(iterations = 5, time = 500, timeUnit = TimeUnit.MILLISECONDS)
public class CallbackBenchmark {
    private static final int RESULTS = 20_000;
    private static final Duration LONG = Duration.ofSeconds(30);

    /** Sends results. */
    public interface Source {
        void send(int count, Callback<Integer> results);
    }

    /** Adds up the results of a source. */
    public interface Reader {
        Promise<Long> read(Source source, int count);
    }

    private static final class Numbers implements Source {
        private static final Integer NUMBER = 1_000_000; // made once, so that all bytes are the library's

        @Override
        public void send(int count, Callback<Integer> results) {
            for (int i = 0; i < count; i++) {
                results.next(NUMBER);
            }
            results.finish();
        }
    }

    private static final class Sum implements Reader {
        @Override
        public Promise<Long> read(Source source, int count) {
            var answer = new Deferred<Long>();
            long[] sum = new long[1];
            Callback<Integer> results = new Callback.Stream<>(number -> sum[0] += number, error -> {
                if (error == null) {
                    answer.resolve(sum[0]);
                } else {
                    answer.reject(error);
                }
            });
            source.send(count, results);
            return answer;
        }
    }

    private ActorSpace space;
    private ActorSpace otherSpace;
    private Reader reader;
    private Source near;
    private Source far;

    @Setup
    public void open() {
        space = ActorSpace.create(SpaceSettings.named("reader"));
        otherSpace = ActorSpace.create(SpaceSettings.named("source"));
        reader = space.spawn(Reader.class, Sum::new);
        near = space.spawn(Source.class, Numbers::new);
        far = otherSpace.spawn(Source.class, Numbers::new);
    }

    @TearDown
    public void close() {
        space.close();
        otherSpace.close();
    }

    @Benchmark
    @OperationsPerInvocation(RESULTS)
    public long result_sameSpace() throws Exception {
        return reader.read(near, RESULTS).get(LONG);
    }

    @Benchmark
    @OperationsPerInvocation(RESULTS)
    public long result_otherSpace() throws Exception {
        return reader.read(far, RESULTS).get(LONG);
    }
}
