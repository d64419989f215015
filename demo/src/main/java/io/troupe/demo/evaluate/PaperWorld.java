package io.troupe.demo.evaluate;

import io.troupe.demo.terminal.WorldLoader;
import io.troupe.player.PlayerPorts;
import io.troupe.player.wire.TcpServer;
import io.troupe.sim.Pace;
import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.sim.worldfile.WorldFileException;
import java.nio.file.Path;
import java.util.function.DoubleConsumer;

/** A world with the paper's two robots, and the port that offers them. */
record PaperWorld(Scenario scenario, int port) {
    private static final int ROBOTS = 2;
    private static final double JITTER_M = 0.02;
    private static final double JITTER_RAD = StrictMath.toRadians(2);

    /** Settings with start poses varied by the seed; the same in simulated and in real time. */
    static WorldSettings settings(long seed) {
        return WorldSettings.defaults().withSeed(seed).withJitter(JITTER_M, JITTER_RAD);
    }

    /**
     * Reads a world file that the command has read before; its warnings were printed then.
     *
     * @throws WorldFileException if it does not have two robots, or offers no position2d
     */
    static PaperWorld read(Path file) {
        return of(ScenarioReader.readLeniently(file, warning -> {}), file);
    }

    /** @throws WorldFileException if it does not have two robots, or offers no position2d */
    static PaperWorld of(Scenario scenario, Path file) {
        int robots = scenario.world().robots().size();
        if (robots != ROBOTS) {
            throw new WorldFileException(
                    file + " has " + robots + " robots, expected " + ROBOTS + " for the services of the paper");
        }
        return new PaperWorld(scenario, WorldLoader.robotPort(scenario, file));
    }

    /**
     * Opens this world in real time.
     *
     * @param passed called with the elapsed seconds, on a thread of the world
     */
    RealTimeServer serve(long seed, DoubleConsumer passed) {
        var simulation = Simulation.open(scenario, settings(seed));
        try {
            simulation.lockStep(false);
            var server = TcpServer.open(PlayerPorts.find(port).orElseThrow(), 0);
            var runner = SimulationRunner.start(
                    simulation, 1, snapshot -> passed.accept(snapshot.timeMicros() / 1e6), new Pace.RealTime(1));
            return new RealTimeServer(simulation, server, runner);
        } catch (RuntimeException e) {
            simulation.close();
            throw e;
        }
    }

    /** A world in real time on a local TCP socket, as Stage offers it: it does not wait for slow clients. */
    static final class RealTimeServer implements AutoCloseable {
        private final Simulation simulation;
        private final TcpServer server;
        private final SimulationRunner runner;

        private RealTimeServer(Simulation simulation, TcpServer server, SimulationRunner runner) {
            this.simulation = simulation;
            this.server = server;
            this.runner = runner;
        }

        int port() {
            return server.port();
        }

        @Override
        public void close() {
            try (simulation;
                    server) {
                runner.close();
            }
        }
    }
}
