package io.troupe.view;

import io.troupe.sim.model.WorldSpec;
import java.io.BufferedWriter;
import java.io.IOException;
import java.nio.file.FileSystemException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.jspecify.annotations.Nullable;

/**
 * The file {@code run.jsonl}: one JSON object per line, in the order of simulated time. No value depends on the wall
 * clock. The format is described in {@code docs/run-log.md}.
 *
 * <p><b>Role.</b> A {@link RecordedRun} or a {@link RunRecorder} writes it.
 *
 * <p><b>Threads.</b> One at a time.
 *
 * <p><b>Errors.</b> A failed write does not end the run. {@link #close} throws the first failure, with the name of the
 * file.
 */
public final class RunLog implements AutoCloseable {
    /** Name and version of the program that writes the file. */
    public static final String PROGRAM = "Troupe 0.1.0-SNAPSHOT";

    /** Name of the format. */
    public static final String FORMAT = "troupe-run";

    /** Version of the format. It is incremented when readers of the previous one would misread the file. */
    public static final int VERSION = 1;

    private final Path file;
    private final BufferedWriter writer;
    private @Nullable IOException failure;

    /**
     * Creates the file, or empties it.
     *
     * @throws IOException if that is impossible; the message names the file
     */
    public RunLog(Path file) throws IOException {
        this.file = file;
        try {
            writer = Files.newBufferedWriter(file);
        } catch (IOException e) {
            throw named(e);
        }
    }

    /**
     * Writes the first line of the file. {@link RecordedRun} calls it; with a {@link RunRecorder} the caller does.
     *
     * @param settings of the run, as far as they hold for it
     */
    public void begin(WorldSpec world, RecordedRun.Settings settings) {
        write(header(world)
                .put("seed", settings.seed())
                .put("mode", settings.mode())
                .put("reconnect", settings.reconnects())
                .put("seconds", new Json.Fragment(Json.seconds(settings.endMicros())))
                .put("interval", new Json.Fragment(Json.seconds(world.intervalMillis() * 1000L))));
    }

    private static Json header(WorldSpec world) {
        return Json.line(0, "header")
                .put("format", FORMAT)
                .put("version", VERSION)
                .put("program", PROGRAM)
                .put("world", world.name())
                .put("robots", world.robots().size());
    }

    /** The same for a run without a table of services, which has no mode. */
    public void begin(WorldSpec world, double seconds) {
        write(header(world)
                .put("seconds", new Json.Fragment(Json.seconds(StrictMath.round(seconds * 1e6))))
                .put("interval", new Json.Fragment(Json.seconds(world.intervalMillis() * 1000L))));
    }

    /** The same for a run over hosts. */
    void begin(RecordedHostedRun.Settings settings) {
        write(Json.line(0, "header")
                .put("format", FORMAT)
                .put("version", VERSION)
                .put("program", PROGRAM)
                .put("world", settings.world().name())
                .put("robots", settings.world().robots().size())
                .put("robotsAt", settings.host() + ":" + settings.port())
                .put("mode", settings.mode())
                .put("seconds", new Json.Fragment(Json.seconds(settings.endMicros())))
                .put("interval", new Json.Fragment(Json.seconds(settings.world().intervalMillis() * 1000L))));
    }

    void write(Json line) {
        if (failure != null) {
            return;
        }
        try {
            writer.write(line.toString());
            writer.write('\n');
        } catch (IOException e) {
            failure = e;
        }
    }

    /** The error with the name of the file; that of a full disk has none. */
    private IOException named(IOException e) {
        String reason = e.getMessage() == null ? e.toString() : e.getMessage();
        return e instanceof FileSystemException ? e : new IOException(file + ": " + reason, e);
    }

    /**
     * Writes what is left, and closes the file.
     *
     * @throws IOException if a line could not be written, now or earlier
     */
    @Override
    public void close() throws IOException {
        try {
            writer.close();
        } catch (IOException e) {
            failure = failure == null ? e : failure;
        }
        if (failure != null) {
            throw named(failure);
        }
    }
}
