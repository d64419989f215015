package io.troupe.view.tools;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.services.subsumption.SubsumptionRun;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.RobotReading;
import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.device.DeviceReading;
import io.troupe.sim.device.GripperDevice;
import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.tools.Thorough;
import io.troupe.view.DeviceRoom;
import io.troupe.view.PushedBox;
import io.troupe.view.RecordedRun;
import io.troupe.view.RunLog;
import io.troupe.view.RunRecorder;
import io.troupe.view.tools.RunListener.Level;
import io.troupe.view.tools.RunListener.Remark;
import io.troupe.view.tools.RunListener.StateBegins;
import io.troupe.view.tools.RunListener.Touch;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

@Timeout(120)
class RunLogReaderTest {
    private static final String STATE =
            "{\"t\":0.0,\"type\":\"state\",\"state\":1,\"colour\":255,\"services\":[\"avoid\"]}\n";
    private static final String POSE =
            "{\"t\":0.0,\"type\":\"pose\",\"robot\":1,\"x\":1.0,\"y\":2.0,\"heading\":0.0,\"gap\":2.7,\"service\":\"avoid\"}\n";

    @TempDir
    private Path folder;

    /** Keeps what it receives. */
    private static final class Collector implements RunListener {
        final Map<String, String> header = new LinkedHashMap<>();
        final List<Reading> readings = new ArrayList<>();
        final List<Event> events = new ArrayList<>();

        @Override
        public void begin(Map<String, String> all) {
            header.putAll(all);
        }

        @Override
        public void read(Reading reading) {
            readings.add(reading);
        }

        @Override
        public void happened(Event event) {
            events.add(event);
        }
    }

    private final Collector collector = new Collector();

    private List<String> read(String text, WorldSpec world) throws IOException {
        Path file = folder.resolve("run.jsonl");
        Files.writeString(file, text);
        return new RunLogReader(file, world, collector).read();
    }

    @Test
    void readingsOfARun_areThoseThatTheRobotsHad_bitForBit() throws Exception {
        Scenario scenario = ScenarioReader.read(Path.of("..", "demo", "worlds", "paper-arena.world"));
        SubsumptionTable table = SubsumptionTable.ofThePaper();
        Path file = folder.resolve("run.jsonl");
        List<Snapshot> snapshots = new ArrayList<>();
        Map<Long, ColouredBox> boxes = Map.of(
                10_000_000L, new ColouredBox(1, 0xFFFF00, 3, 0),
                20_000_000L, new ColouredBox(2, 0x00FFFF, -5, -3.5),
                25_000_000L, new ColouredBox(1, 0xFFFF00, 2, 3));
        try (var simulation = Simulation.open(scenario, WorldSettings.defaults());
                var log = new RunLog(file)) {
            log.begin(scenario.world(), RecordedRun.Settings.defaults());
            var recorder = new RunRecorder(scenario.world(), table, log, change -> {});
            var robots = RobotServicesActor.Settings.defaults().withTable(table).withObserver(recorder);
            var settings = SubsumptionRun.Settings.defaults()
                    .withMode(Mode.PROMISE)
                    .withRobots(robots)
                    .withClock(simulation.clock())
                    .withListener(recorder);
            try (var running = SubsumptionRun.start(settings)) {
                recorder.start(simulation.latest());
                snapshots.add(simulation.latest());
                while (simulation.timeMicros() < 60_000_000) {
                    ColouredBox box = boxes.get(simulation.timeMicros());
                    if (box != null) {
                        simulation.putBox(box);
                        recorder.intervened("box " + box.words());
                    } else if (simulation.timeMicros() == 40_000_000) {
                        simulation.removeBox(1);
                        recorder.intervened("unbox 1");
                    }
                    snapshots.add(simulation.tick());
                    running.check();
                    recorder.record(snapshots.getLast());
                }
            }
            recorder.finish(false);
        }
        assertThat(new RunLogReader(file, scenario.world(), collector).read()).isEmpty();
        assertSameReadings(snapshots);
        assertThat(snapshots)
                .as("a robot has seen a blob")
                .anyMatch(each -> each.robots().stream()
                        .anyMatch(robot -> !robot.blobs().blobs().isEmpty()));
        assertThat(collector.readings)
                .as("readings with one, two and no box")
                .extracting(each -> each.snapshot().boxes().size())
                .contains(0, 1, 2);
        assertThat(collector.readings.getFirst().services()).containsExactly("wallFollower", "spaceWanderer");
        assertThat(collector.header).containsEntry("world", "paper arena").containsEntry("seed", "1");
        assertThat(collector.events)
                .contains(new StateBegins(0, 1, 0, 0x0000ff, List.of("wallFollower", "spaceWanderer")));
    }

