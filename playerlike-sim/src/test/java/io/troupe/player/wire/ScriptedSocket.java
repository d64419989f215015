package io.troupe.player.wire;

import static java.util.Objects.requireNonNull;

import io.troupe.player.PlayerClient;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.nio.charset.StandardCharsets;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import org.jspecify.annotations.Nullable;

/**
 * A server at a socket whose behaviour the test scripts; what the script leaves out is answered as a real server does.
 */
final class ScriptedSocket implements AutoCloseable {
    /** What the server does with a request instead of the default reply. */
    interface Answer {
        void to(WireMessage message) throws IOException;
    }

    /** All messages except commands. */
    final List<WireMessage> received = new CopyOnWriteArrayList<>();
    /** While this is true, nothing is answered. */
    volatile boolean silent;

    private final BlockingQueue<WireMessage> commands = new LinkedBlockingQueue<>();
    private final Map<List<Integer>, Answer> script = new ConcurrentHashMap<>();
    private final CountDownLatch readOn = new CountDownLatch(1);
    private final List<PlayerClient> clients = new CopyOnWriteArrayList<>();
    private final ServerSocket listener;
    private final byte[] greeting;
    private final Thread thread;
    private volatile @Nullable Socket client;

    /** A Player greeting is padded to its 32 bytes; any other is sent unchanged. */
    ScriptedSocket(String greeting) {
        byte[] text = greeting.getBytes(StandardCharsets.ISO_8859_1);
        this.greeting = greeting.startsWith("Player") ? Arrays.copyOf(text, 32) : text;
        try {
            listener = new ServerSocket(0, 1, InetAddress.getLoopbackAddress());
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
        thread = Thread.ofPlatform().daemon().name("scripted-socket").start(this::serve);
    }

    ScriptedSocket() {
        this("Player v.3.1.1-dev");
    }

    /** Scripts the requests of this kind. */
    void on(int interfaceCode, int subtype, Answer answer) {
        script.put(List.of(interfaceCode, subtype), answer);
    }

    /** Scripts that nothing is read after a request of this kind until {@link #readOn}. */
    void stopReadingAt(int interfaceCode, int subtype) {
        on(interfaceCode, subtype, message -> {
            awaitReadOn();
            answer(message);
        });
    }

    void awaitReadOn() {
        try {
            readOn.await();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    void readOn() {
        readOn.countDown();
    }

    /** A client that is closed with this server. */
    PlayerClient connect() {
        clients.add(new PlayerClient("localhost", port()));
        return clients.getLast();
    }

    PlayerConnection connect(DataSink sink) {
        return new RemoteServer("localhost", port()).connect(sink, null);
    }

    int port() {
        return listener.getLocalPort();
    }

    /** Host and port, as messages name them. */
    @Override
    public String toString() {
        return "localhost:" + port();
    }

    DeviceAddress device(Interfaces type) {
        return new DeviceAddress(TcpServer.LOOPBACK_HOST, port(), type.code(), 0);
    }

    private static List<Integer> kind(WireMessage message) {
        return List.of(
                message.header().address().interfaceCode(), message.header().subtype());
    }

    /** The number of requests of this kind so far. */
    long count(int interfaceCode, int subtype) {
        return received.stream()
                .filter(each -> kind(each).equals(List.of(interfaceCode, subtype)))
                .count();
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
                if (!silent) {
                    script.getOrDefault(kind(message), this::answer).to(message);
                }
            }
        } catch (IOException closed) {
            // closed by the client or by the test
        } catch (WireException e) {
            throw new AssertionError(e);
        }
    }

    /** The default reply. */
    void answer(WireMessage message) throws IOException {
        if (message.header().address().interfaceCode() != PlayerRequest.INTERFACE) {
            send(ack(message, Content.NONE));
            return;
        }
        try {
            PlayerReply reply = switch (PlayerDeviceCodec.request(
                    message.header().subtype(), message.payload())) {
                case PlayerRequest.DeviceList list ->
                    new PlayerReply.DeviceList(List.of(
                            device(Interfaces.POSITION2D), device(Interfaces.SONAR), device(Interfaces.RANGER)));
                case PlayerRequest.Access access -> new PlayerReply.Access(access.device(), access.mode(), "stage");
                default -> new PlayerReply.Ack();
            };
            send(reply(message, PlayerDeviceCodec.type(reply), PlayerDeviceCodec.encode(reply)));
        } catch (WireException e) {
            throw new AssertionError(e);
        }
    }

    WireMessage reply(WireMessage to, MessageType type, byte[] payload) {
        return WireMessage.of(to.header().address(), type, to.header().subtype(), 0, payload);
    }

    WireMessage ack(WireMessage to, byte[] payload) {
        return reply(to, MessageType.ACK, payload);
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
        var bytes = new ByteArrayOutputStream();
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

    /** Closes the server and leaves its clients open. */
    void vanish() {
        try {
            listener.close();
            Socket connected = client;
            if (connected != null) {
                connected.close();
            }
            thread.join();
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    @Override
    public void close() {
        readOn();
        clients.forEach(PlayerClient::close);
        vanish();
    }
}
