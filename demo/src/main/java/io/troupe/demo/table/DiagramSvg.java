package io.troupe.demo.table;

import io.troupe.demo.table.Diagram.Node;
import io.troupe.drawing.Svg;
import java.util.List;
import java.util.stream.Stream;

/**
 * Draws a diagram as SVG: up to three states with all arrows between them, more states with one arrow each from a
 * common bar.
 *
 * <p>Places are fixed here rather than found by a layout library: every state leads to every other, which a triangle
 * shows as it is. Layers would put the states into an order that they do not have, and lead two arrows around a state.
 */
final class DiagramSvg {
    private record Point(double x, double y) {}

    private static final double MARGIN_PX = 24;
    private static final double GAP_PX = 22;
    /** Distance between the bar and boxes, and between the boxes of a triangle; fits a label. */
    private static final double ARROW_PX = 150;

    private static final double MOST_BOW_PX = 70;
    /** Position of the label along an arrow, as a share of its length. */
    private static final double LABEL_AT = 0.4;

    private static final double BAR_PX = 150;
    /** From this number of states on, there are boxes on both sides of the bar. */
    private static final int TWO_SIDED = 9;

    private static final String BOX = "fill=\"#f6f6f6\" stroke=\"#444\" stroke-width=\"1.5\"";
    private static final String FINAL_BOX = BOX + " stroke-dasharray=\"6 4\"";
    private static final String CENTRED = "text-anchor=\"middle\"";

    private final Diagram diagram;
    private final double boxWidth;
    private final double boxHeight;

    private DiagramSvg(Diagram diagram) {
        this.diagram = diagram;
        this.boxWidth = diagram.nodes().stream()
                        .flatMap(node -> Stream.concat(Stream.of(node.heading()), node.lines().stream()))
                        .mapToDouble(SvgText::width)
                        .max()
                        .orElse(0)
                + 24;
        this.boxHeight = diagram.nodes().stream()
                                .mapToInt(node -> node.lines().size() + 1)
                                .max()
                                .orElse(1)
                        * SvgText.LINE_PX
                + 18;
    }

    static String draw(Diagram diagram) {
        var drawing = new DiagramSvg(diagram);
        return diagram.hasBar() ? drawing.withBar() : drawing.withAllArrows();
    }

    private SvgText begin(double width, double height) {
        double notes =
                diagram.notes().stream().mapToDouble(SvgText::width).max().orElse(0);
        var svg = new SvgText(
                Math.max(width, notes + 2 * MARGIN_PX),
                diagram.notes().isEmpty() ? height : height + diagram.notes().size() * SvgText.LINE_PX + MARGIN_PX,
                diagram.title());
        for (int line = 0; line < diagram.notes().size(); line++) {
            svg.line(diagram.notes().get(line), MARGIN_PX, height + (line + 1) * SvgText.LINE_PX - 4, "");
        }
        return svg;
    }

    private void box(SvgText svg, Node node, Point centre) {
        svg.box(
                centre.x() - boxWidth / 2,
                centre.y() - boxHeight / 2,
                boxWidth,
                boxHeight,
                node.ends() ? BOX : FINAL_BOX);
        double y = centre.y() - (node.lines().size()) * SvgText.LINE_PX / 2 + 5;
        svg.line(node.heading(), centre.x(), y, CENTRED + " font-weight=\"bold\"");
        for (String line : node.lines()) {
            y += SvgText.LINE_PX;
            svg.line(line, centre.x(), y, CENTRED);
        }
    }

