package io.troupe.sim.device;

import static io.troupe.sim.Specs.BLACK;
import static io.troupe.sim.Specs.BLUE;
import static io.troupe.sim.Specs.GREEN;
import static io.troupe.sim.Specs.ORANGE;
import static io.troupe.sim.Specs.R1;
import static io.troupe.sim.Specs.RED;
import static io.troupe.sim.Specs.camera;
import static io.troupe.sim.Specs.robot;
import static io.troupe.sim.Specs.sonars;
import static io.troupe.sim.Specs.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.tuple;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.Specs;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.CargoSpec;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.OdometryError;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeNoise;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.SplittableRandom;
import java.util.TreeSet;
import org.assertj.core.data.Offset;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** Sonars, rangers, cameras, the gap to the nearest wall, and odometry with errors, compared with closed forms. */
class SensorsTest {
    private static final double DEGREE = StrictMath.PI / 180;
    private static final Offset<Double> EXACT = within(1e-9);

    private static void assertRanges(List<Double> ranges, double... expected) {
        assertThat(ranges).hasSize(expected.length);
        for (int i = 0; i < expected.length; i++) {
            assertThat(ranges.get(i)).as("range %d", i).isCloseTo(expected[i], EXACT);
        }
    }

    // ---- sonars

    private static List<Double> read(SonarSpec sonar, ObstacleSpec... obstacles) {
        return read(sonar, Specs.world(R1, obstacles));
    }

    /** Readings of robot 0 with these sonars. */
    private static List<Double> read(SonarSpec sonar, WorldSpec world) {
        return new Sonar(sonar).read(new Scene(world), 0);
    }

    @Test
    void sonar_measuresTheDistanceOverTheCosine_fromItsMount_leftPositive() {
        List<Double> ranges = read(sonars(0, 10, -30, 60, 89), wall("wall", 2.5, 0, 1, 8));
        assertRanges(ranges, 2, 2 / StrictMath.cos(10 * DEGREE), 2 / StrictMath.cos(30 * DEGREE), 4, 5);
        assertThat(ranges.get(4)).as("passes the end of the wall").isEqualTo(5);
        assertThat(read(sonars(90, -90), wall("left", 0, 2, 1, 2), wall("right", 0, -4, 1, 2)))
                .containsExactly(1.0, 3.0);
        // the robot stands at (1, 1) and faces north; the wall's face is y = 3
        WorldSpec world = Specs.world(robot("r1", 1, 1, 90 * DEGREE), wall("north", 1, 4, 12, 2));
        List<Double> ring = read(Specs.pioneerFront(), world);
        assertThat(ring.get(3)).isCloseTo((2 - 0.170) / StrictMath.cos(10 * DEGREE), EXACT);
        assertThat(ring.get(2)).isCloseTo((2 - 0.150) / StrictMath.cos(30 * DEGREE), EXACT);
        assertThat(ring.get(6)).isCloseTo((2 - 0.115) / StrictMath.cos(50 * DEGREE), EXACT);
        assertThat(ring.get(0)).as("looks west along the wall").isEqualTo(5);
    }

    @Test
    void range_isClampedToTheSonarsLimits_andFoundAtCornersAndCellBorders() {
        SonarSpec sonar = new SonarSpec(List.of(Pose.ORIGIN, new Pose(0, 0, StrictMath.PI)), 0.5, 3, 0.2);
        assertThat(read(sonar, wall("near", 0.8, 0, 1, 1), wall("far", -4, 0, 1, 1)))
                .containsExactly(0.5, 3.0);
        assertThat(read(sonars(0, 45, 180))).as("nothing in reach").containsExactly(5.0, 5.0, 5.0);
        assertThat(read(sonars(0), wall("beyond", 6, 0, 1.9, 1))).containsExactly(5.0);
        // faces and rays on whole metres, where the cells of the grid meet; two boxes share the corner (3, 0)
        assertThat(read(sonars(0), wall("above", 3.5, 0.5, 1, 1), wall("below", 3.5, -0.5, 1, 1)))
                .containsExactly(3.0);
        assertRanges(
                read(sonars(45), Specs.world(robot("r1", -1, -1, 0), wall("box", 1, 1, 2, 2))), StrictMath.sqrt(2));
    }

