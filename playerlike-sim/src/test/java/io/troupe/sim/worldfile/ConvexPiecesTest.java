package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.model.Point;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Random;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class ConvexPiecesTest {
    private static List<Point> points(double... coordinates) {
        var points = new ArrayList<Point>();
        for (int i = 0; i < coordinates.length; i += 2) {
            points.add(new Point(coordinates[i], coordinates[i + 1]));
        }
        return points;
    }

    private static List<Point> regular(int corners) {
        var points = new ArrayList<Point>();
        for (int i = 0; i < corners; i++) {
            double angle = 2 * Math.PI * i / corners;
            points.add(new Point(Math.cos(angle), Math.sin(angle)));
        }
        return points;
    }

    /**
     * Asserts that the pieces are convex, counter-clockwise, of 3 to 8 corners, without overlap, and of the same total
     * area.
     */
    private static void assertCovers(List<List<Point>> pieces, List<Point> polygon) {
        double area = 0;
        for (List<Point> piece : pieces) {
            assertThat(piece).hasSizeBetween(3, 8);
            for (int i = 0; i < piece.size(); i++) {
                Point a = piece.get(i);
                Point b = piece.get((i + 1) % piece.size());
                Point c = piece.get((i + 2) % piece.size());
                assertThat(Polygons.turn(a, b, c)).isPositive();
            }
            area += Polygons.signedArea(piece);
        }
        for (int i = 0; i < pieces.size(); i++) {
            for (int j = 0; j < i; j++) {
                assertThat(Polygons.overlap(pieces.get(i), pieces.get(j))).isFalse();
            }
        }
        assertThat(area).isCloseTo(Math.abs(Polygons.signedArea(polygon)), within(1e-9));
    }

    @ParameterizedTest
    @ValueSource(ints = {3, 4, 8})
    void polygon_convexWithUpToEightCorners_staysWhole(int corners) {
        assertThat(ConvexPieces.of(regular(corners))).containsExactly(regular(corners));
    }

    @ParameterizedTest
    @ValueSource(ints = {9, 12, 20, 100})
    void polygon_convexWithMoreCorners_isCutIntoAsFewAsPossible(int corners) {
        List<List<Point>> pieces = ConvexPieces.of(regular(corners));

        assertCovers(pieces, regular(corners));
        // every piece of 8 takes 6 triangles of corners - 2
        assertThat(pieces).hasSizeLessThanOrEqualTo((corners - 2 + 5) / 6 + 1);
    }

    @Test
    void corner_onAStraightLine_isLeftOut() {
        assertThat(ConvexPieces.of(points(0, 0, 1, 0, 2, 0, 2, 2, 0, 2, 0, 1)))
                .containsExactly(points(0, 0, 2, 0, 2, 2, 0, 2));
    }

    @Test
    void comb_drawnEitherWay_isCutIntoConvexPieces() {
        List<Point> comb =
                points(0, 0, 7, 0, 7, 3, 6, 3, 6, 1, 5, 1, 5, 3, 4, 3, 4, 1, 3, 1, 3, 3, 2, 3, 2, 1, 1, 1, 1, 3, 0, 3);

        assertCovers(ConvexPieces.of(comb), comb);
        assertCovers(ConvexPieces.of(comb.reversed()), comb);
    }

    @Test
    void bay_whoseCornersLieOnOneLine_isCutIntoConvexPieces() {
        List<Point> bay = points(0, 0, 3, 0, 3, 3, 0, 3, 0, 2, 1, 2, 1, 1, 0, 1);

        for (int turn = 0; turn < bay.size(); turn++) {
            var turned = new ArrayList<>(bay);
            Collections.rotate(turned, turn);
            assertCovers(ConvexPieces.of(turned), turned);
        }
    }

    @Test
    void polygons_onAGrid_areCutIntoConvexPieces() {
        long seed = 20_260_302;
        var random = new Random(seed);
        for (int round = 0; round < 200; round++) {
            // a skyline, then the same upside down below it
            var skyline = new ArrayList<Point>();
            int width = 2 + random.nextInt(8);
            for (int x = 0; x < width; x++) {
                int height = 1 + random.nextInt(3);
                skyline.add(new Point(x, height));
                skyline.add(new Point(x + 1, height));
            }
            for (int x = width; x > 0; x--) {
                int depth = -random.nextInt(3);
                skyline.add(new Point(x, depth));
                skyline.add(new Point(x - 1, depth));
            }
            assertThat(ConvexPieces.of(skyline))
                    .as("seed " + seed + ", round " + round)
                    .isNotEmpty();
            assertCovers(ConvexPieces.of(skyline), skyline);
        }
    }

    @Test
    void stars_ofRandomShape_areCutIntoConvexPieces() {
        long seed = 20_260_101;
        var random = new Random(seed);
        for (int round = 0; round < 300; round++) {
            int corners = 3 + random.nextInt(40);
            var star = new ArrayList<Point>();
            for (int i = 0; i < corners; i++) {
                // one corner in each of equal sectors around the middle: the outline never crosses itself
                double angle = 2 * Math.PI * (i + 0.8 * random.nextDouble()) / corners;
                double radius = 0.2 + random.nextDouble();
                star.add(new Point(radius * Math.cos(angle), radius * Math.sin(angle)));
            }
            assertCovers(ConvexPieces.of(star), star);
        }
    }

    @Test
    void polygon_thinnerThanAMicrometre_hasNoPieces() {
        assertThat(ConvexPieces.of(points(0, 0, 1, 0, 1, 1e-8))).isEmpty();
    }

    @Test
    void polygons_touching_doNotOverlap() {
        List<Point> square = Polygons.rectangle(0, 0, 1, 1);

        assertThat(Polygons.overlap(square, Polygons.rectangle(1, 0, 2, 1))).isFalse();
        assertThat(Polygons.overlap(square, Polygons.rectangle(1, 1, 2, 2))).isFalse();
        assertThat(Polygons.overlap(square, Polygons.rectangle(0.999, 0.999, 2, 2)))
                .isTrue();
        assertThat(Polygons.overlap(square, Polygons.rectangle(0.4, 0.4, 0.6, 0.6)))
                .isTrue();
        assertThat(Polygons.overlap(square, points(1.3, 0.8, 1.5, 1.5, 0.8, 1.3)))
                .isFalse();
    }
}
