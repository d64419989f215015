package io.troupe.sim.device;

import static io.troupe.sim.Specs.BLACK;
import static io.troupe.sim.Specs.BLUE;
import static io.troupe.sim.Specs.GREEN;
import static io.troupe.sim.Specs.ORANGE;
import static io.troupe.sim.Specs.RED;
import static io.troupe.sim.Specs.camera;
import static io.troupe.sim.Specs.robot;
import static io.troupe.sim.Specs.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.Specs;
import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import java.util.List;
import org.junit.jupiter.api.Test;

class BlobfinderTest {
    private static final double DEGREE = StrictMath.PI / 180;

    private static List<ColourBlob> see(BlobfinderSpec camera, ObstacleSpec... obstacles) {
        return see(camera, Specs.world(robot("r1", Pose.ORIGIN), obstacles));
    }

    private static List<ColourBlob> see(BlobfinderSpec camera, WorldSpec world) {
        return new Blobfinder(camera).read(new Scene(world), 0).blobs();
    }

    private static ObstacleSpec box(double x, double y, double lengthM, double widthM, int colour) {
        return Specs.box("box", new Pose(x, y, 0), lengthM, widthM, colour);
    }

    /** The columns of 80 over 60 degrees whose centre lies between these angles, left positive. */
    private static int[] columnsBetween(double leftRad, double rightRad) {
        int first = (int) StrictMath.ceil((30 * DEGREE - leftRad) / (0.75 * DEGREE) - 0.5);
        int last = (int) StrictMath.floor((30 * DEGREE - rightRad) / (0.75 * DEGREE) - 0.5);
        return new int[] {first, last};
    }

    @Test
    void box_fillsTheColumnsItsFaceSpans() {
        // its outermost corners, seen from the camera: near left (2, 0.5) and far right (2.2, 0.3)
        ColourBlob blob = see(camera(8), box(2.1, 0.4, 0.2, 0.2, RED)).getFirst();

        int[] columns = columnsBetween(StrictMath.atan2(0.5, 2), StrictMath.atan2(0.3, 2.2));
        assertThat(blob.colour()).isEqualTo(RED);
        assertThat(blob.left()).isEqualTo(columns[0]).isEqualTo(21);
        assertThat(blob.right()).isEqualTo(columns[1]).isEqualTo(29);
        assertThat(blob.x()).isEqualTo(25);
        assertThat(blob.rangeM()).isBetween(2.0, 2.2);
    }

    @Test
    void blobOfAWideWall_fillsTheImage_withTheHeightOfItsMeanRange() {
        ColourBlob blob = see(camera(8), wall("wall", 2.5, 0, 1, 20)).getFirst();

        double sum = 0;
        for (int column = 0; column < 80; column++) {
            sum += 2 / StrictMath.cos((30 - (column + 0.5) * 0.75) * DEGREE);
        }
        assertThat(blob.rangeM()).isCloseTo(sum / 80, within(1e-9));
        assertThat(blob.left()).isZero();
        assertThat(blob.right()).isEqualTo(79);
        // atan(0.3 / 2.09) is 8.2 degrees, a row is one degree
        assertThat(blob.top()).isEqualTo(22);
        assertThat(blob.bottom()).isEqualTo(38);
        assertThat(blob.y()).isEqualTo(30);
        assertThat(blob.areaPx2()).isEqualTo(79 * 16);
        assertThat(blob.colour()).isEqualTo(BLACK);
    }

    @Test
    void nearThing_isClippedToTheImage() {
        ColourBlob blob = see(camera(8), wall("wall", 0.75, 0, 1, 4)).getFirst();

        assertThat(blob.top()).isZero();
        assertThat(blob.bottom()).isEqualTo(60);
    }

    @Test
    void twoColours_areReportedFromLeftToRight() {
        List<ColourBlob> blobs = see(camera(8), box(3, -0.5, 0.4, 0.4, GREEN), box(3, 0.5, 0.4, 0.4, BLUE));

        assertThat(blobs).extracting(ColourBlob::colour).containsExactly(BLUE, GREEN);
        assertThat(blobs.get(0).right()).isLessThan(40);
        assertThat(blobs.get(1).left()).isGreaterThanOrEqualTo(40);
        assertThat(blobs.get(0).left()).isEqualTo(79 - blobs.get(1).right());
    }

    @Test
    void neighboursOfOneColour_areOneBlob_butAGapParts() {
        assertThat(see(camera(8), box(3, 0.25, 0.5, 0.5, RED), box(3, -0.25, 0.5, 0.5, RED)))
                .hasSize(1);
        assertThat(see(camera(8), box(3, 0.5, 0.5, 0.5, RED), box(3, -0.5, 0.5, 0.5, RED)))
                .hasSize(2);
    }

