package io.troupe.view;

import io.troupe.common.svg.Svg;
import io.troupe.services.subsumption.Service;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.WorldSpec;
import java.util.List;
import java.util.Locale;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * Draws the arena, the paths coloured by service, and the places of state changes. Paths of a few robots have arrows
 * and time marks. Paths of a crowd fade with age instead, and its robots have no numbers.
 */
final class TrajectorySvg {
    private static final double SCALE = 70; // pixels per metre, upper limit
    private static final double MOST_PX = 1400; // length of the longer side
    private static final double FONT_PX = 14;
    private static final double TITLE_PX = 17;
    private static final double LEFT_PX = 16;
    private static final double LINE_PX = 24;
    private static final double LEGEND_LINE_PX = 44;
    private static final double LEAST_WIDTH_PX = 460;
    /** Distance between two arrows on a path. */
    private static final double ARROW_EVERY_PX = 130;
    /** For all robots together. */
    private static final int MOST_TIME_MARKS = 12;
    /** Number of steps from faint (old) to solid (new) in the paths of a crowd. */
    private static final int AGES = 6;
    /** Dash patterns of the robots' paths, used cyclically; the first one is solid. */
    private static final List<String> DASHES = List.of("", "8 4", "2 3", "14 4 2 4", "18 6", "8 3 2 3 2 3", "5 2");

    private final WorldSpec world;
    private final RunResult result;
    private final WorldMap map;
    private final boolean crowd;
    /** Otherwise paths are coloured by robot. */
    private final boolean hasServices;

    private final ServiceColours colours;
    private final Svg legend = Svg.fragment();
    private final List<String> title;
    private final Svg svg;
    private double legendX = LEFT_PX;
    private double legendY;

    TrajectorySvg(WorldSpec world, RunResult result) {
        this.world = world;
        this.result = result;
        this.hasServices = !result.table().services().isEmpty();
        this.colours = hasServices
                ? ServiceColours.of(result.table())
                : ServiceColours.of(
                        result.robots().stream().map(TrajectorySvg::name).toList());
        Stream<Point> obstacles =
                world.obstacles().stream().flatMap(obstacle -> corners(obstacle.shape(), obstacle.pose()));
        Stream<Point> paths = result.robots().stream().flatMap(this::reach);
        map = new WorldMap(Stream.concat(obstacles, paths).toList(), SCALE, MOST_PX, LEAST_WIDTH_PX);
        crowd = result.robots().size() >= RunRecorder.MANY_ROBOTS;
        title = Svg.wrap(finding(), map.pageWidthPx() - 2 * LEFT_PX, TITLE_PX);
        map.below(title.size() * LINE_PX + 6);
        legendY = map.bottomPx() + LINE_PX;
        drawLegend();
        svg = Svg.page(map.pageWidthPx(), legendY + LEFT_PX, FONT_PX, finding());
    }

    private static Stream<Point> corners(Shape shape, Pose pose) {
        return shape.polygons().stream().flatMap(List::stream).map(pose::place);
    }

    /** Where a robot was: its body at both ends of its path, and the corners of a box around the path. */
    private Stream<Point> reach(RobotRecord robot) {
        var path = robot.path();
        if (path.isEmpty()) {
            return Stream.empty();
        }
        var x = path.stream().mapToDouble(sample -> sample.pose().x()).summaryStatistics();
        var y = path.stream().mapToDouble(sample -> sample.pose().y()).summaryStatistics();
        Shape body = world.robots().get(robot.index()).shape();
        return Stream.of(
                        corners(body, path.getFirst().pose()),
                        corners(body, path.getLast().pose()),
                        Stream.of(new Point(x.getMin(), y.getMin()), new Point(x.getMax(), y.getMax())))
                .flatMap(points -> points);
    }

