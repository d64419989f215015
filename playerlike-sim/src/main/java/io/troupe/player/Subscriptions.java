package io.troupe.player;

import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.DeviceDataMessage;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.CopyOnWriteArrayList;

/**
 * The subscribed devices of a client by address; one client may subscribe to the devices of a thousand robots.
 *
 * <p><b>Threads.</b> Any thread; messages are dispatched under the lock of {@link ClientInbox}.
 */
final class Subscriptions {
    private final Map<DeviceAddress, List<PlayerDevice>> devices = new ConcurrentHashMap<>();

    void add(PlayerDevice device) {
        at(device.address()).add(device);
    }

    void remove(PlayerDevice device) {
        at(device.address()).remove(device);
    }

    void removeAll(DeviceAddress address) {
        at(address).clear();
    }

    /** Binds a device to another address. */
    void move(PlayerDevice device, DeviceAddress from, DeviceAddress to) {
        if (at(from).remove(device)) {
            at(to).add(device);
        }
    }

    private List<PlayerDevice> at(DeviceAddress address) {
        return devices.computeIfAbsent(address, none -> new CopyOnWriteArrayList<>());
    }

    boolean everythingSeen() {
        for (var same : devices.values()) {
            for (var device : same) {
                if (device.latest().isNew()) {
                    return false;
                }
            }
        }
        return true;
    }

    void dispatch(DeviceDataMessage message) {
        List<PlayerDevice> same = devices.get(message.from());
        if (same != null) {
            for (var device : same) {
                device.receive(message);
            }
        }
    }
}
