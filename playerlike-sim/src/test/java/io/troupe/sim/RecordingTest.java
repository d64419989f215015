package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import java.io.IOException;
import java.io.StringReader;
import java.io.UncheckedIOException;
import java.io.Writer;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import org.junit.jupiter.api.Test;

class RecordingTest {
    private static final int TICKS = 250;

    /** Records a run with every kind of input. */
    private static String record(List<Snapshot> snapshots, WorldSettings settings) {
        World world = World.create(Arena.spec(4), settings);
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

    private static Replay read(String text) throws IOException {
        return Replay.read(new StringReader(text));
    }

    @Test
    void replay_givesEverySnapshotAgain_bitForBit() throws Exception {
        for (WorldSettings settings : List.of(Arena.seed(4), Arena.seed(5).withWatchdogMicros(700_000))) {
            var recorded = new ArrayList<Snapshot>();
            Replay replay = read(record(recorded, settings));
            var played = new ArrayList<Snapshot>();

            long checksum = replay.play(Arena.spec(4), played::add);

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
    void recording_saysEverythingThatHappened() {
        assertThat(record(new ArrayList<>(), Arena.seed(4)))
                .startsWith("troupe-recording 1\nworld test\nsettings 4 0.02 0.035 10000 5.0 10.0 0\nrobots 4 start ")
                .contains(" velocity ", " heading ", " goto ", " odometry ", " power ")
                .contains("\n60 teleport 1 -3.0 -3.0 0.5\n")
                .contains("\n150 reset\n")
                .contains("\n150 pause\n150 resume\n")
                .contains("\n200 is ")
                .containsPattern("\n250 end [0-9a-f]{8}\n$");
    }

    @Test
    void recordingThatIsCutOff_isRefused_whereverItIsCut() {
        String text = record(new ArrayList<>(), Arena.seed(4));
        for (int end = 0; end < text.length() - 10; end += 37) {
            String cut = text.substring(0, end);
            assertThatThrownBy(() -> read(cut)).as(cut).isInstanceOf(RecordingException.class);
        }
        String withoutEnd = text.substring(0, text.lastIndexOf("\n250 end") + 1);
        assertThatThrownBy(() -> read(withoutEnd))
                .hasMessageMatching("the recording is cut off after line \\d+: it does not end with .*");
    }

    @Test
    void recordingWithADamagedCharacter_isRefusedOrDoesNotReplay() {
        String text = record(new ArrayList<>(), Arena.seed(4));
        var random = new SplittableRandom(1);
        int from = text.indexOf("start ");
        for (int i = 0; i < 60; i++) {
            int at = random.nextInt(from, text.length() - 1);
            String damaged = text.substring(0, at) + '~' + text.substring(at + 1);
            assertThatThrownBy(() -> read(damaged).play(Arena.spec(4), snapshot -> {}))
                    .as("character %s", at)
                    .isInstanceOf(RecordingException.class);
        }
    }

    @Test
    void recordingThatSaysSomethingElse_doesNotReplay() {
        String text = record(new ArrayList<>(), Arena.seed(4));

        assertThatThrownBy(() -> read(text.replace("60 teleport 1 -3.0", "60 teleport 1 -2.9"))
                        .play(Arena.spec(4), snapshot -> {}))
                .isInstanceOf(RecordingException.class)
                .hasMessageMatching("line \\d+ of the recording: at tick 100 the checksum was .*");
        assertThatThrownBy(() -> read(text.replaceAll("\n100 is .*", "")).play(Arena.spec(4), snapshot -> {}))
                .hasMessageContaining("a line '100 is <checksum>' is missing before tick 1");
        assertThatThrownBy(() -> read(text).play(Arena.spec(3), snapshot -> {}))
                .hasMessage("the recording was made in world 'test' with 4 robots; world 'test' has 3");
        assertThatThrownBy(
                        () -> read(text.replace("settings 4 ", "settings 6 ")).play(Arena.spec(4), snapshot -> {}))
                .hasMessageContaining("the recording was made in another world");
    }

    @Test
    void lineThatMakesNoSense_isNamed() {
        String head = "troupe-recording 1\nworld test\nsettings 1 0.0 0.0 10000 5.0 10.0 0\nrobots 2 start 00000000\n";
        assertThatThrownBy(() -> read("hello")).hasMessage("line 1 of the recording: expected 'troupe-recording 1'");
        assertThatThrownBy(() -> read(head + "0 velocity 2 0.1 0.1\n0 end 0"))
                .hasMessage("line 5 of the recording: robot '2', expected 0 to 1");
        assertThatThrownBy(() -> read(head + "0 velocity 1 0.1 NaN\n0 end 0"))
                .hasMessage("line 5 of the recording: 'NaN', expected a finite number");
        assertThatThrownBy(() -> read(head + "3 reset\n2 reset\n")).hasMessageContaining("tick 2 comes after tick 3");
        assertThatThrownBy(() -> read(head + "0 fly 1\n"))
                .hasMessageContaining("'fly' is nothing that can be recorded");
        assertThatThrownBy(() -> read(head + "0 velocity 1 0.1\n"))
                .hasMessageContaining("'velocity' has 2 words after it, expected 3");
        assertThatThrownBy(() -> read(head + "0 power 1 up\n")).hasMessageContaining("expected on or off");
        assertThatThrownBy(() -> read(head + "0 end 0\n1 reset")).hasMessageContaining("nothing is expected after");
        assertThatThrownBy(() -> read(head.replace("10000", "0")))
                .hasMessage(
                        "line 3 of the recording: settings '1 0.0 0.0 0 5.0 10.0 0': physicsStepMicros is 0, expected at least 1");
        assertThatThrownBy(() -> read(head.replace("10000", "1~0")))
                .hasMessageStartingWith("line 3 of the recording: settings '1 0.0 0.0 1~0 5.0 10.0 0': ");
    }

    @Test
    void settingsThatFitNoWorld_areNamedWithTheirLine() {
        String text = record(new ArrayList<>(), Arena.seed(4));
        String cannot = "line 3 of the recording: world 'test' cannot be created with its settings: ";

        assertThatThrownBy(
                        () -> read(text.replace(" 10000 5.0 ", " 10000 500.0 ")).play(Arena.spec(4), snapshot -> {}))
                .isInstanceOf(RecordingException.class)
                .hasMessageStartingWith(cannot + "a physics step of 10000 us is too long for 500.0 m/s");
        assertThatThrownBy(() -> read(text.replace(" 10000 5.0 ", " 7 5.0 ")).play(Arena.spec(4), snapshot -> {}))
                .isInstanceOf(RecordingException.class)
                .hasMessageStartingWith(cannot + "test.world: the interval of world 'test' is 100000 us");
    }

    @Test
    void lineThatTheWorldRefuses_isNamed() {
        String text = record(new ArrayList<>(), Arena.seed(4));
        int line = (int) text.substring(0, text.indexOf(" odometry ")).lines().count();

        assertThatThrownBy(() -> read(text.replaceFirst("( odometry \\d) [^ ]+", "$1 1.7E308"))
                        .play(Arena.spec(4), snapshot -> {}))
                .isInstanceOf(RecordingException.class)
                .hasMessageStartingWith("line " + line + " of the recording: odometry of robot 'r");
    }

    @Test
    void lineThatIsTooLong_isNamedWithoutItsText() {
        assertThatThrownBy(() -> read("troupe-recording 1\nworld " + "x".repeat(5_000_000)))
                .isInstanceOf(RecordingException.class)
                .hasMessage("line 2 of the recording has 5000006 characters, expected at most 2000");
    }

    @Test
    void worldName_withLineBreaksOrVeryLong_isRecordedOnOneLine() throws Exception {
        for (String name : List.of("a\rb", "a\r\nb", "a\nb\n", "x".repeat(100_000))) {
            WorldSpec named = new WorldSpec(
                    name,
                    Arena.spec(1).file(),
                    100,
                    Arena.spec(1).robots(),
                    Arena.spec(1).obstacles());
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
        world.record(new Writer() {
            private int lines;

            @Override
            public void write(char[] text, int from, int count) throws IOException {
                if (++lines > 1) {
                    throw new IOException("disk full");
                }
            }

            @Override
            public void flush() {}

            @Override
            public void close() {}
        });
        world.command(0, 0.1, 0);
        assertThatThrownBy(world::advance)
                .isInstanceOf(UncheckedIOException.class)
                .hasMessageContaining("at tick 0")
                .hasRootCauseMessage("disk full");
    }
}
