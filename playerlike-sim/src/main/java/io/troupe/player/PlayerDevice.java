package io.troupe.player;

import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.PlayerDevAddr;
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

    /** Seconds on the server's clock when the newest data were taken. */
    protected volatile double timestamp;

    private volatile @Nullable DeviceAddress address;
    private volatile byte access;
    private volatile String driverName = "";

    protected PlayerDevice(PlayerClient client) {
        this.pc = Objects.requireNonNull(client, "client");
    }

    /** Seconds on the server's clock (simulated time) when the newest data were taken; 0 before there are any. */
    public double getTimestamp() {
        return timestamp;
    }

    public PlayerDevAddr getDeviceAddress() {
        return convert(address());
    }

    /** Makes this object stand for another device, whose data it gets if the client has subscribed to that. */
    public void setDeviceAddress(PlayerDevAddr newAddress) {
        address = convert(newAddress);
    }

    /** {@code PLAYER_OPEN_MODE}, or {@code PLAYER_CLOSE_MODE} if it was requested to be closed. */
    public byte getDeviceAccess() {
        return access;
    }

    public void setDeviceAccess(byte newAccess) {
        access = newAccess;
    }

    /** The name of the driver behind the device. */
    public String getDeviceDriverName() {
        return driverName;
    }

    public void setDeviceDriverName(String newName) {
        driverName = newName;
    }

    /** Takes the content of a data message. */
    abstract void accept(DeviceData data);

    /** The newest data, and whether they have been looked for. */
    abstract Latest<?> latest();

    final void accept(double timeSeconds, DeviceData data) {
        accept(data);
        timestamp = timeSeconds; // last: whoever sees a new one without asking isDataReady() finds its data
    }

    final void bind(DeviceAddress newAddress, byte newAccess, String newDriverName) {
        address = newAddress;
        access = newAccess;
        driverName = newDriverName;
    }

    final DeviceAddress address() {
        DeviceAddress bound = address;
        if (bound == null) {
            throw new PlayerException(
                    "this device is not subscribed: get it from a requestInterface method of PlayerClient");
        }
        return bound;
    }

    static PlayerDevAddr convert(DeviceAddress address) {
        var converted = new PlayerDevAddr();
        converted.setHost(address.host());
        converted.setRobot(address.robot());
        converted.setInterf((short) address.interfaceCode());
        converted.setIndex((short) address.index());
        return converted;
    }

    static DeviceAddress convert(PlayerDevAddr address) {
        return new DeviceAddress(address.getHost(), address.getRobot(), address.getInterf(), address.getIndex());
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

    /** What a call throws that is in the API, and that no server of ours serves today. */
    final PlayerException notOffered(String call) {
        return new PlayerException(call + " of " + this + " is not offered yet");
    }

    @Override
    public String toString() {
        DeviceAddress bound = address;
        return bound == null
                ? getClass().getSimpleName()
                : Interfaces.name(bound.interfaceCode()) + ":" + bound.index();
    }
}
