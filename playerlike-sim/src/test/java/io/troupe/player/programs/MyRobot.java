package io.troupe.player.programs;

import io.troupe.player.*;
import io.troupe.player.structures.*;
import io.troupe.player.structures.position2d.*;
import io.troupe.player.structures.sonar.*;

/** A robot class that extends the client, drives a square by its odometry, and uses structures of both generations. */
public final class MyRobot extends PlayerClient {
    private final Position2DInterface wheels;
    private final SonarInterface ring;

    public MyRobot(String host, int port) {
        super(host, port);
        wheels = (Position2DInterface) requestInterface(PLAYER_POSITION2D_CODE, 0, PLAYER_OPEN_MODE);
        ring = requestInterfaceSonar(0, PLAYER_OPEN_MODE);
        runThreaded(-1, -1);
    }

    private PlayerPose where() {
        while (!wheels.isDataReady())
            ;
        PlayerPosition2dData data = wheels.getData();
        PlayerPose2d newer = data.getPos();
        PlayerPose older = data.getPos();
        return newer.getPx() == older.getPx() ? older : null;
    }

    private void forward(double metres) {
        PlayerPose start = where();
        PlayerPose now = start;
        while (Math.hypot(now.getPx() - start.getPx(), now.getPy() - start.getPy()) < metres) {
            PlayerSonarData sonars = ring.getData();
            if (sonars != null && sonars.getRanges_count() > 4 && sonars.getRanges()[3] < 0.5) {
                break;
            }
            wheels.setVelocity(new PlayerPose2d(0.4, 0, 0), 1);
            now = where();
        }
    }

    private void turnLeft() {
        PlayerPosition2dCmdVel command = new PlayerPosition2dCmdVel();
        PlayerPose turning = new PlayerPose();
        turning.setPa(0.5);
        command.setVel(turning);
        command.setState((byte) 1);
        double turned = 0;
        double before = where().getPa();
        while (turned < Math.PI / 2) {
            wheels.setVelocity(command);
            double now = where().getPa();
            turned += Math.atan2(Math.sin(now - before), Math.cos(now - before));
            before = now;
        }
    }

    public static void main(String[] args) {
        MyRobot robot = new MyRobot(args[0], Integer.parseInt(args[1]));
        while (true) {
            robot.forward(1);
            robot.turnLeft();
        }
    }
}
