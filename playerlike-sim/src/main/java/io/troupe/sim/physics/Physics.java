package io.troupe.sim.physics;

import io.troupe.sim.scenario.Point;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.Shape;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import org.jbox2d.collision.shapes.MassData;
import org.jbox2d.collision.shapes.PolygonShape;
import org.jbox2d.common.MathUtils;
import org.jbox2d.common.Settings;
import org.jbox2d.common.Vec2;
import org.jbox2d.dynamics.Body;
import org.jbox2d.dynamics.BodyDef;
import org.jbox2d.dynamics.BodyType;
import org.jbox2d.dynamics.FixtureDef;
import org.jbox2d.dynamics.World;
import org.jbox2d.pooling.normal.DefaultWorldPool;

/**
 * How robots move and what they bump into.
 *
 * <p><b>Role.</b> Hides jbox2d. A robot drives exactly the arc it is told to while nothing is in its way; walls and
 * other robots hold it back, push it aside and rub (friction 0.3, no bounce).
 *
 * <p><b>Order.</b> All obstacles are added first, then the robots by index, then come the steps.
 *
 * <p><b>Threads.</b> One thread at a time.
 *
 * <p><b>Units and shapes.</b> SI. Bodies count as touching from a gap of {@link #SKIN_M} on, so a robot that drives
 * against a wall comes to rest between one and two centimetres before it.
 */
public final class Physics {
    /** Bodies as near as this touch: each polygon of jbox2d has a skin of half of it. */
    public static final double SKIN_M = 0.02;

    /** No body may move farther in one step. */
    public static final double MAX_TRAVEL_M = Settings.maxTranslation;

    /** No body may turn farther in one step. */
    public static final double MAX_TURN_RAD = Settings.maxRotation;

    /**
     * The polygons of an obstacle that are nearest to the same point of a grid share a body there: jbox2d computes the
     * area and the centre of a polygon in single precision from the origin of its body, and robots pass through one
     * that is far from it.
     */
    private static final double ANCHOR_SPACING_M = 32;

    private static final float FRICTION = 0.3f;
    private static final int VELOCITY_ITERATIONS = 8;
    private static final int POSITION_ITERATIONS = 3;

    private final RepairedTree tree;
    private final World world;
    private final List<RobotBody> robots = new ArrayList<>();
    private final TouchLedger touches;
    private final int robotCount;
    private final int stepMicros;
    private final boolean mayGlide;
    private int obstacleCount;
    private long timeMicros;

    /**
     * A world without bodies.
     *
     * @param stepMicros so short that no robot travels farther in it than half of its smallest extent; in longer ones
     *     it may pass walls
     */
    public Physics(int robotCount, int stepMicros) {
        this(robotCount, stepMicros, true);
    }

    /**
     * @param mayGlide whether robots that nothing is near may make their steps without jbox2d: that changes nothing but
     *     the time it takes
     */
    Physics(int robotCount, int stepMicros, boolean mayGlide) {
        this.robotCount = robotCount;
        this.stepMicros = stepMicros;
        this.mayGlide = mayGlide;
        touches = new TouchLedger(robotCount);
        tree = new RepairedTree();
        world = new World(
                new Vec2(0, 0), new DefaultWorldPool(World.WORLD_POOL_SIZE, World.WORLD_POOL_CONTAINER_SIZE), tree);
        world.setAllowSleep(false);
        world.setContinuousPhysics(false);
        world.setContactListener(touches);
    }

    /**
     * Whether jbox2d's table of sines holds here what it holds on other machines; if not, trajectories may differ from
     * theirs.
     */
    public static boolean hasStandardSineTable() {
        return SineTable.STANDARD;
    }

    private static final class SineTable {
        static final boolean STANDARD = compare();

        private static boolean compare() {
            for (int i = 0; i < MathUtils.sinLUT.length; i++) {
                if (MathUtils.sinLUT[i] != (float) StrictMath.sin(i * Settings.SINCOS_LUT_PRECISION)) {
                    return false;
                }
            }
            return true;
        }
    }

    /** Adds the next obstacle; it has an index even if it blocks nothing and its shape is empty. */
    public void addObstacle(Pose pose, Shape shape) {
        if (!robots.isEmpty()) {
            throw new IllegalStateException("obstacles come before robots");
        }
        int id = robotCount + obstacleCount++;
        Map<Pose, Body> bodies = new HashMap<>();
        for (List<Point> polygon : shape.polygons()) {
            // placed in double precision: jbox2d's own sine is only good to half a millimetre at ten metres
            List<Point> placed = polygon.stream().map(pose::place).toList();
            Pose anchor = anchor(placed);
            Body body = bodies.computeIfAbsent(anchor, each -> createBody(BodyType.STATIC, each, id));
            body.createFixture(fixture(placed.stream()
                    .map(vertex -> new Point(vertex.x() - anchor.x(), vertex.y() - anchor.y()))
                    .toList()));
        }
    }

