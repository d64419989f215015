package io.troupe.view.live;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.actor.ManualClock;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.RobotReading;
import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.device.DeviceReading;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangeNoise;
import io.troupe.sim.model.RangeSensorSpec;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.WorldSpec;
import io.troupe.view.DeviceRoom;
import io.troupe.view.PushedBox;
import io.troupe.view.RecordedRun;
import io.troupe.view.RunLog;
import io.troupe.view.RunRecorder;
import io.troupe.view.RunResult;
import java.io.IOException;
import java.io.InputStream;
import java.net.BindException;
import java.net.InetAddress;
import java.net.Socket;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HexFormat;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.concurrent.atomic.AtomicInteger;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** The server of the live page, asked over plain sockets. */
@Timeout(300)
class LiveViewTest {
    @TempDir
    private Path folder;

    private static LiveView page() throws IOException {
        return LiveView.open(LiveView.Settings.defaults().withPort(0));
    }

    /** Sends a request as it is; returns all of the answer. */
    private static String ask(int port, String request) throws IOException {
        try (var socket = new Socket(InetAddress.getLoopbackAddress(), port)) {
            socket.getOutputStream().write(request.getBytes(StandardCharsets.UTF_8));
            return new String(socket.getInputStream().readAllBytes(), StandardCharsets.UTF_8);
        }
    }

    private static String get(int port, String path, String host) throws IOException {
        return ask(port, "GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n\r\n");
    }

    private static String post(int port, String path, String origin, String body) throws IOException {
        return ask(
                port,
                "POST " + path + " HTTP/1.1\r\nHost: localhost:" + port + "\r\nConnection: close\r\n"
                        + (origin.isEmpty() ? "" : "Origin: " + origin + "\r\n") + "Content-Length: " + body.length()
                        + "\r\n\r\n" + body);
    }

    @Test
    void sampleOfThePage_showsARun() throws Exception {
        Scenario scenario = LiveRuns.ARENA;
        var run = new RecordedRun(
                scenario,
                SubsumptionTable.ofThePaper(),
                RecordedRun.Settings.defaults().withSeconds(2));
        var control = new RunControl(0, true);
        String address;
        RunResult result;
        try (var log = new RunLog(folder.resolve("run.jsonl"))) {
            try (var page = LiveView.open(LiveView.Settings.defaults().withPort(0))) {
                address = page.address();
                var viewed = new ViewedRun(scenario.world(), SubsumptionTable.ofThePaper(), control).onto(page);
                result = run.run(log, viewed.listener(RecordedRun.Listener.NONE));
            }
        }
        assertThat(System.getProperty("sun.net.httpserver.nodelay")).isNull();
        assertThat(address).matches("http://localhost:\\d+/");
        assertThat(result.duration()).isEqualTo("2.0");
    }

    @Test
    void run_writesTheSameBytes_withTwentyViewersAndAFrozenOne_asWithoutAPage() throws Exception {
        Path alone = folder.resolve("alone.jsonl");
        Path watched = folder.resolve("watched.jsonl");
        LiveRuns.run(alone, 60, RecordedRun.Listener.NONE);
        List<Socket> viewers = new ArrayList<>();
        var read = new AtomicInteger();
        List<Thread> readers = new ArrayList<>();
        try (var page = page()) {
            for (int i = 0; i < 21; i++) {
                var socket = new Socket(InetAddress.getLoopbackAddress(), page.port());
                viewers.add(socket);
                socket.getOutputStream()
                        .write(("GET /stream HTTP/1.1\r\nHost: localhost:" + page.port() + "\r\n\r\n")
                                .getBytes(StandardCharsets.UTF_8));
                InputStream stream = socket.getInputStream();
                if (i > 0) { // the first one never reads
                    assertThat(stream.read()).isEqualTo('H');
                    readers.add(Thread.ofVirtual().start(() -> count(stream, read)));
                }
            }
            var viewed = new ViewedRun(LiveRuns.ARENA.world(), LiveRuns.TABLE, new RunControl(0, true)).onto(page);
            LiveRuns.run(watched, 60, viewed.listener(RecordedRun.Listener.NONE));
            page.close("the run has ended");
            for (Thread reader : readers) {
                reader.join();
            }
        } finally {
            for (Socket socket : viewers) {
                socket.close();
            }
        }
        assertThat(watched).hasSameBinaryContentAs(alone);
        assertThat(read.get())
                .as("bytes that the viewers got: the world, the last frame and the reason of the end at least")
                .isGreaterThan(20 * 3000);
    }

