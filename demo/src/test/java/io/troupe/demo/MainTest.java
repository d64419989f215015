package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.PetriNet;
import io.troupe.petri.Pnml;
import io.troupe.view.RunLog;
import java.io.IOException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** The command line: every usage error gives one clear line and exit status 2. */
class MainTest extends CommandLineBench {
    @Test
    void help_namesCommandsAndOptions_andHowToStart() {
        assertThat(printed(""))
                .startsWith("Usage: troupe")
                .contains("evaluate", "Start with the main job: troupe run");
        assertThat(printed("help run")).startsWith("Usage: troupe run").doesNotContain("Start with");
        assertThat(printed("run --help"))
                .contains("--world=FILE", "--seconds=N", "--seed=N", "--realtime", "--out=DIR");
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
                "run --mode magic | --mode .. magic .. SYNC, CALLBACK, PROMISE .. case-insensitive",
                "run --mode sync --reconnect | --reconnect goes with --mode callback or promise .. connects once"
                        + " .. troupe run --help",
                "run --out DIR/taken | --out is DIR/taken, but DIR/taken is a file, expected a directory",
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
                "serve --realtime --lock-step | troupe: --realtime, --lock-step are mutually exclusive",
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
    void recordingThatCannotBeWritten_isOneLineWithoutNamesOfClasses() {
        assertThat(troupe("serve " + ARENA + "--port 0 --record DIR/missing/session.txt"))
                .isEqualTo(Main.USAGE);
        assertThat(err.toString().lines())
                .containsExactly(local("troupe: --record is DIR/missing/session.txt, but there is no directory"
                        + " DIR/missing (see troupe serve --help)"));
    }

    @Test
    void nameThatCanBeNoFile_isToldWithTheEncoding() {
        assertRefused("draw a\0b", "'a\0b' can be no file here, where names are in ");
    }

    @Test
    void mistakeInAFile_isToldWithItsPlace() throws IOException {
        file("bad.pnml", "<pnml xmlns=\"http://www.pnml.org/version-2009/grammar/pnml\">");
        assertRefused("verify --net DIR/bad.pnml --out DIR", "bad.pnml", "troupe verify");
        file("wrong.world", "interval_sim 100\nmodel ( siez [ 1 1 1 ] )\n");
        assertRefused("run --world DIR/wrong.world --out DIR/o", "wrong.world:2:9: ", "siez", "size");
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
        assertThat(directory.resolve("states.svg")).doesNotExist();
    }

    @Test
    void netWithMoreTokensThanAnIntHolds_isOneLine() {
        var net = PetriNet.builder("many").place("p", Integer.MAX_VALUE).transition("t", List.of(), List.of("p"));
        Pnml.write(net.build(), directory.resolve("many.pnml"));
        assertRefused(
                "verify --net DIR/many.pnml --out DIR", "many.pnml", "place p would hold 2147483648 tokens");
    }

    @Test
    void configurationThatSwapsTheRobots_isRefused() throws IOException {
        for (String name : List.of("paper-arena.world", "pioneer.inc")) {
            Files.copy(Path.of("worlds", name), directory.resolve(name));
        }
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
            assertThat(err.toString().lines())
                    .contains(local(
                            "troupe: warning: DIR/t.world:2:9: \"joules\" has no effect here: energy is not simulated"));

            file("t.world", "\nmodel ( siez 1 )");
            String problem = local("DIR/t.world:2:9: unknown property \"siez\" of model; did you mean \"size\"?");
            assertRefused(line);
            assertThat(err.toString()).startsWith("troupe: " + problem);
            err.getBuffer().setLength(0);
            troupe(line + "--lenient");
            assertThat(err.toString().lines()).contains("troupe: warning: " + problem);
        }
    }
}
