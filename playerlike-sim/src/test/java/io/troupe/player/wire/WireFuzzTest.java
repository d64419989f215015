package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import com.sun.management.ThreadMXBean;
import java.io.ByteArrayInputStream;
import java.io.EOFException;
import java.io.IOException;
import java.lang.management.ManagementFactory;
import java.nio.ByteBuffer;
import java.util.Arrays;
import java.util.List;
import java.util.Random;
import org.junit.jupiter.api.Test;

/**
 * Damaged bytes cause a {@link WireException} and nothing else. {@code -Dwire.fuzz=1000000} sets the number of
 * attempts, {@code -Dwire.seed=7} the seed.
 */
class WireFuzzTest {
    private static final int CASES = Integer.getInteger("wire.fuzz", 200_000);
    private static final long SEED = Long.getLong("wire.seed", 1);
    private static final int[] CODES = {1, 4, 5, 6, 7, 31, 62, 10};
    private static final int[] COUNTS = {0, 1, 2, 8, 1 << 16, 1 << 28, 1 << 30, Integer.MAX_VALUE, 1 << 31, -1};

    private final ThreadMXBean threads = (ThreadMXBean) ManagementFactory.getThreadMXBean();
    private final Random random = new Random(SEED);
    /** The payloads of real messages of all kinds. */
    private final List<byte[]> payloads = new RandomMessages(random)
            .all().stream().map(each -> each.encoded().payload()).toList();

    /** Decodes a payload in every way in which it could arrive; returns how many attempts were rejected. */
    private static int decode(int code, int subtype, byte[] payload) {
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
                refused += decode(code, subtype, payload);
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
        decode(5, 1, Hex.bytes("80000000 80000000 00000000")); // loads the classes
        long before = threads.getCurrentThreadAllocatedBytes();
        for (int count : COUNTS) {
            byte[] payload = ByteBuffer.allocate(12).putInt(count).putInt(count).array();
            for (int code : CODES) {
                for (int subtype = 0; subtype < 11; subtype++) {
                    decode(code, subtype, payload);
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
}
