package io.troupe.view;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceCatalogue;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.services.subsumption.SubsumptionTableReader;
import io.troupe.services.subsumption.SynchronousRound;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.worldfile.CrowdWorld;
import io.troupe.view.RecordedRun.Settings;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/**
 * Random tables and crowds: the modes agree as in the paper's arena, with several colour finders per state, holds and
 * priorities.
 */
@Timeout(300)
class RandomTablesTest {
    private static final double SECONDS = 40;
    private static final int LEAST_SWITCHES = 20;
    private static final int SEEDS = 6;
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

    private record Team(Scenario scenario, SubsumptionTable table) {}

    private static Team team(Random random) {
        int robots = 6 + random.nextInt(15);
        int colours = 2 + random.nextInt(7);
        var table = SubsumptionTable.forRobots(robots).hold(random.nextInt(3) * random.nextDouble());
        for (int colour : CrowdWorld.colours(colours)) {
            List<Service> services = new ArrayList<>();
            for (int robot = 0; robot < robots; robot++) {
                services.add(SERVICES.get(random.nextInt(SERVICES.size())));
            }
            services.set(random.nextInt(robots), Service.SPACE_WANDERER); // at least one service that looks for colours
            table.when(colour, services);
            if (random.nextBoolean()) {
                table.priority(colour, random.nextInt(5) - 2);
            }
        }
        return new Team(CrowdWorld.scenario(robots, colours), table.build());
    }

    private RunResult run(Team team, long seed, Settings settings, String name) throws Exception {
        return new RecordedRun(
                        team.scenario, team.table, settings.withSeed(seed).withSeconds(SECONDS))
                .run(out.resolve(name));
    }

    private static Settings in(Mode mode) {
        return Settings.DEFAULT.withMode(mode);
    }

    @Test
    void modes_haveTheSameStatesAndPoses() throws Exception {
        int switches = 0;
        for (long seed = 1; seed <= SEEDS; seed++) {
            var team = team(new Random(seed));
            var promise = run(team, seed, in(Mode.PROMISE), "promise");
            var callback = run(team, seed, in(Mode.CALLBACK), "callback");
            run(team, seed, in(Mode.SYNC).withRound(SynchronousRound.ALL_SERVICES_A_READING), "sync");

            requireSameFiles(seed);
            assertThat(linesBeforeSummary("sync"))
                    .as("seed %d: lines of sync mode", seed)
                    .isEqualTo(linesBeforeSummary("promise"));
            assertThat(callback.messages().received())
                    .as("seed %d: messages received", seed)
                    .isEqualTo(callback.messages().sent());
            switches += promise.states().size() - 1;
        }
        assertThat(switches).as("state changes in all runs").isGreaterThan(LEAST_SWITCHES);
    }

    @Test
    void reconnection_isTheSameInBothAsynchronousModes() throws Exception {
        int switches = 0;
        for (long seed = 1; seed <= SEEDS; seed++) {
            var team = team(new Random(seed));
            var promise = run(team, seed, in(Mode.PROMISE).withReconnection(true), "promise");
            run(team, seed, in(Mode.CALLBACK).withReconnection(true), "callback");

            requireSameFiles(seed);
            switches += promise.states().size() - 1;
        }
        assertThat(switches).as("state changes in all runs").isGreaterThan(LEAST_SWITCHES);
    }

    private void requireSameFiles(long seed) throws IOException {
        assertThat(RunLines.afterHeader(out.resolve("callback")))
                .as("seed %d: run.jsonl of callback mode", seed)
                .isEqualTo(RunLines.afterHeader(out.resolve("promise")));
    }

    private List<String> linesBeforeSummary(String name) throws IOException {
        var lines = RunLines.afterHeader(out.resolve(name));
        assertThat(lines.getLast()).contains("\"type\":\"summary\"");
        return lines.subList(0, lines.size() - 1);
    }
}
