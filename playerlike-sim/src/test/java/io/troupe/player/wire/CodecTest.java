package io.troupe.player.wire;

import static java.util.Collections.nCopies;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import com.sun.management.ThreadMXBean;
import io.troupe.tools.Thorough;
import java.io.ByteArrayInputStream;
import java.io.EOFException;
import java.io.IOException;
import java.lang.management.ManagementFactory;
import java.nio.ByteBuffer;
import java.util.Arrays;
import java.util.List;
import java.util.Random;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.MethodSource;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * Messages of real clients and servers, byte for byte; random messages, which must come back as they were; and damaged
 * bytes. {@code -Dwire.fuzz=1000000} sets the number of damaged payloads, {@code -Dwire.seed=7} their seed.
 */
class CodecTest {
    private static final int SEEDS = Thorough.times(100, 300);
    private static final int CASES = Integer.getInteger("wire.fuzz", Thorough.times(20_000, 200_000));
    private static final long SEED = Long.getLong("wire.seed", 1);
    private static final int[] CODES = {1, 4, 5, 6, 7, 31, 62, 10, 14, 3, 40};
    private static final int[] COUNTS = {0, 1, 2, 8, 1 << 16, 1 << 28, 1 << 30, Integer.MAX_VALUE, 1 << 31, -1};

    /** The content of a message that has arrived. */
    static Object decode(MessageType type, int code, int subtype, byte[] payload) throws WireException {
        boolean player = code == PlayerRequest.INTERFACE;
        return switch (type) {
            case DATA -> DataCodec.decode(code, subtype, payload).orElseThrow();
            case CMD -> CommandCodec.decode(code, subtype, payload).orElseThrow();
            case REQ ->
                player ? PlayerDeviceCodec.request(subtype, payload) : RequestCodec.decode(code, subtype, payload);
            case ACK, NACK ->
                player
                        ? PlayerDeviceCodec.reply(type, subtype, payload)
                        : ReplyCodec.decode(code, type, subtype, payload);
            case SYNCH -> PlayerDeviceCodec.dropped(subtype, payload);
        };
    }

    /** @param subtype that of the request, which a reply has too; otherwise without effect */
    static Content encode(int code, int subtype, Object content) {
        return switch (content) {
            case DeviceData data -> DataCodec.encode(data);
            case DeviceCommand command -> CommandCodec.encode(command);
            case DeviceRequest request -> RequestCodec.encode(code, request);
            case DeviceReply reply -> new Content(subtype, ReplyCodec.encode(reply));
            case PlayerRequest request -> PlayerDeviceCodec.encode(request);
            case PlayerReply reply -> new Content(subtype, PlayerDeviceCodec.encode(reply));
            case Integer dropped -> PlayerDeviceCodec.synch(dropped);
            default -> throw new AssertionError(content);
        };
    }

    private static MessageType type(Object content) {
        return switch (content) {
            case DeviceData data -> MessageType.DATA;
            case DeviceCommand command -> MessageType.CMD;
            case DeviceReply reply -> ReplyCodec.type(reply);
            case PlayerReply reply -> PlayerDeviceCodec.type(reply);
            case Integer dropped -> MessageType.SYNCH;
            default -> MessageType.REQ;
        };
    }

    private static void assertBothWays(int code, int subtype, byte[] payload, Object content) throws WireException {
        assertThat(decode(type(content), code, subtype, payload)).isEqualTo(content);
        Content encoded = encode(code, subtype, content);
        assertThat(encoded.subtype()).as("%s", content).isEqualTo(subtype);
        assertThat(Hex.text(encoded.payload())).as("%s", content).isEqualTo(Hex.text(payload));
    }

    private static DeviceAddress at(int code) {
        return new DeviceAddress(TcpServer.LOOPBACK_HOST, 6665, code, 0);
    }

    // ---- messages of real clients and servers

    /** @param timeSeconds NaN for the time of a client, which ours does not send */
    private record Golden(Object content, double timeSeconds, String hex) {}

