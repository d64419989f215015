package io.troupe.actor.laws;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.io.ByteArrayOutputStream;
import java.io.PrintStream;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** In each of these runs jcstress itself ends with exit status 0, except in the one that throws. */
class LawsMainTest {
    private static String status(int planned, int passed, int failed, int soft, int hard) {
        return "(ETA: now) (Sampling Rate: N/A) (Results: %d planned; %d passed, %d failed, %d soft errs, %d hard errs)"
                .formatted(planned, passed, failed, soft, hard);
    }

    /** The fault that {@link LawsMain} reports for a run that printed these lines. */
    private static String faultAfter(String... lines) throws Exception {
        return LawsMain.run(new String[0], arguments -> {
            for (String line : lines) {
                System.out.print(line);
            }
        });
    }

    @Test
    void run_inWhichEveryLawPasses_isFine() throws Exception {
        assertThat(faultAfter(status(12, 5, 0, 0, 0) + "\r", status(12, 12, 0, 0, 0) + "\n", "done\n"))
                .isNull();
    }

    @Test
    void run_inWhichALawFailsOrDoesNotRun_isAFault() throws Exception {
        assertThat(faultAfter(status(12, 0, 0, 12, 0) + "\n"))
                .isEqualTo(
                        "expected that every law passes, got (Results: 12 planned; 0 passed, 0 failed, 12 soft errs, "
                                + "0 hard errs): no law ran to its end");
        assertThat(faultAfter(status(12, 11, 0, 1, 0) + "\n")).contains("1 soft errs", "in the report");
        assertThat(faultAfter(status(12, 11, 0, 0, 1) + "\n")).contains("1 hard errs");
        assertThat(faultAfter(status(12, 5, 0, 0, 0))).contains("12 planned; 5 passed");
        assertThat(faultAfter("FATAL: No matching tests.\n")).isEqualTo("no law ran: jcstress counted no results");
        assertThat(faultAfter(status(0, 0, 0, 0, 0) + "\n")).contains("no law ran");
    }

    @Test
    void list_runsNothing_andIsFine() throws Exception {
        assertThat(LawsMain.run(new String[] {"-l"}, arguments -> System.out.println("a.Law")))
                .isNull();
    }

    @Test
    void output_isPassedOn_andRestoredWhenTheRunnerThrows() {
        PrintStream console = System.out;
        var printed = new ByteArrayOutputStream();
        var replaced = new PrintStream(printed, true, UTF_8);
        System.setOut(replaced);
        try {
            assertThatThrownBy(() -> LawsMain.run(new String[0], arguments -> {
                        System.out.println("forbidden – outcome");
                        throw new AssertionError("TEST FAILURES");
                    }))
                    .hasMessage("TEST FAILURES");
            assertThat(System.out).isSameAs(replaced);
        } finally {
            System.setOut(console);
        }
        assertThat(printed.toString(UTF_8)).isEqualToIgnoringNewLines("forbidden – outcome");
    }

    @Test
    void log_takesTheOutput_andIsNamedByAFault(@TempDir Path directory) throws Exception {
        PrintStream console = System.out;
        Path log = directory.resolve("new").resolve("laws.txt");
        String[] arguments = {"--log", log.toString(), "-m", "sanity"};
        assertThat(LawsMain.runLogged(arguments, rest -> {
                    assertThat(rest).containsExactly("-m", "sanity");
                    System.out.println(status(12, 12, 0, 0, 0));
                }))
                .isNull();
        assertThat(log).content().contains("12 passed");
        assertThat(LawsMain.runLogged(arguments, rest -> System.out.println(status(12, 11, 0, 1, 0))))
                .contains("1 soft errs")
                .endsWith("all that jcstress printed is in " + log);
        assertThatThrownBy(() -> LawsMain.runLogged(arguments, rest -> {
                    throw new AssertionError("TEST FAILURES");
                }))
                .hasMessageEndingWith("is in " + log)
                .hasRootCauseMessage("TEST FAILURES");
        assertThat(System.out).isSameAs(console);
    }
}
