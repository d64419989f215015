package io.troupe.services.subsumption;

import io.troupe.player.BlobfinderInterface;
import io.troupe.player.LaserInterface;
import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerException;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.blobfinder.PlayerBlobfinderData;
import io.troupe.services.behaviour.Blob;
import io.troupe.services.behaviour.LaserScan;
import io.troupe.services.behaviour.ReadingTime;
import io.troupe.services.behaviour.RobotPose;
import io.troupe.services.behaviour.Senses;
import io.troupe.services.behaviour.SonarRing;
import io.troupe.services.behaviour.Velocity;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * One robot's sensors and wheels on a connection.
 *
 * <p><b>Threads.</b> That of the connection. <b>Errors.</b> {@link PlayerException} when the server refuses or has
 * gone.
 *
 * <p><b>Source.</b> Paper, Figure 7.
 */
final class RobotDevices {
    /**
     * Two cycles, half of {@link DriverLimits#COMMAND_LIMIT}: one reading may be late. Half a millisecond forgives
     * rounding.
     */
    private static final double RENEWAL_SECONDS = 2 * ReadingTime.CYCLE_SECONDS - 0.0005;

    private final Position2DInterface position;
    private final SonarInterface sonar;
    private final BlobfinderInterface blobfinder;
    private final PlayerClient client;
    private final int robot;
    private @Nullable LaserInterface laser;
    private @Nullable PlayerBlobfinderData image;
    private List<Blob> blobs = List.of(); // of that image
    private final ReadingTime time = new ReadingTime();
    private Velocity told = Velocity.STOP;
    private double toldAtSeconds;

    /** @param usesLaser whether the laser is subscribed to at once */
    RobotDevices(PlayerClient client, int robot, boolean usesLaser) {
        this.client = client;
        this.robot = robot;
        position = client.requestInterfacePosition2D(robot, PlayerConstants.PLAYER_OPEN_MODE);
        DriverLimits.limit(position);
        sonar = client.requestInterfaceSonar(robot, PlayerConstants.PLAYER_OPEN_MODE);
        blobfinder = client.requestInterfaceBlobfinder(robot, PlayerConstants.PLAYER_OPEN_MODE);
        if (usesLaser) {
            useLaser();
        }
    }

    /** Subscribes to the laser, unless that has been done: a scan is the largest reading of all, and costs traffic. */
    void useLaser() {
        if (laser == null) {
            try {
                laser = client.requestInterfaceLaser(robot, PlayerConstants.PLAYER_OPEN_MODE);
            } catch (PlayerException refused) {
                throw new PlayerException(
                        "robot " + (robot + 1) + " is to use its laser: " + refused.getMessage(), refused);
            }
        }
    }

    /** Whether there has been a reading yet. */
    boolean hasData() {
        return position.getData() != null
                && sonar.getData() != null
                && blobfinder.getData() != null
                && (laser == null || laser.getData() != null);
    }

    /** When the sonar readings were taken, in seconds on the robot's clock; it never goes back. */
    double timeSeconds() {
        return time.at(sonar.getTimestamp());
    }

    /**
     * The same as the robot's clock has it, to compare with other robots of the connection: the clock may be set back.
     */
    double stampSeconds() {
        return sonar.getTimestamp();
    }

    /**
     * The newest readings.
     *
     * @param withLaser whether the service asks for the scan; another service of the robot may have subscribed to the
     *     laser
     */
    Senses senses(boolean withLaser) {
        var pose = new RobotPose(position.getX(), position.getY(), position.getYaw());
        return new Senses(
                timeSeconds(),
                SonarRing.of(sonar.getData().getRanges()),
                pose,
                position.getData().getStall() != 0,
                blobs(),
                laser == null || !withLaser ? LaserScan.EMPTY : LaserScan.of(laser.getData()));
    }

    /** What the blobfinder saw at the same time; made once for each image, as finder and behaviour both ask for it. */
    List<Blob> blobs() {
        var newest = blobfinder.getData();
        if (newest != image) {
            blobs = Blob.of(newest);
            image = newest;
        }
        return blobs;
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
