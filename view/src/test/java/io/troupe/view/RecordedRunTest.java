package io.troupe.view;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.services.subsumption.SubsumptionRun;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.sim.worldfile.WorldFileException;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.function.BooleanSupplier;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import javax.xml.parsers.DocumentBuilderFactory;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** The main job: its guarantees are measured on the real world file with real threads. */
@Timeout(300)
class RecordedRunTest {
    private static final Path WORLD = Path.of("..", "demo", "worlds", "paper-arena.world");

    @TempDir
    private Path out;

    private RunResult run(long seed, double seconds, String name) throws Exception {
        return prepared(WORLD, settings(seed, seconds)).run(out.resolve(name));
    }

    private List<String> lines(String name) throws IOException {
        return Files.readAllLines(out.resolve(name));
    }

    private static RecordedRun.Settings settings(long seed, double seconds) {
        return RecordedRun.Settings.defaults().withSeed(seed).withSeconds(seconds);
    }

    private static RecordedRun prepared(Path world, RecordedRun.Settings settings) {
        return new RecordedRun(ScenarioReader.read(world), SubsumptionTable.ofThePaper(), settings);
    }

    @Test
    void programOfTheReadme_writesLogSummaryAndPicture() throws Exception {
        Path world = WORLD;
        Path folder = out;

        Scenario scenario = ScenarioReader.read(world);
        var settings = RecordedRun.Settings.defaults().withSeed(7).withSeconds(60);
        var run = new RecordedRun(scenario, SubsumptionTable.ofThePaper(), settings);
        RunResult result = run.run(folder.resolve("run.jsonl"));
        Files.writeString(folder.resolve("summary.txt"), result.summary());
        Files.writeString(folder.resolve("trajectory.svg"), Pictures.trajectory(scenario.world(), result));

        assertThat(lines("run.jsonl").getLast()).startsWith("{\"t\":60.0,\"type\":\"summary\",");
        assertThat(result.duration()).isEqualTo("60.0");
        assertThat(folder.resolve("summary.txt")).content().contains("distance driven", "state 1 (blue): ");
        assertThat(folder.resolve("trajectory.svg")).content().contains("paper arena: 2 robots change state ");
    }

    @Test
    void loopOfTheCaller_isRecordedTheSameWay() throws Exception {
        Scenario scenario = ScenarioReader.read(WORLD);
        SubsumptionTable table = SubsumptionTable.ofThePaper();
        var described = settings(1, 2).withMode(Mode.CALLBACK);
        try (var simulation = Simulation.open(scenario, WorldSettings.defaults());
                var log = new RunLog(out.resolve("own.jsonl"))) {
            log.begin(scenario.world(), described);
            var recorder = new RunRecorder(scenario.world(), table, log, change -> {});
            var robots = RobotServicesActor.Settings.defaults().withObserver(recorder);
            var settings = SubsumptionRun.Settings.defaults()
                    .withMode(Mode.CALLBACK)
                    .withRobots(robots)
                    .withClock(simulation.clock())
                    .withListener(recorder);
            try (var running = SubsumptionRun.start(settings)) {
                recorder.start(simulation.latest());
                while (simulation.timeMicros() < 2_000_000) {
                    Snapshot snapshot = simulation.tick();
                    running.check();
                    recorder.record(snapshot);
                }
            }
            RunResult result = recorder.finish(false);

            assertThat(result.robots())
                    .allSatisfy(robot -> assertThat(robot.path())
                            .as("one sample before the first reading and one for each")
                            .hasSize(21));
            assertThat(result.states()).hasSize(1);
        }
        assertThat(lines("own.jsonl"))
                .as("header, one state, two robots at 21 times, summary")
                .hasSize(1 + 1 + 2 * 21 + 1)
                .first()
                .asString()
                .contains("\"mode\":\"callback\"", "\"seconds\":2.0");
    }

