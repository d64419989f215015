package io.troupe.player;

import static io.troupe.player.wire.Interfaces.BLOBFINDER;
import static io.troupe.player.wire.Interfaces.LASER;
import static io.troupe.player.wire.Interfaces.POSITION2D;
import static io.troupe.player.wire.Interfaces.RANGER;
import static io.troupe.player.wire.Interfaces.SIMULATION;
import static io.troupe.player.wire.Interfaces.SONAR;
import static io.troupe.sim.TestWorlds.NOWHERE;
import static io.troupe.sim.TestWorlds.RED;
import static io.troupe.sim.TestWorlds.robot;
import static io.troupe.sim.TestWorlds.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.Interfaces;
import io.troupe.player.wire.LaserConfiguration;
import io.troupe.player.wire.Pose3d;
import io.troupe.player.wire.RangerConfiguration;
import io.troupe.player.wire.Size3d;
import io.troupe.sim.Simulation;
import io.troupe.sim.TestWorlds;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeNoise;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.Scenario;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Messages that the simulated devices send and understand. Robot one has a laser, a ranger and a second laser. */
@Timeout(60)
class SimulatedDevicesTest {
    static final int PORT = 6790;
    private static final double DEGREE = StrictMath.PI / 180;

    private final Simulation simulation = Simulation.open(scenario(), WorldSettings.DEFAULT);
    private final WireClient client = new WireClient(PORT, WireClient.ANSWER);

    private static RangeSensorSpec sensor(Pose mount, int fovDeg, int samples) {
        return new RangeSensorSpec(mount, 0.1, 8, fovDeg * DEGREE, samples, 0.03, 0.05, RangeNoise.NONE);
    }

    static Scenario scenario() {
        var front = new RangerSpec(
                RangerSpec.Kind.LASER, new Pose(0.1, 0, 0), 0.15, 0.12, List.of(sensor(new Pose(0.1, 0, 0), 90, 3)));
        var ring = new RangerSpec(
                RangerSpec.Kind.RANGER,
                new Pose(0, 0.1, 90 * DEGREE),
                0.4,
                0.3,
                List.of(sensor(new Pose(0, 0.3, 90 * DEGREE), 15, 1), sensor(Pose.ORIGIN, 15, 1)));
        var back = new RangerSpec(
                RangerSpec.Kind.LASER,
                new Pose(0, 0, 180 * DEGREE),
                0.15,
                0.12,
                List.of(sensor(new Pose(0, 0, 180 * DEGREE), 0, 1)));
        var world = TestWorlds.world(
                List.of(robot("one", 0, 0, 0).withRangers(List.of(front, ring, back)), robot("two", -2, 0, 0)),
                wall("east", 3, 0, 0.2, 12, RED));
        var devices = new ArrayList<>(TestWorlds.scenario(PORT, world).devices());
        devices.add(new DeviceBinding(PORT, "laser", 0, "one", 0, NOWHERE));
        devices.add(new DeviceBinding(PORT, "laser", 1, "one", 2, NOWHERE));
        devices.add(new DeviceBinding(PORT, "ranger", 0, "one", 1, NOWHERE));
        devices.add(new DeviceBinding(PORT, "simulation", 0, "", 0, NOWHERE));
        return new Scenario(world, devices);
    }

    @AfterEach
    void close() {
        simulation.close();
    }

    private Pose pose(int robot) {
        return simulation.latest().robots().get(robot).pose();
    }

    private void ticks(int count) {
        for (int i = 0; i < count; i++) {
            simulation.tick();
        }
    }

    // ---- lasers and rangers

    @Test
    void laser_publishesItsScan_fromRightToLeft() {
        client.subscribe(LASER, 0);
        ticks(2);
        var scan = (DeviceData.LaserScan) client.newest(LASER, 0);
        assertThat(scan.minAngleRad()).isEqualTo((float) (-45 * DEGREE));
        assertThat(scan.maxAngleRad()).isEqualTo((float) (45 * DEGREE));
        assertThat(scan.resolutionRad()).isEqualTo((float) (45 * DEGREE));
        assertThat(scan.maxRangeM()).isEqualTo(8f);
        double straight = 2.9 - 0.1;
        float slanted = (float) (straight / StrictMath.cos(45 * DEGREE));
        assertThat(scan.rangesM()).containsExactly(slanted, (float) straight, slanted);
        assertThat(scan.intensities()).isEmpty();
        assertThat(scan.scanId()).isEqualTo(1);
    }

