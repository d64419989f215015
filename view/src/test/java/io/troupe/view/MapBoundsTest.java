package io.troupe.view;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.drawing.Svg;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.RobotReading;
import io.troupe.sim.Snapshot;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.regex.MatchResult;
import java.util.regex.Pattern;
import org.junit.jupiter.api.Test;

/** Everything that a picture shows is on its page. */
class MapBoundsTest {
    private static final WorldSpec OPEN =
            ScenarioReader.readText("""
            name "open"
            model ( name "box" color "red" pose [ 0 1 0 0 ] size [ 1 1 0.5 ] )
            define robot position ( size [ 0.4 0.4 0.2 ] )
            robot ( name "a" pose [ 0 0 0 0 ] )
            robot ( name "b" pose [ 1 0 0 0 ] )
            """, Path.of("open.world")).world();

    private static RobotRecord path(int robot, Pose... poses) {
        var record = new RobotRecord(robot, 0);
        record.began(Service.WALL_FOLLOWER);
        for (int i = 0; i < poses.length; i++) {
            var odometry = new Odometry(poses[i], 0, 0, false);
            record.moved(i * 100_000L, new RobotReading(poses[i], odometry, null, null, List.of(), 1));
        }
        return record;
    }

    @Test
    void trajectory_inAWorldWithoutWalls_hasTheWholeRun() {
        var robots = List.of(
                path(0, new Pose(0, 0, 0), new Pose(-30, 2, 1), new Pose(0, 1, 2)),
                path(1, new Pose(1, 0, 0), new Pose(12, -9, 0)));
        var result = new RunResult(
                200_000, SubsumptionTable.ofThePaper(), List.of(), robots, new RunResult.Messages(0, 0, 0));
        String svg = Pictures.trajectory(OPEN, result);
        double[] page = page(svg);
        assertThat(Pattern.compile("<polyline points=\"([^\"]*)\"").matcher(svg).results())
                .as("from each place to the next one, which are of different ages")
                .hasSize(3)
                .allSatisfy(line -> assertOnPage(line, page));
    }

    @Test
    void world_inWhichAnObstacleWasPutElsewhere_hasIt() {
        try (var world = World.create(OPEN, WorldSettings.defaults())) {
            world.placeObstacle(0, new Pose(25, 14, 0));
            Snapshot now = world.advance();
            String svg = Pictures.world(OPEN, now);
            double[] page = page(svg);
            assertThat(Pattern.compile("<path d=\"([^\"]*)\"").matcher(svg).results())
                    .hasSizeGreaterThan(2)
                    .allSatisfy(line -> assertOnPage(line, page));
        }
    }

    @Test
    void names_ofAnyLength_areOnThePage() {
        String name = "a world whose name has many words, ".repeat(4) + "and_one_that_is_longer_than_a_line".repeat(9);
        var world = new WorldSpec(name, Path.of("t"), 100, OPEN.robots(), OPEN.obstacles());
        var table = SubsumptionTable.ofThePaper();
        var robots = List.of(path(0, new Pose(0, 0, 0)), path(1, new Pose(1, 0, 0)));
        var states = List.of(new RunResult.StateChange(0, table.states().getFirst(), null));
        var result = new RunResult(200_000, table, states, robots, new RunResult.Messages(0, 0, 0));
        var modes = new ModeComparison(Map.of(Mode.PROMISE, result, Mode.SYNC, result));
        assertWordsAreOnThePage(Pictures.trajectory(world, result));
        assertWordsAreOnThePage(Pictures.modes(modes, modes.finding() + " (" + name + ", seed 1)"));
    }

    static void assertWordsAreOnThePage(String svg) {
        double wide = page(svg)[0];
        double font = attribute(svg, "font-size", Double.NaN);
        assertThat(Pattern.compile("<text ([^>]*)>([^<]*)</text>").matcher(svg).results())
                .isNotEmpty()
                .allSatisfy(text -> {
                    String attributes = text.group(1);
                    double part = attributes.contains("\"end\"") ? 1 : attributes.contains("\"middle\"") ? 0.5 : 0;
                    double words = Svg.width(text.group(2), attribute(attributes, "font-size", font));
                    double left = attribute(attributes, "x", Double.NaN) - part * words;
                    assertThat(left).as(text.group()).isNotNegative();
                    assertThat(left + words).as(text.group()).isLessThanOrEqualTo(wide);
                });
    }

    private static double attribute(String element, String name, double otherwise) {
        var found = Pattern.compile("\\b" + name + "=\"([-0-9.]+)\"").matcher(element);
        return found.find() ? Double.parseDouble(found.group(1)) : otherwise;
    }

    private static double[] page(String svg) {
        MatchResult box = Pattern.compile("viewBox=\"0 0 ([0-9.]+) ([0-9.]+)\"")
                .matcher(svg)
                .results()
                .findFirst()
                .orElseThrow();
        return new double[] {Double.parseDouble(box.group(1)), Double.parseDouble(box.group(2))};
    }

    private static void assertOnPage(MatchResult line, double[] page) {
        List<Double> numbers = Pattern.compile("-?[0-9.]+")
                .matcher(line.group(1))
                .results()
                .map(number -> Double.parseDouble(number.group()))
                .toList();
        for (int i = 0; i < numbers.size(); i++) {
            assertThat(numbers.get(i)).as(line.group()).isBetween(0.0, page[i % 2]);
        }
    }
}
