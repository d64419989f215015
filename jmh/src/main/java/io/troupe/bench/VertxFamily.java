package io.troupe.bench;

import io.vertx.core.Context;
import io.vertx.core.VerticleBase;
import io.vertx.core.Vertx;
import java.util.concurrent.ExecutionException;

/** Ten closures that run on the context of a verticle. */
public final class VertxFamily implements Family {
    private final Ten ten = new Ten();
    private final Tally tally;

    public VertxFamily(Vertx vertx, Tally tally) throws InterruptedException, ExecutionException {
        this.tally = tally;
        vertx.deployVerticle(ten).toCompletionStage().toCompletableFuture().get();
    }

    private static final class Ten extends VerticleBase {
        Context home() {
            return context;
        }
    }

    @Override
    public void send(int amount) {
        Context home = ten.home();
        home.runOnContext(none -> tally.add(amount));
        home.runOnContext(none -> tally.add(2 * amount));
        home.runOnContext(none -> tally.add(3 * amount));
        home.runOnContext(none -> tally.add(4 * amount));
        home.runOnContext(none -> tally.add(5 * amount));
        home.runOnContext(none -> tally.add(6 * amount));
        home.runOnContext(none -> tally.add(7 * amount));
        home.runOnContext(none -> tally.add(8 * amount));
        home.runOnContext(none -> tally.add(9 * amount));
        home.runOnContext(none -> tally.add(10 * amount));
    }
}
