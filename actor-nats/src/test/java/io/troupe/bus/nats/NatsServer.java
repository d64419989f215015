package io.troupe.bus.nats;

import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.tools.NatsServerProcess;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;

/** A real NATS server on loopback, as a process of its test. */
final class NatsServer implements AutoCloseable {
    private final NatsServerProcess process;

    private NatsServer(NatsServerProcess process) {
        this.process = process;
    }

    /** Skips the test, with one line that gives the reason, if there is no server. */
    static void assumeInstalled() {
        assumeTrue(NatsServerProcess.isInstalled(), NatsServerProcess.HOW_TO_GET + "; not tested");
    }

    static NatsServer start() throws IOException {
        return start(List.of());
    }

    /** @param options of the command, for example {@code --user} */
    static NatsServer start(List<String> options) throws IOException {
        return start(options, Map.of());
    }

    static NatsServer start(List<String> options, Map<String, String> environment) throws IOException {
        assumeInstalled();
        return new NatsServer(NatsServerProcess.start(options, environment));
    }

    /** A server with the settings of a configuration file, without its address. */
    static NatsServer configured(Path folder, String configuration) throws IOException {
        Path file = Files.writeString(folder.resolve("nats.conf"), configuration);
        return start(List.of("-c", file.toString()));
    }

    static int freePort() throws IOException {
        try (var socket = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            return socket.getLocalPort();
        }
    }

    /** With a long limit: the machine may be busy. */
    NatsSettings settings() {
        return NatsSettings.at(address()).withConnectLimit(Duration.ofSeconds(60));
    }

    String address() {
        return process.address();
    }

    int port() {
        return process.port();
    }

    /** Kills it as {@code kill -9} does. */
    void kill() {
        process.kill();
    }

    /** Starts it again on the same port. */
    void startAgain() {
        try {
            process.startAgain();
        } catch (IOException failure) {
            throw new UncheckedIOException(failure);
        }
    }

    /** Freezes it ({@code STOP}), lets it go on ({@code CONT}), or has it send its clients away ({@code USR2}). */
    void signal(String name) throws IOException {
        process.signal(name);
    }

    @Override
    public void close() {
        process.close();
    }
}
