package io.troupe.player.wire;

import static io.troupe.player.wire.Interfaces.POSITION2D;
import static io.troupe.player.wire.Interfaces.RANGER;
import static io.troupe.player.wire.Interfaces.SONAR;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Clock;
import io.troupe.actor.ManualClock;
import io.troupe.player.PlayerPorts;
import java.io.IOException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.nio.ByteBuffer;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.List;
import java.util.Queue;
import java.util.Random;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.Semaphore;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.logging.Handler;
import java.util.logging.Level;
import java.util.logging.LogRecord;
import java.util.logging.Logger;
import java.util.logging.StreamHandler;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.parallel.Isolated;

/**
 * A server whose clients send garbage, send nothing, do not read or vanish, which affects no other client; the limits
 * that it sets them; and its behaviour when the machine runs out of resources.
 */
@Timeout(120)
@Isolated("reads the log")
class TcpServerTest {
    private static final int EACH = 10;
    private static final Duration LONG = Duration.ofDays(1);

    private final ManualClock clock = new ManualClock();
    /** The server's log; an error of the server itself is a WARNING. */
    private final Queue<LogRecord> log = new ConcurrentLinkedQueue<>();

    private final Logger logger = Logger.getLogger("io.troupe.player.wire");
    private final Handler handler = new StreamHandler() {
        @Override
        public void publish(LogRecord entry) {
            log.add(entry);
        }
    };

    @BeforeEach
    void listen() {
        logger.addHandler(handler);
        logger.setUseParentHandlers(false);
    }

    @AfterEach
    void noFurtherErrorOfTheServer() {
        logger.removeHandler(handler);
        logger.setUseParentHandlers(true);
        assertThat(warnings()).isEmpty();
    }

    /** The warnings since the last call. */
    private List<String> warnings() {
        var warnings = log.stream()
                .filter(each -> each.getLevel().intValue() >= Level.WARNING.intValue())
                .toList();
        log.removeAll(warnings);
        return warnings.stream().map(LogRecord::getMessage).toList();
    }

    private static TcpServer.Settings settings(int maxClients) {
        return new TcpServer.Settings(maxClients, LONG, LONG);
    }

    // ---- hostile clients

    private static byte[] random(Random random, int size) {
        var bytes = new byte[size];
        random.nextBytes(bytes);
        return bytes;
    }

    private static void vanish(RawClient client) throws IOException {
        client.socket.setSoLinger(true, 0); // a reset instead of an orderly close
        client.close();
    }

    /** One kind of misbehaviour after the other; the connection must end or stay open as listed. */
    private static void misbehave(RawClient client, int kind, Random random) throws IOException {
        byte[] huge = RawClient.request(1, 0, Content.empty(1));
        huge[36] = (byte) 0x80;
        switch (kind) {
            case 0 -> {} // sends nothing at all
            case 1 -> client.send(random(random, 400)).awaitEnd();
            case 2 -> client.send(huge).awaitEnd();
            case 3 -> client.send(new byte[17]); // half a header
            case 4 -> client.subscribe(SONAR); // and never reads
            case 5 -> {
                client.subscribe(POSITION2D);
                vanish(client);
            }
            case 6 -> vanish(client);
            case 7 -> client.send(random(random, 39)).close();
            default -> throw new AssertionError(kind);
        }
    }

    @Test
    void hostileClients_besideAGoodOne_doNotDisturbIt() throws Exception {
        var random = new Random(1);
        try (var served = Served.open()) {
            var good = served.client();
            good.subscribe(POSITION2D);
            for (int client = 0; client < 8 * EACH; client++) {
                misbehave(served.client(), client / EACH, random);
                served.tick(1);
                good.nextPosition();
            }
            good.drive(0.5, 0).sync();
            double last = 0;
            for (int tick = 0; tick < 100; tick++) {
                served.tick(1);
                last = good.nextPosition().px();
            }
            assertThat(last).isGreaterThan(2);
        }
    }

