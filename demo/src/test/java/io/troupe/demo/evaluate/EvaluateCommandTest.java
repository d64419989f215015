package io.troupe.demo.evaluate;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Set;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine;

/** The whole command with small parameters, including its child JVMs. */
@Timeout(300)
class EvaluateCommandTest {
    private static final String WORLD = Path.of("worlds", "paper-arena.cfg").toString();
    /** Quantities that depend on the machine; all others depend only on the seed. */
    private static final Set<String> COMPUTED =
            Set.of("cycle", "cycle_p99", "turn", "processor", "delay", "delay_p99", "switch");

    /** A late world catches up by at most this much, so the last readings may arrive early relative to the first. */
    private static final double CATCH_UP_MS = 250;

    @TempDir
    private Path directory;

    private final StringWriter out = new StringWriter();

    private int evaluate(String... arguments) {
        var all = new ArrayList<>(List.of("--world", WORLD));
        all.addAll(List.of(arguments));
        return new CommandLine(new EvaluateCommand())
                .setOut(new PrintWriter(out))
                .setErr(new PrintWriter(out))
                .setExecutionExceptionHandler((thrown, command, parsed) -> {
                    thrown.printStackTrace(command.getErr());
                    return 1;
                })
                .execute(all.toArray(String[]::new));
    }

    private List<String[]> rows(Path csv) throws IOException {
        List<String> lines = Files.readAllLines(csv);
        assertThat(lines.getFirst()).isEqualTo("part,mode,cores_told,repetition,subject,quantity,unit,value");
        return lines.stream().skip(1).map(line -> line.split(",", -1)).toList();
    }

    private List<List<String>> decidedByTheSeed(Path csv) throws IOException {
        return rows(csv).stream()
                .filter(row -> !COMPUTED.contains(row[5]))
                .map(Arrays::asList)
                .toList();
    }

    private Path small(String name) {
        Path to = directory.resolve(name);
        assertThat(evaluate(
                        "--loops",
                        "20",
                        "--cores",
                        "2",
                        "--repetitions",
                        "2",
                        "--warm-up",
                        "0",
                        "--seconds",
                        "40",
                        "--reconnect",
                        "--out",
                        to.toString()))
                .as(out.toString())
                .isZero();
        return to.resolve("evaluation.csv");
    }

    @Test
    void evaluate_measuresEveryMode_andWhatTheSeedDecidesIsTheSameAgain() throws IOException {
        Path csv = small("first");
        assertThat(rows(csv)).allSatisfy(row -> {
            assertThat(row).hasSize(8);
            assertThat(Double.parseDouble(row[7])).isNotNegative();
        });
        assertThat(decidedByTheSeed(csv))
                .contains(
                        List.of("loops", "sync", "2", "1", "both", "time", "ms", "4000.0"),
                        List.of("loops", "callback", "2", "1", "both", "time", "ms", "2000.0"),
                        List.of("loops", "promise", "2", "2", "both", "time", "ms", "2000.0"),
                        List.of("loops", "sync", "2", "1", "spaceWanderer", "interval", "ms", "200.0"),
                        List.of("loops", "promise", "2", "1", "both", "sent", "1", "0.0"),
                        List.of("alone", "promise", "2", "1", "wallFollower", "time", "ms", "2000.0"));
        assertThat(out.toString())
                .contains(
                        "20 loops of each service, in simulated time with a cycle of 100 ms",
                        "holds           3.4, Figure 15: \"The total time taken is equal to a sum",
                        "DOES NOT HOLD   4: \"Space Wanderer service takes very less time",
                        "below it with a new connection for each service");
        for (int figure : new int[] {15, 18, 21, 22, 23}) {
            assertThat(csv.resolveSibling("evaluation-" + figure + ".svg")).isNotEmptyFile();
            assertThat(csv.resolveSibling("evaluation-" + figure + ".png")).isNotEmptyFile();
        }
        assertThat(decidedByTheSeed(small("second"))).isEqualTo(decidedByTheSeed(csv));
    }

    @Test
    void realTime_isMeasuredOverTcp_byTheClockOnTheWall() throws IOException {
        assertThat(evaluate(
                        "--realtime",
                        "--loops",
                        "8",
                        "--modes",
                        "promise,sync",
                        "--cores",
                        "2",
                        "--warm-up",
                        "0",
                        "--seconds",
                        "0.5",
                        "--out",
                        directory.toString()))
                .as(out.toString())
                .isZero();
        assertThat(out.toString()).contains("8 loops of each service, over TCP, in real time");
        var times = rows(directory.resolve("evaluation.csv")).stream()
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
        assertThat(evaluate(
                        "--loops",
                        "4",
                        "--modes",
                        "promise",
                        "--cores",
                        "1",
                        "--repetitions",
                        "1",
                        "--warm-up",
                        "0",
                        "--seconds",
                        "0.5",
                        "--out",
                        directory.toString()))
                .isEqualTo(1);
        assertThat(out.toString())
                .contains("0 changes, 0 messages\n", "The paper, and what we find", "no state has changed")
                .contains("evaluation.csv");
        assertThat(directory.resolve("evaluation.log")).doesNotExist();
    }

    @Test
    void directoryThatIsNone_isRefusedBeforeAnythingIsMeasured() throws IOException {
        Path file = Files.createFile(directory.resolve("file"));
        assertThat(evaluate("--out", file.toString())).isEqualTo(2);
        Path taken = Files.createDirectories(directory.resolve("taken"));
        Files.createDirectories(taken.resolve("evaluation.log"));
        assertThat(evaluate("--out", taken.toString())).isEqualTo(2);
        assertThat(out.toString())
                .contains(
                        "--out is " + file + ", but " + file + " is a file, expected a directory",
                        "--out " + taken + " is no directory that can be written to");
    }

    @Test
    void wrongNumbers_areRefused() {
        assertThat(evaluate("--loops", "1")).isEqualTo(2);
        assertThat(evaluate("--cores", "2,0")).isEqualTo(2);
        assertThat(evaluate("--repetitions", "0")).isEqualTo(2);
        assertThat(evaluate("--seconds", "-1")).isEqualTo(2);
        assertThat(evaluate("--warm-up", "-1")).isEqualTo(2);
        assertThat(evaluate("--modes", "both")).isEqualTo(2);
        assertThat(out.toString())
                .contains(
                        "--loops is 1, expected a number from 2 to 1000000",
                        "--cores is 0, expected numbers from 1 to 64",
                        "--repetitions is 0, expected",
                        "--seconds is -1.0, expected",
                        "--warm-up is -1, expected",
                        "both");
    }
}
