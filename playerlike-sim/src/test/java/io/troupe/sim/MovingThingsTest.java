package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.entry;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.device.DeviceReading;
import io.troupe.sim.device.DeviceReading.Grip;
import io.troupe.sim.device.DeviceReading.Paddles;
import io.troupe.sim.device.GripperDevice.Order;
import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.ScenarioReader;
import java.io.IOException;
import java.io.StringReader;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.Random;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.parallel.Isolated;

/** Obstacles that are pushed, grippers, and what of it comes and goes. */
@Isolated("reads the log")
class MovingThingsTest {
    private static final String ROBOT = "position ( name \"r\" size [ 0.4 0.4 0.2 ] mass 10 )\n";

    /** From 0.2 to 0.4 m ahead of the centre; 0.24 m between the open paddles, which are 0.132 m long. */
    private static final String CRANE =
            "position ( name \"r\" size [ 0.4 0.4 0.2 ] gripper ( pose [ 0.3 0 0 0 ] size [ 0.2 0.3 0.2 ] )\n"
                    + "  ranger ( scount 1 spose[0] [ 0 0 0 ] ) )\n";

    private static String box(double x, double y, String more) {
        return "model ( name \"box\" pose [ " + x + " " + y + " 0 0 ] size [ 0.1 0.1 0.2 ] " + more + " )\n";
    }

    private static Pose box(World world) {
        return world.latest().moved().getFirst();
    }

    private static Pose robot(World world) {
        return Specs.first(world.latest()).pose();
    }

    private static Grip grip(World world) {
        return (Grip) Specs.first(world.latest()).devices().getFirst();
    }

    // ---- pushing

    @Test
    void box_byDefault_standsLikeAWall() {
        var world = Specs.driven(0.3, Specs.start(ROBOT + box(0.5, 0, "mass 0.1")));
        world.advance(30);
        assertThat(world.latest().moved()).isEmpty();
        assertThat(robot(world).x()).isBetween(0.23, 0.25);
    }

    @Test
    void lightBox_isPushedByTheShareOfTheMasses() {
        // each step the robot has speed v and the box none, and afterwards both have v * m / (m + M)
        var world = Specs.driven(0.3, Specs.start(ROBOT + box(0.5, 0, "movable 1 mass 2.5")));
        world.advance(20);
        double from = box(world).x();
        world.advance(20);
        assertThat(box(world).x() - from).isCloseTo(0.3 * 2 * 10 / 12.5, within(0.02));
        assertThat(box(world).y()).isCloseTo(0, within(1e-3));
        assertThat(world.latest().displaced(world.spec())).containsExactly(entry(0, Optional.of(box(world))));
        assertThat(box(world).x() - robot(world).x()).as("gap of the skins").isBetween(0.25, 0.275);
        assertThat(Specs.first(world.latest()).odometry().stalled()).isFalse();
        assertThat(Specs.first(world.latest()).wallGapM()).isBetween(0.0, 0.025);
        world.stop(0);
        world.advance();
        double rest = box(world).x();
        world.advance(10);
        assertThat(box(world).x()).as("it stops with the robot").isCloseTo(rest, within(1e-3));
    }

    @Test
    void heavyBox_stallsTheRobot() {
        var world = Specs.driven(0.3, Specs.start(ROBOT + box(0.5, 0, "movable 1 mass 100")));
        world.advance(40);
        assertThat(Specs.first(world.latest()).odometry().stalled()).isTrue();
        assertThat(box(world).x()).isBetween(0.5, 0.65);
    }

