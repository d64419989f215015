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

/** A client's requests to the server itself, and the settings of the connection. */
abstract class ServerRequests extends SupportedInterfaces {
    private static final System.Logger LOG = System.getLogger(PlayerClient.class.getName());
    private static final long REPLY_LIMIT_MILLIS = 10_000;

    final LatestValue<Devices> devices = new LatestValue<>();
    private final LatestValue<PlayerDeviceDriverInfo> driverInfo = new LatestValue<>();
    private final int port;
    private volatile long readTimeoutMillis = REPLY_LIMIT_MILLIS;

    ServerRequests(String threadName, int port) {
        super(threadName);
        this.port = port;
    }

    /** Requests the list of devices; the reply has arrived when this call returns. */
    public void requestDeviceList() {
        devices.put(new Devices(compute(connection()::devices)));
    }

    /** True once for each reply to {@link #requestDeviceList}, and once for the list that a new client starts with. */
    public boolean isReadyPDDList() {
        return devices.takeNew();
    }

    /** The server's devices: the list from connecting, or the newest reply to {@link #requestDeviceList}. */
    public @Nullable PlayerDeviceDevlist getPDDList() {
        Devices newest = devices.get();
        return newest == null ? null : newest.list();
    }

    /** Requests the driver of a device; the reply has arrived when this call returns. */
    public void requestDriverInfo(PlayerDevAddr device) {
        var answer = new PlayerDeviceDriverInfo();
        answer.setAddr(device);
        answer.setDriverName(compute(() -> connection().driverName(PlayerDevice.convert(device))));
        driverInfo.put(answer);
    }

    /** True once for each reply to {@link #requestDriverInfo}. */
    public boolean isReadyPDDI() {
        return driverInfo.takeNew();
    }

    /** The newest reply to {@link #requestDriverInfo}, or null before the first. */
    public @Nullable PlayerDeviceDriverInfo getPDDI() {
        return driverInfo.get();
    }

    /**
     * Sets what the server does with messages queued for this client; the newest matching rule applies.
     *
     * @param interf code of an interface; -1 in this and the next three parameters matches everything
     * @param type type of message, for example {@code PLAYER_MSGTYPE_DATA}
     * @param replace 0: messages queue up; 1: a new message replaces the newest queued one of its kind; 2: messages are
     *     dropped
     */
    public void requestAddReplaceRule(int interf, int index, int type, int subtype, int replace) {
        if (replace < ReplaceRule.ACCEPT || replace > ReplaceRule.IGNORE) {
            throw new PlayerException("replace is " + replace + ", expected 0 (accept), 1 (replace) or 2 (ignore)");
        }
        execute(() -> connection().replace(new ReplaceRule(interf, index, type, subtype, replace)));
    }

    /** Only logs a warning: no Player 3 server authenticates its clients, so nothing is sent. */
    public void requestAuthentication(byte[] key) {
        notServed("authentication");
    }

    /** Always false: see {@link #requestAuthentication}. */
    public boolean isAuthenticated() {
        return false;
    }

    /** Only logs a warning: no Player 3 server maps robot names to ports, so nothing is sent. */
    public void requestNameService(char[] name) {
        notServed("name service");
    }

    /** Always false: see {@link #requestNameService}. */
    public boolean isReadyPortNumber() {
        return false;
    }

    /** The port that this client is connected to. */
    public int getPortNumber() {
        return port;
    }

    /**
     * Only logs a warning: Player 3 has no such request. Its servers send their identification when a client connects;
     * the client logs it.
     */
    public void requestIdent() {
        notServed("identification");
    }

    private void notServed(String what) {
        LOG.log(Level.WARNING, "{0}: Player 3 servers have no {1}", getName(), what);
    }

    /**
     * Limit of a call in milliseconds, for sending and for waiting for the reply together; 10,000 by default. Waiting
     * for data has no limit.
     */
    public long getReadTimeout() {
        return readTimeoutMillis;
    }

    public void setReadTimeout(long millis) {
        if (millis < 1) {
            throw new PlayerException("read timeout is " + millis + " ms, expected at least 1");
        }
        execute(() -> connection().replyLimit(Duration.ofMillis(millis)));
        readTimeoutMillis = millis;
    }

    /** The logger of a client's warnings. */
    public Logger getLogger() {
        return Logger.getLogger(PlayerClient.class.getName());
    }

    /**
     * The devices of a server, converted when first read: a thousand clients of a world with three thousand devices
     * share one list of addresses.
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
