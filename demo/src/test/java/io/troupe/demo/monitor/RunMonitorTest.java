package io.troupe.demo.monitor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.petri.wiring.Conformance;
import io.troupe.petri.wiring.ProtocolEvent;
import io.troupe.petri.wiring.WiringCheck;
import io.troupe.petri.wiring.WiringMonitor;
import io.troupe.petri.wiring.WiringMonitor.ViolationException;
import io.troupe.petri.wiring.WiringResult;
import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.ColourReport;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotServices;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.services.subsumption.ServiceObserver;
import io.troupe.services.subsumption.State;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.view.RecordedRun;
import io.troupe.view.RunLog;
import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.Set;
import java.util.concurrent.CountDownLatch;
import java.util.function.UnaryOperator;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/**
 * The main job does what it declares, and a changed program or a changed declaration is found.
 *
 * <p>The system properties {@code monitor.seeds} and {@code monitor.seconds} make it longer; 100 seeds of 10 simulated
 * seconds are two minutes for each mode.
 */
@Timeout(600)
class RunMonitorTest {
    private static final int SEEDS = Integer.getInteger("monitor.seeds", 4);
    private static final double SECONDS = Integer.getInteger("monitor.seconds", 10);
    private static final double LONG_SECONDS = 150; // with several switches
    private static final Scenario SCENARIO = ScenarioReader.read(Path.of("worlds/paper-arena.cfg"));
    private static final int ROBOTS = 2;

    @TempDir
    private Path directory;

    @ParameterizedTest
    @EnumSource
    void declaration_isProved(Mode mode) {
        assertThat(WiringCheck.check(RunWirings.of(mode, ROBOTS))).isInstanceOf(WiringResult.Proved.class);
    }

    @ParameterizedTest
    @EnumSource
    void runs_conform_andEachStepThatTheyNeedWouldBeMissed(Mode mode) throws IOException, InterruptedException {
        var runs = new Conformance(RunWirings.of(mode, ROBOTS), Set.of());
        for (int seed = 1; seed <= SEEDS; seed++) {
            runs.add(follow(mode, seed, seed == 1 ? LONG_SECONDS : SECONDS, false));
        }
        if (mode != Mode.SYNC) {
            runs.add(follow(mode, 1, LONG_SECONDS, true));
        }
        assertThat(runs.problems()).isEmpty();
        assertThat(runs.unused())
                .as("steps of the declaration that no run takes")
                .extracting(Object::toString)
                .isSubsetOf("inbox: \"judging\" does ignore the colour \"ready\""); // two colours in one reading
        assertThat(runs.used())
                .hasSizeGreaterThan(10)
                .allSatisfy(step -> assertThat(runs.without(step))
                        .as("the declaration without " + step)
                        .hasValueSatisfying(story -> assertThat(story).startsWith(step.component() + " ")));
    }

    private List<ProtocolEvent> follow(Mode mode, int seed, double seconds, boolean reconnects)
            throws IOException, InterruptedException {
        var monitor = WiringMonitor.of(RunWirings.of(mode, ROBOTS)).keepingEvents();
        var settings = RecordedRun.Settings.DEFAULT
                .withMode(mode)
                .withSeed(seed)
                .withSeconds(seconds)
                .withReconnection(reconnects);
        try (var log = new RunLog(directory.resolve("run.jsonl"))) {
            new RecordedRun(SCENARIO, SubsumptionTable.ofThePaper(), settings)
                    .run(log, new RunMonitor(mode, ROBOTS, monitor).listener(RecordedRun.Listener.NONE));
        }
        return monitor.events();
    }

    // ---- changed programs

    @ParameterizedTest
    @EnumSource(names = {"PROMISE", "CALLBACK"})
    void unchangedProgram_isAllowed(Mode mode) throws InterruptedException {
        assertThat(run(mode, services -> services)).isPositive();
    }

