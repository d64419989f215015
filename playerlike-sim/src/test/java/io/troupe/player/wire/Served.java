package io.troupe.player.wire;

import io.troupe.actor.Clock;
import io.troupe.player.PlayerPorts;
import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.TestWorlds;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.worldfile.ScenarioReader;
import java.io.IOException;
import java.net.InetAddress;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.concurrent.atomic.AtomicBoolean;
import org.junit.jupiter.api.function.Executable;

/** A world of one robot or of a scenario, a server for it, and clients that are closed with it. */
final class Served implements AutoCloseable {
    static final int PORT = 6781;

    final Simulation simulation;
    final TcpServer server;
    private final ExecutorService ticker = Executors.newSingleThreadExecutor();
    private final List<Future<Snapshot>> ticks = new ArrayList<>();
    private final List<RawClient> clients = new ArrayList<>();

    /** @param port 0 for any */
    private Served(Scenario scenario, WorldSettings settings, int port, TcpServer.Shared shared) {
        simulation = Simulation.open(scenario, settings);
        server = TcpServer.open(PlayerPorts.find(PORT).orElseThrow(), port, InetAddress.getLoopbackAddress(), shared);
    }

    static Served open() {
        return open(0);
    }

    static Served open(int port) {
        return new Served(oneRobot(), WorldSettings.defaults(), port, ofMachine());
    }

    static Served open(Scenario scenario) {
        return open(scenario, WorldSettings.defaults());
    }

    static Served open(Scenario scenario, WorldSettings settings) {
        return new Served(scenario, settings, 0, ofMachine());
    }

    static Served open(TcpServer.Settings settings, Clock clock) {
        return new Served(oneRobot(), WorldSettings.defaults(), 0, new TcpServer.Shared(settings, clock));
    }

    private static TcpServer.Shared ofMachine() {
        return new TcpServer.Shared(TcpServer.Settings.ofMachine(1), Clock.system());
    }

    /** The scenario of a world file without a {@code .cfg}; its robots are served at {@link #PORT}. */
    static Scenario scenario(String worldFile) {
        Scenario read = ScenarioReader.readText(worldFile, Path.of("t.world"));
        return new Scenario(
                read.world(),
                read.devices().stream()
                        .map(each -> new DeviceBinding(
                                PORT, each.interfaceName(), each.index(), each.model(), each.ranger(), each.where()))
                        .toList());
    }

    /** The robot of the captured conversations: its pose and its sixteen sonars, in an empty world. */
    private static Scenario oneRobot() {
        RobotSpec plain = TestWorlds.robot("r1", 0, -5, 0);
        var robot = new RobotSpec(
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
        return TestWorlds.scenario(PORT, TestWorlds.world(List.of(robot)));
    }

    /** Runs the action while threads that never block occupy every carrier of virtual threads. */
    static void whileNoCarrierIsFree(Executable action) throws Throwable {
        int carriers = Integer.getInteger(
                "jdk.virtualThreadScheduler.parallelism", Runtime.getRuntime().availableProcessors());
        var stop = new AtomicBoolean();
        var spinning = new CountDownLatch(carriers);
        var spinners = new ArrayList<Thread>();
        for (int i = 0; i < carriers; i++) {
            spinners.add(Thread.startVirtualThread(() -> {
                spinning.countDown();
                while (!stop.get()) {
                    Thread.onSpinWait();
                }
            }));
        }
        try {
            spinning.await();
            action.execute();
        } finally {
            stop.set(true);
            for (var each : spinners) {
                each.join();
            }
        }
    }

    int port() {
        return server.port();
    }

    /** A client that has read nothing yet. */
    RawClient connect() throws IOException {
        clients.add(new RawClient(port()));
        return clients.getLast();
    }

    /** A client that has read the greeting. */
    RawClient client() throws IOException {
        clients.add(RawClient.greeted(port()));
        return clients.getLast();
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
        clients.forEach(RawClient::close);
        server.close();
        ticks.forEach(Served::done);
        ticker.shutdownNow();
        simulation.close();
    }
}
