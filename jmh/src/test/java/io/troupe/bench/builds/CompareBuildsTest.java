package io.troupe.bench.builds;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.bench.BenchmarkTests;
import io.troupe.bench.BuildTable.Choice;
import io.troupe.bench.worlds.WorldTable;
import io.troupe.bus.Bus;
import io.troupe.bus.nats.NatsBus;
import io.troupe.petri.PetriNet;
import io.troupe.sim.World;
import io.troupe.tools.NatsServerProcess;
import io.troupe.tools.Thorough;
import java.io.ByteArrayOutputStream;
import java.io.File;
import java.io.PrintStream;
import java.net.URISyntaxException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Objects;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import javax.tools.ToolProvider;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

@Timeout(value = 300, threadMode = Timeout.ThreadMode.SEPARATE_THREAD) // only against hanging
class CompareBuildsTest {
    private static final String NOW = System.getProperty("java.class.path");
    private static final String SHORT = "--quick --starts 1 --rounds 1 --turn 1 --warm-up 1";

    /** Has only what the row of the uncorrected net needs, and burns the milliseconds in place of BURN. */
    private static final String NETS = """
            package io.troupe.petri;
            public final class PaperNets {
                public enum Reading { A }
                public static PetriNet uncorrected(Reading reading) {
                    var threads = java.lang.management.ManagementFactory.getThreadMXBean();
                    long end = threads.getCurrentThreadCpuTime() + BURN * 1_000_000L;
                    while (threads.getCurrentThreadCpuTime() < end) {}
                    return PetriNet.builder("small").place("a", 1).place("b")
                            .transition("t", java.util.List.of("a"), java.util.List.of("b"))
                            .transition("u", java.util.List.of("b"), java.util.List.of("a"))
                            .build();
                }
            }
            """;

    @TempDir
    Path folder;

    private record Outcome(int status, String out, String err) {
        List<String> lines(String start) {
            return out.lines().filter(line -> line.startsWith(start)).toList();
        }
    }

    private static CompareBuilds parsed(String... arguments) {
        return BenchmarkTests.parsed(new CompareBuilds(), arguments);
    }

    private static Outcome run(String now, String before, String options, String... more) throws Exception {
        var out = new ByteArrayOutputStream();
        var err = new ByteArrayOutputStream();
        var arguments = Stream.of(new String[] {"--before", before}, options.split(" "), more)
                .flatMap(Stream::of)
                .toArray(String[]::new);
        int status = parsed(arguments)
                .call(
                        now,
                        new PrintStream(out, true, StandardCharsets.UTF_8),
                        new PrintStream(err, true, StandardCharsets.UTF_8));
        return new Outcome(status, out.toString(StandardCharsets.UTF_8), err.toString(StandardCharsets.UTF_8));
    }

    /** Where this build's modules are. */
    private static String thisBuild() {
        return Stream.of(ActorSpace.class, Bus.class, NatsBus.class, World.class, PetriNet.class)
                .map(CompareBuildsTest::placeOf)
                .collect(Collectors.joining(","));
    }

    private static String placeOf(Class<?> type) {
        try {
            return Path.of(type.getProtectionDomain()
                            .getCodeSource()
                            .getLocation()
                            .toURI())
                    .toString();
        } catch (URISyntaxException wrong) {
            throw new IllegalStateException(type + " has no file", wrong);
        }
    }

    /** Compiles a class of the nets into a folder. */
    private Path compiled(String name, String source) throws Exception {
        Path file = Files.createDirectories(folder.resolve("source")).resolve(name + ".java");
        Files.writeString(file, source);
        Path classes = Files.createDirectories(folder.resolve("classes"));
        int status = Objects.requireNonNull(ToolProvider.getSystemJavaCompiler(), "a JDK, not a JRE")
                .run(null, null, null, "-d", classes.toString(), "-cp", NOW, "-proc:none", file.toString());
        assertThat(status).isZero();
        return classes;
    }

    @Test
    void options_areRead_andQuickReplacesThoseBeforeIt() {
        var usual = parsed("--before", "a,b", "--robots", "2,10");
        assertThat(usual.parts).containsExactly(BuildPart.values());
        assertThat(usual.before).containsExactly(Path.of("a"), Path.of("b"));
        assertThat(usual.robots).containsExactly(2, 10);
        assertThat(usual)
                .extracting(
                        each -> each.starts, each -> each.rounds, each -> each.turnMillis, each -> each.warmUpMillis)
                .containsExactly(8, 5, 40, 400);
        var quick = parsed("--before", "a", "--starts", "9", "--quick", "--rounds", "7", "--parts", "bus,nets");
        assertThat(quick.parts).containsExactly(BuildPart.BUS, BuildPart.NETS);
        assertThat(quick)
                .extracting(
                        each -> each.starts, each -> each.rounds, each -> each.turnMillis, each -> each.warmUpMillis)
                .containsExactly(4, 7, 20, 150);
    }

