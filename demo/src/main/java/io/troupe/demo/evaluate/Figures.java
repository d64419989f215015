package io.troupe.demo.evaluate;

import io.troupe.services.subsumption.Mode;
import java.awt.Color;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.knowm.xchart.CategoryChart;
import org.knowm.xchart.CategoryChartBuilder;
import org.knowm.xchart.style.Styler.LegendLayout;
import org.knowm.xchart.style.Styler.LegendPosition;

/** The paper's figures again: on the left time as it passes for the robots, on the right computing time. */
final class Figures {
    private static final List<String> SUBJECTS = List.of(Findings.FOLLOWER, Findings.WANDERER, Measurement.BOTH);
    private static final List<String> PASSING = List.of("wall follower", "space wanderer", "both");
    private static final List<String> COMPUTING = List.of("wall follower", "space wanderer", "both, with messages");
    /** Told apart by people who see few colours. */
    private static final List<Color> COLOURS = List.of(
            new Color(0x4477AA), new Color(0xDDAA33), new Color(0x228833), new Color(0x66CCEE), new Color(0xAA3377));

    private final EvaluationSettings settings;
    private final Measurements measurements;

    Figures(EvaluationSettings settings, Measurements measurements) {
        this.settings = settings;
        this.measurements = measurements;
    }

    /** Bars that stand side by side over each label. */
    private record Bars(Mode mode, int cores, Color colour) {}

    /** Those for which everything was measured, by the name of their files. */
    Map<String, List<CategoryChart>> charts() {
        Map<String, List<CategoryChart>> charts = new LinkedHashMap<>();
        byCores(charts, 15, Mode.SYNC);
        byCores(charts, 18, Mode.CALLBACK);
        byCores(charts, 21, Mode.PROMISE);
        byMode(charts, 22, List.of(Mode.CALLBACK, Mode.PROMISE));
        byMode(charts, 23, List.of(Mode.values()));
        return charts;
    }

    /** @return the files' names */
    List<String> write(Path directory) throws IOException {
        FigurePainter.checkFonts();
        var names = new ArrayList<String>();
        for (var figure : charts().entrySet()) {
            FigurePainter.write(figure.getValue(), directory, figure.getKey());
            names.add(figure.getKey());
        }
        return names;
    }

    private void byCores(Map<String, List<CategoryChart>> charts, int figure, Mode mode) {
        if (settings.modes().contains(mode)) {
            Map<String, Bars> series = new LinkedHashMap<>();
            for (int cores : settings.cores()) {
                series.put(
                        "told " + Findings.cores(cores),
                        new Bars(mode, cores, COLOURS.get(series.size() % COLOURS.size())));
            }
            charts.put("evaluation-" + figure, panels("Figure " + figure + ", " + mode, series));
        }
    }

    private void byMode(Map<String, List<CategoryChart>> charts, int figure, List<Mode> modes) {
        if (settings.modes().containsAll(modes)) {
            int cores = settings.cores().getLast();
            Map<String, Bars> series = new LinkedHashMap<>();
            for (Mode mode : modes) {
                series.put(mode.toString(), new Bars(mode, cores, COLOURS.get(mode.ordinal())));
            }
            charts.put("evaluation-" + figure, panels("Figure " + figure + ", told " + Findings.cores(cores), series));
        }
    }

    private List<CategoryChart> panels(String title, Map<String, Bars> series) {
        String time = settings.realTime() ? "real time" : "simulated time";
        CategoryChart passing = chart(title + ": " + time, "ms for " + settings.loops() + " loops");
        passing.getStyler().setYAxisDecimalPattern("#,##0");
        CategoryChart computing = chart(
                title + ": computing time",
                "\u00b5s for a loop" + (repeated() ? " \u00b1 half the quartile distance" : ", measured once"));
        computing.getStyler().setYAxisDecimalPattern("#,##0.0#");
        series.forEach((name, bars) -> {
            Spread[] millis = spreads(bars, List.of(Quantity.TIME, Quantity.TIME, Quantity.TIME));
            passing.addSeries(name, PASSING, medians(millis)).setFillColor(bars.colour());
            Spread[] micros = spreads(bars, List.of(Quantity.CYCLE, Quantity.CYCLE, Quantity.TURN));
            var computed = repeated()
                    ? computing.addSeries(
                            name,
                            COMPUTING,
                            medians(micros),
                            Arrays.stream(micros).map(Spread::halfWidth).toList())
                    : computing.addSeries(name, COMPUTING, medians(micros));
            computed.setFillColor(bars.colour());
        });
        return List.of(passing, computing);
    }

    /** Else there is no spread, and a bar's error is not 0 but unknown. */
    private boolean repeated() {
        return settings.repetitions() > 1;
    }

    private Spread[] spreads(Bars bars, List<Quantity> quantities) {
        Spread[] spreads = new Spread[SUBJECTS.size()];
        Arrays.setAll(
                spreads,
                index -> measurements.spread(
                        Part.LOOPS, bars.mode(), bars.cores(), SUBJECTS.get(index), quantities.get(index)));
        return spreads;
    }

    private static List<Double> medians(Spread[] spreads) {
        return Arrays.stream(spreads).map(Spread::median).toList();
    }

    private static CategoryChart chart(String title, String unit) {
        var chart = new CategoryChartBuilder()
                .width(1)
                .height(1)
                .title(title)
                .yAxisTitle(unit)
                .build();
        var style = chart.getStyler();
        style.setLegendPosition(LegendPosition.OutsideS);
        style.setLegendLayout(LegendLayout.Horizontal);
        style.setChartBackgroundColor(Color.WHITE);
        style.setPlotGridVerticalLinesVisible(false);
        style.setAvailableSpaceFill(0.8);
        style.setYAxisMin(0.0);
        style.setLocale(java.util.Locale.ROOT);
        return chart;
    }
}
