package io.troupe.player.wire;

import static io.troupe.player.wire.RemoteConnectionTest.connect;
import static io.troupe.player.wire.RemoteConnectionTest.is;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerException;
import io.troupe.player.PlayerPorts;
import io.troupe.player.structures.PlayerConstants;
import java.io.IOException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.locks.LockSupport;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** A client never waits longer than its limit, bounds what it keeps, and never takes a reply for another one. */
@Tag("threads")
@Timeout(value = 60, threadMode = Timeout.ThreadMode.SEPARATE_THREAD)
class RemoteLimitsTest implements PlayerConstants {
    private static final DeviceAddress SIMULATION = new DeviceAddress(0, 0, Interfaces.SIMULATION.code(), 0);

    private static class Sink implements DataSink {
        final ConcurrentLinkedQueue<Frame> frames = new ConcurrentLinkedQueue<>();

        @Override
        public void frame(Frame frame) {
            frames.add(frame);
        }

        @Override
        public void lost(String reason) {}
    }

    private static void awaitQuietly(CountDownLatch latch) {
        try {
            latch.await();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    @Test
    void serverThatReadsNoMore_endsSendingAfterTheLimit_andByAnInterrupt_andTheConnectionGoesOn() throws Exception {
        var readOn = new CountDownLatch(1);
        try (var server = new ScriptedSocket((message, self) -> {
            if (is(message, 1, 10)) {
                awaitQuietly(readOn);
            }
            return false;
        })) {
            var client = connect(server);
            var pos = client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
            client.setReadTimeout(50);
            assertThatThrownBy(() -> client.requestAddReplaceRule(-1, -1, 1, -1, 1))
                    .isInstanceOf(PlayerException.class);
            assertThatThrownBy(() -> {
                        while (true) {
                            pos.setSpeed(0.1, 0.2); // until all buffers are full
                        }
                    })
                    .isInstanceOf(PlayerException.class)
                    .hasMessageContaining("localhost:" + server.port() + " has not taken a message within 50 ms");
            client.setReadTimeout(3_600_000);
            Thread.currentThread().interrupt();
            assertThatThrownBy(() -> pos.setSpeed(0.1, 0.2))
                    .isInstanceOf(PlayerException.class)
                    .hasMessageContaining("interrupted while sending to localhost:" + server.port());
            assertThat(Thread.interrupted()).isTrue();

            readOn.countDown();
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
            assertThat(newest.payload())
                    .isEqualTo(CommandCodec.encode(new DeviceCommand.Velocity(0.3, 0, 0.4, true))
                            .payload());
            client.close();
        } finally {
            readOn.countDown();
        }
    }

    @Test
    void lateReply_goesToNoOtherRequest() throws Exception {
        var held = new ArrayList<WireMessage>();
        try (var server = new ScriptedSocket((message, self) -> {
            if (!is(message, 31, 1)) {
                return false;
            }
            held.add(message);
            if (held.size() == 2) {
                self.send(pose(held.get(0), "a", 1), pose(held.get(1), "b", 2));
            }
            return true;
        })) {
            var connection = new RemoteServer("localhost", server.port()).connect(new Sink(), null);
            connection.replyLimit(Duration.ofMillis(50));
            assertThatThrownBy(() -> connection.request(SIMULATION, new DeviceRequest.GetPose("a")))
                    .isInstanceOf(RequestFailedException.class);
            connection.replyLimit(Duration.ofMinutes(1));
            assertThat(connection.request(SIMULATION, new DeviceRequest.GetPose("b")))
                    .isEqualTo(new DeviceReply.ModelPose("b", 2, 0, 0));
            connection.close();
        }
    }

    private static WireMessage pose(WireMessage request, String model, double x) {
        byte[] payload = ReplyCodec.encode(new DeviceReply.ModelPose(model, x, 0, 0));
        Header asked = request.header();
        return new WireMessage(
                new Header(asked.address(), MessageType.ACK, asked.subtype(), 0, asked.sequence(), payload.length),
                payload);
    }

    /** Stops the reader where it has noticed the end and notifies the sink. */
    @Test
    void serverThatHasGone_isKnownToTheSinkAndToEveryCall_atTheSameTime() throws Exception {
        var server = new ScriptedSocket((message, self) -> false);
        var toldByReader = new CountDownLatch(1);
        var goOn = new CountDownLatch(1);
        var toldBy = new ConcurrentLinkedQueue<Thread>();
        var sink = new Sink() {
            @Override
            public void lost(String reason) {
                toldBy.add(Thread.currentThread());
                if (toldBy.size() == 1) {
                    toldByReader.countDown();
                    awaitQuietly(goOn);
                }
            }
        };
        var connection = new RemoteServer("localhost", server.port()).connect(sink, null);
        server.close();
        toldByReader.await();
        assertThatThrownBy(connection::devices).hasMessageContaining("has gone");
        assertThat(toldBy).as("told before the call failed").hasSize(2).contains(Thread.currentThread());
        goOn.countDown();
        connection.close();
    }

    @Test
    void errorOfTheSink_endsTheConnection_andEveryCallThatWaits() throws Exception {
        try (var server = new ScriptedSocket((message, self) -> {
            if (is(message, 4, 1)) {
                self.send(self.position(1)); // and sends no reply
                return true;
            }
            return false;
        })) {
            var sink = new Sink() {
                @Override
                public void frame(Frame frame) {
                    throw new NoClassDefFoundError("of a class that could not be read");
                }
            };
            var connection = new RemoteServer("localhost", server.port()).connect(sink, null);
            connection.replyLimit(Duration.ofHours(1));
            assertThatThrownBy(() ->
                            connection.request(server.device(Interfaces.POSITION2D), new DeviceRequest.Geometry()))
                    .isInstanceOf(ConnectionClosedException.class)
                    .hasMessageContaining("NoClassDefFoundError");
            connection.close();
        }
    }

    @Test
    void framesForABusySpace_areBounded_andTheNewestStay() throws Exception {
        int sent = 3_000;
        var goOn = new CountDownLatch(1);
        try (var space = ActorSpace.create(SpaceSettings.named("busy"));
                var server = new ScriptedSocket((message, self) -> {
                    if (is(message, 4, 1)) {
                        for (int i = 1; i <= sent; i++) {
                            self.send(self.position(i));
                        }
                    }
                    return false;
                })) {
            var sink = new Sink();
            var connection = new RemoteServer("localhost", server.port()).connect(sink, space);
            space.execute(() -> awaitQuietly(goOn));
            connection.replyLimit(Duration.ofMinutes(1));
            connection.request(server.device(Interfaces.POSITION2D), new DeviceRequest.Geometry()); // after all data
            goOn.countDown();
            var done = new CountDownLatch(1);
            space.execute(done::countDown);
            done.await();
            assertThat(sink.frames).hasSize(1024);
            assertThat(List.copyOf(sink.frames).getLast().timeSeconds()).isEqualTo(sent);
            connection.close();
        }
    }

    @Test
    void greetingThatTrickles_hasOneLimit() throws Exception {
        try (var listener = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            var trickle = Thread.ofPlatform().daemon().start(() -> {
                try (var socket = listener.accept()) {
                    for (char each : "Player v.3.1.1-dev--------------".toCharArray()) {
                        LockSupport.parkNanos(Duration.ofMillis(20).toNanos());
                        socket.getOutputStream().write(each);
                    }
                    socket.getInputStream().read();
                } catch (IOException clientHasGone) {
                    // expected
                }
            });
            var remote = new RemoteServer("localhost", listener.getLocalPort(), Duration.ofMillis(100));
            assertThatThrownBy(() -> remote.connect(new Sink(), null))
                    .isInstanceOf(ConnectionClosedException.class)
                    .hasMessage("localhost:" + listener.getLocalPort() + " did not answer within 100 ms");
            trickle.join();
        }
    }

    @Test
    void pull_frameWithoutAnything_isReadAndAnswered() throws Exception {
        try (var server = new ScriptedSocket((message, self) -> {
            if (is(message, 1, 4)) {
                long asked =
                        self.received.stream().filter(each -> is(each, 1, 4)).count();
                self.send(self.reply(message, MessageType.ACK, Content.NONE));
                self.send(
                        asked < 3
                                ? new WireMessage[] {self.synch()}
                                : new WireMessage[] {self.position(3), self.synch()});
                return true;
            }
            return false;
        })) {
            var client = connect(server);
            client.requestDataDeliveryMode(PLAYER_DATAMODE_PULL);
            var pos = client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
            for (int frame = 1; frame <= 2; frame++) {
                assertThat(client.readAll()).isEqualTo(PLAYER_MSGTYPE_SYNCH);
                assertThat(pos.isDataReady()).isFalse();
            }
            assertThat(client.readAll()).isEqualTo(PLAYER_MSGTYPE_SYNCH);
            assertThat(pos.getX()).isEqualTo(3);
            client.close();
        }
    }

    // ---- in this JVM

    @Test
    void runThreaded_fromSeveralThreads_startsOne() throws Exception {
        int port = 6794;
        var inFirst = new CountDownLatch(1);
        var goOn = new CountDownLatch(1);
        var entered = new AtomicInteger();
        var server = new ScriptedRanger(Map.of()) {
            @Override
            public void answered(long tick) {
                entered.incrementAndGet();
                inFirst.countDown();
                awaitQuietly(goOn);
            }
        };
        var failures = new ConcurrentLinkedQueue<Throwable>();
        try (var registration = PlayerPorts.open(port, server)) {
            assertThat(registration).isNotNull();
            var client = new PlayerClient("localhost", port);
            Runnable run = () -> {
                try {
                    client.runThreaded(-1, -1);
                } catch (RuntimeException e) {
                    failures.add(e);
                }
            };
            Thread first = Thread.ofPlatform().daemon().start(run);
            inFirst.await();
            Thread second = Thread.ofPlatform().daemon().start(run);
            while (second.getState() != Thread.State.BLOCKED && entered.get() < 2) {
                Thread.onSpinWait();
            }
            goOn.countDown();
            first.join();
            second.join();
            assertThat(failures).isEmpty();
            assertThat(entered).hasValue(1);
            client.close();
        }
    }
}
