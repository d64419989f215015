package io.troupe.sim.device;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.Specs;
import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.CargoSpec;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import org.junit.jupiter.api.Test;

/**
 * A camera with a colour list casts few of its columns, and one for all colours casts every column: both must see the
 * same, bit by bit.
 */
class SparseColumnsTest {
    private static final int[] COLOURS = {Specs.RED, Specs.GREEN, Specs.BLUE, Specs.ORANGE, Specs.BLACK};

    private static WorldSpec world(Random random) {
        List<ObstacleSpec> obstacles = new ArrayList<>(Specs.arena(12));
        for (int i = 0; i < 15; i++) {
            var pose = new Pose(position(random), position(random), 7 * random.nextDouble());
            double lengthM = 0.05 + 2 * random.nextDouble() * random.nextDouble();
            ObstacleSpec box = Specs.box("box" + i, pose, lengthM, 0.05 + random.nextDouble(), colour(random));
            obstacles.add(new ObstacleSpec(
                    box.name(), pose, box.shape(), box.colour(), true, true, random.nextInt(5) > 0, box.where()));
        }
        List<RobotSpec> robots = new ArrayList<>();
        for (int i = 0; i < 12; i++) {
            var pose = new Pose(position(random), position(random), 7 * random.nextDouble());
            RobotSpec plain = Specs.robot("r" + i, pose, colour(random), null, null);
            robots.add(Specs.carrying(plain, random.nextInt(6) > 0, cargo(random)));
        }
        return Specs.world(robots, obstacles);
    }

    /** Up to three things of any colour, some of them beyond the robot's edge, some invisible. */
    private static List<CargoSpec> cargo(Random random) {
        var cargo = new ArrayList<CargoSpec>();
        int pieces = random.nextInt(4);
        for (int i = 0; i < pieces; i++) {
            Shape shape = Specs.box(
                    0.02 + 0.6 * random.nextDouble(),
                    0.02 + 0.6 * random.nextDouble(),
                    1.6 * random.nextDouble() - 0.8);
            cargo.add(new CargoSpec(
                    shape, colour(random), random.nextBoolean(), random.nextBoolean(), random.nextInt(5) > 0));
        }
        return cargo;
    }

    private static double position(Random random) {
        return 10 * random.nextDouble() - 5;
    }

    private static int colour(Random random) {
        return COLOURS[random.nextInt(COLOURS.length)];
    }

    private static BlobfinderSpec camera(Random random, List<Integer> colours) {
        var mount = new Pose(random.nextDouble() - 0.5, random.nextDouble() - 0.5, 7 * random.nextDouble());
        double fovRad = 0.01 + (2 * StrictMath.PI - 0.01) * random.nextDouble();
        return new BlobfinderSpec(mount, 1 + random.nextInt(120), 60, 0.5 + 8 * random.nextDouble(), fovRad, colours);
    }

    @Test
    void cameraForSomeColours_seesWhatOneForAllColoursSees_ofThem() {
        long seed = 23;
        var random = new Random(seed);
        int blobs = 0;
        var scratch = new Scratch();
        for (int round = 0; round < 150; round++) {
            WorldSpec spec = world(random);
            var scene = new Scene(spec);
            for (int move = 0; move < 3; move++) {
                for (int robot = 0; robot < spec.robots().size(); robot++) {
                    List<Integer> colours = List.of(colour(random), colour(random));
                    BlobfinderSpec all = camera(random, List.of());
                    var some = new BlobfinderSpec(
                            all.mount(), all.widthPx(), all.heightPx(), all.rangeM(), all.fovRad(), colours);
                    Blobfinder camera = new Blobfinder(some).twin();
                    List<ColourBlob> expected = new Blobfinder(all)
                            .read(scene, robot).blobs().stream()
                                    .filter(blob -> colours.contains(blob.colour()))
                                    .toList();
                    camera.sense(scene, robot, scratch); // several cameras use it, as in a world
                    assertThat(camera.image().blobs())
                            .as("seed %d, round %d, move %d, robot %d", seed, round, move, robot)
                            .isEqualTo(expected);
                    blobs += expected.size();
                }
                for (int robot = 0; robot < spec.robots().size(); robot++) {
                    scene.place(robot, new Pose(position(random), position(random), 7 * random.nextDouble()));
                }
                scene.refresh();
            }
        }
        assertThat(blobs).as("blobs compared").isGreaterThan(5_000);
    }
}
