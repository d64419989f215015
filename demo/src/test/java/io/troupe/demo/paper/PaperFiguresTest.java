package io.troupe.demo.paper;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.time.Clock;
import io.troupe.player.BlobfinderInterface;
import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerException;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotServices;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.services.subsumption.ServiceObserver;
import io.troupe.services.subsumption.SubsumptionRun;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Path;
import java.util.AbstractList;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.FutureTask;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/**
 * The paper's connection with a robot gets data, and its main code drives the robots of its arena with the same result
 * as our modes.
 */
@Timeout(120)
class PaperFiguresTest {
    private static final int TICKS = 1_500;

    private final List<String> ofThePaper = new ArrayList<>();
    private final List<String> ours = new ArrayList<>();

    private static Simulation open() {
        var scenario = ScenarioReader.read(Path.of("worlds", "paper-arena.world"));
        return Simulation.open(scenario, WorldSettings.DEFAULT);
    }

    private static void tick(Simulation simulation, int times) {
        for (int tick = 0; tick < times; tick++) {
            simulation.tick();
        }
    }

    /** A list that prefixes added lines with the simulated time. */
    private static List<String> stamped(Clock clock, List<String> lines) {
        return new AbstractList<>() {
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

    private void assertSameThroughAllThreeStates() {
        assertThat(ofThePaper)
                .hasSizeGreaterThan(3)
                .anyMatch(line -> line.endsWith("State 2"))
                .anyMatch(line -> line.endsWith("State 3"))
                .isEqualTo(ours);
        assertThat(ofThePaper.getFirst()).endsWith("State 1");
    }

    /** The check solves the paper's first challenge: data are ready before a service starts. */
    @Test
    @Timeout(60)
    void connectionOfFigure7_getsSensorData() throws InterruptedException {
        try (var simulation = open()) {
            PlayerClient robot = null;
            Position2DInterface posi1 = null;
            SonarInterface rngi1 = null;
            BlobfinderInterface blfi1 = null;

            try {
                // Connect to the Player server and request access to Position and Sonar
                robot = new PlayerClient("localhost", 6665);
                posi1 = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
                rngi1 = robot.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
                blfi1 = robot.requestInterfaceBlobfinder(0, PlayerConstants.PLAYER_OPEN_MODE);
            } catch (PlayerException e) {
                System.err.println("robot1: > Error connecting to Player: ");
                System.err.println("    [ " + e.toString() + " ]");
                throw e;
            }

            robot.runThreaded(-1, -1);

            var world = Thread.ofPlatform().start(simulation::tick);
            while (!rngi1.isDataReady())
                ;
            while (!posi1.isDataReady())
                ;
            while (!blfi1.isDataReady())
                ;
            assertThat(rngi1.getData().getRanges()).hasSize(16);
            assertThat(posi1.getX()).isZero();
            assertThat(blfi1.getData().getBlobs_count()).isZero(); // nothing within its 2 m
            assertThat(rngi1.isDataReady()).isFalse(); // no newer data: this call answers the tick
            world.join();
            robot.close();
        }
    }

    @Test
    void demo1OfFigure14_goesThroughAllThreeStates_asTheSynchronousModeDoes() throws InterruptedException {
        FutureTask<?> main;
        try (var simulation = open()) {
            var demo = new Demo1(stamped(simulation.clock(), ofThePaper));
            demo.connect();
            main = new FutureTask<>(demo, null);
            Thread.ofPlatform().name("Demo1").start(main);
            tick(simulation, 2 * TICKS);
        }
        assertThatThrownBy(main::get)
                .cause()
                .isInstanceOf(PlayerException.class)
                .hasMessageContaining("has been closed");
        try (var simulation = open()) {
            var table = SubsumptionTable.ofThePaper();
            var lines = stamped(simulation.clock(), ours);
            Arbitrator.StateListener listener = (state, seenBy) -> lines.add("State " + state.number());
            var settings = new SubsumptionRun.Settings(
                    Mode.SYNC, "localhost", 6665, table, simulation.clock(), ServiceObserver.NONE, listener);
            try (var run = SubsumptionRun.start(settings)) {
                tick(simulation, 2 * TICKS);
                run.check();
            }
        }
        assertSameThroughAllThreeStates();
    }

    /** Starts main code, which writes stamped lines. */
    private interface Application {
        void start(ActorSpace space, List<String> printed);
    }

    private static void drive(List<String> lines, Application application) {
        var problems = new ArrayList<Throwable>();
        try (var simulation = open();
                var space = ActorSpace.create(SpaceSettings.named("robots")
                        .withClock(simulation.clock())
                        .withHandCrank()
                        .withOnError((where, error) -> problems.add(error)))) {
            simulation.whileWaiting(space::crank);
            application.start(space, stamped(space.clock(), lines));
            space.crank();
            tick(simulation, TICKS);
        }
        assertThat(problems).isEmpty();
    }

    private static PaperServices paperServices(ActorSpace space) {
        return space.spawn(PaperServices.class, PaperServices::new);
    }

    /** Our arbitrator and robot services, which write states, and the colours before them, as the paper's code does. */
    private static Application arbitrator(Mode mode, String colourPrefix) {
        return (space, printed) -> {
            var table = SubsumptionTable.ofThePaper();
            var settings = RobotServicesActor.Settings.ofThePaper();
            RobotServices services = space.spawn(RobotServices.class, () -> new RobotServicesActor(settings));
            Arbitrator.StateListener listener = (state, seenBy) -> {
                if (seenBy != null) {
                    printed.add(colourPrefix + state.colour());
                }
                printed.add("State " + state.number());
            };
            space.spawn(Arbitrator.class, () -> new Arbitrator(mode, services, table, listener))
                    .live();
        };
    }

    @Test
    void demo2OfFigure17_goesThroughAllThreeStates_asTheArbitratorDoes() {
        drive(ofThePaper, (space, printed) -> {
            PaperServices robot1 = paperServices(space);
            PaperServices robot2 = paperServices(space);
            space.spawn(Demo2.class, () -> new Demo2(robot1, robot2, printed)).live();
        });
        drive(ours, arbitrator(Mode.CALLBACK, "received color "));
        assertSameThroughAllThreeStates();
    }

    @Test
    void demo3OfFigure20_goesThroughAllThreeStates_asTheArbitratorDoes() {
        drive(ofThePaper, (space, printed) -> {
            PaperServices robot1 = paperServices(space);
            PaperServices robot2 = paperServices(space);
            space.spawn(Demo3.class, () -> new Demo3(robot1, robot2, printed)).live();
        });
        drive(ours, arbitrator(Mode.PROMISE, "color"));
        assertSameThroughAllThreeStates();
    }
}
