package io.troupe.demo;

import io.troupe.demo.svg.SvgElements;
import io.troupe.services.subsumption.Service;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.WorldSpec;
import java.util.HashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.function.ToDoubleFunction;
import java.util.stream.Collectors;

/**
 * Draws the arena, the paths coloured by service, and the places of state changes. Paths of a few robots have arrows
 * and time marks. Paths of a crowd fade with age instead, and its robots have no numbers.
 */
final class TrajectorySvg {
    private static final double SCALE = 70; // pixels per metre, upper limit
    private static final double MOST_PX = 1400; // length of the longer side
    private static final double MARGIN_M = 0.3;
    private static final double FONT_PX = 14;
    private static final double TITLE_PX = 17;
    private static final double LEFT_PX = 16;
    private static final double LINE_PX = 24;
    private static final double LEGEND_LINE_PX = 44;
    /** The picture of a narrower world gets white margins, so that title and legend fit. */
    private static final double LEAST_WIDTH_PX = 460;
    /** Distance between two arrows on a path. */
    private static final double ARROW_EVERY_PX = 130;
    /** For all robots together. */
    private static final int MOST_TIME_MARKS = 12;
    /** Number of steps from faint (old) to solid (new) in the paths of a crowd. */
    private static final int AGES = 6;
    /** Dash patterns of the robots' paths, used cyclically; the first one is solid. */
    private static final List<String> DASHES = List.of("", "8 4", "2 3", "14 4 2 4", "18 6", "8 3 2 3 2 3", "5 2");

