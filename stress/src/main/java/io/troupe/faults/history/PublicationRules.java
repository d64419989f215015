package io.troupe.faults.history;

import io.troupe.faults.history.Event.Closed;
import io.troupe.faults.history.Event.Delivered;
import io.troupe.faults.history.Event.FirstArrival;
import io.troupe.faults.history.Event.Lost;
import io.troupe.faults.history.Event.Opened;
import io.troupe.faults.history.Event.Published;
import io.troupe.faults.history.Event.Unsent;
import io.troupe.faults.history.History.Entry;
import io.troupe.faults.history.Violation.Rule;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * Publications: for each topic, publisher and subscriber, from the first value that concerns the subscriber to the last
 * one, the values that were sent are those that were delivered and those that were reported.
 *
 * <p>The first value is number 1 if it was published after the subscriber was opened. Else it is at latest the first
 * one that has arrived, and at the earliest the first one that was published after the subscriber began. Of a publisher
 * or a subscriber that was killed, the last value is the last one that was delivered: what was on its way is gone with
 * the process that would have counted it. So may be the mark that shows when the series began: then the first value is
 * number 1 only if the publisher's process began after the subscriber was opened.
 */
final class PublicationRules {
    /** Topics whose values must not be delivered late begin with this. */
    public static final String FRESH = "fresh";

    /** The limit of the topic, and the error of an age that is measured without a common clock. */
    private static final long MOST_AGE_MICROS = 300_000 + 100_000;

    /** Of a subscriber that was killed. */
    private static final int MOST_UNREPORTED = 2;

    private record Series(String publisher, String topic) {}

    private record Flow(Series series, String subscriber) {}

    private static final class Sending {
        long last;
        final TreeMap<Long, Long> numbersByNanos = new TreeMap<>();
        final TreeSet<Long> unsent = new TreeSet<>();
        final List<Entry> evidence = new ArrayList<>();

        /** The values to a subscriber in the same process: no connection is needed. */
        Sending toItself() {
            var all = new Sending();
            all.last = last;
            all.numbersByNanos.putAll(numbersByNanos);
            return all;
        }

        @Nullable
        Long begunNanos() {
            return numbersByNanos.isEmpty() ? null : numbersByNanos.firstKey();
        }

        /** How many values with these numbers were sent. */
        long sent(long first, long to) {
            return Math.max(0, to - first + 1)
                    - (to < first ? 0 : unsent.subSet(first, true, to, true).size());
        }
    }

    private static final class Receiving {
        long first = Long.MAX_VALUE;
        long lastDelivered;
        long count;
        final List<Entry> evidence = new ArrayList<>();
    }

    private final Map<Series, Sending> sendings = new HashMap<>();
    private final Map<Flow, Receiving> receivings = new LinkedHashMap<>();
    private final Map<String, Long> opened = new HashMap<>();
    private final Map<String, Long> begun = new HashMap<>();
    private final Map<String, Long> closed = new HashMap<>();
    private final History history;
    private final Pauses pauses;
    private final Consumer<Violation> violations;

    PublicationRules(History history, Pauses pauses, Consumer<Violation> violations) {
        this.history = history;
        this.pauses = pauses;
        this.violations = violations;
    }

    void check() {
        history.entries().forEach(this::note);
        receivings.forEach(this::check);
    }

    private void note(Entry entry) {
        begun.putIfAbsent(entry.process(), entry.nanos());
        switch (entry.event()) {
            case Opened(String node) -> opened.put(entry.process(), entry.nanos());
            case Closed last -> closed.put(entry.process(), entry.nanos());
            case Published(String topic, long last) -> {
                Sending sending = sending(entry.process(), topic);
                sending.numbersByNanos.put(entry.nanos(), sending.last + 1);
                sending.last = Math.max(sending.last, last);
            }
            case Unsent(String topic, long number) -> {
                Sending sending = sending(entry.process(), topic);
                sending.unsent.add(number);
                sending.evidence.add(entry);
            }
            case FirstArrival(String topic, String publisher, long number) -> {
                Receiving receiving = receiving(publisher, topic, entry);
                receiving.first = Math.min(receiving.first, number);
                receiving.evidence.add(entry);
            }
            case Delivered(String topic, String publisher, long last, long count, long ageMicros) -> {
                Receiving receiving = receiving(publisher, topic, entry);
                receiving.count += count;
                receiving.lastDelivered = Math.max(receiving.lastDelivered, last);
                // a publisher may be frozen after it has taken the time, and before it publishes
                long publishedNanos = pauses.runsAgainAt(publisher, entry.nanos() - ageMicros * 1_000);
                if (topic.startsWith(FRESH) && entry.nanos() - publishedNanos > MOST_AGE_MICROS * 1_000) {
                    violations.accept(new Violation(
                            Rule.FRESH,
                            "value " + last + " of " + publisher + " is " + ageMicros / 1_000 + " ms old",
                            List.of(entry)));
                }
            }
            case Lost(String topic, String publisher, Event.Reason reason, long count) -> {
                Receiving receiving = receiving(publisher, topic, entry);
                receiving.count += count;
                receiving.evidence.add(entry);
            }
            default -> {}
        }
    }

    private Sending sending(String publisher, String topic) {
        return sendings.computeIfAbsent(new Series(publisher, topic), series -> new Sending());
    }

    private Receiving receiving(String publisher, String topic, Entry entry) {
        return receivings.computeIfAbsent(
                new Flow(new Series(publisher, topic), entry.process()), flow -> new Receiving());
    }

    /** The first value that concerns the subscriber: a mark may have told it of values before the first arrival. */
    private long firstAfter(String subscriber, Sending sending) {
        var next = sending.numbersByNanos.ceilingEntry(begun.getOrDefault(subscriber, Long.MIN_VALUE));
        return next == null ? Long.MAX_VALUE : next.getValue();
    }

    private void check(Flow flow, Receiving received) {
        Sending sending = sendings.get(flow.series);
        if (sending == null) {
            return; // the process was killed before it wrote anything
        }
        String publisher = flow.series.publisher;
        boolean isComplete = closed.containsKey(publisher) && closed.containsKey(flow.subscriber);
        Long begin = isComplete ? sending.begunNanos() : begun.get(publisher);
        Long subscriberOpened = opened.get(flow.subscriber);
        if (begin != null && subscriberOpened != null && begin > subscriberOpened) {
            received.first = 1;
        }
        if (publisher.equals(flow.subscriber)) {
            sending = sending.toItself();
        }
        long least = sending.sent(received.first, isComplete ? sending.last : received.lastDelivered);
        long most = sending.sent(Math.min(received.first, firstAfter(flow.subscriber, sending)), sending.last);
        // each of its threads may have dropped one, and been killed before it reported that
        long unreported = closed.containsKey(flow.subscriber) ? 0 : MOST_UNREPORTED;
        if (received.count + unreported < least || received.count > most) {
            var evidence = new ArrayList<>(received.evidence);
            evidence.addAll(sending.evidence);
            violations.accept(new Violation(
                    Rule.COUNTED,
                    "%s on %s to %s: values %d to %d, %d of them sent, but %d delivered or reported%s"
                            .formatted(
                                    publisher,
                                    flow.series.topic,
                                    flow.subscriber,
                                    received.first,
                                    isComplete ? sending.last : received.lastDelivered,
                                    least,
                                    received.count,
                                    most == least ? "" : " (at most " + most + ")"),
                    evidence));
        }
    }
}
