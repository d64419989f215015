package io.troupe.demo.evaluate;

import io.troupe.demo.svg.Chart;
import io.troupe.demo.svg.Chart.Anchor;
import io.troupe.demo.svg.SvgElements;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

/**
 * A bar chart: groups of bars over labels, each bar with its value. Several panels stand side by side under one title.
 */
final class BarPanel {
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
        double step = SvgElements.roundStep(Math.max(most, 1e-9) / 5);
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
            x += 20 + SvgElements.width(each.name, 12) + 22;
        }
    }

    /** Formats with about three significant digits and without trailing zeros. */
    static String number(double value) {
        String text = String.format(Locale.ROOT, value >= 100 ? "%,.0f" : value >= 10 ? "%.1f" : "%.2f", value);
        return text.contains(".") ? text.replaceFirst("\\.?0+$", "") : text;
    }
}