    private void assertSameReadings(List<Snapshot> snapshots) {
        assertThat(collector.readings).hasSameSizeAs(snapshots);
        for (int i = 0; i < snapshots.size(); i++) {
            Snapshot read = collector.readings.get(i).snapshot();
            assertThat(read.timeMicros()).isEqualTo(snapshots.get(i).timeMicros());
            assertThat(read.boxes()).isEqualTo(snapshots.get(i).boxes());
            for (int robot = 0; robot < read.robots().size(); robot++) {
                RobotReading had = snapshots.get(i).robots().get(robot);
                RobotReading computed = read.robots().get(robot);
                assertThat(List.of(computed.pose(), computed.rangersM(), computed.wallGapM()))
                        .as("robot %d at tick %d", robot, i)
                        .isEqualTo(List.of(had.pose(), had.rangersM(), had.wallGapM()));
                assertThat(computed.sonarM()).isEqualTo(had.sonarM());
                assertThat(computed.blobs()).isEqualTo(had.blobs());
                assertThat(computed.intensities()).isEqualTo(had.intensities());
                assertThat(computed.devices())
                        .as("devices of robot %d at tick %d", robot, i)
                        .isEqualTo(had.devices());
            }
        }
    }

    @ParameterizedTest
    @ValueSource(strings = {"office.world", "cave.world", "track.world"})
    void readingsOfMovingRobots_withLasers_areTheirs(String name) throws IOException {
        WorldSpec spec =
                ScenarioReader.read(Path.of("..", "demo", "worlds", name)).world();
        List<Snapshot> snapshots = new ArrayList<>();
        try (var world = World.create(spec, WorldSettings.defaults())) {
            snapshots.add(world.latest());
            for (int robot = 0; robot < spec.robots().size(); robot++) {
                world.command(robot, 0.3, 0.4 - 0.1 * robot);
            }
            for (int tick = 0; tick < 30; tick++) {
                snapshots.add(world.advance());
            }
        }
        assertThat(read(Room.log(spec, snapshots), spec)).isEmpty();
        assertSameReadings(snapshots);
    }

    @Test
    void readingsWhileABoxIsPushed_areTheirs() throws IOException {
        List<Snapshot> pushed = PushedBox.run();
        assertThat(read(recorded(PushedBox.WORLD, pushed), PushedBox.WORLD)).hasSize(1);
        assertSameReadings(pushed);
        assertThat(collector.readings)
                .extracting(each -> each.snapshot().moved())
                .isEqualTo(pushed.stream().map(Snapshot::moved).toList());
        assertThat(pushed.getLast().moved().getFirst().x()).isGreaterThan(1.5);
    }

