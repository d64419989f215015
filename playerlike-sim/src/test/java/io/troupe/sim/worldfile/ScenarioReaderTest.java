package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.Scenario;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

class ScenarioReaderTest extends WorldFiles {
    private static final String TWO_ROBOTS = """
            position ( name "bare" )
            position ( name "full" pose [ 2 0 0 0 ] ranger ( scount 1 spose[0] [ 0 0 0 ] ) blobfinder () )
            """;
    private static final String STAGE =
            "driver ( name \"stage\" provides [ \"simulation:0\" ] worldfile \"w.world\" )\n";

    @BeforeEach
    void files() {
        write("pioneer.inc", PIONEER);
        write("arena.world", ARENA);
        write("w.world", """
                position ( name "full" ranger ( scount 1 spose[0] [ 0 0 0 ] ) blobfinder () )
                position ( name "bare" pose [ 2 0 0 0 ] )
                model ( name "box" pose [ 4 0 0 0 ] )
                """);
    }

    private static String provides(String items, String model) {
        return "driver ( name \"stage\" provides [ " + items + " ] model \"" + model + "\" )";
    }

    /** The devices for which "full" has a driver with these items. */
    private List<DeviceBinding> devices(String items) {
        return config(STAGE + provides(items, "full")).devices();
    }

    private static String address(DeviceBinding device) {
        return device.port() + " " + device.interfaceName() + ":" + device.index();
    }

    // ---- a world and the configuration beside it

    @Test
    void world_withoutConfiguration_offersEveryRobotInOrder() {
        assertThat(ScenarioReader.read(write("two.world", TWO_ROBOTS)).devices())
                .extracting(device -> address(device) + " " + device.model())
                .containsExactly(
                        "6665 simulation:0 ",
                        "6665 position2d:0 bare",
                        "6665 position2d:1 full",
                        "6665 sonar:1 full",
                        "6665 blobfinder:1 full");
    }

    @Test
    void world_withItsConfigurationBesideIt_isOfferedAsThatSays_andReadWithIt() {
        Path config = write("arena.cfg", CONFIG);
        assertThat(ScenarioReader.read(file("arena.world")).devices())
                .hasSize(7)
                .anyMatch(device -> device.port() == 6667);
        assertThat(ScenarioReader.read(config).world().robots()).hasSize(2);
    }

    /** The warning about a configuration with an error, beside a world that is read without it. */
    private String warningAboutAConfiguration(String items, String model) {
        write("two.cfg", STAGE.replace("w.world", "two.world").strip() + provides(items, model));
        Path world = write("two.world", TWO_ROBOTS);
        List<String> warnings = warningsOf(world);
        assertThat(warnings)
                .singleElement()
                .asString()
                .startsWith("two.cfg:1:1: this file beside two.world is not used");
        assertThat(ScenarioReader.read(world, warning -> {}).devices()).hasSize(5);
        return warnings.getFirst();
    }

    @ParameterizedTest
    @ValueSource(
            strings = {"\"sonar:x\"", "\"laser:0\"", "\"positon2d:0\"", "\"position2d:0\" \"position2d:0\"", "7", ""})
    void configuration_besideAWorldAndWithAnError_isNotUsedAndThatIsAWarning(String items) {
        assertThat(warningAboutAConfiguration(items, "bare")).contains("name it to use it: two.cfg:1:");
        assertThat(problemOf(() -> ScenarioReader.read(file("two.cfg")))).startsWith("two.cfg:1:");
    }

    @Test
    void configuration_besideAWorldButForAnotherOrWithoutItsModel_isNotUsedAndThatIsAWarning() {
        assertThat(warningAboutAConfiguration("\"position2d:0\"", "renamed")).contains("renamed");
        write("two.cfg", CONFIG);
        Path world = write("two.world", TWO_ROBOTS);
        assertThat(warningsOf(world))
                .containsExactly(
                        "two.cfg:1:1: this file beside two.world is not used, and every robot is offered instead;"
                                + " name it to use it: two.cfg:1:82: it is for another world, arena.world");
        assertThat(ScenarioReader.read(world, warning -> {}).devices()).hasSize(5);
    }

