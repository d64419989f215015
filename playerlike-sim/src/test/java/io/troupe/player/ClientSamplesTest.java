package io.troupe.player;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.blobfinder.PlayerBlobfinderBlob;
import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import io.troupe.sim.WorldSettings;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The samples in the Javadoc of the client and its interfaces, in a world with one robot that has all devices. */
@Tag("threads")
@Timeout(60)
class ClientSamplesTest {
    private static final int port = SimulatedDevicesTest.PORT;

    private final Simulation simulation = Simulation.open(SimulatedDevicesTest.scenario(), WorldSettings.defaults());
    private final SimulationRunner runner = SimulationRunner.start(simulation, 1, snapshot -> {});
    private final PlayerClient robot = new PlayerClient("localhost", port);

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
    void playerClient_givesAccessToDevices() {
        PlayerClient robot = new PlayerClient("localhost", port);
        SonarInterface sonar = robot.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
        robot.runThreaded(-1, -1);
        while (!sonar.isDataReady())
            ;
        float[] ranges = sonar.getData().getRanges();
        robot.close();
        assertThat(ranges).isNotEmpty();
    }

    @Test
    void position2d_drives() {
        Position2DInterface wheels = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
        wheels.setSpeed(0.3, 0); // ahead
        while (!wheels.isDataReady())
            ;
        double travelledMetres = wheels.getX();
        assertThat(travelledMetres).isBetween(0.0, 0.1);
    }

    @Test
    void sonar_measuresRanges() {
        SonarInterface sonar = robot.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
        while (!sonar.isDataReady())
            ;
        float[] ranges = sonar.getData().getRanges();
        assertThat(ranges).isNotEmpty();
    }

    @Test
    void laser_scans() {
        LaserInterface laser = robot.requestInterfaceLaser(0, PlayerConstants.PLAYER_OPEN_MODE);
        while (!laser.isDataReady())
            ;
        float[] ranges = laser.getData().getRanges();
        float leastAngle = laser.getData().getMin_angle();
        assertThat(ranges).hasSize(3);
        assertThat(leastAngle).isNegative();
    }

    @Test
    void blobfinder_findsColours() {
        List<String> log = new ArrayList<>();
        BlobfinderInterface camera = robot.requestInterfaceBlobfinder(0, PlayerConstants.PLAYER_OPEN_MODE);
        while (!camera.isDataReady())
            ;
        for (PlayerBlobfinderBlob blob : camera.getData().getBlobs()) {
            log.add("a blob of " + blob.getArea() + " square pixels");
        }
        assertThat(log).isNotEmpty().allMatch(line -> line.matches("a blob of \\d+ square pixels"));
    }

    @Test
    void ranger_measuresRanges() {
        RangerInterface ranger = robot.requestInterfaceRanger(0, PlayerConstants.PLAYER_OPEN_MODE);
        while (!ranger.isDataReady())
            ;
        double[] ranges = ranger.getData().getRanges();
        assertThat(ranges).hasSize(2);
    }

    @Test
    void simulation_tellsPoses() {
        SimulationInterface world = robot.requestInterfaceSimulation(0, PlayerConstants.PLAYER_OPEN_MODE);
        world.get2DPose("one");
        while (!world.isPose2DReady())
            ;
        PlayerPose pose = world.getPose2D().getPose();
        assertThat(pose.getPx()).isZero();
    }
}