    @Test
    void readingsWhileAGripperCarriesABox_areTheirs() throws IOException {
        WorldSpec spec = ScenarioReader.readText("""
                name "crane"
                interval_sim 100
                model ( name "wall" color "black" pose [ 4 0 0 0 ] size [ 0.2 8 0.5 ] )
                model ( name "box" color "red" pose [ 0.35 0.02 0 0 ] size [ 0.1 0.1 0.2 ] gripper_return 1 )
                position
                (
                  name "crane" size [ 0.4 0.4 0.2 ]
                  gripper ( pose [ 0.3 0 0 0 ] size [ 0.2 0.3 0.2 ] )
                  ranger ( scount 1 spose[0] [ 0 0 0 ] )
                )
                position
                (
                  name "watcher" pose [ 1 2 0 -120 ] size [ 0.4 0.4 0.2 ]
                  ranger ( scount 1 spose[0] [ 0.2 0 0 ] )
                  blobfinder ( image [ 80 60 ] range 4 fov 60 colors_count 1 colors [ "red" ] )
                )
                """, Path.of("crane.world")).world();
        List<Snapshot> snapshots = new ArrayList<>();
        try (var world = World.create(spec, WorldSettings.defaults())) {
            snapshots.add(world.latest());
            world.grip(0, 0, GripperDevice.Order.CLOSE);
            for (int tick = 0; tick < 70; tick++) {
                switch (tick) {
                    case 30 -> world.command(0, 0.3, 0.2);
                    case 55 -> world.grip(0, 0, GripperDevice.Order.OPEN);
                    case 60 -> world.command(0, -0.3, 0);
                    default -> {}
                }
                snapshots.add(world.advance());
            }
        }
        assertThat(snapshots).extracting(each -> Map.copyOf(each.held())).contains(Map.of(), Map.of(1, 0));
        String log = recorded(spec, snapshots);
        assertThat(log.lines().filter(line -> line.contains("\"obstacle\"")))
                .as("it is taken where it stands, carried, and put down")
                .first()
                .asString()
                .endsWith("\"number\":2,\"obstacle\":\"box\",\"x\":0.35,\"y\":0.02,\"heading\":0.0,\"heldBy\":1}");
        assertThat(read(log, spec)).hasSize(1);
        assertSameReadings(snapshots);
        assertThat(collector.readings)
                .extracting(each -> each.snapshot().held())
                .isEqualTo(snapshots.stream().map(Snapshot::held).toList());
    }

    @Test
    void readingsOfFurtherDevices_areTheirs_withTheStatesOfTheGripper() throws IOException {
        List<Snapshot> snapshots = DeviceRoom.run();
        String log = recorded(DeviceRoom.WORLD, snapshots);
        assertThat(read(log, DeviceRoom.WORLD)).hasSize(1);
        assertSameReadings(snapshots);
        assertThat(snapshots)
                .extracting(each -> each.robots().getFirst().devices().getFirst())
                .as("the thing is before the robot until it is gripped; at last there is a wall behind the robot")
                .contains(
                        new DeviceReading.Pressed(List.of(true, false)),
                        new DeviceReading.Pressed(List.of(false, false)),
                        new DeviceReading.Pressed(List.of(false, true)));
        assertThat(snapshots)
                .extracting(each -> each.robots().getFirst().devices().get(DeviceRoom.GRIPPER))
                .contains(
                        new DeviceReading.Grip(DeviceReading.Paddles.CLOSED, true, true, true),
                        new DeviceReading.Grip(DeviceReading.Paddles.OPENING, true, true, false));
        List<String> lines =
                log.lines().filter(line -> line.contains("\"gripper\",")).toList();
        assertThat(lines.getFirst())
                .isEqualTo("{\"t\":0.0,\"type\":\"gripper\",\"robot\":1,\"gripper\":1,\"paddles\":\"open\","
                        + "\"outerBeam\":false,\"innerBeam\":false,\"holds\":false}");
        assertThat(lines).hasSizeGreaterThan(5);
        for (int i = 1; i < lines.size(); i++) {
            String before = lines.get(i - 1);
            assertThat(lines.get(i).substring(lines.get(i).indexOf(',')))
                    .as("only changes")
                    .isNotEqualTo(before.substring(before.indexOf(',')));
        }
    }

    @Test
    void readingsAfterAGrippedThingWasTakenOutOfTheWorld_areTheirs() throws IOException {
        List<Snapshot> snapshots = new ArrayList<>();
        try (var world = World.create(DeviceRoom.WORLD, WorldSettings.defaults())) {
            for (int tick = 0; tick < 70; tick++) {
                DeviceRoom.command(world, tick);
                switch (tick) {
                    case 40 -> world.removeObstacle(0);
                    case 55 -> world.placeObstacle(0, new Pose(1.5, 0.5, 0.3));
                    default -> {}
                }
                snapshots.add(world.advance());
            }
        }
        assertThat(snapshots.get(39).held()).isEqualTo(Map.of(0, 0));
        String log = recorded(DeviceRoom.WORLD, snapshots);
        assertThat(log).contains("{\"t\":4.1,\"type\":\"obstacle\",\"number\":1,\"obstacle\":\"thing\"}\n");
        assertThat(read(log, DeviceRoom.WORLD)).hasSize(1);
        assertSameReadings(snapshots);
        assertThat(collector.readings)
                .extracting(each -> each.snapshot().displaced(DeviceRoom.WORLD))
                .isEqualTo(snapshots.stream()
                        .map(each -> each.displaced(DeviceRoom.WORLD))
                        .toList());
        assertThat(collector.readings)
                .extracting(each -> each.snapshot().moved())
                .isEqualTo(snapshots.stream().map(Snapshot::moved).toList());
    }

