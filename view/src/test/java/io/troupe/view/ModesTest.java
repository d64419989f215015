package io.troupe.view;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceCatalogue;
import io.troupe.services.subsumption.ServiceObserver;
import io.troupe.services.subsumption.SubsumptionRun;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.services.subsumption.SubsumptionTableReader;
import io.troupe.services.subsumption.SynchronousRound;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.worldfile.CrowdWorld;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.tools.Thorough;
import io.troupe.view.RecordedRun.Settings;
import java.io.IOException;
import java.lang.reflect.Proxy;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Collections;
import java.util.EnumMap;
import java.util.List;
import java.util.Map;
import java.util.Queue;
import java.util.Random;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ConcurrentLinkedQueue;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * Common properties and differences of the three modes, with real threads: in the paper's arena, and with random tables
 * and crowds, which have several colour finders per state, holds and priorities.
 */
@Timeout(300)
class ModesTest {
    private static final Path WORLD = Path.of("..", "demo", "worlds", "paper-arena.world");
    private static final double SECONDS = 140; // long enough for all three states

    private static final double RANDOM_SECONDS = 40;
    private static final int SEEDS = Thorough.times(3, 6);
    private static final int LEAST_SWITCHES = Thorough.times(3, 20);
    private static final List<Service> SERVICES = List.of(
            Service.SPACE_WANDERER,
            Service.wallFollower(CornerStyle.FORWARD),
            service("avoid = avoid no colours").over(Service.SPACE_WANDERER),
            service("near = goToGoal(2, 1; -1, -2; again) colours"),
            service("far = goToGoal(5, 0) no colours"));

    @TempDir
    private Path out;

    private static Service service(String declaration) {
        return SubsumptionTableReader.service(declaration, ServiceCatalogue.standard());
    }

    private RunResult run(Settings settings, long seed, String name) throws Exception {
        return new RecordedRun(
                        ScenarioReader.read(WORLD),
                        SubsumptionTable.ofThePaper(),
                        settings.withSeed(seed).withSeconds(SECONDS))
                .run(out.resolve(name));
    }

    private static Settings in(Mode mode) {
        return Settings.defaults().withMode(mode);
    }

    private static Settings syncWithoutCycleTimes() {
        return in(Mode.SYNC).withRound(SynchronousRound.ALL_SERVICES_A_READING);
    }

    /** Asserts that two runs differ only in the name of the mode. */
    private void assertSameButForTheMode(String name, String other) throws IOException {
        assertThat(lines(name)).isEqualTo(lines(other));
    }

    private List<String> lines(String name) throws IOException {
        var lines = Files.readAllLines(out.resolve(name));
        assertThat(lines.getFirst()).startsWith("{\"t\":0.0,\"type\":\"header\",");
        lines.set(0, lines.getFirst().replaceFirst("\"mode\":\"[a-z]+\"", ""));
        return lines;
    }

    /**
     * The lines between header and summary. The summary counts cycles: at a switch, a robot may process the reading
     * only under its next service.
     */
    private List<String> linesBeforeSummary(String name) throws IOException {
        var lines = lines(name);
        assertThat(lines.getLast()).contains("\"type\":\"summary\"");
        return lines.subList(1, lines.size() - 1);
    }

    private static int switches(RunResult result) {
        return result.states().size() - 1;
    }

    @Test
    void comparison_isMadeInAFewLines() throws Exception {
        var scenario = ScenarioReader.read(WORLD);
        var table = SubsumptionTable.ofThePaper();
        var settings = Settings.defaults().withSeconds(60);
        Path folder = out;

        var results = new EnumMap<Mode, RunResult>(Mode.class);
        for (Mode mode : Mode.values()) {
            var run = new RecordedRun(scenario, table, settings.withMode(mode));
            results.put(mode, run.run(folder.resolve(mode + ".jsonl")));
        }
        var comparison = new ModeComparison(results);
        Files.writeString(folder.resolve("modes.svg"), Pictures.modes(comparison, comparison.finding()));

        assertThat(comparison.firstDifference(Mode.CALLBACK)).isEmpty();
        assertThat(comparison.firstDifference(Mode.SYNC)).isPresent();
        assertThat(folder.resolve("modes.svg")).content().contains("first unlike promise mode, ");
        var syncOnly = new ModeComparison(Map.of(Mode.SYNC, comparison.result(Mode.SYNC)));
        assertThatThrownBy(syncOnly::finding).hasMessage("there is no run in promise mode, only in [sync]");
    }

