package io.troupe.faults.node;

import io.troupe.actor.ActorSpace;
import io.troupe.bus.Bus;
import io.troupe.bus.BusMessage;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusTopic;
import io.troupe.bus.Loss;
import io.troupe.faults.history.Event.Delivered;
import io.troupe.faults.history.Event.FirstArrival;
import io.troupe.faults.history.Event.Lost;
import io.troupe.faults.history.Event.Published;
import io.troupe.faults.history.Event.Reason;
import io.troupe.faults.history.Event.Unreadable;
import io.troupe.faults.history.Event.Unsent;
import io.troupe.faults.history.History;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import org.jspecify.annotations.Nullable;

/** Publishes on topics of all kinds, subscribes to them, and writes down what becomes of the values. */
final class Publications {
    /**
     * A value.
     *
     * @param sentNanos on the clock that all processes of the machine share
     */
    record Value(long number, long sentNanos, String text) {}

    private static final BusTopic<Value> BURSTS = new BusTopic<>("bursts", Value.class);
    private static final BusTopic<Value> LATEST = new BusTopic<>("latest", Value.class).withCapacity(1);
    private static final BusTopic<Value> FRESH =
            new BusTopic<>("fresh/all", Value.class).withMaxAge(Duration.ofMillis(300));
    private static final BusTopic<Value> COMMANDS =
            new BusTopic<>("fresh/latest", Value.class).withCapacity(1).withMaxAge(Duration.ofMillis(300));
    private static final BusTopic<Value> FLOOD = new BusTopic<>("flood", Value.class);
    private static final BusTopic<Value> BIG = new BusTopic<>("big", Value.class);
    private static final List<BusTopic<Value>> ALL = List.of(BURSTS, LATEST, FRESH, COMMANDS, FLOOD, BIG);

    private static final int BURST = 10;
    private static final Duration TICK = Duration.ofMillis(50);
    private static final int TICKS_BETWEEN_BURSTS = 50; // marks are sent after a second
    private static final int RUN = 200;
    private static final int SLOW_MILLIS = 20;

    private final History.Writer history;
    private final String process;
    private final Map<String, Long> numbers = new HashMap<>(); // guarded by itself
    private final Map<String, Arrivals> arrivals = new HashMap<>(); // guarded by itself
    private @Nullable BusPort port;
    private volatile long slowUntilNanos = System.nanoTime();
    private volatile boolean isQuiet;
    private int ticks;

    /** What has arrived from one publisher on one topic. */
    private static final class Arrivals {
        final Set<Long> undelivered = new HashSet<>();
        final ArrayDeque<Long> order = new ArrayDeque<>();
        long run; // delivered, but not yet written down
        long runLast;
        long runAgeMicros;
    }

    Publications(History.Writer history, String process) {
        this.history = history;
        this.process = process;
    }

    void subscribe(Bus bus, ActorSpace subscribers) {
        BusPort opened = bus.attach(process);
        port = opened;
        subscribers.execute(() ->
                ALL.forEach(topic -> opened.subscribe(topic, (value, from) -> delivered(topic, from.name(), value))));
    }

    // ---- publishing, on one space

    void tick(ActorSpace space) {
        if (isQuiet) {
            return;
        }
        int now = ticks++;
        publish(LATEST, "");
        if (now % 2 == 0) {
            publish(FRESH, "");
            publish(COMMANDS, "");
        }
        if (now % TICKS_BETWEEN_BURSTS < BURST) {
            publish(BURSTS, "");
        }
        space.delay(TICK).thenRun(() -> tick(space));
    }

    void flood(int count) {
        long last;
        synchronized (numbers) {
            last = numbers.merge(FLOOD.name(), (long) count, Long::sum);
        }
        history.add(new Published(FLOOD.name(), last)); // in advance: a process that is killed has sent fewer
        for (long number = last - count + 1; number <= last; number++) {
            port().publish(FLOOD, new Value(number, System.nanoTime(), ""));
        }
    }

    void publishTooMuch() {
        publish(BIG, "x".repeat(2 << 20));
        publish(BIG, "small");
    }

    private void publish(BusTopic<Value> topic, String text) {
        long number;
        synchronized (numbers) {
            number = numbers.merge(topic.name(), 1L, Long::sum);
        }
        history.add(new Published(topic.name(), number));
        port().publish(topic, new Value(number, System.nanoTime(), text));
    }

    void quiet() {
        isQuiet = true;
    }

    private BusPort port() {
        if (port == null) {
            throw new IllegalStateException("no port is attached");
        }
        return port;
    }

