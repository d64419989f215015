package io.troupe.player.wire;

import static io.troupe.player.wire.Interfaces.POSITION2D;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ManualClock;
import java.io.IOException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.Callable;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.FutureTask;
import java.util.logging.Logger;
import java.util.logging.SimpleFormatter;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.parallel.Isolated;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Speeds that arrive late, on a clock that the test moves for both sides. */
@Timeout(300)
@Isolated("reads the log")
class LateCommandsTest {
    private static final DeviceAddress WHEELS = new DeviceAddress(0, ScriptedServer.PORT, POSITION2D.code(), 0);
    private static final double SENDERS_CLOCK_SECONDS = 4_000;

    private final ManualClock clock = new ManualClock();
    private final TcpServer.Shared shared = new TcpServer.Shared(TcpServer.Settings.ofMachine(1), clock);

    // ---- one handler, messages made by hand

    private final List<DeviceCommand> expected = new ArrayList<>();
    private boolean lockStep;
    private final ScriptedServer devices = new ScriptedServer(POSITION2D) {
        @Override
        public boolean isWaitedFor() {
            return lockStep;
        }
    };
    private final ClientMessageHandler handler =
            new ClientMessageHandler("client", devices, new Outbox(), 1, 2, shared);

    private void receive(MessageType type, Content content, int transitMillis) {
        clock.advance(Duration.ofSeconds(5));
        double sentSeconds = SENDERS_CLOCK_SECONDS + clock.nanos() / 1e9 - transitMillis / 1e3;
        handler.handle(WireMessage.of(WHEELS, type, content.subtype(), sentSeconds, content.payload()));
    }

    private void limit(String key, int millis) {
        var request = new DeviceRequest.SetIntegerProperty(key, millis);
        devices.reply(request, new DeviceReply.Ack());
        receive(MessageType.REQ, RequestCodec.encode(POSITION2D.code(), request), 0);
    }

    private void receive(DeviceCommand command, int transitMillis, boolean isObeyed) {
        receive(MessageType.CMD, CommandCodec.encode(command), transitMillis);
        if (isObeyed) {
            expected.add(command);
        }
        assertThat(devices.commands).isEqualTo(expected);
    }

    private static DeviceCommand speed(double forwardMps) {
        return new DeviceCommand.Velocity(forwardMps, 0, 0, true);
    }

    @Test
    void speedsAboveTheLimit_areDroppedAndCounted_andGoalsAreNot() {
        limit(DeviceRequest.COMMAND_AGE_KEY, 300);
        receive(speed(0.1), 299, true);
        receive(speed(0.2), 301, false);
        receive(new DeviceCommand.Car(0.2, 0), 2_000, false);
        receive(new DeviceCommand.VelocityHeading(0.2, 0), 60_000, false);
        receive(new DeviceCommand.GoTo(1, 0, 0, 0, 0, 0, true), 60_000, true);
        receive(speed(0.3), 0, true);
        assertThat(shared.lateCommands()).hasValue(3);
        limit(DeviceRequest.COMMAND_AGE_KEY, 0);
        receive(speed(0.4), 60_000, true);
    }

    @ParameterizedTest
    @ValueSource(ints = {0, 301, 2_000, 60_000})
    void clientThatAsksForNothing_orOnlyThatSpeedsExpire_hasThemObeyedWhenTheyArrive(int transitMillis) {
        receive(speed(0.1), 0, true);
        receive(speed(0.2), transitMillis, true);
        limit(DeviceRequest.COMMAND_LIMIT_KEY, 400);
        receive(speed(0.3), transitMillis, true);
        assertThat(shared.lateCommands()).hasValue(0);
    }

    @Test
    void worldThatWaitsForTheClient_dropsNothing() {
        limit(DeviceRequest.COMMAND_AGE_KEY, 300);
        lockStep = true;
        receive(speed(0.1), 60_000, true);
        lockStep = false;
        receive(speed(0.2), 60_000, false);
    }

    @Test
    void lateSpeeds_areLoggedOnceForEachTimeThatTheConnectionIsLate() {
        List<String> said = new CopyOnWriteArrayList<>();
        var log = Logger.getLogger(ClientMessageHandler.class.getName());
        log.setFilter(entry -> said.add(entry.getLevel() + " " + new SimpleFormatter().formatMessage(entry)));
        try {
            limit(DeviceRequest.COMMAND_AGE_KEY, 300);
            receive(speed(0.1), 1_840, false);
            receive(speed(0.2), 1_740, false);
            receive(speed(0.3), 0, true);
            receive(speed(0.3), 0, true);
            var unstamped = CommandCodec.encode(speed(0.4));
            handler.handle(WireMessage.of(WHEELS, MessageType.CMD, unstamped.subtype(), 0, unstamped.payload()));
        } finally {
            log.setFilter(null);
        }
        assertThat(said)
                .containsExactly(
                        "WARNING client sent position2d:0 a speed that arrives 1840 ms late; speeds are dropped that"
                                + " are more than 300 ms late",
                        "INFO client is in time again; 2 late speeds were dropped",
                        "WARNING client sent position2d:0 a speed without a time stamp; speeds are dropped that are"
                                + " more than 300 ms late");
    }

    // ---- client and server

    /** Eight bytes of the header, from the 24th on, are the seconds since one second before the connection. */
    @Test
    void ourClient_stampsEveryMessageWithAMonotonicTime() throws Exception {
        try (var server = new ScriptedSocket();
                var connection = server(server.port()).connect(SINK, null)) {
            clock.advance(Duration.ofMillis(250));
            connection.command(WHEELS, speed(0.1));
            assertThat(server.received.getFirst().header().timeSeconds()).isEqualTo(1);
            byte[] sent = server.nextCommand().bytes();
            assertThat(sent)
                    .startsWith(
                            new byte[] {0, 0, 0, 0, 0, 0, 0x1a, 0x5e, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 1})
                    .containsSequence(0x3f, 0xf4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 28);
        }
    }

