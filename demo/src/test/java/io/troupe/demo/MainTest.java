package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.view.RecordedRun;
import io.troupe.view.RunLog;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;
import org.w3c.dom.Element;
import picocli.CommandLine;

/** The command line, and {@code troupe run}, {@code modes}, {@code crowd} and {@code draw}. */
@Timeout(300)
class MainTest extends CommandLineBench {
    // ---- every usage error gives one clear line and exit status 2

    @Test
    void help_namesCommandsAndOptions_andHowToStart() {
        assertThat(printed("")).startsWith("Usage: troupe").contains("evaluate", "Start with the main job: troupe run");
        assertThat(printed("help run")).startsWith("Usage: troupe run").doesNotContain("Start with");
        assertThat(printed("run --help"))
                .contains("--world=FILE", "--seconds=N", "--seed=N", "--realtime", "--out=DIR");
    }

    @Test
    void help_hasExamplesThatAreRight_beforeTheOptions_whichAreInGroupsIfTheyAreMany() {
        var nowhere = new PrintWriter(PrintWriter.nullWriter());
        CommandLine troupe = Main.commandLine(nowhere, nowhere);
        int examples = 0;
        for (CommandLine command : troupe.getSubcommands().values()) {
            for (String example : HelpPage.examples(command)) {
                String[] words = example.replaceFirst("troupe ", "").split(" ");
                assertThat(words[0]).isEqualTo(command.getCommandName());
                troupe.parseArgs(words); // throws if there is no such option
                examples++;
            }
        }
        assertThat(examples).isGreaterThan(30);

        assertThat(printed("run --help"))
                .containsSubsequence(
                        "Examples:\n  troupe run --view\n",
                        "\nWorld:\n",
                        "--world=FILE",
                        "\nRobots and their services:\n",
                        "--mode=MODE",
                        "\nOutput:\n",
                        "--out=DIR",
                        "\nAlso:\n",
                        "\nHelp:\n");
        assertThat(printed("draw --help")).contains("Examples:", "--out=FILE").doesNotContain("Output:");
        assertThat(printed("crowd --help")).containsSubsequence("Help:", "--version", "Processor time is that of all");
    }

    @Test
    void help_isAsWideAsTheTerminal() {
        assertThat(HelpPage.columns("120", "90")).isEqualTo(120);
        assertThat(HelpPage.columns(null, "90")).isEqualTo(90);
        assertThat(HelpPage.columns("wide", null)).isEqualTo(80);
        assertThat(HelpPage.columns("9", null)).isEqualTo(60);
        var text = new StringWriter();
        CommandLine troupe = Main.commandLine(new PrintWriter(text), new PrintWriter(text));
        HelpPage.layOut(troupe, 140);
        troupe.execute("run", "--help");
        assertThat(text.toString().lines().mapToInt(String::length).max().orElseThrow())
                .isBetween(101, 140);
    }

