package io.troupe.services.bus;

/**
 * Carries messages between components: by publish and subscribe, and by request and reply.
 *
 * <p><b>Role.</b> The seam between one process and many: {@code InProcessBus} is inside one; a distributed bus
 * implements the same two interfaces. Nothing that crosses it is a reference: addresses are names, messages are records
 * of values.
 *
 * <p><b>Source.</b> Paper, sections 2.1.2 and 2.2.3.
 */
public interface Bus extends AutoCloseable {
    /** The name of this process on the bus. */
    String node();

    /**
     * Attaches something under a name.
     *
     * @throws IllegalArgumentException if the name is taken
     */
    BusPort attach(String name);

    /** Ends all ports; questions that wait for an answer are rejected. */
    @Override
    void close();
}
