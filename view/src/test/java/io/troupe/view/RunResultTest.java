package io.troupe.view;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.services.subsumption.ServiceCatalogue;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.services.subsumption.SubsumptionTableReader;
import io.troupe.view.RunResult.StateChange;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class RunResultTest {
    private static final String LONG_NAME = "keepsAwayFromEverythingThatIsNear";

    private static RunResult result(int robots) {
        SubsumptionTable table = SubsumptionTableReader.parse(
                """
                robots %d
                colour sun #FFD700
                service %s = avoid colours
                state blue : * = spaceWanderer
                state sun : * = %s
                """.formatted(robots, LONG_NAME, LONG_NAME), Path.of("a.table"), ServiceCatalogue.standard());
        var states = List.of(
                new StateChange(0, table.states().get(0), null),
                new StateChange(700_000, table.states().get(1), 0));
        var records = IntStream.range(0, robots)
                .mapToObj(robot -> new RobotRecord(robot, 0))
                .toList();
        return new RunResult(1_000_000, table, states, records, new RunResult.Messages(0, 0, 0));
    }

    @Test
    void colours_haveTheNamesOfTheTable() {
        RunResult result = result(2);
        assertThat(result.states().getLast().describe(result.table()))
                .startsWith("    0.7 s  robot 1 sees sun   state 2: ");
        assertThat(result.summary()).contains("state 1 (blue): 1 time, 0.7 s", "state 2 (sun): 1 time, 0.3 s");
    }

    @Test
    void columns_standBelowEachOther_howeverLongTheNameOfAColourIs() {
        SubsumptionTable table = SubsumptionTableReader.parse(
                "robots 2\nstate blue : * = spaceWanderer\nstate #CAFF70 : spaceWanderer, wallFollower\n",
                Path.of("a.table"),
                ServiceCatalogue.standard());
        assertThat(List.of(
                        new StateChange(0, table.states().get(0), null).describe(table),
                        new StateChange(700_000, table.states().get(1), 0).describe(table)))
                .extracting(line -> line.indexOf(" state "))
                .containsOnly("    0.7 s  robot 1 sees #CAFF70".length());
    }

    @ParameterizedTest
    @ValueSource(ints = {2, RunRecorder.MANY_ROBOTS})
    void columns_standBelowEachOther_howeverLongTheNameOfAServiceIs(int robots) {
        var lines = result(robots)
                .summary()
                .lines()
                .filter(line -> line.startsWith("distance driven") || line.startsWith("cycles of "))
                .toList();
        assertThat(lines).hasSize(3).anySatisfy(line -> assertThat(line).contains(LONG_NAME + " "));
        assertThat(lines.stream().map(String::length).distinct()).hasSize(1);
    }
}