    @Test
    void version_ofACommand_isThatOfTroupe_andOfTheBuild() throws IOException {
        assertThat(printed("run --version")).startsWith("Troupe ");
        assertThat(printed("verify --version")).startsWith("Troupe ");
        assertThat(Files.readString(Path.of("..", "pom.xml")))
                .contains("<version>" + RunLog.PROGRAM.replace("Troupe ", "") + "</version>");
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "dance | dance",
                "rnu | there is no command 'rnu'; did you mean run?",
                "eval | there is no command 'eval'; did you mean evaluate?",
                "help rnu | did you mean run?",
                "run --sed 1 | there is no option --sed; did you mean --seed? .. troupe run --help",
                "run --seconds=1 --realtme | there is no option --realtme; did you mean --realtime?",
                "table a b | 'b' is one argument too many",
                "run --seconds soon | --seconds is 'soon', expected a number (see",
                "run --seconds -3 | --seconds is -3.0 .. above 0",
                "run --seed 1.5 | --seed is '1.5', expected a whole number (see",
                "run --mode magic | --mode is 'magic', expected one of: sync, callback, promise (see",
                "run --mode asynch | --mode is 'asynch', expected one of: .. (did you mean 'sync'?) (see",
                "evaluate --modes sync,promis | --modes is 'promis', expected one of: .. 'promise'",
                "run --realtime=maybe | --realtime is 'maybe', expected no value, true or false",
                "run --seed | --seed is given without its value, expected --seed N (see",
                "run --seed 1 --seed 2 | --seed is given twice, expected once (see",
                "export | RUN is missing, expected the run.jsonl or recording (see",
                "offer | --robots is missing, expected the Player server",
                "draw caves.world | caves.world: no such file, expected a world file; looked in",
                "run --mode sync --reconnect | --reconnect goes with --mode callback or promise .. connects once"
                        + " .. troupe run --help",
                "run --world worlds/paper-arena.world --out DIR/taken"
                        + " | --out is DIR/taken, but DIR/taken is a file, expected a directory",
                "run --robots 0 | --robots is 0, expected a number from 1 to 20000",
                "run --robots 3 --colours 101 | --colours is 101, expected a number from 1 to 100",
                "run --robots 3 --services 0 | --services is 0, expected a number from 1 to 100",
                "run --robots 3 --hold -1 | --hold is -1.0, expected a number from 0 to 3600",
                "run --services 3 | --services is 3, but there is no crowd: expected --robots as well",
                "run --robots 3 --world x.world | --robots is 3 and --world is x.world, expected only one of them",
                "run --robots 3 --table tables/paper.table"
                        + " | --robots is 3, expected 2 as in --table tables/paper.table",
                "run --robots 2 --services 3 --table tables/paper.table | --services is 3 beside --table",
                "run --table nowhere.table | nowhere.table: no such file",
                "crowd --sizes 3,0 | --sizes is 0, expected a number from 1 to 20000",
                "serve --realtime --lock-step | troupe: --realtime and --lock-step are given, expected one of them",
                "draw worlds/office.world --out DIR/missing/x.svg"
                        + " | --out is DIR/missing/x.svg, but there is no directory DIR/missing",
            })
    void mistake_isToldInPlainWords(String line, String problem) throws IOException {
        file("taken", "x");
        assertRefused(line, problem.split(" \\.\\. "));
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
    void missingFile_isStatus2InEveryCommand(String line) {
        String help = "(see troupe " + line.split(" ")[0] + " --help)";
        assertRefused(line + " DIR/nowhere", "DIR/nowhere: no such file, expected ", help);
    }

    @Test
    void fileThatCannotBeWritten_isOneLineWithoutNamesOfClasses_andANameThatCanBeNoFileIsToldWithTheEncoding() {
        assertThat(troupe("serve " + ARENA + "--port 0 --record DIR/missing/session.txt"))
                .isEqualTo(Main.USAGE);
        assertThat(err.toString().lines())
                .containsExactly(local("troupe: --record is DIR/missing/session.txt, but there is no directory"
                        + " DIR/missing (see troupe serve --help)"));

        assertRefused("draw a\0b", "'a\0b' can be no file here, where names are in ");
    }

    @Test
    void outputThatCannotBeWritten_isStatus2InEveryCommand_andNothingIsLeftBehind() throws IOException {
        Path nowhere = Path.of("/proc");
        assumeTrue(Files.isDirectory(nowhere), "a folder where nobody can write, even root");
        String here = "/proc/x, but ";
        assertRefused(
                "run " + ARENA + "--seconds 1 --out /proc/x", "--out is " + here + "that cannot be made a directory");
        assertRefused("table --out /proc/x", "--out is " + here);
        assertRefused("new /proc/x", "FOLDER is " + here);
        assertRefused("draw worlds/track.world --out /proc/x", "--out is " + here + "it cannot be written (see");
        file("run.jsonl", "");
        assertRefused("export DIR/run.jsonl " + ARENA + "--mcap /proc/x", "--mcap is " + here + "it cannot be written");
        assertRefused(
                "export DIR/run.jsonl " + ARENA + "--csv /proc/x",
                "--csv is " + here + "that cannot be made a directory");
    }

    @Test
    void equalWarnings_areOneLine_withTheFirstPosition() throws IOException {
        file("energy.world", "model ( joules 1 watts 1 )\nmodel ( joules 1 )\nmodel ( joules 1 )\nposition ( )\n");
        printed("draw DIR/energy.world --out DIR/w.svg");
        String first = "troupe: warning: DIR/energy.world:1:9: \"joules\" has no effect here: energy is not simulated";
        String second = "troupe: warning: DIR/energy.world:1:18: \"watts\" has no effect here: energy is not simulated";
        assertThat(err.toString().lines()).startsWith(local(first + " .. and 2 more of this kind"), local(second));
    }

    @Test
    void wrongInput_leavesNoEmptyDirectoryBehind() throws IOException {
        file("wrong.world", "model ( siez 1 )");
        file("lonely.world", "position ( )");
        for (String line : List.of("run --world", "modes --world", "evaluate --world", "verify --net")) {
            assertRefused(line + " DIR/nowhere.world --out DIR/o", "nowhere.world: no such file");
        }
        for (String line : List.of("run", "modes", "evaluate", "hosts")) {
            assertRefused(line + " --world DIR/wrong.world --out DIR/o", "wrong.world:1:9: ");
            assertRefused(line + " --world DIR/lonely.world --out DIR/o", "expected 2");
        }
        file("bad.pnml", "<pnml xmlns=\"http://www.pnml.org/version-2009/grammar/pnml\">");
        assertRefused("verify --net DIR/bad.pnml --out DIR/o", "bad.pnml");
        file("bad.app", "application a\ncomponent r is plyer\n");
        assertRefused("verify --bip DIR/bad.app --out DIR/o", "bad.app:2:16: ");
        assertMissing("o");
    }

    @Test
    void nameThatIsNoFileHere_isThatOfTheInstallation() {
        Path root = Path.of("").toAbsolutePath().getParent();
        String before = System.setProperty("troupe.home", root.toString());
        try {
            assertThat(printed("draw cave.world --out DIR/w.svg")).contains("1 robot");
            assertThat(printed("draw demo/worlds/cave.world --out DIR/w.svg")).contains("1 robot");
            assertThat(printed("table four-services.table --out DIR")).contains("5 services");
            assertThat(printed("run --world office.cfg --seconds 1 --out DIR")).contains("office");
            assertThat(printed("app two-robots.app --seconds 1 --out DIR")).contains("two-robots on paper arena");
            assertRefused(
                    "draw caev.world",
                    "looked in " + Path.of("").toAbsolutePath() + ", ",
                    root.resolve(Path.of("demo", "worlds")) + "; did you mean \"cave.world\"?");
        } finally {
            if (before == null) {
                System.clearProperty("troupe.home");
            } else {
                System.setProperty("troupe.home", before);
            }
        }
    }

    @Test
    void mistakeInAFile_isToldWithItsPlace() throws IOException {
        file("bad.pnml", "<pnml xmlns=\"http://www.pnml.org/version-2009/grammar/pnml\">");
        assertRefused("verify --net DIR/bad.pnml --out DIR", "bad.pnml", "(see docs/guide/03-proving-a-wiring.md)");
        file("wrong.world", "interval_sim 100\nmodel ( siez [ 1 1 1 ] )\n");
        assertRefused("run --world DIR/wrong.world --out DIR/o", "wrong.world:2:9: ", "siez", "05-worlds.md");
        assertThat(err.toString().lines().skip(1)).containsExactly("    model ( siez [ 1 1 1 ] )", "            ^");
        file("long.world", "# " + "x".repeat(80) + "\n\tmodel (" + " ".repeat(200) + "siez 1 )\n");
        assertRefused("draw DIR/long.world", "long.world:2:209: ");
        assertThat(err.toString().lines().skip(1))
                .containsExactly("    " + " ".repeat(50) + "siez 1 )", "    " + " ".repeat(50) + "^");
        file("tab.world", "\tmodel ( siez 1 )\n");
        assertRefused("draw DIR/tab.world", "tab.world:1:10: ");
        assertThat(err.toString().lines().skip(1)).containsExactly("    \tmodel ( siez 1 )", "    \t        ^");
        file("poor.world", """
                define ring ranger ( scount 1 spose[0] [ 0 0 0 ] )
                define bot position ( size [ 0.4 0.4 0.4 ] ring() blobfinder ( ) )
                bot ( name "a" pose [ 0 0 0 0 ] )
                bot ( name "b" pose [ 2 0 0 0 ] )
                """);
        String robot = "robot 'a' has 1 sonar and a blobfinder";
        assertRefused("run --world DIR/poor.world", "poor.world:3:1", robot, "expected 8");
        file("bad.table", "robots 1\nstate red : spaceWandrer\n");
        String problem = "DIR/bad.table:2:13: there is no service called 'spaceWandrer'";
        assertRefused("table DIR/bad.table --out DIR", problem, "did you mean 'spaceWanderer'?");
        assertMissing("states.svg");

        Files.copy(Path.of("worlds", "paper-arena.world"), directory.resolve("paper-arena.world"));
        String swapped = Files.readString(Path.of("worlds", "paper-arena.cfg"))
                .replace("\"robot1\"", "\"x\"")
                .replace("\"robot2\"", "\"robot1\"")
                .replace("\"x\"", "\"robot2\"");
        file("paper-arena.cfg", swapped);
        assertRefused("run --world DIR/paper-arena.cfg", "robot 'robot1' is not position2d:0 on port 6665");
    }

    /** The worlds have no robots and the other files are empty, so that each command ends soon after reading it. */
    @ParameterizedTest
    @ValueSource(
            strings = {
                "run --seconds 0.2 --out DIR/out --world",
                "modes --seconds 0.2 --out DIR/out --world",
                "app DIR/empty --world",
                "draw --out DIR/w.svg",
                "evaluate --out DIR/out --world",
                "serve --port TAKEN --world",
                "replay DIR/empty --world"
            })
    void world_withThingsThatAreNotSimulated_isAWarning_andWithUnknownNamesAnErrorUnlessLenient(String command)
            throws IOException {
        file("empty", "");
        try (var taken = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            String line = command.replace("TAKEN", "" + taken.getLocalPort()) + " DIR/t.world ";
            file("t.world", "\nmodel ( joules 1 )");
            troupe(line);
            String warning = "DIR/t.world:2:9: \"joules\" has no effect here: energy is not simulated";
            assertThat(err.toString().lines()).contains(local("troupe: warning: " + warning));

            file("t.world", "\nmodel ( siez 1 )");
            String problem = "DIR/t.world:2:9: unknown property \"siez\" of model; did you mean \"size\"?";
            assertRefused(line, "troupe: " + problem);
            err.getBuffer().setLength(0);
            troupe(line + "--lenient");
            assertThat(err.toString().lines()).contains(local("troupe: warning: " + problem));
        }
    }

    // ---- what commands print and write

    @Test
    void run_printsChangesAndSummary_andWritesBothFiles() {
        assertThat(printed("run " + ARENA + "--seconds 2 --out DIR/o"))
                .contains("state 1: robot 1 wallFollower, robot 2 spaceWanderer", "times real time", "distance driven");
        assertWritten("o/run.jsonl", "o/trajectory.svg");
        assertThat(err.toString()).isEmpty();
        assertThat(printed(ARENA + "--seconds 1 --out DIR/o"))
                .as("options without a command are those of run")
                .contains("1.0 s simulated");
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
    void logThatCannotBeWritten_isOneLine_andALongRunWarnsBeforeIt() throws IOException {
        Files.createDirectories(directory.resolve("run.jsonl"));
        String command = "run " + ARENA + "--out DIR --seconds ";
        assertFails(1, command + "1", "run.jsonl");
        err.getBuffer().setLength(0);
        assertThat(troupe(command + "100000")).isEqualTo(1);
        assertThat(err.toString().lines())
                .startsWith("troupe: warning: --seconds is 100000.0: expect about "
                        + "320 MB in run.jsonl and at most 24 MB in trajectory.svg");
    }

    @Test
    void interpretedJvm_writesTheSameFile() throws Exception {
        var settings = RecordedRun.Settings.defaults().withSeed(7).withSeconds(20);
        var scenario = ScenarioReader.read(Path.of("worlds", "paper-arena.world"));
        new RecordedRun(scenario, SubsumptionTable.ofThePaper(), settings).run(directory.resolve("here"));
        Path log = directory.resolve("log");
        var run = jvm("-Xint", Main.class, words("run " + ARENA + "--seed 7 --seconds 20 --out DIR/there"));
        var interpreted =
                run.redirectErrorStream(true).redirectOutput(log.toFile()).start();
        assertThat(interpreted.waitFor()).as(Files.readString(log)).isZero();
        assertThat(directory.resolve("there/run.jsonl")).hasSameBinaryContentAs(directory.resolve("here"));
    }

    @Test
    void table_ofAFile_worksWithACrowdToo() {
        assertThat(printed("run --robots 2 --table tables/paper.table --seconds 1 --out DIR"))
                .contains("crowd of 2", "state 3 (green)");
    }

    @ParameterizedTest
    @CsvSource({"8, 3", "5, 4"})
    void crowd_isGenerated(int colours, int services) throws IOException {
        String text = printed("run --robots 50 --seconds 1 --out DIR --colours " + colours + " --services " + services);

        assertThat(text).contains("crowd of 50", "50 robots ");
        assertThat(text.lines().filter(line -> line.matches("state \\d+ \\(.+\\): \\d+ times?, .+ s")))
                .as("states, one for each colour")
                .hasSize(colours);
        var all = List.of("spaceWanderer", "wallFollower", "avoid > patrol1", "avoid > patrol2");
        assertThat(text.lines().filter(line -> line.startsWith("cycles of ")))
                .extracting(line -> line.split(" {2,}")[0].substring("cycles of ".length()))
                .containsExactlyInAnyOrderElementsOf(all.subList(0, services));
        assertThat(written("run.jsonl")).contains("\"robot\":50,").doesNotContain("\"robot\":51,");
        assertThat(written("trajectory.svg")).contains("50 robots, 1.0 s simulated");
        assertThat(err.toString()).isEmpty();
    }

    @Test
    void crowd_isMeasured() throws IOException {
        assertThat(printed("crowd --sizes 1,4 --seconds 0.5 --repeat 1 --out DIR"))
                .contains("us of processor time", "crowd.svg");
        assertThat(written("crowd.csv")).hasLineCount(3);
        assertThat(written("crowd.svg")).contains("<svg");
        assertWritten("crowd.png");
    }

    @Test
    void run_inCallbackMode_tellsItsMessages_andItsTicksWithoutAService() {
        assertThat(printed("run " + ARENA + "--seconds 100 --mode CALLBACK --reconnect --out DIR"))
                .contains("callback mode with reconnection, seed 1")
                .containsPattern("readings with no or several services +1 +1\\R")
                .containsPattern("colours sent by colour finders: [1-9][0-9]+ in 1 state change,");
    }

    private String logWithoutItsMode(String mode) throws IOException {
        String log = written("run-" + mode + ".jsonl");
        String field = ",\"mode\":\"" + mode + "\"";
        assertThat(log.lines().findFirst().orElse("")).contains(field);
        return log.replace(field, "");
    }

    @Test
    void modes_showsWhereSynchronousModeDiffers_andThatCallbackModeDoesNot() throws Exception {
        String text = printed("modes " + ARENA + "--seconds 100 --out DIR");
        assertThat(err.toString()).isEmpty();
        assertThat(text)
                .contains("sync mode", "callback mode", "promise mode", "*  46.1 s 3: robot 2 sees green")
                .contains("callback mode: the same states at the same times and the same trajectories")
                .contains("as each waits for the cycles of the others. The robots are elsewhere from 0.1 s on");
        assertThat(text.lines().filter(line -> line.contains("*  "))).hasSize(1);
        assertThat(text.lines().takeWhile(line -> !line.startsWith("*")))
                .as("the table")
                .hasSizeGreaterThan(2)
                .allSatisfy(line -> assertThat(line).hasSizeLessThanOrEqualTo(100));

        String promise = logWithoutItsMode("promise");
        String sync = logWithoutItsMode("sync");
        assertThat(logWithoutItsMode("callback")).isEqualTo(promise).isNotEqualTo(sync);
        String picture = written("modes.svg");
        assertThat(picture).doesNotContain("#00ff00");
        var svg = ParsedSvg.parse(picture);
        assertThat(svg.elements("g"))
                .as("bars, one for each state")
                .hasSize((promise + promise + sync).split("\"type\":\"state\"", -1).length - 1);
        assertThat(svg.title())
                .matches("States compared with promise mode: sync differs from [0-9.]+ s on,"
                        + " callback does not differ \\(paper arena, seed 1\\)");
    }

    // ---- pictures

    /**
     * Expected areas and titles: one per obstacle and robot. Expected rays: 16 sonars per robot, and 181 of the laser.
     */
    @ParameterizedTest
    @CsvSource({"paper-arena, 2, 32, 12.4", "office, 2, 213, 16.4", "track, 1, 16, 20.4"})
    void world_isDrawnWithAllThatIsInIt(String name, int robots, int rays, double widthM) throws Exception {
        String text = printed("draw --out DIR/w.svg worlds/" + name + ".world");

        String counted = robots == 1 ? "1 robot," : robots + " robots,";
        assertThat(text).startsWith(counted + " ").contains(local("wrote DIR/w.svg"));
        int things = Integer.parseInt(text.replaceAll("(?s).*robots?, (\\d+) other.*", "$1"));
        var svg = ParsedSvg.parse(written("w.svg"));
        assertThat(svg.elements("title")).hasSize(1 + things + robots);
        assertThat(svg.elements("path")).hasSize(things + 2 * robots + rays);
        assertThat(svg.title()).contains(counted);
        assertThat(svg.texts()).contains("robot1", "sonar, first reading");
        assertThat(svg.texts().contains("laser, first reading")).isEqualTo(name.equals("office"));
        assertThat(svg.pixelsPerMetre())
                .as("as long as the map is wide: LONGEST_PX over the outer walls and 0.3 m on both sides")
                .isCloseTo(1000 / (widthM + 0.6), within(0.05));
    }

    @Test
    void pictureInTheGuide_isThatOfTheCommand() {
        printed("draw --out DIR/w.svg worlds/office.world");
        assertThat(directory.resolve("w.svg"))
                .hasSameTextualContentAs(Path.of("..", "docs", "figures", "world-office.svg"));
    }

    /** A world of 5.4 m by 8.4 m with five robots, two of them navy. */
    @Test
    void trajectory_ofANarrowWorldWithFiveRobots_canBeRead() throws Exception {
        file("five.table", """
                robots 5
                ignore black : walls
                state blue : wallFollower, spaceWanderer, spaceWanderer, spaceWanderer, wallFollower
                state red  : spaceWanderer, wallFollower, spaceWanderer, wallFollower, spaceWanderer
                """);
        var world = new StringBuilder("""
                name "narrow hall"
                interval_sim 100
                include "pioneer.inc"
                define wall model ( color "black" obstacle_return 1 blob_return 1 )
                wall ( name "n" pose [ 0 4.1 0 0 ] size [ 5.4 0.2 0.5 ] )
                wall ( name "s" pose [ 0 -4.1 0 0 ] size [ 5.4 0.2 0.5 ] )
                wall ( name "e" pose [ 2.6 0 0 0 ] size [ 0.2 8 0.5 ] )
                wall ( name "w" pose [ -2.6 0 0 0 ] size [ 0.2 8 0.5 ] )
                """);
        var configuration = new StringBuilder(
                "driver ( name \"stage\" provides [ \"simulation:0\" ] plugin \"p\" worldfile \"narrow.world\" )\n");
        var colours = List.of("orange", "black", "navy", "navy", "gold");
        for (int robot = 0; robot < colours.size(); robot++) {
            world.append("pioneer2dx ( name \"r%d\" color \"%s\" pose [ %d %d 0 90 ] )\n"
                    .formatted(robot, colours.get(robot), robot % 2 == 0 ? -1 : 1, robot - 2));
            String devices = "\"position2d:%1$d\" \"sonar:%1$d\" \"blobfinder:%1$d\"";
            configuration.append(
                    ("driver ( name \"stage\" provides [ " + devices + " ] model \"r%1$d\" )\n").formatted(robot));
        }
        file("narrow.world", world.toString());
        file("narrow.cfg", configuration.toString());
        printed("run --seconds=20 --world=DIR/narrow.cfg --table=DIR/five.table --out=DIR");

        var svg = ParsedSvg.parse(written("trajectory.svg"));
        assertThat(svg.title())
                .startsWith("narrow hall: 5 robots change state ")
                .endsWith(" in 20 s");
        assertThat(svg.pixelsPerMetre()).isCloseTo(70, within(0.1));
        captionIsInside(svg);
        var legend = dashes(svg.elements("line", "stroke", "#444444"));
        assertThat(legend).as("every robot has a line of its own").hasSize(5).doesNotHaveDuplicates();
        assertThat(dashes(svg.elements("polyline"))).containsAll(legend);
        assertThat(svg.elements("text", "font-weight", "bold"))
                .as("numbers can be read on the bodies")
                .extracting(text -> text.getTextContent() + " " + text.getAttribute("fill"))
                .containsExactly("1 black", "2 white", "3 white", "4 white", "5 black");
        assertThat(svg.elements("polygon", "class", "head")).as("directions").isNotEmpty();
        assertThat(svg.texts()).contains("10 s");
        assertThat(svg.elements("circle", "class", "time")).hasSize(5);
    }

    /** Estimates the text width: half the font size per letter, about the mean of a sans-serif font. */
    private static void captionIsInside(ParsedSvg svg) {
        String[] viewBox = svg.root().getAttribute("viewBox").split(" ");
        assertThat(svg.elements("text", "class", "caption")).isNotEmpty();
        assertThat(svg.elements("text")).allSatisfy(text -> {
            boolean centred = text.getAttribute("text-anchor").equals("middle");
            int letters = text.getTextContent().length();
            assertThat(ParsedSvg.number(text, "x") + letters * 14 * 0.5 * (centred ? 0.5 : 1))
                    .as(text.getTextContent())
                    .isLessThan(Double.parseDouble(viewBox[2]));
            assertThat(ParsedSvg.number(text, "y")).isLessThan(Double.parseDouble(viewBox[3]));
        });
    }

    private static List<String> dashes(List<Element> lines) {
        return lines.stream().map(line -> line.getAttribute("stroke-dasharray")).toList();
    }

    @Test
    void trajectory_ofACrowd_fadesWithAge() throws IOException {
        printed("run --robots=12 --seconds=6 --out=DIR");
        String svg = written("trajectory.svg");
        assertThat(svg).containsSubsequence("stroke-opacity=\"0.10\"", "stroke-opacity=\"0.85\"");
        assertThat(svg.indexOf("stroke-opacity=\"0.10\"")).isLessThan(svg.indexOf("stroke-opacity=\"0.85\""));
    }

    @Test
    void log_thatCannotBeWritten_isNamed_andTheSummaryIsKept() throws Exception {
        Path full = Path.of("/dev/full");
        assumeTrue(Files.exists(full), "a device that is always full");
        Files.createSymbolicLink(directory.resolve("run.jsonl"), full);
        assertThat(troupe("run " + ARENA + "--seconds 20 --out DIR")).isEqualTo(Main.FAILED);
        assertThat(err.toString().lines()).containsExactly(local("troupe: DIR/run.jsonl: No space left on device"));
        assertThat(out.toString()).contains("20.0 s simulated", "distance driven");
    }
}
