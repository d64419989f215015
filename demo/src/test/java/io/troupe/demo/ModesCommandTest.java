package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import javax.xml.parsers.DocumentBuilderFactory;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** {@code troupe modes}, and the modes of {@code troupe run}. */
@Timeout(300)
class ModesCommandTest {
    private static final String WORLD = Path.of("worlds", "paper-arena.world").toString();

    private final StringWriter out = new StringWriter();
    private final StringWriter err = new StringWriter();

    @TempDir
    private Path directory;

    private int troupe(String... arguments) {
        return Main.execute(new PrintWriter(out), new PrintWriter(err), arguments);
    }

    private String logWithoutItsMode(String mode) throws IOException {
        String log = Files.readString(directory.resolve("run-" + mode + ".jsonl"));
        String field = ",\"mode\":\"" + mode + "\"";
        assertThat(log.lines().findFirst().orElse("")).contains(field);
        return log.replace(field, "");
    }

    @Test
    void modes_showsWhereSynchronousModeDiffers_andThatCallbackModeDoesNot() throws Exception {
        assertThat(troupe("modes", "--world", WORLD, "--seconds", "100", "--out", directory.toString()))
                .isZero();
        assertThat(err.toString()).isEmpty();
        assertThat(out.toString())
                .contains("sync mode", "callback mode", "promise mode", "*  46.1 s 3: robot 2 sees green")
                .contains("callback mode: the same states at the same times and the same trajectories")
                .contains("as each waits for the cycles of the others. The robots are elsewhere from 0.1 s on");
        assertThat(out.toString().lines().filter(line -> line.contains("*  "))).hasSize(1);
        assertThat(logWithoutItsMode("callback"))
                .isEqualTo(logWithoutItsMode("promise"))
                .isNotEqualTo(logWithoutItsMode("sync"));
        assertThat(out.toString().lines().takeWhile(line -> !line.startsWith("*")))
                .as("the table")
                .hasSizeGreaterThan(2)
                .allSatisfy(line -> assertThat(line).hasSizeLessThanOrEqualTo(100));
        var picture = DocumentBuilderFactory.newInstance()
                .newDocumentBuilder()
                .parse(directory.resolve("modes.svg").toFile());
        long bars = picture.getElementsByTagName("g").getLength();
        long states = 0;
        for (String mode : new String[] {"sync", "callback", "promise"}) {
            try (var lines = Files.lines(directory.resolve("run-" + mode + ".jsonl"))) {
                states += lines.filter(line -> line.contains("\"type\":\"state\""))
                        .count();
            }
        }
        assertThat(bars).isEqualTo(states);
        assertThat(picture.getDocumentElement().getAttribute("role")).isEqualTo("img");
        assertThat(picture.getDocumentElement().getAttribute("aria-label"))
                .isEqualTo(picture.getElementsByTagName("title").item(0).getTextContent())
                .matches("States compared with promise mode: sync differs from [0-9.]+ s on,"
                        + " callback does not differ \\(paper arena, seed 1\\)");
        assertThat(directory.resolve("modes.svg")).content().doesNotContain("#00ff00");
    }

    @Test
    void modes_ofAWorldThatIsMissing_isOneLine() {
        assertThat(troupe("modes", "--world", directory.resolve("nowhere.world").toString()))
                .isEqualTo(2);
        assertThat(err.toString().lines()).singleElement().asString().contains("nowhere.world", "troupe modes --help");
    }

    @Test
    void run_inCallbackMode_tellsItsMessages_andItsTicksWithoutAService() {
        assertThat(troupe(
                        "run",
                        "--world",
                        WORLD,
                        "--seconds",
                        "100",
                        "--mode",
                        "CALLBACK",
                        "--reconnect",
                        "--out",
                        directory.toString()))
                .isZero();
        assertThat(out.toString())
                .contains("callback mode with reconnection, seed 1")
                .containsPattern("readings with no or several services +1 +1\\R")
                .containsPattern("colours sent by colour finders: [1-9][0-9]+ in 1 state change,");
    }

    @Test
    void reconnection_inSynchronousMode_isRefused() {
        assertThat(troupe("run", "--world", WORLD, "--mode", "sync", "--reconnect"))
                .isEqualTo(2);
        assertThat(err.toString().lines())
                .singleElement()
                .asString()
                .contains("--reconnect goes with --mode callback or promise", "connects once", "troupe run --help");
    }

    @Test
    void modeThatDoesNotExist_isRefused_withTheOnesThatDo() {
        assertThat(troupe("run", "--world", WORLD, "--mode", "magic")).isEqualTo(2);
        assertThat(err.toString().lines())
                .singleElement()
                .asString()
                .contains("--mode", "magic", "SYNC, CALLBACK, PROMISE", "case-insensitive");
    }
}
