package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.model.Point;
import io.troupe.sim.model.WorldSpec;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** Forms that worlds for Stage have and that its documentation does not lead one to expect. */
class StageFormsTest extends WorldFiles {
    private static final String BOX = "model ( pose [ 2 0 0 0 ] size [ 1 1 1 ] block ( ";

    private List<List<Point>> outline(String world) {
        return world(world).obstacles().getFirst().shape().outlines();
    }

    // ---- macros named like entity types

    @ParameterizedTest
    @ValueSource(strings = {"block", "model", "window", "laser", "sensor", "wifi", "driver"})
    void macroNamedLikeAType_isTheMacroFromThereOn_withAWarning(String name) {
        String text = "define " + name + " model ( size [ 0.5 0.5 0.5 ] gui_nose 0 )\n" + name
                + " ( pose [ 2 0 0 0 ] color \"red\" )";
        WorldSpec world = world(text);
        assertThat(world.obstacles()).singleElement().satisfies(thing -> {
            assertThat(thing.pose().x()).isEqualTo(2);
            assertThat(Box.around(thing.shape().polygons()).width()).isEqualTo(0.5);
        });
        assertThat(warnings(text))
                .containsExactly("t.world:1:8: macro \"" + name + "\" has the name of an entity type: from here on \""
                        + name + "\" is the macro, as in Stage"
                        + (name.equals("block") ? ", also where the outline of a model is meant" : ""));
    }

    @Test
    void macroNamedLikeAType_countsInsideOfModelsToo_andOutlinesBeforeItAreOutlines() {
        WorldSpec world = world("""
                define wedge model ( block ( points 3 point[0] [0 0] point[1] [1 0] point[2] [0 1] z [0 1] ) )
                define block model ( size [ 0.5 0.5 0.5 ] )
                wedge ( size [ 1 1 1 ] block ( pose [ 0 0 0 0 ] ) )
                """);
        assertThat(world.obstacles()).hasSize(2);
        assertThat(world.obstacles().getFirst().shape().polygons().getFirst()).hasSize(3);
    }

    // ---- images of Netpbm

    private void image(String name, String header, int... bytes) {
        var out = new ByteArrayOutputStream();
        out.writeBytes(header.getBytes(StandardCharsets.US_ASCII));
        for (int each : bytes) {
            out.write(each);
        }
        try {
            Files.write(file(name), out.toByteArray());
        } catch (IOException e) {
            throw new AssertionError(e);
        }
    }

    /** Dark pixels {@code #.#} above {@code ###}: in each format below. */
    private void assertIsTheFort(String name) {
        assertThat(outline("model ( bitmap \"" + name + "\" size [ 3 2 1 ] )"))
                .singleElement()
                .satisfies(line -> assertThat(line)
                        .containsExactlyInAnyOrder(
                                new Point(-1.5, -1),
                                new Point(1.5, -1),
                                new Point(1.5, 1),
                                new Point(0.5, 1),
                                new Point(0.5, 0),
                                new Point(-0.5, 0),
                                new Point(-0.5, 1),
                                new Point(-1.5, 1)));
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            t.pbm | P1 3 2 1 0 1 1 1 1
            t.pbm | P1/# a comment/3 2/101/111
            t.pgm | P2 3 2 255 127 128 0 5 7 0
            t.pgm | P2/3 # wide/2/# brightest/15/0 15 7 0 1 2/
            t.pgm | P2 3 2 65535 32639 65535 0 0 0 0
            t.ppm | P3 3 2 255 0 255 255 255 0 0 1 1 1 0 0 0 0 0 0 0 0 0
            map   | P1 3 2 1 0 1 1 1 1
            """)
    void plainImages_areRead(String name, String text) {
        write(name, text.replace('/', '\n'));
        assertIsTheFort(name);
    }

    @Test
    void rawImages_areRead_with8And16Bits() {
        image("t.pbm", "P4\n3 2\n", 0b1010_0000, 0b1110_0000);
        assertIsTheFort("t.pbm");
        image("t.pgm", "P5\n# CREATOR: a map server\n3 2\n255\n", 0, 205, 127, 0, 0, 0);
        assertIsTheFort("t.pgm");
        image("t16.pgm", "P5 3 2 65535\n", 0x7f, 0x7f, 0x80, 0x80, 0, 255, 0, 0, 0, 0, 0, 0);
        assertIsTheFort("t16.pgm");
        image("t.ppm", "P6 3 2 255\n", 0, 9, 9, 255, 0, 0, 0, 9, 9, 0, 9, 9, 0, 9, 9, 0, 9, 9);
        assertIsTheFort("t.ppm");
        image("t16.ppm", "P6\n2 1\n1000\n", 0, 1, 2, 2, 2, 2, 3, 200, 0, 0, 0, 0);
        assertThat(outline("model ( bitmap \"t16.ppm\" size [ 2 1 1 ] )").getFirst())
                .hasSize(4);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            P2 3 2 255 1 2 3 4 5  | is cut off: expected 2 rows of 3 pixels, found 1
            P5 3 2 255 123        | is cut off: expected 2 rows of 3 pixels, found 1
            P4 30000 2 123        | is cut off: expected 2 rows of 30000 pixels, found 0
            P2 3                  | is cut off: expected the height
            P2 three 2 255        | expected the width, found "three"
            P2 0 2 255            | expected a width from 1, not 0
            P2 3 2 0              | expected a greatest value from 1 to 65535, not 0
            P2 3 2 65536          | expected a greatest value from 1 to 65535, not 65536
            P2 3 2 7 1 2 8 0 0 0  | expected values from 0 to 7, not 8, in row 1
            P2 3 2 7 1 2 x 0 0 0  | expected a value in row 1, found "x"
            P1 3 2 1 0 2 0 0 0    | expected 0 or 1 in row 1, found "2"
            P2 99999999999 2 255  | expected the width, found "99999999999"
            """)
    void damagedImage_isRefused_namingTheFileAndWhatWasExpected(String text, String problem) {
        write("t.pgm", text.strip().endsWith("123") ? text.strip() : text.strip() + "\n");
        assertThat(problem("model ( bitmap \"t.pgm\" )"))
                .isEqualTo("t.world:1:16: cannot read the image t.pgm: " + problem.strip());
    }

