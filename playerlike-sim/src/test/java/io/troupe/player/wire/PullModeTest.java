package io.troupe.player.wire;

import static io.troupe.player.wire.Interfaces.POSITION2D;
import static io.troupe.player.wire.Interfaces.SONAR;
import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.util.ArrayDeque;
import java.util.Deque;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * Clients in pull mode that send other requests inside their loop, as programs with libplayerc do: for them the end of
 * a frame (SYNCH) counts only after data that were sent since their request for data.
 */
@Timeout(60)
class PullModeTest {
    private final Served served = Served.open();

    @AfterEach
    void close() {
        served.close();
    }

    /** The reading of libplayerc: what it does with a queue, with requests and with the end of a frame. */
    private static final class LibraryClient {
        private final RawClient raw;
        private final Deque<WireMessage> queue = new ArrayDeque<>(); // what came before the reply to a request
        private int reads;
        double timeSeconds = -1;

        LibraryClient(RawClient raw) throws IOException {
            this.raw = raw;
            request(new PlayerRequest.DataMode(Delivery.PULL));
        }

        void subscribe(Interfaces... types) throws IOException {
            for (var type : types) {
                request(RawClient.access(type, PlayerRequest.OPEN));
            }
        }

        /** Returns the time of the newest frame at the server. */
        double request(PlayerRequest request) throws IOException {
            raw.send(RawClient.bytes(request));
            int subtype = PlayerDeviceCodec.encode(request).subtype();
            WireMessage message = raw.next();
            for (; !isReply(message, subtype); message = raw.next()) {
                queue.add(message);
            }
            return message.header().timeSeconds();
        }

        private static boolean isReply(WireMessage message, int subtype) {
            return message.header().type() == MessageType.ACK
                    && message.header().subtype() == subtype;
        }

        /** Takes what is in the queue or else requests data and waits for the end of their frame. */
        void read() throws IOException {
            read(() -> {});
        }

        /** @param requested what happens after the request for data has been handled */
        void read(Runnable requested) throws IOException {
            reads++;
            if (!queue.isEmpty()) {
                for (var message : queue) {
                    assertThat(message.header().type()).as("read %d", reads).isEqualTo(MessageType.DATA);
                    data(message);
                }
                queue.clear();
                return;
            }
            request(new PlayerRequest.NextData());
            assertThat(queue)
                    .as("read %d: sent before the reply to the request for data", reads)
                    .isEmpty();
            requested.run();
            boolean received = false;
            for (var message = raw.next(); message.header().type() != MessageType.SYNCH; message = raw.next()) {
                data(message);
                received = true;
            }
            assertThat(received)
                    .as("read %d: data before the end of the frame", reads)
                    .isTrue();
        }

        private void data(WireMessage message) {
            assertThat(message.header().type()).isEqualTo(MessageType.DATA);
            timeSeconds = message.header().timeSeconds();
        }
    }

    private LibraryClient client() throws IOException {
        return new LibraryClient(served.client());
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 4})
    void freeRunning_requestsAfterANewFrame_areFollowedByDataOfTheNextFrame(int requests) throws Exception {
        served.simulation.lockStep(false);
        var client = client();
        client.subscribe(POSITION2D);
        for (int round = 0; round < 20; round++) {
            served.tick(1); // a frame waits when the request comes
            for (int i = 0; i < requests; i++) {
                client.request(new PlayerRequest.DeviceList());
            }
            client.read(); // what preceded the reply
            assertThat(client.timeSeconds).isEqualTo(2 * round / 10.0);
            client.read(() -> served.tick(1));
            assertThat(client.timeSeconds).isEqualTo((2 * round + 1) / 10.0);
        }
    }

    @Test
    void subscription_afterANewFrame_isFollowedByDataOfTheNextFrame() throws Exception {
        served.simulation.lockStep(false);
        var client = client();
        client.subscribe(POSITION2D);
        served.tick(1);
        client.subscribe(SONAR);
        client.read();
        client.read(() -> served.tick(1));
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 4})
    void lockStep_dataWaitForTheirRequest_andEachTickIsSeenOnce(int requests) throws Exception {
        served.tick(1);
        var client = client();
        client.subscribe(POSITION2D);
        for (int tick = 1; tick < 30; tick++) {
            served.tickApart();
        }
        while (client.request(new PlayerRequest.DeviceList()) < 0.1) {
            Thread.onSpinWait(); // the first frame is not there yet
        }
        client.subscribe(SONAR);
        for (int tick = 1; tick < 30; tick++) {
            assertThat(client.queue).as("sent before it was requested").isEmpty();
            client.read();
            assertThat(client.timeSeconds).isEqualTo(tick / 10.0);
            for (int i = 0; i < requests; i++) {
                client.request(new PlayerRequest.DeviceList());
            }
        }
    }

    @ParameterizedTest
    @ValueSource(booleans = {true, false})
    void rulesThatDropEverything_leaveNothing_andTheWorldDoesNotWait(boolean lockStep) throws Exception {
        served.simulation.lockStep(lockStep);
        var client = client();
        client.request(new PlayerRequest.AddRule(new ReplaceRule(-1, -1, 1, -1, ReplaceRule.IGNORE)));
        client.subscribe(POSITION2D);
        client.request(new PlayerRequest.NextData());
        served.tick(20); // in lock step this would wait for an answer
        client.request(new PlayerRequest.DeviceList());
        assertThat(client.queue).as("sent to it").isEmpty();
        client.request(new PlayerRequest.AddRule(new ReplaceRule(-1, -1, 1, -1, ReplaceRule.ACCEPT)));
        served.tickApart();
        assertThat(client.raw.next(MessageType.DATA, 4, 1).header().timeSeconds())
                .isEqualTo(2.0);
        client.raw.next(MessageType.SYNCH, 1, 1);
        client.request(new PlayerRequest.NextData()); // the answer to that tick
    }
}
