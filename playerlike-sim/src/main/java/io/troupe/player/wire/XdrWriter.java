package io.troupe.player.wire;

import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.util.Arrays;
import java.util.List;
import java.util.function.BiConsumer;

/** Writes a payload in Player's variant of XDR; the inverse of {@link XdrReader}. */
final class XdrWriter {
    private ByteBuffer bytes = ByteBuffer.allocate(64);

    private ByteBuffer room(int size) {
        if (bytes.remaining() < size) {
            int wanted = Math.max(2 * bytes.capacity(), bytes.position() + size);
            bytes = ByteBuffer.allocate(wanted).put(bytes.flip());
        }
        return bytes;
    }

    /** Also writes smaller integer types, widened to 32 bits. */
    XdrWriter int32(int value) {
        room(4).putInt(value);
        return this;
    }

    XdrWriter bool(boolean value) {
        return int32(value ? 1 : 0);
    }

    XdrWriter float32(float value) {
        room(4).putFloat(value);
        return this;
    }

    XdrWriter float64(double... values) {
        for (double value : values) {
            room(8).putDouble(value);
        }
        return this;
    }

    <T> XdrWriter array(List<T> elements, BiConsumer<XdrWriter, T> element) {
        int32(elements.size()).int32(elements.size());
        elements.forEach(each -> element.accept(this, each));
        return this;
    }

    XdrWriter opaque(byte[] content) {
        int32(content.length).int32(content.length);
        int padding = -content.length & 3;
        room(content.length + padding).put(content).put(new byte[padding]);
        return this;
    }

    /** Includes the terminating NUL. */
    XdrWriter string(String text) {
        byte[] content = text.getBytes(StandardCharsets.UTF_8);
        return opaque(Arrays.copyOf(content, content.length + 1));
    }

    byte[] bytes() {
        return Arrays.copyOf(bytes.array(), bytes.position());
    }
}
