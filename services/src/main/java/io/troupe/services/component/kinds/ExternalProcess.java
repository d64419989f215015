package io.troupe.services.component.kinds;

import io.troupe.actor.promise.Promise;
import io.troupe.services.broker.ProviderException;
import io.troupe.services.component.ComponentCommunication;
import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStream;
import java.io.InputStreamReader;
import java.io.Writer;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * The CCU of a process of the operating system.
 *
 * <p><b>Threads.</b> Daemon threads of its own: two read what the process writes, one writes what it is told; the actor space never waits for the process.
 */
final class ExternalProcess implements ComponentCommunication<String, String> {
    private final ProcessComponent.Settings settings;
    private final Tail errors = new Tail();
    private final BlockingQueue<String> input = new LinkedBlockingQueue<>(1024);
    private final CompletableFuture<@Nullable Void> firstLine = new CompletableFuture<>();
    private @Nullable Process process;
    private volatile boolean ending;

    ExternalProcess(ProcessComponent.Settings settings) {
        this.settings = settings;
    }

    @Override
    public Promise<@Nullable Void> invoke(Signals<? super String> signals) {
        Process begun;
        try {
            begun = new ProcessBuilder(settings.command())
                    .directory(settings.directory().toFile())
                    .start();
        } catch (IOException e) {
            return Promise.failed(new ProviderException(
                    words() + " cannot be started: "
                            + String.valueOf(e.getMessage()).strip(),
                    e));
        }
        process = begun;
        signals.tell("process " + begun.pid() + ": " + words());
        Thread readErrors = thread("stderr", () -> read(begun.getErrorStream(), errors::add));
        Thread readOutput = thread(
                "stdout",
                () -> read(begun.getInputStream(), line -> {
                    firstLine.complete(null);
                    signals.data(line);
                }));
        thread("stdin", () -> write(begun, signals));
        begun.onExit().thenRunAsync(() -> ended(begun, signals, readErrors, readOutput), task -> thread("exit", task));
        return Promise.from(firstLine
                .orTimeout(settings.startLimit().toMillis(), TimeUnit.MILLISECONDS)
                .exceptionally(error -> {
                    throw error instanceof ProviderException said
                            ? said
                            : new ProviderException(words() + " has written no line in " + settings.startLimit()
                                    + ", expected one when it is ready" + said());
                }));
    }

    private void ended(Process past, Signals<?> signals, Thread... readers) {
        for (Thread reader : readers) {
            try {
                reader.join(settings.stopLimit()); // its last words; a child of the process may keep the pipe open
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
            }
        }
        var why = new ProviderException(words() + " ended with status " + past.exitValue() + said());
        firstLine.completeExceptionally(why);
        tellUnwritten(signals);
        if (!ending) {
            signals.failed(why);
        }
    }

    private String said() {
        String last = errors.text();
        return last.isEmpty() ? "" : "; it said: " + last;
    }

    private String words() {
        return "\"" + String.join(" ", settings.command()) + "\"";
    }

    private Thread thread(String what, Runnable work) {
        return Thread.ofPlatform()
                .daemon()
                .name(what + " of " + settings.command().getFirst())
                .start(work);
    }

    private void read(InputStream stream, Consumer<String> lines) {
        try (var reader = new BufferedReader(new InputStreamReader(stream, StandardCharsets.UTF_8))) {
            for (String line = reader.readLine(); line != null; line = reader.readLine()) {
                lines.accept(line);
            }
        } catch (IOException broken) {
            errors.add("(" + broken.getMessage() + ")");
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
            if (to.isAlive() && !ending) { // else its exit says all
                signals.tell(words() + " reads its standard input no more: " + closed.getMessage());
            }
        } catch (InterruptedException gone) {
            Thread.currentThread().interrupt();
        }
    }

    private void tellUnwritten(Signals<?> signals) {
        List<String> rest = new ArrayList<>();
        input.drainTo(rest);
        if (!rest.isEmpty()) {
            signals.tell(rest.size() + " lines for " + words() + " were not written to it");
        }
    }

    @Override
    public void data(String line) {
        if (!input.offer(line)) {
            throw new ProviderException(words() + " does not read its standard input: " + input.size() + " lines wait");
        }
    }

    @Override
    public Promise<@Nullable Void> terminate() {
        ending = true;
        Process past = process;
        if (past == null || !past.isAlive()) {
            return Promise.done();
        }
        List<ProcessHandle> family =
                new ArrayList<>(past.descendants().toList()); // those of a script that starts programs
        family.add(past.toHandle());
        family.forEach(ProcessHandle::destroy);
        return Promise.from(ends(family)
                .orTimeout(settings.stopLimit().toMillis(), TimeUnit.MILLISECONDS)
                .exceptionallyCompose(deaf -> {
                    family.forEach(ProcessHandle::destroyForcibly);
                    return ends(family);
                }));
    }

    private static CompletableFuture<@Nullable Void> ends(List<ProcessHandle> family) {
        return CompletableFuture.allOf(
                        family.stream().map(ProcessHandle::onExit).toArray(CompletableFuture<?>[]::new))
                .thenApply(gone -> null);
    }

    @Override
    public Promise<@Nullable Void> health() {
        Process asked = process;
        return asked != null && asked.isAlive()
                ? Promise.done()
                : Promise.failed(new ProviderException(words() + " does not run" + said()));
    }
}
