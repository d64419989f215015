package io.troupe.actor;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.Objects;
import java.util.function.BooleanSupplier;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * The timers of one thread, on hierarchical wheels: with slots of about one millisecond, 64 milliseconds, 64 times
 * that, and so on.
 *
 * <p><b>Role.</b> Each actor space has one. Internal to this library. <b>Threads.</b> The space's thread only.
 *
 * <p><b>Order.</b> By deadline, then by the order in which they were set; a task never runs before its deadline.
 *
 * <p><b>Cost.</b> Setting and cancelling take constant time. A timer moves to a finer wheel up to seven times before it
 * runs. Running it takes time logarithmic in the number of timers that are due in the same millisecond or overdue.
 * Timers that are due later cost nothing until then.
 *
 * <p><b>Source.</b> Varghese and Lauck, "Hashed and hierarchical timing wheels", scheme 7 (1987).
 */
final class TimerWheel {
    /*
     * Time is counted in ticks of 2^20 ns. Timers that are due up to the tick "position" are near: they are in a heap,
     * in exact order. Each other timer is on the wheel of the highest digit (of six bits) in which its tick differs
     * from the position, in the slot of that digit. So on each wheel only slots after the position's digit are
     * occupied, all of them are due before those of the next coarser wheel, and a bit scan finds the next one.
     */
    private static final int TICK_BITS = 20;
    private static final int DIGIT_BITS = 6;
    private static final int SLOTS = 1 << DIGIT_BITS;
    private static final int WHEELS = (Long.SIZE - TICK_BITS + DIGIT_BITS - 1) / DIGIT_BITS;
    private static final long SLACK_NANOS_PER_TIMER = 200;
    private static final long MOST_SLACK_NANOS = 2_000_000;
    private static final int NONE = -1;
    private static final int FEW = 16;
    private static final long MADE_UP_FOR_NANOS = 1_000_000_000;
    private static final Comparator<WheelTimer> IN_TURN = Comparator.<WheelTimer>comparingLong(
                    timer -> timer.deadlineNanos)
            .thenComparingLong(timer -> timer.sequence);

    private final Clock clock;
    private final BooleanSupplier onThread;
    private final Heap near;
    private final @Nullable WheelTimer[] slots = new WheelTimer[WHEELS * SLOTS];
    private final long[] occupied = new long[WHEELS]; // one bit per slot
    private final List<WheelTimer> periodic = new ArrayList<>(); // periodic timers that have run in this pass
    private long position; // a tick, unsigned
    private long sequence;
    private int size;

    public TimerWheel(Clock clock) {
        this(clock, () -> true);
    }

    /**
     * A wheel whose timers may be cancelled only on the thread of the wheel.
     *
     * @param onThread true on the wheel's thread
     */
    public TimerWheel(Clock clock, BooleanSupplier onThread) {
        this(clock, onThread, new Heap());
    }

    TimerWheel(Clock clock, BooleanSupplier onThread, Heap near) {
        this.clock = clock;
        this.onThread = onThread;
        this.near = near;
        this.position = tick(clock.nanos());
    }

    /** Sets a timer with the schedule {@link Schedule#FIXED_RATE}; see {@link #set(Runnable, long, long, Schedule)}. */
    public Timer set(Runnable task, long delayNanos, long periodNanos) {
        return set(task, delayNanos, periodNanos, Schedule.FIXED_RATE);
    }

    /**
     * Sets a timer.
     *
     * @param delayNanos delay from now; zero or less means as soon as possible
     * @param periodNanos interval of further runs; 0 = once
     */
    public Timer set(Runnable task, long delayNanos, long periodNanos, Schedule schedule) {
        Objects.requireNonNull(task, "task");
        Objects.requireNonNull(schedule, "schedule");
        if (periodNanos < 0) {
            throw new IllegalArgumentException("a timer's period is " + periodNanos + " ns, expected 0 (once) or more");
        }
        long now = clock.nanos();
        if (size == 0) {
            position = Math.max(position, tick(now)); // otherwise it moves when timers are run
        }
        long deadline = saturatedSum(now, Math.max(0, delayNanos));
        var timer = new WheelTimer(this, task, deadline, periodNanos, schedule, sequence++);
        insert(timer);
        size++;
        return timer;
    }

    public boolean isEmpty() {
        return size == 0;
    }

    /** The number of timers that are set. */
    public int size() {
        return size;
    }

