package io.troupe.demo.terminal;

import static java.util.Objects.requireNonNull;

import io.troupe.sim.Snapshot;
import io.troupe.sim.model.WorldSpec;
import io.troupe.view.Pictures;
import io.troupe.view.RunLog;
import io.troupe.view.RunRecorder;
import java.io.IOException;
import java.nio.file.Path;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Model.CommandSpec;

/**
 * The picture and the log of a run without a table of services: {@code trajectory.svg} and {@code run.jsonl}.
 *
 * <p><b>Threads.</b> The one that advances the world.
 */
public final class RunFiles implements AutoCloseable {
    private final CommandSpec spec;
    private final Path directory;
    private final WorldSpec world;
    private final double seconds;
    private @Nullable RunLog log;
    private @Nullable RunRecorder recorder;
    private boolean isBegun;
    private boolean isFinished;

    /** @param seconds simulated time to run */
    public RunFiles(CommandSpec spec, Path directory, WorldSpec world, double seconds) {
        this.spec = spec;
        this.directory = directory;
        this.world = world;
        this.seconds = seconds;
    }

    /** Creates the directory and begins the log, when everything else has been checked. */
    public void open() throws IOException {
        OutputDirectory.make(spec, directory);
        log = new RunLog(directory.resolve("run.jsonl"));
        log.begin(world, seconds);
        recorder = new RunRecorder(world, log);
    }

    /** Records the world before the first tick, or after one. */
    public void record(Snapshot snapshot) {
        RunRecorder opened = requireNonNull(recorder, "not open");
        if (isBegun) {
            opened.record(snapshot);
        } else {
            opened.start(snapshot);
            isBegun = true;
        }
    }

    /**
     * Writes the end of the log, and the picture.
     *
     * @param cutShort whether the run was interrupted before its end
     * @return what was written, in words
     */
    public String finish(boolean cutShort) throws IOException {
        var result = requireNonNull(recorder, "not open").finish(cutShort);
        isFinished = true;
        Path picture = directory.resolve("trajectory.svg");
        OutputFiles.write(picture, Pictures.trajectory(world, result));
        return "wrote " + picture + " and " + directory.resolve("run.jsonl");
    }

    /** Closes the log, with a last line for a run that has failed. */
    @Override
    public void close() throws IOException {
        try {
            if (recorder != null && !isFinished) {
                recorder.fail();
            }
        } finally {
            if (log != null) {
                log.close();
            }
        }
    }
}
