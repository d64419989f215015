package io.troupe.sim.device;

import static io.troupe.sim.Specs.robot;
import static io.troupe.sim.Specs.sonars;
import static io.troupe.sim.Specs.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.Specs;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import java.util.List;
import org.assertj.core.data.Offset;
import org.junit.jupiter.api.Test;

class SonarTest {
    private static final double DEGREE = StrictMath.PI / 180;
    private static final Offset<Double> EXACT = within(1e-9);

    private static List<Double> read(SonarSpec sonar, Pose at, ObstacleSpec... obstacles) {
        return read(sonar, Specs.world(robot("r1", at), obstacles));
    }

    /** Readings of robot 0 with these sonars. */
    private static List<Double> read(SonarSpec sonar, WorldSpec world) {
        return new Sonar(sonar).read(new Scene(world), 0);
    }

    @Test
    void ray_toAWall_measuresTheDistanceOverTheCosine() {
        List<Double> ranges = read(sonars(0, 10, -30, 60, 89), Pose.ORIGIN, wall("wall", 2.5, 0, 1, 8));

        assertThat(ranges.get(0)).isCloseTo(2, EXACT);
        assertThat(ranges.get(1)).isCloseTo(2 / StrictMath.cos(10 * DEGREE), EXACT);
        assertThat(ranges.get(2)).isCloseTo(2 / StrictMath.cos(30 * DEGREE), EXACT);
        assertThat(ranges.get(3)).isCloseTo(4, EXACT);
        assertThat(ranges.get(4)).as("passes the end of the wall").isEqualTo(5);
    }

    @Test
    void ring_onATurnedRobot_measuresFromItsMounts() {
        // the robot stands at (1, 1) and faces north; the wall's face is y = 3
        List<Double> ranges = read(Specs.pioneerFront(), new Pose(1, 1, 90 * DEGREE), wall("north", 1, 4, 12, 2));

        assertThat(ranges.get(3)).isCloseTo((2 - 0.170) / StrictMath.cos(10 * DEGREE), EXACT);
        assertThat(ranges.get(2)).isCloseTo((2 - 0.150) / StrictMath.cos(30 * DEGREE), EXACT);
        assertThat(ranges.get(6)).isCloseTo((2 - 0.115) / StrictMath.cos(50 * DEGREE), EXACT);
        assertThat(ranges.get(0)).as("looks west along the wall").isEqualTo(5);
    }

    @Test
    void left_isPositive() {
        List<Double> ranges = read(sonars(90, -90), Pose.ORIGIN, wall("left", 0, 2, 1, 2), wall("right", 0, -4, 1, 2));

        assertThat(ranges).containsExactly(1.0, 3.0);
    }

    @Test
    void range_isClampedToTheSonarsLimits() {
        SonarSpec sonar = new SonarSpec(List.of(Pose.ORIGIN, new Pose(0, 0, StrictMath.PI)), 0.5, 3, 0.2);

        assertThat(read(sonar, Pose.ORIGIN, wall("near", 0.8, 0, 1, 1), wall("far", -4, 0, 1, 1)))
                .containsExactly(0.5, 3.0);
    }

    @Test
    void nothingInReach_readsTheGreatestRange() {
        assertThat(read(sonars(0, 45, 180), Pose.ORIGIN)).containsExactly(5.0, 5.0, 5.0);
        assertThat(read(sonars(0), Pose.ORIGIN, wall("beyond", 6, 0, 1.9, 1))).containsExactly(5.0);
    }

    @Test
    void robot_seesAnother_butNotItself() {
        WorldSpec world =
                Specs.world(List.of(robot("r1", Pose.ORIGIN), robot("r2", new Pose(2, 0, StrictMath.PI / 2))));

        // the other one's right side is half its width from its centre of rotation
        assertThat(read(sonars(0, 180), world).get(0)).isCloseTo(2 - 0.19, EXACT);
        assertThat(read(sonars(0, 180), world).get(1)).isEqualTo(5);
    }

    @Test
    void movedRobot_isSeenWhereItIs_evenBeyondTheGrid() {
        WorldSpec world = Specs.world(List.of(robot("r1", Pose.ORIGIN), robot("r2", new Pose(2, 0, 0))));
        var scene = new Scene(world);
        var sonar = new Sonar(new SonarSpec(List.of(Pose.ORIGIN), 0, 200, 0.2));

        scene.place(1, new Pose(100, 0, 0));
        scene.refresh();
        assertThat(sonar.read(scene, 0).getFirst()).isCloseTo(100 - 0.26, EXACT);

        scene.place(0, new Pose(180, 0, StrictMath.PI));
        scene.refresh();
        assertThat(sonar.read(scene, 0).getFirst()).isCloseTo(80 - 0.18, EXACT);
    }

    @Test
    void thingThatDoesNotBlockRangers_isTransparent() {
        ObstacleSpec glass = new ObstacleSpec(
                "glass", new Pose(1, 0, 0), Specs.box(0.1, 1, 0), Specs.RED, true, false, true, Specs.at(1));
        RobotSpec plain = robot("ghost", new Pose(2, 0, 0));
        RobotSpec ghost = new RobotSpec(
                plain.name(),
                plain.pose(),
                plain.shape(),
                plain.colour(),
                plain.lengthM(),
                plain.widthM(),
                plain.massKg(),
                plain.origin(),
                plain.startOdometry(),
                null,
                null,
                List.of(),
                false,
                true,
                plain.where());
        WorldSpec world = Specs.world(List.of(robot("r1", Pose.ORIGIN), ghost), glass, wall("wall", 4, 0, 1, 1));

        assertThat(read(sonars(0), world)).containsExactly(3.5);
    }

    @Test
    void rayAlongACornerAndAlongACellBorder_findsTheWall() {
        // faces and rays on whole metres, where the cells of the grid meet; two boxes share the corner (3, 0)
        assertThat(read(sonars(0), Pose.ORIGIN, wall("above", 3.5, 0.5, 1, 1), wall("below", 3.5, -0.5, 1, 1)))
                .containsExactly(3.0);
        assertThat(read(sonars(45), new Pose(-1, -1, 0), wall("box", 1, 1, 2, 2))
                        .getFirst())
                .isCloseTo(StrictMath.sqrt(2), EXACT);
    }

    @Test
    void limitsThatMakeNoSense_areRefused() {
        assertThatThrownBy(() -> new Sonar(new SonarSpec(List.of(), 2, 1, 0.1)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("sonar range is [2.0 1.0]");
    }
}
