package io.troupe.view.tools;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Recording;
import io.troupe.sim.Snapshot;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.device.DeviceReading;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.CrowdWorld;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.view.DeviceRoom;
import io.troupe.view.PushedBox;
import io.troupe.view.RecordedRun;
import java.awt.image.BufferedImage;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Base64;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import javax.imageio.ImageIO;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

@Timeout(180)
class RunExportTest {
    private static final Path ARENA = Path.of("..", "demo", "worlds", "paper-arena.world");
    private static final Path PYTHON_READER = Path.of("..", "docs", "examples", "python", "mcap_summary.py");
    /** In the room: at (-1, 2), to the west. */
    private static final String POSE =
            "{\"t\":1.5,\"type\":\"pose\",\"robot\":1,\"x\":-1.0,\"y\":2.0,\"heading\":3.141592653589793,\"gap\":2.8,\"service\":\"avoid\"}\n";
    /** In the room: in front of the box. */
    private static final String BEFORE_THE_BOX =
            "{\"t\":2.0,\"type\":\"pose\",\"robot\":1,\"x\":1.0,\"y\":3.0,\"heading\":1.5707963267948966,\"gap\":1.7,\"service\":\"none\"}\n";

    @TempDir
    private Path folder;

    private RunExport inTheRoom(String... lines) throws IOException {
        Path run = folder.resolve("run.jsonl");
        Files.writeString(run, Room.header(Room.WORLD) + String.join("", lines));
        return new RunExport(run, Room.WORLD);
    }

    private McapFile mcap(RunExport run) throws IOException {
        Path file = folder.resolve("run.mcap");
        run.writeMcap(file);
        return new McapFile(Files.readAllBytes(file));
    }

    private static String only(McapFile file, String topic) {
        assertThat(file.texts(topic)).as(topic).hasSize(1);
        return file.texts(topic).getFirst();
    }

    @Test
    void programOfTheReadme_writesBothFormats() throws Exception {
        Scenario scenario = ScenarioReader.read(ARENA);
        var settings = RecordedRun.Settings.defaults().withSeconds(5);
        new RecordedRun(scenario, SubsumptionTable.ofThePaper(), settings).run(folder.resolve("run.jsonl"));

        var run = new RunExport(folder.resolve("run.jsonl"), scenario.world());
        run.writeMcap(folder.resolve("run.mcap"));
        run.writeCsv(folder.resolve("tables"));

        var file = new McapFile(Files.readAllBytes(folder.resolve("run.mcap")));
        assertThat(file.texts("/robot2/sonar")).hasSize(51);
        assertThat(file.metadata.get("troupe-run"))
                .containsEntry("world", "paper arena")
                .containsEntry("mode", "promise")
                .containsEntry("seconds", "5");
        assertThat(Files.readAllLines(folder.resolve("tables/poses.csv"))).hasSize(1 + 2 * 51);
        assertThat(Files.readAllLines(folder.resolve("tables/states.csv")))
                .containsExactly("time_s,state,robot,colour,services", "0.0,1,,#0000ff,wallFollower;spaceWanderer");
    }

    @Test
    void sameRun_sameFile() throws IOException {
        RunExport run = inTheRoom(POSE, BEFORE_THE_BOX);
        run.writeMcap(folder.resolve("one"));
        run.writeMcap(folder.resolve("two"));
        assertThat(folder.resolve("two")).hasSameBinaryContentAs(folder.resolve("one"));
    }

    // ---- messages

    @Test
    void poseAndTransform_areThoseOfTheRobot() throws IOException {
        McapFile file = mcap(inTheRoom(POSE));
        String time = "\"timestamp\":{\"sec\":1,\"nsec\":500000000}";
        String rotation = "{\"x\":0,\"y\":0,\"z\":1,\"w\":6.123233995736766E-17}";
        assertThat(only(file, "/robot_1/pose"))
                .isEqualTo("{" + time + ",\"frame_id\":\"world\",\"pose\":{\"position\":{\"x\":-1,\"y\":2,\"z\":0},"
                        + "\"orientation\":" + rotation + "}}");
        assertThat(only(file, "/tf"))
                .isEqualTo(
                        "{\"transforms\":[{" + time + ",\"parent_frame_id\":\"world\",\"child_frame_id\":\"robot_1\","
                                + "\"translation\":{\"x\":-1,\"y\":2,\"z\":0},\"rotation\":" + rotation + "}]}");
        assertThat(file.messages)
                .filteredOn(each -> file.channel(each).topic().equals("/tf"))
                .singleElement()
                .satisfies(message -> assertThat(message.logNanos()).isEqualTo(1_500_000_000));
        assertThat(only(file, "/robot_1/status")).isEqualTo("{" + time + ",\"service\":\"avoid\",\"gap\":2.8}");
    }