    @Test
    void box_thatIsPushed_isSeenWhereItIs() {
        String world = "position ( name \"r\" size [ 0.4 0.4 0.2 ] mass 10 )\n"
                + "position ( name \"s\" pose [ 0.9 1 0 -90 ] size [ 0.2 0.2 0.2 ] ranger ( scount 1 spose[0] [ 0 0 0 ] )"
                + " blobfinder ( image [ 21 20 ] ) fiducial () )\n"
                + box(0.5, 0, "movable 1 mass 0.1 color \"blue\" fiducial_return 5");
        var pushed = Specs.driven(0, Specs.start(world));
        RobotReading before = pushed.latest().robots().get(1);
        assertThat(before.sonarM()).containsExactly(5.0);
        pushed.command(0, 0.3, 0);
        while (box(pushed).x() < 0.9) {
            pushed.advance();
        }
        pushed.stop(0);
        pushed.advance();
        RobotReading after = pushed.latest().robots().get(1);
        assertThat(after.sonarM().getFirst()).isCloseTo(0.95, within(1e-3));
        assertThat(after.blobs().blobs()).extracting(blob -> blob.colour()).contains(0x0000FF);
        var marker =
                ((DeviceReading.Fiducials) after.devices().getFirst()).seen().getFirst();
        assertThat(marker.id()).isEqualTo(5);
        assertThat(marker.x()).isCloseTo(1, within(1e-3));
        assertThat(marker.y()).isCloseTo(box(pushed).x() - 0.9, within(1e-9));
    }

    @Test
    void contact_withABox_hasItsNameAndBoxesAlonePublishNone() {
        var world = Specs.driven(
                0.3,
                Specs.start(ROBOT + box(0.4, 0, "movable 1 mass 0.1")
                        + "model ( name \"wall\" pose [ 0.8 0 0 0 ] size [ 0.2 2 0.5 ] )"));
        int contacts = 0;
        for (int i = 0; i < 30; i++) {
            for (Contact contact : world.advance().contacts()) {
                assertThat(contact.other()).isEqualTo("box");
                assertThat(contact.otherRobot()).isEqualTo(-1);
                contacts++;
            }
        }
        assertThat(contacts).isPositive();
        assertThat(box(world).x()).as("it does not go through the wall").isBetween(0.6, 0.67);
    }

    @Test
    void teleport_toWhereABoxIsNow_isRefused() {
        var world = Specs.driven(0.3, Specs.start(ROBOT + box(0.5, 0, "movable 1 mass 0.1")));
        world.advance(30);
        assertThatThrownBy(() -> world.teleport(0, new Pose(box(world).x() + 0.1, 0, 0)))
                .hasMessageContaining("it would overlap obstacle 'box'");
        world.teleport(0, new Pose(0.5, 1, 0));
        world.reset();
        world.advance();
        assertThat(box(world)).isEqualTo(new Pose(0.5, 0, 0));
        assertThat(world.latest().displaced(world.spec())).isEmpty();
    }

    // ---- grippers

    @Test
    void gripper_withNothingBetweenItsPaddles_closesInTwoSeconds() {
        var world = Specs.start(CRANE + box(2, 0, "gripper_return 1"));
        assertThat(grip(world)).isEqualTo(new Grip(Paddles.OPEN, false, false, false));
        world.grip(0, 0, Order.CLOSE);
        world.advance(19);
        assertThat(grip(world).paddles()).isEqualTo(Paddles.CLOSING);
        world.advance(2);
        assertThat(grip(world)).isEqualTo(new Grip(Paddles.CLOSED, false, false, false));
        world.grip(0, 0, Order.OPEN);
        world.advance(21);
        assertThat(grip(world).paddles()).isEqualTo(Paddles.OPEN);
    }

    @Test
    void beams_areAQuarterAndThreeQuartersAlongThePaddles() {
        // the paddles are from 0.268 to 0.4 m: the beams at 0.367 and 0.301 m
        assertThat(grip(updated(0.42))).isEqualTo(new Grip(Paddles.OPEN, false, false, false));
        assertThat(grip(updated(0.4))).isEqualTo(new Grip(Paddles.OPEN, true, false, false));
        assertThat(grip(updated(0.34))).isEqualTo(new Grip(Paddles.OPEN, true, true, false));
        assertThat(grip(updated(0.305))).isEqualTo(new Grip(Paddles.OPEN, false, true, false));
    }

