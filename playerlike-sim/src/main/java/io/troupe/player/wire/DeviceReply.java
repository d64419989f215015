package io.troupe.player.wire;

import static java.util.Objects.requireNonNull;

import java.util.List;

/** The reply of a device to a request; metres, radians. */
public sealed interface DeviceReply {
    /** Success (RESP_ACK without content). */
    record Ack() implements DeviceReply {}

    /** Refusal (RESP_NACK), with the reason if the server sends one. */
    record Nack(String reason) implements DeviceReply {}

    /** The body in the robot's frame: its centre, its length (x) and width (y), metres and radians. */
    record Position2dGeometry(double px, double py, double pa, double lengthM, double widthM) implements DeviceReply {}

    /** The pose of each sonar, in the robot's frame. */
    record SonarGeometry(List<SonarMount> mounts) implements DeviceReply {
        public SonarGeometry {
            mounts = List.copyOf(mounts);
        }
    }

    /** Metres and radians, in the robot's frame. */
    record SonarMount(double px, double py, double yaw) {}

    /** Poses and sizes of a ranger and its elements. */
    record RangerGeometry(Pose3d pose, Size3d size, List<Pose3d> elementPoses, List<Size3d> elementSizes)
            implements DeviceReply {
        public RangerGeometry {
            elementPoses = List.copyOf(elementPoses);
            elementSizes = List.copyOf(elementSizes);
        }
    }

    /** Reply to {@link DeviceRequest.GetConfiguration} and {@link DeviceRequest.SetRangerConfiguration} of a ranger. */
    record OfRanger(RangerConfiguration configuration) implements DeviceReply {
        public OfRanger {
            requireNonNull(configuration, "configuration");
        }
    }

    /** Pose and size of a laser. */
    record LaserGeometry(Pose3d pose, Size3d size) implements DeviceReply {}

    /** Reply to {@link DeviceRequest.GetConfiguration} and {@link DeviceRequest.SetLaserConfiguration} of a laser. */
    record OfLaser(LaserConfiguration configuration) implements DeviceReply {
        public OfLaser {
            requireNonNull(configuration, "configuration");
        }
    }

    /** Reply to {@link DeviceRequest.LaserId}. */
    record LaserId(int id) implements DeviceReply {}

    /** Pose and size of a fiducial finder, and the size of the markers. */
    record FiducialGeometry(Pose3d pose, Size3d size, double markerWidthM, double markerLengthM)
            implements DeviceReply {}

    /** Reply to {@link DeviceRequest.GetFieldOfView} and {@link DeviceRequest.SetFieldOfView}. */
    record FieldOfView(float minRangeM, float maxRangeM, float angleRad) implements DeviceReply {}

    /** Reply to {@link DeviceRequest.GetMarker} and {@link DeviceRequest.SetMarker}: the number of the own marker. */
    record Marker(int id) implements DeviceReply {}

    /**
     * A gripper.
     *
     * @param inner the space between the open paddles
     * @param capacity number of things that it can store
     */
    record GripperGeometry(Pose3d pose, Size3d outer, Size3d inner, int beams, int capacity) implements DeviceReply {}

    /** The bumpers of a robot. */
    record BumperGeometry(List<Bumper> bumpers) implements DeviceReply {
        public BumperGeometry {
            bumpers = List.copyOf(bumpers);
        }
    }

    /** One bumper: the pose of its middle, its length, and the radius of its curve, 0 for a straight one. */
    record Bumper(Pose3d pose, float lengthM, float radiusM) {}

    /** Reply to {@link DeviceRequest.GetImage}. */
    record Image(DeviceData.CameraImage image) implements DeviceReply {
        public Image {
            requireNonNull(image, "image");
        }
    }

    /** Reply to {@link DeviceRequest.GetPose}: a pose in the world's frame. */
    record ModelPose(String model, double px, double py, double pa) implements DeviceReply {
        public ModelPose {
            requireNonNull(model, "model");
        }
    }

    /**
     * Reply to {@link DeviceRequest.GetPose3d}.
     *
     * @param timeMicros simulated time of the pose, as Stage sends it
     */
    record ModelPose3d(String model, Pose3d pose, double timeMicros) implements DeviceReply {
        public ModelPose3d {
            requireNonNull(model, "model");
        }
    }

    /** Reply to {@link DeviceRequest.GetProperty}; the bytes of the value are those in the memory of the server. */
    record ModelProperty(String model, String property, int index, Octets value) implements DeviceReply {}

    /** Reply to {@link DeviceRequest.GetColour}. */
    record Colour(int channel, int rmin, int rmax, int gmin, int gmax, int bmin, int bmax) implements DeviceReply {}
}