    @Test
    void sonarAndItsRays_endAtTheWalls() throws IOException {
        McapFile file = mcap(inTheRoom(POSE));
        assertThat(numbers(only(file, "/robot_1/sonar"), "\"ranges\":\\[(.*?)\\]"))
                .as("to the west wall and to the south wall, without 0.1 m to the sonar")
                .usingElementComparator(RunExportTest::about)
                .containsExactly(3.9, 6.9);
        assertThat(only(file, "/robot_1/sonar/rays"))
                .as("in the frame of the robot")
                .contains("\"frame_id\":\"robot_1\"", "\"type\":2")
                .contains("\"points\":[{\"x\":0.1,\"y\":0,\"z\":0},{\"x\":4,\"y\":0,\"z\":0},"
                        + "{\"x\":0,\"y\":0.1,\"z\":0},{\"x\":0,\"y\":7,\"z\":0}]");
    }

    @Test
    void laserScan_goesFromRightToLeft() throws IOException {
        String scan = only(mcap(inTheRoom(POSE)), "/robot_1/laser");
        assertThat(scan)
                .contains(
                        "\"frame_id\":\"robot_1\"",
                        "\"start_angle\":-1.5707963267948966,\"end_angle\":1.5707963267948966",
                        "\"intensities\":[]");
        assertThat(numbers(scan, "\"ranges\":\\[(.*?)\\]"))
                .as("north, west, south")
                .usingElementComparator(RunExportTest::about)
                .containsExactly(3.0, 4.0, 7.0);
    }

    @Test
    void blobs_areWhereTheCameraSeesThem() throws IOException {
        McapFile file = mcap(inTheRoom(POSE, BEFORE_THE_BOX));
        List<String> blobs = file.texts("/robot_1/blobs");
        assertThat(blobs.getFirst()).endsWith("\"width\":80,\"height\":60,\"blobs\":[]}");
        // the box is 1.9 m away and 0.5 m wide to each side: atan(0.5 / 1.9) = 14.7 degrees of 30 on each side
        assertThat(blobs.getLast()).contains("\"colour\":\"#ff0000\",\"left\":20,\"right\":59,");
        List<String> views = file.texts("/robot_1/blobs/view");
        assertThat(views.getFirst()).contains("\"triangles\":[]");
        assertThat(views.getLast())
                .contains("\"points\":[{\"x\":0,\"y\":0,\"z\":0},{\"x\":")
                .contains("\"color\":{\"r\":1,\"g\":0,\"b\":0,\"a\":0.5}");
    }

    @Test
    void statesAndLog_areMessages() throws IOException {
        McapFile file = mcap(inTheRoom(
                "{\"t\":0.0,\"type\":\"state\",\"state\":1,\"colour\":255,\"services\":[\"avoid\"]}\n",
                POSE,
                "{\"t\":1.75,\"type\":\"contact\",\"robot\":1,\"service\":\"avoid\",\"obstacle\":\"red box\"}\n",
                BEFORE_THE_BOX));
        assertThat(only(file, "/state"))
                .isEqualTo("{\"timestamp\":{\"sec\":0,\"nsec\":0},\"state\":1,\"robot\":0,\"colour\":\"#0000ff\","
                        + "\"services\":[\"avoid\"]}");
        assertThat(file.texts("/log"))
                .containsExactly(
                        "{\"timestamp\":{\"sec\":0,\"nsec\":0},\"level\":2,\"message\":\"state 1 begins: robot 1 avoid\","
                                + "\"name\":\"run\",\"file\":\"\",\"line\":0}",
                        "{\"timestamp\":{\"sec\":1,\"nsec\":750000000},\"level\":3,\"message\":\"touches red box\","
                                + "\"name\":\"robot 1\",\"file\":\"\",\"line\":0}");
    }

