package io.troupe.player.wire;

import java.util.List;

/**
 * A client's line to a server.
 *
 * <p><b>Threads.</b> Any thread. <b>Errors.</b> Every method but {@code close} throws {@link LineClosedException} once the line is closed,
 * and {@link IllegalArgumentException} for a device that the server does not have.
 */
public interface PlayerConnection extends AutoCloseable {
    /** Before the first tick, which is 0. */
    long NO_TICK = -1;

    List<DeviceAddress> devices();

    /** Name of the driver behind a device, {@code stage} for simulated ones. */
    String driverName(DeviceAddress device);

    /** From now on the device's data come with every frame. */
    void subscribe(DeviceAddress device);

    void unsubscribe(DeviceAddress device);

    /** Never answered by the device. Counts from the end of the tick in which it is sent; sent after {@link #answered}, from the end of the next one. */
    void command(DeviceAddress device, DeviceCommand command);

    DeviceReply request(DeviceAddress device, DeviceRequest request);

    /**
     * Lock step: this client has done what it wants to do about the frame of that tick and waits for a newer one.
     *
     * @param tick {@link #NO_TICK} while it waits for its first
     */
    void answered(long tick);

    /**
     * This client cannot say when it has answered, as a push client behind a socket: from now on no tick waits for it, and a world that has such a client
     * keeps pace with real time. For good.
     */
    void neverAnswers();

    /** Over a socket: when the server sends data; a client that asks for them ({@link Delivery#PULL}) answers by asking. In this JVM nothing changes. */
    void delivery(Delivery mode);

    /** Adds a rule for the messages that wait for this client; the newest rule that matches counts. */
    void replace(ReplaceRule rule);

    @Override
    void close();
}
