package io.troupe.view.tools;

import io.troupe.sim.Snapshot;
import java.io.IOException;
import java.util.List;
import java.util.Map;

/** Receives a run, in the order of simulated time. */
interface RunListener {
    /** @param header what is known about the whole run, for example its seed */
    void begin(Map<String, String> header) throws IOException;

    void read(Reading reading) throws IOException;

    void happened(Event event) throws IOException;

    /**
     * Something in the world is changed from outside.
     *
     * @param words the command, as the log has it
     * @param line number of the line in the log
     */
    default void changed(long timeMicros, String words, int line) {}

    /** False if {@link #read} need not be called, so that no sensors have to be computed. */
    default boolean wantsReadings() {
        return true;
    }

    /**
     * What the robots' sensors read at one time.
     *
     * @param services that control the robots, by robot; {@code none} and {@code several} are possible
     * @param hasSpeeds whether the odometry of the snapshot is known
     */
    record Reading(Snapshot snapshot, List<String> services, boolean hasSpeeds) {
        static final String NO_SERVICE = "none";
    }

    /** What happens between two readings. */
    sealed interface Event {
        long timeMicros();
    }

    /**
     * A state begins.
     *
     * @param robot that has seen the colour, from 1; 0 in the first state
     * @param colour {@code 0x00RRGGBB}
     * @param services by robot
     */
    record StateBegins(long timeMicros, int state, int robot, int colour, List<String> services) implements Event {}

    /**
     * A robot begins to touch something.
     *
     * @param robot from 1
     * @param other name of the obstacle, or of the other robot
     */
    record Touch(long timeMicros, int robot, String service, String other) implements Event {}

    /** Something else that belongs into a log. */
    record Remark(long timeMicros, Level level, String source, String text) implements Event {}

    /** A colour as text, for example {@code #ff0000}. */
    static String hex(int rgb) {
        return String.format("#%06x", rgb);
    }

    /** How serious a remark is. */
    enum Level {
        INFO,
        WARNING,
        ERROR
    }
}
