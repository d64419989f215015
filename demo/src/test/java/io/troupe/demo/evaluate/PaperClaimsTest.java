package io.troupe.demo.evaluate;

import static io.troupe.demo.evaluate.ClaimVerdict.CANNOT_BE_TOLD;
import static io.troupe.demo.evaluate.ClaimVerdict.DOES_NOT_HOLD;
import static io.troupe.demo.evaluate.ClaimVerdict.HOLDS;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.demo.evaluate.Measurement.Kind;
import io.troupe.demo.evaluate.Measurement.Quantity;
import io.troupe.services.subsumption.Mode;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** Each verdict is tested in both directions. */
class PaperClaimsTest {
    private static ClaimVerdict verdict(SyntheticMeasurements made, String words, String measure) {
        return made.claims().stream()
                .filter(judged -> judged.claim().words().contains(words)
                        && judged.claim().measure().equals(measure))
                .findFirst()
                .orElseThrow()
                .verdict();
    }

    private static ClaimVerdict inTime(SyntheticMeasurements made, String words) {
        return verdict(made, words, "simulated time");
    }

    @Test
    void everythingAsThePaperSays_holds() {
        assertThat(SyntheticMeasurements.confirmingThePaper().claims())
                .hasSize(17)
                .allSatisfy(each ->
                        assertThat(each.verdict()).as(each.claim().words()).isEqualTo(HOLDS));
    }

    @Test
    void synchronousThatTakesNoLongerThanTheOthers_contradictsThreeClaims() {
        var made = SyntheticMeasurements.confirmingThePaper().loops(Mode.SYNC, Measurement.BOTH, Quantity.TIME, 4_000);
        assertThat(inTime(made, "equal to a sum")).isEqualTo(DOES_NOT_HOLD);
        assertThat(inTime(made, "It [callback] is faster")).isEqualTo(DOES_NOT_HOLD);
        assertThat(inTime(made, "takes much time than the other because")).isEqualTo(DOES_NOT_HOLD);
    }

    @Test
    void asynchronousThatTakesTheSum_isNotAsLongAsTheLonger() {
        var made =
                SyntheticMeasurements.confirmingThePaper().loops(Mode.PROMISE, Measurement.BOTH, Quantity.TIME, 8_000);
        assertThat(inTime(made, "so that promise takes as long")).isEqualTo(DOES_NOT_HOLD);
        assertThat(inTime(made, "so that callback takes as long")).isEqualTo(HOLDS);
        assertThat(inTime(made, "It [promise] is faster than synchronous")).isEqualTo(DOES_NOT_HOLD);
        assertThat(inTime(made, "It [promise] is faster than [..] actor with callback"))
                .isEqualTo(DOES_NOT_HOLD);
        assertThat(inTime(made, "not much time difference")).isEqualTo(DOES_NOT_HOLD);
    }

    @Test
    void aCycleMoreOrLess_isTheSame() {
        var made = SyntheticMeasurements.confirmingThePaper().loops(Mode.SYNC, Measurement.BOTH, Quantity.TIME, 8_090);
        assertThat(inTime(made, "equal to a sum")).isEqualTo(HOLDS);
    }

    @Test
    void onTheWall_aDifferenceOfLessThanACycle_isNone() {
        var claims = PaperClaims.judge(
                SyntheticMeasurements.confirmingThePaper().measurements(),
                SyntheticMeasurements.MODES,
                SyntheticMeasurements.CORES,
                true);
        assertThat(claims)
                .filteredOn(each -> each.claim().measure().equals("time on the wall")
                        && each.claim().words().contains("It [promise] is faster than [..] actor with callback"))
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
        var made = SyntheticMeasurements.confirmingThePaper()
                .loops(Mode.CALLBACK, Measurement.BOTH, Quantity.TURN, 2_000)
                .loops(Mode.SYNC, Measurement.BOTH, Quantity.TURN, 5_000)
                .loops(Mode.PROMISE, Measurement.WANDERER, Quantity.CYCLE, 9_000);
        String turn = "computing time with messages";
        assertThat(verdict(made, "promise takes less time than callback", turn)).isEqualTo(DOES_NOT_HOLD);
        assertThat(verdict(made, "not much time difference", turn)).isEqualTo(DOES_NOT_HOLD);
        assertThat(verdict(made, "synchronously takes much", turn)).isEqualTo(DOES_NOT_HOLD);
        assertThat(verdict(made, "very less time", "computing time")).isEqualTo(DOES_NOT_HOLD);
        assertThat(inTime(made, "very less time")).isEqualTo(HOLDS);
    }

