package io.troupe.view;

import io.troupe.drawing.Svg;
import io.troupe.services.subsumption.Service;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * Draws the arena, the paths, and the places of state changes. Older parts of a path are paler and thinner. Paths of a
 * few robots are coloured by service, with arrows and time marks; each robot of a crowd has another colour.
 */
final class TrajectorySvg {
    private static final double SCALE = 70; // pixels per metre, upper limit
    private static final double MOST_PX = 1000; // length of the longer side
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
    /** Number of steps from faint (old) to solid (new) in the paths. */
    private static final int AGES = 6;

    private static final double LABEL_PX = 12;
    private static final double MARK_RADIUS_PX = 3;
    /** Marks of a robot that stays within this distance have one label. */
    private static final double STAY_PX = 12;
    /** A body on which a number would be smaller has none. */
    private static final double LEAST_NUMBER_PX = 7;
    /** Between the hues of two robots of a crowd, in turns; successive hues differ, and none comes again. */
    private static final double HUE_STEP = 0.381966;

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
    private final Labels labels;
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
        labels = new Labels(new Box(0, title.size() * LINE_PX, map.pageWidthPx(), map.bottomPx()));
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
        for (int age = 0; age < AGES; age++) {
            for (RobotRecord robot : result.robots()) {
                path(robot, age);
            }
        }
        List<TimeMark> marks = crowd
                ? List.of()
                : result.robots().stream()
                        .flatMap(robot -> timeMarks(robot).stream())
                        .toList();
        if (!crowd) {
            result.robots().forEach(this::directions);
        }
        marks.forEach(this::ring);
        result.robots().forEach(this::robot);
        result.states().forEach(this::stateChange);
        marks.forEach(this::time);
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
        labels.avoid(box(obstacle.shape(), obstacle.pose()), 0.3);
    }

    private Box box(Shape shape, Pose pose) {
        return corners(shape, pose)
                .map(corner -> new Box(map.x(corner.x()), map.y(corner.y()), map.x(corner.x()), map.y(corner.y())))
                .reduce(Box::around)
                .orElseThrow();
    }

    /** Draws one polyline per stretch under the same service, of those of one age. */
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
        if (samples.size() < 2) {
            return;
        }
        String points = samples.stream()
                .map(sample ->
                        map.corner(new Point(sample.pose().x(), sample.pose().y())))
                .collect(Collectors.joining(" "));
        double newness = (age + 1.0) / AGES;
        svg.add(
                "<polyline points=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"%s\" stroke-opacity=\"%.2f\""
                        + dash(robot) + "/>\n",
                points,
                colourOf(robot, first),
                (crowd ? 0.6 : 1.2) + 1.4 * newness,
                opacity(age));
    }

    private double opacity(int age) {
        double newness = (age + 1.0) / AGES;
        return crowd ? 0.08 + 0.77 * newness * newness : 0.3 + 0.6 * newness;
    }

    private int age(RobotRecord.Sample sample) {
        return (int) Math.min(AGES - 1, sample.timeMicros() * AGES / Math.max(1, result.endMicros()));
    }

    private String colourOf(int robot, RobotRecord.Sample sample) {
        if (crowd) {
            return Svg.colour(colourInCrowd(robot));
        }
        return colours.colour(
                hasServices ? sample.service() : name(result.robots().get(robot)));
    }

    private static String name(RobotRecord robot) {
        return "robot " + (robot.index() + 1);
    }

    /** Three brightnesses of each hue, dark enough for lines on white. */
    static int colourInCrowd(int robot) {
        double hue = robot * HUE_STEP % 1 * 6;
        double most = robot % 3 == 0 ? 220 : robot % 3 == 1 ? 170 : 120;
        int rgb = 0;
        for (int shift = 0; shift < 6; shift += 2) {
            double distance = Math.abs((hue + shift) % 6 - 3); // 3 at the part's own hue
            rgb = rgb << 8 | (int) (most * (0.1 + 0.9 * Math.max(0, Math.min(1, distance - 1))));
        }
        return rgb;
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
                svg.add("<g opacity=\"%.2f\">", opacity(age(path.get(i))));
                svg.arrowHead(
                        x(path.get(i).pose()),
                        y(path.get(i).pose()),
                        StrictMath.atan2(dy, dx),
                        11,
                        colourOf(robot.index(), path.get(i)));
                svg.add("</g>");
            }
        }
    }

    /** Where a robot was at one regular time, or stayed at several. */
    private record TimeMark(long fromMicros, long toMicros, double x, double y, String colour) {
        boolean hasStayed(double otherX, double otherY) {
            return Math.hypot(otherX - x, otherY - y) <= STAY_PX;
        }

        String words() {
            String end = Svg.number(toMicros / 1e6, 1) + " s";
            return fromMicros == toMicros ? end : Svg.number(fromMicros / 1e6, 1) + "-" + end;
        }
    }

    private List<TimeMark> timeMarks(RobotRecord robot) {
        long every = timeMarkMicros();
        List<TimeMark> marks = new ArrayList<>();
        long next = every;
        for (RobotRecord.Sample sample : robot.path()) {
            if (sample.timeMicros() >= next && next < result.endMicros()) {
                double x = x(sample.pose());
                double y = y(sample.pose());
                if (!marks.isEmpty() && marks.getLast().hasStayed(x, y)) {
                    TimeMark last = marks.removeLast();
                    marks.add(new TimeMark(last.fromMicros, next, last.x, last.y, last.colour));
                } else {
                    marks.add(new TimeMark(next, next, x, y, colourOf(robot.index(), sample)));
                }
                next += every;
            }
        }
        return marks;
    }

    private void ring(TimeMark mark) {
        svg.add(
                "<circle class=\"time\" cx=\"%.1f\" cy=\"%.1f\" r=\"%s\" fill=\"white\" stroke=\"%s\" stroke-width=\"1.5\"/>\n",
                mark.x, mark.y, MARK_RADIUS_PX, mark.colour);
        labels.avoid(Box.centred(mark.x, mark.y, 2 * MARK_RADIUS_PX, 2 * MARK_RADIUS_PX), 1);
    }

    private void time(TimeMark mark) {
        Box at = labels.place(mark.x, mark.y, Svg.width(mark.words(), LABEL_PX), LABEL_PX, false);
        pointer(mark.x, mark.y, at);
        svg.textOnLines(
                at.left,
                at.bottom - 2,
                "class=\"time\" font-size=\"" + Svg.number(LABEL_PX, 0) + "\" fill=\"#333333\"",
                mark.words());
    }

    /** Draws a line to a label that is not beside its place. */
    private void pointer(double x, double y, Box label) {
        double nearX = Math.max(label.left, Math.min(label.right, x));
        double nearY = Math.max(label.top, Math.min(label.bottom, y));
        if (Math.hypot(nearX - x, nearY - y) > 10) {
            svg.add(
                    "<path d=\"M%.1f %.1f L%.1f %.1f\" stroke=\"#666666\" stroke-width=\"0.8\"/>\n",
                    x, y, nearX, nearY);
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
        int colour = crowd ? colourInCrowd(robot.index()) : spec.colour();
        String fill = "fill=\"" + Svg.colour(colour) + "\" stroke=\"#444444\"";
        if (!crowd) {
            map.parts(svg, spec.shape(), robot.path().getFirst().pose(), fill + " opacity=\"0.35\"");
        }
        Pose end = robot.path().getLast().pose();
        map.parts(svg, spec.shape(), end, fill);
        labels.avoid(box(spec.shape(), end), 1);
        String number = Integer.toString(robot.index() + 1);
        double roomPx = 0.8 * Math.min(spec.lengthM(), spec.widthM()) * map.pixelsPerMetre();
        double fontPx = Math.min(FONT_PX, Math.min(roomPx, roomPx / Svg.width(number, 1)));
        if (fontPx >= LEAST_NUMBER_PX) {
            svg.text(
                    x(end),
                    y(end) + fontPx * 0.36,
                    "text-anchor=\"middle\" font-weight=\"bold\" font-size=\"" + Svg.number(fontPx, 1) + "\" fill=\""
                            + Svg.inkOn(colour) + "\"",
                    number);
        }
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
        Box at = labels.place(x, y, Svg.width(words, LABEL_PX) + 8, LABEL_PX + 4, true);
        pointer(x, y, at);
        svg.add(
                "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" rx=\"3\" fill=\"%s\" stroke=\"white\" stroke-width=\"1.5\"/>",
                at.left, at.top, at.right - at.left, at.bottom - at.top, Svg.colour(colour));
        svg.text(
                (at.left + at.right) / 2,
                at.bottom - 4,
                "class=\"tag\" text-anchor=\"middle\" font-size=\"" + Svg.number(LABEL_PX, 0) + "\" fill=\""
                        + Svg.inkOn(colour) + "\"",
                words);
    }

    /** Draws the scale bar and the legend. Samples stand side by side as far as they fit; sentences follow. */
    private void drawLegend() {
        legendX += map.scaleBar(legend, legendX + 1, legendY - 5, FONT_PX) + LINE_PX;
        for (Service service : crowd ? List.<Service>of() : result.table().services()) {
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
        tag += "Pale paths are old.";
        if (crowd) {
            return result.robots().size() + " robots, " + Json.seconds(result.endMicros()) + " s simulated. " + tag
                    + " Each robot has a colour, and stands where it ended.";
        }
        return tag + " Faint body: start; body with a number: that robot at the end. Ring: where a robot was "
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

    /** A rectangle of the page, in pixels. */
    private record Box(double left, double top, double right, double bottom) {
        static Box centred(double x, double y, double width, double height) {
            return new Box(x - width / 2, y - height / 2, x + width / 2, y + height / 2);
        }

        Box around(Box other) {
            return new Box(
                    Math.min(left, other.left),
                    Math.min(top, other.top),
                    Math.max(right, other.right),
                    Math.max(bottom, other.bottom));
        }

        double overlap(Box other) {
            double wide = Math.min(right, other.right) - Math.max(left, other.left);
            double high = Math.min(bottom, other.bottom) - Math.max(top, other.top);
            return wide > 0 && high > 0 ? wide * high : 0;
        }

        double area() {
            return (right - left) * (bottom - top);
        }
    }

    /** Finds places for labels: near what they name, within the map, and on nothing else. */
    private static final class Labels {
        private static final List<Double> DISTANCES_PX = List.of(7.0, 14.0, 24.0, 36.0, 52.0);
        /** To the right and down, best first. */
        private static final int[][] SIDES = {{1, -1}, {1, 1}, {-1, -1}, {-1, 1}, {0, -1}, {0, 1}, {1, 0}, {-1, 0}};

        private record Thing(Box box, double weight) {}

        private final List<Thing> things = new ArrayList<>();
        private final Box page;

        Labels(Box page) {
            this.page = page;
        }

        /** @param weight how much it matters that no label is on the box; labels have 1 */
        void avoid(Box box, double weight) {
            things.add(new Thing(box, weight));
        }

        /** @param onIt whether the label may be at the place itself */
        Box place(double x, double y, double width, double height, boolean onIt) {
            Box best = Box.centred(x, y, width, height);
            double least = onIt ? cost(best) : Double.POSITIVE_INFINITY;
            for (double distance : DISTANCES_PX) {
                for (int[] side : SIDES) {
                    double reach = side[0] == 0 || side[1] == 0 ? distance : distance * 0.7;
                    Box box = Box.centred(
                            x + side[0] * (reach + width / 2), y + side[1] * (reach + height / 2), width, height);
                    double cost = cost(box) + distance;
                    if (cost < least) {
                        least = cost;
                        best = box;
                    }
                }
            }
            avoid(best, 1);
            return best;
        }

        private double cost(Box box) {
            double covered = things.stream()
                    .mapToDouble(thing -> thing.weight * box.overlap(thing.box))
                    .sum();
            return 2 * covered + 10 * (box.area() - box.overlap(page));
        }
    }
}
