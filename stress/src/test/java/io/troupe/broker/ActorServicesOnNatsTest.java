package io.troupe.broker;

import io.troupe.bus.Bus;
import io.troupe.bus.BusSettings;
import io.troupe.bus.nats.ContractServer;
import java.io.IOException;
import java.util.Objects;
import java.util.UUID;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;

/** The contract of actor services in a process at a real server: nothing differs for its own actors. */
@Tag("threads")
class ActorServicesOnNatsTest extends ActorServicesTest {
    private static final AtomicReference<@Nullable ContractServer> SERVER = new AtomicReference<>();
    private @Nullable Bus bus; // without an initial value, because open() is called before one would be set

    @BeforeAll
    static void start() throws IOException {
        SERVER.set(ContractServer.start());
    }

    @AfterAll
    static void stop() {
        ContractServer server = SERVER.getAndSet(null);
        if (server != null) {
            server.close();
        }
    }

    @Override
    ActorServices open() {
        var engine =
                Objects.requireNonNull(SERVER.get()).engine(UUID.randomUUID().toString());
        Bus opened = Bus.open("node", engine, BusSettings.on(test.space()));
        bus = opened;
        broker = Broker.over(opened, test.space(), WITHOUT_RESTART.withObserver(this::record));
        return broker.services();
    }

    @AfterEach
    void close() {
        if (bus != null) {
            bus.close();
        }
    }
}
