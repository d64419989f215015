package io.troupe.bus.internal;

import java.lang.invoke.MethodHandles;
import java.lang.invoke.VarHandle;
import java.nio.ByteOrder;
import java.nio.charset.StandardCharsets;
import java.util.Arrays;

/** Writes the items of CBOR (RFC 8949): definite lengths only, each number in its shortest form. For one value. */
public final class CborWriter {
    static final int UNSIGNED = 0;
    static final int NEGATIVE = 1;
    static final int BYTES = 2;
    static final int TEXT = 3;
    static final int ARRAY = 4;
    static final int MAP = 5;
    static final int TAG = 6;
    static final int SIMPLE = 7;

    static final int FALSE = 0xf4;
    static final int TRUE = 0xf5;
    static final int NULL = 0xf6;
    static final int HALF = 0xf9;
    static final int FLOAT = 0xfa;
    static final int DOUBLE = 0xfb;

    static final VarHandle LONG = MethodHandles.byteArrayViewVarHandle(long[].class, ByteOrder.BIG_ENDIAN);
    static final VarHandle INT = MethodHandles.byteArrayViewVarHandle(int[].class, ByteOrder.BIG_ENDIAN);

    private static final int LONGEST_HEAD = 9;

    private byte[] bytes;
    private int size;

    public CborWriter(int expectedSize) {
        bytes = new byte[expectedSize];
    }

    public byte[] toBytes() {
        return Arrays.copyOf(bytes, size);
    }

    public void writeNull() {
        writeByte(NULL);
    }

    public void writeBoolean(boolean value) {
        writeByte(value ? TRUE : FALSE);
    }

    public void writeLong(long value) {
        if (value >= 0) {
            writeHead(UNSIGNED, value);
        } else {
            writeHead(NEGATIVE, ~value);
        }
    }

    /** As 32 bits if these hold the same value. */
    public void writeDouble(double value) {
        float narrow = (float) value;
        if (narrow == value || value != value) {
            writeFloat(narrow);
        } else {
            makeRoom(LONGEST_HEAD);
            bytes[size] = (byte) DOUBLE;
            LONG.set(bytes, size + 1, Double.doubleToRawLongBits(value));
            size += 1 + Double.BYTES;
        }
    }

    public void writeFloat(float value) {
        makeRoom(LONGEST_HEAD);
        bytes[size++] = (byte) FLOAT;
        INT.set(bytes, size, Float.floatToIntBits(value));
        size += Float.BYTES;
    }

    /** @throws IllegalArgumentException if the text has half a surrogate pair, which UTF-8 cannot express */
    public void writeText(String text) {
        int length = text.length();
        makeRoom(LONGEST_HEAD + length);
        int at = size + headLength(length);
        for (int i = 0; i < length; i++) {
            char character = text.charAt(i);
            if (character >= 0x80) {
                writeLongerText(text);
                return;
            }
            bytes[at + i] = (byte) character;
        }
        writeHead(TEXT, length); // does not reach the characters
        size += length;
    }

    private void writeLongerText(String text) {
        byte[] encoded = text.getBytes(StandardCharsets.UTF_8);
        if (!new String(encoded, StandardCharsets.UTF_8).equals(text)) {
            throw new IllegalArgumentException("a text in it has half a surrogate pair, expected Unicode characters");
        }
        writeHead(TEXT, encoded.length);
        writeRaw(encoded);
    }

    public void writeArray(int elements) {
        writeHead(ARRAY, elements);
    }

    public void writeMap(int entries) {
        writeHead(MAP, entries);
    }

    /** Appends items that have been encoded already. */
    public void writeRaw(byte[] items) {
        makeRoom(items.length);
        System.arraycopy(items, 0, bytes, size, items.length);
        size += items.length;
    }

    private void writeByte(int value) {
        makeRoom(1);
        bytes[size++] = (byte) value;
    }

    private static int headLength(long value) {
        return value < 24 ? 1 : value < 0x100 ? 2 : value < 0x1_0000 ? 3 : value <= 0xffff_ffffL ? 5 : 9;
    }

    private void writeHead(int major, long value) {
        makeRoom(LONGEST_HEAD);
        int first = major << 5;
        if (value >= 0 && value < 24) {
            bytes[size++] = (byte) (first | (int) value);
        } else if (value >= 0 && value < 0x100) {
            bytes[size++] = (byte) (first | 24);
            bytes[size++] = (byte) value;
        } else if (value >= 0 && value < 0x1_0000) {
            bytes[size++] = (byte) (first | 25);
            bytes[size++] = (byte) (value >> 8);
            bytes[size++] = (byte) value;
        } else if (value >= 0 && value <= 0xffff_ffffL) {
            bytes[size++] = (byte) (first | 26);
            INT.set(bytes, size, (int) value);
            size += Integer.BYTES;
        } else {
            bytes[size++] = (byte) (first | 27);
            LONG.set(bytes, size, value);
            size += Long.BYTES;
        }
    }

    private void makeRoom(int length) {
        if (bytes.length - size < length) {
            bytes = Arrays.copyOf(bytes, Math.max(2 * bytes.length, size + length));
        }
    }
}
