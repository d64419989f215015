package io.troupe.demo.crowd;

import com.sun.management.OperatingSystemMXBean;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
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
import io.troupe.sim.worldfile.CrowdWorld;
import io.troupe.tools.UsedHeap;
import io.troupe.view.live.LiveView;
import io.troupe.view.live.RunControl;
import io.troupe.view.live.ViewControl;
import io.troupe.view.live.ViewedRun;
import java.lang.management.ManagementFactory;
import java.lang.management.ThreadMXBean;
import java.util.concurrent.atomic.AtomicReferenceArray;
import java.util.function.Consumer;
import java.util.function.DoubleConsumer;
import org.jspecify.annotations.Nullable;

/**
 * Runs a crowd and measures it: world, in-process Player connections, one actor space with arbitrator and services, in
 * lock step.
 *
 * <p><b>Threads.</b> The calling thread advances the world, the actor space's thread does everything else. At any time
 * one of the two waits for the other, so their processor times split the cost of a tick into world and services.
 */
final class CrowdTrial {
    /**
     * What to run.
     *
     * @param seconds minimum simulated time to measure
     */
    record Settings(int robots, int colours, int services, double seconds, long seed) {}

    /**
     * The measured cost.
     *
     * @param wallNanos from the first measured tick to the last
     * @param processorNanos of all threads, including compiler and garbage collector
     * @param worldNanos processor time of the thread that advances the world
     * @param servicesNanos processor time of the actor space's thread: frames, Player clients, services, arbitrator
     * @param retainedBytes heap retained by the whole crowd: world, connections, actors
     * @param states number of states that started in the measured ticks
     */
    record Result(
            int robots,
            long ticks,
            long intervalMicros,
            long wallNanos,
            long processorNanos,
            long worldNanos,
            long servicesNanos,
            long retainedBytes,
            int states) {
        /** By the wall clock. */
        double timesRealTime() {
            return ticks * intervalMicros * 1000.0 / wallNanos;
        }

        /** By the processor time of all threads: the speed on one core without other programs. */
        double timesRealTimeOfOneCore() {
            return ticks * intervalMicros * 1000.0 / processorNanos;
        }

        double micros() {
            return perRobotAndTick(processorNanos);
        }

        double worldMicros() {
            return perRobotAndTick(worldNanos);
        }

        double servicesMicros() {
            return perRobotAndTick(servicesNanos);
        }

        private double perRobotAndTick(long nanos) {
            return nanos / 1000.0 / robots / ticks;
        }

        double retainedKilobytesPerRobot() {
            return retainedBytes / 1000.0 / robots;
        }
    }

    private static final int WARM_UP_TICKS = 20;
    /** Minimum wall-clock time: a few robots simulate ten seconds too fast to be measured. */
    private static final long LEAST_WALL_NANOS = 500_000_000;

    private static final OperatingSystemMXBean PROCESS =
            ManagementFactory.getPlatformMXBean(OperatingSystemMXBean.class);
    private static final ThreadMXBean THREADS = ManagementFactory.getThreadMXBean();

    /** Counts states and records the thread that runs the services. */
    private static final class Watch implements Arbitrator.StateListener {
        private volatile long servicesThread;
        private volatile int states;

        @Override
        public void stateStarted(State state, @Nullable Integer seenBy) {
            servicesThread = Thread.currentThread().threadId();
            states = states + 1; // written by one thread only
        }
    }

    /** Knows which service drives each robot. */
    private static final class Drivers implements ServiceObserver {
        private final AtomicReferenceArray<String> services;

        Drivers(int robots) {
            services = new AtomicReferenceArray<>(robots);
        }

        @Override
        public void serviceStarted(int robot, Service service) {
            services.set(robot, service.name());
        }

        @Override
        public void cycleEnded(int robot, Service service) {}

        @Override
        public void serviceEnded(int robot, Service service) {}

        String of(int robot) {
            String name = services.get(robot);
            return name == null ? "none" : name;
        }
    }

    private final Settings settings;
    private final SubsumptionTable table;
    private final @Nullable LiveView page;

    CrowdTrial(Settings settings) {
        this(settings, null);
    }

    /** @param page that shows the crowd; null = none */
    CrowdTrial(Settings settings, @Nullable LiveView page) {
        this.page = page;
        this.settings = settings;
        this.table = CrowdTable.of(
                settings.robots(),
                CrowdWorld.colours(settings.colours()),
                settings.services(),
                CrowdTable.HOLD_SECONDS,
                CornerStyle.FORWARD);
    }

    /** @param progress called with the completed share, from 0 to 1 */
    Result run(DoubleConsumer progress) throws InterruptedException {
        long before = UsedHeap.bytes();
        Consumer<Snapshot> show = snapshot -> {};
        var scenario = CrowdWorld.scenario(settings.robots(), settings.colours());
        try (var simulation = Simulation.open(scenario, WorldSettings.defaults().withSeed(settings.seed()))) {
            var watch = new Watch();
            var drivers = new Drivers(settings.robots());
            int port = scenario.devices().getFirst().port();
            var robots = RobotServicesActor.Settings.defaults()
                    .withPort(port)
                    .withTable(table)
                    .withObserver(page == null ? ServiceObserver.none() : drivers);
            var services = SubsumptionRun.Settings.defaults()
                    .withMode(Mode.PROMISE)
                    .withRobots(robots)
                    .withClock(simulation.clock())
                    .withListener(watch)
                    .withCallObserver(page == null ? null : page.callGraph());
            if (page != null) {
                var viewed =
                        new ViewedRun(scenario.world(), table, new RunControl(0, false)).onto(page, ViewControl.NONE);
                show = snapshot -> viewed.moved(snapshot, drivers::of);
            }
            try (var running = SubsumptionRun.start(services)) {
                for (int tick = 0; tick < WARM_UP_TICKS; tick++) {
                    show.accept(simulation.tick());
                }
                Result timed = measure(simulation, running, watch, show, progress);
                return withRetained(timed, UsedHeap.bytes() - before);
            }
        }
    }

    private Result measure(
            Simulation simulation,
            SubsumptionRun running,
            Watch watch,
            Consumer<Snapshot> show,
            DoubleConsumer progress) {
        long intervalMicros = simulation.world().spec().intervalMillis() * 1000L;
        long leastTicks = StrictMath.max(1, StrictMath.round(settings.seconds() * 1e6 / intervalMicros));
        long services = THREADS.getThreadCpuTime(watch.servicesThread);
        long processor = PROCESS.getProcessCpuTime();
        long world = THREADS.getCurrentThreadCpuTime();
        int states = watch.states;
        long begin = System.nanoTime();
        long wallNanos = 0;
        long ticks = 0;
        while (ticks < leastTicks || wallNanos < LEAST_WALL_NANOS) {
            show.accept(simulation.tick());
            running.check();
            ticks++;
            wallNanos = System.nanoTime() - begin;
            progress.accept(Math.min((double) ticks / leastTicks, (double) wallNanos / LEAST_WALL_NANOS));
        }
        return new Result(
                settings.robots(),
                ticks,
                intervalMicros,
                wallNanos,
                PROCESS.getProcessCpuTime() - processor,
                THREADS.getCurrentThreadCpuTime() - world,
                THREADS.getThreadCpuTime(watch.servicesThread) - services,
                0,
                watch.states - states);
    }

    private static Result withRetained(Result trial, long bytes) {
        return new Result(
                trial.robots(),
                trial.ticks(),
                trial.intervalMicros(),
                trial.wallNanos(),
                trial.processorNanos(),
                trial.worldNanos(),
                trial.servicesNanos(),
                bytes,
                trial.states());
    }
}
