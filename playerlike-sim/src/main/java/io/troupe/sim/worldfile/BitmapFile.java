package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import java.awt.Rectangle;
import java.awt.image.BufferedImage;
import java.awt.image.ColorModel;
import java.awt.image.IndexColorModel;
import java.awt.image.Raster;
import java.io.IOException;
import java.io.InputStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Iterator;
import java.util.List;
import javax.imageio.ImageIO;
import javax.imageio.ImageReadParam;
import javax.imageio.ImageReader;
import javax.imageio.stream.ImageInputStream;

/**
 * Reads an image file; a pixel is dark if its first channel (red, or gray) is in the lower half.
 *
 * <p><b>Cost.</b> At most {@value #MOST_PIXELS} pixels are kept, and decoded at a time. A larger image is read at a
 * lower resolution: a pixel is then dark if any of those that it stands for is, so that no wall gets lost.
 */
final class BitmapFile {
    private static final long MOST_PIXELS = 16_000_000;
    private static final long MOST_PIXELS_OF_A_FILE = 400_000_000;
    private static final int BRIGHTEST_DARK = 127; // of 255

    private final Path file;
    private final SourcePosition namedAt;
    private final int height;
    private final int shrink;
    private final Pixels pixels;

    private BitmapFile(Path file, SourcePosition namedAt, int width, int height, Diagnostics diagnostics) {
        this.file = file;
        this.namedAt = namedAt;
        this.height = height;
        long all = (long) width * height;
        if (all > MOST_PIXELS_OF_A_FILE) {
            throw new WorldFileException(
                    namedAt,
                    "bitmap " + file + " is too large: " + width + " x " + height + " pixels; the limit is "
                            + MOST_PIXELS_OF_A_FILE + " in all");
        }
        shrink = (int) StrictMath.ceil(StrictMath.sqrt((double) all / MOST_PIXELS));
        if (shrink > 1) {
            diagnostics.warn(
                    namedAt,
                    "bitmap " + file + " has " + width + " x " + height + " pixels and is read at 1/" + shrink
                            + " of its resolution: walls may be "
                            + (shrink == 2 ? "1 pixel" : shrink - 1 + " pixels") + " thicker");
        }
        pixels = new Pixels(Math.ceilDiv(width, shrink), Math.ceilDiv(height, shrink));
    }

    /**
     * The dark pixels of a file; at least one.
     *
     * @param namedAt where the file is named
     */
    static Pixels read(Path file, SourcePosition namedAt, Diagnostics diagnostics) {
        if (!Files.isRegularFile(file)) {
            throw new WorldFileException(
                    namedAt, Files.exists(file) ? file + " is not a file" : "there is no file " + file);
        }
        try {
            Pixels pixels = decode(file, namedAt, diagnostics);
            if (pixels.darkCount() == 0) {
                throw new WorldFileException(
                        namedAt,
                        "bitmap " + file + " has no dark pixel: walls are where the first channel is at most 127 of"
                                + " 255");
            }
            return pixels;
        } catch (IOException e) {
            throw unreadable(file, namedAt, String.valueOf(e));
        } catch (PnmImage.DamagedException e) {
            throw unreadable(file, namedAt, String.valueOf(e.getMessage()));
        }
    }

    private static Pixels decode(Path file, SourcePosition namedAt, Diagnostics diagnostics)
            throws IOException, PnmImage.DamagedException {
        try (InputStream stream = Files.newInputStream(file)) {
            if (PnmImage.isOne(stream.readNBytes(3))) {
                try (InputStream whole = Files.newInputStream(file)) {
                    PnmImage image = PnmImage.open(whole);
                    var bitmap = new BitmapFile(file, namedAt, image.width(), image.height(), diagnostics);
                    image.rows(bitmap::row);
                    return bitmap.pixels;
                }
            }
        }
        try (ImageInputStream input = ImageIO.createImageInputStream(file.toFile())) {
            if (input == null) {
                throw new WorldFileException(namedAt, "cannot read " + file);
            }
            return decode(input, file, namedAt, diagnostics);
        }
    }

    private static Pixels decode(ImageInputStream input, Path file, SourcePosition namedAt, Diagnostics diagnostics)
            throws IOException {
        Iterator<ImageReader> readers = ImageIO.getImageReaders(input);
        if (!readers.hasNext()) {
            throw new WorldFileException(
                    namedAt, file + " is no image of a known format: PNG, GIF, BMP, JPEG, PGM, PBM or PPM");
        }
        ImageReader reader = readers.next();
        try {
            reader.setInput(input, false, true);
            var bitmap = new BitmapFile(file, namedAt, reader.getWidth(0), reader.getHeight(0), diagnostics);
            bitmap.strips(reader);
            return bitmap.pixels;
        } catch (WorldFileException e) {
            throw e;
        } catch (RuntimeException e) {
            // exceptions of decoders for damaged files: bad indices, negative sizes, missing tables
            throw unreadable(file, namedAt, String.valueOf(e));
        } finally {
            reader.dispose();
        }
    }

    /** Decodes as many rows at a time as the limit allows. */
    private void strips(ImageReader reader) throws IOException {
        List<String> damage = new ArrayList<>();
        reader.addIIOReadWarningListener((source, warning) -> damage.add(warning));
        int width = reader.getWidth(0);
        int rows = shrink == 1 ? height : (int) Math.max(1, MOST_PIXELS / width);
        for (int top = 0; top < height; top += rows) {
            ImageReadParam part = reader.getDefaultReadParam();
            if (shrink > 1) {
                part.setSourceRegion(new Rectangle(0, top, width, Math.min(rows, height - top)));
            }
            BufferedImage image = reader.read(0, part);
            if (!damage.isEmpty()) {
                // a decoder that reaches the end of the file early returns the walls so far
                throw new WorldFileException(namedAt, "the image " + file + " is damaged: " + damage.getFirst());
            }
            strip(image, top);
        }
    }

    private static WorldFileException unreadable(Path file, SourcePosition namedAt, String why) {
        return new WorldFileException(namedAt, "cannot read the image " + file + ": " + why);
    }

    private void strip(BufferedImage image, int top) {
        Raster raster = image.getRaster();
        ColorModel colours = image.getColorModel();
        int brightest = (1 << Math.min(30, raster.getSampleModel().getSampleSize(0))) - 1;
        int[] samples = new int[image.getWidth()];
        for (int row = 0; row < image.getHeight(); row++) {
            raster.getSamples(0, row, samples.length, 1, 0, samples);
            if (colours instanceof IndexColorModel palette) {
                for (int x = 0; x < samples.length; x++) {
                    samples[x] = palette.getRed(samples[x]);
                }
            }
            // the stored values: getRGB would brighten gray images
            row(top + row, samples, colours instanceof IndexColorModel ? 255 : brightest);
        }
    }

    private void row(int row, int[] levels, int brightest) {
        for (int x = 0; x < levels.length; x++) {
            if (levels[x] * 255L / brightest <= BRIGHTEST_DARK) {
                pixels.darken(x / shrink, (height - 1 - row) / shrink);
            }
        }
    }
}
