package io.troupe.bus.nats;

import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.bus.BusEngine;
import io.troupe.tools.NatsServerProcess;
import java.io.IOException;
import java.time.Duration;
import java.util.List;
import java.util.Map;

/** A real NATS server on loopback, and engines for nodes of it; in the package of the engine, which is not public. */
public final class ContractServer implements AutoCloseable {
    private final NatsServerProcess process;

    private ContractServer(NatsServerProcess process) {
        this.process = process;
    }

    /** Skips the test, with one line that gives the reason, if there is no server. */
    public static ContractServer start() throws IOException {
        assumeTrue(NatsServerProcess.isInstalled(), NatsServerProcess.HOW_TO_GET + "; not tested");
        return new ContractServer(NatsServerProcess.start(List.of(), Map.of()));
    }

    /** The engine of a node, with a long limit: the machine may be busy. */
    public BusEngine engine(String application) {
        return new NatsEngine(NatsSettings.at(process.address())
                .withConnectLimit(Duration.ofSeconds(60))
                .withApplication(application));
    }

    @Override
    public void close() {
        process.close();
    }
}