    @Test
    void clientThatAsksAndNeverReads_isDisconnectedAfterTheLimit_andOthersGoOn() throws Exception {
        var writesOnly = new TcpServer.Settings(10, Duration.ofSeconds(30), Duration.ofDays(100_000));
        try (var served = Served.open(writesOnly, clock)) {
            var greedy = served.client();
            byte[] request = RawClient.request(5, 0, Content.empty(1));
            var ten = ByteBuffer.allocate(10 * request.length);
            while (ten.hasRemaining()) {
                ten.put(request);
            }
            Thread flood = Thread.ofVirtual().start(() -> {
                try {
                    while (true) {
                        greedy.socket.getOutputStream().write(ten.array());
                    }
                } catch (IOException end) {
                    // as required
                }
            });
            served.server.checkLimits();
            assertThat(served.server.clients()).as("before the limit").isEqualTo(1);
            while (served.server.clients() > 0) {
                clock.advance(Duration.ofSeconds(31));
                served.server.checkLimits();
                Thread.onSpinWait();
            }
            assertThat(log)
                    .extracting(LogRecord::getMessage)
                    .anyMatch(text -> text.contains("a write has not got through within PT30S"));
            flood.join();
            served.client().sync();
        }
    }

    @Test
    void randomMessages_neverBreakTheServer() throws Exception {
        var random = new Random(7);
        try (var served = Served.open()) {
            for (int connection = 0; connection < 200; connection++) {
                try (var client = RawClient.greeted(served.port())) {
                    for (int i = 0; i < 50; i++) {
                        client.send(noise(random));
                    }
                    client.socket.shutdownOutput();
                    client.awaitEnd();
                } catch (IOException ended) {
                    // closed by the server, in the middle of the noise
                }
            }
            var good = served.client();
            good.sync();
            good.subscribe(POSITION2D);
        }
    }

    /** Mostly a message with a valid header. */
    private static byte[] noise(Random random) {
        int[] codes = {1, 4, 5, 7, 31, 62};
        byte[] payload = random(random, 4 * random.nextInt(12));
        for (int i = 0; i < payload.length; i++) {
            if (random.nextInt(4) > 0) {
                payload[i] = (byte) (i % 4 == 3 ? random.nextInt(6) : 0);
            }
        }
        int subtype = random.nextInt(12);
        int code = codes[random.nextInt(codes.length)];
        MessageType type = random.nextInt(10) == 0 ? MessageType.CMD : MessageType.REQ;
        byte[] message = RawClient.message(type, code, random.nextInt(2), new Content(subtype, payload));
        if (random.nextInt(100) == 0) {
            message[random.nextInt(40)] ^= (byte) (1 << random.nextInt(8));
        }
        return message;
    }

    @Test
    void dataThatCannotBeSent_endTheirClient_notTheThreadThatPublishes() throws Exception {
        var ranger = new ScriptedServer(RANGER);
        try (var server = TcpServer.open(ranger, 0);
                var client = RawClient.greeted(server.port())) {
            client.ask(new PlayerRequest.DataMode(Delivery.PULL));
            client.subscribe(RANGER);
            ranger.publish(0, null);
            client.awaitEnd();
            assertThat(server.clients()).isZero();
        } catch (NullPointerException e) {
            throw new AssertionError("thrown to the thread that publishes", e);
        }
        assertThat(warnings()).singleElement().asString().contains("its data could not be sent");
    }

    // ---- many clients, closing, opening

    @Test
    void twoHundredClients_areAllServed() throws Exception {
        var clients = new ArrayList<RawClient>();
        try (var served = Served.open()) {
            for (int i = 0; i < 200; i++) {
                clients.add(served.client());
            }
            for (var client : clients) {
                client.subscribe(POSITION2D);
            }
            served.tick(5);
            for (var client : clients) {
                for (int tick = 0; tick < 5; tick++) {
                    client.nextPosition();
                }
            }
            assertThat(served.server.clients()).isEqualTo(200);
            served.server.close();
            clients.forEach(RawClient::awaitEnd);
            assertThat(served.server.clients()).isZero();
            assertThat(served.simulation.hasSubscribers()).isFalse();
        }
    }