    @Test
    void sonar_seesAnotherRobot_butNeitherItsOwnNorThingsThatDoNotBlockRangers() {
        List<Double> ranges = read(sonars(0, 180), Specs.world(List.of(R1, robot("r2", 2, 0, StrictMath.PI / 2))));
        // the other one's right side is half its width from its centre of rotation
        assertRanges(ranges, 2 - 0.19, 5);
        assertThat(ranges.get(1)).isEqualTo(5);
        var glass = new ObstacleSpec(
                "glass", new Pose(1, 0, 0), Specs.box(0.1, 1), Specs.RED, true, false, true, Specs.at(1));
        RobotSpec ghost = Specs.with(robot("ghost", 2, 0, 0), "blocksRangers", false);
        WorldSpec world = Specs.world(List.of(R1, ghost), glass, wall("wall", 4, 0, 1, 1));
        assertThat(read(sonars(0), world)).containsExactly(3.5);
    }

    @Test
    void movedRobot_isSeenWhereItIs_evenBeyondTheGrid() {
        var scene = new Scene(Specs.world(List.of(R1, robot("r2", 2, 0, 0))));
        var sonar = new Sonar(new SonarSpec(List.of(Pose.ORIGIN), 0, 200, 0.2));
        scene.place(1, new Pose(100, 0, 0));
        scene.refresh();
        assertRanges(sonar.read(scene, 0), 100 - 0.26);
        scene.place(0, new Pose(180, 0, StrictMath.PI));
        scene.refresh();
        assertRanges(sonar.read(scene, 0), 80 - 0.18);
    }

    // ---- lasers and rangers

    private static RangeSensorSpec sensor(Pose mount, int fovDeg, int samples, RangeNoise noise) {
        return new RangeSensorSpec(mount, 0.1, 8, fovDeg * DEGREE, samples, 0.1, 0.1, noise);
    }

    private static RangerSpec laser(Pose mount, int fovDeg, int samples) {
        List<RangeSensorSpec> sensors = List.of(sensor(mount, fovDeg, samples, RangeNoise.NONE));
        return new RangerSpec(RangerSpec.Kind.LASER, mount, 0.15, 0.15, sensors);
    }

    private static RangerSpec ranger(RangeSensorSpec... sensors) {
        return new RangerSpec(RangerSpec.Kind.RANGER, Pose.ORIGIN, 0.1, 0.1, List.of(sensors));
    }

    private static double noDraw(double bound) {
        throw new AssertionError("an exact ranger draws nothing");
    }

    private static List<Double> read(RangerSpec ranger, WorldSpec world) {
        return new Ranger(ranger, SensorsTest::noDraw).read(new Scene(world), 0);
    }

    private static List<Double> read(RangerSpec ranger, ObstacleSpec... obstacles) {
        return read(ranger, Specs.world(R1, obstacles));
    }

    @Test
    void scan_ofAWall_isItsDistanceOverTheCosine_fromRightToLeft() {
        // the wall's face is x = 2, from y = -1.5 on to the left
        List<Double> ranges = read(laser(Pose.ORIGIN, 180, 181), wall("ahead", 2.5, 8.5, 1, 20));
        assertThat(ranges).hasSize(181);
        for (int i = 0; i < 181; i++) {
            double angle = (i - 90) * DEGREE;
            double expected = 2 / StrictMath.cos(angle);
            boolean past = 2 * StrictMath.tan(angle) < -1.5 - 1e-9 || expected > 8 || i == 0 || i == 180;
            assertThat(ranges.get(i)).as("ray %s", i - 90).isCloseTo(past ? 8 : expected, EXACT);
        }
        assertThat(ranges.get(90 - 40)).as("to the right, past the wall").isEqualTo(8);
        assertThat(ranges.get(90 + 40)).as("to the left").isLessThan(3);
    }

