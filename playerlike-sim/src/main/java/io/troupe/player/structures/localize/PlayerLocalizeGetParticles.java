package io.troupe.player.structures.localize;

import io.troupe.player.structures.PlayerPose;
import io.troupe.player.structures.PlayerPose2d;

/** Part of a message of the Player interface localize. This client does not use it. */
public class PlayerLocalizeGetParticles {
    private PlayerPose mean = new PlayerPose();
    private double variance;
    private int particles_count;
    private PlayerLocalizeParticle[] particles = new PlayerLocalizeParticle[0];

    public synchronized PlayerPose getMean() {
        return mean;
    }

    public synchronized void setMean(PlayerPose2d value) {
        mean = PlayerPose.of(value);
    }

    public synchronized double getVariance() {
        return variance;
    }

    public synchronized void setVariance(double value) {
        variance = value;
    }

    public synchronized int getParticles_count() {
        return particles_count;
    }

    public synchronized void setParticles_count(int value) {
        particles_count = value;
    }

    public synchronized PlayerLocalizeParticle[] getParticles() {
        return particles;
    }

    public synchronized void setParticles(PlayerLocalizeParticle[] value) {
        particles = value;
    }
}
