package io.troupe.services.subsumption;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.player.PlayerPorts;
import io.troupe.player.wire.ConnectionClosedException;
import io.troupe.player.wire.DataSink;
import io.troupe.player.wire.Delivery;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceDataMessage;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.Frame;
import io.troupe.player.wire.Interfaces;
import io.troupe.player.wire.PlayerConnection;
import io.troupe.player.wire.PlayerServer;
import io.troupe.player.wire.ReplaceRule;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/** A fake Player server. Tests set what its robots sense, and read the commands that they received. */
public final class FakeRobots implements PlayerServer, AutoCloseable {
    public static final int PORT = 7001;
    public static final DeviceCommand.Velocity STOP = ahead(0);

    private static final long ANSWER_LIMIT_NANOS = 10_000_000_000L;

    /** What a robot senses, and the commands that it received. */
    public static final class Robot {
        public final List<DeviceCommand.Velocity> commands = new ArrayList<>();
        private final List<Float> ranges = new ArrayList<>(Collections.nCopies(16, 5f));
        private int[] colours = {0};
        public boolean isStalled;

        /** Whether it has a laser with three beams, at -90, 0 and 90 degrees, which read 1 m, 2 m and 3 m. */
        public boolean hasLaser;

        boolean isLaserSlow; // publishes nothing
    }

    /** The command limits and silence limits that clients have requested. */
    public final List<String> limits = new CopyOnWriteArrayList<>();

    int connectionsMade;
    boolean refuses; // all further connections

    private final TestSpace test;
    private final List<Robot> robots;
    private final PlayerPorts.Registration port;
    private final List<Connection> connections = new CopyOnWriteArrayList<>();
    private final Object answers = new Object();
    private long tick;
    private long timeMillis;

    public FakeRobots(TestSpace test, int robots) {
        this(test, robots, PORT);
    }

    public FakeRobots(TestSpace test, int robots, int portNumber) {
        this.port = PlayerPorts.open(portNumber, this);
        this.test = test;
        this.robots = Stream.generate(Robot::new).limit(robots).toList();
    }

    /** The command to drive straight ahead. */
    public static DeviceCommand.Velocity ahead(double speedMps) {
        return new DeviceCommand.Velocity(speedMps, 0, 0, true);
    }

    /**
     * Sets the colours that the robot sees, as large blobs in descending order of area. Black stands for the walls and
     * is always added.
     */
    public void show(int robot, int... shown) {
        robots.get(robot).colours = shown;
    }

    /** Sets the range that one of the robot's sonars reads. */
    public void range(int robot, int sonar, double rangeM) {
        robots.get(robot).ranges.set(sonar, (float) rangeM);
    }

    public Robot get(int robot) {
        return robots.get(robot);
    }

    /** The number of connections that have subscribed to a robot's laser. */
    public long laserSubscriptions(int robot) {
        return connections.stream()
                .flatMap(connection -> connection.subscribed.stream())
                .filter(device -> isLaser(device) && device.index() == robot)
                .count();
    }

    private static boolean isLaser(DeviceAddress device) {
        return device.interfaceCode() == Interfaces.LASER.code();
    }

    /** Advances the clock and delivers the next readings to all clients in one turn of the space. */
    public void tick(int millis) {
        test.run(() -> deliver(millis));
    }

    private long deliver(int millis) {
        long number = tick++;
        timeMillis += millis;
        List.copyOf(connections).forEach(connection -> connection.deliver(number));
        return number;
    }

    /** Does the same for clients on other threads: waits until all have answered, or have disconnected. */
    void tickAndAwait(int millis) throws InterruptedException {
        long number = deliver(millis);
        synchronized (answers) {
            long deadline = System.nanoTime() + ANSWER_LIMIT_NANOS;
            while (connections.stream().anyMatch(connection -> connection.answered < number)) {
                long leftMillis = (deadline - System.nanoTime()) / 1_000_000;
                assertThat(leftMillis)
                        .as("milliseconds left to answer tick " + number)
                        .isPositive();
                answers.wait(leftMillis);
            }
        }
    }

    /** Waits until all clients have disconnected. */
    void awaitNoConnection() throws InterruptedException {
        synchronized (answers) {
            while (!connections.isEmpty()) {
                answers.wait();
            }
        }
    }

    public List<DeviceCommand.Velocity> commands(int robot) {
        return robots.get(robot).commands;
    }

