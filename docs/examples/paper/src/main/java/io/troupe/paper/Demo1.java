package io.troupe.paper;

import io.troupe.player.BlobfinderInterface;
import io.troupe.player.PlayerClient;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.services.behaviour.Blob;
import io.troupe.services.behaviour.ColourFinder;
import io.troupe.services.behaviour.SonarRing;
import io.troupe.services.behaviour.SpaceWanderer;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.behaviour.WallFollower;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.SubsumptionTable;

/**
 * The main code of the paper in synchronous mode: Figure 14 for state 1, and the same for states 2 and 3, which the
 * paper does not print. The changes are listed in {@code docs/guide/02-the-papers-code.md}; [n] marks the lines of that
 * list.
 */
final class Demo1 {
    private final PlayerClient robot;
    private final Position2DInterface posi1;
    private final SonarInterface rngi1;
    private final BlobfinderInterface blfi1;
    private final Position2DInterface posi;
    private final SonarInterface rngi;
    private final BlobfinderInterface blfi;
    private final double seconds;
    private final WallFollower follower = new WallFollower(CornerStyle.FORWARD);
    private WallFollower.Memory temp = WallFollower.START;
    private double startSeconds = Double.NaN;
    private double nowSeconds;
    private int color1 = 255;
    private int color4;

    public static void main(String[] args) {
        PaperRobots.drive(args, 1, robots -> new Demo1(robots.host(), robots.port(), robots.seconds()).run());
    }

    /** "The connection with the robots is done only single time in the starting of the main code." */
    Demo1(String host, int port, double seconds) {
        this.seconds = seconds;
        robot = new PlayerClient(host, port);
        robot.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
        posi1 = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
        rngi1 = robot.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
        blfi1 = robot.requestInterfaceBlobfinder(0, PlayerConstants.PLAYER_OPEN_MODE);
        posi = robot.requestInterfacePosition2D(1, PlayerConstants.PLAYER_OPEN_MODE);
        rngi = robot.requestInterfaceSonar(1, PlayerConstants.PLAYER_OPEN_MODE);
        blfi = robot.requestInterfaceBlobfinder(1, PlayerConstants.PLAYER_OPEN_MODE);
    }

    void run() {
        while (goesOn()) {
            temp = WallFollower.START;
            if (color1 == 255) {
                System.out.println("State 1");
                do {
                    wallF(posi1, rngi1, blfi1);
                    color4 = SW(posi, rngi, blfi);
                    System.out.println(color4);
                    if (color4 != 0 && color4 != 16753920) {
                        color1 = color4;
                    }
                } while (color1 == 255 && goesOn()); // [1]
            } else if (color1 == 16711680) {
                System.out.println("State 2");
                do {
                    color4 = SW(posi1, rngi1, blfi1);
                    System.out.println(color4);
                    if (color4 != 0 && color4 != 16753920) {
                        color1 = color4;
                    } else {
                        wallF(posi, rngi, blfi);
                    }
                } while (color1 == 16711680 && goesOn());
            } else if (color1 == 65280) {
                System.out.println("State 3");
                do {
                    color4 = SW(posi1, rngi1, blfi1);
                    if (color4 == 0) {
                        color4 = SW(posi, rngi, blfi);
                    }
                    System.out.println(color4);
                    if (color4 != 0 && color4 != 16753920) {
                        color1 = color4;
                    }
                } while (color1 == 65280 && goesOn());
            }
        }
        posi1.setSpeed(0, 0);
        posi.setSpeed(0, 0);
        robot.close();
    }

    /** The wall follower; its camera is of no use to it. */
    private void wallF(Position2DInterface position, SonarInterface sonar, BlobfinderInterface unused) {
        robot.readAll();
        nowSeconds = sonar.getTimestamp();
        var step = follower.step(temp, SonarRing.of(sonar.getData().getRanges()));
        temp = step.memory();
        setSpeed(position, step.velocity());
    }

    /** The space wanderer; returns the colour that leads to another state, or black. */
    private int SW(Position2DInterface position, SonarInterface sonar, BlobfinderInterface blobfinder) {
        robot.readAll();
        nowSeconds = sonar.getTimestamp();
        setSpeed(position, SpaceWanderer.steer(SonarRing.of(sonar.getData().getRanges())));
        var states = SubsumptionTable.ofThePaper();
        return ColourFinder.find(
                        Blob.of(blobfinder.getData()),
                        colour -> colour != color1 && states.state(colour).isPresent())
                .orElse(0);
    }

    private static void setSpeed(Position2DInterface position, Velocity velocity) {
        position.setSpeed(velocity.forwardMps(), velocity.turnRadps());
    }

    private boolean goesOn() {
        if (Double.isNaN(startSeconds)) {
            startSeconds = nowSeconds;
        }
        return nowSeconds - startSeconds < seconds;
    }
}
