package io.troupe.bench;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.PrintStream;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

/**
 * The coordinator's end of a {@link ContenderProcess}. Between two requests that process waits, and uses no processor.
 */
final class ContenderPipe implements AutoCloseable {
    private static final int PATIENCE_SECONDS = 60;

    private final String name;
    private final Process process;
    private final PrintStream questions;
    private final BufferedReader answers;

    ContenderPipe(String name) throws IOException {
        this.name = name;
        var java = Path.of(System.getProperty("java.home"), "bin", "java").toString();
        var command = List.of(
                java,
                "-Xmx512m",
                "-XX:+UseG1GC",
                "-Dslf4j.internal.verbosity=ERROR", // Pekko is used without a logger on purpose
                "-cp",
                System.getProperty("java.class.path"),
                ContenderProcess.class.getName(),
                name);
        process = new ProcessBuilder(command)
                .redirectError(ProcessBuilder.Redirect.INHERIT)
                .start();
        questions = new PrintStream(process.getOutputStream(), true, StandardCharsets.UTF_8);
        answers = process.inputReader(StandardCharsets.UTF_8);
        answer("ready");
    }

    String name() {
        return name;
    }

    /** Warms up; returns how many operations fill a turn. */
    int warm(Workload workload, int millis) throws IOException {
        return Integer.parseInt(ask("warm " + workload.label() + " " + millis));
    }

    TurnResult turn(Workload workload, int operations) throws IOException {
        return TurnResult.parse(ask("turn " + workload.label() + " " + operations));
    }

    /** The bytes of the heap that an actor retains. */
    double retainedBytes() throws IOException {
        return Double.parseDouble(ask("retained"));
    }

    private String ask(String question) throws IOException {
        questions.println(question);
        return answer(question);
    }

    private String answer(String question) throws IOException {
        var answer = CompletableFuture.supplyAsync(this::line);
        try {
            String line = answer.get(PATIENCE_SECONDS, TimeUnit.SECONDS);
            if (line.isEmpty()) {
                throw new IOException(name + " ended at: " + question);
            }
            return line;
        } catch (TimeoutException late) {
            throw new IOException(name + " did not answer in " + PATIENCE_SECONDS + " s: " + question, late);
        } catch (InterruptedException | ExecutionException failure) {
            throw new IOException(name + " cannot be read at: " + question, failure);
        }
    }

    private String line() {
        try {
            var line = answers.readLine();
            return line == null ? "" : line;
        } catch (IOException failure) {
            throw new UncheckedIOException(failure);
        }
    }

    /** Ends the process, even one that hangs. */
    @Override
    public void close() throws IOException {
        questions.close();
        try {
            if (!process.waitFor(5, TimeUnit.SECONDS)) {
                process.destroyForcibly();
            }
        } catch (InterruptedException interrupted) {
            process.destroyForcibly();
            Thread.currentThread().interrupt();
        }
    }
}