    public DeviceCommand.Velocity lastCommand(int robot) {
        return commands(robot).getLast();
    }

    public int connections() {
        return connections.size();
    }

    public void vanish() {
        List.copyOf(connections).forEach(connection -> connection.sink.lost("the server has gone"));
    }

    @Override
    public void close() {
        port.close();
    }

    @Override
    public String banner() {
        return "fake";
    }

    @Override
    public PlayerConnection connect(DataSink sink, @Nullable ActorSpace space) {
        if (refuses) {
            throw new ConnectionClosedException("no more clients");
        }
        connectionsMade++;
        var connection = new Connection(sink);
        connections.add(connection);
        return connection;
    }

    private final class Connection implements PlayerConnection {
        private final DataSink sink;
        private final Set<DeviceAddress> subscribed = new LinkedHashSet<>();
        private long answered = NO_TICK;

        Connection(DataSink sink) {
            this.sink = sink;
        }

        void deliver(long number) {
            double seconds = timeMillis / 1000.0;
            var messages = subscribed.stream()
                    .filter(device -> !isLaser(device) || !robots.get(device.index()).isLaserSlow)
                    .map(device -> new DeviceDataMessage(device, seconds, read(device)))
                    .toList();
            sink.frame(new Frame(number, seconds, messages));
        }

        private DeviceData read(DeviceAddress device) {
            var robot = robots.get(device.index());
            if (device.interfaceCode() == Interfaces.SONAR.code()) {
                return new DeviceData.SonarRanges(List.copyOf(robot.ranges));
            }
            if (device.interfaceCode() == Interfaces.BLOBFINDER.code()) {
                var blobs = new ArrayList<DeviceData.Blob>();
                blobs.add(new DeviceData.Blob(0, 0, 4000, 40, 30, 0, 79, 0, 59, 2f));
                for (int colour : robot.colours) {
                    int area = 101 - blobs.size();
                    blobs.add(new DeviceData.Blob(0, colour, area, 40, 30, 35, 45, 25, 35, 1f));
                }
                return new DeviceData.Blobs(80, 60, blobs);
            }
            if (isLaser(device)) {
                float quarter = (float) (Math.PI / 2);
                return new DeviceData.LaserScan(-quarter, quarter, quarter, 8, List.of(1f, 2f, 3f), List.of(), 0);
            }
            return new DeviceData.Position2d(0, 0, 0, 0, 0, 0, robot.isStalled);
        }

        @Override
        public List<DeviceAddress> devices() {
            var types = List.of(Interfaces.POSITION2D, Interfaces.SONAR, Interfaces.BLOBFINDER, Interfaces.LASER);
            return IntStream.range(0, robots.size())
                    .boxed()
                    .flatMap(robot -> types.stream().map(type -> new DeviceAddress(0, PORT, type.code(), robot)))
                    .filter(device -> !isLaser(device) || robots.get(device.index()).hasLaser)
                    .toList();
        }

        @Override
        public String driverName(DeviceAddress device) {
            return "fake";
        }

        @Override
        public void subscribe(DeviceAddress device) {
            subscribed.add(device);
        }

        @Override
        public void unsubscribe(DeviceAddress device) {
            subscribed.remove(device);
        }

        @Override
        public void command(DeviceAddress device, DeviceCommand command) {
            commands(device.index()).add((DeviceCommand.Velocity) command);
        }

        @Override
        public DeviceReply request(DeviceAddress device, DeviceRequest request) {
            if (request instanceof DeviceRequest.SetIntegerProperty limit) {
                limits.add("robot " + (device.index() + 1) + " " + limit.key() + " " + limit.value());
                return new DeviceReply.Ack();
            }
            return new DeviceReply.Nack("a fake answers nothing else");
        }

        @Override
        public void silenceLimit(Duration limit) {
            limits.add("silence " + limit);
        }

        @Override
        public void answers(boolean whether) {}

        @Override
        public void delivery(Delivery mode) {}

        @Override
        public void replace(ReplaceRule rule) {}

        @Override
        public void answered(long answeredTick) {
            synchronized (answers) {
                answered = answeredTick;
                answers.notifyAll();
            }
        }

        @Override
        public void close() {
            synchronized (answers) {
                connections.remove(this);
                answers.notifyAll();
            }
        }
    }
}