    static List<Golden> goldenMessages() {
        int[] bits = {0x40a00000, 0x40a00000, 0x40a00000, 0x409907c6, 0x4031773e, 0x3fceb517, 0x3f91e931, 0x3f58e111};
        var ranges = IntStream.of(bits).mapToObj(Float::intBitsToFloat).toList();
        return List.of(
                new Golden(new PlayerRequest.DataMode(Delivery.PULL), Double.NaN, """
                        00000000 00000000 00000001 00000000 00000003 00000005 41dac04347905a32 00000000 00000004
                        | 00000002"""),
                new Golden(new PlayerReply.Ack(), 1.7, """
                        0100007f 00001a09 00000001 00000000 00000004 00000005 3ffb333333333333 00000000 00000000"""),
                new Golden(new PlayerRequest.DeviceList(), Double.NaN, """
                        00000000 00000000 00000001 00000000 00000003 00000001 41dac0434797a609 00000000 00000000"""),
                new Golden(new PlayerReply.DeviceList(List.of(at(31), at(4), at(7), at(5), at(6))), 1.8, """
                        0100007f 00001a09 00000001 00000000 00000004 00000001 3ffccccccccccccd 00000000 00000058
                        | 00000005 00000005 0100007f 00001a09 0000001f 00000000 0100007f 00001a09 00000004 00000000
                        0100007f 00001a09 00000007 00000000 0100007f 00001a09 00000005 00000000
                        0100007f 00001a09 00000006 00000000"""),
                new Golden(new PlayerRequest.DriverInfo(at(31)), Double.NaN, """
                        00000000 00000000 00000001 00000000 00000003 00000002 0000000000000000 00000000 00000018
                        | 0100007f 00001a09 0000001f 00000000 00000000 00000000"""),
                new Golden(new PlayerReply.DriverInfo(at(31), "stage"), 0, """
                        0100007f 00001a09 00000001 00000000 00000004 00000002 0000000000000000 00000000 00000020
                        | 0100007f 00001a09 0000001f 00000000 00000006 00000006 73746167 65000000"""),
                new Golden(
                        new PlayerRequest.Access(new DeviceAddress(0, 0, 4, 0), PlayerRequest.OPEN), Double.NaN, """
                        00000000 00000000 00000001 00000000 00000003 00000003 41dac04347a4fcc6 00000000 0000001c
                        | 00000000 00000000 00000004 00000000 00000001 00000000 00000000"""),
                new Golden(new PlayerReply.Access(at(4), PlayerRequest.OPEN, "stage"), 2, """
                        0100007f 00001a09 00000001 00000000 00000004 00000003 4000000000000000 00000000 00000024
                        | 0100007f 00001a09 00000004 00000000 00000001 00000006 00000006 73746167 65000000"""),
                new Golden(new PlayerRequest.NextData(), Double.NaN, """
                        00000000 00000000 00000001 00000000 00000003 00000004 41dac04347b36bca 00000000 00000000"""),
                new Golden(new PlayerReply.Ack(), 2.2, """
                        0100007f 00001a09 00000001 00000000 00000004 00000004 400199999999999a 00000000 00000000"""),
                new Golden(0, 0, """
                        00000000 00000000 00000001 00000000 00000005 00000001 0000000000000000 00000000 00000000"""),
                new Golden(new DeviceData.Position2d(0, -5, 0, 0, 0, 0, false), 15.3, """
                        0100007f 00001a09 00000004 00000000 00000001 00000001 402e99999999999a 00000000 00000034
                        | 0000000000000000 c014000000000000 0000000000000000 0000000000000000 0000000000000000
                        0000000000000000 00000000"""),
                new Golden(new DeviceCommand.Velocity(0.2, 0, 0.1, true), Double.NaN, """
                        00000000 00001a09 00000004 00000000 00000002 00000001 41dac04347b36a55 00000000 0000001c
                        | 3fc999999999999a 0000000000000000 3fb999999999999a 00000001"""),
                new Golden(new DeviceData.SonarRanges(ranges), 2.9, """
                        0100007f 00001a09 00000005 00000000 00000001 00000001 4007333333333333 00000000 00000028
                        | 00000008 00000008 40a00000 40a00000 40a00000 409907c6 4031773e 3fceb517 3f91e931 3f58e111"""),
                new Golden(new DeviceData.Blobs(0, 0, List.of()), 3.6, """
                        0100007f 00001a09 00000007 00000000 00000001 00000001 400ccccccccccccd 00000000 00000010
                        | 00000000 00000000 00000000 00000000"""));
    }

