package io.troupe.demo.evaluate;

import static io.troupe.demo.evaluate.ClaimVerdict.CANNOT_BE_TOLD;
import static io.troupe.demo.evaluate.ClaimVerdict.DOES_NOT_HOLD;
import static io.troupe.demo.evaluate.ClaimVerdict.HOLDS;
import static io.troupe.demo.evaluate.Measurement.BOTH;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.demo.evaluate.Measurement.Kind;
import io.troupe.demo.evaluate.Measurement.Quantity;
import io.troupe.services.subsumption.Mode;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** The rules that decide a claim, and each verdict in both directions. */
class PaperClaimsTest {
    private static final String FASTER_THAN_CALLBACK = "It [promise] is faster than [..] actor with callback";

    private final SyntheticMeasurements made = SyntheticMeasurements.confirmingThePaper();

    private ClaimVerdict verdict(String words, String measure) {
        return made.claims().stream()
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
        assertThat(made.claims())
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
        made.loops(mode, subject, quantity, value);
        assertThat(verdict(words, "simulated time")).isEqualTo(verdict);
    }

    @Test
    void onTheWall_aDifferenceOfLessThanACycle_isNone() {
        var claims = PaperClaims.judge(
                made.measurements(), SyntheticMeasurements.MODES, SyntheticMeasurements.CORES, true);
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
        made.loops(Mode.CALLBACK, BOTH, Quantity.TURN, 2_000)
                .loops(Mode.SYNC, BOTH, Quantity.TURN, 5_000)
                .loops(Mode.PROMISE, Measurement.WANDERER, Quantity.CYCLE, 9_000);
        String turn = "computing time with messages";
        assertThat(List.of("promise takes less time than callback", "not much time difference", "synchronously takes much"))
                .extracting(words -> verdict(words, turn))
                .containsOnly(DOES_NOT_HOLD);
        assertThat(verdict("very less time", "computing time")).isEqualTo(DOES_NOT_HOLD);
        assertThat(verdict("very less time", "simulated time")).isEqualTo(HOLDS);
    }

    @Test
    void wakingUp_decidesNothing() {
        var before = made.claims();
        made.loops(Mode.SYNC, BOTH, Quantity.PROCESSOR, 1);
        assertThat(made.claims()).isEqualTo(before);
    }

    @Test
    void messages_areCountedAndTimed_andNothingIsToldOfThemWithoutAChangeOfState() {
        made.add(Kind.SWITCHES, Mode.CALLBACK, BOTH, Quantity.DELAY, 1)
                .add(Kind.SWITCHES, Mode.PROMISE, BOTH, Quantity.SENT, 30)
                .add(Kind.SWITCHES, Mode.CALLBACK, BOTH, Quantity.SENT, 10);
        assertThat(verdict("1-2 milliseconds", "delay of a message")).isEqualTo(DOES_NOT_HOLD);
        assertThat(verdict("only single time", "messages")).isEqualTo(DOES_NOT_HOLD);
        assertThat(verdict("repeatedly", "messages")).isEqualTo(DOES_NOT_HOLD);

        made.add(Kind.SWITCHES, Mode.PROMISE, BOTH, Quantity.SENT, 10)
                .add(Kind.SWITCHES, Mode.PROMISE, BOTH, Quantity.STATE_CHANGES, 0);
        assertThat(verdict("only single time", "messages")).isEqualTo(CANNOT_BE_TOLD);
    }

    @Test
    void incompleteRepetitions_decideNothing(@TempDir Path directory) {
        var settings = SyntheticMeasurements.settings(directory);
        var two = Evaluation.Outcome.of(settings, 2, made.measurements());
        assertThat(two.settings().repetitions()).isEqualTo(2);
        assertThat(two.claims())
                .hasSize(17)
                .extracting(PaperClaims.Judged::verdict)
                .contains(CANNOT_BE_TOLD);
        assertThat(two.measurements().all()).hasSizeLessThan(two.all().all().size());
        assertThat(Evaluation.Outcome.of(settings, 0, made.measurements()).claims()).isEmpty();
    }

    @Test
    void modeThatWasNotMeasured_hasNoClaim() {
        made.forget(Kind.LOOPS, Mode.SYNC).forget(Kind.LOOPS, Mode.CALLBACK);
        assertThat(made.claims())
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
}