    /** Draws one box, two side by side, or a triangle with the first state on top. */
    private String withAllArrows() {
        int count = diagram.nodes().size();
        double across = boxWidth + ARROW_PX * (count == 2 ? 1 : 1.5);
        double down = boxHeight + ARROW_PX;
        double width = 2 * MARGIN_PX + boxWidth + (count > 1 ? across : 0);
        // the initial arrow enters the first state from above
        double top = MARGIN_PX + 30 + boxHeight / 2 + (count == 2 ? 20 : 0);
        double left = MARGIN_PX + boxWidth / 2;
        List<Point> centres = switch (count) {
            case 1 -> List.of(new Point(left, top));
            case 2 -> List.of(new Point(left, top), new Point(left + across, top));
            default ->
                List.of(new Point(width / 2, top), new Point(left, top + down), new Point(left + across, top + down));
        };
        double bottom = centres.getLast().y() + boxHeight / 2;
        // parallel arrows curve below the lowest boxes if these are not high enough
        double bow = count == 1 ? 0 : Math.max(0, (MOST_BOW_PX + SvgText.LINE_PX) / 2 + 4 - boxHeight / 2);
        SvgText svg = begin(width, bottom + bow + MARGIN_PX);
        Point first = centres.getFirst();
        svg.dot(first.x(), MARGIN_PX);
        straight(svg, new Point(first.x(), MARGIN_PX), new Point(first.x(), first.y() - boxHeight / 2));
        for (var arrow : diagram.arrows()) {
            arc(
                    svg,
                    centres.get(arrow.from()),
                    centres.get(arrow.to()),
                    diagram.nodes().get(arrow.to()));
        }
        for (int index = 0; index < count; index++) {
            box(svg, diagram.nodes().get(index), centres.get(index));
        }
        return svg.end();
    }

    /** Draws an arrow that curves to its left, so that the arrows of both directions are apart. */
    private void arc(SvgText svg, Point from, Point to, Node entered) {
        double dx = to.x() - from.x();
        double dy = to.y() - from.y();
        double length = Math.hypot(dx, dy);
        double bow = Math.min(MOST_BOW_PX, length * 0.3);
        var bend = new Point((from.x() + to.x()) / 2 + dy / length * bow, (from.y() + to.y()) / 2 - dx / length * bow);
        Point start = edge(from, bend);
        Point end = edge(to, bend);
        svg.arrow("M" + pair(start) + " Q" + pair(bend) + " ", bend, end);
        svg.label(
                entered.enters(),
                entered.colour(),
                onCurve(start.x(), bend.x(), end.x()),
                onCurve(start.y(), bend.y(), end.y()));
    }

    /** A coordinate of the label, before the middle of the curve, so that the labels of both directions are apart. */
    private static double onCurve(double start, double bend, double end) {
        double rest = 1 - LABEL_AT;
        return rest * rest * start + 2 * rest * LABEL_AT * bend + LABEL_AT * LABEL_AT * end;
    }

    /** Point where the line from a box's centre to an outside point leaves the box. */
    private Point edge(Point centre, Point outside) {
        double dx = outside.x() - centre.x();
        double dy = outside.y() - centre.y();
        double share = Math.min(dx == 0 ? 1 : boxWidth / 2 / Math.abs(dx), dy == 0 ? 1 : boxHeight / 2 / Math.abs(dy));
        return new Point(centre.x() + dx * Math.min(1, share), centre.y() + dy * Math.min(1, share));
    }

