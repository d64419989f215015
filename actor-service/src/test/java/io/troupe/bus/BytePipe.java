package io.troupe.bus;

import io.troupe.actor.ActorSpace;
import java.util.Map;
import java.util.Queue;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ConcurrentLinkedQueue;

/** A bus between nodes that exchange only bytes. Pending messages arrive by callbacks of a space. */
final class BytePipe {
    private record Parcel(String to, byte[] bytes) {}

    private final ActorSpace carrier;
    private final Map<String, Bus> nodes = new ConcurrentHashMap<>();
    private final Queue<Parcel> underWay = new ConcurrentLinkedQueue<>();
    private long carried;

    BytePipe(ActorSpace carrier) {
        this.carrier = carrier;
    }

    Bus open(String name, BusSettings settings) {
        nodes.put(name, new Bus(name, settings, new End(this, name)));
        return nodes.get(name);
    }

    /** The number of bytes sent between nodes. */
    long bytesCarried() {
        return carried;
    }

    /** Delivers all pending messages now. */
    void carryAll() {
        for (Parcel next = underWay.poll(); next != null; next = underWay.poll()) {
            carried += next.bytes().length;
            var node = nodes.get(next.to());
            if (node != null) {
                node.receive((BusMessage) RecordCodec.decode(next.bytes()));
            }
        }
    }

    /** The transport of one node. */
    private record End(BytePipe pipe, String mine) implements Bus.Transport {
        @Override
        public boolean reaches(String node) {
            return pipe.nodes.containsKey(node);
        }

        @Override
        public void send(String node, BusMessage message) {
            pipe.underWay.add(new Parcel(node, RecordCodec.encode((Record) message)));
            pipe.carrier.execute(pipe::carryAll);
        }

        @Override
        public void broadcast(BusMessage publication) {
            pipe.nodes.keySet().stream().filter(node -> !node.equals(mine)).forEach(node -> send(node, publication));
        }

        @Override
        public void close() {
            pipe.nodes.remove(mine);
        }
    }
}
