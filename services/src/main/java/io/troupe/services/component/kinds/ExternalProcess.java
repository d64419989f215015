package io.troupe.services.component.kinds;

import io.troupe.actor.Promise;
import io.troupe.broker.ProviderException;
import io.troupe.services.component.ComponentCommunication;
import java.io.IOException;
import java.io.InputStream;
import java.io.InputStreamReader;
import java.io.Reader;
import java.io.Writer;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Deque;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.function.Consumer;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/**
 * The CCU of an operating system process.
 *
 * <p><b>Threads.</b> Five daemon threads for each process: two read its output and error streams, one writes its input,
 * one waits for its exit, and one ends it. They never block the actor space or the common pool. {@link Process#onExit}
 * is not used because it occupies a thread of the common pool while a child that outlives the process keeps the pipe
 * open.
 */
final class ExternalProcess implements ComponentCommunication<String, String> {
    /** Longer lines are cut here. */
    static final int LONGEST_LINE_CHARACTERS = 65_536;

    /** Time limit for the end of killed processes, which usually end at once. */
    private static final Duration KILL_LIMIT = Duration.ofSeconds(10);

    /**
     * Time that an application has, during the shutdown of the virtual machine, to stop its components in its order.
     */
    private static final Duration SHUTDOWN_GRACE = Duration.ofSeconds(2);

    /** Starts the program and returns its process tree. */
    interface Starter {
        ProcessTree start(ProcessComponent.Settings settings) throws IOException;
    }

    private final ProcessComponent.Settings settings;
    private final Starter starter;
    private final Duration killLimit;
    private final Duration shutdownGrace;
    private final Tail errors = new Tail();
    private final BlockingQueue<String> input = new LinkedBlockingQueue<>(1024);
    private final CompletableFuture<@Nullable Void> firstLine = new CompletableFuture<>();

    /** Completed when the process and all processes that it started have ended. */
    private final CompletableFuture<@Nullable Void> treeEnded = new CompletableFuture<>();

    /** Completed when the start of the program has succeeded or failed. */
    private final CompletableFuture<@Nullable Void> startAttempted = new CompletableFuture<>();

    final Thread shutdownHook;
    private volatile @Nullable ProcessTree tree;
    private volatile boolean terminating;
    private @Nullable CompletableFuture<@Nullable Void> end; // guarded by this

    ExternalProcess(ProcessComponent.Settings settings) {
        this(settings, ProcessTree::start, KILL_LIMIT, SHUTDOWN_GRACE);
    }

    ExternalProcess(ProcessComponent.Settings settings, Starter starter, Duration killLimit, Duration shutdownGrace) {
        this.settings = settings;
        this.starter = starter;
        this.killLimit = killLimit;
        this.shutdownGrace = shutdownGrace;
        this.shutdownHook =
                new Thread(this::endAtShutdown, "end of " + settings.command().getFirst());
    }

    @Override
    public Promise<@Nullable Void> invoke(Signals<? super String> signals) {
        try {
            // Ctrl-C in a terminal does not reach processes in other sessions
            Runtime.getRuntime().addShutdownHook(shutdownHook);
        } catch (IllegalStateException shuttingDown) {
            return Promise.failed(notStarted("the virtual machine is shutting down", shuttingDown));
        }
        ProcessTree started;
        try {
            started = starter.start(settings);
            tree = started;
        } catch (IOException | RuntimeException | Error e) {
            removeShutdownHook();
            return Promise.failed(notStarted(String.valueOf(e.getMessage()).strip(), e));
        } finally {
            startAttempted.complete(null);
        }
        if (terminating) {
            end();
        }
        Process process = started.root();
        signals.info("process " + process.pid() + ": " + commandLine());
        Thread readErrors = thread("stderr", () -> read(process.getErrorStream(), "error", signals, errors::add));
        Thread readOutput = thread(
                "stdout",
                () -> read(process.getInputStream(), "output", signals, line -> {
                    firstLine.complete(null);
                    signals.data(line);
                }));
        thread("stdin", () -> write(process, signals));
        thread("exit", () -> awaitExit(started, signals, readErrors, readOutput));
        return Promise.from(firstLine
                .orTimeout(TimeUnit.MILLISECONDS.convert(settings.startLimit()), TimeUnit.MILLISECONDS)
                .exceptionallyCompose(error ->
                        error instanceof TimeoutException ? abortStart() : CompletableFuture.failedFuture(error)));
    }

    private ProviderException notStarted(String why, Throwable cause) {
        return new ProviderException(commandLine() + " cannot be started: " + why, cause);
    }

