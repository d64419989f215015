package io.troupe.player.wire;

import static io.troupe.player.wire.RemoteConnectionTest.is;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.catchThrowableOfType;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.time.Clock;
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
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.function.Consumer;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Messages that are not sent, or only in part, because the server does not read. */
@Tag("threads")
@Timeout(value = 60, threadMode = Timeout.ThreadMode.SEPARATE_THREAD)
class RemoteSendingTest {
    private static final DeviceAddress SIMULATION = new DeviceAddress(0, 0, Interfaces.SIMULATION.code(), 0);
    private static final Duration SHORT = Duration.ofMillis(50);
    private static final Duration LONG = Duration.ofMinutes(1);

    private final CountDownLatch readOn = new CountDownLatch(1);

    private static DataSink sink(Consumer<Frame> frames, Consumer<String> lost) {
        return new DataSink() {
            @Override
            public void frame(Frame frame) {
                frames.accept(frame);
            }

            @Override
            public void lost(String reason) {
                lost.accept(reason);
            }
        };
    }

    private void awaitReadOn() {
        try {
            readOn.await();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    private static PlayerConnection connect(ScriptedSocket server, DataSink sink) {
        return new RemoteServer("localhost", server.port()).connect(sink, null);
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
    void pull_questionForDataThatWasNotSent_isAskedAgain() throws Exception {
        var frame = new CompletableFuture<Frame>();
        try (var server = new ScriptedSocket((message, self) -> {
            if (is(message, 1, 10)) {
                awaitReadOn();
            }
            if (is(message, 1, 4)) {
                self.send(self.reply(message, MessageType.ACK, Content.NONE), self.position(1), self.synch());
                return true;
            }
            return false;
        })) {
            var connection = connect(server, sink(frame::complete, reason -> {}));
            connection.delivery(Delivery.PULL);
            connection.replyLimit(SHORT);
            assertThatThrownBy(() -> connection.replace(new ReplaceRule(-1, -1, 1, -1, ReplaceRule.IGNORE)))
                    .isInstanceOf(RequestFailedException.class);
            fill(connection);
            assertThatThrownBy(() -> connection.answered(PlayerConnection.NO_TICK))
                    .isInstanceOf(RequestFailedException.class);
            readOn.countDown();
            connection.replyLimit(LONG);
            connection.answered(PlayerConnection.NO_TICK);
            assertThat(frame.get(30, TimeUnit.SECONDS).timeSeconds()).isEqualTo(1);
            connection.close();
        } finally {
            readOn.countDown();
        }
    }

    @Test
    void pull_onAnActorSpace_questionForDataThatCannotBeSent_losesTheLine() throws Exception {
        var lost = new CompletableFuture<String>();
        var connection = new CompletableFuture<PlayerConnection>();
        try (var space = ActorSpace.create(SpaceSettings.named("asking"));
                var server = new ScriptedSocket((message, self) -> {
                    if (is(message, 1, 4)) {
                        self.send(self.reply(message, MessageType.ACK, Content.NONE), self.synch());
                        awaitReadOn();
                        return true;
                    }
                    return false;
                })) {
            var sink = sink(frame -> fill(connection.join()), lost::complete);
            connection.complete(new RemoteServer("localhost", server.port()).connect(sink, space));
            connection.join().delivery(Delivery.PULL);
            connection.join().replyLimit(SHORT);
            connection.join().answered(PlayerConnection.NO_TICK);
            assertThat(lost.get(30, TimeUnit.SECONDS))
                    .startsWith("data cannot be asked for: localhost:" + server.port() + " has not taken a message");
            readOn.countDown();
            connection.join().close();
        } finally {
            readOn.countDown();
        }
    }

    /** The server replies in order and without sequence numbers. */
    @Test
    void requestThatWasSentInPart_getsItsReply_andNoLaterRequestDoes() throws Exception {
        try (var server = new ScriptedSocket((message, self) -> {
            if (is(message, 1, 10)) {
                awaitReadOn();
            }
            if (!is(message, 31, 1)) {
                return false;
            }
            try {
                String model = ((DeviceRequest.GetPose)
                                RequestCodec.decode(SIMULATION.interfaceCode(), 1, message.payload()))
                        .model();
                var pose = new DeviceReply.ModelPose(model.substring(0, 1), 0, 0, 0);
                self.send(self.reply(message, MessageType.ACK, ReplyCodec.encode(pose)));
            } catch (WireException e) {
                throw new IOException(e);
            }
            return true;
        })) {
            var connection = connect(server, sink(frame -> {}, reason -> {}));
            connection.replyLimit(SHORT);
            assertThatThrownBy(() -> connection.replace(new ReplaceRule(-1, -1, 1, -1, ReplaceRule.IGNORE)))
                    .isInstanceOf(RequestFailedException.class);
            fill(connection);
            readOn.countDown();
            connection.replyLimit(LONG);
            assertThat(connection.request(SIMULATION, new DeviceRequest.GetPose("b")))
                    .isEqualTo(new DeviceReply.ModelPose("b", 0, 0, 0));
            connection.close();
        } finally {
            readOn.countDown();
        }
    }

    @Test
    void socket_saysHowMuchWasSent_andSendsTheRest() throws Exception {
        byte[] message = new byte[16 << 20]; // more than all buffers can hold
        try (var listener = new ServerSocket(0, 1, InetAddress.getLoopbackAddress());
                var socket = new RemoteSocket()) {
            socket.connect(new InetSocketAddress(listener.getInetAddress(), listener.getLocalPort()), LONG);
            try (var server = listener.accept()) {
                var inPart = catchThrowableOfType(
                        SocketTimeoutException.class,
                        () -> socket.send(message, Deadline.after(SHORT, Clock.system())));
                assertThat(inPart.bytesTransferred).isPositive().isLessThan(message.length);
                var nothing = catchThrowableOfType(
                        SocketTimeoutException.class,
                        () -> socket.send(message, Deadline.after(SHORT, Clock.system())));
                assertThat(nothing.bytesTransferred).isZero();
                var read = CompletableFuture.supplyAsync(() -> {
                    try {
                        return server.getInputStream().readNBytes(message.length).length;
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
    void questionForASignOfLife_isSent_whileNoCarrierOfVirtualThreadsIsFree() throws Exception {
        var asked = new CountDownLatch(2); // one from connecting, one for the keep-alive request
        var stop = new AtomicBoolean();
        try (var server = new ScriptedSocket((message, self) -> {
            if (is(message, 1, 1)) {
                asked.countDown();
            }
            return false;
        })) {
            var connection = (RemoteConnection) connect(server, sink(frame -> {}, reason -> {}));
            int carriers = Runtime.getRuntime().availableProcessors();
            var spinning = new CountDownLatch(carriers);
            var threads = new ArrayList<Thread>();
            for (int i = 0; i < carriers; i++) {
                threads.add(Thread.startVirtualThread(() -> {
                    spinning.countDown();
                    while (!stop.get()) {
                        Thread.onSpinWait();
                    }
                }));
            }
            try {
                spinning.await();
                connection.sendKeepAlive();
                assertThat(asked.await(20, TimeUnit.SECONDS)).isTrue();
            } finally {
                stop.set(true);
                for (var each : threads) {
                    each.join();
                }
            }
            connection.close();
        }
    }

    /** Each read of the clock advances it by an hour, so sending uses up the whole limit. */
    @Test
    void call_hasOneLimit_forSendingAndForWaiting() throws Exception {
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
        try (var server = new ScriptedSocket((message, self) -> is(message, 1, 10))) {
            var connection = new RemoteServer("localhost", server.port(), LONG, clock)
                    .connect(sink(frame -> {}, reason -> {}), null);
            slow.set(true);
            connection.replyLimit(Duration.ofMinutes(59));
            assertThatThrownBy(() -> connection.replace(new ReplaceRule(-1, -1, 1, -1, ReplaceRule.IGNORE)))
                    .isInstanceOf(RequestFailedException.class)
                    .hasMessageContaining("did not answer within 3540000 ms");
            connection.close();
        }
    }

    @Test
    void socketWithoutASelector_leavesNoChannelOpen() throws Exception {
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
