package io.troupe.bench.bus;

import static io.troupe.bench.bus.SampleValues.Sonar;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.bus.Bus;
import io.troupe.bus.BusSettings;
import io.troupe.bus.BusTopic;
import io.troupe.common.measure.UsedHeap;
import java.lang.ref.Reference;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.function.BiFunction;

/** Measures the heap that an open node keeps. */
final class BusMemory {
    static final int PORTS = 10;
    static final int TOPICS = 100;

    private static final int NODES = 20;
    private static final Duration PAUSE = Duration.ofMillis(100);

    private BusMemory() {}

    /** The bytes of a node with {@value #PORTS} ports that publish and subscribe to {@value #TOPICS} topics. */
    static double bytesOfNode(BiFunction<String, BusSettings, Bus> opening) throws InterruptedException {
        try (var space = ActorSpace.create(SpaceSettings.named("memory"))) {
            List<Bus> kept = new ArrayList<>();
            kept.add(use(opening.apply("first", BusSettings.on(space)))); // loads classes
            long before = UsedHeap.bytes(PAUSE);
            for (int i = 0; i < NODES; i++) {
                kept.add(use(opening.apply("node" + i, BusSettings.on(space))));
            }
            long after = UsedHeap.bytes(PAUSE);
            Reference.reachabilityFence(kept);
            kept.forEach(Bus::close);
            return (double) (after - before) / NODES;
        }
    }

    /** Returns the node after each of its ports has published and received a value on each of its topics. */
    private static Bus use(Bus bus) throws InterruptedException {
        var values = new SampleValues(1);
        var received = new CountDownLatch(TOPICS);
        for (int i = 0; i < PORTS; i++) {
            var port = bus.attach("port" + i);
            for (int j = 0; j < TOPICS / PORTS; j++) {
                var topic = new BusTopic<>(bus.node() + "/sonar" + i + "/" + j, Sonar.class);
                port.subscribe(topic, (value, publisher) -> received.countDown());
                port.publish(topic, values.sonar());
            }
        }
        received.await();
        return bus;
    }
}
