package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.device.Odometry;
import io.troupe.sim.model.Pose;
import io.troupe.sim.worldfile.ScenarioReader;
import java.io.IOException;
import java.io.StringReader;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;

/** Omnidirectional robots, robots that steer like a car, and acceleration bounds, against closed forms. */
class SteeringTest {
    private static final double EXACT = 1e-9;

    private static World world(String properties) {
        return Specs.start("position ( size [ 0.4 0.4 0.2 ] " + properties + " )");
    }

    private static World accelerating(String properties) {
        String text = "position ( size [ 0.4 0.4 0.2 ] " + properties + " )";
        return World.create(
                ScenarioReader.readText(text, Path.of("t.world")).world(),
                WorldSettings.defaults().withAccelerationBounds(true));
    }

    private static void assertAt(World world, double x, double y, double headingRad) {
        Pose pose = Specs.first(world.latest()).pose();
        assertThat(pose.x()).isCloseTo(x, within(EXACT));
        assertThat(pose.y()).isCloseTo(y, within(EXACT));
        assertThat(pose.headingRad()).isCloseTo(headingRad, within(EXACT));
    }

    private static Odometry odometry(World world) {
        return Specs.first(world.latest()).odometry();
    }

    // ---- omni

    @Test
    void omni_withoutTurning_movesAlongAStraightLine() {
        var world = world("drive \"omni\" pose [ 0 0 0 90 ]");
        world.command(0, 0.3, 0.4, 0);
        world.advance(20);
        assertAt(world, -0.8, 0.6, Math.PI / 2);
        assertThat(odometry(world))
                .isEqualTo(new Odometry(
                        new Pose(
                                odometry(world).pose().x(),
                                odometry(world).pose().y(),
                                0),
                        0.3,
                        0.4,
                        0,
                        false));
    }

    @Test
    void omni_thatTurns_movesOnACircle() {
        // v = (f, s) turns with the robot: the path is a circle of radius |v| / w around (-s / w, f / w)
        double f = 0.3;
        double s = -0.2;
        double w = 0.5;
        var world = world("drive \"omni\"");
        world.command(0, f, s, w);
        world.advance(40);
        double angle = w * 4;
        double x = (f * Math.sin(angle) - s * (1 - Math.cos(angle))) / w;
        double y = (f * (1 - Math.cos(angle)) + s * Math.sin(angle)) / w;
        assertAt(world, x, y, angle);
    }

    @Test
    void diff_commandedSideways_doesNotMoveSideways() {
        var world = world("");
        world.command(0, 0.3, 0.4, 0);
        world.advance(10);
        assertAt(world, 0.3, 0, 0);
        assertThat(odometry(world).sidewaysMps()).isZero();
    }

    @Test
    void omni_bounds_clampEachAxis() {
        var world = world("drive \"omni\" velocity_bounds [ -0.5 0.5 -0.1 0.2 0 0 -90 90 ]");
        world.command(0, 1, 1, 0);
        world.advance(10);
        assertAt(world, 0.5, 0.2, 0);
        world.command(0, 0, -1, 0);
        world.advance(10);
        assertAt(world, 0.5, 0.1, 0);
    }

    @Test
    void omni_startVelocity_isThatOfTheFile() {
        var world = world("drive \"omni\" velocity [ 0.1 0.2 0 0 ]");
        world.advance(10);
        assertAt(world, 0.1, 0.2, 0);
    }

    @Test
    void omni_goesToAPose_alongAllAxesAtOnce() {
        var world = world("drive \"omni\" pose [ 0 0 0 90 ] localization_origin [ 0 0 0 0 ]");
        world.goTo(0, new Pose(1, -1, 0));
        world.advance();
        assertThat(odometry(world).forwardMps())
                .as("1 m behind along its x axis")
                .isCloseTo(-0.4, within(EXACT));
        assertThat(odometry(world).sidewaysMps()).as("1 m to the right").isCloseTo(-0.4, within(EXACT));
        world.advance(200);
        Pose end = Specs.first(world.latest()).pose();
        assertThat(Math.hypot(end.x() - 1, end.y() + 1)).isLessThan(1e-4);
        assertThat(end.headingRad()).isCloseTo(0, within(1e-4));
    }

    @Test
    void omni_againstAWall_stalls() {
        var world = Specs.start(
                "position ( size [ 0.4 0.4 0.2 ] drive \"omni\" ) model ( pose [ 0 0.5 0 0 ] size [ 3 0.2 0.5 ] )");
        world.command(0, 0, 0.5, 0);
        world.advance(20);
        assertThat(Specs.first(world.latest()).pose().y()).isBetween(0.17, 0.2);
        assertThat(odometry(world).stalled()).isTrue();
    }