    @Test
    void scan_ofACorner_meetsBothWalls() {
        // the robot looks north-west into the corner (-3, 4), seen from a laser 0.2 m ahead of (1, 1)
        double heading = 135 * DEGREE;
        double x = 1 + 0.2 * StrictMath.cos(heading);
        double y = 1 + 0.2 * StrictMath.sin(heading);
        WorldSpec world =
                Specs.world(robot("r1", 1, 1, heading), wall("west", -3.5, 0, 1, 30), wall("north", 0, 4.5, 30, 1));
        List<Double> ranges = read(laser(new Pose(0.2, 0, 0), 60, 61), world);
        for (int i = 0; i < 61; i++) {
            double angle = heading + (i - 30) * DEGREE;
            double toWest = (x + 3) / -StrictMath.cos(angle);
            double toNorth = (4 - y) / StrictMath.sin(angle);
            double nearest = Math.min(toWest > 0 ? toWest : 8, toNorth > 0 ? toNorth : 8);
            assertThat(ranges.get(i)).as("ray %s", i - 30).isCloseTo(Math.min(8, nearest), EXACT);
        }
    }

    @Test
    void laser_seesOtherRobots_butNotItsOwn_andItsSingleSampleLooksAhead() {
        // 0.05 m from the laser to the wall; the laser sits inside its own robot
        RangerSpec single = laser(Pose.ORIGIN, 0, 1);
        assertThat(read(single, wall("touching", 0.55, 0, 1, 1))).containsExactly(0.1);
        assertThat(read(single, wall("far", 9, 0, 1, 1))).containsExactly(8.0);
        assertThat(read(laser(Pose.ORIGIN, 360, 13))).containsOnly(8.0);
        assertRanges(read(laser(new Pose(0, 0, 90 * DEGREE), 180, 1), wall("left", 0, 2, 1, 2)), 1);
        WorldSpec world = Specs.world(List.of(R1, robot("r2", 3, 0, StrictMath.PI)));
        List<Double> ranges = read(laser(Pose.ORIGIN, 90, 3), world);
        // it faces back: its front is 0.18 m ahead of its centre of rotation
        assertThat(ranges.get(1)).isCloseTo(3 - 0.18, EXACT);
        assertThat(ranges.getFirst()).isEqualTo(8);
    }

    @Test
    void severalSensors_followOneAnother() {
        RangerSpec ring = ranger(
                sensor(new Pose(0, 0, 90 * DEGREE), 15, 1, RangeNoise.NONE),
                sensor(new Pose(0, 0, -90 * DEGREE), 20, 3, RangeNoise.NONE),
                sensor(Pose.ORIGIN, 15, 1, RangeNoise.NONE));
        double aside = 3 / StrictMath.cos(10 * DEGREE);
        assertRanges(
                read(ring, wall("left", 0, 2, 1, 2), wall("right", 0, -4, 8, 2), wall("ahead", 5.5, 0, 1, 1)),
                1,
                aside,
                3,
                aside,
                5);
    }

    @Test
    void noise_isWhatTheDrawsSay_andIsDrawnWhereNothingIsHit_withoutLeavingTheGreatestRange() {
        // every draw is its bound: half of the specified value
        RangerSpec noisy = ranger(sensor(Pose.ORIGIN, 0, 1, new RangeNoise(0.2, 0.1, 2 * 30 * DEGREE)));
        var scene = new Scene(Specs.world(R1, wall("ahead", 2.5, 0, 1, 20)));
        double exact = 2 / StrictMath.cos(30 * DEGREE);
        assertRanges(new Ranger(noisy, bound -> bound).read(scene, 0), exact * 1.05 + 0.1);
        assertRanges(new Ranger(noisy, bound -> -bound).read(scene, 0), exact * 0.95 - 0.1);
        var bounds = new ArrayList<Double>();
        var seesNothing = new Ranger(ranger(sensor(Pose.ORIGIN, 90, 10, new RangeNoise(0.2, 0.1, 0.01))), bound -> {
            bounds.add(bound);
            return -bound;
        });
        assertThat(seesNothing.read(new Scene(Specs.world(R1)), 0)).containsOnly(8.0);
        assertThat(bounds).hasSize(30);
    }

