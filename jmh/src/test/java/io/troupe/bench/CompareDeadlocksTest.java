package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.bench.CompareDeadlocks.Answer;
import io.troupe.bench.CompareDeadlocks.Row;
import io.troupe.bench.CompareDeadlocks.Timed;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.PrintStream;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class CompareDeadlocksTest {
    @TempDir
    Path folder;

    private static Row row(Answer ours, Answer peer, Answer consensus) {
        return new Row("net", "1, 1", new Timed(ours, 5, "why"), new Timed(peer, 7, ""), consensus);
    }

    @Test
    void summary_namesNetsThatOnlyTheOtherAnsweredOrAnsweredOtherwise() {
        var lost = row(Answer.UNKNOWN, Answer.NO, Answer.NO);
        var wrong = row(Answer.YES, Answer.UNKNOWN, Answer.NO);
        var rows = List.of(
                row(Answer.YES, Answer.YES, Answer.YES),
                lost,
                wrong,
                row(Answer.UNKNOWN, Answer.UNKNOWN, Answer.UNKNOWN));
        assertThat(CompareDeadlocks.summary(rows))
                .containsExactly(
                        lost.toString(),
                        wrong.toString(),
                        "as expected: 1 of 4",
                        "both: 1 of 4",
                        "neither: 1 of 4",
                        "not as expected: 1 of 4",
                        "only ours: 1 of 4",
                        "only verifypn: 1 of 4");
    }

    @Test
    void answers_areReadInTheFormOfTheContest() {
        assertThat(CompareDeadlocks.answer("x\nFORMULA ReachabilityDeadlock TRUE TECHNIQUES A B\n"))
                .isEqualTo(Answer.YES);
        assertThat(CompareDeadlocks.answer("FORMULA net-RD-00 FALSE TECHNIQUES A"))
                .isEqualTo(Answer.NO);
        assertThat(CompareDeadlocks.answer("FORMULA net-RD-00 ? TECHNIQUES A")).isEqualTo(Answer.UNKNOWN);
        assertThat(CompareDeadlocks.answer("")).isEqualTo(Answer.UNKNOWN);
    }

    @Test
    void folder_isComparedWithTheExpectedAnswers() throws IOException {
        write("stops", "1", "<arc id='a' source='p' target='t'/>");
        write("goes", "1", "<arc id='a' source='p' target='t'/><arc id='b' source='t' target='p'/>");
        write("many", "4000000000", "<arc id='a' source='p' target='t'/>");
        write("full", "4000000000", "<arc id='a' source='t' target='q'/><arc id='b' source='q' target='t'/>");
        Files.writeString(folder.resolve("broken.pnml"), "<pnml>");
        Files.writeString(folder.resolve("stops-RD.out"), "FORMULA ReachabilityDeadlock TRUE TECHNIQUES ORACLE");
        var out = new ByteArrayOutputStream();
        var before = System.out;
        System.setOut(new PrintStream(out, true, StandardCharsets.UTF_8));
        try {
            assertThat(BenchmarkCommand.of(new CompareDeadlocks())
                            .execute(folder.toString(), "--expected", folder.toString(), "--seconds", "1"))
                    .isZero();
        } finally {
            System.setOut(before);
        }
        assertThat(out.toString(StandardCharsets.UTF_8).lines().map(line -> line.replaceAll("\t\\d+\t", "\t#\t")))
                .contains(
                        "stops\t2, 1\tYES\t#\t1 firings\tUNKNOWN\t#\tYES",
                        "goes\t2, 1\tNO\t#\treductions leave a transition that needs no tokens\tUNKNOWN\t#\tUNKNOWN",
                        "full\t2, 1\tYES\t#\t0 firings\tUNKNOWN\t#\tUNKNOWN",
                        "as expected: 1 of 5",
                        "neither: 2 of 5",
                        "only ours: 3 of 5")
                .anyMatch(line -> line.startsWith("many\t2, 1\tUNKNOWN\t#\tCANCELLED after "))
                .anyMatch(line -> line.startsWith("broken\t\tUNKNOWN\t#\trefused: "));
    }

    private void write(String name, String tokens, String arcs) throws IOException {
        Files.writeString(folder.resolve(name + ".pnml"), """
                <pnml xmlns="http://www.pnml.org/version-2009/grammar/pnml"><net id="n"
                type="http://www.pnml.org/version-2009/grammar/ptnet"><page id="g"><place id="p">
                <initialMarking><text>%s</text></initialMarking></place><place id="q"/><transition id="t"/>%s</page></net></pnml>
                """.formatted(tokens, arcs));
    }
}
