package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerException;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.PlayerPose;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** A client and a server connected by a socket: what is sent, how arriving messages are handled, and in which order. */
@Tag("threads")
@Timeout(value = 60, threadMode = Timeout.ThreadMode.SEPARATE_THREAD) // a busy loop cannot be interrupted
class RemoteConnectionTest implements PlayerConstants {
    static boolean is(WireMessage message, int interfaceCode, int subtype) {
        return message.header().type() == MessageType.REQ
                && message.header().address().interfaceCode() == interfaceCode
                && message.header().subtype() == subtype;
    }

    static PlayerClient connect(ScriptedSocket server) {
        return new PlayerClient("localhost", server.port());
    }

    @Test
    void push_readAllBringsOneMessage_inTheOrderSent_andDataMayComeWithTheAcknowledgement() throws Exception {
        try (var server = new ScriptedSocket((message, self) -> {
            if (is(message, 1, 3)) {
                var reply = new PlayerReply.Access(self.device(Interfaces.POSITION2D), 1, "stage");
                self.send(
                        self.position(1),
                        self.reply(message, MessageType.ACK, PlayerDeviceCodec.encode(reply)),
                        self.position(2),
                        self.position(3));
                return true;
            }
            return false;
        })) {
            var client = connect(server);
            var pos = client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
            assertThat(pos.getDeviceDriverName()).isEqualTo("stage");
            assertThat(pos.getDeviceAddress().getRobot()).isEqualTo(server.port());
            var seen = new ArrayList<Double>();
            while (seen.size() < 3) {
                assertThat(client.readAll()).isEqualTo(PLAYER_MSGTYPE_DATA);
                assertThat(pos.isDataReady()).isTrue();
                seen.add(pos.getX());
            }
            assertThat(seen).containsExactly(1.0, 2.0, 3.0);
            assertThat(pos.getTimestamp()).isEqualTo(3);
            client.close();
        }
    }

    @Test
    void commandsAndRequests_areSentInOrder_andRepliesAreMatchedByDevice() throws Exception {
        var held = new ArrayList<WireMessage>();
        try (var server = new ScriptedSocket((message, self) -> {
            if (is(message, 4, 1)) { // the reply with the geometry of position2d comes later than that of the sonars
                held.add(message);
                return true;
            }
            if (is(message, 5, 1)) {
                var sonars = new DeviceReply.SonarGeometry(List.of(new DeviceReply.SonarMount(0.1, 0.2, 0.3)));
                var body = new DeviceReply.Position2dGeometry(-0.04, 0, 0, 0.44, 0.33);
                self.send(
                        self.reply(message, MessageType.ACK, ReplyCodec.encode(sonars)),
                        self.reply(held.getFirst(), MessageType.ACK, ReplyCodec.encode(body)));
                return true;
            }
            return false;
        })) {
            var client = connect(server);
            var pos = client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
            var son = client.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
            client.runThreaded(-1, -1);
            pos.queryGeometry();
            son.queryGeometry();
            while (!pos.isGeomReady())
                ;
            while (!son.isGeomReady())
                ;
            assertThat(pos.getGeom().getSize().getSw()).isEqualTo(0.33);
            assertThat(son.getGeom().getPoses()[0].getPyaw()).isEqualTo(0.3);
            pos.setSpeed(0.2, 0.1);
            pos.setCarCMD(0.3, 0);
            assertThat(server.nextCommand().payload())
                    .isEqualTo(CommandCodec.encode(new DeviceCommand.Velocity(0.2, 0, 0.1, true))
                            .payload());
            assertThat(server.nextCommand().header().subtype()).isEqualTo(3);
            client.close();
        }
    }

    @Test
    void pull_aFrameIsWhatCameUntilSynch_andOneRequestIsOpenAtATime() throws Exception {
        try (var server = new ScriptedSocket((message, self) -> {
            if (is(message, 1, 4)) {
                self.send(self.reply(message, MessageType.ACK, Content.NONE));
                long asked =
                        self.received.stream().filter(each -> is(each, 1, 4)).count();
                self.send(self.position(asked), self.sonar(asked), self.position(asked + 0.5), self.synch());
                return true;
            }
            return false;
        })) {
            var client = connect(server);
            client.requestDataDeliveryMode(PLAYER_DATAMODE_PULL);
            var pos = client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
            var son = client.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
            for (int round = 1; round <= 20; round++) {
                assertThat(client.readAll()).isEqualTo(PLAYER_MSGTYPE_SYNCH);
                assertThat(pos.isDataReady()).isTrue();
                assertThat(pos.getX()).isEqualTo(round + 0.5);
                assertThat(son.isDataReady()).isTrue();
                assertThat(son.getData().getRanges()[0]).isEqualTo(round);
            }
            client.runThreaded(-1, -1);
            for (int round = 21; round <= 40; round++) {
                while (!son.isDataReady())
                    ;
                assertThat(son.getData().getRanges()[0]).isEqualTo(round);
                assertThat(pos.getX()).isEqualTo(round + 0.5);
            }
            client.close();
        }
    }