    @ParameterizedTest
    @ValueSource(longs = {1, 2, 3, 4, 5})
    void callbackMode_writesTheSameFileAsPromiseMode_butSendsManyMoreMessages(long seed) throws Exception {
        var promise = run(in(Mode.PROMISE), seed, "promise");
        var callback = run(in(Mode.CALLBACK), seed, "callback");
        assertThat(promise.states()).hasSizeGreaterThan(2);
        assertSameButForTheMode("callback", "promise");
        assertThat(promise.messages().sent()).isEqualTo(switches(promise));
        assertThat(callback.messages().sent())
                .isGreaterThan(5 * promise.messages().sent())
                .isEqualTo(callback.messages().received());
    }

    @ParameterizedTest
    @ValueSource(longs = {1, 2, 3})
    void synchronousModeWithoutItsCycleTimes_hasTheSameStatesAndPosesAsPromiseMode(long seed) throws Exception {
        run(in(Mode.PROMISE), seed, "promise");
        var sync = run(syncWithoutCycleTimes(), seed, "sync");
        assertThat(linesBeforeSummary("sync")).isEqualTo(linesBeforeSummary("promise"));
        assertThat(sync.messages().sent()).isZero();
    }

    @Test
    void synchronousModeOfThePaper_differsFirstByTheReadingThatTheSecondServiceWaits() throws Exception {
        var promise = run(in(Mode.PROMISE), 1, "promise");
        var sync = run(in(Mode.SYNC), 1, "sync");
        for (int robot = 0; robot < 2; robot++) {
            assertThat(pose(sync, robot, 0)).isEqualTo(pose(promise, robot, 0));
        }
        assertThat(pose(sync, 0, 1)).as("robot 1 is first").isEqualTo(pose(promise, 0, 1));
        assertThat(pose(sync, 1, 1)).as("robot 2 has to wait").isEqualTo(pose(sync, 1, 0));
        assertThat(pose(promise, 1, 1)).isNotEqualTo(pose(promise, 1, 0));
        assertThat(sync.states().getFirst()).isEqualTo(promise.states().getFirst());
        assertThat(sync.states()).isNotEqualTo(promise.states());
        assertThat(sync.robots()).allSatisfy(robot -> {
            int ticks = robot.path().size() - 1;
            long loops =
                    robot.loops().values().stream().mapToLong(Long::longValue).sum();
            assertThat(loops).as("cycles: every second reading").isBetween(ticks / 2L - 10, ticks / 2L + 10);
            assertThat(robot.ticksWithoutCycle()).isEqualTo(ticks - loops);
        });
    }

    private static Object pose(RunResult result, int robot, int tick) {
        return result.robots().get(robot).path().get(tick).pose();
    }

    @Test
    void reconnection_costsEachRobotATickWithoutAServiceAtEverySwitch_inBothAsynchronousModesAlike() throws Exception {
        var promise = run(in(Mode.PROMISE).withReconnection(true), 1, "promise");
        run(in(Mode.CALLBACK).withReconnection(true), 1, "callback");
        run(in(Mode.CALLBACK).withReconnection(true), 1, "again");
        assertThat(switches(promise)).isPositive();
        assertThat(promise.robots())
                .allSatisfy(robot -> assertThat(robot.chargeFaults()).isEqualTo(switches(promise)));
        assertSameButForTheMode("callback", "promise");
        assertThat(out.resolve("again")).hasSameBinaryContentAs(out.resolve("callback"));
    }

    @Test
    void everyMode_isRepeatable() throws Exception {
        for (Mode mode : List.of(Mode.SYNC, Mode.CALLBACK)) {
            run(in(mode), 7, "first");
            run(in(mode), 7, "second");
            assertThat(out.resolve("second")).hasSameBinaryContentAs(out.resolve("first"));
        }
    }

    /** The callbacks of observer and listener. */
    private interface Callbacks extends ServiceObserver, Arbitrator.StateListener {}

