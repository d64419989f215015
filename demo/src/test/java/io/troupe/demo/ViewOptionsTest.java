package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.Recording;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.ScenarioReader;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.io.UncheckedIOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse.BodyHandlers;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.regex.Pattern;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** The live page, the page in a file, and interventions, on the command line. */
@Timeout(180)
class ViewOptionsTest extends CommandLineBench {
    private static final String SHORT_RUN = "run " + ARENA + "--seconds 3 --out DIR";
    private static final String PAGE = "<!doctype html>";
    private static final String AT_ONE_SECOND = "\"t\":1.0,\"type\":\"intervention\",\"what\":\"";

    // ---- --html

    @Test
    void pageOfTheDefaultRun_isTheOneOfTheDocs() throws IOException {
        assertThat(printed("run " + ARENA + "--html DIR/run.html --out DIR"))
                .contains(local("wrote DIR/trajectory.svg, DIR/run.html and DIR/run.jsonl"));
        String docs = Files.readString(Path.of("..", "docs", "examples", "run.html"));
        assertThat(written("run.html").equals(docs))
                .as("a change of the page or of a run needs a new file: ./troupe run --html docs/examples/run.html")
                .isTrue();
    }

    @Test
    void recording_isWrittenAsAPage() throws IOException {
        record(12);
        assertThat(printed("replay DIR/session.txt --world worlds/paper-arena.cfg --html DIR/session.html"))
                .contains("12 ticks of world paper arena, the same bit for bit");
        assertThat(written("session.html"))
                .startsWith(PAGE)
                .containsPattern("<script id=\"data\" type=\"text/plain\">[A-Za-z0-9+/=]{500,}</script>");
    }

    // ---- --repeat

