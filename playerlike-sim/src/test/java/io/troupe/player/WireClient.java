package io.troupe.player;

import io.troupe.player.wire.DataSink;
import io.troupe.player.wire.DeviceAddress;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.player.wire.DeviceData;
import io.troupe.player.wire.DeviceReply;
import io.troupe.player.wire.DeviceRequest;
import io.troupe.player.wire.Frame;
import io.troupe.player.wire.Interfaces;
import io.troupe.player.wire.PlayerConnection;
import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.function.BiConsumer;

/** A client at the wire level that reacts to every frame in the same way. */
public final class WireClient implements DataSink {
    /** The minimum that a client in lock step does: it answers. */
    public static final BiConsumer<WireClient, Frame> ANSWER = WireClient::answer;

    public final List<Frame> frames = new CopyOnWriteArrayList<>();
    public final PlayerConnection line;
    final List<String> losses = new CopyOnWriteArrayList<>();
    private final BiConsumer<WireClient, Frame> move;

    public WireClient(int port, BiConsumer<WireClient, Frame> move) {
        this.move = move;
        line = PlayerPorts.find(port).orElseThrow().connect(this, null);
    }

    public WireClient subscribe(Interfaces type, int index) {
        line.subscribe(device(type, index));
        return this;
    }

    public DeviceAddress device(Interfaces type, int index) {
        return line.devices().stream()
                .filter(each -> each.interfaceCode() == type.code() && each.index() == index)
                .findFirst()
                .orElseThrow();
    }

    void answer(Frame frame) {
        line.answered(frame.tick());
    }

    public void tell(Interfaces type, int index, DeviceCommand command) {
        line.command(device(type, index), command);
    }

    void drive(int robot, double speedMps) {
        tell(Interfaces.POSITION2D, robot, new DeviceCommand.Velocity(speedMps, 0, 0, true));
    }

    public DeviceReply ask(Interfaces type, int index, DeviceRequest request) {
        return line.request(device(type, index), request);
    }

    /** The newest data of a device. */
    public DeviceData newest(Interfaces type, int index) {
        return frames.getLast().messages().stream()
                .filter(each -> each.from().equals(device(type, index)))
                .findFirst()
                .orElseThrow()
                .data();
    }

    @Override
    public void frame(Frame frame) {
        frames.add(frame);
        move.accept(this, frame);
    }

    @Override
    public void lost(String reason) {
        losses.add(reason);
    }
}
