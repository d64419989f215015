package io.troupe.player.programs;

import io.troupe.player.*;
import io.troupe.player.structures.*;
import io.troupe.player.structures.laser.*;
import io.troupe.player.structures.ranger.*;

/**
 * Turns to where its laser sees most free space, checks that the ranger reports the same in the middle, and requests
 * its pose in the world.
 */
public class LaserDriver implements PlayerConstants {
    public static void main(String[] args) {
        PlayerClient client = new PlayerClient(args[0], Integer.parseInt(args[1]));
        client.requestDataDeliveryMode(PLAYER_DATAMODE_PULL);
        Position2DInterface pos = client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
        LaserInterface laser = client.requestInterfaceLaser(0, PLAYER_OPEN_MODE);
        RangerInterface ranger = client.requestInterfaceRanger(0, PLAYER_OPEN_MODE);
        SimulationInterface world = client.requestInterfaceSimulation(0, PLAYER_OPEN_MODE);
        ranger.queryConfiguration();
        while (!ranger.isConfReady())
            ;
        PlayerRangerConf how = ranger.getConf();
        world.get2DPose("one");
        while (!world.isPose2DReady())
            ;
        PlayerPose2d start = world.getPose2D().getPose();
        while (true) {
            client.readAll();
            PlayerLaserData scan = laser.getData();
            PlayerPoint2d[] points = scan.getPoints();
            int best = 0;
            for (int i = 0; i < scan.getRanges_count(); i++) {
                if (scan.getRanges()[i] > scan.getRanges()[best]) best = i;
            }
            int middle = scan.getRanges_count() / 2;
            double difference = ranger.getData().getRanges()[middle] - scan.getRanges()[middle];
            if (Math.abs(difference) > 0.001 || how.getMax_range() < scan.getMax_range()) {
                throw new IllegalStateException("laser and ranger differ by " + difference);
            }
            if (Math.hypot(pos.getX(), pos.getY()) > 1 && Double.isNaN(start.getPx())) {
                throw new IllegalStateException("never asked where it was");
            }
            double heading = Math.atan2(points[best].getPy(), points[best].getPx());
            boolean space = scan.getRanges()[middle] > 1;
            pos.setSpeed(space ? 0.3 : 0, space ? 0.5 * heading : 0.6);
        }
    }
}