    @Test
    void scene_hasAllThings_andBodiesOutlinedByService() throws IOException {
        McapFile file = mcap(inTheRoom(
                "{\"t\":0.0,\"type\":\"state\",\"state\":1,\"colour\":255,\"services\":[\"avoid\"]}\n",
                POSE,
                BEFORE_THE_BOX));
        assertThat(only(file, "/world"))
                .contains("\"id\":\"0 north\"", "\"id\":\"3 west\"", "\"id\":\"4 red box\"")
                .contains("\"position\":{\"x\":1,\"y\":4.95,\"z\":0}", "{\"x\":0.5,\"y\":-0.05,\"z\":0}")
                .contains("\"color\":{\"r\":1,\"g\":0,\"b\":0,\"a\":1}");
        assertThat(file.texts("/robots"))
                .as("once for each service")
                .hasSize(2)
                .allMatch(body -> body.contains("\"frame_id\":\"robot_1\"") && body.contains("\"text\":\"robot 1\""))
                .satisfiesExactly(
                        avoid -> assertThat(avoid).contains("\"color\":{\"r\":0.851,\"g\":0.373,\"b\":0.008,\"a\":1}"),
                        none -> assertThat(none).contains("\"color\":{\"r\":0.533,\"g\":0.533,\"b\":0.533,\"a\":1}"));
    }

    @Test
    void channels_haveSchemasOfWellKnownNames() throws IOException {
        McapFile file = mcap(inTheRoom(POSE));
        assertThat(file.channels.values().stream()
                        .collect(Collectors.toMap(
                                McapFile.Channel::topic,
                                channel -> file.schemas.get(channel.schema()).name())))
                .containsExactlyInAnyOrderEntriesOf(Map.ofEntries(
                        Map.entry("/tf", "foxglove.FrameTransforms"),
                        Map.entry("/world", "foxglove.SceneUpdate"),
                        Map.entry("/robots", "foxglove.SceneUpdate"),
                        Map.entry("/state", "troupe.State"),
                        Map.entry("/log", "foxglove.Log"),
                        Map.entry("/robot_1/pose", "foxglove.PoseInFrame"),
                        Map.entry("/robot_1/status", "troupe.RobotStatus"),
                        Map.entry("/robot_1/sonar", "troupe.Ranges"),
                        Map.entry("/robot_1/sonar/rays", "foxglove.SceneUpdate"),
                        Map.entry("/robot_1/laser", "foxglove.LaserScan"),
                        Map.entry("/robot_1/blobs", "troupe.Blobs"),
                        Map.entry("/robot_1/blobs/view", "foxglove.SceneUpdate")));
        assertThat(file.channels.values())
                .allMatch(channel -> channel.encoding().equals("json"));
        assertThat(file.schemas.values()).allMatch(schema -> schema.encoding().equals("jsonschema"));
    }

    @Test
    void messages_haveTheMembersThatTheirSchemasRequire() throws Exception {
        Scenario scenario = ScenarioReader.read(ARENA);
        Path run = folder.resolve("run.jsonl");
        new RecordedRun(
                        scenario,
                        SubsumptionTable.ofThePaper(),
                        RecordedRun.Settings.defaults().withSeconds(15))
                .run(run);
        McapFile file = mcap(new RunExport(run, scenario.world()));
        Set<String> seen = new HashSet<>();
        for (McapFile.Message message : file.messages) {
            var channel = file.channel(message);
            Map<String, String> members = JsonObject.read(message.data()).texts(); // fails unless this is JSON
            for (String required :
                    requiredAtTheTop(file.schemas.get(channel.schema()).data())) {
                assertThat(message.data()).as(channel.topic()).contains("\"" + required + "\":");
            }
            assertThat(members.size()).isLessThan(20);
            seen.add(channel.topic());
        }
        assertThat(seen).contains("/tf", "/robot1/blobs/view", "/log", "/world");
    }

    private static List<String> requiredAtTheTop(String schema) {
        String last = schema.substring(schema.lastIndexOf("\"required\":[") + 12, schema.lastIndexOf(']'));
        return List.of(last.replace("\"", "").split(","));
    }

    private static List<Double> numbers(String text, String pattern) {
        var matcher = Pattern.compile(pattern).matcher(text);
        assertThat(matcher.find()).as(pattern + " in " + text).isTrue();
        return Pattern.compile(",")
                .splitAsStream(matcher.group(1))
                .map(Double::valueOf)
                .toList();
    }

    private static int about(double one, double other) {
        return StrictMath.abs(one - other) < 1e-9 ? 0 : Double.compare(one, other);
    }

    // ---- other runs

