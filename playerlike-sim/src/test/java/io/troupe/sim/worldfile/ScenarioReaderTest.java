package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.model.Scenario;
import java.nio.file.Path;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class ScenarioReaderTest {
    private static final String TWO_ROBOTS = """
            position ( name "bare" )
            position ( name "full" pose [ 2 0 0 0 ] ranger ( scount 1 spose[0] [ 0 0 0 ] ) blobfinder () )
            """;

    @TempDir
    private Path dir;

    private Worlds worlds;

    @BeforeEach
    void files() {
        worlds = new Worlds(dir);
        worlds.write("pioneer.inc", Worlds.PIONEER);
    }

    @Test
    void world_withoutConfiguration_offersEveryRobotInOrder() {
        Scenario scenario = ScenarioReader.read(worlds.write("two.world", TWO_ROBOTS));

        assertThat(scenario.devices())
                .extracting(d -> d.port() + " " + d.interfaceName() + ":" + d.index() + " " + d.model())
                .containsExactly(
                        "6665 simulation:0 ",
                        "6665 position2d:0 bare",
                        "6665 position2d:1 full",
                        "6665 sonar:1 full",
                        "6665 blobfinder:1 full");
    }

    @Test
    void world_withItsConfigurationBesideIt_isOfferedAsThatSays() {
        worlds.write("arena.cfg", Worlds.CONFIG);

        assertThat(ScenarioReader.read(worlds.write("arena.world", Worlds.ARENA))
                        .devices())
                .hasSize(7)
                .anyMatch(device -> device.port() == 6667);
    }

    @Test
    void configuration_isReadWithItsWorld() {
        worlds.write("arena.world", Worlds.ARENA);

        assertThat(ScenarioReader.read(worlds.write("my.cfg", Worlds.CONFIG))
                        .world()
                        .robots())
                .hasSize(2);
    }

    @Test
    void configuration_besideAWorldButForAnother_isNotUsedAndThatIsAWarning() {
        worlds.write("arena.world", Worlds.ARENA);
        worlds.write("two.cfg", Worlds.CONFIG);
        Path world = worlds.write("two.world", TWO_ROBOTS);

        assertThat(worlds.warningsOf(world))
                .containsExactly(
                        "two.cfg:1:1: this file beside two.world is not used, and every robot is offered instead;"
                                + " name it to use it: two.cfg:1:82: it is for another world, arena.world");
        assertThat(ScenarioReader.read(world, warning -> {}).devices()).hasSize(5);
    }

    @ParameterizedTest
    @ValueSource(
            strings = {"\"sonar:x\"", "\"laser:0\"", "\"positon2d:0\"", "\"position2d:0\" \"position2d:0\"", "7", ""})
    void configuration_besideAWorldAndWithAnError_isNotUsedAndThatIsAWarning(String items) {
        String stage = "driver ( name \"stage\" provides [ \"simulation:0\" ] worldfile \"two.world\" )";
        Path config =
                worlds.write("two.cfg", stage + "driver ( name \"stage\" provides [ " + items + " ] model \"bare\" )");
        Path world = worlds.write("two.world", TWO_ROBOTS);

        assertThat(worlds.warningsOf(world))
                .singleElement()
                .asString()
                .startsWith("two.cfg:1:1: this file beside two.world is not used")
                .contains("name it to use it: two.cfg:1:");
        assertThat(ScenarioReader.read(world, warning -> {}).devices()).hasSize(5);
        assertThat(worlds.problemOf(() -> ScenarioReader.read(config))).startsWith("two.cfg:1:");
    }

    @Test
    void configuration_besideAWorldWithoutItsModel_isNotUsedAndThatIsAWarning() {
        String stage = "driver ( name \"stage\" provides [ \"simulation:0\" ] worldfile \"two.world\" )";
        worlds.write("two.cfg", stage + "driver ( name \"stage\" provides [ \"position2d:0\" ] model \"renamed\" )");
        Path world = worlds.write("two.world", TWO_ROBOTS);

        assertThat(worlds.warningsOf(world))
                .singleElement()
                .asString()
                .startsWith("two.cfg:1:1: this file beside two.world is not used")
                .contains("renamed");
        assertThat(ScenarioReader.read(world, warning -> {}).devices()).hasSize(5);
    }

    @Test
    void error_inAWorldWithAConfiguration_isTheWorldsOwn() {
        worlds.write("two.cfg", Worlds.CONFIG);
        Path world = worlds.write("two.world", "model ( siez 1 )");

        assertThat(worlds.problemOf(() -> ScenarioReader.read(world))).startsWith("two.world:1:9: unknown property");
    }

    @Test
    void file_thatIsNeither_isRefused() {
        assertThat(worlds.problemOf(() -> ScenarioReader.read(worlds.file("arena.yaml"))))
                .isEqualTo("expected a .world or a .cfg file, not arena.yaml");
        assertThat(worlds.problemOf(() -> ScenarioReader.read(worlds.file("gone.world"))))
                .isEqualTo("there is no file gone.world");
        assertThat(worlds.problemOf(() -> ScenarioReader.read(worlds.file("gone.cfg"))))
                .isEqualTo("there is no file gone.cfg");
    }
}
