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
 * The Player devices of one robot: its sensors and wheels on one connection.
 *
 * <p><b>Threads.</b> The thread of the connection. <b>Errors.</b> {@link PlayerException} when the server refuses a
 * request or has disconnected.
 *
 * <p><b>Source.</b> Paper, Figure 7.
 */
final class PlayerDevices {
    /**
     * Two cycles, half of {@link DriverLimits#COMMAND_LIMIT}, so that one reading may be late. Minus half a millisecond
     * of tolerance for rounding.
     */
    private static final double RENEWAL_SECONDS = 2 * ReadingTime.CYCLE_SECONDS - 0.0005;

    private final Position2DInterface position;
    private final SonarInterface sonar;
    private final BlobfinderInterface blobfinder;
    private final PlayerClient client;
    private final int robot;
    private @Nullable LaserInterface laser;
    private @Nullable PlayerBlobfinderData image;
    private List<Blob> blobs = List.of(); // converted from image
    private final ReadingTime time = new ReadingTime();
    private Velocity lastCommand = Velocity.STOP;
    private double lastCommandSeconds;

    /** @param usesLaser whether to subscribe to the laser at once */
    PlayerDevices(PlayerClient client, int robot, boolean usesLaser) {
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

    /**
     * Subscribes to the laser, unless that is done already. Only services that use the laser do so: a scan is the
     * largest of all readings.
     */
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

    /** Whether each subscribed sensor has sent a reading. */
    boolean hasData() {
        return position.getData() != null
                && sonar.getData() != null
                && blobfinder.getData() != null
                && (laser == null || laser.getData() != null);
    }

    /** The time of the sonar readings in seconds on the robot's clock, made monotonic by {@link ReadingTime}. */
    double timeSeconds() {
        return time.at(sonar.getTimestamp());
    }

    /**
     * The time stamp of the sonar readings, to compare with other robots of the connection. It may go back if the
     * robot's clock is set back.
     */
    double stampSeconds() {
        return sonar.getTimestamp();
    }

    /**
     * The newest readings.
     *
     * @param withLaser whether to include the laser scan; a service gets it only if it uses the laser, also if another
     *     service of the robot has subscribed to it
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

    /** The blobs of the newest image. Converted once per image, as colour finder and behaviour both read them. */
    List<Blob> blobs() {
        var newest = blobfinder.getData();
        if (newest != image) {
            blobs = Blob.of(newest);
            image = newest;
        }
        return blobs;
    }

    void drive(Velocity velocity) {
        lastCommand = velocity;
        lastCommandSeconds = timeSeconds();
        position.setSpeed(velocity.forwardMps(), velocity.turnRadps());
    }

    /** Repeats the last speed command before it expires, for a robot whose next cycle comes later than that. */
    void repeatCommand() {
        if (!lastCommand.equals(Velocity.STOP) && timeSeconds() - lastCommandSeconds >= RENEWAL_SECONDS) {
            drive(lastCommand);
        }
    }
}
