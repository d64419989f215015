package io.troupe.demo;

import io.troupe.demo.terminal.Plural;
import io.troupe.demo.terminal.RealTime;
import io.troupe.demo.terminal.WorldLoader;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.Mode;
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
import java.util.List;
import java.util.Set;
import java.util.function.BooleanSupplier;
import java.util.function.Consumer;
import java.util.stream.Collectors;

/**
 * One run of the main job: the robots of a scenario, controlled by the paper's arbitrator, in lock step with the
 * simulated world.
 *
 * <p><b>Threads.</b> The calling thread advances the world, another thread runs the services. At any time one of the
 * two waits for the other.
 *
 * <p><b>Source.</b> Paper, sections 3.4 to 3.6.
 */
final class PaperRun {
    private static final double JITTER_M = 0.02;
    private static final double JITTER_RAD = StrictMath.toRadians(2);

    private static final int SONARS = 8;

    private final Scenario scenario;
    private final int port;
    private final WorldSettings settings;
    private final long endMicros;
    private final boolean realtime;
    private final SubsumptionTable table;
    private final ModeSettings modeSettings;

    /** A device that the world's configuration offers. */
    private record Binding(String type, int index, String model) {}

    /**
     * The mode of a run and its variants.
     *
     * @param reconnects whether every service opens a new connection
     * @param round how the synchronous mode distributes readings among the services
     */
    record ModeSettings(Mode mode, boolean reconnects, SynchronousRound round) {
        static final ModeSettings DEFAULT = new ModeSettings(Mode.PROMISE, false);

        /** The default round, as in the paper. */
        ModeSettings(Mode mode, boolean reconnects) {
            this(mode, reconnects, SynchronousRound.ONE_SERVICE_A_READING);
        }
    }

    PaperRun(Scenario scenario, long seed, double seconds, CornerStyle corners, boolean realtime) {
        this(scenario, seed, seconds, corners, realtime, ModeSettings.DEFAULT);
    }

    PaperRun(
            Scenario scenario,
            long seed,
            double seconds,
            CornerStyle corners,
            boolean realtime,
            ModeSettings modeSettings) {
        this(
                new TeamOptions.Team(scenario, SubsumptionTable.ofThePaper(corners)),
                seed,
                seconds,
                realtime,
                modeSettings);
    }

    PaperRun(TeamOptions.Team team, long seed, double seconds, boolean realtime, ModeSettings modeSettings) {
        this.table = team.table();
        this.scenario = team.scenario();
        this.settings = WorldSettings.DEFAULT.withSeed(seed).withJitter(JITTER_M, JITTER_RAD);
        this.endMicros = StrictMath.round(seconds * 1e6);
        this.realtime = realtime;
        this.modeSettings = modeSettings;
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
        int port = WorldLoader.robotPort(scenario, scenario.world().file());
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
     * Runs until the end time, or until {@code stop} returns true.
     *
     * @param changes called with a line of text for every state change, as it happens
     */
    RunResult run(RunLog log, Consumer<String> changes, ProgressBar progress, BooleanSupplier stop)
            throws InterruptedException {
        try (var simulation = Simulation.open(scenario, settings)) {
            log.write(header());
            var recorder = new RunRecorder(scenario.world(), table, log, changes);
            var services = new SubsumptionRun.Settings(
                            modeSettings.mode(), "localhost", port, table, simulation.clock(), recorder, recorder)
                    .withReconnection(modeSettings.reconnects())
                    .withRound(modeSettings.round());
            try (var running = SubsumptionRun.start(services)) {
                recorder.start(simulation.latest());
                var realTime = new RealTime();
                while (simulation.timeMicros() < endMicros && !stop.getAsBoolean()) {
                    Snapshot snapshot = simulation.tick();
                    running.check();
                    recorder.record(snapshot);
                    progress.show(snapshot.timeMicros() / 1e6);
                    if (realtime) {
                        realTime.await(snapshot.timeMicros());
                    }
                }
                return recorder.finish(simulation.timeMicros() < endMicros);
            } catch (RuntimeException | Error failure) {
                recorder.fail();
                throw failure;
            }
        }
    }

    private Json header() {
        return RunLog.header()
                .put("world", scenario.world().name())
                .put("robots", scenario.world().robots().size())
                .put("seed", settings.seed())
                .put("mode", modeSettings.mode())
                .put("reconnect", modeSettings.reconnects())
                .put("seconds", new Json.Fragment(Json.seconds(endMicros)))
                .put("interval", new Json.Fragment(Json.seconds(scenario.world().intervalMillis() * 1000L)));
    }
}