    @Test
    void error_inTheWorld_isTheWorldsOwn() {
        write("two.cfg", CONFIG);
        Path world = write("two.world", "model ( siez 1 )");
        assertThat(problemOf(() -> ScenarioReader.read(world))).startsWith("two.world:1:9: unknown property");

        write("w.world", "model ( siez 1 )");
        assertThat(configProblem(STAGE)).startsWith("w.world:1:9: unknown property \"siez\"");
    }

    @Test
    void file_thatIsNeither_isRefused() {
        assertThat(problemOf(() -> ScenarioReader.read(file("arena.yaml"))))
                .isEqualTo("expected a .world or a .cfg file, not arena.yaml");
        assertThat(problemOf(() -> ScenarioReader.read(file("gone.world")))).isEqualTo("there is no file gone.world");
        assertThat(problemOf(() -> ScenarioReader.read(file("gone.cfg")))).isEqualTo("there is no file gone.cfg");
    }

    // ---- the configuration itself

    @Test
    void config_ofTheArena_bindsEveryDevice_andNamesItsWorldRelatively() throws IOException {
        Scenario scenario = config(CONFIG);
        assertThat(scenario.world().name()).isEqualTo("arena");
        assertThat(scenario.devices())
                .extracting(device -> address(device) + " " + device.model())
                .containsExactly(
                        "6665 simulation:0 ",
                        "6665 position2d:0 r0",
                        "6665 sonar:0 r0",
                        "6665 blobfinder:0 r0",
                        "6666 position2d:0 r1",
                        "6665 sonar:1 r1",
                        "6667 blobfinder:2 r1");
        assertThat(scenario.devices().get(2).where()).hasToString(file("t.cfg") + ":2:49");
        Files.createDirectories(file("sub"));
        Path config = write("sub/t.cfg", STAGE.replace("w.world", "../w.world"));
        assertThat(ScenarioReader.readConfig(config).world().file()).isEqualTo(file("w.world"));
    }

