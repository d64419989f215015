package io.troupe.view;

import io.troupe.actor.CallObserver;
import io.troupe.common.text.Plural;
import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.services.subsumption.ServiceObserver;
import io.troupe.services.subsumption.SubsumptionRun;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.services.subsumption.SynchronousRound;
import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.worldfile.WorldFileException;
import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.Set;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/**
 * One run of the main job: the robots of a scenario, controlled by the paper's arbitrator, in lock step with the
 * simulated world, and recorded.
 *
 * {@snippet :
 * Scenario scenario = ScenarioReader.read(world);
 * var settings = RecordedRun.Settings.defaults().withSeed(7).withSeconds(60);
 * var run = new RecordedRun(scenario, SubsumptionTable.ofThePaper(), settings);
 * RunResult result = run.run(folder.resolve("run.jsonl"));
 * Files.writeString(folder.resolve("summary.txt"), result.summary());
 * Files.writeString(folder.resolve("trajectory.svg"), Pictures.trajectory(scenario.world(), result));
 * }
 *
 * <p><b>Threads.</b> The calling thread advances the world, another thread runs the services. At any time one of the
 * two waits for the other.
 *
 * <p><b>Order.</b> The same scenario, table and settings give the same log, byte for byte, on every machine.
 *
 * <p><b>Errors.</b> A world without the devices that the services need is a {@link WorldFileException}. A service that
 * fails ends the run with its exception; the last line of the log reports it.
 *
 * <p><b>Source.</b> Paper, sections 3.4 to 3.6.
 */
public final class RecordedRun {
    private static final double JITTER_M = 0.02;
    private static final double JITTER_RAD = StrictMath.toRadians(2);

    private static final int SONARS = 8;

    private final Scenario scenario;
    private final int port;
    private final SubsumptionTable table;
    private final Settings settings;

    /** A device that the world's configuration offers. */
    private record Binding(String type, int index, String model) {}

    /** How to run. */
    public static final class Settings extends io.troupe.actor.Settings<Settings> {
        private static final Settings DEFAULTS = new Settings();

        private Mode mode = Mode.PROMISE;
        private long seed = 1;
        private double seconds = 300;
        private boolean realTime;
        private boolean reconnects;
        private SynchronousRound round = SynchronousRound.ONE_SERVICE_A_READING;

        private Settings() {}

        /** Promise mode, seed 1, 300 s as fast as possible, one connection per robot, the paper's synchronous round. */
        public static Settings defaults() {
            return DEFAULTS;
        }

        @Override
        protected void check() {} // each value makes sense

        long endMicros() {
            return StrictMath.round(seconds * 1e6);
        }

        /** One of the paper's three modes. */
        public Settings withMode(Mode newMode) {
            return with(copy -> copy.mode = newMode);
        }

        /** Moves the start poses by up to 2 cm along x and y, and 2 degrees. */
        public Settings withSeed(long newSeed) {
            return with(copy -> copy.seed = newSeed);
        }

        /** The simulated time to run. */
        public Settings withSeconds(double newSeconds) {
            return with(copy -> copy.seconds = newSeconds);
        }

        /** No faster than real time. */
        public Settings withRealTime(boolean newRealTime) {
            return with(copy -> copy.realTime = newRealTime);
        }

        /** Whether every service opens a new connection; not in synchronous mode. */
        public Settings withReconnection(boolean newReconnects) {
            return with(copy -> copy.reconnects = newReconnects);
        }

        /** How the synchronous mode distributes readings among the services. */
        public Settings withRound(SynchronousRound newRound) {
            return with(copy -> copy.round = newRound);
        }

        public Mode mode() {
            return mode;
        }

        public long seed() {
            return seed;
        }

        public double seconds() {
            return seconds;
        }

        public boolean realTime() {
            return realTime;
        }

        public boolean reconnects() {
            return reconnects;
        }

        public SynchronousRound round() {
            return round;
        }
    }

