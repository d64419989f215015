package io.troupe.view;

import io.troupe.drawing.Svg;
import io.troupe.sim.Snapshot;
import io.troupe.sim.device.DeviceReading;
import io.troupe.sim.device.Ranger;
import io.troupe.sim.model.CargoSpec;
import io.troupe.sim.model.DeviceSpec;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import java.util.List;
import java.util.Optional;
import java.util.SortedMap;
import java.util.stream.IntStream;
import java.util.stream.Stream;

/** Draws a snapshot of a world from above, with the rays of its sonars and lasers, as SVG. */
final class WorldSvg {
    private static final double LONGEST_PX = 1000;
    private static final double FONT_PX = 14;
    private static final double TITLE_PX = 36;
    private static final double LEGEND_PX = 40;
    private static final double LEFT_PX = 16;
    private static final double LEAST_WIDTH_PX = 560;

    private static final String SONAR = "#d9822b";
    private static final String LASER = "#8fb3d9";
    private static final String MARKER = "#b03fb0";
    private static final String PRESSED = "#c62828";
    private static final String FREE = "#2e8b57";

    private final WorldSpec world;
    private final Snapshot now;
    private final SortedMap<Integer, Optional<Pose>> displaced;
    private final WorldMap map;
    private final Svg svg;

    WorldSvg(WorldSpec world, Snapshot now) {
        this.world = world;
        this.now = now;
        this.displaced = now.displaced(world);
        List<Point> corners = Stream.concat(
                        IntStream.range(0, world.obstacles().size())
                                .boxed()
                                .flatMap(i -> place(i).stream()
                                        .flatMap(pose ->
                                                corners(world.obstacles().get(i).shape(), pose))),
                        IntStream.range(0, world.robots().size())
                                .boxed()
                                .flatMap(i -> corners(world.robots().get(i).shape(), pose(i))))
                .toList();
        map = new WorldMap(corners, Double.POSITIVE_INFINITY, LONGEST_PX, LEAST_WIDTH_PX);
        map.below(TITLE_PX);
        svg = Svg.page(map.pageWidthPx(), map.bottomPx() + LEGEND_PX, FONT_PX, title());
    }

    private static Stream<Point> corners(Shape shape, Pose pose) {
        return shape.outlines().stream().flatMap(List::stream).map(pose::place);
    }

    private Pose pose(int robot) {
        return now.robots().get(robot).pose();
    }

    /** Where an obstacle is; empty = not in the world. */
    private Optional<Pose> place(int obstacle) {
        return displaced.getOrDefault(
                obstacle, Optional.of(world.obstacles().get(obstacle).pose()));
    }

    String draw() {
        svg.text(LEFT_PX, TITLE_PX - 10, "font-size=\"17\"", title());
        for (int i = 0; i < world.robots().size(); i++) {
            rays(i);
        }
        for (int i = 0; i < world.obstacles().size(); i++) {
            ObstacleSpec obstacle = world.obstacles().get(i);
            place(i).ifPresent(pose -> map.body(svg, obstacle.name(), obstacle.shape(), pose, obstacle.colour()));
        }
        for (int i = 0; i < world.robots().size(); i++) {
            RobotSpec robot = world.robots().get(i);
            map.body(svg, robot.name(), robot.shape(), pose(i), robot.colour());
            for (CargoSpec piece : robot.cargo()) {
                map.body(svg, robot.name(), piece.shape(), pose(i), piece.colour());
            }
            nose(robot, pose(i));
            devices(i);
        }
        for (int i = 0; i < world.robots().size(); i++) {
            name(world.robots().get(i), pose(i));
        }
        legend(map.bottomPx() + 24);
        return svg.end();
    }

    private String title() {
        int robots = world.robots().size();
        int obstacles = world.obstacles().size();
        return world.name() + ": " + (robots == 1 ? "1 robot" : robots + " robots") + ", "
                + (obstacles == 1 ? "1 obstacle" : obstacles + " obstacles");
    }

