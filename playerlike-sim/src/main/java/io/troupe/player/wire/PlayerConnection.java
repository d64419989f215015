package io.troupe.player.wire;

import java.time.Duration;
import java.util.List;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * A client's connection to a server.
 *
 * <p><b>Threads.</b> Any thread. <b>Errors.</b> Every method but {@code close} throws {@link ConnectionClosedException}
 * once the connection is closed, and {@link IllegalArgumentException} for a device that the server does not have.
 */
public interface PlayerConnection extends AutoCloseable {
    /** The value before the first tick, which is 0. */
    long NO_TICK = -1;

    List<DeviceAddress> devices();

    /** The name of the driver that serves a device, {@code stage} for simulated devices. */
    String driverName(DeviceAddress device);

    /** Adds the data of a device to every following frame. */
    void subscribe(DeviceAddress device);

    void unsubscribe(DeviceAddress device);

    /**
     * Sends a command, which has no reply. It takes effect at the end of the tick in which it is sent; if sent after
     * {@link #answered}, at the end of the next tick.
     */
    void command(DeviceAddress device, DeviceCommand command);

    DeviceReply request(DeviceAddress device, DeviceRequest request);

    /**
     * Sends a request without waiting for the reply. The receiver gets the reply: within this call if the server is in
     * this JVM, else on a thread of the connection. If no reply arrives within the limit, or if the connection is lost
     * first, the receiver gets a {@link DeviceReply.Nack} with the reason.
     */
    default void request(DeviceAddress device, DeviceRequest request, Consumer<DeviceReply> receiver) {
        receiver.accept(request(device, request));
    }

    /** Sets the limit of a call, for sending and for waiting for the reply together. In this JVM no call waits. */
    default void replyLimit(Duration limit) {}

    /**
     * Sets how long the server may send nothing, not even a reply to a keep-alive request, before {@link DataSink#lost}
     * is called; null for no limit. The connection stays open. In this JVM a server is never silent.
     */
    default void silenceLimit(@Nullable Duration limit) {}

    /**
     * Lock step: this client has handled the frame of that tick and waits for a newer one.
     *
     * @param tick {@link #NO_TICK} while the client waits for its first frame
     */
    void answered(long tick);

    /**
     * Sets whether this client answers ticks; it does by default. The world does not wait for a client that does not,
     * such as a push client over a socket, and keeps pace with real time while it has one.
     */
    void answers(boolean whether);

    /** True if the world's time does not pass until this client answers: then none of its commands is late. */
    default boolean isWaitedFor() {
        return false;
    }

    /**
     * Sets the delivery mode of a connection over a socket. A client that requests its data ({@link Delivery#PULL})
     * answers a tick by its next request. In this JVM nothing changes.
     */
    void delivery(Delivery mode);

    /** Adds a rule for messages queued for this client; the newest matching rule applies. */
    void replace(ReplaceRule rule);

    @Override
    void close();
}
