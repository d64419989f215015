package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.LoggedWarnings;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.WorldSpec;
import java.io.File;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.function.Function;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.parallel.Isolated;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.MethodSource;

/**
 * Messages for wrong world files, which name position, value and what was expected, and the worlds of Stage 2 to 4,
 * which are read without options, some with a warning.
 */
@Isolated("reads the log")
class WorldErrorsTest extends WorldFiles {
    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            position ( Pose [1 1 0] ) | t.world:1:12: unknown property "Pose" of position; did you mean "pose"?
            block ( frobnicate 1 ) | t.world:1:1: "block" cannot stand in a world file; it belongs in a model or a position
            model ( block ( frobnicate 1 ) ) | t.world:1:17: unknown property "frobnicate" of block; known: point, points, z
            interval_sin 100 | t.world:1:1: unknown property "interval_sin" of world file; did you mean "interval_sim"?
            define pioneer position () pionee () | t.world:1:28: unknown entity "pionee"; did you mean "pioneer"?
            pioneer2dx () | t.world:1:1: unknown entity "pioneer2dx"; known: model, position, window
            define wall model ( collor "red" ) | t.world:1:21: unknown property "collor" of model; did you mean "color"?
            driver () | t.world:1:1: "driver" cannot stand in a world file; it belongs in a configuration file
            model ( size 1 ) | t.world:1:14: "size" must be a tuple of 2 or 3 numbers, not the number 1
            model ( size [1] ) | t.world:1:14: "size" must be a tuple of 2 or 3 numbers, not a tuple of 1 value
            model ( pose [1 2 "x"] ) | t.world:1:14: "pose" must be a tuple of 3 or 4 numbers, not a tuple of 3 values
            model ( color 7 ) | t.world:1:15: "color" must be a text in double quotes, not the number 7
            model ( mass "heavy" ) | t.world:1:14: "mass" must be a number, not the text "heavy"
            model ( gui_nose "yes" ) | t.world:1:18: "gui_nose" must be a number, 0 for no, not the text "yes"
            model ( size[0] [1 1] ) | t.world:1:9: "size" takes no index
            window ( size "big" ) | t.world:1:15: "size" must be a tuple of 2 numbers, not the text "big"
            interval_sim 0.5 | t.world:1:14: "interval_sim" must be a whole number, not the number 0.5
            interval_sim 0 | t.world:1:14: "interval_sim" must be from 1 to 60000 milliseconds, not 0
            unit_length "km" | t.world:1:13: "unit_length" must be "m", "cm" or "mm", not "km"
            unit_angle "grad" | t.world:1:12: "unit_angle" must be "degrees" or "radians", not "grad"
            model ( size [1 0 1] ) | t.world:1:14: "size" must be from 0.001 to 10000 m in x and y, not 0.0 m
            model ( size [-1 1] ) | t.world:1:14: "size" must be from 0.001 to 10000 m in x and y, not -1.0 m
            model ( pose [1e9 0 0] ) | t.world:1:14: a length of 1.0E9 m is beyond anything a world can hold
            position ( mass 0 ) | t.world:1:17: "mass" must be above 0 kg, not 0.0
            position ( drive "dif" ) | t.world:1:18: "drive" must be "diff", "omni" or "car", not "dif"
            position ( localization "map" ) | t.world:1:25: "localization" must be "gps" or "odom", not "map"
            position ( localization "odom" odom_error [-1 0 0 0] ) | t.world:1:43: "odom_error" must be shares from 0 to 2 of a motion, not -1.0
            position ( velocity_bounds [1 2 -1 1 -1 1 -90 90] ) | t.world:1:28: "velocity_bounds" needs least <= 0 <= greatest along x and for turning, not 1.0 to 2.0 and -1.5707963267948966 to 1.5707963267948966 rad
            position ( obstacle_return 0 model () ) | t.world:1:30: a robot with "obstacle_return" 0 cannot carry a model that others bump into; give the model "obstacle_return" 0 too
            sensor () | t.world:1:1: "sensor" cannot stand in a world file; it belongs in a ranger
            model ( color "gren" ) | t.world:1:15: unknown colour "gren"; did you mean "green"?
            model ( color "#00ff00" ) | t.world:1:15: unknown colour "#00ff00"; expected a colour name of X11, such as "red"
            model ( color_rgba [ 255 0 0 1 ] ) | t.world:1:20: "color_rgba" must be four shares from 0 to 1, not 255.0
            """)
    void entry_thatIsUnknownOrMisplacedOrWrong_isRefused_namingWhatWasExpected(String text, String message) {
        assertThat(problem(text)).isEqualTo(message);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            ranger ( scount 0 ) | t.world:1:28: "scount" must be from 1 to 1000, not 0
            ranger ( scount 2 spose[0] [0 0 0] ) | t.world:1:28: "scount" is 2, but spose[1] is missing
            ranger ( scount 1 spose[0] [0 0 0] spose[1] [0 0 0] ) | t.world:1:28: "scount" is 1, but 2 sposes are given
            ranger ( scount 1 spose [0 0 0] ) | t.world:1:30: "spose" needs an index: spose[0], spose[1], ..
            ranger ( scount 1 spose[0] [0 0] ) | t.world:1:39: "spose[0]" must be a tuple of 3 numbers, not a tuple of 2 values
            ranger ( scount 1 spose[0] [0 0 0] sview [5 1 15] ) | t.world:1:53: "sview" [min max fov] needs 0 <= min < max <= 1000 m, not 5.0 and 1.0
            ranger ( scount 1 spose[0] [0 0 0] sview [0 5 0] ) | t.world:1:53: the field of view must be above 0 and at most a full circle, not 0.0
            blobfinder ( image [80 0] ) | t.world:1:31: "image" must be two whole numbers from 1 to 10000, not 0.0
            blobfinder ( range 0 ) | t.world:1:31: "range" must be above 0 and at most 1000 m, not 0.0
            blobfinder ( fov 361 ) | t.world:1:29: the field of view must be above 0 and at most a full circle, not 361.0
            blobfinder ( colors_count 2 colors ["red"] ) | t.world:1:38: "colors_count" is 2, but "colors" has 1
            blobfinder ( colors ["red"] ) | t.world:1:32: "colors_count" is 0, but "colors" has 1
            blobfinder ( colors_count 1 colors ["rad"] ) | t.world:1:48: unknown colour "rad"; did you mean "red"?
            blobfinder ( colors_count 1 colors [1] ) | t.world:1:47: "colors" must be a tuple of texts [ ".." .. ], not a tuple of 1 value
            laser ( samples 0 ) | t.world:1:28: "samples" must be from 1 to 10000, not 0
            laser ( range_max 0 ) | t.world:1:30: the range needs 0 <= least < greatest <= 1000 m, not 0.0 to 0.0
            laser ( fov -1 ) | t.world:1:24: "fov" must be from 0 to a full circle, not -1.0
            laser ( resolution 0 ) | t.world:1:31: "resolution" must be 1 or more samples, not 0
            laser ( size [-1 1] ) | t.world:1:25: "size" of a laser must not be negative
            ranger ( sensor ( range [5 1] ) ) | t.world:1:36: the range needs 0 <= least < greatest <= 1000 m, not 5.0 to 1.0
            ranger ( sensor ( noise [0 -1 0] ) ) | t.world:1:36: "noise" [constant proportional angular] must not be negative, not -1.0
            ranger ( sensor ( samples 20000 ) ) | t.world:1:38: "samples" must be from 1 to 10000, not 20000
            """)
    void sensor_thatDoesNotAddUp_isRefused(String sensor, String message) {
        assertThat(problem("position ( " + sensor + " )")).isEqualTo(message);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            points 2 point[0] [0 0] point[1] [1 1] | t.world:1:24: a block needs 3 to 1000 points, not 2
            z [0 1] | t.world:1:9: a block needs 3 to 1000 points, not 0
            points 4 point[0] [0 0] point[1] [1 0] point[2] [1 1] | t.world:1:24: "points" is 4, but point[3] is missing
            points 3 point[0] [0 0] point[1] [1 0] point[2] [1 1] point[3] [0 1] | t.world:1:24: "points" is 3, but 4 points are given
            points 3 point[0] [0 0] point[1] [1 0] point[3] [1 1] | t.world:1:24: "points" is 3, but point[2] is missing
            points 3 point[0] [0 0] point[1] [1 0] point[2] [1 0] | t.world:1:24: a block needs 3 to 1000 different points, not 2
            points 3 point[0] [0 0] point[1] [1 0] point[2] [2 0] | t.world:1:9: the block has no area: its points lie on a line
            points 4 point[0] [0 0] point[1] [1 1] point[2] [1 0] point[3] [0 1] | t.world:1:9: the block's outline crosses or touches itself: the edge from point[0] meets the edge from point[2]
            points 4 point[0] [0 0] point[1] [2 0] point[2] [1 0] point[3] [1 1] | t.world:1:9: the block's outline crosses or touches itself: the edge from point[0] meets the edge from point[1]
            points 3 point[0] [0 0] point[1] [1 0] point[2] [1e7 1] | t.world:1:65: a block's coordinates must be within +-1000000
            points 4 point[0] [0 0] point[1] [1e6 1e6] point[2] [0 1e-9] point[3] [-0.0001 0] | t.world:1:9: the block is too thin: scaled to "size" it is narrower than a micrometre
            """)
    void block_thatIsNoSimplePolygon_isRefused(String block, String message) {
        assertThat(problem("model ( block ( " + block + " ) )")).isEqualTo(message);
    }

    @Test
    void error_inAnIncludedFile_namesThatFile() {
        write("parts.inc", "\ndefine wall model\n(\n  size [ 1 1 ]\n  colour \"red\"\n)");
        assertThat(problem("include \"parts.inc\" wall ()"))
                .isEqualTo("parts.inc:5:3: unknown property \"colour\" of model; did you mean \"color\"?");
    }

    @Test
    void wordsOfAnyLength_areNotQuotedWhole() {
        String word = "x".repeat(5_000_000);
        assertThat(List.of(
                        "model ( " + word + " 1 )",
                        word + " ()",
                        "model ( color \"" + word + "\" )",
                        "model ( size " + word + " )",
                        "model ( mass 1" + word + " )",
                        "model ( bitmap \"" + word + "\" )",
                        "position ( name \"" + word + "\" ) position ( name \"" + word + "\" pose [ 3 0 0 0 ] )"))
                .extracting(text -> problem(text).length())
                .allSatisfy(length -> assertThat(length).isBetween(1_000, 3_000));
        assertThat(problem("model ( " + word + " 1 )"))
                .startsWith("t.world:1:9: unknown property \"xxx")
                .contains("x .. (4")
                .contains(" characters are left out here) .. ")
                .contains("; known: alwayson, ");
        assertThat(lenientWarnings("model ( " + "x".repeat(100_000) + " 1 )"))
                .singleElement()
                .satisfies(warning -> assertThat(warning).hasSizeBetween(1_000, 3_000));
    }

    // ---- where robots and obstacles are

    private static final String WALLS = "model ( name \"arena\" size [ 10 10 1 ] boundary 1 )\n";

    private static String robot(String name, double x, double y, double degrees) {
        return "position ( name \"%s\" size [ 1 1 1 ] pose [ %s %s 0 %s ] )%n".formatted(name, x, y, degrees);
    }

    @Test
    void robots_thatOverlap_areBothNamed_butThoseThatTouchAreApart() {
        assertThat(warnings(robot("a", 0, 0, 0) + robot("b", 0.9, 0.9, 0)))
                .containsExactly(
                        "t.world:2:1: robot \"b\" overlaps robot \"a\" (t.world:1:1) at the start: both stall, each until"
                                + " it is put elsewhere");
        assertThat(warnings(robot("a", 0, 0, 0) + robot("b", 1, 0, 0) + robot("c", 0, -1, 90)))
                .isEmpty();
        // both turned by 45 degrees: corners at 0.7071 along the axes, so their bounding boxes meet at (0.75, 0.75)
        double meeting = Math.sqrt(0.5);
        assertThat(warnings(robot("a", 0, 0, 45) + robot("b", meeting + 0.001, meeting + 0.001, 45)))
                .isEmpty();
        assertThat(warnings(robot("a", 0, 0, 45) + robot("b", meeting - 0.001, meeting - 0.001, 45)))
                .hasSize(1);
    }

    @Test
    void robot_insideAnObstacle_isWarnedAbout_unlessItCanBeDrivenThroughOrIsHollow() {
        String box = "model ( name \"box\" pose [ 2 0 0 0 ] size [ 3 3 ] ";
        assertThat(warnings(robot("a", 2, 0, 0) + box + ")"))
                .containsExactly(
                        "t.world:1:1: robot \"a\" overlaps obstacle \"box\" (t.world:2:1) at the start: it stalls"
                                + " until it is put elsewhere");
        assertThat(warnings(robot("a", 2, 0, 0) + box + "obstacle_return 0 )")).isEmpty();
        String hook = """
                model ( size [ 4 4 ] block ( points 8 point[0] [ 0 0 ] point[1] [ 4 0 ] point[2] [ 4 4 ] point[3] [ 3 4 ]
                  point[4] [ 3 1 ] point[5] [ 1 1 ] point[6] [ 1 4 ] point[7] [ 0 4 ] ) )
                """;
        assertThat(warnings(hook + robot("a", 0, 0.6, 0))).isEmpty();
        assertThat(warnings(hook + robot("a", 0, -0.6, 0)))
                .singleElement()
                .asString()
                .contains("overlaps obstacle \"model:0\"");
    }

    @Test
    void robot_outsideTheWalls_isRefusedWithItsPlaceAndTheirs() {
        assertThat(problem(WALLS + robot("lost", 7.25, 0, 0)))
                .isEqualTo("t.world:2:1: robot \"lost\" at (7.250, 0.000) stands outside the arena, whose walls reach"
                        + " x from -5.000 to 5.000, y from -5.000 to 5.000");
        String boxes = """
                define wall model ( color "black" )
                wall ( size [ 10 0.2 ] pose [ 0 5 0 0 ] ) wall ( size [ 10 0.2 ] pose [ 0 -5 0 0 ] )
                wall ( size [ 0.2 10.2 ] pose [ 5 0 0 0 ] ) wall ( size [ 0.2 10.2 ] pose [ -5 0 0 0 ] )
                """;
        assertThat(problem(boxes + robot("lost", 0, -8, 0))).contains("stands outside the arena");
    }

    @Test
    void robot_insideOrBesideThingsOrBeforeAGate_isNotOutside() {
        String open = "model ( pose [ 3 0 0 0 ] size [ 1 1 ] ) model ( pose [ 3 5 0 0 ] size [ 1 1 ] )\n";
        String gated = """
                model ( size [ 10 10 ] block ( points 8 point[0] [ 0 0 ] point[1] [ 10 0 ] point[2] [ 10 10 ] point[3] [ 0 10 ]
                  point[4] [ 0 9 ] point[5] [ 9 9 ] point[6] [ 9 1 ] point[7] [ 0 1 ] ) )
                """;
        assertThat(world(WALLS + robot("home", 4.4, 0, 0)).robots()).hasSize(1);
        assertThat(world(open + robot("free", 0, 0, 0)).robots()).hasSize(1);
        assertThat(world(gated + robot("guest", -8, 0, 0)).robots()).hasSize(1);
        assertThat(world("model () model ()").obstacles())
                .as("obstacles that overlap")
                .hasSize(2);
    }

    @Test
    void names_mustDiffer_andPlacesAreLimited() {
        String taken = "t.world:2:1: the name \"a\" is already taken at t.world:1:1";
        assertThat(problem(robot("a", 0, 0, 0) + robot("a", 3, 0, 0))).isEqualTo(taken);
        assertThat(problem("model ( name \"a\" )\n" + robot("a", 3, 0, 0))).isEqualTo(taken);
        assertThat(problem("model ( name \"far\" pose [ 0 -4999.6 0 0 ] size [ 1 1 ] )"))
                .isEqualTo("t.world:1:1: obstacle \"far\" lies 5000.100 m from the origin along x or y;"
                        + " the limit is 5000 m");
        assertThat(world("model ( size [ 1200 600 ] boundary 1 )").obstacles()).hasSize(1);
        assertThat(problem(robot("far", 900, 0, 0))).contains("robot \"far\" lies 900.500 m");
        assertThat(LoggedWarnings.of(
                        WorldChecks.class, () -> world(robot("near", 149, 0, 0) + robot("far", 0, 150, 0))))
                .containsExactly("WARNING " + file("t.world")
                        + ":2:1: robot \"far\" lies 150.500 m from the origin; beyond 150 m motion loses accuracy");
    }

    // ---- worlds with the constructs of Stage

    private static final Path RESOURCES = Path.of("src/test/resources/io/troupe/sim/worldfile/stage");

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
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            position ( velocity [0 1 0 0] ) | t.world:1:21: only a robot whose drive is "omni" can move sideways: its start speed of 1.0 that way is left out
            position ( camera ( pantilt [ 0 10 ] ) ) | t.world:1:29: the tilt of a camera has no effect here: it looks straight ahead
            position ( model ( fiducial_return 3 ) ) | t.world:1:36: a marker of a model that a robot carries is not seen here: give it to the robot
            position ( energy () ) | t.world:1:12: "energy" is not simulated and left out; simulated are model, position, ranger, laser, blobfinder, fiducial, bumper, camera and gripper
            define arm actuator () position ( arm () ) | t.world:1:35: "actuator" is not simulated and left out; simulated are model, position, ranger, laser, blobfinder, fiducial, bumper, camera and gripper
            position ( wifi ( essid "x" ) ) | t.world:1:12: "wifi" is not simulated and left out; simulated are model, position, ranger, laser, blobfinder, fiducial, bumper, camera and gripper
            position ( blinkenlight () ) | t.world:1:12: "blinkenlight" is not simulated and left out; simulated are model, position, ranger, laser, blobfinder, fiducial, bumper, camera and gripper
            model ( position () ) | t.world:1:9: a position on a model does not drive here: it is read as a part of the model
            position ( position () ) | t.world:1:12: a position on a robot does not drive by itself here: it is read as a model that the robot carries
            position ( blobfinder () blobfinder () ) | t.world:1:26: a second blobfinder on one robot is not simulated and left out; the first is at t.world:1:12
            position ( ranger ( scount 1 spose[0] [0 0 0] ) model ( ranger ( scount 1 spose[0] [0 0 0] ) ) ) | t.world:1:57: a second ring of sonars on one robot is not simulated and left out; the first is at t.world:1:12
            position ( blobfinder ( channel_count 1 ) ) | t.world:1:25: "channel_count" is an obsolete name which Stage ignores; write colors_count
            position ( laser () ranger ( sensor () ) ) | t.world:1:12: "laser" belongs to the classic dialect, but "sensor" at t.world:1:30 to that of Stage 4; the world is read as one of Stage 4
            position ( velocity_bounds [-1 1 -1 1 -1 1 -90 90] ranger ( scount 1 spose[0] [0 0 0] ) ) | t.world:1:61: "scount" belongs to the classic dialect, but "velocity_bounds" at t.world:1:12 to that of Stage 4; the world is read as one of Stage 4
            model ( laser_return 0 ) | t.world:1:22: lasers and sonars see the same things here: "ranger_return" counts, and "laser_return" differs from it
            model ( blobfinder () ) | t.world:1:9: a blobfinder must hang on a robot (a position); on a model that stands still it is left out
            ranger () | t.world:1:1: a ranger that hangs on no robot (a position) is not read and left out
            position ( ranger ( alwayson 1 ) ) | t.world:1:12: a ranger without "scount" sonars and without a sensor( .. ) as in Stage 4 measures nothing and is left out
            position ( ranger ( sensor ( view [0 5 30] ) ) ) | t.world:1:30: "view" has no effect, here or in Stage 4: write range and fov
            position ( ranger ( samples 9 sensor () ) ) | t.world:1:21: "samples" has no effect on a ranger, here or in Stage 4: it belongs in a sensor( .. ) of it
            model ( block ( points 3 point[0] [0 0] point[1] [1 0] point[2] [1 1] color "red" ) ) | t.world:1:71: "color" has no effect here: a block has the colour of its model
            model ( joules 9 ) | t.world:1:9: "joules" has no effect here: energy is not simulated
            position ( ctrl "wander" ) | t.world:1:17: "ctrl" "wander" is a program that Stage runs and that is not run here: robots wait for their clients
            position ( watchdog_timeout -1 ) | t.world:1:12: "watchdog_timeout" has no effect here: a client asks for a limit to its commands by itself
            define a model ( mass 1 ) define a model ( mass 2 ) a () | t.world:1:34: macro "a" is already defined at t.world:1:8, and the first counts
            model ( size [1 1] size [2 2] ) | t.world:1:20: "size" is given twice, the first time at t.world:1:9, and the last counts
            """)
    void thingThatStageKnowsAndThatIsNotSimulated_isAWarningWithItsPlace(String text, String warning) {
        assertThat(warnings(text)).containsExactly(warning);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            model ( siez [1 1] ) | t.world:1:9: unknown property "siez" of model; did you mean "size"?
            psition () | t.world:1:1: unknown entity "psition"; did you mean "position"?
            define wall modle () | t.world:1:13: unknown entity "modle"; did you mean "model"?
            position ( wifii () ) | t.world:1:12: unknown entity "wifii"; known: blobfinder, block, bumper, camera, fiducial, fiducialfinder, gripper, laser, model, position, ranger
            """)
    void nameThatNobodyKnows_isAnErrorAndLenientlyAWarning(String text, String message) {
        assertThat(problem(text)).isEqualTo(message);
        assertThat(lenientWarnings(text)).containsExactly(message);
    }

    @Test
    void sameWarning_isGivenOnce_andNotMoreThanAThousand() {
        assertThat(warnings("define r position ( joules 1 ) r ( name \"a\" ) r ( name \"b\" pose [ 3 0 0 0 ] )"))
                .hasSize(1);
        assertThat(warnings("model ( mass 1" + "\nmass 1".repeat(3000) + " )"))
                .hasSize(1001)
                .last()
                .isEqualTo("t.world:1002:1: more than 1000 warnings; no more are shown");
    }

    // ---- the lenient reader

    @Test
    void lenientReader_tellsEachThingOnceAndReadsTheRest_butRefusesWhatBreaksTheGrammar() {
        var warnings = new ArrayList<String>();
        Path file = write("t.world", """
                define pioneer position ( paint "matt" fiducial ( range_max 8 ) size [ 0.4 0.4 ] )
                pioneer ( name "a" ) pioneer ( name "b" pose [ 2 0 0 0 ] energy () wheel[3] 7 )
                speed 3
                model ( pose [ 4 0 0 0 ] laser () )
                """);
        WorldSpec world = ScenarioReader.readLeniently(file, into(warnings)).world();
        assertThat(world.robots()).extracting(RobotSpec::name).containsExactly("a", "b");
        assertThat(world.obstacles()).hasSize(1);
        String leftOut =
                " is not simulated and left out; simulated are model, position, ranger, laser, blobfinder, fiducial, bumper, camera and gripper";
        assertThat(warnings)
                .extracting(warning -> warning.replaceFirst("; known.*", ""))
                .containsExactlyInAnyOrder(
                        "t.world:1:27: unknown property \"paint\" of position",
                        "t.world:2:58: \"energy\"" + leftOut,
                        "t.world:2:68: unknown property \"wheel\" of position",
                        "t.world:3:1: unknown property \"speed\" of world file",
                        "t.world:4:26: a laser must hang on a robot (a position); on a model that stands still it is left"
                                + " out");
        Path wrong = write("t.world", "model ( size [ 1 1 )");
        assertThat(problemOf(() -> ScenarioReader.readLeniently(wrong, warning -> {})))
                .startsWith("t.world:1:20: missing ']'");
    }

    // ---- where files are looked for

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
        write("wall.inc", "define wall model ()");
        Path from = write("parts/all.inc", "include \"wall.inc\"");
        assertThat(world("include \"parts/all.inc\" wall ()").obstacles()).hasSize(1);

        Function<String, Optional<Path>> found =
                name -> SourceText.find(from, file("t.world"), List.of(stage), name, new SourcePosition(from, 1, 1));
        assertThat(found.apply("only.inc")).contains(stage.resolve("only.inc"));
        assertThat(found.apply(dir.resolve("gone/worlds/only.inc").toString())).contains(stage.resolve("only.inc"));
        assertThat(found.apply("wall.inc")).contains(file("wall.inc"));
        assertThat(found.apply("none.inc")).isEmpty();
    }

    @Test
    void includedFile_thatIsNowhere_isOneOfThoseThatComeWithUs_orToldWithThePlacesLookedAt() throws IOException {
        WorldSpec own = world("include \"pioneer.inc\" include \"sick.inc\" pioneer3dx ( sicklaser ( ) )");
        assertThat(own.robots().getFirst().rangers()).hasSize(1);
        write("pioneer.inc", "define pioneer3dx position ( size [ 1 1 1 ] )");
        assertThat(world("include \"pioneer.inc\" pioneer3dx ( )")
                        .robots()
                        .getFirst()
                        .sonar())
                .as("a file beside the world comes first")
                .isNull();

        assertThat(problem("include \"pionier.inc\""))
                .contains("there is no file pionier.inc; looked in ", "/usr/share/stage/worlds; with Troupe come")
                .endsWith("; did you mean \"pioneer.inc\"?");
        assertThat(problem("include \"sub/map.inc\"")).contains("there is no file sub/map.inc; looked in ");
        assertThat(problem("include \"pioneer.inc\" pioneer3dx ( bitmap \"a.png\" )"))
                .contains("looked in ");
    }

    @Test
    void includedFile_ofAnInstalledStage_isOurs_withAWarning() {
        String stage = "/opt/stage-4.3/worlds/map.inc";
        assertThat(warnings("include \"" + stage + "\" floorplan ( size [ 1 1 1 ] )"))
                .containsExactly("t.world:1:9: there is no file " + stage
                        + "; the map.inc that comes with Troupe is read instead");
        assertThat(problem("include \"/opt/other/worlds/map.inc\""))
                .contains("no file /opt/other/worlds/map.inc; with");
    }

    /** One robot of each kind with each laser, in both dialects, in which they must be the same. */
    @Test
    void filesThatComeWithUs_areAllListed_andDefineTheSameThingsInBothDialects() throws Exception {
        Path folder = Path.of(SourceText.class.getResource("includes").toURI());
        try (Stream<Path> files = Files.walk(folder).filter(Files::isRegularFile)) {
            assertThat(files.map(each -> folder.relativize(each).toString().replace('\\', '/')))
                    .containsExactlyInAnyOrderElementsOf(SourceText.OURS);
        }
        String things = "";
        for (String kind : List.of("pioneer2dx", "pioneer3dx", "pioneer3at", "amigobot")) {
            things += kind + " ( pose [ " + things.length() / 20.0 + " 0 0 0 ] sicklaser ( ) hokuyolaser ( ) )\n";
        }
        things += "include \"map.inc\"\nfloorplan ( size [ 90 9 1 ] )\nzone ( pose [ 1 0 0 0 ] )\n";
        String includes = "include \"pioneer.inc\"\ninclude \"sick.inc\"\ninclude \"hokuyo.inc\"\n";
        var warnings = new ArrayList<WorldFileWarning>();
        WorldSpec classic = ScenarioReader.read(write("t.world", includes + things), warnings::add)
                .world();
        String newer = includes.replace("include \"", "include \"stage4/");
        WorldSpec stage4 = ScenarioReader.read(write("t.world", newer + things), warnings::add)
                .world();

        assertThat(warnings).as("nothing overlaps the zone").isEmpty();
        assertThat(classic.robots()).hasSize(4);
        assertThat(stage4.robots()).zipSatisfy(classic.robots(), (robot, other) -> {
            assertThat(robot)
                    .usingRecursiveComparison()
                    .ignoringFields("where", "sonar", "rangers", "startOdometry", "drive", "traits.reflectance")
                    .isEqualTo(other);
            assertThat(robot.rangers().getFirst().sensors())
                    .extracting(RangeSensorSpec::mount)
                    .isEqualTo(other.sonar().mounts());
            assertThat(robot.rangers()).hasSize(3);
            assertThat(other.rangers()).hasSize(2);
        });
        assertThat(stage4.obstacles())
                .usingRecursiveFieldByFieldElementComparatorIgnoringFields("where", "traits.reflectance")
                .isEqualTo(classic.obstacles());
        assertThat(SourceText.OURS.stream().filter(each -> each.startsWith("stage4/")))
                .as("Stage 4 rejects a world with an unknown type or property")
                .allSatisfy(each -> assertThat(Files.readString(folder.resolve(each)))
                        .doesNotContainPattern("define \\w+ laser|scount|spose|sview|ssize"));
    }
}