    @Test
    void severalRangers_ofOneRobot_areToldApart() {
        client.subscribe(LASER, 1).subscribe(RANGER, 0);
        ticks(1);
        assertThat(((DeviceData.LaserScan) client.newest(LASER, 1)).rangesM())
                .as("looks back at the front of robot two")
                .containsExactly((float) (2 - 0.2));
        assertThat(((DeviceData.RangerRanges) client.newest(RANGER, 0)).rangesM())
                .containsExactly(8.0, 2.9);
    }

    @Test
    void geometry_ofARanger_hasItsSensorsInItsOwnFrame() {
        var geometry = (DeviceReply.RangerGeometry) client.ask(RANGER, 0, new DeviceRequest.Geometry());
        assertThat(geometry.pose()).isEqualTo(Pose3d.flat(0, 0.1, 90 * DEGREE));
        assertThat(geometry.size()).isEqualTo(new Size3d(0.3, 0.4, 0));
        assertThat(geometry.elementSizes()).containsOnly(new Size3d(0.05, 0.03, 0));
        assertPose(geometry.elementPoses().get(0), 0.2, 0, 0);
        assertPose(geometry.elementPoses().get(1), -0.1, 0, -90 * DEGREE);
        assertThat(client.ask(LASER, 0, new DeviceRequest.Geometry()))
                .isEqualTo(new DeviceReply.LaserGeometry(Pose3d.flat(0.1, 0, 0), new Size3d(0.12, 0.15, 0)));
    }

    private static void assertPose(Pose3d actual, double x, double y, double yaw) {
        assertThat(actual.x()).isCloseTo(x, within(1e-12));
        assertThat(actual.y()).isCloseTo(y, within(1e-12));
        assertThat(actual.yaw()).isCloseTo(yaw, within(1e-12));
    }

    @Test
    void configuration_isThatOfTheFile_andCannotBeAnother() {
        var laser = new LaserConfiguration(
                (float) (-45 * DEGREE), (float) (45 * DEGREE), (float) (45 * DEGREE), 8, 1, false, 10);
        assertThat(client.ask(LASER, 0, new DeviceRequest.GetConfiguration()))
                .isEqualTo(new DeviceReply.OfLaser(laser));
        assertThat(client.ask(LASER, 0, new DeviceRequest.SetLaserConfiguration(laser)))
                .isEqualTo(new DeviceReply.OfLaser(laser));
        var rounded = new LaserConfiguration(-0.785f, 0.785f, 0.785f, 8, 0.01f, false, 0); // no frequency
        assertThat(client.ask(LASER, 0, new DeviceRequest.SetLaserConfiguration(rounded)))
                .as("what it is already, in round numbers")
                .isEqualTo(new DeviceReply.OfLaser(laser));
        for (var other : List.of(
                new LaserConfiguration(-0.785f, 0.785f, 0.775f, 8, 1, false, 0),
                new LaserConfiguration(-0.785f, 0.785f, Float.NaN, 8, 1, false, 0),
                new LaserConfiguration(-0.785f, 0.785f, 0.785f, 8, 1, true, 0),
                new LaserConfiguration(-0.785f, 0.785f, 0.785f, 8, 1, false, 20))) {
            assertRefused(client.ask(LASER, 0, new DeviceRequest.SetLaserConfiguration(other)), "world file");
        }
        var finer = new LaserConfiguration(0, 1, 0.1f, 8, 0, false, 10);
        assertRefused(client.ask(LASER, 0, new DeviceRequest.SetLaserConfiguration(finer)), "world file");
        var ranger = new RangerConfiguration(-7.5 * DEGREE, 7.5 * DEGREE, 15 * DEGREE, 0.1, 8, 0, 10);
        assertThat(client.ask(RANGER, 0, new DeviceRequest.GetConfiguration()))
                .isEqualTo(new DeviceReply.OfRanger(ranger));
        assertThat(client.ask(LASER, 1, new DeviceRequest.LaserId())).isEqualTo(new DeviceReply.LaserId(1));
        assertRefused(client.ask(RANGER, 0, new DeviceRequest.Intensities(true)), "not offer");
        assertThat(client.ask(RANGER, 0, new DeviceRequest.Intensities(false))).isEqualTo(new DeviceReply.Ack());
    }

