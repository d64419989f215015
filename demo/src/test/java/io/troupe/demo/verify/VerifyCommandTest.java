package io.troupe.demo.verify;

import static io.troupe.petri.wiring.Protocol.acquires;
import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.releases;
import static io.troupe.petri.wiring.Protocol.requests;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.demo.CommandLineBench;
import io.troupe.demo.monitor.RunWiring;
import io.troupe.demo.verify.ReadingStudy.Statement;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.PetriNet;
import io.troupe.petri.PetriNetBuilder;
import io.troupe.petri.Pnml;
import io.troupe.petri.wiring.Protocol;
import io.troupe.petri.wiring.Wiring;
import io.troupe.petri.wiring.WiringCheck;
import io.troupe.petri.wiring.WiringResult;
import io.troupe.services.subsumption.Mode;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.parallel.Execution;
import org.junit.jupiter.api.parallel.ExecutionMode;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** {@code troupe verify}, every statement of section 5 with our numbers, and our wiring. */
@Execution(ExecutionMode.CONCURRENT)
class VerifyCommandTest extends CommandLineBench {
    private PetriNet net(String name) {
        return Pnml.read(directory.resolve(name + ".pnml"));
    }

    @Test
    void verify_printsBothSidesAndWritesNetsDrawingsAndReport() throws IOException {
        assertThat(printed("verify --robots 2 --out DIR"))
                .contains(
                        "holds   5.5.4: there are 44 minimal siphons\n          ours: 44 minimal siphons",
                        "DIFFERS 5.5.4: there are 44 minimal siphons\n          ours: 36 minimal siphons",
                        "2 robots: 18 dead",
                        "a colour is a promise: proved free of deadlock");
        for (var reading : Reading.values()) {
            assertThat(net("uncorrected-" + reading).sameStructureAs(PaperNets.uncorrected(reading)))
                    .isTrue();
            assertThat(net("corrected-" + reading).sameStructureAs(PaperNets.corrected(reading)))
                    .isTrue();
            assertWritten("deadlock-" + reading + ".svg", "graph-uncorrected-" + reading + ".svg");
            assertWritten("graph-robot-player-" + reading + ".dot");
        }
        for (var name : List.of("uncorrected-A.svg", "corrected-A.svg", "graph-robot-player-A.svg")) {
            assertThat(directory.resolve(name))
                    .as("the picture in the guide")
                    .hasSameTextualContentAs(Path.of("..", "docs", "figures", name));
        }
        assertThat(written("verify.md"))
                .contains(
                        "| minimal siphons | 44 | 48 | 36 | 48 |",
                        "| reachable markings / edges | 1264 / 3706 | 429 / 1084 | 1104 / 3236 | 363 / 913 |",
                        " 7. Tp4     player stops",
                        "arbitrator waits for stopper1.done; stopper1 waits for service1.stop; service1 waits for arbitrator.colour");
    }

    /** Returns the exit status; only what is printed now is kept. */
    private int verify(PetriNet net, String options) {
        out.getBuffer().setLength(0);
        Pnml.write(net, directory.resolve("net.pnml"));
        return troupe("verify --net DIR/net.pnml --out DIR/o " + options);
    }

    @Test
    void verify_ofAFile_tellsWhatIsKnownOfIt() {
        assertThat(verify(PaperNets.uncorrected(Reading.A), "")).isEqualTo(1);

        assertThat(out.toString())
                .startsWith("uncorrected A: can deadlock: 6 dead markings, the nearest {P1, M1, S10, R7''} after [")
                .contains(
                        "1264 markings, 3706 edges, all of them",
                        "dead markings: 6, the nearest {P1, M1, S10, R7''}",
                        "live NO, reversible NO")
                .endsWith(local("wrote, as .dot and .svg: DIR/o/net, DIR/o/net-deadlock, DIR/o/net-graph\n"));
        assertWritten("o/net.svg", "o/net-deadlock.svg", "o/net-graph.dot");
    }

