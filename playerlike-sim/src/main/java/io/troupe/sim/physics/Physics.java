package io.troupe.sim.physics;

import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.Shape;
import java.nio.ByteBuffer;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.zip.CRC32;
import org.jbox2d.callbacks.ContactImpulse;
import org.jbox2d.callbacks.ContactListener;
import org.jbox2d.collision.Manifold;
import org.jbox2d.collision.shapes.MassData;
import org.jbox2d.collision.shapes.PolygonShape;
import org.jbox2d.common.MathUtils;
import org.jbox2d.common.Settings;
import org.jbox2d.common.Vec2;
import org.jbox2d.dynamics.Body;
import org.jbox2d.dynamics.BodyDef;
import org.jbox2d.dynamics.BodyType;
import org.jbox2d.dynamics.Fixture;
import org.jbox2d.dynamics.FixtureDef;
import org.jbox2d.dynamics.World;
import org.jbox2d.dynamics.contacts.Contact;
import org.jbox2d.pooling.normal.DefaultWorldPool;
import org.jspecify.annotations.Nullable;

/**
 * Motion and collisions of the robots.
 *
 * <p><b>Role.</b> Hides jbox2d. An unobstructed robot drives exactly the commanded arc. Walls and other robots stop it,
 * push it aside and cause friction (coefficient 0.3, no bounce).
 *
 * <p><b>Order.</b> First all obstacles are added, then the robots by index; then the steps are run. Between steps,
 * robots may leave and come back, and obstacles may be taken away and put elsewhere.
 *
 * <p><b>Threads.</b> One thread at a time.
 *
 * <p><b>Units and shapes.</b> SI. Bodies count as touching when their gap is at most {@link #SKIN_M}, so a robot that
 * drives against a wall comes to rest one to two centimetres before it.
 */
public final class Physics {
    /** Largest gap at which bodies touch: each jbox2d polygon has a skin of half of it. */
    public static final double SKIN_M = 0.02;

    /** Largest distance that a body may move in one step. */
    public static final double MAX_TRAVEL_M = Settings.maxTranslation;

    /** Largest angle that a body may turn in one step. */
    public static final double MAX_TURN_RAD = Settings.maxRotation;

    /**
     * Spacing of the grid of anchor points. The polygons of an obstacle that are nearest to the same anchor share a
     * body there. jbox2d computes the area and the centre of a polygon in single precision relative to the origin of
     * its body, and robots pass through a polygon that is far from it.
     */
    private static final double ANCHOR_SPACING_M = 32;

    private static final float FRICTION = 0.3f;
    private static final int VELOCITY_ITERATIONS = 8;
    private static final int POSITION_ITERATIONS = 3;
    /**
     * Objects of each type in jbox2d's pools, which by default have 100. At most three are in use at a time; if there
     * were too few, jbox2d would throw.
     */
    private static final int POOLED = 8;

    private final BodyCells cells = new BodyCells();
    private final World world;
    private final List<RobotBody> robots = new ArrayList<>();
    private final Map<Shape, FatBoxes.Vertices> vertices = new HashMap<>();
    private final RobotBody.Directions directions = new RobotBody.Directions();
    private final Gliders gliders;
    private final TouchTracker touches;
    private final int robotCount;
    private final int stepMicros;
    private final boolean mayGlide;
    private @Nullable Body firstOfList; // the head of jbox2d's list of bodies
    private final List<Body> obstacleBodies = new ArrayList<>();
    private int obstacleCount;
    private long timeMicros;
    private boolean changed; // something has come or gone since the last step

    /**
     * Creates a world without bodies.
     *
     * @param stepMicros must be so short that no robot travels farther than half of its smallest extent in one step;
     *     with longer steps it may pass through walls
     */
    public Physics(int robotCount, int stepMicros) {
        this(robotCount, stepMicros, true);
    }

    /**
     * Creates a world in which obstacles move too. They have to be added after the robots, as robots without commands:
     * in each step they lose the speed that a robot has given them.
     *
     * @param movers indices of the obstacles that move
     */
    public static Physics withMovers(int robotCount, int stepMicros, List<Integer> movers) {
        return new Physics(
                robotCount + movers.size(),
                stepMicros,
                true,
                movers.stream().mapToInt(Integer::intValue).toArray());
    }