    /**
     * Ends a process whose start has timed out. The future fails only after the process has ended, so that a
     * replacement does not run beside it.
     */
    private CompletableFuture<@Nullable Void> abortStart() {
        terminating = true;
        return end().handle((ended, left) -> {
            var why = new ProviderException(commandLine() + " has written no line in " + settings.startLimit()
                    + ", expected one when it is ready" + lastErrors());
            if (left != null) {
                why.addSuppressed(left);
            }
            throw why;
        });
    }

    private void awaitExit(ProcessTree ofProgram, Signals<?> signals, Thread... readers) {
        final int status;
        try {
            status = ofProgram.root().waitFor();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            return;
        }
        List<Throwable> errorsOnExit = new ArrayList<>();
        attempt(() -> reportOrphans(ofProgram, status, signals), errorsOnExit);
        // remaining processes are reported by the termination of the component
        attempt(() -> end().handle((ended, left) -> null).join(), errorsOnExit);
        for (Thread reader : readers) {
            attempt(() -> awaitLastLines(reader, signals), errorsOnExit);
        }
        attempt(() -> reportUnwritten(signals), errorsOnExit);
        removeShutdownHook();
        var why = new ProviderException(commandLine() + " ended with status " + status + lastErrors());
        errorsOnExit.forEach(why::addSuppressed);
        firstLine.completeExceptionally(why);
        treeEnded.complete(null);
        if (!terminating) {
            signals.failed(why);
        }
    }

    /**
     * Runs a step and records its exception. A failed step must not prevent the report of the exit, on which starts and
     * health checks wait.
     */
    private static void attempt(Runnable step, List<Throwable> errorsOnExit) {
        try {
            step.run();
        } catch (RuntimeException | Error error) {
            errorsOnExit.add(error);
        }
    }

    private void reportOrphans(ProcessTree ofProgram, int status, Signals<?> signals) {
        var orphans = ofProgram.alive();
        if (!orphans.isEmpty() && !terminating) {
            signals.info(commandLine() + " has ended with status " + status
                    + ", before processes that it had started; these are ended too: " + describe(orphans));
        }
    }

    private void awaitLastLines(Thread reader, Signals<?> signals) {
        join(reader);
        if (reader.isAlive()) {
            signals.info(commandLine() + " has ended, but a process outside its session keeps its " + reader.getName()
                    + " open");
        }
    }

