package io.troupe.tools;

import io.troupe.common.process.Programs;
import java.io.BufferedReader;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.regex.Pattern;

/**
 * A NATS server on loopback, as a child process; for commands and tests that need one for a while.
 *
 * <pre>{@code
 * try (var server = NatsServerProcess.start("--user", "ada", "--pass", "secret")) {
 *     connect(server.address());
 * }
 * }</pre>
 *
 * <p><b>Role.</b> {@link Programs#find} has to find {@code nats-server}. The port is a free one, and stays the same
 * when the server is started again.
 *
 * <p><b>Errors.</b> {@link IOException} with the server's log if it does not accept connections within
 * {@value #READY_SECONDS} s.
 */
public final class NatsServerProcess implements AutoCloseable {
    /** How to get the server, for error messages. */
    public static final String HOW_TO_GET = "there is no nats-server in " + Programs.places()
            + ": on Debian and Ubuntu apt-get install nats-server, elsewhere see https://nats.io/download";

    private static final int READY_SECONDS = 60;
    private static final int END_SECONDS = 60;
    private static final String ANY_PORT = "-1";
    private static final Pattern LISTENING = Pattern.compile("Listening for client connections on .*:(\\d+)");

    private final List<String> options;
    private final Map<String, String> environment;
    private int port;
    private Process process;

    private NatsServerProcess(List<String> options, Map<String, String> environment) throws IOException {
        this.options = List.copyOf(options);
        this.environment = Map.copyOf(environment);
        this.process = begin(ANY_PORT);
    }

    /** True if the program is found. */
    public static boolean isInstalled() {
        return program().isPresent();
    }

    /** The program, if it is installed. */
    public static Optional<Path> program() {
        return Programs.find("nats-server");
    }

    /** Starts a server and waits until it accepts connections. */
    public static NatsServerProcess start(String... options) throws IOException {
        return start(List.of(options), Map.of());
    }

    /**
     * The same with environment variables, which a configuration file may use.
     *
     * @param options of the program, for example {@code -c FILE}; they override the address in the file
     */
    public static NatsServerProcess start(List<String> options, Map<String, String> environment) throws IOException {
        return new NatsServerProcess(options, environment);
    }

    private Process begin(String itsPort) throws IOException {
        String program =
                program().orElseThrow(() -> new IOException(HOW_TO_GET)).toString();
        var command = new ArrayList<>(List.of(program, "-a", "127.0.0.1", "-p", itsPort));
        command.addAll(options);
        var builder = new ProcessBuilder(command).redirectErrorStream(true);
        builder.environment().putAll(environment);
        Process started = builder.start();
        var ready = new CompletableFuture<Integer>();
        Thread.ofVirtual().name("nats-server log").start(() -> read(started.inputReader(), ready));
        try {
            port = ready.get(READY_SECONDS, TimeUnit.SECONDS);
            return started;
        } catch (ExecutionException failed) {
            started.destroyForcibly();
            throw new IOException(failed.getCause().getMessage(), failed);
        } catch (TimeoutException late) {
            started.destroyForcibly();
            throw new IOException("nats-server was not ready in " + READY_SECONDS + " s", late);
        } catch (InterruptedException interrupted) {
            started.destroyForcibly();
            Thread.currentThread().interrupt();
            throw new IOException("interrupted while nats-server started", interrupted);
        }
    }

    /** Reads to the end, so that the server does not block on its log. */
    private static void read(BufferedReader output, CompletableFuture<Integer> ready) {
        var log = new StringBuilder();
        int port = 0;
        try (output) {
            for (String line = output.readLine(); line != null; line = output.readLine()) {
                var listening = LISTENING.matcher(line);
                if (listening.find()) {
                    port = Integer.parseInt(listening.group(1));
                }
                if (!ready.isDone()) {
                    log.append('\n').append(line);
                }
                if (line.contains("Server is ready")) {
                    ready.complete(port);
                }
            }
        } catch (IOException killed) {
            log.append('\n').append(killed.getMessage());
        }
        ready.completeExceptionally(new IOException("nats-server did not start:" + log));
    }

    /** The address for clients without encryption, {@code nats://127.0.0.1:PORT}. */
    public String address() {
        return "nats://127.0.0.1:" + port;
    }

    public int port() {
        return port;
    }

    /** Kills it as {@code kill -9} does, and waits for its end. */
    public void kill() {
        process.destroyForcibly();
        try {
            if (!process.waitFor(END_SECONDS, TimeUnit.SECONDS)) {
                throw new IllegalStateException("nats-server, process " + process.pid() + ", was still alive "
                        + END_SECONDS + " s after kill -9");
            }
        } catch (InterruptedException interrupted) {
            Thread.currentThread().interrupt();
        }
    }

    /** Starts it again on the same port, with the same options. */
    public void startAgain() throws IOException {
        process = begin(String.valueOf(port));
    }

    /**
     * Sends a signal, where the system has them.
     *
     * @param signal for example {@code STOP}, which freezes it, and {@code CONT}
     */
    public void signal(String signal) throws IOException {
        signal(process, signal);
    }

    /** Sends a signal to any process. */
    public static void signal(Process process, String signal) throws IOException {
        try {
            int status = new ProcessBuilder("kill", "-" + signal, String.valueOf(process.pid()))
                    .redirectErrorStream(true)
                    .start()
                    .waitFor();
            if (status != 0) {
                throw new IOException("the signal " + signal + " could not be sent to process " + process.pid());
            }
        } catch (InterruptedException interrupted) {
            Thread.currentThread().interrupt();
            throw new IOException("interrupted while the signal " + signal + " was sent", interrupted);
        }
    }

    @Override
    public void close() {
        kill();
    }
}
