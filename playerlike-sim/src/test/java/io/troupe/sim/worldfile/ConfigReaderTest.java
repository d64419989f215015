package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.Scenario;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class ConfigReaderTest {
    private static final String STAGE =
            "driver ( name \"stage\" provides [ \"simulation:0\" ] worldfile \"w.world\" )\n";

    @TempDir
    private Path dir;

    private Worlds worlds;

    @BeforeEach
    void files() {
        worlds = new Worlds(dir);
        worlds.write("pioneer.inc", Worlds.PIONEER);
        worlds.write("arena.world", Worlds.ARENA);
        worlds.write("w.world", """
                position ( name "full" ranger ( scount 1 spose[0] [ 0 0 0 ] ) blobfinder () )
                position ( name "bare" pose [ 2 0 0 0 ] )
                model ( name "box" pose [ 4 0 0 0 ] )
                """);
    }

    @Test
    void config_ofTheArena_bindsEveryDevice() {
        Scenario scenario = ScenarioReader.readConfig(worlds.write("arena.cfg", Worlds.CONFIG));

        assertThat(scenario.world().name()).isEqualTo("arena");
        assertThat(scenario.devices())
                .extracting(d -> d.port() + " " + d.interfaceName() + ":" + d.index() + " " + d.model())
                .containsExactly(
                        "6665 simulation:0 ",
                        "6665 position2d:0 r0",
                        "6665 sonar:0 r0",
                        "6665 blobfinder:0 r0",
                        "6666 position2d:0 r1",
                        "6665 sonar:1 r1",
                        "6667 blobfinder:2 r1");
        assertThat(scenario.devices().get(2).where()).hasToString(worlds.file("arena.cfg") + ":2:49");
    }

    @Test
    void worldFile_isRelativeToTheConfiguration() throws Exception {
        Files.createDirectories(worlds.file("sub"));
        String text = STAGE.replace("w.world", "../w.world");

        assertThat(ScenarioReader.readConfig(worlds.write("sub/t.cfg", text))
                        .world()
                        .file())
                .isEqualTo(worlds.file("w.world"));
    }

    @Test
    void fields_leftOut_haveTheirDefaults() {
        assertThat(ScenarioReader.readConfig(worlds.write(
                                "t.cfg",
                                STAGE
                                        + "driver ( name \"stage\" provides [ \"position2d\" \"k:localhost:7000:sonar:3\" ]"
                                        + " model \"full\" )"))
                        .devices())
                .extracting(d -> d.port() + " " + d.interfaceName() + ":" + d.index())
                .containsExactly("6665 simulation:0", "6665 position2d:0", "7000 sonar:3");
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "\"positon2d:0\"               | t.cfg:2:34: unknown interface \"positon2d\" in \"positon2d:0\"; did you mean \"position2d\"? known: blobfinder, laser, position2d, ranger, simulation, sonar",
                "\"wheels:0\"                  | t.cfg:2:34: unknown interface \"wheels\" in \"wheels:0\"; known: blobfinder, laser, position2d, ranger, simulation, sonar",
                "\"laser:0\"                   | t.cfg:2:34: robot \"full\" (w.world:1:1) cannot provide laser; it can provide position2d, sonar, blobfinder, ranger",
                "\"sonar:x\"                   | t.cfg:2:34: the index in \"sonar:x\" must be a whole number from 0 to 65535, not \"x\"",
                "\"sonar:\"                    | t.cfg:2:34: the index in \"sonar:\" must be a whole number from 0 to 65535, not \"\"",
                "\"0:sonar:0\"                 | t.cfg:2:34: the port in \"0:sonar:0\" must be a whole number from 1 to 65535, not \"0\"",
                "\"70000:sonar:0\"             | t.cfg:2:34: the port in \"70000:sonar:0\" must be a whole number from 1 to 65535, not \"70000\"",
                "\"robot.local::sonar:0\"      | t.cfg:2:34: host \"robot.local\" in \"robot.local::sonar:0\" is not supported: devices are provided by this machine; leave the host empty",
                "\"a:b:c:d:sonar:0\"           | t.cfg:2:34: \"a:b:c:d:sonar:0\" has more fields than key:host:port:interface:index",
                "\"\"                          | t.cfg:2:34: unknown interface \"\" in \"\"; known: blobfinder, laser, position2d, ranger, simulation, sonar",
                "\"sonar:0\" \"sonar:0\"       | t.cfg:2:44: sonar:0 on port 6665 is already provided at t.cfg:2:34",
                "\"sonar:0\" \"sonar:1\"       | t.cfg:2:44: robot \"full\" has one sonar, and it is already provided at t.cfg:2:34",
                "\"simulation:0\"              | t.cfg:2:34: simulation is provided by the driver with the \"worldfile\", not by one with a \"model\"",
                "                              | t.cfg:2:32: a driver must provide something, such as [ \"position2d:0\" ]",
                "7                             | t.cfg:2:32: \"provides\" must be a tuple of texts [ \"..\" .. ], not a tuple of 1 value",
            })
    void item_thatCannotBeProvided_isRefused(String items, String message) {
        String provided = items == null ? "" : items.strip();
        assertThat(worlds.configProblem(
                        STAGE + "driver ( name \"stage\" provides [ " + provided + " ] model \"full\" )"))
                .isEqualTo(message);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "driver ( name \"stage\" provides [ \"sonar:0\" ] model \"bare\" ) | t.cfg:2:34: robot \"bare\" (w.world:2:1) cannot provide sonar; it can provide position2d",
                "driver ( name \"stage\" provides [ \"sonar:0\" ] model \"ful\" )  | t.cfg:2:52: there is no robot \"ful\" in w.world; did you mean \"full\"? known: bare, full",
                "driver ( name \"stage\" provides [ \"sonar:0\" ] model \"box\" )  | t.cfg:2:52: model \"box\" is not a robot in w.world; known: bare, full",
                "driver ( name \"stage\" provides [ \"sonar:0\" ] )                | t.cfg:2:1: a driver needs either a \"worldfile\" (to provide simulation) or a \"model\" (to provide a robot's devices)",
                "driver ( provides [ \"position2d:1\" ] model \"full\" )           | t.cfg:2:1: a driver needs a \"name\"; expected \"stage\"",
                "driver ( name \"stage\" model \"full\" )                          | t.cfg:2:1: a driver must provide something, such as [ \"position2d:0\" ]",
                "driver ( name \"stage\" modle \"full\" )                          | t.cfg:2:23: unknown property \"modle\" of driver; did you mean \"model\"?",
                "driver ( name \"stage\" provides [ \"simulation:1\" ] worldfile \"x.world\" ) | t.cfg:2:61: a second \"worldfile\"; the first is at t.cfg:1:61",
                "drivr ( )                                                          | t.cfg:2:1: unknown entity \"drivr\"; did you mean \"driver\"?",
                "model ( )                                                          | t.cfg:2:1: \"model\" cannot stand in a configuration file; it belongs in a model or a position or a world file",
                "speed 3                                                            | t.cfg:2:1: unknown property \"speed\" of configuration file; known: none",
            })
    void driver_thatMakesNoSense_isRefused(String driver, String message) {
        assertThat(worlds.configProblem(STAGE + driver.strip())).isEqualTo(message);
    }

    @Test
    void device_offeredByTwoRobotsAtOneAddress_isRefused() {
        assertThat(worlds.configProblem(STAGE
                        + "driver ( name \"stage\" provides [ \"position2d:0\" ] model \"full\" )\n"
                        + "driver ( name \"stage\" provides [ \"position2d:0\" ] model \"bare\" )"))
                .isEqualTo("t.cfg:3:34: position2d:0 on port 6665 is already provided at t.cfg:2:34");
    }

    @Test
    void worldFile_notNamedOrMissing_isRefused() {
        assertThat(worlds.configProblem("driver ( name \"stage\" provides [ \"sonar:0\" ] model \"full\" )"))
                .startsWith("t.cfg:1:1: no driver names a \"worldfile\"; expected driver(");
        assertThat(worlds.configProblem(STAGE.replace("w.world", "gone.world")))
                .isEqualTo("t.cfg:1:61: there is no file gone.world");
        assertThat(worlds.configProblem(STAGE.replace("simulation:0", "position2d:0")))
                .isEqualTo("t.cfg:1:34: position2d is provided by a driver with a \"model\", not by the one with the"
                        + " \"worldfile\"");
    }

    @Test
    void error_inTheWorld_isReportedThere() {
        worlds.write("w.world", "model ( siez 1 )");

        assertThat(worlds.configProblem(STAGE)).startsWith("w.world:1:9: unknown property \"siez\"");
    }

    @Test
    void rangers_ofOneRobot_areBoundInTheOrderOfProvides() {
        worlds.write("w.world", """
                position ( name "full"
                  laser ( range_max 8 ) ranger ( scount 1 spose[0] [ 0 0 0 ] )
                  model ( pose [ 0 0.1 0 90 ] laser ( range_max 4 ) ) )
                """);

        Scenario scenario = ScenarioReader.readConfig(
                worlds.write(
                        "t.cfg",
                        STAGE
                                + "driver ( name \"stage\" provides [ \"laser:4\" \"sonar:0\" \"7000:laser:0\" ] model \"full\" )"));

        assertThat(scenario.devices())
                .extracting(d -> d.port() + " " + d.interfaceName() + ":" + d.index() + " " + d.ranger())
                .containsExactly("6665 simulation:0 0", "6665 laser:4 0", "6665 sonar:0 0", "7000 laser:0 1");
        assertThat(scenario.world().robots().getFirst().rangers())
                .extracting(r -> r.sensors().getFirst().maxRangeM())
                .containsExactly(8.0, 4.0);
        assertThat(worlds.configProblem(STAGE
                        + "driver ( name \"stage\" provides [ \"laser:0\" \"laser:1\" \"laser:2\" ] model \"full\" )"))
                .isEqualTo("t.cfg:2:54: robot \"full\" has 2 of laser, and they are already provided, the last at"
                        + " t.cfg:2:44");
    }

    @Test
    void ring_ofSonars_isProvidedByBothInterfaces() {
        Scenario scenario = ScenarioReader.readConfig(worlds.write(
                "t.cfg", STAGE + "driver ( name \"stage\" provides [ \"ranger:0\" \"sonar:0\" ] model \"full\" )"));

        assertThat(scenario.devices())
                .extracting(d -> d.interfaceName() + ":" + d.index() + " " + d.ranger())
                .containsExactly("simulation:0 0", "ranger:0 " + DeviceBinding.SONAR_RING, "sonar:0 0");
        assertThat(worlds.configProblem(
                        STAGE + "driver ( name \"stage\" provides [ \"ranger:0\" \"ranger:1\" ] model \"full\" )"))
                .isEqualTo("t.cfg:2:45: robot \"full\" has one ranger, and it is already provided at t.cfg:2:34");
    }

    @Test
    void ring_inTheDialectOfStage4_isProvidedByBothInterfaces_andAScanIsNot() {
        worlds.write("w.world", """
                position ( name "full" ranger ( sensor ( samples 180 ) )
                  ranger ( sensor ( samples 1 ) sensor ( samples 1 ) ) )
                """);
        String both = "driver ( name \"stage\" provides [ \"sonar:0\" \"ranger:0\" \"ranger:1\" ] model \"full\" )";

        assertThat(ScenarioReader.readConfig(worlds.write("t.cfg", STAGE + both))
                        .devices())
                .extracting(DeviceBinding::ranger)
                .containsExactly(0, 1, 0, 1);
    }

    @Test
    void scan_ofStage4_isNoRingOfSonars() {
        worlds.write(
                "w.world",
                "position ( name \"full\" ranger ( sensor ( samples 90 ) ) ranger ( sensor ( samples 180 ) ) )");
        String driver = "driver ( name \"stage\" provides [ \"%s\" ] model \"full\" )";

        assertThat(ScenarioReader.readConfig(worlds.write("t.cfg", STAGE + driver.formatted("ranger:0\" \"ranger:1")))
                        .devices())
                .extracting(DeviceBinding::ranger)
                .containsExactly(0, 0, 1);
        assertThat(worlds.configProblem(STAGE + driver.formatted("sonar:0")))
                .isEqualTo("t.cfg:2:34: robot \"full\" (w.world:1:1) cannot provide sonar; it can provide position2d,"
                        + " ranger");
    }

    @Test
    void otherDriversAndInterfaces_areLeftOutWithAWarning() {
        var warnings = new ArrayList<String>();
        Path file = worlds.write("t.cfg", STAGE + """
                driver ( name "vfh" provides [ "position2d:1" ] requires [ "laser:0" ] safety_dist 0.3 )
                driver ( name "stage" provides [ "speech:0" "sonar:0" ] requires [ "map:0" ] model "full" )
                """);

        Scenario scenario = ScenarioReader.read(
                file, warning -> warnings.add(warning.toString().replace(dir + "/", "")));

        assertThat(scenario.devices()).extracting(DeviceBinding::interfaceName).containsExactly("simulation", "sonar");
        assertThat(warnings)
                .containsExactly(
                        "t.cfg:3:57: \"requires\" has no effect here: the drivers offered here need no other device",
                        "t.cfg:2:15: driver \"vfh\" is not run here and left out, and what it provides with it;"
                                + " expected \"stage\"",
                        "t.cfg:3:34: interface \"speech\" is not provided here and left out; provided are blobfinder,"
                                + " laser, position2d, ranger, simulation, sonar");
    }

    @Test
    void driverNamedAlmostStage_isASlip() {
        assertThat(worlds.configProblem(STAGE + "driver ( name \"stag\" provides [ \"sonar:0\" ] model \"full\" )"))
                .isEqualTo("t.cfg:2:15: unknown driver \"stag\"; did you mean \"stage\"?");
    }

    @Test
    void blanksAroundAField_areNotPartOfIt() {
        assertThat(ScenarioReader.readConfig(worlds.write(
                                "t.cfg",
                                STAGE + "driver ( name \"stage\" provides [ \"7001: sonar:1 \" ] model \"full\" )"))
                        .devices())
                .extracting(d -> d.port() + " " + d.interfaceName() + ":" + d.index())
                .containsExactly("6665 simulation:0", "7001 sonar:1");
    }

    @Test
    void lenientReader_leavesOutAnUnknownInterface() {
        var warnings = new ArrayList<String>();
        Path file = worlds.write(
                "t.cfg", STAGE + "driver ( name \"stage\" provides [ \"sonr:0\" \"sonar:0\" ] model \"full\" )");

        Scenario scenario = ScenarioReader.readLeniently(file, warning -> warnings.add(warning.problem()));

        assertThat(scenario.devices()).extracting(DeviceBinding::interfaceName).containsExactly("simulation", "sonar");
        assertThat(warnings).singleElement().asString().contains("unknown interface \"sonr\"", "\"sonar\"?");
    }
}
