package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.CargoSpec;
import io.troupe.sim.model.DriveSpec;
import io.troupe.sim.model.DriveSpec.Bounds;
import io.troupe.sim.model.DriveSpec.Localization;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeNoise;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import java.util.List;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** What worlds in the dialects of Stage 2 and 3, and of Stage 4, mean. */
class WorldReaderTest extends WorldFiles {
    private Shape shape(String model) {
        return obstacle(model).shape();
    }

    private static void assertOutline(List<Point> outline, double... coordinates) {
        assertThat(outline).hasSize(coordinates.length / 2);
        for (int i = 0; i < outline.size(); i++) {
            assertThat(outline.get(i).x()).as("x of %d of %s", i, outline).isCloseTo(coordinates[2 * i], EXACT);
            assertThat(outline.get(i).y()).as("y of %d of %s", i, outline).isCloseTo(coordinates[2 * i + 1], EXACT);
        }
    }

    // ---- a whole world

    @Test
    void arena_asInTheMainJob_isReadWhole_withPioneersAndCameras() {
        write("pioneer.inc", PIONEER);
        WorldSpec world = world(ARENA);
        assertThat(world.name()).isEqualTo("arena");
        assertThat(world.file()).isEqualTo(file("t.world"));
        assertThat(world.intervalMillis()).isEqualTo(100);
        assertThat(world.robots())
                .extracting(RobotSpec::name, RobotSpec::colour)
                .containsExactly(tuple("r0", 0xffa500), tuple("r1", 0));
        assertThat(world.obstacles())
                .extracting(ObstacleSpec::name, ObstacleSpec::colour)
                .containsExactly(tuple("outer", 0), tuple("inner", 0), tuple("red", 0xff0000), tuple("blue", 0x0000ff));
        assertThat(world.obstacles().get(1).where()).hasToString(file("t.world") + ":9:1");

        RobotSpec robot = world.robots().getFirst();
        assertPose(robot.pose(), -4, 0, 90);
        assertThat(List.of(robot.lengthM(), robot.widthM(), robot.massKg())).containsExactly(0.44, 0.33, 23.0);
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

        // its block is drawn as 0.4 x 0.511, so 0.12 of 0.2 becomes 0.132 of 0.22 along x, and 0.12 of 0.2555 the same
        // share of 0.165 along y
        double y = 0.165 * 0.12 / 0.2555;
        double[] outline = {
            -0.26, y, -0.26, -y, -0.172, -0.165, 0.092, -0.165, 0.18, -y, 0.18, y, 0.092, 0.165, -0.172, 0.165
        };
        assertThat(robot.shape().polygons()).hasSize(1);
        assertOutline(robot.shape().polygons().getFirst(), outline);
        double fovRad = Math.toRadians(60);

        assertThat(world.robots())
                .extracting(RobotSpec::blobfinder)
                .containsExactly(
                        new BlobfinderSpec(Pose.ORIGIN, 80, 60, 8, fovRad, List.of(0xff0000, 0x00ff00, 0x0000ff)),
                        new BlobfinderSpec(new Pose(0.1, 0, Math.toRadians(30)), 80, 60, 12, fovRad, List.of()));
    }

    // ---- models

    @Test
    void model_blocksEverythingAndIsSeen_unlessItsReturnsAreZero() {
        ObstacleSpec box = obstacle("model ()");
        assertThat(box.name()).isEqualTo("model:0");
        assertThat(box.pose()).isEqualTo(Pose.ORIGIN);
        assertThat(box.blocksBodies()).isTrue();
        assertThat(box.blocksRangers()).isTrue();
        assertThat(box.visible()).isTrue();
        ObstacleSpec ghost = obstacle("model ( obstacle_return 0 ranger_return 0 blob_return 0 )");
        assertThat(ghost.blocksBodies()).isFalse();
        assertThat(ghost.blocksRangers()).isFalse();
        assertThat(ghost.visible()).isFalse();
        assertThat(world("model ( blob_return 2 ) model ( blob_return 0 ) model ( blob_return 0.5 )")
                        .obstacles())
                .extracting(ObstacleSpec::visible)
                .containsExactly(true, false, true);
        String things = "model ( ranger_return 0 ) model ( ranger_return -1 ) model ( ranger_return 0.5 )";
        assertThat(world(things).obstacles())
                .extracting(ObstacleSpec::blocksRangers)
                .containsExactly(false, false, true);
        assertThat(world(things + " position ( pose [ 2 0 0 0 ] ranger ( sensor () ) )")
                        .obstacles())
                .extracting(ObstacleSpec::blocksRangers)
                .containsExactly(true, false, true);
    }