    @Test
    void interventions_areRepeated() throws IOException {
        printed(SHORT_RUN);
        String untouched = written("run.jsonl");
        // as another program might format it
        String header = untouched.lines().findFirst().orElseThrow();
        file(
                "by-hand.jsonl",
                header + "\n{\"t\": 1.00, \"type\": \"intervention\", \"what\": \"place 1 3.5 -1.0 0.7\"}\n");
        printed(SHORT_RUN + " --repeat DIR/by-hand.jsonl");
        String changed = written("run.jsonl");
        assertThat(changed).contains(AT_ONE_SECOND + "place 1 3.5 -1.0 0.7\"");
        assertThat(changed.lines().takeWhile(line -> !line.contains("\"t\":1.0")))
                .isNotEmpty()
                .containsExactlyElementsOf(untouched
                        .lines()
                        .takeWhile(line -> !line.contains("\"t\":1.0"))
                        .toList());
        assertThat(changed).isNotEqualTo(untouched);

        file("first.jsonl", changed);
        printed(SHORT_RUN + " --repeat DIR/first.jsonl");
        assertThat(written("run.jsonl")).isEqualTo(changed);
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "place 3 0.0 0.0 0.0", // there are two robots
                "place 1 0.0",
                "dance 1",
                "pause", // is not recorded
            })
    void interventionThatCannotBeRepeated_isRefusedWithItsLine(String what) throws IOException {
        printed(SHORT_RUN);
        String header = written("run.jsonl").lines().findFirst().orElseThrow();
        file("by-hand.jsonl", header + "\n{" + AT_ONE_SECOND + what + "\"}\n");
        assertRefused(SHORT_RUN + " --repeat DIR/by-hand.jsonl", "--repeat: DIR/by-hand.jsonl");
    }

    @Test
    void logThatCannotBeRepeated_isRefusedWithTheReason() throws IOException {
        printed(SHORT_RUN);
        file("first.jsonl", written("run.jsonl"));
        String repeat = " --repeat DIR/first.jsonl";
        assertRefused(SHORT_RUN + " --seed 2" + repeat, "the seed of the recorded run is 1, and that of this run 2");
        assertRefused(SHORT_RUN + " --mode callback" + repeat, "the mode of the recorded run is promise, and that of");
        assertRefused(SHORT_RUN + " --reconnect" + repeat, "the reconnect of the recorded run is false, and that of");
        assertRefused(
                "run --robots 3 --seconds 3 --out DIR" + repeat, "the run was in world 'paper arena' with 2 robots");
        file("text.jsonl", "no run\nat all\n");
        assertRefused(SHORT_RUN + " --repeat DIR/text.jsonl", "text.jsonl:1:1: ", "expected a JSON object");
    }

    // ---- --view

    @ParameterizedTest
    @ValueSource(strings = {"promise", "callback", "sync"})
    void runWithAPage_writesTheSameLog(String mode) throws IOException {
        String run = SHORT_RUN + " --mode " + mode;
        printed(run);
        String expected = written("run.jsonl");
        Files.delete(directory.resolve("run.jsonl"));
        assertAnswersWhile(run + " --view 0 --view-speed 0");
        assertThat(written("run.jsonl")).isEqualTo(expected);
    }

    @Test
    void application_isShown() {
        assertThat(assertAnswersWhile("app --world worlds/paper-arena.cfg --out DIR/o --seconds 1 --view 0"
                        + " applications/two-robots.app"))
                .contains("two-robots on paper arena, 1.0 s simulated");
    }

    @Test
    void crowd_isShown() {
        assertThat(assertAnswersWhile("crowd --sizes 3 --seconds 1 --repeat 1 --out DIR --view 0"))
                .contains("times real time");
    }

    @Test
    void recording_isShown() throws IOException {
        record(5);
        assertThat(assertAnswersWhile("replay DIR/session.txt --world worlds/paper-arena.cfg --view 0"))
                .contains("5 ticks of world paper arena, the same bit for bit");
    }

    @Test
    void badOptions_areRefused() {
        assertRefused(SHORT_RUN + " --view 65536", "--view is 65536, expected a port from 0 to 65535");
        assertRefused(SHORT_RUN + " --view many", "--view", "many");
        assertRefused(SHORT_RUN + " --view-bind 127.0.0.1", "--view-bind is 127.0.0.1", "expected --view as well");
        assertRefused(SHORT_RUN + " --view 0 --view-bind no.such.host.invalid", "--view-bind is no.such.host.invalid");
        assertRefused(SHORT_RUN + " --view 0 --view-speed -1", "--view-speed is -1.0, expected a number from 0");
        assertRefused(SHORT_RUN + " --html DIR/missing/run.html", "--html");
        assertMissing("run.jsonl");
    }

    private void record(int ticks) throws IOException {
        var scenario = ScenarioReader.read(Path.of("worlds/paper-arena.cfg"));
        try (var world = World.create(scenario.world(), WorldSettings.defaults());
                var file = Files.newBufferedWriter(directory.resolve("session.txt"))) {
            Recording recording = world.record(file);
            for (int tick = 0; tick < ticks; tick++) {
                world.advance();
            }
            recording.close();
        }
    }

    /** Runs a command that prints the address of its page, which has to answer while the command is under way. */
    private String assertAnswersWhile(String line) {
        var output = new AskedOnFlush();
        int status = Main.execute(
                new PrintWriter(output), new PrintWriter(err), words(line).toArray(String[]::new));
        assertThat(status).as(() -> output + "" + err).isZero();
        assertThat(output.page).as("the page at the address that was printed").startsWith(PAGE);
        return output.toString();
    }

    /** Asks for the page on the thread of the command, which prints and flushes its address once it is open. */
    private static final class AskedOnFlush extends StringWriter {
        private static final Pattern ADDRESS = Pattern.compile("watch it at (http://\\S+)");

        private @Nullable String page;

        @Override
        public void flush() {
            var found = ADDRESS.matcher(toString());
            if (page == null && found.find()) {
                page = get(found.group(1));
            }
        }

        private static String get(String address) {
            try (var client = HttpClient.newHttpClient()) {
                var answer =
                        client.send(HttpRequest.newBuilder(URI.create(address)).build(), BodyHandlers.ofString());
                assertThat(answer.statusCode()).isEqualTo(200);
                return answer.body();
            } catch (IOException e) {
                throw new UncheckedIOException(e);
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
                throw new AssertionError(e);
            }
        }
    }
}