    @Test
    void readingsAfterAResetWhileAThingIsHeld_areTheirs() throws IOException {
        List<Snapshot> snapshots = new ArrayList<>();
        try (var world = World.create(DeviceRoom.WORLD, WorldSettings.defaults())) {
            for (int tick = 0; tick < 50; tick++) {
                DeviceRoom.command(world, tick);
                if (tick == 40) {
                    world.reset();
                }
                snapshots.add(world.advance());
            }
        }
        assertThat(snapshots.get(39).held()).isEqualTo(Map.of(0, 0));
        String log = recorded(DeviceRoom.WORLD, snapshots);
        int next = log.indexOf('\n', log.lastIndexOf("{\"t\":4.0,")) + 1;
        String reset = "{\"t\":4.0,\"type\":\"intervention\",\"what\":\"reset\"}\n";
        assertThat(read(log.substring(0, next) + reset + log.substring(next), DeviceRoom.WORLD))
                .hasSize(1);
        assertSameReadings(snapshots);
    }

    /** The log of eleven robots has one reading a second. */
    @Test
    void readingsOfACrowdWithAGripper_areTheirs() throws IOException {
        String others = IntStream.range(0, 9)
                .mapToObj(i -> "position ( name \"r" + i + "\" pose [ " + (20 + i) + " 0 0 0 ] size [ 0.4 0.4 0.2 ] )")
                .collect(Collectors.joining("\n"));
        WorldSpec crowd = ScenarioReader.readText(DeviceRoom.TEXT + others, Path.of("crowd.world"))
                .world();
        List<Snapshot> snapshots = new ArrayList<>();
        try (var world = World.create(crowd, WorldSettings.defaults())) {
            snapshots.add(world.latest());
            for (int tick = 0; tick < 90; tick++) {
                DeviceRoom.command(world, tick);
                snapshots.add(world.advance());
            }
        }
        List<Snapshot> logged =
                IntStream.rangeClosed(0, 9).mapToObj(i -> snapshots.get(10 * i)).toList();
        assertThat(logged).extracting(each -> Map.copyOf(each.held())).contains(Map.of(), Map.of(0, 0));
        assertThat(read(recorded(crowd, snapshots), crowd)).hasSize(1);
        assertSameReadings(logged);
    }

    @Test
    void gripper_withoutALine_isNotKnown() throws IOException {
        String log = recorded(DeviceRoom.WORLD, DeviceRoom.run())
                .lines()
                .filter(line -> !line.contains("\"gripper\","))
                .collect(Collectors.joining("\n"));
        read(log, DeviceRoom.WORLD);
        assertThat(collector.readings)
                .extracting(
                        each -> each.snapshot().robots().getFirst().devices().get(DeviceRoom.GRIPPER))
                .containsOnly(new DeviceReading.Unknown());
    }

    @Test
    void linesOfGrippers_thatAreWrong_areErrors() throws IOException {
        Map<String, String> wrong = Map.of(
                "\"robot\":2,\"gripper\":1",
                "gripper 1 of robot 'watcher', which has 0 grippers in devices.world: expected the world of the run, unchanged",
                "\"robot\":1,\"gripper\":2",
                "gripper 2 of robot 'collector', which has 1 gripper in devices.world: expected the world of the run, unchanged",
                "\"robot\":1,\"gripper\":1,\"paddles\":\"ajar\"",
                "'paddles' is 'ajar', expected open, closed, opening or closing",
                "\"robot\":1,\"gripper\":1,\"paddles\":\"open\",\"outerBeam\":0",
                "'outerBeam' is 0.0, expected true or false");
        wrong.forEach((members, problem) -> assertThatThrownBy(() -> read(
                        Room.header(DeviceRoom.WORLD) + "{\"t\":0.0,\"type\":\"gripper\"," + members + "}\n{}\n",
                        DeviceRoom.WORLD))
                .hasMessageEndingWith("run.jsonl:2:1: " + problem));
    }

