package io.troupe.services.robot;

import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.player.PlayerClient;
import io.troupe.player.structures.PlayerConstants;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * A connection with one or more robots of a Player server.
 *
 * <p><b>Role.</b> Opened by the program that drives the robots, and closed by it. Readings arrive in one of two ways.
 * On an actor space, call {@link #readOnSpace} once and then wait for {@link #nextData}. On a plain thread, call
 * {@link #readAll}, which blocks until the next reading.
 *
 * <p><b>Threads.</b> The thread on which it was opened. <b>Errors.</b> {@link io.troupe.player.PlayerException} when
 * the server refuses a request or has disconnected.
 *
 * <p><b>Source.</b> Paper, Figure 7.
 */
public final class RobotConnection implements AutoCloseable {
    /** How the server delivers data. */
    public enum Delivery {
        /** On request: one frame holds all readings of a tick, also over a socket. */
        PULL,
        /** As soon as there are data: the default of a Player server. */
        PUSH
    }

    /**
     * The devices of one robot to subscribe to, besides its wheels and its sonar ring.
     *
     * @param index Player index, from 0
     */
    public record Devices(int index, boolean camera, boolean laser) {}

    private final PlayerClient client;
    private final List<PlayerRobot> robots = new ArrayList<>();
    private @Nullable Deferred<Boolean> waiting;
    private @Nullable Promise<Boolean> reading;

    private RobotConnection(PlayerClient client) {
        this.client = client;
    }

    /** Connects, subscribes to the devices of the robots, and sets the {@link DriverLimits}. */
    public static RobotConnection open(String host, int port, Delivery delivery, List<Devices> robots) {
        return open(host, port, delivery, robots, DriverLimits.SILENCE_LIMIT);
    }

    /** The same with another silence limit. */
    public static RobotConnection open(
            String host, int port, Delivery delivery, List<Devices> robots, Duration silenceLimit) {
        var connection = new RobotConnection(new PlayerClient(host, port));
        try {
            connection.subscribe(delivery, robots, silenceLimit);
            return connection;
        } catch (RuntimeException refused) {
            connection.client.close();
            throw refused;
        }
    }

    private void subscribe(Delivery delivery, List<Devices> devices, Duration silenceLimit) {
        if (delivery == Delivery.PULL) {
            client.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
        }
        client.setSilenceLimit(silenceLimit);
        for (Devices each : devices) {
            robots.add(new PlayerRobot(client, each));
        }
    }

    /** The robots, in the order in which they were given; unmodifiable. */
    public List<PlayerRobot> robots() {
        return Collections.unmodifiableList(robots);
    }

    /** Receives data on the current actor space from now on. */
    public void readOnSpace() {
        client.runThreaded(-1, -1);
    }

    /** Resolves to true as soon as new data are ready, or to false if {@link #wake} is called first. */
    public Promise<Boolean> nextData() {
        var next = new Deferred<Boolean>();
        reading = client.nextData().thenApply(ready -> true);
        next.resolveFrom(reading);
        waiting = next;
        return next;
    }

    /** Resolves the promise of {@link #nextData} with false. */
    public void wake() {
        if (waiting != null) {
            waiting.resolve(false);
        }
    }

    /** Blocks until the next reading of all robots; for a plain thread. */
    public void readAll() {
        client.readAll();
    }

    @Override
    public void close() {
        if (reading != null) {
            reading.cancel(); // closing the client would reject a pending promise
        }
        client.close();
    }
}
