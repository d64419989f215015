package io.troupe.services.component.kinds;

import io.troupe.actor.Promise;
import io.troupe.bus.BusTopic;
import io.troupe.player.PlayerException;
import io.troupe.player.structures.laser.PlayerLaserData;
import io.troupe.services.behaviour.Blob;
import io.troupe.services.behaviour.RobotPose;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.component.ApplicationData;
import io.troupe.services.component.Buffering;
import io.troupe.services.component.Component;
import io.troupe.services.component.ComponentCommunication;
import io.troupe.services.component.Conversion;
import io.troupe.services.component.kinds.RobotTopics.BlobsReading;
import io.troupe.services.component.kinds.RobotTopics.LaserReading;
import io.troupe.services.component.kinds.RobotTopics.PositionReading;
import io.troupe.services.component.kinds.RobotTopics.SonarReading;
import io.troupe.services.robot.DriverLimits;
import io.troupe.services.robot.PlayerRobot;
import io.troupe.services.robot.RobotConnection;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import org.jspecify.annotations.Nullable;

/**
 * Makes a component of a Player server, Troupe's or another: it publishes the sensor readings of its robots, and
 * subscribes to their velocity commands.
 *
 * <p><b>Role.</b> Robot n publishes {@code robotn/sonar} and {@code robotn/position}, and also {@code robotn/blobs} and
 * {@code robotn/laser} if the settings enable them. It moves at the velocities published on {@code robotn/velocity}. A
 * moving robot that has received no velocity for {@value #MAX_READINGS_WITHOUT_COMMAND} sonar readings is stopped, and
 * this is reported to the observer.
 *
 * <p><b>Threads.</b> A server in the same JVM is found by its port; in lock step, its world waits until the space of
 * the interface is idle. Connecting to a server over a socket blocks the space.
 *
 * <p><b>Errors.</b> The start fails if there is no server, or no such robot. The component fails when the connection to
 * the server is lost.
 */
public final class PlayerComponent {
    /**
     * Number of sonar readings without a command after which a moving robot is stopped: half a second in the worlds of
     * the paper. Needed for other servers; Troupe's server stops the robot earlier, at
     * {@link DriverLimits#COMMAND_LIMIT}.
     */
    static final int MAX_READINGS_WITHOUT_COMMAND = 5;

    /** Address of the server, its robots, and the devices that are used. */
    public static final class Settings extends io.troupe.actor.Settings<Settings> {
        private final String host;
        private final int port;
        private final List<Integer> robots;
        private boolean camera;
        private boolean laser;

        private Settings(String host, int port, List<Integer> robots) {
            this.host = host;
            this.port = port;
            this.robots = List.copyOf(robots);
        }

        /**
         * Sonars and positions of some robots.
         *
         * @param robots robot numbers from 1, which are Player indices plus one
         */
        public static Settings of(String host, int port, List<Integer> robots) {
            var settings = new Settings(host, port, robots);
            settings.check();
            return settings;
        }

        @Override
        protected void check() {
            if (robots.isEmpty() || robots.stream().anyMatch(number -> number < 1)) {
                throw new IllegalArgumentException("robots are " + robots + ", expected numbers from 1");
            }
        }

        /** Whether to subscribe to the blobfinders of the robots, too. */
        public Settings withCamera(boolean newCamera) {
            return with(copy -> copy.camera = newCamera);
        }

        /** Whether to subscribe to the lasers of the robots, too. */
        public Settings withLaser(boolean newLaser) {
            return with(copy -> copy.laser = newLaser);
        }

        public String host() {
            return host;
        }

        public int port() {
            return port;
        }

        public List<Integer> robots() {
            return robots;
        }

        public boolean camera() {
            return camera;
        }

        public boolean laser() {
            return laser;
        }

        String where() {
            return "Player server " + host + ":" + port;
        }
    }

    /** Sensor reading of a robot from the server. Robots are identified by their Player index, from 0. */
    sealed interface Reading {
        int index();

        double timestamp();
    }

    record Sonar(int index, double timestamp, float[] rangesM) implements Reading {}

    record Laser(int index, double timestamp, PlayerLaserData data) implements Reading {}

    record Position(int index, double timestamp, RobotPose pose, boolean stalled) implements Reading {}

    record Blobs(int index, double timestamp, List<Blob> blobs) implements Reading {}

    /** Command to the server: {@code setSpeed}. */
    record SetSpeed(int index, double speed, double turnRate) {}

    private PlayerComponent() {}

