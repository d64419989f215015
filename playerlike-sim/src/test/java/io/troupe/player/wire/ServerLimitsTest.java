package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.time.Clock;
import io.troupe.actor.time.ManualClock;
import java.io.IOException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.Semaphore;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.logging.Handler;
import java.util.logging.LogRecord;
import java.util.logging.Logger;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Limits that a server sets its clients, and its behaviour when the machine runs out of resources. */
@Timeout(60)
class ServerLimitsTest {
    private static final Duration LONG = Duration.ofDays(1);

    private final Queue<String> warnings = new ConcurrentLinkedQueue<>();
    private final Logger logger = Logger.getLogger("io.troupe.player.wire");
    private final Handler handler = new Handler() {
        @Override
        public void publish(LogRecord record) {
            if (record.getLevel().intValue() >= java.util.logging.Level.WARNING.intValue()) {
                warnings.add(record.getMessage());
            }
        }

        @Override
        public void flush() {}

        @Override
        public void close() {}
    };

    @BeforeEach
    void listen() {
        logger.addHandler(handler);
        logger.setUseParentHandlers(false);
    }

    @AfterEach
    void listenNoMore() {
        logger.removeHandler(handler);
        logger.setUseParentHandlers(true);
    }

    private static TcpServer.Shared shared(int maxClients, Clock clock) {
        return new TcpServer.Shared(new TcpServer.Settings(maxClients, LONG, LONG), clock);
    }

    // ---- clients that send without a pause

    /**
     * Threads that never block occupy every carrier of virtual threads, as the readers of clients that send without a
     * pause once did.
     */
    @Test
    void client_isServed_whileNoVirtualThreadCanRun() throws Exception {
        int carriers = Integer.getInteger(
                "jdk.virtualThreadScheduler.parallelism", Runtime.getRuntime().availableProcessors());
        var stop = new AtomicBoolean();
        var spinning = new CountDownLatch(carriers);
        var spinners = new ArrayList<Thread>();
        for (int i = 0; i < carriers; i++) {
            spinners.add(Thread.ofVirtual().start(() -> {
                spinning.countDown();
                while (!stop.get()) {
                    Thread.onSpinWait();
                }
            }));
        }
        spinning.await();
        try (var served = Served.open();
                var client = RawClient.greeted(served.port())) {
            client.subscribe(Interfaces.POSITION2D);
            served.tick(2);
            client.nextPosition();
            client.nextPosition();
            client.drive(0.5, 0).ask(new PlayerRequest.DeviceList());
            served.tick(2);
            client.nextPosition();
            assertThat(client.nextPosition().px()).isPositive();
        } finally {
            stop.set(true);
        }
        for (var each : spinners) {
            each.join();
        }
    }

    /** A ranger whose replies the test holds back. */
    private static final class SlowReplies implements PlayerServer {
        final AtomicInteger handled = new AtomicInteger();
        final AtomicInteger mostAtOnce = new AtomicInteger();
        final CountDownLatch goOn = new CountDownLatch(1);
        private final AtomicInteger atOnce = new AtomicInteger();

        @Override
        public String banner() {
            return "Player v.3.1.1-dev";
        }

        @Override
        public PlayerConnection connect(DataSink sink, @Nullable ActorSpace space) {
            return new ScriptedRanger(Map.of()) {
                @Override
                public DeviceReply request(DeviceAddress device, DeviceRequest request) {
                    mostAtOnce.accumulateAndGet(atOnce.incrementAndGet(), Math::max);
                    try {
                        goOn.await();
                    } catch (InterruptedException e) {
                        throw new AssertionError(e);
                    }
                    atOnce.decrementAndGet();
                    handled.incrementAndGet();
                    return new DeviceReply.Ack();
                }
            };
        }
    }

    @Test
    void messages_areHandledAtOnce_onlyAsManyAsThereArePermits() {
        var devices = new SlowReplies();
        var permits = new Semaphore(2, true);
        var shared = new TcpServer.Shared(new TcpServer.Settings(10, LONG, LONG), Clock.system(), permits);
        var clients = new ArrayList<RawClient>();
        try (var server = TcpServer.open(devices, 0, InetAddress.getLoopbackAddress(), shared)) {
            byte[] request = RawClient.message(MessageType.REQ, 62, 0, Content.empty(1));
            for (int i = 0; i < 6; i++) {
                clients.add(RawClient.greeted(server.port()).send(request));
            }
            while (devices.mostAtOnce.get() < 2 || permits.getQueueLength() < 4 && devices.mostAtOnce.get() == 2) {
                Thread.onSpinWait();
            }
            assertThat(devices.mostAtOnce).hasValue(2);
            devices.goOn.countDown();
            clients.forEach(RawClient::next);
            assertThat(devices.handled).hasValue(6);
            assertThat(devices.mostAtOnce).hasValue(2);
        } finally {
            devices.goOn.countDown();
            clients.forEach(RawClient::close);
        }
    }

    @Test
    void dataThatCannotBeSent_endTheirClient_notTheThreadThatPublishes() {
        var ranger = new ScriptedRanger(Map.of());
        try (var server = TcpServer.open(ranger, 0);
                var client = RawClient.greeted(server.port())) {
            client.ask(new PlayerRequest.DataMode(Delivery.PULL));
            client.subscribe(Interfaces.RANGER);
            ranger.publish(0, null);
            client.awaitEnd();
            assertThat(server.clients()).isZero();
        } catch (NullPointerException e) {
            throw new AssertionError("thrown to the thread that publishes", e);
        }
        assertThat(warnings).hasSize(1).allMatch(text -> text.contains("its data could not be sent"));
    }