    @Test
    void subscription_isRefused_inEveryWayARealServerRefuses() throws Exception {
        try (var server = new ScriptedSocket((message, self) -> {
            if (is(message, 1, 3)) {
                boolean sonar = message.payload()[11] == Interfaces.SONAR.code();
                var echo = PlayerDeviceCodec.encode(new PlayerReply.Access(self.device(Interfaces.SONAR), 3, ""));
                self.send(self.reply(message, sonar ? MessageType.NACK : MessageType.ACK, echo));
                return true;
            }
            return false;
        })) {
            var client = connect(server);
            assertThatThrownBy(() -> client.requestInterfaceSonar(0, PLAYER_OPEN_MODE))
                    .isInstanceOf(PlayerException.class)
                    .hasMessageContaining("Negative acknowledgement received for subscribing to sonar:0");
            assertThatThrownBy(() -> client.requestInterfaceRanger(0, PLAYER_OPEN_MODE))
                    .isInstanceOf(PlayerException.class)
                    .hasMessageContaining("Error subscribing to ranger:0");
            assertThatThrownBy(() -> client.requestInterfaceLaser(0, PLAYER_OPEN_MODE))
                    .hasMessageContaining("laser:0 is not in the device list. It has: position2d:0, sonar:0, ranger:0");
            client.close();
        }
    }

    @Test
    void request_thatIsDropped_isNamed_whenItsTimeIsOver() throws Exception {
        try (var server = new ScriptedSocket((message, self) -> is(message, 1, 10) || is(message, 4, 5))) {
            var client = connect(server);
            var pos = client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
            client.setReadTimeout(50);
            assertThatThrownBy(() -> client.requestAddReplaceRule(-1, -1, 1, -1, 1))
                    .isInstanceOf(PlayerException.class)
                    .hasMessageContaining("localhost:" + server.port() + " did not answer within 50 ms: ReplaceRule[");
            pos.setOdometry(new PlayerPose(1, 2, 3)); // logs a warning
            assertThat(client.readAll()).isEqualTo(PLAYER_MSGTYPE_RESP_NACK);
            client.setReadTimeout(30_000);
            pos.resetOdometry(); // continues, whatever happened to the other requests
            assertThat(client.readAll()).isEqualTo(PLAYER_MSGTYPE_RESP_ACK);
            client.close();
        }
    }

    @Test
    void messagesNobodyKnows_areSkipped() throws Exception {
        try (var server = new ScriptedSocket((message, self) -> false)) {
            var client = connect(server);
            var pos = client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
            var wheels = server.device(Interfaces.POSITION2D);
            server.send(
                    WireMessage.of(new DeviceAddress(1, 2, 10, 0), MessageType.DATA, 1, 0, new byte[12]),
                    WireMessage.of(wheels, MessageType.DATA, 99, 0, new byte[4]),
                    WireMessage.of(wheels, MessageType.DATA, 1, 0, new byte[4]),
                    WireMessage.of(server.device(Interfaces.SONAR), MessageType.ACK, 1, 0, Content.NONE),
                    WireMessage.of(new DeviceAddress(0, 0, 1, 0), MessageType.SYNCH, 2, 0, new byte[] {0, 0, 0, 9}),
                    server.position(7));
            assertThat(client.readAll()).isEqualTo(PLAYER_MSGTYPE_DATA);
            assertThat(pos.getX()).isEqualTo(7);
            client.close();
        }
    }

    @Test
    void ranger_tellsIntensities_andWhatItsRangesAreStampedWith() throws Exception {
        try (var server = new ScriptedSocket((message, self) -> false)) {
            var client = connect(server);
            var ranger = client.requestInterfaceRanger(0, PLAYER_OPEN_MODE);
            var where = new DeviceReply.RangerGeometry(Pose3d.flat(1, 2, 3), new Size3d(1, 2, 3), List.of(), List.of());
            var stamped = new DeviceData.RangerStamped(new DeviceData.RangerRanges(List.of(6.0)), where, null);
            server.send(
                    server.data(Interfaces.RANGER, new DeviceData.RangerIntensities(List.of(5.0)), 0),
                    server.data(Interfaces.RANGER, stamped, 0));
            client.readAll();
            assertThat(ranger.isDataIntnsReady()).isTrue();
            assertThat(ranger.isDataReady()).isFalse();
            assertThat(ranger.getDataIntns().getIntens()).containsExactly(5);
            client.readAll();
            assertThat(ranger.isDataReady()).isTrue();
            assertThat(ranger.getData().getRanges()).containsExactly(6);
            assertThat(ranger.isGeomReady()).isTrue();
            assertThat(ranger.getGeom().getPose().getPy()).isEqualTo(2);
            assertThat(ranger.isConfReady()).isFalse();
            client.close();
        }
    }

    @Test
    void clientOnAnActorSpace_getsItsFramesAsTurns_andAsksForTheNextWhenNothingIsLeftToDo() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("remote"));
                var server = new ScriptedSocket((message, self) -> {
                    if (is(message, 1, 4)) {
                        long asked = self.received.stream()
                                .filter(each -> is(each, 1, 4))
                                .count();
                        if (asked <= 3) {
                            self.send(
                                    self.reply(message, MessageType.ACK, Content.NONE),
                                    self.position(asked),
                                    self.synch());
                        }
                        return true;
                    }
                    return false;
                })) {
            var seen = new ConcurrentLinkedQueue<String>();
            var done = new CountDownLatch(4);
            space.execute(() -> {
                var client = connect(server);
                client.requestDataDeliveryMode(PLAYER_DATAMODE_PULL);
                var pos = client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
                client.runThreaded(-1, -1);
                space.repeatWhile(
                                () -> true,
                                () -> client.nextData().thenAccept(ready -> {
                                    seen.add(pos.isDataReady() + " " + pos.getX() + " "
                                            + (ActorSpace.current() == space));
                                    done.countDown();
                                    if (pos.getX() == 3) {
                                        client.close();
                                    }
                                }))
                        .exceptionally(closed -> {
                            done.countDown();
                            return null;
                        });
            });
            assertThat(done.await(30, TimeUnit.SECONDS)).isTrue();
            assertThat(seen).containsExactly("true 1.0 true", "true 2.0 true", "true 3.0 true");
        }
    }
}
