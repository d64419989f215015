package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;

import java.nio.charset.StandardCharsets;
import java.util.List;
import java.util.Map;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** What real clients send, and which replies they must receive. */
@Timeout(60)
class RecordedConversationsTest {
    private static final String REAL_PORT = "00001a09";

    /** The message without the parts that may differ: time, sequence number, port and sonar readings. */
    private static String comparable(byte[] message, int port) {
        String text = Hex.text(message).replace(port(port), REAL_PORT);
        boolean sonarData = text.startsWith("00000005000000000000000100000001", 16);
        return text.substring(0, 48) + " " + text.substring(72, 80) + " " + (sonarData ? "" : text.substring(80));
    }

    private static String port(int port) {
        return String.format("%08x", port);
    }

    @ParameterizedTest
    @ValueSource(
            strings = {"s32-playerprint-position2d.txt", "s32-playerprint-sonar.txt", "s32-playerprint-blobfinder.txt"})
    void playerprint_asCaptured_receivesTheSameBytes(String name) {
        List<Hex.Line> lines = Hex.capture(name);
        try (var served = Served.open();
                var client = RawClient.greeted(served.port())) {
            for (var line : lines.subList(1, lines.size())) {
                if (line.sender() == 'C') {
                    client.send(Hex.bytes(Hex.text(line.bytes()).replace(REAL_PORT, port(served.port()))));
                    continue;
                }
                if (line.message().header().type() == MessageType.DATA) {
                    served.tickApart();
                }
                assertThat(comparable(client.next().bytes(), served.port()))
                        .as("what answers %s", line.message())
                        .isEqualTo(comparable(line.bytes(), 6665));
            }
        }
    }

    @Test
    void playerprintOfARanger_asCaptured_receivesTheSameBytes() throws WireException {
        List<Hex.Line> lines = Hex.capture("playerprint-ranger.txt");
        var ranger = new ScriptedRanger(Map.of(
                new DeviceRequest.GetConfiguration(), captured(lines, 5),
                new DeviceRequest.Geometry(), captured(lines, 1)));
        try (var server = TcpServer.open(ranger, 0);
                var client = new RawClient(server.port())) {
            client.banner();
            assertThat(Hex.text(client.received()))
                    .isEqualTo(Hex.text(lines.getFirst().bytes()));
            for (int at = 1; at < lines.size(); ) {
                int from = at + 1;
                int to = from;
                while (to < lines.size() && lines.get(to).sender() == 'S') {
                    to++;
                }
                publish(ranger, lines.subList(from, to)); // before it is requested
                client.send(lines.get(at).bytes());
                for (var line : lines.subList(from, to)) {
                    boolean data = line.message().header().type() == MessageType.DATA;
                    byte[] received = client.next().bytes();
                    assertThat(data ? Hex.text(received) : comparable(received, server.port()))
                            .as("instead of %s", line.message())
                            .isEqualTo(
                                    data
                                            ? Hex.text(line.bytes()).replace(REAL_PORT, port(server.port()))
                                            : comparable(line.bytes(), 6665));
                }
                at = to;
            }
            // data flushed by a reply are answered with the frame that ends after them
            client.ask(new PlayerRequest.NextData());
            client.ask(new PlayerRequest.DeviceList()); // wait until the answer has arrived
            synchronized (ranger) {
                assertThat(ranger.answers).containsExactly(PlayerConnection.NO_TICK, 23L);
            }
        }
    }

    private static void publish(ScriptedRanger ranger, List<Hex.Line> lines) throws WireException {
        for (var line : lines) {
            Header header = line.message().header();
            if (header.type() == MessageType.DATA) {
                ranger.publish(
                        header.timeSeconds(),
                        DataCodec.decode(62, header.subtype(), line.message().payload())
                                .orElseThrow());
            }
        }
    }

    private static DeviceReply captured(List<Hex.Line> lines, int subtype) throws WireException {
        WireMessage reply = lines.stream()
                .skip(1)
                .map(Hex.Line::message)
                .filter(each -> each.header().type() == MessageType.ACK
                        && each.header().address().interfaceCode() == 62
                        && each.header().subtype() == subtype)
                .findFirst()
                .orElseThrow();
        return ReplyCodec.decode(62, MessageType.ACK, subtype, reply.payload());
    }

    @Test
    void javaclient_inPushMode_isServedToTheEnd() throws WireException {
        try (var served = Served.open();
                var client = new RawClient(served.port())) {
            assertThat(client.banner()).hasSizeBetween(10, 31);
            String robot = port(served.port());
            String here = "0100007f " + robot;
            // DEVLIST as javaclient3 sends it
            client.send(Hex.bytes("00000000 00000000 00000001 00000000 00000003 00000001 41dac04314800000"
                    + "00000000 00000008 00000000 00000000"));
            assertThat(comparable(client.next().bytes(), served.port()))
                    .isEqualTo(comparable(
                            Hex.bytes(here + "00000001 00000000 00000004 00000001 0000000000000000 00000000 00000038"
                                    + "00000003 00000003" + here + "00000004 00000000" + here + "00000005 00000000"
                                    + here + "00000007 00000000"),
                            served.port()));
            for (String code : List.of("00000004", "00000005", "00000007")) {
                client.send(Hex.bytes("00000000 00000000 00000001 00000000 00000003 00000002 41dac04314800000"
                        + "00000000 00000018" + here + code + "00000000 00000000 00000000"));
                assertThat(comparable(client.next().bytes(), served.port()))
                        .isEqualTo(comparable(
                                Hex.bytes(here + "00000001 00000000 00000004 00000002 0000000000000000 00000000"
                                        + "00000020" + here + code + "00000000 00000006 00000006 73746167 65000000"),
                                served.port()));
            }
            served.tick(3); // not sent to the client: it has not subscribed
            client.subscribe(Interfaces.POSITION2D);
            served.tick(1);
            WireMessage data = client.next(MessageType.DATA, 4, 1);
            assertThat(data.header().timeSeconds()).isEqualTo(0.3);
            assertThat(data.header().address())
                    .isEqualTo(new DeviceAddress(TcpServer.LOOPBACK_HOST, served.port(), 4, 0));
            client.drive(0.5, 0).ask(new PlayerRequest.DeviceList()); // wait until the command has arrived
            served.tick(2);
            client.nextPosition();
            assertThat(client.nextPosition().px()).isGreaterThan(0.01);
        }
    }

