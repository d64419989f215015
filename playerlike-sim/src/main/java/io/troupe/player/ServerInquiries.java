package io.troupe.player;

import io.troupe.player.structures.PlayerDevAddr;
import io.troupe.player.structures.player.PlayerDeviceDevlist;
import io.troupe.player.structures.player.PlayerDeviceDriverInfo;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.ReplaceRule;
import java.lang.System.Logger.Level;
import java.time.Duration;
import java.util.List;
import java.util.logging.Logger;
import org.jspecify.annotations.Nullable;

/** What a client asks its server about itself, and the settings of the line to it. */
abstract class ServerInquiries extends OfferedInterfaces {
    private static final System.Logger LOG = System.getLogger(PlayerClient.class.getName());
    private static final long REPLY_LIMIT_MILLIS = 10_000;

    final Latest<Devices> devices = new Latest<>();
    private final Latest<PlayerDeviceDriverInfo> driverInfo = new Latest<>();
    private final int port;
    private volatile long readTimeoutMillis = REPLY_LIMIT_MILLIS;

    ServerInquiries(String threadName, int port) {
        super(threadName);
        this.port = port;
    }

    /** Asks which devices the server has; the answer is there when this returns. */
    public void requestDeviceList() {
        devices.put(new Devices(calling(connection()::devices)));
    }

    /** True once for each answer to {@link #requestDeviceList}, and once for the list that a new client has. */
    public boolean isReadyPDDList() {
        return devices.takeNew();
    }

    /** The server's devices: as a new client has found them, or the newest answer to {@link #requestDeviceList}. */
    public @Nullable PlayerDeviceDevlist getPDDList() {
        Devices newest = devices.get();
        return newest == null ? null : newest.list();
    }

    /** Asks which driver is behind a device; the answer is there when this returns. */
    public void requestDriverInfo(PlayerDevAddr device) {
        var answer = new PlayerDeviceDriverInfo();
        answer.setAddr(device);
        answer.setDriverName(calling(() -> connection().driverName(PlayerDevice.convert(device))));
        driverInfo.put(answer);
    }

    /** True once for each answer to {@link #requestDriverInfo}. */
    public boolean isReadyPDDI() {
        return driverInfo.takeNew();
    }

    /** The answer to {@link #requestDriverInfo}, or null before. */
    public @Nullable PlayerDeviceDriverInfo getPDDI() {
        return driverInfo.get();
    }

    /**
     * Says what the server does with messages that wait for this client; the newest rule that matches counts.
     *
     * @param interf code of an interface; -1 in this and the next three matches everything
     * @param type of message, for example {@code PLAYER_MSGTYPE_DATA}
     * @param replace 0: they queue up; 1: a new message takes the place of the newest one of its kind; 2: they are
     *     dropped
     */
    public void requestAddReplaceRule(int interf, int index, int type, int subtype, int replace) {
        if (replace < ReplaceRule.ACCEPT || replace > ReplaceRule.IGNORE) {
            throw new PlayerException("replace is " + replace + ", expected 0 (accept), 1 (replace) or 2 (ignore)");
        }
        tell(() -> connection().replace(new ReplaceRule(interf, index, type, subtype, replace)));
    }

    /** No Player 3 server authenticates its clients, so nothing is sent; leaves a warning in the log. */
    public void requestAuthentication(byte[] key) {
        notServed("authentication");
    }

    /** False: see {@link #requestAuthentication}. */
    public boolean isAuthenticated() {
        return false;
    }

    /** No Player 3 server tells the ports of robots by their names, so nothing is sent; leaves a warning in the log. */
    public void requestNameService(char[] name) {
        notServed("name service");
    }

    /** False: see {@link #requestNameService}. */
    public boolean isReadyPortNumber() {
        return false;
    }

    /** The port that this client is connected to. */
    public int getPortNumber() {
        return port;
    }

    /** Player 3 servers have no such request: they say who they are when a client connects, which is in the log. */
    public void requestIdent() {
        notServed("identification");
    }

    private void notServed(String what) {
        LOG.log(Level.WARNING, "{0}: Player 3 servers have no {1}", getName(), what);
    }

    /**
     * How long a call takes at most, for sending and for waiting for the server's reply together, in milliseconds;
     * 10,000 unless set. Data are waited for as long as it takes.
     */
    public long getReadTimeout() {
        return readTimeoutMillis;
    }

    public void setReadTimeout(long millis) {
        if (millis < 1) {
            throw new PlayerException("read timeout is " + millis + " ms, expected at least 1");
        }
        tell(() -> connection().replyLimit(Duration.ofMillis(millis)));
        readTimeoutMillis = millis;
    }

    /** Where a client's warnings go. */
    public Logger getLogger() {
        return Logger.getLogger(PlayerClient.class.getName());
    }

    /**
     * The devices of a server, converted when they are first read: a thousand clients of a world of three thousand
     * devices share one list of addresses.
     */
    static final class Devices {
        private final List<DeviceAddress> addresses;
        private @Nullable PlayerDeviceDevlist converted;

        Devices(List<DeviceAddress> addresses) {
            this.addresses = addresses;
        }

        synchronized PlayerDeviceDevlist list() {
            PlayerDeviceDevlist list = converted;
            if (list == null) {
                list = new PlayerDeviceDevlist();
                list.setDevList(addresses.stream().map(PlayerDevice::convert).toArray(PlayerDevAddr[]::new));
                list.setDeviceCount(list.getDevList().length);
                converted = list;
            }
            return list;
        }
    }
}
