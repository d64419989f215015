package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.w3c.dom.Element;

/** The pictures that {@code troupe draw} and {@code troupe run} write. */
class PicturesTest extends CommandLineBench {
    /**
     * Expected areas and titles: one per obstacle and robot. Expected rays: 16 sonars per robot, and 181 of the laser.
     */
    @ParameterizedTest
    @CsvSource({"paper-arena, 2, 32, 12.4", "office, 2, 213, 16.4", "track, 1, 16, 20.4"})
    void world_isDrawnWithAllThatIsInIt(String name, int robots, int rays, double widthM) throws Exception {
        String text = printed("draw --out DIR/w.svg worlds/" + name + ".world");

        String counted = robots == 1 ? "1 robot," : robots + " robots,";
        assertThat(text).startsWith(counted + " ").contains(local("wrote DIR/w.svg"));
        int things = Integer.parseInt(text.replaceAll("(?s).*robots?, (\\d+) other.*", "$1"));
        var svg = ParsedSvg.parse(Files.readString(directory.resolve("w.svg")));
        assertThat(svg.elements("title")).hasSize(1 + things + robots);
        assertThat(svg.elements("path")).hasSize(things + 2 * robots + rays);
        assertThat(svg.title()).contains(counted);
        assertThat(svg.texts()).contains("robot1", "sonar, first reading");
        assertThat(svg.texts().contains("laser, first reading")).isEqualTo(name.equals("office"));
        assertThat(svg.pixelsPerMetre())
                .as("as long as the map is wide: LONGEST_PX over the outer walls and 0.3 m on both sides")
                .isCloseTo(1000 / (widthM + 0.6), within(0.05));
    }

    @Test
    void pictureInTheGuide_isThatOfTheCommand() {
        printed("draw --out DIR/w.svg worlds/office.world");
        assertThat(directory.resolve("w.svg"))
                .hasSameTextualContentAs(Path.of("..", "docs", "figures", "world-office.svg"));
    }

    /** A world of 5.4 m by 8.4 m with five robots, two of them navy. */
    @Test
    void trajectory_ofANarrowWorldWithFiveRobots_canBeRead() throws Exception {
        Files.copy(Path.of("worlds", "pioneer.inc"), directory.resolve("pioneer.inc"));
        file("five.table", """
                robots 5
                ignore black : walls
                state blue : wallFollower, spaceWanderer, spaceWanderer, spaceWanderer, wallFollower
                state red  : spaceWanderer, wallFollower, spaceWanderer, wallFollower, spaceWanderer
                """);
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
        var configuration = new StringBuilder(
                "driver ( name \"stage\" provides [ \"simulation:0\" ] plugin \"p\" worldfile \"narrow.world\" )\n");
        var colours = List.of("orange", "black", "navy", "navy", "gold");
        for (int robot = 0; robot < colours.size(); robot++) {
            world.append("pioneer2dx ( name \"r%d\" color \"%s\" pose [ %d %d 0 90 ] )\n"
                    .formatted(robot, colours.get(robot), robot % 2 == 0 ? -1 : 1, robot - 2));
            String devices = "\"position2d:%1$d\" \"sonar:%1$d\" \"blobfinder:%1$d\"";
            configuration.append(("driver ( name \"stage\" provides [ " + devices + " ] model \"r%1$d\" )\n")
                    .formatted(robot));
        }
        file("narrow.world", world.toString());
        file("narrow.cfg", configuration.toString());
        printed("run --seconds=20 --world=DIR/narrow.cfg --table=DIR/five.table --out=DIR");

        var svg = ParsedSvg.parse(Files.readString(directory.resolve("trajectory.svg")));
        assertThat(svg.title()).startsWith("narrow hall: 5 robots change state ").endsWith(" in 20 s");
        assertThat(svg.pixelsPerMetre()).isCloseTo(70, within(0.1));
        captionIsInside(svg);
        everyRobotHasALineOfItsOwn(svg);
        assertThat(svg.elements("text", "font-weight", "bold"))
                .as("numbers can be read on the bodies")
                .extracting(text -> text.getTextContent() + " " + text.getAttribute("fill"))
                .containsExactly("1 black", "2 white", "3 white", "4 white", "5 black");
        assertThat(svg.elements("polygon", "class", "head")).as("directions").isNotEmpty();
        assertThat(svg.texts()).contains("10 s");
        assertThat(svg.elements("circle", "class", "time")).hasSize(5);
    }

    /** Estimates the text width: half the font size per letter, about the mean of a sans-serif font. */
    private static void captionIsInside(ParsedSvg svg) {
        String[] viewBox = svg.root().getAttribute("viewBox").split(" ");
        assertThat(svg.elements("text", "class", "caption")).isNotEmpty();
        assertThat(svg.elements("text")).allSatisfy(text -> {
            boolean centred = text.getAttribute("text-anchor").equals("middle");
            int letters = text.getTextContent().length();
            assertThat(ParsedSvg.number(text, "x") + letters * 14 * 0.5 * (centred ? 0.5 : 1))
                    .as(text.getTextContent())
                    .isLessThan(Double.parseDouble(viewBox[2]));
            assertThat(ParsedSvg.number(text, "y")).isLessThan(Double.parseDouble(viewBox[3]));
        });
    }

    private static void everyRobotHasALineOfItsOwn(ParsedSvg svg) {
        var legend = dashes(svg.elements("line", "stroke", "#444444"));
        assertThat(legend).hasSize(5).doesNotHaveDuplicates();
        assertThat(dashes(svg.elements("polyline"))).containsAll(legend);
    }

    private static List<String> dashes(List<Element> lines) {
        return lines.stream().map(line -> line.getAttribute("stroke-dasharray")).toList();
    }

    @Test
    void trajectory_ofACrowd_fadesWithAge() throws IOException {
        printed("run --robots=12 --seconds=6 --out=DIR");
        String svg = Files.readString(directory.resolve("trajectory.svg"));
        assertThat(svg).containsSubsequence("stroke-opacity=\"0.10\"", "stroke-opacity=\"0.85\"");
        assertThat(svg.indexOf("stroke-opacity=\"0.10\"")).isLessThan(svg.indexOf("stroke-opacity=\"0.85\""));
    }
}
