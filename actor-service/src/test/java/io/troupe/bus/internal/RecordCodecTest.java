package io.troupe.bus.internal;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.tools.Thorough;
import java.lang.management.ManagementFactory;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.HexFormat;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Random;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** Values as CBOR: golden bytes, round trips, versions, and bytes of any content. */
@Timeout(120)
class RecordCodecTest {
    private static final HexFormat HEX = HexFormat.of();

    private final RecordCodec codec = new RecordCodec();

    record Velocity(double x, double turn) {}

    record Numbers(byte b, short s, int i, long l, float f, double d, char c, boolean t) {}

    record Boxes(
            @Nullable Byte b,
            @Nullable Short s,
            @Nullable Integer i,
            @Nullable Long l,
            @Nullable Float f,
            @Nullable Double d,
            @Nullable Character c,
            @Nullable Boolean t) {}

    enum Side {
        LEFT,
        RIGHT {
            @Override
            public String toString() {
                return "right";
            }
        }
    }

    sealed interface Shape permits Circle, Polygon, Side2 {}

    record Circle(double radius) implements Shape {}

    sealed interface Polygon extends Shape permits Square, Outline {}

    record Square(double side) implements Polygon {}

    record Outline(List<Velocity> points) implements Polygon {}

    enum Side2 implements Shape {
        FRONT,
        BACK
    }

    record Everything(
            @Nullable String text,
            Side side,
            Duration time,
            Instant at,
            Optional<String> perhaps,
            Optional<Optional<Integer>> twice,
            List<Double> numbers,
            Map<String, List<Shape>> shapes,
            @Nullable Everything inner) {}

    private static final Everything LEAF = new Everything(
            null,
            Side.LEFT,
            Duration.ofMillis(-1),
            Instant.MIN,
            Optional.empty(),
            Optional.empty(),
            List.of(),
            Map.of(),
            null);

    private static final Everything VALUE = new Everything(
            "Grüße, 世界 \uD83E\uDD16",
            Side.RIGHT,
            Duration.ofSeconds(Long.MAX_VALUE, 999_999_999),
            Instant.MAX,
            Optional.of(""),
            Optional.of(Optional.empty()),
            List.of(0.1, Double.NaN, Double.NEGATIVE_INFINITY, -0.0, 0x1p-149, Double.MIN_VALUE),
            Map.of("a", List.of(new Circle(1), new Square(2), new Outline(List.of(new Velocity(3, 4))), Side2.BACK)),
            LEAF);

    @ParameterizedTest
    @CsvSource({
        "0.5, -1.5, a26178fa3f000000 647475726e fabfc00000",
        "0.1, 3,    a26178fb3fb999999999999a 647475726e fa40400000",
    })
    void record_isAMapOfItsComponents_withShortNumbers(double x, double turn, String bytes) {
        var value = new Velocity(x, turn);
        assertThat(HEX.formatHex(codec.encode(value))).isEqualTo(bytes.replace(" ", ""));
        assertThat(codec.decode(codec.encode(value), Velocity.class)).isEqualTo(value);
    }

    @Test
    void valuesOfEveryType_comeBackEqual() {
        List<Record> values = List.of(
                VALUE,
                new Numbers(
                        Byte.MIN_VALUE,
                        Short.MAX_VALUE,
                        Integer.MIN_VALUE,
                        Long.MIN_VALUE,
                        0.1f,
                        1e300,
                        '\uD83E',
                        true),
                new Numbers((byte) 23, (short) 24, 255, 256, Float.NaN, 65_536, 'a', false),
                new Boxes((byte) -24, (short) -25, -256, -257L, -0f, 4_294_967_296.0, 'b', false),
                new Boxes(null, null, null, null, null, null, null, null));
        for (Record value : values) {
            assertThat((Record) codec.decode(codec.encode(value), value.getClass()))
                    .isEqualTo(value);
        }
    }

