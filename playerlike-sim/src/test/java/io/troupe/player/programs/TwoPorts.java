package io.troupe.player.programs;

import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerException;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;

/** Drives two robots at two ports, each from a separate thread. */
public class TwoPorts extends Thread {
    private final Position2DInterface pos;
    private final SonarInterface son;

    public TwoPorts(String host, String port) {
        PlayerClient client = new PlayerClient(host, Integer.parseInt(port));
        pos = client.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
        son = client.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
        client.runThreaded(-1, -1);
    }

    @Override
    public void run() {
        try {
            while (true) {
                while (!son.isDataReady())
                    ;
                SpaceWanderer.steer(pos, son.getData().getRanges());
            }
        } catch (PlayerException e) {
            // the server has closed
        }
    }

    public static void main(String[] args) throws InterruptedException {
        TwoPorts first = new TwoPorts(args[0], args[1]);
        TwoPorts second = new TwoPorts(args[0], args[2]);
        first.start();
        second.start();
        first.join();
        second.join();
    }
}
