package io.troupe.demo.paper;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.player.BlobfinderInterface;
import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerException;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/**
 * The paper's connection with robot 1, and the check that solves its first challenge: data are ready before a service
 * starts.
 */
@Timeout(60)
class Figure7Test {
    @Test
    void connectionOfThePaper_getsSensorData() throws InterruptedException {
        try (var simulation =
                Simulation.open(ScenarioReader.read(Path.of("worlds", "paper-arena.world")), WorldSettings.DEFAULT)) {
            PlayerClient robot = null;
            Position2DInterface posi1 = null;
            SonarInterface rngi1 = null;
            BlobfinderInterface blfi1 = null;

            try {
                // Connect to the Player server and request access to Position and Sonar
                robot = new PlayerClient("localhost", 6665);
                posi1 = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
                rngi1 = robot.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
                blfi1 = robot.requestInterfaceBlobfinder(0, PlayerConstants.PLAYER_OPEN_MODE);
            } catch (PlayerException e) {
                System.err.println("robot1: > Error connecting to Player: ");
                System.err.println("    [ " + e.toString() + " ]");
                throw e;
            }

            robot.runThreaded(-1, -1);

            var world = Thread.ofPlatform().start(simulation::tick);
            while (!rngi1.isDataReady())
                ;
            while (!posi1.isDataReady())
                ;
            while (!blfi1.isDataReady())
                ;
            assertThat(rngi1.getData().getRanges()).hasSize(16);
            assertThat(posi1.getX()).isZero();
            assertThat(blfi1.getData().getBlobs_count()).isZero(); // nothing within its 2 m
            assertThat(rngi1.isDataReady()).isFalse(); // no newer data: this call answers the tick
            world.join();
            robot.close();
        }
    }
}