    /** What a run reports while it runs, on the thread that called {@link RecordedRun#run}. */
    public interface Listener {
        /** Does nothing, and lets the run reach its end. */
        Listener NONE = new Listener() {};

        /** A state began; {@code line} describes it. */
        default void stateStarted(String line) {}

        /** The next interval begins now; may wait, and may change the world. */
        default void beforeTick(Simulation simulation, RunRecorder recorder) throws InterruptedException {}

        /** The world at the start or after a tick is recorded. */
        default void recorded(Snapshot snapshot, RunRecorder recorder) {}

        /** A reading of the sensors was handled. */
        default void ticked(long timeMicros) {}

        /** Whether to end the run now. */
        default boolean isStopRequested() {
            return false;
        }

        /** Observes the calls of the services and the arbitrator; null = none. */
        default @Nullable CallObserver callObserver() {
            return null;
        }

        /** Returns {@code recorder}, or an observer of the services that passes everything on to it. */
        default ServiceObserver services(ServiceObserver recorder) {
            return recorder;
        }

        /** Returns {@code recorder}, or a listener to the states that passes everything on to it. */
        default Arbitrator.StateListener states(Arbitrator.StateListener recorder) {
            return recorder;
        }

        /** The services are going to be stopped, because the run ends. */
        default void closing() {}

        /** The same after a failure, with which the run ends. */
        default void failed() {}

        /** A listener that passes everything on to another one; base of those that change some of it. */
        abstract class Forwarding implements Listener {
            private final Listener inner;

            protected Forwarding(Listener inner) {
                this.inner = inner;
            }

            @Override
            public void stateStarted(String line) {
                inner.stateStarted(line);
            }

            @Override
            public void beforeTick(Simulation simulation, RunRecorder recorder) throws InterruptedException {
                inner.beforeTick(simulation, recorder);
            }

            @Override
            public void recorded(Snapshot snapshot, RunRecorder recorder) {
                inner.recorded(snapshot, recorder);
            }

            @Override
            public void ticked(long timeMicros) {
                inner.ticked(timeMicros);
            }

            @Override
            public boolean isStopRequested() {
                return inner.isStopRequested();
            }

            @Override
            public @Nullable CallObserver callObserver() {
                return inner.callObserver();
            }

            @Override
            public ServiceObserver services(ServiceObserver recorder) {
                return inner.services(recorder);
            }

            @Override
            public Arbitrator.StateListener states(Arbitrator.StateListener recorder) {
                return inner.states(recorder);
            }

            @Override
            public void closing() {
                inner.closing();
            }

            @Override
            public void failed() {
                inner.failed();
            }
        }
    }

    /**
     * Prepares a run.
     *
     * @throws WorldFileException if the scenario lacks a robot or a device that the table's services need
     */
    public RecordedRun(Scenario scenario, SubsumptionTable table, Settings settings) {
        this.scenario = scenario;
        this.table = table;
        this.settings = settings;
        this.port = check(scenario, table);
    }

