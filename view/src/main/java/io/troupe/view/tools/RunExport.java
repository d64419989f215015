package io.troupe.view.tools;

import io.troupe.sim.Contact;
import io.troupe.sim.RecordingException;
import io.troupe.sim.Replay;
import io.troupe.sim.Snapshot;
import io.troupe.sim.model.WorldSpec;
import io.troupe.view.tools.RunListener.Level;
import io.troupe.view.tools.RunListener.Reading;
import io.troupe.view.tools.RunListener.Remark;
import io.troupe.view.tools.RunListener.Touch;
import java.io.BufferedOutputStream;
import java.io.Closeable;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.charset.CharacterCodingException;
import java.nio.charset.StandardCharsets;
import java.nio.file.FileSystemException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Set;
import org.jspecify.annotations.Nullable;

/**
 * A run that is written in formats of other tools: {@code run.jsonl}, or a recording of {@code troupe serve --record}.
 *
 * {@snippet :
 * var run = new RunExport(folder.resolve("run.jsonl"), scenario.world());
 * run.writeMcap(folder.resolve("run.mcap"));
 * run.writeCsv(folder.resolve("tables"));
 * }
 *
 * <p><b>Role.</b> {@code docs/guide} describes the channels of the MCAP file and the tables.
 *
 * <p><b>Units and shapes.</b> A {@code run.jsonl} has no sensor readings; these are computed from the poses and the
 * world, without the noise of lasers and rangers; only states of grippers are in it. A recording is played again, and
 * has no services and states.
 *
 * <p><b>Order.</b> The same run gives the same files, byte for byte.
 *
 * <p><b>Errors.</b> {@link RunFileException} for a file that is no run, or a run in another world. {@link IOException},
 * with the name of the file, if one cannot be read or written; then none is left half written.
 */
public final class RunExport {
    private static final String RECORDING = "troupe-recording";

    private final Path run;
    private final WorldSpec world;

    /**
     * What has been written.
     *
     * @param endMicros time of the last reading
     * @param remarks about what is missing in the run; empty for a complete one
     */
    public record Report(long readings, long endMicros, List<String> remarks) {}

    /** @param world in which the run was */
    public RunExport(Path run, WorldSpec world) {
        this.run = run;
        this.world = world;
    }

    /** Writes a file that Foxglove, Lichtblick and the MCAP libraries read. */
    public Report writeMcap(Path file) throws IOException {
        return writeMcap(file, FoxgloveChannels.sensorsUnlessMany(world));
    }

    /**
     * As above, with the sensors of chosen robots only.
     *
     * @param sensorsOf their indices; all robots of a world with at most ten, and none of a larger one, unless given
     */
    public Report writeMcap(Path file, Set<Integer> sensorsOf) throws IOException {
        sensorsOf.forEach(robot -> Objects.checkIndex(robot, world.robots().size()));
        return write(
                () -> new McapExport(world, sensorsOf, new BufferedOutputStream(Files.newOutputStream(file))),
                file,
                List.of(file));
    }

    /**
     * Writes tables for spreadsheets and plotting programs: {@code poses.csv}, {@code ranges.csv}, {@code blobs.csv},
     * {@code states.csv}, {@code contacts.csv} and {@code log.csv}; and, if there are such devices,
     * {@code intensities.csv}, {@code fiducials.csv}, {@code bumpers.csv} and {@code grippers.csv}.
     *
     * @param directory is created if it is missing
     */
    public Report writeCsv(Path directory) throws IOException {
        List<Path> files = new ArrayList<>();
        return write(
                () -> {
                    Files.createDirectories(directory);
                    return new CsvExport(world, directory, files::add);
                },
                directory,
                files);
    }

    /** Opens the files, once the run has proved to be one. */
    private interface Opener<T extends RunListener & Closeable> {
        T open() throws IOException;
    }

