package io.troupe.player.wire;

import static java.util.Objects.requireNonNull;

import java.util.List;
import org.jspecify.annotations.Nullable;

/** The content of a DATA message; immutable, SI units, angles in radians. */
public sealed interface DeviceData {
    /** position2d DATA 1: pose in the odometry frame, velocity in the robot's frame. */
    record Position2d(double px, double py, double pa, double vx, double vy, double va, boolean stall)
            implements DeviceData {}

    /** sonar DATA 1: one range per sonar, in metres. */
    record SonarRanges(List<Float> rangesM) implements DeviceData {
        public SonarRanges {
            rangesM = List.copyOf(rangesM);
        }
    }

    /**
     * blobfinder DATA 1: the size of the image in pixels (0 x 0 if it has no blob) and its blobs, from right to left in
     * Stage's order.
     */
    record Blobs(int width, int height, List<Blob> blobs) implements DeviceData {
        public Blobs {
            blobs = List.copyOf(blobs);
        }
    }

    /** One blob, in pixels; colour {@code 0x00RRGGBB}; range in metres. */
    record Blob(int id, int colour, int area, int x, int y, int left, int right, int top, int bottom, float rangeM) {}

    /**
     * ranger DATA 1: the ranges of all elements in metres, one element after the other; within an element from right to
     * left.
     */
    record RangerRanges(List<Double> rangesM) implements DeviceData {
        public RangerRanges {
            rangesM = List.copyOf(rangesM);
        }
    }

    /**
     * laser DATA 1: a scan from the least angle (right) to the greatest (left).
     *
     * @param intensities one for each range, or none
     */
    record LaserScan(
            float minAngleRad,
            float maxAngleRad,
            float resolutionRad,
            float maxRangeM,
            List<Float> rangesM,
            List<Byte> intensities,
            int scanId)
            implements DeviceData {
        public LaserScan {
            rangesM = List.copyOf(rangesM);
            intensities = List.copyOf(intensities);
        }
    }

    /** fiducial DATA 1: the markers in view. */
    record Fiducials(List<Fiducial> seen) implements DeviceData {
        public Fiducials {
            seen = List.copyOf(seen);
        }
    }

    /** One marker: its number (-1 if it cannot be read), its pose relative to the finder, and how uncertain that is. */
    record Fiducial(int id, Pose3d pose, Pose3d uncertainty) {}

    /**
     * camera DATA 1: an image, its rows from the top.
     *
     * @param bitsPerPixel 8, 16, 24 or 32
     * @param format Player's number of it
     * @param divisor of pixel values that are scaled, else 1
     * @param compression 0 = none, 1 = JPEG
     */
    record CameraImage(int width, int height, int bitsPerPixel, int format, int divisor, int compression, Octets pixels)
            implements DeviceData {
        /** Value of {@link #format}: a byte each for red, green and blue. */
        public static final int RGB888 = 5;
        /** Value of {@link #compression}. */
        public static final int RAW = 0;
    }

    /**
     * gripper DATA 1.
     *
     * @param state Player's number of it
     * @param beams a bit for each beam that is broken
     * @param stored number of stored things
     */
    record GripperState(int state, int beams, int stored) implements DeviceData {
        /** Value of {@link #state}. */
        public static final int OPEN = 1;
        /** Value of {@link #state}. */
        public static final int CLOSED = 2;
        /** Value of {@link #state}. */
        public static final int MOVING = 3;
    }

    /** bumper DATA 1: for each bumper whether it is pressed, 0 if not. */
    record BumperStates(List<Byte> states) implements DeviceData {
        public BumperStates {
            states = List.copyOf(states);
        }
    }

    /** ranger DATA 3: the intensity of the echo of each range of DATA 1. */
    record RangerIntensities(List<Double> intensities) implements DeviceData {
        public RangerIntensities {
            intensities = List.copyOf(intensities);
        }
    }

    /**
     * ranger DATA 2 and 4: ranges or intensities, with the geometry and configuration of the ranger at that time.
     *
     * @param data {@link RangerRanges} or {@link RangerIntensities}
     */
    record RangerStamped(
            DeviceData data,
            DeviceReply.@Nullable RangerGeometry geometry,
            @Nullable RangerConfiguration configuration) implements DeviceData {
        public RangerStamped {
            if (!(data instanceof RangerRanges || data instanceof RangerIntensities)) {
                throw new IllegalArgumentException("data is " + data + ", expected ranges or intensities");
            }
        }
    }

    /**
     * DATA 2 of position2d, sonar and bumper, DATA 5 of ranger: the geometry has changed.
     *
     * @param geometry the same as in the reply to {@link DeviceRequest.Geometry}
     */
    record GeometryChanged(DeviceReply geometry) implements DeviceData {
        public GeometryChanged {
            requireNonNull(geometry, "geometry");
        }
    }
}
