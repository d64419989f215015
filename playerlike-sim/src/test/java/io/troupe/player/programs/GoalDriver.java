package io.troupe.player.programs;

import io.troupe.player.PlayerClient;
import io.troupe.player.Position2DInterface;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;

/** Drives to two goals and stays at the second. */
public class GoalDriver {
    public static void main(String[] args) {
        PlayerClient client = new PlayerClient(args[0], Integer.parseInt(args[1]));
        client.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
        Position2DInterface pos = client.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
        pos.resetOdometry();
        PlayerPose2d[] goals = {new PlayerPose2d(1.5, 0, 0), new PlayerPose2d(1.5, 1, Math.PI / 2)};
        int goal = 0;
        pos.setPosition(goals[0], new PlayerPose(), 1);
        while (true) {
            client.readAll();
            if (pos.isDataReady() && goal == 0 && Math.abs(pos.getX() - 1.5) < 0.15 && Math.abs(pos.getY()) < 0.15) {
                goal = 1;
                pos.setPosition(goals[1], new PlayerPose(), 1);
            }
        }
    }
}