    @Test
    void specificationsThatMakeNoSense_areRefused() {
        assertThatThrownBy(() -> new Sonar(new SonarSpec(List.of(), 2, 1, 0.1)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("sonar range is [2.0 1.0]");
        assertThatThrownBy(() -> read(laser(Pose.ORIGIN, 90, 0))).hasMessageContaining("0 samples");
        assertThatThrownBy(() -> read(laser(Pose.ORIGIN, 400, 2))).hasMessageContaining("field of view");
        assertThatThrownBy(() -> read(new RangerSpec(RangerSpec.Kind.LASER, Pose.ORIGIN, 1, 1, List.of())))
                .hasMessageContaining("a laser has 0 sensors, expected one");
    }

    // ---- cameras

    private static List<ColourBlob> see(BlobfinderSpec camera, ObstacleSpec... obstacles) {
        return see(camera, Specs.world(R1, obstacles));
    }

    private static List<ColourBlob> see(ObstacleSpec... obstacles) {
        return see(camera(8), obstacles);
    }

    private static List<ColourBlob> see(BlobfinderSpec camera, WorldSpec world) {
        return new Blobfinder(camera).read(new Scene(world), 0).blobs();
    }

    private static List<Integer> colours(List<ColourBlob> blobs) {
        return blobs.stream().map(ColourBlob::colour).toList();
    }

    private static ObstacleSpec box(double x, double y, double lengthM, double widthM, int colour) {
        return Specs.box("box", new Pose(x, y, 0), lengthM, widthM, colour);
    }

    @Test
    void blob_fillsTheColumnsThatAFaceSpans_withTheHeightOfItsMeanRange() {
        // its outermost corners, seen from the camera: near left (2, 0.5) at 14.04 degrees and far right (2.2, 0.3) at
        // 7.77; the middle of column 0 is at 29.625 degrees, and each next one 0.75 degrees to the right
        ColourBlob blob = see(box(2.1, 0.4, 0.2, 0.2, RED)).getFirst();
        assertThat(List.of(blob.colour(), blob.left(), blob.right(), blob.x())).containsExactly(RED, 21, 29, 25);
        assertThat(blob.rangeM()).isBetween(2.0, 2.2);
        ColourBlob wide = see(wall("wall", 2.5, 0, 1, 20)).getFirst();
        double sum = 0;
        for (int column = 0; column < 80; column++) {
            sum += 2 / StrictMath.cos((30 - (column + 0.5) * 0.75) * DEGREE);
        }
        assertThat(wide.rangeM()).isCloseTo(sum / 80, within(1e-9));
        // atan(0.3 / 2.09) is 8.2 degrees, a row is one degree
        assertThat(wide).isEqualTo(new ColourBlob(BLACK, 79 * 16, wide.x(), 30, 0, 79, 22, 38, wide.rangeM()));
    }

    @Test
    void image_clipsWhatIsNear_leavesOutWhatIsFarOrBehind_andLooksWhereItsMountSays() {
        assertThat(see(wall("wall", 0.75, 0, 1, 4)))
                .first()
                .extracting(ColourBlob::top, ColourBlob::bottom)
                .containsExactly(0, 60);
        WorldSpec world = Specs.world(R1, box(4, 0, 0.5, 0.5, RED), box(-1, 0, 0.5, 0.5, RED));
        assertThat(new Blobfinder(camera(3)).read(new Scene(world), 0)).isEqualTo(new BlobImage(80, 60, List.of()));
        var left = new BlobfinderSpec(new Pose(0, 0, 90 * DEGREE), 80, 60, 8, 60 * DEGREE, List.of());
        ColourBlob blob = see(left, box(0, 3, 0.4, 0.4, RED)).getFirst();
        assertThat(blob.left() + blob.right()).isEqualTo(79);
    }

    @Test
    void twoColours_areReportedFromLeftToRight_sharingNoColumn_butNeighboursOfOneColourAreOneBlob() {
        List<ColourBlob> blobs = see(box(3, -0.5, 0.4, 0.4, GREEN), box(3, 0.5, 0.4, 0.4, BLUE));
        assertThat(colours(blobs)).containsExactly(BLUE, GREEN);
        assertThat(blobs.get(0).right()).isLessThan(40);
        assertThat(blobs.get(1).left()).isGreaterThanOrEqualTo(40);
        assertThat(blobs.get(0).left()).isEqualTo(79 - blobs.get(1).right());
        List<ColourBlob> touching = see(box(3, 0.5, 0.4, 1, BLUE), box(3, -0.5, 0.4, 1, GREEN));
        assertThat(touching).hasSize(2);
        assertThat(touching.get(0).right()).isEqualTo(39);
        assertThat(touching.get(1).left()).isEqualTo(40);
        assertThat(see(box(3, 0.25, 0.5, 0.5, RED), box(3, -0.25, 0.5, 0.5, RED)))
                .hasSize(1);
        assertThat(see(box(3, 0.5, 0.5, 0.5, RED), box(3, -0.5, 0.5, 0.5, RED))).hasSize(2);
    }

    @Test
    void wallOrRobot_hidesWhatIsBehindIt_evenFromOtherColours_butAnInvisibleThingDoesNot() {
        assertThat(colours(see(box(4, 0, 0.5, 0.5, RED), wall("screen", 2, 0, 0.1, 1))))
                .containsExactly(BLACK);
        // the screen covers the left half of the box
        assertThat(see(camera(8, RED), box(4, 0, 0.5, 1, RED), wall("screen", 2, 0.5, 0.1, 1)))
                .extracting(ColourBlob::colour, ColourBlob::left)
                .containsExactly(tuple(RED, 40));
        WorldSpec world = Specs.world(List.of(R1, robot("r2", 2, 0, 0)), box(4, 0, 0.5, 0.5, RED));
        assertThat(colours(see(camera(8), world))).containsExactly(ORANGE);
        assertThat(see(camera(8, RED), world)).isEmpty();
        var glass =
                new ObstacleSpec("glass", new Pose(1, 0, 0), Specs.box(0.1, 4), GREEN, true, true, false, Specs.at(1));
        assertThat(colours(see(glass, box(3, 0, 0.4, 0.4, RED)))).containsExactly(RED);
    }

    @Test
    void filter_reportsOnlyItsColours_exactly() {
        ObstacleSpec[] boxes = {
            box(3, 1, 0.3, 0.3, RED),
            box(3, 0, 0.3, 0.3, 0xFE0000),
            box(3, -1, 0.3, 0.3, BLUE),
            wall("back", 6, 0, 1, 20)
        };
        assertThat(colours(see(camera(8, BLUE, RED), boxes))).containsExactly(RED, BLUE);
        assertThat(colours(see(boxes))).containsExactly(BLACK, RED, BLACK, 0xFE0000, BLACK, BLUE, BLACK);
    }

    @ParameterizedTest
    @CsvSource({"0, 8, 1, image is 0 x 60", "80, 0, 1, range is 0.0", "80, 8, -1, field of view is -1.0"})
    void imageThatMakesNoSense_isRefused(int widthPx, double rangeM, double fovRad, String message) {
        assertThatThrownBy(
                        () -> new Blobfinder(new BlobfinderSpec(Pose.ORIGIN, widthPx, 60, rangeM, fovRad, List.of())))
                .hasMessageContaining(message);
    }

    // ---- a colour list: such a camera casts few of its columns, but must see the same as one for all colours

    private static final int[] COLOURS = {RED, GREEN, BLUE, ORANGE, BLACK};

    private static WorldSpec world(Random random) {
        List<ObstacleSpec> obstacles = new ArrayList<>(Specs.arena(12));
        for (int i = 0; i < 15; i++) {
            Pose pose = place(random);
            double lengthM = 0.05 + 2 * random.nextDouble() * random.nextDouble();
            Shape shape = Specs.box(lengthM, 0.05 + random.nextDouble());
            obstacles.add(new ObstacleSpec(
                    "box" + i, pose, shape, colour(random), true, true, random.nextInt(5) > 0, Specs.at(1)));
        }
        List<RobotSpec> robots = new ArrayList<>();
        for (int i = 0; i < 12; i++) {
            Pose pose = place(random);
            RobotSpec plain = robot("r" + i, pose, colour(random), null, null);
            robots.add(Specs.carrying(plain, random.nextInt(6) > 0, cargo(random)));
        }
        return Specs.world(robots, obstacles);
    }

    /** Up to three things of any colour, some of them beyond the robot's edge, some invisible. */
    private static List<CargoSpec> cargo(Random random) {
        var cargo = new ArrayList<CargoSpec>();
        int pieces = random.nextInt(4);
        for (int i = 0; i < pieces; i++) {
            Shape shape = Specs.box(
                    0.02 + 0.6 * random.nextDouble(),
                    0.02 + 0.6 * random.nextDouble(),
                    1.6 * random.nextDouble() - 0.8);
            cargo.add(new CargoSpec(
                    shape, colour(random), random.nextBoolean(), random.nextBoolean(), random.nextInt(5) > 0));
        }
        return cargo;
    }

    private static Pose place(Random random) {
        return new Pose(10 * random.nextDouble() - 5, 10 * random.nextDouble() - 5, 7 * random.nextDouble());
    }

    private static int colour(Random random) {
        return COLOURS[random.nextInt(COLOURS.length)];
    }

    private static BlobfinderSpec randomCamera(Random random) {
        var mount = new Pose(random.nextDouble() - 0.5, random.nextDouble() - 0.5, 7 * random.nextDouble());
        double fovRad = 0.01 + (2 * StrictMath.PI - 0.01) * random.nextDouble();
        return new BlobfinderSpec(mount, 1 + random.nextInt(120), 60, 0.5 + 8 * random.nextDouble(), fovRad, List.of());
    }

    @Test
    void cameraForSomeColours_seesWhatOneForAllColoursSees_ofThem_bitByBit() {
        long seed = 23;
        var random = new Random(seed);
        int blobs = 0;
        var scratch = new Scratch();
        for (int round = 0; round < 150; round++) {
            WorldSpec spec = world(random);
            var scene = new Scene(spec);
            for (int move = 0; move < 3; move++) {
                for (int robot = 0; robot < spec.robots().size(); robot++) {
                    List<Integer> colours = List.of(colour(random), colour(random));
                    BlobfinderSpec all = randomCamera(random);
                    var some = new BlobfinderSpec(
                            all.mount(), all.widthPx(), all.heightPx(), all.rangeM(), all.fovRad(), colours);
                    Blobfinder camera = new Blobfinder(some).twin();
                    List<ColourBlob> expected = new Blobfinder(all)
                            .read(scene, robot).blobs().stream()
                                    .filter(blob -> colours.contains(blob.colour()))
                                    .toList();
                    camera.sense(scene, robot, scratch); // several cameras use it, as in a world
                    assertThat(camera.image().blobs())
                            .as("seed %d, round %d, move %d, robot %d", seed, round, move, robot)
                            .isEqualTo(expected);
                    blobs += expected.size();
                }
                for (int robot = 0; robot < spec.robots().size(); robot++) {
                    scene.place(robot, place(random));
                }
                scene.refresh();
            }
        }
        assertThat(blobs).as("blobs compared").isGreaterThan(5_000);
    }

    // ---- the nearest wall

    private static Outline outline(SplittableRandom random, double spreadM, double largestM) {
        Shape shape = Specs.box(random.nextDouble(0.05, largestM), random.nextDouble(0.05, largestM));
        double x = random.nextDouble(-spreadM, spreadM);
        double y = random.nextDouble(-spreadM, spreadM);
        return new Outline(shape, new Pose(x, y, random.nextDouble(-4, 4)));
    }

    /** Compares with a search over all walls, bit for bit, inside and outside of the walls' extent. */
    @Test
    void gap_isThatOfTheNearestOfAll_andInfiniteWithoutWalls() {
        for (long seed = 0; seed < 300; seed++) {
            var random = new SplittableRandom(seed);
            double spreadM = random.nextDouble(0.5, 60);
            List<Outline> walls = new ArrayList<>();
            for (int i = random.nextInt(1, 40); i > 0; i--) {
                walls.add(outline(random, spreadM, random.nextInt(4) == 0 ? 30 : 2));
            }
            var nearest = new NearestWalls(walls);
            for (int i = 0; i < 50; i++) {
                Outline body = outline(random, 1.5 * spreadM, 3);
                double expected = walls.stream().mapToDouble(body::gapM).min().orElseThrow();
                assertThat(nearest.gapM(body)).as("seed %d, body %d", seed, i).isEqualTo(expected);
                assertThat(new NearestWalls(List.of()).gapM(body)).isInfinite();
            }
        }
    }

    // ---- odometry with errors

    private static final OdometryError ODOMETRY_ERROR = new OdometryError(0.01, -0.02, 0.05);

    private final Position2d odometry = new Position2d(Pose.ORIGIN, Pose.ORIGIN, ODOMETRY_ERROR);

    private static Pose report(Position2d odometry, double x, double y, double headingRad) {
        odometry.sense(x, y, headingRad);
        return odometry.reported();
    }

    private static void assertPose(Pose actual, double x, double y, double headingRad) {
        assertThat(actual.x()).as("x").isCloseTo(x, EXACT);
        assertThat(actual.y()).as("y").isCloseTo(y, EXACT);
        assertThat(actual.headingRad()).as("heading").isCloseTo(headingRad, EXACT);
    }

    @Test
    void straightDrive_isCountedTooLong_inEveryDirection() {
        for (double heading : new double[] {0, 1, -2.5}) {
            double cos = StrictMath.cos(heading);
            double sin = StrictMath.sin(heading);
            var drive = new Position2d(new Pose(3, 4, heading), Pose.ORIGIN, ODOMETRY_ERROR);
            for (int i = 1; i <= 100; i++) {
                report(drive, 3 + 0.05 * i * cos, 4 + 0.05 * i * sin, heading);
            }
            assertPose(report(drive, 3 + 5 * cos, 4 + 5 * sin, heading), 5 * 1.01, 0, 0);
        }
    }

    @Test
    void push_sideways_isCountedTooShort_andATurnTooFar() {
        assertPose(report(new Position2d(Pose.ORIGIN, Pose.ORIGIN, ODOMETRY_ERROR), 0, -0.5, 0), 0, -0.49, 0);
        Pose reported = Pose.ORIGIN;
        for (int i = 1; i <= 200; i++) {
            reported = report(odometry, 0, 0, StrictMath.IEEEremainder(0.1 * i, 2 * StrictMath.PI));
        }
        assertPose(reported, 0, 0, StrictMath.IEEEremainder(20 * 1.05, 2 * StrictMath.PI));
    }

    @Test
    void reset_keepsTheError() {
        report(odometry, 1, 0, 0);
        odometry.set(new Pose(1, 0, 0), new Pose(7, 8, StrictMath.PI / 2));
        assertPose(report(odometry, 2, 0, 0), 7, 8 + 1.01, StrictMath.PI / 2);
        assertPose(report(odometry, 2, 0, 0), 7, 8 + 1.01, StrictMath.PI / 2);
    }

    @Test
    void teleport_isNotCounted_butExactOdometryNotices() {
        report(odometry, 1, 0, 0);
        odometry.teleported(new Pose(5, 5, 1));
        assertPose(report(odometry, 5, 5, 1), 1.01, 0, 0);
        var exact = new Position2d(Pose.ORIGIN, Pose.ORIGIN);
        exact.teleported(new Pose(5, 5, 1));
        assertPose(report(exact, 5, 5, 1), 5, 5, 1);
    }

    @Test
    void world_drawsTheErrorFromSeedAndRobot_withinHalfOfWhatTheSpecificationSays() {
        var distances = new TreeSet<Double>();
        for (long seed = 1; seed <= 20; seed++) {
            distances.add(drive(seed, "r1"));
        }
        assertThat(distances).hasSize(20);
        assertThat(distances.getFirst()).isBetween(1 - 0.015, 1.0);
        assertThat(distances.getLast()).isBetween(1.0, 1 + 0.015);
        assertThat(drive(1, "r1")).isEqualTo(drive(1, "r1"));
        assertThat(drive(1, "r2")).isNotEqualTo(drive(1, "r1"));
    }

    /** The distance that odometry reports for a drive of one metre. */
    private static double drive(long seed, String name) {
        RobotSpec robot = Specs.robot(name, Pose.ORIGIN).withOdometryError(OdometryError.STAGE);
        World world = World.create(Specs.world(robot), WorldSettings.defaults().withSeed(seed));
        world.command(0, 1, 0);
        return Specs.run(world, 10).odometry().pose().x();
    }
}
