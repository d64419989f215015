package io.troupe.demo.evaluate;

import io.troupe.actor.Clock;
import io.troupe.common.text.NamedColours;
import io.troupe.demo.evaluate.Measurement.Kind;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.SubsumptionRun;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Simulation;
import io.troupe.sim.model.Scenario;
import io.troupe.tools.MeasuringJvm;
import java.nio.file.Path;
import java.util.List;

/**
 * Executes jobs. The main class of the JVM of a {@link Evaluation.MeasuringProcess}.
 *
 * <p><b>Threads.</b> The calling thread advances the world if the job has a separate one. The services run on a
 * separate thread.
 */
final class JobRunner {
    private static final long POLL_MILLIS = 20;
    /** More than any mode needs for a loop of both services; a run that exceeds it makes no progress. */
    private static final int MOST_TICKS_PER_LOOP = 4;

    private final Scenario scenario;
    private final int port;

    /** @param port that offers the robots of the scenario */
    JobRunner(Scenario scenario, int port) {
        this.scenario = scenario;
        this.port = port;
    }

    /** @param arguments the world file */
    public static void main(String[] arguments) throws Exception {
        MeasuringJvm.serve(() -> {
            var world = PaperWorld.read(Path.of(arguments[0]));
            var runner = new JobRunner(world.scenario(), world.port());
            return request -> runner.measure(Job.parse(request)).lines();
        });
    }

    Job.Result measure(Job job) throws InterruptedException {
        return job.server() == 0 ? inLockStep(job) : inRealTime(job);
    }

    private Job.Result inLockStep(Job job) throws InterruptedException {
        try (var simulation = Simulation.open(scenario, PaperWorld.settings(job.seed()))) {
            long intervalNanos = scenario.world().intervalMillis() * 1_000_000L;
            var time = new Meter.RobotClock() {
                @Override
                public long nanos() {
                    return simulation.clock().nanos();
                }

                @Override
                public long endOfCycleNanos() {
                    return nanos() + intervalNanos;
                }
            };
            Meter meter = meter(job, time);
            long mostTicks = job.countsLoops() ? (long) MOST_TICKS_PER_LOOP * job.loops() : Long.MAX_VALUE;
            try (var run = SubsumptionRun.start(settings(job, "localhost", port, simulation.clock(), meter))) {
                for (long tick = 0; !meter.isDone(); tick++) {
                    if (tick == mostTicks) {
                        throw new IllegalStateException(job.title() + ": after " + tick
                                + " readings the services have not done " + job.loops() + " loops each");
                    }
                    simulation.tick();
                    run.check();
                }
                return meter.result();
            }
        }
    }

    private static Job.Result inRealTime(Job job) throws InterruptedException {
        var clock = Clock.system();
        var time = new Meter.RobotClock() {
            @Override
            public long nanos() {
                return clock.nanos();
            }

            @Override
            public long endOfCycleNanos() {
                return clock.nanos();
            }
        };
        Meter meter = meter(job, time);
        try (var run = SubsumptionRun.start(settings(job, "127.0.0.1", job.server(), clock, meter))) {
            while (!meter.isDone()) {
                Thread.sleep(POLL_MILLIS);
                run.check();
            }
        }
        return meter.result();
    }

    private static SubsumptionRun.Settings settings(Job job, String host, int port, Clock clock, Meter meter) {
        var robots = RobotServicesActor.Settings.defaults()
                .withHost(host)
                .withPort(port)
                .withTable(table(job))
                .withObserver(meter)
                .withReconnection(job.kind() == Kind.RECONNECTS);
        return SubsumptionRun.Settings.defaults()
                .withMode(job.mode())
                .withRobots(robots)
                .withClock(clock)
                .withListener(meter);
    }

    private static Meter meter(Job job, Meter.RobotClock time) {
        return job.countsLoops()
                ? new LoopMeter(job.mode(), table(job).first(), job.loops(), time)
                : new SwitchMeter(job.seconds(), time);
    }

    private static SubsumptionTable table(Job job) {
        return switch (job.kind()) {
            case LOOPS -> oneState();
            case ALONE -> alone(service(job.subject()));
            case SWITCHES, RECONNECTS -> SubsumptionTable.ofThePaper();
        };
    }

    private static Service service(String name) {
        return List.of(Service.WALL_FOLLOWER, Service.SPACE_WANDERER).stream()
                .filter(each -> each.name().equals(name))
                .findFirst()
                .orElseThrow(() -> new IllegalArgumentException("there is no service " + name));
    }

    /**
     * One state that never ends: robot 1 follows walls, robot 2 wanders. Blue is the only colour with a state, and
     * leads to this one.
     */
    static SubsumptionTable oneState() {
        return SubsumptionTable.forRobots(2)
                .state(NamedColours.BLUE, Service.WALL_FOLLOWER, Service.SPACE_WANDERER)
                .build();
    }

    /** Robot 1 alone, in one state that never ends. */
    private static SubsumptionTable alone(Service service) {
        return SubsumptionTable.forRobots(1)
                .state(NamedColours.BLUE, service)
                .allowFinal()
                .build();
    }
}
