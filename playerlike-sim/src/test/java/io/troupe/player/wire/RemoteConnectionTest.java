package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.fail;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.ManualClock;
import io.troupe.actor.SpaceSettings;
import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerException;
import io.troupe.player.Position2DInterface;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.PlayerPose;
import java.io.InputStream;
import java.net.ServerSocket;
import java.net.SocketTimeoutException;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.List;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.logging.Logger;
import java.util.logging.SimpleFormatter;
import org.assertj.core.api.ThrowableAssert.ThrowingCallable;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.parallel.Isolated;

/**
 * A client and a server connected by a socket: what is sent, how arriving messages are handled and in which order, how
 * the connection ends or fails to open, and servers that fall silent.
 */
@Tag("threads")
@Timeout(value = 60, threadMode = Timeout.ThreadMode.SEPARATE_THREAD) // a busy loop cannot be interrupted
@Isolated("looks at all threads")
class RemoteConnectionTest implements PlayerConstants {
    private static final int SET_INTEGER_PROPERTY = 253;

    private final ScriptedSocket server = new ScriptedSocket();
    private final PlayerClient client = server.connect();
    private final List<String> events = new ArrayList<>();
    private final ManualClock clock = new ManualClock();

    @AfterEach
    void close() {
        server.close();
    }

    private Position2DInterface wheels() {
        return client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
    }

    private void addRule() {
        client.requestAddReplaceRule(-1, -1, 1, -1, 1);
    }

    private static void fails(ThrowingCallable call, String... parts) {
        var failure = assertThatThrownBy(call).isInstanceOf(PlayerException.class);
        List.of(parts).forEach(failure::hasMessageContaining);
    }

    // ---- what is sent and received

    @Test
    void push_readAllBringsOneMessage_inTheOrderSent_andDataMayComeWithTheAcknowledgement() {
        server.on(1, 3, message -> {
            var reply = new PlayerReply.Access(server.device(Interfaces.POSITION2D), 1, "stage");
            var acknowledgement = server.ack(message, PlayerDeviceCodec.encode(reply));
            server.send(server.position(1), acknowledgement, server.position(2), server.position(3));
        });
        var pos = wheels();
        assertThat(pos.getDeviceDriverName()).isEqualTo("stage");
        assertThat(pos.getDeviceAddress().getRobot()).isEqualTo(server.port());
        for (double expected = 1; expected <= 3; expected++) {
            assertThat(client.readAll()).isEqualTo(PLAYER_MSGTYPE_DATA);
            assertThat(pos.isDataReady()).isTrue();
            assertThat(pos.getX()).isEqualTo(expected);
        }
        assertThat(pos.getTimestamp()).isEqualTo(3);
    }

    @Test
    void commandsAndRequests_areSentInOrder_andRepliesAreMatchedByDevice() throws Exception {
        var held = new ArrayList<WireMessage>();
        server.on(4, 1, held::add); // the reply with the geometry of position2d comes later than that of the sonars
        server.on(5, 1, message -> {
            var sonars = new DeviceReply.SonarGeometry(List.of(new DeviceReply.SonarMount(0.1, 0.2, 0.3)));
            var body = new DeviceReply.Position2dGeometry(-0.04, 0, 0, 0.44, 0.33);
            server.send(
                    server.ack(message, ReplyCodec.encode(sonars)),
                    server.ack(held.getFirst(), ReplyCodec.encode(body)));
        });
        var pos = wheels();
        var son = client.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
        client.runThreaded(-1, -1);
        pos.queryGeometry();
        son.queryGeometry();
        while (!pos.isGeomReady())
            ;
        while (!son.isGeomReady())
            ;
        assertThat(pos.getGeom().getSize().getSw()).isEqualTo(0.33);
        assertThat(son.getGeom().getPoses()[0].getPyaw()).isEqualTo(0.3);
        pos.setSpeed(0.2, 0.1);
        pos.setCarCMD(0.3, 0);
        var velocity = CommandCodec.encode(new DeviceCommand.Velocity(0.2, 0, 0.1, true));
        assertThat(server.nextCommand().payload()).isEqualTo(velocity.payload());
        assertThat(server.nextCommand().header().subtype()).isEqualTo(3);
    }

