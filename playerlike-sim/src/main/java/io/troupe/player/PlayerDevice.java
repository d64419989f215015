package io.troupe.player;

import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.Interfaces;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * A device that a client has subscribed to.
 *
 * <p><b>Role.</b> Made by the {@code requestInterface..} methods of {@link PlayerClient}.
 * <p><b>Threads.</b> Any thread.
 * <p><b>Errors.</b> {@link PlayerException} when the server refuses or has gone.
 */
public abstract class PlayerDevice implements PlayerConstants {
    /** The client it belongs to. */
    protected final PlayerClient pc;

    private @Nullable DeviceAddress address;
    private volatile double timestampSeconds;

    protected PlayerDevice(PlayerClient client) {
        this.pc = Objects.requireNonNull(client, "client");
    }

    /** Seconds on the server's clock (simulated time) when the newest data were taken; 0 before there are any. */
    public double getTimestamp() {
        return timestampSeconds;
    }

    /** The name of the driver behind the device. */
    public String getDeviceDriverName() {
        return pc.driverName(address());
    }

    /** Takes the content of a data message. */
    abstract void accept(DeviceData data);

    final void accept(double timeSeconds, DeviceData data) {
        timestampSeconds = timeSeconds;
        accept(data);
    }

    final void bind(DeviceAddress newAddress) {
        address = newAddress;
    }

    final DeviceAddress address() {
        if (address == null) {
            throw new PlayerException(
                    "this device is not subscribed: get it from a requestInterface method of PlayerClient");
        }
        return address;
    }

    final void send(DeviceCommand command) {
        pc.command(address(), command);
    }

    /** Asks, and throws if the device refuses. */
    final DeviceReply ask(DeviceRequest request) {
        DeviceReply reply = pc.request(address(), request);
        if (reply instanceof DeviceReply.Nack(String reason)) {
            throw new PlayerException(this + " refused " + request + ": " + reason);
        }
        return reply;
    }

    /** Whether newer data have come; a false is the moment to let the world go on. */
    final boolean takeNew(Latest<?> latest) {
        return latest.takeNew() || pc.awaitNewer(latest);
    }

    @Override
    public String toString() {
        return address == null
                ? getClass().getSimpleName()
                : Interfaces.name(address.interfaceCode()) + ":" + address.index();
    }
}