    @Test
    void binding_toARangerThatIsNotThere_isRefused() {
        Scenario good = scenario();
        for (var bad : List.of(
                new DeviceBinding(PORT + 1, "laser", 0, "one", 1, NOWHERE),
                new DeviceBinding(PORT + 1, "laser", 0, "two", 0, NOWHERE))) {
            assertThatThrownBy(() -> Simulation.open(new Scenario(good.world(), List.of(bad)), WorldSettings.DEFAULT))
                    .isInstanceOf(IllegalArgumentException.class)
                    .hasMessageContaining("laser:0 is ranging device " + bad.ranger() + " of '" + bad.model() + "'");
        }
    }

    private static void assertRefused(DeviceReply reply, String reason) {
        assertThat(reply)
                .isInstanceOfSatisfying(
                        DeviceReply.Nack.class,
                        nack -> assertThat(nack.reason()).contains(reason));
    }

    // ---- position2d

    @Test
    void car_isSpeedAndTurnRate_andSidewaysIsIgnored() {
        client.subscribe(POSITION2D, 0).tell(POSITION2D, 0, new DeviceCommand.Car(0.2, 0.5));
        ticks(2);
        assertThat(simulation.latest().robots().getFirst().odometry().forwardMps())
                .isEqualTo(0.2);
        assertThat(simulation.latest().robots().getFirst().odometry().turnRadps())
                .isEqualTo(0.5);
        client.tell(POSITION2D, 0, new DeviceCommand.Velocity(0, 0.7, 0, true));
        ticks(1);
        Pose before = pose(0);
        ticks(2);
        assertThat(pose(0)).isEqualTo(before);
    }

    @Test
    void goTo_andVelocityHeading_areUnderstood() {
        client.subscribe(POSITION2D, 0).tell(POSITION2D, 0, new DeviceCommand.GoTo(0.5, 0, 1, 0, 0, 0, true));
        ticks(120);
        assertThat(pose(0).x()).isCloseTo(0.5, within(0.02));
        assertThat(pose(0).headingRad()).isCloseTo(1, within(0.01));
        client.tell(POSITION2D, 0, new DeviceCommand.VelocityHeading(0.1, -1));
        ticks(60);
        assertThat(pose(0).headingRad()).isCloseTo(-1, within(0.02));
    }

    @Test
    void stateZero_drives_asInStage() {
        client.subscribe(POSITION2D, 0).tell(POSITION2D, 0, new DeviceCommand.GoTo(0.5, 0, 1, 0, 0, 0, false));
        ticks(120);
        assertThat(pose(0).x()).isCloseTo(0.5, within(0.02));
        client.tell(POSITION2D, 0, new DeviceCommand.Velocity(0.1, 0, 0, false));
        ticks(2);
        assertThat(simulation.latest().robots().getFirst().odometry().forwardMps())
                .isEqualTo(0.1);
    }

    @Test
    void motorPower_off_holdsTheRobot() {
        client.subscribe(POSITION2D, 0);
        assertThat(client.ask(POSITION2D, 0, new DeviceRequest.Power(false))).isEqualTo(new DeviceReply.Ack());
        client.tell(POSITION2D, 0, new DeviceCommand.Velocity(0.5, 0, 0, true));
        ticks(3);
        assertThat(pose(0)).isEqualTo(Pose.ORIGIN);
        client.ask(POSITION2D, 0, new DeviceRequest.Power(true));
        client.tell(POSITION2D, 0, new DeviceCommand.Velocity(0.5, 0, 0, true));
        ticks(2);
        // the client has already answered: the command counts one tick later
        assertThat(pose(0).x()).isCloseTo(0.1, within(1e-9));
    }

    @Test
    void requestsThatStageRefuses_areRefused() {
        for (DeviceRequest request : List.of(
                new DeviceRequest.VelocityMode(0),
                new DeviceRequest.SpeedPid(1, 2, 3),
                new DeviceRequest.PositionPid(1, 2, 3),
                new DeviceRequest.SpeedProfile(1, 2),
                new DeviceRequest.PositionMode(7),
                new DeviceRequest.GetColour(),
                new DeviceRequest.Unknown(99))) {
            assertThat(client.ask(POSITION2D, 0, request)).as("%s", request).isInstanceOf(DeviceReply.Nack.class);
        }
        assertThat(client.ask(POSITION2D, 0, new DeviceRequest.PositionMode(1))).isEqualTo(new DeviceReply.Ack());
        assertRefused(client.ask(BLOBFINDER, 0, new DeviceRequest.SetColour(0, 1, 2, 3, 4, 5, 6)), "not offer");
        assertRefused(client.ask(BLOBFINDER, 0, new DeviceRequest.SetImager(0, 1, 2, 3)), "not offer");
    }

