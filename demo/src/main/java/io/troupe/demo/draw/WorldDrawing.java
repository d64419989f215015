package io.troupe.demo.draw;

import io.troupe.demo.svg.SvgElements;
import io.troupe.sim.Snapshot;
import io.troupe.sim.device.Ranger;
import io.troupe.sim.model.CargoSpec;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import java.util.List;
import java.util.Locale;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import java.util.stream.Stream;

/** Draws a snapshot of a world from above, with the rays of its sonars and lasers, as SVG. */
final class WorldDrawing {
    private static final double LONGEST_PX = 1000;
    private static final double MARGIN_M = 0.3;
    private static final double FONT_PX = 14;
    private static final double TITLE_PX = 36;
    private static final double LEGEND_PX = 40;
    private static final double LEFT_PX = 16;
    /** The picture of a narrower world gets white margins, so that the legend fits. */
    private static final double LEAST_WIDTH_PX = 560;

    private static final String SONAR = "#d9822b";
    private static final String LASER = "#8fb3d9";

    private final WorldSpec world;
    private final Snapshot now;
    private final StringBuilder svg = new StringBuilder();
    private final double left;
    private final double top;
    private final double widthM;
    private final double heightM;
    private final double pixelsPerMetre;
    private final double pageWidth;
    private final double shiftX;

    WorldDrawing(WorldSpec world, Snapshot now) {
        this.world = world;
        this.now = now;
        List<Point> corners = Stream.concat(
                        world.obstacles().stream().flatMap(each -> corners(each.shape(), each.pose())),
                        IntStream.range(0, world.robots().size())
                                .boxed()
                                .flatMap(i -> corners(world.robots().get(i).shape(), pose(i))))
                .toList();
        var x = corners.stream().mapToDouble(Point::x).summaryStatistics();
        var y = corners.stream().mapToDouble(Point::y).summaryStatistics();
        left = x.getMin() - MARGIN_M;
        top = y.getMax() + MARGIN_M;
        widthM = x.getMax() + MARGIN_M - left;
        heightM = top - y.getMin() + MARGIN_M;
        pixelsPerMetre = LONGEST_PX / Math.max(widthM, heightM);
        pageWidth = Math.max(LEAST_WIDTH_PX, widthM * pixelsPerMetre);
        shiftX = (pageWidth - widthM * pixelsPerMetre) / 2;
    }

    private static Stream<Point> corners(Shape shape, Pose pose) {
        return shape.outlines().stream().flatMap(List::stream).map(pose::place);
    }

    private Pose pose(int robot) {
        return now.robots().get(robot).pose();
    }

    String svg() {
        double bottom = TITLE_PX + heightM * pixelsPerMetre;
        svg.append(SvgElements.begin(pageWidth, bottom + LEGEND_PX, FONT_PX, title()));
        svg.append(SvgElements.text(LEFT_PX, TITLE_PX - 10, "font-size=\"17\"", title()));
        for (int i = 0; i < world.robots().size(); i++) {
            rays(i);
        }
        for (ObstacleSpec obstacle : world.obstacles()) {
            area(obstacle.name(), obstacle.shape(), obstacle.pose(), obstacle.colour());
        }
        for (int i = 0; i < world.robots().size(); i++) {
            RobotSpec robot = world.robots().get(i);
            area(robot.name(), robot.shape(), pose(i), robot.colour());
            for (CargoSpec piece : robot.cargo()) {
                area(robot.name(), piece.shape(), pose(i), piece.colour());
            }
            nose(robot, pose(i));
        }
        for (int i = 0; i < world.robots().size(); i++) {
            name(world.robots().get(i), pose(i));
        }
        legend(bottom + 24);
        append("</svg>%n");
        return svg.toString();
    }

    /** Filled with the even-odd rule, so that holes stay open. */
    private void area(String name, Shape shape, Pose pose, int colour) {
        String path = shape.outlines().stream()
                .map(line ->
                        line.stream().map(pose::place).map(this::place).collect(Collectors.joining(" L", "M", " Z")))
                .collect(Collectors.joining(" "));
        append(
                "<path d=\"%s\" fill=\"%s\" fill-rule=\"evenodd\" stroke=\"#444444\" stroke-width=\"0.5\"><title>%s</title></path>%n",
                path, SvgElements.colour(colour), SvgElements.escape(name));
    }

