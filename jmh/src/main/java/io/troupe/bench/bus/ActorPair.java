package io.troupe.bench.bus;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.ActorServices;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerObserver;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.ConnectionSettings;
import io.troupe.broker.Need;
import io.troupe.bus.Bus;
import io.troupe.bus.BusSettings;
import java.time.Duration;
import java.util.List;
import java.util.function.BiFunction;
import java.util.function.BooleanSupplier;

/** Two nodes with a broker each: one calls an actor of the other by its interface, from its space. */
final class ActorPair implements BusPair {
    private static final Duration LIMIT = Duration.ofSeconds(60);

    private final ActorSpace nearSpace = ActorSpace.create(SpaceSettings.named(TroupePair.NEAR));
    private final ActorSpace farSpace = ActorSpace.create(SpaceSettings.named(TroupePair.FAR));
    private final SampleValues values = new SampleValues(1);
    private final Bus near;
    private final Bus far;
    private final Echo echo;

    /** The interface of the actor. */
    interface Echo {
        Promise<String> echo(String text);
    }

    /** @param opening opens a node of that name */
    ActorPair(BiFunction<String, BusSettings, Bus> opening) throws Exception {
        far = opening.apply(TroupePair.FAR, BusSettings.on(farSpace));
        publishEcho(services(far, farSpace), farSpace);
        near = opening.apply(TroupePair.NEAR, BusSettings.on(nearSpace));
        var limits = ConnectionSettings.defaults().withWaitLimit(LIMIT).withAnswerLimit(LIMIT);
        var connection = services(near, nearSpace).connect(Echo.class, Need.ofService("benchmark", "echo"), limits);
        echo = connection.actor();
        askWhile(64, () -> false); // waits until the other broker's offers have come, and starts the actor
    }

    static ActorServices services(Bus bus, ActorSpace space) {
        BrokerObserver silent = event -> {}; // a call that fails ends the comparison
        return Broker.over(bus, space, BrokerSettings.defaults().withObserver(silent))
                .services();
    }

    static void publishEcho(ActorServices services, ActorSpace space) throws Exception {
        services.publish(space, Echo.class, "echo", List.of(), () -> Promise::of)
                .get(LIMIT);
    }

    @Override
    public void askWhile(int payloadBytes, BooleanSupplier again) throws Exception {
        String text = values.text(payloadBytes).text();
        new RequestLoop<>(nearSpace, () -> echo.echo(text), reply -> reply, payloadBytes).run(again);
    }

    @Override
    public void publishAll() {
        throw new IllegalStateException("an actor call is no publication");
    }

    @Override
    public void close() {
        near.close();
        far.close();
        nearSpace.close();
        farSpace.close();
    }
}
