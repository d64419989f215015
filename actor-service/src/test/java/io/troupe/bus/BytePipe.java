package io.troupe.bus;

import io.troupe.actor.ActorSpace;
import java.util.Map;
import java.util.Queue;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.atomic.AtomicLong;

/** A bus between nodes that exchange only bytes. Pending messages arrive by callbacks of a space. */
final class BytePipe {
    private record Parcel(String to, byte[] bytes) {}

    private final ActorSpace carrier;
    private final Map<String, Bus> nodes = new ConcurrentHashMap<>();
    private final Queue<Parcel> underWay = new ConcurrentLinkedQueue<>();
    private final AtomicLong carried = new AtomicLong();

    BytePipe(ActorSpace carrier) {
        this.carrier = carrier;
    }

    Bus open(String name, BusSettings settings) {
        var node = new Bus(name, settings, new End(name));
        nodes.put(name, node);
        return node;
    }

    /** The number of bytes sent between nodes. */
    long bytesCarried() {
        return carried.get();
    }

    /** Delivers all pending messages now. */
    void carryAll() {
        for (Parcel next = underWay.poll(); next != null; next = underWay.poll()) {
            carried.addAndGet(next.bytes().length);
            var node = nodes.get(next.to());
            if (node != null) {
                node.receive((BusMessage) RecordCodec.decode(next.bytes()));
            }
        }
    }

    /** The transport of one node. */
    private final class End implements Bus.Transport {
        private final String mine;

        End(String mine) {
            this.mine = mine;
        }

        @Override
        public boolean reaches(String node) {
            return nodes.containsKey(node);
        }

        @Override
        public void send(String node, BusMessage message) {
            underWay.add(new Parcel(node, RecordCodec.encode((Record) message)));
            carrier.execute(BytePipe.this::carryAll);
        }

        @Override
        public void broadcast(BusMessage publication) {
            nodes.keySet().stream().filter(node -> !node.equals(mine)).forEach(node -> send(node, publication));
        }

        @Override
        public void close() {
            nodes.remove(mine);
        }
    }
}
