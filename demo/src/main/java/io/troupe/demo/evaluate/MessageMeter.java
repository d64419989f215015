package io.troupe.demo.evaluate;

import java.util.ArrayDeque;
import java.util.HashMap;
import java.util.Map;
import java.util.Queue;

/** Counts the colour messages from services to the main code, and measures their delay. */
final class MessageMeter {
    private static final double NANOS_PER_MICRO = 1e3;

    /**
     * Send times of messages in transit, by robot. Messages of one robot arrive in the order in which they were sent.
     */
    private final Map<Integer, Queue<Long>> onTheirWay = new HashMap<>();

    private final Durations delays = new Durations();
    private int sent;
    private int received;

    void sent(int robot) {
        sent++;
        onTheirWay.computeIfAbsent(robot, index -> new ArrayDeque<>()).add(System.nanoTime());
    }

    void received(int robot) {
        long now = System.nanoTime();
        Long then =
                onTheirWay.computeIfAbsent(robot, index -> new ArrayDeque<>()).poll();
        if (then != null) { // null if it was sent after counting had ended
            received++;
            delays.add(now - then);
        }
    }

    void addTo(Result.Builder result) {
        result.add(Measurement.BOTH, Quantity.SENT, sent).add(Measurement.BOTH, Quantity.RECEIVED, received);
        if (delays.count() > 0) {
            result.add(Measurement.BOTH, Quantity.DELAY, delays.quantile(0.5, NANOS_PER_MICRO))
                    .add(Measurement.BOTH, Quantity.DELAY_P99, delays.quantile(0.99, NANOS_PER_MICRO));
        }
    }
}