    /** Draws the name above the robot, or below it if the robot faces upwards. */
    private void name(RobotSpec robot, Pose pose) {
        double y = map.y(pose.y());
        double gap = (robot.lengthM() + robot.widthM()) / 2 * map.pixelsPerMetre();
        svg.textOnLines(
                map.x(pose.x()),
                StrictMath.sin(pose.headingRad()) > 0.5 ? y + gap + 10 : y - gap + 4,
                "class=\"name\" text-anchor=\"middle\" font-weight=\"bold\" fill=\"#222222\"",
                robot.name());
    }

    private void legend(double y) {
        double x = LEFT_PX + map.scaleBar(svg, LEFT_PX, y - 5, FONT_PX) + 30;
        if (world.robots().stream().anyMatch(robot -> robot.sonar() != null)) {
            x = sample(x, y, SONAR, "sonar, first reading");
        }
        if (world.robots().stream().anyMatch(robot -> !robot.rangers().isEmpty())) {
            x = sample(x, y, LASER, "laser, first reading");
        }
        if (has(DeviceSpec.FiducialFinder.class)) {
            x = sample(x, y, MARKER, "marker that a finder sees");
        }
        if (has(DeviceSpec.Bumpers.class)) {
            sample(x, y, FREE, "bumper, red if pressed");
        }
    }

    private boolean has(Class<? extends DeviceSpec> device) {
        return world.robots().stream()
                .anyMatch(robot -> robot.devices().stream().anyMatch(device::isInstance));
    }

    private double sample(double x, double y, String colour, String words) {
        svg.add(
                "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"2\"/>",
                x, y - 5, x + 30, y - 5, colour);
        svg.text(x + 38, y, "", words);
        return x + 38 + Svg.width(words, FONT_PX) + 20;
    }

    /** Draws a line that shows the robot's heading. */
    private void nose(RobotSpec robot, Pose pose) {
        Pose ahead = pose.compose(new Pose(robot.lengthM(), 0, 0));
        svg.add(
                "<path d=\"M%s L%s\" stroke=\"#444444\" stroke-width=\"1.5\"/>\n",
                map.place(pose.x(), pose.y()), map.place(ahead.x(), ahead.y()));
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

    /** Lines to the markers that its finders see, and its bumpers. */
    private void devices(int robot) {
        List<DeviceSpec> specs = world.robots().get(robot).devices();
        List<DeviceReading> readings = now.robots().get(robot).devices();
        for (int i = 0; i < readings.size(); i++) {
            if (readings.get(i) instanceof DeviceReading.Fiducials(var seen)
                    && specs.get(i) instanceof DeviceSpec.FiducialFinder finder) {
                Pose from = pose(robot).compose(finder.mount());
                seen.forEach(marker -> line(
                        new Point(from.x(), from.y()), from.place(new Point(marker.x(), marker.y())), MARKER, 1.2));
            } else if (readings.get(i) instanceof DeviceReading.Pressed(var pressed)
                    && specs.get(i) instanceof DeviceSpec.Bumpers(var parts)) {
                for (int j = 0; j < parts.size(); j++) {
                    Pose middle = pose(robot).compose(parts.get(j).mount());
                    double halfM = parts.get(j).lengthM() / 2;
                    line(
                            middle.place(new Point(0, -halfM)),
                            middle.place(new Point(0, halfM)),
                            pressed.get(j) ? PRESSED : FREE,
                            3);
                }
            }
        }
    }

    private void line(Point from, Point to, String colour, double widthPx) {
        svg.add(
                "<path d=\"M%s L%s\" stroke=\"%s\" stroke-width=\"%.1f\"/>\n",
                map.place(from.x(), from.y()), map.place(to.x(), to.y()), colour, widthPx);
    }

    private void ray(Pose from, double lengthM, String colour) {
        Pose end = from.compose(new Pose(lengthM, 0, 0));
        svg.add(
                "<path d=\"M%s L%s\" stroke=\"%s\" stroke-width=\"0.6\"/>\n",
                map.place(from.x(), from.y()), map.place(end.x(), end.y()), colour);
    }
}
