package io.troupe.view.tools;

import java.io.ByteArrayOutputStream;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.util.zip.CRC32;
import java.util.zip.Deflater;

/**
 * Writes images as PNG.
 *
 * <p><b>Source.</b> The W3C recommendation Portable Network Graphics: three chunks, and in front of each row the number
 * of its filter. Rows are differences from the row above, which are mostly 0 in images of a simulated camera.
 */
final class Png {
    private static final byte[] SIGNATURE = {(byte) 0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    private static final byte UP = 2; // filter: the difference from the row above
    private static final byte BITS = 8; // of each colour
    private static final byte RGB = 2;

    private Png() {}

    /** @param rgb rows from the top, three bytes for each pixel */
    static byte[] of(int widthPx, int heightPx, byte[] rgb) {
        int rowBytes = 3 * widthPx;
        byte[] rows = new byte[heightPx * (1 + rowBytes)];
        for (int row = 0; row < heightPx; row++) {
            int to = row * (1 + rowBytes);
            int from = row * rowBytes;
            rows[to] = UP;
            for (int i = 0; i < rowBytes; i++) {
                rows[to + 1 + i] = (byte) (rgb[from + i] - (row == 0 ? 0 : rgb[from + i - rowBytes]));
            }
        }
        ByteBuffer header = ByteBuffer.allocate(13).putInt(widthPx).putInt(heightPx);
        header.put(BITS).put(RGB); // and zeros: deflate, the five filters, not interlaced
        var png = new ByteArrayOutputStream();
        png.writeBytes(SIGNATURE);
        chunk(png, "IHDR", header.array());
        chunk(png, "IDAT", deflated(rows));
        chunk(png, "IEND", new byte[0]);
        return png.toByteArray();
    }

    private static void chunk(ByteArrayOutputStream png, String type, byte[] content) {
        byte[] name = type.getBytes(StandardCharsets.US_ASCII);
        var crc = new CRC32();
        crc.update(name);
        crc.update(content);
        png.writeBytes(ByteBuffer.allocate(12 + content.length)
                .putInt(content.length)
                .put(name)
                .put(content)
                .putInt((int) crc.getValue())
                .array());
    }

    private static byte[] deflated(byte[] bytes) {
        var deflater = new Deflater();
        try {
            deflater.setInput(bytes);
            deflater.finish();
            var packed = new ByteArrayOutputStream();
            byte[] part = new byte[4096];
            while (!deflater.finished()) {
                packed.write(part, 0, deflater.deflate(part));
            }
            return packed.toByteArray();
        } finally {
            deflater.end();
        }
    }
}
