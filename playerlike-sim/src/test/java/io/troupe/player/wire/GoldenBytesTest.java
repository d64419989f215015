package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import org.junit.jupiter.api.Test;

/** Messages of real clients and servers, byte for byte. */
class GoldenBytesTest {
    private static final int HOST = 0x0100007f;
    private static final int PORT = 6665;

    private static DeviceAddress at(int code) {
        return new DeviceAddress(HOST, PORT, code, 0);
    }

    private static String hex(String text) {
        return Hex.text(Hex.bytes(text));
    }

    private static void playerRequest(String hex, PlayerRequest expected) throws WireException {
        WireMessage message = Hex.message(hex);
        assertThat(message.header().type()).isEqualTo(MessageType.REQ);
        assertThat(PlayerDeviceCodec.request(message.header().subtype(), message.payload()))
                .isEqualTo(expected);
        Content content = PlayerDeviceCodec.encode(expected);
        assertThat(content.subtype()).isEqualTo(message.header().subtype());
        assertThat(Hex.text(content.payload())).isEqualTo(Hex.text(message.payload()));
    }

    private static void playerReply(String hex, double timeSeconds, PlayerReply expected) throws WireException {
        WireMessage message = Hex.message(hex);
        int subtype = message.header().subtype();
        assertThat(PlayerDeviceCodec.reply(message.header().type(), subtype, message.payload()))
                .isEqualTo(expected);
        WireMessage made = WireMessage.of(
                at(1), PlayerDeviceCodec.type(expected), subtype, timeSeconds, PlayerDeviceCodec.encode(expected));
        assertThat(Hex.text(made.bytes())).isEqualTo(hex(hex));
    }

    private static void data(String hex, double timeSeconds, DeviceData expected) throws WireException {
        WireMessage message = Hex.message(hex);
        Header header = message.header();
        assertThat(DataCodec.decode(header.address().interfaceCode(), header.subtype(), message.payload()))
                .contains(expected);
        Content content = DataCodec.encode(expected);
        WireMessage made =
                WireMessage.of(header.address(), MessageType.DATA, content.subtype(), timeSeconds, content.payload());
        assertThat(Hex.text(made.bytes())).isEqualTo(hex(hex));
    }

    private static void command(int subtype, String payload, DeviceCommand expected) throws WireException {
        assertThat(CommandCodec.decode(4, subtype, Hex.bytes(payload))).contains(expected);
        Content content = CommandCodec.encode(expected);
        assertThat(content.subtype()).isEqualTo(subtype);
        assertThat(Hex.text(content.payload())).isEqualTo(hex(payload));
    }

    private static void request(int code, int subtype, String payload, DeviceRequest expected) throws WireException {
        assertThat(RequestCodec.decode(code, subtype, Hex.bytes(payload))).isEqualTo(expected);
        Content content = RequestCodec.encode(code, expected);
        assertThat(content.subtype()).isEqualTo(subtype);
        assertThat(Hex.text(content.payload())).isEqualTo(hex(payload));
    }

    @Test
    void banner_is32Bytes_andEndsWithZero() {
        assertThat(Hex.text(TcpServer.banner("Player v.3.1.1-dev")))
                .isEqualTo("506c6179657220762e332e312e312d6465760000000000000000000000000000");
        assertThat(TcpServer.banner("x".repeat(40))).hasSize(32).endsWith('x', 0);
    }

    @Test
    void dataMode_requestAndReply() throws WireException {
        playerRequest(
                "00000000 00000000 00000001 00000000 00000003 00000005 41dac04347905a32 00000000 00000004 | 00000002",
                new PlayerRequest.DataMode(Delivery.PULL));
        playerReply(
                "0100007f 00001a09 00000001 00000000 00000004 00000005 3ffb333333333333 00000000 00000000",
                1.7,
                new PlayerReply.Ack());
    }

