package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import java.nio.file.Path;
import java.util.List;
import org.assertj.core.data.Offset;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class WorldReaderTest {
    private static final Offset<Double> EXACT = within(1e-12);

    @TempDir
    private Path dir;

    private Worlds worlds;

    @BeforeEach
    void files() {
        worlds = new Worlds(dir);
        worlds.write("pioneer.inc", Worlds.PIONEER);
    }

    private ObstacleSpec obstacle(String text) {
        return worlds.world(text).obstacles().getLast();
    }

    private static void assertPose(Pose pose, double x, double y, double degrees) {
        assertThat(pose.x()).isCloseTo(x, EXACT);
        assertThat(pose.y()).isCloseTo(y, EXACT);
        assertThat(pose.headingRad()).isCloseTo(Math.toRadians(degrees), EXACT);
    }

    private static void assertOutline(List<Point> outline, double... coordinates) {
        assertThat(outline).hasSize(coordinates.length / 2);
        for (int i = 0; i < outline.size(); i++) {
            assertThat(outline.get(i).x()).as("x of %d of %s", i, outline).isCloseTo(coordinates[2 * i], EXACT);
            assertThat(outline.get(i).y()).as("y of %d of %s", i, outline).isCloseTo(coordinates[2 * i + 1], EXACT);
        }
    }

    @Test
    void arena_asInTheMainJob_isReadWhole() {
        WorldSpec world = worlds.world(Worlds.ARENA);

        assertThat(world.name()).isEqualTo("arena");
        assertThat(world.file()).isEqualTo(worlds.file("t.world"));
        assertThat(world.intervalMillis()).isEqualTo(100);
        assertThat(world.robots()).extracting(RobotSpec::name).containsExactly("r0", "r1");
        assertThat(world.robots()).extracting(RobotSpec::colour).containsExactly(0xffa500, 0);
        assertThat(world.obstacles()).extracting(ObstacleSpec::name).containsExactly("outer", "inner", "red", "blue");
        assertThat(world.obstacles()).extracting(ObstacleSpec::colour).containsExactly(0, 0, 0xff0000, 0x0000ff);
        assertThat(world.obstacles().get(1).where()).hasToString(worlds.file("t.world") + ":9:1");
    }

    @Test
    void pioneer_hasItsBodyAxleAndSixteenSonars() {
        RobotSpec robot = worlds.world(Worlds.ARENA).robots().getFirst();

        assertPose(robot.pose(), -4, 0, 90);
        assertThat(robot.lengthM()).isEqualTo(0.44);
        assertThat(robot.widthM()).isEqualTo(0.33);
        assertThat(robot.massKg()).isEqualTo(23);
        assertPose(robot.origin(), -0.04, 0, 0);
        assertThat(robot.startOdometry()).isEqualTo(Pose.ORIGIN);
        assertThat(robot.blocksRangers()).isTrue();
        assertThat(robot.visible()).isTrue();

        SonarSpec sonar = robot.sonar();
        assertThat(sonar).isNotNull();
        assertThat(sonar.mounts()).hasSize(16);
        assertPose(sonar.mounts().get(0), 0.075, 0.13, 90);
        assertPose(sonar.mounts().get(3), 0.17, 0.025, 10);
        assertPose(sonar.mounts().get(11), -0.25, -0.025, -170);
        assertThat(sonar.minRangeM()).isZero();
        assertThat(sonar.maxRangeM()).isEqualTo(5);
        assertThat(sonar.fovRad()).isCloseTo(Math.toRadians(15), EXACT);
    }

    @Test
    void block_ofTheRobot_fillsItsSizeAroundTheOrigin() {
        Shape shape = worlds.world(Worlds.ARENA).robots().getFirst().shape();

        // drawn as 0.4 x 0.511, so 0.12 of 0.2 becomes 0.132 of 0.22 along x, and 0.12 of 0.2555 the same share of
        // 0.165 along y
        double y = 0.165 * 0.12 / 0.2555;
        assertThat(shape.polygons()).hasSize(1);
        assertOutline(
                shape.polygons().getFirst(),
                -0.26,
                y,
                -0.26,
                -y,
                -0.172,
                -0.165,
                0.092,
                -0.165,
                0.18,
                -y,
                0.18,
                y,
                0.092,
                0.165,
                -0.172,
                0.165);
    }

    @Test
    void blobfinder_readsImageViewAndColours() {
        List<RobotSpec> robots = worlds.world(Worlds.ARENA).robots();

        assertThat(robots.get(0).blobfinder())
                .isEqualTo(new BlobfinderSpec(
                        Pose.ORIGIN, 80, 60, 8, Math.toRadians(60), List.of(0xff0000, 0x00ff00, 0x0000ff)));
        assertThat(robots.get(1).blobfinder())
                .isEqualTo(new BlobfinderSpec(
                        new Pose(0.1, 0, Math.toRadians(30)), 80, 60, 12, Math.toRadians(60), List.of()));
    }

    @Test
    void model_withoutProperties_isARedBoxOfTenCentimetres() {
        ObstacleSpec box = obstacle("model ()");

        assertThat(box.name()).isEqualTo("model:0");
        assertThat(box.pose()).isEqualTo(Pose.ORIGIN);
        assertOutline(box.shape().polygons().getFirst(), -0.05, -0.05, 0.05, -0.05, 0.05, 0.05, -0.05, 0.05);
        assertThat(box.blocksBodies()).isTrue();
        assertThat(box.blocksRangers()).isTrue();
        assertThat(box.visible()).isTrue();
    }

    @Test
    void returns_setToZero_makeAThingTransparent() {
        ObstacleSpec ghost = obstacle("model ( obstacle_return 0 ranger_return 0 blob_return 0 )");

        assertThat(ghost.blocksBodies()).isFalse();
        assertThat(ghost.blocksRangers()).isFalse();
        assertThat(ghost.visible()).isFalse();
        assertThat(obstacle("model ( ranger_return 0.5 )").blocksRangers()).isTrue();
        assertThat(obstacle("model ( ranger_return -1 )").blocksRangers()).isFalse();
    }

    @Test
    void origin_movesAndTurnsTheBodyAroundThePosePoint() {
        Shape shape = obstacle("model ( size [ 2 1 ] origin [ 3 0 0 90 ] )").shape();

        assertOutline(shape.polygons().getFirst(), 3.5, -1, 3.5, 1, 2.5, 1, 2.5, -1);
    }

    @Test
    void blocks_severalOfThem_shareOneBoundingBox() {
        Shape shape = obstacle("""
                        model
                        (
                          size [ 4 2 1 ]
                          block ( points 4 point[0] [ 0 0 ] point[1] [ 10 0 ] point[2] [ 10 10 ] point[3] [ 0 10 ] )
                          block ( points 3 point[0] [ 20 20 ] point[1] [ 40 0 ] point[2] [ 40 20 ] z [ 0 1 ] )
                        )
                        """).shape();

        assertThat(shape.polygons()).hasSize(2);
        assertOutline(shape.polygons().get(0), -2, -1, -1, -1, -1, 0, -2, 0);
        assertOutline(shape.polygons().get(1), 0, 1, 2, -1, 2, 1);
    }

    @Test
    void block_drawnClockwise_isTurnedRound() {
        Shape shape = obstacle("model ( size [ 2 2 ] block ( point[0] [ 0 0 ] point[1] [ 0 1 ] point[2] [ 1 0 ] ) )")
                .shape();

        assertOutline(shape.polygons().getFirst(), 1, -1, -1, 1, -1, -1);
    }

    @Test
    void block_concave_isCutIntoConvexPieces() {
        Shape shape = obstacle("""
                        model ( size [ 2 2 ] block ( points 6
                          point[0] [ 0 0 ] point[1] [ 2 0 ] point[2] [ 2 1 ] point[3] [ 1 1 ] point[4] [ 1 2 ] point[5] [ 0 2 ] ) )
                        """).shape();

        assertThat(shape.polygons()).hasSize(2);
        assertThat(shape.polygons().stream().mapToDouble(Polygons::signedArea).sum())
                .isCloseTo(3, EXACT);
    }

    @Test
    void boundary_givesFourThinWallsInsideTheBox() {
        Shape shape = obstacle("model ( size [ 16 8 1 ] boundary 1 )").shape();

        assertThat(shape.polygons()).hasSize(4);
        assertOutline(shape.polygons().get(0), -8, -4, 8, -4, 8, -3.98, -8, -3.98);
        assertOutline(shape.polygons().get(3), 7.98, -4, 8, -4, 8, 4, 7.98, 4);
    }

    @Test
    void boundary_withBlocks_addsToThem() {
        Shape shape = obstacle("""
                        model ( size [ 4 4 ] boundary 1
                          block ( points 3 point[0] [ 0 0 ] point[1] [ 1 0 ] point[2] [ 0 1 ] ) )
                        """).shape();

        assertThat(shape.polygons()).hasSize(5);
        assertOutline(shape.polygons().getFirst(), -2, -2, 2, -2, -2, 2);
    }

    @Test
    void models_nested_becomeObstaclesWithComposedPoses() {
        WorldSpec world = worlds.world("""
                model ( name "a" pose [ 1 2 0 90 ]
                  model ( name "b" pose [ 3 0 0 90 ]
                    model ( name "c" pose [ 1 1 0 -30 ] ) ) )
                model ( name "d" )
                """);

        assertThat(world.obstacles()).extracting(ObstacleSpec::name).containsExactly("a", "b", "c", "d");
        assertPose(world.obstacles().get(1).pose(), 1, 5, 180);
        assertPose(world.obstacles().get(2).pose(), 0, 4, 150);
    }

    @Test
    void sensors_mountedOnAPose_turnWithIt() {
        SonarSpec sonar = worlds.world(
                        "position ( ranger ( pose [ 1 0 0 90 ] scount 2 spose[0] [ 2 0 0 ] spose[1] [ 0 1 -90 ] ) )")
                .robots()
                .getFirst()
                .sonar();

        assertThat(sonar).isNotNull();
        assertPose(sonar.mounts().get(0), 1, 2, 90);
        assertPose(sonar.mounts().get(1), 0, 0, 0);
        assertThat(sonar.maxRangeM()).isEqualTo(5);
        assertThat(sonar.fovRad()).isCloseTo(Math.PI / 2, EXACT);
    }

    @Test
    void odometry_withItsOwnOrigin_startsAtTheDifference() {
        RobotSpec robot = worlds.world(
                        "position ( pose [ 3 4 0 90 ] localization_origin [ 1 1 0 90 ] localization \"gps\" )")
                .robots()
                .getFirst();

        assertPose(robot.startOdometry(), 3, -2, 0);
    }

    @Test
    void units_ofTheFile_applyToEveryLengthAndAngle() {
        WorldSpec world = worlds.world("""
                unit_length "cm"
                unit_angle "radians"
                model ( pose [ 300 0 1.5 ] size [ 20 10 ] )
                model ( pose [ 0 300 0 ] )
                position ( size [ 44 33 ] ranger ( scount 1 spose[0] [ 10 0 -0.5 ] sview [ 10 400 0.2 ] )
                  blobfinder ( range 800 fov 1 pan 0.25 ) )
                """);

        assertThat(world.obstacles().get(0).pose()).isEqualTo(new Pose(3, 0, 1.5));
        assertOutline(
                world.obstacles().get(0).shape().polygons().getFirst(), -0.1, -0.05, 0.1, -0.05, 0.1, 0.05, -0.1, 0.05);
        assertThat(Box.around(world.obstacles().get(1).shape().polygons()).width())
                .isCloseTo(0.1, EXACT);
        RobotSpec robot = world.robots().getFirst();
        assertThat(robot.lengthM()).isCloseTo(0.44, EXACT);
        assertThat(robot.sonar()).isEqualTo(new SonarSpec(List.of(new Pose(0.1, 0, -0.5)), 0.1, 4, 0.2));
        assertThat(robot.blobfinder()).isEqualTo(new BlobfinderSpec(new Pose(0, 0, 0.25), 80, 60, 8, 1, List.of()));
    }

    @Test
    void names_notGiven_countWithinTheType() {
        WorldSpec world = worlds.world(
                "model () position ( pose [ 1 0 0 0 ] ) model ( name \"m\" ) model () position ( pose [ 2 0 0 ] )");

        assertThat(world.name()).isEqualTo("t.world");
        assertThat(world.robots()).extracting(RobotSpec::name).containsExactly("position:0", "position:1");
        assertThat(world.obstacles()).extracting(ObstacleSpec::name).containsExactly("model:0", "m", "model:2");
    }

    @Test
    void properties_thatOnlySteerTheGraphicalProgram_areAccepted() {
        WorldSpec world = worlds.world("""
                paused 0 speedup 1 show_clock 0 show_clock_interval 100 quit_time 3600 resolution 0.02 threads 1
                interval_real 100 interval_sim 50
                window ( size [ 400 300 ] scale 20 center [ 0 0 ] rotate [ 0 0 ] pcam_loc [ 0 -4 2 ] show_grid 1 )
                model ( gui_nose 1 gui_grid 0 gui_move 0 gui_outline 1 trail_length 5 map_resolution 0.1 update_interval 100
                  alwayson 1 fiducial_return 3 fiducial_key 1 gripper_return 1 stack_children 1 ctrl "wander" laser_return 2 )
                """);

        assertThat(world.intervalMillis()).isEqualTo(50);
        assertThat(world.obstacles()).hasSize(1);
    }

    @Test
    void stockIncludes_withThingsNotSupported_canBeReadWhileUnused() {
        assertThat(worlds.world("""
                                define sicklaser laser ( range_max 8 fov 180 samples 361 )
                                define fancy position ( drive "omni" velocity_bounds [ -1 1 -1 1 -1 1 -90 90 ] gripper () sicklaser () model () )
                                define new_sonar ranger ( sensor ( range [ 0 5 ] ) )
                                model ()
                                """).obstacles()).hasSize(1);
    }
}
