package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.device.Outline;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import java.util.function.IntFunction;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;

class PlacementCheckTest {
    private static List<Pose> rows(int count) {
        return IntStream.range(0, count)
                .mapToObj(i -> new Pose(i % 100 - 50, i / 100 - 50, i))
                .toList();
    }

    private static PlacementCheck room(List<Pose> poses) {
        List<RobotSpec> robots = IntStream.range(0, poses.size())
                .mapToObj(i -> Specs.robot("r" + i, poses.get(i)))
                .toList();
        return new PlacementCheck(Specs.world(robots));
    }

    /** Each check looks at the robots that are near, not at all robots. */
    @Test
    void teleportsOfAllRobots_lookAtAFewRobotsEach() {
        List<Pose> poses = new ArrayList<>(rows(4_000));
        var looks = new int[1];
        IntFunction<Pose> counted = robot -> {
            looks[0]++;
            return poses.get(robot);
        };
        PlacementCheck.Occupancy occupancy = room(poses).occupancy(counted);
        for (int robot = 0; robot < 4_000; robot++) {
            Pose to = new Pose(poses.get(robot).x() + 0.1, poses.get(robot).y(), 1);
            assertThat(occupancy.refusal(robot, to)).as("robot %d", robot).isNull();
            poses.set(robot, to);
            occupancy.moved(robot);
        }
        assertThat(looks[0]).isBetween(4_000, 20 * 4_000);
    }

    @Test
    void refusal_namesTheFirstRobotInTheWay_asAComparisonWithAllOfThemDoes() {
        long seed = 7;
        var random = new SplittableRandom(seed);
        List<Pose> poses = new ArrayList<>(rows(60));
        PlacementCheck room = room(poses);
        PlacementCheck.Occupancy occupancy = room.occupancy(poses::get);
        int refused = 0;
        for (int i = 0; i < 2_000; i++) {
            int robot = random.nextInt(60);
            Pose to = new Pose(random.nextDouble(-51, 11), random.nextDouble(-51, -48), random.nextDouble(6));
            String expected = firstInTheWay(poses, robot, to);
            String answer = occupancy.refusal(robot, to);
            if (expected == null) {
                assertThat(answer).as("seed %d, question %d", seed, i).isNull();
                poses.set(robot, to);
                occupancy.moved(robot);
            } else {
                refused++;
                assertThat(answer)
                        .as("seed %d, question %d", seed, i)
                        .endsWith("it would overlap robot '" + expected + "'");
            }
        }
        assertThat(refused).isBetween(200, 1_800);
    }

    @Test
    void questionAboutAPlace_looksAtTheObstaclesNearby_andAtTheLargeOnes() {
        List<ObstacleSpec> obstacles = new ArrayList<>(rows(4_000).stream()
                .map(pose -> Specs.box("o", pose, 0.2, 0.2, Specs.BLACK))
                .toList());
        obstacles.add(Specs.box("wall", new Pose(0, 60, 0), 200, 0.1, Specs.BLACK));
        var room = new PlacementCheck(Specs.world(List.of(Specs.robot("r", new Pose(100, 0, 0))), obstacles));
        assertThat(room.obstaclesNear(new Pose(0, -40, 0)))
                .contains(1_050, 4_000)
                .hasSizeLessThan(30);
    }

    @Test
    void refusal_namesTheFirstObstacleInTheWay_asAComparisonWithAllOfThemDoes() {
        long seed = 11;
        var random = new SplittableRandom(seed);
        List<ObstacleSpec> obstacles = new ArrayList<>();
        for (int i = 0; i < 200; i++) { // some are in a few cells, some in many
            double length = random.nextInt(10) == 0 ? random.nextDouble(5, 20) : random.nextDouble(0.1, 2);
            var at = new Pose(random.nextDouble(-30, 30), random.nextDouble(-30, 30), random.nextDouble(6));
            obstacles.add(Specs.box("o" + i, at, length, 0.1, Specs.BLACK));
        }
        var start = new Pose(100, 0, 0);
        var robot = Specs.robot("r", start);
        PlacementCheck.Occupancy occupancy =
                new PlacementCheck(Specs.world(List.of(robot), obstacles)).occupancy(each -> start);
        int refused = 0;
        for (int i = 0; i < 1_000; i++) {
            Pose to = new Pose(random.nextDouble(-31, 31), random.nextDouble(-31, 31), random.nextDouble(6));
            var outline = new Outline(robot.collisionShape(), to);
            String expected = obstacles.stream()
                    .filter(each -> new Outline(each.shape(), each.pose()).overlaps(outline))
                    .map(ObstacleSpec::name)
                    .findFirst()
                    .orElse(null);
            String answer = occupancy.refusal(0, to);
            if (expected == null) {
                assertThat(answer).as("seed %d, question %d", seed, i).isNull();
            } else {
                refused++;
                assertThat(answer)
                        .as("seed %d, question %d", seed, i)
                        .endsWith("it would overlap obstacle '" + expected + "'");
            }
        }
        assertThat(refused).isBetween(30, 970);
    }

    private static @Nullable String firstInTheWay(List<Pose> poses, int robot, Pose to) {
        var outline = new Outline(Specs.robot("", to).shape(), to);
        for (int other = 0; other < poses.size(); other++) {
            if (other != robot && new Outline(Specs.robot("", to).shape(), poses.get(other)).overlaps(outline)) {
                return "r" + other;
            }
        }
        return null;
    }
}
