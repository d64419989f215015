package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.model.CargoSpec;
import io.troupe.sim.model.DriveSpec;
import io.troupe.sim.model.DriveSpec.Bounds;
import io.troupe.sim.model.DriveSpec.Localization;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeNoise;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Scenario;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** Robots in the dialect of Stage 2 and 3, and in that of Stage 4. */
class DialectsTest {
    @TempDir
    private Path dir;

    private Worlds worlds;

    @BeforeEach
    void files() {
        worlds = new Worlds(dir);
    }

    private RobotSpec robot(String text) {
        return worlds.world(text).robots().getFirst();
    }

    private static void assertPose(Pose pose, double x, double y, double degrees) {
        assertThat(pose.x()).isCloseTo(x, within(1e-12));
        assertThat(pose.y()).isCloseTo(y, within(1e-12));
        assertThat(pose.headingRad()).isCloseTo(Math.toRadians(degrees), within(1e-12));
    }

    @Test
    void laser_ofTheClassicDialect_isAScanOfOneSensor() {
        RobotSpec robot = robot("""
                define sicklaser laser ( range_max 6 fov 90 samples 91 size [ 0.156 0.155 0.19 ] resolution 2 )
                position ( pose [ 1 2 0 30 ] sicklaser ( pose [ 0.1 0 0 180 ] ) laser () )
                """);

        var mount = new Pose(0.1, 0, Math.PI);
        assertThat(robot.rangers().getFirst())
                .isEqualTo(new RangerSpec(
                        RangerSpec.Kind.LASER,
                        mount,
                        0.156,
                        0.155,
                        List.of(new RangeSensorSpec(
                                mount, 0, 6, Math.toRadians(90), 91, 0.156, 0.155, RangeNoise.NONE))));
        RangeSensorSpec unset = robot.rangers().get(1).sensors().getFirst();
        assertThat(unset.samples()).isEqualTo(180);
        assertThat(unset.maxRangeM()).isEqualTo(8);
        assertThat(unset.fovRad()).isEqualTo(Math.PI);
        assertThat(robot.sonar()).isNull();
        assertThat(robot.startOdometry()).isEqualTo(Pose.ORIGIN);
        assertThat(robot.drive().velocityBounds()).isEqualTo(Bounds.NONE);
    }

    @Test
    void ranger_ofStage4_hasItsSensorsInTheRobotsFrame() {
        RobotSpec robot = robot("""
                define beam sensor ( range [ 0.1 4 ] fov 20 samples 3 noise [ 0.01 0.02 5 ] size [ 0.01 0.05 ] )
                position ( pose [ 1 2 0 30 ] ranger ( pose [ 1 0 0 90 ] size [ 0 0 0 ]
                  beam ( pose [ 0.5 0 0 -90 ] ) sensor () ) )
                """);

        RangerSpec ranger = robot.rangers().getFirst();
        assertThat(ranger.kind()).isEqualTo(RangerSpec.Kind.RANGER);
        assertThat(ranger.lengthM()).isZero();
        RangeSensorSpec beam = ranger.sensors().getFirst();
        assertPose(beam.mount(), 1, 0.5, 0);
        assertThat(beam.minRangeM()).isEqualTo(0.1);
        assertThat(beam.maxRangeM()).isEqualTo(4);
        assertThat(beam.samples()).isEqualTo(3);
        assertThat(beam.lengthM()).isEqualTo(0.01);
        assertThat(beam.widthM()).isEqualTo(0.05);
        assertThat(beam.noise()).isEqualTo(new RangeNoise(0.01, 0.02, Math.toRadians(5)));
        assertThat(ranger.sensors().get(1).maxRangeM()).isEqualTo(5);
        assertThat(ranger.sensors().get(1).samples()).isEqualTo(1);
    }

    @Test
    void stage4_isToldByWhatTheWorldUses_andReportsGlobalOdometryAndBounds() {
        String pose = "position ( pose [ 1 2 0 90 ] localization_origin [ 5 5 0 0 ] ";

        assertThat(robot("define eye ranger ( sensor () ) " + pose + ")").startOdometry())
                .as("an unused macro does not count")
                .isNotEqualTo(new Pose(1, 2, Math.toRadians(90)));
        RobotSpec newer = robot(pose + "ranger ( sensor () ) )");
        assertPose(newer.startOdometry(), 1, 2, 90);
        assertThat(newer.drive().velocityBounds()).isEqualTo(new Bounds(-1, 1, -Math.PI / 2, Math.PI / 2));

        RobotSpec bounded = robot(pose + """
                velocity_bounds [ -0.5 2 0 0 0 0 -45 180 ] acceleration_bounds [ -3 4 0 0 0 0 -10 20 ] )
                """);
        assertPose(bounded.startOdometry(), 1, 2, 90);
        assertThat(bounded.drive().velocityBounds()).isEqualTo(new Bounds(-0.5, 2, Math.toRadians(-45), Math.PI));
        assertThat(bounded.drive().accelerationBounds().mostForward()).isEqualTo(4);
    }

