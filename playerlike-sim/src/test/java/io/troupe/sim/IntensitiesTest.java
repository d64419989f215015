package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.sim.model.Pose;
import io.troupe.sim.worldfile.ScenarioReader;
import java.io.IOException;
import java.io.StringReader;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;

/** The intensities of the echoes of lasers and rangers. */
class IntensitiesTest {
    /** Three rays: to the right, ahead and to the left. */
    private static final String LASER = "position ( size [ 0.4 0.4 0.2 ] laser ( samples 3 fov 180 range_max 8 ) )\n";

    private static final String RANGER = """
            position ( size [ 0.4 0.4 0.2 ]
              ranger ( sensor ( pose [ 0 0 0 -90 ] ) sensor () sensor ( pose [ 0 0 0 90 ] ) )
              model ( pose [ -0.3 0 0 0 ] size [ 0.1 0.1 0.1 ] ranger_return 0.75 ) )
            """;

    private static String box(double x, double y, String more) {
        return "model ( pose [ " + x + " " + y + " 0 0 ] size [ 0.2 0.2 0.2 ] " + more + " )\n";
    }

    private static List<List<Double>> intensities(World world) {
        return Specs.first(world.latest()).intensities();
    }

    @Test
    void laser_worldWithoutAnythingBright_measuresNoneUntilItIsAskedTo() {
        var world = Specs.start(LASER + box(2, 0, ""));
        assertThat(intensities(world)).isEmpty();
        world.measureIntensities(0, 0, true);
        world.advance();
        assertThat(intensities(world)).containsExactly(List.of(0.0, 0.0, 0.0));
        world.measureIntensities(0, 0, false);
        world.advance();
        assertThat(intensities(world)).isEmpty();
    }

    @Test
    void laser_brightThing_echoesWithOneFromTheStart() {
        var world = Specs.start(LASER + box(2, 0, "laser_return 2") + box(0, 2, "laser_return 1"));
        assertThat(intensities(world)).containsExactly(List.of(0.0, 1.0, 0.0));
        world.measureIntensities(0, 0, false);
        world.advance();
        assertThat(intensities(world)).isEmpty();
        world.reset();
        world.advance();
        assertThat(intensities(world)).as("as in the file").containsExactly(List.of(0.0, 1.0, 0.0));
    }

    @Test
    void ranger_ofStageFour_readsTheReflectanceOfWhatItHits() {
        var world = Specs.start(RANGER + box(2, 0, "ranger_return 0.5") + box(0, 2, ""));
        assertThat(intensities(world)).isEmpty();
        world.measureIntensities(0, 0, true);
        world.advance();
        assertThat(intensities(world)).as("nothing, 0.5, the default").containsExactly(List.of(0.0, 0.5, 1.0));
    }

    @Test
    void ranger_robotWithCargo_readsTheReflectanceOfEither() {
        String other = RANGER.replace("position (", "position ( ranger_return 0.25 pose [ 2 0 0 0 ]");
        var world = Specs.start(RANGER + other);
        world.measureIntensities(0, 0, true);
        world.advance();
        assertThat(intensities(world).getFirst().get(1))
                .as("the cargo is behind, so nearer")
                .isEqualTo(0.75);
        world.teleport(1, new Pose(2, 0, Math.PI));
        world.advance();
        assertThat(intensities(world).getFirst().get(1)).isEqualTo(0.25);
    }

    @Test
    void ranges_withIntensities_areTheSameBits() {
        var with = World.create(Arena.spec(6), Arena.seed(3));
        var without = World.create(Arena.spec(6), Arena.seed(3));
        for (int robot = 0; robot < 6; robot++) {
            with.measureIntensities(robot, robot % 2, true);
        }
        for (int tick = 0; tick < 50; tick++) {
            Snapshot now = with.advance();
            Snapshot plain = without.advance();
            for (int robot = 0; robot < 6; robot++) {
                assertThat(now.robots().get(robot).rangersM())
                        .isEqualTo(plain.robots().get(robot).rangersM());
                assertThat(now.robots().get(robot).intensities().get(robot % 2))
                        .hasSameSizeAs(now.robots().get(robot).rangersM().get(robot % 2));
            }
        }
    }

    @Test
    void switches_areRecordedAndReplayed() throws IOException {
        var spec = ScenarioReader.readText(RANGER + box(2, 0, "ranger_return 0.5"), Path.of("t.world"))
                .world();
        var world = World.create(spec, WorldSettings.defaults());
        var text = new StringBuilder();
        long hash;
        try (Recording recording = world.record(text)) {
            world.advance();
            world.measureIntensities(0, 0, true);
            world.advance(2);
            hash = recording.hash();
        }
        assertThat(text.toString()).contains("1 intensities 0 0 on");
        assertThat(Replay.read(new StringReader(text.toString())).play(spec, snapshot -> {}))
                .isEqualTo(hash);
        assertThatThrownBy(() -> Replay.read(new StringReader(text.toString().replace("0 0 on", "0 0 maybe"))))
                .hasMessageContaining("expected on or off");
    }

    @Test
    void ranger_thatDoesNotExist_isRefused() {
        var world = Specs.start(RANGER);
        assertThatThrownBy(() -> world.measureIntensities(0, 1, true))
                .hasMessageContaining("has no laser or ranger 1, but 1 of them");
    }
}
