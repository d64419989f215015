package io.troupe.sim.device;

import static io.troupe.sim.Specs.robot;
import static io.troupe.sim.Specs.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.Specs;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeNoise;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import org.assertj.core.data.Offset;
import org.junit.jupiter.api.Test;

/** Scans compared with closed forms. */
class RangerTest {
    private static final double DEGREE = StrictMath.PI / 180;
    private static final Offset<Double> EXACT = within(1e-9);

    private static RangeSensorSpec sensor(Pose mount, int fovDeg, int samples, RangeNoise noise) {
        return new RangeSensorSpec(mount, 0.1, 8, fovDeg * DEGREE, samples, 0.1, 0.1, noise);
    }

    private static RangerSpec laser(Pose mount, int fovDeg, int samples) {
        return new RangerSpec(
                RangerSpec.Kind.LASER, mount, 0.15, 0.15, List.of(sensor(mount, fovDeg, samples, RangeNoise.NONE)));
    }

    private static double noDraw(double bound) {
        throw new AssertionError("an exact ranger draws nothing");
    }

    private static List<Double> read(RangerSpec ranger, WorldSpec world) {
        return new Ranger(ranger, RangerTest::noDraw).read(new Scene(world), 0);
    }

    @Test
    void scan_ofAWall_isItsDistanceOverTheCosine_fromRightToLeft() {
        // the wall's face is x = 2, from y = -1.5 on to the left
        List<Double> ranges = read(
                laser(Pose.ORIGIN, 180, 181), Specs.world(robot("r1", Pose.ORIGIN), wall("ahead", 2.5, 8.5, 1, 20)));

        assertThat(ranges).hasSize(181);
        for (int i = 0; i < 181; i++) {
            double angle = (i - 90) * DEGREE;
            double expected = 2 / StrictMath.cos(angle);
            boolean past = 2 * StrictMath.tan(angle) < -1.5 - 1e-9 || expected > 8 || i == 0 || i == 180;
            assertThat(ranges.get(i)).as("ray %s", i - 90).isCloseTo(past ? 8 : expected, EXACT);
        }
        assertThat(ranges.get(90 - 40))
                .as("to the right it looks past the wall")
                .isEqualTo(8);
        assertThat(ranges.get(90 + 40)).as("to the left it does not").isLessThan(3);
    }

    @Test
    void scan_ofACorner_meetsBothWalls() {
        // the robot looks north-west into the corner (-3, 4), seen from a laser 0.2 m ahead of (1, 1)
        double heading = 135 * DEGREE;
        Pose at = new Pose(1, 1, heading);
        Pose mount = new Pose(0.2, 0, 0);
        double x = 1 + 0.2 * StrictMath.cos(heading);
        double y = 1 + 0.2 * StrictMath.sin(heading);
        List<Double> ranges = read(
                laser(mount, 60, 61),
                Specs.world(robot("r1", at), wall("west", -3.5, 0, 1, 30), wall("north", 0, 4.5, 30, 1)));

        for (int i = 0; i < 61; i++) {
            double angle = heading + (i - 30) * DEGREE;
            double toWest = (x + 3) / -StrictMath.cos(angle);
            double toNorth = (4 - y) / StrictMath.sin(angle);
            double nearest = Math.min(toWest > 0 ? toWest : 8, toNorth > 0 ? toNorth : 8);
            assertThat(ranges.get(i)).as("ray %s", i - 30).isCloseTo(Math.min(8, nearest), EXACT);
        }
    }

    @Test
    void singleSample_looksAhead_whateverTheFieldOfView() {
        assertThat(read(
                        laser(new Pose(0, 0, 90 * DEGREE), 180, 1),
                        Specs.world(robot("r1", Pose.ORIGIN), wall("left", 0, 2, 1, 2))))
                .hasSize(1)
                .first()
                .satisfies(range -> assertThat(range).isCloseTo(1, EXACT));
    }

    @Test
    void ranges_areClampedToTheLimits_andOwnBodyIsIgnored() {
        // 0.05 m from the laser to the wall; the laser sits inside its own robot
        assertThat(read(
                        laser(Pose.ORIGIN, 0, 1),
                        Specs.world(robot("r1", Pose.ORIGIN), wall("touching", 0.55, 0, 1, 1))))
                .containsExactly(0.1);
        assertThat(read(laser(Pose.ORIGIN, 0, 1), Specs.world(robot("r1", Pose.ORIGIN), wall("far", 9, 0, 1, 1))))
                .containsExactly(8.0);
        assertThat(read(laser(Pose.ORIGIN, 360, 13), Specs.world(robot("r1", Pose.ORIGIN))))
                .containsOnly(8.0);
    }