    @Test
    void pull_aFrameIsWhatCameUntilSynch_andOneRequestIsOpenAtATime() {
        server.on(1, 4, message -> {
            server.send(server.ack(message, Content.NONE));
            long asked = server.count(1, 4);
            server.send(server.position(asked), server.sonar(asked), server.position(asked + 0.5), server.synch());
        });
        client.requestDataDeliveryMode(PLAYER_DATAMODE_PULL);
        var pos = wheels();
        var son = client.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
        for (int round = 1; round <= 40; round++) {
            if (round <= 20) {
                assertThat(client.readAll()).isEqualTo(PLAYER_MSGTYPE_SYNCH);
                assertThat(List.of(pos.isDataReady(), son.isDataReady())).containsExactly(true, true);
            } else {
                if (round == 21) {
                    client.runThreaded(-1, -1);
                }
                while (!son.isDataReady())
                    ;
            }
            assertThat(pos.getX()).isEqualTo(round + 0.5);
            assertThat(son.getData().getRanges()[0]).isEqualTo(round);
        }
    }

    @Test
    void pull_dataBeforeAReply_areAFrame_withoutARequestForData() {
        server.on(1, 4, message -> {
            server.send(server.ack(message, Content.NONE));
            server.send(server.position(2), server.synch());
        });
        client.requestDataDeliveryMode(PLAYER_DATAMODE_PULL);
        var pos = wheels();
        server.on(1, 3, message -> {
            server.send(server.position(1));
            server.answer(message);
        });
        client.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
        client.readAll();
        assertThat(pos.isDataReady()).isTrue();
        assertThat(pos.getX()).isEqualTo(1);
        assertThat(server.count(1, 4)).as("requests for data").isZero();
        client.readAll();
        assertThat(pos.getX()).isEqualTo(2);
        assertThat(server.count(1, 4)).as("requests for data").isEqualTo(1);
    }

    @Test
    void pull_frameWithoutAnything_isReadAndAnswered() {
        server.on(1, 4, message -> {
            server.send(server.ack(message, Content.NONE));
            if (server.count(1, 4) == 3) {
                server.send(server.position(3), server.synch());
            } else {
                server.send(server.synch());
            }
        });
        client.requestDataDeliveryMode(PLAYER_DATAMODE_PULL);
        var pos = wheels();
        for (int frame = 1; frame <= 3; frame++) {
            assertThat(client.readAll()).isEqualTo(PLAYER_MSGTYPE_SYNCH);
            assertThat(pos.isDataReady()).isEqualTo(frame == 3);
        }
        assertThat(pos.getX()).isEqualTo(3);
    }

    @Test
    void subscription_isRefused_inEveryWayARealServerRefuses() {
        server.on(1, 3, message -> {
            boolean sonar = message.payload()[11] == Interfaces.SONAR.code();
            var echo = PlayerDeviceCodec.encode(new PlayerReply.Access(server.device(Interfaces.SONAR), 3, ""));
            server.send(server.reply(message, sonar ? MessageType.NACK : MessageType.ACK, echo));
        });
        fails(
                () -> client.requestInterfaceSonar(0, PLAYER_OPEN_MODE),
                "Negative acknowledgement received for subscribing to sonar:0");
        fails(() -> client.requestInterfaceRanger(0, PLAYER_OPEN_MODE), "Error subscribing to ranger:0");
        fails(
                () -> client.requestInterfaceLaser(0, PLAYER_OPEN_MODE),
                "laser:0 is not in the device list. It has: position2d:0, sonar:0, ranger:0");
    }

    @Test
    void request_thatIsDropped_isNamed_whenItsTimeIsOver() {
        server.on(1, 10, dropped -> {});
        server.on(4, 5, dropped -> {});
        var pos = wheels();
        client.setReadTimeout(50);
        fails(this::addRule, server + " did not answer within 50 ms: ReplaceRule[");
        pos.setOdometry(new PlayerPose(1, 2, 3)); // logs a warning
        assertThat(client.readAll()).isEqualTo(PLAYER_MSGTYPE_RESP_NACK);
        client.setReadTimeout(30_000);
        pos.resetOdometry(); // continues, whatever happened to the other requests
        assertThat(client.readAll()).isEqualTo(PLAYER_MSGTYPE_RESP_ACK);
    }

