package io.troupe.services.component.kinds;

import io.troupe.player.BlobfinderInterface;
import io.troupe.player.LaserInterface;
import io.troupe.player.PlayerClient;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.services.component.ComponentCommunication.Signals;
import io.troupe.services.subsumption.DriverLimits;
import org.jspecify.annotations.Nullable;

/**
 * The devices of one robot of a Player server.
 *
 * <p><b>Role.</b> A Player server keeps the last command for ever. A robot without further commands is therefore
 * stopped here, since its driver may have failed. A server that supports {@link DriverLimits} does the same even if
 * this program hangs.
 */
final class PlayerRobot {
    /**
     * Number of sonar readings without a command after which a moving robot is stopped: half a second in the worlds of
     * the paper. Needed for other servers; Troupe's server stops the robot earlier, at
     * {@link DriverLimits#COMMAND_LIMIT}.
     */
    static final int MAX_READINGS_WITHOUT_COMMAND = 5;

    private final int index;
    private final Position2DInterface position;
    private final SonarInterface sonar;
    private final @Nullable BlobfinderInterface blobfinder;
    private final @Nullable LaserInterface laser;
    private double sonarSeconds = Double.NEGATIVE_INFINITY;
    private double positionSeconds = Double.NEGATIVE_INFINITY;
    private double blobsSeconds = Double.NEGATIVE_INFINITY;
    private double laserSeconds = Double.NEGATIVE_INFINITY;
    private boolean moving;
    private int readingsSinceCommand;

    PlayerRobot(PlayerClient client, int index, PlayerComponent.Settings settings) {
        this.index = index;
        position = client.requestInterfacePosition2D(index, PlayerConstants.PLAYER_OPEN_MODE);
        DriverLimits.limit(position);
        sonar = client.requestInterfaceSonar(index, PlayerConstants.PLAYER_OPEN_MODE);
        blobfinder =
                settings.camera() ? client.requestInterfaceBlobfinder(index, PlayerConstants.PLAYER_OPEN_MODE) : null;
        laser = settings.laser() ? client.requestInterfaceLaser(index, PlayerConstants.PLAYER_OPEN_MODE) : null;
    }

    /**
     * Publishes the readings whose time stamp has changed. An older time stamp counts as a change, since a clock may be
     * set back. Position, blobs and scan are published before the sonar ranges, so that a subscriber that reacts to the
     * ranges already has the others.
     */
    void publishReadings(Signals<? super PlayerSignal.Reading> signals) {
        var pose = position.getData();
        if (pose != null && position.getTimestamp() != positionSeconds) {
            positionSeconds = position.getTimestamp();
            signals.data(new PlayerSignal.Position(index, positionSeconds, pose));
        }
        var picture = blobfinder == null ? null : blobfinder.getData();
        if (picture != null && blobfinder.getTimestamp() != blobsSeconds) {
            blobsSeconds = blobfinder.getTimestamp();
            signals.data(new PlayerSignal.Blobs(index, blobsSeconds, picture));
        }
        var scan = laser == null ? null : laser.getData();
        if (scan != null && laser.getTimestamp() != laserSeconds) {
            laserSeconds = laser.getTimestamp();
            signals.data(new PlayerSignal.Laser(index, laserSeconds, scan));
        }
        var ranges = sonar.getData();
        if (ranges != null && sonar.getTimestamp() != sonarSeconds) {
            sonarSeconds = sonar.getTimestamp();
            signals.data(new PlayerSignal.Sonar(index, sonarSeconds, ranges));
            checkCommandLimit(signals);
        }
    }

    private void checkCommandLimit(Signals<?> signals) {
        if (moving && ++readingsSinceCommand >= MAX_READINGS_WITHOUT_COMMAND) {
            stop();
            signals.info("robot " + (index + 1) + " has heard no command for " + MAX_READINGS_WITHOUT_COMMAND
                    + " readings, and is stopped");
        }
    }

    void drive(double speed, double turnRate) {
        readingsSinceCommand = 0;
        moving = speed != 0 || turnRate != 0;
        position.setSpeed(speed, turnRate);
    }

    void stop() {
        moving = false;
        position.setSpeed(0, 0);
    }
}
