package io.troupe.actor.soak;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSettings.Overflow;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import java.lang.management.ManagementFactory;
import java.lang.management.MemoryMXBean;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.List;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.TimeoutException;
import java.util.function.Consumer;
import java.util.stream.IntStream;

/**
 * Producers that send to an actor, and through a forwarding actor to an actor in a second space.
 *
 * <p>With unbounded mailboxes the producers are slowed down by the results of their requests ({@link Producer}), for
 * both actors. With a bounded mailbox its capacity slows them down. Only the receiver in the second space still needs
 * the requests, because the forwarding actor must not block.
 */
final class Soak {
    private static final Duration PATIENCE = Duration.ofSeconds(60);
    private static final long SAMPLE_MILLIS = 250;

    private final SoakOptions options;
    private final Consumer<String> out;
    private final Queue<String> faults = new ConcurrentLinkedQueue<>();

    Soak(SoakOptions options, Consumer<String> out) {
        this.options = options;
        this.out = out;
    }

    /**
     * Runs both mailboxes, each with half of the messages.
     *
     * @return the problems found; empty if there are none
     */
    List<String> run() throws InterruptedException {
        // created before both runs, so that neither counts what it retains as part of its beginning
        var heap = new HeapWatch(options.heapBoundMib());
        run("unbounded", ActorSettings.defaults(), false, heap);
        run("bounded", ActorSettings.defaults().withMailbox(options.capacity(), Overflow.BLOCK), true, heap);
        if (heap.isExceeded()) {
            faults.add(heap.toString());
        }
        return List.copyOf(faults);
    }

    private SpaceSettings settings(String name) {
        return SpaceSettings.named(name)
                .withOnError((where, error) -> faults.add(where + " threw " + error))
                .withOnDeadLetter(letter -> faults.add("dead letter: " + letter));
    }

    private void run(String mailbox, ActorSettings actor, boolean bounded, HeapWatch heap) throws InterruptedException {
        try (var first = ActorSpace.create(settings("first"));
                var second = ActorSpace.create(settings("second"))) {
            Sink receiver = first.spawn(Sink.class, () -> new Receiver("direct", options.producers()), actor);
            Sink far = second.spawn(Sink.class, () -> new Receiver("forwarded", options.producers()));
            Sink forwarder = first.spawn(Sink.class, () -> new Forwarder(far), actor);
            var sinks = List.of(receiver, forwarder);
            var paced = bounded ? List.of(forwarder) : sinks;
            long perSink = options.messages() / 2 / options.producers() / sinks.size();
            watch(mailbox, start(perSink, sinks, paced), sinks, perSink * options.producers() * sinks.size(), heap);
        }
    }

    private List<Thread> start(long perSink, List<Sink> sinks, List<Sink> paced) {
        return IntStream.range(0, options.producers())
                .mapToObj(number -> new Producer(number, perSink, options.window(), sinks, paced, faults::add))
                .map(producer -> Thread.ofPlatform().daemon().start(producer))
                .toList();
    }

    private void watch(String mailbox, List<Thread> producers, List<Sink> sinks, long expected, HeapWatch heap)
            throws InterruptedException {
        long begin = System.nanoTime();
        try {
            for (Thread producer : producers) {
                while (!producer.join(Duration.ofMillis(SAMPLE_MILLIS))) {
                    progress(mailbox, takenInAll(sinks), expected, heap, begin);
                }
            }
            long taken = takenInAll(sinks);
            progress(mailbox, taken, expected, heap, begin);
            if (taken != expected) {
                faults.add("%s: %,d messages arrived, of %,d sent".formatted(mailbox, taken, expected));
            }
            for (Sink sink : sinks) {
                faults.addAll(sink.faults().get(PATIENCE));
            }
        } catch (TimeoutException late) {
            faults.add(mailbox + ": " + late.getMessage());
        }
        out.accept("%-9s done, %s".formatted(mailbox, heap));
    }

    private static long takenInAll(List<Sink> sinks) throws TimeoutException, InterruptedException {
        var asked = new ArrayList<Long>();
        for (Sink sink : sinks) {
            asked.add(sink.takenInAll().get(PATIENCE));
        }
        return asked.stream().mapToLong(Long::longValue).sum();
    }

    private void progress(String mailbox, long taken, long expected, HeapWatch heap, long beginNanos) {
        double seconds = (System.nanoTime() - beginNanos) / 1e9;
        out.accept("%-9s %,11d of %,d messages, %5.1f s, %.2f million/s, heap %.1f MiB"
                .formatted(mailbox, taken, expected, seconds, taken / seconds / 1e6, heap.sampleMib()));
    }

    /** Forwards every message to an actor in another space. */
    private static final class Forwarder implements Sink {
        private final Sink target;

        Forwarder(Sink target) {
            this.target = target;
        }

        @Override
        public void take(int producer, long number) {
            target.take(producer, number);
        }

        @Override
        public Promise<Long> taken(int producer) {
            return target.taken(producer);
        }

        @Override
        public Promise<Long> takenInAll() {
            return target.takenInAll();
        }

        @Override
        public Promise<List<String>> faults() {
            return target.faults();
        }
    }

