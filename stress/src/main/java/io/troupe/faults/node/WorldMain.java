package io.troupe.faults.node;

import io.troupe.faults.history.Event.Moved;
import io.troupe.faults.history.History;
import io.troupe.player.PlayerPorts;
import io.troupe.player.wire.DataSink;
import io.troupe.player.wire.Frame;
import io.troupe.player.wire.TcpServer;
import io.troupe.sim.Pace;
import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import io.troupe.sim.Snapshot;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.ScenarioReader;
import java.io.IOException;
import java.net.InetAddress;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.concurrent.FutureTask;

/**
 * The world: two robots in real time, which turn on the spot as they are commanded, behind a Player server. It ends
 * with its input.
 */
public final class WorldMain {
    private static final int PORT = 6665;
    private static final String WORLD = """
            interval_sim 100
            define eyes ranger ( scount 1 spose[0] [ 0 0 0 ] sview [ 0 5 15 ] ssize [ 0.01 0.05 ] )
            define turner position ( size [ 0.4 0.4 0.2 ] drive "diff" eyes() )
            turner ( name "robot1" pose [ -5 0 0 0 ] )
            turner ( name "robot2" pose [ 5 0 0 0 ] )
            """;
    private static final String DEVICES = """
            driver ( name "stage" provides [ "simulation:0" ] plugin "stageplugin" worldfile "faults.world" )
            driver ( name "stage" provides [ "position2d:0" "sonar:0" ] model "robot1" )
            driver ( name "stage" provides [ "position2d:1" "sonar:1" ] model "robot2" )
            """;

    private WorldMain() {}

    /** @param arguments the process, the folder of the histories, and the address to listen on */
    public static void main(String[] arguments) throws Exception {
        Path folder = Path.of(arguments[1]);
        var history = new History.Writer(folder, arguments[0]);
        Thread.ofPlatform().daemon().priority(Thread.MAX_PRIORITY).start(new FutureTask<>(() -> {
            NodeMain.watchPauses(history);
            return null;
        }));
        try (var simulation = Simulation.open(ScenarioReader.read(write(folder)), WorldSettings.DEFAULT);
                var server =
                        TcpServer.open(PlayerPorts.find(PORT).orElseThrow(), 0, InetAddress.getByName(arguments[2]))) {
            simulation.lockStep(false);
            simulation.disconnectSilentClients(true);
            watch();
            try (var runner =
                    SimulationRunner.start(simulation, 1, snapshot -> note(snapshot, history), new Pace.RealTime(1))) {
                System.out.println("world at " + server.port());
                while (System.in.read() >= 0
                        && !runner.ended().toCompletableFuture().isDone()) {}
            }
        }
        Runtime.getRuntime().halt(0);
    }

    private static Path write(Path folder) throws IOException {
        Files.writeString(folder.resolve("faults.world"), WORLD);
        return Files.writeString(folder.resolve("faults.cfg"), DEVICES);
    }

    /** Time passes also while no driver is connected. */
    private static void watch() {
        var onlooker = PlayerPorts.find(PORT)
                .orElseThrow()
                .connect(
                        new DataSink() {
                            @Override
                            public void frame(Frame frame) {}

                            @Override
                            public void lost(String reason) {}
                        },
                        null);
        onlooker.answers(false);
        onlooker.devices().forEach(onlooker::subscribe);
    }

    private static void note(Snapshot snapshot, History.Writer history) {
        for (int robot = 0; robot < snapshot.robots().size(); robot++) {
            var odometry = snapshot.robots().get(robot).odometry();
            history.add(new Moved(snapshot.timeMicros(), robot, odometry.turnRadps()));
        }
    }
}
