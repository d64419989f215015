package io.troupe.view;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;

/** Reads {@code run.jsonl}. */
final class RunLines {
    private RunLines() {}

    /** All lines except the header, which contains the mode of the run. */
    static List<String> afterHeader(Path file) throws IOException {
        List<String> lines = Files.readAllLines(file);
        assertThat(lines.getFirst()).startsWith("{\"t\":0.0,\"type\":\"header\",");
        return lines.subList(1, lines.size());
    }

    /** Asserts that two runs in different modes differ only in the name of the mode. */
    static void assertSameButForTheMode(Path file, Path other) throws IOException {
        assertThat(afterHeader(file)).isEqualTo(afterHeader(other));
        assertThat(header(file)).isEqualTo(header(other));
    }

    private static String header(Path file) throws IOException {
        return Files.readAllLines(file).getFirst().replaceFirst("\"mode\":\"[a-z]+\"", "");
    }
}
