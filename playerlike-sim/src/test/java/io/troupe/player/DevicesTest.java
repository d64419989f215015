package io.troupe.player;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.PlayerDevAddr;
import io.troupe.player.structures.PlayerMsgHdr;
import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;
import io.troupe.player.structures.blobfinder.PlayerBlobfinderColorConfig;
import io.troupe.player.structures.blobfinder.PlayerBlobfinderImagerConfig;
import io.troupe.player.structures.position2d.PlayerPosition2dCmdPos;
import io.troupe.player.structures.position2d.PlayerPosition2dCmdVel;
import io.troupe.player.structures.ranger.PlayerRangerConf;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceCommand.Car;
import io.troupe.player.wire.DeviceCommand.GoTo;
import io.troupe.player.wire.DeviceCommand.Velocity;
import io.troupe.player.wire.DeviceCommand.VelocityHeading;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.LaserConfiguration;
import io.troupe.player.wire.Pose3d;
import io.troupe.player.wire.RangerConfiguration;
import io.troupe.player.wire.ReplaceRule;
import io.troupe.player.wire.ScriptedServer;
import io.troupe.player.wire.Size3d;
import java.io.IOException;
import java.text.MessageFormat;
import java.time.Duration;
import java.util.AbstractList;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Locale;
import java.util.logging.Logger;
import org.assertj.core.api.ThrowableAssert.ThrowingCallable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.parallel.Isolated;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** What devices send to the server, what the server reports about them, and the message handling that all share. */
@Isolated("reads the log")
class DevicesTest implements PlayerConstants {
    private final ScriptedServer server = new ScriptedServer();
    private final PlayerPorts.Registration port = PlayerPorts.open(ScriptedServer.PORT, server);
    private final PlayerClient client = new PlayerClient("127.0.0.1", ScriptedServer.PORT);
    private final Position2DInterface pos = client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);

    @AfterEach
    void close() {
        client.close();
        port.close();
    }

    private void read(long tick) {
        server.publish(tick);
        client.readAll();
    }

    private static void refused(String what, ThrowingCallable call) {
        assertThatThrownBy(call).isInstanceOf(PlayerException.class).hasMessageContaining(what);
    }

    // ---- commands and requests

    @Test
    void commands_ofBothGenerations_comeToTheSame_andOthersAreSentAsTheyAre() {
        pos.setSpeed(0.4, -0.2);
        pos.setVelocity(new PlayerPose(0.4, 0, -0.2), 1);
        pos.setVelocity(new PlayerPose2d(0.4, 0, -0.2), 1);
        var speed = new PlayerPosition2dCmdVel();
        speed.setVel(new PlayerPose2d(0.4, 0, -0.2));
        speed.setState((byte) 1);
        pos.setVelocity(speed);
        PlayerPose old = speed.getVel();
        pos.setVelocity(old, 1);
        assertThat(server.commands).hasSize(5).containsOnly(new Velocity(0.4, 0, -0.2, true));
        pos.setVelocity(old, 0);
        assertThat(server.commands.getLast()).isEqualTo(new Velocity(0.4, 0, -0.2, false));
        server.commands.clear();

        pos.setPosition(new PlayerPose(1, 2, 0.5), new PlayerPose2d(0.3, 0, 0.1), 1);
        pos.setPosition(new PlayerPose2d(1, 2, 0.5), new PlayerPose(0.3, 0, 0.1), 1);
        var goal = new PlayerPosition2dCmdPos();
        goal.setPos(new PlayerPose2d(1, 2, 0.5));
        goal.setVel(new PlayerPose(0.3, 0, 0.1));
        goal.setState((byte) 1);
        pos.setPosition(goal);
        assertThat(server.commands).hasSize(3).containsOnly(new GoTo(1, 2, 0.5, 0.3, 0, 0.1, true));
        pos.setCarCMD(0.4, -0.2);
        pos.setVelHead(0.3, 3);
        assertThat(server.commands.subList(3, 5)).containsExactly(new Car(0.4, -0.2), new VelocityHeading(0.3, 3));
    }

    @ParameterizedTest
    @ValueSource(doubles = {Double.NaN, Double.POSITIVE_INFINITY})
    void speed_isNotFinite_isRefusedByItsValue(double speed) {
        assertThatThrownBy(() -> pos.setSpeed(speed, 0))
                .isInstanceOf(PlayerException.class)
                .hasMessageContainingAll("position2d:0", "" + speed);
        assertThat(server.commands).isEmpty();
    }

    @Test
    void settings_areSentAsTheyAre_andRefusalsDoNotEndTheProgram() {
        var blf = client.requestInterfaceBlobfinder(0, PLAYER_OPEN_MODE);
        pos.setVelocityControl(1);
        pos.setControlMode(1);
        pos.setVelocityPIDParams(1, 2, 3);
        pos.setPositionPIDParams(4, 5, 6);
        pos.setSpeedProfileParams(7, 8);
        pos.setMotorPower(0);
        pos.resetOdometry();
        pos.setOdometry(new PlayerPose(1, 2, 3));
        var colours = new PlayerBlobfinderColorConfig();
        colours.setChannel(1);
        colours.setRmin(2);
        colours.setRmax(3);
        colours.setGmin(4);
        colours.setGmax(5);
        colours.setBmin(6);
        colours.setBmax(7);
        blf.setTrackingColor(colours);
        var imager = new PlayerBlobfinderImagerConfig();
        imager.setBrightness(-1);
        imager.setContrast(1);
        imager.setColormode(2);
        imager.setAutogain(3);
        blf.setImagerParams(imager);
        assertThat(server.requests)
                .containsExactly(
                        new DeviceRequest.VelocityMode(1),
                        new DeviceRequest.PositionMode(1),
                        new DeviceRequest.SpeedPid(1, 2, 3),
                        new DeviceRequest.PositionPid(4, 5, 6),
                        new DeviceRequest.SpeedProfile(7, 8),
                        new DeviceRequest.Power(false),
                        new DeviceRequest.ResetOdometry(),
                        new DeviceRequest.SetOdometry(1, 2, 3),
                        new DeviceRequest.SetColour(1, 2, 3, 4, 5, 6, 7),
                        new DeviceRequest.SetImager(-1, 1, 2, 3));
    }

    @Test
    void request_theServerRefuses_leavesAWarning() {
        var warnings = new ArrayList<String>();
        var logger = Logger.getLogger(PlayerDevice.class.getName());
        logger.setFilter(entry -> warnings.add(MessageFormat.format(entry.getMessage(), entry.getParameters())));
        try {
            pos.queryGeometry();
        } finally {
            logger.setFilter(null);
        }
        assertThat(warnings).containsExactly("position2d:0 refused Geometry[]: not in the script");
        assertThat(pos.isGeomReady()).isFalse();
        assertThat(pos.getGeom()).isNull();
    }

    @Test
    void reply_comesLater_isSeenByWhoWaitsForIt_orByReadAll() {
        server.replier = request -> new DeviceReply.Position2dGeometry(-0.04, 0, 0, 0.44, 0.33);
        server.repliesLater = true;
        pos.queryGeometry();
        assertThat(pos.isGeomReady()).isFalse();
        Thread.ofPlatform().daemon().start(server.replies.remove());
        assertThat(client.readAll()).as("without any data").isEqualTo(PLAYER_MSGTYPE_RESP_ACK);
        assertThat(List.of(pos.isGeomReady(), pos.isGeomReady())).containsExactly(true, false);
        assertThat(pos.getGeom().getSize().getSl()).isEqualTo(0.44);
        assertThat(pos.getGeom().getPose().getPx()).isEqualTo(-0.04);
        server.replier = request -> new DeviceReply.Nack("no");
        pos.setMotorPower(0);
        server.replies.remove().run();
        server.publish(0);
        assertThat(client.readAll()).as("data first").isEqualTo(PLAYER_MSGTYPE_DATA);
    }

    @Test
    void simulation_tellsPoses_andTakesCommands() {
        var sim = client.requestInterfaceSimulation(0, PLAYER_OPEN_MODE);
        server.replier = request -> request instanceof DeviceRequest.GetPose(String model)
                ? new DeviceReply.ModelPose(model, 1, 2, 0.5)
                : new DeviceReply.Ack();
        assertThat(sim.getPose2D()).isNull();
        sim.get2DPose("robot1");
        assertThat(sim.isPose2DReady()).isTrue();
        assertThat(sim.getPose2D().getName()).isEqualTo("robot1");
        assertThat(sim.getSimulationPose2D()).isSameAs(sim.getPose2D());
        PlayerPose where = sim.getPose2D().getPose();
        assertThat(where.getPa()).isEqualTo(0.5);
        sim.set2DPose("robot1", new PlayerPose2d(3, 4, 0));
        sim.set2DPose("robot1", new PlayerPose(3, 4, 0));
        assertThat(sim.isPose2DReady()).isFalse();
        assertThat(server.requests.subList(1, 3)).containsOnly(new DeviceRequest.SetPose("robot1", 3, 4, 0));
        refused("robot1", () -> sim.set2DPose("robot1", new PlayerPose(Double.NaN, 4, 0)));
        sim.pause();
        sim.reset();
        sim.save();
        assertThat(server.commands)
                .containsExactly(new DeviceCommand.Pause(), new DeviceCommand.Reset(), new DeviceCommand.Save());
    }

    // ---- connections and the device list

    @Test
    void unofferedInterfaces_nameTheDevice_whatIsOffered_andWhatIsThere() throws Exception {
        var methods = Arrays.stream(PlayerClient.class.getMethods())
                .filter(method -> method.getName().startsWith("requestInterface")
                        && method.getParameterCount() == 2
                        && (UnsupportedDevice.class.isAssignableFrom(method.getReturnType())
                                || method.getReturnType() == Position3DInterface.class))
                .toList();
        assertThat(methods).hasSize(34);
        for (var method : methods) {
            String name =
                    method.getName().substring("requestInterface".length()).toLowerCase(Locale.ROOT);
            assertThatThrownBy(() -> method.invoke(client, 3, PLAYER_OPEN_MODE))
                    .cause()
                    .isInstanceOf(PlayerException.class)
                    .hasMessageStartingWith("[PlayerClient] Requested device "
                            + (name.equals("speechrecognition") ? "speech_recognition" : name) + ":3 is not offered")
                    .hasMessageContaining(
                            "which has position2d, sonar, ranger, laser, blobfinder, simulation, fiducial, bumper, camera, gripper")
                    .hasMessageContaining("The server has: position2d:0, sonar:0");
        }
        refused("interface12:3 is not offered", () -> client.requestInterface(PLAYER_SPEECH_CODE, 3, PLAYER_OPEN_MODE));
        assertThat(client.isReadyRequestDevice()).as("the position2d").isTrue();
        assertThat(client.isReadyRequestDevice()).isFalse();
    }

    @Test
    void connectionSettings_reachTheServer_orAreRefusedByTheirValue() {
        client.requestAddReplaceRule(-1, -1, PLAYER_MSGTYPE_DATA, -1, 1);
        assertThat(server.rules).containsExactly(new ReplaceRule(-1, -1, 1, -1, ReplaceRule.REPLACE));
        refused("replace is 3", () -> client.requestAddReplaceRule(-1, -1, 1, -1, 3));
        assertThat(client.getReadTimeout()).isEqualTo(10_000);
        client.setReadTimeout(500);
        assertThat(server.replyLimit).isEqualTo(Duration.ofMillis(500));
        assertThat(client.getReadTimeout()).isEqualTo(500);
        refused("read timeout is 0 ms", () -> client.setReadTimeout(0));
        refused("access mode of sonar:0 is 9", () -> client.requestInterfaceSonar(0, 9));
        refused("data delivery mode is 3", () -> client.requestDataDeliveryMode(3));
        client.requestAuthentication(new byte[] {1});
        client.requestNameService("robot".toCharArray());
        client.requestIdent();
        assertThat(client.isAuthenticated()).isFalse();
        assertThat(client.isReadyPortNumber()).isFalse();
        assertThat(client.getPortNumber()).isEqualTo(ScriptedServer.PORT);
        assertThat(client.getLogger().getName()).isEqualTo(PlayerClient.class.getName());
    }

    @Test
    void deviceList_isThereFromTheBeginning_andToldWithTheDriverOnRequest() {
        for (int list = 1; list <= 2; list++) {
            assertThat(client.getPDDList().getDeviceCount()).isEqualTo(10);
            assertThat(client.getPDDList().getDevList())
                    .extracting(PlayerDevAddr::getInterf)
                    .containsExactly(
                            PLAYER_POSITION2D_CODE,
                            PLAYER_SONAR_CODE,
                            PLAYER_RANGER_CODE,
                            PLAYER_LASER_CODE,
                            PLAYER_BLOBFINDER_CODE,
                            PLAYER_SIMULATION_CODE,
                            PLAYER_FIDUCIAL_CODE,
                            PLAYER_BUMPER_CODE,
                            PLAYER_CAMERA_CODE,
                            PLAYER_GRIPPER_CODE);
            assertThat(List.of(client.isReadyPDDList(), client.isReadyPDDList()))
                    .as("once for each list")
                    .containsExactly(true, false);
            client.requestDeviceList();
        }
        client.requestDriverInfo(client.getPDDList().getDevList()[1]);
        assertThat(client.isReadyPDDI()).isTrue();
        assertThat(client.getPDDI().getDriverName()).isEqualTo("stage");
        assertThat(pos.getDeviceDriverName()).isEqualTo("stage");
        assertThat(pos.getDeviceAddress().getRobot()).isEqualTo(ScriptedServer.PORT);
    }

    /** A thousand clients of a world with three thousand devices must not keep three million addresses. */
    @Test
    void deviceList_isConvertedWhenItIsFirstRead_andOnce() {
        var addresses = new AbstractList<DeviceAddress>() {
            private int reads;

            @Override
            public DeviceAddress get(int index) {
                reads++;
                return new DeviceAddress(0, ScriptedServer.PORT, PLAYER_SONAR_CODE, index);
            }

            @Override
            public int size() {
                return 3_000;
            }
        };
        var devices = new PlayerClient.Devices(addresses);
        assertThat(addresses.reads).isZero();
        var list = devices.list();
        assertThat(list.getDeviceCount()).isEqualTo(3_000);
        assertThat(list.getDevList()).hasSize(3_000);
        int reads = addresses.reads;
        assertThat(devices.list()).isSameAs(list);
        assertThat(addresses.reads).isEqualTo(reads);
    }

    // ---- data

    @Test
    void sameDevice_requestedTwice_bothGetTheData_untilItIsClosed() {
        var again = (Position2DInterface) client.requestInterface(PLAYER_POSITION2D_CODE, 0, PLAYER_OPEN_MODE);
        assertThat(pos.getData()).isNull();
        assertThatThrownBy(pos::getX).isInstanceOf(NullPointerException.class).hasMessageContaining("isDataReady()");
        read(0);
        assertThat(List.of(pos.isDataReady(), again.isDataReady())).containsExactly(true, true);
        assertThat(pos.getData()).isNotSameAs(again.getData());
        PlayerPose pose = pos.getData().getPos();
        PlayerPose2d sameAgain = pos.getData().getPos();
        assertThat(pose).isSameAs(sameAgain);
        var ended = client.requestInterfacePosition2D(0, PLAYER_CLOSE_MODE);
        assertThat(ended.getDeviceAccess()).isEqualTo((byte) PLAYER_CLOSE_MODE);
        var son = client.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
        read(1);
        assertThat(son.isDataReady()).isTrue();
        assertThat(pos.getX()).isZero();
    }

    @Test
    void messages_haveDataOfTheirOwn_aNewArrayForEach() {
        var son = client.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
        var ranger = (RangerInterface) client.requestInterface(PLAYER_RANGER_CODE, 0, PLAYER_OPEN_MODE);
        assertThat(ranger.getData()).isNull();
        client.requestDataDeliveryMode(PLAYER_DATAMODE_PULL);
        server.publish(3);
        assertThat(client.readAll()).isEqualTo(PLAYER_MSGTYPE_SYNCH);
        assertThat(List.of(ranger.isDataReady(), ranger.isDataReady())).containsExactly(true, false);
        var first = son.getData();
        first.getRanges()[0] = -1;
        double[] ranges = ranger.getData().getRanges();
        assertThat(ranges).containsExactly(3, 2);
        assertThat(ranger.getData().getRanges_count()).isEqualTo(2);
        ranges[0] = -1;
        read(4);
        assertThat(son.getData()).isNotSameAs(first);
        assertThat(son.getData().getRanges()).containsExactly(4f);
        assertThat(first.getRanges()).containsExactly(-1f);
        assertThat(ranger.getData().getRanges()).containsExactly(4, 2);
        assertThat(ranges).containsExactly(-1, 2);
        assertThat(ranger.isDataIntnsReady()).isFalse();
        assertThat(ranger.getDataIntns()).isNull();
    }

    @Test
    void messages_areReadByTheClientOnly_andStreamsAreNotForWriting() {
        var seen = new ArrayList<String>();
        class Listener extends SonarInterface {
            Listener() {
                super(client);
            }

            @Override
            public void readData(PlayerMsgHdr header) {
                super.readData(header);
                seen.add(header.getAddr().getInterf() + "/" + header.getType() + "/" + header.getSubtype() + " "
                        + header.getTimestamp() + " " + getData().getRanges_count());
            }

            void write() throws IOException {
                os.write(1);
            }
        }
        var listener = new Listener();
        client.requestInterfacePosition2D(0, PLAYER_CLOSE_MODE);
        var son = client.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
        listener.setDeviceAddress(son.getDeviceAddress());
        client.subscriptions.add(listener);
        read(2);
        assertThat(seen).containsExactly("5/1/1 0.2 1");
        refused("no message for sonar:0", () -> son.readData(new PlayerMsgHdr()));
        assertThatThrownBy(son::handleNARMessage).isInstanceOf(PlayerException.class);
        assertThatThrownBy(listener::write).isInstanceOf(IOException.class);
    }

    // ---- rangers and lasers

    @Test
    void ranger_tellsGeometryAndConfiguration_andSwitches() {
        var ranger = client.requestInterfaceRanger(0, PLAYER_OPEN_MODE);
        assertThat(new PlayerRangerConf().getMax_range()).isNaN();
        var poses = List.of(Pose3d.flat(7, 8, 9), Pose3d.flat(10, 11, 12));
        var sizes = List.of(new Size3d(0.4, 0.5, 0.6));
        var body = new Size3d(0.1, 0.2, 0.3);
        server.replier = request -> new DeviceReply.Ack();
        server.reply(
                new DeviceRequest.Geometry(),
                new DeviceReply.RangerGeometry(new Pose3d(1, 2, 3, 4, 5, 6), body, poses, sizes));
        server.reply(
                new DeviceRequest.GetConfiguration(),
                new DeviceReply.OfRanger(new RangerConfiguration(-1, 1, 0.5, 0.1, 8, 0.01, 10)));
        ranger.queryGeometry();
        assertThat(ranger.isGeomReady()).isTrue();
        var geometry = ranger.getGeom();
        assertThat(geometry.getPose())
                .extracting("px", "py", "pz", "proll", "ppitch", "pyaw")
                .containsExactly(1.0, 2.0, 3.0, 4.0, 5.0, 6.0);
        assertThat(geometry.getSize()).extracting("sw", "sl", "sh").containsExactly(0.1, 0.2, 0.3);
        assertThat(geometry.getPoses_count()).isEqualTo(2);
        assertThat(geometry.getPoses()[1].getPyaw()).isEqualTo(12);
        assertThat(geometry.getSizes_count()).isEqualTo(1);
        assertThat(geometry.getSizes()[0].getSl()).isEqualTo(0.5);
        assertThat(ranger.isConfReady()).isFalse();
        ranger.queryConfiguration();
        assertThat(ranger.isConfReady()).isTrue();
        assertThat(ranger.getConf())
                .extracting("min_angle", "max_angle", "resolution", "min_range", "max_range", "range_res", "frequency")
                .containsExactly(-1.0, 1.0, 0.5, 0.1, 8.0, 0.01, 10.0);
        ranger.setRangerPower(1);
        assertThat(server.requests.getLast()).isEqualTo(new DeviceRequest.Power(true));
    }

    @Test
    void laser_hasAScan_withPointsInItsFrame() {
        client.requestInterfacePosition2D(0, PLAYER_CLOSE_MODE);
        var laser = client.requestInterfaceLaser(0, PLAYER_OPEN_MODE);
        read(4);
        assertThat(laser.isDataReady()).isTrue();
        var scan = laser.getData();
        assertThat(scan)
                .extracting(
                        "min_angle", "max_angle", "resolution", "max_range", "ranges_count", "intensity_count", "id")
                .containsExactly(-1f, 1f, 1f, 8f, 3, 1, 4);
        assertThat(scan.getRanges()).containsExactly(4, 2, 3);
        assertThat(scan.getIntensity()).containsExactly(7);
        assertThat(scan.getPoints()[0].getPx()).isCloseTo(4 * Math.cos(-1), within(1e-12));
        assertThat(scan.getPoints()[0].getPy()).isCloseTo(4 * Math.sin(-1), within(1e-12));
        assertThat(scan.getPoints()[1].getPx()).isEqualTo(2);
        assertThat(laser.isDataScanposeReady()).isFalse();
        assertThat(laser.getDataScanPose()).isNull();
    }

    @Test
    void laser_tellsGeometryAndConfiguration_whichCanBeSet() {
        var laser = client.requestInterfaceLaser(0, PLAYER_OPEN_MODE);
        var eightMetres = new LaserConfiguration(-1, 1, 0.5f, 8, 0.01f, true, 10);
        var fourMetres = new LaserConfiguration(-1, 1, 0.5f, 4, 0.01f, true, 10);
        var geometry = new DeviceReply.LaserGeometry(Pose3d.flat(0.1, 0, 0.5), new Size3d(0.1, 0.2, 0.3));
        server.replier = request -> new DeviceReply.Ack();
        server.reply(new DeviceRequest.Geometry(), geometry);
        server.reply(new DeviceRequest.GetConfiguration(), new DeviceReply.OfLaser(eightMetres));
        server.reply(new DeviceRequest.SetLaserConfiguration(fourMetres), new DeviceReply.OfLaser(fourMetres));
        laser.queryGeometry();
        assertThat(laser.isReadyPlgeom()).isTrue();
        assertThat(laser.getPlayerLaserGeom())
                .extracting("pose.px", "pose.pa", "size.sh")
                .containsExactly(0.1, 0.5, 0.3);
        laser.getScanProperties();
        assertThat(laser.isReadyPlconfig()).isTrue();
        var config = laser.getPlayerLaserConfig();
        assertThat(config.getIntensity()).isEqualTo((byte) 1);
        config.setMax_range(4);
        laser.setScanProperties(config);
        assertThat(server.requests.getLast()).isEqualTo(new DeviceRequest.SetLaserConfiguration(fourMetres));
        assertThat(laser.isReadyPlconfig()).isTrue();
        assertThat(laser.getPlayerLaserConfig().getMax_range()).isEqualTo(4);
        laser.setPower(0);
        assertThat(server.requests.getLast()).isEqualTo(new DeviceRequest.Power(false));
    }
}
