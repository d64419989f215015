package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.sim.model.DriveSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.WorldSpec;
import io.troupe.tools.Thorough;
import java.io.FilterWriter;
import java.io.IOException;
import java.io.StringReader;
import java.io.UncheckedIOException;
import java.io.Writer;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.SplittableRandom;
import java.util.stream.LongStream;
import org.assertj.core.api.AbstractThrowableAssert;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

class RecordingTest {
    private static final int TICKS = 250;
    private static final WorldSpec FOUR = Arena.spec(4);

    /** Records a run with every kind of input. */
    private static String record(List<Snapshot> snapshots, WorldSettings settings) {
        World world = World.create(FOUR, settings);
        var out = new StringBuilder();
        var random = new SplittableRandom(11);
        try (Recording recording = world.record(out)) {
            snapshots.add(world.latest());
            for (int tick = 0; tick < TICKS; tick++) {
                Arena.drive(world, random);
                if (tick == 60) {
                    world.teleport(1, new Pose(-3, -3, 0.5));
                } else if (tick == 150) {
                    world.reset();
                    recording.paused(true);
                    recording.paused(false);
                }
                snapshots.add(world.advance());
            }
        }
        return out.toString();
    }

    private static String recorded() {
        return record(new ArrayList<>(), Arena.seed(4));
    }

    private static Replay read(String text) throws IOException {
        return Replay.read(new StringReader(text));
    }

    private static AbstractThrowableAssert<?, ? extends Throwable> assertUnreadable(String text) {
        return assertThatThrownBy(() -> read(text)).as(text).isInstanceOf(RecordingException.class);
    }

    private static AbstractThrowableAssert<?, ? extends Throwable> assertUnplayable(String text) {
        return assertThatThrownBy(() -> read(text).play(FOUR, snapshot -> {})).isInstanceOf(RecordingException.class);
    }

    @Test
    void replay_givesEverySnapshotAgain_bitForBit() throws Exception {
        for (WorldSettings settings : List.of(Arena.seed(4), Arena.seed(5).withWatchdogMicros(700_000))) {
            var recorded = new ArrayList<Snapshot>();
            Replay replay = read(record(recorded, settings));
            var played = new ArrayList<Snapshot>();
            long checksum = replay.play(FOUR, played::add);
            assertThat(played).isEqualTo(recorded);
            assertThat(replay.ticks()).isEqualTo(TICKS);
            assertThat(replay.settings()).isEqualTo(settings);
            assertThat(replay.worldName()).isEqualTo("test");
            var hash = new SnapshotHash();
            recorded.forEach(hash::update);
            assertThat(checksum).isEqualTo(hash.value());
        }
    }

    @Test
    void robotDrivenByHand_ignoresItsClients_stopsWhenReleased_andIsReplayed() throws Exception {
        var scenario = new Scenario(FOUR, List.of());
        var out = new StringBuilder();
        try (var simulation = Simulation.open(scenario, Arena.seed(4))) {
            simulation.record(out);
            simulation.world().command(0, 0.1, 0);
            simulation.override(0, -0.2, 0.5);
            for (int tick = 0; tick < 5; tick++) {
                simulation.world().command(0, 0.1, 0); // as a client does, at every reading
                Snapshot snapshot = simulation.tick();
                assertThat(snapshot.robots().getFirst().odometry().forwardMps()).isEqualTo(-0.2);
            }
            simulation.endOverride(0);
            assertThat(simulation.tick().robots().getFirst().odometry().forwardMps())
                    .isZero();
            simulation.world().command(0, 0.1, 0);
            assertThat(simulation.tick().robots().getFirst().odometry().forwardMps())
                    .isEqualTo(0.1);
        }
        assertThat(out).contains("\n0 velocity 0 -0.2 0.5\n", "\n5 velocity 0 0.0 0.0\n");
        assertThat(read(out.toString()).play(FOUR, snapshot -> {})).isNotZero();
    }

