package io.troupe.demo.evaluate;

import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.ServiceObserver;

/**
 * Measures a run, and decides when it has enough data.
 *
 * <p><b>Threads.</b> Callbacks arrive on the thread that runs the services. {@link #result} may be called once that
 * thread has ended or waits for the world.
 */
interface Meter extends ServiceObserver, Arbitrator.StateListener {
    /** May be called by any thread. */
    boolean isDone();

    Result result();
}