    String draw() {
        for (int line = 0; line < title.size(); line++) {
            svg.text(LEFT_PX, (line + 1) * LINE_PX, "font-size=\"" + TITLE_PX + "\"", title.get(line));
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
        return svg.append(legend).end();
    }

    /** The main result in one sentence; the picture's title. */
    private String finding() {
        int changes = result.switches();
        int robots = result.robots().size();
        if (!hasServices) {
            return String.format(
                    Locale.ROOT,
                    "%s: %s %s %s m in %s s",
                    world.name(),
                    robots == 1 ? "1 robot" : robots + " robots",
                    robots == 1 ? "drives" : "drive",
                    Svg.number(
                            result.robots().stream()
                                    .mapToDouble(RobotRecord::distanceM)
                                    .sum(),
                            1),
                    Svg.number(result.endMicros() / 1e6, 1));
        }
        return String.format(
                Locale.ROOT,
                "%s: %s %s state %s in %s s",
                world.name(),
                robots == 1 ? "1 robot" : robots + " robots",
                robots == 1 ? "changes" : "change",
                changes == 1 ? "once" : changes + " times",
                Svg.number(result.endMicros() / 1e6, 1));
    }

    private void obstacle(ObstacleSpec obstacle) {
        svg.add("<g><title>%s</title>", obstacle.name());
        map.parts(svg, obstacle.shape(), obstacle.pose(), "fill=\"" + Svg.colour(obstacle.colour()) + "\"");
        svg.add("</g>\n");
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
                .map(sample ->
                        map.corner(new Point(sample.pose().x(), sample.pose().y())))
                .collect(Collectors.joining(" "));
        double newness = (age + 1.0) / AGES;
        svg.add(
                "<polyline points=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"%s\" stroke-opacity=\"%s\""
                        + dash(robot) + "/>\n",
                points,
                colourOf(robot, first),
                crowd ? 0.6 + 1.4 * newness : 2.0,
                crowd ? String.format(Locale.ROOT, "%.2f", 0.08 + 0.77 * newness * newness) : "0.8");
    }

    private int age(RobotRecord.Sample sample) {
        return crowd ? (int) Math.min(AGES - 1, sample.timeMicros() * AGES / Math.max(1, result.endMicros())) : 0;
    }

    private String colourOf(int robot, RobotRecord.Sample sample) {
        return colours.colour(
                hasServices ? sample.service() : name(result.robots().get(robot)));
    }

    private static String name(RobotRecord robot) {
        return "robot " + (robot.index() + 1);
    }

    /** Draws arrow heads along the path at equal distances. */
    private void directions(RobotRecord robot) {
        double sinceLastPx = ARROW_EVERY_PX / 2;
        var path = robot.path();
        for (int i = 1; i < path.size(); i++) {
            double dx = x(path.get(i).pose()) - x(path.get(i - 1).pose());
            double dy = y(path.get(i).pose()) - y(path.get(i - 1).pose());
            sinceLastPx += Math.hypot(dx, dy);
            if (sinceLastPx >= ARROW_EVERY_PX && Math.hypot(dx, dy) > 0) {
                sinceLastPx = 0;
                svg.arrowHead(
                        x(path.get(i).pose()),
                        y(path.get(i).pose()),
                        StrictMath.atan2(dy, dx),
                        11,
                        colourOf(robot.index(), path.get(i)));
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
                double x = x(sample.pose());
                double y = y(sample.pose());
                svg.add(
                        "<circle class=\"time\" cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"white\" stroke=\"%s\" stroke-width=\"1.5\"/>\n",
                        x, y, colourOf(robot.index(), sample));
                String label = Svg.number(next / 1e6, 1) + " s";
                svg.textOnLines(x + 6, y - 5, "font-size=\"11\" fill=\"#333333\"", label);
                next += every;
            }
        }
    }

    /** Interval of time marks: 1, 2 or 5 times a power of ten seconds, for about a dozen marks in all. */
    private long timeMarkMicros() {
        double marksOfOne =
                Math.max(3, (double) MOST_TIME_MARKS / result.robots().size());
        return StrictMath.round(1e6 * Svg.roundStep(Math.max(0.1, result.endMicros() / 1e6 / marksOfOne)));
    }

    /** Draws the body, faint at the start and solid at the end. */
    private void robot(RobotRecord robot) {
        RobotSpec spec = world.robots().get(robot.index());
        String fill = "fill=\"" + Svg.colour(spec.colour()) + "\" stroke=\"#444444\"";
        if (!crowd) {
            map.parts(svg, spec.shape(), robot.path().getFirst().pose(), fill + " opacity=\"0.35\"");
        }
        map.parts(svg, spec.shape(), robot.path().getLast().pose(), fill);
        if (crowd) {
            return;
        }
        Pose end = robot.path().getLast().pose();
        svg.text(
                x(end),
                y(end) + 5,
                "text-anchor=\"middle\" font-weight=\"bold\" fill=\"" + Svg.inkOn(spec.colour()) + "\"",
                Integer.toString(robot.index() + 1));
    }

    /**
     * Marks the robot that saw the colour with a tag of that colour. Its label begins with "s", since plain numbers are
     * robots.
     */
    private void stateChange(RunResult.StateChange change) {
        if (change.seenBy() == null) {
            return;
        }
        var path = result.robots().get(change.seenBy()).path();
        Pose pose = path.stream()
                .filter(sample -> sample.timeMicros() >= change.timeMicros())
                .findFirst()
                .orElse(path.getLast())
                .pose();
        svg.add(
                "<g class=\"state\"><title>%s</title>",
                change.describe(result.table()).strip());
        tag(x(pose), y(pose), change.state().colour(), "s" + change.state().number());
        svg.add("</g>\n");
    }

    private void tag(double x, double y, int colour, String words) {
        double wide = Svg.width(words, 11) + 8;
        svg.add(
                "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"15\" rx=\"3\" fill=\"%s\" stroke=\"white\" stroke-width=\"1.5\"/>",
                x - wide / 2, y - 7.5, wide, Svg.colour(colour));
        svg.text(x, y + 4, "text-anchor=\"middle\" font-size=\"11\" fill=\"" + Svg.inkOn(colour) + "\"", words);
    }

    /** Draws the scale bar and the legend. Samples stand side by side as far as they fit; sentences follow. */
    private void drawLegend() {
        legendX += map.scaleBar(legend, legendX + 1, legendY - 5, FONT_PX) + LINE_PX;
        for (Service service : result.table().services()) {
            entry(service.name(), "stroke=\"" + colours.colour(service.name()) + "\" stroke-width=\"3\"");
        }
        if (!crowd) {
            for (RobotRecord robot : result.robots()) {
                String colour = hasServices ? "#444444" : colours.colour(name(robot));
                entry(name(robot), "stroke=\"" + colour + "\" stroke-width=\"2\"" + dash(robot.index()));
            }
        }
        for (String line : Svg.wrap(caption(), map.pageWidthPx() - 2 * LEFT_PX, FONT_PX)) {
            legendY += LINE_PX;
            legend.text(LEFT_PX, legendY, "class=\"caption\"", line);
        }
    }

    private String caption() {
        String tag = hasServices ? "Tag s2: here a robot saw that colour, and state 2 began. " : "";
        if (crowd) {
            return result.robots().size() + " robots, " + Json.seconds(result.endMicros()) + " s simulated. " + tag
                    + "Faint paths are old, strong ones new; bodies stand where the robots ended.";
        }
        return tag + "Faint body: start; body with a number: that robot at the end. Ring: where a robot was "
                + "after so many seconds.";
    }

    private void entry(String words, String style) {
        double wide = LEGEND_LINE_PX + Svg.width(words, FONT_PX) + LINE_PX;
        if (legendX > LEFT_PX && legendX + wide - LINE_PX > map.pageWidthPx() - LEFT_PX) {
            legendX = LEFT_PX;
            legendY += LINE_PX;
        }
        legend.add(
                "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" " + style + "/>",
                legendX,
                legendY - 5,
                legendX + LEGEND_LINE_PX - 6,
                legendY - 5);
        legend.text(legendX + LEGEND_LINE_PX, legendY, "", words);
        legendX += wide;
    }

    private String dash(int robot) {
        String dash = crowd ? "" : DASHES.get(robot % DASHES.size());
        return dash.isEmpty() ? "" : " stroke-dasharray=\"" + dash + "\"";
    }

    private double x(Pose pose) {
        return map.x(pose.x());
    }

    private double y(Pose pose) {
        return map.y(pose.y());
    }
}
