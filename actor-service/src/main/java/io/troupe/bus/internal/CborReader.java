package io.troupe.bus.internal;

import java.nio.ByteBuffer;
import java.nio.charset.CharacterCodingException;
import java.nio.charset.StandardCharsets;
import java.util.Arrays;

/**
 * Reads the items of CBOR (RFC 8949), also those that {@link CborWriter} does not write: indefinite lengths, half
 * floats, and tags, which are ignored. For one value.
 *
 * <p><b>Errors.</b> Bytes of any content lead to a value or to an {@link UnreadableException}. A length is compared
 * with the bytes that are left before anything is allocated.
 */
public final class CborReader {
    private static final int INDEFINITE = 31;
    private static final int BREAK = 0xff;
    private static final int UNDEFINED = 0xf7;

    private final byte[] bytes;
    private final int end;
    private int at;
    private int level;

    public CborReader(byte[] bytes) {
        this.bytes = bytes;
        this.end = bytes.length;
    }

    private CborReader(byte[] bytes, int at) {
        this(bytes);
        this.at = at;
    }

    /** Another reader at the same place. */
    public CborReader copy() {
        return new CborReader(bytes, at);
    }

    public void expectEnd() {
        if (at != end) {
            throw new UnreadableException("expected the end, and " + (end - at) + " bytes follow");
        }
    }

    /** Called before the parts of a list, map or record are read. */
    void enter() {
        if (++level > Portable.MAX_LEVELS) {
            throw new UnreadableException("expected at most " + Portable.MAX_LEVELS + " levels of nesting");
        }
    }

    void leave() {
        level--;
    }

    /** Consumes the next item if it is null; the value undefined counts as null. */
    public boolean readNull() {
        skipTags();
        int next = peek();
        if (next == CborWriter.NULL || next == UNDEFINED) {
            at++;
            return true;
        }
        return false;
    }

    public boolean readBoolean() {
        skipTags();
        int next = peek();
        if (next != CborWriter.TRUE && next != CborWriter.FALSE) {
            throw unexpected("true or false");
        }
        at++;
        return next == CborWriter.TRUE;
    }

    public long readLong(long least, long greatest) {
        skipTags();
        int next = peek();
        int major = next >> 5;
        if (major != CborWriter.UNSIGNED && major != CborWriter.NEGATIVE) {
            throw unexpected("a whole number");
        }
        at++;
        long argument = argument(next & 31);
        long value = major == CborWriter.UNSIGNED ? argument : ~argument;
        if (argument < 0 || value < least || value > greatest) {
            throw new UnreadableException("expected a whole number from " + least + " to " + greatest + ", not "
                    + (argument < 0
                            ? (major == CborWriter.UNSIGNED ? "" : "-") + Long.toUnsignedString(argument)
                            : Long.toString(value)));
        }
        return value;
    }

    public double readDouble() {
        if (at < end - Double.BYTES && bytes[at] == (byte) CborWriter.DOUBLE) { // the usual case, without its checks
            at += 1 + Double.BYTES;
            return Double.longBitsToDouble((long) CborWriter.LONG.get(bytes, at - Double.BYTES));
        }
        skipTags();
        int next = peek();
        switch (next) {
            case CborWriter.DOUBLE -> {
                at++;
                return Double.longBitsToDouble(fixed(8));
            }
            case CborWriter.FLOAT -> {
                at++;
                return Float.intBitsToFloat((int) fixed(4));
            }
            case CborWriter.HALF -> {
                at++;
                return Float.float16ToFloat((short) fixed(2));
            }
            default -> {
                if (next >> 5 > CborWriter.NEGATIVE) {
                    throw unexpected("a number");
                }
                return readLong(Long.MIN_VALUE, Long.MAX_VALUE); // other languages write 1 for 1.0
            }
        }
    }

    public String readText() {
        skipTags();
        int next = peek();
        if (next >> 5 != CborWriter.TEXT) {
            throw unexpected("a text");
        }
        at++;
        if ((next & 31) != INDEFINITE) {
            return text(length(next & 31, 1));
        }
        var whole = new StringBuilder();
        while (!readBreak()) {
            int chunk = peek();
            if (chunk >> 5 != CborWriter.TEXT || (chunk & 31) == INDEFINITE) {
                throw unexpected("a part of a text");
            }
            at++;
            whole.append(text(length(chunk & 31, 1)));
        }
        return whole.toString();
    }

    private String text(int length) {
        int from = at;
        at += length;
        for (int i = from; i < at; i++) {
            if (bytes[i] < 0) {
                return decoded(from, length);
            }
        }
        return new String(bytes, from, length, StandardCharsets.ISO_8859_1); // ASCII: no decoding
    }

    private String decoded(int from, int length) {
        try {
            return StandardCharsets.UTF_8
                    .newDecoder()
                    .decode(ByteBuffer.wrap(bytes, from, length))
                    .toString();
        } catch (CharacterCodingException notUtf8) {
            throw new UnreadableException("expected a text in UTF-8");
        }
    }

    /**
     * Consumes the next item if it is a text of these bytes.
     *
     * @param encoded a text item as {@link CborWriter} writes it
     */
    boolean readExactly(byte[] encoded) {
        int length = encoded.length;
        if (end - at < length) {
            return false;
        }
        for (int i = 0; i < length; i++) {
            if (bytes[at + i] != encoded[i]) {
                return false;
            }
        }
        at += length;
        return true;
    }