    @Test
    void capabilities_areWhatTheDevicesDo() {
        assertThat(capability(POSITION2D, 2, 2)).isTrue();
        assertThat(capability(POSITION2D, 3, 7)).isFalse();
        assertThat(capability(SONAR, 2, 1)).isFalse();
        assertThat(capability(SONAR, 1, 1)).isTrue();
        assertThat(capability(LASER, 3, 3)).isTrue();
        assertThat(capability(SIMULATION, 2, 3)).isFalse();
        assertThat(capability(BLOBFINDER, 3, 255)).isTrue();
        assertThat(capability(BLOBFINDER, 9, 1)).isFalse();
    }

    private boolean capability(Interfaces type, int messageType, int subtype) {
        return client.ask(type, 0, new DeviceRequest.Capability(messageType, subtype)) instanceof DeviceReply.Ack;
    }

    @Test
    void commandToTheWrongDevice_orWithoutANumber_isRefused() {
        assertThatThrownBy(() -> client.tell(SONAR, 0, new DeviceCommand.Car(0, 0)))
                .hasMessage("sonar:0 takes no commands");
        assertThatThrownBy(() -> client.tell(POSITION2D, 0, new DeviceCommand.Reset()))
                .hasMessage("position2d:0 does not understand Reset[]");
        assertThatThrownBy(() -> client.tell(SIMULATION, 0, new DeviceCommand.Car(0, 0)))
                .hasMessageStartingWith("simulation:0 does not understand Car");
        assertThatThrownBy(() -> client.tell(POSITION2D, 0, new DeviceCommand.Car(Double.NaN, 0)))
                .hasMessageContaining("expected finite numbers");
    }

    @Test
    void sensor_cannotBeSwitchedOff_soThatItsClientHasSomethingToAnswer() {
        client.subscribe(SONAR, 0);
        assertThat(client.ask(SONAR, 0, new DeviceRequest.Power(false)))
                .isEqualTo(new DeviceReply.Nack("sonar:0 of a simulated robot cannot be switched off"));
        assertThat(client.ask(SONAR, 0, new DeviceRequest.Power(true))).isEqualTo(new DeviceReply.Ack());
        ticks(3);
        assertThat(client.frames).as("a frame for each tick").hasSize(3);
    }

    // ---- simulation

    @Test
    void poses_canBeAsked_andSet() {
        client.subscribe(POSITION2D, 0);
        assertThat(client.ask(SIMULATION, 0, new DeviceRequest.GetPose("two")))
                .isEqualTo(new DeviceReply.ModelPose("two", -2, 0, 0));
        assertThat(client.ask(SIMULATION, 0, new DeviceRequest.GetPose("east")))
                .isEqualTo(new DeviceReply.ModelPose("east", 3, 0, 0));
        assertThat(client.ask(SIMULATION, 0, new DeviceRequest.SetPose("two", -3, 2, 1)))
                .isEqualTo(new DeviceReply.Ack());
        assertThat(client.ask(SIMULATION, 0, new DeviceRequest.SetPose("one", -1, -2, 0)))
                .isEqualTo(new DeviceReply.Ack());
        ticks(1);
        assertThat(pose(1)).isEqualTo(new Pose(-3, 2, 1));
        assertThat(pose(0)).isEqualTo(new Pose(-1, -2, 0));
    }

    @Test
    void poseThatCannotBe_isRefused_sayingWhy() {
        assertRefused(
                client.ask(SIMULATION, 0, new DeviceRequest.SetPose("one", 2.8, 0, 0)),
                "it would overlap obstacle 'east'");
        assertRefused(
                client.ask(SIMULATION, 0, new DeviceRequest.SetPose("one", -2, 0.1, 0)),
                "it would overlap robot 'two'");
        assertRefused(client.ask(SIMULATION, 0, new DeviceRequest.SetPose("three", 0, 0, 0)), "no model 'three'");
        assertRefused(client.ask(SIMULATION, 0, new DeviceRequest.SetPose("east", 0, 0, 0)), "only robots");
        assertRefused(client.ask(SIMULATION, 0, new DeviceRequest.GetPose("three")), "world 'test' has no model");
        assertRefused(client.ask(SIMULATION, 0, new DeviceRequest.Geometry()), "not offer");
    }