    private static void refused(Served served, int times) throws IOException {
        for (int i = 0; i < times; i++) {
            var late = served.connect();
            late.awaitEnd();
            assertThat(late.received()).as("no greeting").isEmpty();
        }
    }

    @Test
    void closedServer_freesItsPort_andTheWorldGoesOn_whileAClosedWorldDisconnectsItsClients() throws Exception {
        try (var served = Served.open()) {
            int port = served.port();
            served.server.close();
            try (var again = TcpServer.open(PlayerPorts.find(Served.PORT).orElseThrow(), port)) {
                assertThat(again.port()).isEqualTo(port);
                var client = served.client();
                client.subscribe(POSITION2D);
                served.simulation.close();
                client.awaitEnd();
                refused(served, 1);
            }
        }
    }

    @Test
    void addressOthersCanReach_isWarnedOf() throws Exception {
        var anywhere = InetAddress.getByAddress(new byte[4]);
        try (var served = Served.open();
                var open = TcpServer.open(PlayerPorts.find(Served.PORT).orElseThrow(), 0, anywhere);
                var client = RawClient.greeted(open.port())) {
            client.sync();
            assertThat(open.port()).isNotEqualTo(served.port());
        }
        assertThat(warnings()).singleElement().asString().contains("no authentication");
    }

    // ---- limits

    /** The readers of clients that send without a pause once occupied every carrier of virtual threads. */
    @Test
    void client_isServed_whileNoVirtualThreadCanRun() throws Throwable {
        Served.whileNoCarrierIsFree(() -> {
            try (var served = Served.open()) {
                var client = served.client();
                client.subscribe(POSITION2D);
                served.tick(2);
                client.nextPosition();
                client.nextPosition();
                client.drive(0.5, 0).sync();
                served.tick(2);
                client.nextPosition();
                assertThat(client.nextPosition().px()).isPositive();
            }
        });
    }

    @Test
    void messages_areHandledAtOnce_onlyAsManyAsThereArePermits() throws Exception {
        var handled = new AtomicInteger();
        var atOnce = new AtomicInteger();
        var mostAtOnce = new AtomicInteger();
        var goOn = new CountDownLatch(1);
        var devices = new ScriptedServer(RANGER);
        devices.replier = request -> {
            mostAtOnce.accumulateAndGet(atOnce.incrementAndGet(), Math::max);
            try {
                goOn.await();
            } catch (InterruptedException e) {
                throw new AssertionError(e);
            }
            atOnce.decrementAndGet();
            handled.incrementAndGet();
            return new DeviceReply.Ack();
        };
        var permits = new Semaphore(2, true);
        var shared = new TcpServer.Shared(settings(10), Clock.system(), permits);
        var clients = new ArrayList<RawClient>();
        try (var server = TcpServer.open(devices, 0, InetAddress.getLoopbackAddress(), shared)) {
            for (int i = 0; i < 6; i++) {
                clients.add(RawClient.greeted(server.port()).send(RawClient.request(62, 0, Content.empty(1))));
            }
            while (mostAtOnce.get() < 2 || permits.getQueueLength() < 4 && mostAtOnce.get() == 2) {
                Thread.onSpinWait();
            }
            assertThat(mostAtOnce).hasValue(2);
            goOn.countDown();
            for (var client : clients) {
                client.next();
            }
            assertThat(handled).hasValue(6);
            assertThat(mostAtOnce).hasValue(2);
        } finally {
            goOn.countDown();
            clients.forEach(RawClient::close);
        }
    }

