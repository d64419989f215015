package io.troupe.view.live;

import io.troupe.sim.Snapshot;
import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.DeviceSpec;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.WorldSpec;
import io.troupe.view.Json;
import io.troupe.view.RunLog;
import io.troupe.view.ServiceColours;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * A world as it is described to a page, and the scale of the positions in its frames: u16 steps from a corner.
 *
 * <p><b>Units and shapes.</b> Metres, radians; the step is a millimetre, and more in a world wider than 43 m.
 */
final class ViewedWorld {
    private static final double LEAST_STEP_M = 0.001;
    /** The range of positions is so many times as wide as the world, so that robots may leave it. */
    private static final double SPARE = 1.5;

    private static final int MOST_STEPS = 0xFFFF;

    private final WorldSpec spec;
    private final List<String> services;
    private final double leftM;
    private final double bottomM;
    private final double stepM;
    private final String json;

    /**
     * Describes a world.
     *
     * @param services the names of the services, whose numbers in frames count from 1
     * @param controls first words of the commands that the page may send
     */
    ViewedWorld(WorldSpec spec, List<String> services, List<String> controls) {
        this.spec = spec;
        this.services = services;
        List<Point> corners = corners(spec);
        var x = corners.stream().mapToDouble(Point::x).summaryStatistics();
        var y = corners.stream().mapToDouble(Point::y).summaryStatistics();
        double extentM = Math.max(x.getMax() - x.getMin(), y.getMax() - y.getMin());
        stepM = Math.max(LEAST_STEP_M, extentM * SPARE / MOST_STEPS);
        leftM = (x.getMin() + x.getMax() - MOST_STEPS * stepM) / 2;
        bottomM = (y.getMin() + y.getMax() - MOST_STEPS * stepM) / 2;
        json = describe(services, controls);
    }

    private static List<Point> corners(WorldSpec spec) {
        Stream<Point> obstacles = spec.obstacles().stream()
                .flatMap(each ->
                        each.shape().outlines().stream().flatMap(List::stream).map(each.pose()::place));
        Stream<Point> robots = spec.robots().stream()
                .map(each -> new Point(each.pose().x(), each.pose().y()));
        List<Point> all = Stream.concat(obstacles, robots).toList();
        return all.isEmpty() ? List.of(new Point(0, 0)) : all;
    }

    WorldSpec spec() {
        return spec;
    }

    /** The names of the services, whose numbers in frames count from 1. */
    List<String> services() {
        return services;
    }

    int xSteps(double xM) {
        return steps(xM - leftM);
    }

    int ySteps(double yM) {
        return steps(yM - bottomM);
    }

    private int steps(double distanceM) {
        return Math.clamp(Math.round(distanceM / stepM), 0, MOST_STEPS);
    }

    /**
     * An obstacle that is not where the world file has it.
     *
     * @param xSteps x, y and heading are as in a frame
     * @param headingSteps {@link #TAKEN_OUT} if it is not in the world
     */
    record Displaced(int index, int xSteps, int ySteps, int headingSteps) {
        /** No heading has this value. */
        static final int TAKEN_OUT = Short.MIN_VALUE;
    }

    /** The obstacles that have moved by a step or more, or were taken out. */
    List<Displaced> displaced(Snapshot snapshot) {
        var displaced = snapshot.displaced(spec);
        if (displaced.isEmpty()) {
            return List.of();
        }
        List<Displaced> moved = new ArrayList<>();
        displaced.forEach((index, pose) -> {
            var now =
                    pose.map(there -> displaced(index, there)).orElse(new Displaced(index, 0, 0, Displaced.TAKEN_OUT));
            if (!now.equals(displaced(index, spec.obstacles().get(index).pose()))) {
                moved.add(now);
            }
        });
        return moved;
    }

    private Displaced displaced(int index, Pose pose) {
        return new Displaced(index, xSteps(pose.x()), ySteps(pose.y()), headingSteps(pose.headingRad()));
    }

    /** Steps of 0.0001 rad. */
    static int headingSteps(double headingRad) {
        return (int) StrictMath.round(StrictMath.IEEEremainder(headingRad, 2 * StrictMath.PI) * 1e4);
    }

    /** The description for the page. */
    String json() {
        return json;
    }

