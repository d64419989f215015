package io.troupe.demo;

import io.troupe.sim.model.Scenario;
import java.util.concurrent.atomic.AtomicInteger;

/** Ports of worlds for tests that run beside each other in one JVM, where a port has one world. */
public final class OwnPort {
    private static final AtomicInteger NEXT = new AtomicInteger(7_665);

    private OwnPort() {}

    /** A port that no other world in this JVM has. */
    static int next() {
        return NEXT.getAndIncrement();
    }

    /** The same world and devices, at a port that no other world in this JVM has. */
    public static Scenario of(Scenario scenario) {
        return scenario.withPort(next());
    }
}
