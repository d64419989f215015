package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.device.ColourBlob;
import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;

/** What a world file specifies of a robot beyond its body and sensors, tested in motion. */
class CargoTest {
    private static final String SONAR = "ranger ( scount 1 spose[0] [ 0 0 0 ] sview [ 0 5 15 ] )";

    private static World world(String text) {
        return World.create(
                ScenarioReader.readText(text, Path.of("cargo.world")).world(), WorldSettings.DEFAULT);
    }

    private static RobotReading run(World world, int ticks) {
        for (int i = 0; i < ticks; i++) {
            world.advance();
        }
        return world.latest().robots().getFirst();
    }

    @Test
    void cargo_isSeenByOthersInItsOwnColour_andNotByItsRobot() {
        World world = world("position ( name \"eye\" " + SONAR + " blobfinder ( range 5 ) ) position ( name \"carrier\""
                + " pose [ 3 0 0 180 ] size [ 0.4 0.4 ] color \"black\" " + SONAR
                + " model ( pose [ 0.4 0 0 0 ] size [ 0.2 0.2 ] color \"blue\" ) )");

        RobotReading eye = world.latest().robots().get(0);
        assertThat(eye.sonarM()).containsExactly(2.5);
        assertThat(eye.blobs().blobs()).extracting(ColourBlob::colour).contains(0x0000ff, 0x000000);
        // the other robot's sonar is behind its cargo and looks through it: the first robot's front is at 0.05
        assertThat(world.latest().robots().get(1).sonarM().getFirst()).isCloseTo(2.95, within(1e-9));

        world.command(1, -0.5, 0);
        assertThat(run(world, 10).sonarM().getFirst()).isCloseTo(3, within(1e-9));
    }

    @Test
    void cargo_bumpsIntoWalls_unlessItsObstacleReturnIsZero() {
        String robot = "model ( pose [ 2 0 0 0 ] size [ 0.2 2 ] ) position ( size [ 0.4 0.4 ]"
                + " model ( pose [ 0.4 0 0 0 ] size [ 0.2 0.2 ] obstacle_return %d ) )";
        World loaded = world(robot.formatted(1));
        World ghostly = world(robot.formatted(0));
        loaded.command(0, 0.5, 0);
        ghostly.command(0, 0.5, 0);

        // the wall begins at 1.9: cargo reaches 0.5 ahead, the body 0.2
        assertThat(run(loaded, 60).pose().x()).isBetween(1.36, 1.4);
        assertThat(run(ghostly, 60).pose().x()).isBetween(1.66, 1.7);
    }

    @Test
    void robot_withoutObstacleReturn_drivesThroughWallsAndRobots() {
        World world = world("position ( obstacle_return 0 size [ 0.4 0.4 ] ) position ( pose [ 0.1 0 0 0 ] )"
                + " model ( pose [ 1 0 0 0 ] size [ 0.2 2 ] )");
        world.command(0, 0.5, 0);

        assertThat(run(world, 40).pose().x()).isCloseTo(2, within(1e-9));
        assertThat(world.latest().contacts()).isEmpty();
        assertThat(world.latest().robots().get(1).pose().x()).isEqualTo(0.1);
    }

    @Test
    void robot_withAStartVelocity_drivesUntilItIsToldOtherwise() {
        World world = world("position ( velocity [ 0.5 0 0 0 ] )");

        assertThat(run(world, 10).pose().x()).isCloseTo(0.5, within(1e-9));
        world.stop(0);
        assertThat(run(world, 10).pose().x()).isCloseTo(0.5, within(1e-9));
    }

    @Test
    void command_beyondTheVelocityBounds_isClamped() {
        World world = world("position ( velocity_bounds [ -0.1 0.3 0 0 0 0 -10 45 ] )");
        world.command(0, 1, 5);
        Odometry reading = new Odometry(run(world, 1));
        assertThat(reading.forwardMps()).isEqualTo(0.3);
        assertThat(reading.turnRadps()).isCloseTo(Math.toRadians(45), within(1e-12));

        world.command(0, -1, -5);
        reading = new Odometry(run(world, 1));
        assertThat(reading.forwardMps()).isEqualTo(-0.1);
        assertThat(reading.turnRadps()).isCloseTo(Math.toRadians(-10), within(1e-12));
    }

    private record Odometry(double forwardMps, double turnRadps) {
        Odometry(RobotReading reading) {
            this(reading.odometry().forwardMps(), reading.odometry().turnRadps());
        }
    }

    @Test
    void wallWithABay_isSeenAtTheBaysBack() {
        List<Double> expected = world("position ( " + SONAR + " ) model ( pose [ 2 0 0 0 ] size [ 1 1 ] block ("
                        + " point[0] [ 0 0 ] point[1] [ 3 0 ] point[2] [ 3 3 ] point[3] [ 0 3 ] point[4] [ 0 2 ]"
                        + " point[5] [ 1 2 ] point[6] [ 1 1 ] point[7] [ 0 1 ] ) )")
                .latest()
                .robots()
                .getFirst()
                .sonarM();

        // into the bay, to its back wall
        assertThat(expected.getFirst()).isCloseTo(1.5 + 1.0 / 3, within(1e-9));
    }
}
