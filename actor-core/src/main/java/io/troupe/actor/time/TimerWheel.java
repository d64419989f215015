package io.troupe.actor.time;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Objects;
import java.util.function.BooleanSupplier;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * Timers in slots of one millisecond that come round every 512 milliseconds.
 *
 * <p><b>Role.</b> Each actor space has one. <b>Threads.</b> The space's thread only.
 * <p><b>Order.</b> By deadline, then by the order in which they were set; a task never runs before its deadline.
 * <p><b>Cost.</b> Setting and cancelling take constant time; running takes time in the slots passed (512 at most) and the tasks run.
 * <p><b>Source.</b> Varghese and Lauck, "Hashed and hierarchical timing wheels", scheme 6 (1987).
 */
public final class TimerWheel {
    private static final int SLOTS = 512;
    private static final long SLOT_NANOS = 1_000_000;
    private static final Comparator<Timer> IN_TURN =
            Comparator.<Timer>comparingLong(timer -> timer.deadlineNanos).thenComparingLong(timer -> timer.sequence);

    private final Clock clock;
    private final BooleanSupplier onThread;
    private final @Nullable Timer[] slots = new Timer[SLOTS];
    private final List<Timer> due = new ArrayList<>();
    private long doneSlot;
    private long next = Long.MAX_VALUE;
    private long sequence;
    private int size;

    public TimerWheel(Clock clock) {
        this(clock, () -> true);
    }

    /**
     * A wheel whose timers are cancelled on its own thread only.
     *
     * @param onThread whether the calling thread is the wheel's
     */
    public TimerWheel(Clock clock, BooleanSupplier onThread) {
        this.clock = clock;
        this.onThread = onThread;
        this.doneSlot = slotNumber(clock.nanos());
    }

    /**
     * Sets a timer.
     *
     * @param delayNanos from now; nothing and less means as soon as possible
     * @param periodNanos from then on again and again; 0 = once
     */
    public Timer set(Runnable task, long delayNanos, long periodNanos) {
        Objects.requireNonNull(task, "task");
        if (periodNanos < 0) {
            throw new IllegalArgumentException("a timer's period is " + periodNanos + " ns, expected 0 (once) or more");
        }
        var timer =
                new Timer(this, task, saturatedSum(clock.nanos(), Math.max(0, delayNanos)), periodNanos, sequence++);
        insert(timer);
        return timer;
    }

    public boolean isEmpty() {
        return size == 0;
    }

    /** How many timers are set. */
    public int size() {
        return size;
    }

    /** Takes all timers back; answers their tasks, in the order in which they would have run. */
    public List<Runnable> clear() {
        var waiting = new ArrayList<Timer>();
        for (Timer first : slots) {
            for (Timer timer = first; timer != null; timer = timer.after) {
                waiting.add(timer);
            }
        }
        waiting.forEach(this::remove);
        waiting.sort(IN_TURN);
        return waiting.stream().map(timer -> timer.task).toList();
    }

    /** Whether the next deadline is over. */
    public boolean isDue() {
        return size > 0 && next <= clock.nanos();
    }

    /**
     * A moment until which nothing happens here: the next deadline, an earlier one that was cancelled, or, when that is more than a
     * round away, the end of this round; {@link Long#MAX_VALUE} when there is no timer.
     */
    public long nextDeadline() {
        return size == 0 ? Long.MAX_VALUE : next;
    }

    /**
     * Runs what is due, each timer once: one whose next period is over too is due again at once, so that others have their turn in between.
     *
     * @param runner calls the task and deals with what it throws
     * @return how many tasks were run
     */
    public int runDue(Consumer<Runnable> runner) {
        if (!isDue()) {
            return 0;
        }
        long now = clock.nanos();
        long lastSlot = slotNumber(now);
        long firstSlot = Math.max(doneSlot, lastSlot - SLOTS + 1);
        for (long slot = firstSlot; slot <= lastSlot; slot++) {
            for (Timer timer = slots[index(slot)]; timer != null; timer = timer.after) {
                if (timer.deadlineNanos <= now) {
                    due.add(timer);
                }
            }
        }
        doneSlot = lastSlot;
        int count = runCollected(now, runner);
        next = findNext();
        return count;
    }

    private long findNext() {
        for (long slot = doneSlot; slot < doneSlot + SLOTS; slot++) {
            long earliest = Long.MAX_VALUE;
            for (Timer timer = slots[index(slot)]; timer != null; timer = timer.after) {
                if (slotNumber(timer.deadlineNanos) <= slot) {
                    earliest = Math.min(earliest, timer.deadlineNanos);
                }
            }
            if (earliest != Long.MAX_VALUE) {
                return earliest;
            }
        }
        return size == 0 ? Long.MAX_VALUE : (doneSlot + SLOTS) * SLOT_NANOS;
    }

    private int runCollected(long now, Consumer<Runnable> runner) {
        int count = 0;
        while (!due.isEmpty()) {
            due.sort(IN_TURN);
            Timer timer = due.removeFirst();
            if (!timer.waiting) {
                continue; // cancelled by one that ran before
            }
            remove(timer);
            if (timer.periodNanos > 0) {
                timer.deadlineNanos += timer.periodNanos;
                insert(timer);
                doneSlot = Math.min(doneSlot, slotNumber(timer.deadlineNanos));
            }
            runner.accept(timer.task);
            count++;
        }
        return count;
    }

    /** Takes a timer back, on the wheel's thread. */
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
        if (timer.before == null) {
            slots[index(slotNumber(timer.deadlineNanos))] = timer.after;
        } else {
            timer.before.after = timer.after;
        }
        if (timer.after != null) {
            timer.after.before = timer.before;
        }
        timer.before = null;
        timer.after = null;
        timer.waiting = false;
        size--;
        return true;
    }

    private void insert(Timer timer) {
        if (size == 0) {
            doneSlot = slotNumber(Math.min(clock.nanos(), timer.deadlineNanos));
            next = Long.MAX_VALUE;
        }
        next = Math.min(next, timer.deadlineNanos);
        int index = index(slotNumber(timer.deadlineNanos));
        Timer first = slots[index];
        timer.after = first;
        if (first != null) {
            first.before = timer;
        }
        slots[index] = timer;
        timer.waiting = true;
        size++;
    }

    private static long saturatedSum(long nanos, long more) {
        long sum = nanos + more;
        return sum < nanos ? Long.MAX_VALUE : sum;
    }

    private static long slotNumber(long nanos) {
        return Math.floorDiv(nanos, SLOT_NANOS);
    }

    private static int index(long slot) {
        return (int) Math.floorMod(slot, (long) SLOTS);
    }
}