    private static World updated(double boxX) {
        var world = Specs.start(CRANE + box(boxX, 0, "gripper_return 1"));
        world.advance();
        return world;
    }

    @Test
    void gripper_closesAroundABox_carriesItAndPutsItDown() {
        var world = Specs.start(CRANE + box(0.35, 0.02, "gripper_return 1"));
        assertThat(Specs.first(world.latest()).sonarM().getFirst()).isCloseTo(0.3, within(1e-12));
        world.grip(0, 0, Order.CLOSE);
        world.advance(30);
        assertThat(grip(world)).isEqualTo(new Grip(Paddles.CLOSED, true, true, true));
        assertThat(Specs.first(world.latest()).sonarM())
                .as("its rays pass what it holds")
                .containsExactly(5.0);
        assertThat(Specs.first(world.latest()).wallGapM()).isEqualTo(Double.POSITIVE_INFINITY);
        world.command(0, 0.3, 0.4);
        world.advance(25);
        world.stop(0);
        world.advance();
        Pose expected = robot(world).compose(new Pose(0.35, 0.02, 0));
        assertThat(box(world).x()).isCloseTo(expected.x(), within(1e-6));
        assertThat(box(world).y()).isCloseTo(expected.y(), within(1e-6));
        assertThat(box(world).headingRad()).isCloseTo(1, within(1e-6));
        world.grip(0, 0, Order.OPEN);
        assertThat(world.latest().held()).containsExactly(entry(0, 0));
        world.advance(2);
        assertThat(grip(world).holds()).isFalse();
        assertThat(world.latest().held()).isEmpty();
        assertThat(Specs.first(world.latest()).sonarM().getFirst())
                .as("it is an obstacle again")
                .isLessThan(0.4);
        Pose down = box(world);
        world.command(0, -0.3, 0);
        world.advance(10);
        assertThat(box(world)).isEqualTo(down);
        world.command(0, 0.3, 0);
        world.advance(30);
        assertThat(Specs.first(world.latest()).odometry().stalled())
                .as("it stands again")
                .isTrue();
        assertThat(box(world)).isEqualTo(down);
    }

    @Test
    void paddles_stopAtTheWidthOfWhatTheyHold() {
        // 0.24 m between them; 0.1 m remain: closed by 7 / 12, which takes 1.17 s
        var world = Specs.start(CRANE + box(0.35, 0, "gripper_return 1"));
        world.grip(0, 0, Order.CLOSE);
        world.advance(11);
        assertThat(grip(world).paddles()).isEqualTo(Paddles.CLOSING);
        world.advance(2);
        assertThat(grip(world).paddles()).isEqualTo(Paddles.CLOSED);
    }

    @Test
    void box_thatCannotBeGripped_staysWhereItIs() {
        var world = Specs.start(CRANE + box(0.35, 0, ""));
        world.grip(0, 0, Order.CLOSE);
        world.advance(30);
        assertThat(grip(world)).isEqualTo(new Grip(Paddles.CLOSED, false, false, false));
        assertThat(world.latest().moved()).isEmpty();
    }

    @Test
    void gripperThatSnatches_closesByItself() {
        var world =
                Specs.start(CRANE.replace("0.3 0.2 ]", "0.3 0.2 ] autosnatch 1") + box(0.35, 0, "gripper_return 1"));
        world.advance(20);
        assertThat(grip(world)).isEqualTo(new Grip(Paddles.CLOSED, true, true, true));
    }

