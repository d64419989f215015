package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Path;
import java.util.ArrayList;
import javax.xml.parsers.DocumentBuilderFactory;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import picocli.CommandLine;

class DrawCommandTest {
    @TempDir
    private Path directory;

    /**
     * Expected areas and titles: one per obstacle and robot. Expected rays: 16 sonars per robot, and 181 of the laser.
     */
    @ParameterizedTest
    @CsvSource({"paper-arena, 2, 32, 12.4", "office, 2, 213, 16.4", "track, 1, 16, 20.4"})
    void world_isDrawnWithAllThatIsInIt(String name, int robots, int rays, double widthM) throws Exception {
        var out = new StringWriter();
        Path picture = directory.resolve("w.svg");

        int status = new CommandLine(new DrawCommand())
                .setOut(new PrintWriter(out))
                .execute(Path.of("worlds", name + ".world").toString(), "--out", picture.toString());

        assertThat(status).isZero();
        assertThat(out.toString())
                .startsWith(robots == 1 ? "1 robot, " : robots + " robots, ")
                .contains("wrote " + picture);
        int things = Integer.parseInt(out.toString().replaceAll("(?s).*robots?, (\\d+) other.*", "$1"));
        var svg = DocumentBuilderFactory.newInstance().newDocumentBuilder().parse(picture.toFile());
        assertThat(svg.getElementsByTagName("title").getLength()).isEqualTo(1 + things + robots);
        assertThat(svg.getElementsByTagName("path").getLength()).isEqualTo(things + 2 * robots + rays);
        var root = svg.getDocumentElement();
        assertThat(root.getAttribute("role")).isEqualTo("img");
        assertThat(root.getAttribute("aria-label"))
                .isEqualTo(root.getElementsByTagName("title").item(0).getTextContent())
                .contains(robots == 1 ? "1 robot," : robots + " robots,");
        var texts = new ArrayList<String>();
        for (int i = 0; i < svg.getElementsByTagName("text").getLength(); i++) {
            texts.add(svg.getElementsByTagName("text").item(i).getTextContent());
        }
        assertThat(texts).contains("robot1", "sonar, first reading");
        assertThat(texts.contains("laser, first reading")).isEqualTo(name.equals("office"));
        assertThat(new ScaleBar(root).pixelsPerMetre())
                .as("as long as the map is wide: LONGEST_PX over the outer walls and 0.3 m on both sides")
                .isCloseTo(1000 / (widthM + 0.6), within(0.05));
    }

    @Test
    void pictureInTheGuide_isThatOfTheCommand() {
        Path picture = directory.resolve("w.svg");
        new CommandLine(new DrawCommand())
                .setOut(new PrintWriter(new StringWriter()))
                .execute("worlds/office.world", "--out", picture.toString());
        assertThat(picture).hasSameTextualContentAs(Path.of("..", "docs", "figures", "world-office.svg"));
    }
}