    @Test
    void reset_putsEverythingBack_andTimeGoesOn() {
        client.subscribe(POSITION2D, 0).tell(POSITION2D, 0, new DeviceCommand.Velocity(0.5, 0, 0.2, true));
        client.ask(POSITION2D, 0, new DeviceRequest.SetOdometry(5, 5, 0));
        ticks(5);
        assertThat(pose(0).x()).isPositive();
        client.tell(SIMULATION, 0, new DeviceCommand.Reset());
        ticks(2);
        assertThat(pose(0)).isEqualTo(Pose.ORIGIN);
        assertThat(simulation.latest().robots().getFirst().odometry().pose()).isEqualTo(Pose.ORIGIN);
        assertThat(simulation.latest().tick()).isEqualTo(7);
    }

    @Test
    void resetSpeedReset_inOneTick_leavesTheRobotStanding() {
        client.subscribe(POSITION2D, 0);
        client.tell(SIMULATION, 0, new DeviceCommand.Reset());
        client.tell(POSITION2D, 0, new DeviceCommand.Velocity(0.5, 0, 0, true));
        client.tell(SIMULATION, 0, new DeviceCommand.Reset());
        ticks(3);
        assertThat(pose(0)).isEqualTo(Pose.ORIGIN);

        client.tell(SIMULATION, 0, new DeviceCommand.Reset());
        client.tell(POSITION2D, 0, new DeviceCommand.Velocity(0.5, 0, 0, true));
        ticks(2);
        assertThat(pose(0).x()).as("a speed after the last reset").isCloseTo(0.1, within(1e-9));
    }

    @Test
    void resetSpeedReset_afterTheAnswer_leavesTheRobotStandingToo() {
        var talker = new WireClient(PORT, (self, frame) -> {
            self.line.answered(frame.tick());
            if (frame.tick() == 0) {
                self.tell(SIMULATION, 0, new DeviceCommand.Reset());
                self.tell(POSITION2D, 0, new DeviceCommand.Velocity(0.5, 0, 0, true));
                self.tell(SIMULATION, 0, new DeviceCommand.Reset());
            }
        });
        talker.subscribe(POSITION2D, 0);
        ticks(4);
        assertThat(pose(0)).isEqualTo(Pose.ORIGIN);
    }

    @Test
    void odometryThatIsTooFarAway_isRefused_namingTheRobot() {
        assertRefused(
                client.ask(POSITION2D, 1, new DeviceRequest.SetOdometry(1.7e308, 0, 0)),
                "odometry of robot 'two' was set to Pose[x=1.7E308");
        assertRefused(
                client.ask(POSITION2D, 1, new DeviceRequest.SetOdometry(Double.NaN, 0, 0)), "expected finite numbers");
    }

    @Test
    void pause_stopsTime_whileRequestsAreAnswered_andStepLetsOneTickPass() {
        client.subscribe(POSITION2D, 0);
        client.tell(SIMULATION, 0, new DeviceCommand.Pause());
        assertThat(simulation.isPaused()).isTrue();
        var answers = new ArrayList<DeviceReply>();
        simulation.whileWaiting(
                () -> { // on this thread, while the tick waits because time is paused
                    answers.add(client.ask(SIMULATION, 0, new DeviceRequest.GetPose("two")));
                    if (answers.size() == 3) {
                        assertThat(client.frames).as("nothing is published").isEmpty();
                        simulation.step();
                    }
                });
        ticks(1);
        assertThat(answers).hasSizeGreaterThanOrEqualTo(3).hasOnlyElementsOfType(DeviceReply.ModelPose.class);
        assertThat(simulation.latest().tick()).isEqualTo(1);
        assertThat(simulation.isPaused()).isTrue();
        client.tell(SIMULATION, 0, new DeviceCommand.Pause());
        assertThat(simulation.isPaused()).isFalse();
        ticks(1);
        assertThatThrownBy(simulation::step).hasMessage("only a paused simulation can be stepped");
    }

    @Test
    void teleport_acknowledgedBeforeTheClientLeft_stillCounts() {
        client.subscribe(POSITION2D, 0);
        client.ask(SIMULATION, 0, new DeviceRequest.SetPose("two", -3, 2, 1));
        client.line.close();
        ticks(1);
        assertThat(pose(1)).isEqualTo(new Pose(-3, 2, 1));
    }
}
