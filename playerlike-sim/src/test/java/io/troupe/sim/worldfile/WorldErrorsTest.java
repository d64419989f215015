package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;

import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** Messages for wrong world files: position, name, value, what was expected. */
class WorldErrorsTest {
    @TempDir
    private Path dir;

    private Worlds worlds;

    @BeforeEach
    void files() {
        worlds = new Worlds(dir);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "model ( siez [1 1] )           | t.world:1:9: unknown property \"siez\" of model; did you mean \"size\"?",
                "position ( Pose [1 1 0] )      | t.world:1:12: unknown property \"Pose\" of position; did you mean \"pose\"?",
                "block ( frobnicate 1 )         | t.world:1:1: \"block\" cannot stand in a world file; it belongs in a model or a position",
                "model ( block ( frobnicate 1 ) ) | t.world:1:17: unknown property \"frobnicate\" of block; known: point, points, z",
                "interval_sin 100               | t.world:1:1: unknown property \"interval_sin\" of world file; did you mean \"interval_sim\"?",
                "psition ()                     | t.world:1:1: unknown entity \"psition\"; did you mean \"position\"?",
                "define pioneer position () pionee () | t.world:1:28: unknown entity \"pionee\"; did you mean \"pioneer\"?",
                "pioneer2dx ()                  | t.world:1:1: unknown entity \"pioneer2dx\"; known: model, position, window",
                "define wall modle ()           | t.world:1:13: unknown entity \"modle\"; did you mean \"model\"?",
                "define wall model ( collor \"red\" ) | t.world:1:21: unknown property \"collor\" of model; did you mean \"color\"?",
                "driver ()                      | t.world:1:1: \"driver\" cannot stand in a world file; it belongs in a configuration file",
            })
    void name_thatIsUnknownOrMisplaced_isRefusedWithTheNearest(String text, String message) {
        assertThat(worlds.problem(text.strip())).isEqualTo(message);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "model ( size 1 )               | t.world:1:14: \"size\" must be a tuple of 2 or 3 numbers, not the number 1",
                "model ( size [1] )             | t.world:1:14: \"size\" must be a tuple of 2 or 3 numbers, not a tuple of 1 value",
                "model ( pose [1 2 \"x\"] )     | t.world:1:14: \"pose\" must be a tuple of 3 or 4 numbers, not a tuple of 3 values",
                "model ( color 7 )              | t.world:1:15: \"color\" must be a text in double quotes, not the number 7",
                "model ( mass \"heavy\" )        | t.world:1:14: \"mass\" must be a number, not the text \"heavy\"",
                "model ( gui_nose \"yes\" )      | t.world:1:18: \"gui_nose\" must be a number, 0 for no, not the text \"yes\"",
                "model ( size[0] [1 1] )        | t.world:1:9: \"size\" takes no index",
                "window ( size \"big\" )         | t.world:1:15: \"size\" must be a tuple of 2 numbers, not the text \"big\"",
                "interval_sim 0.5               | t.world:1:14: \"interval_sim\" must be a whole number, not the number 0.5",
                "interval_sim 0                 | t.world:1:14: \"interval_sim\" must be from 1 to 60000 milliseconds, not 0",
                "unit_length \"km\"             | t.world:1:13: \"unit_length\" must be \"m\", \"cm\" or \"mm\", not \"km\"",
                "unit_angle \"grad\"            | t.world:1:12: \"unit_angle\" must be \"degrees\" or \"radians\", not \"grad\"",
                "model ( size [1 0 1] )         | t.world:1:14: \"size\" must be from 0.001 to 10000 m in x and y, not 0.0 m",
                "model ( size [-1 1] )          | t.world:1:14: \"size\" must be from 0.001 to 10000 m in x and y, not -1.0 m",
                "model ( pose [1e9 0 0] )       | t.world:1:14: a length of 1.0E9 m is beyond anything a world can hold",
                "position ( mass 0 )            | t.world:1:17: \"mass\" must be above 0 kg, not 0.0",
            })
    void value_ofTheWrongKindOrSize_isRefused(String text, String message) {
        assertThat(worlds.problem(text.strip())).isEqualTo(message);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "position ( drive \"dif\" )     | t.world:1:18: \"drive\" must be \"diff\", not \"dif\"",
                "position ( localization \"map\" ) | t.world:1:25: \"localization\" must be \"gps\" or \"odom\", not \"map\"",
                "position ( localization \"odom\" odom_error [-1 0 0 0] ) | t.world:1:43: \"odom_error\" must be shares from 0 to 2 of a motion, not -1.0",
                "position ( velocity_bounds [1 2 -1 1 -1 1 -90 90] ) | t.world:1:28: \"velocity_bounds\" needs least <= 0 <= greatest along x and for turning, not 1.0 to 2.0 and -1.5707963267948966 to 1.5707963267948966 rad",
                "position ( obstacle_return 0 model () ) | t.world:1:30: a robot with \"obstacle_return\" 0 cannot carry a model that others bump into; give the model \"obstacle_return\" 0 too",
                "sensor ()                      | t.world:1:1: \"sensor\" cannot stand in a world file; it belongs in a ranger",
            })
    void feature_thatWouldChangeWhatHappens_isRefused(String text, String message) {
        assertThat(worlds.problem(text.strip())).isEqualTo(message);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "ranger ( scount 0 )            | t.world:1:28: \"scount\" must be from 1 to 1000, not 0",
                "ranger ( scount 2 spose[0] [0 0 0] ) | t.world:1:28: \"scount\" is 2, but spose[1] is missing",
                "ranger ( scount 1 spose[0] [0 0 0] spose[1] [0 0 0] ) | t.world:1:28: \"scount\" is 1, but 2 sposes are given",
                "ranger ( scount 1 spose [0 0 0] ) | t.world:1:30: \"spose\" needs an index: spose[0], spose[1], ..",
                "ranger ( scount 1 spose[0] [0 0] ) | t.world:1:39: \"spose[0]\" must be a tuple of 3 numbers, not a tuple of 2 values",
                "ranger ( scount 1 spose[0] [0 0 0] sview [5 1 15] ) | t.world:1:53: \"sview\" [min max fov] needs 0 <= min < max <= 1000 m, not 5.0 and 1.0",
                "ranger ( scount 1 spose[0] [0 0 0] sview [0 5 0] ) | t.world:1:53: the field of view must be above 0 and at most a full circle, not 0.0",
                "blobfinder ( image [80 0] )    | t.world:1:31: \"image\" must be two whole numbers from 1 to 10000, not 0.0",
                "blobfinder ( range 0 )         | t.world:1:31: \"range\" must be above 0 and at most 1000 m, not 0.0",
                "blobfinder ( fov 361 )         | t.world:1:29: the field of view must be above 0 and at most a full circle, not 361.0",
                "blobfinder ( colors_count 2 colors [\"red\"] ) | t.world:1:38: \"colors_count\" is 2, but \"colors\" has 1",
                "blobfinder ( colors [\"red\"] ) | t.world:1:32: \"colors_count\" is 0, but \"colors\" has 1",
                "blobfinder ( colors_count 1 colors [\"rad\"] ) | t.world:1:48: unknown colour \"rad\"; did you mean \"red\"?",
                "blobfinder ( colors_count 1 colors [1] ) | t.world:1:47: \"colors\" must be a tuple of texts [ \"..\" .. ], not a tuple of 1 value",
                "laser ( samples 0 )            | t.world:1:28: \"samples\" must be from 1 to 10000, not 0",
                "laser ( range_max 0 )          | t.world:1:30: the range needs 0 <= least < greatest <= 1000 m, not 0.0 to 0.0",
                "laser ( fov -1 )               | t.world:1:24: \"fov\" must be from 0 to a full circle, not -1.0",
                "laser ( resolution 0 )         | t.world:1:31: \"resolution\" must be 1 or more samples, not 0",
                "laser ( size [-1 1] )          | t.world:1:25: \"size\" of a laser must not be negative",
                "ranger ( sensor ( range [5 1] ) ) | t.world:1:36: the range needs 0 <= least < greatest <= 1000 m, not 5.0 to 1.0",
                "ranger ( sensor ( noise [0 -1 0] ) ) | t.world:1:36: \"noise\" [constant proportional angular] must not be negative, not -1.0",
                "ranger ( sensor ( samples 20000 ) ) | t.world:1:38: \"samples\" must be from 1 to 10000, not 20000",
            })
    void sensor_thatDoesNotAddUp_isRefused(String sensor, String message) {
        assertThat(worlds.problem("position ( " + sensor.strip() + " )")).isEqualTo(message);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "points 2 point[0] [0 0] point[1] [1 1] | t.world:1:24: a block needs 3 to 1000 points, not 2",
                "z [0 1]                        | t.world:1:9: a block needs 3 to 1000 points, not 0",
                "points 4 point[0] [0 0] point[1] [1 0] point[2] [1 1] | t.world:1:24: \"points\" is 4, but point[3] is missing",
                "points 3 point[0] [0 0] point[1] [1 0] point[2] [1 1] point[3] [0 1] | t.world:1:24: \"points\" is 3, but 4 points are given",
                "points 3 point[0] [0 0] point[1] [1 0] point[3] [1 1] | t.world:1:24: \"points\" is 3, but point[2] is missing",
                "points 4 point[0] [0 0] point[1] [1 0] point[2] [1 1] point[3] [0 0] | t.world:1:80: point[3] and point[0] are the same; a block's outline closes by itself",
                "points 3 point[0] [0 0] point[1] [1 0] point[2] [2 0] | t.world:1:9: the block has no area: its points lie on a line",
                "points 4 point[0] [0 0] point[1] [1 1] point[2] [1 0] point[3] [0 1] | t.world:1:9: the block's outline crosses or touches itself: the edge from point[0] meets the edge from point[2]",
                "points 4 point[0] [0 0] point[1] [2 0] point[2] [1 0] point[3] [1 1] | t.world:1:9: the block's outline crosses or touches itself: the edge from point[0] meets the edge from point[1]",
                "points 3 point[0] [0 0] point[1] [1 0] point[2] [1e7 1] | t.world:1:65: a block's coordinates must be within +-1000000",
                "points 4 point[0] [0 0] point[1] [1e6 1e6] point[2] [0 1e-9] point[3] [-0.0001 0] | t.world:1:9: the block is too thin: scaled to \"size\" it is narrower than a micrometre",
            })
    void block_thatIsNoSimplePolygon_isRefused(String block, String message) {
        assertThat(worlds.problem("model ( block ( " + block.strip() + " ) )")).isEqualTo(message);
    }

    @Test
    void error_inAnIncludedFile_namesThatFile() {
        worlds.write("parts.inc", "\ndefine wall model\n(\n  size [ 1 1 ]\n  colour \"red\"\n)");

        assertThat(worlds.problem("include \"parts.inc\" wall ()"))
                .isEqualTo("parts.inc:5:3: unknown property \"colour\" of model; did you mean \"color\"?");
    }

    @Test
    void wordsOfAnyLength_areNotQuotedWhole() {
        String word = "x".repeat(5_000_000);
        var longest = new ArrayList<Integer>();
        for (String text : List.of(
                "model ( " + word + " 1 )",
                word + " ()",
                "model ( color \"" + word + "\" )",
                "model ( size " + word + " )",
                "model ( mass 1" + word + " )",
                "model ( bitmap \"" + word + "\" )",
                "position ( name \"" + word + "\" ) position ( name \"" + word + "\" pose [ 3 0 0 0 ] )")) {
            longest.add(worlds.problem(text).length());
        }
        assertThat(longest).allSatisfy(length -> assertThat(length).isBetween(1_000, 3_000));
        assertThat(worlds.problem("model ( " + word + " 1 )"))
                .startsWith("t.world:1:9: unknown property \"xxx")
                .contains("x .. (4")
                .contains(" characters are left out here) .. ")
                .contains("; known: alwayson, ");
    }

    @Test
    void warnings_areNotLongerEither() {
        Path file = worlds.write("t.world", "model ( " + "x".repeat(100_000) + " 1 )");
        var warnings = new ArrayList<String>();
        ScenarioReader.readLeniently(file, warning -> warnings.add(warning.toString()));
        assertThat(warnings).singleElement().satisfies(text -> assertThat(text).hasSizeBetween(1_000, 3_000));
    }
}
