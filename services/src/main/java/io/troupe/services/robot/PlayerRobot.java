package io.troupe.services.robot;

import io.troupe.player.BlobfinderInterface;
import io.troupe.player.LaserInterface;
import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerException;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.blobfinder.PlayerBlobfinderData;
import io.troupe.player.structures.laser.PlayerLaserData;
import io.troupe.player.structures.position2d.PlayerPosition2dData;
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
 * One robot of a Player server: its sensors and wheels on a {@link RobotConnection}.
 *
 * <p><b>Threads.</b> The thread of the connection. <b>Errors.</b> {@link PlayerException} when the server refuses a
 * request or has disconnected.
 *
 * <p><b>Source.</b> Paper, Figure 7.
 */
public final class PlayerRobot {
    /**
     * Two cycles, half of {@link DriverLimits#COMMAND_LIMIT}, so that one reading may be late. Minus half a millisecond
     * of tolerance for rounding.
     */
    private static final double RENEWAL_SECONDS = 2 * ReadingTime.CYCLE_SECONDS - 0.0005;

    private final Position2DInterface position;
    private final SonarInterface sonar;
    private final @Nullable BlobfinderInterface blobfinder;
    private final PlayerClient client;
    private final int index;
    private @Nullable LaserInterface laser;
    private @Nullable PlayerBlobfinderData image;
    private List<Blob> blobs = List.of(); // converted from image
    private final ReadingTime time = new ReadingTime();
    private Velocity lastCommand = Velocity.STOP;
    private double lastCommandSeconds;
    private final Stamps published = new Stamps();

    /** The time stamps of the readings that {@link #publishNew} has published last. */
    private static final class Stamps {
        private double sonarSeconds = Double.NEGATIVE_INFINITY;
        private double positionSeconds = Double.NEGATIVE_INFINITY;
        private double blobsSeconds = Double.NEGATIVE_INFINITY;
        private double laserSeconds = Double.NEGATIVE_INFINITY;
    }

    PlayerRobot(PlayerClient client, RobotConnection.Devices devices) {
        this.client = client;
        this.index = devices.index();
        position = client.requestInterfacePosition2D(index, PlayerConstants.PLAYER_OPEN_MODE);
        DriverLimits.limit(position);
        sonar = client.requestInterfaceSonar(index, PlayerConstants.PLAYER_OPEN_MODE);
        blobfinder =
                devices.camera() ? client.requestInterfaceBlobfinder(index, PlayerConstants.PLAYER_OPEN_MODE) : null;
        if (devices.laser()) {
            useLaser();
        }
    }

    /** The Player index, from 0. */
    public int index() {
        return index;
    }

    /**
     * Subscribes to the laser, unless that is done already. Only services that use the laser do so: a scan is the
     * largest of all readings.
     */
    public void useLaser() {
        if (laser == null) {
            try {
                laser = client.requestInterfaceLaser(index, PlayerConstants.PLAYER_OPEN_MODE);
            } catch (PlayerException refused) {
                throw new PlayerException(
                        "robot " + (index + 1) + " is to use its laser: " + refused.getMessage(), refused);
            }
        }
    }

    /** Whether each subscribed sensor has sent a reading. */
    public boolean hasData() {
        return position.getData() != null
                && sonar.getData() != null
                && (blobfinder == null || blobfinder.getData() != null)
                && (laser == null || laser.getData() != null);
    }

    /** The time of the sonar readings in seconds on the robot's clock, made monotonic by {@link ReadingTime}. */
    public double timeSeconds() {
        return time.at(sonar.getTimestamp());
    }

    /**
     * The time stamp of the sonar readings, to compare with other robots of the connection. It may go back if the
     * robot's clock is set back.
     */
    public double stampSeconds() {
        return sonar.getTimestamp();
    }

    /**
     * The newest readings.
     *
     * @param withLaser whether to include the laser scan; a service gets it only if it uses the laser, also if another
     *     service of the robot has subscribed to it
     * @throws RuntimeException unless {@link #hasData}
     */
    public Senses senses(boolean withLaser) {
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
    public List<Blob> blobs() {
        var newest = blobfinder == null ? null : blobfinder.getData();
        if (newest != null && newest != image) {
            blobs = Blob.of(newest);
            image = newest;
        }
        return blobs;
    }

    /** Receives the readings of a robot one by one, as they are on the wire; times are time stamps in seconds. */
    public interface Subscriber {
        /** Receives the pose by odometry, and whether the wheels are blocked. */
        void position(double stampSeconds, RobotPose pose, boolean stalled);

        /** Receives all blobs of one image; none if the camera sees no colour. */
        void blobs(double stampSeconds, List<Blob> blobs);

        /** Receives one scan; never called unless the robot has subscribed to its laser. */
        void laser(double stampSeconds, PlayerLaserData scan);

        /** Receives the ranges of the sonar ring in metres, in the order of its sonars. */
        void sonar(double stampSeconds, float[] rangesM);
    }

    /**
     * Publishes the readings whose time stamp has changed since the last call. An older time stamp counts as a change,
     * since a clock may be set back. Position, blobs and scan are published before the sonar ranges, so that a
     * subscriber that reacts to the ranges already has the others.
     */
    public void publishNew(Subscriber subscriber) {
        PlayerPosition2dData odometry = position.getData();
        if (odometry != null && position.getTimestamp() != published.positionSeconds) {
            published.positionSeconds = position.getTimestamp();
            var pose = odometry.getPos();
            subscriber.position(
                    published.positionSeconds,
                    new RobotPose(pose.getPx(), pose.getPy(), pose.getPa()),
                    odometry.getStall() != 0);
        }
        if (blobfinder != null && blobfinder.getData() != null && blobfinder.getTimestamp() != published.blobsSeconds) {
            published.blobsSeconds = blobfinder.getTimestamp();
            subscriber.blobs(published.blobsSeconds, blobs());
        }
        if (laser != null && laser.getData() != null && laser.getTimestamp() != published.laserSeconds) {
            published.laserSeconds = laser.getTimestamp();
            subscriber.laser(published.laserSeconds, laser.getData());
        }
        if (sonar.getData() != null && sonar.getTimestamp() != published.sonarSeconds) {
            published.sonarSeconds = sonar.getTimestamp();
            subscriber.sonar(published.sonarSeconds, sonar.getData().getRanges());
        }
    }

    /** Commands a velocity, which the robot keeps until the next command or {@link DriverLimits#COMMAND_LIMIT}. */
    public void drive(Velocity velocity) {
        lastCommand = velocity;
        lastCommandSeconds = timeSeconds();
        position.setSpeed(velocity.forwardMps(), velocity.turnRadps());
    }

    /** Repeats the last speed command before it expires, for a robot whose next cycle comes later than that. */
    public void repeatCommand() {
        if (!lastCommand.equals(Velocity.STOP) && timeSeconds() - lastCommandSeconds >= RENEWAL_SECONDS) {
            drive(lastCommand);
        }
    }
}
