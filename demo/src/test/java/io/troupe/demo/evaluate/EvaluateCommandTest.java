package io.troupe.demo.evaluate;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.actor.ManualClock;
import io.troupe.demo.CommandLineBench;
import io.troupe.demo.evaluate.Measurement.Kind;
import io.troupe.demo.evaluate.Measurement.Quantity;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.State;
import io.troupe.tools.ProgressLine;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.PrintStream;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.Arrays;
import java.util.List;
import java.util.Set;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.parallel.Execution;
import org.junit.jupiter.api.parallel.ExecutionMode;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * The whole command with small parameters, the JVMs that measure for it and how they measure, their world and the
 * progress.
 */
@Timeout(300)
@Execution(ExecutionMode.CONCURRENT)
class EvaluateCommandTest extends CommandLineBench {
    private static final Path PAPER_ARENA = Path.of("worlds", "paper-arena.cfg");
    private static final String EVALUATE = "evaluate --world DIR/arena.cfg ";
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

    @BeforeEach
    void writeArena() throws IOException {
        arenaAtOwnPort();
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
            assertWritten("first/evaluation-" + figure + ".svg", "first/evaluation-" + figure + ".png");
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
        assertMissing("evaluation.log");
    }

    @Test
    void wrongNumbersAndDirectories_areRefusedBeforeAnythingIsMeasured() throws IOException {
        assertRefused(EVALUATE + "--loops 1", "--loops is 1, expected a number from 2 to 1000000");
        assertRefused(EVALUATE + "--cores 2,0", "--cores is 0, expected numbers from 1 to 64");
        assertRefused(EVALUATE + "--repetitions 0", "--repetitions is 0, expected");
        assertRefused(EVALUATE + "--seconds -1", "--seconds is -1.0, expected");
        assertRefused(EVALUATE + "--warm-up -1", "--warm-up is -1, expected");
        assertRefused(EVALUATE + "--modes both", "both");

        file("file", "");
        assertRefused(EVALUATE + "--out DIR/file", "--out is DIR/file, but DIR/file is a file, expected a directory");
        Files.createDirectories(directory.resolve("taken/evaluation.log"));
        assertRefused(EVALUATE + "--out DIR/taken", "--out DIR/taken is no directory that can be written to");
    }

    // ---- the JVMs that measure

    private static final Job ALONE = new Job(Kind.ALONE, Mode.SYNC, "wallFollower", 20, 2.5, 7, 6665);
    private static final Job LOOPS = new Job(Kind.LOOPS, Mode.PROMISE, "both", 2, 1, 1, 0);

    private Evaluation.MeasuringProcess start(int cores, Path world) throws IOException {
        return Evaluation.MeasuringProcess.start(cores, world, directory.resolve("log"));
    }

    @Test
    @Timeout(60)
    void jobAndValue_areReadAsTheyAreWritten() {
        assertThat(Job.parse(ALONE.line())).isEqualTo(ALONE);
        var value = new Job.Result.Value("both", Quantity.DELAY_P99, 0.1);
        assertThat(Job.Result.Value.parse(value.line())).isEqualTo(value);
        assertThatThrownBy(() -> Job.parse("ALONE SYNC")).hasMessageContaining("a job of 2 fields, expected 7");
    }

    @Test
    @Timeout(60)
    void jobThatFails_isToldWithItsReason_andTheNextOneIsDone() throws IOException {
        try (var process = start(2, PAPER_ARENA)) {
            var nobodyThere = new Job(Kind.LOOPS, Mode.PROMISE, "both", 2, 1, 1, 1);
            assertThatThrownBy(() -> process.measure(nobodyThere))
                    .isInstanceOf(IOException.class)
                    .hasMessageContainingAll("promise mode, loops: ", "127.0.0.1:1 cannot be reached");
            assertThat(process.measure(LOOPS).values()).contains(new Job.Result.Value("both", Quantity.TIME, 200));
        }
    }

    /** Two values, of which at most one is the number of processors of this machine. */
    @ParameterizedTest
    @ValueSource(ints = {1, 5})
    @Timeout(60)
    void jvmThatMeasures_hasAsManyProcessorsAsItIsTold(int cores) throws IOException {
        try (var process = start(cores, PAPER_ARENA)) {
            assertThat(process.measure(LOOPS).values()).isNotEmpty(); // rejected if the JVM reports another number
        }
    }

