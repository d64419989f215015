package io.troupe.player;

import static io.troupe.player.wire.Interfaces.BLOBFINDER;
import static io.troupe.player.wire.Interfaces.LASER;
import static io.troupe.player.wire.Interfaces.POSITION2D;
import static io.troupe.player.wire.Interfaces.RANGER;
import static io.troupe.player.wire.Interfaces.SIMULATION;
import static io.troupe.player.wire.Interfaces.SONAR;
import static io.troupe.sim.TestWorlds.NOWHERE;
import static io.troupe.sim.TestWorlds.RED;
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
import io.troupe.sim.RobotReading;
import io.troupe.sim.Simulation;
import io.troupe.sim.TestWorlds;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeNoise;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.worldfile.ScenarioReader;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;
import org.junit.jupiter.params.provider.ValueSource;

/** Messages that the simulated devices send and understand. Robot one has a laser, a ranger and a second laser. */
@Timeout(60)
class SimulatedDevicesTest {
    static final int PORT = 6790;
    private static final double DEGREE = StrictMath.PI / 180;
    private static final DeviceReply ACK = new DeviceReply.Ack();
    private static final DeviceReply LASER_GEOMETRY =
            new DeviceReply.LaserGeometry(Pose3d.flat(0.1, 0, 0), new Size3d(0.12, 0.15, 0));

    private final Simulation simulation = Simulation.open(scenario(), WorldSettings.defaults());
    private final WireClient client = new WireClient(PORT, WireClient.ANSWER);

    private static RangeSensorSpec sensor(Pose mount, int fovDeg, int samples) {
        return new RangeSensorSpec(mount, 0.1, 8, fovDeg * DEGREE, samples, 0.03, 0.05, RangeNoise.NONE);
    }

    private static RangerSpec laser(Pose pose, RangeSensorSpec sensor) {
        return new RangerSpec(RangerSpec.Kind.LASER, pose, 0.15, 0.12, List.of(sensor));
    }

