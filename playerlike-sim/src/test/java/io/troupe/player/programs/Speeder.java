package io.troupe.player.programs;

import io.troupe.player.PlayerClient;
import io.troupe.player.Position2DInterface;
import io.troupe.player.structures.PlayerConstants;

/** Sends speeds that no robot reaches, turning on the spot between them. */
public class Speeder {
    public static void main(String[] args) {
        PlayerClient client = new PlayerClient(args[0], Integer.parseInt(args[1]));
        client.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
        Position2DInterface pos = client.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
        for (int cycle = 0; ; cycle++) {
            client.readAll();
            switch (cycle % 4) {
                case 0 -> pos.setSpeed(1e6, 0);
                case 1 -> pos.setSpeed(-1e6, 0);
                case 2 -> pos.setSpeed(0, 1e300);
                default -> pos.setSpeed(0, -Double.MAX_VALUE);
            }
        }
    }
}