    @Test
    void largeImage_isReadAtLowerResolution_withAWarning() {
        int side = 4800;
        var bits = new int[side / 8 * side];
        bits[0] = 0x80; // one dark pixel in the upper left corner, and one in the lower right
        bits[bits.length - 1] = 1;
        image("large.pbm", "P4 " + side + " " + side + "\n", bits);
        String text = "model ( bitmap \"large.pbm\" size [ 24 24 1 ] )";
        assertThat(outline(text))
                .hasSize(2)
                .allSatisfy(line ->
                        assertThat(Box.around(List.of(line)).width()).isCloseTo(24.0 / (side / 2), within(1e-9)));
        assertThat(warnings(text))
                .containsExactly("t.world:1:16: bitmap large.pbm has 4800 x 4800 pixels and is read at 1/2 of its"
                        + " resolution: walls may be 1 pixel thicker");
        image("huge.pbm", "P4 30000 30000\n");
        assertThat(problem("model ( bitmap \"huge.pbm\" )"))
                .isEqualTo("t.world:1:16: bitmap huge.pbm is too large: 30000 x 30000 pixels; the limit is 400000000 in"
                        + " all");
    }

    // ---- outlines

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            points 5 point[0] [0 0] point[1] [1 0] point[2] [1 1] point[3] [0 1] point[4] [0 0] | 4 | 0 | 4
            points 5 point[0] [0 0] point[1] [1 0] point[2] [1 0] point[3] [1 1] point[4] [0 1] | 1 | 2 | 2
            """)
    void outline_closedOrWithADoubledPoint_isThatWithoutIt_withAWarning(String points, int one, int other, int at) {
        String text = BOX + points + " z [0 1] ) )";
        assertThat(outline(text))
                .isEqualTo(outline(
                        BOX + "points 4 point[0] [0 0] point[1] [1 0] point[2] [1 1] point[3] [0 1] z [0 1] ) )"));
        assertThat(warnings(text))
                .singleElement()
                .asString()
                .endsWith(": point[" + one + "] and point[" + other
                        + "] of a block are the same, and count once: an outline closes by itself");
    }

    @Test
    void outline_ofOnePoint_isStillRefused() {
        assertThat(problem(BOX + "points 3 point[0] [0 0] point[1] [0 0] point[2] [1 0] z [0 1] ) )"))
                .contains("a block needs 3 to 1000 different points, not 2");
    }

    // ---- tuples

    @Test
    void tuple_withMoreNumbersThanNeeded_isReadWithoutThem_withAWarning() {
        String text = "model ( pose [ 2 0 0 90 7 ] size [ 1 2 1 1 ] color_rgba [ 0 1 0 1 1 ] )";
        WorldSpec world = world(text);
        assertPose(world.obstacles().getFirst().pose(), 2, 0, 90);
        assertThat(world.obstacles().getFirst().colour()).isEqualTo(0x00ff00);
        assertThat(warnings(text))
                .containsExactlyInAnyOrder(
                        "t.world:1:14: \"pose\" is a tuple of 3 or 4 numbers; the others have no effect",
                        "t.world:1:34: \"size\" is a tuple of 2 or 3 numbers; the others have no effect",
                        "t.world:1:57: \"color_rgba\" is a tuple of 4 numbers; the others have no effect");
    }

    // ---- the lenient reader

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            model ( color "reddish" )              | 1 | t.world:1:15: unknown colour "reddish"; expected a colour name of X11, such as "red"; "color" is left out
            model ( fiducial_return "yes" )        | 1 | t.world:1:25: "fiducial_return" must be a whole number, not the text "yes"; it is left out
            model ( size [ 0 1 1 ] )               | 1 | t.world:1:14: "size" must be from 0.001 to 10000 m in x and y, not 0.0 m; "size" is left out
            model ( size 3 )                       | 1 | t.world:1:14: "size" must be a tuple of 2 or 3 numbers, not the number 3; it is left out
            model ( size[2] [ 1 1 ] )              | 1 | t.world:1:9: "size" takes no index; it is left out
            model ( max_speed 3 )                  | 1 | t.world:1:9: unknown property "max_speed" of model
            model ( size [1 1] block ( points 4 point[0] [0 0] point[1] [1 0] point[2] [1 1] ) ) | 1 | t.world:1:35: "points" is 4, but point[3] is missing; "points" is left out
            model ( block ( points 4 point[0] [0 0] point[1] [1 1] point[2] [1 0] point[3] [0 1] ) ) | 1 | t.world:1:9: the block's outline crosses or touches itself: the edge from point[0] meets the edge from point[2]; this block is left out
            model ( block ( points 3 point[0] [0 0] point[1] [1 0] point[2] [2 0] ) ) | 1 | t.world:1:9: the block has no area: its points lie on a line; this block is left out
            model ( bitmap "gone.png" )            | 0 | t.world:1:16: there is no file gone.png
            sensor ()                              | 0 | t.world:1:1: "sensor" cannot stand in a world file; it belongs in a ranger; it is left out
            unit_length "km"                       | 0 | t.world:1:13: "unit_length" must be "m", "cm" or "mm", not "km"; "unit_length" is left out
            define thing model ( mass "much" ) thing ( color "no" ) | 1 | t.world:1:27: "mass" must be a number, not the text "much"; it is left out
            """)
    void valueThatCannotBeUsed_isLenientlyLeftOut_withAWarning(String text, int obstacles, String warning) {
        problem(text);
        var warnings = new ArrayList<String>();
        WorldSpec world = ScenarioReader.readLeniently(write("t.world", text), into(warnings))
                .world();
        assertThat(world.obstacles()).hasSize(obstacles);
        assertThat(warnings.getFirst()).startsWith(warning);
    }

    @Test
    void lenientReader_leavesOutOnlyWhatItCannotUse() {
        Path file = write("t.world", """
                define ghost position ( size [ 0.4 0.4 0.2 ] drive "rolling" )
                ghost ( name "one" pose [ 0 0 0 0 ] ranger ( scount 2 spose[0] [ 0 0 0 ] ) )
                ghost ( name "one" pose [ 3 0 0 0 ] )
                model ( bitmap "gone.png" size [ 9 9 1 ] model ( size [ 1 1 1 ] ) )
                model ( pose [ 6 0 0 0 ] color "reddish" )
                """);
        var warnings = new ArrayList<String>();
        WorldSpec world = ScenarioReader.readLeniently(file, into(warnings)).world();
        assertThat(world.robots())
                .singleElement()
                .satisfies(robot -> assertThat(robot.pose().x()).isZero());
        assertThat(world.obstacles())
                .singleElement()
                .satisfies(thing -> assertThat(thing.pose().x()).isEqualTo(6));
        assertThat(warnings)
                .anyMatch(each -> each.endsWith("not \"rolling\"; \"drive\" is left out"))
                .anyMatch(each -> each.endsWith("is already taken at t.world:2:1; this ghost is left out")
                        || each.endsWith("is already taken at t.world:2:1; this position is left out"))
                .anyMatch(each -> each.contains("gone.png") && each.endsWith("; this model is left out"));
    }

    @Test
    void lenientReader_givesUp_whenTooMuchCannotBeUsed() {
        var text = new StringBuilder();
        for (int i = 0; i < 300; i++) {
            text.append("model ( color \"no colour ").append(i).append("\" )\n");
        }
        Path file = write("t.world", text.toString());
        assertThat(problemOf(() -> ScenarioReader.readLeniently(file, warning -> {})))
                .contains("unknown colour")
                .endsWith("; more than 200 things of this world cannot be used");
    }

    @Test
    void robotOutsideTheWalls_isLenientlyAWarning() {
        var warnings = new ArrayList<String>();
        Path file = write(
                "t.world", "model ( size [ 4 4 1 ] boundary 1 ) position ( size [ 0.4 0.4 0.2 ] pose [ 9 0 0 0 ] )");
        assertThat(ScenarioReader.readLeniently(file, into(warnings)).world().robots())
                .hasSize(1);
        assertThat(warnings).singleElement().asString().contains("stands outside the arena");
    }
}