    @Test
    void exitStatus_tellsTheVerdict() {
        assertThat(verify(PaperNets.corrected(Reading.A), "")).isZero();
        assertThat(out.toString()).startsWith("corrected A: proved: no reachable marking is dead (");
        assertThat(verify(PaperNets.uncorrected(Reading.A), "--time 0.000001")).isEqualTo(3);
        assertThat(out.toString())
                .contains("uncorrected A: not known whether it can deadlock: no dead marking among 1 by stubborn sets,"
                        + " then half of the 0.000001 s was over (--time)\n");
        assertThat(printed("verify --help").replaceAll("\\s+", " "))
                .contains(
                        "0 done; with --net: proved",
                        "1 failed; with --net: the net can deadlock",
                        "2 bad input",
                        "3 with --net: not known");
    }

    @Test
    void netWithoutBounds_isNotKnownOnceTheMemoryIsUsedUp_unlessItIsDecidedBefore() {
        // the reductions do not decide it: b would inhibit, but is never marked
        var inhibited =
                PetriNet.builder("growing").place("f", 1).place("g").place("b").place("many");
        inhibited.transition("fg", List.of("f"), List.of("g")).transition("gf", List.of("g"), List.of("f"));
        inhibited.transition("both", List.of("f", "g"), List.of("b"));
        inhibited.transition("up", List.of("f"), List.of("f", "many")).inhibitor("b", "up");
        inhibited.transition("down", List.of("f", "many"), List.of("f"));
        assertThat(verify(inhibited.build(), "--memory 1 --time 600")).isEqualTo(3);
        assertThat(out.toString())
                .contains("growing: not known whether it can deadlock: no dead marking among ")
                .contains("then the memory was used up (--memory)\n", "growing: out of memory at ");

        // thousands of markings, all with a way back
        var consumed = PetriNet.builder("stock").place("on", 1).place("many");
        consumed.transition("make", List.of("on"), List.of("on", "many")).transition("use", List.of("many"), List.of());
        assertThat(verify(consumed.build(), "--memory 1")).isZero();
        assertThat(out.toString()).startsWith("stock: proved: no reachable marking is dead (");

        var growing = PetriNet.builder("growing").place("a", 1).place("many");
        growing.transition("t", List.of("a"), List.of("a", "many"));
        assertThat(verify(growing.build(), "--memory 1")).isZero();
        assertThat(out.toString()).startsWith("growing: proved: no reachable marking is dead (");

        // thousands of dead markings, each a terminal component
        var ends = PetriNet.builder("ends").place("on", 1).place("off").place("many");
        ends.transition("go", List.of("on"), List.of("on", "many")).transition("end", List.of("on"), List.of("off"));
        assertThat(verify(ends.build(), "--memory 4")).isEqualTo(1);
        assertThat(out.toString())
                .containsPattern("ends: can deadlock: \\d{4,} dead markings so far, the nearest \\{off} after \\[end]");
        assertThat(out.toString().lines()).hasSizeLessThan(50);
    }

    /** Nested acquisitions, whose firings are delayed, beside so many philosophers that the net is reduced. */
    @Test
    void netOfNestedAcquisitions_canDeadlock() {
        var server = Protocol.of("server")
                .state("s0", acquires("r1").then("s1"))
                .state("s1", acquires("r2").then("s2"))
                .state("s2", provides("go").then("s3"))
                .state("s3", releases("r2").then("s4"))
                .state("s4", releases("r1").then("s0"));
        var user = Protocol.of("user")
                .state("u", does("well").then("call"), does("badly").then("stuck"))
                .state("call", requests("server.go").then("u"))
                .state("stuck", acquires("lock").then("held"))
                .state("held", acquires("lock").then("twice"))
                .state("twice", releases("lock").then("held"));
        var fork = Protocol.of("fork")
                .state("free", provides("take").then("taken"))
                .state("taken", provides("put").then("free"))
                .build();
        var philosopher = Protocol.of("phil")
                .state("thinking", requests("left.take").then("has left"))
                .state("has left", requests("right.take").then("eating"))
                .state("eating", requests("left.put").then("has right"))
                .state("has right", requests("right.put").then("thinking"))
                .build();
        var count = 50;
        var wiring = Wiring.of("nested").component(server.build()).component(user.build());
        List.of("r1", "r2", "lock").forEach(resource -> wiring.resource(resource, 1));
        wiring.components("phil", count, philosopher).components("fork", count, fork);
        for (var i = 1; i <= count; i++) {
            wiring.bind("phil" + i, "left", "fork" + i).bind("phil" + i, "right", "fork" + (i % count + 1));
        }
        var hour = Duration.ofHours(1);
        var results = new StringBuilder();
        var examination = new NetExamination(
                wiring.build().net(),
                new NetExamination.Limits(hour, () -> hour, 4 << 20),
                progress -> {},
                results::append);
        assertThat(examination.decide()).isEqualTo(NetExamination.CAN_DEADLOCK);
        assertThat(results.toString()).startsWith("nested: can deadlock: ").contains("user.held");
    }

