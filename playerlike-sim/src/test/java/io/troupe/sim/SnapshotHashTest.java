package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeNoise;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The checksum, and pairs of runs with every device and all noise that must have equal checksums. */
class SnapshotHashTest {
    @Test
    void sameSeed_givesTheSameChecksum_withAllDevicesAndNoise() {
        assertThat(Arena.minute(7).toString()).isEqualTo(Arena.minute(7).toString());
        assertThat(Arena.minute(8).toString()).isNotEqualTo(Arena.minute(7).toString());
    }

    @Test
    @Timeout(300)
    void interpretedJvm_givesTheSameChecksum() throws Exception {
        Process process = new ProcessBuilder(
                        Path.of(System.getProperty("java.home"), "bin", "java").toString(),
                        "-Xint",
                        "-cp",
                        System.getProperty("java.class.path"),
                        Arena.class.getName(),
                        "7")
                .redirectErrorStream(true)
                .start();
        String said = new String(process.getInputStream().readAllBytes(), StandardCharsets.UTF_8);
        assertThat(process.waitFor(200, TimeUnit.SECONDS)).isTrue();

        assertThat(said.strip()).isEqualTo(Arena.minute(7).toString());
    }

    @Test
    void oneBitAnywhere_changesTheChecksum() {
        World world = World.create(Arena.spec(2), Arena.seed(1));
        Snapshot snapshot = world.latest();
        RobotReading first = snapshot.robots().getFirst();
        List<List<Double>> rangers = new ArrayList<>(first.rangersM());
        List<Double> scan = new ArrayList<>(rangers.getLast());
        scan.set(3, Math.nextUp(scan.get(3)));
        rangers.set(1, scan);
        var changed = new RobotReading(
                first.pose(), first.odometry(), first.sonarM(), first.blobs(), rangers, first.wallGapM());

        assertThat(SnapshotHash.of(with(snapshot, changed))).isNotEqualTo(SnapshotHash.of(snapshot));
        assertThat(SnapshotHash.of(with(snapshot, first))).isEqualTo(SnapshotHash.of(snapshot));
        assertThat(SnapshotHash.of(new Snapshot(0, 0, snapshot.robots(), List.of(new Contact(0, 0, "wall", -1)))))
                .isNotEqualTo(SnapshotHash.of(snapshot));
    }

    private static Snapshot with(Snapshot snapshot, RobotReading first) {
        return new Snapshot(
                snapshot.tick(),
                snapshot.timeMicros(),
                List.of(first, snapshot.robots().get(1)),
                List.of());
    }

    @Test
    void anotherRobot_changesNobodyElsesNoise() {
        assertThat(firstReadings(Arena.spec(2))).isEqualTo(firstReadings(Arena.spec(1)));
    }

    /** Laser and odometry of the first robot, which turns on the spot and sees no other robot. */
    private static List<Object> firstReadings(WorldSpec spec) {
        World world = World.create(spec, WorldSettings.DEFAULT.withSeed(3));
        var readings = new ArrayList<Object>();
        for (int tick = 0; tick < 5; tick++) {
            world.command(0, 0, -1);
            RobotReading reading = world.advance().robots().getFirst();
            readings.add(reading.odometry());
            readings.add(reading.rangersM().getFirst().subList(0, 10)); // to its right
        }
        return readings;
    }

    @Test
    void noise_isOff_unlessAskedFor() {
        var plain = Specs.robot("r", Pose.ORIGIN).withRangers(List.of(Arena.laser(RangeNoise.NONE)));
        WorldSpec spec = Specs.world(plain, Specs.wall("ahead", 3, 0, 1, 5));

        assertThat(SnapshotHash.of(
                        World.create(spec, WorldSettings.DEFAULT.withSeed(1)).latest()))
                .isEqualTo(SnapshotHash.of(
                        World.create(spec, WorldSettings.DEFAULT.withSeed(2)).latest()));
    }

    @Test
    void reset_repeatsWhatFollowedTheStart_bitForBit() {
        World world = World.create(Arena.spec(6), Arena.seed(5));
        List<Object> fromStart = readings(world);
        List<Object> afterReset = new ArrayList<>();
        world.reset();
        afterReset.addAll(readings(world));

        assertThat(afterReset.equals(fromStart)).isTrue(); // too long to print
        assertThat(world.latest().tick()).as("time goes on").isEqualTo(400);
        assertThat(world.latest().timeMicros()).isEqualTo(40_000_000);
    }

    private static List<Object> readings(World world) {
        long start = world.timeMicros();
        var random = new SplittableRandom(9);
        var readings = new ArrayList<Object>();
        int contacts = 0;
        for (int tick = 0; tick < 200; tick++) {
            Arena.drive(world, random);
            Snapshot snapshot = world.advance();
            readings.add(snapshot.robots());
            for (Contact contact : snapshot.contacts()) {
                readings.add(new Contact(
                        contact.timeMicros() - start, contact.robot(), contact.other(), contact.otherRobot()));
                contacts++;
            }
        }
        assertThat(contacts).as("something must have been hit").isPositive();
        return readings;
    }

    @Test
    void reset_withAController_repeatsWhatFollowedTheStart_bitForBit() {
        World world = World.create(Arena.spec(6), Arena.seed(5));
        List<Object> fromStart = controlled(world);
        world.reset();

        assertThat(controlled(world).equals(fromStart)).isTrue();
    }

    /** Commands the robots by their sensor readings, from the first interval on. */
    private static List<Object> controlled(World world) {
        var readings = new ArrayList<Object>();
        for (int tick = 0; tick < 100; tick++) {
            readings.add(world.advance(1, view -> {
                        for (int robot = 0; robot < view.robotCount(); robot++) {
                            view.command(robot, view.rangeM(robot, 3) / 10, view.rangeM(robot, 0) / 10);
                        }
                    })
                    .robots());
        }
        return readings;
    }

    @Test
    void reset_forgetsWhatWasSaidBefore_andKeepsWhatIsSaidAfter() {
        World world =
                World.create(Specs.world(List.of(Specs.robot("a", Pose.ORIGIN), far("b")), List.of()), Arena.seed(1));
        Pose start = world.latest().robots().getFirst().pose();
        world.command(0, 0.5, 0);
        world.setOdometry(0, new Pose(7, 7, 0));
        world.teleport(0, new Pose(5, 5, 0));
        world.reset();
        world.command(1, 0.5, 0);
        Snapshot after = world.advance();

        assertThat(after.robots().get(0).pose()).isEqualTo(start);
        assertThat(after.robots().get(0).odometry().pose().x()).isZero();
        assertThat(after.robots().get(1).odometry().forwardMps()).isEqualTo(0.5);
    }

    private static RobotSpec far(String name) {
        return Specs.robot(name, new Pose(20, 0, 0));
    }
}
