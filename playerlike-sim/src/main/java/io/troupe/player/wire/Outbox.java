package io.troupe.player.wire;

import java.io.ByteArrayOutputStream;
import java.util.ArrayDeque;
import java.util.Deque;
import java.util.HashSet;
import java.util.Iterator;
import java.util.List;
import java.util.Set;
import java.util.concurrent.locks.Condition;
import java.util.concurrent.locks.ReentrantLock;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * What a server has to tell one client: data, which wait in pull mode until they are asked for, and replies.
 *
 * <p><b>Threads.</b> Any thread; only {@link #take} and {@link #awaitRoom} wait.
 * <p><b>Order.</b> As it was put in, except that the reply to a request for data precedes the data.
 * <p><b>Cost.</b> At most {@value #MAX_DATA} data messages wait, and whoever reads the client's requests waits while {@value #MAX_REPLY_BYTES} bytes of replies do.
 */
final class Outbox {
    static final int MAX_DATA = 1024;
    static final int MAX_REPLY_BYTES = 64 * 1024;
    private static final int MAX_BATCH_BYTES = 64 * 1024;

    /** @param data null for everything that no rule speaks of */
    private record Entry(byte[] bytes, @Nullable Kind data) {}

    private record Kind(DeviceAddress from, int subtype) {}

    private final ReentrantLock lock = new ReentrantLock();
    private final Condition changed = lock.newCondition();
    private final Deque<Entry> sending = new ArrayDeque<>();
    private final Deque<Entry> held = new ArrayDeque<>();
    private final ReplaceRules rules = new ReplaceRules();
    private final Set<DeviceAddress> subscribed = new HashSet<>();
    private Delivery mode = Delivery.PUSH;
    private boolean asked;
    private boolean corked;
    private boolean closed;
    private int dataWaiting;
    private int replyBytes;
    private int dropped;
    private long newestTick = PlayerConnection.NO_TICK;
    private long sentTick = PlayerConnection.NO_TICK;
    private double timeSeconds;

    // ---- what the devices say

    /**
     * Puts a frame's messages in; returns whether it is answered at once, because the client waits and its rules leave nothing of the frame.
     *
     * @param messages of devices at the addresses that the client knows
     */
    boolean frame(long tick, double frameTimeSeconds, List<DataMessage> messages) {
        return under(() -> {
            newestTick = tick;
            timeSeconds = frameTimeSeconds;
            messages.stream().filter(each -> subscribed.contains(each.from())).forEach(this::add);
            if (mode == Delivery.PUSH || held.isEmpty()) {
                release();
                return asked && mode == Delivery.PULL;
            }
            if (asked) {
                endFrame();
            }
            return false;
        });
    }

    private void add(DataMessage message) {
        Content content = DataMessages.encode(message.data());
        var kind = new Kind(message.from(), content.subtype());
        int treatment = rules.treatment(kind.from(), MessageType.DATA, kind.subtype());
        if (treatment == ReplaceRule.IGNORE) {
            return;
        }
        if (treatment == ReplaceRule.REPLACE) {
            removeNewest(kind);
        }
        if (dataWaiting == MAX_DATA) {
            dropped++;
            return;
        }
        dataWaiting++;
        byte[] bytes = Message.of(
                        message.from(), MessageType.DATA, content.subtype(), message.timeSeconds(), content.payload())
                .bytes();
        held.add(new Entry(bytes, kind));
    }

    private void removeNewest(Kind kind) {
        Deque<Entry> waiting =
                mode == Delivery.PULL ? held : sending; // in pull mode, what has been released ends with its SYNCH
        for (Iterator<Entry> each = waiting.descendingIterator(); each.hasNext(); ) {
            if (kind.equals(each.next().data())) {
                each.remove();
                dataWaiting--;
                return;
            }
        }
    }

    private void release() {
        sending.addAll(held);
        held.clear();
        sentTick = newestTick;
    }

    private void endFrame() {
        release();
        asked = false;
        Content end = PlayerMessages.synch(dropped);
        dropped = 0;
        var nobody = new DeviceAddress(0, 0, PlayerRequest.INTERFACE, 0);
        put(Message.of(nobody, MessageType.SYNCH, end.subtype(), 0, end.payload()));
    }

    // ---- what the client's requests lead to

    /** The clock of the newest frame, for replies. */
    double timeSeconds() {
        return under(() -> timeSeconds);
    }

    /** Puts a reply in; what has been put in before goes out before it. */
    void reply(Message message) {
        under(() -> {
            release();
            put(message);
            return true;
        });
    }

    /** A request for data: returns the tick that the client answers by it, the newest of which it has seen all. */
    long ask(Message reply) {
        return under(() -> {
            long seen = sentTick;
            put(reply);
            if (mode == Delivery.PULL) {
                asked = true;
                if (!held.isEmpty()) {
                    endFrame();
                }
            }
            return seen;
        });
    }

    void mode(Delivery newMode) {
        under(() -> {
            mode = newMode;
            if (newMode == Delivery.PUSH) {
                asked = false;
                release();
            }
            return true;
        });
    }

    void add(ReplaceRule rule) {
        under(() -> {
            rules.add(rule);
            return true;
        });
    }

    /** Nothing goes out until {@link #uncork}, so that what happens meanwhile is done when the client hears of it. */
    void cork() {
        under(() -> corked = true);
    }

    void uncork() {
        under(() -> corked = false);
    }

    /** Lets the data of a device in; the client hears of it first. */
    void subscribed(DeviceAddress device, Message reply) {
        under(() -> {
            release();
            put(reply);
            return subscribed.add(device);
        });
    }

    boolean hasSubscribed() {
        return under(() -> !subscribed.isEmpty());
    }

    /** From now on nothing of that device is said. */
    void unsubscribed(DeviceAddress device, Message reply) {
        under(() -> {
            subscribed.remove(device);
            for (var waiting : List.of(held, sending)) {
                int before = waiting.size();
                waiting.removeIf(
                        each -> each.data() != null && each.data().from().equals(device));
                dataWaiting -= before - waiting.size();
            }
            release();
            put(reply);
            return true;
        });
    }

    private void put(Message message) {
        byte[] bytes = message.bytes();
        replyBytes += bytes.length;
        sending.add(new Entry(bytes, null));
    }

    // ---- for the threads of a connection

    /** Raw bytes, before all messages. */
    void greet(byte[] banner) {
        under(() -> {
            replyBytes += banner.length;
            return sending.add(new Entry(banner, null));
        });
    }

    /** Waits until the client has taken most of its replies; false if the outbox is closed. */
    boolean awaitRoom() throws InterruptedException {
        lock.lockInterruptibly();
        try {
            while (!closed && replyBytes > MAX_REPLY_BYTES) {
                changed.await();
            }
            return !closed;
        } finally {
            lock.unlock();
        }
    }

    /** Waits for something to send and takes some of it; null if the outbox is closed. */
    byte @Nullable [] take() throws InterruptedException {
        lock.lockInterruptibly();
        try {
            while (!closed && (corked || sending.isEmpty())) {
                changed.await();
            }
            if (closed) {
                return null;
            }
            var batch = new ByteArrayOutputStream();
            while (!sending.isEmpty() && batch.size() < MAX_BATCH_BYTES) {
                Entry entry = sending.remove();
                batch.writeBytes(entry.bytes());
                if (entry.data() != null) {
                    dataWaiting--;
                } else {
                    replyBytes -= entry.bytes().length;
                }
            }
            changed.signalAll();
            return batch.toByteArray();
        } finally {
            lock.unlock();
        }
    }

    /** Data that were lost since the client was last told. */
    int dropped() {
        return under(() -> dropped);
    }

    void close() {
        under(() -> {
            sending.clear();
            held.clear();
            return closed = true;
        });
    }

    private <T> T under(Supplier<T> action) {
        lock.lock();
        try {
            T result = action.get();
            changed.signalAll();
            return result;
        } finally {
            lock.unlock();
        }
    }
}