    @Test
    void recording_isPlayedAgain_withItsSpeeds() throws IOException {
        Path recording = folder.resolve("recording.txt");
        WorldSpec spec = ScenarioReader.read(ARENA).world();
        try (var world = World.create(spec, WorldSettings.defaults())) {
            try (var out = Files.newBufferedWriter(recording)) {
                Recording recorded = world.record(out);
                world.command(0, 0.5, 0);
                for (int tick = 0; tick < 200; tick++) {
                    world.advance();
                }
                recorded.close();
            }
        }
        var run = new RunExport(recording, spec);
        RunExport.Report report = run.writeCsv(folder);
        assertThat(report).isEqualTo(new RunExport.Report(201, 20_000_000, List.of()));
        List<String> poses = Files.readAllLines(folder.resolve("poses.csv"));
        assertThat(poses.get(1)).startsWith("0.0,1,robot1,-4.0,-2.8,1.57079").endsWith(",none,0.0,0.0,0");
        assertThat(poses.get(3)).contains(",none,0.5,0.0,0");
        assertThat(Files.readAllLines(folder.resolve("contacts.csv")))
                .as("7.3 m straight ahead is the north wall")
                .hasSize(2)
                .last()
                .asString()
                .endsWith(",1,none,north wall");
        McapFile file = mcap(run);
        assertThat(file.texts("/robot1/status").getLast()).contains("\"service\":\"none\"", "\"forward\":0.5");
        assertThat(file.texts("/robot1/status").getLast()).contains("\"stalled\":true");
        assertThat(file.metadata.get("troupe-run")).containsEntry("format", "troupe-recording");
    }

    @Test
    void crowd_hasItsTransformsAndBodies_andItsSensorsInTables() throws IOException {
        WorldSpec crowd = CrowdWorld.scenario(12, 3).world();
        Path run = folder.resolve("run.jsonl");
        try (var world = World.create(crowd, WorldSettings.defaults())) {
            Files.writeString(run, Room.log(crowd, List.of(world.latest(), world.advance())));
        }
        var export = new RunExport(run, crowd);
        McapFile file = mcap(export);
        assertThat(file.channels).hasSize(5);
        assertThat(file.texts("/tf")).hasSize(2).allMatch(text -> text.contains("\"child_frame_id\":\"robot12\""));
        export.writeCsv(folder.resolve("tables"));
        assertThat(Files.readAllLines(folder.resolve("tables/ranges.csv"))).hasSize(1 + 2 * 12);
        Path chosen = folder.resolve("chosen.mcap");
        export.writeMcap(chosen, Set.of(10, 2));
        McapFile two = new McapFile(Files.readAllBytes(chosen));
        assertThat(two.texts("/robot11/sonar")).hasSize(2);
        assertThat(two.texts("/robot3/blobs")).hasSize(2);
        assertThat(two.channels.values())
                .extracting(Object::toString)
                .noneMatch(channel -> channel.contains("/robot12/"));
        assertThatThrownBy(() -> export.writeMcap(chosen, Set.of(12))).isInstanceOf(IndexOutOfBoundsException.class);
    }

    @Test
    void obstaclesThatMove_comeOrGo_areEntitiesWhereTheyAre() throws IOException {
        List<Snapshot> pushed = PushedBox.run();
        McapFile file = mcap(new RunExport(recorded(PushedBox.WORLD, pushed), PushedBox.WORLD));
        List<String> scenes = file.texts("/world");
        assertThat(scenes.getFirst()).contains("\"id\":\"0 box\"", "\"id\":\"1 wall\"");
        long still = pushed.stream()
                .filter(each -> each.displaced(PushedBox.WORLD).isEmpty())
                .count();
        assertThat(still).isGreaterThan(5);
        assertThat(scenes).as("nothing while nothing moves").hasSizeLessThanOrEqualTo((int) (1 + 61 - still));
        Pose end = pushed.getLast().moved().getFirst();
        assertThat(scenes.getLast())
                .contains("\"id\":\"0 box\"", "\"position\":{\"x\":" + end.x() + ",\"y\":" + number(end.y()))
                .doesNotContain("wall");

        List<Snapshot> changed = new ArrayList<>();
        try (var world = World.create(Room.WORLD, WorldSettings.defaults())) {
            changed.add(world.advance());
            world.removeObstacle(4);
            changed.add(world.advance());
            world.placeObstacle(4, new Pose(-3, 0.5, 0));
            changed.add(world.advance());
        }
        List<String> rooms =
                mcap(new RunExport(recorded(Room.WORLD, changed), Room.WORLD)).texts("/world");
        assertThat(rooms).hasSize(3);
        assertThat(rooms.get(1))
                .contains("\"type\":0,\"id\":\"4 red box\"}],\"entities\":[]")
                .contains("{\"sec\":0,\"nsec\":200000000}");
        assertThat(rooms.get(2)).contains("\"deletions\":[]", "\"id\":\"4 red box\"", "{\"x\":-3,\"y\":0.5,\"z\":0}");
    }

