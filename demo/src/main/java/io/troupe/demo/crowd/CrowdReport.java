package io.troupe.demo.crowd;

import io.troupe.tools.SampleStatistics;
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

    private final List<CrowdTrial.Result> trials;

    CrowdReport(List<CrowdTrial.Result> trials) {
        this.trials = List.copyOf(trials);
    }

    List<Row> medians() {
        return trials.stream()
                .map(CrowdTrial.Result::robots)
                .distinct()
                .map(this::row)
                .toList();
    }

    private Row row(int robots) {
        List<CrowdTrial.Result> rounds =
                trials.stream().filter(trial -> trial.robots() == robots).toList();
        var speeds = of(rounds, CrowdTrial.Result::timesRealTimeOfOneCore);
        var micros = of(rounds, CrowdTrial.Result::micros);
        return new Row(
                robots,
                speeds.median(),
                speeds.least(),
                speeds.most(),
                median(rounds, CrowdTrial.Result::timesRealTime),
                micros.median(),
                micros.lowerQuartile(),
                micros.upperQuartile(),
                median(rounds, CrowdTrial.Result::worldMicros),
                median(rounds, CrowdTrial.Result::servicesMicros),
                median(rounds, CrowdTrial.Result::retainedKilobytesPerRobot),
                median(rounds, CrowdTrial.Result::states));
    }

    private static SampleStatistics of(List<CrowdTrial.Result> rounds, ToDoubleFunction<CrowdTrial.Result> figure) {
        return SampleStatistics.of(rounds.stream().mapToDouble(figure).toArray());
    }

    private static double median(List<CrowdTrial.Result> rounds, ToDoubleFunction<CrowdTrial.Result> figure) {
        return of(rounds, figure).median();
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
        for (CrowdTrial.Result trial : trials) {
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
