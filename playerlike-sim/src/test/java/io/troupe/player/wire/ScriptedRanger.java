package io.troupe.player.wire;

import io.troupe.actor.ActorSpace;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import org.jspecify.annotations.Nullable;

/** A server with a ranger:0 for one client, which publishes and replies as the test scripts it. */
class ScriptedRanger implements PlayerServer, PlayerConnection {
    static final DeviceAddress ADDRESS = new DeviceAddress(0, 1, 62, 0);

    /** The ticks that the client has answered, oldest first. */
    final List<Long> answers = new ArrayList<>();

    /** Runs while a client is being subscribed. */
    Runnable whileSubscribing = () -> {};

    private final Map<DeviceRequest, DeviceReply> replies;
    private @Nullable DataSink sink;
    private long tick;

    ScriptedRanger(Map<DeviceRequest, DeviceReply> replies) {
        this.replies = replies;
    }

    void publish(double timeSeconds, @Nullable DeviceData data) {
        sink.frame(new Frame(tick++, timeSeconds, List.of(new DeviceDataMessage(ADDRESS, timeSeconds, data))));
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
        return List.of(ADDRESS);
    }

    @Override
    public String driverName(DeviceAddress device) {
        return "stage";
    }

    @Override
    public void subscribe(DeviceAddress device) {
        if (!device.equals(ADDRESS)) {
            throw new IllegalArgumentException("there is no " + device);
        }
        whileSubscribing.run();
    }

    @Override
    public void unsubscribe(DeviceAddress device) {
        throw new AssertionError("not in the script");
    }

    @Override
    public void command(DeviceAddress device, DeviceCommand command) {
        throw new AssertionError("not in the script");
    }

    @Override
    public DeviceReply request(DeviceAddress device, DeviceRequest request) {
        return replies.getOrDefault(request, new DeviceReply.Nack("not in the script"));
    }

    @Override
    public synchronized void answered(long answeredTick) {
        answers.add(answeredTick);
    }

    @Override
    public void answers(boolean whether) {
        if (!whether) {
            throw new AssertionError("it asks for its data");
        }
    }

    @Override
    public void delivery(Delivery mode) {}

    @Override
    public void replace(ReplaceRule rule) {}

    @Override
    public void close() {}
}
