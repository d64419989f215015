package io.troupe.player.wire;

import static java.util.Objects.requireNonNull;

/**
 * The content of a REQ message to a device; each gets exactly one {@link DeviceReply}.
 *
 * <p><b>Units and shapes.</b> Metres, radians, seconds.
 */
public sealed interface DeviceRequest {
    /**
     * Key of a position2d property: for how many milliseconds of the server's clock a speed sent by this client
     * applies. 0 = until the next command, as in Player.
     */
    String COMMAND_LIMIT_KEY = "troupe_command_limit_ms";

    /**
     * Key of a position2d property: a speed that this client sends is dropped if it arrives more than so many
     * milliseconds late, by the time stamp in its header. 0 = never, as in Player. The stamps have to come from a
     * monotonic clock.
     */
    String COMMAND_AGE_KEY = "troupe_command_age_ms";

    /** REQ 1 of position2d, sonar, ranger, laser, fiducial and bumper: requests the geometry. */
    record Geometry() implements DeviceRequest {}

    /** position2d, sonar and ranger REQ 2, laser REQ 4: switches the device on or off. */
    record Power(boolean on) implements DeviceRequest {}

    /** position2d REQ 3. */
    record VelocityMode(int mode) implements DeviceRequest {}

    /** position2d REQ 4: 0 velocity, 1 position. */
    record PositionMode(int mode) implements DeviceRequest {}

    /** position2d REQ 5. */
    record SetOdometry(double px, double py, double pa) implements DeviceRequest {}

    /** position2d REQ 6. */
    record ResetOdometry() implements DeviceRequest {}

    /** position2d REQ 7. */
    record SpeedPid(float kp, float ki, float kd) implements DeviceRequest {}

    /** position2d REQ 8. */
    record PositionPid(float kp, float ki, float kd) implements DeviceRequest {}

    /** position2d REQ 9. */
    record SpeedProfile(float speedMps, float accelerationMps2) implements DeviceRequest {}

    /** blobfinder REQ 1. */
    record SetColour(int channel, int rmin, int rmax, int gmin, int gmax, int bmin, int bmax)
            implements DeviceRequest {}

    /** blobfinder REQ 2; -1 leaves a value as it is. */
    record SetImager(int brightness, int contrast, int colourMode, int autoGain) implements DeviceRequest {}

    /** blobfinder REQ 3. */
    record GetColour() implements DeviceRequest {}

    /** ranger REQ 3: switches the publication of intensities. */
    record Intensities(boolean on) implements DeviceRequest {}

    /** ranger REQ 5, laser REQ 3. */
    record GetConfiguration() implements DeviceRequest {}

    /** ranger REQ 4. */
    record SetRangerConfiguration(RangerConfiguration configuration) implements DeviceRequest {
        public SetRangerConfiguration {
            requireNonNull(configuration, "configuration");
        }
    }

    /** laser REQ 2. */
    record SetLaserConfiguration(LaserConfiguration configuration) implements DeviceRequest {
        public SetLaserConfiguration {
            requireNonNull(configuration, "configuration");
        }
    }

    /** laser REQ 5. */
    record LaserId() implements DeviceRequest {}

    /** fiducial REQ 2. */
    record GetFieldOfView() implements DeviceRequest {}

    /** fiducial REQ 3. */
    record SetFieldOfView(float minRangeM, float maxRangeM, float angleRad) implements DeviceRequest {}

    /** fiducial REQ 7: requests the number of the marker that the robot itself has. */
    record GetMarker() implements DeviceRequest {}

    /** fiducial REQ 8: sets it. */
    record SetMarker(int id) implements DeviceRequest {}

    /** camera REQ 3: requests the newest image, which is also sent as data. */
    record GetImage() implements DeviceRequest {}

    /** simulation REQ 1: requests the pose of a model. */
    record GetPose(String model) implements DeviceRequest {
        public GetPose {
            requireNonNull(model, "model");
        }
    }

    /** simulation REQ 2: moves a model to a pose. */
    record SetPose(String model, double px, double py, double pa) implements DeviceRequest {
        public SetPose {
            requireNonNull(model, "model");
        }
    }

    /** simulation REQ 3: requests the pose of a model in space. */
    record GetPose3d(String model) implements DeviceRequest {
        public GetPose3d {
            requireNonNull(model, "model");
        }
    }

    /** simulation REQ 4: moves a model to a pose in space. */
    record SetPose3d(String model, Pose3d pose, double timeMicros) implements DeviceRequest {
        public SetPose3d {
            requireNonNull(model, "model");
        }
    }

    /**
     * simulation REQ 5: requests a property of a model.
     *
     * @param index of a property with several values
     * @param valueBytes length of the value
     */
    record GetProperty(String model, String property, int index, int valueBytes) implements DeviceRequest {
        public GetProperty {
            requireNonNull(model, "model");
            requireNonNull(property, "property");
        }
    }

    /** simulation REQ 6: sets a property of a model. */
    record SetProperty(String model, String property, int index, Octets value) implements DeviceRequest {
        public SetProperty {
            requireNonNull(model, "model");
            requireNonNull(property, "property");
        }
    }

    /**
     * position2d REQ 253: sets an integer property of the driver.
     *
     * @param key our server only has {@link #COMMAND_LIMIT_KEY} and {@link #COMMAND_AGE_KEY}
     */
    record SetIntegerProperty(String key, int value) implements DeviceRequest {
        public SetIntegerProperty {
            requireNonNull(key, "key");
        }
    }

    /** REQ 255 of every interface: whether the device supports a message. */
    record Capability(int type, int subtype) implements DeviceRequest {}

    /** A request that no device of ours supports; always refused. */
    record Unknown(int subtype) implements DeviceRequest {}
}
