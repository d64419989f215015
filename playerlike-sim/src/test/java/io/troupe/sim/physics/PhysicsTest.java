package io.troupe.sim.physics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.Specs;
import io.troupe.sim.device.Scene;
import io.troupe.sim.device.Sonar;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.SonarSpec;
import io.troupe.tools.Thorough;
import java.util.ArrayList;
import java.util.DoubleSummaryStatistics;
import java.util.List;
import java.util.Random;
import java.util.TreeSet;
import java.util.function.Consumer;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.jbox2d.collision.AABB;
import org.jbox2d.collision.broadphase.DynamicTree;
import org.jbox2d.collision.shapes.PolygonShape;
import org.jbox2d.common.MathUtils;
import org.jbox2d.common.Settings;
import org.jbox2d.common.Vec2;
import org.jbox2d.dynamics.BodyDef;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class PhysicsTest {
    private static final int STEP_MICROS = 10_000;

    private static Physics physics(Pose... robots) {
        var physics = new Physics(robots.length, STEP_MICROS);
        for (Pose pose : robots) {
            physics.addRobot(pose, Specs.box(0.4, 0.3), 10);
        }
        return physics;
    }

    /** Robots in rows of ten, driving circles. */
    private static Physics circling(int robots, int apartM, int firstX) {
        Physics physics = physics(IntStream.range(0, robots)
                .mapToObj(i -> new Pose(i % 10 * apartM + firstX, i / 10 * apartM, i))
                .toArray(Pose[]::new));
        for (int robot = 0; robot < robots; robot++) {
            physics.drive(robot, 0.3, 0.5);
        }
        return physics;
    }

    private static void step(Physics physics, int steps) {
        physics.advance(steps);
    }

    @Test
    void robotsOnTheirOwn_hardlyConcernTheTree() {
        Physics physics = circling(30, 5, -20);
        step(physics, 1_000);
        BodyCells cells = physics.cells();
        assertThat(cells.reinsertCount())
                .as("of 30,000 steps")
                .isLessThan(3_000)
                .isPositive();
        assertThat(cells.moveCount()).as("of 30,000 steps").isLessThan(4_000);
    }

    @Test
    void angles_areWrapped_andPlacesFarOutCounted_soThatBothStayExact() {
        Physics physics = physics(Pose.ORIGIN);
        double perStep = StrictMath.PI / 500;
        physics.drive(0, 0, perStep * 100);
        step(physics, 100_000); // 100 turns
        assertThat(physics.pose(0).headingRad()).isCloseTo(0, within(1e-8));
        Physics far = physics(new Pose(300, 0, 0));
        far.drive(0, 0.1, 0);
        step(far, 6_000);
        assertThat(far.pose(0).x()).isCloseTo(306, within(1e-8)); // single precision alone would be 4 cm off
    }

    @Test
    void jbox2d_hasOurSineTableAndSkin_andObstaclesComeBeforeRobots() {
        assertThat(Physics.hasStandardSineTable()).isTrue();
        for (int i = 0; i < MathUtils.sinLUT.length; i++) {
            assertThat(MathUtils.sinLUT[i]).isEqualTo((float) StrictMath.sin(i * Settings.SINCOS_LUT_PRECISION));
        }
        assertThat(Physics.SKIN_M).isCloseTo(2.0 * Settings.polygonRadius, within(1e-8));
        Physics physics = circling(1, 2, -9);
        assertThatThrownBy(() -> physics.addObstacle(Pose.ORIGIN, Specs.box(1, 1)))
                .isInstanceOf(IllegalStateException.class);
    }

    @Test
    void body_followsThePose() {
        Physics physics = circling(9, 2, -9);
        step(physics, 5_000);
        for (int i = 0; i < 9; i++) {
            double apart = StrictMath.IEEEremainder(
                    physics.bodyHeadingRad(i) - physics.pose(i).headingRad(), 2 * StrictMath.PI);
            assertThat(apart).as("robot %d", i).isCloseTo(0, within(1e-6));
        }
    }

    // ---- the cells that take the place of jbox2d's tree

    private static final Vec2 STILL = new Vec2(0, 0);

    private final BodyCells cells = new BodyCells();

    private static AABB box(float minX, float minY, float maxX, float maxY) {
        return new AABB(new Vec2(minX, minY), new Vec2(maxX, maxY));
    }

    private List<Integer> query(float minX, float minY, float maxX, float maxY) {
        List<Integer> found = new ArrayList<>();
        cells.query(found::add, box(minX, minY, maxX, maxY));
        return found;
    }

    @Test
    void cells_keepTheirBoxesInMostMoves() {
        // so near each other that jbox2d moves them at every step
        Physics physics = physics(new Pose(0, 0.18, 0), new Pose(0, -0.18, 0));
        physics.drive(0, 0.3, 0);
        physics.drive(1, 0.3, 0);
        step(physics, 1_000);
        assertThat(physics.cells().moveCount()).isEqualTo(2_000);
        assertThat(physics.cells().reinsertCount())
                .as("of 2,000 moves")
                .isLessThan(2_000 / 10)
                .isPositive();
    }

    @Test
    void holds_isTrueForTheOuterBoxOnly() {
        assertThat(BodyCells.holds(box(0, 0, 3, 3), box(1, 1, 2, 2))).isTrue();
        assertThat(BodyCells.holds(box(1, 1, 2, 2), box(0, 0, 3, 3))).isFalse();
        assertThat(BodyCells.holds(box(0, 0, 3, 3), box(0, 0, 3, 3))).isTrue();
        assertThat(BodyCells.holds(box(0, 0, 3, 3), box(1, 1, 2, 4))).isFalse();
    }

    @Test
    void move_withinTheMargin_changesNothing_andOutOfItReinserts() {
        int proxy = cells.createProxy(box(0, 0, 1, 1), "body");
        AABB fat = new AABB(cells.getFatAABB(proxy));
        assertThat(cells.moveProxy(proxy, box(0.05f, 0, 1.05f, 1), STILL)).isFalse();
        assertThat(cells.getFatAABB(proxy).lowerBound).isEqualTo(fat.lowerBound);
        assertThat(cells.reinsertCount()).isZero();
        assertThat(cells.moveProxy(proxy, box(3, 0, 4, 1), STILL)).isTrue();
        assertThat(query(3.4f, 0.4f, 3.6f, 0.6f)).containsExactly(proxy);
        assertThat(query(0.4f, 0.4f, 0.6f, 0.6f)).isEmpty();
    }

    @Test
    void boxThatOutgrowsItsMarginOnAllSides_isStillFoundAtItsRim() {
        int proxy = cells.createProxy(box(0, 0, 1, 1), "body");
        assertThat(cells.moveProxy(proxy, box(-2, -2, 3, 3), STILL)).isTrue();
        assertThat(BodyCells.holds(cells.getFatAABB(proxy), box(-2, -2, 3, 3))).isTrue();
        assertThat(query(2.8f, 2.8f, 2.9f, 2.9f)).containsExactly(proxy);
        assertThat(query(6, -2, 7, 3)).as("where the detour went").isEmpty();
    }

    @Test
    void randomMoves_keepEveryBoxWithinItsFatBox() {
        long seed = 20260;
        var random = new Random(seed);
        int[] proxies = new int[40];
        for (int i = 0; i < proxies.length; i++) {
            proxies[i] = cells.createProxy(box(i, 0, i + 1, 1), i);
        }
        for (int move = 0; move < 20_000; move++) {
            int i = random.nextInt(proxies.length);
            float x = random.nextFloat() * 20;
            float y = random.nextFloat() * 20;
            AABB box = box(x, y, x + 5 * random.nextFloat(), y + 5 * random.nextFloat());
            cells.moveProxy(proxies[i], box, STILL);
            assertThat(BodyCells.holds(cells.getFatAABB(proxies[i]), box))
                    .as("seed %d, move %d", seed, move)
                    .isTrue();
        }
    }

    @Test
    void boxesOfAllSizes_overlapAsInJbox2dsTree() {
        long seed = 77;
        var random = new Random(seed);
        var tree = new DynamicTree();
        int[] ofTree = new int[300];
        for (int i = 0; i < ofTree.length; i++) {
            AABB box = randomBox(random, i % 30 == 0 ? 60 : 2);
            ofTree[i] = tree.createProxy(box, i);
            assertThat(cells.createProxy(box, i)).isEqualTo(i);
        }
        cells.destroyProxy(7);
        tree.destroyProxy(ofTree[7]);
        for (int query = 0; query < 2_000; query++) {
            AABB box = randomBox(random, query % 20 == 0 ? 80 : 3);
            var expected = new TreeSet<Object>();
            tree.query(proxy -> expected.add(tree.getUserData(proxy)), box);
            var found = new TreeSet<Object>();
            cells.query(proxy -> found.add(cells.getUserData(proxy)), box);
            assertThat(found).as("seed %d, query %d", seed, query).isEqualTo(expected);
        }
    }

    private static AABB randomBox(Random random, int sizeM) {
        float x = random.nextFloat() * 400 - 200;
        float y = random.nextFloat() * 400 - 200;
        return box(x, y, x + sizeM * random.nextFloat(), y + sizeM * random.nextFloat());
    }

    // ---- robots that make their steps without jbox2d end at the same place as with it

    private static final int TICKS = 150;
    private static final int STEPS_PER_TICK = 10;

    /** Two worlds, with and without gliding, that receive the same commands. */
    private static final class Twins {
        private final Physics gliding;
        private final Physics plain;
        private final Random random;
        private final int robots;
        private final Pose middle;
        private final double sideM;
        private final double scale; // of the robots
        private final List<Shape> boxes = new ArrayList<>();
        private int firstBox;
        private int touches;

        Twins(long seed) {
            random = new Random(seed);
            robots = 1 + random.nextInt(12);
            scale = random.nextInt(6) == 0 ? 30 : 1;
            sideM = scale * (4 + random.nextInt(20));
            double farM = random.nextInt(3) == 0 ? 300 : 0;
            middle = new Pose(farM, -farM / 2, 0);
            gliding = new Physics(robots, STEP_MICROS, true);
            plain = new Physics(robots, STEP_MICROS, false);
            build();
        }

        private void both(Consumer<Physics> action) {
            action.accept(gliding);
            action.accept(plain);
        }

        private void build() {
            Specs.arena(sideM)
                    .forEach(wall -> both(physics -> physics.addObstacle(middle.compose(wall.pose()), wall.shape())));
            firstBox = Specs.arena(sideM).size();
            int count = random.nextInt(8);
            for (int i = 0; i < count; i++) {
                Pose pose = somewhere();
                Shape shape = Specs.box(0.1 + random.nextDouble(), 0.1 + random.nextDouble(), 0);
                boxes.add(shape);
                both(physics -> physics.addObstacle(pose, shape));
            }
            for (int i = 0; i < robots; i++) {
                Pose pose = somewhere();
                Shape shape = body();
                double massKg = 1 + 30 * random.nextDouble();
                boolean blocks = random.nextInt(6) > 0;
                both(physics -> physics.addRobot(pose, shape, massKg, blocks));
            }
        }

        private Shape body() {
            var polygons = new ArrayList<List<Point>>();
            int count = 1 + random.nextInt(3);
            for (int i = 0; i < count; i++) {
                Shape box = Specs.box(
                        scale * (0.1 + 0.5 * random.nextDouble()),
                        scale * (0.1 + 0.4 * random.nextDouble()),
                        scale * (random.nextDouble() - 0.5));
                polygons.addAll(box.polygons());
            }
            return new Shape(polygons);
        }

        private Pose somewhere() {
            double x = (random.nextDouble() - 0.5) * (sideM - 1);
            double y = (random.nextDouble() - 0.5) * (sideM - 1);
            return middle.compose(new Pose(x, y, 20 * random.nextDouble() - 10));
        }

        private void tell() {
            for (int i = 0; i < robots; i++) {
                int robot = i;
                if (random.nextInt(8) == 0) {
                    double fastest = random.nextInt(20) == 0 ? 30 : 1; // half a metre in a step is too far for gliding
                    double forwardMps = random.nextInt(5) == 0 ? 0 : fastest * (2 * random.nextDouble() - 1);
                    double turnRadps = random.nextInt(3) == 0 ? 0 : 2 * fastest * (2 * random.nextDouble() - 1);
                    both(physics -> physics.drive(robot, forwardMps, turnRadps));
                }
                if (random.nextInt(60) == 0) {
                    Pose pose = somewhere();
                    both(physics -> physics.teleport(robot, pose));
                }
            }
        }

        /** Robots leave, and boxes go, come back and move, wherever robots may be. */
        private void comeAndGo() {
            if (random.nextInt(10) == 0) {
                int robot = random.nextInt(robots);
                both(physics -> physics.removeRobot(robot));
            }
            if (!boxes.isEmpty() && random.nextInt(6) == 0) {
                int box = random.nextInt(boxes.size());
                Pose pose = somewhere();
                boolean goes = random.nextInt(3) == 0;
                both(physics -> {
                    if (goes) {
                        physics.removeObstacle(firstBox + box);
                    } else {
                        physics.placeObstacle(firstBox + box, pose, boxes.get(box));
                    }
                });
            }
        }

        /**
         * @param atOnce steps of an advance of the gliding world
         * @param comings whether robots and boxes come and go
         */
        void run(long seed, int atOnce, boolean comings) {
            for (int tick = 0; tick < TICKS; tick++) {
                tell();
                if (comings) {
                    comeAndGo();
                }
                both(Physics::forgetTouches);
                for (int step = 0; step < STEPS_PER_TICK; step += atOnce) {
                    gliding.advance(atOnce);
                    for (int i = 0; i < atOnce; i++) {
                        plain.advance(1);
                    }
                    assertThat(numbers(gliding))
                            .as("seed %d, tick %d, step %d", seed, tick, step)
                            .isEqualTo(numbers(plain));
                }
                assertThat(touches(gliding)).as("seed %d, tick %d", seed, tick).isEqualTo(touches(plain));
                touches += plain.touches().count();
            }
        }

        private List<Long> numbers(Physics physics) {
            var numbers = new ArrayList<Long>();
            for (int robot = 0; robot < robots; robot++) {
                numbers.add(Double.doubleToRawLongBits(physics.x(robot)));
                numbers.add(Double.doubleToRawLongBits(physics.y(robot)));
                numbers.add(Double.doubleToRawLongBits(physics.headingRad(robot)));
                numbers.add(Double.doubleToRawLongBits(physics.bodyHeadingRad(robot)));
                numbers.add(physics.stalled(robot) ? 1L : 0);
            }
            numbers.add(physics.cells().reinsertCount()); // otherwise contacts would be found later than by jbox2d
            return numbers;
        }

        private static List<List<Long>> touches(Physics physics) {
            Touches all = physics.touches();
            var touches = new ArrayList<List<Long>>();
            for (int i = 0; i < all.count(); i++) {
                touches.add(List.of(
                        all.timeMicros(i), (long) all.robot(i), (long) all.otherRobot(i), (long) all.obstacle(i)));
            }
            return touches;
        }
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 5, 10})
    void robots_endWhereJbox2dPutsThem_bitForBit(int stepsAtOnce) {
        int touches = 0;
        long plainMoves = 0;
        long glidingMoves = 0;
        for (long seed = 1; seed <= Thorough.times(16, 80); seed++) {
            var twins = new Twins(seed);
            twins.run(seed, stepsAtOnce, false);
            touches += twins.touches;
            plainMoves += twins.plain.cells().moveCount();
            glidingMoves += twins.gliding.cells().moveCount();
        }
        assertThat(touches).as("touches compared").isGreaterThan(Thorough.times(150, 1_000));
        assertThat(glidingMoves).as("moves in jbox2d, of %d", plainMoves).isLessThan(plainMoves * 3 / 4);
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 10})
    void robots_endWhereJbox2dPutsThem_whenRobotsAndBoxesComeAndGo(int stepsAtOnce) {
        int touches = 0;
        for (long seed = 101; seed <= 100 + Thorough.times(12, 60); seed++) {
            var twins = new Twins(seed);
            twins.run(seed, stepsAtOnce, true);
            touches += twins.touches;
        }
        assertThat(touches).as("touches compared").isGreaterThan(Thorough.times(75, 500));
    }

    // ---- our rays, compared with those of jbox2d, which are slower and in single precision

    private static final double REACH_M = 6;
    private static final int PLACES = Thorough.times(150, 1_200);
    private static final int RAYS = 400;
    /**
     * jbox2d rotates bodies by a sine table: its result must lie between those of our rays at this angle to both sides.
     */
    private static final double GRAZING_RAD = 3e-5;

    @Test
    void sonarRays_agreeWithJbox2d_toAMillimetre() {
        long seed = 42;
        var random = new Random(seed);
        List<ObstacleSpec> obstacles = obstacles(random);
        var oracle = new org.jbox2d.dynamics.World(new Vec2(0, 0));
        obstacles.forEach(obstacle -> addTo(oracle, obstacle));
        var scene = new Scene(Specs.world(List.of(Specs.R1), obstacles));
        List<Sonar> fans =
                Stream.of(0.0, GRAZING_RAD, -GRAZING_RAD).map(PhysicsTest::fan).toList();
        double largest = 0;
        int hits = 0;
        for (int place = 0; place < PLACES; place++) {
            Pose pose = freePlace(obstacles, random);
            scene.place(0, pose);
            scene.refresh();
            List<List<Double>> ranges =
                    fans.stream().map(fan -> fan.read(scene, 0)).toList();
            for (int i = 0; i < RAYS; i++) {
                int ray = i;
                double theirs = cast(oracle, pose, pose.headingRad() + headingRad(ray));
                DoubleSummaryStatistics ours =
                        ranges.stream().mapToDouble(fan -> fan.get(ray)).summaryStatistics();
                largest = Math.max(largest, Math.max(ours.getMin() - theirs, theirs - ours.getMax()));
                hits += theirs < REACH_M ? 1 : 0;
            }
        }
        assertThat(hits).as("hits, seed %d", seed).isGreaterThan(PLACES * RAYS * 4 / 10);
        assertThat(largest).as("metres of difference, seed %d", seed).isLessThan(0.001);
    }

    private static double headingRad(int ray) {
        return ray * 2 * StrictMath.PI / RAYS;
    }

    private static Sonar fan(double asideRad) {
        var mounts = IntStream.range(0, RAYS).mapToObj(ray -> new Pose(0, 0, headingRad(ray) + asideRad));
        return new Sonar(new SonarSpec(mounts.toList(), 0, REACH_M, 0.1));
    }

    private static Pose freePlace(List<ObstacleSpec> obstacles, Random random) {
        while (true) {
            var pose = new Pose(22 * random.nextDouble() - 11, 22 * random.nextDouble() - 11, random.nextDouble());
            if (!isCrowded(obstacles, pose)) {
                return pose;
            }
        }
    }

    private static List<ObstacleSpec> obstacles(Random random) {
        var obstacles = new ArrayList<ObstacleSpec>();
        for (int index = 0; index < 120; index++) {
            var pose = new Pose(20 * random.nextDouble() - 10, 20 * random.nextDouble() - 10, 7 * random.nextDouble());
            Shape shape = Specs.box(0.1 + random.nextDouble(), 0.1 + random.nextDouble());
            obstacles.add(Specs.obstacle("box " + index, pose, shape, 0));
        }
        return obstacles;
    }

    private static void addTo(org.jbox2d.dynamics.World oracle, ObstacleSpec obstacle) {
        var corner = obstacle.shape().polygons().getFirst().get(2);
        var shape = new PolygonShape();
        shape.setAsBox((float) corner.x(), (float) corner.y());
        var definition = new BodyDef();
        definition.position.set(
                (float) obstacle.pose().x(), (float) obstacle.pose().y());
        definition.angle = (float) obstacle.pose().headingRad();
        oracle.createBody(definition).createFixture(shape, 0);
    }

    /** True if a robot of 10 cm does not fit at this pose. */
    private static boolean isCrowded(List<ObstacleSpec> obstacles, Pose pose) {
        return obstacles.stream()
                .anyMatch(each ->
                        StrictMath.hypot(each.pose().x() - pose.x(), each.pose().y() - pose.y()) < 0.9);
    }

    private static double cast(org.jbox2d.dynamics.World oracle, Pose pose, double heading) {
        var from = new Vec2((float) pose.x(), (float) pose.y());
        var to = new Vec2(
                (float) (pose.x() + REACH_M * Math.cos(heading)), (float) (pose.y() + REACH_M * Math.sin(heading)));
        float[] best = {1};
        oracle.raycast(
                (fixture, point, normal, fraction) -> {
                    // a later hit may be farther: the callback receives hits unsorted
                    best[0] = Math.min(best[0], fraction);
                    return best[0];
                },
                from,
                to);
        return best[0] * REACH_M;
    }
}
