package io.troupe.player.wire;

import io.troupe.player.wire.DeviceRequest.Capability;
import io.troupe.player.wire.DeviceRequest.Geometry;
import io.troupe.player.wire.DeviceRequest.GetColour;
import io.troupe.player.wire.DeviceRequest.GetConfiguration;
import io.troupe.player.wire.DeviceRequest.GetFieldOfView;
import io.troupe.player.wire.DeviceRequest.GetImage;
import io.troupe.player.wire.DeviceRequest.GetMarker;
import io.troupe.player.wire.DeviceRequest.GetPose;
import io.troupe.player.wire.DeviceRequest.GetPose3d;
import io.troupe.player.wire.DeviceRequest.GetProperty;
import io.troupe.player.wire.DeviceRequest.Intensities;
import io.troupe.player.wire.DeviceRequest.LaserId;
import io.troupe.player.wire.DeviceRequest.PositionMode;
import io.troupe.player.wire.DeviceRequest.PositionPid;
import io.troupe.player.wire.DeviceRequest.Power;
import io.troupe.player.wire.DeviceRequest.ResetOdometry;
import io.troupe.player.wire.DeviceRequest.SetColour;
import io.troupe.player.wire.DeviceRequest.SetFieldOfView;
import io.troupe.player.wire.DeviceRequest.SetImager;
import io.troupe.player.wire.DeviceRequest.SetIntegerProperty;
import io.troupe.player.wire.DeviceRequest.SetLaserConfiguration;
import io.troupe.player.wire.DeviceRequest.SetMarker;
import io.troupe.player.wire.DeviceRequest.SetOdometry;
import io.troupe.player.wire.DeviceRequest.SetPose;
import io.troupe.player.wire.DeviceRequest.SetPose3d;
import io.troupe.player.wire.DeviceRequest.SetProperty;
import io.troupe.player.wire.DeviceRequest.SetRangerConfiguration;
import io.troupe.player.wire.DeviceRequest.SpeedPid;
import io.troupe.player.wire.DeviceRequest.SpeedProfile;
import io.troupe.player.wire.DeviceRequest.Unknown;
import io.troupe.player.wire.DeviceRequest.VelocityMode;

/** Encodes and decodes REQ messages to devices. */
final class RequestCodec {
    private static final int CAPABILITY = 255;
    private static final int SET_INTEGER_PROPERTY = 253;

    private RequestCodec() {}

    static Content encode(int interfaceCode, DeviceRequest request) {
        var out = new XdrWriter();
        int subtype = write(out, interfaceCode == Interfaces.LASER.code(), request);
        return new Content(subtype, out.bytes());
    }