    // ---- further devices

    private RunExport ofTheDevices() throws IOException {
        return new RunExport(recorded(DeviceRoom.WORLD, DeviceRoom.run()), DeviceRoom.WORLD);
    }

    @Test
    void devices_haveChannels_onTheRobotsThatHaveThem() throws IOException {
        McapFile file = mcap(ofTheDevices());
        assertThat(file.channels.values().stream()
                        .filter(channel -> channel.topic().matches(".*/(fiducial|bumper|gripper|camera).*"))
                        .collect(Collectors.toMap(
                                McapFile.Channel::topic,
                                channel -> file.schemas.get(channel.schema()).name())))
                .containsExactlyInAnyOrderEntriesOf(Map.of(
                        "/collector/bumper", "troupe.Bumpers",
                        "/collector/bumper/view", "foxglove.SceneUpdate",
                        "/collector/fiducial", "troupe.Fiducials",
                        "/collector/fiducial/view", "foxglove.SceneUpdate",
                        "/collector/gripper", "troupe.Gripper",
                        "/collector/camera", "foxglove.CompressedImage",
                        "/watcher/fiducial", "troupe.Fiducials",
                        "/watcher/fiducial/view", "foxglove.SceneUpdate"));
        assertThat(file.texts("/collector/camera")).hasSize(96);
        assertThat(file.schemas.values())
                .filteredOn(schema -> schema.name().equals("foxglove.CompressedImage"))
                .singleElement()
                .satisfies(schema -> assertThat(schema.data())
                        .contains("\"data\":{\"type\":\"string\",\"contentEncoding\":\"base64\"}")
                        .endsWith("\"required\":[\"timestamp\",\"frame_id\",\"data\",\"format\"]}"));
    }

    @Test
    void markersBumpersAndGripper_areMessages() throws IOException {
        McapFile file = mcap(ofTheDevices());
        assertThat(file.texts("/watcher/fiducial").getFirst())
                .as("at 120 degrees to the right; the numbers of those 2 m away and more cannot be read")
                .startsWith("{\"timestamp\":{\"sec\":0,\"nsec\":0},\"markers\":[{\"id\":0,\"x\":2.0")
                .contains("\"heading\":2.443", "\"id\":0,\"x\":2.2");
        // the thing is at (0.25, 0.09), 0.2657 m from the robot, whose heading is 20 degrees; the lamp at (2, -0.8)
        assertThat(numbers(file.texts("/collector/fiducial").getFirst(), "\"id\":(7),\"x\":.*\"id\":17"))
                .hasSize(1);
        assertThat(numbers(file.texts("/collector/fiducial").getFirst(), "\"id\":17,\"x\":([^,]*),\"y\""))
                .usingElementComparator(RunExportTest::about)
                .containsExactly(2 * Math.cos(Math.PI / 9) - 0.8 * Math.sin(Math.PI / 9));
        assertThat(file.texts("/collector/fiducial/view").getFirst())
                .contains(
                        "\"id\":\"collector fiducial\"",
                        "\"type\":2",
                        "\"points\":[{\"x\":0,\"y\":0,\"z\":0},{\"x\":0.266,")
                .contains("\"text\":\"7\"", "\"text\":\"17\"");
        assertThat(file.texts("/collector/bumper").getFirst())
                .isEqualTo("{\"timestamp\":{\"sec\":0,\"nsec\":0},\"pressed\":[true,false]}");
        assertThat(file.texts("/collector/bumper").getLast()).endsWith("\"pressed\":[false,true]}");
        String pressed = "\"color\":{\"r\":0.776,\"g\":0.157,\"b\":0.157,\"a\":1}";
        assertThat(file.texts("/collector/bumper/view").getFirst()).containsOnlyOnce(pressed);
        assertThat(file.texts("/collector/bumper/view").get(40)).doesNotContain(pressed);
        assertThat(file.texts("/collector/gripper").getFirst())
                .isEqualTo("{\"timestamp\":{\"sec\":0,\"nsec\":0},\"paddles\":\"open\",\"outerBeam\":false,"
                        + "\"innerBeam\":false,\"holds\":false}");
        assertThat(file.texts("/collector/gripper").get(40))
                .endsWith("\"paddles\":\"closed\",\"outerBeam\":true,\"innerBeam\":true,\"holds\":true}");
        assertThat(file.texts("/collector/laser").getFirst())
                .as("the lamp is bright")
                .containsPattern("\"intensities\":\\[(0,)+1,(1,)*(0,)+0\\]\\}");
    }

