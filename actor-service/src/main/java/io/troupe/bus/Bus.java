package io.troupe.bus;

/**
 * Carries messages between components: by publish and subscribe, and by request and reply.
 *
 * <p><b>Role.</b> Separates components from the transport: {@code InProcessBus} works inside one process; a distributed
 * bus implements the same two interfaces. No reference crosses the bus: addresses are names, messages are records of
 * values.
 *
 * <p><b>Source.</b> Paper, sections 2.1.2 and 2.2.3.
 */
public interface Bus extends AutoCloseable {
    /** The name of this process on the bus. */
    String node();

    /**
     * Attaches a port under a name.
     *
     * @throws IllegalArgumentException if the name is taken
     */
    BusPort attach(String name);

    /** Closes all ports; pending requests are rejected. */
    @Override
    void close();
}
