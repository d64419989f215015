package io.troupe.services.subsumption;

import io.troupe.actor.ActorSpace;
import io.troupe.bus.Bus;
import io.troupe.bus.BusEngine;
import io.troupe.bus.BusSettings;
import java.util.HashSet;
import java.util.Map;
import java.util.Objects;
import java.util.Queue;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.atomic.AtomicInteger;
import org.jspecify.annotations.Nullable;

/** A bus between hosts that exchange only bytes, and may lose them. Frames arrive by callbacks of a space. */
final class HostsPipe {
    private static final int MOST_BYTES = 1 << 20;

    private record Parcel(End to, byte[] bytes) {}

    private final ActorSpace carrier;
    private final Map<String, End> nodes = new ConcurrentHashMap<>();
    private final Queue<Parcel> underWay = new ConcurrentLinkedQueue<>();
    private final Map<String, End> cut = new ConcurrentHashMap<>();
    private final Set<String> lost = ConcurrentHashMap.newKeySet();
    private final AtomicInteger losing = new AtomicInteger();

    HostsPipe(ActorSpace carrier) {
        this.carrier = carrier;
    }

    Bus open(String name, BusSettings settings) {
        return Bus.open(name, new End(), settings);
    }

    /** A node loses its connection, and the others notice at once. */
    void disconnect(String node) {
        End end = Objects.requireNonNull(nodes.remove(node));
        cut.put(node, end);
        end.listener().disconnected("the test has cut it");
    }

    /** A node that was disconnected is connected again. */
    void reconnect(String node) {
        End end = Objects.requireNonNull(cut.remove(node));
        nodes.put(node, end);
        end.listener().connected();
    }

    /** From now on, frames from and to that node are lost, and no node notices. */
    void lose(String node) {
        lost.add(node);
    }

    void loseNoMore(String node) {
        lost.remove(node);
    }

    /** The next frames between nodes are lost. */
    void loseNext(int frames) {
        losing.set(frames);
    }

    private void carryAll() {
        for (Parcel next = underWay.poll(); next != null; next = underWay.poll()) {
            if (nodes.containsValue(next.to())) {
                next.to().listener().frame(next.bytes());
            }
        }
    }

    /** The engine of one node. */
    private final class End implements BusEngine {
        private final Set<String> topics = new HashSet<>(); // guarded by itself
        private volatile String mine = "";
        private volatile long incarnation;
        private volatile @Nullable Listener listener;

        Listener listener() {
            return Objects.requireNonNull(listener);
        }

        @Override
        public void start(String node, long itsIncarnation, Listener itsListener) {
            mine = node;
            incarnation = itsIncarnation;
            listener = itsListener;
            nodes.put(node, this);
        }

        @Override
        public @Nullable String whyDisconnected() {
            return cut.containsValue(this) ? "the test has cut it" : null;
        }

        @Override
        public int maxFrameBytes() {
            return MOST_BYTES;
        }

        @Override
        public void send(String node, long number, byte[] frame) {
            End to = nodes.get(node);
            if (to == null) {
                listener().unreachable(node, number, "there is no way from node " + mine + " to node " + node);
            } else {
                carry(to, frame);
            }
        }

        @Override
        public void reply(String node, long toIncarnation, long number, byte[] frame) {
            End to = nodes.get(node);
            if (to == null || to.incarnation != toIncarnation) {
                listener().gone(node, toIncarnation);
            } else {
                carry(to, frame);
            }
        }

        @Override
        public void publish(String topic, byte[] frame) {
            nodes.values().stream()
                    .filter(each -> each != this && each.hasSubscribed(topic))
                    .forEach(each -> carry(each, frame));
        }

        private void carry(End to, byte[] frame) {
            if (lost.contains(mine) || lost.contains(to.mine)) {
                return;
            }
            if (losing.get() > 0) {
                losing.decrementAndGet();
                return;
            }
            underWay.add(new Parcel(to, frame));
            carrier.execute(HostsPipe.this::carryAll);
        }

        private boolean hasSubscribed(String topic) {
            synchronized (topics) {
                return topics.contains(topic);
            }
        }

        @Override
        public void subscribe(String topic) {
            synchronized (topics) {
                topics.add(topic);
            }
        }

        @Override
        public void unsubscribe(String topic) {
            synchronized (topics) {
                topics.remove(topic);
            }
        }

        @Override
        public void close() {
            nodes.remove(mine, this);
            cut.remove(mine, this);
        }
    }
}
