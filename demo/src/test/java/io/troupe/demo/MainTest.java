package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.PetriNet;
import io.troupe.petri.Pnml;
import io.troupe.view.RunLog;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** The command line: every usage error gives one clear line and exit status 2. */
class MainTest {
    private static final String WORLD = Path.of("worlds", "paper-arena.world").toString();

    private final StringWriter out = new StringWriter();
    private final StringWriter err = new StringWriter();

    @TempDir
    private Path directory;

    private int troupe(String... arguments) {
        return Main.execute(new PrintWriter(out), new PrintWriter(err), arguments);
    }

    private void assertComplaint(int status, String... parts) {
        assertThat(status).isEqualTo(2);
        assertThat(err.toString().lines())
                .singleElement()
                .satisfies(line -> assertThat(line).startsWith("troupe: ").contains(parts));
    }

    @Test
    void run_printsChangesAndSummary_andWritesBothFiles() {
        assertThat(troupe(
                        "run",
                        "--world",
                        WORLD,
                        "--seconds",
                        "2",
                        "--out",
                        directory.resolve("o").toString()))
                .isZero();
        assertThat(out.toString())
                .contains("state 1: robot 1 wallFollower, robot 2 spaceWanderer", "times real time", "distance driven");
        assertThat(directory.resolve("o/run.jsonl")).isNotEmptyFile();
        assertThat(directory.resolve("o/trajectory.svg")).isNotEmptyFile();
        assertThat(err.toString()).isEmpty();
    }

    @Test
    void fileThatCannotBeWritten_isOneLineWithoutNamesOfClasses() {
        Path file = directory.resolve("missing/session.txt");
        assertThat(troupe("serve", "--world", WORLD, "--port", "0", "--record", file.toString()))
                .isEqualTo(Main.USAGE);
        assertThat(err.toString().lines())
                .containsExactly("troupe: --record is " + file + ", but there is no directory " + file.getParent()
                        + " (see troupe serve --help)");
    }

    @Test
    void netFileThatIsNone_isOneLine() throws IOException {
        Path file = Files.writeString(
                directory.resolve("bad.pnml"), "<pnml xmlns=\"http://www.pnml.org/version-2009/grammar/pnml\">");
        assertComplaint(
                troupe("verify", "--net", file.toString(), "--out", directory.toString()), "bad.pnml", "troupe verify");
    }

    @Test
    void netWithMoreTokensThanAnIntHolds_isOneLine() {
        Path file = directory.resolve("many.pnml");
        Pnml.write(
                PetriNet.builder("many")
                        .place("p", Integer.MAX_VALUE)
                        .transition("t", List.of(), List.of("p"))
                        .build(),
                file);

        assertComplaint(
                troupe("verify", "--net", file.toString(), "--out", directory.toString()),
                "many.pnml",
                "place p would hold 2147483648 tokens");
    }

    @ParameterizedTest
    @ValueSource(strings = {"run", "verify"})
    void version_ofACommand_isThatOfTroupe(String command) {
        assertThat(troupe(command, "--version")).isZero();
        assertThat(out.toString()).startsWith("Troupe ");
    }

    @Test
    void wrongOption() {
        assertComplaint(troupe("run", "--sed", "1"), "--sed", "troupe run --help");
    }

    @Test
    void wrongCommand() {
        assertComplaint(troupe("dance"), "dance");
    }

    @Test
    void wrongNumber() {
        assertComplaint(troupe("run", "--seconds", "soon"), "--seconds", "soon");
    }

    @Test
    void numberOutOfRange() {
        assertComplaint(troupe("run", "--seconds", "-3"), "--seconds is -3.0", "above 0");
    }

    @Test
    void nothing_printsTheHelp_andHowToStart() {
        assertThat(troupe()).isZero();
        assertThat(out.toString())
                .startsWith("Usage: troupe")
                .contains("evaluate", "Start with the main job: troupe run");
    }

    @Test
    void help_isACommandToo() {
        assertThat(troupe("help", "run")).isZero();
        assertThat(out.toString()).startsWith("Usage: troupe run").doesNotContain("Start with");
    }

