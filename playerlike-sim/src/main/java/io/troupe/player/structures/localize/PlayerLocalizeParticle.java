package io.troupe.player.structures.localize;

import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;

/** Part of a message of the Player interface localize. This client does not use it. */
public class PlayerLocalizeParticle {
    private PlayerPose pose = new PlayerPose();
    private double alpha;

    public synchronized PlayerPose getPose() {
        return pose;
    }

    public synchronized void setPose(PlayerPose2d value) {
        pose = PlayerPose.of(value);
    }

    public synchronized double getAlpha() {
        return alpha;
    }

    public synchronized void setAlpha(double value) {
        alpha = value;
    }
}
