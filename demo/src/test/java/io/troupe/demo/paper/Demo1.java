package io.troupe.demo.paper;

import io.troupe.player.BlobfinderInterface;
import io.troupe.player.PlayerClient;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.Blob;
import io.troupe.services.behaviour.ColourFinder;
import io.troupe.services.behaviour.RobotPose;
import io.troupe.services.behaviour.Senses;
import io.troupe.services.behaviour.SonarRing;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.SubsumptionTable;
import java.util.List;

/**
 * The main code of the paper in synchronous mode: Figure 14 for state 1, and the same for states 2 and 3, which the
 * paper does not print. The changes are listed in {@code docs/guide/02-the-papers-code.md}; [n] marks the lines of that
 * list.
 */
final class Demo1 implements Runnable {
    private final List<String> printed; // [1] instead of System.out, so that a test can read it
    private PlayerClient robot;
    private Position2DInterface posi1;
    private SonarInterface rngi1;
    private BlobfinderInterface blfi1;
    private Position2DInterface posi;
    private SonarInterface rngi;
    private BlobfinderInterface blfi;
    private Behaviour wallF; // [2] the services' memory; new in each state
    private Behaviour sw1;
    private Behaviour sw;
    private int color1 = 255;
    private int color4;

    Demo1(List<String> printed) {
        this.printed = printed;
    }

    /** Called once: "The connection with the robots is done only single time in the starting of the main code." */
    void connect() {
        robot = new PlayerClient("localhost", 6665);
        robot.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
        posi1 = robot.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
        rngi1 = robot.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
        blfi1 = robot.requestInterfaceBlobfinder(0, PlayerConstants.PLAYER_OPEN_MODE);
        posi = robot.requestInterfacePosition2D(1, PlayerConstants.PLAYER_OPEN_MODE);
        rngi = robot.requestInterfaceSonar(1, PlayerConstants.PLAYER_OPEN_MODE);
        blfi = robot.requestInterfaceBlobfinder(1, PlayerConstants.PLAYER_OPEN_MODE);
    }

    @Override
    public void run() {
        while (true) { // [3] until readAll() throws because the connection has been closed
            wallF = Service.WALL_FOLLOWER.behaviour().get();
            sw1 = Service.SPACE_WANDERER.behaviour().get();
            sw = Service.SPACE_WANDERER.behaviour().get();
            if (color1 == 255) {
                printed.add("State 1");
                do {
                    wallF(posi1, rngi1);
                    color4 = SW(sw, posi, rngi, blfi);
                    // [4] System.out.println (color4)
                    if (color4 != 0 && color4 != 16753920) {
                        color1 = color4;
                    }
                } while (color1 == 255);
            } else if (color1 == 16711680) {
                printed.add("State 2");
                do {
                    color4 = SW(sw1, posi1, rngi1, blfi1);
                    if (color4 != 0 && color4 != 16753920) {
                        color1 = color4;
                        continue; // [5] the state has ended
                    }
                    wallF(posi, rngi);
                } while (color1 == 16711680);
            } else if (color1 == 65280) {
                printed.add("State 3");
                do {
                    color4 = SW(sw1, posi1, rngi1, blfi1);
                    if (color4 != 0 && color4 != 16753920) {
                        color1 = color4;
                        continue; // [5]
                    }
                    color4 = SW(sw, posi, rngi, blfi);
                    if (color4 != 0 && color4 != 16753920) {
                        color1 = color4;
                    }
                } while (color1 == 65280);
            }
        }
    }

    private void wallF(Position2DInterface position, SonarInterface sonar) {
        cycle(wallF, position, sonar);
    }

    /** [6] The colour that our rule selects, if it differs from the state's own; otherwise black. */
    private int SW(
            Behaviour behaviour, Position2DInterface position, SonarInterface sonar, BlobfinderInterface blobfinder) {
        cycle(behaviour, position, sonar);
        var states = SubsumptionTable.ofThePaper();
        return ColourFinder.find(
                        Blob.of(blobfinder.getData()),
                        colour -> colour != color1 && states.state(colour).isPresent())
                .orElse(0);
    }

    private void cycle(Behaviour behaviour, Position2DInterface position, SonarInterface sonar) {
        robot.readAll();
        var senses = new Senses(
                sonar.getTimestamp(),
                SonarRing.of(sonar.getData().getRanges()),
                new RobotPose(position.getX(), position.getY(), position.getYaw()));
        Velocity velocity = behaviour.step(senses).orElse(Velocity.STOP);
        position.setSpeed(velocity.forwardMps(), velocity.turnRadps());
    }
}