    /** The number of elements of an array, or -1 if they end with {@link #readBreak}. */
    public int readArray() {
        skipTags();
        int next = peek();
        if (next >> 5 != CborWriter.ARRAY) {
            throw unexpected("a list");
        }
        at++;
        return (next & 31) == INDEFINITE ? -1 : length(next & 31, 1);
    }

    /** Reads the head of an array that must have that many elements. */
    void readArrayOf(int elements, String what) {
        int from = at;
        int size = readArray();
        if (size != elements) {
            at = from;
            throw new UnreadableException("expected " + what + ", not a list of "
                    + (size < 0 ? "unknown length" : size + (size == 1 ? " element" : " elements")));
        }
    }

    /** The number of entries of a map, or -1 if they end with {@link #readBreak}. */
    public int readMap() {
        skipTags();
        int next = peek();
        if (next >> 5 != CborWriter.MAP) {
            throw unexpected("a map");
        }
        at++;
        return (next & 31) == INDEFINITE ? -1 : length(next & 31, 2);
    }

    /** Consumes the end of an item of indefinite length, if it is next. */
    public boolean readBreak() {
        if (peek() == BREAK) {
            at++;
            return true;
        }
        return false;
    }

    /** Skips the next item with everything inside it. */
    public void skip() {
        skipTags();
        int next = peek();
        int major = next >> 5;
        int info = next & 31;
        if (next == BREAK) {
            throw unexpected("an item");
        }
        at++;
        switch (major) {
            case CborWriter.UNSIGNED, CborWriter.NEGATIVE -> argument(info);
            case CborWriter.BYTES, CborWriter.TEXT -> {
                if (info == INDEFINITE) {
                    skipUntilBreak();
                } else {
                    int length = length(info, 1); // advances, so that "at += length(..)" would be wrong
                    at += length;
                }
            }
            case CborWriter.ARRAY -> skipParts(info == INDEFINITE ? -1 : length(info, 1));
            case CborWriter.MAP -> skipParts(info == INDEFINITE ? -1 : 2 * length(info, 2));
            default -> skipSimple(info);
        }
    }

    /** The bytes of the next item with everything inside it. */
    byte[] readItem() {
        int from = at;
        skip();
        return Arrays.copyOfRange(bytes, from, at);
    }

    private void skipSimple(int info) {
        switch (info) {
            case 24 -> fixed(1);
            case 25 -> fixed(2);
            case 26 -> fixed(4);
            case 27 -> fixed(8);
            case 28, 29, 30 -> throw new UnreadableException("expected CBOR, not the reserved value " + info);
            default -> {} // the value is in the head
        }
    }

    private void skipParts(int parts) {
        if (parts < 0) {
            skipUntilBreak();
            return;
        }
        enter();
        for (int part = 0; part < parts; part++) {
            skip();
        }
        leave();
    }

    private void skipUntilBreak() {
        enter();
        while (!readBreak()) {
            skip();
        }
        leave();
    }

    /** What is next, in words. */
    UnreadableException unexpected(String expected) {
        return new UnreadableException("expected " + expected + ", not " + describeNext());
    }

    private String describeNext() {
        int next = bytes[at] & 0xff;
        return switch (next >> 5) {
            case CborWriter.UNSIGNED, CborWriter.NEGATIVE -> "a whole number";
            case CborWriter.BYTES -> "bytes";
            case CborWriter.TEXT -> "a text";
            case CborWriter.ARRAY -> "a list";
            case CborWriter.MAP -> "a map";
            case CborWriter.TAG -> "a tag";
            default ->
                switch (next) {
                    case CborWriter.TRUE -> "true";
                    case CborWriter.FALSE -> "false";
                    case CborWriter.NULL, UNDEFINED -> "null";
                    case CborWriter.HALF, CborWriter.FLOAT, CborWriter.DOUBLE -> "a number with a fraction";
                    case BREAK -> "an end";
                    default -> "the simple value " + (next & 31);
                };
        };
    }

    private void skipTags() {
        while (at < end && (bytes[at] & 0xe0) == CborWriter.TAG << 5) {
            int info = bytes[at++] & 31;
            argument(info);
        }
    }

    private int peek() {
        if (at >= end) {
            throw new UnreadableException("expected more, and the bytes end here");
        }
        return bytes[at] & 0xff;
    }

    /** @param bytesEach the least number of bytes of an element */
    private int length(int info, int bytesEach) {
        long length = argument(info);
        int left = end - at;
        if (length < 0 || length > left / bytesEach) {
            throw new UnreadableException(
                    "a length of " + Long.toUnsignedString(length) + " is beyond the " + left + " bytes that are left");
        }
        return (int) length;
    }

    private long argument(int info) {
        return switch (info) {
            case 24 -> fixed(1);
            case 25 -> fixed(2);
            case 26 -> fixed(4);
            case 27 -> fixed(8);
            case 28, 29, 30, 31 -> throw new UnreadableException("expected CBOR, not the reserved value " + info);
            default -> info;
        };
    }

    /** @param length 1, 2, 4 or 8 */
    private long fixed(int length) {
        if (end - at < length) {
            throw new UnreadableException("expected more, and the bytes end here");
        }
        int from = at;
        at += length;
        return switch (length) {
            case Long.BYTES -> (long) CborWriter.LONG.get(bytes, from);
            case Integer.BYTES -> Integer.toUnsignedLong((int) CborWriter.INT.get(bytes, from));
            case Short.BYTES -> (bytes[from] & 0xff) << 8 | bytes[from + 1] & 0xff;
            default -> bytes[from] & 0xff;
        };
    }
}
