package io.troupe.demo.crowd;

import java.util.List;
import java.util.Locale;
import java.util.function.ToDoubleFunction;

/** Formats trials as a text table and as CSV. */
final class CrowdReport {
    /** Medians over the rounds of one size, with the extremes of the speed and the quartiles of the cost. */
    record Row(
            int robots,
            double timesRealTime,
            double slowest,
            double fastest,
            double timesByTheWall,
            double micros,
            double microsLower,
            double microsUpper,
            double worldMicros,
            double servicesMicros,
            double kilobytesPerRobot,
            double states) {}

    private static final String HEAD = """
                    times real time                              us of processor time
             robots   one core          (from .. to)     by the wall     robot and tick   world  services   kB per robot  states
            """;

    private final List<TrialResult> trials;

    CrowdReport(List<TrialResult> trials) {
        this.trials = List.copyOf(trials);
    }

    List<Row> medians() {
        return trials.stream()
                .map(TrialResult::robots)
                .distinct()
                .map(this::row)
                .toList();
    }

    private Row row(int robots) {
        List<TrialResult> rounds =
                trials.stream().filter(trial -> trial.robots() == robots).toList();
        double[] speeds = sorted(rounds, TrialResult::timesRealTimeOfOneCore);
        return new Row(
                robots,
                median(speeds),
                speeds[0],
                speeds[speeds.length - 1],
                median(sorted(rounds, TrialResult::timesRealTime)),
                median(sorted(rounds, TrialResult::micros)),
                quantile(sorted(rounds, TrialResult::micros), 0.25),
                quantile(sorted(rounds, TrialResult::micros), 0.75),
                median(sorted(rounds, TrialResult::worldMicros)),
                median(sorted(rounds, TrialResult::servicesMicros)),
                median(sorted(rounds, TrialResult::retainedKilobytesPerRobot)),
                median(sorted(rounds, TrialResult::states)));
    }

    private static double[] sorted(List<TrialResult> rounds, ToDoubleFunction<TrialResult> figure) {
        return rounds.stream().mapToDouble(figure).sorted().toArray();
    }

    private static double median(double[] sorted) {
        return quantile(sorted, 0.5);
    }

    /** Quantile with linear interpolation. */
    static double quantile(double[] sorted, double share) {
        double at = share * (sorted.length - 1);
        int below = (int) at;
        int above = Math.min(below + 1, sorted.length - 1);
        return sorted[below] + (at - below) * (sorted[above] - sorted[below]);
    }

    String table() {
        var text = new StringBuilder(HEAD);
        for (Row row : medians()) {
            String range = String.format(Locale.ROOT, "(%,.1f .. %,.1f)", row.slowest, row.fastest);
            text.append(String.format(
                    Locale.ROOT,
                    "%,7d%,11.1f%22s%,16.1f%19.2f%8.2f%10.2f%15.1f%8.0f%n",
                    row.robots,
                    row.timesRealTime,
                    range,
                    row.timesByTheWall,
                    row.micros,
                    row.worldMicros,
                    row.servicesMicros,
                    row.kilobytesPerRobot,
                    row.states));
        }
        return text.toString();
    }

    /** One line per trial. */
    String csv() {
        var text = new StringBuilder(
                "robots,ticks,wall_seconds,processor_seconds,times_real_time_of_one_core,times_real_time_by_the_wall,micros_per_robot_tick,world_micros,services_micros,retained_bytes,states\n");
        for (TrialResult trial : trials) {
            text.append(String.format(
                    Locale.ROOT,
                    "%d,%d,%.6f,%.6f,%.4f,%.4f,%.4f,%.4f,%.4f,%d,%d%n",
                    trial.robots(),
                    trial.ticks(),
                    trial.wallNanos() / 1e9,
                    trial.processorNanos() / 1e9,
                    trial.timesRealTimeOfOneCore(),
                    trial.timesRealTime(),
                    trial.micros(),
                    trial.worldMicros(),
                    trial.servicesMicros(),
                    trial.retainedBytes(),
                    trial.states()));
        }
        return text.toString();
    }
}
