package io.troupe.demo.crowd;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.demo.crowd.CrowdReport.Row;
import java.nio.file.Path;
import java.util.List;
import javax.imageio.ImageIO;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.knowm.xchart.XYSeries;

class CrowdFigureTest {
    private static final List<Row> MEDIANS = List.of(row(1, 90, 31, 52), row(10, 40, 12, 25), row(1000, 20, 7, 11));

    @TempDir
    private Path out;

    /** With a number of its own wherever the figure must not look. */
    private static Row row(int robots, double micros, double worldMicros, double servicesMicros) {
        return new Row(robots, 501, 502, 503, 504, micros, worldMicros, servicesMicros, 505, 506);
    }

    @Test
    void lines_areMicrosecondsPerRobotAndTick_bySize() {
        var chart = new CrowdFigure(MEDIANS, 8, 3).chart();

        assertThat(chart.getSeriesCollection())
                .extracting(XYSeries::getName)
                .containsExactly("all", "world", "services", "real time");
        assertThat(chart.getSeriesCollection())
                .allSatisfy(line -> assertThat(line.getXData()).containsExactly(1, 10, 1000));
        assertThat(chart.getSeries("all").getYData()).containsExactly(90, 40, 20);
        assertThat(chart.getSeries("world").getYData()).containsExactly(31, 12, 7);
        assertThat(chart.getSeries("services").getYData()).containsExactly(52, 25, 11);
        assertThat(chart.getSeries("real time").getYData())
                .as("a tick of 100 ms, shared among the robots")
                .containsExactly(100_000, 10_000, 100);
        assertThat(chart.getTitle()).contains("8 colours", "3 services");
        assertThat(chart.getXAxisTitle()).isEqualTo("robots");
        assertThat(chart.getYAxisTitle()).isEqualTo("µs");
    }

    @Test
    void files_showALineOfEachColour() throws Exception {
        var figure = new CrowdFigure(MEDIANS, 8, 3);

        figure.write(out);

        assertThat(out.resolve("crowd.svg"))
                .content()
                .contains("rgb(51,51,51)", "rgb(27,158,158)", "rgb(123,63,160)", "rgb(204,68,68)")
                .doesNotContain("NaN");
        var picture = ImageIO.read(out.resolve("crowd.png").toFile());
        assertThat(picture.getWidth()).isEqualTo(figure.chart().getWidth());
    }
}
