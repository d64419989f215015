package io.troupe.services.subsumption;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.player.PlayerClient;
import io.troupe.player.structures.PlayerConstants;
import org.jspecify.annotations.Nullable;

/**
 * A connection with one robot, for a service that waits for its readings on an actor space.
 *
 * <p><b>Threads.</b> The actor space on whose thread it was made. <b>Errors.</b>
 * {@link io.troupe.player.PlayerException} when the server refuses or has gone.
 *
 * <p><b>Source.</b> Paper, Figure 7.
 */
final class RobotLink implements AutoCloseable {
    private final PlayerClient client;
    private final RobotDevices devices;
    private @Nullable Deferred<Boolean> waiting;
    private @Nullable Promise<Boolean> reading;

    private RobotLink(PlayerClient client, int robot, boolean usesLaser) {
        this.client = client;
        client.requestDataDeliveryMode(
                PlayerConstants.PLAYER_DATAMODE_PULL); // behind a socket, too, a frame is all readings of a time
        DriverLimits.watch(client);
        devices = new RobotDevices(client, robot, usesLaser);
        client.runThreaded(-1, -1);
    }

    static RobotLink connect(String host, int port, int robot, boolean usesLaser) {
        var client = new PlayerClient(host, port);
        try {
            return new RobotLink(client, robot, usesLaser);
        } catch (RuntimeException refused) {
            client.close();
            throw refused;
        }
    }

    RobotDevices devices() {
        return devices;
    }

    /** True as soon as new data are ready, or false when {@link #wake} is called first. */
    Promise<Boolean> nextData() {
        var next = new Deferred<Boolean>();
        reading = client.nextData().thenApply(ready -> true);
        next.resolveFrom(reading);
        waiting = next;
        return next;
    }

    /** Ends the waiting of {@link #nextData}. */
    void wake() {
        if (waiting != null) {
            waiting.resolve(false);
        }
    }

    @Override
    public void close() {
        if (reading != null) {
            reading.cancel(); // whoever closes does not want to hear that the client was closed
        }
        client.close();
    }
}
