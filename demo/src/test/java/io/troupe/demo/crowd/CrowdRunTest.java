package io.troupe.demo.crowd;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.ActorServices;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerObserver;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.ConnectionSettings;
import io.troupe.broker.Need;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotServices;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.CrowdWorld;
import io.troupe.view.Pictures;
import io.troupe.view.RecordedRun;
import io.troupe.view.RunResult;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** Runs of crowds in the real world with real threads. */
@Timeout(300)
class CrowdRunTest {
    private static final int COLOURS = 8;

    @TempDir
    private Path out;

    private static SubsumptionTable table(int robots, double holdSeconds) {
        return CrowdTable.of(robots, CrowdWorld.colours(COLOURS), 3, holdSeconds, CornerStyle.FORWARD);
    }

    private RunResult run(int robots, double holdSeconds, double seconds, Mode mode, String file) throws Exception {
        var settings = RecordedRun.Settings.DEFAULT.withMode(mode).withSeconds(seconds);
        var scenario = CrowdWorld.scenario(robots, COLOURS);
        return new RecordedRun(scenario, table(robots, holdSeconds), settings).run(out.resolve(file));
    }

    @Test
    void thousandRobots_thatAllSwitchInOneTick_haveOneServiceEachAtEveryTick() throws Exception {
        RunResult result = run(1000, 0, 1, Mode.PROMISE, "run.jsonl");

        int switches = result.states().size() - 1;
        assertThat(switches).isPositive();
        var last = result.states().getLast().state().services();
        assertThat(result.robots()).hasSize(1000).allSatisfy(robot -> {
            assertThat(robot.chargeFaults()).isZero();
            assertThat(robot.ticksWithoutCycle()).isZero();
            assertThat(robot.loops().values().stream().mapToLong(loops -> loops).sum())
                    .as("a loop for each reading, and one more for each switch")
                    .isEqualTo(10 + switches);
            assertThat(robot.serviceName()).isEqualTo(last.get(robot.index()).name());
        });
    }

    @Test
    void hold_keepsAState() throws Exception {
        var states = run(200, 2, 10, Mode.PROMISE, "run.jsonl").states();

        assertThat(states).hasSizeBetween(2, 5);
        for (int i = 1; i < states.size(); i++) {
            assertThat(states.get(i).timeMicros() - states.get(i - 1).timeMicros())
                    .isGreaterThanOrEqualTo(2_000_000);
        }
    }

    @Test
    void sameSeed_sameFile_inEveryMode() throws Exception {
        for (Mode mode : Mode.values()) {
            run(50, 1, 5, mode, mode + "1");
            run(50, 1, 5, mode, mode + "2");
            assertThat(out.resolve(mode + "2")).hasSameBinaryContentAs(out.resolve(mode + "1"));
        }
    }

    @Test
    void crowd_logsItsPosesOnceASecond_andIsToldOfInSumsAndExtremes() throws Exception {
        RunResult result = run(50, 1, 3, Mode.PROMISE, "run.jsonl");

        assertThat(Files.readAllLines(out.resolve("run.jsonl")))
                .filteredOn(line -> line.contains("\"type\":\"pose\""))
                .hasSize(50 * 4);
        assertThat(result.summary())
                .contains("50 robots", "mean", "least", "most", "cycles of avoid > patrol1")
                .doesNotContain("robot 1 ");
        assertThat(result.states().getFirst().describe(result.table()))
                .endsWith("state 1: 16 avoid > patrol1, 17 spaceWanderer, 17 wallFollower");
    }

    @Test
    void picture_ofACrowd_hasAllBodiesAndNoNumbers() throws Exception {
        RunResult result = run(80, 1, 3, Mode.PROMISE, "run.jsonl");

        String svg = Pictures.trajectory(CrowdWorld.scenario(80, COLOURS).world(), result);

        assertThat(svg.split("fill=\"#ffa500\"", -1)).hasSize(80 + 1);
        assertThat(svg).contains("80 robots, 3.0 s simulated").doesNotContain("font-weight=\"bold\"");
    }

    /** Messages served per robot and tick by the actor space of broker, services and arbitrator. */
    private static double servedPerRobot(int robots) throws InterruptedException {
        int ticks = 10;
        var table = table(robots, CrowdTable.HOLD_SECONDS);
        try (var simulation = Simulation.open(CrowdWorld.scenario(robots, COLOURS), WorldSettings.DEFAULT);
                var space = ActorSpace.create(SpaceSettings.named("crowd").withClock(simulation.clock()))) {
            var settings = RobotServicesActor.Settings.ofThePaper().withTable(table);
            var broker = Broker.open(space, BrokerSettings.DEFAULT);
            var actors = new ActorServices(broker, "robots", space, BrokerObserver.logging());
            var type = RobotServices.class;
            actors.publish(space, type, RobotServices.SERVICE, List.of(), () -> new RobotServicesActor(settings));
            var need = Need.ofService("arbitrator", RobotServices.SERVICE);
            var services = actors.connect(type, need, ConnectionSettings.DEFAULT.withoutAnswerLimit())
                    .actor();
            Arbitrator arbitrator = space.spawn(
                    Arbitrator.class, () -> new Arbitrator(Mode.PROMISE, services, table, (state, seenBy) -> {}));
            arbitrator.live();
            var begun = new CountDownLatch(1);
            space.onIdle(begun::countDown);
            begun.await();
            simulation.tick(); // reaches the initial state and an idle space
            long before = space.metrics().served();
            for (int tick = 0; tick < ticks; tick++) {
                simulation.tick();
            }
            return (double) (space.metrics().served() - before) / ticks / robots;
        }
    }

    @Test
    @Timeout(120)
    void messagesOfATick_growAsTheCrowdDoes() throws Exception {
        double few = servedPerRobot(50);
        assertThat(few).isPositive();
        assertThat(servedPerRobot(500)).isCloseTo(few, within(few / 10));
    }
}