    @Test
    void fields_leftOut_haveTheirDefaults_andBlanksAroundThemDoNotCount() {
        assertThat(devices("\"position2d\" \"k:localhost:7000:sonar:3\""))
                .extracting(ScenarioReaderTest::address)
                .containsExactly("6665 simulation:0", "6665 position2d:0", "7000 sonar:3");
        assertThat(devices("\"7001: sonar:1 \""))
                .extracting(ScenarioReaderTest::address)
                .containsExactly("6665 simulation:0", "7001 sonar:1");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            "positon2d:0" | t.cfg:2:34: unknown interface "positon2d" in "positon2d:0"; did you mean "position2d"? known: blobfinder, bumper, camera, fiducial, gripper, laser, position2d, ranger, simulation, sonar
            "wheels:0" | t.cfg:2:34: unknown interface "wheels" in "wheels:0"; known: blobfinder, bumper, camera, fiducial, gripper, laser, position2d, ranger, simulation, sonar
            "laser:0" | t.cfg:2:34: robot "full" (w.world:1:1) cannot provide laser; it can provide position2d, sonar, blobfinder, ranger
            "sonar:x" | t.cfg:2:34: the index in "sonar:x" must be a whole number from 0 to 65535, not "x"
            "sonar:" | t.cfg:2:34: the index in "sonar:" must be a whole number from 0 to 65535, not ""
            "0:sonar:0" | t.cfg:2:34: the port in "0:sonar:0" must be a whole number from 1 to 65535, not "0"
            "70000:sonar:0" | t.cfg:2:34: the port in "70000:sonar:0" must be a whole number from 1 to 65535, not "70000"
            "robot.local::sonar:0" | t.cfg:2:34: host "robot.local" in "robot.local::sonar:0" is not supported: devices are provided by this machine; leave the host empty
            "a:b:c:d:sonar:0" | t.cfg:2:34: "a:b:c:d:sonar:0" has more fields than key:host:port:interface:index
            "" | t.cfg:2:34: unknown interface "" in ""; known: blobfinder, bumper, camera, fiducial, gripper, laser, position2d, ranger, simulation, sonar
            "sonar:0" "sonar:0" | t.cfg:2:44: sonar:0 on port 6665 is already provided at t.cfg:2:34
            "sonar:0" "sonar:1" | t.cfg:2:44: robot "full" has one sonar, and it is already provided at t.cfg:2:34
            "simulation:0" | t.cfg:2:34: simulation is provided by the driver with the "worldfile", not by one with a "model"
             | t.cfg:2:32: a driver must provide something, such as [ "position2d:0" ]
            7 | t.cfg:2:32: "provides" must be a tuple of texts [ ".." .. ], not a tuple of 1 value
            "ranger:0" "ranger:1" | t.cfg:2:45: robot "full" has one ranger, and it is already provided at t.cfg:2:34
            """)
    void item_thatCannotBeProvided_isRefused(String items, String message) {
        String provided = items == null ? "" : items;
        assertThat(configProblem(STAGE + provides(provided, "full"))).isEqualTo(message);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            driver ( name "stage" provides [ "sonar:0" ] model "bare" ) | t.cfg:2:34: robot "bare" (w.world:2:1) cannot provide sonar; it can provide position2d
            driver ( name "stage" provides [ "sonar:0" ] model "ful" ) | t.cfg:2:52: there is no robot "ful" in w.world; did you mean "full"? known: bare, full
            driver ( name "stage" provides [ "sonar:0" ] model "box" ) | t.cfg:2:52: model "box" is not a robot in w.world; known: bare, full
            driver ( name "stage" provides [ "sonar:0" ] ) | t.cfg:2:1: a driver needs either a "worldfile" (to provide simulation) or a "model" (to provide a robot's devices)
            driver ( provides [ "position2d:1" ] model "full" ) | t.cfg:2:1: a driver needs a "name"; expected "stage"
            driver ( name "stage" model "full" ) | t.cfg:2:1: a driver must provide something, such as [ "position2d:0" ]
            driver ( name "stage" modle "full" ) | t.cfg:2:23: unknown property "modle" of driver; did you mean "model"?
            driver ( name "stage" provides [ "simulation:1" ] worldfile "x.world" ) | t.cfg:2:61: a second "worldfile"; the first is at t.cfg:1:61
            drivr ( ) | t.cfg:2:1: unknown entity "drivr"; did you mean "driver"?
            model ( ) | t.cfg:2:1: "model" cannot stand in a configuration file; it belongs in a model or a position or a world file
            speed 3 | t.cfg:2:1: unknown property "speed" of configuration file; known: none
            driver ( name "stag" provides [ "sonar:0" ] model "full" ) | t.cfg:2:15: unknown driver "stag"; did you mean "stage"?
            """)
    void driver_thatMakesNoSense_isRefused(String driver, String message) {
        assertThat(configProblem(STAGE + driver)).isEqualTo(message);
    }

    @Test
    void device_offeredTwice_orAWorldFileThatIsNotNamedOrMissing_isRefused() {
        String item = "\"position2d:0\"";
        assertThat(configProblem(STAGE + provides(item, "full") + "\n" + provides(item, "bare")))
                .isEqualTo("t.cfg:3:34: position2d:0 on port 6665 is already provided at t.cfg:2:34");
        assertThat(configProblem(provides("\"sonar:0\"", "full")))
                .startsWith("t.cfg:1:1: no driver names a \"worldfile\"; expected driver(");
        assertThat(configProblem(STAGE.replace("w.world", "gone.world")))
                .isEqualTo("t.cfg:1:61: there is no file gone.world");
        assertThat(configProblem(STAGE.replace("simulation:0", "position2d:0")))
                .isEqualTo("t.cfg:1:34: position2d is provided by a driver with a \"model\", not by the one with the"
                        + " \"worldfile\"");
    }

