package io.troupe.view;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.drawing.Svg;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.RobotReading;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.view.RunResult.StateChange;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.function.IntToDoubleFunction;
import java.util.regex.MatchResult;
import java.util.regex.Pattern;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;

/** Labels and ages in the picture of a run, read from it. */
class TrajectorySvgTest {
    private static final int SECONDS = 120;
    private static final SubsumptionTable TABLE = SubsumptionTable.ofThePaper();
    private static final WorldSpec HALL =
            ScenarioReader.readText("""
            name "hall"
            model ( pose [ 0 3 0 0 ] size [ 8 0.2 0.5 ] )
            model ( pose [ 0 -3 0 0 ] size [ 8 0.2 0.5 ] )
            define robot position ( size [ 0.4 0.4 0.2 ] )
            robot ( pose [ 0 0 0 0 ] )
            robot ( pose [ 1 0 0 0 ] )
            """, Path.of("hall.world")).world();

    /** A reading in each second; the robot drives along a line and has been so far at each time. */
    private static RobotRecord robot(int index, double y, IntToDoubleFunction metres) {
        var record = new RobotRecord(index, 0);
        record.began(Service.WALL_FOLLOWER);
        for (int second = 0; second <= SECONDS; second++) {
            var odometry = new Odometry(new Pose(metres.applyAsDouble(second), y, 0), 0, 0, false);
            record.moved(second * 1_000_000L, new RobotReading(odometry.pose(), odometry, null, null, List.of(), 1));
        }
        return record;
    }

    private static String draw(List<StateChange> changes, RobotRecord... robots) {
        var messages = new RunResult.Messages(0, 0, 0);
        return Pictures.trajectory(
                HALL, new RunResult(SECONDS * 1_000_000L, TABLE, changes, List.of(robots), messages));
    }

    /** A label of the picture, as wide as its words are estimated. */
    private record Label(String words, double left, double top, double right, double bottom) {
        boolean covers(Label other) {
            return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
        }
    }

    private static List<Label> labels(String svg) {
        return Pattern.compile("<text x=\"([0-9.]+)\" y=\"([0-9.]+)\" class=\"(time|tag)\"[^>]*>([^<]*)<")
                .matcher(svg)
                .results()
                .filter(text -> !text.group().contains("stroke"))
                .map(TrajectorySvgTest::label)
                .toList();
    }

    private static Label label(MatchResult text) {
        double wide = Svg.width(text.group(4), 12);
        double left = Double.parseDouble(text.group(1)) - (text.group(3).equals("tag") ? wide / 2 : 0);
        double baseline = Double.parseDouble(text.group(2));
        return new Label(text.group(4), left, baseline - 9, left + wide, baseline);
    }

    @Test
    void labels_ofRobotsThatMeetInOnePlace_lieOnNoOther() {
        var changes = new ArrayList<>(List.of(new StateChange(0, TABLE.states().getFirst(), null)));
        for (int second : new int[] {50, 51, 60, 61, 70, 71}) {
            changes.add(new StateChange(second * 1_000_000L, TABLE.states().get(second % 2 + 1), second % 2));
        }
        List<Label> labels = labels(draw(
                changes,
                robot(0, 0, second -> Math.sin(second * Math.PI / 27)),
                robot(1, 0.05, second -> Math.sin(second * Math.PI / 27))));
        assertThat(labels).hasSizeGreaterThan(10).extracting(Label::words).contains("s2", "s3", "20 s");
        for (Label label : labels) {
            assertThat(labels).filteredOn(label::covers).containsExactly(label);
        }
    }

    @Test
    void robotThatStays_hasOneLabelForAllTheTimes() {
        var labels =
                labels(draw(List.of(), robot(0, 0, second -> Math.min(second, 40) / 10.0), robot(1, 2, s -> s / 20.0)));
        assertThat(labels)
                .extracting(Label::words)
                .containsExactly("20 s", "40-100 s", "20 s", "40 s", "60 s", "80 s", "100 s");
    }

    @Test
    void path_isPalerAndThinnerTheOlderItIs() {
        String svg = draw(List.of(), robot(0, 0, second -> second / 20.0), robot(1, 2, second -> second / 20.0));
        for (String attribute : List.of("stroke-width", "stroke-opacity")) {
            List<Double> values = Pattern.compile("<polyline [^>]*" + attribute + "=\"([0-9.]+)\"")
                    .matcher(svg)
                    .results()
                    .map(line -> Double.parseDouble(line.group(1)))
                    .toList();
            assertThat(values).as(attribute).hasSize(12).isSorted();
            assertThat(values.stream().distinct()).hasSize(6);
        }
    }

    @Test
    void crowd_hasAColourForEachRobot() {
        var colours =
                IntStream.range(0, 80).map(TrajectorySvg::colourInCrowd).boxed().toList();
        assertThat(colours).doesNotHaveDuplicates();
        for (int i = 1; i < colours.size(); i++) {
            int one = colours.get(i);
            int other = colours.get(i - 1);
            assertThat(IntStream.of(0, 8, 16)
                            .map(shift -> Math.abs((one >> shift & 255) - (other >> shift & 255)))
                            .sum())
                    .as("difference of robots " + i + " and " + (i + 1))
                    .isGreaterThan(100);
        }
    }
}
