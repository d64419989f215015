package io.troupe.demo.paper;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.RobotServices;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.scenario.ScenarioReader;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The paper's main code drives the robots, and comes to the same as our own arbitrator. */
@Timeout(120)
class Figure20Test {
    private static final Path WORLD = Path.of("worlds", "paper-arena.world");
    private static final int TICKS = 1_500;

    @Test
    void demo3_goesThroughAllThreeStates_asTheArbitratorDoes() {
        var ofThePaper = new ArrayList<String>();
        drive(space -> {
            RobotServices robot1 =
                    space.spawn(RobotServices.class, () -> new RobotServices(RobotServices.Settings.ofThePaper()));
            RobotServices robot2 =
                    space.spawn(RobotServices.class, () -> new RobotServices(RobotServices.Settings.ofThePaper()));
            Demo3 demo = space.spawn(Demo3.class, () -> new Demo3(robot1, robot2, stamped(space, ofThePaper)));
            demo.live();
        });
        var ours = new ArrayList<String>();
        drive(space -> {
            var stamped = stamped(space, ours);
            RobotServices services =
                    space.spawn(RobotServices.class, () -> new RobotServices(RobotServices.Settings.ofThePaper()));
            Arbitrator arbitrator = space.spawn(
                    Arbitrator.class,
                    () -> new Arbitrator(services, SubsumptionTable.ofThePaper(), (state, seenBy) -> {
                        if (seenBy != null) {
                            stamped.add("color" + state.colour());
                        }
                        stamped.add("State " + state.number());
                    }));
            arbitrator.live();
        });
        assertThat(ofThePaper).hasSizeGreaterThan(3);
        assertThat(ofThePaper.getFirst()).endsWith("State 1");
        assertThat(ofThePaper).anyMatch(line -> line.endsWith("State 2")).anyMatch(line -> line.endsWith("State 3"));
        assertThat(ofThePaper).isEqualTo(ours);
    }

    /** What is added gets the simulated time in front. */
    private static List<String> stamped(ActorSpace space, List<String> lines) {
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
                return lines.add(space.clock().nanos() / 1_000_000 + " ms " + line);
            }
        };
    }

    private static void drive(Consumer<ActorSpace> application) {
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
}
