package io.troupe.player.wire;

import io.troupe.player.wire.DeviceReply.Ack;
import io.troupe.player.wire.DeviceReply.Bumper;
import io.troupe.player.wire.DeviceReply.BumperGeometry;
import io.troupe.player.wire.DeviceReply.Colour;
import io.troupe.player.wire.DeviceReply.FiducialGeometry;
import io.troupe.player.wire.DeviceReply.FieldOfView;
import io.troupe.player.wire.DeviceReply.GripperGeometry;
import io.troupe.player.wire.DeviceReply.Image;
import io.troupe.player.wire.DeviceReply.LaserGeometry;
import io.troupe.player.wire.DeviceReply.LaserId;
import io.troupe.player.wire.DeviceReply.Marker;
import io.troupe.player.wire.DeviceReply.ModelPose;
import io.troupe.player.wire.DeviceReply.ModelPose3d;
import io.troupe.player.wire.DeviceReply.ModelProperty;
import io.troupe.player.wire.DeviceReply.Nack;
import io.troupe.player.wire.DeviceReply.OfLaser;
import io.troupe.player.wire.DeviceReply.OfRanger;
import io.troupe.player.wire.DeviceReply.Position2dGeometry;
import io.troupe.player.wire.DeviceReply.RangerGeometry;
import io.troupe.player.wire.DeviceReply.SonarGeometry;
import io.troupe.player.wire.DeviceReply.SonarMount;
import java.util.List;

/** Encodes and decodes replies of devices (RESP_ACK and RESP_NACK). */
final class ReplyCodec {
    static final RangerGeometry NO_GEOMETRY =
            new RangerGeometry(Pose3d.flat(0, 0, 0), new Size3d(0, 0, 0), List.of(), List.of());
    static final RangerConfiguration NO_CONFIGURATION = new RangerConfiguration(0, 0, 0, 0, 0, 0, 0);

    private static final int BUMPER_BYTES = XdrStructures.POSE3D_BYTES + 8;

    private ReplyCodec() {}

    static MessageType type(DeviceReply reply) {
        return reply instanceof Nack ? MessageType.NACK : MessageType.ACK;
    }

    /** A NACK has no content, because some clients do not expect any. */
    static byte[] encode(DeviceReply reply) {
        var out = new XdrWriter();
        write(out, reply);
        return out.bytes();
    }

    static void write(XdrWriter out, DeviceReply reply) {
        switch (reply) {
            case Ack ack -> {}
            case Nack nack -> {}
            case Position2dGeometry base -> {
                XdrStructures.pose3d(out, Pose3d.flat(base.px(), base.py(), base.pa()));
                XdrStructures.size3d(out, new Size3d(base.widthM(), base.lengthM(), 0));
            }
            case SonarGeometry sonar ->
                out.array(
                        sonar.mounts(),
                        (to, mount) -> XdrStructures.pose3d(to, Pose3d.flat(mount.px(), mount.py(), mount.yaw())));
            case RangerGeometry ranger -> {
                XdrStructures.pose3d(out, ranger.pose());
                XdrStructures.size3d(out, ranger.size());
                out.array(ranger.elementPoses(), XdrStructures::pose3d)
                        .array(ranger.elementSizes(), XdrStructures::size3d);
            }
            case OfRanger ranger -> XdrStructures.rangerConfiguration(out, ranger.configuration());
            case LaserGeometry laser -> {
                XdrStructures.pose3d(out, laser.pose());
                XdrStructures.size3d(out, laser.size());
            }
            case OfLaser laser -> XdrStructures.laserConfiguration(out, laser.configuration());
            case LaserId laser -> out.int32(laser.id());
            case FiducialGeometry finder -> {
                XdrStructures.pose3d(out, finder.pose());
                XdrStructures.size3d(out, finder.size());
                out.float64(finder.markerWidthM(), finder.markerLengthM());
            }
            case FieldOfView view ->
                out.float32(view.minRangeM()).float32(view.maxRangeM()).float32(view.angleRad());
            case Marker marker -> out.int32(marker.id());
            case Image image -> DataCodec.image(out, image.image());
            case GripperGeometry gripper -> {
                XdrStructures.pose3d(out, gripper.pose());
                XdrStructures.size3d(out, gripper.outer());
                XdrStructures.size3d(out, gripper.inner());
                out.int32(gripper.beams()).int32(gripper.capacity());
            }
            case BumperGeometry row -> out.array(row.bumpers(), ReplyCodec::bumper);
            case ModelPose model -> out.string(model.model()).float64(model.px(), model.py(), model.pa());
            case ModelPose3d model -> {
                out.string(model.model());
                XdrStructures.pose3d(out, model.pose());
                out.float64(model.timeMicros());
            }
            case ModelProperty property ->
                out.string(property.model())
                        .string(property.property())
                        .int32(property.index())
                        .opaque(property.value().toArray());
            case Colour colour -> colour(out, colour);
        }
    }

    private static void colour(XdrWriter out, Colour colour) {
        out.int32(colour.channel()).int32(colour.rmin()).int32(colour.rmax());
        out.int32(colour.gmin()).int32(colour.gmax());
        out.int32(colour.bmin()).int32(colour.bmax());
    }