    @Test
    void readingsWhileObstaclesComeAndGo_areTheirs() throws IOException {
        List<Snapshot> snapshots = new ArrayList<>();
        try (var world = World.create(Room.WORLD, WorldSettings.defaults())) {
            world.command(0, 0.5, 0.1);
            for (int tick = 0; tick < 40; tick++) {
                switch (tick) {
                    case 5 -> world.removeObstacle(4);
                    case 10 -> world.placeObstacle(4, new Pose(2, 4, 0.5));
                    case 20 -> world.removeObstacle(0);
                    case 30 -> world.reset();
                    default -> {}
                }
                snapshots.add(world.advance());
            }
        }
        String log = recorded(Room.WORLD, snapshots);
        assertThat(log)
                .contains("{\"t\":0.6,\"type\":\"obstacle\",\"number\":5,\"obstacle\":\"red box\"}\n")
                .contains(
                        "{\"t\":1.1,\"type\":\"obstacle\",\"number\":5,\"obstacle\":\"red box\",\"x\":2.0,\"y\":4.0,\"heading\":0.5}\n")
                .contains("{\"t\":3.1,\"type\":\"obstacle\",\"number\":1,\"obstacle\":\"north\",\"x\":0.0,\"y\":5.1,");
        assertThat(log.lines().filter(line -> line.contains("\"obstacle\""))).hasSize(5);
        assertThat(read(log, Room.WORLD)).hasSize(1);
        assertSameReadings(snapshots);
    }

    /** The log of a run without services. */
    private String recorded(WorldSpec world, List<Snapshot> snapshots) throws IOException {
        return Files.readString(Room.recorded(folder.resolve("recorded.jsonl"), world, snapshots));
    }

    @Test
    void readings_inARoom_areThoseWorkedOutByHand() throws IOException {
        String pose =
                "{\"t\":0.5,\"type\":\"pose\",\"robot\":1,\"x\":-1.0,\"y\":2.0,\"heading\":0.0,\"gap\":2.8,\"service\":\"a\"}\n";
        assertThat(read(Room.header(Room.WORLD) + pose, Room.WORLD))
                .containsExactly("the run has no end: the program was killed, or the disk was full");
        RobotReading reading = collector.readings.getFirst().snapshot().robots().getFirst();
        assertThat(reading.sonarM())
                .as("the east wall is 6 m away, 0.1 m less from the sonar; the north wall 3 m")
                .satisfiesExactly(
                        ahead -> assertThat(ahead).isEqualTo(5.9, within(1e-9)),
                        left -> assertThat(left).isEqualTo(2.9, within(1e-9)));
        assertThat(reading.rangersM().getFirst())
                .as("south, east, north")
                .satisfiesExactly(
                        south -> assertThat(south).isEqualTo(7, within(1e-9)),
                        east -> assertThat(east).isEqualTo(6, within(1e-9)),
                        north -> assertThat(north).isEqualTo(3, within(1e-9)));
        assertThat(reading.blobs().blobs()).as("the box is not in view").isEmpty();
    }