    @Test
    void rangers_ofOneRobot_areBoundInTheOrderOfProvides() {
        write("w.world", """
                position ( name "full"
                  laser ( range_max 8 ) ranger ( scount 1 spose[0] [ 0 0 0 ] )
                  model ( pose [ 0 0.1 0 90 ] laser ( range_max 4 ) ) )
                """);
        Scenario scenario = config(STAGE + provides("\"laser:4\" \"sonar:0\" \"7000:laser:0\"", "full"));
        assertThat(scenario.devices())
                .extracting(device -> address(device) + " " + device.ranger())
                .containsExactly("6665 simulation:0 0", "6665 laser:4 0", "6665 sonar:0 0", "7000 laser:0 1");
        assertThat(scenario.world().robots().getFirst().rangers())
                .extracting(ranger -> ranger.sensors().getFirst().maxRangeM())
                .containsExactly(8.0, 4.0);
        assertThat(configProblem(STAGE + provides("\"laser:0\" \"laser:1\" \"laser:2\"", "full")))
                .isEqualTo("t.cfg:2:54: robot \"full\" has 2 of laser, and they are already provided, the last at"
                        + " t.cfg:2:44");
    }

    @Test
    void ring_ofSonars_isProvidedByBothInterfaces_inBothDialects_andAScanIsNot() {
        assertThat(devices("\"ranger:0\" \"sonar:0\""))
                .extracting(device -> device.interfaceName() + ":" + device.index() + " " + device.ranger())
                .containsExactly("simulation:0 0", "ranger:0 " + DeviceBinding.SONAR_RING, "sonar:0 0");
        write("w.world", """
                position ( name "full" ranger ( sensor ( samples 180 ) )
                  ranger ( sensor ( samples 1 ) sensor ( samples 1 ) ) )
                """);
        assertThat(devices("\"sonar:0\" \"ranger:0\" \"ranger:1\""))
                .extracting(DeviceBinding::ranger)
                .containsExactly(0, 1, 0, 1);

        write("w.world", """
                position ( name "full" ranger ( sensor ( samples 90 ) ) ranger ( sensor ( samples 180 ) ) )
                """);
        assertThat(devices("\"ranger:0\" \"ranger:1\""))
                .extracting(DeviceBinding::ranger)
                .containsExactly(0, 0, 1);
        assertThat(configProblem(STAGE + provides("\"sonar:0\"", "full")))
                .isEqualTo("t.cfg:2:34: robot \"full\" (w.world:1:1) cannot provide sonar; it can provide position2d,"
                        + " ranger");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            rangertolaser | "laser:0" | "ranger:1" | laser:0 0
            rangertolaser | "6666:laser:3" | ":ranger:1" | laser:3 0
            lasertoranger | "ranger:7" | "laser:5" | ranger:7 2
            sonartoranger | "ranger:7" | "sonar:0" | ranger:7 1
            """)
    void driverThatOnlyRenames_offersTheDeviceByTheOtherInterfaceToo(
            String driver, String provides, String requires, String device) {
        write("w.world", """
                position ( name "full" ranger ( sensor ( samples 180 ) )
                  ranger ( sensor ( samples 1 ) sensor ( samples 1 ) ) laser () )
                """);
        var warnings = new ArrayList<String>();
        Scenario scenario = ScenarioReader.read(
                write(
                        "t.cfg",
                        "driver ( name \"" + driver + "\" provides [ " + provides + " ] requires [ " + requires
                                + " ] )\n" + STAGE
                                + provides("\"ranger:1\" \"ranger:0\" \"sonar:0\" \"laser:5\"", "full")),
                into(warnings));
        assertThat(scenario.devices()).hasSize(6);
        DeviceBinding renamed = scenario.devices().getLast();
        assertThat(renamed.interfaceName() + ":" + renamed.index() + " " + renamed.ranger())
                .isEqualTo(device);
        assertThat(renamed.model()).isEqualTo("full");
        assertThat(renamed.port()).isEqualTo(provides.contains("6666") ? 6666 : 6665);
        assertThat(warnings).noneMatch(warning -> warning.contains(driver));
    }

    @Test
    void ringOfSonars_isRenamedToARanger() {
        String renaming = "driver ( name \"sonartoranger\" provides [ \"ranger:0\" ] requires [ \"sonar:0\" ] )";
        assertThat(config(STAGE + provides("\"sonar:0\"", "full") + renaming).devices())
                .extracting(device -> device.interfaceName() + ":" + device.index() + " " + device.ranger())
                .containsExactly("simulation:0 0", "sonar:0 0", "ranger:0 " + DeviceBinding.SONAR_RING);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            "laser:0"  | "ranger:4" | t.cfg:3:63: driver "rangertolaser" is left out: no driver provides ranger:4 on port 6665
            "laser:0"  | "ranger:0" | t.cfg:3:63: driver "rangertolaser" is left out: a laser is one sensor, and ranger:0 of "full" has several
            "ranger:9" | "ranger:0" | t.cfg:3:1: driver "rangertolaser" is left out: expected provides [ "laser:0" ] requires [ "ranger:0" ]
            """)
    void driverThatRenamesWhatIsNotThere_isLeftOutWithAWarning(String provides, String requires, String warning) {
        write("w.world", """
                position ( name "full" ranger ( sensor ( samples 1 ) sensor ( samples 1 ) ) )
                """);
        var warnings = new ArrayList<String>();
        Scenario scenario = ScenarioReader.read(
                write(
                        "t.cfg",
                        STAGE + provides("\"ranger:0\"", "full") + "\ndriver ( name \"rangertolaser\" provides [ "
                                + provides + " ] requires [ " + requires + " ] )"),
                into(warnings));
        assertThat(scenario.devices()).hasSize(2);
        assertThat(warnings).containsExactly(warning);
    }