    @Test
    void clientsBeyondTheLimit_areDisconnectedAtOnce_andLoggedOnceInASecond() throws Exception {
        try (var served = Served.open(settings(2), clock)) {
            var first = served.client();
            var second = served.client();
            refused(served, 10);
            assertThat(warnings()).singleElement().asString().endsWith(": 2 clients are connected, which is the limit");
            clock.advance(Duration.ofSeconds(1));
            refused(served, 1);
            assertThat(warnings()).singleElement().asString().endsWith("(and 9 times before)");

            second.sync();
            first.socket.shutdownOutput();
            while (served.server.clients() == 2) {
                Thread.onSpinWait();
            }
            served.client().sync();
        }
    }

    @Test
    void clientThatNeverSaysAnything_isDisconnectedAfterTheLimit() throws Exception {
        try (var served = Served.open(new TcpServer.Settings(10, LONG, Duration.ofSeconds(60)), clock)) {
            var talker = served.client();
            var silent = served.client();
            var halfSaid = served.client().send(new byte[17]);
            talker.sync();
            clock.advance(Duration.ofSeconds(60));
            served.server.checkLimits();
            assertThat(served.server.clients()).isEqualTo(3);
            clock.advance(Duration.ofNanos(1));
            served.server.checkLimits();
            silent.awaitEnd();
            halfSaid.awaitEnd();
            assertThat(served.server.clients()).isEqualTo(1);
            talker.sync();
        }
    }

    @Test
    void settings_areChecked_andFollowTheMachine() {
        assertThat(TcpServer.Settings.maxClients(120, 1)).isEqualTo(60);
        assertThat(TcpServer.Settings.maxClients(120, 4)).isEqualTo(15);
        assertThat(TcpServer.Settings.maxClients(-3, 1)).isEqualTo(1);
        assertThat(TcpServer.Settings.maxClients(Long.MAX_VALUE, 2)).isEqualTo(1_000);
        var machine = TcpServer.Settings.ofMachine(1);
        assertThat(machine.withMaxClients(7).maxClients()).isEqualTo(7);
        assertThatThrownBy(() -> machine.withMaxClients(0)).hasMessage("maxClients is 0, expected at least 1");
        assertThatThrownBy(() -> new TcpServer.Settings(1, Duration.ZERO, LONG))
                .hasMessage("writeLimit is PT0S, expected more than nothing");
    }

    // ---- when accepting or serving fails

    @Test
    void acceptor_survives_whateverAcceptThrows() throws Exception {
        var failures = new ArrayDeque<Throwable>(List.of(
                new IOException("Too many open files"),
                new NoClassDefFoundError("of a class that could not be read"),
                new IllegalStateException("of some other kind"),
                new OutOfMemoryError("unable to create native thread")));
        var socket = new ServerSocket(0, 10, InetAddress.getLoopbackAddress()) {
            @Override
            public Socket accept() throws IOException {
                switch (failures.poll()) {
                    case IOException e -> throw e;
                    case RuntimeException e -> throw e;
                    case Error e -> throw e;
                    case null, default -> {
                        return super.accept();
                    }
                }
            }
        };
        var shared = new TcpServer.Shared(settings(10), clock);
        try (var server = TcpServer.serve(new ScriptedServer(RANGER), socket, shared);
                var client = RawClient.greeted(server.port())) {
            client.sync();
            assertThat(failures).isEmpty();
            assertThat(warnings()).as("those of one second").hasSize(1);
        }
    }

    @Test
    void clientThatCannotBeServed_isDisconnected_andTheNextOneIsServed() throws Exception {
        var connections = new AtomicInteger();
        var failing = new ScriptedServer(RANGER) {
            @Override
            public PlayerConnection connect(DataSink sink, @Nullable ActorSpace space) {
                if (connections.incrementAndGet() == 1) {
                    throw new OutOfMemoryError("unable to create native thread");
                }
                return super.connect(sink, space);
            }
        };
        try (var server = TcpServer.open(failing, 0);
                var first = new RawClient(server.port())) {
            first.awaitEnd();
            try (var second = RawClient.greeted(server.port())) {
                second.sync();
                assertThat(server.clients()).isEqualTo(1);
            }
        }
        assertThat(warnings()).hasSize(1);
    }
}
