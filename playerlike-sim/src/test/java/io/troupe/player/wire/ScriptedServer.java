package io.troupe.player.wire;

import io.troupe.actor.ActorSpace;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Queue;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.function.Consumer;
import java.util.function.Function;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/** A server for one client: it publishes and replies as the test scripts it, and records what the client sends. */
public class ScriptedServer implements PlayerServer, PlayerConnection {
    public static final int PORT = 6750;

    public final List<DeviceCommand> commands = new CopyOnWriteArrayList<>();
    public final List<DeviceRequest> requests = new CopyOnWriteArrayList<>();
    public final List<ReplaceRule> rules = new CopyOnWriteArrayList<>();
    /** The ticks that the client has answered, oldest first. */
    public final List<Long> answers = new CopyOnWriteArrayList<>();
    /** Replies that are not delivered yet, if {@link #repliesLater}. */
    public final Queue<Runnable> replies = new ConcurrentLinkedQueue<>();

    public final AtomicBoolean closed = new AtomicBoolean();
    public volatile boolean repliesLater;
    public volatile @Nullable Duration replyLimit;
    /** Runs while a device is being subscribed. */
    public volatile Runnable whileSubscribing = () -> {};
    /** Replies to the requests that {@link #reply} does not name. */
    public volatile Function<DeviceRequest, DeviceReply> replier = request -> new DeviceReply.Nack("not in the script");

    private final Map<DeviceRequest, DeviceReply> script = new ConcurrentHashMap<>();
    private final Set<DeviceAddress> subscribed = ConcurrentHashMap.newKeySet();
    private final List<DeviceAddress> devices;
    private @Nullable DataSink sink;
    private long published;

    public ScriptedServer() {
        this(Interfaces.values());
    }

    public ScriptedServer(Interfaces... types) {
        devices = Stream.of(types)
                .map(type -> new DeviceAddress(0, PORT, type.code(), 0))
                .toList();
    }

    /** Publishes a frame in which every position, range and blob contains the number of the tick. */
    public void publish(long tick) {
        double seconds = tick / 10.0;
        var messages = devices.stream()
                .filter(subscribed::contains)
                .map(from -> new DeviceDataMessage(from, seconds, data(from, tick)))
                .toList();
        sink.frame(new Frame(tick, seconds, messages));
    }

    /** Publishes a frame with one message of the first device. */
    public void publish(double seconds, @Nullable DeviceData data) {
        sink.frame(new Frame(published++, seconds, List.of(new DeviceDataMessage(devices.getFirst(), seconds, data))));
    }

    public void reply(DeviceRequest request, DeviceReply reply) {
        script.put(request, reply);
    }

    public void vanish() {
        sink.lost("the scripted server has gone");
    }

    /** The newest tick that the client has answered; -2 before it has requested its first data. */
    public long answered() {
        return answers.stream().mapToLong(Long::longValue).max().orElse(-2);
    }

    /** Publishes a tick on another thread as soon as an earlier one has been answered. */
    public void publishAfter(long answeredTick, long tick) {
        Thread.ofPlatform().daemon().start(() -> {
            try {
                synchronized (this) {
                    while (answered() < answeredTick) {
                        wait();
                    }
                }
                publish(tick);
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
            }
        });
    }

    private static DeviceData data(DeviceAddress from, long tick) {
        return switch (Interfaces.name(from.interfaceCode())) {
            case "position2d" -> new DeviceData.Position2d(tick, 0, 0, 0, 0, 0, false);
            case "sonar" -> new DeviceData.SonarRanges(List.of((float) tick));
            case "blobfinder" ->
                new DeviceData.Blobs(80, 60, List.of(new DeviceData.Blob(0, (int) tick, 1, 0, 0, 0, 0, 0, 0, 1)));
            case "ranger" -> new DeviceData.RangerRanges(List.of((double) tick, 2.0));
            case "laser" ->
                new DeviceData.LaserScan(-1, 1, 1, 8, List.of((float) tick, 2f, 3f), List.of((byte) 7), (int) tick);
            default -> throw new AssertionError(from + " publishes nothing");
        };
    }

    @Override
    public String banner() {
        return "Player v.3.1.1-dev";
    }

    @Override
    public PlayerConnection connect(DataSink newSink, @Nullable ActorSpace space) {
        sink = newSink;
        return this;
    }

    @Override
    public List<DeviceAddress> devices() {
        return devices;
    }

    @Override
    public String driverName(DeviceAddress device) {
        return "stage";
    }

    @Override
    public void subscribe(DeviceAddress device) {
        if (!devices.contains(device)) {
            throw new IllegalArgumentException("there is no " + device);
        }
        subscribed.add(device);
        whileSubscribing.run();
    }

    @Override
    public void unsubscribe(DeviceAddress device) {
        subscribed.remove(device);
    }

    @Override
    public void command(DeviceAddress device, DeviceCommand command) {
        commands.add(command);
    }

    @Override
    public DeviceReply request(DeviceAddress device, DeviceRequest request) {
        requests.add(request);
        return script.containsKey(request) ? script.get(request) : replier.apply(request);
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
    public void answers(boolean whether) {
        if (!whether) {
            throw new AssertionError("it requests its data");
        }
    }

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
