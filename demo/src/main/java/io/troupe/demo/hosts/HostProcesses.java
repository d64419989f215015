package io.troupe.demo.hosts;

import io.troupe.demo.terminal.Installation;
import io.troupe.tools.NatsServerProcess;
import java.io.BufferedReader;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.SecureRandom;
import java.util.ArrayList;
import java.util.HexFormat;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.regex.MatchResult;
import java.util.regex.Pattern;

/**
 * The processes of {@code troupe hosts}: a NATS server, and commands of Troupe in separate JVMs. Each writes its output
 * to a file {@code NAME.log}.
 *
 * <p>All are ended by {@link #close}; at the latest when this process exits; and the JVMs also when it is killed, since
 * their standard input ends then.
 */
public final class HostProcesses implements AutoCloseable {
    /** The user of the NATS server, whose password is new in each run. */
    public static final String USER = "robots";

    private static final int READY_SECONDS = 60;
    private static final int END_SECONDS = 5;
    private static final int EXIT_SECONDS = 20;
    private static final String LEAF_PORT = "  port: 7422\n";

    private final Path out;
    private final String mainClass;
    private final String password = HexFormat.of().formatHex(new SecureRandom().generateSeed(12));
    private final NatsServerProcess server;
    private final Map<String, Process> jvms = new TreeMap<>(); // guarded by itself
    private final CountDownLatch closed = new CountDownLatch(1);
    private final Thread hook = new Thread(this::endAtExit, "end hosts");

    private HostProcesses(Path out, String mainClass, Path configuration) throws IOException {
        this.out = out;
        this.mainClass = mainClass;
        String text = Files.readString(configuration);
        if (!text.contains(LEAF_PORT)) {
            throw new IOException(
                    configuration + ": expected the line \"" + LEAF_PORT.strip() + "\" for servers on robots");
        }
        // another server of this machine may have that port, and there are no servers on robots here
        Path own = Files.writeString(out.resolve("nats.conf"), text.replace(LEAF_PORT, "  port: -1\n"));
        var environment = Map.of("TROUPE_USER", USER, "TROUPE_PASSWORD", "\"" + password + "\"");
        this.server = NatsServerProcess.start(List.of("-c", own.toString()), environment);
        Runtime.getRuntime().addShutdownHook(hook);
    }

    /**
     * Starts the NATS server.
     *
     * @param out the directory of the logs
     * @param mainClass of Troupe's command line
     * @param configuration {@code docs/hosts/nats.conf}
     */
    public static HostProcesses start(Path out, String mainClass, Path configuration) throws IOException {
        return new HostProcesses(out, mainClass, configuration);
    }

    /** The address of the NATS server. */
    public String bus() {
        return server.address();
    }

    /** The password of {@link #USER}. */
    public String password() {
        return password;
    }

    /** A command that is being started. */
    public static final class Started {
        private final String name;
        private final Path log;
        private final CompletableFuture<MatchResult> ready;

        private Started(String name, Path log, CompletableFuture<MatchResult> ready) {
            this.name = name;
            this.log = log;
            this.ready = ready;
        }

        /**
         * Waits for the line that reports that it is ready.
         *
         * @throws IOException with its last line, if it ends before, or is not ready in time
         */
        public MatchResult await() throws IOException, InterruptedException {
            try {
                return ready.get(READY_SECONDS, TimeUnit.SECONDS);
            } catch (ExecutionException ended) {
                throw new IOException(name + " has ended: " + ended.getCause().getMessage(), ended);
            } catch (TimeoutException late) {
                throw new IOException(name + " was not ready in " + READY_SECONDS + " s, see " + log, late);
            }
        }
    }

