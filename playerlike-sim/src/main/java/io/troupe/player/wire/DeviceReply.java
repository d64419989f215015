package io.troupe.player.wire;

import static java.util.Objects.requireNonNull;

import java.util.List;

/** What a device answers; metres, radians. */
public sealed interface DeviceReply {
    /** Done (RESP_ACK without content). */
    record Ack() implements DeviceReply {}

    /** Refused (RESP_NACK), and why, where the server says so. */
    record Nack(String reason) implements DeviceReply {}

    /** The body in the robot's frame: its centre, its length (x) and width (y), metres and radians. */
    record Position2dGeometry(double px, double py, double pa, double lengthM, double widthM) implements DeviceReply {}

    /** Where each sonar sits, in the robot's frame. */
    record SonarGeometry(List<SonarMount> mounts) implements DeviceReply {
        public SonarGeometry {
            mounts = List.copyOf(mounts);
        }
    }

    /** Metres and radians, in the robot's frame. */
    record SonarMount(double px, double py, double yaw) {}

    /** Where a ranger and its elements sit, and how large they are. */
    record RangerGeometry(Pose3d pose, Size3d size, List<Pose3d> elementPoses, List<Size3d> elementSizes)
            implements DeviceReply {
        public RangerGeometry {
            elementPoses = List.copyOf(elementPoses);
            elementSizes = List.copyOf(elementSizes);
        }
    }

    /** To {@link DeviceRequest.GetConfiguration} and {@link DeviceRequest.SetRangerConfiguration} of a ranger. */
    record OfRanger(RangerConfiguration configuration) implements DeviceReply {
        public OfRanger {
            requireNonNull(configuration, "configuration");
        }
    }

    /** Where a laser sits, and how large it is. */
    record LaserGeometry(Pose3d pose, Size3d size) implements DeviceReply {}

    /** To {@link DeviceRequest.GetConfiguration} and {@link DeviceRequest.SetLaserConfiguration} of a laser. */
    record OfLaser(LaserConfiguration configuration) implements DeviceReply {
        public OfLaser {
            requireNonNull(configuration, "configuration");
        }
    }

    /** To {@link DeviceRequest.LaserId}. */
    record LaserId(int id) implements DeviceReply {}

    /** To {@link DeviceRequest.GetPose}: in the world's frame. */
    record ModelPose(String model, double px, double py, double pa) implements DeviceReply {
        public ModelPose {
            requireNonNull(model, "model");
        }
    }

    /** To {@link DeviceRequest.GetColour}. */
    record Colour(int channel, int rmin, int rmax, int gmin, int gmax, int bmin, int bmax) implements DeviceReply {}
}
