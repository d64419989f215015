package io.troupe.bus;

import java.util.LinkedHashMap;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;

/**
 * What a node knows of other nodes from their frames: how long a frame was on its way, and how many values of a
 * publisher have not arrived.
 *
 * <p><b>Age.</b> The clocks of two machines differ, but frames carry the time since the start of their sender's
 * incarnation. The least difference between the time of arrival and that time, among the frames of the last minute or
 * two, belongs to a frame that was not delayed; a frame is as old as its difference exceeds that. So the age does not
 * contain the usual delay of the network, and a delay that all frames share is not seen.
 *
 * <p><b>Threads.</b> Any thread.
 */
final class RemotePublishers {
    private static final long WINDOW_NANOS = 60_000_000_000L;
    private static final int MOST_NODES = 10_000;
    private static final int MOST_SERIES = 10_000;

    private final Map<String, Peer> peers = new ConcurrentHashMap<>();

    /** A publisher's values on one topic. */
    private record Series(String port, String topic) {}

    /** Returns the age of a frame in nanoseconds. */
    long ageNanos(Frames.Header header, long nowNanos) {
        return peer(header).ageNanos(header.sentMicros() * 1_000, nowNanos);
    }

    /**
     * Records a value of a publisher, or a mark.
     *
     * @param number the number of the value, counted from 1; of a mark, that of the last value
     * @param subscribedNanos since when this node subscribes to the topic
     * @return how many values before it are missing; for the first one of a publisher, 0 if its node was opened before
     *     the subscription
     */
    long missing(Frames.Header header, String topic, long number, boolean isMark, long subscribedNanos) {
        return peer(header).missing(new Series(header.from().name(), topic), number, isMark, subscribedNanos);
    }

    /** Returns whether nothing has arrived yet from a publisher on a topic. */
    boolean isFirst(Frames.Header header, String topic) {
        return peer(header).isFirst(new Series(header.from().name(), topic));
    }

    /** Forgets how many values of the topic have arrived: nothing was subscribed for a while. */
    void forget(String topic) {
        peers.values().forEach(peer -> peer.forget(topic));
    }

    private Peer peer(Frames.Header header) {
        Peer known = peers.get(header.from().node());
        if (known != null && known.incarnation == header.incarnation()) {
            return known;
        }
        if (peers.size() >= MOST_NODES) {
            peers.clear(); // names are cheap to invent: memory must not grow with them
        }
        var peer = new Peer(header.incarnation());
        peers.put(header.from().node(), peer);
        return peer;
    }

    /** One life of another node. */
    private static final class Peer {
        final long incarnation;
        private final Map<Series, Long> last = new LinkedHashMap<>(); // guarded by this, as all fields below
        private boolean known;
        private long leastNanos; // also the time here when the node was opened there
        private long leastOfWindowNanos;
        private long windowEndNanos;

        Peer(long incarnation) {
            this.incarnation = incarnation;
        }

        synchronized long ageNanos(long sentNanos, long nowNanos) {
            long difference = nowNanos - sentNanos;
            if (!known) {
                known = true;
                leastNanos = difference;
                leastOfWindowNanos = difference;
                windowEndNanos = nowNanos + WINDOW_NANOS;
            } else if (nowNanos - windowEndNanos > 0) { // the clocks drift: a minimum of long ago means little
                leastNanos = leastOfWindowNanos;
                leastOfWindowNanos = difference;
                windowEndNanos = nowNanos + WINDOW_NANOS;
            }
            leastOfWindowNanos = Math.min(leastOfWindowNanos, difference);
            leastNanos = Math.min(leastNanos, difference);
            return difference - leastNanos;
        }

        synchronized boolean isFirst(Series series) {
            return !last.containsKey(series);
        }

        synchronized long missing(Series series, long number, boolean isMark, long subscribedNanos) {
            if (last.size() >= MOST_SERIES) {
                last.remove(last.keySet().iterator().next());
            }
            Long before = last.put(series, number);
            if (before == null && known && leastNanos - subscribedNanos <= 0) {
                return 0; // what it published before is of no concern here
            }
            return Math.max(0, number - (before == null ? 0 : before) - (isMark ? 0 : 1));
        }

        synchronized void forget(String topic) {
            last.keySet().removeIf(series -> series.topic.equals(topic));
        }
    }
}
