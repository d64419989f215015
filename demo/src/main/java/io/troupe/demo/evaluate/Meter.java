package io.troupe.demo.evaluate;

import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.ServiceObserver;

/**
 * Watches a run and says when it has seen enough.
 *
 * <p><b>Threads.</b> Told on the thread that runs the services; {@link #result} is for when that has ended or waits for
 * the world.
 */
interface Meter extends ServiceObserver, Arbitrator.StateListener {
    /** Any thread may ask. */
    boolean isDone();

    Result result();
}
