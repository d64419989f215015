package io.troupe.broker;

import io.troupe.actor.promise.Promise;
import java.util.List;
import org.jspecify.annotations.Nullable;

/** A broker, and actors as its services, on a space without a thread. */
final class ServicesStage implements AutoCloseable {
    final BrokerBench bench = new BrokerBench(BrokerSettings.DEFAULT.withoutRestart());
    final ActorServices services = new ActorServices(bench.broker, "node", bench.test.space(), bench.events::add);
    final List<String> diary = bench.diary;
    Parrot.@Nullable Grey last;

    Parrot.Grey parrot(String name) {
        last = new Parrot.Grey(name, diary);
        return last;
    }

    void publish(String name) {
        bench.test.get(
                services.publish(bench.test.space(), Parrot.class, "parrot", List.of("talks"), () -> parrot(name)));
    }

    void kill(String address) {
        bench.test.space().stop(services.running(BrokerBench.at(address)).proxy());
    }

    <T> T get(Promise<T> promise) {
        return bench.test.get(promise);
    }

    @Override
    public void close() {
        bench.close();
    }
}
