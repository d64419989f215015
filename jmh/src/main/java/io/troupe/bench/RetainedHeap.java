package io.troupe.bench;

import java.util.ArrayList;
import java.util.List;

/** Measures the heap that an idle actor retains after it has handled one message. */
final class RetainedHeap {
    static final int ACTORS = 2_000;
    private static final int TRIALS = 5;
    private static final int COLLECTIONS = 4;
    private static final int PAUSE_MILLIS = 20;

    private RetainedHeap() {}

    /**
     * Bytes per actor, the median of some trials. Small allocations of the contender meanwhile are divided by 2,000
     * actors.
     */
    static double bytesPerActor(Contender contender) throws Exception {
        return bytesPerActor(() -> contender.create(ACTORS), contender::clear);
    }

    interface Action {
        void run() throws Exception;
    }

    /**
     * Measures what {@code create}, which makes {@link #ACTORS} objects, adds to the heap; {@code clear} drops them.
     */
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

    /**
     * The used heap after several collections. The pauses let the contender drop what it keeps until a collection or
     * until the end of its last task.
     */
    private static long usedBytes() throws InterruptedException {
        for (int i = 0; i < COLLECTIONS; i++) {
            System.gc();
            Thread.sleep(PAUSE_MILLIS);
        }
        var runtime = Runtime.getRuntime();
        return runtime.totalMemory() - runtime.freeMemory();
    }
}
