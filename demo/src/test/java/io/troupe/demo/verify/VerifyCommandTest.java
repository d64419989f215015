package io.troupe.demo.verify;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.demo.CommandLineBench;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PaperNets.Reading;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Pnml;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;

class VerifyCommandTest extends CommandLineBench {
    private PetriNet written(String name) {
        return Pnml.read(directory.resolve(name + ".pnml"));
    }

    private void assertWritten(Stream<String> names) {
        assertThat(names)
                .isNotEmpty()
                .allSatisfy(name -> assertThat(directory.resolve(name)).isNotEmptyFile());
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
            assertThat(written("uncorrected-" + reading).sameStructureAs(PaperNets.uncorrected(reading)))
                    .isTrue();
            assertThat(written("corrected-" + reading).sameStructureAs(PaperNets.corrected(reading)))
                    .isTrue();
            assertWritten(Stream.of("deadlock-%s.svg", "graph-uncorrected-%s.svg", "graph-robot-player-%s.dot")
                    .map(name -> name.formatted(reading)));
        }
        for (var name : List.of("corrected-A.svg", "graph-robot-player-A.svg")) {
            assertThat(directory.resolve(name))
                    .as("the picture in the guide")
                    .hasSameTextualContentAs(Path.of("..", "docs", "figures", name));
        }
        assertThat(Files.readString(directory.resolve("verify.md")))
                .contains(
                        "| minimal siphons | 44 | 48 | 36 | 48 |",
                        "| reachable markings / edges | 1264 / 3706 | 429 / 1084 | 1104 / 3236 | 363 / 913 |",
                        "| can a siphon be emptied, by one mixed-integer program | perhaps; one it finds is really emptied | no |",
                        " 7. Tp4     player stops",
                        "service1 waits for arbitrator.colour; arbitrator waits for service1.stop");
    }

    /** Returns the exit status; only what is printed now is kept. */
    private int verify(PetriNet net, String options) {
        out.getBuffer().setLength(0);
        Pnml.write(net, directory.resolve("net.pnml"));
        return troupe("verify --net DIR/net.pnml --out DIR " + options);
    }

    @Test
    void verify_ofAFile_tellsWhatIsKnownOfIt() {
        assertThat(verify(PaperNets.uncorrected(Reading.A), "")).isEqualTo(1);

        assertThat(out.toString())
                .startsWith("uncorrected A: can deadlock: 6 dead markings, the nearest {P1, M1, S10, R7''} after [")
                .contains(
                        "1264 markings, 3706 edges, all of them",
                        "dead markings: 6, the nearest {P1, M1, S10, R7''}",
                        "live NO, reversible NO",
                        "44 minimal siphons: 20 of them may perhaps be emptied, which decides nothing by itself")
                .endsWith(local("wrote, as .dot and .svg: DIR/net, DIR/net-deadlock, DIR/net-graph\n"));
        assertWritten(Stream.of("net.svg", "net-deadlock.svg", "net-graph.dot"));
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

    /** The net has a weight of 2, so that siphons decide nothing. */
    @Test
    void netWithoutBounds_isNotKnownOnceTheMemoryIsUsedUp() {
        var net = PetriNet.builder("growing").place("a", 2).place("many").transition("t");
        net.arc("a", "t", 2).arc("t", "a", 2).arc("t", "many");

        assertThat(verify(net.build(), "--memory 1")).isEqualTo(3);
        assertThat(out.toString())
                .contains(
                        "growing: not known whether it can deadlock: no dead marking among ",
                        "then the memory was used up (--memory)\n",
                        "growing: out of memory at ");
    }

    @Test
    void siphons_decideWhereTheSearchDoesNotGetThrough() {
        var net = PetriNet.builder("growing").place("a", 1).place("many");
        net.transition("t", List.of("a"), List.of("a", "many"));

        assertThat(verify(net.build(), "--memory 1")).isZero();
        assertThat(out.toString()).startsWith("growing: proved: no reachable marking is dead (by its siphons; ");
    }

    /** The net has thousands of dead markings, each a terminal component. */
    @Test
    void netWithoutBounds_isToldInFewLines() {
        var net = PetriNet.builder("ends").place("on", 1).place("off").place("many");
        net.transition("go", List.of("on"), List.of("on", "many")).transition("end", List.of("on"), List.of("off"));

        assertThat(verify(net.build(), "--memory 4")).isEqualTo(1);
        assertThat(out.toString())
                .containsPattern("ends: can deadlock: \\d{4,} dead markings so far, the nearest \\{off} after \\[end]");
        assertThat(out.toString().lines()).hasSizeLessThan(50);
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
                .contains(local("wrote, as .dot: DIR/net"));
        assertWritten(Stream.of("net.dot"));
        assertThat(directory.resolve("net.svg")).doesNotExist();
    }

    @Test
    void verdict_standsAlthoughNoPictureCanBeWritten() throws IOException {
        Files.createDirectory(directory.resolve("net.dot"));

        assertThat(verify(PaperNets.corrected(Reading.A), "")).isZero();
        assertThat(out.toString())
                .startsWith("corrected A: proved")
                .contains("troupe: the pictures cannot be written: ");
    }

    @Test
    void fileOfAnotherTool_isReadWithAWarning() throws IOException {
        file("other.pnml", "<pnml><net id='n' type='PTNet'><transition id='t'/></net></pnml>");
        assertThat(printed("verify --net DIR/other.pnml --out DIR"))
                .startsWith(local("troupe: warning: DIR/other.pnml:1: the namespace is \"\""));
    }

    @Test
    void limits_outOfRange_areRefused() {
        assertRefused("verify --time 0", "--time is 0.0, expected seconds above 0, up to 1000000");
        assertRefused("verify --memory 0", "--memory is 0, expected MiB, 1 or more");
        assertRefused("verify --robots 0", "--robots is 0, expected a number from 1 to 7");
    }
}