    @Test
    void otherDriversAndInterfaces_areLeftOutWithAWarning_unknownOnesLeniently() {
        var warnings = new ArrayList<String>();
        Path file = write("t.cfg", STAGE + """
                driver ( name "vfh" provides [ "position2d:1" ] requires [ "laser:0" ] safety_dist 0.3 )
                driver ( name "stage" provides [ "speech:0" "sonar:0" ] requires [ "map:0" ] model "full" )
                """);
        Scenario scenario = ScenarioReader.read(file, into(warnings));
        assertThat(scenario.devices()).extracting(DeviceBinding::interfaceName).containsExactly("simulation", "sonar");
        assertThat(warnings)
                .containsExactly(
                        "t.cfg:3:57: \"requires\" has no effect here: the drivers offered here need no other device",
                        "t.cfg:2:15: driver \"vfh\" is not run here and left out, and what it provides with it;"
                                + " expected \"stage\"",
                        "t.cfg:3:34: interface \"speech\" is not provided here and left out; provided are blobfinder,"
                                + " bumper, camera, fiducial, gripper, laser, position2d, ranger, simulation, sonar");
        var lenient = new ArrayList<String>();
        Path slip = write("t.cfg", STAGE + provides("\"sonr:0\" \"sonar:0\"", "full"));
        Scenario read = ScenarioReader.readLeniently(slip, warning -> lenient.add(warning.problem()));
        assertThat(read.devices()).extracting(DeviceBinding::interfaceName).containsExactly("simulation", "sonar");
        assertThat(lenient).singleElement().asString().contains("unknown interface \"sonr\"", "\"sonar\"?");
    }
}
