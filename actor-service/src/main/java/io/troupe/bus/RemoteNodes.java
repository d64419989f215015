package io.troupe.bus;

import io.troupe.actor.internal.loop.Home;
import io.troupe.bus.BusMessage.Failure;
import io.troupe.bus.BusMessage.Purpose;
import io.troupe.bus.internal.BoundedText;
import io.troupe.bus.internal.RecordCodec;
import io.troupe.bus.internal.UnreadableException;
import java.time.Duration;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * The way between one node and the others: encodes what it sends, decodes what it receives by the types that are known
 * here, and notices what was lost.
 *
 * <p><b>Threads.</b> Any thread.
 */
final class RemoteNodes implements BusEngine.Listener {
    private static final int REMEMBERED_NOTICES = 1_024;
    private static final Duration QUIET = Duration.ofSeconds(1);
    private static final int MOST_MARKS = 5;
    private static final Record UNREAD = new Failure.NotDelivered("its value was not read");

    private final Bus bus;
    private final BusEngine engine;
    private final long incarnation;
    private final RecordCodec codec = new RecordCodec();
    private final Frames frames;
    private final RemotePublishers publishers = new RemotePublishers();
    private final FirstContacts contacts;
    private final Map<String, Long> subscribedNanos = new ConcurrentHashMap<>(); // by topic
    private final Map<SeriesKey, Series> published = new ConcurrentHashMap<>();
    private final AtomicBoolean marking = new AtomicBoolean(); // a round of marks is scheduled
    private final Map<Long, BusMessage> notices = new LinkedHashMap<>() { // guarded by itself
                private static final long serialVersionUID = 1;

                @Override
                protected boolean removeEldestEntry(Map.Entry<Long, BusMessage> eldest) {
                    return size() > REMEMBERED_NOTICES;
                }
            };

    /** A port of this node and a topic on which it has published. */
    private record SeriesKey(Address port, String topic) {}

    /** Numbers the values of one port on one topic, so that other nodes notice a gap. Guarded by itself. */
    private static final class Series {
        long last;
        long begunNanos;
        long publishedAtNanos;
        int youngMarks; // sent since the first value
        int quietMarks; // sent since the last value

        void published(long beforeNanos, long nowNanos) {
            if (last++ == 0) {
                begunNanos = beforeNanos;
            }
            publishedAtNanos = nowNanos;
            quietMarks = 0;
        }

        synchronized boolean isUnmarked() {
            return last > 0 && (youngMarks < MOST_MARKS || quietMarks < MOST_MARKS);
        }

        /** Its first values may be lost: a subscriber learns from a mark when they were published. */
        boolean isYoung(long nowNanos) {
            return isDue(youngMarks, begunNanos, nowNanos);
        }

        boolean isQuiet(long nowNanos) {
            return isDue(quietMarks, publishedAtNanos, nowNanos);
        }

        /** 1, 3, 7, 15 and 31 seconds after it: a subscriber may be frozen or cut off for a while. */
        private static boolean isDue(int marks, long sinceNanos, long nowNanos) {
            return marks < MOST_MARKS && nowNanos - sinceNanos >= QUIET.toNanos() * ((2L << marks) - 1);
        }
    }

    RemoteNodes(Bus bus, BusEngine engine, long incarnation) {
        this.bus = bus;
        this.engine = engine;
        this.incarnation = incarnation;
        this.frames = new Frames(codec, bus.settings.space().clock(), incarnation);
        this.contacts = new FirstContacts(bus, publishers, this::askTime);
    }

    void start() {
        engine.start(bus.node(), incarnation, this);
    }

    void close() {
        engine.close();
    }

    void subscribe(String topic) {
        subscribedNanos.put(topic, bus.nanos());
        engine.subscribe(topic);
    }

    void unsubscribe(String topic) {
        engine.unsubscribe(topic);
        publishers.forget(topic);
        subscribedNanos.remove(topic);
    }

    // ---- sending

    /** @param ageNanos how old the value is already */
    void publish(BusMessage message, String topic, long ageNanos) {
        Series series = published.computeIfAbsent(new SeriesKey(message.from(), topic), key -> new Series());
        synchronized (series) { // frames leave in the order of their numbers
            long beforeNanos = bus.nanos();
            byte[] bytes = frames.publication(message, topic, series.last + 1, ageNanos / 1_000);
            checked(bytes, frame -> engine.publish(topic, frame));
            series.published(beforeNanos, bus.nanos());
        }
        if (marking.compareAndSet(false, true)) {
            markLater();
        }
    }

