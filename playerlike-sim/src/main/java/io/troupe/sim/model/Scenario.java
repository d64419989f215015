package io.troupe.sim.model;

import java.util.List;

/** A world and the devices it offers: the content of a {@code .cfg} file with its {@code .world} file. */
public record Scenario(WorldSpec world, List<DeviceBinding> devices) {
    public Scenario {
        devices = List.copyOf(devices);
    }
}
