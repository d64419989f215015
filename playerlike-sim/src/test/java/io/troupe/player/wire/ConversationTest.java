package io.troupe.player.wire;

import static io.troupe.player.wire.Interfaces.BLOBFINDER;
import static io.troupe.player.wire.Interfaces.POSITION2D;
import static io.troupe.player.wire.Interfaces.RANGER;
import static io.troupe.player.wire.Interfaces.SONAR;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.player.PlayerClient;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.blobfinder.PlayerBlobfinderBlob;
import io.troupe.sim.RobotReading;
import io.troupe.sim.SimulationRunner;
import io.troupe.sim.TestWorlds;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.Scenario;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** What real clients send, which replies and data they must receive, and in which order. */
@Timeout(60)
class ConversationTest {
    private static final String REAL_PORT = "00001a09";
    private static final int FRAMES = 200;

    private Served served = Served.open();

    @AfterEach
    void close() {
        served.close();
    }

    /** The message without the parts that may differ: time, sequence number, port and sonar readings. */
    private static String comparable(byte[] message, int port) {
        String text = Hex.text(message).replace(port(port), REAL_PORT);
        boolean sonarData = text.startsWith("00000005000000000000000100000001", 16);
        return text.substring(0, 48) + " " + text.substring(72, 80) + " " + (sonarData ? "" : text.substring(80));
    }

    private static String port(int port) {
        return String.format("%08x", port);
    }

    private DeviceAddress here(int code, int index) {
        return new DeviceAddress(TcpServer.LOOPBACK_HOST, served.port(), code, index);
    }

    // ---- recorded conversations