    @Test
    void deviceList_requestsOfTwoClients_andReply() throws WireException {
        playerRequest(
                "00000000 00000000 00000001 00000000 00000003 00000001 41dac0434797a609 00000000 00000000",
                new PlayerRequest.DeviceList());
        assertThat(PlayerDeviceCodec.request(1, Hex.bytes("00000000 00000000")))
                .isEqualTo(new PlayerRequest.DeviceList());
        playerReply("""
                0100007f 00001a09 00000001 00000000 00000004 00000001 3ffccccccccccccd 00000000 00000058 | 00000005 00000005
                 0100007f 00001a09 0000001f 00000000 0100007f 00001a09 00000004 00000000 0100007f 00001a09 00000007 00000000
                 0100007f 00001a09 00000005 00000000 0100007f 00001a09 00000006 00000000""", 1.8, new PlayerReply.DeviceList(List.of(at(31), at(4), at(7), at(5), at(6))));
    }

    @Test
    void driverInfo_requestAndReply() throws WireException {
        playerRequest("""
                00000000 00000000 00000001 00000000 00000003 00000002 0000000000000000 00000000 00000018
                | 0100007f 00001a09 0000001f 00000000 00000000 00000000""", new PlayerRequest.DriverInfo(at(31)));
        playerReply("""
                0100007f 00001a09 00000001 00000000 00000004 00000002 0000000000000000 00000000 00000020
                | 0100007f 00001a09 0000001f 00000000 00000006 00000006 73746167 65000000""", 0, new PlayerReply.DriverInfo(at(31), "stage"));
    }

    @Test
    void subscription_requestsAndReplies() throws WireException {
        playerRequest("""
                00000000 00000000 00000001 00000000 00000003 00000003 41dac04347a4fcc6 00000000 0000001c
                | 00000000 00000000 00000004 00000000 00000001 00000000 00000000""", new PlayerRequest.Access(new DeviceAddress(0, 0, 4, 0), PlayerRequest.OPEN));
        playerReply("""
                0100007f 00001a09 00000001 00000000 00000004 00000003 4000000000000000 00000000 00000024
                | 0100007f 00001a09 00000004 00000000 00000001 00000006 00000006 73746167 65000000""", 2, new PlayerReply.Access(at(4), PlayerRequest.OPEN, "stage"));
        assertThat(PlayerDeviceCodec.request(
                        3, Hex.bytes("00000000 00000000 00000005 00000000 00000002 00000000 00000000")))
                .isEqualTo(new PlayerRequest.Access(new DeviceAddress(0, 0, 5, 0), PlayerRequest.CLOSE));
        assertThat(Hex.text(PlayerDeviceCodec.encode(new PlayerReply.Access(at(5), PlayerRequest.CLOSE, "stage"))))
                .isEqualTo(hex("0100007f 00001a09 00000005 00000000 00000002 00000006 00000006 73746167 65000000"));
    }

    @Test
    void refusedSubscription_ofTheRealServer_hasAPayload() throws WireException {
        WireMessage refusal = Hex.message("""
                0100007f 00001a09 00000001 00000000 00000006 00000003 400d99999999999a 00000000 0000001c
                | 0100007f 00001a09 0000003e 00000000 00000003 00000000 00000000""");
        assertThat(refusal.header().type()).isEqualTo(MessageType.NACK);
        assertThat(refusal.header().timeSeconds()).isEqualTo(3.7);
        assertThat(PlayerDeviceCodec.reply(MessageType.NACK, 3, refusal.payload()))
                .isEqualTo(new PlayerReply.Nack());
        assertThat(PlayerDeviceCodec.encode(new PlayerReply.Nack())).isEmpty();
    }

