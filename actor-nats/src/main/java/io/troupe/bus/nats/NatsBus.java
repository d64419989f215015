package io.troupe.bus.nats;

import io.troupe.bus.Bus;
import io.troupe.bus.BusException;
import io.troupe.bus.BusSettings;

/**
 * Opens a bus between processes that a NATS server connects.
 *
 * {@snippet :
 * try (Bus bus = NatsBus.open("robot1", NatsSettings.at(address), BusSettings.on(space))) {
 *     bus.attach("sensor").publish(OUTSIDE, new Temperature(-3));
 * }
 * }
 *
 * <p><b>Role.</b> Everything else is as on a {@link Bus} inside one process: ports, topics, operations, a broker on
 * top.
 *
 * <p><b>Errors.</b> At most once: nothing is repeated, and nothing is kept for later while there is no connection. A
 * connection that is cut is noticed after 1.5 s at most; until it is back, requests are rejected at once and
 * publications are reported to the observer. It connects again by itself, for ever.
 */
public final class NatsBus {
    private NatsBus() {}

    /**
     * Opens a bus.
     *
     * @param node the name of this process, which no other process on the bus has
     * @throws BusException if there is no server, it refuses this process, or another process has the name; the message
     *     is one line that names the remedy
     */
    public static Bus open(String node, NatsSettings server, BusSettings settings) {
        return Bus.open(node, new NatsEngine(server), settings);
    }
}