    private static int write(XdrWriter out, boolean laser, DeviceRequest request) {
        return switch (request) {
            case Geometry geometry -> 1;
            case Power power -> subtype(laser ? 4 : 2, out.bool(power.on()));
            case VelocityMode velocity -> subtype(3, out.int32(velocity.mode()));
            case PositionMode position -> subtype(4, out.int32(position.mode()));
            case SetOdometry pose -> subtype(5, out.float64(pose.px(), pose.py(), pose.pa()));
            case ResetOdometry reset -> 6;
            case SpeedPid pid ->
                subtype(7, out.float32(pid.kp()).float32(pid.ki()).float32(pid.kd()));
            case PositionPid pid ->
                subtype(8, out.float32(pid.kp()).float32(pid.ki()).float32(pid.kd()));
            case SpeedProfile profile ->
                subtype(9, out.float32(profile.speedMps()).float32(profile.accelerationMps2()));
            case SetColour colour -> subtype(1, colour(out, colour));
            case SetImager imager -> {
                out.int32(imager.brightness()).int32(imager.contrast());
                yield subtype(2, out.int32(imager.colourMode()).int32(imager.autoGain()));
            }
            case GetColour colour -> 3;
            case Intensities intensities -> subtype(3, out.bool(intensities.on()));
            case GetConfiguration configuration -> laser ? 3 : 5;
            case SetRangerConfiguration set -> {
                XdrStructures.rangerConfiguration(out, set.configuration());
                yield 4;
            }
            case SetLaserConfiguration set -> {
                XdrStructures.laserConfiguration(out, set.configuration());
                yield 2;
            }
            case LaserId id -> 5;
            case GetFieldOfView get -> 2;
            case SetFieldOfView set ->
                subtype(3, out.float32(set.minRangeM()).float32(set.maxRangeM()).float32(set.angleRad()));
            case GetMarker get -> 7;
            case GetImage get -> 3;
            case SetMarker set -> subtype(8, out.int32(set.id()));
            case GetPose get -> subtype(1, out.string(get.model()).float64(0, 0, 0));
            case SetPose set -> subtype(2, out.string(set.model()).float64(set.px(), set.py(), set.pa()));
            case GetPose3d get -> subtype(3, pose3d(out, get.model(), Pose3d.flat(0, 0, 0), 0));
            case SetPose3d set -> subtype(4, pose3d(out, set.model(), set.pose(), set.timeMicros()));
            case GetProperty(var model, var property, int index, int valueBytes) ->
                subtype(5, out.string(model).string(property).int32(index).opaque(new byte[valueBytes]));
            case SetProperty(var model, var property, int index, var value) ->
                subtype(6, out.string(model).string(property).int32(index).opaque(value.toArray()));
            case SetIntegerProperty property ->
                subtype(SET_INTEGER_PROPERTY, out.string(property.key()).int32(property.value()));
            case Capability capability ->
                subtype(CAPABILITY, out.int32(capability.type()).int32(capability.subtype()));
            case Unknown unknown -> unknown.subtype();
        };
    }

    private static XdrWriter colour(XdrWriter out, SetColour colour) {
        out.int32(colour.channel()).int32(colour.rmin()).int32(colour.rmax());
        out.int32(colour.gmin()).int32(colour.gmax());
        return out.int32(colour.bmin()).int32(colour.bmax());
    }

    private static XdrWriter pose3d(XdrWriter out, String model, Pose3d pose, double timeMicros) {
        out.string(model);
        XdrStructures.pose3d(out, pose);
        return out.float64(timeMicros);
    }

    private static int subtype(int subtype, XdrWriter written) {
        return subtype;
    }

    /** Returns {@link Unknown} for an unknown request. */
    static DeviceRequest decode(int interfaceCode, int subtype, byte[] payload) throws WireException {
        var in = new XdrReader(Interfaces.name(interfaceCode) + " REQ " + subtype, payload);
        if (subtype == CAPABILITY) {
            return ended(new Capability(in.int32("type"), in.int32("subtype")), in);
        }
        Interfaces type = Interfaces.find(interfaceCode);
        if (type == null) {
            return new Unknown(subtype);
        }
        return switch (type) {
            case POSITION2D -> position(subtype, in);
            case SONAR ->
                switch (subtype) {
                    case 1 -> new Geometry();
                    case 2 -> ended(new Power(in.bool("state")), in);
                    default -> new Unknown(subtype);
                };
            case BLOBFINDER -> blobfinder(subtype, in);
            case RANGER -> ranger(subtype, in);
            case LASER -> laser(subtype, in);
            case SIMULATION -> simulation(subtype, in);
            case FIDUCIAL -> fiducial(subtype, in);
            case CAMERA -> subtype == 3 ? new GetImage() : new Unknown(subtype);
            case BUMPER, GRIPPER -> subtype == 1 ? new Geometry() : new Unknown(subtype);
        };
    }

    private static DeviceRequest ended(DeviceRequest request, XdrReader in) throws WireException {
        in.end();
        return request;
    }