    @ParameterizedTest
    @EnumSource
    void observerAndListener_areCalledOnOneThread_andNotOnTheWorlds(Mode mode) throws Exception {
        Set<Thread> threads = ConcurrentHashMap.newKeySet();
        Queue<String> called = new ConcurrentLinkedQueue<>(); // read while callbacks are recorded
        Class<?>[] type = {Callbacks.class};
        var callbacks =
                (Callbacks) Proxy.newProxyInstance(type[0].getClassLoader(), type, (proxy, method, arguments) -> {
                    threads.add(Thread.currentThread());
                    called.add(method.getName());
                    return null;
                });
        try (var simulation = Simulation.open(
                ScenarioReader.read(WORLD), WorldSettings.defaults().withSeed(1))) {
            var table = SubsumptionTable.ofThePaper();
            var robots = RobotServicesActor.Settings.defaults().withTable(table).withObserver(callbacks);
            var settings = SubsumptionRun.Settings.defaults()
                    .withMode(mode)
                    .withRobots(robots)
                    .withClock(simulation.clock())
                    .withListener(callbacks);
            try (var run = SubsumptionRun.start(settings)) {
                while (Collections.frequency(called, "stateStarted") < 3 && simulation.timeMicros() < SECONDS * 1e6) {
                    simulation.tick();
                    run.check();
                }
            }
        }
        assertThat(called).filteredOn("stateStarted"::equals).hasSize(3);
        assertThat(called).contains("serviceStarted", "cycleStarted", "cycleEnded", "serviceEnded");
        assertThat(called.contains("colourSent")).isEqualTo(mode != Mode.SYNC);
        assertThat(called.contains("colourReceived")).isEqualTo(mode != Mode.SYNC);
        assertThat(threads).hasSize(1).doesNotContain(Thread.currentThread());
    }

    // ---- random tables and crowds

    /** A random table for a random number of robots. */
    private record Team(Scenario scenario, SubsumptionTable table) {
        static Team of(Random random) {
            int robots = 6 + random.nextInt(15);
            int colours = 2 + random.nextInt(7);
            var table = SubsumptionTable.forRobots(robots).holdSeconds(random.nextInt(3) * random.nextDouble());
            for (int colour : CrowdWorld.colours(colours)) {
                List<Service> services = new ArrayList<>();
                for (int robot = 0; robot < robots; robot++) {
                    services.add(SERVICES.get(random.nextInt(SERVICES.size())));
                }
                services.set(random.nextInt(robots), Service.SPACE_WANDERER); // at least one that looks for colours
                table.state(colour, services);
                if (random.nextBoolean()) {
                    table.priority(colour, random.nextInt(5) - 2);
                }
            }
            return new Team(CrowdWorld.scenario(robots, colours), table.build());
        }
    }

    @ParameterizedTest
    @ValueSource(booleans = {false, true})
    void randomTables_haveTheSameStatesAndPosesInAllModes_andInBothAsynchronousOnesWithReconnection(boolean reconnect)
            throws Exception {
        int switches = 0;
        for (long seed = 1; seed <= SEEDS; seed++) {
            var team = Team.of(new Random(seed));
            var promise = run(team, seed, in(Mode.PROMISE).withReconnection(reconnect), "promise");
            var callback = run(team, seed, in(Mode.CALLBACK).withReconnection(reconnect), "callback");
            assertThat(lines("callback"))
                    .as("seed %d: run.jsonl of callback mode", seed)
                    .isEqualTo(lines("promise"));
            if (!reconnect) {
                assertThat(callback.messages().received())
                        .as("seed %d: messages received", seed)
                        .isEqualTo(callback.messages().sent());
                run(team, seed, syncWithoutCycleTimes(), "sync");
                assertThat(linesBeforeSummary("sync"))
                        .as("seed %d: lines of sync mode", seed)
                        .isEqualTo(linesBeforeSummary("promise"));
            }
            switches += switches(promise);
        }
        assertThat(switches).as("state changes in all runs").isGreaterThan(LEAST_SWITCHES);
    }

    private RunResult run(Team team, long seed, Settings settings, String name) throws Exception {
        var these = settings.withSeed(seed).withSeconds(RANDOM_SECONDS);
        return new RecordedRun(team.scenario, team.table, these).run(out.resolve(name));
    }
}
