package io.troupe.demo.crowd;

import io.troupe.demo.crowd.CrowdReport.Row;
import java.awt.BasicStroke;
import java.awt.Color;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.function.ToDoubleFunction;
import org.knowm.xchart.ChartEncoder;
import org.knowm.xchart.XYChart;
import org.knowm.xchart.XYChartBuilder;
import org.knowm.xchart.style.Styler.LegendPosition;

/** The cost of a robot by how many there are, both axes logarithmic; a flat line is a crowd that costs in proportion to its size. */
final class CrowdFigure {
    private static final int WIDTH_PX = 860;
    private static final int HEIGHT_PX = 460;
    private static final double MICROS_PER_TICK = 100_000; // at real time

    private final XYChart chart;

    CrowdFigure(List<Row> rows, int colours, int services) {
        chart = new XYChartBuilder()
                .width(WIDTH_PX)
                .height(HEIGHT_PX)
                .title("One robot and tick, on one actor space (" + colours + " colours, " + services + " services)")
                .xAxisTitle("robots")
                .yAxisTitle("µs")
                .build();
        var style = chart.getStyler();
        style.setXAxisLogarithmic(true);
        style.setYAxisLogarithmic(true);
        style.setLegendPosition(LegendPosition.OutsideE);
        style.setChartBackgroundColor(Color.WHITE);
        style.setPlotGridLinesStroke(new BasicStroke(0.5f)); // dashes would be most of the file
        style.setSeriesColors(
                new Color[] {new Color(0x333333), new Color(0x1b9e9e), new Color(0x7b3fa0), new Color(0xcc4444)});
        line("all", rows, Row::micros);
        line("world", rows, Row::worldMicros);
        line("services", rows, Row::servicesMicros);
        line("real time", rows, row -> MICROS_PER_TICK / row.robots());
    }

    private void line(String name, List<Row> rows, ToDoubleFunction<Row> micros) {
        chart.addSeries(
                name,
                rows.stream().mapToDouble(Row::robots).toArray(),
                rows.stream().mapToDouble(micros).toArray());
    }

    XYChart chart() {
        return chart;
    }

    /** Writes {@code crowd.svg} and {@code crowd.png}. */
    void write(Path directory) throws IOException {
        for (String format : List.of("svg", "png")) {
            Files.write(directory.resolve("crowd." + format), ChartEncoder.getBytes(chart, format));
        }
    }
}