    private String title() {
        int robots = world.robots().size();
        int obstacles = world.obstacles().size();
        return world.name() + ": " + (robots == 1 ? "1 robot" : robots + " robots") + ", "
                + (obstacles == 1 ? "1 obstacle" : obstacles + " obstacles");
    }

    /** Draws the name above the robot, or below it if the robot faces upwards. */
    private void name(RobotSpec robot, Pose pose) {
        double y = (top - pose.y()) * pixelsPerMetre;
        double gap = (robot.lengthM() + robot.widthM()) / 2 * pixelsPerMetre;
        svg.append(SvgElements.textOnLines(
                shiftX + (pose.x() - left) * pixelsPerMetre,
                TITLE_PX + (StrictMath.sin(pose.headingRad()) > 0.5 ? y + gap + 10 : y - gap + 4),
                "class=\"name\" text-anchor=\"middle\" font-weight=\"bold\" fill=\"#222222\"",
                robot.name()));
    }

    private void legend(double y) {
        svg.append(SvgElements.scaleBar(LEFT_PX, y - 5, pixelsPerMetre));
        double x = LEFT_PX + SvgElements.scaleBarWidth(pixelsPerMetre, FONT_PX) + 30;
        if (world.robots().stream().anyMatch(robot -> robot.sonar() != null)) {
            x = sample(x, y, SONAR, "sonar, first reading");
        }
        if (world.robots().stream().anyMatch(robot -> !robot.rangers().isEmpty())) {
            sample(x, y, LASER, "laser, first reading");
        }
    }

    private double sample(double x, double y, String colour, String words) {
        append(
                "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"2\"/>",
                x, y - 5, x + 30, y - 5, colour);
        svg.append(SvgElements.text(x + 38, y, "", words));
        return x + 38 + SvgElements.width(words, FONT_PX) + 20;
    }

    /** Draws a line that shows the robot's heading. */
    private void nose(RobotSpec robot, Pose pose) {
        Pose ahead = pose.compose(new Pose(robot.lengthM(), 0, 0));
        append(
                "<path d=\"M%s L%s\" stroke=\"#444444\" stroke-width=\"1.5\"/>%n",
                place(new Point(pose.x(), pose.y())), place(new Point(ahead.x(), ahead.y())));
    }

    private void rays(int robot) {
        RobotSpec spec = world.robots().get(robot);
        SonarSpec sonar = spec.sonar();
        List<Double> sonarM = now.robots().get(robot).sonarM();
        if (sonar != null && sonarM != null) {
            for (int i = 0; i < sonarM.size(); i++) {
                ray(pose(robot).compose(sonar.mounts().get(i)), sonarM.get(i), SONAR);
            }
        }
        for (int i = 0; i < spec.rangers().size(); i++) {
            List<Double> rangesM = now.robots().get(robot).rangersM().get(i);
            int ray = 0;
            for (RangeSensorSpec sensor : spec.rangers().get(i).sensors()) {
                Pose mount = pose(robot).compose(sensor.mount());
                for (double leftRad : Ranger.directionsRad(sensor)) {
                    ray(mount.compose(new Pose(0, 0, leftRad)), rangesM.get(ray++), LASER);
                }
            }
        }
    }

    private void ray(Pose from, double lengthM, String colour) {
        Pose end = from.compose(new Pose(lengthM, 0, 0));
        append(
                "<path d=\"M%s L%s\" stroke=\"%s\" stroke-width=\"0.6\"/>%n",
                place(new Point(from.x(), from.y())), place(new Point(end.x(), end.y())), colour);
    }

    private String place(Point point) {
        return String.format(
                Locale.ROOT,
                "%.1f %.1f",
                shiftX + (point.x() - left) * pixelsPerMetre,
                TITLE_PX + (top - point.y()) * pixelsPerMetre);
    }

    private void append(String format, Object... values) {
        svg.append(String.format(Locale.ROOT, format, values));
    }
}
