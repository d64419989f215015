package io.troupe.sim.model;

import java.util.List;
import java.util.OptionalInt;

/** A world and the devices it offers: the content of a {@code .cfg} file with its {@code .world} file. */
public record Scenario(WorldSpec world, List<DeviceBinding> devices) {
    public Scenario {
        devices = List.copyOf(devices);
    }

    /** The port on which the robots are offered: that of the first position2d; empty if there is none. */
    public OptionalInt robotPort() {
        return devices.stream()
                .filter(device -> device.interfaceName().equals("position2d"))
                .mapToInt(DeviceBinding::port)
                .findFirst();
    }
}
