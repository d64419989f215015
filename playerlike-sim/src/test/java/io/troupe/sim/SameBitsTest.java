package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeNoise;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.RandomWorld;
import io.troupe.tools.Thorough;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Locale;
import java.util.function.Consumer;
import java.util.function.IntConsumer;
import java.util.function.Supplier;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/**
 * Checksums over every bit of all readings in scenes of many kinds, up to ten thousand robots. They were made by the
 * simulator of 23 November 2026, before it was made faster; a change of one changes the paths of robots.
 */
class SameBitsTest {
    private static final double DEGREE = StrictMath.PI / 180;

    /** Scenes by name, with the checksums of their first sixth and of the whole, and their lengths. */
    enum Scene {
        TEN_THOUSAND_WANDER(
                "7f6bae63", "84edca93", 12, Motion.WANDER, () -> Arena.crowd(10_000, 5, Specs.RED, Specs.GREEN)),
        TEN_THOUSAND_BLIND("8cb80853", "236289f4", 12, Motion.BLIND, () -> Arena.crowd(10_000, 6, Specs.RED)),
        THOUSAND_WANDER(
                "73d39fd0",
                "979f7090",
                100,
                Motion.WANDER,
                () -> Arena.crowd(1_000, 7, Specs.RED, Specs.GREEN, Specs.BLUE)),
        THOUSAND_BLIND("04469201", "050d088e", 100, Motion.BLIND, () -> sonarsOnly(Arena.crowd(1_000, 8))),
        HUNDRED_WANDER("fe881be7", "05a61a44", 400, Motion.WANDER, () -> sonarsOnly(Arena.crowd(100, 9))),
        HUNDRED_RANDOM("d519d046", "988d2336", 400, Motion.RANDOM, () -> Arena.crowd(100, 10, Specs.BLUE)),
        PILE(
                "45dbd66f",
                "ff815f27",
                150,
                Motion.PILE,
                () -> RandomWorld.arena(1, 24, 0).withRobots(300)),
        LASERS_IN_CLUTTER("eccffeab", "d0b6eb79", 100, Motion.RANDOM, () -> lasers(RandomWorld.arena(2, 16, 1.2), 20)),
        CAVE(
                "6fdc1f25",
                "63c4258b",
                150,
                Motion.WANDER,
                () -> RandomWorld.cave(3, 30).withRobots(60)),
        LASERS_IN_CAVE("734374d9", "b16ccd21", 60, Motion.RANDOM, () -> lasers(RandomWorld.cave(4, 30), 30)),
        MAZE(
                "f44fb688",
                "2d533e6a",
                150,
                Motion.WANDER,
                () -> RandomWorld.maze(5, 12, 12, 2.5).withRobots(80)),
        OFFICE(
                "0a4ff839",
                "8fe37124",
                150,
                Motion.RANDOM,
                () -> RandomWorld.office(6, 6, 5).withRobots(80)),
        FAST(
                "6b717770",
                "14fbcc2c",
                100,
                Motion.FAST,
                () -> RandomWorld.arena(7, 30, 0.2).withRobots(60)),
        SHORT_STEPS(
                "3935cf16",
                "898dfe4f",
                30,
                Motion.WANDER,
                () -> RandomWorld.arena(8, 12, 0.1).withRobots(20));

        private final String begun;
        private final String checksum;
        private final int ticks;
        private final Motion motion;
        private final Supplier<WorldSpec> world;

        Scene(String begun, String checksum, int ticks, Motion motion, Supplier<WorldSpec> world) {
            this.begun = begun;
            this.checksum = checksum;
            this.ticks = ticks;
            this.motion = motion;
            this.world = world;
        }

        /** The intervals of the first checksum: a sixth. */
        int ticksBegun() {
            return ticks / 6;
        }

        String run(int ticks) {
            WorldSettings settings =
                    WorldSettings.defaults().withPhysicsStepMicros(this == SHORT_STEPS ? 1_000 : 10_000);
            World built = World.create(world.get(), settings);
            var hash = new SnapshotHash();
            hash.update(built.latest());
            for (int tick = 0; tick < ticks; tick++) {
                built.advance(1, motion::control);
                hash.update(built.latest());
            }
            return hash.toString();
        }
    }

    /** How the robots drive. */
    private enum Motion {
        WANDER(view -> {
            if (view.sonarCount(0) == 16) {
                Arena.wander(view);
            }
        }),
        BLIND(view -> each(view, i -> view.command(i, 0.4, 0.1 * (i % 5 - 2)))),
        RANDOM(view -> each(view, i -> {
            long dice = (view.tick() / 10 * 7_919 + i * 104_729L) * 0x9E3779B97F4A7C15L >>> 40;
            view.command(i, (dice % 7) * 0.15 - 0.15, (dice / 7 % 9) * 0.25 - 1);
        })),
        /** All robots drive to the middle. */
        PILE(view -> each(view, i -> {
            double towards = StrictMath.atan2(-view.y(i), -view.x(i)) - view.headingRad(i);
            view.command(i, 0.4, StrictMath.IEEEremainder(towards, 2 * StrictMath.PI));
        })),
        /** So fast that a step is divided, and that robots leave their fat boxes at once. */
        FAST(view -> each(view, i -> view.command(i, 5 - i % 3 * 4, i % 4 * 3 - 4.5)));

        private final Consumer<WorldView> law;

        Motion(Consumer<WorldView> law) {
            this.law = law;
        }

        void control(WorldView view) {
            law.accept(view);
        }

        private static void each(WorldView view, IntConsumer command) {
            IntStream.range(0, view.robotCount()).forEach(command);
        }
    }

    private static WorldSpec sonarsOnly(WorldSpec spec) {
        List<RobotSpec> robots = new ArrayList<>();
        for (RobotSpec robot : spec.robots()) {
            robots.add(Specs.with(robot, "blobfinder", null));
        }
        return Specs.world(robots, spec.obstacles());
    }

    /** Robots with a laser of 180 rays, 8 m and 180 degrees. */
    private static WorldSpec lasers(RandomWorld world, int robots) {
        var ahead = new Pose(0.1, 0, 0);
        var sensor = new RangeSensorSpec(ahead, 0, 8, 180 * DEGREE, 180, 0.15, 0.15, RangeNoise.NONE);
        var laser = new RangerSpec(RangerSpec.Kind.LASER, ahead, 0.15, 0.15, List.of(sensor));
        return world.withRobots(robots, robot -> robot.withRangers(List.of(laser)));
    }

    @ParameterizedTest
    @EnumSource
    @Timeout(300)
    void scene_hasItsChecksum(Scene scene) {
        assertThat(scene.run(scene.ticksBegun())).as("its first sixth").isEqualTo(scene.begun);
        if (Thorough.on()) {
            assertThat(scene.run(scene.ticks)).isEqualTo(scene.checksum);
        }
    }

    /** Prints the checksums of all scenes, or of those named. */
    public static void main(String[] names) {
        Arrays.stream(Scene.values())
                .filter(scene -> names.length == 0 || List.of(names).contains(scene.name()))
                .forEach(scene -> {
                    long begin = System.nanoTime();
                    String checksum = scene.run(scene.ticksBegun()) + " " + scene.run(scene.ticks);
                    double seconds = (System.nanoTime() - begin) / 1e9;
                    System.out.printf(Locale.ROOT, "%-22s %s %.1f s%n", scene.name(), checksum, seconds);
                });
    }
}
