package io.troupe.demo.draw;

import io.troupe.sim.Snapshot;
import io.troupe.sim.device.Ranger;
import io.troupe.sim.scenario.CargoSpec;
import io.troupe.sim.scenario.ObstacleSpec;
import io.troupe.sim.scenario.Point;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.RangeSensorSpec;
import io.troupe.sim.scenario.RobotSpec;
import io.troupe.sim.scenario.Shape;
import io.troupe.sim.scenario.SonarSpec;
import io.troupe.sim.scenario.WorldSpec;
import java.util.List;
import java.util.Locale;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import java.util.stream.Stream;

/** A world seen from above at one moment, with the rays of its sonars and lasers, as SVG. */
final class WorldDrawing {
    private static final double LONGEST_PX = 1000;
    private static final double MARGIN_M = 0.3;

    private final WorldSpec world;
    private final Snapshot now;
    private final StringBuilder svg = new StringBuilder();
    private final double left;
    private final double top;
    private final double widthM;
    private final double heightM;
    private final double pixelsPerMetre;

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
    }

    private static Stream<Point> corners(Shape shape, Pose pose) {
        return shape.outlines().stream().flatMap(List::stream).map(pose::place);
    }

    private Pose pose(int robot) {
        return now.robots().get(robot).pose();
    }

    String svg() {
        append(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" font-family=\"sans-serif\">%n",
                widthM * pixelsPerMetre, heightM * pixelsPerMetre);
        append("<title>%s</title>%n<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>%n", escape(world.name()));
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
        append("</svg>%n");
        return svg.toString();
    }

    /** Filled between its lines, so that holes stay open. */
    private void area(String name, Shape shape, Pose pose, int colour) {
        String path = shape.outlines().stream()
                .map(line ->
                        line.stream().map(pose::place).map(this::place).collect(Collectors.joining(" L", "M", " Z")))
                .collect(Collectors.joining(" "));
        append(
                "<path d=\"%s\" fill=\"#%06x\" fill-rule=\"evenodd\" stroke=\"#444444\" stroke-width=\"0.5\"><title>%s</title></path>%n",
                path, colour, escape(name));
    }

    /** Where a robot looks. */
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
                ray(pose(robot).compose(sonar.mounts().get(i)), sonarM.get(i), "#d9822b");
            }
        }
        for (int i = 0; i < spec.rangers().size(); i++) {
            List<Double> rangesM = now.robots().get(robot).rangersM().get(i);
            int ray = 0;
            for (RangeSensorSpec sensor : spec.rangers().get(i).sensors()) {
                Pose mount = pose(robot).compose(sensor.mount());
                for (double leftRad : Ranger.directionsRad(sensor)) {
                    ray(mount.compose(new Pose(0, 0, leftRad)), rangesM.get(ray++), "#8fb3d9");
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
                Locale.ROOT, "%.1f %.1f", (point.x() - left) * pixelsPerMetre, (top - point.y()) * pixelsPerMetre);
    }

    private void append(String format, Object... values) {
        svg.append(String.format(Locale.ROOT, format, values));
    }

    private static String escape(String text) {
        return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;");
    }
}
