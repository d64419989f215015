package io.troupe.demo.crowd;

import java.util.List;
import java.util.Locale;
import java.util.function.ToDoubleFunction;

/** Trials as a table for people and as CSV. */
final class CrowdReport {
    /** Medians of the rounds of one size, and the least and greatest speed. */
    record Row(
            int robots,
            double timesRealTime,
            double slowest,
            double fastest,
            double micros,
            double worldMicros,
            double servicesMicros,
            double kilobytesPerRobot,
            double states) {}

    private static final String HEAD =
            " robots   x real time (slowest .. fastest)     us per robot and tick: all   world  services   kB per robot   states";

    private final List<Trial> trials;

    CrowdReport(List<Trial> trials) {
        this.trials = List.copyOf(trials);
    }

    List<Row> medians() {
        return trials.stream().map(Trial::robots).distinct().map(this::row).toList();
    }

    private Row row(int robots) {
        List<Trial> rounds =
                trials.stream().filter(trial -> trial.robots() == robots).toList();
        double[] speeds = sorted(rounds, Trial::timesRealTime);
        return new Row(
                robots,
                median(speeds),
                speeds[0],
                speeds[speeds.length - 1],
                median(sorted(rounds, Trial::microsPerRobotAndTick)),
                median(sorted(rounds, Trial::worldMicros)),
                median(sorted(rounds, Trial::servicesMicros)),
                median(sorted(rounds, Trial::retainedKilobytesPerRobot)),
                median(sorted(rounds, Trial::states)));
    }

    private static double[] sorted(List<Trial> rounds, ToDoubleFunction<Trial> figure) {
        return rounds.stream().mapToDouble(figure).sorted().toArray();
    }

    private static double median(double[] sorted) {
        int middle = sorted.length / 2;
        return sorted.length % 2 == 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
    }

    String table() {
        var text = new StringBuilder(HEAD).append(System.lineSeparator());
        for (Row row : medians()) {
            text.append(String.format(
                            Locale.ROOT,
                            "%,7d %,13.1f (%,.1f .. %,.1f)%s%8.2f%8.2f%10.2f%15.1f%9.0f",
                            row.robots,
                            row.timesRealTime,
                            row.slowest,
                            row.fastest,
                            " ".repeat(Math.max(1, 36 - String.format(Locale.ROOT, " (%,.1f .. %,.1f)", row.slowest, row.fastest).length())),
                            row.micros,
                            row.worldMicros,
                            row.servicesMicros,
                            row.kilobytesPerRobot,
                            row.states))
                    .append(System.lineSeparator());
        }
        return text.toString();
    }

    /** A line for each trial. */
    String csv() {
        var text = new StringBuilder(
                "robots,ticks,wall_seconds,times_real_time,micros_per_robot_tick,world_micros,services_micros,retained_bytes,states\n");
        for (Trial trial : trials) {
            text.append(String.format(
                    Locale.ROOT,
                    "%d,%d,%.6f,%.4f,%.4f,%.4f,%.4f,%d,%d%n",
                    trial.robots(),
                    trial.ticks(),
                    trial.wallNanos() / 1e9,
                    trial.timesRealTime(),
                    trial.microsPerRobotAndTick(),
                    trial.worldMicros(),
                    trial.servicesMicros(),
                    trial.retainedBytes(),
                    trial.states()));
        }
        return text.toString();
    }
}
