package io.troupe.demo.monitor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.catchThrowable;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.demo.OwnPort;
import io.troupe.petri.wiring.Conformance;
import io.troupe.petri.wiring.ProtocolEvent;
import io.troupe.petri.wiring.WiringCheck;
import io.troupe.petri.wiring.WiringMonitor;
import io.troupe.petri.wiring.WiringMonitor.ViolationException;
import io.troupe.petri.wiring.WiringResult;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.LeasedRobots;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotServices;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceObserver;
import io.troupe.services.subsumption.State;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.tools.Thorough;
import io.troupe.view.RecordedRun;
import io.troupe.view.RunLog;
import io.troupe.view.RunRecorder;
import java.io.IOException;
import java.nio.file.Path;
import java.util.EnumMap;
import java.util.EnumSet;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Random;
import java.util.Set;
import java.util.concurrent.CountDownLatch;
import java.util.function.UnaryOperator;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.api.parallel.Execution;
import org.junit.jupiter.api.parallel.ExecutionMode;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/**
 * The main job does what it declares, and a changed program or a changed declaration is found.
 *
 * <p>The system properties {@code monitor.seeds} and {@code monitor.seconds} make it longer; 100 seeds of 10 simulated
 * seconds are two minutes for each mode.
 */
@Timeout(600)
@Execution(ExecutionMode.CONCURRENT)
class RunMonitorTest {
    private static final int SEEDS = Integer.getInteger("monitor.seeds", Thorough.times(2, 4));
    private static final double SECONDS = Integer.getInteger("monitor.seconds", 10);
    private static final double LONG_SECONDS = 150; // with several switches
    private static final int ROBOTS = 2;

    private final Scenario scenario = OwnPort.of(ScenarioReader.read(Path.of("worlds/paper-arena.cfg")));

    @TempDir
    private Path directory;

    @ParameterizedTest
    @EnumSource
    void declaration_isProved(Mode mode) {
        assertThat(WiringCheck.check(RunWiring.of(mode, ROBOTS))).isInstanceOf(WiringResult.Proved.class);
    }

    /** A failure ends the run, so it blocks the others; without it nothing does. */
    @ParameterizedTest
    @EnumSource
    void declarationWithFailures_hasNoDeadlock_andOnlyAFailureBlocks(Mode mode) {
        var result = WiringCheck.check(RunWiring.withFailures(mode, ROBOTS));
        assertThat(result)
                .isInstanceOfSatisfying(
                        WiringResult.Blocked.class,
                        blocked -> assertThat(blocked.counterexample().firings())
                                .anyMatch(step -> step.contains(" fails") || step.contains("lose the connection")));
    }

