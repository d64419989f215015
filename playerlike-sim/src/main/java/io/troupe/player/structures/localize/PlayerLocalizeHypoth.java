package io.troupe.player.structures.localize;

import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;

/** Part of a message of the Player interface localize. This client does not use it. */
public class PlayerLocalizeHypoth {
    private PlayerPose mean = new PlayerPose();
    private double[] cov = new double[0];
    private double alpha;

    public synchronized PlayerPose getMean() {
        return mean;
    }

    public synchronized void setMean(PlayerPose2d value) {
        mean = PlayerPose.of(value);
    }

    public synchronized double[] getCov() {
        return cov;
    }

    public synchronized void setCov(double[] value) {
        cov = value;
    }

    public synchronized double getAlpha() {
        return alpha;
    }

    public synchronized void setAlpha(double value) {
        alpha = value;
    }
}