    @Test
    void nextData_requestReplyAndEndOfFrame() throws WireException {
        playerRequest(
                "00000000 00000000 00000001 00000000 00000003 00000004 41dac04347b36bca 00000000 00000000",
                new PlayerRequest.NextData());
        playerReply(
                "0100007f 00001a09 00000001 00000000 00000004 00000004 400199999999999a 00000000 00000000",
                2.2,
                new PlayerReply.Ack());
        Content end = PlayerDeviceCodec.synch(0);
        WireMessage made =
                WireMessage.of(new DeviceAddress(0, 0, 1, 0), MessageType.SYNCH, end.subtype(), 0, end.payload());
        assertThat(Hex.text(made.bytes()))
                .isEqualTo(hex(
                        "00000000 00000000 00000001 00000000 00000005 00000001 0000000000000000 00000000 00000000"));
        Content overflow = PlayerDeviceCodec.synch(7);
        assertThat(overflow.subtype()).isEqualTo(2);
        assertThat(Hex.text(overflow.payload())).isEqualTo("00000007");
        assertThat(PlayerDeviceCodec.dropped(2, overflow.payload())).isEqualTo(7);
    }

    @Test
    void position2d_data() throws WireException {
        data("""
                0100007f 00001a09 00000004 00000000 00000001 00000001 402e99999999999a 00000000 00000034
                | 0000000000000000 c014000000000000 0000000000000000 0000000000000000 0000000000000000 0000000000000000 00000000""", 15.3, new DeviceData.Position2d(0, -5, 0, 0, 0, 0, false));
    }

    @Test
    void position2d_commands() throws WireException {
        WireMessage speed = Hex.message("""
                00000000 00001a09 00000004 00000000 00000002 00000001 41dac04347b36a55 00000000 0000001c
                | 3fc999999999999a 0000000000000000 3fb999999999999a 00000001""");
        assertThat(CommandCodec.decode(4, 1, speed.payload())).contains(new DeviceCommand.Velocity(0.2, 0, 0.1, true));
        command(
                1,
                "3fd3d49300000000 0000000000000000 3fed0d87e0000000 00000001",
                new DeviceCommand.Velocity(
                        Double.longBitsToDouble(0x3fd3d49300000000L),
                        0,
                        Double.longBitsToDouble(0x3fed0d87e0000000L),
                        true));
        command(3, "3fb999999999999a 3fa999999999999a", new DeviceCommand.Car(0.1, 0.05));
        command(2, """
                3ff0000000000000 4000000000000000 3fe0000000000000
                 0000000000000000 0000000000000000 0000000000000000 00000001""", new DeviceCommand.GoTo(1, 2, 0.5, 0, 0, 0, true));
    }

    @Test
    void position2d_requests() throws WireException {
        request(4, 5, "3ff0000000000000 4000000000000000 3fe0000000000000", new DeviceRequest.SetOdometry(1, 2, 0.5));
        request(4, 2, "00000001", new DeviceRequest.Power(true));
        request(4, 1, "", new DeviceRequest.Geometry());
        request(4, 6, "", new DeviceRequest.ResetOdometry());
        byte[] geometry = ReplyCodec.encode(new DeviceReply.Position2dGeometry(-0.04, 0, 0, 0.44, 0.33));
        assertThat(Hex.text(geometry))
                .isEqualTo(hex(
                        "bfa47ae147ae147b" + "0".repeat(80) + "3fd51eb851eb851f 3fdc28f5c28f5c29" + "0".repeat(16)));
    }

    @Test
    void sonar_dataAndGeometry() throws WireException {
        data(
                """
                0100007f 00001a09 00000005 00000000 00000001 00000001 4007333333333333 00000000 00000028
                | 00000008 00000008 40a00000 40a00000 40a00000 409907c6 4031773e 3fceb517 3f91e931 3f58e111""",
                2.9,
                new DeviceData.SonarRanges(List.of(
                        5f,
                        5f,
                        5f,
                        Float.intBitsToFloat(0x409907c6),
                        Float.intBitsToFloat(0x4031773e),
                        Float.intBitsToFloat(0x3fceb517),
                        Float.intBitsToFloat(0x3f91e931),
                        Float.intBitsToFloat(0x3f58e111))));
        assertThat(Hex.text(ReplyCodec.encode(new DeviceReply.SonarGeometry(
                        List.of(new DeviceReply.SonarMount(0.075, 0.130, StrictMath.PI / 2))))))
                .isEqualTo(hex(
                        "00000001 00000001 3fb3333333333333 3fc0a3d70a3d70a4" + "0".repeat(48) + "3ff921fb54442d18"));
    }