    @Test
    void threeHundredSeconds_visitEveryState_withoutTouchingAWallWhileFollowingOne_andAlwaysWithOneServicePerRobot()
            throws Exception {
        RunResult result = run(1, 300, "run.jsonl");
        assertThat(result.table().states())
                .allSatisfy(state -> assertThat(result.visits(state))
                        .as("visits of state %d", state.number())
                        .isGreaterThan(1));
        assertThat(result.robots()).allSatisfy(robot -> {
            assertThat(robot.followingContacts()).isZero();
            assertThat(robot.chargeFaults()).isZero();
            assertThat(robot.loops().values().stream()
                            .mapToLong(Long::longValue)
                            .sum())
                    .as("one loop for each reading, and one more when a service takes over")
                    .isEqualTo(3_000 + result.states().size() - 1);
        });
        assertThat(Pictures.trajectory(ScenarioReader.read(WORLD).world(), result))
                .as("the picture in README")
                .isEqualTo(Files.readString(Path.of("..", "docs", "figures", "trajectory.svg")));
        List<String> lines = lines("run.jsonl");
        assertThat(lines.getFirst())
                .isEqualTo("{\"t\":0.0,\"type\":\"header\",\"format\":\"troupe-run\",\"version\":1,\"program\":\""
                        + RunLog.PROGRAM
                        + "\",\"world\":\"paper arena\",\"robots\":2,\"seed\":1,\"mode\":\"promise\",\"reconnect\":false,"
                        + "\"seconds\":300.0,\"interval\":0.1}");
        assertThat(lines.get(1)).startsWith("{\"t\":0.0,\"type\":\"state\",\"state\":1,\"colour\":255,");
        assertThat(lines)
                .anyMatch(line -> line.matches(
                        "\\{\"t\":[0-9.]+,\"type\":\"state\",\"state\":2,\"robot\":[12],\"colour\":16711680,.*"));
        assertThat(lines.getLast())
                .startsWith("{\"t\":300.0,\"type\":\"summary\",")
                .doesNotContain("cutShort");
    }

    @Test
    void sameSeed_sameFile_anotherSeed_anotherFile() throws Exception {
        run(7, 20, "first");
        run(7, 20, "second");
        run(8, 20, "third");
        assertThat(out.resolve("second")).hasSameBinaryContentAs(out.resolve("first"));
        assertThat(Files.mismatch(out.resolve("first"), out.resolve("third"))).isNotNegative();
    }

    @Test
    void realTime_writesTheSameFile_andEndsNoEarlierThanTheSimulatedTime() throws Exception {
        run(7, 1, "fast");
        prepared(WORLD, settings(7, 1).withRealTime(true)).run(out.resolve("realtime"));
        assertThat(lines("fast")).hasSizeGreaterThan(2 * 10);
        assertThat(out.resolve("realtime")).hasSameBinaryContentAs(out.resolve("fast"));

        long began = System.nanoTime();
        var pacer = new WallClockPacer();
        pacer.await(1_000);
        assertThat(System.nanoTime() - began).isGreaterThanOrEqualTo(1_000_000);
        pacer.await(3_000);
        assertThat(System.nanoTime() - began).isGreaterThanOrEqualTo(3_000_000);
        pacer.await(0); // already over
    }

    private record Start(double x, double y, double heading) {}

    private static List<Start> starts(List<String> log) {
        var pose = Pattern.compile(
                "\\{\"t\":0\\.0,\"type\":\"pose\",.*\"x\":([^,]+),\"y\":([^,]+),\"heading\":([^,}]+).*");
        return log.stream()
                .map(pose::matcher)
                .filter(Matcher::matches)
                .map(found -> new Start(
                        Double.parseDouble(found.group(1)),
                        Double.parseDouble(found.group(2)),
                        Double.parseDouble(found.group(3))))
                .toList();
    }

    @Test
    void startPoses_areWithinTwoCentimetresAndTwoDegrees_ofTheFile() throws Exception {
        double metres = 0.02;
        double radians = Math.toRadians(2);
        var robots = ScenarioReader.read(WORLD).world().robots();
        List<List<Start>> bySeed = new ArrayList<>();
        for (int seed = 1; seed <= 20; seed++) {
            run(seed, 0.1, "log");
            bySeed.add(starts(lines("log")));
            assertThat(bySeed.getLast()).as("first poses with seed %d", seed).hasSize(robots.size());
        }
        for (int index = 0; index < robots.size(); index++) {
            int robot = index;
            Pose file = robots.get(robot).pose();
            var offsets = bySeed.stream()
                    .map(starts -> starts.get(robot))
                    .map(start -> new Start(
                            start.x - file.x(),
                            start.y - file.y(),
                            Math.IEEEremainder(start.heading - file.headingRad(), 2 * Math.PI)))
                    .toList();
            assertThat(offsets).extracting(Start::x).satisfies(each -> assertSpread(each, metres));
            assertThat(offsets).extracting(Start::y).satisfies(each -> assertSpread(each, metres));
            assertThat(offsets).extracting(Start::heading).satisfies(each -> assertSpread(each, radians));
        }
    }

