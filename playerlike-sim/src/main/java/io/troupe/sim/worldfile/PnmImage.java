package io.troupe.sim.worldfile;

import java.io.BufferedInputStream;
import java.io.EOFException;
import java.io.IOException;
import java.io.InputStream;
import java.util.Map;

/**
 * Reads the image formats of Netpbm: black and white (P1, P4), gray (P2, P5: the maps of robots) and colours (P3, P6),
 * as text or raw, with 8 or 16 bits.
 */
final class PnmImage {
    private static final int GREATEST_VALUE = 65_535;
    private static final int LONGEST_WORD = 10;
    private static final Map<Character, Format> FORMATS = Map.of(
            '1', new Format(true, 1, true),
            '2', new Format(true, 1, false),
            '3', new Format(true, 3, false),
            '4', new Format(false, 1, true),
            '5', new Format(false, 1, false),
            '6', new Format(false, 3, false));

    /** @param bits each pixel is a bit, and 1 is black */
    private record Format(boolean text, int channels, boolean bits) {}

    private final InputStream in;
    private final Format format;
    private final int width;
    private final int height;
    private final int greatest;
    private int last = ' '; // the newest character of a text

    private PnmImage(InputStream in, Format format) throws IOException, DamagedException {
        this.in = in;
        this.format = format;
        this.width = fromHeader("width");
        this.height = fromHeader("height");
        this.greatest = format.bits ? 1 : number("a greatest value");
        if (greatest < 1 || greatest > GREATEST_VALUE) {
            throw new DamagedException("expected a greatest value from 1 to " + GREATEST_VALUE + ", not " + greatest);
        }
    }

    /** An image is damaged; the message has what was expected. */
    static final class DamagedException extends Exception {
        private static final long serialVersionUID = 1L;

        DamagedException(String problem) {
            super(problem);
        }
    }

    /** True if the file begins as an image of Netpbm does. */
    static boolean isOne(byte[] start) {
        return start.length >= 3
                && start[0] == 'P'
                && FORMATS.containsKey((char) start[1])
                && (isBlank(start[2]) || start[2] == '#');
    }

    /** Reads the header of an image of which {@link #isOne} is true. */
    static PnmImage open(InputStream file) throws IOException, DamagedException {
        var in = new BufferedInputStream(file);
        in.read();
        Format format = FORMATS.get((char) in.read());
        if (format == null) {
            throw new IllegalArgumentException("not an image of Netpbm");
        }
        return new PnmImage(in, format);
    }

    int width() {
        return width;
    }

    int height() {
        return height;
    }

    /** Receives the rows of an image from the top. */
    @FunctionalInterface
    interface RowReceiver {
        /** @param levels of the first channel, from 0 to {@code brightest} */
        void row(int row, int[] levels, int brightest);
    }

    void rows(RowReceiver receiver) throws IOException, DamagedException {
        var levels = new int[width];
        for (int row = 0; row < height; row++) {
            try {
                if (format.bits && !format.text) {
                    bits(levels);
                } else {
                    values(levels, row);
                }
            } catch (EOFException e) {
                throw new DamagedException(
                        "is cut off: expected " + height + " rows of " + width + " pixels, found " + row);
            }
            receiver.row(row, levels, greatest);
        }
    }

    /** A row of bits, padded to whole bytes. */
    private void bits(int[] levels) throws IOException {
        int eight = 0;
        for (int x = 0; x < width; x++) {
            eight = x % 8 == 0 ? octet() : eight << 1;
            levels[x] = (eight & 0x80) == 0 ? 1 : 0;
        }
    }

    private void values(int[] levels, int row) throws IOException, DamagedException {
        for (int x = 0; x < width; x++) {
            for (int channel = 0; channel < format.channels; channel++) {
                int value = format.bits ? bit(row) : format.text ? number("a value in row " + (row + 1)) : raw();
                if (value > greatest) {
                    throw new DamagedException(
                            "expected values from 0 to " + greatest + ", not " + value + ", in row " + (row + 1));
                }
                levels[x] = channel == 0 ? value : levels[x];
            }
        }
    }

    private int raw() throws IOException {
        return greatest < 256 ? octet() : octet() << 8 | octet();
    }

    private int octet() throws IOException {
        int octet = in.read();
        if (octet < 0) {
            throw new EOFException();
        }
        return octet;
    }

    /** A pixel of a text, where nothing needs to separate them. */
    private int bit(int row) throws IOException, DamagedException {
        int digit = skipBlanks();
        last = ' ';
        if (digit != '0' && digit != '1') {
            throw new DamagedException("expected 0 or 1 in row " + (row + 1) + ", found \"" + (char) digit + '"');
        }
        return '1' - digit;
    }

    private int fromHeader(String what) throws IOException, DamagedException {
        int size;
        try {
            size = number("the " + what);
        } catch (EOFException e) {
            throw new DamagedException("is cut off: expected the " + what);
        }
        if (size < 1) {
            throw new DamagedException("expected a " + what + " from 1, not " + size);
        }
        return size;
    }

    /** The next number of a text, and the one character after it. */
    private int number(String what) throws IOException, DamagedException {
        var word = new StringBuilder();
        for (int next = skipBlanks(); next >= 0 && !isBlank(next) && next != '#' && word.length() <= LONGEST_WORD; ) {
            word.append((char) next);
            next = in.read();
            last = next;
        }
        try {
            int number = Integer.parseInt(word.toString());
            if (number >= 0 && word.charAt(0) != '+') {
                return number;
            }
        } catch (NumberFormatException e) {
            // reported below
        }
        throw new DamagedException("expected " + what + ", found \"" + word + '"');
    }

    /** The next character that is neither blank nor in a comment. */
    private int skipBlanks() throws IOException {
        while (isBlank(last) || last == '#') {
            if (last == '#') {
                while (last >= 0 && last != '\n' && last != '\r') {
                    last = in.read();
                }
            } else {
                last = in.read();
            }
        }
        if (last < 0) {
            throw new EOFException();
        }
        return last;
    }

    private static boolean isBlank(int character) {
        return character == ' ' || character >= '\t' && character <= '\r';
    }
}
