package io.troupe.demo.crowd;

import io.troupe.demo.crowd.CrowdReport.Row;
import io.troupe.demo.svg.Chart;
import io.troupe.demo.svg.Chart.Anchor;
import java.io.IOException;
import java.nio.file.Path;
import java.util.Comparator;
import java.util.List;
import java.util.Locale;
import java.util.function.ToDoubleFunction;
import java.util.stream.Stream;

/**
 * Chart of the cost per robot by crowd size; both axes are logarithmic. A flat line means a cost proportional to the
 * size. Points below the dashed line are faster than real time.
 */
final class CrowdFigure {
    private static final double MICROS_PER_TICK = 100_000; // in real time
    private static final int WIDTH_PX = 860;
    private static final int HEIGHT_PX = 480;
    private static final int LEFT_PX = 76;
    private static final int RIGHT_PX = 680; // the labels of the lines are right of it
    private static final int TOP_PX = 92;
    private static final int BOTTOM_PX = 420;
    private static final int NAME_PX = 16;

    private static final int INK = 0x222222;
    private static final int GREY = 0x666666;
    private static final int GRID = 0xdddddd;
    private static final int LIMIT = 0xb3261e;

    /** One measured line of the chart. */
    private record Line(String name, int colour, ToDoubleFunction<Row> micros) {}

    private static final List<Line> LINES = List.of(
            new Line("whole program", 0x222222, Row::micros),
            new Line("world: physics, rays", 0x1b9e9e, Row::worldMicros),
            new Line("services and Player", 0x7b3fa0, Row::servicesMicros));

    private final List<Row> rows;
    private final int colours;
    private final int services;
    private final int bottomDecade;
    private final int topDecade;
    private final double robotDecades;
    private final Chart chart;

    /** @param rows at least one, by number of robots */
    CrowdFigure(List<Row> rows, int colours, int services) {
        this.rows = rows.stream().sorted(Comparator.comparingInt(Row::robots)).toList();
        this.colours = colours;
        this.services = services;
        double least = this.rows.stream()
                .flatMap(row -> LINES.stream().map(line -> line.micros.applyAsDouble(row)))
                .filter(micros -> micros > 0)
                .min(Double::compare)
                .orElse(1.0);
        double most = this.rows.stream()
                .flatMap(row -> Stream.of(budgetMicros(row.robots()), row.microsUpper()))
                .max(Double::compare)
                .orElse(1.0);
        bottomDecade = (int) Math.floor(Math.log10(least));
        topDecade = Math.max(bottomDecade + 1, (int) Math.ceil(Math.log10(most)));
        robotDecades = Math.max(0.5, Math.log10(this.rows.getLast().robots()));
        chart = new Chart(WIDTH_PX, HEIGHT_PX, title());
        draw();
    }

    /** Time available per robot in a tick of 100 ms. */
    private static double budgetMicros(double robots) {
        return MICROS_PER_TICK / robots;
    }

    /** The result of the largest crowd. */
    private String title() {
        Row largest = rows.getLast();
        double times = largest.timesRealTime();
        return String.format(
                Locale.ROOT,
                "%,d %s run%s at %s times real time on one core",
                largest.robots(),
                largest.robots() == 1 ? "robot" : "robots",
                largest.robots() == 1 ? "s" : "",
                times >= 100 ? String.format(Locale.ROOT, "%,.0f", times) : String.format(Locale.ROOT, "%.1f", times));
    }

    private void draw() {
        chart.text(20, 28, 17, Anchor.START, INK, title());
        chart.text(
                20,
                48,
                12,
                Anchor.START,
                GREY,
                "one actor space, " + colours + " colours, " + services
                        + " services; medians of processor time, upright bars: quartiles; both axes logarithmic");
        grid();
        budget();
        LINES.forEach(this::line);
        quartiles();
        names();
    }