    @Test
    void imagesOfACamera_arePngs_withItsPixels() throws IOException {
        List<Snapshot> snapshots = DeviceRoom.run();
        List<String> images = mcap(ofTheDevices()).texts("/collector/camera");
        for (int tick : new int[] {0, 40, 95}) {
            String message = images.get(tick);
            assertThat(message)
                    .contains("\"frame_id\":\"collector\",\"data\":\"")
                    .endsWith("\",\"format\":\"png\"}");
            String data = message.replaceAll(".*\"data\":\"|\".*", "");
            BufferedImage image =
                    ImageIO.read(new ByteArrayInputStream(Base64.getDecoder().decode(data)));
            var picture = (DeviceReading.Picture)
                    snapshots.get(tick).robots().getFirst().devices().getLast();
            assertThat(List.of(image.getWidth(), image.getHeight())).containsExactly(40, 30);
            Set<Integer> colours = new HashSet<>();
            for (int x = 0; x < 40; x++) {
                for (int y = 0; y < 30; y++) {
                    assertThat(image.getRGB(x, y) & 0xFFFFFF)
                            .as("tick %d, %d, %d", tick, x, y)
                            .isEqualTo(picture.colour(x, y));
                    colours.add(picture.colour(x, y));
                }
            }
            assertThat(colours).hasSizeGreaterThan(2);
        }
    }

    @Test
    void messagesOfDevices_haveTheMembersThatTheirSchemasRequire() throws Exception {
        McapFile file = mcap(ofTheDevices());
        for (McapFile.Message message : file.messages) {
            var channel = file.channel(message);
            JsonObject.read(message.data());
            for (String required :
                    requiredAtTheTop(file.schemas.get(channel.schema()).data())) {
                assertThat(message.data()).as(channel.topic()).contains("\"" + required + "\":");
            }
        }
    }

    @Test
    void unknownGripper_hasNoMessagesAndNoRows() throws IOException {
        Path log = recorded(DeviceRoom.WORLD, DeviceRoom.run());
        Files.write(
                log,
                Files.readAllLines(log).stream()
                        .filter(line -> !line.contains("\"gripper\","))
                        .toList());
        var run = new RunExport(log, DeviceRoom.WORLD);
        assertThat(mcap(run).texts("/collector/gripper")).isEmpty();
        run.writeCsv(folder.resolve("deep/tables"));
        assertThat(table("grippers")).hasSize(1);
    }

    @Test
    void tablesOfDevices_haveTheirReadings_andOnlyWhereThereAreSuchDevices() throws IOException {
        ofTheDevices().writeCsv(folder.resolve("deep/tables"));
        assertThat(table("bumpers"))
                .hasSize(1 + 96)
                .startsWith("time_s,robot,device,bumper_1,bumper_2", "0.0,1,bumper,1,0")
                .endsWith("9.5,1,bumper,0,1");
        assertThat(table("grippers"))
                .hasSize(1 + 96)
                .startsWith("time_s,robot,device,paddles,outer_beam,inner_beam,holds", "0.0,1,gripper,open,0,0,0")
                .contains("4.0,1,gripper,closed,1,1,1");
        assertThat(table("fiducials"))
                .startsWith("time_s,robot,device,id,x_m,y_m,heading_rad")
                .anyMatch(line -> line.startsWith("0.0,1,fiducial,17,1.605"))
                .anyMatch(line -> line.startsWith("0.0,2,fiducial,0,"));
        assertThat(table("intensities"))
                .hasSize(1 + 2 * 96)
                .satisfies(lines -> assertThat(lines.getFirst())
                        .startsWith("time_s,robot,device,intensity_1,intensity_2,")
                        .endsWith(",intensity_19"))
                .satisfies(lines -> assertThat(lines.get(1)).matches("0.0,1,laser,(0.0,)+1.0,((1|0).0,)+0.0"))
                .satisfies(lines -> assertThat(lines.get(2)).matches("0.0,2,laser(,0.0){5},{14}"));

        inTheRoom(POSE).writeCsv(folder.resolve("deep/tables"));
        try (var files = Files.list(folder.resolve("deep/tables"))) {
            assertThat(files.map(each -> each.getFileName().toString()))
                    .containsExactlyInAnyOrder(
                            "poses.csv", "ranges.csv", "blobs.csv", "states.csv", "contacts.csv", "log.csv");
        }
    }

