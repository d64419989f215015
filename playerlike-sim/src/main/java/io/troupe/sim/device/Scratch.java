package io.troupe.sim.device;

/**
 * Working memory for reading devices.
 *
 * <p><b>Threads.</b> One thread at a time; threads that read at the same time have one each.
 */
public final class Scratch {
    final Ray ray = new Ray();
    final Camera camera = new Camera();
    private int[] things = new int[0];
    private double[] distancesM = new double[0];
    private boolean[] wanted = new boolean[0];

    /** Makes room for a fan of so many rays. */
    void fit(int rays) {
        if (things.length < rays) {
            things = new int[rays];
            distancesM = new double[rays];
            wanted = new boolean[rays];
        }
    }

    /** What each ray hit, or {@link Ray#NOTHING}. */
    int[] things() {
        return things;
    }

    /** How far away that is, or infinity. */
    double[] distancesM() {
        return distancesM;
    }

    /** Which rays are worth casting. */
    boolean[] wanted() {
        return wanted;
    }
}
