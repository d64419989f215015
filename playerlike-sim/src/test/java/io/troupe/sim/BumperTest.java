package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.device.DeviceReading;
import java.util.List;
import org.junit.jupiter.api.Test;

/** When bumpers are pressed. The robots are 0.4 m long and wide, with a bumper along each side. */
class BumperTest {
    private static final String ROBOT = """
            define bumpy position ( size [ 0.4 0.4 0.2 ]
              bumper ( bcount 4 blength 0.4 bpose[0] [ 0.2 0 0 0 ] bpose[1] [ 0 0.2 0 90 ] bpose[2] [ -0.2 0 0 180 ]
                bpose[3] [ 0 -0.2 0 -90 ] ) )
            bumpy ( name "r" )
            """;

    private static List<Boolean> pressed(World world, int robot) {
        RobotReading reading = world.latest().robots().get(robot);
        return ((DeviceReading.Pressed) reading.devices().getFirst()).bumpers();
    }

    @Test
    void bumper_nothingNear_isNotPressed() {
        var world = Specs.start(ROBOT + "model ( pose [ 0.25 0 0 0 ] size [ 0.04 1 1 ] )"); // 3 cm ahead
        assertThat(pressed(world, 0)).containsExactly(false, false, false, false);
    }

    @Test
    void bumper_wallWithinTwoCentimetres_isPressedOnThatSideOnly() {
        var world = Specs.start(ROBOT + "model ( pose [ 0.235 0 0 0 ] size [ 0.04 0.2 1 ] )"); // 1.5 cm ahead
        assertThat(pressed(world, 0)).containsExactly(true, false, false, false);
    }

    @Test
    void bumper_wallThatBlocksNoBodies_isNotPressed() {
        var world = Specs.start(ROBOT + "model ( pose [ 0.235 0 0 0 ] size [ 0.04 0.2 1 ] obstacle_return 0 )");
        assertThat(pressed(world, 0)).doesNotContain(true);
    }

    @Test
    void bumper_robotThatDrivesToAWallAndBack_isPressedWhileItStalls() {
        var world = Specs.driven(0.5, Specs.start(ROBOT + "model ( pose [ 1.3 0 0 0 ] size [ 0.2 2 1 ] )"));
        int first = 0;
        while (!pressed(world, 0).getFirst()) {
            world.advance();
            first++;
        }
        assertThat(first).as("a gap of 1 m at 5 cm an interval").isBetween(19, 21);
        world.advance(10);
        assertThat(world.latest().robots().getFirst().odometry().stalled()).isTrue();
        assertThat(pressed(world, 0)).containsExactly(true, false, false, false);
        world.command(0, -0.5, 0);
        world.advance(2);
        assertThat(pressed(world, 0)).doesNotContain(true);
    }

    @Test
    void bumpers_twoRobotsThatMeet_arePressedOnBoth() {
        var world = Specs.driven(0.3, Specs.start(ROBOT + "bumpy ( name \"s\" pose [ 1 0.1 0 180 ] )"));
        world.advance(30);
        assertThat(pressed(world, 0)).containsExactly(true, false, false, false);
        assertThat(pressed(world, 1)).containsExactly(true, false, false, false);
    }
}