    /**
     * Checks that the world has the devices that the services of the table need, and returns the port that offers them.
     */
    private static int check(Scenario scenario, SubsumptionTable table) {
        int expected = table.robots();
        List<RobotSpec> robots = scenario.world().robots();
        if (robots.size() != expected) {
            throw new WorldFileException(scenario.world().file() + " has " + Plural.of(robots.size(), "robot")
                    + ", expected " + expected + " as the table of services has");
        }
        int port = scenario.robotPort()
                .orElseThrow(() -> new WorldFileException(scenario.world().file() + " offers no position2d"));
        Set<Binding> offered = scenario.devices().stream()
                .filter(device -> device.port() == port)
                .map(device -> new Binding(device.interfaceName(), device.index(), device.model()))
                .collect(Collectors.toSet());
        for (int index = 0; index < expected; index++) {
            RobotSpec robot = robots.get(index);
            SonarSpec sonar = robot.sonar();
            if (sonar == null || sonar.mounts().size() < SONARS || robot.blobfinder() == null) {
                throw new WorldFileException(
                        robot.where(),
                        "robot '" + robot.name() + "' has "
                                + Plural.of(sonar == null ? 0 : sonar.mounts().size(), "sonar") + " and "
                                + (robot.blobfinder() == null ? "no" : "a")
                                + " blobfinder, expected " + SONARS
                                + " sonars or more and a blobfinder for the services");
            }
            for (String type : List.of("position2d", "sonar", "blobfinder")) {
                if (!offered.contains(new Binding(type, index, robot.name()))) {
                    throw new WorldFileException(
                            robot.where(),
                            "robot '" + robot.name() + "' is not " + type + ":" + index + " on port " + port
                                    + " of the configuration, expected the robots' devices in the order of the world file on one port");
                }
            }
        }
        for (int number : table.robotsWithLaser()) {
            RobotSpec robot = robots.get(number - 1);
            if (!offered.contains(new Binding("laser", number - 1, robot.name()))) {
                throw new WorldFileException(
                        robot.where(),
                        "robot '" + robot.name() + "' has no laser:" + (number - 1) + " on port " + port
                                + ", expected one for the services that the table gives to robot " + number);
            }
        }
        return port;
    }

    /**
     * Runs until the end time, and writes the log.
     *
     * @param file the log, by custom {@code run.jsonl}
     * @throws IOException if the log cannot be written; the message names it
     */
    public RunResult run(Path file) throws IOException, InterruptedException {
        try (var log = new RunLog(file)) {
            return run(log, Listener.NONE);
        }
    }

    /** Runs until the end time, or until the listener requests to stop. The caller closes the log. */
    public RunResult run(RunLog log, Listener listener) throws InterruptedException {
        long endMicros = settings.endMicros();
        var world = WorldSettings.defaults().withSeed(settings.seed()).withJitter(JITTER_M, JITTER_RAD);
        try (var simulation = Simulation.open(scenario, world)) {
            log.begin(scenario.world(), settings);
            var recorder = new RunRecorder(scenario.world(), table, log, listener::stateStarted);
            var robots = RobotServicesActor.Settings.defaults()
                    .withPort(port)
                    .withTable(table)
                    .withObserver(listener.services(recorder))
                    .withReconnection(settings.reconnects());
            var services = SubsumptionRun.Settings.defaults()
                    .withMode(settings.mode())
                    .withRobots(robots)
                    .withClock(simulation.clock())
                    .withListener(listener.states(recorder))
                    .withRound(settings.round())
                    .withCallObserver(listener.callObserver());
            try (var running = SubsumptionRun.start(services);
                    var ending = new Ending(listener)) {
                recorder.start(simulation.latest());
                listener.recorded(simulation.latest(), recorder);
                var pacer = new WallClockPacer();
                while (simulation.timeMicros() < endMicros && !listener.isStopRequested()) {
                    listener.beforeTick(simulation, recorder);
                    Snapshot snapshot = simulation.tick();
                    running.check();
                    recorder.record(snapshot);
                    listener.recorded(snapshot, recorder);
                    listener.ticked(snapshot.timeMicros());
                    if (settings.realTime()) {
                        pacer.await(snapshot.timeMicros());
                    }
                }
                ending.isDone = true;
                listener.closing();
                return recorder.finish(simulation.timeMicros() < endMicros);
            } catch (RuntimeException | Error failure) {
                recorder.fail();
                throw failure;
            }
        }
    }

    /** Notifies the listener of a failure before the services are stopped. */
    private static final class Ending implements AutoCloseable {
        private final Listener listener;
        private boolean isDone;

        Ending(Listener listener) {
            this.listener = listener;
        }

        @Override
        public void close() {
            if (!isDone) {
                listener.failed();
            }
        }
    }
}