    /**
     * Starts a command of Troupe.
     *
     * @param ready occurs in the line that it prints when it is ready
     */
    public Started start(String name, Pattern ready, String... arguments) throws IOException {
        var command = new ArrayList<>(List.of(
                Path.of(System.getProperty("java.home"), "bin", "java").toString(),
                "-XX:+UseSerialGC",
                "-XX:TieredStopAtLevel=1", // it starts sooner
                "-Xmx256m",
                "-D" + Installation.PROPERTY + "=" + Installation.folder(),
                "-cp",
                System.getProperty("java.class.path"),
                Guarded.class.getName(),
                mainClass));
        command.addAll(List.of(arguments));
        var builder = new ProcessBuilder(command).redirectErrorStream(true);
        builder.environment().put("TROUPE_BUS_PASSWORD", password);
        Path log = out.resolve(name + ".log");
        var writer = new PrintWriter(Files.newBufferedWriter(log), true);
        Process process = builder.start();
        synchronized (jvms) {
            jvms.put(name, process);
        }
        var found = new CompletableFuture<MatchResult>();
        Thread.ofVirtual().name("log of " + name).start(() -> copy(process.inputReader(), writer, ready, found));
        return new Started(name, log, found);
    }

    private static void copy(BufferedReader from, PrintWriter to, Pattern ready, CompletableFuture<MatchResult> found) {
        String last = "it has printed nothing";
        try (from;
                to) {
            for (String line = from.readLine(); line != null; line = from.readLine()) {
                to.println(line);
                last = line;
                var matcher = ready.matcher(line);
                if (matcher.find()) {
                    found.complete(matcher.toMatchResult());
                }
            }
        } catch (IOException killed) {
            last = String.valueOf(killed.getMessage());
        }
        found.completeExceptionally(new IOException(last));
    }

    /** The process id of a command. */
    public long pid(String name) {
        return process(name).pid();
    }

    /** Kills a command as {@code kill -9} does. */
    public void kill(String name) {
        process(name).destroyForcibly();
    }

    /** Stops a command ({@code STOP}), or lets it go on ({@code CONT}). */
    public void signal(String name, String signal) throws IOException {
        NatsServerProcess.signal(process(name), signal);
    }

    private Process process(String name) {
        synchronized (jvms) {
            Process process = jvms.get(name);
            if (process == null) {
                throw new IllegalArgumentException(
                        "no process has the name " + name + ", expected one of " + jvms.keySet());
            }
            return process;
        }
    }

    /** Ends all processes in order, those that do not end by force, and waits for that. */
    @Override
    public void close() {
        List<Process> running;
        synchronized (jvms) {
            running = List.copyOf(jvms.values());
        }
        running.forEach(Process::destroy);
        boolean interrupted = false;
        long endNanos = System.nanoTime() + TimeUnit.SECONDS.toNanos(END_SECONDS);
        for (Process process : running) {
            try {
                if (interrupted || !process.waitFor(endNanos - System.nanoTime(), TimeUnit.NANOSECONDS)) {
                    process.destroyForcibly();
                }
            } catch (InterruptedException e) {
                interrupted = true;
                process.destroyForcibly();
            }
        }
        server.close();
        closed.countDown();
        try {
            Runtime.getRuntime().removeShutdownHook(hook);
        } catch (IllegalStateException exiting) {
            // the hook is already running
        }
        if (interrupted) {
            Thread.currentThread().interrupt();
        }
    }

    /** At Ctrl-C the command itself ends them, after its last results. */
    private void endAtExit() {
        try {
            if (closed.await(EXIT_SECONDS, TimeUnit.SECONDS)) {
                return;
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
        synchronized (jvms) {
            jvms.values().forEach(Process::destroyForcibly);
        }
        server.close();
    }

    /** The main class of the JVMs: runs another one, and exits when the standard input ends. */
    static final class Guarded {
        private Guarded() {}

        /** @param arguments the name of the main class, and its arguments */
        public static void main(String[] arguments) throws ReflectiveOperationException {
            Thread.ofPlatform().daemon().name("parent").start(Guarded::exitWithParent);
            String[] rest = List.of(arguments).subList(1, arguments.length).toArray(String[]::new);
            Class.forName(arguments[0]).getMethod("main", String[].class).invoke(null, (Object) rest);
        }

        private static void exitWithParent() {
            try {
                while (System.in.read() >= 0) {}
            } catch (IOException gone) {
                Runtime.getRuntime().halt(1);
            }
            Runtime.getRuntime().halt(1);
        }
    }
}
