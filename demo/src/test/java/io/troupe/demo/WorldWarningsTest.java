package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.io.UncheckedIOException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * Every command that reads a world warns of parts that are not simulated. Unknown names are errors without
 * {@code --lenient}.
 */
class WorldWarningsTest {
    @TempDir
    private Path directory;

    private final StringWriter err = new StringWriter();

    private int troupe(String command, Path world, String... more) throws IOException {
        try (var taken = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            return troupe(command, world, taken.getLocalPort(), more);
        }
    }

    /** @param takenPort a port in use, on which serve fails */
    private int troupe(String command, Path world, int takenPort, String... more) {
        Path out = directory.resolve("out");
        String text = switch (command) {
            case "run" -> "run --seconds 0.2 --out " + out + " --world " + world;
            case "modes" -> "modes --seconds 0.2 --out " + out + " --world " + world;
            case "app" -> "app " + empty("t.app") + " --world " + world;
            case "draw" -> "draw --out " + directory.resolve("w.svg") + " " + world;
            case "evaluate" -> "evaluate --out " + out + " --world " + world;
            case "serve" -> "serve --port " + takenPort + " --world " + world;
            case "replay" -> "replay " + empty("t.txt") + " --world " + world;
            default -> throw new IllegalArgumentException(command);
        };
        String[] arguments = (text + " " + String.join(" ", more)).strip().split(" +");
        return Main.execute(new PrintWriter(new StringWriter()), new PrintWriter(err), arguments);
    }

    /** An existing empty file: the command reads the world first and then rejects this file. */
    private Path empty(String name) {
        try {
            return Files.writeString(directory.resolve(name), "");
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    /** A world without robots, so that the commands end soon after reading it. */
    private Path world(String text) throws IOException {
        return Files.writeString(directory.resolve("t.world"), text);
    }

    @ParameterizedTest
    @ValueSource(strings = {"run", "modes", "app", "draw", "evaluate", "serve", "replay"})
    void thingThatIsNotSimulated_isAWarningOfEveryCommand(String command) throws IOException {
        Path world = world("\nmodel ( joules 1 )");

        troupe(command, world);

        assertThat(err.toString().lines())
                .contains("troupe: warning: " + world + ":2:9: \"joules\" has no effect here: energy is not simulated");
    }

    @ParameterizedTest
    @ValueSource(strings = {"run", "modes", "app", "draw", "evaluate", "serve", "replay"})
    void nameThatNobodyKnows_isAnErrorOfEveryCommand_andLenientlyAWarning(String command) throws IOException {
        Path world = world("\nmodel ( siez 1 )");
        String problem = world + ":2:9: unknown property \"siez\" of model; did you mean \"size\"?";

        assertThat(troupe(command, world)).isEqualTo(2);
        assertThat(err.toString().lines()).singleElement().asString().startsWith("troupe: " + problem);
        err.getBuffer().setLength(0);
        troupe(command, world, "--lenient");

        assertThat(err.toString().lines()).contains("troupe: warning: " + problem);
    }
}
