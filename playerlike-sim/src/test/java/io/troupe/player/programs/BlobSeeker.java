package io.troupe.player.programs;

import io.troupe.player.BlobfinderInterface;
import io.troupe.player.PlayerClient;
import io.troupe.player.Position2DInterface;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.blobfinder.PlayerBlobfinderBlob;
import io.troupe.player.structures.blobfinder.PlayerBlobfinderData;

/** Turns until it sees red, drives there and stops in front of it. */
public class BlobSeeker {
    public static void main(String[] args) {
        PlayerClient robot = new PlayerClient(args[0], Integer.parseInt(args[1]));
        robot.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
        Position2DInterface pos = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
        BlobfinderInterface camera = robot.requestInterfaceBlobfinder(0, PlayerConstants.PLAYER_OPEN_MODE);
        robot.runThreaded(-1, -1);
        while (true) {
            while (!camera.isDataReady())
                ;
            PlayerBlobfinderData image = camera.getData();
            PlayerBlobfinderBlob red = null;
            for (int i = 0; i < image.getBlobs_count(); i++) {
                if (image.getBlobs()[i].getColor() == 0xFF0000) red = image.getBlobs()[i];
            }
            if (red == null) {
                pos.setSpeed(0, 0.4);
            } else if (red.getRange() > 0.8) {
                pos.setSpeed(0.3, 0.02 * (image.getWidth() / 2 - red.getX()));
            } else {
                pos.setSpeed(0, 0);
            }
        }
    }
}