    public static Component<?, ?> of(Settings settings) {
        Map<Integer, String> names = new LinkedHashMap<>();
        List<BusTopic<?>> subscribes = new ArrayList<>();
        List<BusTopic<?>> publishes = new ArrayList<>();
        for (int number : settings.robots()) {
            String robot = "robot" + number;
            names.put(number - 1, robot);
            subscribes.add(RobotTopics.velocity(robot));
            publishes.add(RobotTopics.position(robot));
            publishes.add(RobotTopics.sonar(robot));
            if (settings.camera()) {
                publishes.add(RobotTopics.blobs(robot));
            }
            if (settings.laser()) {
                publishes.add(RobotTopics.laser(robot));
            }
        }
        return new Component<>(
                "player",
                List.of("senses", "moves"),
                subscribes,
                publishes,
                () -> new PlayerCommunication(settings),
                new PlayerConversion(names),
                Buffering.LATEST, // only the latest command is useful
                Buffering.STREAM);
    }

    /**
     * Converts between the structures of the Player client, which identify a robot by its index, and the topics and
     * records on the bus, which identify it by its name.
     */
    private static final class PlayerConversion implements Conversion<SetSpeed, Reading> {
        private final Map<Integer, String> names;

        /** @param names names of the robots by Player index */
        PlayerConversion(Map<Integer, String> names) {
            this.names = Map.copyOf(names);
        }

        @Override
        public List<ApplicationData<?>> toApplication(Reading reading) {
            String robot = names.get(reading.index());
            double timeSeconds = reading.timestamp();
            return List.of(
                    switch (reading) {
                        case Sonar sonar ->
                            new ApplicationData<>(
                                    RobotTopics.sonar(robot), new SonarReading(timeSeconds, metres(sonar.rangesM())));
                        case Position position ->
                            new ApplicationData<>(RobotTopics.position(robot), position(timeSeconds, position));
                        case Blobs blobs ->
                            new ApplicationData<>(
                                    RobotTopics.blobs(robot), new BlobsReading(timeSeconds, blobs.blobs()));
                        case Laser laser ->
                            new ApplicationData<>(RobotTopics.laser(robot), scan(timeSeconds, laser.data()));
                    });
        }

        private static List<Double> metres(float[] ranges) {
            List<Double> metres = new ArrayList<>(ranges.length);
            for (float range : ranges) {
                metres.add((double) range);
            }
            return metres;
        }

        private static LaserReading scan(double timeSeconds, PlayerLaserData scan) {
            return new LaserReading(
                    timeSeconds,
                    scan.getMin_angle(),
                    scan.getMax_angle(),
                    scan.getMax_range(),
                    metres(scan.getRanges()));
        }

        private static PositionReading position(double timeSeconds, Position position) {
            RobotPose pose = position.pose();
            return new PositionReading(timeSeconds, pose.xM(), pose.yM(), pose.headingRad(), position.stalled());
        }

        @Override
        public SetSpeed toComponent(ApplicationData<?> input) {
            if (!(input.value() instanceof Velocity velocity)) {
                throw new IllegalArgumentException(input + " is no velocity");
            }
            if (!Double.isFinite(velocity.forwardMps()) || !Double.isFinite(velocity.turnRadps())) {
                throw new IllegalArgumentException(
                        input + " is no speed that a robot could have, expected finite numbers of m/s and rad/s");
            }
            for (var robot : names.entrySet()) {
                if (RobotTopics.velocity(robot.getValue()).equals(input.topic())) {
                    return new SetSpeed(robot.getKey(), velocity.forwardMps(), velocity.turnRadps());
                }
            }
            throw new IllegalArgumentException(input + " is for none of the robots " + names.values());
        }
    }

    /** The CCU of a Player server: a connection with its robots, which belongs to the actor space of the interface. */
    private static final class PlayerCommunication implements ComponentCommunication<SetSpeed, Reading> {
        private final Settings settings;
        private final Map<Integer, Robot> robots = new TreeMap<>();
        private @Nullable RobotConnection connection;
        private @Nullable Throwable lost;

        PlayerCommunication(Settings settings) {
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
            from.nextData().onSettled((ready, error) -> {
                if (connection == null) {
                    return; // terminated: the connection was closed
                }
                if (error != null) {
                    lost = new PlayerException(settings.where() + ": " + error.getMessage(), error);
                    signals.failed(lost);
                    return;
                }
                awaitData(from, signals);
                robots.values().forEach(Robot::publishReadings);
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
         * <p><b>Role.</b> A Player server keeps the last command for ever. A robot without further commands is
         * therefore stopped here, since its driver may have failed. A server that supports {@link DriverLimits} does
         * the same even if this program hangs.
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
                if (moving && ++readingsSinceCommand >= MAX_READINGS_WITHOUT_COMMAND) {
                    stop();
                    signals.info("robot " + (robot.index() + 1) + " has received no command for "
                            + MAX_READINGS_WITHOUT_COMMAND + " readings, and is stopped");
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
}
