package io.troupe.player.wire;

/** Encodes and decodes structures that several messages share. */
final class XdrStructures {
    static final int POSE3D_BYTES = 48;
    static final int SIZE3D_BYTES = 24;
    static final int ADDRESS_BYTES = 16;

    private XdrStructures() {}

    static Pose3d pose3d(XdrReader in) throws WireException {
        return new Pose3d(
                in.float64("px"),
                in.float64("py"),
                in.float64("pz"),
                in.float64("roll"),
                in.float64("pitch"),
                in.float64("yaw"));
    }

    static void pose3d(XdrWriter out, Pose3d pose) {
        out.float64(pose.x(), pose.y(), pose.z(), pose.roll(), pose.pitch(), pose.yaw());
    }

    static Size3d size3d(XdrReader in) throws WireException {
        return new Size3d(in.float64("sw"), in.float64("sl"), in.float64("sh"));
    }

    static void size3d(XdrWriter out, Size3d size) {
        out.float64(size.widthM(), size.lengthM(), size.heightM());
    }

    static DeviceAddress address(XdrReader in) throws WireException {
        return new DeviceAddress(in.int32("host"), in.int32("robot"), in.uint16("interface"), in.uint16("index"));
    }

    static void address(XdrWriter out, DeviceAddress address) {
        out.int32(address.host())
                .int32(address.robot())
                .int32(address.interfaceCode())
                .int32(address.index());
    }

    static RangerConfiguration rangerConfiguration(XdrReader in) throws WireException {
        return new RangerConfiguration(
                in.float64("min_angle"),
                in.float64("max_angle"),
                in.float64("angular_res"),
                in.float64("min_range"),
                in.float64("max_range"),
                in.float64("range_res"),
                in.float64("frequency"));
    }

    static void rangerConfiguration(XdrWriter out, RangerConfiguration configuration) {
        out.float64(
                configuration.minAngleRad(),
                configuration.maxAngleRad(),
                configuration.resolutionRad(),
                configuration.minRangeM(),
                configuration.maxRangeM(),
                configuration.rangeResolutionM(),
                configuration.frequencyHz());
    }

    /** 28 bytes, or 24 from clients that do not send the frequency. */
    static LaserConfiguration laserConfiguration(XdrReader in) throws WireException {
        return new LaserConfiguration(
                in.float32("min_angle"),
                in.float32("max_angle"),
                in.float32("resolution"),
                in.float32("max_range"),
                in.float32("range_res"),
                in.bool("intensity"),
                in.remaining() == 0 ? 0 : in.float32("scanning_frequency"));
    }

    static void laserConfiguration(XdrWriter out, LaserConfiguration configuration) {
        out.float32(configuration.minAngleRad())
                .float32(configuration.maxAngleRad())
                .float32(configuration.resolutionRad())
                .float32(configuration.maxRangeM())
                .float32(configuration.rangeResolutionM())
                .bool(configuration.intensities())
                .float32(configuration.frequencyHz());
    }
}
