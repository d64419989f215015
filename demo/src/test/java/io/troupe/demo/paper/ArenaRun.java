package io.troupe.demo.paper;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.time.Clock;
import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotServices;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;

/** Runs main code in the paper's arena, for comparison with other main code. */
final class ArenaRun {
    static final Path WORLD = Path.of("worlds", "paper-arena.world");
    static final int TICKS = 1_500;

    private ArenaRun() {}

    static PaperServices paperServices(ActorSpace space) {
        return space.spawn(PaperServices.class, PaperServices::new);
    }

    /** Starts our arbitrator and robot services for the paper's table. */
    static void startOurs(ActorSpace space, Mode mode, Arbitrator.StateListener listener) {
        RobotServices services = space.spawn(
                RobotServices.class, () -> new RobotServicesActor(RobotServicesActor.Settings.ofThePaper()));
        Arbitrator arbitrator = space.spawn(
                Arbitrator.class, () -> new Arbitrator(mode, services, SubsumptionTable.ofThePaper(), listener));
        arbitrator.live();
    }

    /** Writes states, and the colours before them, in the format of the paper's code. */
    static Arbitrator.StateListener printer(String colourPrefix, List<String> lines) {
        return (state, seenBy) -> {
            if (seenBy != null) {
                lines.add(colourPrefix + state.colour());
            }
            lines.add("State " + state.number());
        };
    }

    /** A list that prefixes added lines with the simulated time. */
    static List<String> stamped(Clock clock, List<String> lines) {
        return new java.util.AbstractList<>() {
            @Override
            public String get(int index) {
                return lines.get(index);
            }

            @Override
            public int size() {
                return lines.size();
            }

            @Override
            public boolean add(String line) {
                return lines.add(clock.nanos() / 1_000_000 + " ms " + line);
            }
        };
    }

    static void drive(Consumer<ActorSpace> application) {
        var problems = new ArrayList<Throwable>();
        try (var simulation = Simulation.open(ScenarioReader.read(WORLD), WorldSettings.DEFAULT);
                var space = ActorSpace.create(SpaceSettings.named("robots")
                        .withClock(simulation.clock())
                        .withHandCrank()
                        .withOnError((where, error) -> problems.add(error)))) {
            simulation.whileWaiting(space::crank);
            application.accept(space);
            space.crank();
            for (int tick = 0; tick < TICKS; tick++) {
                simulation.tick();
            }
        }
        assertThat(problems).isEmpty();
    }

    static void assertAllThreeStates(List<String> lines) {
        assertThat(lines).hasSizeGreaterThan(3);
        assertThat(lines.getFirst()).endsWith("State 1");
        assertThat(lines).anyMatch(line -> line.endsWith("State 2")).anyMatch(line -> line.endsWith("State 3"));
    }
}
