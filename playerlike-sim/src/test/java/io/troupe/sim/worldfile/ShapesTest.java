package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Shape;
import java.awt.image.BufferedImage;
import java.io.IOException;
import java.nio.file.Files;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;
import java.util.Random;
import java.util.stream.IntStream;
import javax.imageio.ImageIO;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** Outlines that are cut into convex pieces, and those of bitmaps. */
class ShapesTest extends WorldFiles {
    private static List<Point> points(double... coordinates) {
        return IntStream.range(0, coordinates.length / 2)
                .mapToObj(i -> new Point(coordinates[2 * i], coordinates[2 * i + 1]))
                .toList();
    }

    private static List<Point> regular(int corners) {
        return IntStream.range(0, corners)
                .mapToDouble(i -> 2 * Math.PI * i / corners)
                .mapToObj(angle -> new Point(Math.cos(angle), Math.sin(angle)))
                .toList();
    }

    private static void assertIsCutIntoConvexPieces(List<Point> polygon, String what) {
        assertCovers(ConvexPieces.of(polygon), polygon, what);
    }

    /**
     * Asserts that the pieces are convex, counter-clockwise, of 3 to 8 corners, without overlap, and of the same total
     * area.
     */
    private static void assertCovers(List<List<Point>> pieces, List<Point> polygon, String what) {
        double area = 0;
        for (List<Point> piece : pieces) {
            assertThat(piece).as(what).hasSizeBetween(3, 8);
            for (int i = 0; i < piece.size(); i++) {
                Point a = piece.get(i);
                Point b = piece.get((i + 1) % piece.size());
                Point c = piece.get((i + 2) % piece.size());
                assertThat(Polygons.turn(a, b, c)).as(what).isPositive();
            }
            area += Polygons.signedArea(piece);
        }
        for (int i = 0; i < pieces.size(); i++) {
            for (int j = 0; j < i; j++) {
                assertThat(Polygons.overlap(pieces.get(i), pieces.get(j)))
                        .as(what)
                        .isFalse();
            }
        }
        assertThat(area).as(what).isCloseTo(Math.abs(Polygons.signedArea(polygon)), within(1e-9));
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
        assertCovers(pieces, regular(corners), corners + " corners");
        // every piece of 8 takes 6 triangles of corners - 2
        assertThat(pieces).hasSizeLessThanOrEqualTo((corners - 2 + 5) / 6 + 1);
    }

    @Test
    void corner_onAStraightLine_isLeftOut_andSoIsAPolygonThinnerThanAMicrometre() {
        assertThat(ConvexPieces.of(points(0, 0, 1, 0, 2, 0, 2, 2, 0, 2, 0, 1)))
                .containsExactly(points(0, 0, 2, 0, 2, 2, 0, 2));
        assertThat(ConvexPieces.of(points(0, 0, 1, 0, 1, 1e-8))).isEmpty();
    }

