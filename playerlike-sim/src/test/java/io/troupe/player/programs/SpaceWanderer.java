package io.troupe.player.programs;

import io.troupe.player.PlayerClient;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;

/** Drives where there is free space. Threaded; clamps the ranges in the array itself. */
public class SpaceWanderer implements PlayerConstants {
    public static void main(String[] args) {
        PlayerClient robot = new PlayerClient(args[0], Integer.parseInt(args[1]));
        Position2DInterface pos = robot.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
        SonarInterface son = robot.requestInterfaceSonar(0, PLAYER_OPEN_MODE);
        robot.runThreaded(-1, -1);
        while (true) {
            while (!son.isDataReady())
                ;
            float[] s = son.getData().getRanges();
            if (s.length == 0) {
                continue;
            }
            for (int i = 0; i < s.length; i++) {
                if (s[i] < 0.2f) s[i] = 0.2f;
                if (s[i] > 5.0f) s[i] = 5.0f;
            }
            steer(pos, s);
        }
    }

    static void steer(Position2DInterface pos, float[] s) {
        double left = (s[1] + s[2]) / 2 / 10;
        double right = (s[5] + s[6]) / 2 / 10;
        double x = Math.min((left + right) / 2, 0.5);
        double yaw = (left - right) * (180 / Math.PI) / 24;
        if ((s[1] > 0.5 && s[2] > 0.5 && s[3] > 0.5) || (s[4] > 0.5 && s[5] > 0.5 && s[6] > 0.5)) {
            pos.setSpeed(x, yaw);
        } else {
            pos.setSpeed(0, s[0] < s[7] ? -0.5 : 0.5);
        }
    }
}
