package io.troupe.demo.crowd;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.demo.crowd.CrowdReport.Row;
import java.io.IOException;
import java.io.StringReader;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Pattern;
import javax.imageio.ImageIO;
import javax.xml.parsers.DocumentBuilderFactory;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.w3c.dom.Element;
import org.xml.sax.InputSource;

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

    private static Element parsed(String svg) throws Exception {
        return DocumentBuilderFactory.newInstance()
                .newDocumentBuilder()
                .parse(new InputSource(new StringReader(svg)))
                .getDocumentElement();
    }

    private static List<Element> elements(Element svg, String name) {
        var found = svg.getElementsByTagName(name);
        List<Element> elements = new ArrayList<>();
        for (int i = 0; i < found.getLength(); i++) {
            elements.add((Element) found.item(i));
        }
        return elements;
    }

    private static double number(Element element, String attribute) {
        return Double.parseDouble(element.getAttribute(attribute));
    }

    @Test
    void figure_saysWhatItShows_withUnitsAndWithoutPowersOfTen() throws Exception {
        Element svg = parsed(new CrowdFigure(MEDIANS, 8, 3).chart().svg());

        String title = "1,000 robots run at 5.3 times real time on one core";
        assertThat(svg.getAttribute("role")).isEqualTo("img");
        assertThat(svg.getAttribute("aria-label")).isEqualTo(title);
        List<String> texts =
                elements(svg, "text").stream().map(Element::getTextContent).toList();
        assertThat(texts)
                .contains(title, "µs for one robot and tick", "number of robots")
                .contains("1", "10", "100", "1,000", "10,000", "100,000")
                .contains("whole program", "world: physics, rays", "services and Player")
                .anyMatch(text -> text.startsWith("budget for real time"))
                .anyMatch(text -> text.contains("8 colours, 3 services"))
                .noneMatch(text -> text.matches("\\d+E\\d+"));
    }

    @Test
    void budget_isDashed_andWhereATickOf100MillisecondsIsUsedUp() throws Exception {
        Element svg = parsed(new CrowdFigure(MEDIANS, 8, 3).chart().svg());

        List<Element> dashed = elements(svg, "line").stream()
                .filter(line -> !line.getAttribute("stroke-dasharray").isEmpty())
                .toList();
        assertThat(dashed).hasSize(1);
        assertThat(number(dashed.getFirst(), "y1")).isCloseTo(yOf(svg, 100_000), within(0.2));
        assertThat(number(dashed.getFirst(), "y2")).isCloseTo(yOf(svg, 100), within(0.2));
    }

    /** The y coordinate of a decade, from its label, which is 4 px below its line. */
    private static double yOf(Element svg, int micros) {
        return elements(svg, "text").stream()
                .filter(text -> text.getAttribute("text-anchor").equals("end"))
                .filter(text -> text.getTextContent().replace(",", "").equals(String.valueOf(micros)))
                .mapToDouble(text -> number(text, "y") - 4)
                .findFirst()
                .orElseThrow();
    }

    @Test
    void dotsAndQuartiles_lieWhereTheNumbersAre() throws Exception {
        Element svg = parsed(new CrowdFigure(MEDIANS, 8, 3).chart().svg());

        double decadePx = yOf(svg, 10) - yOf(svg, 100);
        List<Element> whole = elements(svg, "circle").stream()
                .filter(dot -> dot.getAttribute("fill").equals("#222222"))
                .toList();
        assertThat(whole)
                .extracting(dot -> yOf(svg, 10) - number(dot, "cy"))
                .zipSatisfy(
                        MEDIANS,
                        (above, row) ->
                                assertThat(above).isCloseTo(decadePx * Math.log10(row.micros() / 10), within(0.2)));
        List<Element> bars = elements(svg, "line").stream()
                .filter(line -> line.getAttribute("stroke-width").equals("1.2")
                        && line.getAttribute("x1").equals(line.getAttribute("x2")))
                .toList();
        assertThat(bars)
                .hasSize(MEDIANS.size())
                .allSatisfy(bar -> assertThat(number(bar, "y1") - number(bar, "y2"))
                        .as("from half the median to twice the median")
                        .isCloseTo(decadePx * Math.log10(4), within(0.2)));
    }

    @Test
    void files_areTheSamePictureTwice() throws Exception {
        new CrowdFigure(MEDIANS, 8, 3).write(out);

        Element svg = parsed(Files.readString(out.resolve("crowd.svg")));
        var picture = ImageIO.read(out.resolve("crowd.png").toFile());
        assertThat(picture.getWidth()).isEqualTo(2 * (int) number(svg, "width"));
        Element dot =
                elements(svg, "circle").get(6); // a dot of the world line at 100 robots, where no quartiles are drawn
        int pixel = picture.getRGB((int) (2 * number(dot, "cx")), (int) (2 * number(dot, "cy")));
        assertThat(String.format("#%06x", pixel & 0xffffff)).isEqualTo(dot.getAttribute("fill"));
    }

    /** {@code -Dfigures=write} writes the documented figure. */
    @Test
    void pictureInTheDocumentation_isThatOfTheTableThere() throws IOException {
        List<Row> rows = Files.readAllLines(Path.of("..", "docs", "benchmarks.md")).stream()
                .map(ROW::matcher)
                .filter(java.util.regex.Matcher::matches)
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
    private static Row documented(java.util.regex.Matcher row) {
        double[] numbers = new double[8];
        for (int i = 1; i <= 7; i++) {
            numbers[i] = Double.parseDouble(row.group(i).replace(",", ""));
        }
        int robots = (int) numbers[1];
        double micros = numbers[5];
        return new Row(
                robots,
                numbers[2],
                numbers[3],
                numbers[4],
                0,
                micros,
                (micros + 100_000 / numbers[4] / robots) / 2,
                (micros + 100_000 / numbers[3] / robots) / 2,
                numbers[6],
                numbers[7],
                0,
                0);
    }
}
