package io.troupe.player;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.camera.PlayerCameraData;
import io.troupe.player.structures.fiducial.PlayerFiducialItem;
import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The samples of the Javadoc of further devices. */
@Tag("threads")
@Timeout(60)
class DeviceSamplesTest {
    private static final String WORLD = """
            position ( size [ 0.4 0.4 0.2 ] fiducial () camera () gripper ( pose [ 0.3 0 0 0 ] )
              bumper ( bcount 1 blength 0.4 bpose[0] [ -0.2 0 0 180 ] ) )
            model ( pose [ 0.35 0 0 0 ] size [ 0.1 0.1 0.1 ] color "red" fiducial_return 7 gripper_return 1 )
            model ( pose [ -0.31 0 0 0 ] size [ 0.2 0.2 0.1 ] )
            """;

    private final Simulation simulation =
            Simulation.open(ScenarioReader.readText(WORLD, Path.of("t.world")), WorldSettings.defaults());
    private final SimulationRunner runner = SimulationRunner.start(simulation, 1, snapshot -> {});
    private final PlayerClient robot = new PlayerClient("localhost", 6665);

    @BeforeEach
    void run() {
        assertThat(runner.isRunning()).isTrue();
        robot.runThreaded(-1, -1);
    }

    @AfterEach
    void close() {
        robot.close();
        runner.close();
        simulation.close();
    }

    @Test
    void fiducialFinder_seesMarkers() {
        List<String> log = new ArrayList<>();
        FiducialInterface finder = robot.requestInterfaceFiducial(0, PlayerConstants.PLAYER_OPEN_MODE);
        while (!finder.isDataReady())
            ;
        for (PlayerFiducialItem marker : finder.getData().getFiducials()) {
            log.add("marker " + marker.getId() + ", " + marker.getPose().getPx() + " m ahead");
        }
        assertThat(log).containsExactly("marker 7, 0.35 m ahead");
    }

    @Test
    void bumpers_arePressed() {
        BumperInterface bumpers = robot.requestInterfaceBumper(0, PlayerConstants.PLAYER_OPEN_MODE);
        while (!bumpers.isDataReady())
            ;
        boolean pressed = bumpers.getData().getBumpers()[0] != 0;
        assertThat(pressed).isTrue();
    }

    @Test
    void camera_givesImages() {
        CameraInterface camera = robot.requestInterfaceCamera(0, PlayerConstants.PLAYER_OPEN_MODE);
        while (!camera.isDataReady())
            ;
        PlayerCameraData picture = camera.getData();
        byte[] pixels = picture.getImage(); // a byte each for red, green and blue
        int middle = 3 * (picture.getWidth() * (picture.getHeight() / 2) + picture.getWidth() / 2);
        boolean red = pixels[middle] == -1 && pixels[middle + 1] == 0;
        assertThat(red).isTrue();
    }

    @Test
    void gripper_takesThings() {
        GripperInterface gripper = robot.requestInterfaceGripper(0, PlayerConstants.PLAYER_OPEN_MODE);
        gripper.close();
        do {
            while (!gripper.isDataReady())
                ;
        } while (gripper.getData().getState() != PlayerConstants.PLAYER_GRIPPER_STATE_CLOSED);
        boolean hasSomething = gripper.getData().getBeams() != 0;
        assertThat(hasSomething).isTrue();
    }
}
