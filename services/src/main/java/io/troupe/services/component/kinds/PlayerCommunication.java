package io.troupe.services.component.kinds;

import io.troupe.actor.promise.Promise;
import io.troupe.player.PlayerException;
import io.troupe.player.structures.laser.PlayerLaserData;
import io.troupe.services.behaviour.Blob;
import io.troupe.services.behaviour.RobotPose;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.component.ComponentCommunication;
import io.troupe.services.component.kinds.PlayerComponent.Blobs;
import io.troupe.services.component.kinds.PlayerComponent.Laser;
import io.troupe.services.component.kinds.PlayerComponent.Position;
import io.troupe.services.component.kinds.PlayerComponent.Reading;
import io.troupe.services.component.kinds.PlayerComponent.SetSpeed;
import io.troupe.services.component.kinds.PlayerComponent.Sonar;
import io.troupe.services.robot.DriverLimits;
import io.troupe.services.robot.PlayerRobot;
import io.troupe.services.robot.RobotConnection;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import org.jspecify.annotations.Nullable;

/** The CCU of a Player server: a connection with its robots, which belongs to the actor space of the interface. */
final class PlayerCommunication implements ComponentCommunication<SetSpeed, Reading> {
    private final PlayerComponent.Settings settings;
    private final Map<Integer, Robot> robots = new TreeMap<>();
    private @Nullable RobotConnection connection;
    private @Nullable Throwable lost;

    PlayerCommunication(PlayerComponent.Settings settings) {
        this.settings = settings;
    }

    @Override
    public Promise<@Nullable Void> invoke(Signals<? super Reading> signals) {
        var connected = RobotConnection.open(
                settings.host(),
                settings.port(),
                RobotConnection.Delivery.PUSH,
                settings.robots().stream()
                        .map(number -> new RobotConnection.Devices(number - 1, settings.camera(), settings.laser()))
                        .toList());
        try {
            connected.readOnSpace();
        } catch (RuntimeException refused) {
            connected.close();
            throw refused;
        }
        connection = connected;
        connected.robots().forEach(robot -> robots.put(robot.index(), new Robot(robot, signals)));
        awaitData(connected, signals);
        return Promise.done();
    }

    private void awaitData(RobotConnection from, Signals<? super Reading> signals) {
        from.nextData().handle((ready, error) -> {
            if (connection == null) {
                return null; // terminated: the connection was closed
            }
            if (error != null) {
                lost = new PlayerException(settings.where() + ": " + error.getMessage(), error);
                signals.failed(lost);
                return null;
            }
            awaitData(from, signals);
            robots.values().forEach(Robot::publishReadings);
            return null;
        });
    }

    @Override
    public void data(SetSpeed command) {
        Robot robot = robots.get(command.index());
        if (robot != null) {
            robot.drive(new Velocity(command.speed(), command.turnRate()));
        }
    }

    @Override
    public Promise<@Nullable Void> terminate() {
        RobotConnection ending = connection;
        connection = null;
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
     * One robot of the connection.
     *
     * <p><b>Role.</b> A Player server keeps the last command for ever. A robot without further commands is therefore
     * stopped here, since its driver may have failed. A server that supports {@link DriverLimits} does the same even if
     * this program hangs.
     */
    private static final class Robot implements PlayerRobot.Subscriber {
        private final PlayerRobot robot;
        private final Signals<? super Reading> signals;
        private boolean moving;
        private int readingsSinceCommand;

        Robot(PlayerRobot robot, Signals<? super Reading> signals) {
            this.robot = robot;
            this.signals = signals;
        }

        void publishReadings() {
            robot.publishNew(this);
        }

        @Override
        public void position(double stampSeconds, RobotPose pose, boolean stalled) {
            signals.data(new Position(robot.index(), stampSeconds, pose, stalled));
        }

        @Override
        public void blobs(double stampSeconds, List<Blob> blobs) {
            signals.data(new Blobs(robot.index(), stampSeconds, blobs));
        }

        @Override
        public void laser(double stampSeconds, PlayerLaserData scan) {
            signals.data(new Laser(robot.index(), stampSeconds, scan));
        }

        @Override
        public void sonar(double stampSeconds, float[] rangesM) {
            signals.data(new Sonar(robot.index(), stampSeconds, rangesM));
            checkCommandLimit();
        }

        private void checkCommandLimit() {
            if (moving && ++readingsSinceCommand >= PlayerComponent.MAX_READINGS_WITHOUT_COMMAND) {
                stop();
                signals.info("robot " + (robot.index() + 1) + " has heard no command for "
                        + PlayerComponent.MAX_READINGS_WITHOUT_COMMAND + " readings, and is stopped");
            }
        }

        void drive(Velocity velocity) {
            readingsSinceCommand = 0;
            moving = velocity.forwardMps() != 0 || velocity.turnRadps() != 0;
            robot.drive(velocity);
        }

        void stop() {
            moving = false;
            robot.drive(Velocity.STOP);
        }
    }
}
