package io.troupe.player.wire;

import java.lang.System.Logger;
import java.lang.System.Logger.Level;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.jspecify.annotations.Nullable;

/**
 * Handles the messages of one client and puts the replies into its outbox: one for each request, in order.
 *
 * <p><b>Threads.</b> {@link #handle} on the thread that reads from the client; {@link #frame} on the server's thread.
 *
 * <p><b>Errors.</b> An invalid request is refused with a NACK. Any other invalid message is dropped and logged.
 */
final class ClientMessageHandler {
    private static final Logger LOG = System.getLogger(ClientMessageHandler.class.getName());

    private record Place(int interfaceCode, int index) {
        static Place of(DeviceAddress address) {
            return new Place(address.interfaceCode(), address.index());
        }
    }

    private final String peer;
    private final PlayerConnection connection;
    private final Outbox outbox;
    private final int host;
    private final int robot;
    /** The address of each device in this JVM, by interface and index. */
    private final Map<Place, DeviceAddress> devices = new LinkedHashMap<>();

    private final TcpServer.Shared shared;
    private final MessageAge ages;
    /** Age in milliseconds above which a speed is dropped, for each device with a limit. */
    private final Map<DeviceAddress, Integer> ageLimitsMillis = new HashMap<>();

    private int lateInARow;
    private boolean pull;

    /**
     * @param host host part of every address that the client sees
     * @param robot robot part (the port) of every such address
     */
    ClientMessageHandler(
            String peer, PlayerConnection connection, Outbox outbox, int host, int robot, TcpServer.Shared shared) {
        this.shared = shared;
        this.ages = new MessageAge(shared.clock().nanos());
        this.peer = peer;
        this.connection = connection;
        this.outbox = outbox;
        this.host = host;
        this.robot = robot;
        for (var device : connection.devices()) {
            devices.put(Place.of(device), device);
        }
        outbox.onEmptyFrame(connection::answered);
        outbox.inLockStep(connection::isWaitedFor);
    }

    // ---- to the client

    void frame(Frame frame) {
        List<DeviceDataMessage> messages = frame.messages().stream()
                .map(each -> new DeviceDataMessage(outside(each.from()), each.timeSeconds(), each.data()))
                .toList();
        outbox.frame(frame.tick(), frame.timeSeconds(), messages);
    }

    private DeviceAddress outside(DeviceAddress address) {
        return new DeviceAddress(host, robot, address.interfaceCode(), address.index());
    }

    private WireMessage reply(Header request, MessageType type, byte[] payload) {
        var header = new Header(
                outside(request.address()),
                type,
                request.subtype(),
                outbox.timeSeconds(),
                request.sequence(),
                payload.length);
        return new WireMessage(header, payload);
    }

    private WireMessage refusal(Header request) {
        return reply(request, MessageType.NACK, Content.NONE);
    }

    private WireMessage reply(Header request, PlayerReply reply) {
        return reply(request, PlayerDeviceCodec.type(reply), PlayerDeviceCodec.encode(reply));
    }

    // ---- from the client

    void handle(WireMessage message) {
        double ageSeconds =
                ages.seconds(message.header().timeSeconds(), shared.clock().nanos());
        switch (message.header().type()) {
            case CMD -> command(message, ageSeconds);
            case REQ -> request(message);
            case DATA, ACK, SYNCH, NACK -> drop(message, "expected commands and requests only");
        }
    }

    private void command(WireMessage message, double ageSeconds) {
        Header header = message.header();
        DeviceAddress device = devices.get(Place.of(header.address()));
        if (device == null) {
            drop(message, "there is no such device");
            return;
        }
        try {
            var command = CommandCodec.decode(device.interfaceCode(), header.subtype(), message.payload());
            if (command.isPresent()) {
                if (!isLate(device, command.get(), ageSeconds)) {
                    connection.command(device, command.get());
                }
            } else {
                drop(message, "not a known command");
            }
        } catch (WireException | IllegalArgumentException e) {
            drop(message, String.valueOf(e.getMessage()));
        }
    }

    /**
     * True for a speed that is older than the client's limit: after a cut of the network TCP delivers everything that
     * was sent meanwhile. The first of several is logged, and then their number.
     */
    private boolean isLate(DeviceAddress device, DeviceCommand command, double ageSeconds) {
        Integer limitMillis = ageLimitsMillis.get(device);
        if (limitMillis == null || command instanceof DeviceCommand.GoTo) {
            return false;
        }
        if (ageSeconds * 1_000 <= limitMillis || connection.isWaitedFor()) {
            if (lateInARow > 0) {
                LOG.log(Level.INFO, "{0} is in time again; {1} late speeds were dropped", peer, lateInARow);
                lateInARow = 0;
            }
            return false;
        }
        shared.lateCommands().incrementAndGet();
        if (lateInARow++ == 0) {
            String what = Double.isInfinite(ageSeconds)
                    ? "a speed without a time stamp"
                    : "a speed that arrives " + Math.round(ageSeconds * 1_000) + " ms late";
            LOG.log(
                    Level.WARNING,
                    "{0} sent {1}:{2} {3}; speeds are dropped that are more than {4} ms late",
                    peer,
                    Interfaces.name(device.interfaceCode()),
                    device.index(),
                    what,
                    limitMillis);
        }
        return true;
    }

