package io.troupe.bench.bus;

import io.troupe.bus.Bus;
import io.troupe.bus.BusEngine;
import io.troupe.bus.BusSettings;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.concurrent.ConcurrentHashMap;
import org.jspecify.annotations.Nullable;

/** Passes frames to the nodes of its group in the thread of the sender, and keeps one of each kind. */
final class LoopEngine implements BusEngine {
    /** Engines that reach each other. */
    static final class Group {
        private final Map<String, LoopEngine> nodes = new ConcurrentHashMap<>();
        private volatile byte[] request = {};
        private volatile byte[] reply = {};
        private volatile byte[] publication = {};

        /** Opens a node of the group. */
        Bus open(String node, BusSettings settings) {
            return Bus.open(node, new LoopEngine(this), settings);
        }
    }

    /** The frames of a request, of its reply, and of a publication. */
    record Sample(byte[] request, byte[] reply, byte[] publication) {
        /** What our bus sends for a text of that many bytes, and for a sonar record. */
        static Sample of(int payloadBytes) throws Exception {
            var group = new Group();
            try (var pair = new TroupePair(group::open)) {
                pair.askWhile(payloadBytes, () -> false);
                pair.publishAll();
            }
            return new Sample(group.request, group.reply, group.publication);
        }

        /** The bytes of the frame of an actor call with a text of that many bytes. */
        static int callBytes(int payloadBytes) throws Exception {
            var group = new Group();
            try (var pair = new ActorPair(group::open)) {
                pair.askWhile(payloadBytes, () -> false);
                return group.request.length;
            }
        }
    }

    private static final int MOST_BYTES = 1 << 20;

    private final Group group;
    private final List<String> topics = new ArrayList<>(); // guarded by itself
    private @Nullable Listener listener;
    private String name = "";

    private LoopEngine(Group group) {
        this.group = group;
    }

    @Override
    public void start(String node, long incarnation, Listener itsListener) {
        name = node;
        listener = itsListener;
        group.nodes.put(node, this);
    }

    @Override
    public @Nullable String whyDisconnected() {
        return null;
    }

    @Override
    public int maxFrameBytes() {
        return MOST_BYTES;
    }

    @Override
    public void send(String node, long number, byte[] frame) {
        group.request = frame;
        pass(node, frame);
    }

    @Override
    public void reply(String node, long incarnation, long number, byte[] frame) {
        group.reply = frame;
        pass(node, frame);
    }

    private void pass(String node, byte[] frame) {
        LoopEngine to = group.nodes.get(node);
        if (to != null) {
            Objects.requireNonNull(to.listener).frame(frame);
        }
    }

    @Override
    public void publish(String topic, byte[] frame) {
        for (LoopEngine each : group.nodes.values()) {
            if (each != this && each.subscribes(topic)) {
                if (frame.length > group.publication.length) { // not a mark, which has no value
                    group.publication = frame;
                }
                Objects.requireNonNull(each.listener).frame(frame);
            }
        }
    }

    private boolean subscribes(String topic) {
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
        group.nodes.remove(name);
    }
}
