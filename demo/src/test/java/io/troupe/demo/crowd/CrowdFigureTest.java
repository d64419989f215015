package io.troupe.demo.crowd;

import static io.troupe.demo.ParsedSvg.number;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.demo.ParsedSvg;
import io.troupe.demo.crowd.CrowdReport.Row;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import javax.imageio.ImageIO;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class CrowdFigureTest {
    private static final List<Row> MEDIANS =
            List.of(row(1, 90, 31, 52), row(10, 40, 12, 25), row(100, 30, 10, 15), row(1000, 20, 7, 11));
    private static final Path DOCUMENTED = Path.of("..", "docs", "figures", "crowd.svg");
    /**
     * Columns: robots, speed with its extremes, speed by the wall clock, microseconds in total, of the world and of the
     * services.
     */
    private static final Pattern ROW = Pattern.compile(" +([\\d,]+) +([\\d,.]+) +\\(([\\d,.]+) \\.\\. ([\\d,.]+)\\)"
            + " +[\\d,.]+ +([\\d,.]+) +([\\d,.]+) +([\\d,.]+) +[\\d,.]+ +\\d+");

    @TempDir
    private Path out;

    /** A row with arbitrary values in all columns that the figure does not use. */
    private static Row row(int robots, double micros, double worldMicros, double servicesMicros) {
        return new Row(
                robots, 5.25, 502, 503, 504, micros, micros / 2, micros * 2, worldMicros, servicesMicros, 505, 506);
    }

    private static ParsedSvg drawn() throws Exception {
        return ParsedSvg.parse(new CrowdFigure(MEDIANS, 8, 3).chart().svg());
    }

    @Test
    void figure_saysWhatItShows_withUnitsAndWithoutPowersOfTen() throws Exception {
        var svg = drawn();

        String title = "1,000 robots run at 5.3 times real time on one core";
        assertThat(svg.title()).isEqualTo(title);
        assertThat(svg.texts())
                .contains(title, "µs for one robot and tick", "number of robots")
                .contains("1", "10", "100", "1,000", "10,000", "100,000")
                .contains("whole program", "world: physics, rays", "services and Player")
                .anyMatch(text -> text.startsWith("budget for real time"))
                .anyMatch(text -> text.contains("8 colours, 3 services"))
                .noneMatch(text -> text.matches("\\d+E\\d+"));
    }

    @Test
    void budget_isDashed_andWhereATickOf100MillisecondsIsUsedUp() throws Exception {
        var svg = drawn();

        assertThat(svg.elements("line"))
                .filteredOn(line -> !line.getAttribute("stroke-dasharray").isEmpty())
                .singleElement()
                .satisfies(dashed -> {
                    assertThat(number(dashed, "y1")).isCloseTo(yOf(svg, 100_000), within(0.2));
                    assertThat(number(dashed, "y2")).isCloseTo(yOf(svg, 100), within(0.2));
                });
    }

    /** The y coordinate of a decade, from its label, which is 4 px below its line. */
    private static double yOf(ParsedSvg svg, int micros) {
        return svg.elements("text", "text-anchor", "end").stream()
                .filter(text -> text.getTextContent().replace(",", "").equals(String.valueOf(micros)))
                .mapToDouble(text -> number(text, "y") - 4)
                .findFirst()
                .orElseThrow();
    }

    @Test
    void dotsAndQuartiles_lieWhereTheNumbersAre() throws Exception {
        var svg = drawn();

        double decadePx = yOf(svg, 10) - yOf(svg, 100);
        assertThat(svg.elements("circle", "fill", "#222222"))
                .extracting(dot -> yOf(svg, 10) - number(dot, "cy"))
                .zipSatisfy(
                        MEDIANS,
                        (above, row) ->
                                assertThat(above).isCloseTo(decadePx * Math.log10(row.micros() / 10), within(0.2)));
        assertThat(svg.elements("line", "stroke-width", "1.2"))
                .filteredOn(line -> line.getAttribute("x1").equals(line.getAttribute("x2")))
                .hasSize(MEDIANS.size())
                .allSatisfy(bar -> assertThat(number(bar, "y1") - number(bar, "y2"))
                        .as("from half the median to twice the median")
                        .isCloseTo(decadePx * Math.log10(4), within(0.2)));
    }

    @Test
    void files_areTheSamePictureTwice() throws Exception {
        new CrowdFigure(MEDIANS, 8, 3).write(out);

        var svg = ParsedSvg.parse(Files.readString(out.resolve("crowd.svg")));
        var picture = ImageIO.read(out.resolve("crowd.png").toFile());
        assertThat(picture.getWidth()).isEqualTo(2 * (int) number(svg.root(), "width"));
        // a dot of the world line at 100 robots, where no quartiles are drawn
        var dot = svg.elements("circle").get(6);
        int pixel = picture.getRGB((int) (2 * number(dot, "cx")), (int) (2 * number(dot, "cy")));
        assertThat(String.format("#%06x", pixel & 0xffffff)).isEqualTo(dot.getAttribute("fill"));
    }

    /** {@code -Dfigures=write} writes the documented figure. */
    @Test
    void pictureInTheDocumentation_isThatOfTheTableThere() throws IOException {
        List<Row> rows = Files.readAllLines(Path.of("..", "docs", "benchmarks.md")).stream()
                .map(ROW::matcher)
                .filter(Matcher::matches)
                .map(CrowdFigureTest::documented)
                .toList();
        assertThat(rows).hasSize(7);

        String svg = new CrowdFigure(rows, 8, 3).chart().svg();
        if ("write".equals(System.getProperty("figures"))) {
            Files.writeString(DOCUMENTED, svg);
        }
        assertThat(DOCUMENTED).hasContent(svg);
    }

    /**
     * A row of the documented table. Of three rounds, the quartiles are halfway between the median and the extremes;
     * the table has the extremes of the speed.
     */
    private static Row documented(Matcher row) {
        double[] numbers = new double[8];
        for (int i = 1; i <= 7; i++) {
            numbers[i] = Double.parseDouble(row.group(i).replace(",", ""));
        }
        int robots = (int) numbers[1];
        double micros = numbers[5];
        double low = (micros + 100_000 / numbers[4] / robots) / 2;
        double high = (micros + 100_000 / numbers[3] / robots) / 2;
        double speed = numbers[2];
        return new Row(
                robots, speed, numbers[3], numbers[4], 0, micros, low, high, numbers[6], numbers[7], 0, 0);
    }
}