    @Test
    void otherRobot_isSeen() {
        WorldSpec world = Specs.world(List.of(robot("r1", Pose.ORIGIN), robot("r2", new Pose(3, 0, StrictMath.PI))));

        // it faces back: its front is 0.18 m ahead of its centre of rotation
        assertThat(read(laser(Pose.ORIGIN, 90, 3), world).get(1)).isCloseTo(3 - 0.18, EXACT);
        assertThat(read(laser(Pose.ORIGIN, 90, 3), world).getFirst()).isEqualTo(8);
    }

    @Test
    void severalSensors_followOneAnother() {
        var ring = new RangerSpec(
                RangerSpec.Kind.RANGER,
                Pose.ORIGIN,
                0.1,
                0.1,
                List.of(
                        sensor(new Pose(0, 0, 90 * DEGREE), 15, 1, RangeNoise.NONE),
                        sensor(new Pose(0, 0, -90 * DEGREE), 20, 3, RangeNoise.NONE),
                        sensor(Pose.ORIGIN, 15, 1, RangeNoise.NONE)));
        List<Double> ranges = read(
                ring,
                Specs.world(
                        robot("r1", Pose.ORIGIN),
                        wall("left", 0, 2, 1, 2),
                        wall("right", 0, -4, 8, 2),
                        wall("ahead", 5.5, 0, 1, 1)));

        assertThat(ranges).hasSize(5);
        assertThat(ranges.get(0)).isCloseTo(1, EXACT);
        assertThat(ranges.get(1)).isCloseTo(3 / StrictMath.cos(10 * DEGREE), EXACT);
        assertThat(ranges.get(2)).isCloseTo(3, EXACT);
        assertThat(ranges.get(3)).isCloseTo(3 / StrictMath.cos(10 * DEGREE), EXACT);
        assertThat(ranges.get(4)).isCloseTo(5, EXACT);
    }

    @Test
    void noise_isWhatTheDrawsSay() {
        // every draw is its bound: half of the specified value
        RangerSpec noisy = new RangerSpec(
                RangerSpec.Kind.RANGER,
                Pose.ORIGIN,
                0.1,
                0.1,
                List.of(sensor(Pose.ORIGIN, 0, 1, new RangeNoise(0.2, 0.1, 2 * 30 * DEGREE))));
        WorldSpec world = Specs.world(robot("r1", Pose.ORIGIN), wall("ahead", 2.5, 0, 1, 20));

        assertThat(new Ranger(noisy, bound -> bound).read(new Scene(world), 0).getFirst())
                .isCloseTo(2 / StrictMath.cos(30 * DEGREE) * 1.05 + 0.1, EXACT);
        assertThat(new Ranger(noisy, bound -> -bound).read(new Scene(world), 0).getFirst())
                .isCloseTo(2 / StrictMath.cos(30 * DEGREE) * 0.95 - 0.1, EXACT);
    }

    @Test
    void noise_drawsAsOftenWhereNothingIsHit_andLeavesTheGreatestRange() {
        RangerSpec noisy = new RangerSpec(
                RangerSpec.Kind.RANGER,
                Pose.ORIGIN,
                0.1,
                0.1,
                List.of(sensor(Pose.ORIGIN, 90, 10, new RangeNoise(0.2, 0.1, 0.01))));
        var bounds = new ArrayList<Double>();
        var ranger = new Ranger(noisy, bound -> {
            bounds.add(bound);
            return -bound;
        });

        assertThat(ranger.read(new Scene(Specs.world(robot("r1", Pose.ORIGIN))), 0))
                .containsOnly(8.0);
        assertThat(bounds).hasSize(30);
    }

    @Test
    void specificationsThatMakeNoSense_areRefused() {
        assertThatThrownBy(() -> new Ranger(laser(Pose.ORIGIN, 90, 0), RangerTest::noDraw))
                .hasMessageContaining("0 samples");
        assertThatThrownBy(() -> new Ranger(laser(Pose.ORIGIN, 400, 2), RangerTest::noDraw))
                .hasMessageContaining("field of view");
        assertThatThrownBy(() -> new Ranger(
                        new RangerSpec(RangerSpec.Kind.LASER, Pose.ORIGIN, 1, 1, List.of()), RangerTest::noDraw))
                .hasMessageContaining("a laser has 0 sensors, expected one");
    }
}