    private static void bumper(XdrWriter out, Bumper bumper) {
        XdrStructures.pose3d(out, bumper.pose());
        out.float32(bumper.lengthM()).float32(bumper.radiusM());
    }

    /** Decodes the reply to a request of that subtype. */
    static DeviceReply decode(int interfaceCode, MessageType type, int subtype, byte[] payload) throws WireException {
        if (type == MessageType.NACK) {
            return new Nack("refused by the server");
        }
        if (payload.length == 0) {
            return new Ack();
        }
        Interfaces device = Interfaces.find(interfaceCode);
        if (device == null) {
            return new Ack();
        }
        var in = new XdrReader(device.playerName() + " ACK " + subtype, payload);
        DeviceReply reply = read(device, subtype, in);
        if (!(reply instanceof Ack)) {
            in.end();
        }
        return reply;
    }

    private static DeviceReply read(Interfaces device, int subtype, XdrReader in) throws WireException {
        return switch (device) {
            case POSITION2D -> subtype == 1 ? positionGeometry(in) : new Ack();
            case SONAR -> subtype == 1 ? sonarGeometry(in) : new Ack();
            case BLOBFINDER -> subtype == 3 ? colour(in) : new Ack();
            case RANGER ->
                switch (subtype) {
                    case 1 -> rangerGeometry(in);
                    case 4, 5 -> new OfRanger(XdrStructures.rangerConfiguration(in));
                    default -> new Ack();
                };
            case LASER ->
                switch (subtype) {
                    case 1 -> new LaserGeometry(XdrStructures.pose3d(in), XdrStructures.size3d(in));
                    case 2, 3 -> new OfLaser(XdrStructures.laserConfiguration(in));
                    case 5 -> new LaserId(in.int32("id"));
                    default -> new Ack();
                };
            case SIMULATION ->
                switch (subtype) {
                    case 1 -> new ModelPose(in.string("name"), in.float64("px"), in.float64("py"), in.float64("pa"));
                    case 3 -> new ModelPose3d(in.string("name"), XdrStructures.pose3d(in), in.float64("simtime"));
                    case 5 ->
                        new ModelProperty(
                                in.string("name"), in.string("prop"), in.int32("index"), Octets.of(in.opaque("value")));
                    default -> new Ack();
                };
            case CAMERA -> subtype == 3 ? new Image(DataCodec.image(in)) : new Ack();
            case GRIPPER ->
                subtype == 1
                        ? new GripperGeometry(
                                XdrStructures.pose3d(in),
                                XdrStructures.size3d(in),
                                XdrStructures.size3d(in),
                                in.uint8("num_beams"),
                                in.uint8("capacity"))
                        : new Ack();
            case FIDUCIAL ->
                switch (subtype) {
                    case 1 ->
                        new FiducialGeometry(
                                XdrStructures.pose3d(in),
                                XdrStructures.size3d(in),
                                in.float64("marker width"),
                                in.float64("marker length"));
                    case 2, 3 ->
                        new FieldOfView(in.float32("min_range"), in.float32("max_range"), in.float32("view_angle"));
                    case 7, 8 -> new Marker(in.int32("id"));
                    default -> new Ack();
                };
            case BUMPER -> subtype == 1 ? bumperGeometry(in) : new Ack();
        };
    }

    static BumperGeometry bumperGeometry(XdrReader in) throws WireException {
        return new BumperGeometry(in.array(
                "bumpers",
                BUMPER_BYTES,
                from -> new Bumper(XdrStructures.pose3d(from), from.float32("length"), from.float32("radius"))));
    }

    /** Reads the geometry of a position2d. The fields ignored here are uninitialised in Stage. */
    static Position2dGeometry positionGeometry(XdrReader in) throws WireException {
        Pose3d pose = XdrStructures.pose3d(in);
        Size3d size = XdrStructures.size3d(in);
        return new Position2dGeometry(pose.x(), pose.y(), pose.yaw(), size.lengthM(), size.widthM());
    }

    static SonarGeometry sonarGeometry(XdrReader in) throws WireException {
        return new SonarGeometry(in.array("poses", XdrStructures.POSE3D_BYTES, from -> {
            Pose3d pose = XdrStructures.pose3d(from);
            return new SonarMount(pose.x(), pose.y(), pose.yaw());
        }));
    }

    static RangerGeometry rangerGeometry(XdrReader in) throws WireException {
        return new RangerGeometry(
                XdrStructures.pose3d(in),
                XdrStructures.size3d(in),
                in.array("element poses", XdrStructures.POSE3D_BYTES, XdrStructures::pose3d),
                in.array("element sizes", XdrStructures.SIZE3D_BYTES, XdrStructures::size3d));
    }

    private static Colour colour(XdrReader in) throws WireException {
        return new Colour(
                in.int32("channel"),
                in.int32("rmin"),
                in.int32("rmax"),
                in.int32("gmin"),
                in.int32("gmax"),
                in.int32("bmin"),
                in.int32("bmax"));
    }
}
