package io.troupe.player;

import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.PlayerDevAddr;
import io.troupe.player.structures.PlayerMsgHdr;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceDataMessage;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.Interfaces;
import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.lang.System.Logger.Level;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * A device that a client has subscribed to.
 *
 * <p><b>Role.</b> Created by the {@code requestInterface..} methods of {@link PlayerClient}.
 *
 * <p><b>Threads.</b> Any thread.
 *
 * <p><b>Order.</b> Commands and requests are sent at once. A request does not wait for its reply: the result is
 * available when the matching {@code is..Ready()} method returns true, in this JVM at once.
 *
 * <p><b>Errors.</b> {@link PlayerException} when the connection is lost. A request that the server refuses only logs a
 * warning, because the program has already gone on.
 */
public abstract class PlayerDevice implements PlayerConstants {
    private static final System.Logger LOG = System.getLogger(PlayerDevice.class.getName());

    /** The client that this device belongs to. */
    protected final PlayerClient pc;

    /** Time stamp of the newest data, in seconds of the server's clock. */
    protected volatile double timestamp;

    /** An empty stream: messages are decoded before they reach the device. */
    protected final InputStream is = InputStream.nullInputStream();

    /** Rejects every write: commands and requests are sent by the methods of the device. */
    protected final OutputStream os = new RejectingOutputStream();

    private @Nullable DeviceData arrived; // guarded by the lock of ClientInbox, as is the next field
    private @Nullable DeviceReply answer;
    private volatile @Nullable DeviceAddress address;
    private volatile byte access;
    private volatile String driverName = "";

    protected PlayerDevice(PlayerClient client) {
        this.pc = Objects.requireNonNull(client, "client");
    }

    /** Time stamp of the newest data in seconds of the server's clock (simulated time); 0 before the first data. */
    public double getTimestamp() {
        return timestamp;
    }

    public PlayerDevAddr getDeviceAddress() {
        return convert(address());
    }

    /** Binds this object to another device; it receives that device's data if the client has subscribed to it. */
    public void setDeviceAddress(PlayerDevAddr newAddress) {
        DeviceAddress before = address;
        DeviceAddress after = convert(newAddress);
        address = after;
        if (before != null) {
            pc.subscriptions.move(this, before, after);
        }
    }

    /** {@code PLAYER_OPEN_MODE}, or {@code PLAYER_CLOSE_MODE} if the device was requested with that mode. */
    public byte getDeviceAccess() {
        return access;
    }

    public void setDeviceAccess(byte newAccess) {
        access = newAccess;
    }

    /** The name of the driver that serves the device. */
    public String getDeviceDriverName() {
        return driverName;
    }

    public void setDeviceDriverName(String newName) {
        driverName = newName;
    }

    /**
     * Handles an arrived data message. Called by the client. A subclass that overrides this method is notified of each
     * message, and must call {@code super}.
     *
     * @throws PlayerException if called by anything but the client, because there is no message then
     */
    public void readData(PlayerMsgHdr header) {
        DeviceData data = present(arrived);
        if (data instanceof DeviceData.GeometryChanged(DeviceReply geometry)) {
            accept(geometry);
        } else {
            accept(data);
        }
        // last: a thread that sees a new time stamp without polling isDataReady() also sees its data
        timestamp = header.getTimestamp();
    }

    /** Handles an arrived reply; called by the client in the same way as {@link #readData}. */
    public void handleNARMessage() {
        DeviceReply reply = present(answer);
        if (!(reply instanceof DeviceReply.Ack)) {
            accept(reply);
        }
    }

    private <T> T present(@Nullable T message) {
        if (message == null) {
            throw new PlayerException(
                    "no message for " + this + " is there to be read: PlayerClient calls this method");
        }
        return message;
    }

    /** Handles the content of a data message. */
    abstract void accept(DeviceData data);

    /** Handles the content of a reply. */
    void accept(DeviceReply reply) {}

    /** The newest data, and whether they were polled. */
    abstract LatestValue<?> latest();

    final void receive(DeviceDataMessage message) {
        var header = new PlayerMsgHdr();
        header.setAddr(convert(message.from()));
        header.setType((byte) PLAYER_MSGTYPE_DATA);
        header.setSubtype(subtype(message.data()));
        header.setTimestamp(message.timeSeconds());
        arrived = message.data();
        try {
            readData(header);
        } finally {
            arrived = null;
        }
    }

    private static byte subtype(DeviceData data) {
        return switch (data) {
            case DeviceData.Position2d position -> 1;
            case DeviceData.SonarRanges sonar -> 1;
            case DeviceData.Blobs blobs -> 1;
            case DeviceData.LaserScan scan -> 1;
            case DeviceData.Fiducials fiducials -> 1;
            case DeviceData.BumperStates bumpers -> 1;
            case DeviceData.CameraImage image -> 1;
            case DeviceData.GripperState gripper -> 1;
            case DeviceData.RangerRanges ranges -> 1;
            case DeviceData.RangerIntensities intensities -> 3;
            case DeviceData.RangerStamped stamped -> (byte) (subtype(stamped.data()) + 1);
            case DeviceData.GeometryChanged(DeviceReply geometry) ->
                (byte) (geometry instanceof DeviceReply.RangerGeometry ? 5 : 2);
        };
    }

    final void receive(DeviceRequest request, DeviceReply reply) {
        if (reply instanceof DeviceReply.Nack(String reason)) {
            refused(request, reason);
            return;
        }
        answer = reply;
        try {
            handleNARMessage();
        } finally {
            answer = null;
        }
    }

    /** Called when the server has refused a request, or has not answered it in time. */
    void refused(DeviceRequest request, String reason) {
        LOG.log(Level.WARNING, "{0} refused {1}: {2}", this, request, reason);
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

    /** Sends a request without waiting for the reply. */
    final void ask(DeviceRequest request) {
        pc.request(this, request);
    }

    @Override
    public String toString() {
        DeviceAddress bound = address;
        return bound == null
                ? getClass().getSimpleName()
                : Interfaces.name(bound.interfaceCode()) + ":" + bound.index();
    }

    /**
     * The output stream of a device. In the original client a device writes its messages here; this one rejects every
     * write with an error that names the alternative.
     */
    private static final class RejectingOutputStream extends OutputStream {
        @Override
        public void write(int octet) throws IOException {
            throw new IOException("bytes cannot be written to a device: use the methods of its class");
        }
    }
}
