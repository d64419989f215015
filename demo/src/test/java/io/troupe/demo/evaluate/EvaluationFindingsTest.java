package io.troupe.demo.evaluate;

import static io.troupe.demo.evaluate.ClaimVerdict.CANNOT_BE_TOLD;
import static io.troupe.demo.evaluate.ClaimVerdict.DOES_NOT_HOLD;
import static io.troupe.demo.evaluate.ClaimVerdict.HOLDS;
import static io.troupe.demo.evaluate.Measurement.BOTH;
import static io.troupe.demo.evaluate.Measurement.FOLLOWER;
import static io.troupe.demo.evaluate.Measurement.WANDERER;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.demo.ParsedSvg;
import io.troupe.demo.evaluate.Measurement.Kind;
import io.troupe.demo.evaluate.Measurement.Quantity;
import io.troupe.services.subsumption.Mode;
import java.awt.image.BufferedImage;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.regex.Pattern;
import java.util.stream.Stream;
import javax.imageio.ImageIO;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** The claims of the paper, with each verdict in both directions, and the figures, from synthetic measurements. */
class EvaluationFindingsTest {
    private static final String FASTER_THAN_CALLBACK = "It [promise] is faster than [..] actor with callback";

    private static final List<Mode> MODES = List.of(Mode.values());
    private static final List<Integer> CORES = List.of(2, 3);
    private static final int REPETITIONS = ClaimVerdict.ENOUGH_REPETITIONS;

    private record Key(Kind kind, Mode mode, String subject, Quantity quantity) {}

    private final Map<Key, Double> values = new LinkedHashMap<>();

    /** Measurements that confirm every claim of the paper. */
    EvaluationFindingsTest() {
        double[] both = {8_000, 4_010, 4_000};
        for (Mode mode : MODES) {
            loops(mode, BOTH, Quantity.TIME, both[mode.ordinal()]);
            loops(mode, BOTH, Quantity.TURN, both[mode.ordinal()]);
            loops(mode, BOTH, Quantity.PROCESSOR, 10_000);
            for (Quantity quantity : List.of(Quantity.TIME, Quantity.CYCLE)) {
                loops(mode, FOLLOWER, quantity, 4_000);
                loops(mode, WANDERER, quantity, 1_000);
            }
            loops(mode, WANDERER, Quantity.INTERVAL, 250);
            switches(mode, Quantity.STATE_CHANGES, 10);
        }
        values.put(new Key(Kind.ALONE, Mode.PROMISE, FOLLOWER, Quantity.TIME), 4_000.0);
        values.put(new Key(Kind.ALONE, Mode.PROMISE, WANDERER, Quantity.TIME), 4_000.0);
        switches(Mode.CALLBACK, Quantity.DELAY, 1_500);
        switches(Mode.CALLBACK, Quantity.DELAY_P99, 2_000);
        switches(Mode.CALLBACK, Quantity.SENT, 300);
        switches(Mode.PROMISE, Quantity.SENT, 10);
    }

    private void loops(Mode mode, String subject, Quantity quantity, double value) {
        values.put(new Key(Kind.LOOPS, mode, subject, quantity), value);
    }

    private void switches(Mode mode, Quantity quantity, double value) {
        values.put(new Key(Kind.SWITCHES, mode, BOTH, quantity), value);
    }

    private Measurements measured() {
        var measurements = new Measurements();
        for (int cores : CORES) {
            for (int repetition = 1; repetition <= REPETITIONS; repetition++) {
                int number = repetition;
                values.forEach((key, value) -> measurements.add(
                        new Measurement(key.kind(), key.mode(), cores, number, key.subject(), key.quantity(), value)));
            }
        }
        return measurements;
    }

    private Evaluation.Settings settings() {
        return new Evaluation.Settings(
                Path.of("none.world"), 1000, CORES, MODES, REPETITIONS, 0, 300, false, false, out.resolve("log"));
    }