    /** Cancels all timers; returns their tasks, in the order in which they would have run. */
    public List<Runnable> clear() {
        insertPeriodicOnes();
        var waiting = new ArrayList<WheelTimer>(size);
        for (WheelTimer first : slots) {
            for (WheelTimer timer = first; timer != null; timer = timer.after) {
                waiting.add(timer);
            }
        }
        for (WheelTimer first = near.first(); first != null; first = near.first()) {
            waiting.add(first);
            remove(first);
        }
        waiting.forEach(this::remove);
        waiting.sort(IN_TURN);
        return waiting.stream().map(timer -> timer.task).toList();
    }

    /** True if the next deadline has passed. */
    public boolean isDue() {
        if (size == 0) {
            return false;
        }
        WheelTimer first = near.first();
        long now = clock.nanos();
        if (first != null && first.deadlineNanos <= now) {
            return true;
        }
        int slot = nextSlot();
        if (slot == NONE || start(slot) > tick(now)) {
            return false;
        }
        return earliestIn(slot, Integer.MAX_VALUE) <= now;
    }

    /**
     * A moment before which no timer is due: the next deadline or an earlier moment; {@link Long#MAX_VALUE} if there is
     * no timer.
     */
    public long nextDeadline() {
        WheelTimer first = near.first();
        if (first != null) {
            return first.deadlineNanos;
        }
        int slot = nextSlot();
        return slot == NONE ? Long.MAX_VALUE : earliestIn(slot, FEW);
    }

    /**
     * How long the thread may sleep if nothing else happens; at most the given time. Many timers that are due soon
     * after each other are run together, because waking a thread costs more than running dozens of them. So a timer may
     * run later than its deadline, by a fifth of a microsecond for each timer that is set and by two milliseconds at
     * most.
     */
    public long sleepNanos(long longestNanos) {
        long deadline = nextDeadline();
        if (deadline == Long.MAX_VALUE) {
            return longestNanos;
        }
        long slackNanos = Math.min(MOST_SLACK_NANOS, size * SLACK_NANOS_PER_TIMER);
        return Math.min(longestNanos, Math.max(slackNanos, deadline - clock.nanos()));
    }

    /**
     * Runs the timers that are due, each once. A timer whose next period has also passed, or one that was set during
     * this call, is due again at the next call, so that other work runs in between.
     *
     * @param runner calls the task and handles what it throws
     * @return the number of tasks that were run
     */
    public int runDue(Consumer<Runnable> runner) {
        if (size == 0) {
            return 0;
        }
        long now = clock.nanos();
        moveTo(tick(now));
        // timers set from now on run after all others that are due: their deadline is not before now
        long firstNew = sequence;
        int count = 0;
        try {
            for (WheelTimer timer = near.first(); timer != null; timer = near.first()) {
                if (timer.deadlineNanos > now || timer.sequence >= firstNew) {
                    break;
                }
                run(timer, now, runner);
                count++;
            }
        } finally {
            insertPeriodicOnes();
        }
        return count;
    }

    private void run(WheelTimer timer, long now, Consumer<Runnable> runner) {
        if (timer.periodNanos == 0) {
            remove(timer);
            runner.accept(timer.task);
            return;
        }
        periodic.add(timer); // before it leaves its slot, so that it cannot be lost
        unlink(timer);
        timer.deadlineNanos = nextDeadline(timer, now);
        try {
            runner.accept(timer.task);
        } finally {
            if (timer.schedule == Schedule.FIXED_DELAY) {
                timer.deadlineNanos = saturatedSum(clock.nanos(), timer.periodNanos);
            }
        }
    }

    private long nextDeadline(WheelTimer timer, long now) {
        long next = saturatedSum(timer.deadlineNanos, timer.periodNanos);
        return switch (timer.schedule) {
            case FIXED_RATE ->
                clock.runsByItself() ? notBefore(next, now - MADE_UP_FOR_NANOS, timer.periodNanos) : next;
            case SKIP_MISSED -> notBefore(next, now + 1, timer.periodNanos);
            case FIXED_DELAY -> next; // replaced after the run
        };
    }

    /** The first of the deadlines that is not before a moment. */
    private static long notBefore(long deadline, long momentNanos, long periodNanos) {
        return deadline >= momentNanos
                ? deadline
                : deadline + Math.ceilDiv(momentNanos - deadline, periodNanos) * periodNanos;
    }

