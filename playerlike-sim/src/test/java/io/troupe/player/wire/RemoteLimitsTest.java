package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.catchThrowableOfType;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Clock;
import io.troupe.actor.SpaceSettings;
import io.troupe.player.PlayerException;
import io.troupe.player.structures.PlayerConstants;
import java.io.IOException;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.ProtocolFamily;
import java.net.ServerSocket;
import java.net.SocketTimeoutException;
import java.nio.channels.DatagramChannel;
import java.nio.channels.Pipe;
import java.nio.channels.ServerSocketChannel;
import java.nio.channels.SocketChannel;
import java.nio.channels.spi.AbstractSelector;
import java.nio.channels.spi.SelectorProvider;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/**
 * A client never waits longer than its limit, bounds what it keeps, and never takes a reply for another one, also when
 * the server does not read and messages are not sent, or only in part.
 */
@Tag("threads")
@Timeout(value = 60, threadMode = Timeout.ThreadMode.SEPARATE_THREAD)
class RemoteLimitsTest implements PlayerConstants {
    private static final DeviceAddress SIMULATION = new DeviceAddress(0, 0, Interfaces.SIMULATION.code(), 0);
    private static final ReplaceRule RULE = new ReplaceRule(-1, -1, 1, -1, ReplaceRule.IGNORE);
    private static final Duration SHORT = Duration.ofMillis(50);
    private static final Duration LONG = Duration.ofMinutes(1);

    private final ScriptedSocket server = new ScriptedSocket();

    @AfterEach
    void close() {
        server.close();
    }

    private static void fails(Class<? extends Exception> type, Runnable call, String... parts) {
        var failure = assertThatThrownBy(call::run).isInstanceOf(type);
        List.of(parts).forEach(failure::hasMessageContaining);
    }

    private static WireMessage pose(WireMessage request, String model, double x) {
        byte[] payload = ReplyCodec.encode(new DeviceReply.ModelPose(model, x, 0, 0));
        Header asked = request.header();
        return new WireMessage(
                new Header(asked.address(), MessageType.ACK, asked.subtype(), 0, asked.sequence(), payload.length),
                payload);
    }

    private void requestGeometry(PlayerConnection connection) {
        connection.request(server.device(Interfaces.POSITION2D), new DeviceRequest.Geometry());
    }

    // ---- servers that do not read

    /** Makes a server that stops reading at a rule read nothing more, and fills all buffers. */
    private static void jam(PlayerConnection connection) {
        connection.replyLimit(SHORT);
        fails(RequestFailedException.class, () -> connection.replace(RULE));
        fill(connection);
    }

    /** Sends until all buffers are full and far more remains than a buffer can grow by. */
    private static void fill(PlayerConnection connection) {
        var large = new DeviceRequest.GetPose("a".repeat(900_000));
        RequestFailedException failed;
        do {
            failed = catchThrowableOfType(RequestFailedException.class, () -> connection.request(SIMULATION, large));
        } while (!failed.getMessage().contains("has not taken a message"));
    }

    @Test
    void serverThatReadsNoMore_endsSendingAfterTheLimit_andByAnInterrupt_andTheConnectionGoesOn() throws Exception {
        server.stopReadingAt(1, 10);
        var client = server.connect();
        var pos = client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
        client.setReadTimeout(50);
        fails(PlayerException.class, () -> client.requestAddReplaceRule(-1, -1, 1, -1, 1));
        Runnable untilAllBuffersAreFull = () -> {
            while (true) {
                pos.setSpeed(0.1, 0.2);
            }
        };
        fails(PlayerException.class, untilAllBuffersAreFull, server + " has not taken a message within 50 ms");
        client.setReadTimeout(3_600_000);
        Thread.currentThread().interrupt();
        fails(PlayerException.class, () -> pos.setSpeed(0.1, 0.2), "interrupted while sending to " + server);
        assertThat(Thread.interrupted()).isTrue();

        server.readOn();
        pos.setSpeed(0.3, 0.4);
        // decoded after everything that was sent before, partly sent messages included
        client.requestAddReplaceRule(-1, -1, 1, -1, 1);
        WireMessage newest = server.nextCommand();
        int commands = 1;
        for (WireMessage each = server.pollCommand(); each != null; each = server.pollCommand()) {
            newest = each;
            commands++;
        }
        assertThat(commands).isGreaterThan(1);
        var velocity = CommandCodec.encode(new DeviceCommand.Velocity(0.3, 0, 0.4, true));
        assertThat(newest.payload()).isEqualTo(velocity.payload());
    }

    @Test
    void pull_questionForDataThatWasNotSent_isAskedAgain() throws Exception {
        var frame = new CompletableFuture<Frame>();
        server.stopReadingAt(1, 10);
        server.on(1, 4, message -> {
            server.send(server.ack(message, Content.NONE), server.position(1), server.synch());
        });
        var connection = server.connect(new Sink(frame::complete, reason -> {}));
        connection.delivery(Delivery.PULL);
        jam(connection);
        fails(RequestFailedException.class, () -> connection.answered(PlayerConnection.NO_TICK));
        server.readOn();
        connection.replyLimit(LONG);
        connection.answered(PlayerConnection.NO_TICK);
        assertThat(frame.get(30, TimeUnit.SECONDS).timeSeconds()).isEqualTo(1);
        connection.close();
    }

