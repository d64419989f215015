package io.troupe.bus.internal;

import java.util.Arrays;

/**
 * One item of CBOR, encoded: a value whose type the receiver of the message around it finds out later. Among the
 * components of a record it is written as the item that it holds, not as bytes. Immutable.
 */
public final class CborItem {
    private final byte[] bytes;

    private CborItem(byte[] bytes) {
        this.bytes = bytes;
    }

    /** The one item that was written. */
    public static CborItem of(CborWriter written) {
        return new CborItem(written.toBytes());
    }

    static CborItem readFrom(CborReader in) {
        return new CborItem(in.readItem());
    }

    void writeTo(CborWriter out) {
        out.writeRaw(bytes);
    }

    /** A reader of the item. */
    public CborReader reader() {
        return new CborReader(bytes);
    }

    @Override
    public boolean equals(Object other) {
        return other instanceof CborItem item && Arrays.equals(bytes, item.bytes);
    }

    @Override
    public int hashCode() {
        return Arrays.hashCode(bytes);
    }

    @Override
    public String toString() {
        return bytes.length + " bytes of CBOR";
    }
}
