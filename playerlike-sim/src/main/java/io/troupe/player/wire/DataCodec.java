package io.troupe.player.wire;

import io.troupe.player.wire.DeviceData.Blob;
import io.troupe.player.wire.DeviceData.Blobs;
import io.troupe.player.wire.DeviceData.BumperStates;
import io.troupe.player.wire.DeviceData.CameraImage;
import io.troupe.player.wire.DeviceData.Fiducial;
import io.troupe.player.wire.DeviceData.Fiducials;
import io.troupe.player.wire.DeviceData.GeometryChanged;
import io.troupe.player.wire.DeviceData.GripperState;
import io.troupe.player.wire.DeviceData.LaserScan;
import io.troupe.player.wire.DeviceData.Position2d;
import io.troupe.player.wire.DeviceData.RangerIntensities;
import io.troupe.player.wire.DeviceData.RangerRanges;
import io.troupe.player.wire.DeviceData.RangerStamped;
import io.troupe.player.wire.DeviceData.SonarRanges;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import org.jspecify.annotations.Nullable;

/** Encodes and decodes DATA messages of devices. */
final class DataCodec {
    private static final int BLOB_BYTES = 40;
    private static final int FIDUCIAL_BYTES = 100;

    private DataCodec() {}

    static Content encode(DeviceData data) {
        var out = new XdrWriter();
        int subtype = write(out, data);
        return new Content(subtype, out.bytes());
    }

    private static int write(XdrWriter out, DeviceData data) {
        switch (data) {
            case Position2d state ->
                out.float64(state.px(), state.py(), state.pa(), state.vx(), state.vy(), state.va())
                        .bool(state.stall());
            case SonarRanges sonar -> out.array(sonar.rangesM(), XdrWriter::float32);
            case Blobs image -> out.int32(image.width()).int32(image.height()).array(image.blobs(), DataCodec::blob);
            case RangerRanges ranges -> doubles(out, ranges.rangesM());
            case RangerIntensities values -> {
                doubles(out, values.intensities());
                return 3;
            }
            case RangerStamped stamped -> {
                int subtype = write(out, stamped.data());
                stamp(out, stamped);
                return subtype + 1;
            }
            case LaserScan scan -> scan(out, scan);
            case Fiducials fiducials -> out.array(fiducials.seen(), DataCodec::fiducial);
            case CameraImage image -> image(out, image);
            case GripperState gripper ->
                out.int32(gripper.state()).int32(gripper.beams()).int32(gripper.stored());
            case BumperStates bumpers -> out.opaque(bytes(bumpers.states()));
            case GeometryChanged changed -> {
                ReplyCodec.write(out, changed.geometry());
                return changed.geometry() instanceof DeviceReply.RangerGeometry ? 5 : 2;
            }
        }
        return 1;
    }

    static void image(XdrWriter out, CameraImage image) {
        out.int32(image.width())
                .int32(image.height())
                .int32(image.bitsPerPixel())
                .int32(image.format())
                .int32(image.divisor())
                .int32(image.compression())
                .opaque(image.pixels().toArray());
    }

    static CameraImage image(XdrReader in) throws WireException {
        return new CameraImage(
                in.int32("width"),
                in.int32("height"),
                in.int32("bpp"),
                in.int32("format"),
                in.int32("fdiv"),
                in.int32("compression"),
                Octets.of(in.opaque("image")));
    }

    private static void doubles(XdrWriter out, List<Double> values) {
        out.array(values, (to, value) -> to.float64(value));
    }

    private static void blob(XdrWriter out, Blob blob) {
        out.int32(blob.id())
                .int32(blob.colour())
                .int32(blob.area())
                .int32(blob.x())
                .int32(blob.y())
                .int32(blob.left())
                .int32(blob.right())
                .int32(blob.top())
                .int32(blob.bottom())
                .float32(blob.rangeM());
    }

    private static void stamp(XdrWriter out, RangerStamped stamped) {
        var geometry = stamped.geometry();
        out.bool(geometry != null);
        ReplyCodec.write(out, geometry == null ? ReplyCodec.NO_GEOMETRY : geometry);
        var configuration = stamped.configuration();
        out.bool(configuration != null);
        XdrStructures.rangerConfiguration(out, configuration == null ? ReplyCodec.NO_CONFIGURATION : configuration);
    }

    private static void scan(XdrWriter out, LaserScan scan) {
        out.float32(scan.minAngleRad())
                .float32(scan.maxAngleRad())
                .float32(scan.resolutionRad())
                .float32(scan.maxRangeM())
                .array(scan.rangesM(), XdrWriter::float32);
        out.opaque(bytes(scan.intensities())).int32(scan.scanId());
    }

    private static byte[] bytes(List<Byte> values) {
        var bytes = new byte[values.size()];
        for (int i = 0; i < bytes.length; i++) {
            bytes[i] = values.get(i);
        }
        return bytes;
    }

