package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import javax.xml.parsers.DocumentBuilderFactory;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.w3c.dom.Element;

/** With a world of 5.4 m by 8.4 m and five robots, two of them navy. */
class TrajectorySvgTest {
    private static final List<String> COLOURS = List.of("orange", "black", "navy", "navy", "gold");

    @TempDir
    private Path directory;

    private Element picture() throws Exception {
        Files.copy(Path.of("worlds", "pioneer.inc"), directory.resolve("pioneer.inc"));
        Files.writeString(directory.resolve("narrow.world"), world());
        Files.writeString(directory.resolve("narrow.cfg"), configuration());
        Files.writeString(directory.resolve("five.table"), """
                robots 5
                ignore black : walls
                state blue : wallFollower, spaceWanderer, spaceWanderer, spaceWanderer, wallFollower
                state red  : spaceWanderer, wallFollower, spaceWanderer, wallFollower, spaceWanderer
                """);
        var text = new StringWriter();
        int status = Main.execute(
                new PrintWriter(text),
                new PrintWriter(text),
                "run",
                "--seconds=20",
                "--world=" + directory.resolve("narrow.cfg"),
                "--table=" + directory.resolve("five.table"),
                "--out=" + directory);
        assertThat(status).as(text.toString()).isZero();
        return DocumentBuilderFactory.newInstance()
                .newDocumentBuilder()
                .parse(directory.resolve("trajectory.svg").toFile())
                .getDocumentElement();
    }

    private static String world() {
        var world = new StringBuilder("""
                name "narrow hall"
                interval_sim 100
                include "pioneer.inc"
                define wall model ( color "black" obstacle_return 1 blob_return 1 )
                wall ( name "n" pose [ 0 4.1 0 0 ] size [ 5.4 0.2 0.5 ] )
                wall ( name "s" pose [ 0 -4.1 0 0 ] size [ 5.4 0.2 0.5 ] )
                wall ( name "e" pose [ 2.6 0 0 0 ] size [ 0.2 8 0.5 ] )
                wall ( name "w" pose [ -2.6 0 0 0 ] size [ 0.2 8 0.5 ] )
                """);
        for (int robot = 0; robot < COLOURS.size(); robot++) {
            world.append("pioneer2dx ( name \"r%d\" color \"%s\" pose [ %d %d 0 90 ] )\n"
                    .formatted(robot, COLOURS.get(robot), robot % 2 == 0 ? -1 : 1, robot - 2));
        }
        return world.toString();
    }

    private static String configuration() {
        var text = new StringBuilder(
                "driver ( name \"stage\" provides [ \"simulation:0\" ] plugin \"p\" worldfile \"narrow.world\" )\n");
        for (int robot = 0; robot < COLOURS.size(); robot++) {
            text.append(
                    "driver ( name \"stage\" provides [ \"position2d:%1$d\" \"sonar:%1$d\" \"blobfinder:%1$d\" ] model \"r%1$d\" )\n"
                            .formatted(robot));
        }
        return text.toString();
    }

    private static List<Element> elements(Element svg, String name) {
        var found = svg.getElementsByTagName(name);
        List<Element> elements = new ArrayList<>();
        for (int i = 0; i < found.getLength(); i++) {
            elements.add((Element) found.item(i));
        }
        return elements;
    }

    @Test
    void picture_ofANarrowWorldWithFiveRobots_canBeRead() throws Exception {
        Element svg = picture();

        assertThat(svg.getAttribute("role")).isEqualTo("img");
        assertThat(svg.getAttribute("aria-label"))
                .isEqualTo(elements(svg, "title").getFirst().getTextContent())
                .startsWith("narrow hall: 5 robots change state ")
                .endsWith(" in 20 s");
        assertThat(new ScaleBar(svg).pixelsPerMetre()).isCloseTo(70, within(0.1));
        captionIsInside(svg);
        everyRobotHasALineOfItsOwn(svg);
        numbersCanBeReadOnTheBodies(svg);
        pathsHaveDirectionAndTime(svg);
    }

    /** Estimates the text width: half the font size per letter, about the mean of a sans-serif font. */
    private static void captionIsInside(Element svg) {
        double width = Double.parseDouble(svg.getAttribute("viewBox").split(" ")[2]);
        double height = Double.parseDouble(svg.getAttribute("viewBox").split(" ")[3]);
        List<Element> texts = elements(svg, "text");
        assertThat(texts.stream().filter(text -> text.getAttribute("class").equals("caption")))
                .isNotEmpty();
        assertThat(texts).allSatisfy(text -> {
            double x = Double.parseDouble(text.getAttribute("x"));
            boolean centred = text.getAttribute("text-anchor").equals("middle");
            int letters = text.getTextContent().length();
            assertThat(x + letters * 14 * 0.5 * (centred ? 0.5 : 1))
                    .as(text.getTextContent())
                    .isLessThan(width);
            assertThat(Double.parseDouble(text.getAttribute("y"))).isLessThan(height);
        });
    }

    private static void everyRobotHasALineOfItsOwn(Element svg) {
        List<String> legend = elements(svg, "line").stream()
                .filter(line -> line.getAttribute("stroke").equals("#444444"))
                .map(line -> line.getAttribute("stroke-dasharray"))
                .toList();
        assertThat(legend).hasSize(5).doesNotHaveDuplicates();
        assertThat(elements(svg, "polyline").stream().map(line -> line.getAttribute("stroke-dasharray")))
                .containsAll(legend);
    }

    private static void numbersCanBeReadOnTheBodies(Element svg) {
        assertThat(elements(svg, "text").stream()
                        .filter(text -> text.getAttribute("font-weight").equals("bold"))
                        .map(text -> text.getTextContent() + " " + text.getAttribute("fill")))
                .containsExactly("1 black", "2 white", "3 white", "4 white", "5 black");
    }

    private static void pathsHaveDirectionAndTime(Element svg) {
        assertThat(elements(svg, "polygon").stream()
                        .filter(each -> each.getAttribute("class").equals("head")))
                .isNotEmpty();
        assertThat(elements(svg, "text").stream().map(Element::getTextContent)).contains("10 s");
        assertThat(elements(svg, "circle").stream()
                        .filter(each -> each.getAttribute("class").equals("time")))
                .hasSize(5);
    }

    @Test
    void crowd_fadesWithAge() throws IOException {
        var text = new StringWriter();
        int status = Main.execute(
                new PrintWriter(text),
                new PrintWriter(text),
                "run",
                "--robots=12",
                "--seconds=6",
                "--out=" + directory);

        assertThat(status).as(text.toString()).isZero();
        String svg = Files.readString(directory.resolve("trajectory.svg"));
        assertThat(svg).contains("stroke-opacity=\"0.10\"", "stroke-opacity=\"0.85\"");
        assertThat(svg.indexOf("stroke-opacity=\"0.10\"")).isLessThan(svg.indexOf("stroke-opacity=\"0.85\""));
    }
}
