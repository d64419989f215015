package io.troupe.bench.bus;

import static io.troupe.bench.bus.SampleValues.Sonar;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.bus.Bus;
import io.troupe.bus.BusSettings;
import io.troupe.bus.BusTopic;
import io.troupe.tools.UsedHeap;
import java.lang.management.ManagementFactory;
import java.lang.management.ThreadMXBean;
import java.lang.ref.Reference;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.function.BiFunction;

/** Measures what an open node costs. */
final class BusMemory {
    static final int PORTS = 10;
    static final int TOPICS = 100;

    private static final int NODES = 20;
    private static final ThreadMXBean THREADS = ManagementFactory.getThreadMXBean();
    private static final Duration PAUSE = Duration.ofMillis(100);

    private BusMemory() {}

    /** The heap that it keeps, and its threads; both are means of several nodes. */
    record Cost(double heapBytes, double threads) {
        String line() {
            return heapBytes + " " + threads;
        }

        static Cost parse(String line) {
            String[] numbers = line.split(" ");
            return new Cost(Double.parseDouble(numbers[0]), Double.parseDouble(numbers[1]));
        }
    }

    /** What is added to a node after it was opened. */
    interface Addition {
        void to(Bus bus, ActorSpace space) throws Exception;
    }

    /** The cost of a node with {@value #PORTS} ports that publish and subscribe to {@value #TOPICS} topics. */
    static Cost ofNode(BiFunction<String, BusSettings, Bus> opening, Addition addition) throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("memory"))) {
            List<Bus> kept = new ArrayList<>();
            kept.add(use(opening.apply("first", BusSettings.on(space)), space, addition)); // loads classes
            long before = UsedHeap.bytes(PAUSE);
            int threadsBefore = THREADS.getThreadCount();
            for (int i = 0; i < NODES; i++) {
                kept.add(use(opening.apply("node" + i, BusSettings.on(space)), space, addition));
            }
            long after = UsedHeap.bytes(PAUSE);
            int threadsAfter = THREADS.getThreadCount();
            Reference.reachabilityFence(kept);
            kept.forEach(Bus::close);
            return new Cost((double) (after - before) / NODES, (double) (threadsAfter - threadsBefore) / NODES);
        }
    }

    /** Returns the node after each of its ports has published and received a value on each of its topics. */
    private static Bus use(Bus bus, ActorSpace space, Addition addition) throws Exception {
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
        addition.to(bus, space);
        return bus;
    }
}
