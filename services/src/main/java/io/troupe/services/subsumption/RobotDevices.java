package io.troupe.services.subsumption;

import io.troupe.player.BlobfinderInterface;
import io.troupe.player.PlayerClient;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.services.behaviour.ColourFinder.Sighting;
import io.troupe.services.behaviour.ReadingTime;
import io.troupe.services.behaviour.RobotPose;
import io.troupe.services.behaviour.Senses;
import io.troupe.services.behaviour.SonarRing;
import io.troupe.services.behaviour.Velocity;
import java.util.ArrayList;
import java.util.List;

/**
 * One robot's sensors and wheels on a connection.
 *
 * <p><b>Threads.</b> That of the connection. <b>Errors.</b> {@link io.troupe.player.PlayerException} when the server refuses or has gone.
 * <p><b>Source.</b> Paper, Figure 7.
 */
final class RobotDevices {
    /** Two cycles, half of {@link DriverLimits#COMMAND_LIMIT}: one reading may be late. Half a millisecond forgives rounding. */
    private static final double RENEWAL_SECONDS = 2 * ReadingTime.CYCLE_SECONDS - 0.0005;

    private final Position2DInterface position;
    private final SonarInterface sonar;
    private final BlobfinderInterface blobfinder;
    private final ReadingTime time = new ReadingTime();
    private Velocity told = Velocity.STOP;
    private double toldAtSeconds;

    RobotDevices(PlayerClient client, int robot) {
        position = client.requestInterfacePosition2D(robot, PlayerConstants.PLAYER_OPEN_MODE);
        DriverLimits.limit(position);
        sonar = client.requestInterfaceSonar(robot, PlayerConstants.PLAYER_OPEN_MODE);
        blobfinder = client.requestInterfaceBlobfinder(robot, PlayerConstants.PLAYER_OPEN_MODE);
    }

    /** Whether there has been a reading yet. */
    boolean hasData() {
        return position.getData() != null && sonar.getData() != null && blobfinder.getData() != null;
    }

    /** When the sonar readings were taken, in seconds on the robot's clock; it never goes back. */
    double timeSeconds() {
        return time.at(sonar.getTimestamp());
    }

    /** The same as the robot's clock has it, to compare with other robots of the connection: the clock may be set back. */
    double stampSeconds() {
        return sonar.getTimestamp();
    }

    /** The newest readings. */
    Senses senses() {
        var pose = new RobotPose(position.getX(), position.getY(), position.getYaw());
        return new Senses(timeSeconds(), SonarRing.of(sonar.getData().getRanges()), pose);
    }

    /** What the blobfinder saw at the same time. */
    List<Sighting> sightings() {
        var blobs = blobfinder.getData().getBlobs();
        if (blobs.length == 0) {
            return List.of();
        }
        List<Sighting> sightings = new ArrayList<>(blobs.length);
        for (var blob : blobs) {
            sightings.add(new Sighting(blob.getColor(), blob.getArea(), blob.getLeft()));
        }
        return sightings;
    }

    void drive(Velocity velocity) {
        told = velocity;
        toldAtSeconds = timeSeconds();
        position.setSpeed(velocity.forwardMps(), velocity.turnRadps());
    }

    /** Sends the last speed again before it expires, for a robot whose turn comes later than that. */
    void renew() {
        if (!told.equals(Velocity.STOP) && timeSeconds() - toldAtSeconds >= RENEWAL_SECONDS) {
            drive(told);
        }
    }
}
