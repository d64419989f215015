package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.model.DriveSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import java.io.IOException;
import java.io.StringReader;
import java.util.ArrayList;
import java.util.Random;
import java.util.SplittableRandom;
import java.util.stream.LongStream;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

/** Sessions in which a controller and other threads use every command: their recordings replay bit for bit. */
class ControlledRecordingTest {
    private static final int TICKS = 200;

    static LongStream seeds() {
        return LongStream.rangeClosed(1, 12);
    }

    /** Robots with start speeds and velocity bounds; every other one has exact odometry. */
    private static WorldSpec spec() {
        WorldSpec arena = Arena.spec(5);
        var robots = new ArrayList<RobotSpec>();
        for (int i = 0; i < arena.robots().size(); i++) {
            RobotSpec robot = arena.robots().get(i);
            var localization = i % 2 == 0
                    ? new DriveSpec.Localization.Gps()
                    : robot.drive().localization();
            var bounds = new DriveSpec.Bounds(-0.1, 0.45, -0.8, 0.9);
            robots.add(Specs.driving(robot, new DriveSpec(0.2, 0.1 * i, bounds, bounds, localization)));
        }
        return Specs.world(robots, arena.obstacles());
    }

    /** Commands by readings and by chance, with gaps longer than the watchdog allows. */
    private static void control(WorldView view, Random random) {
        for (int robot = 0; robot < view.robotCount(); robot++) {
            if (random.nextInt(4) == 0) {
                double ahead = view.rangeM(robot, 3);
                view.command(robot, Math.min(0.5, ahead / 4), random.nextInt(3) - view.odometryHeadingRad(robot) / 4);
            }
        }
    }

    private static void interfere(World world, Random random) {
        Arena.drive(world, new SplittableRandom(random.nextLong()));
        int robot = random.nextInt(world.spec().robots().size());
        switch (random.nextInt(25)) {
            case 0 -> world.reset();
            case 1, 2, 3 -> world.teleportLater(robot, new Pose(random.nextInt(7) - 3, random.nextInt(7) - 3, 9));
            case 4 -> world.motorPower(robot, true);
            default -> {}
        }
    }

    @ParameterizedTest
    @MethodSource("seeds")
    void session_withAController_isReplayedBitForBit(long seed) throws IOException {
        var random = new Random(seed);
        WorldSpec spec = spec();
        long watchdogMicros = seed % 3 * 250_000;
        var recorded = new StringBuilder();
        long hash;
        try (World world = World.create(spec, Arena.seed(seed).withWatchdogMicros(watchdogMicros));
                Recording recording = world.record(recorded)) {
            for (int tick = 0; tick < TICKS; tick++) {
                interfere(world, random);
                world.advance(1 + random.nextInt(3), view -> {
                    if (random.nextInt(8) == 0) {
                        interfere(world, random);
                    }
                    control(view, random);
                    if (random.nextInt(8) == 0) {
                        interfere(world, random);
                    }
                });
            }
            hash = recording.hash();
        }
        assertThat(recorded.toString())
                .contains(" teleport ", " odometry ", " goto ", " heading ", " power ", " reset");
        assertThat(Replay.read(new StringReader(recorded.toString())).play(spec, snapshot -> {}))
                .as("seed %d", seed)
                .isEqualTo(hash);
    }
}
