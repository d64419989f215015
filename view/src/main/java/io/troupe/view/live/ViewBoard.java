package io.troupe.view.live;

import java.util.ArrayDeque;
import java.util.Arrays;
import java.util.Deque;
import java.util.List;
import java.util.Objects;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.locks.LockSupport;
import java.util.function.BooleanSupplier;
import java.util.stream.LongStream;
import org.jspecify.annotations.Nullable;

/**
 * What a live page shows at the moment.
 *
 * <p><b>Threads.</b> One thread writes, which never waits for a reader; any number of threads read.
 *
 * <p><b>Order.</b> A newer frame replaces an older one. Events are kept, the newest {@value #MOST_EVENTS} of them.
 */
final class ViewBoard implements ViewSink {
    static final int MOST_EVENTS = 20_000;

    /** Spacing of the frames that are kept for the trails of viewers that come later. */
    private static final long PAST_MICROS = 500_000;

    private static final int MOST_PAST_FRAMES = 600;
    private static final long MOST_PAST_BYTES = 1_000_000;

    /** A frame with its message, which is made when the first viewer needs it. */
    static final class Shown {
        final ViewedWorld world;
        final ViewFrame frame;
        private volatile byte @Nullable [] message;

        Shown(ViewedWorld world, ViewFrame frame) {
            this.world = world;
            this.frame = frame;
        }

        byte[] message() {
            byte[] made = message;
            if (made == null) {
                made = ViewMessages.frame(world, frame, false);
                message = made; // viewers may make the same message twice
            }
            return made;
        }
    }

    /** A thread that waits for a new frame, event or end. */
    static final class Waiting {
        private final Thread thread = Thread.currentThread();
        private volatile boolean isIdle;

        /** Waits until there is something new, or for a time; on the thread that created this. */
        void await(long nanos, BooleanSupplier hasNews) {
            isIdle = true;
            if (!hasNews.getAsBoolean()) {
                LockSupport.parkNanos(this, nanos);
            }
            isIdle = false;
        }

        private void wake() {
            if (isIdle) {
                isIdle = false; // one wake-up is enough, however many frames come
                LockSupport.unpark(thread);
            }
        }
    }

    private final Set<Waiting> waiting = ConcurrentHashMap.newKeySet();
    private volatile @Nullable ViewedWorld world;
    private volatile @Nullable Shown newest;
    private final Deque<Shown> past = new ArrayDeque<>(); // guarded by this, as are the events
    private final @Nullable String[] events = new String[MOST_EVENTS]; // each at the rest of its number
    private long firstEvent;
    private long endOfEvents; // the number of the next one
    private long pastMicros = Long.MIN_VALUE;

    @Override
    public synchronized void world(ViewedWorld begun) {
        past.clear();
        firstEvent = endOfEvents;
        Arrays.fill(events, null);
        pastMicros = Long.MIN_VALUE;
        newest = null;
        world = begun;
    }

    @Override
    public void frame(ViewFrame frame) {
        ViewedWorld of = world;
        if (of == null) {
            throw new IllegalStateException("there is no world yet");
        }
        var shown = new Shown(of, frame);
        newest = shown;
        wakeAll();
        long micros = frame.snapshot().timeMicros();
        if (micros >= pastMicros + PAST_MICROS || micros < pastMicros) {
            pastMicros = micros;
            keep(shown);
        }
    }

    /** Wakes this thread when there is something new, until {@link #leave}. */
    void enter(Waiting thread) {
        waiting.add(thread);
    }

    void leave(Waiting thread) {
        waiting.remove(thread);
    }

    /** Wakes all threads that wait. */
    void wakeAll() {
        if (!waiting.isEmpty()) {
            waiting.forEach(Waiting::wake);
        }
    }

    private synchronized void keep(Shown shown) {
        past.addLast(shown);
        long bytes = 8L * shown.frame.states().length;
        while (past.size() > MOST_PAST_FRAMES || past.size() > 2 && past.size() * bytes > MOST_PAST_BYTES) {
            past.removeFirst();
        }
    }

    @Override
    public synchronized void event(String json) {
        events[place(endOfEvents)] = json;
        endOfEvents++;
        firstEvent = Math.max(firstEvent, endOfEvents - MOST_EVENTS);
    }

    private static int place(long number) {
        return (int) (number % MOST_EVENTS);
    }

    @Nullable
    ViewedWorld world() {
        return world;
    }

    @Nullable
    Shown newest() {
        return newest;
    }

    /** Frames for the trails, oldest first. */
    synchronized List<Shown> past() {
        return List.copyOf(past);
    }

    /**
     * Events from a number on.
     *
     * @param first number of the first event
     * @param last number of the event after the last one
     */
    record Events(long first, long last, List<String> json) {}

    synchronized Events eventsFrom(long number) {
        long from = Math.max(number, firstEvent);
        List<String> json = LongStream.range(from, endOfEvents)
                .mapToObj(each -> Objects.requireNonNull(events[place(each)]))
                .toList();
        return new Events(from, endOfEvents, json);
    }
}
