package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.time.ManualClock;
import io.troupe.player.PlayerPorts;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.net.InetAddress;
import java.nio.ByteBuffer;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.logging.Handler;
import java.util.logging.Level;
import java.util.logging.LogRecord;
import java.util.logging.Logger;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Clients that send garbage, send nothing, do not read or vanish affect no other client. */
@Timeout(120)
class HostileClientsTest {
    private static final int EACH = 10;
    private static final TcpServer.Settings WRITES_ONLY =
            new TcpServer.Settings(10, Duration.ofSeconds(30), Duration.ofDays(100_000));

    /** Collects the server's log; an error of the server itself is a WARNING. */
    private static final class Log extends Handler {
        private final ConcurrentLinkedQueue<LogRecord> records = new ConcurrentLinkedQueue<>();

        @Override
        public void publish(LogRecord record) {
            records.add(record);
        }

        @Override
        public void flush() {}

        @Override
        public void close() {}
    }

    private final Log log = new Log();
    private final Logger logger = Logger.getLogger("io.troupe.player.wire");

    @BeforeEach
    void listen() {
        logger.addHandler(log);
        logger.setUseParentHandlers(false);
    }

    @AfterEach
    void noErrorOfTheServer() {
        logger.removeHandler(log);
        logger.setUseParentHandlers(true);
        assertThat(log.records)
                .filteredOn(each -> each.getLevel().intValue() >= Level.WARNING.intValue())
                .extracting(LogRecord::getMessage)
                .isEmpty();
    }

    private static byte[] random(Random random, int size) {
        var bytes = new byte[size];
        random.nextBytes(bytes);
        return bytes;
    }

    private static void vanish(RawClient client) {
        try {
            client.socket.setSoLinger(true, 0); // a reset instead of an orderly close
            client.close();
        } catch (IOException e) {
            throw new AssertionError(e);
        }
    }

    /** One kind of misbehaviour after the other; the connection must end or stay open as listed. */
    private static void misbehave(RawClient client, int kind, Random random) {
        byte[] huge = WireMessage.of(new DeviceAddress(0, 0, 1, 0), MessageType.REQ, 1, 0, Content.NONE)
                .bytes();
        huge[36] = (byte) 0x80;
        switch (kind) {
            case 0 -> {} // sends nothing at all
            case 1 -> client.send(random(random, 400)).awaitEnd();
            case 2 -> client.send(huge).awaitEnd();
            case 3 -> client.send(new byte[17]); // half a header
            case 4 -> client.subscribe(Interfaces.SONAR); // and never reads
            case 5 -> {
                client.subscribe(Interfaces.POSITION2D);
                vanish(client);
            }
            case 6 -> vanish(client);
            case 7 -> client.send(random(random, 39)).close();
            default -> throw new AssertionError(kind);
        }
    }

    @Test
    void hostileClients_besideAGoodOne_doNotDisturbIt() throws WireException {
        var random = new Random(1);
        var bad = new ArrayList<RawClient>();
        try (var served = Served.open();
                var good = RawClient.greeted(served.port())) {
            good.subscribe(Interfaces.POSITION2D);
            for (int kind = 0; kind < 8; kind++) {
                for (int i = 0; i < EACH; i++) {
                    RawClient client = RawClient.greeted(served.port());
                    bad.add(client);
                    misbehave(client, kind, random);
                    served.tick(1);
                    good.nextPosition();
                }
            }
            good.drive(0.5, 0).ask(new PlayerRequest.DeviceList());
            double last = 0;
            for (int tick = 0; tick < 100; tick++) {
                served.tick(1);
                last = good.nextPosition().px();
            }
            assertThat(last).isGreaterThan(2);
        } finally {
            bad.forEach(RawClient::close);
        }
    }

    @Test
    void clientThatAsksAndNeverReads_isDisconnectedAfterTheLimit_andOthersGoOn() {
        var clock = new ManualClock();
        try (var served = Served.open(0, new TcpServer.Shared(WRITES_ONLY, clock));
                var greedy = RawClient.greeted(served.port())) {
            byte[] requests = ten(RawClient.message(MessageType.REQ, 5, 0, Content.empty(1)));
            Thread flood = Thread.ofVirtual().start(() -> {
                try {
                    while (true) {
                        greedy.socket.getOutputStream().write(requests);
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
            assertThat(log.records)
                    .extracting(LogRecord::getMessage)
                    .anyMatch(text -> text.contains("a write has not got through within PT30S"));
            flood.join();
            try (var good = RawClient.greeted(served.port())) {
                good.ask(new PlayerRequest.DeviceList());
            }
        } catch (InterruptedException e) {
            throw new AssertionError(e);
        }
    }

    private static byte[] ten(byte[] message) {
        var all = ByteBuffer.allocate(10 * message.length);
        for (int i = 0; i < 10; i++) {
            all.put(message);
        }
        return all.array();
    }

    @Test
    void randomMessages_neverBreakTheServer() {
        var random = new Random(7);
        try (var served = Served.open()) {
            for (int connection = 0; connection < 200; connection++) {
                try (var client = RawClient.greeted(served.port())) {
                    for (int i = 0; i < 50; i++) {
                        client.send(noise(random));
                    }
                    client.socket.shutdownOutput();
                    client.awaitEnd();
                } catch (IOException | UncheckedIOException ended) {
                    // closed by the server, in the middle of the noise
                }
            }
            try (var good = RawClient.greeted(served.port())) {
                good.ask(new PlayerRequest.DeviceList());
                good.subscribe(Interfaces.POSITION2D);
            }
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
    void twoHundredClients_areAllServed() throws WireException {
        var clients = new ArrayList<RawClient>();
        try (var served = Served.open()) {
            for (int i = 0; i < 200; i++) {
                clients.add(RawClient.greeted(served.port()));
            }
            for (var client : clients) {
                client.subscribe(Interfaces.POSITION2D);
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
        } finally {
            clients.forEach(RawClient::close);
        }
    }

    @Test
    void closedWorld_disconnectsItsClients() {
        try (var served = Served.open();
                var client = RawClient.greeted(served.port())) {
            client.subscribe(Interfaces.POSITION2D);
            served.simulation.close();
            client.awaitEnd();
            try (var late = new RawClient(served.port())) {
                late.awaitEnd();
                assertThat(late.received()).as("no greeting").isEmpty();
            }
        }
    }

    @Test
    void closedServer_freesItsPort_andTheWorldGoesOn() {
        try (var served = Served.open()) {
            int port = served.port();
            served.server.close();
            try (var again = TcpServer.open(PlayerPorts.find(Served.PORT).orElseThrow(), port);
                    var client = RawClient.greeted(port)) {
                assertThat(again.port()).isEqualTo(port);
                client.ask(new PlayerRequest.DeviceList());
            }
        }
    }

    @Test
    void addressOthersCanReach_isWarnedOf() throws IOException {
        try (var served = Served.open();
                var open = TcpServer.open(
                        PlayerPorts.find(Served.PORT).orElseThrow(), 0, InetAddress.getByAddress(new byte[4]));
                var client = RawClient.greeted(open.port())) {
            client.ask(new PlayerRequest.DeviceList());
            assertThat(open.port()).isNotEqualTo(served.port());
        }
        List<LogRecord> warnings = log.records.stream()
                .filter(each -> each.getLevel() == Level.WARNING)
                .toList();
        assertThat(warnings).hasSize(1);
        assertThat(warnings.getFirst().getMessage()).contains("no authentication");
        log.records.removeAll(warnings);
    }
}
