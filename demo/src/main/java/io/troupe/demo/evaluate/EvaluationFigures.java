package io.troupe.demo.evaluate;

import io.troupe.common.text.Plural;
import io.troupe.demo.evaluate.Measurement.Kind;
import io.troupe.demo.evaluate.Measurement.Quantity;
import io.troupe.demo.svg.Chart;
import io.troupe.demo.svg.Chart.Anchor;
import io.troupe.drawing.Svg;
import io.troupe.services.subsumption.Mode;
import io.troupe.tools.SampleStatistics;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.stream.Collectors;

/** Draws the paper's figures from our measurements: elapsed robot time on the left, computing time on the right. */
final class EvaluationFigures {
    private static final List<String> SUBJECTS = List.of(Measurement.FOLLOWER, Measurement.WANDERER, Measurement.BOTH);
    private static final List<String> PASSING = List.of("wall follower", "space wanderer", "both");
    private static final List<String> COMPUTING = List.of("wall follower", "space wanderer", "both, with messages");
    /** Colours that colour-blind readers can distinguish. */
    private static final List<Integer> COLOURS = List.of(0x4477AA, 0xDDAA33, 0x228833, 0x66CCEE, 0xAA3377);

    private final Evaluation.Settings settings;
    private final Measurements measurements;

    EvaluationFigures(Evaluation.Settings settings, Measurements measurements) {
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
                    "JVM with " + Plural.of(cores, "core"), mode, cores, COLOURS.get(series.size() % COLOURS.size())));
        }
        Bars last = series.getLast();
        String title = String.format(
                Locale.ROOT,
                "%s: both services take %s, the wall follower %s and the space wanderer %s",
                mode,
                seconds(last, Measurement.BOTH),
                seconds(last, Measurement.FOLLOWER),
                seconds(last, Measurement.WANDERER));
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
        charts.put("evaluation-" + figure, chart(title, figure, ", on a JVM with " + Plural.of(cores, "core"), series));
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
                "Computing time, µs for a loop" + (repeated() ? ": medians and quartiles" : ", measured once"),
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
        return measurements.statistics(Kind.LOOPS, bars.mode, bars.cores, subject, quantity);
    }

    /**
     * A bar chart: groups of bars over labels, each bar with its value. Several panels stand side by side under one
     * title.
     */
    private static final class BarPanel {
        private static final int WIDTH_PX = 500;
        private static final int HEIGHT_PX = 400;
        private static final int MARGIN_PX = 20;
        private static final int AXIS_PX = 56;
        private static final int TOP_PX = 110;
        private static final int BOTTOM_PX = 330;
        /** Share of a label's width that its bars take. */
        private static final double GROUP = 0.8;

        private static final int INK = 0x222222;
        private static final int GREY = 0x666666;
        private static final int GRID = 0xdddddd;

        /** A bar and its error bar from {@code lower} to {@code upper}, which is omitted if the two are equal. */
        record Bar(double value, double lower, double upper) {
            static Bar of(double value) {
                return new Bar(value, value, value);
            }

            static Bar of(SampleStatistics statistics) {
                return new Bar(statistics.median(), statistics.lowerQuartile(), statistics.upperQuartile());
            }
        }

        private record Series(String name, int colour, List<Bar> bars) {}

        private final String title;
        private final List<String> labels;
        private final List<Series> series = new ArrayList<>();

        BarPanel(String title, List<String> labels) {
            this.title = title;
            this.labels = labels;
        }

        /** @param bars one per label */
        void add(String name, int colour, List<Bar> bars) {
            series.add(new Series(name, colour, bars));
        }

        static Chart chart(String title, String subtitle, List<BarPanel> panels) {
            var chart = new Chart(MARGIN_PX + panels.size() * WIDTH_PX, HEIGHT_PX, title);
            chart.text(MARGIN_PX, 30, 17, Anchor.START, INK, title);
            chart.text(MARGIN_PX, 52, 12, Anchor.START, GREY, subtitle);
            for (int i = 0; i < panels.size(); i++) {
                panels.get(i).draw(chart, MARGIN_PX + i * WIDTH_PX);
            }
            return chart;
        }

        private void draw(Chart chart, double left) {
            chart.text(left, TOP_PX - 26, 13, Anchor.START, INK, title);
            double most = series.stream()
                    .flatMap(each -> each.bars.stream())
                    .mapToDouble(bar -> Math.max(bar.value, bar.upper))
                    .max()
                    .orElse(1);
            double step = Svg.roundStep(Math.max(most, 1e-9) / 5);
            double top = step * Math.ceil(most / step - 1e-9);
            double pixels = (BOTTOM_PX - TOP_PX) / top;
            for (int i = 0; i * step <= top * (1 + 1e-9); i++) {
                double y = BOTTOM_PX - i * step * pixels;
                chart.line(left + AXIS_PX, y, left + WIDTH_PX - MARGIN_PX, y, i == 0 ? INK : GRID, 1);
                chart.text(left + AXIS_PX - 8, y + 4, 12, Anchor.END, INK, number(i * step));
            }
            double room = (WIDTH_PX - AXIS_PX - MARGIN_PX) / (double) labels.size();
            double wide = room * GROUP / series.size();
            for (int label = 0; label < labels.size(); label++) {
                double middle = left + AXIS_PX + (label + 0.5) * room;
                chart.text(middle, BOTTOM_PX + 18, 12, Anchor.MIDDLE, INK, labels.get(label));
                for (int i = 0; i < series.size(); i++) {
                    bar(
                            chart,
                            middle - room * GROUP / 2 + i * wide,
                            wide,
                            pixels,
                            series.get(i).bars.get(label),
                            series.get(i).colour);
                }
            }
            legend(chart, left + AXIS_PX);
        }

        private static void bar(Chart chart, double x, double wide, double pixels, Bar bar, int colour) {
            double y = BOTTOM_PX - bar.value * pixels;
            chart.bar(x + 1, y, wide - 2, bar.value * pixels, colour);
            double middle = x + wide / 2;
            double highest = BOTTOM_PX - Math.max(bar.value, bar.upper) * pixels;
            if (bar.lower < bar.upper) {
                double lower = BOTTOM_PX - bar.lower * pixels;
                double upper = BOTTOM_PX - bar.upper * pixels;
                chart.line(middle, lower, middle, upper, INK, 1.2);
                chart.line(middle - 4, upper, middle + 4, upper, INK, 1.2);
                chart.line(middle - 4, lower, middle + 4, lower, INK, 1.2);
            }
            chart.text(middle, highest - 5, 11, Anchor.MIDDLE, INK, number(bar.value));
        }

        private void legend(Chart chart, double left) {
            double x = left;
            for (Series each : series) {
                chart.bar(x, BOTTOM_PX + 36, 14, 14, each.colour);
                chart.text(x + 20, BOTTOM_PX + 48, 12, Anchor.START, INK, each.name);
                x += 20 + Svg.width(each.name, 12) + 22;
            }
        }

        /** Formats with about three significant digits and without trailing zeros. */
        static String number(double value) {
            String text = String.format(Locale.ROOT, value >= 100 ? "%,.0f" : value >= 10 ? "%.1f" : "%.2f", value);
            return text.contains(".") ? text.replaceFirst("\\.?0+$", "") : text;
        }
    }
}
