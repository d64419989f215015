package io.troupe.bus;

import java.util.LinkedHashMap;
import java.util.Map;
import java.util.OptionalLong;
import java.util.concurrent.ConcurrentHashMap;
import org.jspecify.annotations.Nullable;

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

    /** What has arrived of a series. */
    private static final class Arrivals {
        final long firstSentMicros;
        long last;
        long undecided; // values before the first one, until it is known whether they followed the subscription

        Arrivals(long firstSentMicros) {
            this.firstSentMicros = firstSentMicros;
        }
    }

    /** Returns the age of a frame in nanoseconds. */
    long ageNanos(Frames.Header header, long nowNanos) {
        return peer(header).ageNanos(header.sentMicros() * 1_000, nowNanos);
    }

    /**
     * Records a value of a publisher.
     *
     * @param number the number of the value, counted from 1
     * @param subscribedNanos since when this node subscribes to the topic
     * @return how many values before it are missing; for the first one of a publisher, 0 if its node was opened before
     *     the subscription: then a mark shows later whether they concern this node
     */
    long missing(Frames.Header header, String topic, long number, long subscribedNanos) {
        return peer(header)
                .missing(new Series(header.from().name(), topic), number - 1, number, header, subscribedNanos);
    }

    /**
     * Records a mark of a publisher.
     *
     * @param last the number of its last value
     * @param begunMicros when it published its first one, on its node's clock; if that is known, it decides whether the
     *     values before the first one that has arrived here are missing
     * @param subscribedNanos as above
     * @return how many values are missing that were not reported before
     */
    long missingAtMark(Frames.Header header, String topic, long last, OptionalLong begunMicros, long subscribedNanos) {
        var series = new Series(header.from().name(), topic);
        Peer peer = peer(header);
        synchronized (peer) {
            return peer.missing(series, last, last, header, subscribedNanos)
                    + (begunMicros.isEmpty() ? 0 : peer.decided(series, begunMicros.getAsLong(), subscribedNanos));
        }
    }

    /** Returns whether nothing has arrived yet from a publisher on a topic. */
    boolean isFirst(Frames.Header header, String topic) {
        return peer(header).isFirst(new Series(header.from().name(), topic));
    }

    /** Forgets how many values of the topic have arrived: nothing was subscribed for a while. */
    void forget(String topic) {
        peers.values().forEach(peer -> peer.forget(topic));
    }

    /** Threads may get the first frames of a node at the same time, and the last ones of its life before. */
    private Peer peer(Frames.Header header) {
        String node = header.from().node();
        Peer known = peers.get(node);
        if (known != null && known.incarnation == header.incarnation()) {
            return known;
        }
        if (peers.size() >= MOST_NODES) {
            peers.clear(); // names are cheap to invent: memory must not grow with them
        }
        Peer latest = peers.compute(
                node,
                (name, now) -> now != null && now.of(header.incarnation()) != null
                        ? now
                        : new Peer(header.incarnation(), now));
        Peer found = latest.of(header.incarnation());
        return found == null ? peer(header) : found; // two more lives have begun since
    }

    /** One life of another node, and the one before: frames of the two may arrive mixed, on two threads. */
    private static final class Peer {
        final long incarnation;
        private final Map<Series, Arrivals> arrivals = new LinkedHashMap<>(); // guarded by this, as all fields below
        private boolean knownClock;
        private long leastNanos; // also the time here when the node was opened there
        private long leastOfWindowNanos;
        private long windowEndNanos;

        /** The life before; null for the first one, and in a life that is itself the one before. */
        private volatile @Nullable Peer before;

        Peer(long incarnation, @Nullable Peer before) {
            this.incarnation = incarnation;
            this.before = before;
            if (before != null) {
                before.before = null;
            }
        }

        /** That life, if it is this one or the one before. */
        @Nullable
        Peer of(long itsIncarnation) {
            Peer earlier = before;
            return itsIncarnation == incarnation ? this : earlier == null ? null : earlier.of(itsIncarnation);
        }

        synchronized long ageNanos(long sentNanos, long nowNanos) {
            long difference = nowNanos - sentNanos;
            if (!knownClock) {
                knownClock = true;
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
            return !arrivals.containsKey(series);
        }

        /** @param before the number of values that should have arrived before this frame */
        synchronized long missing(Series series, long before, long number, Frames.Header header, long subscribedNanos) {
            if (arrivals.size() >= MOST_SERIES) {
                arrivals.remove(arrivals.keySet().iterator().next());
            }
            Arrivals known = arrivals.get(series);
            if (known != null) {
                long missing = Math.max(0, before - known.last);
                known.last = number;
                return missing;
            }
            var first = new Arrivals(header.sentMicros());
            first.last = number;
            arrivals.put(series, first);
            if (isAfter(0, subscribedNanos)) {
                return before;
            }
            first.undecided = before;
            return 0;
        }

        /**
         * Returns how many values before the first one that has arrived are missing, by the beginning of the series.
         */
        synchronized long decided(Series series, long begunMicros, long subscribedNanos) {
            Arrivals known = arrivals.get(series);
            if (known == null || known.undecided == 0) {
                return 0;
            }
            long missing = known.undecided;
            known.undecided = 0;
            boolean isLaterSeries = begunMicros > known.firstSentMicros; // its port was closed and attached again
            return !isLaterSeries && isAfter(begunMicros, subscribedNanos) ? missing : 0;
        }

        /** Whether that time there, as a frame without delay would have brought it here, is after the subscription. */
        private boolean isAfter(long micros, long subscribedNanos) {
            return !knownClock || leastNanos + micros * 1_000 - subscribedNanos > 0;
        }

        void forget(String topic) {
            Peer earlier = before;
            if (earlier != null) {
                earlier.forget(topic);
            }
            synchronized (this) {
                arrivals.keySet().removeIf(series -> series.topic.equals(topic));
            }
        }
    }
}
