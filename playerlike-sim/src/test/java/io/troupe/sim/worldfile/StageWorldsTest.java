package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.WorldSpec;
import java.io.File;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.Stream;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.MethodSource;

/** Constructs of the worlds that come with Stage 2 to 4 are read without options, some with a warning. */
class StageWorldsTest {
    private static final Path RESOURCES = Path.of("src/test/resources/io/troupe/sim/worldfile/stage");

    @TempDir
    private Path dir;

    private Worlds worlds;

    @BeforeEach
    void files() {
        worlds = new Worlds(dir);
    }

    static Stream<Path> resources() throws IOException {
        try (Stream<Path> files = Files.list(RESOURCES)) {
            return files.filter(file -> file.toString().endsWith(".world")).sorted().toList().stream();
        }
    }

    @ParameterizedTest
    @MethodSource("resources")
    void worldWithTheConstructsOfStage_isReadWithTheWarningsThatItAnnounces(Path file) throws IOException {
        var warnings = new ArrayList<String>();

        Scenario scenario = ScenarioReader.read(
                file,
                warning -> warnings.add(warning.where().file().getFileName() + ":"
                        + warning.where().line()));

        List<String> announced = Files.readAllLines(file).stream()
                .filter(line -> line.startsWith("# warns: "))
                .flatMap(line -> Stream.of(line.substring("# warns: ".length()).split(" ")))
                .toList();
        assertThat(warnings).containsExactlyInAnyOrderElementsOf(announced);
        assertThat(scenario.world().robots()).isNotEmpty();
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "position ( drive \"omni\" )    | t.world:1:18: \"drive\" \"omni\" is not simulated: the robot has two driven wheels, as with \"diff\"",
                "position ( drive \"car\" )     | t.world:1:18: \"drive\" \"car\" is not simulated: the robot has two driven wheels, as with \"diff\"",
                "position ( velocity [0 1 0 0] ) | t.world:1:21: a robot with differential drive cannot move sideways: its start speed of 1.0 that way is left out",
                "position ( gripper () )        | t.world:1:12: \"gripper\" is not simulated and left out; simulated are model, position, ranger, laser and blobfinder",
                "define arm gripper () position ( arm () ) | t.world:1:34: \"gripper\" is not simulated and left out; simulated are model, position, ranger, laser and blobfinder",
                "position ( wifi ( essid \"x\" ) ) | t.world:1:12: \"wifi\" is not simulated and left out; simulated are model, position, ranger, laser and blobfinder",
                "position ( blinkenlight () )   | t.world:1:12: \"blinkenlight\" is not simulated and left out; simulated are model, position, ranger, laser and blobfinder",
                "model ( position () )          | t.world:1:9: a position on a model does not drive here: it is read as a part of the model",
                "position ( position () )       | t.world:1:12: a position on a robot does not drive by itself here: it is read as a model that the robot carries",
                "position ( blobfinder () blobfinder () ) | t.world:1:26: a second blobfinder on one robot is not simulated and left out; the first is at t.world:1:12",
                "position ( ranger ( scount 1 spose[0] [0 0 0] ) model ( ranger ( scount 1 spose[0] [0 0 0] ) ) ) | t.world:1:57: a second ring of sonars on one robot is not simulated and left out; the first is at t.world:1:12",
                "position ( blobfinder ( channel_count 1 ) ) | t.world:1:25: \"channel_count\" is an obsolete name which Stage ignores; write colors_count",
                "position ( laser () ranger ( sensor () ) ) | t.world:1:12: \"laser\" belongs to the classic dialect, but \"sensor\" at t.world:1:30 to that of Stage 4; the world is read as one of Stage 4",
                "position ( velocity_bounds [-1 1 -1 1 -1 1 -90 90] ranger ( scount 1 spose[0] [0 0 0] ) ) | t.world:1:61: \"scount\" belongs to the classic dialect, but \"velocity_bounds\" at t.world:1:12 to that of Stage 4; the world is read as one of Stage 4",
                "model ( laser_return 0 )       | t.world:1:22: lasers and sonars see the same things here: \"ranger_return\" counts, and \"laser_return\" differs from it",
                "model ( blobfinder () )        | t.world:1:9: a blobfinder must hang on a robot (a position); on a model that stands still it is left out",
                "ranger ()                      | t.world:1:1: a ranger that hangs on no robot (a position) is read by nobody and left out",
                "position ( ranger ( alwayson 1 ) ) | t.world:1:12: a ranger without \"scount\" sonars and without a sensor( .. ) as in Stage 4 measures nothing and is left out",
                "position ( ranger ( sensor ( view [0 5 30] ) ) ) | t.world:1:30: \"view\" has no effect, here or in Stage 4: write range and fov",
                "position ( ranger ( samples 9 sensor () ) ) | t.world:1:21: \"samples\" has no effect on a ranger, here or in Stage 4: it belongs in a sensor( .. ) of it",
                "model ( block ( points 3 point[0] [0 0] point[1] [1 0] point[2] [1 1] color \"red\" ) ) | t.world:1:71: \"color\" has no effect here: a block has the colour of its model",
                "model ( joules 9 )             | t.world:1:9: \"joules\" has no effect here: energy is not simulated",
                "position ( ctrl \"wander\" )    | t.world:1:17: \"ctrl\" \"wander\" is a program that Stage runs and that is not run here: robots wait for their clients",
                "position ( watchdog_timeout -1 ) | t.world:1:12: \"watchdog_timeout\" has no effect here: a client asks for a limit to its commands by itself",
                "define a model ( mass 1 ) define a model ( mass 2 ) a () | t.world:1:34: macro \"a\" is already defined at t.world:1:8, and the first counts",
                "model ( size [1 1] size [2 2] ) | t.world:1:20: \"size\" is given twice, the first time at t.world:1:9, and the last counts",
            })
    void thingThatStageKnowsAndThatIsNotSimulated_isAWarningWithItsPlace(String text, String warning) {
        assertThat(worlds.warnings(text.strip())).containsExactly(warning);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "model ( siez [1 1] )  | t.world:1:9: unknown property \"siez\" of model; did you mean \"size\"?",
                "psition ()            | t.world:1:1: unknown entity \"psition\"; did you mean \"position\"?",
                "define wall modle ()  | t.world:1:13: unknown entity \"modle\"; did you mean \"model\"?",
                "position ( wifii () ) | t.world:1:12: unknown entity \"wifii\"; known: blobfinder, block, laser, model, position, ranger",
            })
    void nameThatNobodyKnows_isAnErrorAndLenientlyAWarning(String text, String message) {
        var warnings = new ArrayList<String>();
        assertThat(worlds.problem(text.strip())).isEqualTo(message.strip());

        ScenarioReader.readLeniently(
                worlds.write("t.world", text.strip()),
                warning -> warnings.add(warning.toString().replace(dir + "/", "")));

        assertThat(warnings).containsExactly(message.strip());
    }

    @Test
    void sameWarning_isGivenOnce_andNotMoreThanAThousand() {
        assertThat(worlds.warnings("define r position ( joules 1 ) r ( name \"a\" ) r ( name \"b\" pose [ 3 0 0 0 ] )"))
                .hasSize(1);

        List<String> many = worlds.warnings("model ( mass 1" + "\nmass 1".repeat(3000) + " )");

        assertThat(many).hasSize(1001);
        assertThat(many.getLast()).isEqualTo("t.world:1002:1: more than 1000 warnings; no more are shown");
    }

    @Test
    void macroOrPropertyGivenTwice_countsAsInStage() {
        WorldSpec world = worlds.world("""
                define post model ( color "red" size [ 1 1 ] )
                define post model ( color "blue" size [ 2 2 ] )
                post ( size [ 3 3 ] color "green" size [ 4 2 ] )
                post ( pose [ 9 9 0 0 ] )
                """);

        assertThat(world.obstacles()).extracting(ObstacleSpec::colour).containsExactly(0x00ff00, 0xff0000);
        Box first = Box.around(world.obstacles().getFirst().shape().polygons());
        assertThat(first.width()).isCloseTo(4, within(1e-9));
        assertThat(first.height()).isCloseTo(2, within(1e-9));
    }

    @Test
    void polygonsOfStage2_areTheOutlineScaledToTheSize() {
        String square = """
                polygons 1 polygon[0].points 3 polygon[0].filled 1
                polygon[0].point[0] [ 0 0 ] polygon[0].point[1] [ 2 0 ] polygon[0].point[2] [ 2 2 ]
                """;
        String block = "block ( points 3 point[0] [ 0 0 ] point[1] [ 2 0 ] point[2] [ 2 2 ] )";

        Shape asPolygon = shape("model ( size [ 4 1 ] " + square + " )");

        assertThat(asPolygon).isEqualTo(shape("model ( size [ 4 1 ] " + block + " )"));
        assertThat(shape("model ( size [ 4 1 ] "
                        + square.replace("polygons", "blocks")
                                .replace("polygon[", "block[")
                                .replace("block[0].filled 1", "block[0].z [ 0 1 ]")
                        + " )"))
                .isEqualTo(asPolygon);
        assertThat(shape("define wedge model ( " + square + " ) wedge ( size [ 4 1 ] )"))
                .as("inherited")
                .isEqualTo(asPolygon);
    }

    private Shape shape(String text) {
        return worlds.world(text).obstacles().getFirst().shape();
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "polygons 1 | t.world:1:18: \"polygons\" is 1, but polygon[0].points is missing",
                "polygons 100000 | t.world:1:18: \"polygons\" must be from 0 to 1000, not 100000",
                "polygons 1 polygon[0].points 4 polygon[0].point[0] [ 0 0 ] | t.world:1:38: \"points\" is 4, but point[1] is missing",
                "polygons 1 polygon[0].points 2000000000 | t.world:1:38: a block needs 3 to 1000 points, not 2000000000",
                "polygon[0].pionts 4 | t.world:1:9: unknown property \"polygon[0].pionts\" of model; did you mean \"polygon.points\"?",
                "polygon[0].point [ 0 0 ] | t.world:1:9: \"polygon[0].point\" needs an index: polygon[0].point[0], polygon[0].point[1], ..",
            })
    void polygonOfStage2_thatMakesNoSense_isRefused(String text, String message) {
        assertThat(worlds.problem("model ( " + text.strip() + " )")).isEqualTo(message);
    }

    @Test
    void ringOfStage2_hasOneSizeForEachSonar() {
        RobotSpec robot = worlds.world("""
                        position ( ranger ( scount 2 spose[0] [ 0 0 0 ] spose[1] [ 0 0 90 ]
                          ssize[0] [ 0.01 0.05 ] ssize[1] [ 0.01 0.05 ] sview[0] [ 0.1 4 20 ] sview[1] [ 0.1 4 20 ] ) )
                        """).robots().getFirst();

        assertThat(robot.sonar()).isNotNull();
        assertThat(robot.sonar().maxRangeM()).isEqualTo(4);
        assertThat(robot.sonar().fovRad()).isEqualTo(Math.toRadians(20));
    }

    @Test
    void flag_isTrueForAnyNumberButZero() {
        assertThat(worlds.world("model ( blob_return 2 ) model ( blob_return 0 ) model ( blob_return 0.5 )")
                        .obstacles())
                .extracting(ObstacleSpec::visible)
                .containsExactly(true, false, true);
    }

    @Test
    void colourRandom_differsFromPlaceToPlaceAndIsTheSameEachTime() {
        String text = "define bot position ( color \"random\" )\n"
                + "bot ( )\nbot ( pose [ 1 0 0 0 ] )\nbot ( pose [ 2 0 0 0 ] )\nbot ( pose [ 3 0 0 0 ] )\n";

        List<Integer> colours =
                worlds.world(text).robots().stream().map(RobotSpec::colour).toList();

        assertThat(colours).doesNotHaveDuplicates().allMatch(colour -> colour >= 0 && colour <= 0xffffff);
        assertThat(worlds.world(text).robots()).extracting(RobotSpec::colour).isEqualTo(colours);
    }

    @Test
    void positionOnARobot_isItsCargoWithItsSensors() {
        RobotSpec robot = worlds.world("""
                        position ( size [ 0.4 0.4 ]
                          position ( pose [ 0.3 0 0 90 ] size [ 0.2 0.1 ] color "blue" laser ( pose [ 0.1 0 0 0 ] ) ) )
                        """).robots().getFirst();

        assertThat(robot.cargo())
                .singleElement()
                .satisfies(plate -> assertThat(plate.colour()).isEqualTo(0x0000ff));
        assertThat(robot.rangers())
                .singleElement()
                .satisfies(laser -> assertThat(laser.mount().y()).isCloseTo(0.1, within(1e-12)));
    }

    @Test
    void foldersOfStage_areThoseOfItsPath_thenWhereItInstallsItsWorlds() {
        String path = dir.resolve("a") + File.pathSeparator + File.pathSeparator + dir.resolve("b");
        var installed = List.of(Path.of("/usr/local/share/stage/worlds"), Path.of("/usr/share/stage/worlds"));
        assertThat(SourceText.stageFolders(path))
                .containsExactly(dir.resolve("a"), dir.resolve("b"), installed.get(0), installed.get(1));
        assertThat(SourceText.stageFolders(null)).isEqualTo(installed);
    }

    @Test
    void namedFile_isLookedForBesideTheNamingOneThenBesideTheWorldThenInStagesFolders() throws IOException {
        Path parts = Files.createDirectories(dir.resolve("parts"));
        Path stage = Files.createDirectories(dir.resolve("stage"));
        Files.writeString(stage.resolve("only.inc"), "");
        worlds.write("wall.inc", "define wall model ()");
        worlds.write("parts/all.inc", "include \"wall.inc\"");
        Path from = parts.resolve("all.inc");
        Path world = worlds.file("t.world");
        var where = new SourcePosition(from, 1, 1);

        assertThat(worlds.world("include \"parts/all.inc\" wall ()").obstacles())
                .hasSize(1);
        assertThat(SourceText.find(from, world, List.of(stage), "only.inc", where))
                .isEqualTo(stage.resolve("only.inc"));
        assertThat(SourceText.find(from, world, List.of(stage), "wall.inc", where))
                .isEqualTo(dir.resolve("wall.inc"));
        assertThat(SourceText.find(from, world, List.of(stage), "none.inc", where))
                .as("none has it")
                .isEqualTo(parts.resolve("none.inc"));
    }
}