    /** 2^24 markings, of which the last one is dead: stubborn sets find it, the full graph does not. */
    @Test
    void whatTheVerdictDecides_isNotCalledUnknownBelow() {
        var net = PetriNet.builder("switches");
        for (var i = 0; i < 24; i++) {
            net.place("off" + i, 1).place("on" + i).transition("t" + i, List.of("off" + i), List.of("on" + i));
        }
        assertThat(verify(net.build(), "--memory 1")).isEqualTo(1);
        assertThat(out.toString())
                .startsWith("switches: can deadlock: 1 dead marking, the nearest ")
                .contains("switches: out of memory at ", "switches: live NO, reversible NO: nothing leads on from")
                .doesNotContain("UNKNOWN", "not known");
    }

    /** The layout of a larger net takes minutes or overflows the stack; the verdict must be printed anyway. */
    @Test
    void largeNet_isDecidedAndNotDrawn() {
        var net = PetriNet.builder("ring").place("p0", 1);
        for (var i = 1; i < 300; i++) {
            net.place("p" + i);
        }
        for (var i = 0; i < 300; i++) {
            net.transition("t" + i, List.of("p" + i), List.of("p" + (i + 1) % 300));
        }

        assertThat(verify(net.build(), "--time 3600")).isZero();
        assertThat(out.toString())
                .startsWith("ring: proved: no reachable marking is dead (300 markings by stubborn sets)\n")
                .contains("no .svg of the net, which has 600 places and transitions (drawn up to 400)")
                .contains(local("wrote, as .dot: DIR/o/net"));
        assertWritten("o/net.dot");
        assertMissing("o/net.svg");
    }

    /** Each of three jobs takes a token of four thousand million; the other net is dead only after all of them. */
    @Test
    void netWithMoreTokensThanAnInt_isDecidedAndDrawn() throws IOException {
        file("jobs.pnml", lake("<arc id='a' source='job' target='t'/>"));
        assertThat(troupe("verify --net DIR/jobs.pnml --out DIR/o")).isEqualTo(1);
        assertThat(out)
                .asString()
                .startsWith("n: can deadlock: 1 dead marking, the nearest {3999999997*lake} after [t, t, t]\n");
        assertThat(err.toString()).isEmpty();
        assertWritten("o/jobs.dot");

        out.getBuffer().setLength(0);
        file("lake.pnml", lake(""));
        assertThat(troupe("verify --net DIR/lake.pnml --out DIR/o --time 2 --memory 20"))
                .isEqualTo(3);
        assertThat(out.toString()).startsWith("n: not known whether it can deadlock: no dead marking among ");

        file("more.pnml", lake("").replace("4000000000", "9223372036854775808"));
        assertRefused(
                "verify --net DIR/more.pnml --out DIR/o",
                "troupe: DIR/more.pnml:2: the initial marking of place lake is \"9223372036854775808\"");
    }

    private static String lake(String arc) {
        return """
                <pnml xmlns="http://www.pnml.org/version-2009/grammar/pnml"><net id="n"
                type="http://www.pnml.org/version-2009/grammar/ptnet"><page id="g"><place id="lake"><initialMarking>\
                <text>4000000000</text></initialMarking></place><place id="job"><initialMarking><text>3</text>
                </initialMarking></place><transition id="t"/><arc id="b" source="lake" target="t"/>%s</page></net></pnml>
                """.formatted(arc);
    }