    private static void count(InputStream stream, AtomicInteger bytes) {
        try {
            byte[] buffer = new byte[8192];
            for (int got = stream.read(buffer); got >= 0; got = stream.read(buffer)) {
                bytes.addAndGet(got);
            }
        } catch (IOException end) {
            // the server has closed the connection
        }
    }

    /** Interventions at given times: what viewers do, without their clocks. */
    private static RecordedRun.Listener intervening(RunControl control, RecordedRun.Listener inner, String[][] plan) {
        return new RecordedRun.Listener() {
            private int next;

            @Override
            public void beforeTick(Simulation simulation, RunRecorder recorder) throws InterruptedException {
                while (next < plan.length
                        && simulation.timeMicros() >= (long) (Double.parseDouble(plan[next][0]) * 1e6)) {
                    control.submit(ViewCommand.parse(plan[next++][1], 2));
                }
                inner.beforeTick(simulation, recorder);
            }

            @Override
            public void recorded(Snapshot snapshot, RunRecorder recorder) {
                inner.recorded(snapshot, recorder);
            }
        };
    }

    @Test
    void runWithInterventions_isRepeatedByteForByte_byItsOwnLog() throws Exception {
        String[][] plan = {
            {"1", "place 1 3.5 -1.0 0.7"},
            {"2", "drive 2 0.2 0.5"},
            {"4", "release 2"},
            {"5", "place 2 0 0 1.5707"},
            {"5", "place 1 100 100 0"},
            {"5.1", "box 2 00ff00 0.0 0.0"}, // where robot 2 is
            {"5.5", "box 1 ff0000 4.5 -1.0"},
            {"6", "box 1 ff0000 0.5 1.5"},
            {"6.5", "box 3 00ff00 -3.0 0.0"},
            {"7", "reset"},
            {"8", "box 4 0000ff 0.0 0.0"},
            {"9", "drive 1 -0.1 0"},
            {"9.5", "unbox 4"},
            {"10", "release 1"},
        };
        Path first = folder.resolve("first.jsonl");
        Path again = folder.resolve("again.jsonl");
        var control = new RunControl(new ManualClock(), 0, true);
        var viewed = new ViewedRun(LiveRuns.ARENA.world(), LiveRuns.TABLE, control);
        LiveRuns.run(first, 15, intervening(control, viewed.listener(RecordedRun.Listener.NONE), plan));

        var repeating = new RunControl(0, false);
        repeating.repeat(first, LiveRuns.ARENA.world(), Map.of());
        var shown = new ViewedRun(LiveRuns.ARENA.world(), LiveRuns.TABLE, repeating);
        LiveRuns.run(again, 15, shown.listener(RecordedRun.Listener.NONE));

        assertThat(again).hasSameBinaryContentAs(first);
        List<String> lines = Files.readAllLines(first);
        assertThat(lines.stream().filter(line -> line.contains("\"intervention\"")))
                .as("of those at 5 s only the newest place of robot 1 counts, and it is outside of every wall")
                .hasSizeBetween(12, 13)
                .first()
                .isEqualTo("{\"t\":1.0,\"type\":\"intervention\",\"what\":\"place 1 3.5 -1.0 0.7\"}");
        assertThat(lines).anyMatch(line -> line.contains("\"what\":\"box 1 ff0000 0.5 1.5\""));
        assertThat(lines).noneMatch(line -> line.contains("\"what\":\"box 2 "));
        assertThat(lines).anyMatch(line -> line.startsWith("{\"t\":1.1,\"type\":\"pose\",\"robot\":1,\"x\":3.5"));
    }

