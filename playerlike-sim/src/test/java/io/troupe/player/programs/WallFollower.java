package io.troupe.player.programs;

import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerException;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;

/**
 * Finds a wall and keeps it on its left. Threaded; waits in empty loops; its sonar values are static fields, as in many
 * programs of beginners.
 */
public class WallFollower {
    static final float SONAR_MIN = 0.2f;
    static final float SONAR_MAX = 5.0f;
    static final double SPEED = 0.2;
    static final double TURN = 0.15;
    static final double MIN_WALL = 0.3;
    static final double MAX_WALL = 0.4;

    SonarInterface sonar = null;
    Position2DInterface position = null;
    double left, front, first;

    void readSonars() {
        while (!sonar.isDataReady())
            ;
        float[] values = sonar.getData().getRanges();
        for (int i = 0; i < sonar.getData().getRanges_count(); i++) {
            if (values[i] < SONAR_MIN) values[i] = SONAR_MIN;
            if (values[i] > SONAR_MAX) values[i] = SONAR_MAX;
        }
        first = values[0];
        left = Math.min(Math.min(values[0], values[1]), values[2]);
        front = Math.min(values[3], values[4]);
    }

    void approach() {
        readSonars();
        while (left > MAX_WALL && front > MAX_WALL) {
            position.setSpeed(SPEED, 0);
            readSonars();
        }
        double previous = first;
        while (first <= previous) {
            previous = first;
            position.setSpeed(0, front <= left ? -3 * TURN : -TURN);
            readSonars();
        }
        position.setSpeed(0, 0);
    }

    void follow() {
        while (true) {
            readSonars();
            if (front < MAX_WALL) {
                position.setSpeed(-0.10, -0.6);
            } else if (left < MIN_WALL) {
                position.setSpeed(SPEED / 2, -TURN);
            } else if (left > MAX_WALL) {
                position.setSpeed(SPEED / 2, TURN);
            } else {
                position.setSpeed(SPEED, 0);
            }
        }
    }

    public static void main(String[] args) {
        PlayerClient robot = null;
        WallFollower follower = new WallFollower();
        try {
            robot = new PlayerClient(args[0], Integer.parseInt(args[1]));
            follower.position = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
            follower.sonar = robot.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
        } catch (PlayerException e) {
            throw new IllegalStateException("could not connect", e);
        }
        robot.runThreaded(-1, -1);
        follower.approach();
        follower.follow();
    }
}
