package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;

import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.logging.Handler;
import java.util.logging.LogRecord;
import java.util.logging.Logger;
import java.util.logging.SimpleFormatter;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class WorldChecksTest {
    private static final String ARENA = "model ( name \"arena\" size [ 10 10 1 ] boundary 1 )\n";

    @TempDir
    private Path dir;

    private Worlds worlds;

    @BeforeEach
    void files() {
        worlds = new Worlds(dir);
    }

    private static String robot(String name, double x, double y, double degrees) {
        return "position ( name \"%s\" size [ 1 1 1 ] pose [ %s %s 0 %s ] )%n".formatted(name, x, y, degrees);
    }

    @Test
    void robots_overlapping_areBothNamedWithTheirPlaces() {
        assertThat(worlds.warnings(robot("a", 0, 0, 0) + robot("b", 0.9, 0.9, 0)))
                .containsExactly(
                        "t.world:2:1: robot \"b\" overlaps robot \"a\" (t.world:1:1) at the start: both stall, each until"
                                + " it is put elsewhere");
    }

    @Test
    void robots_touching_areApart() {
        assertThat(worlds.warnings(robot("a", 0, 0, 0) + robot("b", 1, 0, 0) + robot("c", 0, -1, 90)))
                .isEmpty();
    }

    @Test
    void robots_whoseBoxesMeetButNotTheirBodies_areApart() {
        // both turned by 45 degrees: corners at 0.7071 along the axes, so their bounding boxes meet at (0.75,
        // 0.75)
        double meeting = Math.sqrt(0.5);
        assertThat(worlds.warnings(robot("a", 0, 0, 45) + robot("b", meeting + 0.001, meeting + 0.001, 45)))
                .isEmpty();
        assertThat(worlds.warnings(robot("a", 0, 0, 45) + robot("b", meeting - 0.001, meeting - 0.001, 45)))
                .hasSize(1);
    }

    @Test
    void robot_insideAnObstacle_isWarnedAboutUnlessItCanBeDrivenThrough() {
        String box = "model ( name \"box\" pose [ 2 0 0 0 ] size [ 3 3 ] ";

        assertThat(worlds.warnings(robot("a", 2, 0, 0) + box + ")"))
                .containsExactly(
                        "t.world:1:1: robot \"a\" overlaps obstacle \"box\" (t.world:2:1) at the start: it stalls"
                                + " until it is put elsewhere");
        assertThat(worlds.warnings(robot("a", 2, 0, 0) + box + "obstacle_return 0 )"))
                .isEmpty();
    }

    @Test
    void robot_insideAConcaveObstacle_isFree() {
        String hook = """
                model ( size [ 4 4 ] block ( points 8 point[0] [ 0 0 ] point[1] [ 4 0 ] point[2] [ 4 4 ] point[3] [ 3 4 ]
                  point[4] [ 3 1 ] point[5] [ 1 1 ] point[6] [ 1 4 ] point[7] [ 0 4 ] ) )
                """;

        assertThat(worlds.warnings(hook + robot("a", 0, 0.6, 0))).isEmpty();
        assertThat(worlds.warnings(hook + robot("a", 0, -0.6, 0)))
                .singleElement()
                .asString()
                .contains("overlaps obstacle \"model:0\"");
    }

    @Test
    void obstacles_overlapping_areAllowed() {
        assertThat(worlds.world("model () model ()").obstacles()).hasSize(2);
    }

    @Test
    void robot_outsideTheWalls_isRefusedWithItsPlaceAndTheirs() {
        assertThat(worlds.problem(ARENA + robot("lost", 7.25, 0, 0)))
                .isEqualTo("t.world:2:1: robot \"lost\" at (7.250, 0.000) stands outside the arena, whose walls reach"
                        + " x from -5.000 to 5.000, y from -5.000 to 5.000");
        assertThat(worlds.world(ARENA + robot("home", 4.4, 0, 0)).robots()).hasSize(1);
    }

    @Test
    void robot_outsideWallsMadeOfSeparateBoxes_isRefused() {
        String walls = """
                define wall model ( color "black" )
                wall ( size [ 10 0.2 ] pose [ 0 5 0 0 ] ) wall ( size [ 10 0.2 ] pose [ 0 -5 0 0 ] )
                wall ( size [ 0.2 10.2 ] pose [ 5 0 0 0 ] ) wall ( size [ 0.2 10.2 ] pose [ -5 0 0 0 ] )
                """;

        assertThat(worlds.problem(walls + robot("lost", 0, -8, 0))).contains("stands outside the arena");
    }

    @Test
    void robot_besideThingsInTheOpen_isNotOutsideAnything() {
        String open = "model ( pose [ 3 0 0 0 ] size [ 1 1 ] ) model ( pose [ 3 5 0 0 ] size [ 1 1 ] )\n";

        assertThat(worlds.world(open + robot("free", 0, 0, 0)).robots()).hasSize(1);
    }

    @Test
    void robot_outsideWallsWithAGate_isFreeToComeIn() {
        String gated = """
                model ( size [ 10 10 ] block ( points 8 point[0] [ 0 0 ] point[1] [ 10 0 ] point[2] [ 10 10 ] point[3] [ 0 10 ]
                  point[4] [ 0 9 ] point[5] [ 9 9 ] point[6] [ 9 1 ] point[7] [ 0 1 ] ) )
                """;

        assertThat(worlds.world(gated + robot("guest", -8, 0, 0)).robots()).hasSize(1);
    }

    @Test
    void names_ofRobots_mustDifferFromAllOthers() {
        assertThat(worlds.problem(robot("a", 0, 0, 0) + robot("a", 3, 0, 0)))
                .isEqualTo("t.world:2:1: the name \"a\" is already taken at t.world:1:1");
        assertThat(worlds.problem("model ( name \"a\" )\n" + robot("a", 3, 0, 0)))
                .isEqualTo("t.world:2:1: the name \"a\" is already taken at t.world:1:1");
    }

    @Test
    void robotBeyond500Metres_andObstacleBeyond5000_areRefused() {
        assertThat(worlds.problem("model ( name \"far\" pose [ 0 -4999.6 0 0 ] size [ 1 1 ] )"))
                .isEqualTo("t.world:1:1: obstacle \"far\" lies 5000.100 m from the origin along x or y;"
                        + " the limit is 5000 m");
        assertThat(worlds.world("model ( size [ 1200 600 ] boundary 1 )").obstacles())
                .hasSize(1);
        assertThat(worlds.problem(robot("far", 900, 0, 0))).contains("robot \"far\" lies 900.500 m");
    }

    @Test
    void body_beyond150Metres_isWarnedAbout() {
        var warnings = new ArrayList<String>();
        var collector = new Handler() {
            @Override
            public void publish(LogRecord record) {
                warnings.add(record.getLevel() + " " + new SimpleFormatter().formatMessage(record));
            }

            @Override
            public void flush() {}

            @Override
            public void close() {}
        };
        Logger logger = Logger.getLogger(WorldChecks.class.getName());
        logger.addHandler(collector);
        logger.setUseParentHandlers(false);
        try {
            worlds.world(robot("near", 149, 0, 0) + robot("far", 0, 150, 0));
        } finally {
            logger.removeHandler(collector);
            logger.setUseParentHandlers(true);
        }

        assertThat(warnings)
                .isEqualTo(List.of("WARNING " + worlds.file("t.world")
                        + ":2:1: robot \"far\" lies 150.500 m from the origin; beyond 150 m motion loses accuracy"));
    }
}