    @Test
    void boxHeld_byTwoGrippers_goesToTheFirst() {
        String other = CRANE.replace("\"r\"", "\"s\" pose [ 0.7 0 0 180 ]");
        var world = Specs.start(CRANE + other + box(0.35, 0, "gripper_return 1"));
        world.grip(1, 0, Order.CLOSE);
        world.grip(0, 0, Order.CLOSE);
        world.advance(30);
        assertThat(grip(world).holds()).isTrue();
        assertThat(((Grip) world.latest().robots().get(1).devices().getFirst()).holds())
                .isFalse();
    }

    @Test
    void gripsAndPushes_areReplayedBitForBit() throws IOException {
        var spec = ScenarioReader.readText(
                        CRANE
                                + box(0.35, 0, "gripper_return 1")
                                + box(1, 0, "movable 1 mass 1").replace("\"box\"", "\"light\""),
                        Path.of("t.world"))
                .world();
        var world = World.create(spec, WorldSettings.defaults());
        var text = new StringBuilder();
        long hash;
        try (Recording recording = world.record(text)) {
            world.grip(0, 0, Order.CLOSE);
            world.advance(20);
            world.command(0, 0.4, 0.1);
            world.advance(40);
            world.grip(0, 0, Order.OPEN);
            world.advance(10);
            world.reset();
            world.advance(5);
            hash = recording.hash();
        }
        assertThat(text.toString()).contains("0 gripper 0 0 close\n").contains("60 gripper 0 0 open\n");
        assertThat(Replay.read(new StringReader(text.toString())).play(spec, snapshot -> {}))
                .isEqualTo(hash);
    }

    // ---- coming and going

    private static final int BOX = 0;

    @Test
    void lightBox_thatGoes_isNeitherSensedNorPushed_andIsPushedAgainWhenItIsBack() {
        var world = Specs.driven(
                0.3,
                Specs.start(ROBOT.replace("mass 10", "mass 10 ranger ( scount 1 spose[0] [ 0 0 0 ] )")
                        + box(0.6, 0, "movable 1 mass 0.1")));
        assertThat(Specs.first(world.latest()).sonarM().getFirst()).isCloseTo(0.55, within(1e-9));
        world.removeObstacle(BOX);
        world.advance(20);
        assertThat(Specs.first(world.latest()).sonarM()).containsExactly(5.0);
        assertThat(Specs.first(world.latest()).wallGapM()).isInfinite();
        assertThat(robot(world).x()).as("it drives through the place").isCloseTo(0.6, within(1e-6));
        assertThat(box(world)).as("where it was last").isEqualTo(new Pose(0.6, 0, 0));
        assertThat(world.latest().displaced(world.spec())).containsExactly(entry(BOX, Optional.empty()));
        assertThat(world.view().holdsObstacle(BOX)).isFalse();

        world.placeObstacle(BOX, new Pose(1.2, 0, 0));
        world.advance();
        assertThat(world.latest().displaced(world.spec()))
                .containsExactly(entry(BOX, Optional.of(new Pose(1.2, 0, 0))));
        assertThat(Specs.first(world.latest()).wallGapM())
                .isCloseTo(1.2 - 0.05 - robot(world).x() - 0.2, within(1e-9));
        world.advance(30);
        assertThat(box(world).x()).isGreaterThan(1.5);
        world.reset();
        world.advance();
        assertThat(box(world)).isEqualTo(new Pose(0.6, 0, 0));
    }

