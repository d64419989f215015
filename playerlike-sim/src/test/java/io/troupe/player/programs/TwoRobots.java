package io.troupe.player.programs;

import io.troupe.player.PlayerClient;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;

/** Drives two robots of one port from one loop. */
public class TwoRobots {
    public static void main(String[] args) {
        PlayerClient client = new PlayerClient(args[0], Integer.parseInt(args[1]));
        Position2DInterface[] pos = new Position2DInterface[2];
        SonarInterface[] son = new SonarInterface[2];
        for (int i = 0; i < 2; i++) {
            pos[i] = client.requestInterfacePosition2D(i, PlayerConstants.PLAYER_OPEN_MODE);
            son[i] = client.requestInterfaceSonar(i, PlayerConstants.PLAYER_OPEN_MODE);
        }
        client.runThreaded(-1, -1);
        while (true) {
            for (int i = 0; i < 2; i++) {
                while (!son[i].isDataReady())
                    ;
                SpaceWanderer.steer(pos[i], son[i].getData().getRanges());
            }
        }
    }
}