    @Test
    void laser_data() throws WireException {
        String ranges = "41000000".repeat(19);
        String payload = "bfc90fdb 3fc90fdb 3e2950b8 41000000 00000013 00000013" + ranges + "00000013 00000013"
                + "01".repeat(19) + "00 0000000a";
        var scan = (DeviceData.LaserScan)
                DataCodec.decode(6, 1, Hex.bytes(payload)).orElseThrow();
        assertThat(scan.minAngleRad()).isEqualTo((float) (-StrictMath.PI / 2));
        assertThat(scan.maxRangeM()).isEqualTo(8);
        assertThat(scan.rangesM()).hasSize(19).containsOnly(8f);
        assertThat(scan.intensities()).hasSize(19).containsOnly((byte) 1);
        assertThat(scan.scanId()).isEqualTo(10);
        assertThat(Hex.text(DataCodec.encode(scan).payload())).isEqualTo(hex(payload));
    }

    @Test
    void blobfinder_data() throws WireException {
        data("""
                0100007f 00001a09 00000007 00000000 00000001 00000001 400ccccccccccccd 00000000 00000010
                | 00000000 00000000 00000000 00000000""", 3.6, new DeviceData.Blobs(0, 0, List.of()));
        assertThat(DataCodec.encode(new DeviceData.Blobs(
                                80, 60, List.of(new DeviceData.Blob(0, 0xFF0000, 20, 5, 6, 3, 7, 4, 8, 1.5f))))
                        .payload())
                .hasSize(56);
    }

    @Test
    void quirksOfRealClients_areUnderstood() throws WireException {
        assertThat(RequestCodec.decode(4, 7, Hex.bytes("3ff0000000000000 4000000000000000 3fe0000000000000")))
                .isEqualTo(new DeviceRequest.SpeedPid(1, 2, 0.5f));
        request(4, 7, "3f800000 40000000 3f000000", new DeviceRequest.SpeedPid(1, 2, 0.5f));
        String config = "bf800000 3f800000 3c23d70a 41000000 3c23d70a 00000001";
        var with = (DeviceRequest.SetLaserConfiguration) RequestCodec.decode(6, 2, Hex.bytes(config + "41200000"));
        var without = (DeviceRequest.SetLaserConfiguration) RequestCodec.decode(6, 2, Hex.bytes(config));
        assertThat(with.configuration().frequencyHz()).isEqualTo(10);
        assertThat(without.configuration().frequencyHz()).isZero();
        assertThat(without.configuration().intensities()).isTrue();
        assertThat(RequestCodec.decode(7, 2, Hex.bytes("00000001 00000002 00000003 00000004 00000000 00000000")))
                .isEqualTo(new DeviceRequest.SetImager(1, 2, 3, 4));
        assertThat(RequestCodec.decode(5, 1, new byte[392])).isEqualTo(new DeviceRequest.Geometry());
        assertThat(RequestCodec.decode(62, 5, new byte[56])).isEqualTo(new DeviceRequest.GetConfiguration());
    }

    @Test
    void simulationPose_hasItsNameWithNul() throws WireException {
        request(
                31,
                2,
                "00000003 00000003 72310000 3ff0000000000000 4000000000000000 3fe0000000000000",
                new DeviceRequest.SetPose("r1", 1, 2, 0.5));
        assertThat(ReplyCodec.decode(
                        31,
                        MessageType.ACK,
                        1,
                        Hex.bytes("00000003 00000003 72310000 3ff0000000000000 4000000000000000 3fe0000000000000")))
                .isEqualTo(new DeviceReply.ModelPose("r1", 1, 2, 0.5));
    }
}