    private <T extends RunListener & Closeable> Report write(Opener<T> opener, Path target, List<Path> files)
            throws IOException {
        var counting = new Counting<>(opener);
        try {
            List<String> remarks;
            try (counting) {
                remarks = isRecording(run) ? play(counting) : new RunLogReader(run, world, counting).read();
            }
            return new Report(counting.readings, counting.endMicros, remarks);
        } catch (IOException e) {
            if (counting.to != null) {
                delete(files, e);
            }
            throw counting.to == null ? e : named(target, e);
        } catch (RuntimeException e) {
            if (counting.to != null) {
                delete(files, e);
            }
            throw e;
        }
    }

    private static void delete(List<Path> files, Exception reason) {
        for (Path file : files) {
            try {
                if (Files.isRegularFile(file)) {
                    Files.delete(file);
                }
            } catch (IOException e) {
                reason.addSuppressed(e);
            }
        }
    }

    private static IOException named(Path file, IOException e) {
        String reason = e.getMessage() == null ? e.toString() : e.getMessage();
        return e instanceof FileSystemException || reason.contains(file.toString())
                ? e
                : new IOException(file + ": " + reason, e);
    }

    /** Opens the files late, and counts. */
    private static final class Counting<T extends RunListener & Closeable> implements RunListener, Closeable {
        private final Opener<T> opener;
        private @Nullable T to;
        private long readings;
        private long endMicros;

        Counting(Opener<T> opener) {
            this.opener = opener;
        }

        @Override
        public void begin(Map<String, String> header) throws IOException {
            to = opener.open();
            to.begin(header);
        }

        @Override
        public void read(Reading reading) throws IOException {
            readings++;
            endMicros = reading.snapshot().timeMicros();
            if (to != null) {
                to.read(reading);
            }
        }

        @Override
        public void happened(Event event) throws IOException {
            if (to != null) {
                to.happened(event);
            }
        }

        @Override
        public void close() throws IOException {
            if (to != null) {
                to.close();
            }
        }
    }

    // ---- recordings

    /** Whether a file is a recording of {@code troupe serve --record}, and not a {@code run.jsonl}. */
    public static boolean isRecording(Path run) throws IOException {
        try (var in = Files.newInputStream(run)) {
            byte[] first = in.readNBytes(RECORDING.length());
            return new String(first, StandardCharsets.ISO_8859_1).equals(RECORDING);
        }
    }

    private List<String> play(RunListener listener) throws IOException {
        try (var reader = Files.newBufferedReader(run)) {
            Replay replay = Replay.read(reader);
            Map<String, String> header = new LinkedHashMap<>();
            header.put("format", RECORDING);
            header.put("world", replay.worldName());
            header.put("robots", "" + world.robots().size());
            boolean[] begun = new boolean[1];
            replay.play(world, snapshot -> {
                try {
                    if (!begun[0]) {
                        begun[0] = true;
                        listener.begin(header);
                    }
                    played(snapshot, listener);
                } catch (IOException e) {
                    throw new UncheckedIOException(e);
                }
            });
            return List.of();
        } catch (CharacterCodingException e) {
            throw new RunFileException(run, "this is no text, expected a recording", e);
        } catch (RecordingException e) {
            throw new RunFileException(run, String.valueOf(e.getMessage()), e);
        } catch (UncheckedIOException e) {
            throw e.getCause();
        }
    }

    private void played(Snapshot snapshot, RunListener listener) throws IOException {
        for (Contact contact : snapshot.contacts()) {
            String robot = world.robots().get(contact.robot()).name();
            listener.happened(
                    new Touch(contact.timeMicros(), contact.robot() + 1, Reading.NO_SERVICE, contact.other()));
            listener.happened(new Remark(contact.timeMicros(), Level.WARNING, robot, "touches " + contact.other()));
        }
        List<String> services = Collections.nCopies(world.robots().size(), Reading.NO_SERVICE);
        listener.read(new Reading(snapshot, services, true));
    }
}