    @Test
    void request_underAnotherName_fromAnotherPage_orForAnotherPath_isRefused() throws Exception {
        try (var page = page()) {
            int port = page.port();
            assertThat(get(port, "/", "localhost:" + port))
                    .startsWith("HTTP/1.1 200")
                    .contains("<title>Troupe</title>");
            assertThat(get(port, "/", "127.0.0.1:" + port)).startsWith("HTTP/1.1 200");
            for (String host : List.of("evil.example:" + port, "localhost", "localhost:1", "127.0.0.1.evil.example")) {
                assertThat(get(port, "/", host)).as(host).startsWith("HTTP/1.1 403");
                assertThat(get(port, "/stream", host)).as(host).startsWith("HTTP/1.1 403");
            }
            for (String path : List.of(
                    "/page.js",
                    "/../pom.xml",
                    "/%2e%2e/%2e%2e/etc/passwd",
                    "//etc/passwd",
                    "/stream/x",
                    "/page.html")) {
                assertThat(get(port, path, "localhost:" + port)).as(path).startsWith("HTTP/1.1 404");
            }
            for (String origin :
                    List.of("", "http://evil.example", "null", "http://localhost", "https://localhost:" + port)) {
                assertThat(post(port, "/command", origin, "pause")).as(origin).startsWith("HTTP/1.1 403");
                assertThat(post(port, "/select", origin, "x 1")).as(origin).startsWith("HTTP/1.1 403");
            }
        }
    }

    @Test
    void page_allowsNothingFromElsewhere() throws Exception {
        try (var page = page()) {
            String answer = get(page.port(), "/", "localhost:" + page.port());
            assertThat(answer)
                    .contains("default-src 'none'", "script-src 'sha256-", "frame-ancestors 'none'", "no-referrer")
                    .doesNotContain("unsafe-inline", "unsafe-eval");
            assertThat(answer.replace("http://www.w3.org", "")).doesNotContain("src=\"http", "href=\"http", "//cdn");
        }
    }

    @Test
    void pageForOtherHosts_answersOnlyWithTheToken() throws Exception {
        var settings = LiveView.Settings.defaults()
                .withAddress(InetAddress.getByName("0.0.0.0"))
                .withPort(0);
        try (var page = LiveView.open(settings)) {
            int port = page.port();
            assertThat(page.address()).matches("http://localhost:" + port + "/\\?t=[0-9a-f]{32}");
            String token = page.address().replaceAll(".*t=", "");
            assertThat(get(port, "/", "robot.local:" + port))
                    .startsWith("HTTP/1.1 403")
                    .contains("token");
            assertThat(get(port, "/?t=" + token.substring(1), "robot.local:" + port))
                    .startsWith("HTTP/1.1 403");
            assertThat(get(port, "/stream", "robot.local:" + port)).startsWith("HTTP/1.1 403");
            assertThat(get(port, "/?t=" + token, "robot.local:" + port)).startsWith("HTTP/1.1 200");
        }
    }

    @Test
    void commandThatMakesNoSense_isAnsweredWithTheReason() throws Exception {
        try (var page = page()) {
            int port = page.port();
            String origin = "http://localhost:" + port;
            assertThat(post(port, "/command", origin, "pause"))
                    .startsWith("HTTP/1.1 400")
                    .contains("no world yet");
            var control = new RunControl(1, true);
            new ViewedRun(LiveRuns.ARENA.world(), LiveRuns.TABLE, control).onto(page);
            assertThat(post(port, "/command", origin, "pause")).startsWith("HTTP/1.1 204");
            assertThat(control.isPaused()).isTrue();
            assertThat(post(port, "/command", origin, "place 3 0 0 0"))
                    .startsWith("HTTP/1.1 400")
                    .contains("robot '3', expected a number from 1 to 2");
            assertThat(post(port, "/command", origin, "x".repeat(LiveView.MOST_COMMAND_BYTES + 1)))
                    .startsWith("HTTP/1.1 400")
                    .contains("longer than 4096 bytes");
            assertThat(post(port, "/select", origin, "nobody 1")).startsWith("HTTP/1.1 400");
            new ViewedRun(LiveRuns.ARENA.world(), LiveRuns.TABLE, control).onto(page, ViewControl.NONE);
            assertThat(post(port, "/command", origin, "pause"))
                    .startsWith("HTTP/1.1 400")
                    .contains("can only be watched");
        }
    }

