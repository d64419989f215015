package io.troupe.bench.bus;

import static io.troupe.bench.bus.SampleValues.ECHO;
import static io.troupe.bench.bus.SampleValues.SONAR;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusSettings;
import java.time.Duration;
import java.util.function.BiFunction;
import java.util.function.BooleanSupplier;

/** Two nodes of our bus with two spaces. The requester runs on its space, as it usually does. */
final class TroupePair implements BusPair {
    static final String NEAR = "near";
    static final String FAR = "far";
    private static final Duration LIMIT = Duration.ofSeconds(60);
    private static final Address ECHOING = new Address(FAR, "echo");

    private final ActorSpace nearSpace = ActorSpace.create(SpaceSettings.named(NEAR));
    private final ActorSpace farSpace = ActorSpace.create(SpaceSettings.named(FAR));
    private final PassingWindow window = new PassingWindow();
    private final SampleValues values = new SampleValues(1);
    private final SampleValues.Sonar sonar = values.sonar();
    private final Bus near;
    private final Bus far;
    private final BusPort port;

    /** @param opening opens a node of that name */
    TroupePair(BiFunction<String, BusSettings, Bus> opening) throws Exception {
        far = opening.apply(FAR, settings(farSpace));
        var echo = far.attach(ECHOING.name());
        echo.answer(ECHO, Promise::of);
        echo.subscribe(SONAR, (record, publisher) -> window.received());
        near = opening.apply(NEAR, settings(nearSpace));
        port = near.attach("main");
        askWhile(64, () -> false); // after its reply the server knows the subscription too
    }

    private static BusSettings settings(ActorSpace space) {
        return BusSettings.on(space).withCapacity(2 * PassingWindow.SIZE);
    }

    @Override
    public void askWhile(int payloadBytes, BooleanSupplier again) throws Exception {
        var text = values.text(payloadBytes);
        new RequestLoop<>(nearSpace, () -> port.ask(ECHOING, ECHO, text, LIMIT), SampleValues.Text::text, payloadBytes)
                .run(again);
    }

    @Override
    public void publishAll() throws InterruptedException {
        for (int i = 0; i < RECORDS; i++) {
            if (i % PassingWindow.GROUP == 0) {
                window.awaitGroup();
            }
            port.publish(SONAR, sonar);
        }
        window.awaitAll();
    }

    @Override
    public void close() {
        near.close();
        far.close();
        nearSpace.close();
        farSpace.close();
    }
}
