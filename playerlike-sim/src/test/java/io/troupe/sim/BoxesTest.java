package io.troupe.sim;

import static io.troupe.sim.Specs.first;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.catchThrowable;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.device.ColourBlob;
import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.Pose;
import java.io.StringReader;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** Boxes that are put into a world while it runs. */
class BoxesTest {
    private static final double FRONT_M = 0.18; // of a robot, from its centre of rotation
    private static final double HALF_M = ColouredBox.SIDE_M / 2;

    @Test
    void sampleOfTheBox_isAnObstacleForBodies() {
        World world = Specs.start(Specs.R1);
        world.putBox(new ColouredBox(1, 0xFF0000, 2.5, -1));
        assertThat(world.latest().boxes()).as("before the next interval").isEmpty();
        assertThat(world.advance().boxes()).containsExactly(new ColouredBox(1, Specs.RED, 2.5, -1));
    }

    @Test
    void box_isMeasuredFromItsFace_stopsARobot_andLetsItGoOnWhenItIsRemoved() {
        World world = Specs.start(Specs.R1);
        assertThat(first(world.latest()).wallGapM()).isInfinite();
        world.putBox(new ColouredBox(3, Specs.RED, 2, 0));
        assertThat(first(world.advance()).wallGapM()).isCloseTo(2 - HALF_M - FRONT_M, within(1e-9));
        world.putBox(new ColouredBox(3, Specs.RED, 1, 0));
        assertThat(first(world.advance()).wallGapM())
                .as("moved, not doubled")
                .isCloseTo(1 - HALF_M - FRONT_M, within(1e-9));
        Specs.driven(0.5, world);
        List<Contact> contacts = new ArrayList<>();
        for (int i = 0; i < 30; i++) {
            contacts.addAll(world.advance().contacts());
        }
        assertThat(contacts).extracting(Contact::other).containsExactly("box 3");
        assertThat(contacts.getFirst().timeMicros())
                .as("0.62 m at 0.5 m/s, from 0.2 s on, less the skin")
                .isBetween(1_300_000L, 1_500_000L);
        assertThat(first(world.latest()).pose().x()).isCloseTo(1 - HALF_M - FRONT_M, within(0.03));
        assertThat(first(world.latest()).odometry().stalled()).isTrue();
        world.removeBox(3);
        for (int i = 0; i < 10; i++) {
            world.advance();
        }
        assertThat(world.latest().boxes()).isEmpty();
        assertThat(first(world.latest()).pose().x()).isGreaterThan(1);
        assertThat(first(world.latest()).wallGapM()).isInfinite();
    }

    @Test
    void camera_seesTheColourOfABox() {
        World world = Specs.start(Specs.robot("r1", Pose.ORIGIN, Specs.ORANGE, Specs.pioneerFront(), Specs.camera(8)));
        world.putBox(new ColouredBox(1, 0x12AB34, 3, 0));
        RobotReading reading = first(world.advance());
        assertThat(reading.blobs().blobs()).extracting(ColourBlob::colour).containsExactly(0x12AB34);
        assertThat(reading.blobs().blobs().getFirst().rangeM()).isCloseTo(3 - HALF_M, within(0.2));
    }

    @Test
    void robotInTheOpen_drivesTheSameArc_bitForBit_whetherOrNotABoxIsPutFarAway() {
        World without = Specs.start(Specs.R1);
        World with = Specs.start(Specs.R1);
        without.command(0, 0.4, 0.3);
        with.command(0, 0.4, 0.3);
        for (int i = 0; i < 50; i++) {
            if (i % 7 == 3) {
                with.putBox(new ColouredBox(1 + i % 3, Specs.BLUE, 20 + i, 30));
            }
            assertThat(first(with.advance()).pose())
                    .isEqualTo(first(without.advance()).pose());
        }
    }

