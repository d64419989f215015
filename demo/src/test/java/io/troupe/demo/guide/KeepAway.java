package io.troupe.demo.guide;

import io.troupe.player.PlayerClient;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;

/** A typical student program, which uses only the Player client. */
final class KeepAway {
    private KeepAway() {}

    static void run(int port, int cycles) {
        PlayerClient robot = new PlayerClient("localhost", port);
        Position2DInterface wheels = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
        SonarInterface sonar = robot.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
        robot.runThreaded(-1, -1);

        for (int cycle = 0; cycle < cycles; cycle++) {
            while (!sonar.isDataReady())
                ;
            float[] ranges = sonar.getData().getRanges();
            boolean free = ranges[3] > 0.8 && ranges[4] > 0.8;
            wheels.setSpeed(free ? 0.3 : 0, free ? 0 : 0.5);
        }
        robot.close();
    }
}
