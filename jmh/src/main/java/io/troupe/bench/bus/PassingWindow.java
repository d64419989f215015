package io.troupe.bench.bus;

import java.util.concurrent.Semaphore;
import java.util.concurrent.TimeUnit;

/**
 * Limits the records on their way from a publisher to its subscriber, since a bus does not make a publisher wait.
 *
 * <p><b>Threads.</b> One publishes, one receives.
 */
final class PassingWindow {
    /** The most records on their way. */
    static final int SIZE = 4_096;
    /** Records are counted in groups, so that counting costs little. */
    static final int GROUP = 256;

    private static final int SECONDS = 60;

    private final Semaphore free = new Semaphore(SIZE);
    private int inGroup; // of the receiving thread

    /** Waits until one more group may be published. */
    void awaitGroup() throws InterruptedException {
        await(GROUP);
    }

    void received() {
        if (++inGroup == GROUP) {
            inGroup = 0;
            free.release(GROUP);
        }
    }

    /** Waits until everything has arrived. */
    void awaitAll() throws InterruptedException {
        await(SIZE);
        free.release(SIZE);
    }

    private void await(int records) throws InterruptedException {
        if (!free.tryAcquire(records, SECONDS, TimeUnit.SECONDS)) {
            throw new IllegalStateException("after " + SECONDS + " s " + (SIZE - free.availablePermits())
                    + " records have not arrived, expected none to be lost");
        }
    }
}
