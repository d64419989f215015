package io.troupe.services.subsumption;

import io.troupe.player.PlayerClient;
import io.troupe.player.Position2DInterface;
import java.time.Duration;

/**
 * What every service and component asks of a Player server, so that no robot is driven on by a program that is gone.
 */
public final class DriverLimits {
    /**
     * A robot that gets no speed from its service for so long, on the server's clock, is stopped by the server: four
     * cycles, so that with the interval in which the last speed arrived a robot stands within half a second.
     */
    public static final Duration COMMAND_LIMIT = Duration.ofMillis(400);

    /** A connected server that says nothing for so long, by our clock, and answers nothing, ends the service. */
    public static final Duration SILENCE_LIMIT = Duration.ofSeconds(5);

    private DriverLimits() {}

    /** Asks once for each connection. */
    public static void watch(PlayerClient server) {
        server.setSilenceLimit(SILENCE_LIMIT);
    }

    /** Asks for each robot that the connection drives. */
    public static void limit(Position2DInterface wheels) {
        wheels.setCommandLimit(COMMAND_LIMIT);
    }
}