    @Test
    void pull_onAnActorSpace_questionForDataThatCannotBeSent_losesTheLine() throws Exception {
        var lost = new CompletableFuture<String>();
        var connection = new CompletableFuture<PlayerConnection>();
        server.on(1, 4, message -> {
            server.send(server.ack(message, Content.NONE), server.synch());
            server.awaitReadOn();
        });
        try (var space = ActorSpace.create(SpaceSettings.named("asking"))) {
            var sink = new Sink(frame -> fill(connection.join()), lost::complete);
            connection.complete(new RemoteServer("localhost", server.port()).connect(sink, space));
            connection.join().delivery(Delivery.PULL);
            connection.join().replyLimit(SHORT);
            connection.join().answered(PlayerConnection.NO_TICK);
            assertThat(lost.get(30, TimeUnit.SECONDS))
                    .startsWith("data cannot be asked for: " + server + " has not taken a message");
            server.readOn();
            connection.join().close();
        }
    }

    /** The server replies in order and without sequence numbers. */
    @Test
    void requestThatWasSentInPart_getsItsReply_andNoLaterRequestDoes() {
        server.stopReadingAt(1, 10);
        server.on(31, 1, message -> {
            try {
                var asked = (DeviceRequest.GetPose) RequestCodec.decode(31, 1, message.payload());
                var pose = new DeviceReply.ModelPose(asked.model().substring(0, 1), 0, 0, 0);
                server.send(server.ack(message, ReplyCodec.encode(pose)));
            } catch (WireException e) {
                throw new IOException(e);
            }
        });
        var connection = server.connect(Sink.NONE);
        jam(connection);
        server.readOn();
        connection.replyLimit(LONG);
        assertThat(connection.request(SIMULATION, new DeviceRequest.GetPose("b")))
                .isEqualTo(new DeviceReply.ModelPose("b", 0, 0, 0));
        connection.close();
    }

    @Test
    void socket_saysHowMuchWasSent_andSendsTheRest() throws Exception {
        byte[] message = new byte[16 << 20]; // more than all buffers can hold
        try (var listener = new ServerSocket(0, 1, InetAddress.getLoopbackAddress());
                var socket = new RemoteSocket()) {
            socket.connect(new InetSocketAddress(listener.getInetAddress(), listener.getLocalPort()), LONG);
            try (var accepted = listener.accept()) {
                var sent = new ArrayList<Integer>();
                for (int attempt = 0; attempt < 2; attempt++) {
                    var failed = catchThrowableOfType(
                            SocketTimeoutException.class,
                            () -> socket.send(message, Deadline.after(SHORT, Clock.system())));
                    sent.add(failed.bytesTransferred);
                }
                assertThat(sent.getFirst()).isPositive().isLessThan(message.length);
                assertThat(sent.getLast()).isZero();
                var read = CompletableFuture.supplyAsync(() -> {
                    try {
                        return accepted.getInputStream().readNBytes(message.length).length;
                    } catch (IOException e) {
                        throw new AssertionError(e);
                    }
                });
                socket.sendRest(Deadline.after(LONG, Clock.system()));
                assertThat(read.get(30, TimeUnit.SECONDS)).isEqualTo(message.length);
            }
        }
    }

    @Test
    void questionForASignOfLife_isSent_whileNoCarrierOfVirtualThreadsIsFree() throws Throwable {
        var asked = new CountDownLatch(2); // one from connecting, one for the keep-alive request
        server.on(1, 1, message -> {
            asked.countDown();
            server.answer(message);
        });
        var connection = (RemoteConnection) server.connect(Sink.NONE);
        Served.whileNoCarrierIsFree(() -> {
            connection.sendKeepAlive();
            assertThat(asked.await(60, TimeUnit.SECONDS)).isTrue();
        });
        connection.close();
    }

    /** Each read of the clock advances it by an hour, so sending uses up the whole limit. */
    @Test
    void call_hasOneLimit_forSendingAndForWaiting() {
        var slow = new AtomicBoolean();
        var clock = new Clock() {
            private long nanos;

            @Override
            public synchronized long nanos() {
                nanos += slow.get() ? Duration.ofHours(1).toNanos() : 0;
                return nanos;
            }

            @Override
            public Runnable onMove(Runnable wake) {
                return () -> {};
            }

            @Override
            public boolean runsByItself() {
                return true;
            }
        };
        server.on(1, 10, dropped -> {});
        var connection = new RemoteServer("localhost", server.port(), LONG, clock).connect(Sink.NONE, null);
        slow.set(true);
        connection.replyLimit(Duration.ofMinutes(59));
        fails(RequestFailedException.class, () -> connection.replace(RULE), "did not answer within 3540000 ms");
        connection.close();
    }

    // ---- replies, ends and bounds

