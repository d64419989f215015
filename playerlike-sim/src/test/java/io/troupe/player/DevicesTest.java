package io.troupe.player;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;
import io.troupe.player.structures.blobfinder.PlayerBlobfinderColorConfig;
import io.troupe.player.structures.blobfinder.PlayerBlobfinderImagerConfig;
import io.troupe.player.structures.position2d.PlayerPosition2dCmdPos;
import io.troupe.player.structures.position2d.PlayerPosition2dCmdVel;
import io.troupe.player.wire.DeviceCommand.Velocity;
import org.assertj.core.api.ThrowableAssert.ThrowingCallable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** What devices say to the server, and what the server says about its devices. */
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

    @Test
    void commands_ofBothGenerations_comeToTheSame() {
        pos.setSpeed(0.4, -0.2);
        pos.setVelocity(new PlayerPose(0.4, 0, -0.2), 1);
        pos.setVelocity(new PlayerPose2d(0.4, 0, -0.2), 1);
        pos.setCarCMD(0.4, -0.2);
        var command = new PlayerPosition2dCmdVel();
        command.setVel(new PlayerPose2d(0.4, 0, -0.2));
        command.setState((byte) 1);
        pos.setVelocity(command);
        PlayerPose old = command.getVel();
        pos.setVelocity(old, 1);
        assertThat(server.commands).hasSize(6).containsOnly(new Velocity(0.4, 0, -0.2, true));
        pos.setVelocity(old, 0);
        assertThat(server.commands.getLast()).isEqualTo(new Velocity(0.4, 0, -0.2, false));
    }

    @ParameterizedTest
    @ValueSource(doubles = {Double.NaN, Double.POSITIVE_INFINITY})
    void speed_isNotFinite_isRefusedByItsValue(double speed) {
        assertThatThrownBy(() -> pos.setSpeed(speed, 0))
                .isInstanceOf(PlayerException.class)
                .hasMessageContaining("position2d:0")
                .hasMessageContaining("" + speed);
        assertThat(server.commands).isEmpty();
    }

    @Test
    void calls_nobodyServesYet_throwAndNameTheCall() {
        var blf = client.requestInterfaceBlobfinder(0, PLAYER_OPEN_MODE);
        refused("setPosition of position2d:0", () -> pos.setPosition(new PlayerPose(), new PlayerPose(), 1));
        refused("setPosition", () -> pos.setPosition(new PlayerPosition2dCmdPos()));
        refused("setVelHead", () -> pos.setVelHead(0.1, 1));
        refused("setVelocityControl", () -> pos.setVelocityControl(1));
        refused("setControlMode(1)", () -> pos.setControlMode(1));
        refused("setVelocityPIDParams", () -> pos.setVelocityPIDParams(1, 0, 0));
        refused("setPositionPIDParams", () -> pos.setPositionPIDParams(1, 0, 0));
        refused("setSpeedProfileParams", () -> pos.setSpeedProfileParams(1, 1));
        refused("setTrackingColor", () -> blf.setTrackingColor(new PlayerBlobfinderColorConfig()));
        refused("setImagerParams", () -> blf.setImagerParams(new PlayerBlobfinderImagerConfig()));
        refused("requestAddReplaceRule", () -> client.requestAddReplaceRule(-1, -1, 1, -1, 1));
        refused("interface12:3", () -> client.requestInterface(PLAYER_SPEECH_CODE, 3, PLAYER_OPEN_MODE));
        assertThat(server.commands).isEmpty();
    }

    private static void refused(String what, ThrowingCallable call) {
        assertThatThrownBy(call).isInstanceOf(PlayerException.class).hasMessageContaining(what);
    }

    @Test
    void request_theServerRefuses_throwsItsReason() {
        refused("not in the script", () -> pos.setMotorPower(0));
        refused("not in the script", pos::queryGeometry);
        assertThat(pos.isGeomReady()).isFalse();
        assertThat(pos.getGeom()).isNull();
    }

    @Test
    void deviceList_andDriver_areToldOnRequest() {
        assertThat(client.isReadyPDDList()).isFalse();
        client.requestDeviceList();
        assertThat(client.isReadyPDDList()).isTrue();
        assertThat(client.isReadyPDDList()).isFalse();
        var list = client.getPDDList();
        assertThat(list.getDeviceCount()).isEqualTo(3);
        assertThat(list.getDevList())
                .extracting(each -> each.getInterf())
                .containsExactly(PLAYER_POSITION2D_CODE, PLAYER_SONAR_CODE, PLAYER_BLOBFINDER_CODE);
        client.requestDriverInfo(list.getDevList()[1]);
        assertThat(client.isReadyPDDI()).isTrue();
        assertThat(client.getPDDI().getDriverName()).isEqualTo("script");
        assertThat(pos.getDeviceDriverName()).isEqualTo("script");
        assertThat(pos.getDeviceAddress().getRobot()).isEqualTo(ScriptedServer.PORT);
    }

    @Test
    void sameDevice_requestedTwice_bothGetTheData_untilItIsClosed() {
        var again = (Position2DInterface) client.requestInterface(PLAYER_POSITION2D_CODE, 0, PLAYER_OPEN_MODE);
        server.publish(0);
        client.readAll();
        assertThat(pos.isDataReady()).isTrue();
        assertThat(again.isDataReady()).isTrue();
        assertThat(pos.getData()).isNotSameAs(again.getData());
        var ended = client.requestInterfacePosition2D(0, PLAYER_CLOSE_MODE);
        assertThat(ended.getDeviceAccess()).isEqualTo((byte) PLAYER_CLOSE_MODE);
        var son = client.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
        server.publish(1);
        client.readAll();
        assertThat(son.isDataReady()).isTrue();
        assertThat(pos.getX()).isZero();
    }

    @Test
    void messages_haveDataOfTheirOwn() {
        var son = client.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
        client.requestDataDeliveryMode(PLAYER_DATAMODE_PULL);
        server.publish(3);
        assertThat(client.readAll()).isEqualTo(PLAYER_MSGTYPE_SYNCH);
        var first = son.getData();
        first.getRanges()[0] = -1;
        server.publish(4);
        client.readAll();
        assertThat(son.getData()).isNotSameAs(first);
        assertThat(son.getData().getRanges()).containsExactly(4f);
        assertThat(first.getRanges()).containsExactly(-1f);
    }

    @Test
    void position_beforeTheFirstData_saysToWait() {
        assertThat(pos.getData()).isNull();
        assertThatThrownBy(pos::getX).isInstanceOf(NullPointerException.class).hasMessageContaining("isDataReady()");
    }

    @Test
    void modes_thatDoNotExist_areRefused() {
        refused("access mode of sonar:0 is 9", () -> client.requestInterfaceSonar(0, 9));
        refused("data delivery mode is 3", () -> client.requestDataDeliveryMode(3));
    }
}
