package io.troupe.view;

import io.troupe.drawing.Svg;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.Shape;
import java.util.List;
import java.util.Locale;
import java.util.function.ToDoubleFunction;
import java.util.stream.Collectors;

/**
 * A world on a page, seen from above: where its points are, its bodies, and its scale.
 *
 * <p><b>Units and shapes.</b> Metres in the world, y upwards; pixels on the page, y downwards.
 */
final class WorldMap {
    private static final double MARGIN_M = 0.3;
    /** Where a world without bodies ends. */
    private static final double EMPTY_M = -5;
    /** Minimum length of the scale bar, which shows 1, 2 or 5 times a power of ten metres. */
    private static final double LEAST_BAR_PX = 48;

    private final double leftM;
    private final double topM;
    private final double widthM;
    private final double heightM;
    private final double pixelsPerMetre;
    private final double pageWidthPx;
    private double topPx;

    /**
     * Fits the world on a page.
     *
     * @param corners of everything that is to be on the map
     * @param mostPixelsPerMetre upper limit of the scale
     * @param mostPx upper limit of the longer side
     * @param leastPx width of the page of a narrower world, which gets white margins, so that title and legend fit
     */
    WorldMap(List<Point> corners, double mostPixelsPerMetre, double mostPx, double leastPx) {
        leftM = least(corners, Point::x) - MARGIN_M;
        topM = MARGIN_M - least(corners, point -> -point.y());
        widthM = MARGIN_M - least(corners, point -> -point.x()) - leftM;
        heightM = topM - (least(corners, Point::y) - MARGIN_M);
        pixelsPerMetre = Math.min(mostPixelsPerMetre, mostPx / Math.max(widthM, heightM));
        pageWidthPx = Math.max(widthM * pixelsPerMetre, leastPx);
    }

    private static double least(List<Point> corners, ToDoubleFunction<Point> coordinate) {
        return corners.stream().mapToDouble(coordinate).min().orElse(EMPTY_M);
    }

    /** Places the map on the page below a title. */
    void below(double newTopPx) {
        topPx = newTopPx;
    }

    double pageWidthPx() {
        return pageWidthPx;
    }

    /** The lower edge of the map on the page. */
    double bottomPx() {
        return topPx + heightM * pixelsPerMetre;
    }

    double pixelsPerMetre() {
        return pixelsPerMetre;
    }

    double x(double worldX) {
        return (pageWidthPx - widthM * pixelsPerMetre) / 2 + (worldX - leftM) * pixelsPerMetre;
    }

    double y(double worldY) {
        return topPx + (topM - worldY) * pixelsPerMetre;
    }

    /** A point for the data of a path. */
    String place(double worldX, double worldY) {
        return String.format(Locale.ROOT, "%.1f %.1f", x(worldX), y(worldY));
    }

    /** A point of a polygon or polyline. */
    String corner(Point point) {
        return String.format(Locale.ROOT, "%.1f,%.1f", x(point.x()), y(point.y()));
    }

    /** Adds the convex parts of a body, without an outline. */
    void parts(Svg svg, Shape shape, Pose pose, String style) {
        for (var polygon : shape.polygons()) {
            String points = polygon.stream().map(pose::place).map(this::corner).collect(Collectors.joining(" "));
            svg.add("<polygon points=\"%s\" " + style + "/>", points);
        }
        svg.add("\n");
    }

    /** Adds a body with its outline and name. The line around a hole runs the other way round, so that it is open. */
    void body(Svg svg, String name, Shape shape, Pose pose, int colour) {
        String path = shape.outlines().stream()
                .map(line -> line.stream()
                        .map(pose::place)
                        .map(point -> place(point.x(), point.y()))
                        .collect(Collectors.joining(" L", "M", " Z")))
                .collect(Collectors.joining(" "));
        svg.add(
                "<path d=\"%s\" fill=\"%s\" stroke=\"#444444\" stroke-width=\"0.5\"><title>%s</title></path>\n",
                path, Svg.colour(colour), name);
    }

    /**
     * Adds a scale bar with its left end at {@code x}, and its length in metres as label.
     *
     * @return its width including the label
     */
    double scaleBar(Svg svg, double x, double y, double fontPx) {
        double metres = Svg.roundStep(LEAST_BAR_PX / pixelsPerMetre);
        double end = x + metres * pixelsPerMetre;
        String label = Svg.number(metres, 1) + " m";
        svg.add("<g class=\"scale\" stroke=\"#222222\" stroke-width=\"2\">");
        line(svg, x, y, end, y);
        line(svg, x, y - 5, x, y + 5);
        line(svg, end, y - 5, end, y + 5);
        svg.add("</g>").text(end + 8, y + 5, "class=\"scale\" fill=\"#222222\"", label);
        return metres * pixelsPerMetre + 8 + Svg.width(label, fontPx);
    }

    private static void line(Svg svg, double x1, double y1, double x2, double y2) {
        svg.add("<line x1=\"%s\" y1=\"%s\" x2=\"%s\" y2=\"%s\"/>", x1, y1, x2, y2);
    }
}
