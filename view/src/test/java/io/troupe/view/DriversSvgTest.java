package io.troupe.view;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.RobotReading;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.model.Pose;
import io.troupe.view.DriverFault.Gap;
import io.troupe.view.RunResult.StateChange;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.regex.Pattern;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** Who drove when: the drawing, and the time without a driver after a fault. */
class DriversSvgTest {
    private static final RobotReading HERE =
            new RobotReading(new Pose(1, 1, 0), new Odometry(new Pose(1, 1, 0), 0, 0, false), null, null, List.of(), 1);

    @TempDir
    private Path folder;

    private final SubsumptionTable table = SubsumptionTable.ofThePaper();
    private final RobotRecord follower = new RobotRecord(0, 0);
    private final RobotRecord wanderer = new RobotRecord(1, 0);

    private static void drive(RobotRecord robot, long fromMicros, String node, Service service) {
        robot.lostDriver();
        robot.drivenBy(fromMicros, node);
        robot.began(service);
        robot.moved(fromMicros, HERE);
    }

    private static void lose(RobotRecord robot, long micros) {
        robot.lostDriver();
        robot.drivenBy(micros, null);
        robot.moved(micros, HERE);
    }

    private RunResult result() {
        var states = List.of(
                new StateChange(0, table.states().get(0), null),
                new StateChange(4_000_000, table.states().get(1), 0));
        return new RunResult(10_000_000, table, states, List.of(follower, wanderer), new RunResult.Messages(0, 0, 0));
    }

    private void failover() {
        drive(follower, 0, "a", Service.WALL_FOLLOWER);
        drive(wanderer, 0, "b", Service.SPACE_WANDERER);
        lose(follower, 6_500_000); // noticed late
        drive(follower, 7_200_000, "c", Service.WALL_FOLLOWER);
    }

    @Test
    void gap_isFromTheFault_toTheNextDriver_ofTheRobotsThatItsNodeDrove() {
        failover();
        assertThat(new DriverFault(5_000_000, "a", "killed").gaps(result()))
                .containsExactly(new Gap(0, 7_200_000, "c"));
        assertThat(new DriverFault(6_500_000, "a", "killed").gaps(result()))
                .as("noticed in the same tick")
                .containsExactly(new Gap(0, 7_200_000, "c"));
        assertThat(new DriverFault(5_000_000, "c", "killed").gaps(result())).isEmpty();
        assertThat(new DriverFault(8_000_000, "c", "killed").gaps(result()))
                .containsExactly(new Gap(0, 10_000_000, null));
    }

    @Test
    void sample_drawsWhoDroveWhen() throws IOException {
        failover();
        var result = result();
        var fault = new DriverFault(30_000_000, "host-a", "killed");
        Files.writeString(folder.resolve("drivers.svg"), Pictures.drivers(result, fault));
        assertThat(Files.readString(folder.resolve("drivers.svg"))).contains("host-a was killed");
    }

    @Test
    void drawing_hasTheNodesAndServicesOfEachRobot_andTheGapWithItsLength() throws IOException {
        failover();
        RunResult result = result();
        var fault = new DriverFault(5_000_000, "a", "killed");
        Files.writeString(folder.resolve("drivers.svg"), Pictures.drivers(result, fault));
        String svg = Files.readString(folder.resolve("drivers.svg"));
        assertThat(svg)
                .startsWith("<svg ")
                .contains("<title>Which node drove which robot; a was killed at 5.0 s</title>")
                .contains("<title>a from 0.0 s to 5.0 s</title>", "<title>c from 7.2 s to 10.0 s</title>")
                .contains("<title>b from 0.0 s to 10.0 s</title>")
                .contains("<title>wallFollower from 0.0 s to 5.0 s</title>")
                .contains("<title>wallFollower from 7.2 s to 10.0 s</title>")
                .contains(">no driver for 2.2 s, then c</text>", ">a killed</text>")
                .contains(">robot 1</text>", ">robot 2</text>", ">node a</text>", ">service spaceWanderer</text>");
        assertThat(svg.lastIndexOf("stroke-dasharray"))
                .as("words and what hides the line of the fault behind them are above it")
                .isLessThan(svg.indexOf("class=\"blank\""));
        var gap = Pattern.compile("class=\"gap\" x=\"([0-9.]+)\" y=\"[0-9.]+\" width=\"([0-9.]+)\"")
                .matcher(svg);
        assertThat(gap.find()).isTrue();
        assertThat(Double.parseDouble(gap.group(1))).isEqualTo(14 + 0.5 * 492);
        assertThat(Double.parseDouble(gap.group(2))).isEqualTo(Math.round(22 * 492) / 100.0);
        assertThat(gap.find()).isFalse();
    }

    @Test
    void longNames_loseTheirMiddle_andAreWholeInTooltips() {
        String lost = "the-node-in-the-warehouse-of-the-eastern-branch-number-1";
        String next = lost.replace("-1", "-2");
        drive(follower, 0, lost, Service.WALL_FOLLOWER);
        drive(wanderer, 0, next, Service.SPACE_WANDERER);
        lose(follower, 6_500_000);
        drive(follower, 7_200_000, next, Service.WALL_FOLLOWER);
        String svg = Pictures.drivers(result(), new DriverFault(5_000_000, lost, "killed"));
        MapBoundsTest.assertWordsAreOnThePage(svg);
        assertThat(svg)
                .contains(">node the-node-in\u2026ch-number-1</text>", ">the-node-in\u2026ch-number-1 killed</text>")
                .contains("<g><title>" + lost + "</title>", "<g><title>" + next + "</title>")
                .contains(">no driver for 2.2 s, then the-node-in\u2026ch-number-2</text>");
    }

    @Test
    void runWithoutAFault_orWithoutAnyDriver_isDrawnToo() {
        assertThat(Pictures.drivers(result(), null)).contains("<title>Which node drove which robot</title>");
        failover();
        assertThat(Pictures.drivers(result(), null))
                .doesNotContain("class=\"gap\"")
                .contains(">node a</text>");
        assertThat(Pictures.drivers(result(), new DriverFault(8_000_000, "c", "killed")))
                .contains(">no driver any more</text>");
    }
}
