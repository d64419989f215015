package io.troupe.bus.nats;

import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.bus.BusEngine;
import java.io.BufferedReader;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;

/** A real NATS server on loopback, as a process of its test. */
public final class NatsServer implements AutoCloseable {
    private final List<String> command;
    private final Map<String, String> environment;
    private final int port;
    private Process process;

    private NatsServer(int port, List<String> command, Map<String, String> environment) throws IOException {
        this.port = port;
        this.command = command;
        this.environment = environment;
        this.process = begin();
    }

    /** Skips the test, with one line that gives the reason, if there is no server. */
    static void assumeInstalled() {
        boolean isInstalled = List.of(System.getenv().getOrDefault("PATH", "").split(":")).stream()
                .anyMatch(folder -> Files.isExecutable(Path.of(folder, "nats-server")));
        assumeTrue(isInstalled, "nats-server is not installed (Debian: apt-get install nats-server): not tested");
    }

    public static NatsServer start() throws IOException {
        return start(List.of());
    }

    /** @param options of the command, for example {@code --user} */
    static NatsServer start(List<String> options) throws IOException {
        return start(freePort(), options, Map.of());
    }

    static NatsServer start(int port, List<String> options, Map<String, String> environment) throws IOException {
        assumeInstalled();
        var command = new ArrayList<>(List.of("nats-server", "-a", "127.0.0.1", "-p", String.valueOf(port)));
        command.addAll(options);
        return new NatsServer(port, command, environment);
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

    private Process begin() throws IOException {
        var builder = new ProcessBuilder(command).redirectErrorStream(true);
        builder.environment().putAll(environment);
        var started = builder.start();
        var log = new StringBuilder();
        var output = started.inputReader();
        for (String line = output.readLine(); line != null; line = output.readLine()) {
            log.append(line).append('\n');
            if (line.contains("Server is ready")) {
                Thread.ofVirtual().start(() -> drain(output)); // it must not block on its log
                return started;
            }
        }
        throw new IOException("nats-server did not start: " + log);
    }

    private static void drain(BufferedReader output) {
        try {
            while (output.readLine() != null) {}
        } catch (IOException killed) {
            return;
        }
    }

    /** The engine of a node, for tests in other packages. */
    public BusEngine engine(String application) {
        return new NatsEngine(settings().withApplication(application));
    }

    /** With a long limit: the machine may be busy. */
    NatsSettings settings() {
        return NatsSettings.at(address()).withConnectLimit(Duration.ofSeconds(60));
    }

    String address() {
        return "nats://127.0.0.1:" + port;
    }

    int port() {
        return port;
    }

    /** Kills it as {@code kill -9} does. */
    void kill() {
        process.destroyForcibly();
        await();
    }

    /** Starts it again on the same port. */
    void startAgain() {
        try {
            process = begin();
        } catch (IOException failure) {
            throw new UncheckedIOException(failure);
        }
    }

    /** Freezes it ({@code STOP}), lets it go on ({@code CONT}), or has it send its clients away ({@code USR2}). */
    void signal(String name) throws IOException, InterruptedException {
        signal(process, name);
    }

    static void signal(Process process, String name) throws IOException, InterruptedException {
        new ProcessBuilder("kill", "-" + name, String.valueOf(process.pid()))
                .start()
                .waitFor();
    }

    private void await() {
        try {
            process.waitFor(10, TimeUnit.SECONDS);
        } catch (InterruptedException interrupted) {
            Thread.currentThread().interrupt();
        }
    }

    @Override
    public void close() {
        kill();
    }
}