    @Test
    void everyKindOfLine_isAnEvent() throws IOException {
        WorldSpec arena = ScenarioReader.read(Path.of("..", "demo", "worlds", "paper-arena.world"))
                .world();
        String header = Room.header(arena);
        assertThat(read(header + """
                        {"t":0.0,"type":"state","state":1,"colour":255,"services":["a","b"]}
                        {"t":1.0,"type":"contact","robot":1,"service":"a","obstacle":"west wall"}
                        {"t":1.5,"type":"contact","robot":2,"service":"b","otherRobot":1}
                        {"t":2.0,"type":"state","state":2,"robot":2,"colour":65280,"services":["b","a"]}
                        {"t":2.0,"type":"charge","robot":1,"services":[]}
                        {"t":2.0,"type":"charge","robot":2,"services":["a","b"]}
                        {"t":3.0,"type":"driver","robot":1,"service":"a","node":"host-a"}
                        {"t":4.0,"type":"lost","robot":1,"service":"a","node":"host-a","why":"killed"}
                        {"t":4.0,"type":"intervention","what":"place 1 0 0 0"}
                        {"t":4.5,"type":"weather","what":"rain"}
                        {"t":5.0,"type":"summary","switches":1,"cutShort":"interrupted"}
                        """, arena))
                .containsExactly("the run ended before its time", "1 line of unknown types left out");
        assertThat(collector.events)
                .containsExactly(
                        new StateBegins(0, 1, 0, 0xff, List.of("a", "b")),
                        new Remark(0, Level.INFO, "run", "state 1 begins: robot1 a, robot2 b"),
                        new Touch(1_000_000, 1, "a", "west wall"),
                        new Remark(1_000_000, Level.WARNING, "robot1", "touches west wall"),
                        new Touch(1_500_000, 2, "b", "robot1"),
                        new Remark(1_500_000, Level.WARNING, "robot2", "touches robot1"),
                        new StateBegins(2_000_000, 2, 2, 0xff00, List.of("b", "a")),
                        new Remark(
                                2_000_000,
                                Level.INFO,
                                "run",
                                "robot2 sees #00ff00: state 2 begins: robot1 b, robot2 a"),
                        new Remark(2_000_000, Level.WARNING, "robot1", "no service controls it"),
                        new Remark(2_000_000, Level.WARNING, "robot2", "several control it: a, b"),
                        new Remark(3_000_000, Level.INFO, "robot1", "is driven by host-a with a"),
                        new Remark(4_000_000, Level.ERROR, "robot1", "has lost its driver host-a: killed"),
                        new Remark(4_000_000, Level.WARNING, "run", "changed from outside: place 1 0 0 0"),
                        new Remark(5_000_000, Level.WARNING, "run", "the run ends before its time: interrupted"));
    }

    @Test
    void runOfAKilledProgram_isReadUpToTheLastReading() throws IOException {
        String header = Room.header(Room.WORLD);
        assertThat(read(header + STATE + POSE + POSE.substring(0, 40), Room.WORLD))
                .containsExactly("the run has no end: the program was killed, or the disk was full");
        assertThat(collector.readings).hasSize(1);
        WorldSpec arena = ScenarioReader.read(Path.of("..", "demo", "worlds", "paper-arena.world"))
                .world();
        String first = Room.poses(start(arena)).lines().findFirst().orElseThrow();
        assertThat(read(Room.header(arena) + first + "\n", arena))
                .containsExactly(
                        "the run has no end: the program was killed, or the disk was full",
                        "the last reading has 1 of 2 poses and is left out");
    }

