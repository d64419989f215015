package io.troupe.actor.guide;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.ByteArrayOutputStream;
import java.io.PrintStream;
import java.nio.charset.StandardCharsets;
import java.util.function.Consumer;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The complete programs of README and guide have printed when their {@code main} returns. */
@Tag("threads")
@Timeout(60)
class ProgramsTest {
    private static String printedBy(Consumer<String[]> main) {
        PrintStream console = System.out;
        var printed = new ByteArrayOutputStream();
        System.setOut(new PrintStream(printed, true, StandardCharsets.UTF_8));
        try {
            main.accept(new String[0]);
        } finally {
            System.setOut(console);
        }
        return printed.toString(StandardCharsets.UTF_8).strip();
    }

    @Test
    void programOfTheReadme_printsBeforeItEnds() {
        assertThat(printedBy(Hello::main)).isEqualTo("Hello again, Ada");
    }

    @Test
    void firstProgramOfTheGuide_printsBeforeItEnds() {
        assertThat(printedBy(Heating::main)).isEqualTo("21.5");
    }
}