    @ParameterizedTest
    @MethodSource("goldenMessages")
    void goldenMessage_isDecoded_andEncodedByteForByte(Golden golden) throws WireException {
        WireMessage message = Hex.message(Hex.bytes(golden.hex));
        Header header = message.header();
        assertThat(header.type()).isEqualTo(type(golden.content));
        if (header.type() == MessageType.ACK || header.type() == MessageType.DATA) {
            assertThat(header.address()).isEqualTo(at(header.address().interfaceCode()));
        }
        assertBothWays(header.address().interfaceCode(), header.subtype(), message.payload(), golden.content);
        if (!Double.isNaN(golden.timeSeconds)) {
            var made = WireMessage.of(
                    header.address(), header.type(), header.subtype(), golden.timeSeconds, message.payload());
            assertThat(Hex.text(made.bytes())).isEqualTo(Hex.text(Hex.bytes(golden.hex)));
        }
    }

    private record Payload(int code, int subtype, String hex, Object content) {}

    static List<Payload> goldenPayloads() {
        double vx = Double.longBitsToDouble(0x3fd3d49300000000L);
        double va = Double.longBitsToDouble(0x3fed0d87e0000000L);
        String zero = "0".repeat(16);
        String pose = "3ff0000000000000 4000000000000000 3fe0000000000000";
        String stage = "00000006 00000006 73746167 65000000";
        String r1 = "00000003 00000003 72310000";
        String scan = "bfc90fdb 3fc90fdb 3e2950b8 41000000 00000013 00000013" + "41000000".repeat(19)
                + "00000013 00000013" + "01".repeat(19) + "00 0000000a";
        float quarter = (float) (StrictMath.PI / 2);
        float step = Float.intBitsToFloat(0x3e2950b8);
        var close = new PlayerRequest.Access(new DeviceAddress(0, 0, 5, 0), PlayerRequest.CLOSE);
        var closed = new PlayerReply.Access(at(5), PlayerRequest.CLOSE, "stage");
        var body = new DeviceReply.Position2dGeometry(-0.04, 0, 0, 0.44, 0.33);
        var velocity = new DeviceCommand.Velocity(vx, 0, va, true);
        var backwards = new DeviceCommand.Velocity(-0.2, 0, 0, false); // the state of a command may be zero
        var going = new DeviceCommand.GoTo(1, 0, 0, 0, 0, 0, false);
        String mount = "00000001 00000001 3fb3333333333333 3fc0a3d70a3d70a4" + zero.repeat(3) + "3ff921fb54442d18";
        var sonar = new DeviceReply.SonarMount(0.075, 0.130, StrictMath.PI / 2);
        return List.of(
                new Payload(1, 3, "00000000 00000000 00000005 00000000 00000002 00000000 00000000", close),
                new Payload(1, 3, "0100007f 00001a09 00000005 00000000 00000002" + stage, closed),
                new Payload(1, 2, "00000007", 7),
                new Payload(4, 1, "3fd3d49300000000" + zero + "3fed0d87e0000000 00000001", velocity),
                new Payload(4, 1, "bfc999999999999a" + zero.repeat(2) + "00000000", backwards),
                new Payload(4, 2, "3ff0000000000000" + zero.repeat(5) + "00000000", going),
                new Payload(4, 3, "3fb999999999999a 3fa999999999999a", new DeviceCommand.Car(0.1, 0.05)),
                new Payload(4, 2, pose + zero.repeat(3) + "00000001", new DeviceCommand.GoTo(1, 2, 0.5, 0, 0, 0, true)),
                new Payload(4, 5, pose, new DeviceRequest.SetOdometry(1, 2, 0.5)),
                new Payload(4, 2, "00000001", new DeviceRequest.Power(true)),
                new Payload(4, 1, "", new DeviceRequest.Geometry()),
                new Payload(4, 6, "", new DeviceRequest.ResetOdometry()),
                new Payload(4, 7, "3f800000 40000000 3f000000", new DeviceRequest.SpeedPid(1, 2, 0.5f)),
                new Payload(
                        4, 1, "bfa47ae147ae147b" + zero.repeat(5) + "3fd51eb851eb851f 3fdc28f5c28f5c29" + zero, body),
                new Payload(5, 1, mount, new DeviceReply.SonarGeometry(List.of(sonar))),
                new Payload(
                        6,
                        1,
                        scan,
                        new DeviceData.LaserScan(
                                -quarter, quarter, step, 8, nCopies(19, 8f), nCopies(19, (byte) 1), 10)),
                new Payload(31, 2, r1 + pose, new DeviceRequest.SetPose("r1", 1, 2, 0.5)),
                new Payload(31, 1, r1 + pose, new DeviceReply.ModelPose("r1", 1, 2, 0.5)));
    }