    @Test
    void lightBox_isPutWhereNothingIs() {
        var world = Specs.start(ROBOT
                + box(1, 0, "movable 1 mass 1")
                + box(2, 0, "movable 1 mass 1").replace("box", "other")
                + "model ( name \"wall\" pose [ 3 0 0 0 ] size [ 0.2 2 0.5 ] )");
        assertThatThrownBy(() -> world.placeObstacle(BOX, new Pose(0.1, 0, 0)))
                .hasMessageEndingWith("it would overlap robot 'r'");
        assertThatThrownBy(() -> world.placeObstacle(BOX, new Pose(2.05, 0, 0)))
                .hasMessageEndingWith("it would overlap obstacle 'other'");
        assertThatThrownBy(() -> world.placeObstacle(BOX, new Pose(3, 0.5, 0)))
                .hasMessageEndingWith("it would overlap obstacle 'wall'");
        assertThatThrownBy(() -> world.placeObstacle(2, new Pose(2, 0.5, 0)))
                .as("a wall is not put upon a light box")
                .hasMessageEndingWith("it would overlap obstacle 'other'");
        assertThatThrownBy(() -> world.putBox(new ColouredBox(1, 0xFF0000, 1, 0)))
                .hasMessageEndingWith("it would overlap obstacle 'box'");
        world.removeObstacle(1);
        world.advance();
        world.placeObstacle(BOX, new Pose(2.05, 0, 0));
        world.advance();
        assertThat(box(world)).isEqualTo(new Pose(2.05, 0, 0));
    }

    @Test
    void coloredBox_isPutIntoAWorldInWhichSomethingWasPushed_isHeld_andIsAway() {
        var world = Specs.start(CRANE
                + box(0.35, 0, "gripper_return 1")
                + box(1, 0, "movable 1 mass 0.1").replace("box", "light")
                + box(5, 5, "movable 1 mass 1").replace("box", "gone"));
        world.grip(0, 0, Order.CLOSE);
        world.removeObstacle(2);
        world.advance(30);
        world.command(0, 0.3, 0);
        world.advance(30);
        world.stop(0);
        world.advance();
        Pose held = box(world);
        Pose light = world.latest().moved().get(1);
        assertThat(light.x()).isGreaterThan(1.05);
        assertThat(held.x()).isGreaterThan(1);
        world.putBox(new ColouredBox(1, 0xFF0000, -3, 3));
        world.advance();
        assertThat(world.latest().boxes()).hasSize(1);
        assertThat(grip(world)).isEqualTo(new Grip(Paddles.CLOSED, true, true, true));
        assertThat(box(world)).isEqualTo(held);
        assertThat(world.latest().moved().get(1).x()).isCloseTo(light.x(), within(1e-6));
        assertThat(world.latest().placed()).containsExactly(entry(2, Optional.empty()));
        world.command(0, 0.3, 0);
        world.advance(10);
        assertThat(box(world).x() - held.x()).as("still carried").isCloseTo(0.3, within(0.01));
        assertThat(world.latest().moved().get(1).x()).as("still pushed").isGreaterThan(light.x() + 0.2);
        world.teleport(0, new Pose(5 - 0.3, 5, 0)); // where the box was that has gone
        world.advance();
        assertThat(robot(world).y()).isCloseTo(5, within(1e-9));
    }

    @Test
    void gripper_losesWhatIsTakenFromIt_andWhatItHoldsIsPutDownWhenItsRobotGoes() {
        var world = Specs.start(CRANE + box(0.35, 0, "gripper_return 1"));
        world.grip(0, 0, Order.CLOSE);
        world.advance(30);
        world.placeObstacle(BOX, new Pose(1, 1, 0));
        world.advance(11);
        assertThat(grip(world))
                .as("its paddles close farther")
                .isEqualTo(new Grip(Paddles.CLOSED, false, false, false));
        assertThat(box(world)).isEqualTo(new Pose(1, 1, 0));

        world.reset();
        world.grip(0, 0, Order.CLOSE);
        world.advance(30);
        assertThat(grip(world).holds()).isTrue();
        world.removeRobot(0);
        world.advance(5);
        Pose down = box(world);
        assertThat(down.x()).isCloseTo(0.35, within(1e-9));
        world.teleport(0, new Pose(-2, 0, 0));
        world.command(0, 0.3, 0);
        world.advance(100);
        assertThat(box(world)).as("it stands there").isEqualTo(down);
        assertThat(Specs.first(world.latest()).odometry().stalled()).isTrue();
    }