    @Test
    void boxThatWouldOverlapARobot_orIsTooFarAway_isRefused() {
        World world = Specs.start(Specs.R1);
        assertThatThrownBy(() -> world.putBox(new ColouredBox(1, 0, 0.3, 0.1)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("obstacle 'box 1' cannot be put at (0.3 m, 0.1 m, 0.0 rad): it would overlap robot 'r1'");
        assertThatThrownBy(() -> world.putBox(new ColouredBox(1, 0, 0, -600)))
                .hasMessageContaining("expected at most 500.0 m from the origin");
        assertThat(world.advance().boxes()).isEmpty();
        world.putBox(new ColouredBox(1, 0, 1, 0));
        world.advance();
        assertThatThrownBy(() -> world.teleport(0, new Pose(1, 0, 0)))
                .as("the box is in the way of robots, too")
                .hasMessageContaining("it would overlap obstacle 'box 1'");
    }

    @Test
    void box_isCheckedLikeAnObstacle_andMayBeWhereARobotWasTakenOut() {
        World world = Specs.start(Specs.R1, new ColouredBox(2, Specs.BLUE, 3, 0).obstacle());
        var box = new ColouredBox(2, Specs.RED, 0.3, 0.1);
        Throwable asBox = catchThrowable(() -> world.putBox(box));
        Throwable asObstacle =
                catchThrowable(() -> world.placeObstacle(0, box.obstacle().pose()));
        assertThat(asBox).hasMessage(asObstacle.getMessage()).hasMessageContaining("it would overlap robot 'r1'");
        world.removeRobot(0);
        world.advance();
        world.putBox(box);
        assertThat(world.advance().boxes()).containsExactly(box);
        assertThatThrownBy(() -> world.teleport(0, Pose.ORIGIN)).hasMessageContaining("it would overlap obstacle");
        world.removeBox(2);
        world.teleport(0, new Pose(-2, 0, 0));
        world.advance();
        world.putBox(new ColouredBox(1, Specs.RED, 0, 0));
        world.teleport(0, new Pose(0, 5, 0));
        world.advance();
        world.teleport(0, new Pose(0, -5, 0));
        world.putBox(new ColouredBox(1, Specs.RED, 0, -5)); // boxes are put first, and the robot finds it there
        world.advance();
        assertThat(world.latest().boxes()).containsExactly(new ColouredBox(1, Specs.RED, 0, -5));
        assertThat(first(world.latest()).pose().y()).isEqualTo(5);
    }

    @ParameterizedTest
    @CsvSource({"0, 0, 0", "21, 0, 0", "1, -1, 0", "1, 16777216, 0", "1, 0, NaN", "1, 0, Infinity"})
    void boxThatMakesNoSense_isRefused(int number, int colour, double x) {
        assertThatThrownBy(() -> new ColouredBox(number, colour, x, 0))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("expected");
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "1 ff0000 1.0",
                "0 ff0000 1 2",
                "1 red 1 2",
                "1 ff0000 x 2",
                "1 ff0000 1 2 3",
                "1 ff0000 NaN 2",
                "-1 ff0000 1 2"
            })
    void wordsThatAreNoBox_areRefused(String words) {
        assertThatThrownBy(() -> ColouredBox.parse(List.of(words.split(" "))))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("expected");
    }

    @Test
    void words_areReadAgain_bitForBit() {
        var random = new SplittableRandom(16);
        for (int i = 0; i < 1_000; i++) {
            var box = new ColouredBox(
                    random.nextInt(1, ColouredBox.MOST + 1),
                    random.nextInt(0x1000000),
                    random.nextDouble(-500, 500),
                    random.nextDouble(-1e-5, 1e-5));
            assertThat(ColouredBox.parse(List.of(box.words().split(" ")))).isEqualTo(box);
        }
    }

    @Test
    void reset_removesBoxes_andTheRunRepeats() {
        World world = World.create(Arena.spec(3), Arena.seed(2));
        List<Long> first = hashes(world);
        world.putBox(new ColouredBox(1, Specs.RED, 1, 1.2));
        world.advance();
        world.putBox(new ColouredBox(2, Specs.RED, 1, -1.2));
        world.reset(); // discards the second one, which waits
        assertThat(hashes(world)).isEqualTo(first);
        assertThat(world.latest().boxes()).isEmpty();
    }

    /** Checksums of the robots' readings, without tick and time, which go on after a reset. */
    private static List<Long> hashes(World world) {
        var random = new SplittableRandom(5);
        List<Long> hashes = new ArrayList<>();
        for (int tick = 0; tick < 60; tick++) {
            Arena.drive(world, random);
            hashes.add(SnapshotHash.of(new Snapshot(0, 0, world.advance().robots(), List.of())));
        }
        return hashes;
    }

    private static String recorded(List<Snapshot> snapshots) {
        World world = World.create(Arena.spec(4), Arena.seed(9));
        var out = new StringBuilder();
        var random = new SplittableRandom(12);
        try (Recording recording = world.record(out)) {
            assertThat(world.recording()).isSameAs(recording);
            for (int tick = 0; tick < 200; tick++) {
                Arena.drive(world, random);
                if (tick % 20 == 7) {
                    try {
                        world.putBox(new ColouredBox(
                                1 + tick % 3, Specs.GREEN, random.nextDouble(-3, 3), random.nextDouble(-3, 3)));
                    } catch (IllegalArgumentException overlaps) {
                        assertThat(overlaps).hasMessageContaining("overlap");
                    }
                } else if (tick % 50 == 40) {
                    world.removeBox(1 + tick % 3);
                } else if (tick == 120) {
                    world.reset();
                }
                snapshots.add(world.advance());
            }
        }
        return out.toString();
    }

    @Test
    void recordingWithBoxes_isReplayed_bitForBit() throws Exception {
        List<Snapshot> snapshots = new ArrayList<>();
        String text = recorded(snapshots);
        assertThat(text).containsPattern("\n\\d+ box \\d 00ff00 ").containsPattern("\n\\d+ unbox \\d\n");
        List<Snapshot> replayed = new ArrayList<>();
        Replay.read(new StringReader(text)).play(Arena.spec(4), replayed::add);
        assertThat(replayed.subList(1, replayed.size())).isEqualTo(snapshots);
    }

    @Test
    void recordingWithAnotherBox_isRefused() {
        String text = recorded(new ArrayList<>());
        for (String[] change : new String[][] {
            {" box 2 00ff00", " box 99 00ff00"}, {" box 2 00ff00", " box 2 green"}, {"unbox ", "unbox -"},
        }) {
            assertThatThrownBy(() -> Replay.read(new StringReader(text.replaceFirst(change[0], change[1]))))
                    .isInstanceOf(RecordingException.class)
                    .hasMessageMatching("line \\d+ of the recording: .*expected.*");
        }
        assertThatThrownBy(() -> Replay.read(new StringReader(text.replaceFirst(" box 2 00ff00", " box 2 00ff01")))
                        .play(Arena.spec(4), snapshot -> {}))
                .isInstanceOf(RecordingException.class)
                .hasMessageContaining("this is not what happened");
    }
}
