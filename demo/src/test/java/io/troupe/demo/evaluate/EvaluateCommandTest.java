package io.troupe.demo.evaluate;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.demo.CommandLineBench;
import java.io.IOException;
import java.nio.file.Files;
import java.util.Arrays;
import java.util.List;
import java.util.Set;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The whole command with small parameters, including its child JVMs. */
@Timeout(300)
class EvaluateCommandTest extends CommandLineBench {
    private static final String EVALUATE = "evaluate --world worlds/paper-arena.cfg ";
    /** Quantities that depend on the machine; all others depend only on the seed. */
    private static final Set<String> COMPUTED =
            Set.of("cycle", "cycle_p99", "turn", "processor", "delay", "delay_p99", "switch");

    /** A late world catches up by at most this much, so the last readings may arrive early relative to the first. */
    private static final double CATCH_UP_MS = 250;

    private List<String[]> rows(String folder) throws IOException {
        List<String> lines = Files.readAllLines(directory.resolve(folder).resolve("evaluation.csv"));
        assertThat(lines.getFirst()).isEqualTo("part,mode,cores_told,repetition,subject,quantity,unit,value");
        return lines.stream().skip(1).map(line -> line.split(",", -1)).toList();
    }

    private List<List<String>> decidedByTheSeed(String folder) throws IOException {
        return rows(folder).stream()
                .filter(row -> !COMPUTED.contains(row[5]))
                .map(Arrays::asList)
                .toList();
    }

    private String small(String folder) {
        return printed(EVALUATE + "--loops 20 --cores 2 --repetitions 2 --warm-up 0 --seconds 40 --reconnect --out DIR/"
                + folder);
    }

    @Test
    void evaluate_measuresEveryMode_andWhatTheSeedDecidesIsTheSameAgain() throws IOException {
        assertThat(small("first"))
                .contains(
                        "20 loops of each service, in simulated time with a cycle of 100 ms",
                        "holds           3.4, Figure 15: \"The total time taken is equal to a sum",
                        "DOES NOT HOLD   4: \"Space Wanderer service takes very less time",
                        "below it with a new connection for each service");
        assertThat(rows("first")).allSatisfy(row -> {
            assertThat(row).hasSize(8);
            assertThat(Double.parseDouble(row[7])).isNotNegative();
        });
        var decided = decidedByTheSeed("first");
        assertThat(decided)
                .contains(
                        List.of("loops", "sync", "2", "1", "both", "time", "ms", "4000.0"),
                        List.of("loops", "callback", "2", "1", "both", "time", "ms", "2000.0"),
                        List.of("loops", "promise", "2", "2", "both", "time", "ms", "2000.0"),
                        List.of("loops", "sync", "2", "1", "spaceWanderer", "interval", "ms", "200.0"),
                        List.of("loops", "promise", "2", "1", "both", "sent", "1", "0.0"),
                        List.of("alone", "promise", "2", "1", "wallFollower", "time", "ms", "2000.0"));
        for (int figure : new int[] {15, 18, 21, 22, 23}) {
            assertThat(directory.resolve("first/evaluation-" + figure + ".svg")).isNotEmptyFile();
            assertThat(directory.resolve("first/evaluation-" + figure + ".png")).isNotEmptyFile();
        }
        small("second");
        assertThat(decidedByTheSeed("second")).isEqualTo(decided);
    }

    @Test
    void realTime_isMeasuredOverTcp_byTheClockOnTheWall() throws IOException {
        assertThat(printed(EVALUATE
                        + "--realtime --loops 8 --modes promise,sync --cores 2 --warm-up 0 --seconds 0.5 --out DIR"))
                .contains("8 loops of each service, over TCP, in real time");
        var times = rows("").stream()
                .filter(row -> row[0].equals("loops") && row[5].equals("time"))
                .toList();
        assertThat(times)
                .hasSize(6)
                .allSatisfy(row -> assertThat(Double.parseDouble(row[7]))
                        .as(String.join(",", row))
                        .isGreaterThanOrEqualTo(7 * 100 - CATCH_UP_MS));
        assertThat(times)
                .as("simulated time is whole cycles, on the wall none is exactly 100 ms")
                .anySatisfy(row -> assertThat(Double.parseDouble(row[7]) % 100).isNotZero());
    }

    @Test
    void runWithoutAChangeOfState_saysSo_andWhatCannotBeWrittenCostsNoResult() throws IOException {
        Files.createDirectories(directory.resolve("evaluation.csv")); // a directory in place of the file
        String promise = "--loops 4 --modes promise --cores 1 --repetitions 1 --warm-up 0 --seconds 0.5 --out DIR";
        assertThat(troupe(EVALUATE + promise)).isEqualTo(1);
        assertThat(out.toString())
                .contains("0 changes, 0 messages\n", "The paper, and what we find", "no state has changed");
        assertThat(err.toString()).contains("evaluation.csv");
        assertThat(directory.resolve("evaluation.log")).doesNotExist();
    }

    @Test
    void directoryThatIsNone_isRefusedBeforeAnythingIsMeasured() throws IOException {
        file("file", "");
        assertRefused(EVALUATE + "--out DIR/file", "--out is DIR/file, but DIR/file is a file, expected a directory");
        Files.createDirectories(directory.resolve("taken/evaluation.log"));
        assertRefused(EVALUATE + "--out DIR/taken", "--out DIR/taken is no directory that can be written to");
    }

    @Test
    void wrongNumbers_areRefused() {
        assertRefused(EVALUATE + "--loops 1", "--loops is 1, expected a number from 2 to 1000000");
        assertRefused(EVALUATE + "--cores 2,0", "--cores is 0, expected numbers from 1 to 64");
        assertRefused(EVALUATE + "--repetitions 0", "--repetitions is 0, expected");
        assertRefused(EVALUATE + "--seconds -1", "--seconds is -1.0, expected");
        assertRefused(EVALUATE + "--warm-up -1", "--warm-up is -1, expected");
        assertRefused(EVALUATE + "--modes both", "both");
    }
}
