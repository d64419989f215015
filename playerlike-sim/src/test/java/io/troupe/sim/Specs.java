package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.common.text.SourcePosition;
import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.CargoSpec;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.ScenarioReader;
import java.lang.reflect.RecordComponent;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.List;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/** World specifications for tests, built in code, and worlds made of them. */
public final class Specs {
    public static final int BLACK = 0x000000;
    public static final int RED = 0xFF0000;
    public static final int GREEN = 0x00FF00;
    public static final int BLUE = 0x0000FF;
    public static final int ORANGE = 0xFFA500;
    /** The robot "r1" at the origin. */
    public static final RobotSpec R1 = robot("r1", Pose.ORIGIN);

    private static final double DEGREE = StrictMath.PI / 180;

    private Specs() {}

    public static WorldSpec world(List<RobotSpec> robots, List<ObstacleSpec> obstacles) {
        return new WorldSpec("test", Path.of("test.world"), 100, robots, obstacles);
    }

    public static WorldSpec world(List<RobotSpec> robots, ObstacleSpec... obstacles) {
        return world(robots, List.of(obstacles));
    }

    public static WorldSpec world(RobotSpec robot, ObstacleSpec... obstacles) {
        return world(List.of(robot), List.of(obstacles));
    }

    public static World start(RobotSpec robot, ObstacleSpec... obstacles) {
        return start(List.of(robot), obstacles);
    }

    public static World start(List<RobotSpec> robots, ObstacleSpec... obstacles) {
        return World.create(world(robots, obstacles), WorldSettings.defaults());
    }

    /** The world of this world file. */
    static World start(String text) {
        return World.create(ScenarioReader.readText(text, Path.of("t.world")).world(), WorldSettings.defaults());
    }

    /** The world, with the command to all its robots to drive straight on. */
    static World driven(double forwardMps, World world) {
        for (int robot = 0; robot < world.spec().robots().size(); robot++) {
            world.command(robot, forwardMps, 0);
        }
        return world;
    }

    /** Advances interval by interval, and returns what the first robot reads then. */
    public static RobotReading run(World world, int ticks) {
        for (int i = 0; i < ticks; i++) {
            world.advance();
        }
        return first(world.latest());
    }

    static RobotReading first(Snapshot snapshot) {
        return snapshot.robots().getFirst();
    }

    public static SourcePosition at(int line) {
        return new SourcePosition(Path.of("test.world"), line, 1);
    }

    /** A rectangle around the origin. */
    public static Shape box(double lengthM, double widthM) {
        return box(lengthM, widthM, 0);
    }

    /** A rectangle whose centre lies at the given point of the body's frame. */
    public static Shape box(double lengthM, double widthM, double centreX) {
        double west = centreX - lengthM / 2;
        double east = centreX + lengthM / 2;
        double y = widthM / 2;
        return new Shape(
                List.of(List.of(new Point(west, -y), new Point(east, -y), new Point(east, y), new Point(west, y))));
    }

    /** A black box that blocks everything. */
    public static ObstacleSpec wall(String name, double x, double y, double lengthM, double widthM) {
        return box(name, new Pose(x, y, 0), lengthM, widthM, BLACK);
    }

    public static ObstacleSpec box(String name, Pose pose, double lengthM, double widthM, int colour) {
        return obstacle(name, pose, box(lengthM, widthM), colour);
    }

    /** An obstacle that blocks everything and is seen. */
    public static ObstacleSpec obstacle(String name, Pose pose, Shape shape, int colour) {
        return new ObstacleSpec(name, pose, shape, colour, true, true, true, at(1));
    }

    /** Four black walls, 0.2 m thick, around a square with this inner side. */
    public static List<ObstacleSpec> arena(double sideM) {
        double out = sideM / 2 + 0.1;
        return List.of(
                wall("east", out, 0, 0.2, sideM + 0.4),
                wall("north", 0, out, sideM + 0.4, 0.2),
                wall("west", -out, 0, 0.2, sideM + 0.4),
                wall("south", 0, -out, sideM + 0.4, 0.2));
    }

    /** 0.44 m x 0.38 m, centre of rotation 4 cm ahead of the middle, no devices. */
    public static RobotSpec robot(String name, Pose pose) {
        return robot(name, pose, ORANGE, null, null);
    }

    public static RobotSpec robot(String name, double x, double y, double headingRad) {
        return robot(name, new Pose(x, y, headingRad));
    }

    public static RobotSpec robot(
            String name, Pose pose, int colour, @Nullable SonarSpec sonar, @Nullable BlobfinderSpec blobfinder) {
        Shape shape = box(0.44, 0.38, -0.04);
        Pose origin = new Pose(-0.04, 0, 0);
        Pose start = Pose.ORIGIN;
        List<RangerSpec> none = List.of();
        return new RobotSpec(
                name, pose, shape, colour, 0.44, 0.38, 23, origin, start, sonar, blobfinder, none, true, true, at(7));
    }

    /** The robot with another value of one component. */
    public static RobotSpec with(RobotSpec robot, String name, Object value) {
        RecordComponent[] components = RobotSpec.class.getRecordComponents();
        assertThat(components).extracting(RecordComponent::getName).contains(name);
        Class<?>[] types = Stream.of(components).map(RecordComponent::getType).toArray(Class[]::new);
        var values = new Object[types.length];
        try {
            for (int i = 0; i < values.length; i++) {
                boolean replaced = components[i].getName().equals(name);
                values[i] = replaced ? value : components[i].getAccessor().invoke(robot);
            }
            return RobotSpec.class.getDeclaredConstructor(types).newInstance(values);
        } catch (ReflectiveOperationException e) {
            throw new AssertionError(e);
        }
    }

    /** The robot with this cargo. */
    public static RobotSpec carrying(RobotSpec robot, boolean visible, List<CargoSpec> cargo) {
        return with(with(robot, "visible", visible), "cargo", cargo);
    }

    /** Sonars in the robot's centre, facing these directions. */
    public static SonarSpec sonars(double... headingsDeg) {
        var mounts = Arrays.stream(headingsDeg).mapToObj(heading -> new Pose(0, 0, heading * DEGREE));
        return new SonarSpec(mounts.toList(), 0, 5, 15 * DEGREE);
    }

    /** The front half of a Pioneer's ring. */
    public static SonarSpec pioneerFront() {
        double[][] ring = {
            {0.075, 0.130, 90}, {0.115, 0.115, 50}, {0.150, 0.080, 30}, {0.170, 0.025, 10},
            {0.170, -0.025, -10}, {0.150, -0.080, -30}, {0.115, -0.115, -50}, {0.075, -0.130, -90}
        };
        var mounts = Arrays.stream(ring).map(mount -> new Pose(mount[0], mount[1], mount[2] * DEGREE));
        return new SonarSpec(mounts.toList(), 0, 5, 15 * DEGREE);
    }

    /** 80 x 60 pixels, 60 degrees, in the robot's centre. */
    public static BlobfinderSpec camera(double rangeM, Integer... colours) {
        return new BlobfinderSpec(Pose.ORIGIN, 80, 60, rangeM, 60 * DEGREE, List.of(colours));
    }
}
