package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import java.awt.image.BufferedImage;
import java.awt.image.ColorModel;
import java.awt.image.IndexColorModel;
import java.awt.image.Raster;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Iterator;
import java.util.List;
import javax.imageio.ImageIO;
import javax.imageio.ImageReader;
import javax.imageio.stream.ImageInputStream;

/** Reads an image file; a pixel is dark if its first channel (red, or gray) is in the lower half. */
final class BitmapFile {
    private static final long MOST_PIXELS = 16_000_000;
    private static final int BRIGHTEST_DARK = 127; // of 255

    private BitmapFile() {}

    /**
     * The dark pixels of a file; at least one.
     *
     * @param namedAt where the file is named
     */
    static Pixels read(Path file, SourcePosition namedAt) {
        if (!Files.isRegularFile(file)) {
            throw new WorldFileException(
                    namedAt, Files.exists(file) ? file + " is not a file" : "there is no file " + file);
        }
        try (ImageInputStream input = ImageIO.createImageInputStream(file.toFile())) {
            if (input == null) {
                throw new WorldFileException(namedAt, "cannot read " + file);
            }
            Pixels pixels = pixels(decode(input, file, namedAt));
            if (pixels.darkCount() == 0) {
                throw new WorldFileException(
                        namedAt,
                        "bitmap " + file + " has no dark pixel: walls are where the first channel is at most 127 of"
                                + " 255");
            }
            return pixels;
        } catch (IOException e) {
            throw unreadable(file, namedAt, e);
        }
    }

    private static BufferedImage decode(ImageInputStream input, Path file, SourcePosition namedAt) throws IOException {
        Iterator<ImageReader> readers = ImageIO.getImageReaders(input);
        if (!readers.hasNext()) {
            throw new WorldFileException(namedAt, file + " is no image of a known format: PNG, GIF, BMP or JPEG");
        }
        ImageReader reader = readers.next();
        try {
            reader.setInput(input, true, true);
            long width = reader.getWidth(0);
            long height = reader.getHeight(0);
            if (width * height > MOST_PIXELS) {
                throw new WorldFileException(
                        namedAt,
                        "bitmap " + file + " is too large: " + width + " x " + height + " pixels; the limit is "
                                + MOST_PIXELS + " in all");
            }
            List<String> damage = new ArrayList<>();
            reader.addIIOReadWarningListener((source, warning) -> damage.add(warning));
            BufferedImage image = reader.read(0);
            if (!damage.isEmpty()) {
                // a decoder that reaches the end of the file early returns the image so far, without the other
                // walls
                throw new WorldFileException(namedAt, "the image " + file + " is damaged: " + damage.getFirst());
            }
            return image;
        } catch (WorldFileException e) {
            throw e;
        } catch (RuntimeException e) {
            // exceptions of decoders for damaged files: bad indices, negative sizes, missing tables
            throw unreadable(file, namedAt, e);
        } finally {
            reader.dispose();
        }
    }

    private static WorldFileException unreadable(Path file, SourcePosition namedAt, Exception why) {
        return new WorldFileException(namedAt, "cannot read the image " + file + ": " + why);
    }

    private static Pixels pixels(BufferedImage image) {
        var pixels = new Pixels(image.getWidth(), image.getHeight());
        Raster raster = image.getRaster();
        ColorModel colours = image.getColorModel();
        int brightest = (1 << Math.min(30, raster.getSampleModel().getSampleSize(0))) - 1;
        int[] samples = new int[pixels.width];
        for (int row = 0; row < pixels.height; row++) {
            raster.getSamples(0, row, pixels.width, 1, 0, samples);
            for (int x = 0; x < pixels.width; x++) {
                // the stored values: getRGB would brighten gray images
                long level = colours instanceof IndexColorModel palette
                        ? palette.getRed(samples[x])
                        : samples[x] * 255L / brightest;
                if (level <= BRIGHTEST_DARK) {
                    pixels.darken(x, pixels.height - 1 - row);
                }
            }
        }
        return pixels;
    }
}