    @Test
    void messagesNobodyKnows_areSkipped() throws Exception {
        var pos = wheels();
        var wheels = server.device(Interfaces.POSITION2D);
        server.send(
                WireMessage.of(new DeviceAddress(1, 2, 10, 0), MessageType.DATA, 1, 0, new byte[12]),
                WireMessage.of(wheels, MessageType.DATA, 99, 0, new byte[4]),
                WireMessage.of(wheels, MessageType.DATA, 1, 0, new byte[4]),
                WireMessage.of(server.device(Interfaces.SONAR), MessageType.ACK, 1, 0, Content.NONE),
                WireMessage.of(new DeviceAddress(0, 0, 1, 0), MessageType.SYNCH, 2, 0, new byte[] {0, 0, 0, 9}),
                server.position(7));
        assertThat(client.readAll()).isEqualTo(PLAYER_MSGTYPE_DATA);
        assertThat(pos.getX()).isEqualTo(7);
    }

    @Test
    void ranger_tellsIntensities_andWhatItsRangesAreStampedWith() throws Exception {
        var ranger = client.requestInterfaceRanger(0, PLAYER_OPEN_MODE);
        var where = new DeviceReply.RangerGeometry(Pose3d.flat(1, 2, 3), new Size3d(1, 2, 3), List.of(), List.of());
        var stamped = new DeviceData.RangerStamped(new DeviceData.RangerRanges(List.of(6.0)), where, null);
        server.send(
                server.data(Interfaces.RANGER, new DeviceData.RangerIntensities(List.of(5.0)), 0),
                server.data(Interfaces.RANGER, stamped, 0));
        client.readAll();
        assertThat(List.of(ranger.isDataIntnsReady(), ranger.isDataReady())).containsExactly(true, false);
        assertThat(ranger.getDataIntns().getIntens()).containsExactly(5);
        client.readAll();
        assertThat(ranger.isDataReady()).isTrue();
        assertThat(ranger.getData().getRanges()).containsExactly(6);
        assertThat(List.of(ranger.isGeomReady(), ranger.isConfReady())).containsExactly(true, false);
        assertThat(ranger.getGeom().getPose().getPy()).isEqualTo(2);
    }

    @Test
    void clientOnAnActorSpace_getsItsFramesAsTurns_andAsksForTheNextWhenNothingIsLeftToDo() throws Exception {
        var seen = new ConcurrentLinkedQueue<String>();
        var done = new CountDownLatch(4);
        try (var space = ActorSpace.create(SpaceSettings.named("remote"));
                var other = new ScriptedSocket()) {
            other.on(1, 4, message -> {
                long asked = other.count(1, 4);
                if (asked <= 3) {
                    other.send(other.ack(message, Content.NONE), other.position(asked), other.synch());
                }
            });
            space.execute(() -> {
                var own = other.connect();
                own.requestDataDeliveryMode(PLAYER_DATAMODE_PULL);
                var pos = own.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
                own.runThreaded(-1, -1);
                Runnable look = () -> {
                    seen.add(pos.isDataReady() + " " + pos.getX() + " " + (ActorSpace.current() == space));
                    done.countDown();
                    if (pos.getX() == 3) {
                        own.close();
                    }
                };
                space.repeatWhile(() -> true, () -> own.nextData().thenAccept(ready -> look.run()))
                        .exceptionally(closed -> {
                            done.countDown();
                            return null;
                        });
            });
            assertThat(done.await(30, TimeUnit.SECONDS)).isTrue();
            assertThat(seen).containsExactly("true 1.0 true", "true 2.0 true", "true 3.0 true");
        }
    }

    // ---- how a connection ends