    @Test
    void portThatIsTaken_isNamed() throws Exception {
        try (var page = page()) {
            assertThatThrownBy(() -> LiveView.open(LiveView.Settings.defaults().withPort(page.port())))
                    .isInstanceOf(BindException.class)
                    .hasMessageContaining(":" + page.port())
                    .hasMessageContaining("expected a free port");
        }
    }

    @Test
    void fileOfTheDefaultRun_hasTheSwitches_andIsSmall() throws Exception {
        Scenario scenario = LiveRuns.ARENA;
        SubsumptionTable table = LiveRuns.TABLE;
        var run = new RecordedRun(scenario, table, RecordedRun.Settings.defaults());
        RunResult result;
        try (var log = new RunLog(folder.resolve("run.jsonl"))) {
            var file = new ViewFile();
            var viewed = new ViewedRun(scenario.world(), table, new RunControl(0, false)).onto(file);
            result = run.run(log, viewed.listener(RecordedRun.Listener.NONE));
            Files.writeString(folder.resolve("run.html"), file.html());
        }
        assertThat(folder.resolve("run.html")).content().contains("id=\"data\"").doesNotContain("DATA");
        assertThat(Files.size(folder.resolve("run.html"))).isLessThan(1_000_000);
        assertThat(result.states()).hasSizeGreaterThan(5);
    }

    @Test
    void pose_isKeptToTheMillimetre_inTheArena() {
        var world = new ViewedWorld(LiveRuns.ARENA.world(), List.of(), List.of());
        var pose = new Pose(1.2344, -3.9996, 0);
        assertThat(world.xSteps(pose.x()) - world.xSteps(0)).isBetween(1233, 1235);
        assertThat(world.ySteps(pose.y()) - world.ySteps(0)).isBetween(-4001, -3999);
        assertThat(world.xSteps(1e9)).isEqualTo(0xFFFF);
    }

    @Test
    void frame_hasTheObstaclesThatAreNotWhereTheyBegan() {
        List<Snapshot> pushed = PushedBox.run();
        var world = new ViewedWorld(PushedBox.WORLD, List.of(), List.of());
        byte[] start = message(world, pushed.getFirst(), false);
        assertThat(start).as("head, time and counts, one robot").hasSize(5 + 20 + 8);
        Pose box = pushed.getLast().moved().getFirst();
        ByteBuffer end =
                ByteBuffer.wrap(message(world, pushed.getLast(), false)).order(ByteOrder.LITTLE_ENDIAN);
        assertThat(end.capacity()).isEqualTo(start.length + 2 + 8);
        assertThat(end.getInt(1)).as("length of the content").isEqualTo(20 + 8 + 2 + 8);
        end.position(start.length);
        assertThat(List.of(end.getShort(), end.getShort())).as("one, the first").containsExactly((short) 1, (short) 0);
        assertThat(end.getShort() & 0xFFFF).isEqualTo(world.xSteps(box.x()));
        assertThat(end.getShort() & 0xFFFF).isEqualTo(world.ySteps(box.y()));
        assertThat((double) end.getShort()).isEqualTo(box.headingRad() * 1e4, within(0.5));
        assertThat(message(world, pushed.getLast(), true)).as("for trails").hasSize(start.length);
    }

    @Test
    void frame_hasWhatWasTakenOut_orPutElsewhere() {
        WorldSpec arena = LiveRuns.ARENA.world();
        try (var world = World.create(arena, WorldSettings.defaults())) {
            world.removeObstacle(1);
            world.placeObstacle(0, new Pose(20, 0, 1.5 * Math.PI));
            var viewed = new ViewedWorld(arena, List.of(), List.of());
            assertThat(viewed.displaced(world.advance()))
                    .containsExactly(
                            new ViewedWorld.Displaced(0, viewed.xSteps(20), viewed.ySteps(0), -15708),
                            new ViewedWorld.Displaced(1, 0, 0, ViewedWorld.Displaced.TAKEN_OUT));
        }
    }

    private static byte[] message(ViewedWorld world, Snapshot snapshot, boolean past) {
        return ViewMessages.frame(world, new ViewFrame(0, snapshot, new short[] {0}, 0), past);
    }