    private String describe(List<String> services, List<String> controls) {
        var colours = ServiceColours.of(services);
        Map<String, Integer> kinds = new LinkedHashMap<>(); // descriptions of bodies; most robots of a crowd are alike
        List<Json> robots = new ArrayList<>();
        for (RobotSpec robot : spec.robots()) {
            String kind = kind(robot);
            robots.add(new Json()
                    .put("name", robot.name())
                    .put("colour", robot.colour())
                    .put("kind", kinds.computeIfAbsent(kind, each -> kinds.size())));
        }
        return new Json()
                .put("program", RunLog.PROGRAM)
                .put("name", spec.name())
                .put("interval", spec.intervalMillis() / 1000.0)
                .put("left", leftM)
                .put("bottom", bottomM)
                .put("step", stepM)
                .put(
                        "services",
                        Json.objects(services.stream()
                                .map(each -> new Json().put("name", each).put("colour", colours.colour(each)))
                                .toList()))
                .put("controls", Json.texts(controls))
                .put("kinds", new Json.Fragment("[" + String.join(",", kinds.keySet()) + "]"))
                .put("robots", Json.objects(robots))
                .put(
                        "obstacles",
                        Json.objects(spec.obstacles().stream()
                                .map(ViewedWorld::obstacle)
                                .toList()))
                .toString();
    }

    private static Json obstacle(ObstacleSpec obstacle) {
        return new Json()
                .put("name", obstacle.name())
                .put("colour", obstacle.colour())
                .put("pose", new Json.Fragment(mount(obstacle.pose())))
                .put("outlines", outlines(obstacle.shape()));
    }

    private static String kind(RobotSpec robot) {
        var kind = new Json().put("outlines", outlines(robot.shape()));
        kind.put(
                "cargo",
                Json.objects(robot.cargo().stream()
                        .map(each -> new Json().put("colour", each.colour()).put("outlines", outlines(each.shape())))
                        .toList()));
        if (robot.sonar() != null) {
            kind.put(
                    "sonar",
                    new Json()
                            .put("most", robot.sonar().maxRangeM())
                            .put("mounts", list(robot.sonar().mounts().stream().map(ViewedWorld::mount))));
        }
        kind.put("sensors", list(robot.rangers().stream().flatMap(ViewedWorld::sensors)));
        BlobfinderSpec camera = robot.blobfinder();
        if (camera != null) {
            kind.put(
                    "camera",
                    new Json()
                            .put("mount", new Json.Fragment(mount(camera.mount())))
                            .put("width", camera.widthPx())
                            .put("range", camera.rangeM())
                            .put("fov", camera.fovRad()));
        }
        if (!robot.devices().isEmpty()) {
            kind.put("devices", list(robot.devices().stream().map(ViewedWorld::device)));
        }
        return kind.toString();
    }

    private static String device(DeviceSpec device) {
        var json = new Json().put("interface", device.interfaceName());
        switch (device) {
            case DeviceSpec.FiducialFinder finder -> json.put("mount", new Json.Fragment(mount(finder.mount())));
            case DeviceSpec.Bumpers(var parts) ->
                json.put(
                        "parts",
                        Json.objects(parts.stream()
                                .map(part -> new Json()
                                        .put("mount", new Json.Fragment(mount(part.mount())))
                                        .put("length", part.lengthM()))
                                .toList()));
            case DeviceSpec.Gripper gripper ->
                json.put("mount", new Json.Fragment(mount(gripper.mount())))
                        .put("length", gripper.lengthM())
                        .put("width", gripper.widthM())
                        .put("paddleLength", gripper.paddleLength())
                        .put("paddleWidth", gripper.paddleWidth());
            case DeviceSpec.Camera camera ->
                json.put("mount", new Json.Fragment(mount(camera.mount())))
                        .put("range", camera.rangeM())
                        .put("fov", camera.fovRad());
        }
        return json.toString();
    }

    /** The sensors of a laser or ranger, in the frame of the robot. */
    private static Stream<String> sensors(RangerSpec ranger) {
        return ranger.sensors().stream()
                .map(each -> new Json()
                        .put("mount", new Json.Fragment(mount(each.mount())))
                        .put("samples", each.samples())
                        .put("fov", each.fovRad())
                        .put("most", each.maxRangeM())
                        .toString());
    }

    private static Json.Fragment outlines(Shape shape) {
        return list(shape.outlines().stream()
                .map(line -> line.stream()
                        .map(point -> number(point.x()) + "," + number(point.y()))
                        .collect(Collectors.joining(",", "[", "]"))));
    }

    private static String mount(Pose pose) {
        return "[" + number(pose.x()) + "," + number(pose.y()) + "," + number(pose.headingRad()) + "]";
    }

    private static Json.Fragment list(Stream<String> values) {
        return new Json.Fragment(values.collect(Collectors.joining(",", "[", "]")));
    }

    /** With tenths of a millimetre. */
    private static String number(double value) {
        String text = String.format(Locale.ROOT, "%.4f", value);
        return text.contains(".") ? text.replaceAll("\\.?0+$", "") : text;
    }
}