    @ParameterizedTest
    @MethodSource("goldenPayloads")
    void goldenPayload_isDecoded_andEncodedByteForByte(Payload golden) throws WireException {
        assertBothWays(golden.code, golden.subtype, Hex.bytes(golden.hex), golden.content);
    }

    static List<Payload> quirks() {
        String laser = "bf800000 3f800000 3c23d70a 41000000 3c23d70a 00000001";
        var with = new LaserConfiguration(-1, 1, 0.01f, 8, 0.01f, true, 10);
        var without = new LaserConfiguration(-1, 1, 0.01f, 8, 0.01f, true, 0);
        String doubles = "3ff0000000000000 4000000000000000 3fe0000000000000";
        String imager = "00000001 00000002 00000003 00000004 00000000 00000000";
        return List.of(
                new Payload(1, 1, "00000000 00000000", new PlayerRequest.DeviceList()),
                new Payload(4, 7, doubles, new DeviceRequest.SpeedPid(1, 2, 0.5f)),
                new Payload(6, 2, laser + "41200000", new DeviceRequest.SetLaserConfiguration(with)),
                new Payload(6, 2, laser, new DeviceRequest.SetLaserConfiguration(without)),
                new Payload(7, 2, imager, new DeviceRequest.SetImager(1, 2, 3, 4)),
                new Payload(5, 1, "00".repeat(392), new DeviceRequest.Geometry()),
                new Payload(62, 5, "00".repeat(56), new DeviceRequest.GetConfiguration()));
    }

    @ParameterizedTest
    @MethodSource("quirks")
    void quirkOfRealClients_isUnderstood(Payload quirk) throws WireException {
        assertThat(decode(MessageType.REQ, quirk.code, quirk.subtype, Hex.bytes(quirk.hex)))
                .isEqualTo(quirk.content);
    }

    @Test
    void refusedSubscription_ofTheRealServer_hasAPayload() throws WireException {
        WireMessage refusal = Hex.message(Hex.bytes("""
                0100007f 00001a09 00000001 00000000 00000006 00000003 400d99999999999a 00000000 0000001c
                | 0100007f 00001a09 0000003e 00000000 00000003 00000000 00000000"""));
        assertThat(refusal.header().type()).isEqualTo(MessageType.NACK);
        assertThat(refusal.header().timeSeconds()).isEqualTo(3.7);
        assertThat(decode(MessageType.NACK, 1, 3, refusal.payload())).isEqualTo(new PlayerReply.Nack());
        assertThat(PlayerDeviceCodec.encode(new PlayerReply.Nack())).isEmpty();
    }

    @Test
    void banner_is32Bytes_andEndsWithZero() {
        assertThat(Hex.text(TcpServer.banner("Player v.3.1.1-dev")))
                .isEqualTo("506c6179657220762e332e312e312d6465760000000000000000000000000000");
        assertThat(TcpServer.banner("x".repeat(40))).hasSize(32).endsWith('x', 0);
    }

