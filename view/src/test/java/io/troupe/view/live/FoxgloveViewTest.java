package io.troupe.view.live;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.RobotReading;
import io.troupe.sim.Snapshot;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.CrowdWorld;
import io.troupe.view.PushedBox;
import io.troupe.view.RecordedRun;
import io.troupe.view.RunLog;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.net.InetAddress;
import java.net.Socket;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.WebSocket;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.List;
import java.util.Random;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** Viewers with Foxglove's protocol, at the port of the live page. The client is the one of the JDK. */
@Timeout(300)
class FoxgloveViewTest {
    @TempDir
    private Path folder;

    /** A client that keeps what it receives, texts as they are and data as {@code subscription nanoseconds JSON}. */
    private static final class Client implements WebSocket.Listener, AutoCloseable {
        final BlockingQueue<String> received = new LinkedBlockingQueue<>();
        private final StringBuilder text = new StringBuilder();
        private final ByteArrayOutputStream data = new ByteArrayOutputStream();
        private final HttpClient http = HttpClient.newHttpClient();
        private final WebSocket socket;

        Client(int port) {
            socket = http.newWebSocketBuilder()
                    .subprotocols("foxglove.websocket.v1")
                    .buildAsync(URI.create("ws://localhost:" + port + "/"), this)
                    .join();
        }

        @Override
        public @Nullable CompletionStage<?> onText(WebSocket from, CharSequence part, boolean last) {
            text.append(part);
            if (last) {
                received.add(text.toString());
                text.setLength(0);
            }
            from.request(1);
            return null;
        }

        @Override
        public @Nullable CompletionStage<?> onBinary(WebSocket from, ByteBuffer part, boolean last) {
            while (part.hasRemaining()) {
                data.write(part.get());
            }
            if (last) {
                ByteBuffer message = ByteBuffer.wrap(data.toByteArray()).order(ByteOrder.LITTLE_ENDIAN);
                data.reset();
                received.add(
                        message.get() == 2
                                ? "time " + message.getLong()
                                : message.getInt() + " " + message.getLong() + " "
                                        + StandardCharsets.UTF_8.decode(message));
            }
            from.request(1);
            return null;
        }

        void send(String json) {
            socket.sendText(json, true).join();
        }

        /** The next message that begins so. */
        String next(String start) throws InterruptedException {
            while (true) {
                String message = received.poll(2, TimeUnit.MINUTES);
                assertThat(message).as("message that begins with " + start).isNotNull();
                if (message.startsWith(start)) {
                    return message;
                }
            }
        }

        @Override
        public void close() {
            socket.abort();
            http.close();
        }
    }

    private static int channel(String advertise, String topic) {
        Matcher matcher =
                Pattern.compile("\\{\"id\":(\\d+),\"topic\":\"" + topic + "\"").matcher(advertise);
        assertThat(matcher.find()).as(topic + " in " + advertise).isTrue();
        return Integer.parseInt(matcher.group(1));
    }

    private static void subscribe(Client client, int id, int channel) {
        client.send("{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":" + id + ",\"channelId\":" + channel + "}]}");
    }

    private static LiveView page() throws IOException {
        return LiveView.open(LiveView.Settings.defaults().withPort(0));
    }

    @Test
    void subscriber_getsWhatTheRobotsRead_atTheirTime() throws Exception {
        try (var world = World.create(LiveRuns.ARENA.world(), WorldSettings.defaults());
                var page = page()) {
            var viewed = new ViewedRun(LiveRuns.ARENA.world(), LiveRuns.TABLE, new RunControl(0, true)).onto(page);
            viewed.moved(world.latest(), robot -> "wallFollower");
            try (var client = new Client(page.port())) {
                assertThat(client.next("{\"op\":\"serverInfo\""))
                        .contains("\"name\":\"" + RunLog.PROGRAM + "\"", "\"capabilities\":[\"time\"]");
                String channels = client.next("{\"op\":\"advertise\"");
                assertThat(channels).contains("\"schemaName\":\"foxglove.FrameTransforms\"");
                subscribe(client, 4_000_000, channel(channels, "/world"));
                assertThat(client.next("4000000 "))
                        .as("what stays is sent to each subscriber")
                        .contains("north wall");
                subscribe(client, 7, channel(channels, "/robot1/pose"));
                assertThat(client.next("7 0 ")).contains("\"position\":{\"x\":-4,\"y\":-2.8,\"z\":0}");

                world.command(0, 0.5, 0);
                Snapshot moved = world.advance();
                viewed.moved(moved, robot -> "wallFollower");
                RobotReading robot = moved.robots().getFirst();
                assertThat(client.next("time ")).isEqualTo("time 100000000");
                assertThat(client.next("7 "))
                        .startsWith("7 100000000 ")
                        .contains("\"y\":" + robot.pose().y());

                client.send("{\"op\":\"unsubscribe\",\"subscriptionIds\":[7]}");
                subscribe(client, 8, channel(channels, "/robot1/status"));
                assertThat(client.next("8 ")).contains("\"service\":\"wallFollower\"", "\"forward\":0.5");
                viewed.moved(world.advance(), index -> "none");
                assertThat(client.next("8 200000000")).contains("\"service\":\"none\"");
                assertThat(client.received).noneMatch(each -> each.startsWith("7 "));
            }
        }
    }

