package io.troupe.demo.draw;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Path;
import javax.xml.parsers.DocumentBuilderFactory;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import picocli.CommandLine;

class DrawCommandTest {
    @TempDir
    private Path directory;

    /** Areas and titles: one for each thing and robot; rays: 16 sonars a robot, 181 more of the laser. */
    @ParameterizedTest
    @CsvSource({"paper-arena, 2, 32", "office, 2, 213", "track, 1, 16"})
    void world_isDrawnWithAllThatIsInIt(String name, int robots, int rays) throws Exception {
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
    }
}