    private List<PaperClaims.Judged> claims() {
        return PaperClaims.judge(measured(), MODES, CORES, false);
    }

    private ClaimVerdict verdict(String words, String measure) {
        return claims().stream()
                .filter(each -> each.claim().words().contains(words)
                        && each.claim().measure().equals(measure))
                .findFirst()
                .orElseThrow()
                .verdict();
    }

    private static double[] numbers(String text) {
        return Stream.of(text.split(" ")).mapToDouble(Double::parseDouble).toArray();
    }

    @ParameterizedTest
    @CsvSource({
        "1.1 1.2 1.3 1.4 0.9, HOLDS",
        "0.8 0.85 0.9 0.95 1.1, DOES_NOT_HOLD",
        "0.8 0.9 1.05 1.1 1.2, CANNOT_BE_TOLD",
        "1, DOES_NOT_HOLD",
        "1 1 1, DOES_NOT_HOLD",
        "1.05, CANNOT_BE_TOLD",
        "0.95, CANNOT_BE_TOLD",
        "2, HOLDS",
        "0.5, DOES_NOT_HOLD",
    })
    void above_isDecidedByTheQuartiles_butOfOneMeasurementByAPlainDifference(String numbers, ClaimVerdict verdict) {
        assertThat(ClaimVerdict.above(numbers(numbers), 1)).isEqualTo(verdict);
    }

    @ParameterizedTest
    @CsvSource({
        "1 1.2 1.5 1.7 2, HOLDS",
        "2 2.1 4 5 6, DOES_NOT_HOLD",
        "0.1 0.2 0.3 0.4 1, DOES_NOT_HOLD",
        "1 2 5, CANNOT_BE_TOLD",
        "2.1, CANNOT_BE_TOLD",
        "2.3, DOES_NOT_HOLD",
    })
    void within_isDecidedByTheQuartiles_butOfOneMeasurementByAPlainDifference(String numbers, ClaimVerdict verdict) {
        assertThat(ClaimVerdict.within(numbers(numbers), 1, 2)).isEqualTo(verdict);
    }

    @Test
    void verdict_isWhatAllFind_andToldOfEnoughRepetitions() {
        assertThat(HOLDS.ifRepeated(4)).isEqualTo(CANNOT_BE_TOLD);
        assertThat(HOLDS.ifRepeated(5)).isEqualTo(HOLDS);
        assertThat(ClaimVerdict.agreed(List.of(HOLDS, HOLDS))).isEqualTo(HOLDS);
        assertThat(ClaimVerdict.agreed(List.of(HOLDS, DOES_NOT_HOLD))).isEqualTo(CANNOT_BE_TOLD);
    }