    /**
     * @param mayGlide whether robots with nothing near them may make their steps without jbox2d; this changes only the
     *     run time
     */
    Physics(int robotCount, int stepMicros, boolean mayGlide) {
        this(robotCount, stepMicros, mayGlide, new int[0]);
    }

    private Physics(int robotCount, int stepMicros, boolean mayGlide, int[] movers) {
        this.robotCount = robotCount;
        this.stepMicros = stepMicros;
        this.mayGlide = mayGlide;
        touches = new TouchTracker(robotCount, movers);
        world = new World(new Vec2(0, 0), new DefaultWorldPool(POOLED, POOLED), cells);
        world.setAllowSleep(false);
        world.setContinuousPhysics(false);
        world.setContactListener(touches);
        gliders = new Gliders(robots, robotCount, cells);
    }

    /**
     * True if jbox2d's sine table has the same values here as on other machines; if not, trajectories may differ from
     * theirs.
     */
    public static boolean hasStandardSineTable() {
        return SineTable.STANDARD;
    }

    private static final class SineTable {
        /** Of the sines by StrictMath in single precision. The checksum takes far less time than those in a new JVM. */
        private static final long CHECKSUM = 0xB5A468BAL;

        static final boolean STANDARD = checksum() == CHECKSUM;

        private static long checksum() {
            ByteBuffer bytes = ByteBuffer.allocate(Float.BYTES * MathUtils.sinLUT.length);
            bytes.asFloatBuffer().put(MathUtils.sinLUT);
            var checksum = new CRC32();
            checksum.update(bytes);
            return checksum.getValue();
        }
    }

    /** Adds the next obstacle; it has an index even if it blocks nothing and its shape is empty. */
    public void addObstacle(Pose pose, Shape shape) {
        if (!robots.isEmpty()) {
            throw new IllegalStateException("obstacles come before robots");
        }
        build(robotCount + obstacleCount++, pose, shape);
    }

    /** Takes an obstacle away; it keeps its index. */
    public void removeObstacle(int obstacle) {
        obstacleBodies.removeIf(body -> {
            boolean leaves = TouchTracker.id(body) == robotCount + obstacle;
            if (leaves) {
                world.destroyBody(body);
            }
            return leaves;
        });
        changed = true;
    }

    /** Puts an obstacle at a pose, where no robot may be. It leaves the place where it was. */
    public void placeObstacle(int obstacle, Pose pose, Shape shape) {
        removeObstacle(obstacle);
        build(robotCount + obstacle, pose, shape);
    }

    private void build(int id, Pose pose, Shape shape) {
        Map<Pose, Body> bodies = new LinkedHashMap<>();
        for (List<Point> polygon : shape.polygons()) {
            // placed in double precision: jbox2d's sine is accurate to only half a millimetre at ten metres
            List<Point> placed = polygon.stream().map(pose::place).toList();
            Pose anchor = anchor(placed);
            Body body = bodies.computeIfAbsent(anchor, each -> createBody(BodyType.STATIC, each, id));
            addFixture(
                    body,
                    fixture(placed.stream()
                            .map(vertex -> new Point(vertex.x() - anchor.x(), vertex.y() - anchor.y()))
                            .toList()));
        }
        obstacleBodies.addAll(bodies.values());
    }

    /** The anchor point nearest to the middle of a polygon; exact in single precision. */
    private static Pose anchor(List<Point> polygon) {
        var x = polygon.stream().mapToDouble(Point::x).summaryStatistics();
        var y = polygon.stream().mapToDouble(Point::y).summaryStatistics();
        return new Pose(nearestAnchor((x.getMin() + x.getMax()) / 2), nearestAnchor((y.getMin() + y.getMax()) / 2), 0);
    }

    private static double nearestAnchor(double at) {
        return ANCHOR_SPACING_M * StrictMath.rint(at / ANCHOR_SPACING_M) + 0.0; // no negative zero
    }

    /** Adds the next robot; the origin of its shape is the centre of rotation. */
    public void addRobot(Pose pose, Shape shape, double massKg) {
        addRobot(pose, shape, massKg, true);
    }

    /**
     * Adds the next robot; the origin of its shape is the centre of rotation.
     *
     * @param blocksBodies false if it collides with nothing
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
            proxies[i] = addFixture(body, fixture);
        }
        setMass(body, massKg);
        var fatBoxes = new FatBoxes(cells, proxies, vertices.computeIfAbsent(shape, FatBoxes.Vertices::new));
        robots.add(new RobotBody(body, fatBoxes, directions, pose, stepMicros));
    }

    /** Adds a polygon. Returns the number of its proxy, which is also its user data. */
    private int addFixture(Body body, FixtureDef definition) {
        Fixture fixture = body.createFixture(definition);
        int proxy = cells.newestProxy();
        fixture.setUserData(proxy);
        return proxy;
    }

