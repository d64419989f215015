package io.troupe.player.programs;

import io.troupe.player.PlayerClient;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;

/** Drives where there is free space. Not threaded, in pull mode: a whole frame with each readAll(). */
public class PullReader {
    public static void main(String[] args) {
        PlayerClient robot = new PlayerClient(args[0], Integer.parseInt(args[1]));
        robot.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
        Position2DInterface pos = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
        SonarInterface son = robot.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
        pos.setMotorPower(1);
        pos.queryGeometry();
        while (true) {
            robot.readAll();
            if (!son.isDataReady() || !pos.isDataReady()) {
                throw new IllegalStateException("half a frame");
            }
            SpaceWanderer.steer(pos, son.getData().getRanges());
        }
    }
}
