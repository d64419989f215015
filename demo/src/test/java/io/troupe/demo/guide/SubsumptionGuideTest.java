package io.troupe.demo.guide;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.common.text.NamedColours;
import io.troupe.services.behaviour.Avoid;
import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.RobotPose;
import io.troupe.services.behaviour.Senses;
import io.troupe.services.behaviour.SonarRing;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.Assignment;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceCatalogue;
import io.troupe.services.subsumption.ServiceObserver;
import io.troupe.services.subsumption.SubsumptionRun;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.services.subsumption.SubsumptionTableReader;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Optional;
import java.util.concurrent.atomic.LongAdder;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** Runs the samples of the guide to subsumption. */
class SubsumptionGuideTest {
    private static final String FIFTY = """
            robots 50
            ignore black : walls                                    # the text after ':' is the reason
            colour lilac #C8A2C8                                    # declares a name; it must be used
            service patrol = goToGoal(1.5, -2; 3, 0; again) colours # "colours": its robots look for colours
            hold 2 s
            state blue : * = spaceWanderer, 3..5 = wallFollower     # the default; robots 3 to 5
            state lilac priority 1 : * = avoid > patrol
            """;

    static Service spin() {
        return new Service("spin", true, () -> {
            double[] began = {Double.NaN};
            return senses -> {
                if (Double.isNaN(began[0])) {
                    began[0] = senses.timeSeconds();
                }
                boolean enough = senses.timeSeconds() - began[0] > 5;
                return enough ? Optional.empty() : Optional.of(new Velocity(0, 0.5));
            };
        });
    }

    static SubsumptionTable crowd(int robots) {
        Service avoid = new Service("avoid", false, Avoid.DEFAULT::behaviour);
        return SubsumptionTable.forRobots(robots)
                .ignoring(NamedColours.BLACK, "walls")
                .when(
                        NamedColours.BLUE,
                        Assignment.everyRobot(Service.SPACE_WANDERER).robots(3, 5, Service.WALL_FOLLOWER))
                .when(NamedColours.RED, Assignment.everyRobot(avoid.over(spin()).over(Service.SPACE_WANDERER)))
                .priority(NamedColours.RED, 1)
                .hold(2)
                .build();
    }

    static SubsumptionTable read(Path file) {
        var catalogue = ServiceCatalogue.standard().with(new ServiceCatalogue.Kind("spin", true, true, arguments -> {
            double rate = arguments.number("rate", 0.5);
            return () -> senses -> Optional.of(new Velocity(0, rate));
        }));
        return SubsumptionTableReader.read(file, catalogue);
    }

    /** Advances a world with the robots of a table by the given number of ticks. */
    private static void drive(
            Simulation simulation,
            SubsumptionTable table,
            ServiceObserver observer,
            Arbitrator.StateListener listener,
            int ticks)
            throws InterruptedException {
        var clock = simulation.clock();
        var settings = new SubsumptionRun.Settings(Mode.CALLBACK, "localhost", 6665, table, clock, observer, listener);
        try (var run = SubsumptionRun.start(settings.withReconnection(true))) {
            // advance the world; check() throws if a service has failed
            for (int i = 0; i < ticks; i++) {
                simulation.tick();
                run.check();
            }
        }
    }

    @Test
    void programOfOnesOwn_drivesTheRobotsOfAWorld() throws Exception {
        var scenario = ScenarioReader.read(Path.of("worlds", "paper-arena.world"));
        var cycles = new LongAdder();
        var observer = new ServiceObserver() {
            @Override
            public void serviceStarted(int robot, Service service) {}

            @Override
            public void cycleEnded(int robot, Service service) {
                cycles.increment();
            }

            @Override
            public void serviceEnded(int robot, Service service) {}
        };
        var states = new ArrayList<Integer>();
        try (var simulation = Simulation.open(scenario, WorldSettings.DEFAULT.withSeed(1))) {
            drive(
                    simulation,
                    SubsumptionTable.ofThePaper(),
                    observer,
                    (state, seenBy) -> states.add(state.number()),
                    20);
        }
        assertThat(states).startsWith(1);
        assertThat(cycles.sum()).isGreaterThanOrEqualTo(2 * 19);
    }

    private static Senses senses(double seconds) {
        var ranges = new float[16];
        Arrays.fill(ranges, 5);
        return new Senses(seconds, SonarRing.of(ranges), new RobotPose(0, 0, 0));
    }

    @Test
    void spin_hasNothingToSayAfterFiveSeconds_andTheWandererBelowDrives() {
        Service layers =
                crowd(6).state(NamedColours.RED).orElseThrow().services().getFirst();
        assertThat(layers).hasToString("avoid > spin > spaceWanderer");
        Behaviour law = layers.behaviour().get();
        assertThat(law.step(senses(10))).hasValue(new Velocity(0, 0.5));
        assertThat(law.step(senses(15))).hasValue(new Velocity(0, 0.5));
        assertThat(law.step(senses(15.1)).orElseThrow().forwardMps()).isEqualTo(0.5);
    }

    @Test
    void kindOfOnesOwn_isReadFromAFile(@TempDir Path directory) throws Exception {
        Path file = Files.writeString(
                directory.resolve("own.table"), "robots 1\nservice slow = spin(rate 0.25)\nstate red : slow\n");
        Behaviour law = read(file).first().services().getFirst().behaviour().get();
        assertThat(law.step(senses(0))).hasValue(new Velocity(0, 0.25));
    }

    @Test
    void fileOfTheGuide_isRead_andItsMistakeIsTold() {
        var catalogue = ServiceCatalogue.standard();
        var table = SubsumptionTableReader.parse(FIFTY, Path.of("my.table"), catalogue);
        assertThat(table.robots()).isEqualTo(50);
        assertThat(table.colourName(0xC8A2C8)).isEqualTo("lilac");
        String wrong = FIFTY.replace("* = spaceWanderer, 3..5 = wallFollower", "spaceWandrer");
        assertThatThrownBy(() -> SubsumptionTableReader.parse(wrong, Path.of("my.table"), catalogue))
                .hasMessage(
                        "my.table:6:14: there is no service called 'spaceWandrer', expected one of: patrol, wallFollower, spaceWanderer, goToGoal, avoid (did you mean 'spaceWanderer'?)");
    }
}