    @Test
    void recording_saysEverythingThatHappened() {
        assertThat(recorded())
                .startsWith("troupe-recording 1\nworld test\nsettings 4 0.02 0.035 10000 5.0 10.0 0\nrobots 4 start ")
                .contains(" velocity ", " heading ", " goto ", " odometry ", " power ")
                .contains("\n60 teleport 1 -3.0 -3.0 0.5\n", "\n150 reset\n", "\n150 pause\n150 resume\n", "\n200 is ")
                .containsPattern("\n250 end [0-9a-f]{8}\n$");
    }

    // ---- sessions in which a controller and other threads use every command

    static LongStream seeds() {
        return LongStream.rangeClosed(1, Thorough.times(4, 12));
    }

    /** Robots with start speeds and velocity bounds; every other one has exact odometry. */
    private static WorldSpec boundedRobots() {
        WorldSpec arena = Arena.spec(5);
        var robots = new ArrayList<RobotSpec>();
        for (RobotSpec robot : arena.robots()) {
            int i = robots.size();
            var localization = i % 2 == 0
                    ? new DriveSpec.Localization.Gps()
                    : robot.drive().localization();
            var bounds = new DriveSpec.Bounds(-0.1, 0.45, -0.8, 0.9);
            robots.add(Specs.with(robot, "drive", new DriveSpec(0.2, 0.1 * i, bounds, bounds, localization)));
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
        WorldSpec spec = boundedRobots();
        long watchdogMicros = seed % 3 * 250_000;
        var recorded = new StringBuilder();
        long hash;
        try (World world = World.create(spec, Arena.seed(seed).withWatchdogMicros(watchdogMicros));
                Recording recording = world.record(recorded)) {
            for (int tick = 0; tick < 200; tick++) {
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
        assertThat(read(recorded.toString()).play(spec, snapshot -> {}))
                .as("seed %d", seed)
                .isEqualTo(hash);
    }

    // ---- damaged and wrong recordings

    @Test
    void recording_cutOffOrWithADamagedCharacter_isRefusedOrDoesNotReplay() {
        String text = recorded();
        for (int end = 0; end < text.length() - 10; end += 37) {
            assertUnreadable(text.substring(0, end));
        }
        assertUnreadable(text.substring(0, text.lastIndexOf("\n250 end") + 1))
                .hasMessageMatching("the recording is cut off after line \\d+: it does not end with .*");
        var random = new SplittableRandom(1);
        int from = text.indexOf("start ");
        for (int i = 0; i < 60; i++) {
            int at = random.nextInt(from, text.length() - 1);
            String damaged = text.substring(0, at) + '~' + text.substring(at + 1);
            assertThatThrownBy(() -> read(damaged).play(FOUR, snapshot -> {}))
                    .as("character %s", at)
                    .isInstanceOf(RecordingException.class);
        }
    }

    @Test
    void recordingThatSaysSomethingElse_doesNotReplay() {
        String text = recorded();
        assertUnplayable(text.replace("60 teleport 1 -3.0", "60 teleport 1 -2.9"))
                .hasMessageMatching("line \\d+ of the recording: at tick 100 the checksum was .*");
        assertUnplayable(text.replaceAll("\n100 is .*", ""))
                .hasMessageContaining("a line '100 is <checksum>' is missing before tick 1");
        assertUnplayable(text.replace("settings 4 ", "settings 6 "))
                .hasMessageContaining("the recording was made in another world");
        assertThatThrownBy(() -> read(text).play(Arena.spec(3), snapshot -> {}))
                .hasMessage("the recording was made in world 'test' with 4 robots; world 'test' has 3");
    }

    @Test
    void settingsThatFitNoWorld_andLinesThatTheWorldRefuses_areNamed() {
        String text = recorded();
        String cannot = "line 3 of the recording: world 'test' cannot be created with its settings: ";
        assertUnplayable(text.replace(" 10000 5.0 ", " 10000 500.0 "))
                .hasMessageStartingWith(cannot + "a physics step of 10000 us is too long for 500.0 m/s");
        assertUnplayable(text.replace(" 10000 5.0 ", " 7 5.0 "))
                .hasMessageStartingWith(cannot + "test.world: the interval of world 'test' is 100000 us");
        long line = text.substring(0, text.indexOf(" odometry ")).lines().count();
        assertUnplayable(text.replaceFirst("( odometry \\d) [^ ]+", "$1 1.7E308"))
                .hasMessageStartingWith("line " + line + " of the recording: odometry of robot 'r");
    }

    @Test
    void lineThatMakesNoSense_isNamed() {
        String head = "troupe-recording 1\nworld test\nsettings 1 0.0 0.0 10000 5.0 10.0 0\nrobots 2 start 00000000\n";
        String velocity = head + "0 velocity ";
        assertUnreadable("hello").hasMessage("line 1 of the recording: expected 'troupe-recording 1'");
        assertUnreadable(velocity + "2 0.1 0.1\n0 end 0")
                .hasMessage("line 5 of the recording: robot '2', expected 0 to 1");
        assertUnreadable(velocity + "1 0.1 NaN\n0 end 0")
                .hasMessage("line 5 of the recording: 'NaN', expected a finite number");
        assertUnreadable(velocity + "1 0.1\n").hasMessageContaining("'velocity' has 2 words after it, expected 3");
        assertUnreadable(head + "3 reset\n2 reset\n").hasMessageContaining("tick 2 comes after tick 3");
        assertUnreadable(head + "0 fly 1\n").hasMessageContaining("'fly' is nothing that can be recorded");
        assertUnreadable(head + "0 power 1 up\n").hasMessageContaining("expected on or off");
        assertUnreadable(head + "0 end 0\n1 reset").hasMessageContaining("nothing is expected after");
        String settings = "line 3 of the recording: settings '1 0.0 0.0 ";
        assertUnreadable(head.replace("10000", "0"))
                .hasMessage(settings + "0 5.0 10.0 0': physicsStepMicros is 0, expected at least 1");
        assertUnreadable(head.replace("10000", "1~0")).hasMessageStartingWith(settings + "1~0 5.0 10.0 0': ");
        assertUnreadable("troupe-recording 1\nworld " + "x".repeat(5_000_000))
                .hasMessage("line 2 of the recording has 5000006 characters, expected at most 2000");
    }

    @Test
    void worldName_withLineBreaksOrVeryLong_isRecordedOnOneLine() throws Exception {
        WorldSpec one = Arena.spec(1);
        for (String name : List.of("a\rb", "a\r\nb", "a\nb\n", "x".repeat(100_000))) {
            WorldSpec named = new WorldSpec(name, one.file(), 100, one.robots(), one.obstacles());
            World world = World.create(named, Arena.seed(1));
            var text = new StringBuilder();
            Recording recording = world.record(text);
            world.command(0, 0.1, 0);
            world.advance(3);
            recording.close();
            Replay replay = read(text.toString());
            assertThat(replay.play(named, snapshot -> {})).as(name).isEqualTo(recording.hash());
            assertThat(replay.worldName())
                    .isEqualTo(name.substring(0, Math.min(1000, name.length())).replaceAll("\\R", " "));
        }
    }

    @Test
    void recording_beginsAtTheStart_andOnce() {
        World world = World.create(Arena.spec(1), Arena.seed(1));
        Recording recording = world.record(new StringBuilder());
        assertThatThrownBy(() -> world.record(new StringBuilder())).hasMessageContaining("already");
        recording.close();
        World late = World.create(Arena.spec(1), Arena.seed(1));
        late.advance();
        assertThatThrownBy(() -> late.record(new StringBuilder()))
                .hasMessage("a recording begins at tick 0, the world is at tick 1");
    }

    @Test
    void outputThatFails_endsTheRun() {
        World world = World.create(Arena.spec(1), Arena.seed(1));
        world.record(new FilterWriter(Writer.nullWriter()) {
            private int lines;

            @Override
            public void write(String text, int from, int count) throws IOException {
                if (++lines > 1) {
                    throw new IOException("disk full");
                }
            }
        });
        world.command(0, 0.1, 0);
        assertThatThrownBy(world::advance)
                .isInstanceOf(UncheckedIOException.class)
                .hasMessageContaining("at tick 0")
                .hasRootCauseMessage("disk full");
    }
}
