package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceObserver;
import io.troupe.services.subsumption.State;
import io.troupe.services.subsumption.SubsumptionRun;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Scenario;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import org.jspecify.annotations.Nullable;

/** Records how services drive robots. The services' thread writes it while the world waits for them. */
public final class RecordedDrive implements ServiceObserver, Arbitrator.StateListener {
    public final Map<String, Integer> cycles = new TreeMap<>();
    public final List<Integer> states = new ArrayList<>();
    private final Map<Integer, Service> inCharge = new TreeMap<>();

    /** Lets the services of a table drive for a time, checks that none has failed, and returns the end. */
    public Snapshot drive(Mode mode, Scenario scenario, SubsumptionTable table, int seconds)
            throws InterruptedException {
        var robots = RobotServicesActor.Settings.defaults().withTable(table).withObserver(this);
        try (var simulation = Simulation.open(scenario, WorldSettings.defaults().withSeed(1));
                var run = SubsumptionRun.start(SubsumptionRun.Settings.defaults()
                        .withMode(mode)
                        .withRobots(robots)
                        .withClock(simulation.clock())
                        .withListener(this))) {
            while (simulation.timeMicros() < seconds * 1_000_000L) {
                simulation.tick();
                run.check();
            }
            return simulation.latest();
        }
    }

    @Override
    public void stateStarted(State state, @Nullable Integer seenBy) {
        states.add(state.number());
    }

    @Override
    public void serviceStarted(int robot, Service service) {
        assertThat(inCharge.put(robot, service)).isNull();
    }

    @Override
    public void cycleEnded(int robot, Service service) {
        cycles.merge(service.name(), 1, Integer::sum);
    }

    @Override
    public void serviceEnded(int robot, Service service) {
        assertThat(inCharge.remove(robot)).isEqualTo(service);
    }
}
