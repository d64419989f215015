package io.troupe.player;

import io.troupe.player.wire.DataMessage;
import io.troupe.player.wire.DeviceAddress;
import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;

/**
 * The devices a client has subscribed to.
 *
 * <p><b>Threads.</b> Any thread; messages are dispatched under the lock of {@link Incoming}.
 */
final class Subscriptions {
    private final List<PlayerDevice> devices = new CopyOnWriteArrayList<>();

    void add(PlayerDevice device) {
        devices.add(device);
    }

    void remove(PlayerDevice device) {
        devices.remove(device);
    }

    void removeAll(DeviceAddress address) {
        devices.removeIf(each -> each.address().equals(address));
    }

    boolean everythingSeen() {
        for (var device : devices) {
            if (device.latest().isNew()) {
                return false;
            }
        }
        return true;
    }

    void dispatch(DataMessage message) {
        for (var device : devices) {
            if (device.address().equals(message.from())) {
                device.receive(message);
            }
        }
    }
}
