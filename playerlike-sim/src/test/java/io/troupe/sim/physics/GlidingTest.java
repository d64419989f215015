package io.troupe.sim.physics;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.Specs;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.Shape;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.function.Consumer;
import org.junit.jupiter.api.Test;

/**
 * Robots that make their steps without jbox2d end at the same place as with it: compares two worlds, with and without
 * gliding, bit for bit.
 */
class GlidingTest {
    private static final int STEP_MICROS = 10_000;
    private static final int TICKS = 150;
    private static final int STEPS_PER_TICK = 10;

    /** Two worlds that receive the same commands. */
    private static final class Twins {
        private final Physics gliding;
        private final Physics plain;
        private final Random random;
        private final int robots;
        private final Pose middle;
        private final double sideM;
        private final double scale; // of the robots
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
            int boxes = random.nextInt(8);
            for (int i = 0; i < boxes; i++) {
                Pose pose = somewhere();
                Shape shape = Specs.box(0.1 + random.nextDouble(), 0.1 + random.nextDouble(), 0);
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

        /** One to three boxes, with the centre of rotation anywhere near. */
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

        /** New commands for some robots, and sometimes a teleport, possibly into another robot. */
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

        void run(long seed) {
            for (int tick = 0; tick < TICKS; tick++) {
                tell();
                both(Physics::forgetTouches);
                for (int step = 0; step < STEPS_PER_TICK; step++) {
                    both(Physics::step);
                    assertThat(numbers(gliding))
                            .as("seed %d, tick %d, step %d", seed, tick, step)
                            .isEqualTo(numbers(plain));
                }
                assertThat(touches(gliding)).as("seed %d, tick %d", seed, tick).isEqualTo(touches(plain));
                touches += plain.touches().count();
            }
        }

        /** The poses as bits, the stall flags, and the number of re-inserted boxes. */
        private List<Long> numbers(Physics physics) {
            var numbers = new ArrayList<Long>();
            for (int robot = 0; robot < robots; robot++) {
                numbers.add(Double.doubleToRawLongBits(physics.x(robot)));
                numbers.add(Double.doubleToRawLongBits(physics.y(robot)));
                numbers.add(Double.doubleToRawLongBits(physics.headingRad(robot)));
                numbers.add(Double.doubleToRawLongBits(physics.bodyHeadingRad(robot)));
                numbers.add(physics.stalled(robot) ? 1L : 0);
            }
            numbers.add(physics.tree().reinsertCount()); // otherwise contacts would be found later than by jbox2d
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

    @Test
    void robots_endWhereJbox2dPutsThem_bitForBit() {
        int touches = 0;
        long plainMoves = 0;
        long glidingMoves = 0;
        for (long seed = 1; seed <= 80; seed++) {
            var twins = new Twins(seed);
            twins.run(seed);
            touches += twins.touches;
            plainMoves += twins.plain.tree().moveCount();
            glidingMoves += twins.gliding.tree().moveCount();
        }
        assertThat(touches).as("touches compared").isGreaterThan(1_000);
        assertThat(glidingMoves).as("moves in jbox2d, of %d", plainMoves).isLessThan(plainMoves * 3 / 4);
    }
}
