package io.troupe.demo;

import io.troupe.services.subsumption.Colours;
import io.troupe.services.subsumption.Service;
import io.troupe.sim.scenario.ObstacleSpec;
import io.troupe.sim.scenario.Point;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.RobotSpec;
import io.troupe.sim.scenario.Shape;
import io.troupe.sim.scenario.WorldSpec;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.function.ToDoubleFunction;
import java.util.stream.Collectors;

/** Draws the arena, both paths in the colours of the services, and where states changed. */
final class TrajectorySvg {
    private static final double SCALE = 70; // pixels per metre
    private static final double MARGIN_M = 0.3;
    private static final double LEGEND_PX = 64;
    private static final Map<String, String> PATH_COLOURS = Map.of(
            Service.WALL_FOLLOWER.name(), "#7b3fa0",
            Service.SPACE_WANDERER.name(), "#1b9e9e");

    private final WorldSpec world;
    private final RunResult result;
    private final double left;
    private final double top;
    private final double width;
    private final double height;
    private final StringBuilder svg = new StringBuilder();

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
    }

    String draw() {
        append(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" font-family=\"sans-serif\" font-size=\"14\">%n",
                width * SCALE, height * SCALE + LEGEND_PX);
        append("<title>%s: where the robots went</title>%n", escape(world.name()));
        append("<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>%n");
        world.obstacles().forEach(this::obstacle);
        result.robots().forEach(this::path);
        result.robots().forEach(this::robot);
        result.states().forEach(this::stateChange);
        legend();
        append("</svg>%n");
        return svg.toString();
    }

    private void obstacle(ObstacleSpec obstacle) {
        append("<g><title>%s</title>", escape(obstacle.name()));
        polygons(obstacle.shape(), obstacle.pose(), String.format("fill=\"#%06x\"", obstacle.colour()));
        append("</g>%n");
    }

    /** One line for each stretch under the same service; robot 2's is dashed. */
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
                    "<polyline points=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"2\" stroke-opacity=\"0.8\"%s/>%n",
                    points, PATH_COLOURS.getOrDefault(path.get(from).service(), "#888888"), dash(robot.index()));
            from = to + 1;
        }
    }

    /** The body at the start, faint, and at the end. */
    private void robot(RobotRecord robot) {
        RobotSpec spec = world.robots().get(robot.index());
        String fill = String.format("fill=\"#%06x\" stroke=\"#444444\"", spec.colour());
        polygons(spec.shape(), robot.path().getFirst().pose(), fill + " opacity=\"0.35\"");
        polygons(spec.shape(), robot.path().getLast().pose(), fill);
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
                "<g><title>%s</title><circle cx=\"%.1f\" cy=\"%.1f\" r=\"9\" fill=\"#%06x\" stroke=\"white\" stroke-width=\"1.5\"/>",
                escape(change.describe().strip()),
                x(pose.x()),
                y(pose.y()),
                change.state().colour());
        append(
                "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\" font-size=\"11\" fill=\"%s\">%d</text></g>%n",
                x(pose.x()),
                y(pose.y()) + 4,
                change.state().colour() == Colours.GREEN ? "black" : "white",
                change.state().number());
    }

    private void legend() {
        double line = height * SCALE + 24;
        double column = 16;
        for (Service service : result.table().services()) {
            append(
                    "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"3\"/>",
                    column, line - 5, column + 30, line - 5, PATH_COLOURS.getOrDefault(service.name(), "#888888"));
            append("<text x=\"%.1f\" y=\"%.1f\">%s</text>%n", column + 36, line, service.name());
            column += 170;
        }
        for (int robot = 0; robot < result.robots().size(); robot++) {
            append(
                    "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#444444\" stroke-width=\"2\"%s/>",
                    column, line - 5, column + 30, line - 5, dash(robot));
            append("<text x=\"%.1f\" y=\"%.1f\">robot %d</text>%n", column + 36, line, robot + 1);
            column += 110;
        }
        append(
                "<text x=\"16\" y=\"%.1f\">%s s simulated, %d state changes. Disc: here a robot saw that colour, and state n began. Faint body: start.</text>%n",
                line + 24, Json.seconds(result.endMicros()), result.states().size() - 1);
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

    private static String dash(int robot) {
        return robot == 0 ? "" : " stroke-dasharray=\"7 3\"";
    }

    private static double edge(List<Point> corners, ToDoubleFunction<Point> coordinate, double sign) {
        return corners.stream().mapToDouble(coordinate).min().orElse(-5) + sign * MARGIN_M;
    }

    private double x(double worldX) {
        return (worldX - left) * SCALE;
    }

    private double y(double worldY) {
        return (top - worldY) * SCALE;
    }

    private void append(String format, Object... values) {
        svg.append(String.format(Locale.ROOT, format, values));
    }

    private static String escape(String text) {
        return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;");
    }
}