    @Test
    void verdict_standsAlthoughNoPictureCanBeWritten_andAFileOfAnotherToolIsReadWithAWarning() throws IOException {
        Files.createDirectories(directory.resolve("o/net.dot"));
        assertThat(verify(PaperNets.corrected(Reading.A), "")).isZero();
        assertThat(out.toString()).startsWith("corrected A: proved");
        assertThat(err.toString()).startsWith("troupe: the pictures cannot be written: ");

        file("other.pnml", "<pnml><net id='n' type='PTNet'><transition id='t'/></net></pnml>");
        err.getBuffer().setLength(0);
        printed("verify --net DIR/other.pnml --out DIR");
        assertThat(err.toString()).startsWith(local("troupe: warning: DIR/other.pnml:1: the namespace is \"\""));
    }

    @Test
    void limits_outOfRange_areRefused() {
        assertRefused("verify --time 0", "--time is 0.0, expected seconds above 0, up to 1000000");
        assertRefused("verify --memory 0", "--memory is 0, expected MiB, 1 or more");
        assertRefused("verify --robots 0", "--robots is 0, expected a number from 1 to 7");
    }

    // ---- the statements of the paper

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
    void siphons_otherReadingsAreNamed_andThreeRoutesToTheEmptiedOnesAgree() {
        assertThat(statement(A, "44 minimal siphons").ours()).startsWith("44 minimal siphons");
        assertThat(UncorrectedStatements.OtherReading.all())
                .extracting(UncorrectedStatements.OtherReading::minimalSiphons)
                .isEqualTo(List.of(44, 44, 44, 44, 32, 40, 36));
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
    void correctedNet_mustStopOnceRobotWantsTo_andLowPriorityRemovesTheDeadlockAndTheStop() {
        var statement = statement(A, "no other path");
        assertThat(statement.ours())
                .isEqualTo("R10 is marked in 69 markings, and Tstop may fire in 1 of all; from R10 every way leads to"
                        + " it, after at most 21 other firings");
        assertThat(statement.details()).singleElement().asString().contains("after 27 firings");
        String withPriority =
                "360 markings, 0 dead; stops that ever fire: none; R10 is never marked; terminal components: 1";
        assertThat(statement(A, "lower priority").ours()).isEqualTo(withPriority);
    }

    /** Returns our numbers for a statement about the corrected net, which does not hold for a changed one. */
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

    @Test
    void oneTimeOnly_andDeadlockFreedom_ofNetsWithoutThem_doNotHold() {
        // still only Tstop puts tokens back on P1, but player does not need it to give proxies again
        var again = corrected().transition("ask again", List.of("R5", "P4"), List.of("R4''", "P2''"));
        assertThat(refuted(again, 1)).endsWith("without Tstop between: [Trp2'']");

        // the statement is about the given net, not about the paper's
        var leaving = corrected().place("gone").transition("leave", List.of("R10"), List.of("gone"));
        assertThat(refuted(leaving, 4)).endsWith("its siphons alone do not prove it");
    }

    // ---- our components cannot deadlock

    @ParameterizedTest
    @ValueSource(ints = {1, 2})
    void declarationOfTheRun_isProved(int robots) {
        assertThat(WiringCheck.check(RunWiring.of(Mode.PROMISE, robots))).isInstanceOf(WiringResult.Proved.class);
    }

    /** With a single service no colour is seen while the arbitrator changes the state for another one. */
    @Test
    void withDirectCalls_isProvedOfOneRobot_andDeadlocksOfTwo() {
        assertThat(WiringCheck.check(RunWiring.withDirectCalls(1))).isInstanceOf(WiringResult.Proved.class);
        var two = (WiringResult.Deadlock) WiringCheck.check(RunWiring.withDirectCalls(2));
        assertThat(two.counterexample().sentence())
                .isEqualTo("arbitrator waits for stopper1.done; stopper1 waits for service1.stop; service1 waits for"
                        + " arbitrator.colour: all ask and none answers");
    }
}
