package io.troupe.player.programs;

import io.troupe.player.PlayerClient;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;

/** Drives where there is free space. Not threaded: requests and reads in its loop, one message after the other. */
public class ReadAllWanderer {
    public static void main(String[] args) {
        PlayerClient robot = new PlayerClient(args[0], Integer.parseInt(args[1]));
        Position2DInterface pos = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
        SonarInterface son = robot.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
        while (true) {
            robot.requestData();
            robot.readAll();
            if (son.isDataReady()) {
                SpaceWanderer.steer(pos, son.getData().getRanges());
            }
        }
    }
}
