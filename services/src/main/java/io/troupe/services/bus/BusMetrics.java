package io.troupe.services.bus;

/**
 * How much a node of a bus has carried since it was opened.
 *
 * <p><b>Units and shapes.</b> Once all is quiet, {@code queued = delivered + failed + dropped + discarded}, and
 * {@code asked = answered + refused + timedOut}, if no asker cancels.
 *
 * @param published values sent from here
 * @param queued copies of values put before subscribers here: one for each value and subscriber
 * @param delivered copies heard
 * @param failed copies whose subscriber threw
 * @param dropped copies that made room for newer ones
 * @param discarded copies that waited when their subscription ended
 * @param undeliverable messages that came here and that nobody here can take
 * @param asked questions sent from here
 * @param answered questions from here that were answered
 * @param refused questions from here that were rejected otherwise than by their time limit
 * @param timedOut questions from here that found no answer within their limit
 * @param late answers for which nobody waited any more
 */
public record BusMetrics(
        long published,
        long queued,
        long delivered,
        long failed,
        long dropped,
        long discarded,
        long undeliverable,
        long asked,
        long answered,
        long refused,
        long timedOut,
        long late) {}
