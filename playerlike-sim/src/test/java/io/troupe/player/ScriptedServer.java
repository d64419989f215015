package io.troupe.player;

import io.troupe.actor.ActorSpace;
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
import java.util.List;
import java.util.Queue;
import java.util.Set;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.ConcurrentSkipListSet;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.function.Consumer;
import java.util.function.Function;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/** A server for one client: it publishes when the test calls it, and records the ticks that the client has answered. */
final class ScriptedServer implements PlayerServer, PlayerConnection {
    static final int PORT = 6750;
    private static final List<Interfaces> TYPES = List.of(
            Interfaces.POSITION2D, Interfaces.SONAR, Interfaces.BLOBFINDER, Interfaces.RANGER, Interfaces.LASER);
    private static final List<Interfaces> SILENT = List.of(Interfaces.SIMULATION);

    final List<DeviceCommand> commands = new CopyOnWriteArrayList<>();
    final List<DeviceRequest> requests = new CopyOnWriteArrayList<>();
    final List<ReplaceRule> rules = new CopyOnWriteArrayList<>();
    /** Replies that are not delivered yet, if {@link #repliesLater}. */
    final Queue<Runnable> replies = new ConcurrentLinkedQueue<>();

    final AtomicBoolean closed = new AtomicBoolean();
    volatile boolean repliesLater;
    volatile Function<DeviceRequest, DeviceReply> replier = request -> new DeviceReply.Nack("not in the script");
    volatile @Nullable Duration replyLimit;
    private final Set<Integer> subscribed = new ConcurrentSkipListSet<>();
    private final List<Long> answers = new ArrayList<>();
    private @Nullable DataSink sink;

    /** Publishes a frame in which every position, range and blob contains the number of the tick. */
    void publish(long tick) {
        double seconds = tick / 10.0;
        var messages = TYPES.stream()
                .filter(type -> subscribed.contains(type.code()))
                .map(type -> new DeviceDataMessage(address(type), seconds, data(type, tick)))
                .toList();
        sink.frame(new Frame(tick, seconds, messages));
    }

    void vanish() {
        sink.lost("the scripted server has gone");
    }

    /** The newest tick that the client has answered; -2 before it has requested its first data. */
    synchronized long answered() {
        return answers.isEmpty()
                ? -2
                : answers.stream().mapToLong(Long::longValue).max().orElseThrow();
    }

    synchronized void awaitAnswer(long tick) throws InterruptedException {
        while (answered() < tick) {
            wait();
        }
    }

    /** Publishes a tick on another thread as soon as an earlier one has been answered. */
    Thread publishAfter(long answeredTick, long tick) {
        return Thread.ofPlatform().daemon().start(() -> {
            try {
                awaitAnswer(answeredTick);
                publish(tick);
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
            }
        });
    }

    private static DeviceAddress address(Interfaces type) {
        return new DeviceAddress(0, PORT, type.code(), 0);
    }

    private static DeviceData data(Interfaces type, long tick) {
        return switch (type) {
            case POSITION2D -> new DeviceData.Position2d(tick, 0, 0, 0, 0, 0, false);
            case SONAR -> new DeviceData.SonarRanges(List.of((float) tick));
            case BLOBFINDER ->
                new DeviceData.Blobs(80, 60, List.of(new DeviceData.Blob(0, (int) tick, 1, 0, 0, 0, 0, 0, 0, 1)));
            case RANGER -> new DeviceData.RangerRanges(List.of((double) tick, 2.0));
            case LASER ->
                new DeviceData.LaserScan(-1, 1, 1, 8, List.of((float) tick, 2f, 3f), List.of((byte) 7), (int) tick);
            case SIMULATION -> throw new AssertionError("publishes nothing");
        };
    }

    @Override
    public String banner() {
        return "scripted";
    }

    @Override
    public PlayerConnection connect(DataSink newSink, @Nullable ActorSpace space) {
        sink = newSink;
        return this;
    }

    @Override
    public List<DeviceAddress> devices() {
        return Stream.concat(TYPES.stream(), SILENT.stream())
                .map(ScriptedServer::address)
                .toList();
    }

    @Override
    public String driverName(DeviceAddress device) {
        return "script";
    }

    @Override
    public void subscribe(DeviceAddress device) {
        subscribed.add(device.interfaceCode());
    }

    @Override
    public void unsubscribe(DeviceAddress device) {
        subscribed.remove(device.interfaceCode());
    }

    @Override
    public void command(DeviceAddress device, DeviceCommand command) {
        commands.add(command);
    }

    @Override
    public DeviceReply request(DeviceAddress device, DeviceRequest request) {
        requests.add(request);
        return replier.apply(request);
    }

    @Override
    public void request(DeviceAddress device, DeviceRequest request, Consumer<DeviceReply> receiver) {
        var reply = request(device, request);
        if (repliesLater) {
            replies.add(() -> receiver.accept(reply));
        } else {
            receiver.accept(reply);
        }
    }

    @Override
    public void replyLimit(Duration limit) {
        replyLimit = limit;
    }

    @Override
    public void answers(boolean whether) {}

    @Override
    public void delivery(Delivery mode) {}

    @Override
    public void replace(ReplaceRule rule) {
        rules.add(rule);
    }

    @Override
    public synchronized void answered(long tick) {
        answers.add(tick);
        notifyAll();
    }

    @Override
    public void close() {
        closed.set(true);
    }
}
