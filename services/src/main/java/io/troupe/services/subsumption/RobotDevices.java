package io.troupe.services.subsumption;

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

/**
 * One robot's sensors and wheels on a connection.
 *
 * <p><b>Threads.</b> That of the connection. <b>Errors.</b> {@link io.troupe.player.PlayerException} when the server refuses or has gone.
 * <p><b>Source.</b> Paper, Figure 7.
 */
final class RobotDevices {
    private final Position2DInterface position;
    private final SonarInterface sonar;
    private final BlobfinderInterface blobfinder;

    RobotDevices(PlayerClient client, int robot) {
        position = client.requestInterfacePosition2D(robot, PlayerConstants.PLAYER_OPEN_MODE);
        sonar = client.requestInterfaceSonar(robot, PlayerConstants.PLAYER_OPEN_MODE);
        blobfinder = client.requestInterfaceBlobfinder(robot, PlayerConstants.PLAYER_OPEN_MODE);
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
}