    /** The point of a coarse grid that is nearest to the middle of a polygon; exact in single precision. */
    private static Pose anchor(List<Point> polygon) {
        var x = polygon.stream().mapToDouble(Point::x).summaryStatistics();
        var y = polygon.stream().mapToDouble(Point::y).summaryStatistics();
        return new Pose(nearestAnchor((x.getMin() + x.getMax()) / 2), nearestAnchor((y.getMin() + y.getMax()) / 2), 0);
    }

    private static double nearestAnchor(double at) {
        return ANCHOR_SPACING_M * StrictMath.rint(at / ANCHOR_SPACING_M) + 0.0; // no negative zero
    }

    /** Adds the next robot; the origin of its shape is the centre it turns about. */
    public void addRobot(Pose pose, Shape shape, double massKg) {
        addRobot(pose, shape, massKg, true);
    }

    /**
     * Adds the next robot; the origin of its shape is the centre it turns about.
     *
     * @param blocksBodies if not, it touches nothing and nothing touches it
     */
    public void addRobot(Pose pose, Shape shape, double massKg, boolean blocksBodies) {
        Body body = createBody(BodyType.DYNAMIC, pose, robots.size());
        body.setSleepingAllowed(false);
        var proxies = new int[shape.polygons().size()];
        for (int i = 0; i < proxies.length; i++) {
            FixtureDef fixture = fixture(shape.polygons().get(i));
            if (!blocksBodies) {
                fixture.filter.maskBits = 0;
            }
            body.createFixture(fixture);
            proxies[i] = tree.newestProxy();
        }
        setMass(body, massKg);
        robots.add(new RobotBody(body, new FatBoxes(tree, proxies, shape), pose, stepMicros));
    }

    /** Holds a robot that overlaps something where it is, as if it were an obstacle, until it is put elsewhere. */
    public void hold(int robot) {
        robots.get(robot).hold();
    }

    private Body createBody(BodyType type, Pose pose, int id) {
        var definition = new BodyDef();
        definition.type = type;
        definition.position.set((float) pose.x(), (float) pose.y());
        definition.angle = (float) StrictMath.IEEEremainder(pose.headingRad(), 2 * StrictMath.PI);
        definition.userData = id;
        return world.createBody(definition);
    }

    private static FixtureDef fixture(List<Point> polygon) {
        var vertices = new Vec2[polygon.size()];
        for (int i = 0; i < vertices.length; i++) {
            vertices[i] =
                    new Vec2((float) polygon.get(i).x(), (float) polygon.get(i).y());
        }
        var shape = new PolygonShape();
        shape.set(vertices, vertices.length);
        var definition = new FixtureDef();
        definition.shape = shape;
        definition.density = 1;
        definition.friction = FRICTION;
        definition.restitution = 0;
        return definition;
    }

    /** Spreads the mass evenly over the body. */
    private static void setMass(Body body, double massKg) {
        var data = new MassData();
        body.getMassData(data);
        float scale = (float) massKg / data.mass;
        data.mass *= scale;
        data.I *= scale;
        body.setMassData(data);
    }

    /** Sets a robot's speed, to hold until it is set again. */
    public void drive(int robot, double forwardMps, double turnRadps) {
        robots.get(robot).drive(forwardMps, turnRadps);
    }

    /** Puts a robot elsewhere, as it is; what it touched it touches no more. */
    public void teleport(int robot, Pose pose) {
        robots.get(robot).teleport(pose);
    }

    /** Advances by one step. */
    public void step() {
        for (int i = 0; i < robots.size(); i++) {
            robots.get(i).aim(mayGlide && timeMicros > 0);
        }
        world.step(stepMicros / 1e6f, VELOCITY_ITERATIONS, POSITION_ITERATIONS);
        timeMicros += stepMicros;
        touches.settle(timeMicros);
        for (int i = 0; i < robots.size(); i++) {
            robots.get(i).settle(touches.touched(i));
        }
    }

    /** Where a robot's centre of rotation is. */
    public double x(int robot) {
        return robots.get(robot).x();
    }

    /** Where a robot's centre of rotation is. */
    public double y(int robot) {
        return robots.get(robot).y();
    }

    /** A robot's heading, from -pi to pi. */
    public double headingRad(int robot) {
        return robots.get(robot).headingRad();
    }

    /** The pose of a robot's centre of rotation, the heading from -pi to pi. */
    public Pose pose(int robot) {
        return new Pose(x(robot), y(robot), headingRad(robot));
    }

    /**
     * Whether something touches or overlaps the robot and keeps it from half of what it was told to do in the last 0.2
     * s.
     */
    public boolean stalled(int robot) {
        return (touches.touched(robot) || robots.get(robot).isHeld())
                && robots.get(robot).heldBack();
    }

    /** The touches that began since the last {@link #forgetTouches}; always the same object. */
    public Touches touches() {
        return touches.begun();
    }

    public void forgetTouches() {
        touches.begun().clear();
    }

    /** What jbox2d holds for the heading. */
    double bodyHeadingRad(int robot) {
        return robots.get(robot).bodyHeadingRad();
    }

    RepairedTree tree() {
        return tree;
    }
}