    @Test
    void sensorsOfALaser_areWhereItIs_inTheFrameOfTheRobot() {
        var mount = new Pose(0.25, -0.125, 0.5);
        var sensor = new RangeSensorSpec(mount, 0, 8, Math.PI, 181, 0.1, 0.1, RangeNoise.NONE);
        var laser = new RangerSpec(RangerSpec.Kind.LASER, mount, 0.1, 0.1, List.of(sensor));
        var arena = LiveRuns.ARENA.world();
        var robots = arena.robots().stream()
                .map(robot -> robot.withRangers(List.of(laser)))
                .toList();
        var world = new WorldSpec(arena.name(), arena.file(), arena.intervalMillis(), robots, arena.obstacles());
        assertThat(new ViewedWorld(world, List.of(), List.of()).json())
                .contains("\"sensors\":[{\"mount\":[0.25,-0.125,0.5],\"samples\":181,");
    }

    @Test
    void devices_areTheseBytes() {
        var plain = new RobotReading(
                new Pose(0, 0, 0), new Odometry(new Pose(0, 0, 0), 0, 0, false), null, null, List.of(), 1);
        List<DeviceReading> devices = List.of(
                new DeviceReading.Unknown(),
                new DeviceReading.Fiducials(List.of(new DeviceReading.Fiducial(7, 1.5, -0.25, 0.1))),
                new DeviceReading.Pressed(List.of(true, false)),
                new DeviceReading.Grip(DeviceReading.Paddles.CLOSING, true, false, true),
                new DeviceReading.Picture(2, List.of(new DeviceReading.Column(0xFF8000, 0, 2))));
        var equipped = new RobotReading(
                plain.pose(),
                plain.odometry(),
                null,
                null,
                List.of(List.of(1.0), List.of(2.0, 3.0)),
                List.of(List.of(), List.of(0.0, 1.0)),
                devices,
                1);
        var held = new TreeMap<>(Map.of(2, 0, 4, 1));
        var snapshot = new Snapshot(
                3,
                300_000,
                List.of(plain, equipped),
                List.of(),
                List.of(),
                List.of(),
                new TreeMap<>(),
                List.of(),
                held);
        var frame = new ViewFrame(42, snapshot, new short[2], 0);
        assertThat(HexFormat.of().formatHex(ViewMessages.devices(frame, List.of(0, 1, 5))))
                .as("the robot without devices, and one that is not in the world, are left out")
                .isEqualTo("09" + "57000000" + "2a000000" + "0100" // type, length, number of the frame, robots
                        + "0100" + "0500" + "0300" + "0100" // robot, devices, intensities, held things
                        + "00" + "00000000" // unknown
                        + "01" + "10000000" + "0100" + "07000000" + "0000c03f" + "000080be" + "e803" // a marker
                        + "02" + "04000000" + "0200" + "01" + "00" // bumpers
                        + "03" + "02000000" + "03" + "05" // gripper: closing, outer beam, holds
                        + "04" + "0c000000" + "0200" + "0100" + "0080ff00" + "0000" + "0200" // a column
                        + "0000c07f" + "00000000" + "0000803f" // not measured, 0, 1
                        + "0400"); // the thing that it holds
        assertThat(ViewMessages.devices(frame, List.of(0)))
                .as("nothing of robots without devices")
                .isEmpty();
    }

    @Test
    void worldsDescription_hasTheDevices_ofRobotsThatHaveSome() {
        assertThat(new ViewedWorld(LiveRuns.ARENA.world(), List.of(), List.of()).json())
                .doesNotContain("devices");
        String json = new ViewedWorld(DeviceRoom.WORLD, List.of(), List.of()).json();
        assertThat(json)
                .contains("\"devices\":[{\"interface\":\"bumper\",\"parts\":[{\"mount\":[0.2,0,0],\"length\":0.4},"
                        + "{\"mount\":[-0.2,0,3.1416],\"length\":0.4}]},{\"interface\":\"fiducial\",\"mount\":[0,0,0]},"
                        + "{\"interface\":\"gripper\",\"mount\":[0.24,0,0],\"length\":0.2,\"width\":0.3,")
                .contains("\"devices\":[{\"interface\":\"fiducial\",\"mount\":[0,0,0]}]");
    }
}