    private void insertPeriodicOnes() {
        for (WheelTimer timer : periodic) {
            if (timer.waiting && timer.place == WheelTimer.NOWHERE) {
                insert(timer);
            }
        }
        periodic.clear();
    }

    /** Cancels a timer; on the wheel's thread only. */
    private boolean cancel(WheelTimer timer) {
        if (!onThread.getAsBoolean()) {
            throw new IllegalStateException("a timer can be cancelled on the thread of its space only, and not on "
                    + Thread.currentThread().getName() + ": send the actor a message");
        }
        return remove(timer);
    }

    private boolean remove(WheelTimer timer) {
        if (!timer.waiting) {
            return false;
        }
        timer.waiting = false;
        size--;
        if (timer.place != WheelTimer.NOWHERE) {
            unlink(timer);
        }
        return true;
    }

    // ---- slots

    private void insert(WheelTimer timer) {
        long tick = tick(timer.deadlineNanos);
        long difference = tick ^ position;
        if (tick <= position) { // signed comparison: a tick has fewer than 64 bits
            timer.near = true;
            near.add(timer);
            return;
        }
        int wheel = (Long.SIZE - 1 - Long.numberOfLeadingZeros(difference)) / DIGIT_BITS;
        int digit = (int) (tick >>> wheel * DIGIT_BITS) & (SLOTS - 1);
        int slot = wheel * SLOTS + digit;
        WheelTimer first = slots[slot];
        timer.near = false;
        timer.place = slot;
        timer.after = first;
        if (first != null) {
            first.before = timer;
        }
        slots[slot] = timer;
        occupied[wheel] |= 1L << digit;
    }

    private void unlink(WheelTimer timer) {
        if (timer.near) {
            near.remove(timer);
            return;
        }
        int slot = timer.place;
        WheelTimer after = timer.after;
        if (timer.before != null) {
            timer.before.after = after;
        } else {
            slots[slot] = after;
            if (after == null) {
                occupied[slot / SLOTS] &= ~(1L << slot % SLOTS);
            }
        }
        if (after != null) {
            after.before = timer.before;
        }
        timer.before = null;
        timer.after = null;
        timer.place = WheelTimer.NOWHERE;
    }

    /** Moves timers that are due up to a tick to the heap, and those due soon after it to finer wheels. */
    private void moveTo(long tick) {
        for (int slot = nextSlot(); slot != NONE && start(slot) <= tick; slot = nextSlot()) {
            position = start(slot);
            for (WheelTimer timer = slots[slot]; timer != null; timer = slots[slot]) {
                unlink(timer);
                insert(timer);
            }
        }
        position = Math.max(position, tick);
    }

    /** The first occupied slot, or {@link #NONE}. */
    private int nextSlot() {
        for (int wheel = 0; wheel < WHEELS; wheel++) {
            if (occupied[wheel] != 0) {
                return wheel * SLOTS + Long.numberOfTrailingZeros(occupied[wheel]);
            }
        }
        return NONE;
    }

    /** The first tick of a slot. */
    private long start(int slot) {
        int wheel = slot / SLOTS;
        long coarser = position >>> (wheel + 1) * DIGIT_BITS << DIGIT_BITS;
        return (coarser | slot % SLOTS) << wheel * DIGIT_BITS;
    }

    /** The earliest deadline in a slot, or the start of the slot if it holds more than {@code limit} timers. */
    private long earliestIn(int slot, int limit) {
        long earliest = Long.MAX_VALUE;
        int looks = 0;
        for (WheelTimer timer = slots[slot]; timer != null; timer = timer.after) {
            if (looks++ == limit) {
                return nanos(start(slot));
            }
            earliest = Math.min(earliest, timer.deadlineNanos);
        }
        return earliest;
    }

    /** The tick of a moment: order-preserving and never negative. */
    private static long tick(long nanos) {
        return (nanos ^ Long.MIN_VALUE) >>> TICK_BITS;
    }

    private static long nanos(long tick) {
        return (tick << TICK_BITS) ^ Long.MIN_VALUE;
    }

    private static long saturatedSum(long nanos, long more) {
        long sum = nanos + more;
        return sum < nanos ? Long.MAX_VALUE : sum;
    }

    /** A timer of a wheel. */
    static final class WheelTimer implements Timer {
        /** The place of a timer that is neither in a slot nor in the heap. */
        static final int NOWHERE = -1;

