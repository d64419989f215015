package io.troupe.player.programs;

import io.troupe.player.PlayerClient;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;

/** Drives where there is free space. Threaded, in pull mode, with the calls of both styles. */
public class PullThread {
    public static void main(String[] args) {
        PlayerClient robot = new PlayerClient(args[0], Integer.parseInt(args[1]));
        robot.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
        Position2DInterface pos = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
        SonarInterface son = robot.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
        robot.runThreaded(-1, -1);
        while (true) {
            robot.requestData();
            robot.readAll();
            if (son.isDataReady()) {
                SpaceWanderer.steer(pos, son.getData().getRanges());
            }
        }
    }
}