    @Test
    void lateReply_goesToNoOtherRequest() {
        var held = new ArrayList<WireMessage>();
        server.on(31, 1, message -> {
            held.add(message);
            if (held.size() == 2) {
                server.send(pose(held.get(0), "a", 1), pose(held.get(1), "b", 2));
            }
        });
        var connection = server.connect(Sink.NONE);
        connection.replyLimit(SHORT);
        fails(RequestFailedException.class, () -> connection.request(SIMULATION, new DeviceRequest.GetPose("a")));
        connection.replyLimit(LONG);
        assertThat(connection.request(SIMULATION, new DeviceRequest.GetPose("b")))
                .isEqualTo(new DeviceReply.ModelPose("b", 2, 0, 0));
        connection.close();
    }

    /** Stops the reader where it has noticed the end and notifies the sink. */
    @Test
    void serverThatHasGone_isKnownToTheSinkAndToEveryCall_atTheSameTime() throws Exception {
        var toldByReader = new CountDownLatch(1);
        var toldBy = new ConcurrentLinkedQueue<Thread>();
        var connection = server.connect(new Sink(frame -> {}, reason -> {
            toldBy.add(Thread.currentThread());
            if (toldBy.size() == 1) {
                toldByReader.countDown();
                server.awaitReadOn();
            }
        }));
        server.vanish();
        toldByReader.await();
        assertThatThrownBy(connection::devices).hasMessageContaining("has gone");
        assertThat(toldBy).as("told before the call failed").hasSize(2).contains(Thread.currentThread());
        server.readOn();
        connection.close();
    }

    @Test
    void errorOfTheSink_endsTheConnection_andEveryCallThatWaits() {
        server.on(4, 1, message -> server.send(server.position(1))); // and sends no reply
        var connection = server.connect(new Sink(
                frame -> {
                    throw new NoClassDefFoundError("of a class that could not be read");
                },
                reason -> {}));
        connection.replyLimit(Duration.ofHours(1));
        fails(ConnectionClosedException.class, () -> requestGeometry(connection), "NoClassDefFoundError");
        connection.close();
    }

    @Test
    void framesForABusySpace_areBounded_andTheNewestStay() throws Exception {
        int sent = 3_000;
        server.on(4, 1, message -> {
            for (int i = 1; i <= sent; i++) {
                server.send(server.position(i));
            }
            server.answer(message);
        });
        try (var space = ActorSpace.create(SpaceSettings.named("busy"))) {
            var frames = new ConcurrentLinkedQueue<Frame>();
            var connection =
                    new RemoteServer("localhost", server.port()).connect(new Sink(frames::add, reason -> {}), space);
            space.execute(server::awaitReadOn);
            connection.replyLimit(LONG);
            requestGeometry(connection); // after all data
            server.readOn();
            var done = new CountDownLatch(1);
            space.execute(done::countDown);
            done.await();
            assertThat(frames).hasSize(1024);
            assertThat(List.copyOf(frames).getLast().timeSeconds()).isEqualTo(sent);
            connection.close();
        }
    }

    @Test
    void greetingThatTrickles_hasOneLimit() throws Exception {
        var isOver = new CountDownLatch(1);
        try (var listener = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            var trickle = Thread.ofPlatform().daemon().start(() -> {
                try (var socket = listener.accept()) {
                    for (char each : "Player v.3.1.1-dev--------------".toCharArray()) {
                        isOver.await(20, TimeUnit.MILLISECONDS); // less than the limit, and in all far longer
                        socket.getOutputStream().write(each);
                    }
                    socket.getInputStream().read();
                } catch (IOException | InterruptedException clientHasGone) {
                    // expected
                }
            });
            var remote = new RemoteServer("localhost", listener.getLocalPort(), Duration.ofMillis(100));
            assertThatThrownBy(() -> remote.connect(Sink.NONE, null))
                    .isInstanceOf(ConnectionClosedException.class)
                    .hasMessage("localhost:" + listener.getLocalPort() + " did not answer within 100 ms");
            isOver.countDown();
            trickle.join();
        }
    }

    @Test
    void socketWithoutASelector_leavesNoChannelOpen() {
        var system = SelectorProvider.provider();
        var opened = new ArrayList<SocketChannel>();
        var provider = new SelectorProvider() {
            @Override
            public DatagramChannel openDatagramChannel() throws IOException {
                return system.openDatagramChannel();
            }

            @Override
            public DatagramChannel openDatagramChannel(ProtocolFamily family) throws IOException {
                return system.openDatagramChannel(family);
            }

            @Override
            public Pipe openPipe() throws IOException {
                return system.openPipe();
            }

            @Override
            public AbstractSelector openSelector() throws IOException {
                throw new IOException("Too many open files");
            }

            @Override
            public ServerSocketChannel openServerSocketChannel() throws IOException {
                return system.openServerSocketChannel();
            }

            @Override
            public SocketChannel openSocketChannel() throws IOException {
                opened.add(system.openSocketChannel());
                return opened.getLast();
            }
        };
        assertThatThrownBy(() -> new RemoteSocket(provider)).hasMessage("Too many open files");
        assertThat(opened).hasSize(1).noneMatch(SocketChannel::isOpen);
    }
}
