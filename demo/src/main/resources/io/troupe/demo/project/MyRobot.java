import io.troupe.player.PlayerClient;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.sim.Pace;
import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.view.live.LiveView;
import io.troupe.view.live.RunControl;
import io.troupe.view.live.SimulationControl;
import io.troupe.view.live.ViewedRun;
import java.nio.file.Path;

/** Drives the first robot of a world to where there is room. */
public class MyRobot {
    /** The robot: a Player program, which knows only a host and a port. Returns where it has come. */
    static String drive(int port, int cycles) {
        PlayerClient robot = new PlayerClient("localhost", port);
        Position2DInterface wheels = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
        SonarInterface sonar = robot.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
        robot.runThreaded(-1, -1);
        double turn = 0; // rad/s; to the same side until the way is free
        for (int cycle = 0; cycle < cycles; cycle++) {
            while (!sonar.isDataReady())
                ;
            float[] metres = sonar.getData().getRanges(); // 0 to 7 are in front, from left to right
            float left = Math.min(metres[2], metres[3]);
            float right = Math.min(metres[4], metres[5]);
            boolean free = left > 0.7 && right > 0.7;
            turn = free ? 0 : turn != 0 ? turn : left > right ? 0.8 : -0.8;
            wheels.setSpeed(free ? 0.4 : 0, turn); // m/s, rad/s
        }
        String end = wheels.getX() + " m ahead and " + wheels.getY() + " m to the left of its start";
        robot.close();
        return end;
    }

    /** So many cycles, as fast as the robot takes them. */
    static String run(Path world, int cycles) {
        try (var simulation = Simulation.open(ScenarioReader.read(world), WorldSettings.defaults());
                var runner = SimulationRunner.start(simulation, 1, snapshot -> {})) {
            return drive(6665, cycles);
        }
    }

    /** In real time, on a page for browsers, until Ctrl-C. */
    static void watch(Path world) throws Exception {
        var scenario = ScenarioReader.read(world);
        try (var simulation = Simulation.open(scenario, WorldSettings.defaults());
                var page = LiveView.open(LiveView.Settings.defaults().withPort(0))) {
            var control = new SimulationControl(simulation, 1);
            var viewed = new ViewedRun(scenario.world(), new RunControl(1, true)).onto(page, control);
            try (var runner = SimulationRunner.start(simulation, 1, viewed::moved, new Pace.RealTime(1))) {
                control.runner(runner);
                System.out.println("watch it at " + page.address());
                drive(6665, Integer.MAX_VALUE);
            }
        }
    }

    public static void main(String[] arguments) throws Exception {
        Path world = Path.of("hall.world");
        if (arguments.length == 0) {
            watch(world);
        } else {
            System.out.println(run(world, Integer.parseInt(arguments[0])));
        }
    }
}