    /** Holds a robot that overlaps something in place, like an obstacle, until it is teleported. */
    public void hold(int robot) {
        robots.get(robot).hold();
    }

    /** Takes a robot out of the world until it is teleported. It touches nothing, and stands still. */
    public void removeRobot(int robot) {
        robots.get(robot).leave();
        changed = true;
    }

    /** True if a robot is held in place. */
    public boolean isHeld(int robot) {
        return robots.get(robot).isHeld();
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

    /** Sets a robot's speed, until it is set again. */
    public void drive(int robot, double forwardMps, double turnRadps) {
        drive(robot, forwardMps, 0, turnRadps);
    }

    /** Sets the speed of a robot that can move sideways (left positive), until it is set again. */
    public void drive(int robot, double forwardMps, double sidewaysMps, double turnRadps) {
        robots.get(robot).drive(forwardMps, sidewaysMps, turnRadps);
    }

    /** Moves a robot to a pose; its current touches end. */
    public void teleport(int robot, Pose pose) {
        robots.get(robot).teleport(pose);
    }

    /**
     * Advances by this number of steps.
     *
     * <p><b>Cost.</b> Robots that nothing can touch in these steps make all of them at once, without jbox2d. In each
     * step jbox2d handles only the others.
     */
    public void advance(int steps) {
        gliders.begin(steps);
        for (int step = 0; step < steps; step++) {
            gliders.select(step, mayGlide && timeMicros > 0 && !changed); // jbox2d has to find and end contacts
            changed = false;
            step(gliders);
        }
    }

    private void step(Gliders each) {
        for (int i = 0; i < each.awakeCount(); i++) {
            robots.get(each.awake(i)).push();
        }
        timeMicros += stepMicros;
        if (each.awakeCount() > 0) {
            list(each);
            world.step(stepMicros / 1e6f, VELOCITY_ITERATIONS, POSITION_ITERATIONS);
        }
        touches.settle(timeMicros);
        for (int i = 0; i < each.awakeCount(); i++) {
            int robot = each.awake(i);
            robots.get(robot).settle(touches.touched(robot));
        }
    }

    /**
     * Leaves only the robots of this step in jbox2d's list of bodies, in their order, which is from the newest to the
     * oldest. Obstacles need not be in it: jbox2d finds them by their contacts.
     */
    private void list(Gliders each) {
        Body last = firstOfList;
        if (last == null) {
            last = createBody(BodyType.STATIC, Pose.ORIGIN, robotCount + obstacleCount);
            firstOfList = last;
        }
        for (int i = each.awakeCount() - 1; i >= 0; i--) {
            Body next = robots.get(each.awake(i)).body();
            last.m_next = next;
            last = next;
        }
        last.m_next = null;
    }

    /** X coordinate of a robot's centre of rotation. */
    public double x(int robot) {
        return robots.get(robot).x();
    }

    /** Y coordinate of a robot's centre of rotation. */
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
     * True if a body touches or overlaps the robot, and in the last 0.2 s the robot achieved less than half of the
     * commanded motion.
     */
    public boolean stalled(int robot) {
        return (touches.touched(robot) || robots.get(robot).isHeld())
                && !robots.get(robot).isAway()
                && robots.get(robot).heldBack();
    }

    /** The touches that began since the last {@link #forgetTouches}; always the same object. */
    public Touches touches() {
        return touches.begun();
    }

    public void forgetTouches() {
        touches.begun().clear();
    }

    /** Heading of the robot's body in jbox2d. */
    double bodyHeadingRad(int robot) {
        return robots.get(robot).bodyHeadingRad();
    }

    BodyCells cells() {
        return cells;
    }

    /**
     * Tracks which bodies touch. Bodies have ids: robots from 0, obstacles after them.
     *
     * <p>jbox2d reports contacts of fixtures, and does so inside its step, where its world must not be changed. The
     * callbacks therefore only write to a buffer, and {@link #settle} converts it into pairs of bodies after the step.
     * Two bodies touch once, however many of their polygons do.
     */
    private static final class TouchTracker implements ContactListener {
        private static final long END = 1L << 63;

        private final TouchingPairs open = new TouchingPairs();
        private final Touches begun;
        private final boolean[] touched;
        private long[] buffer = new long[64];
        private int buffered;
        private long[] started = new long[64];
        private int startedCount;
        private boolean recent; // the last step had contact events, so `touched` may contain a touch that has ended

        TouchTracker(int robotCount, int[] movers) {
            touched = new boolean[robotCount];
            begun = new Touches(robotCount, movers);
        }

        @Override
        public void beginContact(Contact contact) {
            append(pair(contact));
        }

        @Override
        public void endContact(Contact contact) {
            append(pair(contact) | END);
        }

        @Override
        public void preSolve(Contact contact, Manifold oldManifold) {}

        @Override
        public void postSolve(Contact contact, ContactImpulse impulse) {}

        private void append(long event) {
            if (buffered == buffer.length) {
                buffer = Arrays.copyOf(buffer, 2 * buffered);
            }
            buffer[buffered++] = event;
        }

        private static long pair(Contact contact) {
            int a = id(contact.getFixtureA().getBody());
            int b = id(contact.getFixtureB().getBody());
            return (long) Math.min(a, b) << 32 | Math.max(a, b);
        }

        private static int id(Body body) {
            return (Integer) body.getUserData();
        }

        /** Processes the contact events of the step that ended at this time. */
        void settle(long timeMicros) {
            if (buffered == 0 && !recent) {
                return;
            }
            recent = buffered > 0;
            open.remember();
            startedCount = 0;
            Arrays.fill(touched, false);
            for (int i = 0; i < buffered; i++) {
                take(buffer[i]);
            }
            buffered = 0;
            for (int i = 0; i < open.size(); i++) {
                mark(open.pair(i));
            }
            Arrays.sort(started, 0, startedCount);
            for (int i = 0; i < startedCount; i++) {
                if (i == 0 || started[i] != started[i - 1]) {
                    begun.add(timeMicros, started[i]);
                }
            }
        }

        private void take(long event) {
            long pair = event & ~END;
            mark(pair);
            if (event < 0) {
                open.end(pair);
                return;
            }
            open.begin(pair);
            if (!open.touchedBefore(pair)) {
                if (startedCount == started.length) {
                    started = Arrays.copyOf(started, 2 * startedCount);
                }
                started[startedCount++] = pair;
            }
        }

        private void mark(long pair) {
            touched[(int) (pair >> 32)] = true;
            if ((int) pair < touched.length) {
                touched[(int) pair] = true;
            }
        }

        /** True if anything touched the robot in the last step. */
        boolean touched(int robot) {
            return touched[robot];
        }

        Touches begun() {
            return begun;
        }

        /** Sorted pairs of touching bodies, with the number of polygon contacts of each pair. */
        private static final class TouchingPairs {
            private long[] pairs = new long[64];
            private int[] counts = new int[64];
            private long[] before = new long[64]; // the pairs at the last call of `remember`
            private int size;
            private int sizeBefore;

            int size() {
                return size;
            }

            long pair(int i) {
                return pairs[i];
            }

            void remember() {
                if (before.length < size) {
                    before = new long[pairs.length];
                }
                System.arraycopy(pairs, 0, before, 0, size);
                sizeBefore = size;
            }

            /** True if the bodies touched at the last call of {@link #remember}. */
            boolean touchedBefore(long pair) {
                return Arrays.binarySearch(before, 0, sizeBefore, pair) >= 0;
            }

            void begin(long pair) {
                int at = Arrays.binarySearch(pairs, 0, size, pair);
                if (at >= 0) {
                    counts[at]++;
                    return;
                }
                if (size == pairs.length) {
                    pairs = Arrays.copyOf(pairs, 2 * size);
                    counts = Arrays.copyOf(counts, 2 * size);
                }
                int to = -at - 1;
                System.arraycopy(pairs, to, pairs, to + 1, size - to);
                System.arraycopy(counts, to, counts, to + 1, size - to);
                pairs[to] = pair;
                counts[to] = 1;
                size++;
            }

            void end(long pair) {
                int at = Arrays.binarySearch(pairs, 0, size, pair);
                if (at >= 0 && --counts[at] == 0) {
                    size--;
                    System.arraycopy(pairs, at + 1, pairs, at, size - at);
                    System.arraycopy(counts, at + 1, counts, at, size - at);
                }
            }
        }
    }
}
