package io.troupe.demo.svg;

import io.troupe.demo.terminal.OutputFiles;
import io.troupe.drawing.Svg;
import java.awt.BasicStroke;
import java.awt.Color;
import java.awt.Font;
import java.awt.Graphics2D;
import java.awt.GraphicsEnvironment;
import java.awt.RenderingHints;
import java.awt.font.FontRenderContext;
import java.awt.geom.Ellipse2D;
import java.awt.geom.Line2D;
import java.awt.geom.Rectangle2D;
import java.awt.image.BufferedImage;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.function.Consumer;
import javax.imageio.ImageIO;
import org.jspecify.annotations.Nullable;

/**
 * A drawing of lines, bars and text, written as SVG, where text stays text, and as PNG.
 *
 * <p><b>Units and shapes.</b> Pixels, y downwards. Colours are {@code 0x00RRGGBB}.
 */
public final class Chart {
    /** Position of a text relative to its point. */
    public enum Anchor {
        START("start", 0),
        MIDDLE("middle", 0.5),
        END("end", 1);

        private final String svg;
        private final double share;

        Anchor(String svg, double share) {
            this.svg = svg;
            this.share = share;
        }
    }

    /** Pixels of the PNG per pixel of the drawing. */
    private static final int SCALE = 2;

    private final int width;
    private final int height;
    private final Svg svg;
    private final List<Consumer<Graphics2D>> strokes = new ArrayList<>();

    public Chart(int width, int height, String title) {
        this.width = width;
        this.height = height;
        this.svg = Svg.page(width, height, 12, title);
    }

    public void line(double x1, double y1, double x2, double y2, int colour, double thick) {
        line(x1, y1, x2, y2, colour, thick, "");
    }

    /** @param dash alternating lengths of dashes and gaps, separated by blanks; "" is solid */
    public void line(double x1, double y1, double x2, double y2, int colour, double thick, String dash) {
        svg.add(
                "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"%.1f\""
                        + (dash.isEmpty() ? "" : " stroke-dasharray=\"" + dash + "\"") + "/>\n",
                x1,
                y1,
                x2,
                y2,
                hex(colour),
                thick);
        strokes.add(canvas -> {
            canvas.setColor(new Color(colour));
            canvas.setStroke(
                    dash.isEmpty()
                            ? new BasicStroke((float) thick)
                            : new BasicStroke((float) thick, 0, 0, 10, lengths(dash), 0));
            canvas.draw(new Line2D.Double(x1, y1, x2, y2));
        });
    }

    private static float[] lengths(String dash) {
        String[] words = dash.split(" ");
        float[] lengths = new float[words.length];
        for (int i = 0; i < words.length; i++) {
            lengths[i] = Float.parseFloat(words[i]);
        }
        return lengths;
    }

    public void bar(double x, double y, double wide, double high, int colour) {
        svg.add(
                "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\"/>\n",
                x, y, wide, high, hex(colour));
        strokes.add(canvas -> {
            canvas.setColor(new Color(colour));
            canvas.fill(new Rectangle2D.Double(x, y, wide, high));
        });
    }

    public void dot(double x, double y, double radius, int colour) {
        svg.add("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"%s\"/>\n", x, y, radius, hex(colour));
        strokes.add(canvas -> {
            canvas.setColor(new Color(colour));
            canvas.fill(new Ellipse2D.Double(x - radius, y - radius, 2 * radius, 2 * radius));
        });
    }

    public void text(double x, double y, int sizePx, Anchor anchor, int colour, String words) {
        svg.text(
                x,
                y,
                "font-size=\"" + sizePx + "\" text-anchor=\"" + anchor.svg + "\" fill=\"" + hex(colour) + "\"",
                words);
        strokes.add(canvas -> {
            canvas.setColor(new Color(colour));
            canvas.setFont(new Font(Font.SANS_SERIF, Font.PLAIN, sizePx));
            double wide = canvas.getFontMetrics().getStringBounds(words, canvas).getWidth();
            canvas.drawString(words, (float) (x - anchor.share * wide), (float) y);
        });
    }

    public String svg() {
        return svg.end();
    }

    private static String hex(int colour) {
        return String.format(Locale.ROOT, "#%06x", colour);
    }

    /** An image of twice the size of the drawing, for high-resolution screens. */
    public BufferedImage image() {
        var image = new BufferedImage(SCALE * width, SCALE * height, BufferedImage.TYPE_INT_RGB);
        Graphics2D canvas = image.createGraphics();
        canvas.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_ON);
        canvas.setRenderingHint(RenderingHints.KEY_STROKE_CONTROL, RenderingHints.VALUE_STROKE_PURE);
        canvas.scale(SCALE, SCALE);
        canvas.setColor(Color.WHITE);
        canvas.fillRect(0, 0, width, height);
        strokes.forEach(stroke -> stroke.accept(canvas));
        canvas.dispose();
        return image;
    }

    /** @throws IOException if Java finds no font for the PNG; the message explains how to fix it */
    public static void checkFonts() throws IOException {
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

    /**
     * Writes {@code name.svg} and {@code name.png}.
     *
     * @throws IOException if a file cannot be written, or Java finds no font on this machine
     */
    public void write(Path directory, String name) throws IOException {
        checkFonts();
        OutputFiles.write(directory.resolve(name + ".svg"), svg());
        var png = new ByteArrayOutputStream();
        ImageIO.write(image(), "png", png);
        OutputFiles.write(directory.resolve(name + ".png"), png.toByteArray());
    }
}
