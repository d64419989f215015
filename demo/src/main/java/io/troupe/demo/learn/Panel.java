package io.troupe.demo.learn;

import io.troupe.drawing.Svg;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.WorldSpec;
import java.util.List;
import java.util.Locale;
import java.util.stream.Collectors;

/**
 * A rectangle of a picture in which values are drawn: points of a chart, or places of a world.
 *
 * <p><b>Units and shapes.</b> Values with y upwards; pixels with y downwards. A line or dot with values outside of the
 * panel is cut off at its edge by the caller.
 */
final class Panel {
    static final String INK = "#222222";
    static final String GREY = "#8a8a8a";
    private static final String GRID = "#dddddd";
    private static final double MAP_MARGIN_M = 0.2;
    private static final double BOLD_PX = 13; // bold letters of 12 px are as wide

    private final Svg svg;
    private final double leftPx;
    private final double topPx;
    private final double widthPx;
    private final double heightPx;
    private final double minX;
    private final double minY;
    private final double maxX;
    private final double maxY;

    private Panel(
            Svg svg,
            double leftPx,
            double topPx,
            double widthPx,
            double heightPx,
            double minX,
            double minY,
            double maxX,
            double maxY) {
        this.svg = svg;
        this.leftPx = leftPx;
        this.topPx = topPx;
        this.widthPx = widthPx;
        this.heightPx = heightPx;
        this.minX = minX;
        this.minY = minY;
        this.maxX = maxX;
        this.maxY = maxY;
    }

    /** A chart with a grid, whose axes have labels at round steps. */
    static Panel chart(
            Svg svg,
            double leftPx,
            double topPx,
            double widthPx,
            double heightPx,
            Point least,
            Point most,
            String nameOfX,
            String nameOfY) {
        var panel = new Panel(svg, leftPx, topPx, widthPx, heightPx, least.x(), least.y(), most.x(), most.y());
        panel.grid(nameOfX, nameOfY);
        return panel;
    }

    /** A square with a world and its bodies, seen from above. */
    static Panel map(Svg svg, double leftPx, double topPx, double sidePx, WorldSpec world) {
        List<Point> corners = world.obstacles().stream()
                .flatMap(each ->
                        each.shape().outlines().stream().flatMap(List::stream).map(each.pose()::place))
                .toList();
        double halfM = corners.stream()
                        .mapToDouble(corner -> Math.max(Math.abs(corner.x()), Math.abs(corner.y())))
                        .max()
                        .orElse(1)
                + MAP_MARGIN_M;
        var panel = new Panel(svg, leftPx, topPx, sidePx, sidePx, -halfM, -halfM, halfM, halfM);
        for (ObstacleSpec obstacle : world.obstacles()) {
            for (List<Point> outline : obstacle.shape().outlines()) {
                svg.add(
                        "<polygon points=\"%s\" fill=\"%s\"/>\n",
                        panel.points(
                                outline.stream().map(obstacle.pose()::place).toList()),
                        Svg.colour(obstacle.colour()));
            }
        }
        return panel;
    }

    private void grid(String nameOfX, String nameOfY) {
        double stepX = Svg.roundStep((maxX - minX) / 8);
        for (double at = Math.ceil(minX / stepX) * stepX; at <= maxX + stepX / 1000; at += stepX) {
            straight(x(at), topPx, x(at), topPx + heightPx, GRID);
            svg.text(x(at), topPx + heightPx + 16, "text-anchor=\"middle\"", Svg.number(at, 2));
        }
        double stepY = Svg.roundStep((maxY - minY) / 7);
        for (double at = Math.ceil(minY / stepY) * stepY; at <= maxY + stepY / 1000; at += stepY) {
            straight(leftPx, y(at), leftPx + widthPx, y(at), GRID);
            svg.text(leftPx - 6, y(at) + 4, "text-anchor=\"end\"", Svg.number(at, 2));
        }
        svg.text(leftPx + widthPx / 2, topPx + heightPx + 36, "text-anchor=\"middle\"", nameOfX);
        svg.text(leftPx - 30, topPx - 12, "", nameOfY);
    }

    private void straight(double x1, double y1, double x2, double y2, String colour) {
        svg.add("<line x1=\"%s\" y1=\"%s\" x2=\"%s\" y2=\"%s\" stroke=\"%s\"/>\n", x1, y1, x2, y2, colour);
    }

    private double x(double value) {
        return leftPx + (value - minX) / (maxX - minX) * widthPx;
    }

    private double y(double value) {
        return topPx + heightPx - (value - minY) / (maxY - minY) * heightPx;
    }

    private String points(List<Point> values) {
        return values.stream()
                .map(value -> String.format(Locale.ROOT, "%.1f,%.1f", x(value.x()), y(value.y())))
                .collect(Collectors.joining(" "));
    }

    void line(List<Point> values, String colour, double thickPx) {
        svg.add(
                "<polyline points=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"%s\"/>\n",
                points(values), colour, thickPx);
    }

    void dashes(List<Point> values, String colour) {
        svg.add(
                "<polyline points=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"1.5\" stroke-dasharray=\"6 4\"/>\n",
                points(values), colour);
    }

    /** Explains a dashed line above the right corner, where no dot is. */
    void keyOfDashes(String colour, String words) {
        double right = leftPx + widthPx;
        double sampleEnd = right - Svg.width(words, BOLD_PX) - 8;
        svg.add(
                "<line x1=\"%s\" y1=\"%s\" x2=\"%s\" y2=\"%s\" stroke=\"%s\" stroke-width=\"1.5\" stroke-dasharray=\"6 4\"/>\n",
                sampleEnd - 34, topPx - 16, sampleEnd, topPx - 16, colour);
        svg.text(right, topPx - 12, "text-anchor=\"end\" fill=\"" + colour + "\" font-weight=\"bold\"", words);
    }

    void dot(Point value, String colour, double radiusPx) {
        svg.add("<circle cx=\"%s\" cy=\"%s\" r=\"%s\" fill=\"%s\"/>\n", x(value.x()), y(value.y()), radiusPx, colour);
    }

    /** A ring around a place, for example where a robot touches something. */
    void ring(Point value, String colour) {
        svg.add(
                "<circle cx=\"%s\" cy=\"%s\" r=\"4\" fill=\"none\" stroke=\"%s\" stroke-width=\"1.5\"/>\n",
                x(value.x()), y(value.y()), colour);
    }

    void label(Point value, String anchor, String colour, String words) {
        svg.textOnLines(
                x(value.x()),
                y(value.y()),
                "text-anchor=\"" + anchor + "\" fill=\"" + colour + "\" font-weight=\"bold\"",
                words);
    }
}