    @Test
    void program_isThatOfTheBuild() throws IOException {
        assertThat(Files.readString(Path.of("..", "pom.xml")))
                .contains("<version>" + RunLog.PROGRAM.replace("Troupe ", "") + "</version>");
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "rnu | there is no command 'rnu'; did you mean run?",
                "eval | there is no command 'eval'; did you mean evaluate?",
                "help rnu | did you mean run?",
                "run --sed 1 | there is no option --sed; did you mean --seed?",
                "run --seconds=1 --realtme | there is no option --realtme; did you mean --realtime?",
                "table a b | 'b' is one argument too many",
                "run --seconds soon | --seconds is 'soon', expected a number (see",
                "run --seed 1.5 | --seed is '1.5', expected a whole number (see",
                "serve --realtime --lock-step | troupe: --realtime, --lock-step are mutually exclusive",
            })
    void slipOfTheFinger_isToldInPlainWords(String arguments, String problem) {
        assertComplaint(troupe(arguments.split(" ")), problem);
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "run --world",
                "run --robots 2 --table",
                "modes --world",
                "evaluate --world",
                "serve --world",
                "replay",
                "app",
                "app applications/two-robots.app --world",
                "draw",
                "table",
                "verify --net"
            })
    void missingFile_isStatus2InEveryCommand(String arguments) {
        String file = directory.resolve("nowhere").toString();
        assertComplaint(troupe((arguments + " " + file).split(" ")), file + ": no such file, expected ", " --help)");
    }

    @Test
    void drawing_inADirectoryThatIsMissing_isStatus2() {
        Path file = directory.resolve("missing/x.svg");
        assertComplaint(
                troupe("draw", "worlds/office.world", "--out", file.toString()),
                "--out is " + file + ", but there is no directory " + file.getParent());
    }

    @Test
    void longRun_saysFirstHowLargeItsFilesGet() {
        assertThat(RunCommand.Sizes.of(2, 100, 100_000))
                .satisfies(sizes -> assertThat(sizes.areLarge()).isTrue())
                .extracting(RunCommand.Sizes::describe)
                .isEqualTo("320 MB in run.jsonl and at most 24 MB in trajectory.svg");
        assertThat(RunCommand.Sizes.of(2, 100, 300).areLarge()).isFalse();
    }

    /** The run fails at once, since the log file is a directory. */
    @Test
    void longRun_warnsBeforeItBegins() throws Exception {
        Files.createDirectories(directory.resolve("run.jsonl"));
        assertThat(troupe("run", "--world", WORLD, "--seconds", "100000", "--out", directory.toString()))
                .isEqualTo(1);
        assertThat(err.toString().lines())
                .first()
                .asString()
                .isEqualTo("troupe: warning: --seconds is 100000.0: expect about "
                        + "320 MB in run.jsonl and at most 24 MB in trajectory.svg");
    }

    @Test
    void nameThatCanBeNoFile_isToldWithTheEncoding() {
        assertComplaint(troupe("draw", "a\0b"), "'a\0b' can be no file here, where names are in ");
    }

    @Test
    void missingWorld() {
        assertComplaint(
                troupe("run", "--world", directory.resolve("nowhere.world").toString()), "nowhere.world");
    }

    @Test
    void wrongWorld_isNamedByFileLineAndColumn() throws Exception {
        Path world = directory.resolve("wrong.world");
        Files.writeString(world, "interval_sim 100\nmodel ( siez [ 1 1 1 ] )\n");
        assertComplaint(
                troupe(
                        "run",
                        "--world",
                        world.toString(),
                        "--out",
                        directory.resolve("o").toString()),
                "wrong.world:2:9: ",
                "siez",
                "size");
    }

    @Test
    void outputThatIsAFile() throws Exception {
        Path file = Files.writeString(directory.resolve("taken"), "x");
        assertComplaint(
                troupe("run", "--world", WORLD, "--out", file.toString()),
                "--out is " + file + ", but " + file + " is a file, expected a directory");
    }

    @Test
    void help_namesEveryOption() {
        assertThat(troupe("run", "--help")).isZero();
        assertThat(out.toString()).contains("--world=FILE", "--seconds=N", "--seed=N", "--realtime", "--out=DIR");
    }

    @Test
    void optionsWithoutACommand_areThoseOfRun() {
        assertThat(troupe(
                        "--world",
                        WORLD,
                        "--seconds",
                        "1",
                        "--out",
                        directory.resolve("o").toString()))
                .isZero();
        assertThat(out.toString()).contains("1.0 s simulated");
    }

    @Test
    void fileThatCannotBeWritten_isOneLine() throws Exception {
        Files.createDirectories(directory.resolve("o").resolve("run.jsonl"));
        assertThat(troupe(
                        "run",
                        "--world",
                        WORLD,
                        "--seconds",
                        "1",
                        "--out",
                        directory.resolve("o").toString()))
                .isEqualTo(1);
        assertThat(err.toString().lines())
                .singleElement()
                .satisfies(line -> assertThat(line).contains("run.jsonl"));
    }

    @Test
    void robotThatTheServicesCannotDrive_isNamed() throws Exception {
        Path world = directory.resolve("poor.world");
        Files.writeString(world, """
                define ring ranger ( scount 1 spose[0] [ 0 0 0 ] )
                define bot position ( size [ 0.4 0.4 0.4 ] ring() blobfinder ( ) )
                bot ( name "a" pose [ 0 0 0 0 ] )
                bot ( name "b" pose [ 2 0 0 0 ] )
                """);
        assertComplaint(
                troupe("run", "--world", world.toString()),
                "poor.world:3:1",
                "robot 'a' has 1 sonar and a blobfinder",
                "expected 8");
    }

    @Test
    void configurationThatSwapsTheRobots_isRefused() throws Exception {
        for (String name : new String[] {"paper-arena.world", "pioneer.inc"}) {
            Files.copy(Path.of("worlds", name), directory.resolve(name));
        }
        String swapped = Files.readString(Path.of("worlds", "paper-arena.cfg"))
                .replace("\"robot1\"", "\"x\"")
                .replace("\"robot2\"", "\"robot1\"")
                .replace("\"x\"", "\"robot2\"");
        Files.writeString(directory.resolve("paper-arena.cfg"), swapped);
        assertComplaint(
                troupe("run", "--world", directory.resolve("paper-arena.cfg").toString()),
                "robot 'robot1' is not position2d:0 on port 6665");
    }

    @Test
    void table_thatIsWrong_isToldWithItsPlace() throws IOException {
        Path file = Files.writeString(directory.resolve("bad.table"), "robots 1\nstate red : spaceWandrer\n");
        assertComplaint(
                troupe("table", file.toString(), "--out", directory.toString()),
                file + ":2:13: there is no service called 'spaceWandrer'",
                "did you mean 'spaceWanderer'?");
        assertThat(directory.resolve("states.svg")).doesNotExist();
    }

    @Test
    void table_thatIsNotThere_isAComplaint() {
        assertComplaint(troupe("table", directory.resolve("none").toString()), "no such file");
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "--robots 0 | --robots is 0, expected a number from 1 to 20000",
                "--robots 3 --colours 101 | --colours is 101, expected a number from 1 to 100",
                "--robots 3 --services 0 | --services is 0, expected a number from 1 to 100",
                "--robots 3 --hold -1 | --hold is -1.0, expected a number from 0 to 3600",
                "--services 3 | --services is 3, but there is no crowd: expected --robots as well",
                "--robots 3 --world x.world | --robots is 3 and --world is x.world, expected only one of them",
                "--robots 3 --table tables/paper.table | --robots is 3, expected 2 as in --table tables/paper.table",
                "--robots 2 --services 3 --table tables/paper.table | --services is 3 beside --table",
                "--table nowhere.table | nowhere.table: no such file",
            })
    void crowdThatCannotBe_isRefused(String options, String problem) {
        assertComplaint(troupe(("run " + options).split(" ")), problem);
    }

    @Test
    void table_ofAFile_worksWithACrowdToo() {
        String output = directory.resolve("o").toString();
        assertThat(troupe("run", "--robots", "2", "--table", "tables/paper.table", "--seconds", "1", "--out", output))
                .isZero();
        assertThat(out.toString()).contains("crowd of 2", "state 3 (green)");
    }

    @ParameterizedTest
    @CsvSource({"8, 3", "5, 4"})
    void crowd_isGenerated(int colours, int services) {
        String output = directory.resolve("o").toString();
        String options = "run --robots 50 --colours " + colours + " --services " + services + " --seconds 1 --out";

        assertThat(troupe((options + " " + output).split(" "))).isZero();

        assertThat(out.toString()).contains("crowd of 50", "50 robots ");
        assertThat(out.toString().lines().filter(line -> line.matches("state \\d+ \\(.+\\): \\d+ times?, .+ s")))
                .as("states, one for each colour")
                .hasSize(colours);
        var all = List.of("spaceWanderer", "wallFollower", "avoid > patrol1", "avoid > patrol2");
        assertThat(out.toString().lines().filter(line -> line.startsWith("cycles of ")))
                .extracting(line -> line.split(" {2,}")[0].substring("cycles of ".length()))
                .containsExactlyInAnyOrderElementsOf(all.subList(0, services));
        assertThat(directory.resolve("o/run.jsonl"))
                .content()
                .contains("\"robot\":50,")
                .doesNotContain("\"robot\":51,");
        assertThat(directory.resolve("o/trajectory.svg")).content().contains("50 robots, 1.0 s simulated");
        assertThat(err.toString()).isEmpty();
    }

    @Test
    void crowd_isMeasured() {
        assertThat(troupe(
                        "crowd", "--sizes", "1,4", "--seconds", "0.5", "--repeat", "1", "--out", directory.toString()))
                .isZero();
        assertThat(out.toString()).contains("us of processor time", "crowd.svg");
        assertThat(directory.resolve("crowd.csv")).content().hasLineCount(3);
        assertThat(directory.resolve("crowd.svg")).content().contains("<svg");
        assertThat(directory.resolve("crowd.png")).isNotEmptyFile();
    }

    @Test
    void crowd_ofNobody_isNotMeasured() {
        assertComplaint(troupe("crowd", "--sizes", "3,0"), "--sizes is 0, expected a number from 1 to 20000");
    }
}
