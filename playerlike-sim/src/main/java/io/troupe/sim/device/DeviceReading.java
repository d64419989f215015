package io.troupe.sim.device;

import java.util.List;

/**
 * The reading of a device that {@link io.troupe.sim.model.RobotSpec#devices} lists; immutable.
 *
 * <p><b>Units and shapes.</b> Metres and radians.
 */
public sealed interface DeviceReading {
    /** The markers that a fiducial finder sees: first those of obstacles, then of robots, in the order of the file. */
    record Fiducials(List<Fiducial> seen) implements DeviceReading {
        public Fiducials {
            seen = List.copyOf(seen);
        }
    }

    /**
     * A marker, as seen from the finder.
     *
     * @param id its number; 0 if it is too far away for the number to be read
     * @param x ahead of the finder
     * @param y left of it
     * @param headingRad of the thing with the marker, relative to the finder's heading; from -pi to pi
     */
    record Fiducial(int id, double x, double y, double headingRad) {}

    /**
     * An image: columns from left to right.
     *
     * @param heightPx number of rows
     */
    record Picture(int heightPx, List<Column> columns) implements DeviceReading {
        /** Colour above everything, {@code 0x00RRGGBB}. */
        public static final int SKY = 0xFFFFFF;
        /** Colour below everything, {@code 0x00RRGGBB}. */
        public static final int FLOOR = 0xC0C0C0;

        public Picture {
            columns = List.copyOf(columns);
        }

        /** Colour of a pixel, {@code 0x00RRGGBB}; row 0 is the top. */
        public int colour(int column, int row) {
            Column at = columns.get(column);
            if (row >= at.top() && row < at.bottom()) {
                return at.colour();
            }
            return row < heightPx / 2 ? SKY : FLOOR;
        }

        /** All pixels: rows from the top, each from left to right, three bytes (red, green, blue) for each pixel. */
        public byte[] rgb() {
            byte[] pixels = new byte[3 * heightPx * columns.size()];
            int at = 0;
            for (int row = 0; row < heightPx; row++) {
                for (int column = 0; column < columns.size(); column++) {
                    int colour = colour(column, row);
                    pixels[at++] = (byte) (colour >> 16);
                    pixels[at++] = (byte) (colour >> 8);
                    pixels[at++] = (byte) colour;
                }
            }
            return pixels;
        }
    }

    /**
     * A column of an image, and the thing in it.
     *
     * @param colour of the thing
     * @param top its first row
     * @param bottom the row after its last one; that of {@code top} if there is nothing
     */
    record Column(int colour, int top, int bottom) {}

    /**
     * The state of a gripper.
     *
     * @param outerBeam a grippable thing breaks the beam near the tips of the paddles
     * @param innerBeam a grippable thing breaks the beam near its base
     * @param holds it holds something
     */
    record Grip(Paddles paddles, boolean outerBeam, boolean innerBeam, boolean holds) implements DeviceReading {}

    /** What the paddles of a gripper do. */
    enum Paddles {
        OPEN,
        CLOSED,
        OPENING,
        CLOSING
    }

    /** Whether something presses each bumper of a row. */
    record Pressed(List<Boolean> bumpers) implements DeviceReading {
        public Pressed {
            bumpers = List.copyOf(bumpers);
        }
    }

    /** What a device reads is not known: the state of a gripper of which only the robot's pose is known. */
    record Unknown() implements DeviceReading {}
}