    private static DeviceRequest position(int subtype, XdrReader in) throws WireException {
        return switch (subtype) {
            case 1 -> new Geometry();
            case 2 -> ended(new Power(in.bool("state")), in);
            case 3 -> ended(new VelocityMode(in.int32("mode")), in);
            case 4 -> ended(new PositionMode(in.int32("mode")), in);
            case 5 -> ended(new SetOdometry(in.float64("px"), in.float64("py"), in.float64("pa")), in);
            case 6 -> ended(new ResetOdometry(), in);
            case 7 -> {
                boolean doubles = in.remaining() == 24; // javaclient3 sends doubles
                yield ended(new SpeedPid(gain(in, doubles), gain(in, doubles), gain(in, doubles)), in);
            }
            case 8 -> {
                boolean doubles = in.remaining() == 24;
                yield ended(new PositionPid(gain(in, doubles), gain(in, doubles), gain(in, doubles)), in);
            }
            case 9 -> ended(new SpeedProfile(in.float32("speed"), in.float32("acc")), in);
            case SET_INTEGER_PROPERTY -> ended(new SetIntegerProperty(in.string("key"), in.int32("value")), in);
            default -> new Unknown(subtype);
        };
    }

    private static float gain(XdrReader in, boolean doubles) throws WireException {
        return doubles ? (float) in.float64("gain") : in.float32("gain");
    }

    private static DeviceRequest blobfinder(int subtype, XdrReader in) throws WireException {
        return switch (subtype) {
            case 1 ->
                ended(
                        new SetColour(
                                in.int32("channel"),
                                in.int32("rmin"),
                                in.int32("rmax"),
                                in.int32("gmin"),
                                in.int32("gmax"),
                                in.int32("bmin"),
                                in.int32("bmax")),
                        in);
            case 2 -> // javaclient sends 24 bytes, only these have a meaning
                new SetImager(
                        in.int32("brightness"), in.int32("contrast"), in.int32("colormode"), in.int32("autogain"));
            case 3 -> new GetColour();
            default -> new Unknown(subtype);
        };
    }

    private static DeviceRequest ranger(int subtype, XdrReader in) throws WireException {
        return switch (subtype) {
            case 1 -> new Geometry();
            case 2 -> ended(new Power(in.bool("state")), in);
            case 3 -> ended(new Intensities(in.bool("state")), in);
            case 4 -> ended(new SetRangerConfiguration(XdrStructures.rangerConfiguration(in)), in);
            case 5 -> new GetConfiguration();
            default -> new Unknown(subtype);
        };
    }

    private static DeviceRequest laser(int subtype, XdrReader in) throws WireException {
        return switch (subtype) {
            case 1 -> new Geometry();
            case 2 -> ended(new SetLaserConfiguration(XdrStructures.laserConfiguration(in)), in);
            case 3 -> new GetConfiguration();
            case 4 -> ended(new Power(in.bool("state")), in);
            case 5 -> new LaserId();
            default -> new Unknown(subtype);
        };
    }

    private static DeviceRequest fiducial(int subtype, XdrReader in) throws WireException {
        return switch (subtype) {
            case 1 -> new Geometry();
            case 2 -> new GetFieldOfView();
            case 3 ->
                ended(
                        new SetFieldOfView(in.float32("min_range"), in.float32("max_range"), in.float32("view_angle")),
                        in);
            case 7 -> new GetMarker();
            case 8 -> ended(new SetMarker(in.int32("id")), in);
            default -> new Unknown(subtype);
        };
    }

    private static DeviceRequest simulation(int subtype, XdrReader in) throws WireException {
        return switch (subtype) {
            case 1 -> new GetPose(in.string("name")); // the pose that follows is ignored
            case 2 -> ended(new SetPose(in.string("name"), in.float64("px"), in.float64("py"), in.float64("pa")), in);
            case 3 -> new GetPose3d(in.string("name")); // as the pose here
            case 4 -> ended(new SetPose3d(in.string("name"), XdrStructures.pose3d(in), in.float64("simtime")), in);
            case 5 ->
                ended(
                        new GetProperty(
                                in.string("name"), in.string("prop"), in.int32("index"), in.opaque("value").length),
                        in);
            case 6 ->
                ended(
                        new SetProperty(
                                in.string("name"), in.string("prop"), in.int32("index"), Octets.of(in.opaque("value"))),
                        in);
            default -> new Unknown(subtype);
        };
    }
}