    @Test
    void everythingAsThePaperSays_holds() {
        assertThat(claims())
                .hasSize(17)
                .allSatisfy(each ->
                        assertThat(each.verdict()).as(each.claim().words()).isEqualTo(HOLDS));
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "SYNC     | both          | TIME     | 4000 | DOES_NOT_HOLD | equal to a sum",
                "SYNC     | both          | TIME     | 4000 | DOES_NOT_HOLD | It [callback] is faster",
                "SYNC     | both          | TIME     | 4000 | DOES_NOT_HOLD | takes much time than the other because",
                "SYNC     | both          | TIME     | 8090 | HOLDS         | equal to a sum", // a cycle more or less
                "SYNC     | spaceWanderer | INTERVAL | 400  | DOES_NOT_HOLD | 200-300",
                "PROMISE  | both          | TIME     | 8000 | DOES_NOT_HOLD | so that promise takes as long",
                "PROMISE  | both          | TIME     | 8000 | HOLDS         | so that callback takes as long",
                "PROMISE  | both          | TIME     | 8000 | DOES_NOT_HOLD | It [promise] is faster than synchronous",
                "PROMISE  | both          | TIME     | 8000 | DOES_NOT_HOLD | " + FASTER_THAN_CALLBACK,
                "PROMISE  | both          | TIME     | 8000 | DOES_NOT_HOLD | not much time difference",
                "PROMISE  | spaceWanderer | TIME     | 4000 | DOES_NOT_HOLD | very less time",
                "CALLBACK | both          | TIME     | 4000 | HOLDS         | It [promise] is faster than synchronous",
                "CALLBACK | both          | TIME     | 4000 | DOES_NOT_HOLD | " + FASTER_THAN_CALLBACK,
            })
    void measurementThatIsDifferent_decidesAClaim(
            Mode mode, String subject, Quantity quantity, double value, ClaimVerdict verdict, String words) {
        loops(mode, subject, quantity, value);
        assertThat(verdict(words, "simulated time")).isEqualTo(verdict);
    }

    @Test
    void onTheWall_aDifferenceOfLessThanACycle_isNone() {
        var claims = PaperClaims.judge(measured(), MODES, CORES, true);
        assertThat(claims)
                .filteredOn(each -> each.claim().measure().equals("time on the wall")
                        && each.claim().words().contains(FASTER_THAN_CALLBACK))
                .singleElement()
                .extracting(PaperClaims.Judged::verdict)
                .isEqualTo(CANNOT_BE_TOLD);
        assertThat(claims)
                .filteredOn(each -> each.claim().words().contains("It [callback] is faster"))
                .singleElement()
                .extracting(PaperClaims.Judged::verdict)
                .isEqualTo(HOLDS);
    }

    @Test
    void computing_isJudgedByItself() {
        loops(Mode.CALLBACK, BOTH, Quantity.TURN, 2_000);
        loops(Mode.SYNC, BOTH, Quantity.TURN, 5_000);
        loops(Mode.PROMISE, WANDERER, Quantity.CYCLE, 9_000);
        String turn = "computing time with messages";
        assertThat(List.of(
                        "promise takes less time than callback",
                        "not much time difference",
                        "synchronously takes much"))
                .extracting(words -> verdict(words, turn))
                .containsOnly(DOES_NOT_HOLD);
        assertThat(verdict("very less time", "computing time")).isEqualTo(DOES_NOT_HOLD);
        assertThat(verdict("very less time", "simulated time")).isEqualTo(HOLDS);
    }

    @Test
    void wakingUp_decidesNothing() {
        var before = claims();
        loops(Mode.SYNC, BOTH, Quantity.PROCESSOR, 1);
        assertThat(claims()).isEqualTo(before);
    }

    @Test
    void messages_areCountedAndTimed_andNothingIsToldOfThemWithoutAChangeOfState() {
        switches(Mode.CALLBACK, Quantity.DELAY, 1);
        switches(Mode.PROMISE, Quantity.SENT, 30);
        switches(Mode.CALLBACK, Quantity.SENT, 10);
        assertThat(verdict("1-2 milliseconds", "delay of a message")).isEqualTo(DOES_NOT_HOLD);
        assertThat(verdict("only single time", "messages")).isEqualTo(DOES_NOT_HOLD);
        assertThat(verdict("repeatedly", "messages")).isEqualTo(DOES_NOT_HOLD);

        switches(Mode.PROMISE, Quantity.SENT, 10);
        assertThat(verdict("only single time", "messages")).isEqualTo(HOLDS);
        switches(Mode.PROMISE, Quantity.STATE_CHANGES, 0);
        assertThat(verdict("only single time", "messages")).isEqualTo(CANNOT_BE_TOLD);
    }

    @Test
    void incompleteRepetitions_decideNothing() {
        var two = Evaluation.Outcome.of(settings(), 2, measured());
        assertThat(two.settings().repetitions()).isEqualTo(2);
        assertThat(two.claims())
                .hasSize(17)
                .extracting(PaperClaims.Judged::verdict)
                .contains(CANNOT_BE_TOLD);
        assertThat(two.measurements().all()).hasSizeLessThan(two.all().all().size());
        assertThat(Evaluation.Outcome.of(settings(), 0, measured()).claims()).isEmpty();
    }

    @Test
    void modeThatWasNotMeasured_hasNoClaim() {
        values.keySet().removeIf(key -> key.kind() == Kind.LOOPS && key.mode() != Mode.PROMISE);
        assertThat(claims())
                .extracting(each -> each.claim().words())
                .hasSize(4)
                .noneMatch(words -> words.contains("[callback]") || words.contains("sum"));
    }

    @Test
    void differentFindingsForDifferentCores_cannotBeTold_andAreNamed() {
        var claim = new PaperClaims.Judged(
                new PaperClaims.Claim("4", "words", "time", new PaperClaims.SendsOnce()),
                List.of(new PaperClaims.Finding(1, "1 s", HOLDS), new PaperClaims.Finding(3, "2 s", DOES_NOT_HOLD)));
        assertThat(claim.verdict()).isEqualTo(CANNOT_BE_TOLD);
        assertThat(claim.ours()).isEqualTo("1 core: 1 s; 3 cores: 2 s");
    }

    // ---- figures

    private static final int BLUE = 0x4477AA;
    private static final int YELLOW = 0xDDAA33;
    private static final int GREEN = 0x228833;
    private static final List<String> SUBJECTS = List.of(FOLLOWER, WANDERER, BOTH);
    private static final String THIN_LINE = "stroke-width=\"1.2\"";

    @TempDir
    private Path out;

    private EvaluationFigures figures(Measurements measurements) {
        return new EvaluationFigures(settings(), measurements);
    }

    private EvaluationFigures figuresOfPromises(boolean realTime, Measurements measurements) {
        var settings = new Evaluation.Settings(
                out, 10, List.of(2), List.of(Mode.PROMISE), 1, 0, 10, false, realTime, out.resolve("log"));
        return new EvaluationFigures(settings, measurements);
    }

    @Test
    void everyFigureOfThePaper_saysWhatItFound_inSeconds() throws Exception {
        var charts = figures(measured()).charts();

        assertThat(charts.keySet())
                .containsExactly("evaluation-15", "evaluation-18", "evaluation-21", "evaluation-22", "evaluation-23");
        assertThat(ParsedSvg.parse(charts.get("evaluation-15").svg()).texts())
                .contains("sync: both services take 8 s, the wall follower 4 s and the space wanderer 1 s")
                .contains("JVM with 2 cores", "JVM with 3 cores", "Simulated time, s for 1000 loops");
        String title = "Both services take: sync 8 s, callback 4.01 s, promise 4 s";
        var svg = ParsedSvg.parse(charts.get("evaluation-23").svg());
        assertThat(svg.texts())
                .contains(title, "Figure 23 of the paper, 1000 loops of each service, on a JVM with 3 cores")
                .contains("sync", "callback", "promise", "8", "4.01", "4");
        assertThat(svg.title()).isEqualTo(title);
    }

    @Test
    void files_arePicturesWithBarsAsHighAsTheNumbers() throws Exception {
        var names = figures(measured()).write(out);
        assertThat(names).hasSize(5);
        for (String name : names) {
            var svg = Files.readString(out.resolve(name + ".svg"));
            assertThat(svg).contains("#ddaa33").doesNotContain("NaN");
            ParsedSvg.parse(svg).assertWordsAreOnThePage();
        }
        BufferedImage all = ImageIO.read(out.resolve("evaluation-23.png").toFile());
        int left = all.getWidth() / 2;
        // the tallest column of a colour on the left is the bar of both services: 8, 4.01 and 4 s
        int sync = tallest(all, left, BLUE);
        assertThat(sync).isGreaterThan(100);
        assertThat(tallest(all, left, YELLOW) / (double) sync).isBetween(0.47, 0.53);
        assertThat(tallest(all, left, GREEN) / (double) sync).isBetween(0.47, 0.53);
    }

    private static int tallest(BufferedImage image, int width, int colour) {
        int tallest = 0;
        for (int x = 0; x < width; x++) {
            int height = 0;
            for (int y = 0; y < image.getHeight(); y++) {
                height = (image.getRGB(x, y) & 0xFFFFFF) == colour ? height + 1 : 0;
                tallest = Math.max(tallest, height);
            }
        }
        return tallest;
    }

    @Test
    void whatWasMeasuredOnce_hasNoSpread_andModesThatWereNotMeasuredHaveNoFigure() throws Exception {
        var once = new Measurements();
        var often = new Measurements();
        for (int repetition = 1; repetition <= 5; repetition++) {
            for (var each : measured().all()) {
                double value = each.value() * repetition;
                var varied = new Measurement(
                        each.kind(), each.mode(), each.cores(), repetition, each.subject(), each.quantity(), value);
                often.add(varied);
                if (repetition == 1) {
                    once.add(varied);
                }
            }
        }
        String single =
                figuresOfPromises(true, once).charts().get("evaluation-21").svg();
        assertThat(ParsedSvg.parse(single).texts()).contains("Computing time, µs for a loop, measured once");
        assertThat(single).doesNotContain(THIN_LINE);
        String repeated = figures(often).charts().get("evaluation-21").svg();
        assertThat(repeated).contains(THIN_LINE);
        assertThat(figuresOfPromises(false, measured()).charts()).containsOnlyKeys("evaluation-21");
    }

    /** {@code -Dfigures=write} writes the documented figures. */
    @Test
    void picturesInTheDocumentation_areThoseOfTheTableThere() throws Exception {
        String guide = Files.readString(Path.of("..", "docs", "guide", "11-measurements.md"));
        var charts = figures(documented(guide)).charts();

        for (int figure : new int[] {15, 22, 23}) {
            String name = "evaluation-" + figure;
            Path file = Path.of("..", "docs", "figures", name + ".svg");
            if ("write".equals(System.getProperty("figures"))) {
                Files.writeString(file, charts.get(name).svg());
            }
            assertThat(file).hasContent(charts.get(name).svg());
            assertThat(guide).contains("(../figures/" + name + ".svg)");
        }
    }

    /** Five repetitions with the documented medians and quartiles. */
    private static Measurements documented(String guide) {
        var measurements = new Measurements();
        String spread = " +([\\d.]+) \\(([\\d.]+?)\\.\\.([\\d.]+)\\) +\\|";
        var row = Pattern.compile("(?m)^\\| (\\w+) +\\| (\\d) +\\| ([\\d.]+) s +\\|" + spread + spread + spread)
                .matcher(guide);
        var alone = Pattern.compile("by themselves ([\\d.]+) s and ([\\d.]+) s").matcher(guide);
        assertThat(alone.find()).isTrue();
        while (row.find()) {
            Mode mode = Mode.valueOf(row.group(1).toUpperCase(Locale.ROOT));
            int cores = Integer.parseInt(row.group(2));
            for (int repetition = 1; repetition <= 5; repetition++) {
                for (int column = 0; column < 3; column++) {
                    String subject = SUBJECTS.get(column);
                    int group = 4 + 3 * column + (repetition < 3 ? 1 : repetition == 3 ? 0 : 2);
                    double seconds = Double.parseDouble(column == 2 ? row.group(3) : alone.group(column + 1));
                    double micros = Double.parseDouble(row.group(group));
                    var computing = column == 2 ? Quantity.TURN : Quantity.CYCLE;
                    measurements.add(new Measurement(
                            Kind.LOOPS, mode, cores, repetition, subject, Quantity.TIME, 1000 * seconds));
                    measurements.add(new Measurement(Kind.LOOPS, mode, cores, repetition, subject, computing, micros));
                }
            }
        }
        assertThat(measurements.all()).hasSize(6 * 5 * 3 * 2);
        return measurements;
    }
}