    @Test
    void pushedBox_isSentWhereItIs_andNothingElseOfTheWorld() throws Exception {
        List<Snapshot> pushed = PushedBox.run();
        try (var page = page();
                var client = new Client(page.port())) {
            var viewed = new ViewedRun(PushedBox.WORLD, new RunControl(0, true)).onto(page);
            viewed.moved(pushed.getFirst());
            subscribe(client, 1, channel(client.next("{\"op\":\"advertise\""), "/world"));
            assertThat(client.next("1 0 ")).contains("\"id\":\"0 box\"", "\"id\":\"1 wall\"");
            viewed.moved(pushed.getLast());
            assertThat(client.next("1 6000000000 "))
                    .contains(
                            "\"id\":\"0 box\"",
                            "\"x\":" + pushed.getLast().moved().getFirst().x())
                    .doesNotContain("wall");
        }
    }

    @Test
    void requestsThatCannotBeServed_getAStatus_andTheConnectionGoesOn() throws Exception {
        try (var world = World.create(LiveRuns.ARENA.world(), WorldSettings.defaults());
                var page = page();
                var client = new Client(page.port())) {
            var viewed = new ViewedRun(LiveRuns.ARENA.world(), new RunControl(0, true)).onto(page);
            viewed.moved(world.latest());
            String channels = client.next("{\"op\":\"advertise\"");
            String[][] requests = {
                {"hello", "'h', expected a JSON object"},
                {"{}", "there is no 'op', expected a text"},
                {"{\"op\":\"fetchAsset\"}", "'fetchAsset' is not offered by this server"},
                {"{\"op\":\"subscribe\"}", "there is no 'subscriptions', expected a list of objects"},
                {"{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":1,\"channelId\":999}]}", "there is no channel 999"},
                {
                    "{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":-1,\"channelId\":0}]}",
                    "'id' is -1.0, expected whole numbers from 0 to 4294967295"
                },
                {"{\"op\":\"unsubscribe\",\"subscriptionIds\":[5]}", "there is no subscription 5"},
            };
            for (String[] each : requests) {
                client.send(each[0]);
                assertThat(client.next("{\"op\":\"status\""))
                        .isEqualTo("{\"op\":\"status\",\"level\":2,\"message\":\"" + each[1] + "\"}");
            }
            subscribe(client, 1, channel(channels, "/tf"));
            client.next("1 0 ");
            subscribe(client, 1, channel(channels, "/tf"));
            assertThat(client.next("{\"op\":\"status\"")).contains("subscription 1 exists already");
        }
    }

    @Test
    void anotherWorld_hasOtherChannels() throws Exception {
        try (var arena = World.create(LiveRuns.ARENA.world(), WorldSettings.defaults());
                var crowd = World.create(CrowdWorld.scenario(12).world(), WorldSettings.defaults());
                var page = page();
                var client = new Client(page.port())) {
            new ViewedRun(LiveRuns.ARENA.world(), new RunControl(0, true))
                    .onto(page)
                    .moved(arena.latest());
            String channels = client.next("{\"op\":\"advertise\"");
            subscribe(client, 1, channel(channels, "/tf"));
            client.next("1 0 ");
            new ViewedRun(CrowdWorld.scenario(12).world(), new RunControl(0, true))
                    .onto(page)
                    .moved(crowd.latest());
            assertThat(client.next("{\"op\":\"unadvertise\""))
                    .startsWith("{\"op\":\"unadvertise\",\"channelIds\":[0,1,2,3,4,5,");
            assertThat(client.next("{\"op\":\"advertise\""))
                    .contains("\"topic\":\"/tf\"")
                    .doesNotContain("/robot1");
        }
    }

