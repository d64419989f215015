package io.troupe.demo.verify;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.Pnml;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine;

class VerifyCommandTest {
    @TempDir
    private Path directory;

    private final StringWriter out = new StringWriter();

    private int verify(String... arguments) {
        return new CommandLine(new VerifyCommand())
                .setOut(new PrintWriter(out))
                .setErr(new PrintWriter(out))
                .execute(arguments);
    }

    @Test
    void verify_printsBothSidesAndWritesNetsDrawingsAndReport() throws IOException {
        assertThat(verify("--robots", "2", "--out", directory.toString())).isZero();

        assertThat(out.toString())
                .contains(
                        "holds   5.5.4: there are 44 minimal siphons\n          ours: 44 minimal siphons",
                        "DIFFERS 5.5.4: there are 44 minimal siphons\n          ours: 36 minimal siphons",
                        "2 robots: 18 dead",
                        "a colour is a promise: proved free of deadlock");
        for (var reading : Reading.values()) {
            assertThat(Pnml.read(directory.resolve("uncorrected-" + reading + ".pnml"))
                            .sameStructureAs(PaperNets.uncorrected(reading)))
                    .isTrue();
            assertThat(Pnml.read(directory.resolve("corrected-" + reading + ".pnml"))
                            .sameStructureAs(PaperNets.corrected(reading)))
                    .isTrue();
            assertThat(directory.resolve("deadlock-" + reading + ".svg")).isNotEmptyFile();
            assertThat(directory.resolve("graph-uncorrected-" + reading + ".svg"))
                    .isNotEmptyFile();
            assertThat(directory.resolve("graph-robot-player-" + reading + ".dot"))
                    .isNotEmptyFile();
        }
        assertThat(Files.readString(directory.resolve("verify.md")))
                .contains(
                        "| minimal siphons | 44 | 48 | 36 | 48 |",
                        "| reachable markings / edges | 1264 / 3706 | 429 / 1084 | 1104 / 3236 | 363 / 913 |",
                        "| can a siphon be emptied, by one mixed-integer program | perhaps; one it finds is really emptied | no |",
                        " 7. Tp4     player stops",
                        "service1 waits for arbitrator.colour; arbitrator waits for service1.stop");
    }

    @Test
    void verify_ofAFile_tellsWhatIsKnownOfIt() {
        var file = directory.resolve("mine.pnml");
        Pnml.write(PaperNets.uncorrected(Reading.A), file);

        assertThat(verify(
                        "--net",
                        file.toString(),
                        "--out",
                        directory.resolve("o").toString()))
                .isZero();

        assertThat(out.toString())
                .contains(
                        "1264 markings, 3706 edges, all of them",
                        "dead markings: 6, the nearest {P1, M1, S10, R7''}",
                        "live NO, reversible NO",
                        "44 minimal siphons: 20 of them may perhaps be emptied, which decides nothing by itself");
        var o = directory.resolve("o");
        assertThat(out.toString())
                .endsWith("wrote, as .dot and .svg: " + o.resolve("mine") + ", " + o.resolve("mine-deadlock") + ", "
                        + o.resolve("mine-graph") + "\n");
        assertThat(directory.resolve("o/mine.svg")).isNotEmptyFile();
        assertThat(directory.resolve("o/mine-deadlock.svg")).isNotEmptyFile();
        assertThat(directory.resolve("o/mine-graph.dot")).isNotEmptyFile();
    }

    @Test
    void robots_outOfRange_areRefused() {
        assertThat(verify("--robots", "0")).isEqualTo(2);
        assertThat(out.toString()).contains("--robots is 0, expected a number from 1 to 7");
    }
}
