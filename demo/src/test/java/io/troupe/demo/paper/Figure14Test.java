package io.troupe.demo.paper;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.player.PlayerException;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.ServiceObserver;
import io.troupe.services.subsumption.SubsumptionRun;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.ScenarioReader;
import java.util.ArrayList;
import java.util.concurrent.atomic.AtomicReference;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The paper's main code in synchronous mode drives the robots with the same result as our loop. */
@Timeout(120)
class Figure14Test {
    private static Simulation open() {
        return Simulation.open(ScenarioReader.read(ArenaRun.WORLD), WorldSettings.DEFAULT);
    }

    @Test
    void demo1_goesThroughAllThreeStates_asTheSynchronousModeDoes() throws InterruptedException {
        var ofThePaper = new ArrayList<String>();
        var end = new AtomicReference<Throwable>();
        Thread main;
        try (var simulation = open()) {
            var demo = new Demo1(ArenaRun.stamped(simulation.clock(), ofThePaper));
            demo.connect();
            main = new Thread(demo, "Demo1");
            main.setUncaughtExceptionHandler((thread, error) -> end.set(error));
            main.start();
            tick(simulation);
        }
        main.join();
        assertThat(end.get()).isInstanceOf(PlayerException.class).hasMessageContaining("has been closed");
        var ours = new ArrayList<String>();
        try (var simulation = open();
                var run = SubsumptionRun.start(new SubsumptionRun.Settings(
                        Mode.SYNC,
                        "localhost",
                        6665,
                        SubsumptionTable.ofThePaper(),
                        simulation.clock(),
                        ServiceObserver.NONE,
                        (state, seenBy) ->
                                ArenaRun.stamped(simulation.clock(), ours).add("State " + state.number())))) {
            tick(simulation);
            run.check();
        }
        ArenaRun.assertAllThreeStates(ofThePaper);
        assertThat(ofThePaper).isEqualTo(ours);
    }

    private static void tick(Simulation simulation) {
        for (int tick = 0; tick < 2 * ArenaRun.TICKS; tick++) {
            simulation.tick();
        }
    }
}