    private void join(Thread reader) {
        try {
            reader.join(settings.stopLimit());
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    private String lastErrors() {
        String last = errors.text();
        return last.isEmpty() ? "" : "; it printed: " + last;
    }

    private String commandLine() {
        return "\"" + String.join(" ", settings.command()) + "\"";
    }

    private Thread thread(String what, Runnable work) {
        return Thread.ofPlatform()
                .daemon()
                .name(what + " of " + settings.command().getFirst())
                .start(work);
    }

    private void read(InputStream stream, String what, Signals<?> signals, Consumer<String> lines) {
        try (var reader = new InputStreamReader(stream, StandardCharsets.UTF_8)) {
            readLines(
                    reader,
                    lines,
                    () -> signals.info(commandLine() + " wrote a line of more than " + LONGEST_LINE_CHARACTERS
                            + " characters to its standard " + what + "; the rest of the line is lost"));
        } catch (IOException broken) {
            errors.add("(" + broken.getMessage() + ")");
        }
    }

    /**
     * Splits text into lines like {@link java.io.BufferedReader#readLine}, but cuts long lines, so that an endless line
     * takes bounded memory.
     */
    private static void readLines(Reader from, Consumer<String> lines, Runnable cut) throws IOException {
        var line = new StringBuilder();
        boolean skipping = false;
        boolean afterReturn = false;
        char[] chunk = new char[8192];
        for (int count = from.read(chunk); count >= 0; count = from.read(chunk)) {
            for (int i = 0; i < count; i++) {
                char c = chunk[i];
                boolean endsPair = c == '\n' && afterReturn;
                afterReturn = c == '\r';
                if (endsPair) {
                    continue;
                }
                if (c == '\n' || c == '\r') {
                    if (!skipping) {
                        lines.accept(line.toString());
                    }
                    line.setLength(0);
                    skipping = false;
                } else if (!skipping && line.length() == LONGEST_LINE_CHARACTERS) {
                    skipping = true;
                    boolean splitsCharacter = Character.isLowSurrogate(c);
                    lines.accept(line.substring(0, line.length() - (splitsCharacter ? 1 : 0)));
                    line.setLength(0);
                    cut.run();
                } else if (!skipping) {
                    line.append(c);
                }
            }
        }
        if (!line.isEmpty()) {
            lines.accept(line.toString());
        }
    }

    private void write(Process to, Signals<?> signals) {
        try (Writer writer = to.outputWriter(StandardCharsets.UTF_8)) {
            while (to.isAlive()) {
                String line = input.poll(1, TimeUnit.SECONDS);
                if (line != null) {
                    writer.write(line + "\n");
                    writer.flush();
                }
            }
        } catch (IOException closed) {
            if (to.isAlive() && !terminating) { // otherwise the exit is reported
                signals.info(commandLine() + " reads its standard input no more: " + closed.getMessage());
            }
        } catch (InterruptedException gone) {
            Thread.currentThread().interrupt();
        }
    }

    private void reportUnwritten(Signals<?> signals) {
        List<String> rest = new ArrayList<>();
        input.drainTo(rest);
        if (!rest.isEmpty()) {
            signals.info(rest.size() + " lines for " + commandLine() + " were not written to it");
        }
    }

    @Override
    public void data(String line) {
        if (!input.offer(line)) {
            throw new ProviderException(
                    commandLine() + " does not read its standard input: " + input.size() + " lines wait");
        }
    }

    /**
     * Ends the process and all processes that it started. The promise is rejected with the remaining processes if some
     * are alive {@link #KILL_LIMIT} after they were killed; the next call tries again.
     */
    @Override
    public Promise<@Nullable Void> terminate() {
        terminating = true;
        return tree == null ? Promise.done() : Promise.from(end());
    }

    /**
     * Shutdown hook: waits for a start in progress, then for the application to stop its components, and then ends the
     * process if it is still alive.
     */
    void endAtShutdown() {
        awaitAtShutdown(startAttempted, killLimit);
        if (tree == null) {
            terminating = true;
            return;
        }
        awaitAtShutdown(treeEnded, shutdownGrace);
        terminating = true;
        end().handle((ended, left) -> null).join();
    }

    private static void awaitAtShutdown(CompletableFuture<?> awaited, Duration limit) {
        try {
            awaited.get(TimeUnit.MILLISECONDS.convert(limit), TimeUnit.MILLISECONDS);
        } catch (TimeoutException | ExecutionException late) {
            // the process is ended anyway
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    private void removeShutdownHook() {
        try {
            Runtime.getRuntime().removeShutdownHook(shutdownHook);
        } catch (IllegalStateException shuttingDown) {
            // the hook is already running
        }
    }

    private synchronized CompletableFuture<@Nullable Void> end() {
        ProcessTree past = Objects.requireNonNull(tree);
        if (end == null || end.isCompletedExceptionally()) {
            var now = new CompletableFuture<@Nullable Void>();
            end = now;
            thread("end", () -> end(past, now));
        }
        return end;
    }

    private void end(ProcessTree past, CompletableFuture<@Nullable Void> ended) {
        try {
            var left = past.end(settings.stopLimit(), killLimit);
            if (left.isEmpty()) {
                ended.complete(null);
            } else {
                ended.completeExceptionally(new ProviderException(commandLine() + " was killed, and " + killLimit
                        + " later some of its processes are still alive: " + describe(left)));
            }
        } catch (RuntimeException | Error failure) {
            ended.completeExceptionally(failure);
        }
    }

    private static String describe(List<ProcessHandle> processes) {
        return processes.stream()
                .map(each -> each.pid()
                        + each.info().command().map(name -> " (" + name + ")").orElse(""))
                .collect(Collectors.joining(", "));
    }

    @Override
    public Promise<@Nullable Void> health() {
        ProcessTree asked = tree;
        if (asked != null && asked.root().isAlive()) {
            return Promise.done();
        }
        // waits for the end of the child processes: after the rejection, a broker starts another provider
        return Promise.from((asked == null ? CompletableFuture.completedFuture(null) : treeEnded).thenApply(ended -> {
            throw new ProviderException(commandLine() + " does not run" + lastErrors());
        }));
    }

    /** The last lines of a process's error output. Any thread. */
    private static final class Tail {
        private static final int LINES = 5;
        private static final int LINE_CHARACTERS = 200;

        private final Deque<String> lines = new ArrayDeque<>(); // guarded by this

        synchronized void add(String line) {
            if (lines.size() == LINES) {
                lines.remove();
            }
            lines.add(line.length() > LINE_CHARACTERS ? line.substring(0, LINE_CHARACTERS) + ".." : line);
        }

        /** The lines joined to one; empty if there are none. */
        synchronized String text() {
            return String.join(" | ", lines).strip();
        }
    }
}