    private void drop(WireMessage message, String reason) {
        LOG.log(Level.DEBUG, () -> peer + " sent " + message + ", which is dropped: " + reason);
    }

    private void request(WireMessage message) {
        Header header = message.header();
        DeviceAddress device = devices.get(Place.of(header.address()));
        try {
            if (header.address().interfaceCode() == PlayerRequest.INTERFACE) {
                player(header, PlayerDeviceCodec.request(header.subtype(), message.payload()));
            } else if (device == null) {
                refuse(message, "there is no such device");
            } else {
                var request = RequestCodec.decode(device.interfaceCode(), header.subtype(), message.payload());
                DeviceReply answer = request instanceof DeviceRequest.Unknown
                        ? new DeviceReply.Nack("not a known request")
                        : connection.request(device, request);
                if (answer instanceof DeviceReply.Ack
                        && request instanceof DeviceRequest.SetIntegerProperty(String key, int millis)
                        && key.equals(DeviceRequest.COMMAND_AGE_KEY)) {
                    ageLimit(device, millis);
                }
                if (answer instanceof DeviceReply.Nack(String reason)) {
                    refuse(message, reason);
                } else {
                    outbox.reply(reply(header, ReplyCodec.type(answer), ReplyCodec.encode(answer)));
                }
            }
        } catch (WireException | IllegalArgumentException e) {
            refuse(message, String.valueOf(e.getMessage()));
        }
    }

    private void ageLimit(DeviceAddress device, int millis) {
        if (millis == 0) {
            ageLimitsMillis.remove(device);
        } else {
            ageLimitsMillis.put(device, millis);
        }
    }

    private void refuse(WireMessage message, String reason) {
        LOG.log(Level.DEBUG, () -> peer + " sent " + message + ", which is refused: " + reason);
        outbox.reply(refusal(message.header()));
    }

    private void player(Header header, PlayerRequest request) {
        switch (request) {
            case PlayerRequest.DeviceList list ->
                outbox.reply(reply(
                        header,
                        new PlayerReply.DeviceList(
                                devices.values().stream().map(this::outside).toList())));
            case PlayerRequest.DriverInfo info -> {
                DeviceAddress device = devices.get(Place.of(info.device()));
                outbox.reply(
                        device == null
                                ? refusal(header)
                                : reply(
                                        header,
                                        new PlayerReply.DriverInfo(outside(device), connection.driverName(device))));
            }
            case PlayerRequest.Access access -> access(header, access.mode(), devices.get(Place.of(access.device())));
            case PlayerRequest.NextData next -> {
                long seen = outbox.ask(reply(header, new PlayerReply.Ack()));
                if (pull) {
                    connection.answered(seen);
                }
            }
            case PlayerRequest.DataMode mode -> deliver(header, mode.mode());
            case PlayerRequest.AddRule add -> {
                outbox.add(add.rule());
                outbox.reply(reply(header, new PlayerReply.Ack()));
            }
            case PlayerRequest.Capability capability ->
                outbox.reply(
                        PlayerDeviceCodec.isServed(capability.type(), capability.subtype())
                                ? reply(header, new PlayerReply.Ack())
                                : refusal(header));
            case PlayerRequest.Other other -> outbox.reply(refusal(header));
        }
    }

    private void deliver(Header header, Delivery mode) {
        pull = mode == Delivery.PULL;
        if (outbox.hasSubscribed()) {
            connection.answers(pull);
        }
        outbox.mode(mode);
        outbox.reply(reply(header, new PlayerReply.Ack()));
    }

    private void access(Header header, int mode, @Nullable DeviceAddress device) {
        if (device == null || mode != PlayerRequest.OPEN && mode != PlayerRequest.CLOSE) {
            outbox.reply(refusal(header));
            return;
        }
        WireMessage reply = reply(header, new PlayerReply.Access(outside(device), mode, connection.driverName(device)));
        if (mode == PlayerRequest.CLOSE) {
            connection.unsubscribe(device);
            outbox.unsubscribed(outside(device), reply);
            return;
        }
        // The reply precedes the first data in the outbox, but is sent only when the devices know the subscriber.
        outbox.cork();
        try {
            outbox.subscribed(outside(device), reply);
            connection.answers(pull);
            connection.subscribe(device);
        } finally {
            outbox.uncork();
        }
    }
}
