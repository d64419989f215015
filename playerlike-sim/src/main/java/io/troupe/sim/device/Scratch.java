package io.troupe.sim.device;

/**
 * Working memory for reading devices.
 *
 * <p><b>Threads.</b> One thread at a time; concurrent readers need one each.
 */
public final class Scratch {
    final Ray ray = new Ray();
    final Camera camera = new Camera();
    final FanProjection.Rays rays = new FanProjection.Rays();
    private int[] things = new int[0];
    private double[] distancesM = new double[0];
    private boolean[] wanted = new boolean[0];
    private int[] markers = new int[0];

    /** Ensures the capacity for a fan of the given number of rays. */
    void fit(int size) {
        rays.fit(size);
        if (things.length < size) {
            things = new int[size];
            distancesM = new double[size];
            wanted = new boolean[size];
        }
    }

    /** Number of the thing that each ray hit, or {@link Ray#NOTHING}. */
    int[] things() {
        return things;
    }

    /** Distance of each hit, or infinity. */
    double[] distancesM() {
        return distancesM;
    }

    /** Room for this number of markers. */
    int[] markers(int count) {
        if (markers.length < count) {
            markers = new int[count];
        }
        return markers;
    }

    /** Rays that must be cast. */
    boolean[] wanted() {
        return wanted;
    }
}
