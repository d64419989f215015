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
import java.util.HashSet;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/** A fake Player server. Tests set what its robots sense, and read the commands that they received. */
public final class FakeRobots implements PlayerServer, AutoCloseable {
    public static final int PORT = 7001;

    private static final long ANSWER_LIMIT_NANOS = 10_000_000_000L;

    private final TestSpace test;
    private final int robots;
    private final PlayerPorts.Registration port;
    private final List<Connection> connections = new CopyOnWriteArrayList<>();
    private final List<String> limits = new CopyOnWriteArrayList<>();
    private final Object answers = new Object();
    private final float[][] ranges;
    private final int[][] colours;
    private final List<List<DeviceCommand.Velocity>> commands;
    private final Set<Integer> stalled = new HashSet<>();
    private final Set<Integer> withLaser = new HashSet<>();
    private final Set<Integer> slowLasers = new HashSet<>();
    private long tick;
    private int connectionsMade;
    private boolean refuses;

    public FakeRobots(TestSpace test, int robots) {
        this(test, robots, PORT);
    }

    public FakeRobots(TestSpace test, int robots, int portNumber) {
        this.port = PlayerPorts.open(portNumber, this);
        this.test = test;
        this.robots = robots;
        this.ranges = new float[robots][16];
        this.colours = new int[robots][1];
        this.commands = IntStream.range(0, robots)
                .<List<DeviceCommand.Velocity>>mapToObj(i -> new ArrayList<>())
                .toList();
        for (var ring : ranges) {
            java.util.Arrays.fill(ring, 5f);
        }
    }

    /**
     * Sets the colours that the robot sees, as large blobs in descending order of area. Black stands for the walls and
     * is always added.
     */
    public void show(int robot, int... shown) {
        colours[robot] = shown;
    }

    /** Sets the range that one of the robot's sonars reads. */
    public void range(int robot, int sonar, double rangeM) {
        ranges[robot][sonar] = (float) rangeM;
    }

    /** Blocks the robot, so that it reports a stall. */
    public void stall(int robot) {
        stalled.add(robot);
    }

    /** Gives the robot a laser with three beams, at -90, 0 and 90 degrees, which read 1 m, 2 m and 3 m. */
    public void giveLaser(int robot) {
        withLaser.add(robot);
    }

    /** Sets whether the robot's laser is slow, that is, publishes nothing. */
    void setLaserSlow(int robot, boolean slow) {
        if (slow) {
            slowLasers.add(robot);
        } else {
            slowLasers.remove(robot);
        }
    }

    /** The number of connections that have subscribed to a robot's laser. */
    public long laserSubscriptions(int robot) {
        return connections.stream()
                .flatMap(connection -> connection.subscribed.stream())
                .filter(device -> device.interfaceCode() == Interfaces.LASER.code() && device.index() == robot)
                .count();
    }

    /** Advances the clock and delivers the next readings to all clients in one turn of the space. */
    public void tick(int millis) {
        long number = tick++;
        timeMillis += millis;
        test.run(() -> List.copyOf(connections).forEach(connection -> connection.deliver(number)));
    }

    /** Does the same for clients on other threads: waits until all have answered, or have disconnected. */
    void tickAndAwait(int millis) throws InterruptedException {
        long number = tick++;
        timeMillis += millis;
        List.copyOf(connections).forEach(connection -> connection.deliver(number));
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

    private long timeMillis;

    /** The command limits and silence limits that clients have requested. */
    public List<String> limits() {
        return limits;
    }

    public List<DeviceCommand.Velocity> commands(int robot) {
        return commands.get(robot);
    }

    public DeviceCommand.Velocity lastCommand(int robot) {
        return commands.get(robot).getLast();
    }

    public int connections() {
        return connections.size();
    }

    int connectionsMade() {
        return connectionsMade;
    }

    /** Refuses all further connections. */
    void refuse() {
        refuses = true;
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
            sink.frame(new Frame(
                    number,
                    seconds,
                    subscribed.stream()
                            .filter(device -> device.interfaceCode() != Interfaces.LASER.code()
                                    || !slowLasers.contains(device.index()))
                            .map(device -> new DeviceDataMessage(device, seconds, read(device)))
                            .toList()));
        }

        private DeviceData read(DeviceAddress device) {
            if (device.interfaceCode() == Interfaces.SONAR.code()) {
                var list = new ArrayList<Float>();
                for (float range : ranges[device.index()]) {
                    list.add(range);
                }
                return new DeviceData.SonarRanges(list);
            }
            if (device.interfaceCode() == Interfaces.BLOBFINDER.code()) {
                var blobs = new ArrayList<DeviceData.Blob>();
                blobs.add(new DeviceData.Blob(0, 0, 4000, 40, 30, 0, 79, 0, 59, 2f));
                for (int colour : colours[device.index()]) {
                    int area = 101 - blobs.size();
                    blobs.add(new DeviceData.Blob(0, colour, area, 40, 30, 35, 45, 25, 35, 1f));
                }
                return new DeviceData.Blobs(80, 60, blobs);
            }
            if (device.interfaceCode() == Interfaces.LASER.code()) {
                float quarter = (float) (Math.PI / 2);
                return new DeviceData.LaserScan(-quarter, quarter, quarter, 8, List.of(1f, 2f, 3f), List.of(), 0);
            }
            return new DeviceData.Position2d(0, 0, 0, 0, 0, 0, stalled.contains(device.index()));
        }

        @Override
        public List<DeviceAddress> devices() {
            return IntStream.range(0, robots)
                    .boxed()
                    .flatMap(robot -> java.util.stream.Stream.of(
                                    Interfaces.POSITION2D, Interfaces.SONAR, Interfaces.BLOBFINDER, Interfaces.LASER)
                            .filter(type -> type != Interfaces.LASER || withLaser.contains(robot))
                            .map(type -> new DeviceAddress(0, PORT, type.code(), robot)))
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
            commands.get(device.index()).add((DeviceCommand.Velocity) command);
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