    private void grid() {
        chart.text(20, TOP_PX - 16, 12, Anchor.START, INK, "µs for one robot and tick");
        for (int decade = bottomDecade; decade <= topDecade; decade++) {
            double micros = Math.pow(10, decade);
            chart.line(LEFT_PX, y(micros), RIGHT_PX, y(micros), GRID, 1);
            String label = decade < 0
                    ? String.format(Locale.ROOT, "%." + -decade + "f", micros)
                    : String.format(Locale.ROOT, "%,.0f", micros);
            chart.text(LEFT_PX - 8, y(micros) + 4, 12, Anchor.END, INK, label);
        }
        double free = Double.NEGATIVE_INFINITY;
        for (Row row : rows) {
            double x = x(row.robots());
            chart.line(x, TOP_PX, x, BOTTOM_PX + 4, GRID, 1);
            if (x >= free) {
                chart.text(x, BOTTOM_PX + 20, 12, Anchor.MIDDLE, INK, String.format(Locale.ROOT, "%,d", row.robots()));
                free = x + 44;
            }
        }
        chart.text((LEFT_PX + RIGHT_PX) / 2.0, BOTTOM_PX + 44, 12, Anchor.MIDDLE, INK, "number of robots");
    }

    /** Draws the limit of real time, dashed because it is not measured. */
    private void budget() {
        double most = Math.pow(10, robotDecades);
        chart.line(x(1), y(budgetMicros(1)), x(most), y(budgetMicros(most)), LIMIT, 2, "7 5");
        double third = Math.pow(10, robotDecades / 3);
        double x = x(third) + 20;
        double y = y(budgetMicros(third));
        chart.text(x, y - 24, 13, Anchor.START, LIMIT, "budget for real time: 100 ms a tick, shared by the robots");
        chart.text(x, y - 7, 12, Anchor.START, GREY, "above: slower than real time, below: faster");
    }

    private void line(Line line) {
        for (int i = 0; i < rows.size(); i++) {
            double x = x(rows.get(i).robots());
            double y = y(line.micros.applyAsDouble(rows.get(i)));
            if (i > 0) {
                Row before = rows.get(i - 1);
                chart.line(x(before.robots()), y(line.micros.applyAsDouble(before)), x, y, line.colour, 2);
            }
            chart.dot(x, y, 3.5, line.colour);
        }
    }

    private void quartiles() {
        for (Row row : rows) {
            double x = x(row.robots());
            double upper = y(row.microsUpper());
            double lower = y(row.microsLower());
            chart.line(x, lower, x, upper, INK, 1.2);
            chart.line(x - 4, upper, x + 4, upper, INK, 1.2);
            chart.line(x - 4, lower, x + 4, lower, INK, 1.2);
        }
    }

    /** Labels the right ends of the lines; moves labels down where they would overlap. */
    private void names() {
        double free = Double.NEGATIVE_INFINITY;
        List<Line> downwards = LINES.stream()
                .sorted(Comparator.comparingDouble(line -> y(line.micros.applyAsDouble(rows.getLast()))))
                .toList();
        for (Line line : downwards) {
            double y = Math.max(y(line.micros.applyAsDouble(rows.getLast())) + 4, free);
            chart.text(x(rows.getLast().robots()) + 12, y, 13, Anchor.START, line.colour, line.name);
            free = y + NAME_PX;
        }
    }

    private double x(double robots) {
        return LEFT_PX + (RIGHT_PX - LEFT_PX) * Math.log10(robots) / robotDecades;
    }

    private double y(double micros) {
        double decade = Math.max(bottomDecade, Math.log10(Math.max(micros, Double.MIN_NORMAL)));
        return BOTTOM_PX - (BOTTOM_PX - TOP_PX) * (decade - bottomDecade) / (topDecade - bottomDecade);
    }

    Chart chart() {
        return chart;
    }

    /** Writes {@code crowd.svg} and {@code crowd.png}. */
    void write(Path directory) throws IOException {
        chart.write(directory, "crowd");
    }
}
