package io.troupe.view.tools;

import io.troupe.sim.model.WorldSpec;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import org.jspecify.annotations.Nullable;

/** What was changed from outside in a recorded run, from its {@code run.jsonl}. */
public final class RecordedInterventions implements RunListener {
    /**
     * A change.
     *
     * @param words the command, as the log has it
     * @param line number of the line in the log
     */
    public record Timed(long timeMicros, String words, int line) {}

    private final Path log;
    private final Map<String, String> settings;
    private final List<Timed> found = new ArrayList<>();

    private RecordedInterventions(Path log, Map<String, String> settings) {
        this.log = log;
        this.settings = settings;
    }

    /**
     * Reads the changes of a run, in their order.
     *
     * @param settings what the header of the run must have, for example its seed
     * @throws RunFileException if the file is no run, or one in another world or with other settings
     */
    public static List<Timed> read(Path log, WorldSpec world, Map<String, String> settings) throws IOException {
        var interventions = new RecordedInterventions(log, settings);
        new RunLogReader(log, world, interventions).read();
        return interventions.found;
    }

    @Override
    public void begin(Map<String, String> header) {
        settings.forEach((name, expected) -> {
            String recorded = header.get(name);
            if (!isSame(expected, recorded)) {
                throw new RunFileException(
                        log,
                        1,
                        1,
                        "the " + name + " of the recorded run is " + (recorded == null ? "not given" : recorded)
                                + ", and that of this run " + expected
                                + ": expected the same, so that it can be repeated");
            }
        });
    }

    /** JSON has no numbers of 64 bits. */
    private static boolean isSame(String expected, @Nullable String recorded) {
        return expected.equals(recorded)
                || expected.matches("-?\\d+")
                        && Long.toString((long) Double.parseDouble(expected)).equals(recorded);
    }

    @Override
    public void read(Reading reading) {
        throw new IllegalStateException("no readings are wanted");
    }

    @Override
    public void happened(Event event) {
        // only changes count
    }

    @Override
    public boolean wantsReadings() {
        return false;
    }

    @Override
    public void changed(long timeMicros, String words, int line) {
        found.add(new Timed(timeMicros, words, line));
    }
}
