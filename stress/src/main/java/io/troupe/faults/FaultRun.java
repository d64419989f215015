package io.troupe.faults;

import io.troupe.faults.history.History;
import java.io.IOException;

/** One run of the suite: processes are started, broken at random, repaired, and ended in good order. */
sealed interface FaultRun extends AutoCloseable permits BusFaultRun, DriverFaultRun {
    /** The number, from 1, and the description of a fault that begins now. */
    record Progress(long number, String text) {}

    /**
     * Breaks that many things, and repairs them.
     *
     * @return what all processes have written down
     */
    History run(int faults) throws IOException, InterruptedException;

    /** Ends all processes of the run. */
    @Override
    void close();
}
