package io.troupe.player;

import io.troupe.player.wire.DeviceData;

/**
 * A device of an interface that this client does not support. Programs may mention its class; no server grants access
 * to it.
 */
abstract class UnofferedDevice extends PlayerDevice {
    private final Latest<DeviceData> nothing = new Latest<>();
    private final String interfaceName;

    UnofferedDevice(PlayerClient client, String interfaceName) {
        super(client);
        this.interfaceName = interfaceName;
    }

    final PlayerException notOffered() {
        return pc.notOffered(interfaceName);
    }

    @Override
    final Latest<?> latest() {
        return nothing;
    }

    @Override
    final void accept(DeviceData message) {}
}
