package io.troupe.player;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.PlayerMsgHdr;
import io.troupe.player.structures.laser.PlayerLaserConfig;
import io.troupe.player.structures.ranger.PlayerRangerConf;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.LaserConfiguration;
import io.troupe.player.wire.Pose3d;
import io.troupe.player.wire.RangerConfiguration;
import io.troupe.player.wire.Size3d;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** Rangers and lasers, and the message handling that all devices share. */
class ScannersTest implements PlayerConstants {
    private final ScriptedServer server = new ScriptedServer();
    private final PlayerPorts.Registration port = PlayerPorts.open(ScriptedServer.PORT, server);
    private final PlayerClient client = new PlayerClient("localhost", ScriptedServer.PORT);

    @AfterEach
    void close() {
        client.close();
        port.close();
    }

    @Test
    void ranger_hasRanges_aNewArrayForEachMessage() {
        var ranger = (RangerInterface) client.requestInterface(PLAYER_RANGER_CODE, 0, PLAYER_OPEN_MODE);
        assertThat(ranger.getData()).isNull();
        server.publish(3);
        client.readAll();
        assertThat(ranger.isDataReady()).isTrue();
        assertThat(ranger.isDataReady()).isFalse();
        assertThat(ranger.getData().getRanges_count()).isEqualTo(2);
        double[] ranges = ranger.getData().getRanges();
        assertThat(ranges).containsExactly(3, 2);
        ranges[0] = -1;
        server.publish(4);
        client.readAll();
        assertThat(ranger.getData().getRanges()).containsExactly(4, 2);
        assertThat(ranges).containsExactly(-1, 2);
        assertThat(ranger.isDataIntnsReady()).isFalse();
        assertThat(ranger.getDataIntns()).isNull();
    }

    @Test
    void ranger_tellsGeometryAndConfiguration_andSwitches() {
        var ranger = client.requestInterfaceRanger(0, PLAYER_OPEN_MODE);
        assertThat(new PlayerRangerConf().getMax_range()).isNaN();
        server.replier = request -> switch (request) {
            case DeviceRequest.Geometry geometry ->
                new DeviceReply.RangerGeometry(
                        new Pose3d(1, 2, 3, 4, 5, 6),
                        new Size3d(0.1, 0.2, 0.3),
                        List.of(Pose3d.flat(7, 8, 9), Pose3d.flat(10, 11, 12)),
                        List.of(new Size3d(0.4, 0.5, 0.6)));
            case DeviceRequest.GetConfiguration get ->
                new DeviceReply.OfRanger(new RangerConfiguration(-1, 1, 0.5, 0.1, 8, 0.01, 10));
            default -> new DeviceReply.Ack();
        };
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
        var laser = client.requestInterfaceLaser(0, PLAYER_OPEN_MODE);
        server.publish(4);
        client.readAll();
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
        var how = new LaserConfiguration(-1, 1, 0.5f, 8, 0.01f, true, 10);
        server.replier = request -> switch (request) {
            case DeviceRequest.Geometry geometry ->
                new DeviceReply.LaserGeometry(Pose3d.flat(0.1, 0, 0.5), new Size3d(0.1, 0.2, 0.3));
            case DeviceRequest.GetConfiguration get -> new DeviceReply.OfLaser(how);
            case DeviceRequest.SetLaserConfiguration set -> new DeviceReply.OfLaser(set.configuration());
            default -> new DeviceReply.Ack();
        };
        laser.queryGeometry();
        assertThat(laser.isReadyPlgeom()).isTrue();
        assertThat(laser.getPlayerLaserGeom().getPose().getPx()).isEqualTo(0.1);
        assertThat(laser.getPlayerLaserGeom().getPose().getPa()).isEqualTo(0.5);
        assertThat(laser.getPlayerLaserGeom().getSize().getSh()).isEqualTo(0.3);
        laser.getScanProperties();
        assertThat(laser.isReadyPlconfig()).isTrue();
        PlayerLaserConfig config = laser.getPlayerLaserConfig();
        assertThat(config.getIntensity()).isEqualTo((byte) 1);
        config.setMax_range(4);
        laser.setScanProperties(config);
        assertThat(server.requests.getLast())
                .isEqualTo(new DeviceRequest.SetLaserConfiguration(
                        new LaserConfiguration(-1, 1, 0.5f, 4, 0.01f, true, 10)));
        assertThat(laser.isReadyPlconfig()).isTrue();
        assertThat(laser.getPlayerLaserConfig().getMax_range()).isEqualTo(4);
        laser.setPower(0);
        assertThat(server.requests.getLast()).isEqualTo(new DeviceRequest.Power(false));
    }

    @Test
    void messages_areReadByTheClientOnly_andStreamsAreNotForWriting() {
        var seen = new java.util.ArrayList<String>();
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

            void write() throws java.io.IOException {
                os.write(1);
            }
        }
        var listener = new Listener();
        var son = client.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
        listener.setDeviceAddress(son.getDeviceAddress());
        client.subscriptions.add(listener);
        server.publish(2);
        client.readAll();
        assertThat(seen).containsExactly("5/1/1 0.2 1");
        assertThatThrownBy(() -> son.readData(new PlayerMsgHdr()))
                .isInstanceOf(PlayerException.class)
                .hasMessageContaining("no message for sonar:0");
        assertThatThrownBy(son::handleNARMessage).isInstanceOf(PlayerException.class);
        assertThatThrownBy(listener::write).isInstanceOf(java.io.IOException.class);
    }
}