    @Test
    void rangerReturnOfZero_isSeenInStage4Only() {
        String things = "model ( ranger_return 0 ) model ( ranger_return -1 ) model ( ranger_return 0.5 )";

        assertThat(worlds.world(things).obstacles())
                .extracting(ObstacleSpec::blocksRangers)
                .containsExactly(false, false, true);
        assertThat(worlds.world(things + " position ( pose [ 2 0 0 0 ] ranger ( sensor () ) )")
                        .obstacles())
                .extracting(ObstacleSpec::blocksRangers)
                .containsExactly(true, false, true);
    }

    @Test
    void drive_saysHowTheRobotStartsAndWhereItBelievesToBe() {
        DriveSpec drive = robot(
                        "position ( velocity [ 0.3 0 0 20 ] localization \"odom\" odom_error [ 0.1 0.2 9e-1 0.4 ] )")
                .drive();

        assertThat(drive.startForwardMps()).isEqualTo(0.3);
        assertThat(drive.startTurnRadps()).isEqualTo(Math.toRadians(20));
        assertThat(drive.localization()).isEqualTo(new Localization.DeadReckoning(0.1, 0.2, 0.4));
        assertThat(robot("position ( localization \"odom\" )").drive().localization())
                .isEqualTo(new Localization.DeadReckoning(0.03, 0.03, 0.05));
        assertThat(robot("position ()").drive()).isEqualTo(DriveSpec.STANDARD);
    }

    @Test
    void models_onARobot_areItsCargo() {
        RobotSpec robot = robot("""
                position ( pose [ 5 5 0 0 ] size [ 0.4 0.4 ]
                  model ( pose [ 0.3 0 0 90 ] size [ 0.2 0.1 ] color "blue"
                    model ( pose [ 0.2 0 0 0 ] size [ 0.1 0.1 ] obstacle_return 0 ranger_return 0 blob_return 0
                      blobfinder ( pose [ 0 0 0 -90 ] ) ) ) )
                """);

        CargoSpec box = robot.cargo().getFirst();
        assertThat(box.colour()).isEqualTo(0x0000ff);
        Box seen = Box.around(box.shape().polygons());
        assertThat(seen.minX()).isCloseTo(0.25, within(1e-12));
        assertThat(seen.maxY()).isCloseTo(0.1, within(1e-12));
        CargoSpec ghost = robot.cargo().get(1);
        assertThat(ghost.blocksBodies() || ghost.blocksRangers() || ghost.visible())
                .isFalse();
        assertThat(Box.around(robot.collisionShape().polygons()).maxX()).isCloseTo(0.35, within(1e-12));
        assertThat(robot.blobfinder()).isNotNull();
        assertPose(robot.blobfinder().mount(), 0.3, 0.2, 0);
    }

    @Test
    void lenientReader_tellsEachThingOnceAndReadsTheRest() {
        var warnings = new ArrayList<String>();
        Path file = worlds.write("t.world", """
                define pioneer position ( paint "matt" fiducial ( range_max 8 ) size [ 0.4 0.4 ] )
                pioneer ( name "a" ) pioneer ( name "b" pose [ 2 0 0 0 ] camera () wheel[3] 7 )
                speed 3
                model ( pose [ 4 0 0 0 ] laser () )
                """);

        Scenario scenario = ScenarioReader.readLeniently(
                file,
                warning ->
                        warnings.add(warning.toString().replace(dir + "/", "").replaceFirst("; known.*", "")));

        assertThat(scenario.world().robots()).extracting(RobotSpec::name).containsExactly("a", "b");
        assertThat(scenario.world().obstacles()).hasSize(1);
        assertThat(warnings)
                .containsExactlyInAnyOrder(
                        "t.world:1:27: unknown property \"paint\" of position",
                        "t.world:1:40: \"fiducial\" is not simulated and left out; simulated are model, position, ranger,"
                                + " laser and blobfinder",
                        "t.world:2:58: \"camera\" is not simulated and left out; simulated are model, position, ranger,"
                                + " laser and blobfinder",
                        "t.world:2:68: unknown property \"wheel\" of position",
                        "t.world:3:1: unknown property \"speed\" of world file",
                        "t.world:4:26: a laser must hang on a robot (a position); on a model that stands still it is left"
                                + " out");
    }

    @Test
    void lenientReader_stillRefusesWhatMakesNoSense() {
        Path file = worlds.write("t.world", "model ( size \"big\" )");

        assertThat(worlds.problemOf(() -> ScenarioReader.readLeniently(file, warning -> {})))
                .startsWith("t.world:1:14: \"size\" must be");
    }
}
