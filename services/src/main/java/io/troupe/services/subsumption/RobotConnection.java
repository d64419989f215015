package io.troupe.services.subsumption;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.player.PlayerClient;
import io.troupe.player.structures.PlayerConstants;
import org.jspecify.annotations.Nullable;

/**
 * A connection with one robot, for a service that waits for readings on an actor space.
 *
 * <p><b>Threads.</b> The thread of the actor space on which it was created. <b>Errors.</b>
 * {@link io.troupe.player.PlayerException} when the server refuses a request or has disconnected.
 *
 * <p><b>Source.</b> Paper, Figure 7.
 */
final class RobotConnection implements AutoCloseable {
    private final PlayerClient client;
    private final PlayerDevices devices;
    private @Nullable Deferred<Boolean> waiting;
    private @Nullable Promise<Boolean> reading;

    private RobotConnection(PlayerClient client, int robot, boolean usesLaser) {
        this.client = client;
        // in pull mode one frame holds all readings of a tick, also over a socket
        client.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
        DriverLimits.watch(client);
        devices = new PlayerDevices(client, robot, usesLaser);
        client.runThreaded(-1, -1);
    }

    static RobotConnection connect(String host, int port, int robot, boolean usesLaser) {
        var client = new PlayerClient(host, port);
        try {
            return new RobotConnection(client, robot, usesLaser);
        } catch (RuntimeException refused) {
            client.close();
            throw refused;
        }
    }

    PlayerDevices devices() {
        return devices;
    }

    /** Resolves to true as soon as new data are ready, or to false if {@link #wake} is called first. */
    Promise<Boolean> nextData() {
        var next = new Deferred<Boolean>();
        reading = client.nextData().thenApply(ready -> true);
        next.resolveFrom(reading);
        waiting = next;
        return next;
    }

    /** Resolves the promise of {@link #nextData} with false. */
    void wake() {
        if (waiting != null) {
            waiting.resolve(false);
        }
    }

    @Override
    public void close() {
        if (reading != null) {
            reading.cancel(); // closing the client would reject a pending promise
        }
        client.close();
    }
}
