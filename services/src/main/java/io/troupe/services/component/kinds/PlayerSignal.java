package io.troupe.services.component.kinds;

import io.troupe.player.structures.blobfinder.PlayerBlobfinderData;
import io.troupe.player.structures.laser.PlayerLaserData;
import io.troupe.player.structures.position2d.PlayerPosition2dData;
import io.troupe.player.structures.sonar.PlayerSonarData;

/**
 * Data signals between the component interface and the Player client. Robots are identified by their Player index, from
 * 0.
 */
sealed interface PlayerSignal {
    int index();

    /** Command to the server: {@code setSpeed}. */
    record SetSpeed(int index, double speed, double turnRate) implements PlayerSignal {}

    /** Sensor reading from the server. */
    sealed interface Reading extends PlayerSignal {
        double timestamp();
    }

    record Sonar(int index, double timestamp, PlayerSonarData data) implements Reading {}

    record Laser(int index, double timestamp, PlayerLaserData data) implements Reading {}

    record Position(int index, double timestamp, PlayerPosition2dData data) implements Reading {}

    record Blobs(int index, double timestamp, PlayerBlobfinderData data) implements Reading {}
}
