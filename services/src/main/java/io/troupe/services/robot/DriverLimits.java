package io.troupe.services.robot;

import io.troupe.player.Position2DInterface;
import java.time.Duration;

/**
 * Time limits that every service and component requests from a Player server, so that no robot keeps moving after its
 * program has gone.
 */
public final class DriverLimits {
    /**
     * The server stops a robot that gets no speed command for this long, on the server's clock. It is four cycles:
     * together with the interval in which the last command arrived, the robot stands within half a second.
     */
    public static final Duration COMMAND_LIMIT = Duration.ofMillis(400);

    /**
     * A connected server that sends nothing for this long, on this program's clock, and does not answer a request
     * either, ends the service.
     */
    public static final Duration SILENCE_LIMIT = Duration.ofSeconds(5);

    private DriverLimits() {}

    /** Requests the command limit; once for each robot that the connection drives. */
    public static void limit(Position2DInterface wheels) {
        wheels.setCommandLimit(COMMAND_LIMIT);
    }
}