    private static final Map<String, String> PATH_COLOURS = Map.of(
            Service.WALL_FOLLOWER.name(), "#7b3fa0",
            Service.SPACE_WANDERER.name(), "#1b9e9e");
    /** Colours of further services, used cyclically. */
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
    private final double pageWidth;
    private final List<String> title;
    private final double shiftX;
    private final double shiftY;
    private double legendX = LEFT_PX;
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
        crowd = result.robots().size() >= RunRecorder.MANY_ROBOTS;
        pageWidth = Math.max(width * scale, LEAST_WIDTH_PX);
        title = SvgElements.wrap(finding(), pageWidth - 2 * LEFT_PX, TITLE_PX);
        shiftX = (pageWidth - width * scale) / 2;
        shiftY = title.size() * LINE_PX + 6;
        legendY = shiftY + height * scale + LINE_PX;
        for (Service service : result.table().services()) {
            int more = pathColours.size() - PATH_COLOURS.size();
            pathColours.putIfAbsent(service.name(), MORE_COLOURS.get(more % MORE_COLOURS.size()));
        }
    }

    String draw() {
        drawLegend();
        svg.append(SvgElements.begin(pageWidth, legendY + LEFT_PX, FONT_PX, finding()));
        for (int line = 0; line < title.size(); line++) {
            svg.append(
                    SvgElements.text(LEFT_PX, (line + 1) * LINE_PX, "font-size=\"" + TITLE_PX + "\"", title.get(line)));
        }
        world.obstacles().forEach(this::obstacle);
        for (int age = 0; age < (crowd ? AGES : 1); age++) {
            for (RobotRecord robot : result.robots()) {
                path(robot, age);
            }
        }
        if (!crowd) {
            result.robots().forEach(this::directions);
        }
        result.robots().forEach(this::robot);
        if (!crowd) {
            result.robots().forEach(this::timeMarks);
        }
        result.states().forEach(this::stateChange);
        svg.append(legend);
        append("</svg>%n");
        return svg.toString();
    }

    /** The main result in one sentence; the picture's title. */
    private String finding() {
        int changes = result.states().size() - 1;
        int robots = result.robots().size();
        return String.format(
                Locale.ROOT,
                "%s: %s %s state %s in %s s",
                world.name(),
                robots == 1 ? "1 robot" : robots + " robots",
                robots == 1 ? "changes" : "change",
                changes == 1 ? "once" : changes + " times",
                SvgElements.number(result.endMicros() / 1e6));
    }

    private void obstacle(ObstacleSpec obstacle) {
        append("<g><title>%s</title>", SvgElements.escape(obstacle.name()));
        polygons(obstacle.shape(), obstacle.pose(), "fill=\"" + SvgElements.colour(obstacle.colour()) + "\"");
        append("</g>%n");
    }

    /** Draws one polyline per stretch under the same service; of a crowd, only the stretches of one age. */
    private void path(RobotRecord robot, int age) {
        var path = robot.path();
        int from = 0;
        while (from < path.size()) {
            int to = from;
            while (to + 1 < path.size()
                    && path.get(to + 1).service().equals(path.get(from).service())
                    && age(path.get(to + 1)) == age(path.get(from))) {
                to++;
            }
            if (age(path.get(from)) == age) {
                line(robot.index(), path.subList(Math.max(0, from - 1), to + 1), path.get(from), age);
            }
            from = to + 1;
        }
    }

    private void line(int robot, List<RobotRecord.Sample> samples, RobotRecord.Sample first, int age) {
        String points = samples.stream()
                .map(sample -> String.format(
                        Locale.ROOT,
                        "%.1f,%.1f",
                        x(sample.pose().x()),
                        y(sample.pose().y())))
                .collect(Collectors.joining(" "));
        double newness = (age + 1.0) / AGES;
        append(
                "<polyline points=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"%s\" stroke-opacity=\"%s\"%s/>%n",
                points,
                colourOf(first),
                crowd ? SvgElements.number(0.6 + 1.4 * newness) : "2",
                crowd ? String.format(Locale.ROOT, "%.2f", 0.08 + 0.77 * newness * newness) : "0.8",
                dash(robot));
    }

    private int age(RobotRecord.Sample sample) {
        return crowd ? (int) Math.min(AGES - 1, sample.timeMicros() * AGES / Math.max(1, result.endMicros())) : 0;
    }

    private String colourOf(RobotRecord.Sample sample) {
        return pathColours.getOrDefault(sample.service(), "#888888");
    }

    /** Draws arrow heads along the path at equal distances. */
    private void directions(RobotRecord robot) {
        double sinceLastPx = ARROW_EVERY_PX / 2;
        var path = robot.path();
        for (int i = 1; i < path.size(); i++) {
            double dx = x(path.get(i).pose().x()) - x(path.get(i - 1).pose().x());
            double dy = y(path.get(i).pose().y()) - y(path.get(i - 1).pose().y());
            sinceLastPx += Math.hypot(dx, dy);
            if (sinceLastPx >= ARROW_EVERY_PX && Math.hypot(dx, dy) > 0) {
                sinceLastPx = 0;
                svg.append(SvgElements.head(
                        x(path.get(i).pose().x()),
                        y(path.get(i).pose().y()),
                        StrictMath.atan2(dy, dx),
                        11,
                        colourOf(path.get(i))));
            }
        }
    }

    /** Marks the robot's position at regular times. */
    private void timeMarks(RobotRecord robot) {
        long every = timeMarkMicros();
        var path = robot.path();
        long next = every;
        for (RobotRecord.Sample sample : path) {
            if (sample.timeMicros() >= next && next < result.endMicros()) {
                append(
                        "<circle class=\"time\" cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"white\" stroke=\"%s\" stroke-width=\"1.5\"/>%n",
                        x(sample.pose().x()), y(sample.pose().y()), colourOf(sample));
                String label = SvgElements.number(next / 1e6) + " s";
                svg.append(SvgElements.textOnLines(
                        x(sample.pose().x()) + 6,
                        y(sample.pose().y()) - 5,
                        "font-size=\"11\" fill=\"#333333\"",
                        label));
                next += every;
            }
        }
    }

    /** Interval of time marks: 1, 2 or 5 times a power of ten seconds, for about a dozen marks in all. */
    private long timeMarkMicros() {
        double marksOfOne =
                Math.max(3, (double) MOST_TIME_MARKS / result.robots().size());
        return StrictMath.round(1e6 * SvgElements.roundStep(Math.max(0.1, result.endMicros() / 1e6 / marksOfOne)));
    }

    /** Draws the body, faint at the start and solid at the end. */
    private void robot(RobotRecord robot) {
        RobotSpec spec = world.robots().get(robot.index());
        String fill = "fill=\"" + SvgElements.colour(spec.colour()) + "\" stroke=\"#444444\"";
        if (!crowd) {
            polygons(spec.shape(), robot.path().getFirst().pose(), fill + " opacity=\"0.35\"");
        }
        polygons(spec.shape(), robot.path().getLast().pose(), fill);
        if (crowd) {
            return;
        }
        Pose end = robot.path().getLast().pose();
        svg.append(SvgElements.text(
                x(end.x()),
                y(end.y()) + 5,
                "text-anchor=\"middle\" font-weight=\"bold\" fill=\"" + SvgElements.inkOn(spec.colour()) + "\"",
                Integer.toString(robot.index() + 1)));
    }

    /**
     * Marks the robot that saw the colour with a tag of that colour. Its label begins with "s", since plain numbers are
     * robots.
     */
    private void stateChange(RunRecorder.StateChange change) {
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
                "<g class=\"state\"><title>%s</title>",
                SvgElements.escape(change.describe(result.table()).strip()));
        svg.append(tag(
                x(pose.x()),
                y(pose.y()),
                change.state().colour(),
                "s" + change.state().number()));
        append("</g>%n");
    }

    private static String tag(double x, double y, int colour, String words) {
        double wide = SvgElements.width(words, 11) + 8;
        return String.format(
                        Locale.ROOT,
                        "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"15\" rx=\"3\" fill=\"%s\" stroke=\"white\" stroke-width=\"1.5\"/>",
                        x - wide / 2,
                        y - 7.5,
                        wide,
                        SvgElements.colour(colour))
                + SvgElements.text(
                        x,
                        y + 4,
                        "text-anchor=\"middle\" font-size=\"11\" fill=\"" + SvgElements.inkOn(colour) + "\"",
                        words);
    }

    /** Draws the scale bar and the legend. Samples stand side by side as far as they fit; sentences follow. */
    private void drawLegend() {
        legend.append(SvgElements.scaleBar(legendX + 1, legendY - 5, scale));
        legendX += SvgElements.scaleBarWidth(scale, FONT_PX) + LINE_PX;
        for (Service service : result.table().services()) {
            entry(service.name(), "stroke=\"" + pathColours.get(service.name()) + "\" stroke-width=\"3\"");
        }
        if (!crowd) {
            for (int robot = 0; robot < result.robots().size(); robot++) {
                entry("robot " + (robot + 1), "stroke=\"#444444\" stroke-width=\"2\"" + dash(robot));
            }
        }
        for (String line : SvgElements.wrap(caption(), pageWidth - 2 * LEFT_PX, FONT_PX)) {
            legendY += LINE_PX;
            legend.append(SvgElements.text(LEFT_PX, legendY, "class=\"caption\"", line));
        }
    }

    private String caption() {
        String tag = "Tag s2: here a robot saw that colour, and state 2 began.";
        if (crowd) {
            return result.robots().size() + " robots, " + Json.seconds(result.endMicros()) + " s simulated. " + tag
                    + " Faint paths are old, strong ones new; bodies stand where the robots ended.";
        }
        return tag + " Faint body: start; body with a number: that robot at the end. Ring: where a robot was "
                + "after so many seconds.";
    }

    private void entry(String words, String style) {
        double wide = LEGEND_LINE_PX + SvgElements.width(words, FONT_PX) + LINE_PX;
        if (legendX > LEFT_PX && legendX + wide - LINE_PX > pageWidth - LEFT_PX) {
            legendX = LEFT_PX;
            legendY += LINE_PX;
        }
        legend.append(String.format(
                Locale.ROOT,
                "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" %s/>",
                legendX,
                legendY - 5,
                legendX + LEGEND_LINE_PX - 6,
                legendY - 5,
                style));
        legend.append(SvgElements.text(legendX + LEGEND_LINE_PX, legendY, "", words));
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
        String dash = crowd ? "" : DASHES.get(robot % DASHES.size());
        return dash.isEmpty() ? "" : " stroke-dasharray=\"" + dash + "\"";
    }

    private static double edge(List<Point> corners, ToDoubleFunction<Point> coordinate, double sign) {
        return corners.stream().mapToDouble(coordinate).min().orElse(-5) + sign * MARGIN_M;
    }

    private double x(double worldX) {
        return shiftX + (worldX - left) * scale;
    }

    private double y(double worldY) {
        return shiftY + (top - worldY) * scale;
    }

    private void append(String format, Object... values) {
        svg.append(String.format(Locale.ROOT, format, values));
    }
}