    /** A port publishes on a topic no more. */
    void endSeries(Address port, String topic) {
        var key = new SeriesKey(port, topic);
        Series series = published.remove(key);
        if (series != null) {
            mark(key, series, true);
        }
    }

    /**
     * Reports on each topic that is new, or has been quiet for a second, since when and how many values were published,
     * so that the loss of the first and of the last ones is noticed as well.
     */
    private void markLater() {
        bus.settings.space().delay(QUIET).then((nothing, closed) -> {
            if (closed != null || bus.isClosed()) {
                return;
            }
            marking.set(false); // before the round: a value that it does not see begins another one
            published.forEach((key, series) -> mark(key, series, false));
            if (published.values().stream().anyMatch(Series::isUnmarked) && marking.compareAndSet(false, true)) {
                markLater();
            }
        });
    }

    private void mark(SeriesKey key, Series series, boolean atEnd) {
        synchronized (series) {
            long nowNanos = bus.nanos();
            boolean isQuiet = atEnd ? series.quietMarks == 0 : series.isQuiet(nowNanos);
            boolean isYoung = series.isYoung(nowNanos);
            if (series.last == 0 || !isQuiet && !isYoung) {
                return;
            }
            try {
                byte[] frame = frames.mark(key.port, key.topic, series.last, series.begunNanos);
                checked(frame, bytes -> engine.publish(key.topic, bytes));
                series.quietMarks += isQuiet ? 1 : 0;
                series.youngMarks += isYoung ? 1 : 0;
            } catch (RuntimeException disconnected) {
                return; // the next round tries again
            }
        }
    }

    void request(BusMessage message, Purpose.Request request, @Nullable Duration limit, boolean isShared) {
        long limitMicros = limit == null ? 0 : Math.max(1, Home.nanosOf(limit) / 1_000);
        byte[] frame = frames.request(message, request, limitMicros, isShared);
        checked(frame, bytes -> engine.send(request.to().node(), message.sequence(), bytes));
    }

    void notice(BusMessage message, Purpose.Notice notice) {
        synchronized (notices) {
            notices.put(message.sequence(), message);
        }
        byte[] frame = frames.notice(message, notice);
        checked(frame, bytes -> engine.send(notice.to().node(), message.sequence(), bytes));
    }

    void reply(BusMessage message, Purpose.Reply reply, long toIncarnation) {
        byte[] frame = frames.reply(message, reply, toIncarnation);
        checked(frame, bytes -> engine.reply(reply.to().node(), toIncarnation, reply.request(), bytes));
    }

    void reject(BusMessage message, Purpose.Rejection rejection, long toIncarnation) {
        byte[] frame = frames.rejection(message, rejection, toIncarnation);
        checked(frame, bytes -> engine.reply(rejection.to().node(), toIncarnation, rejection.request(), bytes));
    }

    /** Without effect if it is lost: the request has a limit there. */
    void cancel(BusMessage message, Purpose.Request request) {
        if (engine.whyDisconnected() == null) {
            engine.send(request.to().node(), message.sequence(), frames.cancellation(message, request));
        }
    }

    private interface Sending {
        void send(byte[] frame);
    }

    private void checked(byte[] frame, Sending sending) {
        String why = engine.whyDisconnected();
        if (why != null) {
            throw new IllegalStateException(why);
        }
        if (frame.length > engine.maxFrameBytes()) {
            throw new IllegalArgumentException(
                    "it has " + frame.length + " bytes, expected at most " + engine.maxFrameBytes());
        }
        sending.send(frame);
    }

    /** Sends a request to a node that only measures how long its reply takes. */
    private void askTime(String node, long number) {
        var request = new Purpose.Request(new Address(node, FirstContacts.PORT), FirstContacts.OPERATION);
        var from = new Address(bus.node(), FirstContacts.PORT);
        var message = BusMessage.of(Operation.Kind.CONTROL, from, request, number, FirstContacts.NOTHING);
        checked(frames.request(message, request, 0, false), bytes -> engine.send(node, number, bytes));
    }

