package io.troupe.faults.node;

import io.troupe.faults.history.Event.Moved;
import io.troupe.faults.history.Event.Rolled;
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
    private static final String ARENA = """
            interval_sim 100
            define ring ranger
            (
              scount 16
              spose[0] [ 0.075 0.13 90 ] spose[1] [ 0.115 0.115 50 ] spose[2] [ 0.15 0.08 30 ] spose[3] [ 0.17 0.025 10 ]
              spose[4] [ 0.17 -0.025 -10 ] spose[5] [ 0.15 -0.08 -30 ]
              spose[6] [ 0.115 -0.115 -50 ] spose[7] [ 0.075 -0.13 -90 ]
              spose[8] [ -0.155 -0.13 -90 ] spose[9] [ -0.195 -0.115 -130 ]
              spose[10] [ -0.23 -0.08 -150 ] spose[11] [ -0.25 -0.025 -170 ]
              spose[12] [ -0.25 0.025 170 ] spose[13] [ -0.23 0.08 150 ]
              spose[14] [ -0.195 0.115 130 ] spose[15] [ -0.155 0.13 90 ]
              sview [ 0 5 15 ]
              ssize [ 0.01 0.05 ]
            )
            define eye blobfinder ( colors_count 0 image [ 80 60 ] range 2 fov 60 )
            define roller position ( size [ 0.44 0.4 0.2 ] drive "diff" ring() eye() )
            define wall model ( color "black" obstacle_return 1 blob_return 1 )
            define panel model ( size [ 1 0.1 0.5 ] obstacle_return 1 blob_return 1 )
            wall ( pose [ 0 4.6 0 0 ] size [ 12.4 0.2 0.5 ] )
            wall ( pose [ 0 -4.6 0 0 ] size [ 12.4 0.2 0.5 ] )
            wall ( pose [ 6.1 0 0 0 ] size [ 0.2 9 0.5 ] )
            wall ( pose [ -6.1 0 0 0 ] size [ 0.2 9 0.5 ] )
            panel ( color "red" pose [ -5.95 -2.9 0 90 ] )
            panel ( color "red" pose [ 5.95 2.2 0 90 ] )
            panel ( color "green" pose [ 4.6 4.45 0 0 ] )
            panel ( color "blue" pose [ -3.6 -4.45 0 0 ] )
            panel ( color "blue" pose [ 5.95 -2.6 0 90 ] )
            roller ( name "robot1" color "orange" pose [ -4 -2.8 0 90 ] )
            roller ( name "robot2" color "black" pose [ 3 -0.5 0 180 ] )
            """;
    private static final String DEVICES = """
            driver ( name "stage" provides [ "simulation:0" ] plugin "stageplugin" worldfile "faults.world" )
            driver ( name "stage" provides [ "position2d:0" "sonar:0" ] model "robot1" )
            driver ( name "stage" provides [ "position2d:1" "sonar:1" ] model "robot2" )
            """;

    private WorldMain() {}

    /**
     * @param arguments the process, the folder of the histories, the address to listen on, and {@code services} for an
     *     arena with robots that have all sensors
     */
    public static void main(String[] arguments) throws Exception {
        Path folder = Path.of(arguments[1]);
        boolean forServices = arguments[3].equals("services");
        var history = new History.Writer(folder, arguments[0]);
        Thread.ofPlatform().daemon().priority(Thread.MAX_PRIORITY).start(new FutureTask<>(() -> {
            NodeMain.watchPauses(history);
            return null;
        }));
        try (var simulation =
                        Simulation.open(ScenarioReader.read(write(folder, forServices)), WorldSettings.defaults());
                var server =
                        TcpServer.open(PlayerPorts.find(PORT).orElseThrow(), 0, InetAddress.getByName(arguments[2]))) {
            simulation.lockStep(false);
            simulation.disconnectSilentClients(true);
            watch();
            try (var runner = SimulationRunner.start(
                    simulation, 1, snapshot -> note(snapshot, history, forServices), new Pace.RealTime(1))) {
                System.out.println("world at " + server.port());
                while (System.in.read() >= 0
                        && !runner.ended().toCompletableFuture().isDone()) {}
            }
        }
        Runtime.getRuntime().halt(0);
    }

    private static Path write(Path folder, boolean forServices) throws IOException {
        Files.writeString(folder.resolve("faults.world"), forServices ? ARENA : WORLD);
        String devices = forServices ? DEVICES.replaceAll("\"sonar:(.)\"", "\"sonar:$1\" \"blobfinder:$1\"") : DEVICES;
        return Files.writeString(folder.resolve("faults.cfg"), devices);
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

    private static void note(Snapshot snapshot, History.Writer history, boolean forServices) {
        for (int robot = 0; robot < snapshot.robots().size(); robot++) {
            var odometry = snapshot.robots().get(robot).odometry();
            if (forServices) {
                boolean moving = odometry.forwardMps() != 0 || odometry.turnRadps() != 0;
                history.add(new Rolled(snapshot.timeMicros(), robot, moving));
            } else {
                history.add(new Moved(snapshot.timeMicros(), robot, odometry.turnRadps()));
            }
        }
    }
}
