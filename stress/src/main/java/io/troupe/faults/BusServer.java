package io.troupe.faults;

import io.troupe.faults.hosts.HostProcess;
import io.troupe.faults.hosts.Hosts;
import io.troupe.tools.NatsServerProcess;
import java.io.IOException;
import java.net.ServerSocket;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.function.Consumer;

/** Starts {@code nats-server} on its host, again and again at the same port. */
final class BusServer {
    private static final int PORT = 4222;
    private static final int READY_SECONDS = 60;
    /** What the shipped configuration sets, without users. */
    private static final String CONFIGURATION = """
            host: "0.0.0.0"
            port: %d
            ping_interval: "1s"
            ping_max: 2
            write_deadline: "2s"
            max_payload: 1048576
            """;

    private final Hosts hosts;
    private final Path folder;
    private final Consumer<String> onSurprise;
    private final int port;

    BusServer(Hosts hosts, Path folder, Consumer<String> onSurprise) throws IOException {
        this.hosts = hosts;
        this.folder = folder;
        this.onSurprise = onSurprise;
        this.port = hosts.canCut() ? PORT : freePort();
    }

    private static int freePort() throws IOException {
        try (var socket = new ServerSocket(0)) {
            return socket.getLocalPort();
        }
    }

    int port() {
        return port;
    }

    String address() {
        return "nats://" + hosts.address(Hosts.SERVER) + ":" + port;
    }

    private static String program() throws IOException {
        return NatsServerProcess.program()
                .orElseThrow(() -> new IOException(NatsServerProcess.HOW_TO_GET))
                .toString();
    }

    HostProcess start() throws IOException, InterruptedException {
        Path file = Files.writeString(folder.resolve("nats.conf"), CONFIGURATION.formatted(port));
        var command = hosts.on(Hosts.SERVER, List.of(program(), "-c", file.toString()));
        var server = HostProcess.start("nats-server", command, onSurprise);
        if (server.await("Server is ready", READY_SECONDS) == null) {
            onSurprise.accept("nats-server does not start: " + server.lastLines());
        }
        return server;
    }
}