    private static final DataSink SINK = new DataSink() {
        @Override
        public void frame(Frame frame) {}

        @Override
        public void lost(String reason) {}
    };

    private RemoteServer server(int port) {
        return new RemoteServer("localhost", port, Duration.ofMinutes(5), clock);
    }

    /** Forwards one connection; while it is held, what the client sends waits. */
    private static final class Cable implements AutoCloseable {
        private final ServerSocket listener = new ServerSocket(0, 1, InetAddress.getLoopbackAddress());
        private final List<Socket> ends = new CopyOnWriteArrayList<>();
        private boolean held; // guarded by this

        Cable(int serverPort) throws IOException {
            start(() -> {
                var client = listener.accept();
                var server = new Socket(InetAddress.getLoopbackAddress(), serverPort);
                ends.addAll(List.of(client, server));
                server.setTcpNoDelay(true);
                start(() -> server.getInputStream().transferTo(client.getOutputStream()));
                var bytes = new byte[8192];
                for (int count = 0; count >= 0; count = client.getInputStream().read(bytes)) {
                    awaitFree();
                    server.getOutputStream().write(bytes, 0, count);
                }
                return true;
            });
        }

        /** The test ends the task by closing its sockets. */
        private static void start(Callable<?> task) {
            Thread.ofPlatform().daemon().start(new FutureTask<>(task));
        }

        private synchronized void awaitFree() throws InterruptedException {
            while (held) {
                wait();
            }
        }

        synchronized void hold(boolean whether) {
            held = whether;
            notifyAll();
        }

        @Override
        public void close() throws IOException {
            hold(false);
            listener.close();
            for (var end : ends) {
                end.close();
            }
        }
    }

    /** The robot's world runs on the same clock, a tick each 100 ms. */
    private double speedAfterTick(Served served) {
        clock.advance(Duration.ofMillis(100));
        return served.simulation.tick().robots().getFirst().odometry().forwardMps();
    }

    @Test
    void speedsHeldBackForTwoSeconds_moveNoRobot_andTheNextOneDoes() throws Exception {
        try (var served = Served.open(TcpServer.Settings.ofMachine(1), clock);
                var cable = new Cable(served.port())) {
            served.simulation.lockStep(false);
            var connection = server(cable.listener.getLocalPort()).connect(SINK, null);
            var wheels = connection.devices().stream()
                    .filter(device -> device.interfaceCode() == POSITION2D.code())
                    .findFirst()
                    .orElseThrow();
            connection.subscribe(wheels);
            connection.request(wheels, new DeviceRequest.SetIntegerProperty(DeviceRequest.COMMAND_LIMIT_KEY, 400));
            connection.request(wheels, new DeviceRequest.SetIntegerProperty(DeviceRequest.COMMAND_AGE_KEY, 300));
            connection.command(wheels, speed(0.1));
            connection.request(wheels, new DeviceRequest.Geometry()); // everything before it has been handled
            assertThat(speedAfterTick(served)).isEqualTo(0.1);

            cable.hold(true);
            for (int i = 1; i <= 20; i++) {
                connection.command(wheels, speed(0.2 + i / 1e3));
                assertThat(speedAfterTick(served)).isEqualTo(i < 4 ? 0.1 : 0);
            }
            clock.advance(Duration.ofMillis(50)); // the newest two are 150 and 250 ms old
            cable.hold(false);
            connection.request(wheels, new DeviceRequest.Geometry());
            assertThat(served.server.lateCommands()).isEqualTo(18);
            assertThat(speedAfterTick(served)).isEqualTo(0.22);

            cable.hold(true);
            for (int i = 1; i <= 20; i++) {
                connection.command(wheels, speed(0.3));
                assertThat(speedAfterTick(served)).isEqualTo(i < 4 ? 0.22 : 0);
            }
            clock.advance(Duration.ofMillis(250));
            cable.hold(false);
            connection.request(wheels, new DeviceRequest.Geometry());
            assertThat(served.server.lateCommands()).isEqualTo(38);
            assertThat(speedAfterTick(served)).isZero();

            connection.command(wheels, speed(0.1));
            connection.request(wheels, new DeviceRequest.Geometry());
            assertThat(speedAfterTick(served)).isEqualTo(0.1);
            connection.close();
        }
    }

    @Test
    void worldInLockStep_obeysWhatWasHeldBack() throws Exception {
        try (var served = Served.open(TcpServer.Settings.ofMachine(1), clock);
                var cable = new Cable(served.port())) {
            var connection = server(cable.listener.getLocalPort()).connect(SINK, null);
            var wheels = connection.devices().stream()
                    .filter(device -> device.interfaceCode() == POSITION2D.code())
                    .findFirst()
                    .orElseThrow();
            connection.delivery(Delivery.PULL);
            connection.subscribe(wheels);
            connection.request(wheels, new DeviceRequest.SetIntegerProperty(DeviceRequest.COMMAND_AGE_KEY, 300));
            cable.hold(true);
            connection.command(wheels, speed(0.1));
            clock.advance(Duration.ofSeconds(60));
            cable.hold(false);
            connection.request(wheels, new DeviceRequest.Geometry());
            connection.close(); // and the tick does not wait for it
            assertThat(served.server.lateCommands()).isZero();
        }
    }
}
