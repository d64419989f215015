package io.troupe.bench;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.ActorConnection;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.Need;
import java.time.Duration;
import java.util.List;
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

/** What a call of an actor on the same space costs, directly and through a connection to it as a service. */
@State(Scope.Benchmark)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.NANOSECONDS)
@Fork(3)
@Warmup(iterations = 4, time = 500, timeUnit = TimeUnit.MILLISECONDS)
@Measurement(iterations = 5, time = 500, timeUnit = TimeUnit.MILLISECONDS)
public class ServiceCallBenchmark {
    private static final int CALLS = 20_000;
    private static final Duration LONG = Duration.ofSeconds(30);

    /** The service. */
    public interface Counter {
        void add(int amount);

        Promise<Integer> total();
    }

    /** Calls a counter, from the space of all. */
    public interface Caller {
        Promise<Integer> tell(Counter counter, int count);

        Promise<Integer> ask(Counter counter, int count);
    }

    private static final class Sum implements Counter {
        private static final Promise<Integer> DONE = Promise.of(1_000_000); // so that all bytes are the library's

        @Override
        public void add(int amount) {}

        @Override
        public Promise<Integer> total() {
            return DONE;
        }
    }

    private static final class Repeating implements Caller {
        @Override
        public Promise<Integer> tell(Counter counter, int count) {
            for (int i = 1; i < count; i++) {
                counter.add(i);
            }
            return counter.total();
        }

        /** One call at a time: the next one when the last one is answered. */
        @Override
        public Promise<Integer> ask(Counter counter, int count) {
            var end = new Deferred<Integer>();
            new Object() {
                int left = count;

                void next() {
                    counter.total().then((total, error) -> {
                        if (error != null) {
                            end.reject(error);
                        } else if (--left > 0) {
                            next();
                        } else {
                            end.resolve(total);
                        }
                    });
                }
            }.next();
            return end;
        }
    }

    private ActorSpace space;
    private Caller caller;
    private Counter direct;
    private ActorConnection<Counter> connection;
    private Counter service;

    @Setup
    public void open() throws Exception {
        space = ActorSpace.create(SpaceSettings.named("service-calls"));
        caller = space.spawn(Caller.class, Repeating::new);
        direct = space.spawn(Counter.class, Sum::new);
        var services = Broker.open(space, BrokerSettings.defaults()).services();
        services.publish(space, Counter.class, "counter", List.of("counting"), Sum::new)
                .get(LONG);
        connection = services.connect(Counter.class, Need.ofService("caller", "counter"));
        service = connection.actor();
        caller.ask(service, 1).get(LONG);
    }

    @TearDown
    public void close() {
        space.close();
    }

    @Benchmark
    @OperationsPerInvocation(CALLS)
    public int tell_direct() throws Exception {
        return caller.tell(direct, CALLS).get(LONG);
    }

    @Benchmark
    @OperationsPerInvocation(CALLS)
    public int tell_service() throws Exception {
        return caller.tell(service, CALLS).get(LONG);
    }

    @Benchmark
    @OperationsPerInvocation(CALLS)
    public int ask_direct() throws Exception {
        return caller.ask(direct, CALLS).get(LONG);
    }

    @Benchmark
    @OperationsPerInvocation(CALLS)
    public int ask_service() throws Exception {
        return caller.ask(service, CALLS).get(LONG);
    }
}