    @Test
    void requests_thatCannotBeServed_areRefusedWithoutContent_inOrder() {
        var nack = List.of(
                RawClient.message(MessageType.REQ, 62, 0, Content.empty(1)), // no such device
                RawClient.message(MessageType.REQ, 4, 3, Content.empty(1)), // no such index
                RawClient.message(MessageType.REQ, 4, 0, Content.empty(200)), // no such request
                RawClient.message(MessageType.REQ, 4, 0, new Content(5, new byte[4])), // too short
                RawClient.message(MessageType.REQ, 1, 0, new Content(7, new byte[12])), // AUTH
                RawClient.message(MessageType.REQ, 1, 0, new Content(8, new byte[4])), // NAMESERVICE
                RawClient.message(MessageType.REQ, 1, 0, new Content(5, Hex.bytes("00000007"))), // no such mode
                RawClient.message(MessageType.REQ, 1, 0, new Content(255, Hex.bytes("00000003 00000007"))),
                RawClient.access(Interfaces.RANGER, PlayerRequest.OPEN),
                RawClient.access(Interfaces.SONAR, 7),
                RawClient.bytes(new PlayerRequest.DriverInfo(new DeviceAddress(0, 0, 62, 0))));
        byte[] good = RawClient.message(MessageType.REQ, 1, 0, new Content(255, Hex.bytes("00000003 00000003")));
        byte[] unknownCommand = RawClient.message(MessageType.CMD, 4, 0, Content.empty(99));
        byte[] commandToNobody = RawClient.message(MessageType.CMD, 62, 0, Content.empty(1));
        byte[] strange = RawClient.message(MessageType.SYNCH, 1, 0, Content.empty(1));
        try (var served = Served.open();
                var client = RawClient.greeted(served.port())) {
            for (byte[] request : nack) {
                client.send(unknownCommand, commandToNobody, strange, request, good);
            }
            for (byte[] request : nack) {
                Header asked = Hex.message(request).header();
                WireMessage refused = client.next();
                assertThat(refused.header().type()).isEqualTo(MessageType.NACK);
                assertThat(refused.payload()).isEmpty();
                assertThat(refused.header().subtype()).isEqualTo(asked.subtype());
                assertThat(refused.header().address())
                        .isEqualTo(new DeviceAddress(
                                TcpServer.LOOPBACK_HOST,
                                served.port(),
                                asked.address().interfaceCode(),
                                asked.address().index()));
                client.next(MessageType.ACK, 1, 255);
            }
        }
    }

    @Test
    void requestsToDevices_areAnswered_withTheirSequenceNumber() throws WireException {
        try (var served = Served.open();
                var client = RawClient.greeted(served.port())) {
            var header = new Header(new DeviceAddress(9, 9, 4, 0), MessageType.REQ, 1, 0, 77, 0);
            client.send(new WireMessage(header, Content.NONE).bytes());
            WireMessage reply = client.next(MessageType.ACK, 4, 1);
            assertThat(reply.header().sequence()).isEqualTo(77);
            assertThat(ReplyCodec.decode(4, MessageType.ACK, 1, reply.payload()))
                    .isEqualTo(new DeviceReply.Position2dGeometry(0, 0, 0, 0.4, 0.3));
            client.send(RawClient.message(MessageType.REQ, 5, 0, Content.empty(1)));
            assertThat(client.next(MessageType.ACK, 5, 1).payload()).hasSize(8 + 16 * 48);
            client.send(RawClient.message(
                    MessageType.REQ, 4, 0, RequestCodec.encode(4, new DeviceRequest.SetOdometry(1, 2, 0.5))));
            assertThat(client.next(MessageType.ACK, 4, 5).payload()).isEmpty();
        }
    }

    @Test
    void unsubscribed_receivesNothingMore() throws WireException {
        try (var served = Served.open();
                var client = RawClient.greeted(served.port())) {
            client.subscribe(Interfaces.POSITION2D);
            client.subscribe(Interfaces.SONAR);
            served.tick(1);
            client.nextPosition();
            client.next(MessageType.DATA, 5, 1);
            WireMessage closed =
                    client.ask(new PlayerRequest.Access(new DeviceAddress(0, 0, 5, 0), PlayerRequest.CLOSE));
            assertThat(PlayerDeviceCodec.reply(MessageType.ACK, 3, closed.payload()))
                    .isEqualTo(new PlayerReply.Access(
                            new DeviceAddress(TcpServer.LOOPBACK_HOST, served.port(), 5, 0),
                            PlayerRequest.CLOSE,
                            "stage"));
            served.tick(2);
            client.nextPosition();
            client.nextPosition();
        }
    }

    @Test
    void greeting_isOneTextOf32Bytes() {
        try (var served = Served.open();
                var client = new RawClient(served.port())) {
            client.banner();
            assertThat(new String(client.received(), StandardCharsets.US_ASCII))
                    .startsWith("Player v.3")
                    .endsWith("\0")
                    .hasSize(32);
        }
    }
}
