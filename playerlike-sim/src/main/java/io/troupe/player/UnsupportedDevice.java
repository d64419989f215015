package io.troupe.player;

import io.troupe.player.wire.DeviceData;

/**
 * A device of an interface that this client does not support. Programs may mention its class; no server grants access
 * to it.
 */
abstract class UnsupportedDevice extends PlayerDevice {
    private final LatestValue<DeviceData> nothing = new LatestValue<>();
    private final String interfaceName;

    UnsupportedDevice(PlayerClient client, String interfaceName) {
        super(client);
        this.interfaceName = interfaceName;
    }

    final PlayerException notSupported() {
        return pc.notSupported(interfaceName);
    }

    @Override
    final LatestValue<?> latest() {
        return nothing;
    }

    @Override
    final void accept(DeviceData message) {}
}
