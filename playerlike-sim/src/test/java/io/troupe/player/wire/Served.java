package io.troupe.player.wire;

import io.troupe.actor.time.Clock;
import io.troupe.player.PlayerPorts;
import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.TestWorlds;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.SonarSpec;
import java.net.InetAddress;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;

/** A world of one robot, and a server for it. */
final class Served implements AutoCloseable {
    static final int PORT = 6781;

    final Simulation simulation;
    final TcpServer server;
    private final ExecutorService ticker = Executors.newSingleThreadExecutor();
    private final List<Future<Snapshot>> ticks = new ArrayList<>();

    private Served(Simulation simulation, TcpServer server) {
        this.simulation = simulation;
        this.server = server;
    }

    static Served open() {
        return open(0);
    }

    static Served open(int port) {
        return open(port, new TcpServer.Shared(TcpServer.Settings.ofMachine(1), Clock.system()));
    }

    /** @param port 0 for any */
    static Served open(int port, TcpServer.Shared shared) {
        var simulation =
                Simulation.open(TestWorlds.scenario(PORT, TestWorlds.world(List.of(robot()))), WorldSettings.DEFAULT);
        var devices = PlayerPorts.find(PORT).orElseThrow();
        return new Served(simulation, TcpServer.open(devices, port, InetAddress.getLoopbackAddress(), shared));
    }

    /** The robot of the captured conversations: its pose and its sixteen sonars, in an empty world. */
    private static RobotSpec robot() {
        RobotSpec plain = TestWorlds.robot("r1", 0, -5, 0);
        return new RobotSpec(
                plain.name(),
                plain.pose(),
                plain.shape(),
                plain.colour(),
                plain.lengthM(),
                plain.widthM(),
                plain.massKg(),
                plain.origin(),
                new Pose(0, -5, 0),
                new SonarSpec(Collections.nCopies(16, Pose.ORIGIN), 0, 5, 0.1),
                plain.blobfinder(),
                plain.rangers(),
                true,
                true,
                plain.where());
    }

    int port() {
        return server.port();
    }

    /** Ticks and returns when that is done; for clients that need not answer. */
    void tick(int times) {
        for (int i = 0; i < times; i++) {
            done(ticker.submit(simulation::tick));
        }
    }

    /** Ticks on another thread: in lock step a tick ends only when the client requests the next data. */
    void tickApart() {
        ticks.add(ticker.submit(simulation::tick));
    }

    private static void done(Future<Snapshot> tick) {
        try {
            tick.get();
        } catch (InterruptedException | ExecutionException e) {
            throw new AssertionError("a tick went wrong", e);
        }
    }

    /** Checks that all started ticks have succeeded; without clients they wait for no answer. */
    @Override
    public void close() {
        server.close();
        ticks.forEach(Served::done);
        ticker.shutdownNow();
        simulation.close();
    }
}
