package io.troupe.demo.worlds;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.RobotReading;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.sim.worldfile.WorldFileWarning;
import java.awt.image.BufferedImage;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import javax.imageio.ImageIO;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.parallel.Execution;
import org.junit.jupiter.api.parallel.ExecutionMode;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** The worlds in {@code demo/worlds}: they are readable, offer the configured devices, and robots can move in them. */
@Execution(ExecutionMode.CONCURRENT)
class ShippedWorldsTest {
    private static final int TICKS_OF_10_SECONDS = 100;

    private static Path file(String name) {
        return Path.of("worlds", name);
    }

    private static Scenario read(String name) {
        return ScenarioReader.read(file(name));
    }

    @ParameterizedTest
    @CsvSource({"paper-arena", "office", "cave", "track"})
    void robots_drivingForTenSeconds_neverReachIntoAWall(String name) {
        World world = World.create(
                read(name + ".cfg").world(),
                WorldSettings.defaults().withSeed(7).withJitter(0.02, Math.toRadians(2)));
        int robots = world.spec().robots().size();
        for (int tick = 0; tick < TICKS_OF_10_SECONDS; tick++) {
            for (int robot = 0; robot < robots; robot++) {
                world.command(robot, 0.4, 0.5 * StrictMath.sin(tick / 10.0 + robot));
            }
            for (RobotReading robot : world.advance().robots()) {
                assertThat(robot.wallGapM()).as("%s at tick %d", name, tick).isPositive();
            }
        }
        for (int robot = 0; robot < robots; robot++) {
            var start = world.spec().robots().get(robot).pose();
            var end = world.latest().robots().get(robot).pose();
            assertThat(StrictMath.hypot(end.x() - start.x(), end.y() - start.y()))
                    .as("way of robot %d in %s", robot + 1, name)
                    .isGreaterThan(0.5);
        }
    }

    @Test
    void cave_hasFewPiecesAndExactOutlines_andTheLasersOfTheOfficeAreWhereTheConfigurationSays() {
        ObstacleSpec cave = read("cave.world").world().obstacles().getFirst();

        // the rectangles cover the dark pixels, the lines surround them; the boundary adds four pieces
        assertThat(cave.shape().polygons()).hasSizeBetween(100, 1200);
        assertThat(cave.shape().outlines()).hasSizeBetween(5, 40);

        assertThat(read("office.cfg").devices())
                .filteredOn(device -> device.interfaceName().equals("laser"))
                .extracting(DeviceBinding::model)
                .containsExactly("robot1");
    }

    /** {@code -Dfigures=write} writes the image. */
    @Test
    void caveImage_isWhatItsGeneratorDraws() throws IOException {
        BufferedImage drawn = CaveImage.draw();
        if ("write".equals(System.getProperty("figures"))) {
            assertThat(ImageIO.write(drawn, "png", file("cave.png").toFile())).isTrue();
        }
        BufferedImage shipped = ImageIO.read(file("cave.png").toFile());

        assertThat(List.of(shipped.getWidth(), shipped.getHeight()))
                .containsExactly(drawn.getWidth(), drawn.getHeight());
        assertThat(pixels(shipped)).containsExactly(pixels(drawn));
    }

    private static int[] pixels(BufferedImage image) {
        return image.getRGB(0, 0, image.getWidth(), image.getHeight(), null, 0, image.getWidth());
    }

    @ParameterizedTest
    @CsvSource({"paper-arena,2,7", "office,2,8", "cave,1,5", "track,1,4"})
    void world_offersItsRobotsDevices_andItsTwinForStage4IsTheSameWithRangers(String name, int robots, int devices) {
        Scenario scenario = read(name + ".world");
        WorldSpec classic = scenario.world();
        assertThat(classic.robots()).hasSize(robots);
        assertThat(scenario.devices()).hasSize(devices);
        assertThat(scenario.devices().getFirst().interfaceName()).isEqualTo("simulation");

        var warnings = new ArrayList<WorldFileWarning>();
        Scenario twin = ScenarioReader.read(file("stage4/" + name + ".world"), warnings::add);

        assertThat(warnings).isEmpty();
        assertThat(twin.devices()).hasSize(devices);
        assertThat(twin.world().name()).isEqualTo(classic.name());
        assertThat(twin.world().obstacles())
                .usingRecursiveFieldByFieldElementComparatorIgnoringFields("where", "traits.reflectance")
                .isEqualTo(classic.obstacles());
        assertThat(twin.world().robots()).zipSatisfy(classic.robots(), (robot, other) -> {
            assertThat(robot)
                    .usingRecursiveComparison()
                    .ignoringFields("where", "sonar", "rangers", "startOdometry", "drive", "traits.reflectance")
                    .isEqualTo(other);
            assertThat(robot.sonar()).isNull();
            assertThat(robot.rangers().getFirst().sensors())
                    .extracting(RangeSensorSpec::mount)
                    .isEqualTo(other.sonar().mounts());
            assertThat(robot.rangers()).hasSize(1 + other.rangers().size());
        });
    }

    /** Stage 4 rejects a world with an unknown type or interface. */
    @Test
    void twinsForStage4_haveNothingOfTheClassicDialect() throws IOException {
        String classic = "\\blaser\\s*\\(|define \\w+ laser|scount|spose|sview|ssize|\"sonar|\"laser:";
        var files = "paper-arena.world office.world cave.world track.world office.cfg";
        assertThat(files.split(" ")).allSatisfy(name -> {
            String text = Files.readString(file("stage4/" + name)).replaceAll("#.*", "");
            assertThat(text).doesNotContainPattern(classic);
        });
    }
}
