package io.troupe.paper;

import io.troupe.player.BlobfinderInterface;
import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerException;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;
import java.util.Arrays;

/**
 * The connection with a robot, Figure 7, and what it gets. What differs from the paper is listed in
 * {@code docs/guide/02-the-papers-code.md}.
 */
final class Figure7 {
    private Figure7() {}

    public static void main(String[] args) {
        PaperRobots.drive(args, 1, robots -> connect(robots.host(), robots.port()));
    }

    private static void connect(String host, int port) {
        PlayerClient robot = null;
        Position2DInterface posi1 = null;
        SonarInterface rngi1 = null;
        BlobfinderInterface blfi1 = null;

        try {
            // Connect to the Player server and request access to Position and Sonar
            robot = new PlayerClient(host, port);
            posi1 = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
            rngi1 = robot.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
            blfi1 = robot.requestInterfaceBlobfinder(0, PlayerConstants.PLAYER_OPEN_MODE);
        } catch (PlayerException e) {
            System.err.println("robot1: > Error connecting to Player: ");
            System.err.println("    [ " + e.toString() + " ]");
            System.exit(1);
        }

        robot.runThreaded(-1, -1);

        // The figure ends here. By the text a service begins when isDataReady() replies true.
        while (!rngi1.isDataReady())
            ;
        System.out.println("sonar ready: " + Arrays.toString(rngi1.getData().getRanges()));
        while (!posi1.isDataReady())
            ;
        System.out.println("position ready: " + posi1.getX() + ", " + posi1.getY() + ", " + posi1.getYaw());
        while (!blfi1.isDataReady())
            ;
        System.out.println("blobfinder ready: " + blfi1.getData().getBlobs_count() + " blobs");
        robot.close();
    }
}
