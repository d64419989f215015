package io.troupe.sim.device;

import io.troupe.sim.model.DeviceSpec;

/** A simulated device of a {@link DeviceSpec}. */
public sealed interface Device permits FiducialFinder, BumperRow, ColourCamera, GripperDevice {
    static Device of(DeviceSpec spec) {
        return switch (spec) {
            case DeviceSpec.FiducialFinder finder -> new FiducialFinder(finder);
            case DeviceSpec.Bumpers bumpers -> new BumperRow(bumpers);
            case DeviceSpec.Camera camera -> new ColourCamera(camera);
            case DeviceSpec.Gripper gripper -> new GripperDevice(gripper);
        };
    }

    /** Reads the device. Several threads may read devices of different robots. */
    void sense(Scene scene, int robot, Scratch scratch);

    /** The reading as a value; called by the thread that advances the world. */
    DeviceReading reading(Scene scene, int robot);
}
