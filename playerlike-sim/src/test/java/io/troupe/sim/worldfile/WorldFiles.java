package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.catchThrowableOfType;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.WorldSpec;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;
import org.assertj.core.api.ThrowableAssert.ThrowingCallable;
import org.assertj.core.data.Offset;
import org.junit.jupiter.api.io.TempDir;

/** Tests with world files, in a temporary directory. */
abstract class WorldFiles {
    /** A Pioneer 2DX with its 16 sonars, in the classic dialect. */
    static final String PIONEER = """
            # the ring of sixteen sonars
            define pioneer2dx_sonar ranger
            (
              scount 16
              spose[0] [ 0.075 0.130 90 ]    spose[1] [ 0.115 0.115 50 ]
              spose[2] [ 0.150 0.080 30 ]    spose[3] [ 0.170 0.025 10 ]
              spose[4] [ 0.170 -0.025 -10 ]  spose[5] [ 0.150 -0.080 -30 ]
              spose[6] [ 0.115 -0.115 -50 ]  spose[7] [ 0.075 -0.130 -90 ]
              spose[8] [ -0.155 -0.130 -90 ] spose[9] [ -0.195 -0.115 -130 ]
              spose[10] [ -0.230 -0.080 -150 ] spose[11] [ -0.250 -0.025 -170 ]
              spose[12] [ -0.250 0.025 170 ] spose[13] [ -0.230 0.080 150 ]
              spose[14] [ -0.195 0.115 130 ] spose[15] [ -0.155 0.130 90 ]
              sview [ 0 5.0 15 ]
              ssize [ 0.01 0.05 ]
            )
            define pioneer2dx position
            (
              size [ 0.44 0.33 0.22 ]
              origin [ -0.04 0 0 0 ]
              gui_nose 1
              drive "diff"
              mass 23.0
              localization "gps"
              block
              (
                points 8
                point[0] [ -0.2 0.12 ]   point[1] [ -0.2 -0.12 ]
                point[2] [ -0.12 -0.2555 ] point[3] [ 0.12 -0.2555 ]
                point[4] [ 0.2 -0.12 ]   point[5] [ 0.2 0.12 ]
                point[6] [ 0.12 0.2555 ] point[7] [ -0.12 0.2555 ]
                z [ 0 1 ]
              )
              pioneer2dx_sonar()
            )
            """;

    /** A walled arena with two robots, as in the paper's demonstration. */
    static final String ARENA = """
            include "pioneer.inc"
            name "arena"
            interval_sim 100
            resolution 0.02
            window ( size [ 700 700 ] scale 40 center [ 0 0 ] rotate [ 0 0 ] show_data 1 )
            define wall model ( color "black" gui_move 0 gui_nose 0 )
            define box model ( size [ 0.5 0.5 0.5 ] obstacle_return 1 )
            wall ( name "outer" boundary 1 size [ 16 16 1 ] )
            wall ( name "inner" size [ 0.2 6 1 ] pose [ 0 5 0 0 ] )
            box ( name "red" pose [ 4 4 0 0 ] color "red" )
            box ( name "blue" pose [ -6 -6 0 45 ] color_rgba [ 0 0 1 1 ] )
            pioneer2dx
            (
              name "r0" pose [ -4 0 0 90 ] color "orange"
              blobfinder ( colors_count 3 colors [ "red" "green" "blue" ] image [ 80 60 ] range 8 fov 60 )
            )
            pioneer2dx ( name "r1" pose [ 4 0 0 0 ] color "black" blobfinder ( pose [ 0.1 0 0 0 ] pan 30 ) )
            """;

    static final String CONFIG = """
            driver ( name "stage" provides [ "simulation:0" ] plugin "stageplugin" worldfile "arena.world" usegui 0 )
            driver ( name "stage" provides [ "position2d:0" "sonar:0" "blobfinder:0" ] model "r0" )
            driver ( name "stage" provides [ "6666:position2d:0" "odometry:::sonar:1" "::6667:blobfinder:2" ] model "r1" )
            """;

    static final Offset<Double> EXACT = within(1e-12);

    @TempDir
    Path dir;

    Path file(String name) {
        return dir.resolve(name);
    }

    Path write(String name, String text) {
        try {
            return Files.writeString(file(name), text);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    WorldSpec world(String text) {
        return ScenarioReader.readWorld(write("t.world", text));
    }

    ObstacleSpec obstacle(String text) {
        return world(text).obstacles().getFirst();
    }

    RobotSpec robot(String text) {
        return world(text).robots().getFirst();
    }

    Scenario config(String text) {
        return ScenarioReader.readConfig(write("t.cfg", text));
    }

    /** The error message for a world file {@code t.world}, without the directory. */
    String problem(String text) {
        Path file = write("t.world", text);
        return problemOf(() -> ScenarioReader.readWorld(file));
    }

    /** The error message for a file {@code t.cfg}, without the directory. */
    String configProblem(String text) {
        Path file = write("t.cfg", text);
        return problemOf(() -> ScenarioReader.readConfig(file));
    }

    String problemOf(ThrowingCallable reading) {
        var problem = catchThrowableOfType(WorldFileException.class, reading);
        assertThat(problem).as("the file was read without complaint").isNotNull();
        return withoutDirectory(String.valueOf(problem.getMessage()));
    }

    /** The warnings of the strict reader for a world file {@code t.world}, without the directory. */
    List<String> warnings(String text) {
        return warningsOf(write("t.world", text));
    }

    List<String> warningsOf(Path file) {
        var warnings = new ArrayList<String>();
        ScenarioReader.read(file, into(warnings));
        return warnings;
    }

    /** The warnings of the lenient reader for a world file {@code t.world}, without the directory. */
    List<String> lenientWarnings(String text) {
        var warnings = new ArrayList<String>();
        ScenarioReader.readLeniently(write("t.world", text), into(warnings));
        return warnings;
    }

    Consumer<WorldFileWarning> into(List<String> warnings) {
        return warning -> warnings.add(withoutDirectory(warning.toString()));
    }

    private String withoutDirectory(String message) {
        return message.replace(dir + "/", "");
    }

    static void assertPose(Pose pose, double x, double y, double degrees) {
        assertThat(pose.x()).isCloseTo(x, EXACT);
        assertThat(pose.y()).isCloseTo(y, EXACT);
        assertThat(pose.headingRad()).isCloseTo(Math.toRadians(degrees), EXACT);
    }
}