    /** All offsets are within the limit, and some are in the outer half on either side. */
    private static void assertSpread(List<? extends Double> offsets, double limit) {
        double rounding = 1e-4; // of the log
        assertThat(offsets).allSatisfy(offset -> assertThat(offset).isBetween(-limit - rounding, limit + rounding));
        assertThat(offsets).anySatisfy(offset -> assertThat(offset).isLessThan(-limit / 2));
        assertThat(offsets).anySatisfy(offset -> assertThat(offset).isGreaterThan(limit / 2));
    }

    /** Asks to stop, or fails, at this poll. */
    private static RecordedRun.Listener atPoll(int number, BooleanSupplier action) {
        var polls = new int[1];
        return new RecordedRun.Listener() {
            @Override
            public boolean isStopRequested() {
                return polls[0]++ == number && action.getAsBoolean();
            }
        };
    }

    @Test
    void stop_endsTheRunWithTheSummarySoFar() throws Exception {
        try (var log = new RunLog(out.resolve("short"))) {
            var result = prepared(WORLD, settings(1, 300)).run(log, atPoll(50, () -> true));
            assertThat(result.endMicros()).isEqualTo(5_000_000);
        }
        assertThat(lines("short").getLast())
                .startsWith("{\"t\":5.0,\"type\":\"summary\"")
                .endsWith(",\"cutShort\":\"interrupted\"}");
    }

    @Test
    void runThatFails_saysSoInItsLastLine() throws Exception {
        try (var log = new RunLog(out.resolve("failed"))) {
            var run = prepared(WORLD, settings(1, 300));
            assertThatThrownBy(() -> run.run(log, atPoll(10, () -> {
                        throw new IllegalStateException("for a test");
                    })))
                    .hasMessage("for a test");
        }
        assertThat(lines("failed").getLast()).isEqualTo("{\"t\":1.0,\"type\":\"cutShort\",\"cutShort\":\"failed\"}");
    }

    @Test
    void listener_isCalledAtEveryReadingAndEveryState() throws Exception {
        List<String> states = new ArrayList<>();
        List<Long> ticks = new ArrayList<>();
        try (var log = new RunLog(out.resolve("run.jsonl"))) {
            RunResult result = prepared(WORLD, settings(1, 140)).run(log, new RecordedRun.Listener() {
                @Override
                public void stateStarted(String line) {
                    states.add(line);
                }

                @Override
                public void ticked(long timeMicros) {
                    ticks.add(timeMicros);
                }
            });
            assertThat(states)
                    .hasSizeGreaterThan(1)
                    .isEqualTo(result.states().stream()
                            .map(change -> change.describe(result.table()))
                            .toList());
        }
        assertThat(ticks).hasSize(1_400).startsWith(100_000L).endsWith(140_000_000L);
    }

    @Test
    void robotThatMakesNoWay_isToldWithItsTime() throws Exception {
        RunResult result =
                prepared(WORLD.resolveSibling("office.cfg"), settings(1, 60)).run(out.resolve("office"));
        assertThat(result.summary())
                .containsPattern("robot 2 made no way for 1[0-9]\\.[0-9] s: from 4[0-9]\\.[0-9] s to 60\\.0 s it stayed"
                        + " within 5 cm while spaceWanderer drove it\\R")
                .doesNotContain("robot 1 made no way");
    }

    @Test
    void picture_showsEveryObstacleBothPathsAndEveryStateChange() throws Exception {
        RunResult result = run(1, 60, "run.jsonl");
        String svg = Pictures.trajectory(ScenarioReader.read(WORLD).world(), result);
        assertThat(svg).startsWith("<svg").endsWith("</svg>\n");
        assertThat(svg).contains("<title>red box 1</title>", "wallFollower", "spaceWanderer", "stroke-dasharray");
        assertThat(svg.split("<g class=\"state\"", -1))
                .hasSize(result.states().size()); // one per change, none for the start
        DocumentBuilderFactory.newInstance()
                .newDocumentBuilder()
                .parse(new ByteArrayInputStream(svg.getBytes(StandardCharsets.UTF_8)));
    }

    @Test
    void worldWithAnotherNumberOfRobots_isRefused() {
        Scenario two = ScenarioReader.read(WORLD);
        WorldSpec world = two.world();
        var robot = world.robots().subList(0, 1);
        var ofOne = new WorldSpec(world.name(), world.file(), world.intervalMillis(), robot, world.obstacles());
        var one = new Scenario(ofOne, two.devices());
        assertThatThrownBy(() -> new RecordedRun(one, SubsumptionTable.ofThePaper(), settings(1, 1)))
                .isInstanceOf(WorldFileException.class)
                .hasMessageContaining("has 1 robot, expected 2");
    }
}
