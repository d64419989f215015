package io.troupe.view;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceObserver;
import io.troupe.services.subsumption.State;
import io.troupe.services.subsumption.SubsumptionRun;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.services.subsumption.SynchronousRound;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.view.RecordedRun.Settings;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.EnumMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.AtomicInteger;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;
import org.junit.jupiter.params.provider.ValueSource;

/** Common properties and differences of the three modes, in the paper's arena with real threads. */
@Timeout(300)
class ModesTest {
    private static final Path WORLD = Path.of("..", "demo", "worlds", "paper-arena.world");
    private static final int PORT = 6665;
    private static final double SECONDS = 140; // long enough for all three states

    @TempDir
    private Path out;

    private RunResult run(Settings settings, long seed, String name) throws Exception {
        return new RecordedRun(
                        ScenarioReader.read(WORLD),
                        SubsumptionTable.ofThePaper(),
                        settings.withSeed(seed).withSeconds(SECONDS))
                .run(out.resolve(name));
    }

    private static Settings in(Mode mode) {
        return Settings.DEFAULT.withMode(mode);
    }

    @Test
    void comparison_isMadeInAFewLines() throws Exception {
        var scenario = ScenarioReader.read(WORLD);
        var table = SubsumptionTable.ofThePaper();
        var settings = Settings.DEFAULT.withSeconds(60);
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
        RunLines.assertSameButForTheMode(out.resolve("callback"), out.resolve("promise"));
        assertThat(promise.messages().sent()).isEqualTo(promise.states().size() - 1L);
        assertThat(callback.messages().sent())
                .isGreaterThan(5 * promise.messages().sent());
        assertThat(callback.messages().received()).isEqualTo(callback.messages().sent());
    }

    @ParameterizedTest
    @ValueSource(longs = {1, 2, 3})
    void synchronousModeWithoutItsCycleTimes_hasTheSameStatesAndPosesAsPromiseMode(long seed) throws Exception {
        run(in(Mode.PROMISE), seed, "promise");
        var sync = run(in(Mode.SYNC).withRound(SynchronousRound.ALL_SERVICES_A_READING), seed, "sync");
        assertThat(linesBeforeSummary("sync")).isEqualTo(linesBeforeSummary("promise"));
        assertThat(sync.messages().sent()).isZero();
    }

    /**
     * The lines before the summary. The summary counts cycles: at a switch, a robot may process the reading only under
     * its next service.
     */
    private List<String> linesBeforeSummary(String name) throws IOException {
        var lines = RunLines.afterHeader(out.resolve(name));
        assertThat(lines.getLast()).contains("\"type\":\"summary\"");
        return lines.subList(0, lines.size() - 1);
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
        int switches = promise.states().size() - 1;
        assertThat(switches).isPositive();
        assertThat(promise.robots())
                .allSatisfy(robot -> assertThat(robot.chargeFaults()).isEqualTo(switches));
        RunLines.assertSameButForTheMode(out.resolve("callback"), out.resolve("promise"));
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

    @ParameterizedTest
    @EnumSource
    void observerAndListener_areCalledOnOneThread_andNotOnTheWorlds(Mode mode) throws Exception {
        var threads = new Callers();
        try (var simulation = Simulation.open(ScenarioReader.read(WORLD), WorldSettings.DEFAULT.withSeed(1))) {
            var settings = new SubsumptionRun.Settings(
                    mode, "localhost", PORT, SubsumptionTable.ofThePaper(), simulation.clock(), threads, threads);
            try (var run = SubsumptionRun.start(settings)) {
                while (threads.states.get() < 3 && simulation.timeMicros() < SECONDS * 1e6) {
                    simulation.tick();
                    run.check();
                }
            }
        }
        assertThat(threads.states).as("states that began").hasValue(3);
        assertThat(threads.called).contains("state", "began", "cycle begins", "cycled", "ended");
        assertThat(threads.called.contains("colour sent")).isEqualTo(mode != Mode.SYNC);
        assertThat(threads.called.contains("colour received")).isEqualTo(mode != Mode.SYNC);
        assertThat(threads.seen).hasSize(1).doesNotContain(Thread.currentThread());
    }

    /** Records the threads of the callbacks. */
    private static final class Callers implements ServiceObserver, Arbitrator.StateListener {
        private final Set<Thread> seen = ConcurrentHashMap.newKeySet();
        private final Set<String> called = ConcurrentHashMap.newKeySet();
        private final AtomicInteger states = new AtomicInteger();

        private void note(String what) {
            seen.add(Thread.currentThread());
            called.add(what);
        }

        @Override
        public void stateStarted(State state, @Nullable Integer seenBy) {
            note("state");
            states.incrementAndGet();
        }

        @Override
        public void colourReceived(int robot, int colour) {
            note("colour received");
        }

        @Override
        public void colourTooLate(int robot, int colour) {
            note("colour too late");
        }

        @Override
        public void serviceStarted(int robot, Service service) {
            note("began");
        }

        @Override
        public void cycleStarted(int robot, Service service) {
            note("cycle begins");
        }

        @Override
        public void cycleEnded(int robot, Service service) {
            note("cycled");
        }

        @Override
        public void serviceEnded(int robot, Service service) {
            note("ended");
        }

        @Override
        public void colourSent(int robot, int colour) {
            note("colour sent");
        }
    }
}