    private static void fiducial(XdrWriter out, Fiducial marker) {
        out.int32(marker.id());
        XdrStructures.pose3d(out, marker.pose());
        XdrStructures.pose3d(out, marker.uncertainty());
    }

    /** Empty for an unknown message. */
    static Optional<DeviceData> decode(int interfaceCode, int subtype, byte[] payload) throws WireException {
        Interfaces type = Interfaces.find(interfaceCode);
        if (type == null) {
            return Optional.empty();
        }
        var in = new XdrReader(type.playerName() + " DATA " + subtype, payload);
        DeviceData data = read(type, subtype, in);
        if (data != null) {
            in.end();
        }
        return Optional.ofNullable(data);
    }

    private static @Nullable DeviceData read(Interfaces type, int subtype, XdrReader in) throws WireException {
        return switch (type) {
            case POSITION2D ->
                switch (subtype) {
                    case 1 -> position(in);
                    case 2 -> new GeometryChanged(ReplyCodec.positionGeometry(in));
                    default -> null;
                };
            case SONAR ->
                switch (subtype) {
                    case 1 -> new SonarRanges(in.array("ranges", 4, from -> from.float32("range")));
                    case 2 -> new GeometryChanged(ReplyCodec.sonarGeometry(in));
                    default -> null;
                };
            case BLOBFINDER ->
                subtype == 1
                        ? new Blobs(
                                in.int32("width"), in.int32("height"), in.array("blobs", BLOB_BYTES, DataCodec::blob))
                        : null;
            case RANGER ->
                switch (subtype) {
                    case 1 -> new RangerRanges(doubles(in));
                    case 2 -> stamped(new RangerRanges(doubles(in)), in);
                    case 3 -> new RangerIntensities(doubles(in));
                    case 4 -> stamped(new RangerIntensities(doubles(in)), in);
                    case 5 -> new GeometryChanged(ReplyCodec.rangerGeometry(in));
                    default -> null;
                };
            case LASER -> subtype == 1 ? scan(in) : null;
            case SIMULATION -> null;
            case FIDUCIAL ->
                subtype == 1 ? new Fiducials(in.array("fiducials", FIDUCIAL_BYTES, DataCodec::fiducial)) : null;
            case CAMERA -> subtype == 1 ? image(in) : null;
            case GRIPPER ->
                subtype == 1 ? new GripperState(in.uint8("state"), in.int32("beams"), in.uint8("stored")) : null;
            case BUMPER ->
                switch (subtype) {
                    case 1 -> new BumperStates(bytes("bumpers", in));
                    case 2 -> new GeometryChanged(ReplyCodec.bumperGeometry(in));
                    default -> null;
                };
        };
    }

    private static Position2d position(XdrReader in) throws WireException {
        return new Position2d(
                in.float64("px"),
                in.float64("py"),
                in.float64("pa"),
                in.float64("vx"),
                in.float64("vy"),
                in.float64("va"),
                in.bool("stall"));
    }

    private static List<Double> doubles(XdrReader in) throws WireException {
        return in.array("ranges", 8, from -> from.float64("range"));
    }

    private static Blob blob(XdrReader in) throws WireException {
        return new Blob(
                in.int32("id"),
                in.int32("color"),
                in.int32("area"),
                in.int32("x"),
                in.int32("y"),
                in.int32("left"),
                in.int32("right"),
                in.int32("top"),
                in.int32("bottom"),
                in.float32("range"));
    }

    private static RangerStamped stamped(DeviceData data, XdrReader in) throws WireException {
        boolean hasGeometry = in.bool("have_geom");
        var geometry = ReplyCodec.rangerGeometry(in);
        boolean hasConfiguration = in.bool("have_config");
        var configuration = XdrStructures.rangerConfiguration(in);
        return new RangerStamped(data, hasGeometry ? geometry : null, hasConfiguration ? configuration : null);
    }

    private static LaserScan scan(XdrReader in) throws WireException {
        float min = in.float32("min_angle");
        float max = in.float32("max_angle");
        float resolution = in.float32("resolution");
        float maxRange = in.float32("max_range");
        List<Float> ranges = in.array("ranges", 4, from -> from.float32("range"));
        List<Byte> intensities = bytes("intensity", in);
        return new LaserScan(min, max, resolution, maxRange, ranges, intensities, in.int32("id"));
    }

    private static List<Byte> bytes(String field, XdrReader in) throws WireException {
        var bytes = new ArrayList<Byte>();
        for (byte each : in.opaque(field)) {
            bytes.add(each);
        }
        return bytes;
    }

    private static Fiducial fiducial(XdrReader in) throws WireException {
        return new Fiducial(in.int32("id"), XdrStructures.pose3d(in), XdrStructures.pose3d(in));
    }
}