    /**
     * A thread that sends numbered messages to every sink in turn.
     *
     * <p><b>Order.</b> After each window of messages it requests from a sink the number that has arrived. The result
     * must be exactly the number sent, because the request was queued behind the messages. The producer waits for the
     * result of the previous request first, so at most two windows of its messages are queued.
     */
    private static final class Producer implements Runnable {
        private static final Duration PATIENCE = Duration.ofSeconds(60);
        private static final int REQUESTS_OPEN = 1;

        private record OpenRequest(Sink sink, long sent, Promise<Long> taken) {}

        private final int number;
        private final long messagesPerSink;
        private final int window;
        private final List<Sink> sinks;
        private final List<Sink> paced;
        private final Consumer<String> fault;
        private final ArrayDeque<OpenRequest> open = new ArrayDeque<>();

        /**
         * Creates a producer.
         *
         * @param paced those sinks that have no other means of slowing it down
         */
        Producer(
                int number,
                long messagesPerSink,
                int window,
                List<Sink> sinks,
                List<Sink> paced,
                Consumer<String> fault) {
            this.number = number;
            this.messagesPerSink = messagesPerSink;
            this.window = window;
            this.sinks = sinks;
            this.paced = paced;
            this.fault = fault;
        }

        @Override
        public void run() {
            try {
                for (long message = 0; message < messagesPerSink; message++) {
                    for (Sink sink : sinks) {
                        sink.take(number, message);
                    }
                    if ((message + 1) % window == 0) {
                        ask(paced, message + 1);
                        check(REQUESTS_OPEN * paced.size());
                    }
                }
                ask(sinks, messagesPerSink);
                check(0);
            } catch (TimeoutException late) {
                fault.accept("producer " + number + ": " + late.getMessage());
            } catch (InterruptedException stopped) {
                fault.accept("producer " + number + " was interrupted");
            } catch (RuntimeException refused) {
                fault.accept("producer " + number + ": " + refused);
            }
        }

        private void ask(List<Sink> asked, long sent) {
            asked.forEach(sink -> open.add(new OpenRequest(sink, sent, sink.taken(number))));
        }

        private void check(int mayStayOpen) throws TimeoutException, InterruptedException {
            while (open.size() > mayStayOpen) {
                OpenRequest request = open.remove();
                long taken = request.taken.get(PATIENCE);
                if (taken != request.sent) {
                    fault.accept("producer %d had sent %,d messages to %s, and %,d had arrived"
                            .formatted(number, request.sent, request.sink, taken));
                }
            }
        }
    }

    /** Checks that every producer's numbers are consecutive. */
    static final class Receiver implements Sink {
        private static final int FAULTS_KEPT = 10;

        private final String name;
        private final long[] taken;
        private final List<String> faults = new ArrayList<>();
        private long takenInAll;

        Receiver(String name, int producers) {
            this.name = name;
            this.taken = new long[producers];
        }

        @Override
        public void take(int producer, long number) {
            long expected = taken[producer];
            if (number != expected && faults.size() < FAULTS_KEPT) {
                faults.add("%s: message %,d of producer %d came where %,d was expected"
                        .formatted(name, number, producer, expected));
            }
            taken[producer] = number + 1;
            takenInAll++;
        }

        @Override
        public Promise<Long> taken(int producer) {
            return Promise.of(taken[producer]);
        }

        @Override
        public Promise<Long> takenInAll() {
            return Promise.of(takenInAll);
        }

        @Override
        public Promise<List<String>> faults() {
            return Promise.of(List.copyOf(faults));
        }
    }

    /** Compares the heap in use after a garbage collection with that at the beginning. */
    static final class HeapWatch {
        private static final double MIB = 1024 * 1024;

        private final MemoryMXBean memory = ManagementFactory.getMemoryMXBean();
        private final double boundMib;
        private final double firstMib;
        private double highestMib;

        /**
         * Creates a watch.
         *
         * @param boundMib the allowed increase since the beginning
         */
        HeapWatch(double boundMib) {
            this.boundMib = boundMib;
            this.firstMib = usedMib();
            this.highestMib = firstMib;
        }

        /** Collects garbage and returns the increase. */
        double sampleMib() {
            double now = usedMib();
            highestMib = Math.max(highestMib, now);
            return now;
        }

        boolean isExceeded() {
            return highestMib > firstMib + boundMib;
        }

        private double usedMib() {
            memory.gc();
            return memory.getHeapMemoryUsage().getUsed() / MIB;
        }

        @Override
        public String toString() {
            return "heap after collection %.1f MiB at first, %.1f MiB at most, allowed %.1f MiB"
                    .formatted(firstMib, highestMib, firstMib + boundMib);
        }
    }

    /** Receives numbered messages. Each producer has separate numbers, from 0. */
    interface Sink {
        void take(int producer, long number);

        /** The number of messages of a producer that have arrived. */
        Promise<Long> taken(int producer);

        /** The number of messages that have arrived from all producers. */
        Promise<Long> takenInAll();

        /** Descriptions of the first few messages that were lost, duplicated or out of order. */
        Promise<List<String>> faults();
    }
}