    @Test
    @Timeout(60)
    void jvmThatEnds_isToldWithItsStatus() throws IOException {
        try (var process = start(2, directory.resolve("no.world"))) {
            assertThatThrownBy(() -> process.measure(LOOPS))
                    .isInstanceOf(IOException.class)
                    .hasMessageContaining("the JVM that measures (told 2 cores) has ended: exit status 1, see "
                            + directory.resolve("log"));
        }
    }

    // ---- the progress

    private final ByteArrayOutputStream terminal = new ByteArrayOutputStream();
    private final ManualClock clock = new ManualClock();
    private final PrintStream stream = new PrintStream(terminal, true, StandardCharsets.UTF_8);
    private final EvaluationProgress progress = new EvaluationProgress(ProgressLine.on(stream, clock::nanos), clock);

    /** The output since the previous call. */
    private String shown() {
        String text = terminal.toString(StandardCharsets.UTF_8);
        terminal.reset();
        return text.replace("\r", "").replace("\033[K", "");
    }

    private static String bar(int full) {
        return "[" + "#".repeat(full) + ".".repeat(30 - full) + "]";
    }

    @Test
    void progress_isTheShareOfWhatIsExpected_andTheTimeLeftFollowsFromIt() {
        progress.expect(200);
        progress.warmsUp(2);
        assertThat(shown()).isEqualTo(bar(0) + "   0 %  warming up, told 2 cores"); // too early for an estimate
        clock.advance(Duration.ofSeconds(10));
        progress.ended(50);
        progress.begins(ALONE, 1);
        String doing = ALONE.title() + ", told " + "1 core";
        assertThat(shown()).isEqualTo(bar(7) + "  25 %, 30 s left  " + doing);
        clock.advance(Duration.ofSeconds(10));
        progress.within(50);
        assertThat(shown()).isEqualTo(bar(15) + "  50 %, 20 s left  " + doing);
        progress.ended(100); // includes the progress reported during the job
        clock.advance(Duration.ofSeconds(1)); // a terminal is updated only a few times a second
        progress.begins(ALONE, 1);
        assertThat(shown()).isEqualTo(bar(22) + "  75 %, 7 s left  " + doing);
    }

    @Test
    void moreThanWasExpected_isAll_andCloseWipesTheLine() {
        progress.expect(10);
        progress.ended(9);
        progress.within(5);
        assertThat(shown()).startsWith(bar(30) + " 100 %, 0 s left");
        progress.ended(5);
        progress.begins(ALONE, 3);
        assertThat(shown()).startsWith(bar(30) + " 100 %, 0 s left").endsWith("told 3 cores");

        progress.close();
        assertThat(terminal.toString(StandardCharsets.UTF_8)).isEqualTo("\r\033[K");
    }

    // ---- measuring: computing takes no time, and each command takes effect for 100 ms

    private static final int FOLLOWER = 0;
    private static final int WANDERER = 1;
    private static final State STATE = JobRunner.oneState().first();

    private long millis;

    private final Meter.RobotClock time = new Meter.RobotClock() {
        @Override
        public long nanos() {
            return millis * 1_000_000;
        }

        @Override
        public long endOfCycleNanos() {
            return (millis + 100) * 1_000_000;
        }
    };

    /** Creates the meter at 0 s; the first robot connects after 5 s, the second after 7 s. */
    private LoopMeter connected(Mode mode, int loops) {
        var meter = new LoopMeter(mode, STATE, loops, time);
        millis = 5000;
        meter.serviceStarted(FOLLOWER, STATE.services().get(FOLLOWER));
        millis = 7000;
        meter.serviceStarted(WANDERER, STATE.services().get(WANDERER));
        return meter;
    }

    private void cycles(LoopMeter meter, int robot, long... atMillis) {
        for (long at : atMillis) {
            millis = at;
            meter.cycleStarted(robot, STATE.services().get(robot));
            meter.cycleEnded(robot, STATE.services().get(robot));
        }
    }

