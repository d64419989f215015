package io.troupe.demo.evaluate;

import io.troupe.demo.svg.Chart;
import io.troupe.services.subsumption.Mode;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Collectors;

/** Draws the paper's figures from our measurements: elapsed robot time on the left, computing time on the right. */
final class EvaluationFigures {
    private static final List<String> SUBJECTS =
            List.of(CoreMeasurements.FOLLOWER, CoreMeasurements.WANDERER, Measurement.BOTH);
    private static final List<String> PASSING = List.of("wall follower", "space wanderer", "both");
    private static final List<String> COMPUTING = List.of("wall follower", "space wanderer", "both, with messages");
    /** Colours that colour-blind readers can distinguish. */
    private static final List<Integer> COLOURS = List.of(0x4477AA, 0xDDAA33, 0x228833, 0x66CCEE, 0xAA3377);

    private final EvaluationSettings settings;
    private final Measurements measurements;

    EvaluationFigures(EvaluationSettings settings, Measurements measurements) {
        this.settings = settings;
        this.measurements = measurements;
    }

    /** One series of bars. */
    private record Bars(String name, Mode mode, int cores, int colour) {}

    /** The figures for which all measurements exist, by file name. */
    Map<String, Chart> charts() {
        Map<String, Chart> charts = new LinkedHashMap<>();
        byCores(charts, 15, Mode.SYNC);
        byCores(charts, 18, Mode.CALLBACK);
        byCores(charts, 21, Mode.PROMISE);
        byMode(charts, 22, List.of(Mode.CALLBACK, Mode.PROMISE));
        byMode(charts, 23, List.of(Mode.values()));
        return charts;
    }

    /** @return the file names */
    List<String> write(Path directory) throws IOException {
        Chart.checkFonts();
        var names = new ArrayList<String>();
        for (var figure : charts().entrySet()) {
            figure.getValue().write(directory, figure.getKey());
            names.add(figure.getKey());
        }
        return names;
    }

    private void byCores(Map<String, Chart> charts, int figure, Mode mode) {
        if (!settings.modes().contains(mode)) {
            return;
        }
        List<Bars> series = new ArrayList<>();
        for (int cores : settings.cores()) {
            series.add(new Bars(
                    "JVM with " + CoreMeasurements.cores(cores),
                    mode,
                    cores,
                    COLOURS.get(series.size() % COLOURS.size())));
        }
        Bars last = series.getLast();
        String title = CoreMeasurements.format(
                "%s: both services take %s, the wall follower %s and the space wanderer %s",
                mode,
                seconds(last, Measurement.BOTH),
                seconds(last, CoreMeasurements.FOLLOWER),
                seconds(last, CoreMeasurements.WANDERER));
        charts.put("evaluation-" + figure, chart(title, figure, "", series));
    }

    private void byMode(Map<String, Chart> charts, int figure, List<Mode> modes) {
        if (!settings.modes().containsAll(modes)) {
            return;
        }
        int cores = settings.cores().getLast();
        List<Bars> series = modes.stream()
                .map(mode -> new Bars(mode.toString(), mode, cores, COLOURS.get(mode.ordinal())))
                .toList();
        String title = series.stream()
                .map(bars -> bars.name() + " " + seconds(bars, Measurement.BOTH))
                .collect(Collectors.joining(", ", "Both services take: ", ""));
        charts.put(
                "evaluation-" + figure,
                chart(title, figure, ", on a JVM with " + CoreMeasurements.cores(cores), series));
    }

    private String seconds(Bars bars, String subject) {
        return BarPanel.number(statistics(bars, subject, Quantity.TIME).median() / 1000) + " s";
    }

    private Chart chart(String title, int figure, String machine, List<Bars> series) {
        String time = settings.realTime() ? "Real time" : "Simulated time";
        String subtitle =
                "Figure " + figure + " of the paper, " + settings.loops() + " loops of each service" + machine;
        var passing = new BarPanel(time + ", s for " + settings.loops() + " loops", PASSING);
        var computing = new BarPanel(
                "Computing time, µs for a loop"
                        + (repeated() ? ": medians, thin lines from quartile to quartile" : ", measured once"),
                COMPUTING);
        for (Bars bars : series) {
            passing.add(
                    bars.name,
                    bars.colour,
                    SUBJECTS.stream()
                            .map(subject -> statistics(bars, subject, Quantity.TIME))
                            .map(millis -> BarPanel.Bar.of(millis.median() / 1000))
                            .toList());
            computing.add(
                    bars.name,
                    bars.colour,
                    SUBJECTS.stream()
                            .map(subject -> statistics(
                                    bars, subject, subject.equals(Measurement.BOTH) ? Quantity.TURN : Quantity.CYCLE))
                            .map(micros -> repeated() ? BarPanel.Bar.of(micros) : BarPanel.Bar.of(micros.median()))
                            .toList());
        }
        return BarPanel.chart(title, subtitle, List.of(passing, computing));
    }

    /** With a single repetition the spread is unknown, and no error bars are drawn. */
    private boolean repeated() {
        return settings.repetitions() > 1;
    }

    private SampleStatistics statistics(Bars bars, String subject, Quantity quantity) {
        return measurements.statistics(MeasurementKind.LOOPS, bars.mode, bars.cores, subject, quantity);
    }
}