    static Scenario scenario() {
        var quarter = sensor(new Pose(0.1, 0, 0), 90, 3);
        var left = sensor(new Pose(0, 0.3, 90 * DEGREE), 15, 1);
        var behind = sensor(new Pose(0, 0, 180 * DEGREE), 0, 1);
        var front = laser(new Pose(0.1, 0, 0), quarter);
        var ring = new RangerSpec(
                RangerSpec.Kind.RANGER,
                new Pose(0, 0.1, 90 * DEGREE),
                0.4,
                0.3,
                List.of(left, sensor(Pose.ORIGIN, 15, 1)));
        var back = laser(new Pose(0, 0, 180 * DEGREE), behind);
        var world = TestWorlds.world(
                List.of(
                        TestWorlds.robot("one", 0, 0, 0).withRangers(List.of(front, ring, back)),
                        TestWorlds.robot("two", -2, 0, 0)),
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

    private RobotReading robot(int index) {
        return simulation.latest().robots().get(index);
    }

    private Pose pose(int robot) {
        return robot(robot).pose();
    }

    private void ticks(int count) {
        for (int i = 0; i < count; i++) {
            simulation.tick();
        }
    }

    // ---- requests

    /** @param expected the reply, or what the reason of a refusal contains */
    private record Asked(Interfaces type, int index, DeviceRequest request, Object expected) {}

    private static Asked asked(Interfaces type, DeviceRequest request, Object expected) {
        return new Asked(type, 0, request, expected);
    }

    private static Asked laserSet(LaserConfiguration configuration, Object expected) {
        return asked(LASER, new DeviceRequest.SetLaserConfiguration(configuration), expected);
    }

    private static Asked set(String robot, double x, double y, String reason) {
        return asked(SIMULATION, new DeviceRequest.SetPose(robot, x, y, 0), reason);
    }

    private static Asked capability(Interfaces type, int messageType, int subtype, boolean offered) {
        return asked(type, new DeviceRequest.Capability(messageType, subtype), offered ? ACK : "");
    }

    static List<Asked> requests() {
        float eighth = (float) (45 * DEGREE);
        var laser = new LaserConfiguration(-eighth, eighth, eighth, 8, 1, false, 10);
        var ofLaser = new DeviceReply.OfLaser(laser);
        var ranger = new RangerConfiguration(-7.5 * DEGREE, 7.5 * DEGREE, 15 * DEGREE, 0.1, 8, 0, 10);
        return List.of(
                asked(LASER, new DeviceRequest.Geometry(), LASER_GEOMETRY),
                asked(LASER, new DeviceRequest.GetConfiguration(), ofLaser),
                new Asked(LASER, 1, new DeviceRequest.LaserId(), new DeviceReply.LaserId(1)),
                laserSet(laser, ofLaser),
                // what it is already, in round numbers, without a frequency
                laserSet(new LaserConfiguration(-0.785f, 0.785f, 0.785f, 8, 0.01f, false, 0), ofLaser),
                // libplayerc sends no value as the largest range, but what is in its memory
                laserSet(new LaserConfiguration(-eighth, eighth, eighth, Float.NaN, 1, false, 10), ofLaser),
                laserSet(new LaserConfiguration(-0.785f, 0.785f, 0.775f, 8, 1, false, 0), "world file"),
                laserSet(new LaserConfiguration(-0.785f, 0.785f, Float.NaN, 8, 1, false, 0), "world file"),
                laserSet(
                        new LaserConfiguration(-0.785f, 0.785f, 0.785f, 8, 1, true, 0),
                        new DeviceReply.OfLaser(laser.withIntensities(true))),
                laserSet(new LaserConfiguration(-0.785f, 0.785f, 0.785f, 8, 1, false, 20), "world file"),
                laserSet(new LaserConfiguration(0, 1, 0.1f, 8, 0, false, 10), "world file"),
                asked(RANGER, new DeviceRequest.GetConfiguration(), new DeviceReply.OfRanger(ranger)),
                asked(RANGER, new DeviceRequest.Intensities(true), ACK),
                asked(RANGER, new DeviceRequest.Intensities(false), ACK),
                // as Stage does
                asked(POSITION2D, new DeviceRequest.VelocityMode(0), ""),
                asked(POSITION2D, new DeviceRequest.SpeedPid(1, 2, 3), ""),
                asked(POSITION2D, new DeviceRequest.PositionPid(1, 2, 3), ""),
                asked(POSITION2D, new DeviceRequest.SpeedProfile(1, 2), ""),
                asked(POSITION2D, new DeviceRequest.PositionMode(7), ""),
                asked(POSITION2D, new DeviceRequest.PositionMode(1), ACK),
                asked(POSITION2D, new DeviceRequest.GetColour(), ""),
                asked(POSITION2D, new DeviceRequest.Unknown(99), ""),
                asked(BLOBFINDER, new DeviceRequest.SetColour(0, 1, 2, 3, 4, 5, 6), "not offer"),
                asked(BLOBFINDER, new DeviceRequest.SetImager(0, 1, 2, 3), "not offer"),
                capability(POSITION2D, 2, 2, true),
                capability(POSITION2D, 3, 7, false),
                capability(SONAR, 2, 1, false),
                capability(SONAR, 1, 1, true),
                capability(LASER, 3, 3, true),
                capability(SIMULATION, 2, 3, false),
                capability(BLOBFINDER, 3, 255, true),
                capability(BLOBFINDER, 9, 1, false),
                asked(SIMULATION, new DeviceRequest.Geometry(), "not offer"),
                asked(SIMULATION, new DeviceRequest.GetPose("two"), new DeviceReply.ModelPose("two", -2, 0, 0)),
                asked(SIMULATION, new DeviceRequest.GetPose("east"), new DeviceReply.ModelPose("east", 3, 0, 0)),
                asked(SIMULATION, new DeviceRequest.GetPose("three"), "world 'test' has no model"),
                set("one", 2.8, 0, "it would overlap obstacle 'east'"),
                set("one", -2, 0.1, "it would overlap robot 'two'"),
                set("three", 0, 0, "no model 'three'"),
                set("east", 0, 0, "it would overlap robot 'one'"),
                new Asked(
                        POSITION2D,
                        1,
                        new DeviceRequest.SetOdometry(1.7e308, 0, 0),
                        "odometry of robot 'two' was set to Pose[x=1.7E308"),
                new Asked(POSITION2D, 1, new DeviceRequest.SetOdometry(Double.NaN, 0, 0), "expected finite numbers"));
    }

    @ParameterizedTest
    @MethodSource("requests")
    void request_isAnswered_orRefusedSayingWhy(Asked asked) {
        var reply = client.ask(asked.type, asked.index, asked.request);
        if (asked.expected instanceof String reason) {
            assertThat(reply)
                    .isInstanceOfSatisfying(
                            DeviceReply.Nack.class,
                            nack -> assertThat(nack.reason()).contains(reason));
        } else {
            assertThat(reply).isEqualTo(asked.expected);
        }
    }

    // ---- sonars, lasers and rangers

    /** One sonar ring that is served as sonar:0 and as ranger:0, in both dialects: real programs use both. */
    @ParameterizedTest
    @ValueSource(strings = {"ranger ( scount 2 spose[0] [ 0 0 0 ] spose[1] [ 0.05 0 90 ] sview [ 0 5 15 ] )", """
                ranger ( pose [ 0 0 0 0 ]
                  sensor ( pose [ 0 0 0 0 ] range [ 0 5 ] fov 15 samples 1 )
                  sensor ( pose [ 0.05 0 0 90 ] range [ 0 5 ] fov 15 samples 1 ) )"""})
    void sonarAndRanger_ofOneRobot_areOfferedTogether_andSeeTheSame(String ring, @TempDir Path dir) throws IOException {
        Files.writeString(dir.resolve("w.world"), """
                model ( name "wall" pose [ 3 0 0 0 ] size [ 2 2 1 ] )
                position ( name "r" size [ 0.4 0.3 0.2 ] %s )
                """.formatted(ring));
        Path config = Files.writeString(dir.resolve("w.cfg"), """
                driver ( name "stage" provides [ "simulation:0" ] worldfile "w.world" )
                driver ( name "stage" provides [ "6791:sonar:0" "6791:ranger:0" ] model "r" )
                """);
        try (var world = Simulation.open(ScenarioReader.readConfig(config), WorldSettings.defaults())) {
            var both =
                    new WireClient(6791, WireClient.ANSWER).subscribe(SONAR, 0).subscribe(RANGER, 0);
            world.tick();
            world.tick();
            assertThat(both.newest(SONAR, 0)).isEqualTo(new DeviceData.SonarRanges(List.of(2f, 5f)));
            assertThat(both.newest(RANGER, 0)).isEqualTo(new DeviceData.RangerRanges(List.of(2.0, 5.0)));
            var mounts = List.of(
                    new DeviceReply.SonarMount(0, 0, 0), new DeviceReply.SonarMount(0.05, 0, StrictMath.PI / 2));
            assertThat(both.ask(SONAR, 0, new DeviceRequest.Geometry()))
                    .isEqualTo(new DeviceReply.SonarGeometry(mounts));
            var ranger = (DeviceReply.RangerGeometry) both.ask(RANGER, 0, new DeviceRequest.Geometry());
            assertThat(ranger.elementPoses())
                    .extracting(each -> new DeviceReply.SonarMount(each.x(), each.y(), each.yaw()))
                    .isEqualTo(mounts);
            assertThat(both.ask(RANGER, 0, new DeviceRequest.GetConfiguration()))
                    .extracting("configuration.minRangeM", "configuration.maxRangeM")
                    .containsExactly(0.0, 5.0);
        }
    }

    @Test
    void laser_publishesItsScan_fromRightToLeft() {
        client.subscribe(LASER, 0);
        ticks(2);
        double straight = 2.9 - 0.1;
        float slanted = (float) (straight / StrictMath.cos(45 * DEGREE));
        float eighth = (float) (45 * DEGREE);
        var ranges = List.of(slanted, (float) straight, slanted);
        assertThat(client.newest(LASER, 0))
                .isEqualTo(new DeviceData.LaserScan(
                        -eighth, eighth, eighth, 8, ranges, List.of((byte) 0, (byte) 0, (byte) 0), 1));
    }

    @Test
    void severalRangers_ofOneRobot_areToldApart() {
        client.subscribe(LASER, 1).subscribe(RANGER, 0);
        ticks(1);
        assertThat(((DeviceData.LaserScan) client.newest(LASER, 1)).rangesM())
                .as("looks back at the front of robot two")
                .containsExactly((float) (2 - 0.2));
        assertThat(client.newest(RANGER, 0)).isEqualTo(new DeviceData.RangerRanges(List.of(8.0, 2.9)));
    }

    @Test
    void geometry_ofARanger_hasItsSensorsInItsOwnFrame() {
        var geometry = (DeviceReply.RangerGeometry) client.ask(RANGER, 0, new DeviceRequest.Geometry());
        assertThat(geometry.pose()).isEqualTo(Pose3d.flat(0, 0.1, 90 * DEGREE));
        assertThat(geometry.size()).isEqualTo(new Size3d(0.3, 0.4, 0));
        assertThat(geometry.elementSizes()).containsOnly(new Size3d(0.05, 0.03, 0));
        assertPose(geometry.elementPoses().get(0), 0.2, 0, 0);
        assertPose(geometry.elementPoses().get(1), -0.1, 0, -90 * DEGREE);
    }

    private static void assertPose(Pose3d actual, double x, double y, double yaw) {
        assertThat(actual.x()).isCloseTo(x, within(1e-12));
        assertThat(actual.y()).isCloseTo(y, within(1e-12));
        assertThat(actual.yaw()).isCloseTo(yaw, within(1e-12));
    }

    @Test
    void binding_toARangerThatIsNotThere_isRefused() {
        Scenario good = scenario();
        for (var bad : List.of(
                new DeviceBinding(PORT + 1, "laser", 0, "one", 1, NOWHERE),
                new DeviceBinding(PORT + 1, "laser", 0, "two", 0, NOWHERE))) {
            assertThatThrownBy(
                            () -> Simulation.open(new Scenario(good.world(), List.of(bad)), WorldSettings.defaults()))
                    .isInstanceOf(IllegalArgumentException.class)
                    .hasMessageContaining("laser:0 is ranging device " + bad.ranger() + " of '" + bad.model() + "'");
        }
    }

    // ---- position2d

    @Test
    void car_isSpeedAndTurnRate_andSidewaysIsIgnored() {
        client.subscribe(POSITION2D, 0).tell(POSITION2D, 0, new DeviceCommand.Car(0.2, 0.5));
        ticks(2);
        assertThat(robot(0).odometry().forwardMps()).isEqualTo(0.2);
        assertThat(robot(0).odometry().turnRadps()).isEqualTo(0.5);
        client.tell(POSITION2D, 0, new DeviceCommand.Velocity(0, 0.7, 0, true));
        ticks(1);
        Pose before = pose(0);
        ticks(2);
        assertThat(pose(0)).isEqualTo(before);
    }

    /** State zero drives too, as in Stage. */
    @ParameterizedTest
    @ValueSource(booleans = {true, false})
    void goTo_velocityHeadingAndVelocity_areUnderstood_whateverTheState(boolean enabled) {
        client.subscribe(POSITION2D, 0).tell(POSITION2D, 0, new DeviceCommand.GoTo(0.5, 0, 1, 0, 0, 0, enabled));
        ticks(120);
        assertThat(pose(0).x()).isCloseTo(0.5, within(0.02));
        assertThat(pose(0).headingRad()).isCloseTo(1, within(0.01));
        client.tell(POSITION2D, 0, new DeviceCommand.VelocityHeading(0.1, -1));
        ticks(60);
        assertThat(pose(0).headingRad()).isCloseTo(-1, within(0.02));
        client.tell(POSITION2D, 0, new DeviceCommand.Velocity(0.2, 0, 0, enabled));
        ticks(2);
        assertThat(robot(0).odometry().forwardMps()).isEqualTo(0.2);
    }

    @Test
    void motorPower_off_holdsTheRobot() {
        client.subscribe(POSITION2D, 0);
        assertThat(client.ask(POSITION2D, 0, new DeviceRequest.Power(false))).isEqualTo(ACK);
        client.drive(0, 0.5);
        ticks(3);
        assertThat(pose(0)).isEqualTo(Pose.ORIGIN);
        client.ask(POSITION2D, 0, new DeviceRequest.Power(true));
        client.drive(0, 0.5);
        ticks(2);
        // the client has already answered: the command counts one tick later
        assertThat(pose(0).x()).isCloseTo(0.1, within(1e-9));
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
        assertThat(client.ask(SONAR, 0, new DeviceRequest.Power(true))).isEqualTo(ACK);
        ticks(3);
        assertThat(client.frames).as("a frame for each tick").hasSize(3);
    }

    // ---- simulation

    @Test
    void reset_putsEverythingBack_andTimeGoesOn() {
        client.subscribe(POSITION2D, 0).tell(POSITION2D, 0, new DeviceCommand.Velocity(0.5, 0, 0.2, true));
        client.ask(POSITION2D, 0, new DeviceRequest.SetOdometry(5, 5, 0));
        ticks(5);
        assertThat(pose(0).x()).isPositive();
        client.tell(SIMULATION, 0, new DeviceCommand.Reset());
        ticks(2);
        assertThat(pose(0)).isEqualTo(Pose.ORIGIN);
        assertThat(robot(0).odometry().pose()).isEqualTo(Pose.ORIGIN);
        assertThat(simulation.latest().tick()).isEqualTo(7);
    }

    private static void resetSpeedReset(WireClient client) {
        client.tell(SIMULATION, 0, new DeviceCommand.Reset());
        client.drive(0, 0.5);
        client.tell(SIMULATION, 0, new DeviceCommand.Reset());
    }

    @Test
    void resetSpeedReset_inOneTickOrAfterTheAnswer_leavesTheRobotStanding() {
        client.subscribe(POSITION2D, 0);
        resetSpeedReset(client);
        ticks(3);
        assertThat(pose(0)).isEqualTo(Pose.ORIGIN);
        client.tell(SIMULATION, 0, new DeviceCommand.Reset());
        client.drive(0, 0.5);
        ticks(2);
        assertThat(pose(0).x()).as("a speed after the last reset").isCloseTo(0.1, within(1e-9));

        resetSpeedReset(client);
        new WireClient(PORT, (self, frame) -> {
                    self.answer(frame);
                    if (self.frames.size() == 1) {
                        resetSpeedReset(self);
                    }
                })
                .subscribe(POSITION2D, 0);
        ticks(4);
        assertThat(pose(0)).isEqualTo(Pose.ORIGIN);
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
    void poses_canBeSet_andCount_whenTheClientHasLeftAfterTheAcknowledgement() {
        client.subscribe(POSITION2D, 0);
        for (boolean leaves : new boolean[] {false, true}) {
            double x = leaves ? -3 : -2.5;
            assertThat(client.ask(SIMULATION, 0, new DeviceRequest.SetPose("two", x, 2, 1)))
                    .isEqualTo(ACK);
            assertThat(client.ask(SIMULATION, 0, new DeviceRequest.SetPose("one", -1, -2, 0)))
                    .isEqualTo(ACK);
            if (leaves) {
                client.line.close();
            }
            ticks(1);
            assertThat(pose(1)).isEqualTo(new Pose(x, 2, 1));
            assertThat(pose(0)).isEqualTo(new Pose(-1, -2, 0));
        }
    }

    @Test
    void rangerAsLaser_andLaserAsRanger_areReadByBothInterfaces(@TempDir Path dir) throws IOException {
        Files.writeString(dir.resolve("w.world"), """
                model ( pose [ 3 0 0 0 ] size [ 0.2 9 1 ] )
                position ( name "r0" size [ 0.4 0.4 0.2 ]
                  ranger ( pose [ 0.1 0 0 0 ] sensor ( range [ 0 8 ] fov 180 samples 181 ) ) )
                position ( name "r1" size [ 0.4 0.4 0.2 ] pose [ -3 0 0 0 ]
                  ranger ( sensor ( range [ 0 8 ] samples 1 ) sensor ( range [ 0 8 ] samples 1 pose [ 0 0 0 90 ] ) ) )
                """);
        Path config = dir.resolve("t.cfg");
        Files.writeString(config, """
                driver ( name "stage" provides [ "6791:simulation:0" ] worldfile "w.world" )
                driver ( name "stage" provides [ "6791:position2d:0" "6791:ranger:0" ] model "r0" )
                driver ( name "stage" provides [ "6791:sonar:0" ] model "r1" )
                driver ( name "rangertolaser" provides [ "6791:laser:0" ] requires [ "6791:ranger:0" ] )
                driver ( name "sonartoranger" provides [ "6791:ranger:1" ] requires [ "6791:sonar:0" ] )
                driver ( name "lasertoranger" provides [ "6791:ranger:2" ] requires [ "6791:laser:0" ] )
                """);
        try (var world = Simulation.open(ScenarioReader.readConfig(config), WorldSettings.defaults())) {
            var both = new WireClient(6791, WireClient.ANSWER);
            both.subscribe(LASER, 0);
            for (int ranger = 0; ranger < 3; ranger++) {
                both.subscribe(RANGER, ranger);
            }
            world.tick();
            var scan = (DeviceData.LaserScan) both.newest(LASER, 0);
            assertThat(scan.rangesM()).hasSize(181);
            assertThat(scan.rangesM().get(90)).isCloseTo(2.8f, within(1e-6f));
            assertThat(scan.maxAngleRad()).isCloseTo((float) (90 * DEGREE), within(1e-6f));
            List<Double> ranges = ((DeviceData.RangerRanges) both.newest(RANGER, 0)).rangesM();
            assertThat(ranges).hasSize(181).isEqualTo(((DeviceData.RangerRanges) both.newest(RANGER, 2)).rangesM());
            assertThat(((DeviceData.RangerRanges) both.newest(RANGER, 1)).rangesM())
                    .hasSize(2);
            assertThat(both.ask(LASER, 0, new DeviceRequest.Geometry())).isInstanceOf(DeviceReply.LaserGeometry.class);
            assertThat(both.ask(RANGER, 2, new DeviceRequest.Geometry()))
                    .isInstanceOf(DeviceReply.RangerGeometry.class);
            assertThat(both.ask(LASER, 0, new DeviceRequest.GetConfiguration()))
                    .isInstanceOf(DeviceReply.OfLaser.class);
        }
    }
}