    @Test
    void blobsThatTouch_shareNoColumn_andSkipNone() {
        List<ColourBlob> blobs = see(camera(8), box(3, 0.5, 0.4, 1, BLUE), box(3, -0.5, 0.4, 1, GREEN));

        assertThat(blobs).hasSize(2);
        assertThat(blobs.get(0).right()).isEqualTo(39);
        assertThat(blobs.get(1).left()).isEqualTo(40);
    }

    @Test
    void wall_hidesWhatIsBehindIt() {
        List<ColourBlob> blobs = see(camera(8), box(4, 0, 0.5, 0.5, RED), wall("screen", 2, 0, 0.1, 1));

        assertThat(blobs).extracting(ColourBlob::colour).containsExactly(BLACK);
    }

    @Test
    void wall_hidesEvenWhenOnlyOtherColoursAreAskedFor() {
        // the screen covers the left half of the box
        List<ColourBlob> blobs = see(camera(8, RED), box(4, 0, 0.5, 1, RED), wall("screen", 2, 0.5, 0.1, 1));

        assertThat(blobs).hasSize(1);
        assertThat(blobs.getFirst().colour()).isEqualTo(RED);
        assertThat(blobs.getFirst().left()).isEqualTo(40);
    }

    @Test
    void robot_hidesWhatIsBehindIt_andHasAColourItself() {
        WorldSpec world = Specs.world(
                List.of(robot("r1", Pose.ORIGIN), robot("r2", new Pose(2, 0, 0))), box(4, 0, 0.5, 0.5, RED));

        assertThat(see(camera(8), world)).extracting(ColourBlob::colour).containsExactly(ORANGE);
        assertThat(see(camera(8, RED), world)).isEmpty();
    }

    @Test
    void filter_reportsOnlyItsColours_exactly() {
        ObstacleSpec[] boxes = {
            box(3, 1, 0.3, 0.3, RED),
            box(3, 0, 0.3, 0.3, 0xFE0000),
            box(3, -1, 0.3, 0.3, BLUE),
            wall("back", 6, 0, 1, 20)
        };

        assertThat(see(camera(8, BLUE, RED), boxes))
                .extracting(ColourBlob::colour)
                .containsExactly(RED, BLUE);
        assertThat(see(camera(8), boxes))
                .extracting(ColourBlob::colour)
                .containsExactly(BLACK, RED, BLACK, 0xFE0000, BLACK, BLUE, BLACK);
    }

    @Test
    void invisibleThing_hidesNothing() {
        ObstacleSpec glass = new ObstacleSpec(
                "glass", new Pose(1, 0, 0), Specs.box(0.1, 4, 0), GREEN, true, true, false, Specs.at(1));

        assertThat(see(camera(8), glass, box(3, 0, 0.4, 0.4, RED)))
                .extracting(ColourBlob::colour)
                .containsExactly(RED);
    }

    @Test
    void thingOutOfRangeOrBehind_isNotSeen_andTheImageKeepsItsSize() {
        BlobImage image = new Blobfinder(camera(3))
                .read(
                        new Scene(Specs.world(
                                robot("r1", Pose.ORIGIN), box(4, 0, 0.5, 0.5, RED), box(-1, 0, 0.5, 0.5, RED))),
                        0);

        assertThat(image).isEqualTo(new BlobImage(80, 60, List.of()));
    }

    @Test
    void pannedCamera_looksWhereItsMountSays() {
        var left = new BlobfinderSpec(new Pose(0, 0, 90 * DEGREE), 80, 60, 8, 60 * DEGREE, List.of());

        ColourBlob blob = see(left, box(0, 3, 0.4, 0.4, RED)).getFirst();

        assertThat(blob.left() + blob.right()).isEqualTo(79);
    }

    @Test
    void imageThatMakesNoSense_isRefused() {
        assertThatThrownBy(() -> new Blobfinder(new BlobfinderSpec(Pose.ORIGIN, 0, 60, 8, 1, List.of())))
                .hasMessageContaining("image is 0 x 60");
        assertThatThrownBy(() -> new Blobfinder(new BlobfinderSpec(Pose.ORIGIN, 80, 60, 0, 1, List.of())))
                .hasMessageContaining("range is 0.0");
        assertThatThrownBy(() -> new Blobfinder(new BlobfinderSpec(Pose.ORIGIN, 80, 60, 8, -1, List.of())))
                .hasMessageContaining("field of view is -1.0");
    }
}