    private void answerTime(Frames.Header header, Purpose.Request request) {
        var reply = new Purpose.Reply(header.from(), request.operation(), header.number());
        var message =
                BusMessage.of(Operation.Kind.CONTROL, request.to(), reply, bus.nextNumber(), FirstContacts.NOTHING);
        try {
            reply(message, reply, header.incarnation());
        } catch (RuntimeException disconnected) {
            return; // it asks again
        }
    }

    // ---- receiving

    @Override
    public void frame(byte[] bytes) {
        Frames.Frame frame;
        try {
            frame = Frames.read(bytes, bus.node());
        } catch (RuntimeException unreadable) {
            bus.notifier.unreadable("a frame of " + bytes.length + " bytes", unreadable);
            return;
        }
        var header = frame.header();
        if (header.from().node().equals(bus.node())) {
            if (header.incarnation() != incarnation) {
                bus.notifier.unreadable(
                        "a message from " + header.from(),
                        new IllegalStateException("another process has the name of this node, " + bus.node()));
            }
            return;
        }
        long nowNanos = bus.nanos();
        publishers.ageNanos(header, nowNanos);
        switch (frame.body()) {
            case Frames.Body.Requested requested
            when FirstContacts.isTime(requested.purpose()) -> answerTime(header, requested.purpose());
            case Frames.Body.Replied(var reply, var kind, long toIncarnation)
            when toIncarnation == incarnation && contacts.answered(header, reply.request()) -> {}
            case Frames.Body.Rejected(var rejection, var kind, long toIncarnation)
            when toIncarnation == incarnation && contacts.answered(header, rejection.request()) -> {}
            default -> {
                if (!contacts.hold(frame, () -> handle(frame, nowNanos))) {
                    handle(frame, nowNanos);
                }
            }
        }
    }

    /** @param nowNanos when it arrived */
    private void handle(Frames.Frame frame, long nowNanos) {
        var header = frame.header();
        long ageNanos = publishers.ageNanos(header, nowNanos);
        switch (frame.body()) {
            case Frames.Body.Published(var publication, long series, long ageMicros) -> {
                noteMissing(
                        header,
                        publication.topic(),
                        publishers.missing(header, publication.topic(), series, subscribedNanos(publication)));
                long valueNanos = ageNanos + ageMicros * 1_000;
                receivePublication(frame, publication, new Arrival(header.incarnation(), nowNanos, valueNanos));
            }
            case Frames.Body.Mark(var publication, long series, var begunMicros) ->
                noteMissing(
                        header,
                        publication.topic(),
                        publishers.missingAtMark(
                                header, publication.topic(), series, begunMicros, subscribedNanos(publication)));
            case Frames.Body.Requested requested ->
                receiveRequest(frame, requested, new Arrival(header.incarnation(), nowNanos, ageNanos));
            case Frames.Body.Noticed(var notice, var kind) ->
                receiveNotice(frame, notice, new Arrival(header.incarnation(), nowNanos, ageNanos));
            case Frames.Body.Cancelled(var request) ->
                bus.cancel(
                        request, new MessageDelivery.RequestId(header.from(), header.incarnation(), header.number()));
            case Frames.Body.Replied(var reply, var kind, long toIncarnation) ->
                receiveReply(frame, reply.request(), toIncarnation, () -> bus.replyType(reply.request()));
            case Frames.Body.Rejected(var rejection, var kind, long toIncarnation) ->
                receiveReply(frame, rejection.request(), toIncarnation, () -> Failure.class);
        }
    }

    /** The life of the sender, and when and how late a frame came. */
    private record Arrival(long incarnation, long nanos, long ageNanos) {
        MessageDelivery of(BusMessage message, long limitNanos) {
            return new MessageDelivery(message, incarnation, nanos, ageNanos, limitNanos);
        }
    }

    private long subscribedNanos(Purpose.Publication publication) {
        return subscribedNanos.getOrDefault(publication.topic(), Long.MAX_VALUE);
    }

    private void noteMissing(Frames.Header header, String topic, long missing) {
        if (missing > 0) {
            bus.counters.missed.add(missing);
            bus.notifier.lost(new Loss.Missed(header.from(), topic, missing));
        }
    }

