package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Shape;
import java.awt.image.BufferedImage;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.List;
import java.util.Random;
import javax.imageio.ImageIO;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

class BitmapsTest {
    @TempDir
    private Path dir;

    private Worlds worlds;

    @BeforeEach
    void files() {
        worlds = new Worlds(dir);
    }

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

    private void write(String name, BufferedImage image) {
        try {
            String format = name.substring(name.indexOf('.') + 1);
            assertThat(ImageIO.write(image, format, worlds.file(name).toFile()))
                    .as(name)
                    .isTrue();
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    private Shape shape(String... rows) {
        write("t.png", image(BufferedImage.TYPE_BYTE_BINARY, rows));
        Box box = darkBox(rows);
        return worlds.world("model ( bitmap \"t.png\" size [ " + box.width() + " " + box.height() + " ] )")
                .obstacles()
                .getFirst()
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
    void darkPixels_fillTheSize_topRowUp() {
        write("l.png", image(BufferedImage.TYPE_INT_RGB, ".....", ".#...", ".#...", ".##..", "....."));

        Shape shape = worlds.world("model ( bitmap \"l.png\" size [ 4 3 1 ] pose [ 7 0 0 0 ] )")
                .obstacles()
                .getFirst()
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
    void hole_hasALineOfItsOwn_clockwise() {
        Shape shape = shape("####", "#..#", "####");

        assertThat(shape.outlines()).hasSize(2);
        assertThat(shape.outlines()).extracting(Polygons::signedArea).containsExactlyInAnyOrder(12.0, -2.0);
        assertThat(shape.polygons()).hasSize(4);
    }

    @Test
    void pixels_thatShareACornerOnly_areApart() {
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
            assertThat(lines.stream().mapToDouble(BitmapsTest::length).sum())
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
    void formats_thatImageIoReads_giveTheSameWall(String name) {
        var image = new BufferedImage(32, 16, BufferedImage.TYPE_INT_RGB);
        for (int i = 0; i < 32 * 16; i++) {
            image.setRGB(i % 32, i / 32, i % 32 < 16 ? 0x000000 : 0xffffff);
        }
        write(name, image);

        Shape shape = worlds.world("model ( bitmap \"" + name + "\" size [ 2 2 ] )")
                .obstacles()
                .getFirst()
                .shape();

        assertThat(shape.polygons()).containsExactly(Polygons.rectangle(-1, -1, 1, 1));
    }

    @ParameterizedTest
    @CsvSource({"10,127,1", "10,128,0", "5,127,1", "5,128,0"})
    void level_of127Of255_isTheBrightestDark(int imageType, int level, int dark) {
        // type 10 is gray, whose levels getRGB would brighten; type 5 has three channels, of which the first
        // counts
        var image = new BufferedImage(2, 1, imageType);
        int[] levels = {level, 255, 255};
        image.getRaster().setPixel(0, 0, Arrays.copyOf(levels, image.getRaster().getNumBands()));
        image.getRaster().setPixel(1, 0, new int[image.getRaster().getNumBands()]);
        write("t.png", image);

        Pixels pixels = BitmapFile.read(worlds.file("t.png"), new SourcePosition(dir, 1, 1));

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

    @Test
    void bitmap_thatIsNoWall_isRefusedWhereItIsNamed() throws Exception {
        Files.writeString(worlds.file("text.png"), "no image");
        write("white.png", image(BufferedImage.TYPE_INT_RGB, "...", "..."));
        write("dot.png", image(BufferedImage.TYPE_INT_RGB, "#"));
        byte[] whole = Files.readAllBytes(worlds.file("white.png"));
        write("cave.png", image(BufferedImage.TYPE_INT_RGB, "#.#", ".#."));
        byte[] cave = Files.readAllBytes(worlds.file("cave.png"));
        Files.write(worlds.file("half.png"), Arrays.copyOf(cave, 45));
        Files.write(worlds.file("head.png"), Arrays.copyOf(cave, 20));
        whole[16] = 0x70; // the first byte of the width
        Files.write(worlds.file("huge.png"), whole);

        assertThat(problem("gone.png", "")).isEqualTo("t.world:1:16: there is no file gone.png");
        assertThat(problem("", "block ( point[0] [ 0 0 ] point[1] [ 1 0 ] point[2] [ 1 1 ] )"))
                .isEqualTo("none");
        assertThat(problem("text.png", ""))
                .isEqualTo("t.world:1:16: text.png is no image of a known format: PNG, GIF, BMP or JPEG");
        assertThat(problem("white.png", ""))
                .isEqualTo("t.world:1:16: bitmap white.png has no dark pixel: walls are where the first channel is at"
                        + " most 127 of 255");
        assertThat(problem("half.png", "")).startsWith("t.world:1:16: ").contains("the image half.png");
        assertThat(problem("head.png", "")).startsWith("t.world:1:16: cannot read the image head.png: ");
        assertThat(problem("huge.png", ""))
                .startsWith("t.world:1:16: bitmap huge.png is too large: 1879048195 x 2 pixels; the limit is 16000000");
        assertThat(problem("dot.png", "block ( point[0] [ 0 0 ] point[1] [ 1 0 ] point[2] [ 1 1 ] )"))
                .isEqualTo(
                        "t.world:1:16: a model has a \"bitmap\" or blocks, not both; the first block is at t.world:1:26");
    }

    private String problem(String bitmap, String more) {
        String text = "model ( bitmap \"" + bitmap + "\" " + more + " )";
        if (bitmap.isEmpty()) {
            assertThat(worlds.world(text).obstacles()).hasSize(1);
            return "none";
        }
        return worlds.problem(text);
    }

    @Test
    void bitmap_isSoughtBesideTheFileThatNamesIt() throws Exception {
        Files.createDirectories(worlds.file("sub"));
        write("sub/dot.png".replace("sub/", ""), image(BufferedImage.TYPE_INT_RGB, "#"));
        Files.move(worlds.file("dot.png"), worlds.file("sub/dot.png"));
        worlds.write("sub/map.inc", "define floorplan model ( bitmap \"dot.png\" boundary 1 color \"gray30\" )");

        Shape shape = worlds.world("include \"sub/map.inc\" floorplan ( size [ 4 4 ] )")
                .obstacles()
                .getFirst()
                .shape();

        assertThat(shape.polygons()).hasSize(5);
    }
}
