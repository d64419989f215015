package io.troupe.player.wire;

import java.io.ByteArrayOutputStream;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Deque;
import java.util.HashSet;
import java.util.Iterator;
import java.util.List;
import java.util.Queue;
import java.util.Set;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.Semaphore;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.atomic.AtomicLong;
import java.util.concurrent.locks.ReentrantLock;
import java.util.function.BooleanSupplier;
import java.util.function.LongConsumer;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * The output queue of one client: data, which in pull mode are held until the client requests them, and replies.
 *
 * <p><b>Threads.</b> Any thread; only {@link #take} and {@link #awaitRoom} wait. {@link #frame} and {@link #close}
 * never wait for the lock, for which the threads of the connection compete. They put a frame into a separate queue, and
 * the thread that holds the lock, or the next one to get it, moves it from there.
 *
 * <p><b>Order.</b> First in, first out, except that the reply to a request for data precedes the data.
 *
 * <p><b>Cost.</b> At most {@value #MAX_DATA} data messages are queued. The thread that reads the client's requests
 * blocks while {@value #MAX_REPLY_BYTES} bytes of replies are queued.
 */
final class Outbox {
    static final int MAX_DATA = 1024;
    static final int MAX_REPLY_BYTES = 64 * 1024;
    /** Bound of frames not yet moved into the queue because a thread held the lock all the time. */
    private static final int MAX_ARRIVED = 1024;

    private static final int MAX_BATCH_BYTES = 64 * 1024;

    /** @param data null for everything that replace rules do not apply to */
    private record Entry(byte[] bytes, @Nullable Kind data) {}

    private record Kind(DeviceAddress from, int subtype) {}

    private record Arrival(long tick, double timeSeconds, List<DeviceDataMessage> messages) {}

    private final Queue<Arrival> arrived = new ConcurrentLinkedQueue<>();
    private final AtomicInteger arrivedCount = new AtomicInteger();
    private final AtomicInteger dropped = new AtomicInteger();
    /**
     * For the thread that writes: there may be output. A release never waits, unlike the signal of a condition of the
     * lock.
     */
    private final Semaphore outputReady = new Semaphore(0);
    /** For the thread that reads: replies may have been taken. */
    private final Semaphore replySpace = new Semaphore(0);
    /** The newest tick that needs no answer, because nothing of its frame was left for a client that waits for data. */
    private final AtomicLong empty = new AtomicLong(PlayerConnection.NO_TICK);

    private volatile LongConsumer emptyFrames = tick -> {};
    private volatile BooleanSupplier lockStep = () -> false;
    private volatile boolean closed;
    private volatile int replyBytes; // written under the lock

    // guarded by the lock
    private final ReentrantLock lock = new ReentrantLock();
    private final Deque<Entry> sending = new ArrayDeque<>();
    private final Deque<Entry> held = new ArrayDeque<>();
    private final ReplaceRules rules = new ReplaceRules();
    private final Set<DeviceAddress> subscribed = new HashSet<>();
    private Delivery mode = Delivery.PUSH;
    private boolean dataRequested;
    private boolean corked;
    private int dataWaiting;
    private long newestTick = PlayerConnection.NO_TICK;
    private long endedTick = PlayerConnection.NO_TICK; // of which nothing is left to be sent
    private double timeSeconds;

    // ---- data from the devices

    /**
     * Adds the messages of a frame, without waiting.
     *
     * @param messages from devices at the addresses that the client knows
     */
    void frame(long tick, double frameTimeSeconds, List<DeviceDataMessage> messages) {
        if (arrivedCount.incrementAndGet() > MAX_ARRIVED) {
            arrivedCount.decrementAndGet();
            dropped.addAndGet(messages.size());
        } else {
            arrived.add(new Arrival(tick, frameTimeSeconds, messages));
        }
        tryTakeIn(); // applies the rules and bounds the data even while the writing thread is blocked
        wake(outputReady);
    }

    /**
     * Sets who is notified of the tick of a frame of which the rules left nothing, although the client waits for data:
     * as from a real server, such a client gets nothing, not even the end of a frame, so it cannot answer. Called by
     * any thread, without the lock.
     */
    void onEmptyFrame(LongConsumer listener) {
        emptyFrames = listener;
    }

    private void tryTakeIn() {
        if (lock.tryLock()) {
            try {
                takeIn();
            } finally {
                lock.unlock();
            }
            notifyOfEmptyFrame();
        }
    }

    private void notifyOfEmptyFrame() {
        if (empty.get() != PlayerConnection.NO_TICK) {
            long tick = empty.getAndSet(PlayerConnection.NO_TICK);
            if (tick != PlayerConnection.NO_TICK) {
                emptyFrames.accept(tick);
            }
        }
    }

    private void takeIn() {
        if (closed) {
            arrived.clear();
            sending.clear();
            held.clear();
            return;
        }
        for (Arrival each = arrived.poll(); each != null; each = arrived.poll()) {
            arrivedCount.decrementAndGet();
            takeIn(each);
        }
    }

    private void takeIn(Arrival frame) {
        newestTick = frame.tick();
        timeSeconds = frame.timeSeconds();
        for (var message : frame.messages()) {
            if (subscribed.contains(message.from())) {
                add(message);
            }
        }
        if (mode == Delivery.PULL && dataRequested) {
            if (held.isEmpty()) {
                endedTick = newestTick;
                empty.set(newestTick);
            } else {
                endFrame();
            }
        } else if (mode == Delivery.PUSH) {
            release();
        }
    }

    private void add(DeviceDataMessage message) {
        Content content = DataCodec.encode(message.data());
        var kind = new Kind(message.from(), content.subtype());
        int treatment = rules.treatment(kind.from(), MessageType.DATA, kind.subtype());
        if (treatment == ReplaceRule.IGNORE) {
            return;
        }
        if (treatment == ReplaceRule.REPLACE) {
            removeNewest(kind);
        }
        if (dataWaiting == MAX_DATA) {
            dropped.incrementAndGet();
            return;
        }
        dataWaiting++;
        byte[] bytes = WireMessage.of(
                        message.from(), MessageType.DATA, content.subtype(), message.timeSeconds(), content.payload())
                .bytes();
        held.add(new Entry(bytes, kind));
    }

    private void removeNewest(Kind kind) {
        Deque<Entry> waiting =
                mode == Delivery.PULL ? held : sending; // pull mode: released data are final, their SYNCH follows
        for (Iterator<Entry> each = waiting.descendingIterator(); each.hasNext(); ) {
            if (kind.equals(each.next().data())) {
                each.remove();
                dataWaiting--;
                return;
            }
        }
    }

    private void release() {
        if (!held.isEmpty()) {
            sending.addAll(held);
            held.clear();
            wake(outputReady);
        }
        if (mode == Delivery.PUSH) {
            endedTick = newestTick; // each message is a frame
        }
    }

    /**
     * Sends what is held, and the end of the frame. Only with data: libplayerc fails if the end of a frame follows its
     * request without data in between.
     */
    private void endFrame() {
        release();
        dataRequested = false;
        endedTick = newestTick;
        Content end = PlayerDeviceCodec.synch(dropped.getAndSet(0));
        var noDevice = new DeviceAddress(0, 0, PlayerRequest.INTERFACE, 0);
        put(WireMessage.of(noDevice, MessageType.SYNCH, end.subtype(), 0, end.payload()));
    }

    // ---- effects of the client's requests

    /** The time of the newest frame, for replies. */
    double timeSeconds() {
        return locked(() -> timeSeconds);
    }

    /** Sets whether the world waits for the client's answer to each frame. */
    void inLockStep(BooleanSupplier whether) {
        lockStep = whether;
    }

    /**
     * Before a reply the waiting data are sent, as from a real server. In lock step they wait for the client's request
     * for data: they are the frame that it answers, and many clients pass over data that they did not request.
     */
    private void release(boolean inLockStep) {
        if (mode == Delivery.PUSH || !inLockStep) {
            release();
        }
    }

    /** Adds a reply. */
    void reply(WireMessage message) {
        boolean inLockStep = lockStep.getAsBoolean(); // not under our lock
        locked(() -> {
            release(inLockStep);
            put(message);
            return true;
        });
    }

    /**
     * Handles a request for data. Returns the tick that the client answers with it: the newest of which it has got all
     * data, either up to the end of a frame or before a reply.
     */
    long ask(WireMessage reply) {
        return locked(() -> {
            if (held.isEmpty()) {
                endedTick = newestTick;
            }
            long answered = endedTick;
            put(reply);
            if (mode == Delivery.PULL) {
                dataRequested = true;
                if (!held.isEmpty()) {
                    endFrame();
                }
            }
            return answered;
        });
    }

    void mode(Delivery newMode) {
        locked(() -> {
            mode = newMode;
            if (newMode == Delivery.PUSH) {
                dataRequested = false;
                release();
            }
            return true;
        });
    }

    void add(ReplaceRule rule) {
        locked(() -> {
            rules.add(rule);
            return true;
        });
    }

    /**
     * Holds all output until {@link #uncork}, so that what happens in between is complete before the client is
     * notified.
     */
    void cork() {
        locked(() -> corked = true);
    }

    void uncork() {
        locked(() -> corked = false);
        wake(outputReady);
    }

    /** Adds a subscription; the reply precedes its first data. */
    void subscribed(DeviceAddress device, WireMessage reply) {
        boolean inLockStep = lockStep.getAsBoolean();
        locked(() -> {
            release(inLockStep);
            put(reply);
            return subscribed.add(device);
        });
    }

    boolean hasSubscribed() {
        return locked(() -> !subscribed.isEmpty());
    }

    /** Removes a subscription and the queued data of the device. */
    void unsubscribed(DeviceAddress device, WireMessage reply) {
        boolean inLockStep = lockStep.getAsBoolean();
        locked(() -> {
            subscribed.remove(device);
            for (var waiting : List.of(held, sending)) {
                int before = waiting.size();
                waiting.removeIf(
                        each -> each.data() != null && each.data().from().equals(device));
                dataWaiting -= before - waiting.size();
            }
            release(inLockStep);
            put(reply);
            return true;
        });
    }

    private void put(WireMessage message) {
        put(message.bytes());
    }

    private void put(byte[] bytes) {
        replyBytes += bytes.length;
        sending.add(new Entry(bytes, null));
        wake(outputReady);
    }

    // ---- called by the threads of a connection

    /** Adds raw bytes that precede all messages. */
    void greet(byte[] banner) {
        locked(() -> {
            put(banner);
            return true;
        });
    }

    /** Waits until the client has read most of its replies; false if the outbox is closed. */
    boolean awaitRoom() throws InterruptedException {
        while (!closed && replyBytes > MAX_REPLY_BYTES) {
            await(replySpace);
        }
        return !closed;
    }

    /** Waits for output and takes a batch of it; null if the outbox is closed. */
    byte @Nullable [] take() throws InterruptedException {
        while (!closed) {
            byte[] batch = locked(this::batch);
            if (batch != null) {
                wake(replySpace);
                return batch;
            }
            await(outputReady);
        }
        return null;
    }

    private byte @Nullable [] batch() {
        if (corked || sending.isEmpty()) {
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
        return batch.toByteArray();
    }

    /** Number of data messages dropped since the client was last notified. */
    int dropped() {
        return dropped.get();
    }

    /** Ends all waiting calls; does not wait. */
    void close() {
        closed = true;
        tryTakeIn();
        wake(outputReady);
        wake(replySpace);
    }

    private <T extends @Nullable Object> T locked(Supplier<T> action) {
        T result;
        lock.lock();
        try {
            takeIn();
            result = action.get();
        } finally {
            lock.unlock();
        }
        notifyOfEmptyFrame();
        return result;
    }

    /** The caller checks its condition again after this. */
    private static void await(Semaphore permits) throws InterruptedException {
        permits.acquire();
        permits.drainPermits();
    }

    private static void wake(Semaphore permits) {
        if (permits.availablePermits() == 0) {
            permits.release();
        }
    }

    /** The replace rules of one client: the newest matching rule applies, and their number is bounded. */
    private static final class ReplaceRules {
        static final int MAX_RULES = 256;

        private final List<ReplaceRule> rules = new ArrayList<>();

        /**
         * Adds a rule. It replaces a rule for the same messages; if there are too many rules, the oldest is dropped.
         */
        void add(ReplaceRule rule) {
            rules.removeIf(each -> each.interfaceCode() == rule.interfaceCode()
                    && each.index() == rule.index()
                    && each.type() == rule.type()
                    && each.subtype() == rule.subtype());
            if (rules.size() == MAX_RULES) {
                rules.removeFirst();
            }
            rules.add(rule);
        }

        /** The treatment of such a message: ACCEPT, REPLACE or IGNORE. */
        int treatment(DeviceAddress from, MessageType type, int subtype) {
            for (int i = rules.size() - 1; i >= 0; i--) {
                if (rules.get(i).matches(from, type.code(), subtype)) {
                    return rules.get(i).replace();
                }
            }
            return ReplaceRule.ACCEPT;
        }
    }
}