    private void receivePublication(Frames.Frame frame, Purpose.Publication publication, Arrival arrival) {
        Class<?> type = bus.subscribedType(publication.topic());
        if (type == null) {
            return; // the last subscriber has just left
        }
        try {
            bus.receive(arrival.of(frame.message(codec, type), Long.MAX_VALUE));
        } catch (UnreadableException unreadable) {
            bus.notifier.unreadable(publication + " from " + frame.header().from(), unreadable);
        }
    }

    private void receiveRequest(Frames.Frame frame, Frames.Body.Requested requested, Arrival arrival) {
        Purpose.Request request = requested.purpose();
        long limitNanos =
                requested.limitMicros() == 0 ? Long.MAX_VALUE : requested.limitMicros() * 1_000 - arrival.ageNanos;
        Class<?> type = bus.requestType(request.to(), request.operation());
        BusMessage message;
        try {
            message = type == null ? frame.message(UNREAD) : frame.message(codec, type);
        } catch (UnreadableException unreadable) {
            bus.reject(
                    request.to(),
                    arrival.of(frame.message(UNREAD), limitNanos),
                    "cannot read it: " + unreadable.getMessage());
            return;
        } catch (Error machine) { // memory or stack: the requester still gets to know
            bus.reject(
                    request.to(),
                    arrival.of(frame.message(UNREAD), limitNanos),
                    "cannot read it: " + BoundedText.of(machine));
            throw machine;
        }
        MessageDelivery delivery = arrival.of(message, limitNanos);
        bus.receive(requested.isShared() ? delivery.withSharedLimit() : delivery);
    }

    private void receiveNotice(Frames.Frame frame, Purpose.Notice notice, Arrival arrival) {
        Class<?> type = bus.requestType(notice.to(), notice.operation());
        try {
            BusMessage message = type == null ? frame.message(UNREAD) : frame.message(codec, type);
            bus.receive(arrival.of(message, Long.MAX_VALUE));
        } catch (UnreadableException unreadable) {
            bus.notifier.unreadable(notice + " from " + frame.header().from(), unreadable);
        }
    }

    private void receiveReply(
            Frames.Frame frame, long request, long toIncarnation, Supplier<@Nullable Class<?>> expected) {
        if (toIncarnation != incarnation) {
            bus.notifier.late(frame.message(UNREAD), "it is for an earlier life of this node");
            return;
        }
        Class<?> type = expected.get();
        try {
            BusMessage message = type == null ? frame.message(UNREAD) : frame.message(codec, type);
            bus.receive(MessageDelivery.within(message, frame.header().incarnation(), MessageDelivery.NOT_NOTED));
        } catch (UnreadableException unreadable) {
            bus.notifier.unreadable("the reply from " + frame.header().from(), unreadable);
            bus.rejectRequest(request, "the answer cannot be read: " + unreadable.getMessage());
        } catch (Error machine) {
            bus.rejectRequest(request, "the answer cannot be read: " + BoundedText.of(machine));
            throw machine;
        }
    }

    @Override
    public void unreachable(String node, long number, String why) {
        if (contacts.isAsked(number)) {
            return; // it is asked again
        }
        BusMessage notice;
        synchronized (notices) {
            notice = notices.remove(number);
        }
        if (notice != null) {
            bus.notifier.undeliverable(notice, why);
        } else {
            bus.rejectUnreachable(number, why);
        }
    }

    @Override
    public void rejected(String node, String why) {
        List<BusMessage> rejected;
        synchronized (notices) {
            rejected = notices.values().stream()
                    .filter(notice -> isTo(node, notice))
                    .toList();
            rejected.forEach(notice -> notices.remove(notice.sequence()));
        }
        rejected.forEach(notice -> bus.notifier.undeliverable(notice, why));
        bus.rejectUnreachable(node, why);
    }

    private static boolean isTo(String node, BusMessage message) {
        return message.purpose() instanceof Purpose.Notice notice
                && notice.to().node().equals(node);
    }

    @Override
    public void gone(String node, long goneIncarnation) {
        bus.forgetRequestsOf(node, goneIncarnation);
    }

    @Override
    public void lost(long messages, String why) {
        bus.notifier.lost(new Loss.LostOnTheWay(messages, why));
    }

    @Override
    public void disconnected(String why) {
        bus.setConnected(false);
        bus.notifier.disconnected(why);
    }

    @Override
    public void connected() {
        bus.setConnected(true);
        bus.notifier.connected();
    }
}
