package io.troupe.bench.worlds;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.PrintStream;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.TimeUnit;

/** The coordinator's end of a {@link WorldProcess}. Between two requests that process waits, and uses no processor. */
final class WorldPipe implements AutoCloseable {
    private final WorldKind kind;
    private final Process process;
    private final PrintStream questions;
    private final BufferedReader answers;

    WorldPipe(WorldKind kind) throws IOException {
        this.kind = kind;
        var java = Path.of(System.getProperty("java.home"), "bin", "java").toString();
        process = new ProcessBuilder(List.of(
                        java,
                        "-Xmx2g",
                        "-XX:+UseSerialGC", // one thread, including the collector
                        "-cp",
                        System.getProperty("java.class.path"),
                        WorldProcess.class.getName(),
                        kind.label()))
                .redirectError(ProcessBuilder.Redirect.INHERIT)
                .start();
        questions = new PrintStream(process.getOutputStream(), true, StandardCharsets.UTF_8);
        answers = process.inputReader(StandardCharsets.UTF_8);
        answer("start");
    }

    WorldKind kind() {
        return kind;
    }

    double retainedBytes(int robotCount) throws IOException {
        return Double.parseDouble(ask("retained " + robotCount));
    }

    void build(int robotCount) throws IOException {
        ask("build " + robotCount);
    }

    WorldTurn turn(int millis) throws IOException {
        return WorldTurn.parse(ask("turn " + millis));
    }

    void drop() throws IOException {
        ask("drop");
    }

    private String ask(String question) throws IOException {
        questions.println(question);
        return answer(question);
    }

    private String answer(String question) throws IOException {
        String line = answers.readLine();
        if (line == null) {
            throw new IOException(kind.label() + " ended at: " + question);
        }
        return line;
    }

    /** Ends the process. */
    @Override
    public void close() {
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