    private static Snapshot start(WorldSpec spec) {
        try (var world = World.create(spec, WorldSettings.defaults())) {
            return world.latest();
        }
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "hello | 1:1: 'h', expected a JSON object",
                "{\"t\":0.0} | 1:1: expected a header with \"format\":\"troupe-run\", as troupe run writes it",
                "{\"format\":\"troupe-run\",\"version\":2} | 1:1: the version of the run is 2, expected 1",
                "{\"format\":\"troupe-run\",\"version\":1} | 1:1: there is no 'robots', expected a whole number from 0 to 2147483647",
                "{\"format\":\"troupe-run\",\"version\":1,\"robots\":2,\"world\":\"office\"} | 1:1: the run was in world 'office' with 2 robots, but room.world is 'room' with 1 robot: expected the world of the run",
                "{\"format\":\"troupe-run\" | 1:23: the end of the line, expected ',' or '}'",
            })
    void firstLine_thatIsNoHeader_isAnError(String line, String problem) {
        assertThatThrownBy(() -> read(line + "\n", Room.WORLD))
                .isInstanceOf(RunFileException.class)
                .hasMessage(folder.resolve("run.jsonl") + ":" + problem);
        assertThat(collector.header).as("nothing has begun").isEmpty();
    }

    @Test
    void emptyFile_andBytesThatAreNoText_areErrors() throws IOException {
        assertThatThrownBy(() -> read("", Room.WORLD))
                .hasMessageEndingWith("run.jsonl:1:1: the file is empty, expected the header of a run");
        Path file = folder.resolve("bytes");
        Files.write(file, new byte[] {(byte) 0xff, (byte) 0xfe, 0, 1});
        assertThatThrownBy(() -> new RunLogReader(file, Room.WORLD, collector).read())
                .hasMessageEndingWith("bytes:1:1: this is no text, expected a run.jsonl");
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "{\"t\":0.0,\"type\":\"pose\",\"robot\":2} | 'robot' is 2.0, expected a whole number from 1 to 1",
                "{\"t\":0.0,\"type\":\"pose\",\"robot\":1} | there is no 'x', expected a number",
                "{\"t\":0.0,\"type\":\"pose\",\"robot\":1,\"x\":\"1\"} | 'x' is '1', expected a number",
                "{\"type\":\"pose\"} | there is no 't', expected a number",
                "{\"t\":-1.0,\"type\":\"pose\"} | 't' is -1.0, expected 0.0 or more, as in the line before",
                "{\"t\":0.0,\"type\":\"pose\",\"robot\":1,\"x\":-3,\"y\":0,\"heading\":0,\"gap\":1,\"service\":\"a\"} | robot 1 is 1.000 m from the nearest obstacle, but in room.world that is 1.800 m: expected the world of the run, unchanged",
                "{\"t\":0.0,\"type\":\"obstacle\",\"number\":6} | 'number' is 6.0, expected a whole number from 1 to 5",
                "{\"t\":0.0,\"type\":\"obstacle\",\"number\":1,\"x\":1} | there is no 'y', expected a number",
                "{\"t\":0.0,\"type\":\"obstacle\",\"number\":1,\"x\":1,\"y\":1,\"heading\":0,\"heldBy\":1} | a gripper holds 'north', which stands still in room.world: expected the world of the run, unchanged",
                "{\"t\":0.0,\"type\":\"state\",\"state\":1,\"colour\":255,\"services\":[1]} | 'services' is [1.0], expected a list of texts",
                "{\"t\":0.0,\"type\":\"state\",\"state\":1,\"colour\":255,\"services\":[]} | 0 services, expected one for each robot",
                "{\"t\":0.0,\"type\":\"state\",\"state\":1,\"colour\":-1,\"services\":[]} | 'colour' is -1.0, expected a whole number from 0 to 16777215",
            })
    void wrongLine_isAnErrorWithItsNumber(String line, String problem) {
        assertThatThrownBy(() -> read(Room.header(Room.WORLD) + line + "\n" + POSE, Room.WORLD))
                .isInstanceOf(RunFileException.class)
                .hasMessage(folder.resolve("run.jsonl") + ":2:1: " + problem);
    }

    @Test
    void damagedRuns_areReadOrRejectedWithTheirLine() throws IOException {
        long seed = new Random().nextLong();
        var random = new Random(seed);
        String run = Room.header(Room.WORLD) + STATE + POSE + POSE
                + "{\"t\":0.1,\"type\":\"contact\",\"robot\":1,\"service\":\"avoid\",\"obstacle\":\"north\"}\n"
                + "{\"t\":0.1,\"type\":\"summary\"}\n";
        int rejected = 0;
        for (int round = 0; round < Thorough.times(300, 3_000); round++) {
            var damaged = new StringBuilder(run);
            for (int i = random.nextInt(3); i >= 0; i--) {
                int at = random.nextInt(damaged.length());
                switch (random.nextInt(3)) {
                    case 0 -> damaged.deleteCharAt(at);
                    case 1 -> damaged.setCharAt(at, (char) (' ' + random.nextInt(95)));
                    default -> damaged.insert(at, "{}[]\",:0e-\\u\n".charAt(random.nextInt(13)));
                }
            }
            try {
                read(damaged.toString(), Room.WORLD);
            } catch (RunFileException e) {
                assertThat(e.getMessage())
                        .as("seed %d, round %d", seed, round)
                        .containsPattern("run\\.jsonl:\\d+:\\d+: .");
                rejected++;
            }
        }
        assertThat(rejected).as("seed %d", seed).isGreaterThan(Thorough.times(100, 1_000));
    }
}
