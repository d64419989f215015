package io.troupe.player.wire;

import static io.troupe.player.wire.RemoteConnectionTest.connect;
import static io.troupe.player.wire.RemoteConnectionTest.is;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerException;
import io.troupe.player.structures.PlayerConstants;
import java.net.ServerSocket;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.List;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** How a connection over a socket ends, or fails to open. */
@Tag("threads")
@Timeout(value = 60, threadMode = Timeout.ThreadMode.SEPARATE_THREAD)
class RemoteEndTest implements PlayerConstants {
    @Test
    void serverThatGoes_endsEveryWaitingCall_busyOnesIncluded() throws Exception {
        var server = new ScriptedSocket((message, self) -> is(message, 4, 1) || is(message, 1, 10));
        var client = connect(server);
        var pos = client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
        client.runThreaded(-1, -1);
        pos.queryGeometry();
        var promise = client.nextData();
        Queue<Throwable> failures = new ConcurrentLinkedQueue<>();
        var threads = List.<Runnable>of(
                        () -> {
                            while (!pos.isDataReady())
                                ;
                        },
                        () -> {
                            while (!pos.isGeomReady())
                                ;
                        },
                        () -> client.requestAddReplaceRule(-1, -1, 1, -1, 1),
                        () -> {
                            while (true) {
                                pos.setSpeed(0.1, 0);
                            }
                        })
                .stream()
                .map(wait -> Thread.ofPlatform().daemon().start(() -> {
                    try {
                        wait.run();
                    } catch (PlayerException e) {
                        failures.add(e);
                    }
                }))
                .toList();
        while (server.received.stream().noneMatch(message -> is(message, 1, 10))) {
            Thread.onSpinWait();
        }
        server.close();
        for (var thread : threads) {
            thread.join();
        }
        client.join();
        assertThat(failures)
                .hasSize(4)
                .allSatisfy(each -> assertThat(each)
                        .hasMessageContaining("the Player server at localhost:" + server.port() + " has gone"));
        assertThatThrownBy(() -> promise.get(Duration.ofSeconds(30))).isInstanceOf(PlayerException.class);
        assertThatThrownBy(client::requestData).isInstanceOf(PlayerException.class);
        client.close();
    }

    @Test
    void serverThatGoes_endsAReadAll_andANewClientMayConnectElsewhere() throws Exception {
        try (var other = new ScriptedSocket((message, self) -> false)) {
            var server = new ScriptedSocket((message, self) -> false);
            var client = connect(server);
            var son = client.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
            server.close();
            assertThatThrownBy(client::readAll)
                    .isInstanceOf(PlayerException.class)
                    .hasMessageContaining("has gone");
            assertThatThrownBy(son::isDataReady).isInstanceOf(PlayerException.class);
            client.close();
            var again = connect(other); // the caller decides to reconnect
            son = again.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
            other.send(other.sonar(2));
            again.readAll();
            assertThat(son.getData().getRanges()).containsExactly(2);
            again.close();
        }
    }

    @Test
    void bytesThatAreNoMessages_endTheLine_andSayWhy() throws Exception {
        try (var server = new ScriptedSocket((message, self) -> false)) {
            var client = connect(server);
            var pos = client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
            server.sendRaw(
                    "HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\n\r\n".getBytes(StandardCharsets.ISO_8859_1));
            assertThatThrownBy(client::readAll)
                    .isInstanceOf(PlayerException.class)
                    .hasMessageContaining("sent what is not the Player protocol: header ");
            assertThatThrownBy(() -> pos.setSpeed(1, 1)).isInstanceOf(PlayerException.class);
            client.close();
        }
    }

    @Test
    void close_leavesNoThread_andEveryLaterCallThrows() throws Exception {
        try (var server = new ScriptedSocket((message, self) -> false)) {
            var client = connect(server);
            var son = client.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
            client.runThreaded(-1, -1);
            assertThat(threads(server)).hasSize(2);
            client.close();
            assertThat(threads(server)).isEmpty();
            assertThatThrownBy(son::isDataReady).hasMessageContaining("this client is closed");
            assertThatThrownBy(son::queryGeometry).hasMessageContaining("has been closed");
        }
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
        assertThatThrownBy(() -> new PlayerClient("no-such-host.invalid", 6665))
                .isInstanceOf(PlayerException.class)
                .hasMessageContaining("there is no host 'no-such-host.invalid'");
        assertThatThrownBy(() -> new PlayerClient("localhost", 70_000))
                .isInstanceOf(PlayerException.class)
                .hasMessageContaining("port is 70000");
    }

    @Test
    void greeting_isNotPlayers_isQuoted() throws Exception {
        try (var server = new ScriptedSocket("SSH-2.0-Open\r\n", (message, self) -> false)) {
            assertThatThrownBy(() -> connect(server))
                    .isInstanceOf(PlayerException.class)
                    .hasMessageContaining("it greeted with \"SSH-2.0-Open??\", expected \"Player v...\"");
            assertThat(threads(server)).isEmpty();
        }
    }

    @Test
    void silence_hasALimit_andIsNamed() throws Exception {
        var limit = Duration.ofMillis(50);
        try (var server = new ScriptedSocket((message, self) -> true)) {
            var remote = new RemoteServer("localhost", server.port(), limit);
            assertThatThrownBy(() -> remote.connect(new NoSink(), null))
                    .isInstanceOf(RequestFailedException.class)
                    .hasMessageContaining("the device list was requested");
            assertThat(remote.banner()).isEqualTo("Player v.3.1.1-dev");
            assertThat(threads(server)).isEmpty();
        }
        try (var server = new ScriptedSocket("", (message, self) -> true)) {
            var remote = new RemoteServer("localhost", server.port(), limit);
            assertThatThrownBy(() -> remote.connect(new NoSink(), null))
                    .isInstanceOf(ConnectionClosedException.class)
                    .hasMessage("localhost:" + server.port() + " did not answer within 50 ms");
        }
    }

    private static final class NoSink implements DataSink {
        @Override
        public void frame(Frame frame) {
            throw new AssertionError("nothing was subscribed");
        }

        @Override
        public void lost(String reason) {}
    }
}