    @Test
    void wrongOptions_areRefused() throws Exception {
        assertThat(BenchmarkTests.errorOf(new CompareBuilds(), "--quick")).contains("--before=PATH");
        assertThat(BenchmarkTests.errorOf(new CompareBuilds(), "--before", "a", "--parts", "actors,music"))
                .startsWith("--parts is music, expected one of actors, simulator, nets, bus");
        var missing = run(NOW, folder + "/none", SHORT);
        assertThat(missing.status).isEqualTo(2);
        assertThat(missing.err).startsWith("--before is " + folder + "/none, which has no build of Troupe; expected");
        var lacking = run(NOW, placeOf(PetriNet.class), SHORT);
        assertThat(lacking.status).isEqualTo(2);
        assertThat(lacking.err).startsWith("--before has no actor-core, which the part actors measures: expected");
        var row = run(NOW, placeOf(PetriNet.class), SHORT + " --parts nets --row chess");
        assertThat(row.status).isEqualTo(2);
        assertThat(row.err).startsWith("--row is chess, expected a part of one of these names: 6 robots, all dead");
    }

    @Test
    void rows_haveNamesOfTheirTables() {
        var usual = new WorldTable(List.of(), 1).rows();
        assertThat(usual).hasSize(8 + 2).anyMatch(each -> each.name().equals("full, 1,000 robots"));
        assertThat(usual).filteredOn(each -> each.choice() == Choice.QUICK).hasSize(3);
        assertThat(new WorldTable(List.of(7), 1).rows())
                .hasSize(8)
                .allMatch(each -> each.name().endsWith(", 7 robots"));
    }

    /**
     * Equal builds give equal answers, and each part measures its rows in all three JVMs: one quick row, or all of them
     * if tests are thorough.
     */
    @ParameterizedTest
    @EnumSource(BuildPart.class)
    void thisBuild_besideItself_isMeasuredInAllRows(BuildPart part) throws Exception {
        var quick = part.table(new BuildPart.Setting(List.of(), 1, null), "").rows().stream()
                .filter(row -> row.choice() == Choice.QUICK)
                .toList();
        String[] row = Thorough.on()
                ? new String[0]
                : new String[] {"--row", quick.getLast().name()};
        var outcome = run(NOW, thisBuild(), SHORT + " --parts " + part, row);
        assertThat(outcome.status).as(outcome.out).isZero();
        var rows = outcome.out
                .lines()
                .filter(line -> line.contains("| not judged, fewer than 3 starts |"))
                .toList();
        assertThat(rows).as(outcome.out).hasSizeGreaterThanOrEqualTo(Thorough.on() ? quick.size() : 1);
        assertThat(outcome.out).contains(" cores for the JVM, ", "Load average ", "* Slower: none");
        assertThat(outcome.lines("* Not compared: ").getFirst())
                .as("only a server may be missing")
                .isIn("* Not compared: none", "* Not compared: bus, over NATS (" + NatsServerProcess.HOW_TO_GET + ")");
    }

    @Test
    void build_thatIsManyTimesSlower_isFound_byTheNameOfTheRow_withExitStatus1() throws Exception {
        String slow = compiled("PaperNets", NETS.replace("BURN", "300")) + File.pathSeparator + NOW;
        var outcome = run(slow, thisBuild(), SHORT + " --starts 3 --parts nets --row paper's");
        assertThat(outcome.out).contains("| **slower** |");
        assertThat(outcome.lines("* Slower: "))
                .singleElement()
                .asString()
                .contains("nets, paper's net, minimal siphons by processor time");
        assertThat(outcome.status).isEqualTo(1);
    }

    @Test
    void olderBuild_thatLacksAMethod_isComparedInTheOtherRows() throws Exception {
        String old = compiled("PaperNets", NETS.replace("BURN", "0")) + "," + thisBuild();
        var outcome = run(NOW, old, SHORT + " --parts nets --row siphons");
        assertThat(outcome.status).isZero();
        assertThat(outcome.lines("| corrected net, minimal siphons |"))
                .singleElement()
                .asString()
                .contains("cannot be compared: the build before: ")
                .contains("it lacks what the benchmark needs, java.lang.NoSuchMethodError: ")
                .contains("PaperNets.corrected(");
        assertThat(outcome.lines("| paper's net, minimal siphons |"))
                .singleElement()
                .asString()
                .contains("| not judged, fewer than 3 starts |");
        assertThat(outcome.lines("* Not compared: nets, corrected net, minimal siphons ("))
                .hasSize(1);
    }

    @Test
    void thisBuild_thatLacksAMethod_hasExitStatus1() throws Exception {
        String lacking = compiled("PaperNets", NETS.replace("BURN", "0")) + File.pathSeparator + NOW;
        var outcome = run(lacking, thisBuild(), SHORT + " --parts nets --row corrected");
        assertThat(outcome.lines("* Not compared: nets, corrected net, minimal siphons (this build"))
                .hasSize(1);
        assertThat(outcome.status).isEqualTo(1);
    }

    @Test
    void builds_thatAnswerDifferently_areComparedOnlyIfTheyMay() throws Exception {
        String other = """
                package io.troupe.petri;
                public final class RobotTeams {
                    public static PetriNet uncorrected(int robots) {
                        return PetriNet.builder("live").place("a", 1)
                                .transition("t", java.util.List.of("a"), java.util.List.of("a")).build();
                    }
                }
                """;
        String old = compiled("RobotTeams", other) + "," + thisBuild();
        String options = SHORT + " --parts nets --row dead";
        var outcome = run(NOW, old, options);
        assertThat(outcome.lines("| 6 robots, all dead markings |"))
                .singleElement()
                .asString()
                .contains("it answers \"0 dead, COMPLETE\", and this build \"1458 dead, COMPLETE\", expected the same");
        assertThat(run(NOW, old, options + " --other-answers").lines("| 6 robots, all dead markings |"))
                .singleElement()
                .asString()
                .contains("| not judged, fewer than 3 starts |");
    }
}
