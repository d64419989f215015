package io.troupe.bench;

import java.util.ArrayList;
import java.util.List;

/** What an actor that has handled one message and now waits keeps of the heap. */
final class Retained {
    static final int ACTORS = 2_000;
    private static final int TRIALS = 5;
    private static final int COLLECTIONS = 4;
    private static final int PAUSE_MILLIS = 20;

    private Retained() {}

    /**
     * Bytes per actor, the median of some trials. Minor things that the contender allocates meanwhile are divided by
     * 2,000 actors.
     */
    static double bytesPerActor(Contender contender) throws Exception {
        return bytesPerActor(() -> contender.create(ACTORS), contender::clear);
    }

    interface Action {
        void run() throws Exception;
    }

    /** The first action makes as many as {@link #ACTORS}, the second lets them go. */
    static double bytesPerActor(Action create, Action clear) throws Exception {
        List<Double> trials = new ArrayList<>();
        for (int i = 0; i < TRIALS; i++) {
            long before = usedBytes();
            create.run();
            trials.add((double) (usedBytes() - before) / ACTORS);
            clear.run();
        }
        return Quartiles.of(trials).median();
    }

    /** Between the collections the contender may drop what only waited for them, or for the end of its last task. */
    private static long usedBytes() throws InterruptedException {
        for (int i = 0; i < COLLECTIONS; i++) {
            System.gc();
            Thread.sleep(PAUSE_MILLIS);
        }
        var runtime = Runtime.getRuntime();
        return runtime.totalMemory() - runtime.freeMemory();
    }
}