    @Test
    void models_nested_haveComposedPoses_andCountedNames() {
        WorldSpec world = world("""
                model ( name "a" pose [ 1 2 0 90 ]
                  model ( name "b" pose [ 3 0 0 90 ]
                    model ( name "c" pose [ 1 1 0 -30 ] ) ) )
                model ( name "d" )
                """);
        assertThat(world.obstacles()).extracting(ObstacleSpec::name).containsExactly("a", "b", "c", "d");
        assertPose(world.obstacles().get(1).pose(), 1, 5, 180);
        assertPose(world.obstacles().get(2).pose(), 0, 4, 150);
        WorldSpec unnamed = world(
                "model () position ( pose [ 1 0 0 0 ] ) model ( name \"m\" ) model () position ( pose [ 2 0 0 ] )");
        assertThat(unnamed.name()).isEqualTo("t.world");
        assertThat(unnamed.robots()).extracting(RobotSpec::name).containsExactly("position:0", "position:1");
        assertThat(unnamed.obstacles()).extracting(ObstacleSpec::name).containsExactly("model:0", "m", "model:2");
    }

    @Test
    void macroOrPropertyGivenTwice_countsAsInStage() {
        WorldSpec world = world("""
                define post model ( color "red" size [ 1 1 ] )
                define post model ( color "blue" size [ 2 2 ] )
                post ( size [ 3 3 ] color "green" size [ 4 2 ] )
                post ( pose [ 9 9 0 0 ] )
                """);
        assertThat(world.obstacles()).extracting(ObstacleSpec::colour).containsExactly(0x00ff00, 0xff0000);
        Box first = Box.around(world.obstacles().getFirst().shape().polygons());
        assertThat(first.width()).isCloseTo(4, within(1e-9));
        assertThat(first.height()).isCloseTo(2, within(1e-9));
    }

    // ---- shapes

