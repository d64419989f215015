package io.troupe.services.component.kinds;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.player.PlayerPorts;
import io.troupe.player.wire.DataMessage;
import io.troupe.player.wire.DataSink;
import io.troupe.player.wire.Delivery;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.Frame;
import io.troupe.player.wire.Interfaces;
import io.troupe.player.wire.PlayerConnection;
import io.troupe.player.wire.PlayerServer;
import io.troupe.player.wire.ReplaceRule;
import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/** A Player server whose robots sense what a test says and remember what they were told. */
public final class FakePlayer implements PlayerServer, AutoCloseable {
    public static final int PORT = 7101;

    private final TestSpace test;
    private final int robots;
    private final PlayerPorts.Registration port;
    private final List<Line> lines = new ArrayList<>();
    private final float[][] ranges;
    private final int[] colours;
    private final List<List<DeviceCommand.Velocity>> commands;
    private long tick;

    public FakePlayer(TestSpace test, int robots) {
        this(test, robots, PORT);
    }

    public FakePlayer(TestSpace test, int robots, int portNumber) {
        this.port = PlayerPorts.open(portNumber, this);
        this.test = test;
        this.robots = robots;
        this.ranges = new float[robots][16];
        this.colours = new int[robots];
        this.commands = IntStream.range(0, robots)
                .<List<DeviceCommand.Velocity>>mapToObj(i -> new ArrayList<>())
                .toList();
        for (var ring : ranges) {
            java.util.Arrays.fill(ring, 5f);
        }
    }

    /** From now on the robot sees a large blob of that colour; black stands for the walls and is always there. */
    public void show(int robot, int colour) {
        colours[robot] = colour;
    }

    /** From now on one of the robot's sonars reads so much. */
    public void range(int robot, int sonar, double rangeM) {
        ranges[robot][sonar] = (float) rangeM;
    }

    /** Delivers the readings of the next moment, so many milliseconds after the last, to all clients in one turn of the space. */
    public void tick(int millis) {
        long number = tick++;
        timeMillis += millis;
        test.run(() -> List.copyOf(lines).forEach(line -> line.deliver(number)));
    }

    private long timeMillis;

    public List<DeviceCommand.Velocity> commands(int robot) {
        return commands.get(robot);
    }

    public DeviceCommand.Velocity lastCommand(int robot) {
        return commands.get(robot).getLast();
    }

    public int connections() {
        return lines.size();
    }

    public void vanish() {
        List.copyOf(lines).forEach(line -> line.sink.lost("the server has gone"));
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
        var line = new Line(sink);
        lines.add(line);
        return line;
    }

    private final class Line implements PlayerConnection {
        private final DataSink sink;
        private final Set<DeviceAddress> subscribed = new LinkedHashSet<>();

        Line(DataSink sink) {
            this.sink = sink;
        }

        void deliver(long number) {
            double seconds = timeMillis / 1000.0;
            sink.frame(new Frame(
                    number,
                    seconds,
                    subscribed.stream()
                            .map(device -> new DataMessage(device, seconds, read(device)))
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
                var wall = new DeviceData.Blob(0, 0, 4000, 40, 30, 0, 79, 0, 59, 2f);
                var blob = new DeviceData.Blob(0, colours[device.index()], 100, 40, 30, 35, 45, 25, 35, 1f);
                return new DeviceData.Blobs(80, 60, List.of(wall, blob));
            }
            return new DeviceData.Position2d(0, 0, 0, 0, 0, 0, false);
        }

        @Override
        public List<DeviceAddress> devices() {
            return IntStream.range(0, robots)
                    .boxed()
                    .flatMap(robot -> java.util.stream.Stream.of(
                                    Interfaces.POSITION2D, Interfaces.SONAR, Interfaces.BLOBFINDER)
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
            return new DeviceReply.Nack("a fake answers nothing");
        }

        @Override
        public void answers(boolean whether) {}

        @Override
        public void delivery(Delivery mode) {}

        @Override
        public void replace(ReplaceRule rule) {}

        @Override
        public void answered(long answeredTick) {
            // a fake does not wait
        }

        @Override
        public void close() {
            lines.remove(this);
        }
    }
}