    @Test
    void decodedListsAndMaps_areImmutable() {
        var value = codec.decode(codec.encode(VALUE), Everything.class);
        assertThatThrownBy(() -> value.numbers().set(0, 1.0)).isInstanceOf(UnsupportedOperationException.class);
        assertThatThrownBy(() -> value.shapes().clear()).isInstanceOf(UnsupportedOperationException.class);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "another order         | a2 647475726e 02 6178 01",
                "unknown entries       | a4 6178 01 6166 9f 01 a1 61 61 f6 5f 41 01 ff ff 647475726e 02 617a c1 fb 0000000000000000",
                "half floats and tags  | a2 6178 c1 f93c00 647475726e d9 0101 f94000",
                "an indefinite map     | bf 6178 01 647475726e 02 ff",
                "a text in parts       | a2 7f 61 78 ff 01 7f 62 7475 62 726e ff 02",
            })
    void whatOtherLibrariesWrite_isRead(String what, String bytes) {
        assertThat(codec.decode(HEX.parseHex(bytes.replace(" ", "")), Velocity.class))
                .as(what)
                .isEqualTo(new Velocity(1, 2));
    }

    record Newer(double x, double turn, Optional<String> why, Optional<Integer> count) {}

    record NewerStill(double x, double turn, String why, int count) {}

    record Opaque(CborItem item, int after) {}

    record Text(String text) {}

    @Test
    void item_isWrittenAsWhatItHolds_andReadAsItsBytes_alsoWithLongTexts() {
        var text = new CborWriter(10);
        codec.write(Text.class, new Text("x".repeat(300)), text);
        var item = CborItem.of(text);
        var copy = codec.decode(codec.encode(new Opaque(item, 7)), Opaque.class);
        assertThat(copy).isEqualTo(new Opaque(item, 7)).hasSameHashCodeAs(new Opaque(item, 7));
        assertThat(codec.read(Text.class, copy.item().reader())).isEqualTo(new Text("x".repeat(300)));
        var none = new CborWriter(1);
        none.writeNull();
        assertThat(codec.decode(codec.encode(new Opaque(CborItem.of(none), 8)), Opaque.class))
                .isEqualTo(new Opaque(CborItem.of(none), 8));
    }

    @Test
    void unknownEntry_withALongTextOrBytes_isSkipped() {
        for (int length : new int[] {23, 24, 255, 256, 70_000}) {
            var out = new CborWriter(10);
            out.writeMap(3);
            out.writeText("text");
            out.writeText("x".repeat(length));
            out.writeText("bytes");
            out.writeRaw(bytesItem(length));
            out.writeText("radius");
            out.writeDouble(2);
            assertThat(codec.decode(out.toBytes(), Circle.class)).isEqualTo(new Circle(2));
        }
    }

    private static byte[] bytesItem(int length) {
        var text = new CborWriter(10);
        text.writeText("x".repeat(length));
        byte[] item = text.toBytes();
        item[0] ^= (CborWriter.TEXT ^ CborWriter.BYTES) << 5; // the major type
        return item;
    }

    @Test
    void versions_unknownIsSkipped_missingOptionalIsEmpty_otherMissingIsRefusedByName() {
        byte[] newer = codec.encode(new NewerStill(1, 2, "test", 3));
        assertThat(codec.decode(newer, Velocity.class)).isEqualTo(new Velocity(1, 2));
        byte[] older = codec.encode(new Velocity(1, 2));
        assertThat(codec.decode(older, Newer.class)).isEqualTo(new Newer(1, 2, Optional.empty(), Optional.empty()));
        assertThatThrownBy(() -> codec.decode(older, NewerStill.class))
                .isInstanceOf(UnreadableException.class)
                .hasMessage("NewerStill: expected a NewerStill, and why, count are missing");
    }

    record Positive(int value) {
        Positive {
            if (value <= 0) {
                throw new IllegalArgumentException("value is " + value + ", expected more than 0");
            }
        }
    }

    record Nested(List<Positive> values, Optional<Shape> shape, Map<String, Byte> bytes) {}

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "a0     | Nested: expected a Nested, and values, bytes are missing",
                "80     | Nested: expected a map, not a list",
                "a1 6676616c756573 a0 | Nested.values: expected a list, not a map",
                "a1 6676616c756573 82 a1 6576616c7565 01 a1 6576616c7565 63616263 | Nested.values[1].value: expected a whole number, not a text",
                "a1 6676616c756573 81 a1 6576616c7565 20 | Nested.values[0]: expected a Positive, which rejects its values: java.lang.IllegalArgumentException: value is -1, expected more than 0",
                "a1 6676616c756573 81 a1 6576616c7565 1b ffffffffffffffff | Nested.values[0].value: expected a whole number from -2147483648 to 2147483647, not 18446744073709551615",
                "a1 657368617065 82 6454657374 f6 | Nested.shape: expected one of Circle, Square, Outline, Side2, not \"Test\"",
                "a1 657368617065 82 655369646532 62 c328 | Nested.shape(Side2): expected a text in UTF-8",
                "a1 657368617065 83 01 02 03 | Nested.shape: expected [name, value], not a list of 3 elements",
                "a1 656279746573 a2 6161 01 6161 02 | Nested.bytes{\"a\"}: expected each key once",
                "a1 656279746573 a1 6161 1880 | Nested.bytes{\"a\"}: expected a whole number from -128 to 127, not 128",
                "a2 656279746573 a0 656279746573 a0 | Nested.bytes: expected each component once",
                "a1 6676616c756573 9a 7fffffff | Nested.values: a length of 2147483647 is beyond the 0 bytes that are left",
                "bf | Nested: expected more, and the bytes end here",
                "a1 617a 1f | Nested: expected CBOR, not the reserved value 31",
                "a3 6676616c756573 80 656279746573 a0 657368617065 f6 00 | expected the end, and 1 bytes follow",
            })
    void bytesOfAnotherShape_areRefused_namingThePlaceAndWhatWasExpected(String bytes, String message) {
        assertThatThrownBy(() -> codec.decode(HEX.parseHex(bytes.replace(" ", "")), Nested.class))
                .isInstanceOf(UnreadableException.class)
                .hasMessage(message);
    }

    record Chain(@Nullable Chain next) {}

    @Test
    void nesting_isLimited_whenReadAndWhenSkipped() {
        Chain chain = null;
        for (int level = 0; level < Portable.MAX_LEVELS; level++) {
            chain = new Chain(chain);
        }
        assertThat(codec.decode(codec.encode(chain), Chain.class)).isEqualTo(chain);
        byte[] deeper = codec.encode(new Chain(chain));
        assertThatThrownBy(() -> codec.decode(deeper, Chain.class))
                .isInstanceOf(UnreadableException.class)
                .hasMessageContaining("..")
                .hasMessageEndingWith("expected at most 500 levels of nesting");
        byte[] skipped = new byte[1_000_000];
        Arrays.fill(skipped, (byte) 0x81);
        System.arraycopy(HEX.parseHex("a1617a"), 0, skipped, 0, 3);
        assertThatThrownBy(() -> codec.decode(skipped, Chain.class))
                .isInstanceOf(UnreadableException.class)
                .hasMessageEndingWith("expected at most 500 levels of nesting");
    }

    static final class One {
        record Same() implements Twins {}
    }

    static final class Other {
        record Same() implements Twins {}
    }

    sealed interface Twins permits One.Same, Other.Same {}

    record Family(Twins twins) {}

    @Test
    void valuesThatBytesCannotExpress_areRefused() {
        assertThatThrownBy(() -> codec.encode(new Family(new One.Same())))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageEndingWith("expected one class for each simple name");
        assertThatThrownBy(() -> codec.encode(new Newer(1, 2, Optional.of("\uD83E"), Optional.empty())))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("a text in it has half a surrogate pair, expected Unicode characters");
    }

    /** Mutated bytes never hang, never allocate beyond a multiple of their length, and throw one exception only. */
    @Test
    void fuzz_mutatedBytes_areReadOrRefused() {
        long seed = 20_261_123;
        var random = new Random(seed);
        byte[] original = codec.encode(VALUE);
        int read = 0;
        int refused = 0;
        for (int round = 0; round < Thorough.times(10_000, 100_000); round++) {
            byte[] bytes = mutated(original, random);
            try {
                assertThat(codec.decode(bytes, Everything.class)).isNotNull();
                read++;
            } catch (UnreadableException expected) {
                refused++;
            } catch (Throwable other) {
                throw new AssertionError("seed " + seed + ", round " + round + ": " + HEX.formatHex(bytes), other);
            }
        }
        assertThat(read).as("read, of which seed %d", seed).isGreaterThan(Thorough.times(100, 1_000));
        assertThat(refused).as("refused, of which seed %d", seed).isGreaterThan(Thorough.times(100, 1_000));
    }

    /** Each list claims as many elements as there are bytes behind it, and has one: the next list. */
    @Test
    void listsThatClaimMoreThanTheyHave_allocateWhatTheyHave() {
        var size = 100_000;
        var bytes = new byte[size];
        var at = 0;
        var name = "children".getBytes(StandardCharsets.US_ASCII);
        for (int level = 0; level < 120; level++) {
            bytes[at++] = (byte) 0xa1; // a map of one entry
            bytes[at++] = (byte) (0x60 | name.length);
            System.arraycopy(name, 0, bytes, at, name.length);
            at += name.length;
            bytes[at++] = (byte) 0x9a; // a list, its size in four bytes
            ByteBuffer.wrap(bytes).putInt(at, size - at - Integer.BYTES);
            at += Integer.BYTES;
        }
        var threads = (com.sun.management.ThreadMXBean) ManagementFactory.getThreadMXBean();
        assertThatThrownBy(() -> codec.decode(bytes, Tree.class)).isInstanceOf(UnreadableException.class);
        long before = threads.getCurrentThreadAllocatedBytes();
        assertThatThrownBy(() -> codec.decode(bytes, Tree.class)).isInstanceOf(UnreadableException.class);
        assertThat(threads.getCurrentThreadAllocatedBytes() - before).isLessThan(20L * size);
    }

    record Tree(List<Tree> children) {}

    @Test
    void listOfAnyLength_isReadAsItWas() {
        for (var size : List.of(0, 1, 63, 64, 65, 127, 128, 129, 1_000)) {
            var tree = new Tree(Collections.nCopies(size, new Tree(List.of())));
            assertThat(codec.decode(codec.encode(tree), Tree.class)).isEqualTo(tree);
        }
    }

    private static byte[] mutated(byte[] original, Random random) {
        byte[] bytes =
                random.nextInt(4) == 0 ? Arrays.copyOf(original, random.nextInt(original.length)) : original.clone();
        for (int change = random.nextInt(4); change >= 0 && bytes.length > 0; change--) {
            bytes[random.nextInt(bytes.length)] = (byte) random.nextInt(256);
        }
        return bytes;
    }

    /** Random values of random shapes. */
    @Test
    void property_randomValues_comeBackEqual() {
        long seed = new Random().nextLong();
        var random = new Random(seed);
        for (int round = 0; round < Thorough.times(500, 5_000); round++) {
            var value = random(random, 0);
            assertThat(codec.decode(codec.encode(value), Everything.class))
                    .as("seed %d, round %d", seed, round)
                    .isEqualTo(value);
        }
    }

    private static Everything random(Random random, int level) {
        var numbers = new ArrayList<Double>();
        for (int i = random.nextInt(40); i > 0; i--) {
            numbers.add(random.nextBoolean() ? random.nextGaussian() : Double.longBitsToDouble(random.nextLong()));
        }
        List<Shape> shapes =
                new ArrayList<>(List.of(new Circle(random.nextFloat()), Side2.FRONT, new Outline(List.of())));
        Collections.shuffle(shapes, random);
        return new Everything(
                random.nextInt(3) == 0 ? null : text(random),
                Side.values()[random.nextInt(2)],
                Duration.ofSeconds(random.nextLong(), random.nextInt(1_000_000_000)),
                Instant.ofEpochSecond(random.nextInt(), random.nextInt(1_000_000_000)),
                random.nextBoolean() ? Optional.empty() : Optional.of(text(random)),
                random.nextBoolean() ? Optional.of(Optional.of(random.nextInt())) : Optional.empty(),
                numbers,
                Map.of(text(random), shapes),
                random.nextInt(3) == 0 || level > 20 ? null : random(random, level + 1));
    }

    private static String text(Random random) {
        var text = new StringBuilder();
        for (int i = random.nextInt(300); i > 0; i--) {
            text.appendCodePoint(random.nextInt(10) > 0 ? ' ' + random.nextInt(95) : 0xa0 + random.nextInt(0xd000));
        }
        return text.toString();
    }
}
