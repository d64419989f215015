package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Scenario;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Robots that steer in other ways, driven by Player's commands over TCP and compared with closed forms. */
@Timeout(60)
class SteeringMessagesTest {
    private static final double EXACT = 1e-5; // single precision of the physics
    private static final double INTERVAL_S = 0.1;

    private static Scenario robot(String properties) {
        return Served.scenario("position ( name \"r\" size [ 0.4 0.4 0.2 ] " + properties + " )");
    }

    private static RawClient commanding(Served served, DeviceCommand command) throws Exception {
        RawClient client = served.client();
        client.subscribe(Interfaces.POSITION2D);
        client.send(RawClient.message(MessageType.CMD, 4, 0, CommandCodec.encode(command)));
        client.sync();
        return client;
    }

    /** The position that the client receives after so many intervals with its command. */
    private static DeviceData.Position2d after(int intervals, Served served, RawClient client) throws Exception {
        served.tick(intervals + 1); // the first publishes where it stands
        for (int i = 0; i < intervals; i++) {
            client.nextPosition();
        }
        return client.nextPosition();
    }

    private static void assertAt(DeviceData.Position2d position, double x, double y, double headingRad) {
        assertThat(position.px()).isCloseTo(x, within(EXACT));
        assertThat(position.py()).isCloseTo(y, within(EXACT));
        assertThat(position.pa()).isCloseTo(headingRad, within(EXACT));
    }

    @Test
    void omni_commandedAheadAndSideways_movesAlongBoth() throws Exception {
        try (var served = Served.open(robot("drive \"omni\""))) {
            RawClient client = commanding(served, new DeviceCommand.Velocity(0.3, -0.2, 0, true));
            DeviceData.Position2d there = after(10, served, client);
            assertAt(there, 0.3, -0.2, 0);
            assertThat(there.vx()).isEqualTo(0.3);
            assertThat(there.vy()).isEqualTo(-0.2);
        }
    }

    @Test
    void diff_commandedSideways_doesNotMoveSideways() throws Exception {
        try (var served = Served.open(robot("drive \"diff\""))) {
            RawClient client = commanding(served, new DeviceCommand.Velocity(0.3, -0.2, 0, true));
            assertAt(after(10, served, client), 0.3, 0, 0);
        }
    }

    @Test
    void car_commandedAnAngle_drivesOnTheCircleOfItsWheelbase() throws Exception {
        double speedMps = 0.5;
        double angleRad = 0.4;
        double radiusM = 0.8 / Math.tan(angleRad);
        double turnedRad = speedMps * Math.sin(angleRad) / 0.8 * 20 * INTERVAL_S;
        try (var served = Served.open(robot("drive \"car\" wheelbase 0.8"))) {
            RawClient client = commanding(served, new DeviceCommand.Velocity(speedMps, 0, angleRad, true));
            DeviceData.Position2d there = after(20, served, client);
            assertAt(there, radiusM * Math.sin(turnedRad), radiusM * (1 - Math.cos(turnedRad)), turnedRad);
            assertThat(there.va()).isCloseTo(speedMps * Math.sin(angleRad) / 0.8, within(EXACT));
        }
    }

    @Test
    void accelerationBounds_ifObeyed_letTheSpeedRiseByEqualSteps() throws Exception {
        Scenario robot = robot("acceleration_bounds [ -1 0.5 0 0 0 0 -10 10 ] velocity_bounds [ -1 1 0 0 0 0 -90 90 ]");
        try (var served = Served.open(robot, WorldSettings.defaults().withAccelerationBounds(true))) {
            RawClient client = commanding(served, new DeviceCommand.Velocity(0.8, 0, 0, true));
            DeviceData.Position2d there = after(4, served, client);
            assertThat(there.vx()).as("four steps of 0.05 m/s").isCloseTo(0.2, within(EXACT));
            assertAt(there, INTERVAL_S * (0.05 + 0.1 + 0.15 + 0.2), 0, 0);
        }
        try (var served = Served.open(robot)) {
            RawClient client = commanding(served, new DeviceCommand.Velocity(0.8, 0, 0, true));
            assertThat(after(4, served, client).vx()).as("by default").isEqualTo(0.8);
        }
    }
}