    @Test
    void intensitiesThatWereAskedFor_areInTheTablesOfARecording() throws IOException {
        Path recording = folder.resolve("recording.txt");
        try (var world = World.create(Room.WORLD, WorldSettings.defaults());
                var out = Files.newBufferedWriter(recording)) {
            Recording recorded = world.record(out);
            world.advance();
            world.measureIntensities(0, 0, true);
            world.advance(2);
            recorded.close();
        }
        new RunExport(recording, Room.WORLD).writeCsv(folder.resolve("deep/tables"));
        assertThat(table("intensities"))
                .containsExactly(
                        "time_s,robot,device,intensity_1,intensity_2,intensity_3",
                        "0.2,1,laser,0.0,0.0,0.0",
                        "0.3,1,laser,0.0,0.0,0.0");
    }

    @Test
    void brokenRunOfDevices_leavesNoTable_andOthersAlone() throws IOException {
        Path log = recorded(DeviceRoom.WORLD, DeviceRoom.run());
        Files.writeString(log, Files.readString(log) + "{\"t\":0.0}\n{}\n");
        Files.createDirectories(folder.resolve("deep/tables"));
        Files.writeString(folder.resolve("deep/tables/notes.csv"), "mine");
        var run = new RunExport(log, DeviceRoom.WORLD);
        assertThatThrownBy(() -> run.writeCsv(folder.resolve("deep/tables"))).isInstanceOf(RunFileException.class);
        try (var files = Files.list(folder.resolve("deep/tables"))) {
            assertThat(files.map(each -> each.getFileName().toString())).containsExactly("notes.csv");
        }
    }

    private static String number(double value) {
        return value == Math.rint(value) ? "" + (long) value : "" + value;
    }

    /** The log of a run without services. */
    private Path recorded(WorldSpec world, List<Snapshot> snapshots) throws IOException {
        return Room.recorded(folder.resolve("recorded.jsonl"), world, snapshots);
    }

    // ---- tables

    @Test
    void tables_haveTheNumbersOfTheRun() throws IOException {
        RunExport.Report report = inTheRoom(
                        POSE,
                        "{\"t\":1.75,\"type\":\"charge\",\"robot\":1,\"services\":[\"a \\\"b\\\"\",\"c\"]}\n",
                        BEFORE_THE_BOX,
                        "{\"t\":2.0,\"type\":\"summary\"}\n")
                .writeCsv(folder.resolve("deep/tables"));
        assertThat(report).isEqualTo(new RunExport.Report(2, 2_000_000, List.of()));
        assertThat(table("poses"))
                .containsExactly(
                        "time_s,robot,name,x_m,y_m,heading_rad,gap_m,service,forward_mps,turn_radps,stalled",
                        "1.5,1,robot 1,-1.0,2.0,3.141592653589793,2.8,avoid,,,",
                        "2.0,1,robot 1,1.0,3.0,1.5707963267948966,1.7,none,,,");
        assertThat(table("ranges"))
                .hasSize(5)
                .startsWith("time_s,robot,device,range_1_m,range_2_m,range_3_m")
                .satisfies(lines -> assertThat(lines.get(1)).matches("1\\.5,1,sonar,3\\.[89]\\d*,6\\.[89]\\d*,"))
                .satisfies(lines ->
                        assertThat(lines.get(2)).matches("1\\.5,1,laser,[23]\\.[\\d]*,[34]\\.[\\d]*,[67]\\.\\d*"));
        assertThat(table("blobs")).hasSize(2).last().asString().startsWith("2.0,1,#ff0000,20,59,");
        assertThat(table("log"))
                .contains("1.75,warning,robot 1,\"several control it: a \"\"b\"\", c\"", "2.0,info,run,the run ends");
    }

    private List<String> table(String name) throws IOException {
        return Files.readAllLines(folder.resolve("deep/tables/" + name + ".csv"));
    }

    // ---- errors

