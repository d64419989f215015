package io.troupe.faults.hosts;

import java.io.IOException;
import java.io.PrintWriter;
import java.nio.charset.StandardCharsets;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/** A process on a host. */
public final class HostProcess implements AutoCloseable {
    private static final int LINES_KEPT = 20;

    private final String name;
    private final Process process;
    private final PrintWriter commands;
    private final BlockingQueue<String> output = new LinkedBlockingQueue<>();
    private final ArrayDeque<String> lastLines = new ArrayDeque<>(); // guarded by itself
    private final Consumer<String> onSurprise;
    private volatile boolean mayEnd;

    /** @param onSurprise is called if the process ends without being killed */
    private HostProcess(String name, Process process, Consumer<String> onSurprise) {
        this.name = name;
        this.process = process;
        this.onSurprise = onSurprise;
        this.commands = new PrintWriter(process.outputWriter(StandardCharsets.UTF_8), true);
    }

    public static HostProcess start(String name, List<String> command, Consumer<String> onSurprise) throws IOException {
        Process process = new ProcessBuilder(command).redirectErrorStream(true).start();
        var started = new HostProcess(name, process, onSurprise);
        Thread.ofPlatform().daemon().name("output of " + name).start(started::read);
        return started;
    }

    /** A virtual machine with the class path of this one. */
    public static List<String> java(Class<?> main, List<String> arguments) {
        var command = new ArrayList<>(List.of(
                System.getProperty("java.home") + "/bin/java",
                "-XX:TieredStopAtLevel=1",
                "-XX:+UseSerialGC",
                "-Xshare:auto",
                "-Xmx128m",
                "-XX:+ExitOnOutOfMemoryError",
                "-Djava.net.preferIPv4Stack=true",
                "-cp",
                System.getProperty("java.class.path"),
                main.getName()));
        command.addAll(arguments);
        return command;
    }

    private void read() {
        try (var reader = process.inputReader(StandardCharsets.UTF_8)) {
            for (String line = reader.readLine(); line != null; line = reader.readLine()) {
                synchronized (lastLines) {
                    lastLines.add(line);
                    if (lastLines.size() > LINES_KEPT) {
                        lastLines.remove();
                    }
                }
                output.add(line);
            }
        } catch (IOException killed) {
            mayEnd |= !process.isAlive();
        }
        if (!mayEnd) {
            onSurprise.accept(name + " has ended: " + lastLines());
        }
    }

    /** What it has written last. */
    public String lastLines() {
        synchronized (lastLines) {
            return String.join(" | ", lastLines);
        }
    }

    /** Sends a line to its input. */
    public void command(String line) {
        commands.println(line);
    }

    /** Waits for a line of its output; returns null if it does not come in time. */
    public @Nullable String await(String part, int seconds) throws InterruptedException {
        long deadline = System.nanoTime() + TimeUnit.SECONDS.toNanos(seconds);
        while (true) {
            String line = output.poll(deadline - System.nanoTime(), TimeUnit.NANOSECONDS);
            if (line == null || line.contains(part)) {
                return line;
            }
        }
    }

    /** {@code STOP} or {@code CONT}. */
    public void signal(String signal) throws IOException, InterruptedException {
        new ProcessBuilder("kill", "-" + signal, "" + process.pid()).start().waitFor();
    }

    /** Its end is expected from now on. */
    public void mayEnd() {
        mayEnd = true;
    }

    /** As {@code kill -9} does. */
    public void kill() throws InterruptedException {
        mayEnd = true;
        process.destroyForcibly().waitFor();
    }

    @Override
    public void close() {
        mayEnd = true;
        process.destroyForcibly();
    }

    @Override
    public String toString() {
        return name;
    }
}
