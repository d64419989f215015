package io.troupe.services.subsumption;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.player.BlobfinderInterface;
import io.troupe.player.PlayerClient;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.services.behaviour.ColourFinder.Sighting;
import io.troupe.services.behaviour.RobotPose;
import io.troupe.services.behaviour.Senses;
import io.troupe.services.behaviour.SonarRing;
import io.troupe.services.behaviour.Velocity;
import java.util.Arrays;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * The connection with one robot's sensors and wheels.
 *
 * <p><b>Threads.</b> The actor space on whose thread it was made. <b>Errors.</b> {@link io.troupe.player.PlayerException} when the server refuses or
 * has gone.
 * <p><b>Source.</b> Paper, Figure 7.
 */
final class RobotLink implements AutoCloseable {
    private final PlayerClient client;
    private final Position2DInterface position;
    private final SonarInterface sonar;
    private final BlobfinderInterface blobfinder;
    private @Nullable Deferred<Boolean> waiting;
    private @Nullable Promise<Boolean> reading;

    private RobotLink(PlayerClient client, int robot) {
        this.client = client;
        position = client.requestInterfacePosition2D(robot, PlayerConstants.PLAYER_OPEN_MODE);
        sonar = client.requestInterfaceSonar(robot, PlayerConstants.PLAYER_OPEN_MODE);
        blobfinder = client.requestInterfaceBlobfinder(robot, PlayerConstants.PLAYER_OPEN_MODE);
        client.runThreaded(-1, -1);
    }

    static RobotLink connect(String host, int port, int robot) {
        var client = new PlayerClient(host, port);
        try {
            return new RobotLink(client, robot);
        } catch (RuntimeException refused) {
            client.close();
            throw refused;
        }
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

    /** Whether there has been a reading yet. */
    boolean hasData() {
        return position.getData() != null && sonar.getData() != null && blobfinder.getData() != null;
    }

    /** When the sonar readings were taken, in seconds on the robot's clock. */
    double timeSeconds() {
        return sonar.getTimestamp();
    }

    /** The newest readings. */
    Senses senses() {
        var pose = new RobotPose(position.getX(), position.getY(), position.getYaw());
        return new Senses(timeSeconds(), SonarRing.of(sonar.getData().getRanges()), pose);
    }

    /** What the blobfinder saw at the same time. */
    List<Sighting> sightings() {
        return Arrays.stream(blobfinder.getData().getBlobs())
                .map(blob -> new Sighting(blob.getColor(), blob.getArea(), blob.getLeft()))
                .toList();
    }

    void drive(Velocity velocity) {
        position.setSpeed(velocity.forwardMps(), velocity.turnRadps());
    }

    @Override
    public void close() {
        if (reading != null) {
            reading.cancel(); // whoever closes does not want to hear that the client was closed
        }
        client.close();
    }
}
