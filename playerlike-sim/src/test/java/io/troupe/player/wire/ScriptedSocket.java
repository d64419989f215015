package io.troupe.player.wire;

import static java.util.Objects.requireNonNull;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.nio.charset.StandardCharsets;
import java.util.Arrays;
import java.util.List;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import org.jspecify.annotations.Nullable;

/**
 * A server at a socket whose behaviour the test scripts; what the script leaves out is answered as a real server does.
 */
final class ScriptedSocket implements AutoCloseable {
    private static final int LOOPBACK = 0x0100007f;

    /** The requests that a test answers itself. */
    interface Script {
        /** False leaves the message to the default reply. */
        boolean answers(WireMessage message, ScriptedSocket server) throws IOException;
    }

    /** All messages except commands. */
    final List<WireMessage> received = new CopyOnWriteArrayList<>();

    private final BlockingQueue<WireMessage> commands = new LinkedBlockingQueue<>();
    private final ServerSocket listener = new ServerSocket(0, 1, InetAddress.getLoopbackAddress());
    private final byte[] greeting;
    private final Script script;
    private final Thread thread;
    private volatile @Nullable Socket client;

    /** A Player greeting is padded to its 32 bytes; any other is sent unchanged. */
    ScriptedSocket(String greeting, Script script) throws IOException {
        byte[] text = greeting.getBytes(StandardCharsets.ISO_8859_1);
        this.greeting = greeting.startsWith("Player") ? Arrays.copyOf(text, 32) : text;
        this.script = script;
        this.thread = Thread.ofPlatform().daemon().name("scripted-socket").start(this::serve);
    }

    ScriptedSocket(Script script) throws IOException {
        this("Player v.3.1.1-dev", script);
    }

    int port() {
        return listener.getLocalPort();
    }

    DeviceAddress device(Interfaces type) {
        return new DeviceAddress(LOOPBACK, port(), type.code(), 0);
    }

    private void serve() {
        try (var socket = listener.accept()) {
            client = socket;
            socket.getOutputStream().write(greeting);
            var messages = new MessageReader(socket.getInputStream(), 1 << 20);
            for (WireMessage message = messages.read(); message != null; message = messages.read()) {
                if (message.header().type() == MessageType.CMD) {
                    commands.add(message);
                    continue;
                }
                received.add(message);
                if (!script.answers(message, this)) {
                    answer(message);
                }
            }
        } catch (IOException closed) {
            // closed by the client or by the test
        } catch (WireException e) {
            throw new AssertionError(e);
        }
    }

    private void answer(WireMessage message) throws IOException, WireException {
        var header = message.header();
        if (header.address().interfaceCode() != PlayerRequest.INTERFACE) {
            send(reply(message, MessageType.ACK, Content.NONE));
            return;
        }
        PlayerReply reply = switch (PlayerDeviceCodec.request(header.subtype(), message.payload())) {
            case PlayerRequest.DeviceList list ->
                new PlayerReply.DeviceList(
                        List.of(device(Interfaces.POSITION2D), device(Interfaces.SONAR), device(Interfaces.RANGER)));
            case PlayerRequest.Access access -> new PlayerReply.Access(access.device(), access.mode(), "stage");
            default -> new PlayerReply.Ack();
        };
        send(reply(message, PlayerDeviceCodec.type(reply), PlayerDeviceCodec.encode(reply)));
    }

    WireMessage reply(WireMessage to, MessageType type, byte[] payload) {
        return WireMessage.of(to.header().address(), type, to.header().subtype(), 0, payload);
    }

    WireMessage position(double x) {
        return data(Interfaces.POSITION2D, new DeviceData.Position2d(x, 0, 0, 0, 0, 0, false), x);
    }

    WireMessage sonar(float range) {
        return data(Interfaces.SONAR, new DeviceData.SonarRanges(List.of(range)), range);
    }

    WireMessage data(Interfaces type, DeviceData data, double timeSeconds) {
        Content content = DataCodec.encode(data);
        return WireMessage.of(device(type), MessageType.DATA, content.subtype(), timeSeconds, content.payload());
    }

    /** With address and time as a real server sends them. */
    WireMessage synch() {
        return WireMessage.of(new DeviceAddress(0, 0, 1, 0), MessageType.SYNCH, 1, Double.NaN, Content.NONE);
    }

    /** In a single write, so as one segment. */
    void send(WireMessage... messages) throws IOException {
        var bytes = new java.io.ByteArrayOutputStream();
        for (var each : messages) {
            bytes.writeBytes(each.bytes());
        }
        sendRaw(bytes.toByteArray());
    }

    void sendRaw(byte[] bytes) throws IOException {
        requireNonNull(client, "nobody has connected").getOutputStream().write(bytes);
    }

    WireMessage nextCommand() throws InterruptedException {
        return requireNonNull(commands.poll(30, TimeUnit.SECONDS), "no command came");
    }

    /** The next command that has already arrived, or null. */
    @Nullable
    WireMessage pollCommand() {
        return commands.poll();
    }

    /** Closes the server. */
    @Override
    public void close() {
        try {
            listener.close();
            Socket connected = client;
            if (connected != null) {
                connected.close();
            }
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
        try {
            thread.join();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
