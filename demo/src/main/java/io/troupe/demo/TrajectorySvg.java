package io.troupe.demo;

import io.troupe.services.subsumption.Colours;
import io.troupe.services.subsumption.Service;
import io.troupe.sim.scenario.ObstacleSpec;
import io.troupe.sim.scenario.Point;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.RobotSpec;
import io.troupe.sim.scenario.Shape;
import io.troupe.sim.scenario.WorldSpec;
import java.util.HashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.function.ToDoubleFunction;
import java.util.stream.Collectors;

/** Draws the arena, all paths in the colours of the services, and where states changed; a crowd smaller, and without its robots' numbers. */
final class TrajectorySvg {
    private static final double SCALE = 70; // pixels per metre, at most
    private static final double MOST_PX = 1400; // along the longer side
    private static final double MARGIN_M = 0.3;
    private static final double LINE_PX = 24;
    private static final double LETTER_PX = 7.5;
    private static final double LEGEND_LINE_PX = 36;
    private static final Map<String, String> PATH_COLOURS = Map.of(
            Service.WALL_FOLLOWER.name(), "#7b3fa0",
            Service.SPACE_WANDERER.name(), "#1b9e9e");
    /** For the other services of a table, round and round. */
    private static final List<String> MORE_COLOURS =
            List.of("#d95f02", "#4c78a8", "#9c755f", "#66a61e", "#b07aa1", "#888888");

    private final WorldSpec world;
    private final RunResult result;
    private final double left;
    private final double top;
    private final double width;
    private final double height;
    private final double scale;
    private final boolean crowd;
    private final Map<String, String> pathColours = new HashMap<>(PATH_COLOURS);
    private final StringBuilder svg = new StringBuilder();
    private final StringBuilder legend = new StringBuilder();
    private double legendX = 16;
    private double legendY;

    TrajectorySvg(WorldSpec world, RunResult result) {
        this.world = world;
        this.result = result;
        List<Point> corners = world.obstacles().stream()
                .flatMap(obstacle -> obstacle.shape().polygons().stream()
                        .flatMap(List::stream)
                        .map(obstacle.pose()::place))
                .toList();
        left = edge(corners, Point::x, -1);
        top = -edge(corners, point -> -point.y(), -1);
        width = -edge(corners, point -> -point.x(), -1) - left;
        height = top - edge(corners, Point::y, -1);
        scale = Math.min(SCALE, MOST_PX / Math.max(width, height));
        crowd = result.robots().size() >= Ledger.MANY_ROBOTS;
        legendY = height * scale + LINE_PX;
        for (Service service : result.table().services()) {
            int more = pathColours.size() - PATH_COLOURS.size();
            pathColours.putIfAbsent(service.name(), MORE_COLOURS.get(more % MORE_COLOURS.size()));
        }
    }

    String draw() {
        drawLegend();
        append(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" font-family=\"sans-serif\" font-size=\"14\">%n",
                width * scale, legendY + 16);
        append("<title>%s: where the robots went</title>%n", escape(world.name()));
        append("<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>%n");
        world.obstacles().forEach(this::obstacle);
        result.robots().forEach(this::path);
        result.robots().forEach(this::robot);
        result.states().forEach(this::stateChange);
        svg.append(legend);
        append("</svg>%n");
        return svg.toString();
    }

    private void obstacle(ObstacleSpec obstacle) {
        append("<g><title>%s</title>", escape(obstacle.name()));
        polygons(obstacle.shape(), obstacle.pose(), String.format("fill=\"#%06x\"", obstacle.colour()));
        append("</g>%n");
    }

    /** One line for each stretch under the same service; in a pair robot 2's is dashed. */
    private void path(RobotRecord robot) {
        var path = robot.path();
        int from = 0;
        while (from < path.size()) {
            int to = from;
            while (to + 1 < path.size()
                    && path.get(to + 1).service().equals(path.get(from).service())) {
                to++;
            }
            String points = path.subList(Math.max(0, from - 1), to + 1).stream()
                    .map(sample -> String.format(
                            Locale.ROOT,
                            "%.1f,%.1f",
                            x(sample.pose().x()),
                            y(sample.pose().y())))
                    .collect(Collectors.joining(" "));
            append(
                    "<polyline points=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"%s\" stroke-opacity=\"%s\"%s/>%n",
                    points,
                    pathColours.getOrDefault(path.get(from).service(), "#888888"),
                    crowd ? "1" : "2",
                    crowd ? "0.5" : "0.8",
                    dash(robot.index()));
            from = to + 1;
        }
    }

