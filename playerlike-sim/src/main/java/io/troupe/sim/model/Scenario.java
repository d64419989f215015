package io.troupe.sim.model;

import java.util.List;
import java.util.OptionalInt;

/** A world and the devices it offers: the content of a {@code .cfg} file with its {@code .world} file. */
public record Scenario(WorldSpec world, List<DeviceBinding> devices) {
    public Scenario {
        devices = List.copyOf(devices);
    }

    /** The same world, with all its devices on another port: for a second world in one JVM. */
    public Scenario withPort(int port) {
        return new Scenario(
                world,
                devices.stream()
                        .map(device -> new DeviceBinding(
                                port,
                                device.interfaceName(),
                                device.index(),
                                device.model(),
                                device.ranger(),
                                device.where()))
                        .toList());
    }

    /** The port on which the robots are offered: that of the first position2d; empty if there is none. */
    public OptionalInt robotPort() {
        return devices.stream()
                .filter(device -> device.interfaceName().equals("position2d"))
                .mapToInt(DeviceBinding::port)
                .findFirst();
    }
}
