package io.troupe.demo.table;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceCatalogue;
import io.troupe.services.subsumption.ServiceObserver;
import io.troupe.services.subsumption.State;
import io.troupe.services.subsumption.SubsumptionRun;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.services.subsumption.SubsumptionTableReader;
import io.troupe.services.subsumption.SubsumptionTableWriter;
import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.TreeMap;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The tables in {@code demo/tables} match their description and drive the robots of the paper's arena. */
@Timeout(300)
class ShippedTablesTest {
    private static final Path TABLES = Path.of("tables");
    private static final Path WORLD = Path.of("worlds", "paper-arena.world");

    /** Records a run. The services' thread writes it while the world waits for them. */
    private static final class Recorder implements ServiceObserver, Arbitrator.StateListener {
        final Map<String, Integer> cycles = new TreeMap<>();
        final List<Integer> states = new ArrayList<>();
        final int[] inCharge = new int[2];
        private @Nullable Snapshot end;

        /** The distance of a robot from a point. */
        double metresAtTheEnd(int robot, double x, double y) {
            var pose = Objects.requireNonNull(end).robots().get(robot).pose();
            return Math.hypot(pose.x() - x, pose.y() - y);
        }

        @Override
        public void stateStarted(State state, @Nullable Integer seenBy) {
            states.add(state.number());
        }

        @Override
        public void serviceStarted(int robot, Service service) {
            assertThat(++inCharge[robot]).isEqualTo(1);
        }

        @Override
        public void cycleEnded(int robot, Service service) {
            cycles.merge(service.name(), 1, Integer::sum);
        }

        @Override
        public void serviceEnded(int robot, Service service) {
            inCharge[robot]--;
        }
    }

    private static SubsumptionTable read(String text) {
        return SubsumptionTableReader.parse(text, Path.of("text"), ServiceCatalogue.standard());
    }

    private static Recorder run(SubsumptionTable table, int seconds) throws Exception {
        var recorder = new Recorder();
        try (var simulation = Simulation.open(ScenarioReader.read(WORLD), WorldSettings.DEFAULT.withSeed(1));
                var run = SubsumptionRun.start(new SubsumptionRun.Settings(
                        Mode.PROMISE, "localhost", 6665, table, simulation.clock(), recorder, recorder))) {
            while (simulation.timeMicros() < seconds * 1_000_000L) {
                simulation.tick();
                run.check();
            }
            recorder.end = simulation.latest();
        }
        return recorder;
    }

    @Test
    void paperTable_isTheTableOfThePaper_andRuns() throws Exception {
        SubsumptionTable table = SubsumptionTableReader.read(TABLES.resolve("paper.table"));
        assertThat(table).isEqualTo(SubsumptionTable.ofThePaper());
        Recorder recorder = run(table, 120);
        assertThat(recorder.states).contains(1, 2, 3);
        assertThat(recorder.cycles).containsOnlyKeys("wallFollower", "spaceWanderer");
    }

    @Test
    void fourServices_allDrive_andEveryStateIsVisited() throws Exception {
        Recorder recorder = run(SubsumptionTableReader.read(TABLES.resolve("four-services.table")), 300);
        assertThat(recorder.states).contains(1, 2, 3);
        assertThat(recorder.cycles).containsOnlyKeys("wallFollower", "spaceWanderer", "dodge > west", "dodge > east");
        assertThat(recorder.cycles.values()).allMatch(count -> count > 20);
    }

    @Test
    void goalsOfATable_areReached_roundAnInnerWall() throws Exception {
        Recorder recorder = run(read("""
                robots 2
                allow final
                service there = goToGoal(-1.4, 2.1; within 0.1)
                service round = goToGoal(3.3, -1; -0.2, -4; within 0.1)
                state blue : avoid > round, avoid > there
                """), 90);
        assertThat(recorder.metresAtTheEnd(0, 0.0, -3.0)).isLessThan(0.2);
        assertThat(recorder.metresAtTheEnd(1, 4.4, -2.6)).isLessThan(0.2);
        assertThat(recorder.states).containsExactly(1);
    }

    @Test
    void everyTable_isReadAgainAsItIsWritten() throws Exception {
        try (var files = Files.list(TABLES)) {
            List<Path> tables =
                    files.filter(file -> file.toString().endsWith(".table")).toList();
            assertThat(tables).hasSizeGreaterThanOrEqualTo(2);
            for (Path file : tables) {
                SubsumptionTable table = SubsumptionTableReader.read(file);
                assertThat(read(SubsumptionTableWriter.write(table))).isEqualTo(table);
            }
        }
    }
}