    /** Random things and robots go, come and move while the robots drive and grip; hashes of all ticks. */
    private static List<Long> busyRun(World world, long seed) {
        var random = new Random(seed);
        List<Long> hashes = new ArrayList<>();
        for (int tick = 0; tick < 200; tick++) {
            for (int robot = 0; robot < 3; robot++) {
                world.command(robot, random.nextDouble(-0.2, 0.6), random.nextDouble(-0.8, 0.8));
            }
            var somewhere = new Pose(random.nextDouble(-2, 2), random.nextDouble(-2, 2), random.nextDouble(-3, 3));
            switch (random.nextInt(12)) {
                case 0 -> world.removeRobot(random.nextInt(3));
                case 1 -> world.removeObstacle(random.nextInt(5));
                case 2, 3 -> world.placeObstacleLater(random.nextInt(5), somewhere);
                case 4, 5 -> world.teleportLater(random.nextInt(3), somewhere);
                case 6 -> world.putBoxLater(new ColouredBox(1, 0xFF0000, somewhere.x(), somewhere.y()));
                case 7 -> world.removeBox(1);
                case 8 -> world.grip(2 * random.nextInt(2), 0, random.nextBoolean() ? Order.OPEN : Order.CLOSE);
                default -> {}
            }
            hashes.add(SnapshotHash.of(world.advance()));
        }
        return hashes;
    }

    private static WorldSpec busyWorld() {
        String crane = CRANE.replace("[ 0.3 0 0 0 ] size", "[ 0.3 0 0 0 ] autosnatch 1 size");
        return ScenarioReader.readText(
                        crane
                                + crane.replace("\"r\"", "\"s\" pose [ -1 1 0 0 ] fiducial ()")
                                + crane.replace("\"r\"", "\"t\" pose [ 1 -1 0 90 ]")
                                + box(0.8, 0, "gripper_return 1 fiducial_return 3")
                                + box(0, 1, "movable 1 mass 1").replace("box", "light")
                                + box(0, -1, "movable 1 mass 30 gripper_return 1")
                                        .replace("box", "heavy")
                                + box(1.5, 1.5, "").replace("box", "still")
                                + box(-1.5, 1.5, "gripper_return 1").replace("box", "more"),
                        Path.of("t.world"))
                .world();
    }

    @Test
    void runWithComingsAndGoings_repeatsBitForBit_onSeveralThreads_andFromItsRecording() throws IOException {
        for (long seed = 1; seed <= 5; seed++) {
            var world = World.create(busyWorld(), WorldSettings.defaults());
            var text = new StringBuilder();
            List<Long> hashes = new ArrayList<>();
            long hash;
            long run = seed;
            try (Recording recording = world.record(text)) {
                LoggedWarnings.of(World.class, () -> hashes.addAll(busyRun(world, run)));
                hash = recording.hash();
            }
            assertThat(text.toString()).contains(" leave ", " remove ", " place ", " teleport ", " box ", " gripper ");
            try (var threaded = World.create(
                    busyWorld(), WorldSettings.defaults().withSensingThreads(3), SensingThreads.Choice.ALL)) {
                List<Long> again = new ArrayList<>();
                LoggedWarnings.of(World.class, () -> again.addAll(busyRun(threaded, run)));
                assertThat(again).as("seed %d", seed).isEqualTo(hashes);
            }
            assertThat(Replay.read(new StringReader(text.toString())).play(busyWorld(), snapshot -> {}))
                    .as("seed %d", seed)
                    .isEqualTo(hash);
        }
    }

    @Test
    void gripper_thatIsNone_isRefused() {
        var world = Specs.start(
                "position ( name \"r\" size [ 0.4 0.4 0.2 ] bumper ( bcount 1 blength 1 bpose[0] [ 0 0 0 ] ) )");
        assertThatThrownBy(() -> world.grip(0, 0, Order.OPEN))
                .hasMessage("device 0 of robot 'r' is no gripper; its devices, counted from 0, are [bumper]");
    }
}
