package io.troupe.player.wire;

import java.util.List;

/** The content of a DATA message; immutable, SI units, angles in radians. */
public sealed interface DeviceData {
    /** position2d DATA 1: pose in the odometry frame, velocity in the robot's frame. */
    record Position2d(double px, double py, double pa, double vx, double vy, double va, boolean stall)
            implements DeviceData {}

    /** sonar DATA 1: one range in metres per sonar. */
    record SonarRanges(List<Float> rangesM) implements DeviceData {
        public SonarRanges {
            rangesM = List.copyOf(rangesM);
        }
    }

    /** blobfinder DATA 1: the image's size in pixels (0 x 0 when it shows no blob) and its blobs from left to right. */
    record Blobs(int width, int height, List<Blob> blobs) implements DeviceData {
        public Blobs {
            blobs = List.copyOf(blobs);
        }
    }

    /** One blob, in pixels; colour {@code 0x00RRGGBB}; range in metres. */
    record Blob(int id, int colour, int area, int x, int y, int left, int right, int top, int bottom, float rangeM) {}

    /** ranger DATA 1: the ranges in metres of all elements, one after the other; within one from right to left. */
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
}
