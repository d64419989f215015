package io.troupe.demo.evaluate;

import io.troupe.player.PlayerPorts;
import io.troupe.player.wire.TcpServer;
import io.troupe.sim.Pace;
import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import java.util.function.DoubleConsumer;

/** A world in real time on a local TCP socket, as Stage offers it: it does not wait for slow clients. */
final class RealTimeServer implements AutoCloseable {
    private final Simulation simulation;
    private final TcpServer server;
    private final SimulationRunner runner;

    private RealTimeServer(Simulation simulation, TcpServer server, SimulationRunner runner) {
        this.simulation = simulation;
        this.server = server;
        this.runner = runner;
    }

    /** @param passed called with the elapsed seconds, on a thread of the world */
    static RealTimeServer open(PaperWorld world, long seed, DoubleConsumer passed) {
        var simulation = Simulation.open(world.scenario(), PaperWorld.settings(seed));
        try {
            simulation.lockStep(false);
            var server = TcpServer.open(PlayerPorts.find(world.port()).orElseThrow(), 0);
            var runner = SimulationRunner.start(
                    simulation, 1, snapshot -> passed.accept(snapshot.timeMicros() / 1e6), new Pace.RealTime(1));
            return new RealTimeServer(simulation, server, runner);
        } catch (RuntimeException e) {
            simulation.close();
            throw e;
        }
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