    /** Outlines stand in the order of the polygons, and .. for one that is not compared. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            model () | -0.05 -0.05 0.05 -0.05 0.05 0.05 -0.05 0.05
            model ( size [ 2 1 ] origin [ 3 0 0 90 ] ) | 3.5 -1 3.5 1 2.5 1 2.5 -1
            model ( size [ 2 2 ] block ( point[0] [ 0 0 ] point[1] [ 0 1 ] point[2] [ 1 0 ] ) ) | 1 -1 -1 1 -1 -1
            model ( size [ 16 8 1 ] boundary 1 ) | -8 -4 8 -4 8 -3.98 -8 -3.98 / .. / .. / 7.98 -4 8 -4 8 4 7.98 4
            model ( size [ 4 4 ] boundary 1 block ( points 3 point[0] [ 0 0 ] point[1] [ 1 0 ] point[2] [ 0 1 ] ) ) | \
            -2 -2 2 -2 -2 2 / .. / .. / .. / ..
            model ( size [ 4 2 1 ] \
            block ( points 4 point[0] [ 0 0 ] point[1] [ 10 0 ] point[2] [ 10 10 ] point[3] [ 0 10 ] ) \
            block ( points 3 point[0] [ 20 20 ] point[1] [ 40 0 ] point[2] [ 40 20 ] z [ 0 1 ] ) ) | \
            -2 -1 -1 -1 -1 0 -2 0 / 0 1 2 -1 2 1
            """)
    void shape_ofAModel_hasThePolygonsOfItsSizeOriginBlocksAndBoundary(String model, String outlines) {
        List<List<Point>> polygons = shape(model).polygons();
        String[] expected = outlines.split(" / ");
        assertThat(polygons).hasSize(expected.length);
        for (int i = 0; i < expected.length; i++) {
            if (!expected[i].equals("..")) {
                double[] outline = Stream.of(expected[i].split(" "))
                        .mapToDouble(Double::parseDouble)
                        .toArray();
                assertOutline(polygons.get(i), outline);
            }
        }
    }

    @Test
    void block_concave_isCutIntoConvexPieces() {
        List<List<Point>> pieces = shape("""
                model ( size [ 2 2 ] block ( points 6
                  point[0] [ 0 0 ] point[1] [ 2 0 ] point[2] [ 2 1 ] point[3] [ 1 1 ] point[4] [ 1 2 ] point[5] [ 0 2 ] ) )
                """).polygons();
        assertThat(pieces).hasSize(2);
        assertThat(pieces.stream().mapToDouble(Polygons::signedArea).sum()).isCloseTo(3, EXACT);
    }

    @Test
    void polygonsOfStage2_areTheOutlineScaledToTheSize() {
        String polygons = """
                polygons 1 polygon[0].points 3 polygon[0].filled 1
                polygon[0].point[0] [ 0 0 ] polygon[0].point[1] [ 2 0 ] polygon[0].point[2] [ 2 2 ]
                """;
        String blocks = polygons.replace("polygon", "block").replace("block[0].filled 1", "block[0].z [ 0 1 ]");
        String block = "block ( points 3 point[0] [ 0 0 ] point[1] [ 2 0 ] point[2] [ 2 2 ] )";
        Shape expected = shape("model ( size [ 4 1 ] " + block + " )");
        assertThat(shape("model ( size [ 4 1 ] " + polygons + " )")).isEqualTo(expected);
        assertThat(shape("model ( size [ 4 1 ] " + blocks + " )")).isEqualTo(expected);
        assertThat(shape("define wedge model ( " + polygons + " ) wedge ( size [ 4 1 ] )"))
                .as("inherited")
                .isEqualTo(expected);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            polygons 1 | t.world:1:18: "polygons" is 1, but polygon[0].points is missing
            polygons 100000 | t.world:1:18: "polygons" must be from 0 to 1000, not 100000
            polygons 1 polygon[0].points 4 polygon[0].point[0] [ 0 0 ] | t.world:1:38: "points" is 4, but point[1] is missing
            polygons 1 polygon[0].points 2000000000 | t.world:1:38: a block needs 3 to 1000 points, not 2000000000
            polygon[0].pionts 4 | t.world:1:9: unknown property "polygon[0].pionts" of model; did you mean "polygon.points"?
            polygon[0].point [ 0 0 ] | t.world:1:9: "polygon[0].point" needs an index: polygon[0].point[0], polygon[0].point[1], ..
            """)
    void polygonOfStage2_thatMakesNoSense_isRefused(String text, String message) {
        assertThat(problem("model ( " + text + " )")).isEqualTo(message);
    }

    // ---- colours

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            green ( color "blue" ) | 0000ff
            green ( color "red" ) | ff0000
            green ( color "green" ) | 00ff00
            green ( color "orange" ) | ffa500
            green ( color "black" ) | 000000
            green ( color "gray30" ) | 4d4d4d
            green ( color "Light Sea Green" ) | 20b2aa
            green ( color "lightSeaGreen" ) | 20b2aa
            green ( color "RebeccaPurple" ) | 663399
            green ( color "crimson" ) | dc143c
            green ( color "gray" ) | bebebe
            green ( color_rgba [ 1 0.5 0 0.3 ] ) | ff8000
            green () | 00ff00
            both () | 0000ff
            both ( color "red" ) | ff0000
            model () | ff0000
            """)
    void colour_isTheInstancesOrTheMacrosOrRed_andItsNameThatOfX11(String model, String hex) {
        String macros = """
                define green model ( color "green" )
                define both model ( color "green" color_rgba [ 0 0 1 1 ] )
                """;
        assertThat(obstacle(macros + model).colour()).isEqualTo(Integer.parseInt(hex, 16));
    }

    @Test
    void colourRandom_differsFromPlaceToPlaceAndIsTheSameEachTime() {
        String text = "define bot position ( color \"random\" )\n"
                + "bot ( )\nbot ( pose [ 1 0 0 0 ] )\nbot ( pose [ 2 0 0 0 ] )\nbot ( pose [ 3 0 0 0 ] )\n";
        List<Integer> colours =
                world(text).robots().stream().map(RobotSpec::colour).toList();
        assertThat(colours).doesNotHaveDuplicates().allMatch(colour -> colour >= 0 && colour <= 0xffffff);
        assertThat(world(text).robots()).extracting(RobotSpec::colour).isEqualTo(colours);
    }

    // ---- sensors

    @Test
    void sonars_mountedOnAPose_turnWithIt_andHaveOneSizeEachInStage2() {
        SonarSpec sonar = robot(
                        "position ( ranger ( pose [ 1 0 0 90 ] scount 2 spose[0] [ 2 0 0 ] spose[1] [ 0 1 -90 ] ) )")
                .sonar();
        assertThat(sonar).isNotNull();
        assertPose(sonar.mounts().get(0), 1, 2, 90);
        assertPose(sonar.mounts().get(1), 0, 0, 0);
        assertThat(sonar.maxRangeM()).isEqualTo(5);
        assertThat(sonar.fovRad()).isCloseTo(Math.PI / 2, EXACT);
        SonarSpec older = robot("""
                position ( ranger ( scount 2 spose[0] [ 0 0 0 ] spose[1] [ 0 0 90 ]
                  ssize[0] [ 0.01 0.05 ] ssize[1] [ 0.01 0.05 ] sview[0] [ 0.1 4 20 ] sview[1] [ 0.1 4 20 ] ) )
                """).sonar();
        assertThat(older).isNotNull();
        assertThat(older.maxRangeM()).isEqualTo(4);
        assertThat(older.fovRad()).isEqualTo(Math.toRadians(20));
    }

    @Test
    void laser_ofTheClassicDialect_isAScanOfOneSensor() {
        RobotSpec robot = robot("""
                define sicklaser laser ( range_max 6 fov 90 samples 91 size [ 0.156 0.155 0.19 ] resolution 2 )
                position ( pose [ 1 2 0 30 ] sicklaser ( pose [ 0.1 0 0 180 ] ) laser () )
                """);
        var mount = new Pose(0.1, 0, Math.PI);
        var sensor = new RangeSensorSpec(mount, 0, 6, Math.toRadians(90), 91, 0.156, 0.155, RangeNoise.NONE);
        assertThat(robot.rangers().getFirst())
                .isEqualTo(new RangerSpec(RangerSpec.Kind.LASER, mount, 0.156, 0.155, List.of(sensor)));
        assertThat(robot.rangers().get(1).sensors())
                .first()
                .extracting(RangeSensorSpec::samples, RangeSensorSpec::maxRangeM, RangeSensorSpec::fovRad)
                .containsExactly(180, 8.0, Math.PI);
        assertThat(robot.sonar()).isNull();
        assertThat(robot.startOdometry()).isEqualTo(Pose.ORIGIN);
        assertThat(robot.drive().velocityBounds()).isEqualTo(Bounds.NONE);
    }

    @Test
    void ranger_ofStage4_hasItsSensorsInTheRobotsFrame() {
        RangerSpec ranger = robot("""
                define beam sensor ( range [ 0.1 4 ] fov 20 samples 3 noise [ 0.01 0.02 5 ] size [ 0.01 0.05 ] )
                position ( pose [ 1 2 0 30 ] ranger ( pose [ 1 0 0 90 ] size [ 0 0 0 ]
                  beam ( pose [ 0.5 0 0 -90 ] ) sensor () ) )
                """).rangers().getFirst();
        assertThat(ranger.kind()).isEqualTo(RangerSpec.Kind.RANGER);
        assertThat(ranger.lengthM()).isZero();
        RangeSensorSpec beam = ranger.sensors().getFirst();
        assertPose(beam.mount(), 1, 0.5, 0);
        var noise = new RangeNoise(0.01, 0.02, Math.toRadians(5), RangeNoise.Law.STAGE);
        assertThat(beam).isEqualTo(new RangeSensorSpec(beam.mount(), 0.1, 4, Math.toRadians(20), 3, 0.01, 0.05, noise));
        assertThat(ranger.sensors().get(1).maxRangeM()).isEqualTo(5);
        assertThat(ranger.sensors().get(1).samples()).isEqualTo(1);
    }

    // ---- drives

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
        String ownOrigin = "position ( pose [ 3 4 0 90 ] localization_origin [ 1 1 0 90 ] localization \"gps\" )";
        assertPose(robot(ownOrigin).startOdometry(), 3, -2, 0);
    }

    // ---- cargo

    @Test
    void modelsAndPositionsOnARobot_areItsCargoWithTheirSensors() {
        RobotSpec robot = robot("""
                position ( pose [ 5 5 0 0 ] size [ 0.4 0.4 ]
                  model ( pose [ 0.3 0 0 90 ] size [ 0.2 0.1 ] color "blue"
                    model ( pose [ 0.2 0 0 0 ] size [ 0.1 0.1 ] obstacle_return 0 ranger_return 0 blob_return 0
                      blobfinder ( pose [ 0 0 0 -90 ] ) ) ) )
                """);
        CargoSpec box = robot.cargo().getFirst();
        assertThat(box.colour()).isEqualTo(0x0000ff);
        Box seen = Box.around(box.shape().polygons());
        assertThat(seen.minX()).isCloseTo(0.25, EXACT);
        assertThat(seen.maxY()).isCloseTo(0.1, EXACT);
        CargoSpec ghost = robot.cargo().get(1);
        assertThat(ghost.blocksBodies() || ghost.blocksRangers() || ghost.visible())
                .isFalse();
        assertThat(Box.around(robot.collisionShape().polygons()).maxX()).isCloseTo(0.35, EXACT);
        assertThat(robot.blobfinder()).isNotNull();
        assertPose(robot.blobfinder().mount(), 0.3, 0.2, 0);
        RobotSpec plated = robot("""
                position ( size [ 0.4 0.4 ]
                  position ( pose [ 0.3 0 0 90 ] size [ 0.2 0.1 ] color "blue" laser ( pose [ 0.1 0 0 0 ] ) ) )
                """);
        assertThat(plated.cargo()).extracting(CargoSpec::colour).containsExactly(0x0000ff);
        assertThat(plated.rangers())
                .singleElement()
                .satisfies(laser -> assertThat(laser.mount().y()).isCloseTo(0.1, EXACT));
    }

    // ---- units, and what is accepted without effect

    @Test
    void units_ofTheFile_applyToEveryLengthAndAngle() {
        WorldSpec world = world("""
                unit_length "cm"
                unit_angle "radians"
                model ( pose [ 300 0 1.5 ] size [ 20 10 ] )
                model ( pose [ 0 300 0 ] )
                position ( size [ 44 33 ] ranger ( scount 1 spose[0] [ 10 0 -0.5 ] sview [ 10 400 0.2 ] )
                  blobfinder ( range 800 fov 1 pan 0.25 ) )
                """);
        ObstacleSpec first = world.obstacles().getFirst();
        assertThat(first.pose()).isEqualTo(new Pose(3, 0, 1.5));
        assertOutline(first.shape().polygons().getFirst(), -0.1, -0.05, 0.1, -0.05, 0.1, 0.05, -0.1, 0.05);
        Box second = Box.around(world.obstacles().get(1).shape().polygons());
        assertThat(second.width()).isCloseTo(0.1, EXACT);
        RobotSpec robot = world.robots().getFirst();
        assertThat(robot.lengthM()).isCloseTo(0.44, EXACT);
        assertThat(robot.sonar()).isEqualTo(new SonarSpec(List.of(new Pose(0.1, 0, -0.5)), 0.1, 4, 0.2));
        assertThat(robot.blobfinder()).isEqualTo(new BlobfinderSpec(new Pose(0, 0, 0.25), 80, 60, 8, 1, List.of()));
    }

    @Test
    void thingsThatHaveNoEffect_areAccepted() {
        WorldSpec world = world("""
                paused 0 speedup 1 show_clock 0 show_clock_interval 100 quit_time 3600 resolution 0.02 threads 1
                interval_real 100 interval_sim 50
                window ( size [ 400 300 ] scale 20 center [ 0 0 ] rotate [ 0 0 ] pcam_loc [ 0 -4 2 ] show_grid 1 )
                model ( gui_nose 1 gui_grid 0 gui_move 0 gui_outline 1 trail_length 5 map_resolution 0.1 update_interval 100
                  alwayson 1 fiducial_return 3 fiducial_key 1 gripper_return 1 stack_children 1 ctrl "wander" laser_return 2 )
                """);
        assertThat(world.intervalMillis()).isEqualTo(50);
        assertThat(world.obstacles()).hasSize(1);
        String stock = """
                define sicklaser laser ( range_max 8 fov 180 samples 361 )
                define fancy position ( drive "omni" velocity_bounds [ -1 1 -1 1 -1 1 -90 90 ] actuator () sicklaser () model () )
                define new_sonar ranger ( sensor ( range [ 0 5 ] ) )
                model ()
                """;
        assertThat(obstacle(stock).name()).isEqualTo("model:0");
        assertThat(warnings(stock)).isEmpty();
    }
}
