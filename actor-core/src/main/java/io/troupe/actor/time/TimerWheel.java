package io.troupe.actor.time;

import java.util.ArrayList;
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
 * <p><b>Role.</b> Each actor space has one; internal to this library. <b>Threads.</b> The space's thread only.
 *
 * <p><b>Order.</b> By deadline, then by the order in which they were set; a task never runs before its deadline.
 *
 * <p><b>Cost.</b> Setting and cancelling take constant time. A timer moves to a finer wheel up to seven times before it
 * runs. Running it takes time logarithmic in the number of timers that are due in the same millisecond or overdue.
 * Timers that are due later cost nothing until then.
 *
 * <p><b>Source.</b> Varghese and Lauck, "Hashed and hierarchical timing wheels", scheme 7 (1987).
 *
 * @hidden
 */
public final class TimerWheel {
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
    private static final int NONE = -1;
    private static final int FEW = 16;
    private static final long MADE_UP_FOR_NANOS = 1_000_000_000;
    private static final Comparator<Timer> IN_TURN =
            Comparator.<Timer>comparingLong(timer -> timer.deadlineNanos).thenComparingLong(timer -> timer.sequence);

    private final Clock clock;
    private final BooleanSupplier onThread;
    private final TimerHeap near;
    private final @Nullable Timer[] slots = new Timer[WHEELS * SLOTS];
    private final long[] occupied = new long[WHEELS]; // one bit per slot
    private final List<Timer> periodic = new ArrayList<>(); // periodic timers that have run in this pass
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
        this(clock, onThread, new TimerHeap());
    }

    TimerWheel(Clock clock, BooleanSupplier onThread, TimerHeap near) {
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
        var timer = new Timer(this, task, deadline, periodNanos, schedule, sequence++);
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
        var waiting = new ArrayList<Timer>(size);
        for (Timer first : slots) {
            for (Timer timer = first; timer != null; timer = timer.after) {
                waiting.add(timer);
            }
        }
        for (Timer first = near.first(); first != null; first = near.first()) {
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
        Timer first = near.first();
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
        Timer first = near.first();
        if (first != null) {
            return first.deadlineNanos;
        }
        int slot = nextSlot();
        return slot == NONE ? Long.MAX_VALUE : earliestIn(slot, FEW);
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
            for (Timer timer = near.first(); timer != null; timer = near.first()) {
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

    private void run(Timer timer, long now, Consumer<Runnable> runner) {
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

    private long nextDeadline(Timer timer, long now) {
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
        for (Timer timer : periodic) {
            if (timer.waiting && timer.place == Timer.NOWHERE) {
                insert(timer);
            }
        }
        periodic.clear();
    }

    /** Cancels a timer; on the wheel's thread only. */
    boolean cancel(Timer timer) {
        if (!onThread.getAsBoolean()) {
            throw new IllegalStateException("a timer can be cancelled on the thread of its space only, and not on "
                    + Thread.currentThread().getName() + ": send the actor a message");
        }
        return remove(timer);
    }

    private boolean remove(Timer timer) {
        if (!timer.waiting) {
            return false;
        }
        timer.waiting = false;
        size--;
        if (timer.place != Timer.NOWHERE) {
            unlink(timer);
        }
        return true;
    }

    // ---- slots

    private void insert(Timer timer) {
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
        Timer first = slots[slot];
        timer.near = false;
        timer.place = slot;
        timer.after = first;
        if (first != null) {
            first.before = timer;
        }
        slots[slot] = timer;
        occupied[wheel] |= 1L << digit;
    }

    private void unlink(Timer timer) {
        if (timer.near) {
            near.remove(timer);
            return;
        }
        int slot = timer.place;
        Timer after = timer.after;
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
        timer.place = Timer.NOWHERE;
    }

    /** Moves timers that are due up to a tick to the heap, and those due soon after it to finer wheels. */
    private void moveTo(long tick) {
        for (int slot = nextSlot(); slot != NONE && start(slot) <= tick; slot = nextSlot()) {
            position = start(slot);
            for (Timer timer = slots[slot]; timer != null; timer = slots[slot]) {
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
        for (Timer timer = slots[slot]; timer != null; timer = timer.after) {
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
}