    @Test
    void omni_moves_areRecordedAndReplayed() throws IOException {
        var world = world("drive \"omni\" localization \"odom\"");
        var text = new StringBuilder();
        long hash;
        try (Recording recording = world.record(text)) {
            world.command(0, 0.1, 0.2, 0.3);
            world.advance(5);
            world.command(0, 0.1, 0, 0.3);
            world.advance(5);
            hash = recording.hash();
        }
        assertThat(text.toString()).contains("0 omni 0 0.1 0.2 0.3\n").contains("5 velocity 0 0.1 0.3\n");
        assertThat(Replay.read(new StringReader(text.toString())).play(world.spec(), snapshot -> {}))
                .isEqualTo(hash);
    }

    // ---- car

    @Test
    void car_withAnAngle_drivesOnTheCircleOfItsWheelbase() {
        // ahead at v cos a, turning at v sin a / L, so on a circle of radius L / tan a
        double v = 0.5;
        double a = 0.4;
        var world = world("drive \"car\" wheelbase 0.8");
        world.command(0, v, a);
        world.advance(30);
        double radius = 0.8 / Math.tan(a);
        double turned = v * Math.sin(a) / 0.8 * 3;
        assertAt(world, radius * Math.sin(turned), radius * (1 - Math.cos(turned)), turned);
        assertThat(odometry(world).forwardMps()).isCloseTo(v * Math.cos(a), within(EXACT));
        assertThat(odometry(world).turnRadps()).isCloseTo(v * Math.sin(a) / 0.8, within(EXACT));
    }

    @Test
    void car_thatStands_doesNotTurn() {
        var world = world("drive \"car\"");
        world.command(0, 0, 0.7);
        world.advance(10);
        assertAt(world, 0, 0, 0);
    }

    @Test
    void car_sentToAPose_isRefused() {
        var world = world("name \"beetle\" drive \"car\"");
        assertThatThrownBy(() -> world.goTo(0, Pose.ORIGIN))
                .hasMessage("robot 'beetle' steers like a car and cannot be sent to a pose: command its speed and"
                        + " steering angle");
        assertThatThrownBy(() -> world.steer(0, 1, 1)).hasMessageContaining("cannot be steered to a heading");
    }

    // ---- acceleration bounds

    @Test
    void acceleration_byDefault_isUnlimited() {
        var world = world("acceleration_bounds [ -1 0.5 0 0 0 0 -10 10 ]");
        world.command(0, 0.8, 0);
        world.advance(10);
        assertAt(world, 0.8, 0, 0);
    }

    @Test
    void acceleration_obeyed_speedRisesByStepsAndTheWayIsTheirSum() {
        var world = accelerating("acceleration_bounds [ -2 0.5 0 0 0 0 -10 10 ]");
        world.command(0, 0.2, 0);
        world.advance(10);
        // 0.05, 0.1, 0.15, 0.2, 0.2, ..
        assertAt(world, 0.1 * (0.05 + 0.1 + 0.15 + 7 * 0.2), 0, 0);
        world.command(0, -0.2, 0);
        world.advance();
        assertThat(odometry(world).forwardMps()).as("2 m/s2 down").isEqualTo(0);
        world.advance();
        assertThat(odometry(world).forwardMps()).isCloseTo(-0.2, within(EXACT));
    }

    @Test
    void acceleration_obeyed_limitsTurnsAndMotionSideways() {
        var world = accelerating("drive \"omni\" acceleration_bounds [ -1 1 -0.1 0.3 0 0 -90 45 ]");
        world.command(0, 0, 1, 1);
        world.advance();
        assertThat(odometry(world).sidewaysMps()).isCloseTo(0.03, within(EXACT));
        assertThat(odometry(world).turnRadps()).isCloseTo(Math.toRadians(4.5), within(EXACT));
    }

    @Test
    void accelerationSetting_isRecordedOnlyWhenItIsOn() {
        assertThat(WorldSettings.parse(WorldSettings.defaults().words())).isEqualTo(WorldSettings.defaults());
        var on = WorldSettings.defaults().withAccelerationBounds(true);
        assertThat(on.words()).isEqualTo(WorldSettings.defaults().words() + " acceleration");
        assertThat(WorldSettings.parse(on.words())).isEqualTo(on);
    }
}
