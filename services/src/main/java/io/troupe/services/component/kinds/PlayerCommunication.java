package io.troupe.services.component.kinds;

import io.troupe.actor.promise.Promise;
import io.troupe.player.BlobfinderInterface;
import io.troupe.player.LaserInterface;
import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerException;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.services.component.ComponentCommunication;
import io.troupe.services.component.kinds.PlayerComponent.Blobs;
import io.troupe.services.component.kinds.PlayerComponent.Laser;
import io.troupe.services.component.kinds.PlayerComponent.Position;
import io.troupe.services.component.kinds.PlayerComponent.Reading;
import io.troupe.services.component.kinds.PlayerComponent.SetSpeed;
import io.troupe.services.component.kinds.PlayerComponent.Sonar;
import io.troupe.services.subsumption.DriverLimits;
import java.util.Map;
import java.util.TreeMap;
import org.jspecify.annotations.Nullable;

/** The CCU of a Player server: a Player client, which belongs to the actor space of the interface. */
final class PlayerCommunication implements ComponentCommunication<SetSpeed, Reading> {
    private final PlayerComponent.Settings settings;
    private final Map<Integer, Robot> robots = new TreeMap<>();
    private @Nullable PlayerClient client;
    private @Nullable Throwable lost;

    PlayerCommunication(PlayerComponent.Settings settings) {
        this.settings = settings;
    }

    @Override
    public Promise<@Nullable Void> invoke(Signals<? super Reading> signals) {
        var connected = new PlayerClient(settings.host(), settings.port());
        client = connected;
        try {
            DriverLimits.watch(connected);
            settings.robots().forEach(number -> robots.put(number - 1, new Robot(connected, number - 1, settings)));
            connected.runThreaded(-1, -1);
        } catch (RuntimeException refused) {
            connected.close();
            client = null;
            throw refused;
        }
        awaitData(connected, signals);
        return Promise.done();
    }

    private void awaitData(PlayerClient from, Signals<? super Reading> signals) {
        from.nextData().handle((ready, error) -> {
            if (client == null) {
                return null; // terminated: the client was closed
            }
            if (error != null) {
                lost = new PlayerException(settings.where() + ": " + error.getMessage(), error);
                signals.failed(lost);
                return null;
            }
            awaitData(from, signals);
            robots.values().forEach(robot -> robot.publishReadings(signals));
            return null;
        });
    }

    @Override
    public void data(SetSpeed command) {
        Robot robot = robots.get(command.index());
        if (robot != null) {
            robot.drive(command.speed(), command.turnRate());
        }
    }

    @Override
    public Promise<@Nullable Void> terminate() {
        PlayerClient ending = client;
        client = null;
        if (ending == null) {
            return Promise.done();
        }
        try {
            // the server may still execute commands even if it sends no data
            robots.values().forEach(Robot::stop);
        } catch (PlayerException unreachable) {
            if (lost == null) {
                throw unreachable;
            }
        } finally {
            ending.close();
        }
        return Promise.done();
    }

    @Override
    public Promise<@Nullable Void> health() {
        return lost == null ? Promise.done() : Promise.failed(lost);
    }

    /**
     * The devices of one robot of a Player server.
     *
     * <p><b>Role.</b> A Player server keeps the last command for ever. A robot without further commands is therefore
     * stopped here, since its driver may have failed. A server that supports {@link DriverLimits} does the same even if
     * this program hangs.
     */
    private static final class Robot {
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

        Robot(PlayerClient client, int index, PlayerComponent.Settings settings) {
            this.index = index;
            position = client.requestInterfacePosition2D(index, PlayerConstants.PLAYER_OPEN_MODE);
            DriverLimits.limit(position);
            sonar = client.requestInterfaceSonar(index, PlayerConstants.PLAYER_OPEN_MODE);
            blobfinder = settings.camera()
                    ? client.requestInterfaceBlobfinder(index, PlayerConstants.PLAYER_OPEN_MODE)
                    : null;
            laser = settings.laser() ? client.requestInterfaceLaser(index, PlayerConstants.PLAYER_OPEN_MODE) : null;
        }

        /**
         * Publishes the readings whose time stamp has changed. An older time stamp counts as a change, since a clock
         * may be set back. Position, blobs and scan are published before the sonar ranges, so that a subscriber that
         * reacts to the ranges already has the others.
         */
        void publishReadings(Signals<? super Reading> signals) {
            var pose = position.getData();
            if (pose != null && position.getTimestamp() != positionSeconds) {
                positionSeconds = position.getTimestamp();
                signals.data(new Position(index, positionSeconds, pose));
            }
            var picture = blobfinder == null ? null : blobfinder.getData();
            if (picture != null && blobfinder.getTimestamp() != blobsSeconds) {
                blobsSeconds = blobfinder.getTimestamp();
                signals.data(new Blobs(index, blobsSeconds, picture));
            }
            var scan = laser == null ? null : laser.getData();
            if (scan != null && laser.getTimestamp() != laserSeconds) {
                laserSeconds = laser.getTimestamp();
                signals.data(new Laser(index, laserSeconds, scan));
            }
            var ranges = sonar.getData();
            if (ranges != null && sonar.getTimestamp() != sonarSeconds) {
                sonarSeconds = sonar.getTimestamp();
                signals.data(new Sonar(index, sonarSeconds, ranges));
                checkCommandLimit(signals);
            }
        }

        private void checkCommandLimit(Signals<?> signals) {
            if (moving && ++readingsSinceCommand >= PlayerComponent.MAX_READINGS_WITHOUT_COMMAND) {
                stop();
                signals.info("robot " + (index + 1) + " has heard no command for "
                        + PlayerComponent.MAX_READINGS_WITHOUT_COMMAND + " readings, and is stopped");
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
}