    @ParameterizedTest
    @EnumSource
    void runs_conform_andEachStepThatTheyNeedWouldBeMissed(Mode mode) throws IOException, InterruptedException {
        var runs = new Conformance(RunWiring.of(mode, ROBOTS), Set.of());
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

    // ---- runs with a fault

    /** What goes wrong in a run, once, at the first opportunity after a random time. */
    private enum Fault {
        CYCLE_FAILS,
        COMMAND_FAILS,
        REPORT_FAILS,
        STOP_FAILS,
        CONNECTION_IS_LOST
    }

    private static final class FaultException extends IllegalStateException {
        private static final long serialVersionUID = 1;

        FaultException(Fault fault) {
            super(fault + " by intent");
        }
    }

    /** Makes a service of a random robot fail, or closes the world under all of them. */
    private static final class Faulty implements RecordedRun.Listener {
        private final Fault fault;
        private final int robot;
        private final long afterMicros;
        private volatile long nowMicros;
        private volatile boolean happened;

        Faulty(Fault fault, Random random) {
            this.fault = fault;
            this.robot = random.nextInt(ROBOTS);
            this.afterMicros = 1_000_000 + random.nextInt(8_000_000);
        }

        private void at(Fault here, int itsRobot) {
            if (!happened && fault == here && itsRobot == robot && nowMicros >= afterMicros) {
                happened = true;
                throw new FaultException(fault);
            }
        }

        @Override
        public void ticked(long timeMicros) {
            nowMicros = timeMicros;
        }

        @Override
        public void beforeTick(Simulation simulation, RunRecorder recorder) {
            if (!happened && fault == Fault.CONNECTION_IS_LOST && nowMicros >= afterMicros) {
                happened = true;
                simulation.close();
            }
        }

        @Override
        public ServiceObserver services(ServiceObserver recorder) {
            return new ServiceObserver() {
                @Override
                public void serviceStarted(int its, Service service) {
                    recorder.serviceStarted(its, service);
                }

                @Override
                public void cycleStarted(int its, Service service) {
                    at(Fault.CYCLE_FAILS, its);
                    recorder.cycleStarted(its, service);
                }

                @Override
                public void commanded(int its, Service service, Velocity velocity) {
                    at(Fault.COMMAND_FAILS, its);
                    recorder.commanded(its, service, velocity);
                }

                @Override
                public void cycleEnded(int its, Service service) {
                    recorder.cycleEnded(its, service);
                }

                @Override
                public void serviceEnded(int its, Service service) {
                    recorder.serviceEnded(its, service);
                    at(Fault.STOP_FAILS, its);
                }

                @Override
                public void colourSent(int its, int colour) {
                    recorder.colourSent(its, colour);
                    at(Fault.REPORT_FAILS, its);
                }
            };
        }
    }

    @ParameterizedTest
    @EnumSource
    void runsWithFaults_conform_andEndWithTheFault(Mode mode) throws IOException {
        var runs = new Conformance(RunWiring.withFailures(mode, ROBOTS), Set.of());
        var happened = new EnumMap<Fault, Integer>(Fault.class);
        int seeds = Math.max(SEEDS, Fault.values().length);
        for (int seed = 1; seed <= seeds; seed++) {
            var fault = Fault.values()[seed % Fault.values().length];
            var faulty = new Faulty(fault, new Random(seed));
            var monitor = WiringMonitor.of(RunWiring.withFailures(mode, ROBOTS)).keepingEvents();
            var settings = RecordedRun.Settings.defaults()
                    .withMode(mode)
                    .withSeed(seed)
                    .withSeconds(fault == Fault.STOP_FAILS || fault == Fault.REPORT_FAILS ? LONG_SECONDS : 10);
            var run = new RecordedRun(scenario, SubsumptionTable.ofThePaper(), settings);
            try (var log = new RunLog(directory.resolve("run.jsonl"))) {
                var failure =
                        catchThrowable(() -> run.run(log, new RunMonitor(mode, ROBOTS, monitor).listener(faulty)));
                assertThat(monitor.violation())
                        .as("%s mode, seed %s, %s", mode, seed, fault)
                        .isEmpty();
                assertThat(failure)
                        .as("%s mode, seed %s, %s", mode, seed, fault)
                        .satisfies(why -> assertThat(why != null).isEqualTo(faulty.happened));
            }
            if (faulty.happened) {
                happened.merge(fault, 1, Integer::sum);
            }
            runs.add(monitor.events());
        }
        assertThat(runs.problems()).isEmpty();
        assertThat(happened.keySet())
                .as("faults that happened")
                .containsAll(EnumSet.of(Fault.CYCLE_FAILS, Fault.CONNECTION_IS_LOST));
        assertThat(runs.used())
                .allSatisfy(step -> assertThat(runs.without(step))
                        .as("the declaration without " + step)
                        .isPresent());
    }

    private List<ProtocolEvent> follow(Mode mode, int seed, double seconds, boolean reconnects)
            throws IOException, InterruptedException {
        var monitor = WiringMonitor.of(RunWiring.of(mode, ROBOTS)).keepingEvents();
        var settings = RecordedRun.Settings.defaults()
                .withMode(mode)
                .withSeed(seed)
                .withSeconds(seconds)
                .withReconnection(reconnects);
        try (var log = new RunLog(directory.resolve("run.jsonl"))) {
            new RecordedRun(scenario, SubsumptionTable.ofThePaper(), settings)
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
                    public Promise<@Nullable Void> stop(Lease lease, int robot) {
                        end(robot, new ServiceEnd(Optional.empty(), false));
                        return super.stop(lease, robot);
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
                    public Promise<@Nullable Void> stop(Lease lease, int robot) {
                        super.stop(lease, robot);
                        return super.stop(lease, robot);
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
                    public Promise<@Nullable Void> stop(Lease lease, int robot) {
                        leaveOut(robot);
                        return super.stop(lease, robot);
                    }
                }))
                .isInstanceOf(ViolationException.class)
                .hasMessageContaining("service1 takes answered from world is not allowed: service1 is in \"free\","
                        + " where it may take begin");
    }

    /** The services, in front of which a mistake can be made. */
    private static class Changed implements RobotServices {
        private final RobotServices services;
        private final Map<Integer, Deferred<ServiceEnd>> ends = new HashMap<>(); // by robot

        Changed(RobotServices services) {
            this.services = services;
        }

        /** The call for a robot ends now, for its caller. */
        void end(int robot, ServiceEnd how) {
            ends.get(robot).resolve(how);
        }

        /** The call for a robot never ends, for its caller. */
        void leaveOut(int robot) {
            ends.put(robot, new Deferred<>());
        }

        private Promise<ServiceEnd> changeable(int robot, Promise<ServiceEnd> real) {
            var changed = new Deferred<ServiceEnd>();
            ends.put(robot, changed);
            real.handle((how, error) -> {
                if (ends.get(robot) == changed) {
                    changed.resolveFrom(real);
                }
                return null;
            });
            return changed;
        }

        @Override
        public Promise<Stamp> stamp() {
            return services.stamp();
        }

        @Override
        public Promise<ServiceEnd> drive(Lease lease, int robot, String service, int stateColour) {
            return changeable(robot, services.drive(lease, robot, service, stateColour));
        }

        @Override
        public Promise<ServiceEnd> report(Lease lease, int robot, String service, Callback<ColourReport> reports) {
            return changeable(robot, services.report(lease, robot, service, reports));
        }

        @Override
        public Promise<Renewal> renew(Lease lease, int robot) {
            return services.renew(lease, robot);
        }

        @Override
        public Promise<@Nullable Void> stop(Lease lease, int robot) {
            return services.stop(lease, robot);
        }
    }

    /** Runs the services without a broker until the second switch, and returns the number of switches. */
    private int run(Mode mode, UnaryOperator<RobotServices> change) throws InterruptedException {
        var monitor = new RunMonitor(mode, ROBOTS);
        var switches = new int[1];
        var table = SubsumptionTable.ofThePaper();
        try (var simulation = Simulation.open(scenario, WorldSettings.defaults());
                var space = ActorSpace.create(SpaceSettings.named("robots")
                        .withClock(simulation.clock())
                        .withCallObserver(monitor.calls()))) {
            var settings = RobotServicesActor.Settings.defaults()
                    .withPort(scenario.robotPort().orElseThrow())
                    .withObserver(monitor.services(ServiceObserver.none()));
            RobotServices services = space.spawn(RobotServices.class, () -> new RobotServicesActor(settings));
            Arbitrator.StateListener states = (State state, @Nullable Integer seenBy) -> {
                if (seenBy != null) {
                    switches[0]++;
                }
            };
            space.spawn(
                            Arbitrator.class,
                            () -> new Arbitrator(
                                    mode, LeasedRobots.of(change.apply(services)), table, monitor.states(states)))
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