    @Test
    void serverThatGoes_endsEveryWaitingCall_busyOnesIncluded() throws Exception {
        server.on(4, 1, dropped -> {});
        server.on(1, 10, dropped -> {});
        var pos = wheels();
        client.runThreaded(-1, -1);
        pos.queryGeometry();
        var promise = client.nextData();
        Queue<Throwable> failures = new ConcurrentLinkedQueue<>();
        List<Runnable> waits = List.of(
                () -> {
                    while (!pos.isDataReady())
                        ;
                },
                () -> {
                    while (!pos.isGeomReady())
                        ;
                },
                this::addRule,
                () -> {
                    while (true) {
                        pos.setSpeed(0.1, 0);
                    }
                });
        var threads = new ArrayList<Thread>();
        for (var wait : waits) {
            threads.add(Thread.ofPlatform().daemon().start(() -> {
                try {
                    wait.run();
                } catch (PlayerException e) {
                    failures.add(e);
                }
            }));
        }
        while (server.count(1, 10) == 0) {
            Thread.onSpinWait();
        }
        server.vanish();
        for (var thread : threads) {
            thread.join();
        }
        client.join();
        assertThat(failures)
                .hasSize(4)
                .allSatisfy(
                        each -> assertThat(each).hasMessageContaining("the Player server at " + server + " has gone"));
        fails(() -> promise.get(Duration.ofSeconds(30)));
        fails(client::requestData);
    }

    @Test
    void serverThatGoes_endsAReadAll_andANewClientMayConnectElsewhere() throws Exception {
        var son = client.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
        server.vanish();
        fails(client::readAll, "has gone");
        fails(son::isDataReady);
        client.close();
        try (var other = new ScriptedSocket()) {
            var again = other.connect(); // the caller decides to reconnect
            son = again.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
            other.send(other.sonar(2));
            again.readAll();
            assertThat(son.getData().getRanges()).containsExactly(2);
        }
    }

    @Test
    void bytesThatAreNoMessages_endTheLine_andSayWhy() throws Exception {
        var pos = wheels();
        server.sendRaw("HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\n\r\n".getBytes(StandardCharsets.ISO_8859_1));
        fails(client::readAll, "sent what is not the Player protocol: header ");
        fails(() -> pos.setSpeed(1, 1));
    }

    @Test
    void close_leavesNoThread_andEveryLaterCallThrows() {
        var son = client.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
        client.runThreaded(-1, -1);
        assertThat(threads(server)).hasSize(2);
        client.close();
        assertThat(threads(server)).isEmpty();
        fails(son::isDataReady, "this client is closed");
        fails(son::queryGeometry, "is closed");
    }

    private static List<Thread> threads(ScriptedSocket server) {
        return Thread.getAllStackTraces().keySet().stream()
                .filter(thread -> thread.getName().endsWith("" + server.port()))
                .toList();
    }

    // ---- no connection

    @Test
    void connection_doesNotComeAbout_andOneMessageSaysWhy() throws Exception {
        int unused;
        try (var socket = new ServerSocket(0)) {
            unused = socket.getLocalPort();
        }
        assertThatThrownBy(() -> new PlayerClient("localhost", unused))
                .isInstanceOf(PlayerException.class)
                .hasMessageStartingWith(
                        "[PlayerClient]: Error in PlayerClient init: localhost:" + unused + " cannot be reached: ")
                .hasMessageContaining("does a Player server run there?");
        fails(() -> new PlayerClient("no-such-host.invalid", 6665), "there is no host 'no-such-host.invalid'");
        fails(() -> new PlayerClient("localhost", 70_000), "port is 70000");
    }

    @Test
    void greeting_isNotPlayers_isQuoted() {
        try (var other = new ScriptedSocket("SSH-2.0-Open\r\n")) {
            fails(other::connect, "it greeted with \"SSH-2.0-Open??\", expected \"Player v...\"");
            assertThat(threads(other)).isEmpty();
        }
    }

    @Test
    void silence_hasALimit_andIsNamed() {
        var limit = Duration.ofSeconds(2); // the greeting has to come in time
        var sink = new Sink(frame -> fail("nothing was subscribed"), reason -> {});
        try (var quiet = new ScriptedSocket()) {
            quiet.silent = true;
            var remote = new RemoteServer("localhost", quiet.port(), limit);
            assertThatThrownBy(() -> remote.connect(sink, null))
                    .isInstanceOf(RequestFailedException.class)
                    .hasMessageContaining("the device list was requested");
            assertThat(remote.banner()).isEqualTo("Player v.3.1.1-dev");
            assertThat(threads(quiet)).isEmpty();
        }
        try (var mute = new ScriptedSocket("")) {
            assertThatThrownBy(() -> new RemoteServer("localhost", mute.port(), limit).connect(sink, null))
                    .isInstanceOf(ConnectionClosedException.class)
                    .hasMessage(mute + " did not answer within 2000 ms");
        }
    }