    @Test
    void combDrawnEitherWay_andBayWhoseCornersLieOnOneLine_areCutIntoConvexPieces() {
        List<Point> comb =
                points(0, 0, 7, 0, 7, 3, 6, 3, 6, 1, 5, 1, 5, 3, 4, 3, 4, 1, 3, 1, 3, 3, 2, 3, 2, 1, 1, 1, 1, 3, 0, 3);
        assertIsCutIntoConvexPieces(comb, "comb");
        assertIsCutIntoConvexPieces(comb.reversed(), "comb, clockwise");
        List<Point> bay = points(0, 0, 3, 0, 3, 3, 0, 3, 0, 2, 1, 2, 1, 1, 0, 1);
        for (int turn = 0; turn < bay.size(); turn++) {
            var turned = new ArrayList<>(bay);
            Collections.rotate(turned, turn);
            assertIsCutIntoConvexPieces(turned, "bay, turned by " + turn);
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
                skyline.addAll(points(x, height, x + 1, height));
            }
            for (int x = width; x > 0; x--) {
                int depth = -random.nextInt(3);
                skyline.addAll(points(x, depth, x - 1, depth));
            }
            String what = "seed " + seed + ", round " + round;
            assertThat(ConvexPieces.of(skyline)).as(what).isNotEmpty();
            assertIsCutIntoConvexPieces(skyline, what);
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
            assertIsCutIntoConvexPieces(star, "seed " + seed + ", round " + round);
        }
    }

    @Test
    void polygons_touching_doNotOverlap() {
        List<Point> square = Polygons.rectangle(0, 0, 1, 1);
        assertThat(List.of(Polygons.rectangle(1, 0, 2, 1), Polygons.rectangle(1, 1, 2, 2)))
                .noneMatch(other -> Polygons.overlap(square, other));
        assertThat(List.of(Polygons.rectangle(0.999, 0.999, 2, 2), Polygons.rectangle(0.4, 0.4, 0.6, 0.6)))
                .allMatch(other -> Polygons.overlap(square, other));
        assertThat(Polygons.overlap(square, points(1.3, 0.8, 1.5, 1.5, 0.8, 1.3)))
                .isFalse();
    }

    // ---- bitmaps

    private static final String BLOCK = "block ( point[0] [ 0 0 ] point[1] [ 1 0 ] point[2] [ 1 1 ] )";

    /** Rows from top to bottom, {@code #} is dark. */
    private static BufferedImage image(int type, String... rows) {
        var image = new BufferedImage(rows[0].length(), rows.length, type);
        for (int y = 0; y < rows.length; y++) {
            for (int x = 0; x < rows[y].length(); x++) {
                image.setRGB(x, y, rows[y].charAt(x) == '#' ? 0xff000000 : 0xffffffff);
            }
        }
        return image;
    }

    private void save(String name, BufferedImage image) throws IOException {
        String format = name.substring(name.indexOf('.') + 1);
        assertThat(ImageIO.write(image, format, file(name).toFile())).as(name).isTrue();
    }

    private void draw(String name, String... rows) throws IOException {
        save(name, image(BufferedImage.TYPE_INT_RGB, rows));
    }

    private Shape shape(String... rows) throws IOException {
        save("t.png", image(BufferedImage.TYPE_BYTE_BINARY, rows));
        Box box = darkBox(rows);
        return obstacle("model ( bitmap \"t.png\" size [ " + box.width() + " " + box.height() + " ] )")
                .shape();
    }

    private static Box darkBox(String... rows) {
        Box box = Box.NOTHING;
        for (int y = 0; y < rows.length; y++) {
            for (int x = 0; x < rows[y].length(); x++) {
                box = rows[y].charAt(x) == '#' ? box.union(new Box(x, y, x + 1, y + 1)) : box;
            }
        }
        return box;
    }

    private static double area(List<List<Point>> rings) {
        return rings.stream().mapToDouble(Polygons::signedArea).sum();
    }

    @Test
    void darkPixels_fillTheSize_topRowUp() throws IOException {
        draw("l.png", ".....", ".#...", ".#...", ".##..", ".....");
        Shape shape = obstacle("model ( bitmap \"l.png\" size [ 4 3 1 ] pose [ 7 0 0 0 ] )")
                .shape();
        assertThat(shape.outlines())
                .containsExactly(List.of(
                        new Point(2, -1.5),
                        new Point(2, -0.5),
                        new Point(0, -0.5),
                        new Point(0, 1.5),
                        new Point(-2, 1.5),
                        new Point(-2, -1.5)));
        assertThat(shape.polygons())
                .containsExactlyInAnyOrder(Polygons.rectangle(-2, -1.5, 2, -0.5), Polygons.rectangle(-2, -0.5, 0, 1.5));
    }

    @Test
    void hole_hasALineOfItsOwn_clockwise_andPixelsThatShareACornerOnlyAreApart() throws IOException {
        Shape shape = shape("####", "#..#", "####");
        assertThat(shape.outlines()).extracting(Polygons::signedArea).containsExactlyInAnyOrder(12.0, -2.0);
        assertThat(shape.polygons()).hasSize(4);
        assertThat(shape("#.", ".#").outlines())
                .hasSize(2)
                .allSatisfy(line -> assertThat(line).hasSize(4));
        assertThat(shape("##.", "#.#", "###").outlines()).hasSize(1);
        assertThat(shape("##", "##").polygons()).hasSize(1);
    }

    @Test
    void regions_ofRandomPixels_areCoveredOnceAndOutlinedExactly() {
        long seed = 20_260_301;
        var random = new Random(seed);
        for (int round = 0; round < 200; round++) {
            int width = 1 + random.nextInt(9);
            int height = 1 + random.nextInt(9);
            var pixels = new Pixels(width, height);
            for (int i = random.nextInt(width * height); i >= 0; i--) {
                pixels.darken(random.nextInt(width), random.nextInt(height));
            }
            String what = "seed " + seed + ", round " + round;
            int[] covered = new int[width * height];
            for (Box box : pixels.rectangles()) {
                for (int y = (int) box.minY(); y < box.maxY(); y++) {
                    for (int x = (int) box.minX(); x < box.maxX(); x++) {
                        covered[y * width + x]++;
                    }
                }
            }
            List<List<Point>> lines = pixels.outlines();
            for (int i = 0; i < covered.length; i++) {
                int x = i % width;
                int y = i / width;
                assertThat(covered[i]).as(what).isEqualTo(pixels.isDark(x, y) ? 1 : 0);
                assertThat(windings(lines, x + 0.5, y + 0.5)).as(what).isEqualTo(pixels.isDark(x, y) ? 1 : 0);
            }
            assertThat(area(lines)).as(what).isEqualTo(pixels.darkCount());
            assertThat(lines.stream().mapToDouble(ShapesTest::length).sum())
                    .as("no line inside a region, " + what)
                    .isEqualTo(edges(pixels));
        }
    }

    private static double length(List<Point> ring) {
        double length = 0;
        for (int i = 0; i < ring.size(); i++) {
            length += Polygons.distance(ring.get(i), ring.get((i + 1) % ring.size()));
        }
        return length;
    }

    private static int edges(Pixels pixels) {
        int edges = 0;
        for (int y = 0; y <= pixels.height; y++) {
            for (int x = 0; x <= pixels.width; x++) {
                edges += pixels.isDark(x, y) != pixels.isDark(x - 1, y) ? 1 : 0;
                edges += pixels.isDark(x, y) != pixels.isDark(x, y - 1) ? 1 : 0;
            }
        }
        return edges;
    }

    /** Winding number of the lines around a point, counted along a ray to the right. */
    private static int windings(List<List<Point>> lines, double x, double y) {
        int windings = 0;
        for (List<Point> line : lines) {
            for (int i = 0; i < line.size(); i++) {
                Point a = line.get(i);
                Point b = line.get((i + 1) % line.size());
                if (a.x() > x && Math.min(a.y(), b.y()) < y && Math.max(a.y(), b.y()) > y) {
                    windings += b.y() > a.y() ? 1 : -1;
                }
            }
        }
        return windings;
    }

    @ParameterizedTest
    @ValueSource(strings = {"t.png", "t.gif", "t.bmp", "t.jpg"})
    void formats_thatImageIoReads_giveTheSameWall(String name) throws IOException {
        String row = "#".repeat(16) + ".".repeat(16);
        draw(name, Collections.nCopies(16, row).toArray(String[]::new));
        assertThat(obstacle("model ( bitmap \"" + name + "\" size [ 2 2 ] )")
                        .shape()
                        .polygons())
                .containsExactly(Polygons.rectangle(-1, -1, 1, 1));
    }

    @ParameterizedTest
    @CsvSource({"10,127,1", "10,128,0", "5,127,1", "5,128,0"})
    void level_of127Of255_isTheBrightestDark(int imageType, int level, int dark) throws IOException {
        // type 10 is gray, whose levels getRGB would brighten; type 5 has three channels, of which the first counts
        var image = new BufferedImage(2, 1, imageType);
        int[] levels = {level, 255, 255};
        image.getRaster().setPixel(0, 0, Arrays.copyOf(levels, image.getRaster().getNumBands()));
        image.getRaster().setPixel(1, 0, new int[image.getRaster().getNumBands()]);
        save("t.png", image);
        Pixels pixels = BitmapFile.read(file("t.png"), new SourcePosition(dir, 1, 1), Diagnostics.logged());
        assertThat(pixels.darkCount()).isEqualTo(1 + dark);
    }

    @Test
    void cave_of500By500_givesFewPieces() {
        var pixels = new Pixels(500, 500);
        for (int y = 0; y < 500; y++) {
            for (int x = 0; x < 500; x++) {
                double wave = Math.sin(x / 25.0) + Math.cos(y / 30.0) + Math.sin((x + y) / 40.0);
                if (wave > 1.2 || x < 4 || y < 4 || x > 495 || y > 495) {
                    pixels.darken(x, y);
                }
            }
        }

        assertThat(pixels.rectangles()).hasSizeLessThan(2500);
        assertThat(area(pixels.outlines())).isCloseTo(pixels.darkCount(), within(1e-9));
    }

    private String problem(String bitmap, String more) {
        return problem("model ( bitmap \"" + bitmap + "\" " + more + " )");
    }

    @Test
    void bitmap_thatIsNoWall_isRefusedWhereItIsNamed() throws IOException {
        write("text.png", "no image");
        draw("white.png", "...", "...");
        draw("dot.png", "#");
        draw("cave.png", "#.#", ".#.");
        byte[] cave = Files.readAllBytes(file("cave.png"));
        Files.write(file("half.png"), Arrays.copyOf(cave, 45));
        Files.write(file("head.png"), Arrays.copyOf(cave, 20));
        byte[] huge = Files.readAllBytes(file("white.png"));
        huge[16] = 0x70; // the first byte of the width
        Files.write(file("huge.png"), huge);
        assertThat(problem("gone.png", "")).startsWith("t.world:1:16: there is no file gone.png; looked in ");
        assertThat(world("model ( bitmap \"\" " + BLOCK + " )").obstacles()).hasSize(1);
        assertThat(problem("text.png", ""))
                .isEqualTo(
                        "t.world:1:16: text.png is no image of a known format: PNG, GIF, BMP, JPEG, PGM, PBM or PPM");
        assertThat(problem("white.png", ""))
                .isEqualTo("t.world:1:16: bitmap white.png has no dark pixel: walls are where the first channel is at"
                        + " most 127 of 255");
        assertThat(problem("half.png", "")).startsWith("t.world:1:16: ").contains("the image half.png");
        assertThat(problem("head.png", "")).startsWith("t.world:1:16: cannot read the image head.png: ");
        assertThat(problem("huge.png", ""))
                .startsWith(
                        "t.world:1:16: bitmap huge.png is too large: 1879048195 x 2 pixels; the limit is 400000000");
        assertThat(problem("dot.png", BLOCK))
                .isEqualTo(
                        "t.world:1:16: a model has a \"bitmap\" or blocks, not both; the first block is at t.world:1:26");
    }

    @Test
    void bitmap_isSoughtBesideTheFileThatNamesIt() throws IOException {
        Files.createDirectories(file("sub"));
        draw("sub/dot.png", "#");
        write("sub/map.inc", "define floorplan model ( bitmap \"dot.png\" boundary 1 color \"gray30\" )");
        assertThat(obstacle("include \"sub/map.inc\" floorplan ( size [ 4 4 ] )")
                        .shape()
                        .polygons())
                .hasSize(5);
    }
}
