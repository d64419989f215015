package io.troupe.demo.verify;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.demo.verify.ReadingStudy.Statement;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.PetriNetBuilder;
import java.util.List;
import org.junit.jupiter.api.Test;

/** Every statement of section 5, with our numbers. */
class ReadingStudyTest {
    private static final ReadingStudy A = ReadingStudy.of(Reading.A, progress -> {});
    private static final ReadingStudy B = ReadingStudy.of(Reading.B, progress -> {});

    private static Statement statement(ReadingStudy study, String claim) {
        return study.statements().stream()
                .filter(each -> each.claim().contains(claim))
                .reduce((one, other) -> {
                    throw new AssertionError("two statements with " + claim);
                })
                .orElseThrow();
    }

    @Test
    void statements_allHold_butInReadingBTheNumberOfSiphons() {
        assertThat(A.statements()).hasSize(12).allMatch(Statement::holds);
        assertThat(B.statements())
                .filteredOn(each -> !each.holds())
                .singleElement()
                .satisfies(each -> assertThat(each.ours()).startsWith("36 minimal siphons"));
    }

    @Test
    void siphons_otherReadingsWithTheSameNumber_areNamed() {
        assertThat(statement(A, "44 minimal siphons").ours()).startsWith("44 minimal siphons");
        assertThat(UncorrectedStatements.OtherReading.all())
                .extracting(UncorrectedStatements.OtherReading::minimalSiphons)
                .isEqualTo(List.of(44, 44, 44, 44, 32, 40, 36));
    }

    @Test
    void emptiedSiphons_threeRoutesAgree() {
        for (var study : List.of(A.uncorrected(), A.corrected(), B.uncorrected(), B.corrected())) {
            assertThat(study.emptiedByTheStateEquation())
                    .isEqualTo(study.emptied().size());
            assertThat(study.withoutMarkedTrap()).isEqualTo(study.emptied());
        }
        assertThat(A.uncorrected().emptied()).hasSize(20);
        assertThat(B.uncorrected().emptied()).hasSize(12);
        assertThat(A.corrected().emptied()).isEmpty();
        assertThat(A.corrected().fewestTokens()).isEqualTo(1);
    }

    @Test
    void deadlock_isToldInWords_andOfReadingBThePartialOneToo() {
        var statement = statement(A, "has a deadlock");

        assertThat(statement.ours()).isEqualTo("6 of 1264 reachable markings are dead");
        assertThat(statement.details())
                .contains("{P1, M1, S10, R7''} after 14 firings", " 7. Tp4     player stops")
                .contains("never left again once marked together: [M1, S10], in 36 markings, first after 6 firings")
                .noneMatch(line -> line.contains("partial deadlock"));
        assertThat(statement(B, "has a deadlock").details())
                .anyMatch(line -> line.startsWith("besides, a partial deadlock: 8 markings"));
    }

    @Test
    void causes_haveTheirShortestWays() {
        var player = statement(A, "player may stop at P4");
        assertThat(player.ours()).contains("in 32 markings", "first after 8 firings", "in 2 of the 6 dead");
        assertThat(player.details()).hasSize(8).last().isEqualTo(" 8. Tr4''   robot asks player to set values");
        var service = statement(A, "after Tms2'' service may stop");
        assertThat(service.ours()).contains("in 36 markings", "first after 21 firings", "in 3 of the 6 dead");
        assertThat(service.details()).hasSize(21);
    }

    @Test
    void lowPriority_removesTheDeadlockAndTheStop() {
        String expected =
                "360 markings, 0 dead; stops that ever fire: none; R10 is never marked; terminal components: 1";
        assertThat(statement(A, "lower priority").ours()).isEqualTo(expected);
    }

    @Test
    void correctedNet_mustStopOnceRobotWantsTo() {
        var statement = statement(A, "no other path");
        assertThat(statement.ours())
                .isEqualTo("R10 is marked in 69 markings, and Tstop may fire in 1 of all; from R10 every way leads to"
                        + " it, after at most 21 other firings");
        assertThat(statement.details()).singleElement().asString().contains("after 27 firings");
    }

    /** Returns what is said of a corrected statement that does not hold for a net. */
    private static String refuted(PetriNetBuilder net, int statement) {
        var judged = new CorrectedStatements(NetStudy.of(net.build())).all().get(statement);
        assertThat(judged.holds()).isFalse();
        return judged.ours();
    }

    private static PetriNetBuilder corrected() {
        return A.corrected().net().toBuilder();
    }

    @Test
    void inevitability_ofANetInWhichRobotNeedNotStop_orNeverWantsTo_doesNotHold() {
        // Tstop is the only way on from R10; with a cycle beside it, it need never fire
        var idle = corrected().transition("idle", List.of("R10", "M4"), List.of("R10", "M4"));
        assertThat(refuted(idle, 0)).endsWith("not every way from R10 leads to it");

        // no cycle avoids Tstop while R10 is marked, but another transition takes its token
        refuted(corrected().transition("back", List.of("R10"), List.of("R5")), 0);

        var never = corrected()
                .remove("Tr6")
                .transition("other", List.of("R9"), List.of("R9"))
                .transition("Tr6", List.of("R9", "R10"), List.of("R10"));
        assertThat(refuted(never, 0)).startsWith("R10 is marked in 0 markings");
        refuted(never, 3);
    }

    /** Still only Tstop puts tokens back on P1, but player does not need it to give proxies again. */
    @Test
    void oneTimeOnly_ofANetInWhichRobotMayAskAgain_doesNotHold() {
        var net = corrected().transition("ask again", List.of("R5", "P4"), List.of("R4''", "P2''"));
        assertThat(refuted(net, 1)).endsWith("without Tstop between: [Trp2'']");
    }

    /** The statement is about the given net, not about the paper's. */
    @Test
    void deadlockFreedom_ofANetWithoutIt_isNotSaidToBeProved() {
        var net = corrected().place("gone").transition("leave", List.of("R10"), List.of("gone"));
        assertThat(refuted(net, 4)).endsWith("its siphons alone do not prove it");
    }
}
