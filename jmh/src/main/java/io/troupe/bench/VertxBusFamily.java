package io.troupe.bench;

import io.vertx.core.Future;
import io.vertx.core.VerticleBase;
import io.vertx.core.Vertx;
import io.vertx.core.eventbus.EventBus;
import io.vertx.core.eventbus.Message;
import java.util.concurrent.ExecutionException;

/** A verticle with ten addresses, and a handler at each. */
public final class VertxBusFamily implements Family {
    private final EventBus bus;
    private final String[] addresses = new String[TYPES + 1];

    public VertxBusFamily(Vertx vertx, String name, Tally tally) throws InterruptedException, ExecutionException {
        bus = vertx.eventBus();
        for (int type = 1; type <= TYPES; type++) {
            addresses[type] = name + ".add" + type;
        }
        vertx.deployVerticle(new Ten(addresses, tally))
                .toCompletionStage()
                .toCompletableFuture()
                .get();
    }

    private static final class Ten extends VerticleBase {
        private final String[] addresses;
        private final Tally tally;

        Ten(String[] addresses, Tally tally) {
            this.addresses = addresses;
            this.tally = tally;
        }

        @Override
        public Future<?> start() {
            EventBus bus = vertx.eventBus();
            bus.localConsumer(addresses[1], (Message<Integer> amount) -> tally.add(amount.body()));
            bus.localConsumer(addresses[2], (Message<Integer> amount) -> tally.add(2 * amount.body()));
            bus.localConsumer(addresses[3], (Message<Integer> amount) -> tally.add(3 * amount.body()));
            bus.localConsumer(addresses[4], (Message<Integer> amount) -> tally.add(4 * amount.body()));
            bus.localConsumer(addresses[5], (Message<Integer> amount) -> tally.add(5 * amount.body()));
            bus.localConsumer(addresses[6], (Message<Integer> amount) -> tally.add(6 * amount.body()));
            bus.localConsumer(addresses[7], (Message<Integer> amount) -> tally.add(7 * amount.body()));
            bus.localConsumer(addresses[8], (Message<Integer> amount) -> tally.add(8 * amount.body()));
            bus.localConsumer(addresses[9], (Message<Integer> amount) -> tally.add(9 * amount.body()));
            bus.localConsumer(addresses[10], (Message<Integer> amount) -> tally.add(10 * amount.body()));
            return Future.succeededFuture();
        }
    }

    @Override
    public void send(int amount) {
        bus.send(addresses[1], amount);
        bus.send(addresses[2], amount);
        bus.send(addresses[3], amount);
        bus.send(addresses[4], amount);
        bus.send(addresses[5], amount);
        bus.send(addresses[6], amount);
        bus.send(addresses[7], amount);
        bus.send(addresses[8], amount);
        bus.send(addresses[9], amount);
        bus.send(addresses[10], amount);
    }
}