    @Test
    void badRun_leavesNoFile_andAnOlderOneAlone() throws IOException {
        Path file = folder.resolve("run.mcap");
        Files.writeString(file, "older");
        RunExport wrongWorld =
                new RunExport(inTheRoomFile(), ScenarioReader.read(ARENA).world());
        assertThatThrownBy(() -> wrongWorld.writeMcap(file)).isInstanceOf(RunFileException.class);
        assertThat(file).hasContent("older");

        RunExport broken = inTheRoom(POSE, "{\"t\":1.0}\n", POSE);
        assertThatThrownBy(() -> broken.writeMcap(folder.resolve("new.mcap")))
                .hasMessageContaining("run.jsonl:3:1: 't' is 1.0, expected 1.5 or more");
        assertThat(folder.resolve("new.mcap")).doesNotExist();
        assertThatThrownBy(() -> broken.writeCsv(folder.resolve("tables"))).isInstanceOf(RunFileException.class);
        assertThat(folder.resolve("tables")).isEmptyDirectory();
    }

    private Path inTheRoomFile() throws IOException {
        inTheRoom(POSE);
        return folder.resolve("run.jsonl");
    }

    @Test
    void damagedRecording_isAnErrorThatNamesTheFile() throws IOException {
        Path recording = folder.resolve("recording.txt");
        Files.writeString(recording, "troupe-recording 1\nworld room\n");
        assertThatThrownBy(() -> new RunExport(recording, Room.WORLD).writeCsv(folder))
                .isInstanceOf(RunFileException.class)
                .hasMessage(recording + ": the recording is cut off after line 2");
    }

    @Test
    void fullDisk_isAnErrorThatNamesTheFile() throws IOException {
        Path full = Path.of("/dev/full");
        assumeTrue(Files.exists(full), "there is no /dev/full here: not tested");
        RunExport run = inTheRoom(POSE);
        assertThatThrownBy(() -> run.writeMcap(full))
                .isInstanceOf(IOException.class)
                .hasMessage("/dev/full: No space left on device");
        assertThat(full).exists();
    }

    @Test
    void missingDirectory_isAnErrorThatNamesTheFile() throws IOException {
        Path file = folder.resolve("none/run.mcap");
        RunExport run = inTheRoom(POSE);
        assertThatThrownBy(() -> run.writeMcap(file))
                .isInstanceOf(IOException.class)
                .hasMessage(file.toString());
    }

    // ---- the official reader

    @Test
    void officialReaderForPython_readsTheFile_withItsChecks() throws Exception {
        String python = python();
        Scenario scenario = ScenarioReader.read(ARENA);
        Path run = folder.resolve("run.jsonl");
        new RecordedRun(
                        scenario,
                        SubsumptionTable.ofThePaper(),
                        RecordedRun.Settings.defaults().withSeconds(20))
                .run(run);
        Path file = folder.resolve("run.mcap");
        new RunExport(run, scenario.world()).writeMcap(file);
        assertThat(readBy(python, file))
                .anyMatch(line -> line.matches("\\d+ messages in \\d+ chunks, 0.0 s to 20.0 s"))
                .anyMatch(line -> line.startsWith("troupe-run {") && line.contains("\"world\": \"paper arena\""))
                .contains("   201 /tf foxglove.FrameTransforms", "   201 /robot2/blobs troupe.Blobs");
    }

    @Test
    void officialReaderForPython_readsTheFileOfTheDevices() throws Exception {
        String python = python();
        Path file = folder.resolve("run.mcap");
        ofTheDevices().writeMcap(file);
        assertThat(readBy(python, file))
                .contains(
                        "    96 /collector/camera foxglove.CompressedImage",
                        "    96 /collector/gripper troupe.Gripper",
                        "    96 /watcher/fiducial troupe.Fiducials");
    }

    /** What the reader prints. */
    private static List<String> readBy(String python, Path file) throws Exception {
        var reader = new ProcessBuilder(python, PYTHON_READER.toString(), file.toString())
                .redirectErrorStream(true)
                .start();
        String text = new String(reader.getInputStream().readAllBytes(), StandardCharsets.UTF_8);
        assertThat(reader.waitFor()).as(text).isZero();
        return text.lines().toList();
    }

    /** An interpreter with the package; skips the test, with one line that gives the reason, if there is none. */
    private static String python() throws InterruptedException {
        String python = System.getProperty("troupe.python", "python3");
        boolean hasPackage;
        try {
            hasPackage = new ProcessBuilder(python, "-c", "import mcap")
                            .redirectError(ProcessBuilder.Redirect.DISCARD)
                            .start()
                            .waitFor()
                    == 0;
        } catch (IOException none) {
            hasPackage = false;
        }
        assumeTrue(hasPackage, python + " has no mcap (pip install mcap, or -Dtroupe.python=..): not tested");
        return python;
    }
}