    @Test
    void wakingUp_decidesNothing() {
        var made = SyntheticMeasurements.confirmingThePaper();
        var before = made.claims();
        made.loops(Mode.SYNC, Measurement.BOTH, Quantity.PROCESSOR, 1);
        assertThat(made.claims()).isEqualTo(before);
    }

    @Test
    void promise_isComparedWithEachOfTheOthers() {
        var made =
                SyntheticMeasurements.confirmingThePaper().loops(Mode.CALLBACK, Measurement.BOTH, Quantity.TIME, 4_000);
        assertThat(inTime(made, "It [promise] is faster than synchronous")).isEqualTo(HOLDS);
        assertThat(inTime(made, "It [promise] is faster than [..] actor with callback"))
                .isEqualTo(DOES_NOT_HOLD);
    }

    @Test
    void wandererThatTakesAsLong_doesNotTakeLess() {
        var made = SyntheticMeasurements.confirmingThePaper()
                .loops(Mode.PROMISE, Measurement.WANDERER, Quantity.TIME, 4_000);
        assertThat(inTime(made, "very less time")).isEqualTo(DOES_NOT_HOLD);
    }

    @Test
    void cyclesFurtherApart_areNotFast() {
        var made = SyntheticMeasurements.confirmingThePaper()
                .loops(Mode.SYNC, Measurement.WANDERER, Quantity.INTERVAL, 400);
        assertThat(inTime(made, "200-300")).isEqualTo(DOES_NOT_HOLD);
    }

    @Test
    void messages_areCountedAndTimed() {
        var made = SyntheticMeasurements.confirmingThePaper()
                .add(Kind.SWITCHES, Mode.CALLBACK, Measurement.BOTH, Quantity.DELAY, 1)
                .add(Kind.SWITCHES, Mode.PROMISE, Measurement.BOTH, Quantity.SENT, 30)
                .add(Kind.SWITCHES, Mode.CALLBACK, Measurement.BOTH, Quantity.SENT, 10);
        assertThat(verdict(made, "1-2 milliseconds", "delay of a message")).isEqualTo(DOES_NOT_HOLD);
        assertThat(verdict(made, "only single time", "messages")).isEqualTo(DOES_NOT_HOLD);
        assertThat(verdict(made, "repeatedly", "messages")).isEqualTo(DOES_NOT_HOLD);
    }

    @Test
    void incompleteRepetitions_decideNothing(@TempDir Path directory) {
        var settings = SyntheticMeasurements.settings(directory);
        var all = SyntheticMeasurements.confirmingThePaper().measurements();
        var two = Evaluation.Outcome.of(settings, 2, all);
        assertThat(two.settings().repetitions()).isEqualTo(2);
        assertThat(two.claims())
                .hasSize(17)
                .extracting(PaperClaims.Judged::verdict)
                .contains(CANNOT_BE_TOLD);
        assertThat(two.measurements().all()).hasSizeLessThan(two.all().all().size());
        assertThat(Evaluation.Outcome.of(settings, 0, all).claims()).isEmpty();
    }

    @Test
    void noChangeOfState_tellsNothingOfMessages() {
        var made = SyntheticMeasurements.confirmingThePaper()
                .add(Kind.SWITCHES, Mode.PROMISE, Measurement.BOTH, Quantity.STATE_CHANGES, 0);
        assertThat(verdict(made, "only single time", "messages")).isEqualTo(CANNOT_BE_TOLD);
    }

    @Test
    void modeThatWasNotMeasured_hasNoClaim() {
        var made = SyntheticMeasurements.confirmingThePaper()
                .forget(Kind.LOOPS, Mode.SYNC)
                .forget(Kind.LOOPS, Mode.CALLBACK);
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