    @Test
    void blob_takes40Bytes() {
        var blob = new DeviceData.Blob(0, 0xFF0000, 20, 5, 6, 3, 7, 4, 8, 1.5f);
        assertThat(DataCodec.encode(new DeviceData.Blobs(80, 60, List.of(blob))).payload())
                .hasSize(56);
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "playerprint-ranger.txt",
                "s32-playerprint-position2d.txt",
                "s32-playerprint-sonar.txt",
                "s32-playerprint-blobfinder.txt"
            })
    void capturedMessage_decodedAndEncodedAgain_isTheSame(String name) throws WireException {
        List<Hex.Line> lines = Hex.capture(name);
        assertThat(lines).hasSizeGreaterThan(9);
        assertThat(Hex.text(lines.getFirst().bytes()))
                .as("banner")
                .isEqualTo(Hex.text(TcpServer.banner("Player v.3.1.1-dev")));
        for (var line : lines.subList(1, lines.size())) {
            WireMessage message = line.message();
            assertThat(Hex.text(message.bytes())).as("header of %s", message).isEqualTo(Hex.text(line.bytes()));
            int code = message.header().address().interfaceCode();
            int subtype = message.header().subtype();
            Content again = encode(code, subtype, decode(message.header().type(), code, subtype, message.payload()));
            assertThat(Hex.text(again.payload())).as("payload of %s", message).isEqualTo(Hex.text(message.payload()));
            assertThat(again.subtype()).isEqualTo(subtype);
        }
    }

    // ---- random messages

    @Test
    void message_ofEveryKind_comesBack() {
        for (long seed = 1; seed <= SEEDS; seed++) {
            for (var sample : new RandomMessages(new Random(seed)).all()) {
                try {
                    assertComesBack(sample);
                } catch (WireException | AssertionError | RuntimeException e) {
                    throw new AssertionError("seed " + seed + ": " + sample + ": " + e.getMessage(), e);
                }
            }
        }
    }

    private static void assertComesBack(RandomMessages.Sample sample) throws WireException {
        Content content = sample.encoded();
        MessageType type = type(sample.content());
        assertThat(decode(type, sample.address().interfaceCode(), content.subtype(), content.payload()))
                .isEqualTo(sample.content());
        assertThat(content.payload().length % 4).isZero();
        var whole = WireMessage.of(sample.address(), type, content.subtype(), sample.timeSeconds(), content.payload());
        assertThat(Hex.message(whole.bytes()).header()).isEqualTo(whole.header());
    }

    // ---- damaged bytes cause a WireException and nothing else

    private final ThreadMXBean threads = (ThreadMXBean) ManagementFactory.getThreadMXBean();
    private final Random random = new Random(SEED);
    /** The payloads of real messages of all kinds. */
    private final List<byte[]> payloads = new RandomMessages(random)
            .all().stream().map(each -> each.encoded().payload()).toList();

    /** Decodes a payload in every way in which it could arrive; returns how many attempts were rejected. */
    private static int decodeInEveryWay(int code, int subtype, byte[] payload) {
        int refused = 0;
        for (int way = 0; way < 6; way++) {
            try {
                Object decoded = switch (way) {
                    case 0 -> DataCodec.decode(code, subtype, payload);
                    case 1 -> CommandCodec.decode(code, subtype, payload);
                    case 2 -> RequestCodec.decode(code, subtype, payload);
                    case 3 -> ReplyCodec.decode(code, MessageType.ACK, subtype, payload);
                    case 4 -> PlayerDeviceCodec.request(subtype, payload);
                    default -> PlayerDeviceCodec.reply(MessageType.ACK, subtype, payload);
                };
                assertThat(decoded).isNotNull();
            } catch (WireException e) {
                refused++;
            }
        }
        return refused;
    }

    private byte[] anyPayload() {
        return payloads.get(random.nextInt(payloads.size()));
    }

    private byte[] damage(byte[] payload) {
        byte[] damaged = payload.clone();
        switch (random.nextInt(5)) {
            case 0 -> {
                damaged = new byte[random.nextInt(120)];
                random.nextBytes(damaged);
            }
            case 1 -> damaged = Arrays.copyOf(damaged, random.nextInt(damaged.length + 1));
            case 2 -> damaged = Arrays.copyOf(damaged, damaged.length + random.nextInt(40));
            case 3 -> {
                for (int flips = 1 + random.nextInt(4); flips > 0 && damaged.length > 0; flips--) {
                    damaged[random.nextInt(damaged.length)] ^= (byte) (1 << random.nextInt(8));
                }
            }
            default -> {
                if (damaged.length >= 8) { // a valid count, repeated as the format requires
                    int at = 4 * random.nextInt(damaged.length / 4 - 1);
                    int count = COUNTS[random.nextInt(COUNTS.length)];
                    ByteBuffer.wrap(damaged).putInt(at, count).putInt(at + 4, count);
                }
            }
        }
        return damaged;
    }

    @Test
    void damagedPayloads_areRefused_withWireExceptionOnly() {
        long refused = 0;
        for (int i = 0; i < CASES; i++) {
            byte[] payload = damage(anyPayload());
            int code = CODES[random.nextInt(CODES.length)];
            int subtype = random.nextInt(20) == 0 ? 255 : random.nextInt(11);
            try {
                refused += decodeInEveryWay(code, subtype, payload);
            } catch (RuntimeException e) {
                throw new AssertionError(
                        "seed " + SEED + ", case " + i + ": " + code + "/" + subtype + " " + Hex.text(payload), e);
            }
        }
        assertThat(refused).isBetween((long) CASES, 6L * CASES);
    }

    @Test
    void damagedStreams_areCutOrRefused() {
        int whole = 0;
        int refused = 0;
        for (int i = 0; i < CASES / 10; i++) {
            var to = new DeviceAddress(0, 0, 4, 0);
            var message = WireMessage.of(to, MessageType.REQ, random.nextInt(256), 1, anyPayload());
            var reader = new MessageReader(new ByteArrayInputStream(damage(message.bytes())), 4096);
            try {
                while (reader.read() != null) {
                    whole++;
                }
            } catch (WireException | EOFException e) {
                refused++;
            } catch (IOException | RuntimeException e) {
                throw new AssertionError("seed " + SEED + ", case " + i, e);
            }
        }
        assertThat(whole).isPositive();
        assertThat(refused).isPositive();
    }

    @Test
    void hugeCounts_takeNoMemory() {
        decodeInEveryWay(5, 1, Hex.bytes("80000000 80000000 00000000")); // loads the classes
        long before = threads.getCurrentThreadAllocatedBytes();
        for (int count : COUNTS) {
            byte[] payload = ByteBuffer.allocate(12).putInt(count).putInt(count).array();
            for (int code : CODES) {
                for (int subtype = 0; subtype < 11; subtype++) {
                    decodeInEveryWay(code, subtype, payload);
                }
            }
        }
        assertThat(threads.getCurrentThreadAllocatedBytes() - before)
                .as("bytes taken for %s small payloads", COUNTS.length * CODES.length * 11 * 6)
                .isLessThan(32 << 20);
    }

    @Test
    void hugeSize_isRefused_andAnnouncedBytesTakeNoMemory() {
        byte[] header = RawClient.message(MessageType.REQ, 4, 0, Content.empty(1));
        ByteBuffer.wrap(header).putInt(36, 1 << 31);
        assertThatThrownBy(() -> new MessageReader(new ByteArrayInputStream(header), 65_536).read())
                .isInstanceOf(WireException.class)
                .hasMessage("header size is 2147483648, expected 0 to 65536");
        ByteBuffer.wrap(header).putInt(36, Integer.MAX_VALUE);
        long before = threads.getCurrentThreadAllocatedBytes();
        assertThatThrownBy(() -> new MessageReader(new ByteArrayInputStream(header), Integer.MAX_VALUE).read())
                .isInstanceOf(EOFException.class);
        assertThat(threads.getCurrentThreadAllocatedBytes() - before).isLessThan(1 << 20);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            DATA | 5 | 1 | 00000002000000030000000000000000 | \
            sonar DATA 1: count of ranges is 2, then 3, expected the same twice
            DATA | 5 | 1 | 800000008000000000000000 | \
            sonar DATA 1: count of ranges is 2147483648, expected at most 1 for the 4 bytes that follow
            CMD | 4 | 3 | 000000000000000000000000 | \
            position2d CMD 3: size is 12, expected 8 bytes for angle at offset 8
            CMD | 4 | 3 | 0000000000000000000000000000000000000000 | \
            position2d CMD 3: size is 20, expected 16
            REQ | 1 | 5 | 00000009 | player REQ 5: mode is 9, expected 1 (push) or 2 (pull)
            """)
    void error_namesFieldValueAndExpectation(MessageType type, int code, int subtype, String hex, String message) {
        assertThatThrownBy(() -> decode(type, code, subtype, Hex.bytes(hex)))
                .isInstanceOf(WireException.class)
                .hasMessage(message);
    }
}