    /** The body at the start, faint, and at the end. */
    private void robot(RobotRecord robot) {
        RobotSpec spec = world.robots().get(robot.index());
        String fill = String.format("fill=\"#%06x\" stroke=\"#444444\"", spec.colour());
        if (!crowd) {
            polygons(spec.shape(), robot.path().getFirst().pose(), fill + " opacity=\"0.35\"");
        }
        polygons(spec.shape(), robot.path().getLast().pose(), fill);
        if (crowd) {
            return;
        }
        Pose end = robot.path().getLast().pose();
        append(
                "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\" fill=\"%s\" font-weight=\"bold\">%d</text>%n",
                x(end.x()), y(end.y()) + 5, spec.colour() == Colours.BLACK ? "white" : "black", robot.index() + 1);
    }

    /** At the robot that saw the colour: a disc of that colour with the number of the state. */
    private void stateChange(Ledger.StateChange change) {
        if (change.seenBy() == null) {
            return;
        }
        var path = result.robots().get(change.seenBy()).path();
        Pose pose = path.stream()
                .filter(sample -> sample.timeMicros() >= change.timeMicros())
                .findFirst()
                .orElse(path.getLast())
                .pose();
        append(
                "<g><title>%s</title><circle cx=\"%.1f\" cy=\"%.1f\" r=\"%s\" fill=\"#%06x\" stroke=\"white\" stroke-width=\"1.5\"/>",
                escape(change.describe(result.table()).strip()),
                x(pose.x()),
                y(pose.y()),
                crowd ? "7" : "9",
                change.state().colour());
        append(
                "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\" font-size=\"%s\" fill=\"%s\">%d</text></g>%n",
                x(pose.x()),
                y(pose.y()) + (crowd ? 3 : 4),
                crowd ? "8" : "11",
                isBright(change.state().colour()) ? "black" : "white",
                change.state().number());
    }

    private static boolean isBright(int colour) {
        return 0.3 * (colour >> 16 & 0xff) + 0.59 * (colour >> 8 & 0xff) + 0.11 * (colour & 0xff) > 140;
    }

    /** Lines as long as they fit side by side, then two sentences. */
    private void drawLegend() {
        for (Service service : result.table().services()) {
            String stroke = pathColours.get(service.name());
            entry(escape(service.name()), service.name().length(), "stroke=\"" + stroke + "\" stroke-width=\"3\"");
        }
        if (!crowd) {
            for (int robot = 0; robot < result.robots().size(); robot++) {
                entry("robot " + (robot + 1), 8, "stroke=\"#444444\" stroke-width=\"2\"" + dash(robot));
            }
        }
        legendY += LINE_PX;
        legend.append(String.format(
                Locale.ROOT,
                "<text x=\"16\" y=\"%.1f\">%s%s s simulated, %d state changes. Disc: here a robot saw that colour, and state n began.%s</text>%n",
                legendY,
                crowd ? result.robots().size() + " robots, " : "",
                Json.seconds(result.endMicros()),
                result.states().size() - 1,
                crowd ? "" : " Faint body: start."));
    }

    private void entry(String title, int letters, String style) {
        double wide = LEGEND_LINE_PX + letters * LETTER_PX + LINE_PX;
        if (legendX > 16 && legendX + wide > width * scale) {
            legendX = 16;
            legendY += LINE_PX;
        }
        legend.append(String.format(
                Locale.ROOT,
                "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" %s/><text x=\"%.1f\" y=\"%.1f\">%s</text>%n",
                legendX,
                legendY - 5,
                legendX + LEGEND_LINE_PX - 6,
                legendY - 5,
                style,
                legendX + LEGEND_LINE_PX,
                legendY,
                title));
        legendX += wide;
    }

    private void polygons(Shape shape, Pose pose, String style) {
        for (var polygon : shape.polygons()) {
            String points = polygon.stream()
                    .map(pose::place)
                    .map(point -> String.format(Locale.ROOT, "%.1f,%.1f", x(point.x()), y(point.y())))
                    .collect(Collectors.joining(" "));
            append("<polygon points=\"%s\" %s/>", points, style);
        }
        append("%n");
    }

    private String dash(int robot) {
        return robot == 0 || crowd ? "" : " stroke-dasharray=\"7 3\"";
    }

    private static double edge(List<Point> corners, ToDoubleFunction<Point> coordinate, double sign) {
        return corners.stream().mapToDouble(coordinate).min().orElse(-5) + sign * MARGIN_M;
    }

    private double x(double worldX) {
        return (worldX - left) * scale;
    }

    private double y(double worldY) {
        return (top - worldY) * scale;
    }

    private void append(String format, Object... values) {
        svg.append(String.format(Locale.ROOT, format, values));
    }

    private static String escape(String text) {
        return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;");
    }
}