    // ---- how many there may be

    @Test
    void clientsBeyondTheLimit_areDisconnectedAtOnce_andLoggedOnceInASecond() throws IOException {
        var clock = new ManualClock();
        try (var served = Served.open(0, shared(2, clock));
                var first = RawClient.greeted(served.port());
                var second = RawClient.greeted(served.port())) {
            refused(served, 10);
            assertThat(warnings)
                    .hasSize(1)
                    .allMatch(text -> text.endsWith(": 2 clients are connected, which is the limit"));
            clock.advance(Duration.ofSeconds(1));
            refused(served, 1);
            assertThat(warnings).hasSize(2).anyMatch(text -> text.endsWith("(and 9 times before)"));

            second.ask(new PlayerRequest.DeviceList());
            first.socket.shutdownOutput();
            while (served.server.clients() == 2) {
                Thread.onSpinWait();
            }
            try (var third = RawClient.greeted(served.port())) {
                third.ask(new PlayerRequest.DeviceList());
            }
        }
    }

    private static void refused(Served served, int times) {
        for (int i = 0; i < times; i++) {
            try (var late = new RawClient(served.port())) {
                late.awaitEnd();
                assertThat(late.received()).as("no greeting").isEmpty();
            }
        }
    }

    @Test
    void clientThatNeverSaysAnything_isDisconnectedAfterTheLimit() {
        var clock = new ManualClock();
        var settings = new TcpServer.Settings(10, LONG, Duration.ofSeconds(60));
        try (var served = Served.open(0, new TcpServer.Shared(settings, clock));
                var talker = RawClient.greeted(served.port());
                var silent = RawClient.greeted(served.port());
                var halfSaid = RawClient.greeted(served.port())) {
            talker.ask(new PlayerRequest.DeviceList());
            halfSaid.send(new byte[17]);
            clock.advance(Duration.ofSeconds(60));
            served.server.checkLimits();
            assertThat(served.server.clients()).isEqualTo(3);
            clock.advance(Duration.ofNanos(1));
            served.server.checkLimits();
            silent.awaitEnd();
            halfSaid.awaitEnd();
            assertThat(served.server.clients()).isEqualTo(1);
            talker.ask(new PlayerRequest.DeviceList());
        }
    }

    @Test
    void settings_areChecked_andFollowTheMachine() {
        assertThat(TcpServer.Settings.maxClients(120, 1)).isEqualTo(60);
        assertThat(TcpServer.Settings.maxClients(120, 4)).isEqualTo(15);
        assertThat(TcpServer.Settings.maxClients(-3, 1)).isEqualTo(1);
        assertThat(TcpServer.Settings.maxClients(Long.MAX_VALUE, 2)).isEqualTo(1_000);
        assertThat(TcpServer.Settings.ofMachine(1).withMaxClients(7).maxClients())
                .isEqualTo(7);
        assertThatThrownBy(() -> TcpServer.Settings.ofMachine(1).withMaxClients(0))
                .hasMessage("maxClients is 0, expected at least 1");
        assertThatThrownBy(() -> new TcpServer.Settings(1, Duration.ZERO, LONG))
                .hasMessage("writeLimit is PT0S, expected more than nothing");
    }

    // ---- when accepting fails

    /** Fails in every way before it accepts. */
    private static final class FailingSocket extends ServerSocket {
        private final List<Throwable> failures;
        private int accepted;

        FailingSocket(Throwable... failures) throws IOException {
            super(0, 10, InetAddress.getLoopbackAddress());
            this.failures = List.of(failures);
        }

        @Override
        public Socket accept() throws IOException {
            if (accepted < failures.size()) {
                switch (failures.get(accepted++)) {
                    case IOException e -> throw e;
                    case RuntimeException e -> throw e;
                    case Error e -> throw e;
                    default -> throw new IllegalArgumentException("not thrown by accept");
                }
            }
            return super.accept();
        }
    }

    @Test
    void acceptor_survives_whateverAcceptThrows() throws IOException {
        var socket = new FailingSocket(
                new IOException("Too many open files"),
                new NoClassDefFoundError("of a class that could not be read"),
                new IllegalStateException("of some other kind"),
                new OutOfMemoryError("unable to create native thread"));
        try (var server = TcpServer.serve(new ScriptedRanger(Map.of()), socket, shared(10, new ManualClock()));
                var client = RawClient.greeted(server.port())) {
            client.ask(new PlayerRequest.DeviceList());
            assertThat(socket.accepted).isEqualTo(4);
            assertThat(warnings).as("those of one second").hasSize(1);
        }
    }

    @Test
    void clientThatCannotBeServed_isDisconnected_andTheNextOneIsServed() {
        var failures = new AtomicInteger();
        var devices = new SlowReplies();
        devices.goOn.countDown();
        PlayerServer failing = new PlayerServer() {
            @Override
            public String banner() {
                return devices.banner();
            }

            @Override
            public PlayerConnection connect(DataSink sink, @Nullable ActorSpace space) {
                if (failures.incrementAndGet() == 1) {
                    throw new OutOfMemoryError("unable to create native thread");
                }
                return devices.connect(sink, space);
            }
        };
        try (var server = TcpServer.open(failing, 0)) {
            try (var first = new RawClient(server.port())) {
                first.awaitEnd();
            }
            try (var second = RawClient.greeted(server.port())) {
                second.ask(new PlayerRequest.DeviceList());
                assertThat(server.clients()).isEqualTo(1);
            }
        }
    }
}
