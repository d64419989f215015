package io.troupe.demo.evaluate;

import de.erichseifert.vectorgraphics2d.VectorGraphics2D;
import de.erichseifert.vectorgraphics2d.svg.SVGProcessor;
import de.erichseifert.vectorgraphics2d.util.PageSize;
import java.awt.Color;
import java.awt.Font;
import java.awt.Graphics2D;
import java.awt.GraphicsEnvironment;
import java.awt.RenderingHints;
import java.awt.font.FontRenderContext;
import java.awt.image.BufferedImage;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.regex.Pattern;
import javax.imageio.ImageIO;
import org.jspecify.annotations.Nullable;
import org.knowm.xchart.CategoryChart;

/**
 * Writes charts side by side as SVG and PNG.
 *
 * <p><b>Errors.</b> {@link IOException} if a file cannot be written, or Java finds no font on this machine.
 */
final class FigurePainter {
    private static final int PANEL_WIDTH = 560;
    private static final int HEIGHT = 420;
    /** Pixels of the PNG for one of the drawing. */
    private static final int SCALE = 2;

    private static final Pattern FRACTION = Pattern.compile("(\\d\\.\\d\\d)\\d+");

    private FigurePainter() {}

    /** @throws IOException if there is no font to write with, which says what to do about it */
    static void checkFonts() throws IOException {
        try {
            if (GraphicsEnvironment.getLocalGraphicsEnvironment().getAvailableFontFamilyNames().length > 0) {
                new Font(Font.SANS_SERIF, Font.PLAIN, 12).getStringBounds("0", new FontRenderContext(null, true, true));
                return;
            }
        } catch (RuntimeException | LinkageError | InternalError unusable) {
            throw noFont(unusable);
        }
        throw noFont(null);
    }

    private static IOException noFont(@Nullable Throwable cause) {
        return new IOException(
                "the pictures cannot be drawn: Java finds no font on this machine; install one, for example the packages fontconfig and fonts-dejavu-core",
                cause);
    }

    static void write(List<CategoryChart> panels, Path directory, String name) throws IOException {
        int width = panels.size() * PANEL_WIDTH;
        var image = new BufferedImage(SCALE * width, SCALE * HEIGHT, BufferedImage.TYPE_INT_RGB);
        var pixels = image.createGraphics();
        pixels.scale(SCALE, SCALE);
        pixels.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_ON);
        paint(panels, pixels, width);
        pixels.dispose();
        ImageIO.write(image, "png", directory.resolve(name + ".png").toFile());

        var drawing = new VectorGraphics2D();
        paint(panels, drawing, width);
        var document = new SVGProcessor().getDocument(drawing.getCommands(), new PageSize(0, 0, width, HEIGHT));
        var svg = new ByteArrayOutputStream();
        document.writeTo(svg);
        Files.writeString(directory.resolve(name + ".svg"), shorter(svg.toString(StandardCharsets.UTF_8)));
    }

    /** Letters are written as outlines, with digits that nobody sees: a hundredth of a pixel is enough. */
    private static String shorter(String svg) {
        return FRACTION.matcher(svg).replaceAll("$1").replaceAll("(?m)^ +", "");
    }

    private static void paint(List<CategoryChart> panels, Graphics2D canvas, int width) {
        canvas.setColor(Color.WHITE);
        canvas.fillRect(0, 0, width, HEIGHT);
        for (int index = 0; index < panels.size(); index++) {
            var origin = canvas.getTransform();
            canvas.translate(index * PANEL_WIDTH, 0);
            panels.get(index).paint(canvas, PANEL_WIDTH, HEIGHT);
            canvas.setTransform(origin);
        }
    }
}