    // ---- subscribing, on another space

    void slow(long millis) {
        slowUntilNanos = System.nanoTime() + millis * 1_000_000;
    }

    private void delivered(BusTopic<Value> topic, String publisher, Value value) {
        long ageMicros = (System.nanoTime() - value.sentNanos) / 1_000;
        synchronized (arrivals) {
            Arrivals arrived = arrivals(topic.name(), publisher, value.number);
            replacedBefore(arrived, topic.name(), publisher, value.number);
            arrived.run++;
            arrived.runLast = value.number;
            arrived.runAgeMicros = ageMicros;
            if (topic != FLOOD || arrived.run == RUN) {
                writeRun(arrived, topic.name(), publisher);
            }
        }
        if (System.nanoTime() - slowUntilNanos < 0) {
            try {
                Thread.sleep(SLOW_MILLIS);
            } catch (InterruptedException interrupted) {
                Thread.currentThread().interrupt();
            }
        }
    }

    /** Writes down which values were replaced by a newer one, at most up to that number. */
    private void replacedBefore(Arrivals arrived, String topic, String publisher, long number) {
        long replaced = 0;
        while (!arrived.order.isEmpty() && arrived.order.peekFirst() <= number) {
            long arrivedNumber = arrived.order.removeFirst();
            if (arrived.undelivered.remove(arrivedNumber) && arrivedNumber < number) {
                replaced++;
            }
        }
        if (replaced > 0) {
            history.add(new Lost(topic, publisher, Reason.REPLACED, replaced));
        }
    }

    private void writeRun(Arrivals arrived, String topic, String publisher) {
        if (arrived.run > 0) {
            history.add(new Delivered(topic, publisher, arrived.runLast, arrived.run, arrived.runAgeMicros));
            arrived.run = 0;
        }
    }

    private Arrivals arrivals(String topic, String publisher, long number) {
        return arrivals.computeIfAbsent(topic + " " + publisher, key -> {
            history.add(new FirstArrival(topic, publisher, number));
            return new Arrivals();
        });
    }

    /** Writes down what is left. */
    void close() {
        synchronized (arrivals) {
            arrivals.forEach((key, arrived) -> {
                String[] names = key.split(" ");
                writeRun(arrived, names[0], names[1]);
                replacedBefore(arrived, names[0], names[1], Long.MAX_VALUE);
            });
        }
    }

    // ---- the observer of the bus, on any thread

    void passed(BusMessage message) {
        if (message.purpose() instanceof BusMessage.Purpose.Publication(String topic)
                && message.payload() instanceof Value value) {
            synchronized (arrivals) {
                Arrivals arrived = arrivals(topic, message.from().name(), value.number);
                if (isLatestOnly(topic)) {
                    arrived.order.add(value.number);
                    arrived.undelivered.add(value.number);
                }
            }
        }
    }

    private static boolean isLatestOnly(String topic) {
        return topic.equals(LATEST.name()) || topic.equals(COMMANDS.name());
    }

    void lost(Loss loss) {
        switch (loss) {
            case Loss.Missed(var publisher, String topic, long count) -> {
                if (ALL.stream().anyMatch(each -> each.name().equals(topic))) {
                    history.add(new Lost(topic, publisher.name(), Reason.MISSED, count));
                }
            }
            case Loss.Dropped(var subscriber, BusMessage oldest, long soFar) -> notDelivered(oldest, Reason.DROPPED);
            case Loss.Stale(var subscriber, BusMessage message, Duration age) -> notDelivered(message, Reason.STALE);
            case Loss.Undeliverable(BusMessage message, String why) -> {
                if (message.purpose() instanceof BusMessage.Purpose.Publication(String topic)
                        && message.payload() instanceof Value value
                        && message.from().name().equals(process)) {
                    history.add(new Unsent(topic, value.number));
                }
            }
            case Loss.Unreadable(String what, String why) -> history.add(new Unreadable(what + ": " + why));
            default -> {} // of calls, which are checked by their settlement; or counted by MISSED as well
        }
    }

    private void notDelivered(BusMessage message, Reason reason) {
        if (message.purpose() instanceof BusMessage.Purpose.Publication(String topic)
                && message.payload() instanceof Value value) {
            String publisher = message.from().name();
            synchronized (arrivals) {
                arrivals(topic, publisher, value.number).undelivered.remove(value.number);
            }
            history.add(new Lost(topic, publisher, reason, 1));
        }
    }
}