    @ParameterizedTest
    @ValueSource(
            strings = {"s32-playerprint-position2d.txt", "s32-playerprint-sonar.txt", "s32-playerprint-blobfinder.txt"})
    void playerprint_asCaptured_receivesTheSameBytes(String name) throws Exception {
        List<Hex.Line> lines = Hex.capture(name);
        var client = served.client();
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

    @Test
    void playerprintOfARanger_asCaptured_receivesTheSameBytes() throws Exception {
        List<Hex.Line> lines = Hex.capture("playerprint-ranger.txt");
        var ranger = new ScriptedServer(RANGER);
        ranger.reply(new DeviceRequest.GetConfiguration(), captured(lines, 5));
        ranger.reply(new DeviceRequest.Geometry(), captured(lines, 1));
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
                    String whole = Hex.text(line.bytes()).replace(REAL_PORT, port(server.port()));
                    assertThat(data ? Hex.text(received) : comparable(received, server.port()))
                            .as("instead of %s", line.message())
                            .isEqualTo(data ? whole : comparable(line.bytes(), 6665));
                }
                at = to;
            }
            // data sent before a reply are answered by the next request for data
            client.ask(new PlayerRequest.NextData());
            client.sync(); // wait until the answer has arrived
            assertThat(ranger.answers).containsExactly(PlayerConnection.NO_TICK, 23L);
            assertThat(ranger.commands).isEmpty();
        }
    }

    private static void publish(ScriptedServer ranger, List<Hex.Line> lines) throws WireException {
        for (var line : lines) {
            WireMessage message = line.message();
            if (message.header().type() == MessageType.DATA) {
                var data = DataCodec.decode(62, message.header().subtype(), message.payload());
                ranger.publish(message.header().timeSeconds(), data.orElseThrow());
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

    // ---- push

    @Test
    void javaclient_inPushMode_isServedToTheEnd() throws Exception {
        var client = served.connect();
        assertThat(client.banner()).hasSizeBetween(10, 31);
        assertThat(new String(client.received(), StandardCharsets.US_ASCII))
                .startsWith("Player v.3")
                .endsWith("\0")
                .hasSize(32);
        String here = "0100007f " + port(served.port());
        // DEVLIST as javaclient3 sends it
        client.send(Hex.bytes("00000000 00000000 00000001 00000000 00000003 00000001 41dac04314800000"
                + "00000000 00000008 00000000 00000000"));
        assertNext(
                client,
                here + "00000001 00000000 00000004 00000001 0000000000000000 00000000 00000038 00000003 00000003" + here
                        + "00000004 00000000" + here + "00000005 00000000" + here + "00000007 00000000");
        for (String code : List.of("00000004", "00000005", "00000007")) {
            client.send(Hex.bytes("00000000 00000000 00000001 00000000 00000003 00000002 41dac04314800000"
                    + "00000000 00000018" + here + code + "00000000 00000000 00000000"));
            assertNext(
                    client,
                    here + "00000001 00000000 00000004 00000002 0000000000000000 00000000 00000020" + here + code
                            + "00000000 00000006 00000006 73746167 65000000");
        }
        served.tick(3); // not sent to the client: it has not subscribed
        client.subscribe(POSITION2D);
        served.tick(1);
        WireMessage data = client.next(MessageType.DATA, 4, 1);
        assertThat(data.header().timeSeconds()).isEqualTo(0.3);
        assertThat(data.header().address()).isEqualTo(here(4, 0));
        client.drive(0.5, 0).sync();
        served.tick(2);
        client.nextPosition();
        assertThat(client.nextPosition().px()).isGreaterThan(0.01);
    }

    private void assertNext(RawClient client, String hex) throws IOException {
        assertThat(comparable(client.next().bytes(), served.port()))
                .isEqualTo(comparable(Hex.bytes(hex), served.port()));
    }

    @Test
    void requests_thatCannotBeServed_areRefusedWithoutContent_inOrder() throws Exception {
        var refused = List.of(
                RawClient.request(62, 0, Content.empty(1)), // no such device
                RawClient.request(4, 3, Content.empty(1)), // no such index
                RawClient.request(4, 0, Content.empty(200)), // no such request
                RawClient.request(4, 0, new Content(5, new byte[4])), // too short
                RawClient.request(1, 0, new Content(7, new byte[12])), // AUTH
                RawClient.request(1, 0, new Content(8, new byte[4])), // NAMESERVICE
                RawClient.request(1, 0, new Content(5, Hex.bytes("00000007"))), // no such mode
                RawClient.request(1, 0, new Content(255, Hex.bytes("00000003 00000007"))),
                RawClient.bytes(RawClient.access(RANGER, PlayerRequest.OPEN)),
                RawClient.bytes(RawClient.access(SONAR, 7)),
                RawClient.bytes(new PlayerRequest.DriverInfo(new DeviceAddress(0, 0, 62, 0))));
        byte[] good = RawClient.request(1, 0, new Content(255, Hex.bytes("00000003 00000003")));
        byte[] unknownCommand = RawClient.message(MessageType.CMD, 4, 0, Content.empty(99));
        byte[] commandToNobody = RawClient.message(MessageType.CMD, 62, 0, Content.empty(1));
        byte[] strange = RawClient.message(MessageType.SYNCH, 1, 0, Content.empty(1));
        var client = served.client();
        for (byte[] request : refused) {
            client.send(unknownCommand, commandToNobody, strange, request, good);
        }
        for (byte[] request : refused) {
            Header asked = Hex.message(request).header();
            WireMessage reply = client.next();
            assertThat(reply.header().type()).isEqualTo(MessageType.NACK);
            assertThat(reply.payload()).isEmpty();
            assertThat(reply.header().subtype()).isEqualTo(asked.subtype());
            assertThat(reply.header().address())
                    .isEqualTo(here(
                            asked.address().interfaceCode(), asked.address().index()));
            client.next(MessageType.ACK, 1, 255);
        }
    }

    @Test
    void requestsToDevices_areAnswered_withTheirSequenceNumber() throws Exception {
        var client = served.client();
        var header = new Header(new DeviceAddress(9, 9, 4, 0), MessageType.REQ, 1, 0, 77, 0);
        client.send(new WireMessage(header, Content.NONE).bytes());
        WireMessage reply = client.next(MessageType.ACK, 4, 1);
        assertThat(reply.header().sequence()).isEqualTo(77);
        assertThat(ReplyCodec.decode(4, MessageType.ACK, 1, reply.payload()))
                .isEqualTo(new DeviceReply.Position2dGeometry(0, 0, 0, 0.4, 0.3));
        client.send(RawClient.request(5, 0, Content.empty(1)));
        assertThat(client.next(MessageType.ACK, 5, 1).payload()).hasSize(8 + 16 * 48);
        client.send(RawClient.request(4, 0, RequestCodec.encode(4, new DeviceRequest.SetOdometry(1, 2, 0.5))));
        assertThat(client.next(MessageType.ACK, 4, 5).payload()).isEmpty();
    }

    @Test
    void unsubscribed_receivesNothingMore() throws Exception {
        var client = served.client();
        client.subscribe(POSITION2D, SONAR);
        served.tick(1);
        client.nextPosition();
        client.next(MessageType.DATA, 5, 1);
        WireMessage closed = client.ask(RawClient.access(SONAR, PlayerRequest.CLOSE));
        assertThat(PlayerDeviceCodec.reply(MessageType.ACK, 3, closed.payload()))
                .isEqualTo(new PlayerReply.Access(here(5, 0), PlayerRequest.CLOSE, "stage"));
        served.tick(2);
        client.nextPosition();
        client.nextPosition();
    }

    // ---- pull, in lock step with the world

    /** Drives in curves for a while; returns everything that the server has sent. */
    private byte[] driveInCurves() throws IOException {
        try (var runner = SimulationRunner.start(served.simulation, 1, snapshot -> {})) {
            assertThat(runner.isRunning()).isTrue();
            var client = served.client();
            client.ask(new PlayerRequest.DataMode(Delivery.PULL));
            client.subscribe(POSITION2D, SONAR, BLOBFINDER);
            for (int frame = 0; frame < FRAMES; frame++) {
                client.ask(new PlayerRequest.NextData());
                DeviceData.Position2d position = client.nextPosition();
                client.next(MessageType.DATA, 5, 1);
                client.next(MessageType.DATA, 7, 1);
                client.next(MessageType.SYNCH, 1, 1);
                client.drive(0.3, Math.sin(frame) - position.pa());
            }
            client.close();
            return client.received();
        }
    }

    @Test
    void lockStep_twice_givesTheSameBytes_andEveryTickIsSeenOnce() throws Exception {
        byte[] first = driveInCurves();
        var in = new ByteArrayInputStream(first, 32, first.length - 32);
        var reader = new MessageReader(in, 1 << 16);
        int tick = 0;
        while (in.available() > 0) {
            Header header = reader.read().header();
            if (header.type() == MessageType.DATA && header.address().interfaceCode() == 4) {
                assertThat(header.timeSeconds()).isEqualTo(tick++ / 10.0);
            }
        }
        assertThat(tick).isEqualTo(FRAMES);
        int port = served.port();
        served.close();
        served = Served.open(port);
        assertThat(Hex.text(driveInCurves())).isEqualTo(Hex.text(first));
    }

    // ---- what a real server with Stage does and the protocol does not lead one to expect

    /** In front of the robot a red box on the left and a green one on the right; the devices in an unusual order. */
    private void serveBoxes() {
        served.close();
        var world = TestWorlds.world(
                List.of(TestWorlds.robot("one", 0, 0, 0)),
                TestWorlds.wall("left", 3, 1, 0.5, 0.5, TestWorlds.RED),
                TestWorlds.wall("right", 3, -1, 0.5, 0.5, TestWorlds.GREEN));
        var devices = new ArrayList<DeviceBinding>();
        devices.add(new DeviceBinding(Served.PORT, "simulation", 0, "", 0, TestWorlds.NOWHERE));
        for (String type : List.of("sonar", "blobfinder", "position2d")) {
            devices.add(new DeviceBinding(Served.PORT, type, 0, "one", 0, TestWorlds.NOWHERE));
        }
        served = Served.open(new Scenario(world, devices));
    }

    @Test
    void deviceList_hasTheOrderOfProvides() throws Exception {
        serveBoxes();
        String here = "0100007f " + port(served.port());
        assertThat(Hex.text(served.client().sync().payload()))
                .isEqualTo(Hex.text(Hex.bytes("00000004 00000004" + here + "0000001f 00000000" + here
                        + "00000005 00000000" + here + "00000007 00000000" + here + "00000004 00000000")));
    }

    private RobotReading robot() {
        return served.simulation.latest().robots().getFirst();
    }

    @Test
    void blobs_areFromRightToLeft_overTheWireAndInThisJvm_andTheWorldsFromLeftToRight() throws Exception {
        serveBoxes();
        var client = served.client();
        client.subscribe(BLOBFINDER);
        served.tick(1);
        String data = Hex.text(client.next(MessageType.DATA, 7, 1).payload());
        String size = "00000050" + "0000003c" + "00000002" + "00000002";
        assertThat(data).startsWith(size).hasSize(size.length() + 2 * 80);
        assertThat(data.substring(size.length() + 8, size.length() + 16))
                .as("the first colour")
                .isEqualTo("0000ff00");
        assertThat(data.substring(size.length() + 88, size.length() + 96))
                .as("the second colour")
                .isEqualTo("00ff0000");
        client.close();

        var inThisJvm = new PlayerClient("localhost", Served.PORT);
        var camera = inThisJvm.requestInterfaceBlobfinder(0, PlayerConstants.PLAYER_OPEN_MODE);
        served.tickApart();
        inThisJvm.readAll();
        PlayerBlobfinderBlob[] blobs = camera.getData().getBlobs();
        assertThat(blobs).extracting(PlayerBlobfinderBlob::getColor).containsExactly(TestWorlds.GREEN, TestWorlds.RED);
        assertThat(blobs[0].getLeft()).isGreaterThan(blobs[1].getRight());
        inThisJvm.close();
        served.tick(1);
        assertThat(robot().blobs().blobs())
                .extracting(blob -> blob.colour())
                .containsExactly(TestWorlds.RED, TestWorlds.GREEN);
    }
}