    @ParameterizedTest
    @EnumSource(names = {"PROMISE", "CALLBACK"})
    void stopThatIsNotWaitedFor_isFound(Mode mode) {
        assertThatThrownBy(() -> run(mode, services -> new Changed(services) {
                    @Override
                    public Promise<@Nullable Void> stop(int robot) {
                        super.stop(robot);
                        return Promise.done();
                    }
                }))
                .isInstanceOf(ViolationException.class)
                .hasMessageContaining("arbitrator asks stopper")
                .hasMessageContaining("service")
                .hasMessageContaining("waits for");
    }

    @ParameterizedTest
    @EnumSource(names = {"PROMISE", "CALLBACK"})
    void stopThatIsSentTwice_isFound(Mode mode) {
        assertThatThrownBy(() -> run(mode, services -> new Changed(services) {
                    @Override
                    public Promise<@Nullable Void> stop(int robot) {
                        super.stop(robot);
                        return super.stop(robot);
                    }
                }))
                .isInstanceOf(ViolationException.class)
                .hasMessageContaining("arbitrator asks stopper1.send is not allowed: arbitrator is in \"stopping 2\","
                        + " where it may ask stopper2.send");
    }

    @ParameterizedTest
    @EnumSource(names = {"PROMISE", "CALLBACK"})
    void answerThatIsLeftOut_isFound(Mode mode) {
        assertThatThrownBy(() -> run(mode, services -> new Changed(services) {
                    @Override
                    public Promise<@Nullable Void> stop(int robot) {
                        Promise<@Nullable Void> stopped = super.stop(robot);
                        return robot == 1 ? new Deferred<>() : stopped;
                    }
                }))
                .isInstanceOf(ViolationException.class)
                .hasMessageContaining("service1 takes answered from world is not allowed: service1 is in \"free\","
                        + " where it may take begin");
    }

    /** The services, in front of which a mistake can be made. */
    private static class Changed implements RobotServices {
        private final RobotServices services;

        Changed(RobotServices services) {
            this.services = services;
        }

        @Override
        public Promise<ServiceEnd> drive(int robot, String service, int stateColour) {
            return services.drive(robot, service, stateColour);
        }

        @Override
        public void drive(int robot, String service, Callback<ColourReport> reports) {
            services.drive(robot, service, reports);
        }

        @Override
        public Promise<@Nullable Void> stop(int robot) {
            return services.stop(robot);
        }
    }

    /** Runs the services without a broker until the second switch, and returns the number of switches. */
    private static int run(Mode mode, UnaryOperator<RobotServices> change) throws InterruptedException {
        var monitor = new RunMonitor(mode, ROBOTS);
        var switches = new int[1];
        var table = SubsumptionTable.ofThePaper();
        try (var simulation = Simulation.open(SCENARIO, WorldSettings.DEFAULT);
                var space = ActorSpace.create(SpaceSettings.named("robots")
                        .withClock(simulation.clock())
                        .withCallObserver(monitor.calls()))) {
            var settings =
                    RobotServicesActor.Settings.ofThePaper().withObserver(monitor.services(ServiceObserver.NONE));
            RobotServices services = space.spawn(RobotServices.class, () -> new RobotServicesActor(settings));
            Arbitrator.StateListener states = (State state, @Nullable Integer seenBy) -> {
                if (seenBy != null) {
                    switches[0]++;
                }
            };
            space.spawn(
                            Arbitrator.class,
                            () -> new Arbitrator(mode, change.apply(services), table, monitor.states(states)))
                    .live();
            var started = new CountDownLatch(1);
            space.onIdle(started::countDown);
            started.await();
            for (int tick = 0; tick < 3000 && switches[0] < 2; tick++) {
                monitor.tick();
                simulation.tick();
            }
            monitor.close();
        }
        return switches[0];
    }

    @Test
    void summary_countsTheEvents() {
        var monitor = new RunMonitor(Mode.SYNC, ROBOTS);
        monitor.tick();
        assertThat(monitor.summary()).isEqualTo("monitor: 0 events, all as declared for 2 robots in sync mode");
    }
}