    @Test
    void statesOfARun_areMessages_andTheNewestOneIsSentToEachSubscriber() throws Exception {
        try (var page = page();
                var client = new Client(page.port())) {
            var viewed = new ViewedRun(LiveRuns.ARENA.world(), LiveRuns.TABLE, new RunControl(0, true)).onto(page);
            LiveRuns.run(folder.resolve("run.jsonl"), 2, viewed.listener(RecordedRun.Listener.NONE));
            String channels = client.next("{\"op\":\"advertise\"");
            subscribe(client, 3, channel(channels, "/state"));
            assertThat(client.next("3 0 "))
                    .contains(
                            "\"state\":1,\"robot\":0,\"colour\":\"#0000ff\",\"services\":[\"wallFollower\",\"spaceWanderer\"]");
        }
    }

    // ---- who may connect

    private static String upgrade(int port, String... headers) throws IOException {
        return ask(
                port,
                "GET / HTTP/1.1\r\nHost: localhost:" + port
                        + "\r\nConnection: Upgrade\r\nUpgrade: WebSocket\r\nSec-WebSocket-Version: 13\r\n"
                        + "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" + String.join("", headers) + "\r\n");
    }

    /** The first 200 bytes of the answer. */
    private static String ask(int port, String request) throws IOException {
        try (var socket = new Socket(InetAddress.getLoopbackAddress(), port)) {
            socket.getOutputStream().write(request.getBytes(StandardCharsets.UTF_8));
            return new String(socket.getInputStream().readNBytes(200), StandardCharsets.ISO_8859_1);
        }
    }

    @Test
    void foreignPages_otherNames_andOtherProtocols_areRefused() throws IOException {
        try (var page = page()) {
            int port = page.port();
            String known = "Sec-WebSocket-Protocol: other, foxglove.sdk.v1\r\n";
            assertThat(upgrade(port, known))
                    .startsWith("HTTP/1.1 101 ")
                    .contains("Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=", "Protocol: foxglove.sdk.v1\r\n");
            for (String origin :
                    new String[] {"file://", "https://app.foxglove.dev", "http://localhost:8080", "http://127.0.0.1"}) {
                assertThat(upgrade(port, known, "Origin: " + origin + "\r\n")).startsWith("HTTP/1.1 101 ");
            }
            for (String origin : new String[] {
                "https://evil.example", "null", "http://localhost.evil.example", "https://app.foxglove.dev.evil.example"
            }) {
                assertThat(upgrade(port, known, "Origin: " + origin + "\r\n")).startsWith("HTTP/1.1 403 ");
            }
            assertThat(upgrade(port, "Sec-WebSocket-Protocol: other\r\n")).startsWith("HTTP/1.1 400 ");
            assertThat(ask(port, "GET / HTTP/1.1\r\nHost: evil.example\r\nUpgrade: websocket\r\n\r\n"))
                    .startsWith("HTTP/1.1 403 ");
        }
    }

    @Test
    void port_servesSeveralRequestsOfOneConnection_andSurvivesGarbage() throws IOException {
        try (var page = page()) {
            int port = page.port();
            String get = "GET /none HTTP/1.1\r\nHost: localhost:" + port + "\r\n";
            assertThat(askAll(port, get + "\r\n" + get + "Connection: close\r\n\r\n")
                            .split("HTTP/1.1 404 ", -1))
                    .hasSize(3);
            long seed = new Random().nextLong();
            var random = new Random(seed);
            for (int round = 0; round < 200; round++) {
                try (var socket = new Socket(InetAddress.getLoopbackAddress(), port)) {
                    byte[] bytes = new byte[random.nextInt(500)];
                    random.nextBytes(bytes);
                    socket.getOutputStream().write(bytes);
                } catch (IOException refused) {
                    assertThat(refused).as("seed %d, round %d", seed, round).isNotNull();
                }
            }
            assertThat(askAll(port, get + "Connection: close\r\n\r\n"))
                    .as("seed %d", seed)
                    .startsWith("HTTP/1.1 404 ");
        }
    }

    private static String askAll(int port, String request) throws IOException {
        try (var socket = new Socket(InetAddress.getLoopbackAddress(), port)) {
            socket.getOutputStream().write(request.getBytes(StandardCharsets.UTF_8));
            return new String(socket.getInputStream().readAllBytes(), StandardCharsets.ISO_8859_1);
        }
    }
}
