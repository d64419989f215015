package io.troupe.player.wire;

import java.time.Duration;
import java.util.List;
import java.util.function.Consumer;

/**
 * A client's line to a server.
 *
 * <p><b>Threads.</b> Any thread. <b>Errors.</b> Every method but {@code close} throws {@link LineClosedException} once
 * the line is closed, and {@link IllegalArgumentException} for a device that the server does not have.
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

    /**
     * Never answered by the device. Counts from the end of the tick in which it is sent; sent after {@link #answered},
     * from the end of the next one.
     */
    void command(DeviceAddress device, DeviceCommand command);

    DeviceReply request(DeviceAddress device, DeviceRequest request);

    /**
     * The same without waiting: the receiver gets the reply, in this call where the server is in this JVM, else when it
     * comes, on a thread of the line. A request that is not answered in time, or whose line is lost before, has a
     * {@link DeviceReply.Nack} that says so.
     */
    default void request(DeviceAddress device, DeviceRequest request, Consumer<DeviceReply> receiver) {
        receiver.accept(request(device, request));
    }

    /**
     * How long a call may take for sending and waiting for the server's reply together; in this JVM nothing is waited
     * for.
     */
    default void replyLimit(Duration limit) {}

    /**
     * How long the server may say nothing, not even when it is asked for a sign of life, before {@link DataSink#lost}
     * is called, zero for no limit; the connection stays open. In this JVM no server is silent.
     */
    default void silenceLimit(Duration limit) {}

    /**
     * Lock step: this client has done what it wants to do about the frame of that tick and waits for a newer one.
     *
     * @param tick {@link #NO_TICK} while it waits for its first
     */
    void answered(long tick);

    /**
     * Whether this client says when it has answered; it does unless it is told otherwise. One that does not, as a push
     * client behind a socket, is waited for by no tick, and a world that has such a client keeps pace with real time.
     */
    void answers(boolean whether);

    /**
     * Over a socket: when the server sends data; a client that asks for them ({@link Delivery#PULL}) answers by asking.
     * In this JVM nothing changes.
     */
    void delivery(Delivery mode);

    /** Adds a rule for the messages that wait for this client; the newest rule that matches counts. */
    void replace(ReplaceRule rule);

    @Override
    void close();
}