        final Runnable task;
        final long periodNanos;
        final Schedule schedule;
        final long sequence;
        long deadlineNanos;
        boolean waiting = true;
        int place = NOWHERE; // the index in the heap if it is near, else the index of its slot
        boolean near;

        @Nullable
        WheelTimer before; // links within its slot

        @Nullable
        WheelTimer after;

        private final TimerWheel wheel;

        WheelTimer(
                TimerWheel wheel,
                Runnable task,
                long deadlineNanos,
                long periodNanos,
                Schedule schedule,
                long sequence) {
            this.wheel = wheel;
            this.task = task;
            this.deadlineNanos = deadlineNanos;
            this.periodNanos = periodNanos;
            this.schedule = schedule;
            this.sequence = sequence;
        }

        @Override
        public boolean cancel() {
            return wheel.cancel(this);
        }

        @Override
        public boolean isWaiting() {
            return waiting;
        }

        @Override
        public String toString() {
            if (!waiting) {
                return "timer that has run or was cancelled";
            }
            String period = periodNanos > 0 ? ", then every " + Duration.ofNanos(periodNanos) + ", " + schedule : "";
            return "timer due in " + Duration.ofNanos(deadlineNanos - wheel.clock.nanos()) + period;
        }
    }

    /**
     * Timers ordered by deadline, then by creation: a heap with four children per entry, in which each timer stores its
     * index.
     *
     * <p><b>Cost.</b> Logarithmic time for adding and removing.
     */
    static class Heap {
        private static final int SMALL = 16;
        private static final int CHILDREN = 4;

        private @Nullable WheelTimer[] timers = new WheelTimer[SMALL];
        private int size;

        /** The number of timers. */
        final int size() {
            return size;
        }

        /** The earliest timer, or null. */
        final @Nullable WheelTimer first() {
            return timers[0];
        }

        /** True if a timer runs before another one; the only place where timers are compared. */
        boolean isEarlier(WheelTimer timer, WheelTimer other) {
            return timer.deadlineNanos < other.deadlineNanos
                    || timer.deadlineNanos == other.deadlineNanos && timer.sequence < other.sequence;
        }

        /*
         * A stack overflow of the caller in here must not corrupt the heap. A call may overflow, a store cannot:
         * between two calls the heap is complete, and at worst a timer is out of order.
         */

        final void add(WheelTimer timer) {
            if (size == timers.length) {
                timers = Arrays.copyOf(timers, 2 * size);
            }
            timers[size] = timer;
            timer.place = size++;
            moveUp(timer);
        }

        /** Removes a timer that is in the heap. */
        final void remove(WheelTimer timer) {
            WheelTimer last = at(size - 1);
            size--;
            timers[size] = null;
            if (last != timer) {
                timers[timer.place] = last;
                last.place = timer.place;
            }
            timer.place = WheelTimer.NOWHERE;
            if (last != timer) {
                moveDown(last);
                moveUp(last);
            }
            if (size < timers.length / 4 && timers.length > SMALL) {
                timers = Arrays.copyOf(timers, timers.length / 2);
            }
        }

        private WheelTimer at(int place) {
            return Objects.requireNonNull(timers[place]);
        }

        private void moveUp(WheelTimer timer) {
            while (timer.place > 0) {
                WheelTimer parent = at((timer.place - 1) >>> 2);
                if (!isEarlier(timer, parent)) {
                    return;
                }
                int place = parent.place;
                timers[timer.place] = parent;
                parent.place = timer.place;
                timers[place] = timer;
                timer.place = place;
            }
        }

        private void moveDown(WheelTimer timer) {
            for (WheelTimer child = earliestChild(timer); child != null; child = earliestChild(timer)) {
                if (!isEarlier(child, timer)) {
                    return;
                }
                int place = child.place;
                timers[timer.place] = child;
                child.place = timer.place;
                timers[place] = timer;
                timer.place = place;
            }
        }

        private @Nullable WheelTimer earliestChild(WheelTimer timer) {
            int first = (timer.place << 2) + 1;
            WheelTimer earliest = first < size ? at(first) : null;
            for (int place = first + 1; earliest != null && place < Math.min(first + CHILDREN, size); place++) {
                WheelTimer child = at(place);
                if (isEarlier(child, earliest)) {
                    earliest = child;
                }
            }
            return earliest;
        }
    }
}