    /** Draws the bar, with the states in one column on its right, or in one on each side. */
    private String withBar() {
        int count = diagram.nodes().size();
        boolean twoSided = count >= TWO_SIDED;
        int rows = twoSided ? (count + 1) / 2 : count;
        double arrow = Math.max(
                ARROW_PX,
                60
                        + diagram.nodes().stream()
                                .mapToDouble(node -> SvgText.width(node.enters()))
                                .max()
                                .orElse(0));
        double side = arrow + boxWidth + 40; // room for the initial arrow of the first state
        double barX = MARGIN_PX + (twoSided ? side : 0);
        double height = rows * (boxHeight + GAP_PX) - GAP_PX;
        SvgText svg = begin(barX + BAR_PX + side + MARGIN_PX, height + 2 * MARGIN_PX);
        svg.box(barX, MARGIN_PX, BAR_PX, height, "fill=\"#e4e4e4\" stroke=\"#444\"");
        var words = RobotGroups.wrap(Diagram.BAR, 18);
        double y = MARGIN_PX + height / 2 - (words.size() - 1) * SvgText.LINE_PX / 2 + 5;
        for (String line : words) {
            svg.line(line, barX + BAR_PX / 2, y, CENTRED);
            y += SvgText.LINE_PX;
        }
        for (int index = 0; index < count; index++) {
            boolean left = twoSided && index < rows;
            int sign = left ? -1 : 1;
            double edgeX = left ? barX : barX + BAR_PX;
            double rowY = MARGIN_PX + boxHeight / 2 + (twoSided ? index % rows : index) * (boxHeight + GAP_PX);
            Node node = diagram.nodes().get(index);
            straight(svg, new Point(edgeX, rowY), new Point(edgeX + sign * arrow, rowY));
            svg.label(node.enters(), node.colour(), edgeX + sign * (arrow / 2 - 4), rowY);
            double outer = edgeX + sign * (arrow + boxWidth);
            if (index == 0) {
                svg.dot(outer + sign * 32, rowY);
                straight(svg, new Point(outer + sign * 32, rowY), new Point(outer, rowY));
            }
            box(svg, node, new Point(edgeX + sign * (arrow + boxWidth / 2), rowY));
        }
        return svg.end();
    }

    private static void straight(SvgText svg, Point from, Point to) {
        svg.arrow("M" + pair(from) + " L", from, to);
    }

    private static String pair(Point point) {
        return Svg.number(point.x(), 1) + "," + Svg.number(point.y(), 1);
    }

    /** Writes the SVG elements of diagrams. */
    private static final class SvgText {
        static final double FONT_PX = 14;
        static final double LINE_PX = 19;
        private static final double HEAD_PX = 9;
        /** Letter width of a sans-serif font. Generous, since fonts differ. */
        private static final double LETTER_PX = 8;

        private final Svg svg;

        SvgText(double width, double height, String title) {
            svg = Svg.page(width, height, FONT_PX, title);
        }

        /** Upper estimate of the width of a line. */
        static double width(String line) {
            return line.length() * LETTER_PX;
        }

        void box(double x, double y, double width, double height, String style) {
            svg.add(
                    "<rect x=\"%s\" y=\"%s\" width=\"%s\" height=\"%s\" rx=\"8\" " + style + "/>\n",
                    x,
                    y,
                    width,
                    height);
        }

        void line(String words, double x, double y, String style) {
            svg.text(x, y, style, words);
        }

        /** An arrow: SVG path data, continued to {@code tip}, which is approached from {@code before}. */
        void arrow(String start, Point before, Point tip) {
            double direction = StrictMath.atan2(tip.y() - before.y(), tip.x() - before.x());
            double endX = tip.x() - HEAD_PX / 2 * StrictMath.cos(direction);
            double endY = tip.y() - HEAD_PX / 2 * StrictMath.sin(direction);
            svg.add(
                    "<path class=\"arrow\" d=\"" + start
                            + "%s,%s\" fill=\"none\" stroke=\"#444\" stroke-width=\"1.5\"/>\n",
                    endX,
                    endY);
            svg.arrowHead(tip.x(), tip.y(), direction, HEAD_PX, "#444");
        }

        void dot(double x, double y) {
            svg.add("<circle cx=\"%s\" cy=\"%s\" r=\"5\" fill=\"#444\"/>\n", x, y);
        }

        /** A coloured square and a label on white, centred on a line. */
        void label(String words, int colour, double x, double y) {
            double width = width(words) + 18;
            svg.add(
                    "<rect x=\"%s\" y=\"%s\" width=\"%s\" height=\"%s\" fill=\"white\"/>\n",
                    x - width / 2 - 3, y - LINE_PX / 2, width + 6, LINE_PX);
            svg.add(
                    "<rect x=\"%s\" y=\"%s\" width=\"12\" height=\"12\" fill=\"%s\" stroke=\"#444\"/>\n",
                    x - width / 2, y - 6, Svg.colour(colour));
            line(words, x - width / 2 + 18, y + 5, "");
        }

        String end() {
            return svg.end();
        }
    }
}