    private static double value(LoopMeter meter, String subject, Quantity quantity) {
        return meter.result().values().stream()
                .filter(each -> each.subject().equals(subject) && each.quantity() == quantity)
                .mapToDouble(Job.Result.Value::value)
                .sum();
    }

    private static void assertTimesMs(LoopMeter meter, double follower, double wanderer, double both) {
        assertThat(value(meter, Measurement.FOLLOWER, Quantity.TIME)).isEqualTo(follower);
        assertThat(value(meter, Measurement.WANDERER, Quantity.TIME)).isEqualTo(wanderer);
        assertThat(value(meter, Measurement.BOTH, Quantity.TIME)).isEqualTo(both);
    }

    private static double intervalMs(LoopMeter meter, int robot) {
        return value(meter, STATE.services().get(robot).name(), Quantity.INTERVAL);
    }

    @Test
    void connecting_isNotCounted_butWaitingForTheFirstReadingIs() {
        LoopMeter meter = connected(Mode.PROMISE, 3);
        for (long at : new long[] {7030, 7130, 7230}) {
            cycles(meter, FOLLOWER, at);
            cycles(meter, WANDERER, at);
        }
        assertTimesMs(meter, 330, 330, 330); // from 7 s to 7.33 s
    }

    @Test
    void servicesInTurn_shareTheTime_eachFromTheEndOfTheOthersLoop() {
        LoopMeter meter = connected(Mode.SYNC, 3);
        for (long at : new long[] {7030, 7230, 7430}) {
            cycles(meter, FOLLOWER, at);
            cycles(meter, WANDERER, at + 100);
        }
        assertTimesMs(meter, 330, 300, 630); // the sum, as in the paper
        assertThat(intervalMs(meter, FOLLOWER)).isEqualTo(200);
        assertThat(intervalMs(meter, WANDERER)).isEqualTo(200);
    }

    @Test
    void interval_isThatOfOneServicesCycles_withTheMiddleAndTheLongest() {
        LoopMeter meter = connected(Mode.CALLBACK, 4);
        cycles(meter, FOLLOWER, 7000, 7100, 7200, 7500);
        cycles(meter, WANDERER, 7500, 7550, 7600, 7650);
        assertThat(intervalMs(meter, FOLLOWER)).isEqualTo(100);
        // of 100, 100 and 300 ms, interpolated between the two longest
        assertThat(value(meter, "wallFollower", Quantity.INTERVAL_P99)).isCloseTo(296, within(1e-9));
        assertThat(intervalMs(meter, WANDERER)).isEqualTo(50);
    }

    @Test
    void measurement_isDoneWhenBothServicesAre_andFurtherLoopsOfTheFasterOneAreNotCounted() {
        LoopMeter meter = connected(Mode.PROMISE, 2);
        cycles(meter, FOLLOWER, 7000, 7100, 7900, 8000);
        assertThat(meter.isDone()).isFalse();
        cycles(meter, WANDERER, 8000);
        assertThat(meter.isDone()).isFalse();
        cycles(meter, WANDERER, 8100);
        assertThat(meter.isDone()).isTrue();
        cycles(meter, WANDERER, 9000);
        assertTimesMs(meter, 200, 1200, 1200);
        assertThat(intervalMs(meter, FOLLOWER)).isEqualTo(100);
    }

    @Test
    void trimmedMean_leavesOutTheLongestHundredth_ofFewNothing() {
        var many = new Meter.Durations();
        for (int i = 0; i < 198; i++) {
            many.add(i % 2 == 0 ? 1_000 : 3_000);
        }
        many.add(1_000_000);
        many.add(2_000_000);
        assertThat(many.trimmedMean(1_000)).isEqualTo(2);
        assertThat(many.quantile(0.5, 1_000)).isEqualTo(3);
        var few = new Meter.Durations();
        few.add(1);
        few.add(6);
        assertThat(few.trimmedMean(1)).isEqualTo(3.5);
    }

    @Test
    void ratios_areOfTheSameRepetition() {
        assertThat(Measurements.ratios(new double[] {2, 9}, new double[] {1, 3}))
                .containsExactly(2, 3);
        assertThatThrownBy(() -> Measurements.ratios(new double[2], new double[1]))
                .hasMessage("2 numerators, expected 1 as there are denominators");
    }
}