    // ---- servers that stay connected and do not send what a client waits for

    /** Reads come from the list: a number of bytes, 0 for a time-out of one second, -1 for the end of the stream. */
    private RemoteReader.KeepAliveInput input(@Nullable Duration limit, Integer... reads) {
        Queue<Integer> next = new ArrayDeque<>(List.of(reads));
        var in = new InputStream() {
            @Override
            public int read() {
                throw new AssertionError("byte by byte");
            }

            @Override
            public int read(byte[] bytes, int offset, int length) throws SocketTimeoutException {
                int count = next.remove();
                if (count == 0) {
                    clock.advance(Duration.ofSeconds(1));
                    throw new SocketTimeoutException();
                }
                events.add("read " + count);
                return count;
            }
        };
        return new RemoteReader.KeepAliveInput(
                in, clock, () -> limit, () -> events.add("ask"), silent -> events.add("silent"));
    }

    @Test
    void input_asksAfterHalfOfTheLimit_andReportsSilenceAfterAll_once() throws Exception {
        var four = Duration.ofSeconds(4);
        var in = input(four, 0, 1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, -1);
        for (int expected : new int[] {1, 2, 3, -1}) {
            assertThat(in.read(new byte[8], 0, 8)).isEqualTo(expected);
        }
        assertThat(events).containsExactly("read 1", "ask", "read 2", "ask", "silent", "read 3", "read -1");
    }

    @Test
    void serverThatFallsSilent_endsTheWaiting_andIsStillSentCommands() throws Exception {
        var pos = wheels();
        server.silent = true;
        client.setSilenceLimit(Duration.ofMillis(100));
        assertThatThrownBy(client::readAll)
                .isInstanceOf(PlayerException.class)
                .hasMessage("the Player server at " + server
                        + " is connected and silent: nothing has come from it for 100 ms, and no answer to a request");
        pos.setSpeed(0, 0);
        assertThat(server.nextCommand().header().subtype()).isEqualTo(1);
    }

    @Test
    void silenceLimit_ofNoneOrBeyondAllNanoseconds_isTaken_andEndsNothing_andOneMillisecondIsRefused()
            throws Exception {
        var endless = Duration.ofSeconds(Long.MAX_VALUE);
        assertThat(input(null, 0, 0, 0, 0, 0, 0, 0, 0, 7).read(new byte[8], 0, 8))
                .isEqualTo(7);
        assertThat(input(endless, 0, 0, 0, 8).read(new byte[8], 0, 8)).isEqualTo(8);
        assertThat(events).containsExactly("read 7", "read 8");
        client.setSilenceLimit(endless);
        client.setReadTimeout(Long.MAX_VALUE);
        addRule();
        client.setSilenceLimit(null);
        addRule();
        assertThatThrownBy(() -> client.setSilenceLimit(Duration.ofMillis(1)))
                .isInstanceOf(PlayerException.class)
                .hasMessage("silence limit is PT0.001S, expected 2 ms or more, or null for none");
    }

    @Test
    void serverThatRefusesCommandLimits_isNamedInTheLogOnce_andObeysAsEver() throws Exception {
        List<String> said = new CopyOnWriteArrayList<>();
        var log = Logger.getLogger(PlayerClient.class.getName());
        log.setFilter(entry -> said.add(entry.getLevel() + " " + new SimpleFormatter().formatMessage(entry)));
        try {
            server.on(
                    4,
                    SET_INTEGER_PROPERTY,
                    message -> server.send(server.reply(message, MessageType.NACK, Content.NONE)));
            var pos = wheels();
            pos.setCommandLimit(Duration.ofMillis(400));
            pos.setCommandLimit(Duration.ofMillis(500));
            pos.setSpeed(0.1, 0);
            assertThat(server.nextCommand().header().subtype()).isEqualTo(1);
            addRule(); // waits for its reply, which comes after the refusals
        } finally {
            log.setFilter(null);
        }
        assertThat(said).singleElement().asString().startsWith("INFO").contains("position2d:0", "the server decides");
    }
}
