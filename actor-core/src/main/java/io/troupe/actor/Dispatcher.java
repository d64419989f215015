package io.troupe.actor;

import io.troupe.actor.Reports.Trouble;
import io.troupe.actor.internal.loop.EntryQueue;
import io.troupe.actor.internal.loop.QueueEntries;
import io.troupe.actor.internal.loop.QueueEntry;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Objects;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * The queues of a space and the order in which they are processed. On the space's thread, except for the inboxes and
 * {@link #served}.
 *
 * <p><b>Queues.</b> A <i>message</i> is a call of an actor or a task in message order; a <i>callback</i> is a listener,
 * a result for a {@link Callback}, or the resumption of a sequential body. Processing one of them is a <i>turn</i>.
 * Both kinds have an inbox for entries from other threads and a ring for entries from the space's own thread.
 *
 * <p><b>Order.</b> A pass drains the queues in these steps:
 *
 * <ol>
 *   <li>Before each message, the callbacks in the callback inbox are moved to the callback ring. So a callback from
 *       another space does not wait for messages, and no message overtakes a callback that its sender queued before it.
 *   <li>A message from the inbox runs at once only if both rings are empty. Otherwise it is appended to the message
 *       ring, which keeps the order of messages from one sender to one receiver.
 *   <li>Callbacks run before messages. After {@value #QUOTA} callbacks in a row (and one returned by a request, see
 *       below) one message, the inbox and the timers get their turn. A message from the inbox runs then only if no
 *       callback that came before it is left.
 *   <li>Timers run after each pass. Within a pass they run after {@value #STRIDE} messages, or after each message while
 *       messages take longer than a millisecond. On a clock that is moved by hand no timer is ever late, so the end of
 *       the pass suffices.
 * </ol>
 *
 * <p>A request whose result has exactly one listener returns that listener, and it runs next, as it would from its
 * ring. Actions of {@link #afterTurn} run before everything else.
 */
final class Dispatcher {
    private static final int QUOTA = 256;
    private static final int RENEWAL = (1 << 10) - 1;
    private static final int STRIDE = 16;
    private static final long LONG_STRIDE_NANOS = 1_000_000;
    private static final int SPINS = 1_000;

    final EntryQueue inbox;
    final EntryQueue callbackInbox;
    final TimerWheel timers;
    private final SpaceHome space;
    private final Clock clock;
    private final Consumer<Runnable> runTask = this::runTask; // created once: a pass must not allocate
    private final EntryRing callbacks;
    private final EntryRing messages;
    private final Precedence precedence = new Precedence();
    private final ArrayDeque<Runnable> afterTurn = new ArrayDeque<>();
    private final List<Runnable> idleActions = new ArrayList<>();
    private final EntryCounter direct = new EntryCounter(); // counts what was run without being in a ring
    private int passes;
    private int arrivals; // messages that the last pass took from the inbox
    private boolean turnLeavesWork;
    private int quota = QUOTA; // of entries in a row; 0 once halted, so that each loop over entries ends
    // reduced within a row of callbacks, or if a message waits for that many callbacks only
    private int callbackQuota = QUOTA;
    private int stride = STRIDE;
    private int untilLook = STRIDE; // messages until the timers are checked
    private long lastLookNanos;

    Dispatcher(
            SpaceHome space,
            EntryQueue inbox,
            EntryQueue callbackInbox,
            EntryRing callbacks,
            EntryRing messages,
            TimerWheel timers,
            Clock clock) {
        this.space = space;
        this.inbox = inbox;
        this.callbackInbox = callbackInbox;
        this.callbacks = callbacks;
        this.messages = messages;
        this.timers = timers;
        this.clock = clock;
    }

    /** Runs nothing more after the current turn. */
    void halt() {
        quota = 0;
        callbackQuota = 0;
        messages.allow(0);
        turnLeavesWork = true; // a listener that the turn returns must not run
    }

    private boolean isHalted() {
        return quota == 0;
    }

    /** Runs an action when the entry that is being processed has returned. */
    void afterTurn(Runnable action) {
        turnLeavesWork = true;
        afterTurn.add(action);
    }

    void addIdleAction(Runnable action) {
        idleActions.add(action);
    }

    /** One pass through the queues; false if there was nothing to do. */
    boolean pass() {
        if ((++passes & RENEWAL) == 0) {
            renew();
        }
        boolean worked = drainInbox(true);
        if (drainRings()) {
            worked = true;
            messages.forgetKept();
            space.beginForItself();
        }
        worked |= !isHalted() && timers.runDue(runTask) > 0;
        if (!worked && space.isThreadless()) { // a space with a thread does so before it sleeps
            forgetServed();
        }
        return worked;
    }

    /** Releases the entries that were processed last; called when the queues are empty. */
    void forgetServed() {
        inbox.forgetLast();
        callbackInbox.forgetLast();
    }

    /** Replaces objects that are written at every turn, before they become old: see {@link EntryRing#renew}. */
    private void renew() {
        space.renewTurn();
        callbacks.renew();
        messages.renew();
    }

    /** True if nothing is queued and no timer is due; between two turns. */
    boolean isQuiet() {
        return callbacks.isEmpty()
                && messages.isEmpty()
                && inbox.isEmpty()
                && callbackInbox.isEmpty()
                && !timers.isDue();
    }

    /** The number of messages that the last pass took from the inbox; 0 if there is more to do already. */
    int arrivals() {
        return callbacks.isEmpty() && messages.isEmpty() && !callbackInbox.isReady() ? arrivals : 0;
    }

    /** True if an entry has arrived from another thread; does not read the senders' cache lines. */
    boolean isReady() {
        return inbox.isReady() || callbackInbox.isReady();
    }

    /** True if an entry from another thread is queued or being queued. */
    boolean hasArrivals() {
        return !inbox.isEmpty() || !callbackInbox.isEmpty();
    }

    /** Runs the idle actions; false if there are none. */
    boolean runIdleActions() {
        if (idleActions.isEmpty()) {
            return false;
        }
        takeIdleActions().forEach(runTask);
        return true;
    }

    List<Runnable> takeIdleActions() {
        var actions = List.copyOf(idleActions);
        idleActions.clear();
        return actions;
    }

    /** Removes an entry that will not be processed any more; entries of the rings are counted as processed. */
    @Nullable
    QueueEntry pollLeftover() {
        QueueEntry node = callbacks.poll();
        if (node == null) {
            node = messages.poll();
        }
        if (node == null) {
            node = callbackInbox.poll();
        }
        return node != null ? node : inbox.poll();
    }

    /** The number of processed entries; from any thread, slightly delayed. */
    long served() {
        return direct.served() + callbacks.taken() + messages.taken();
    }

    /**
     * The number of queued entries; between two turns. Takes time proportional to the number of those in the inboxes.
     */
    long waiting() {
        return (long) callbacks.size() + messages.size() + inbox.size() + callbackInbox.size();
    }

    /** The number of messages ahead of this one; -1 if it is not among the first {@code limit}. */
    int messagesBefore(QueueEntry message, int limit) {
        int inside = Math.min(limit, messages.size());
        for (int index = 0; index < inside; index++) {
            if (QueueEntries.carries(messages.get(index), message)) {
                return index;
            }
        }
        int behind = inbox.indexOf(message, limit - inside);
        return behind < 0 ? -1 : inside + behind;
    }

    /** True if more than {@code limit} messages are queued. Takes time proportional to the limit. */
    boolean isLongerThan(int limit) {
        int inside = messages.size();
        return inside > limit || inbox.isLongerThan(limit - inside);
    }

    /** Runs a message that is in no ring, and the listener that it returns. */
    void serveDirect(QueueEntry message) {
        space.beginFor(message);
        serve(message);
    }

    /** Runs the message that its ring keeps, and the listener that it returns. */
    private void serveKept(QueueEntry message) {
        space.beginForKept();
        serve(message);
    }

    private void serve(QueueEntry node) {
        QueueEntry next = serveOne(node);
        if (next != null) {
            serveNext(next);
        }
    }

    /**
     * Runs an entry and catches everything it throws, so that the thread goes on. The entry was counted before, by its
     * ring or by {@link #direct}, so one that never returns counts as begun. {@link Watchdog} looks for this method on
     * the stack. Small enough (35 bytes of code) to be inlined even where it is seldom called.
     *
     * @return the listener to run next, or null
     */
    private @Nullable QueueEntry serveOne(QueueEntry node) {
        QueueEntry next = null;
        try {
            next = QueueEntries.serve(node);
        } catch (Throwable thrown) {
            fail(node, thrown);
        }
        return turnLeavesWork ? endTurn(next) : next;
    }

    /** Passes an exception that an entry has thrown to the entry's handler. */
    void fail(QueueEntry node, Throwable thrown) {
        try {
            QueueEntries.threw(node, thrown);
        } catch (Throwable again) {
            space.reports().error(Trouble.AN_ENTRY, space, again);
        }
    }

    /**
     * Runs the single listener of the request that was just answered; it would have been the next callback in its ring.
     * A listener that this one returns is not run this way.
     */
    private void serveNext(QueueEntry callback) {
        direct.step();
        serveOne(callback);
        if (!callbacks.isEmpty()) {
            callbackQuota = Math.max(0, quota - 1); // those that it queued continue the row
        }
    }

    /**
     * Runs the timers that are due between two messages. Reads the clock only if there are timers, because that costs
     * as much as a few messages.
     *
     * @return the number of messages until the next check
     */
    private int lookAtTimers() {
        if (!timers.isEmpty() && clock.runsByItself() && !isHalted()) {
            long now = clock.nanos();
            stride = now - lastLookNanos > LONG_STRIDE_NANOS ? 1 : Math.min(STRIDE, 2 * stride);
            lastLookNanos = now;
            if (timers.nextDeadline() <= now) {
                timers.runDue(runTask);
            }
        }
        return stride;
    }

    /** Runs a task that is not an entry: a timer's or an idle action. */
    void runTask(Runnable task) {
        direct.step();
        space.runGuarded(task);
        if (turnLeavesWork) {
            endTurn(null);
        }
    }

    /**
     * Runs the actions of {@link #afterTurn}.
     *
     * @param next the listener that the turn has returned; it is queued if it must not run now
     * @return the listener to run next, or null
     */
    private @Nullable QueueEntry endTurn(@Nullable QueueEntry next) {
        boolean isQueued = true;
        try {
            turnLeavesWork = false;
            for (Runnable action = afterTurn.poll(); action != null; action = afterTurn.poll()) {
                space.runGuarded(action);
            }
            isQueued = isHalted();
        } finally {
            if (isHalted()) {
                turnLeavesWork = true; // halted for good
            }
            if (isQueued && next != null) { // halted, or there is no memory for a report
                space.enqueue(next);
            }
        }
        return isQueued ? null : next;
    }

    /**
     * Drains the inbox.
     *
     * @param withCallbacks whether callbacks may run between the messages; otherwise the messages behind them are
     *     appended to their ring
     */
    private boolean drainInbox(boolean withCallbacks) {
        boolean worked = takeCallbacks();
        QueueEntry last = inbox.beginBatch();
        int count = 0;
        try {
            for (; count < quota && inbox.isReadyAfter(last); count++) {
                takeCallbacks(); // these may include callbacks that the sender queued before the message
                long callbacksBefore = callbacks.added();
                boolean callbacksFirst = withCallbacks && !callbacks.isEmpty();
                if (callbacksFirst) {
                    inbox.endBatch(last); // a callback may read the queue
                }
                while (withCallbacks && callbackQuota > 1 && !callbacks.isEmpty()) {
                    callbackQuota--;
                    serveOne(Objects.requireNonNull(callbacks.poll()));
                    worked = true;
                }
                if (isHalted()) {
                    break; // a callback has halted this dispatcher
                }
                boolean behind = !callbacks.isEmpty() || !messages.isEmpty();
                // before the message is taken: it must not be lost if memory is short
                if (behind && !hasRoomBehind(callbacksBefore)) {
                    break; // those in the rings run first, which makes room
                }
                last = inbox.takeAfter(last);
                worked = true;
                if (behind) {
                    messages.add(last);
                } else {
                    callbackQuota = quota; // no callback precedes this message any more
                    direct.step();
                    serveDirect(last);
                    if (untilLook == 1) {
                        inbox.endBatch(last); // a timer's task may read the queue
                    }
                    ran(1);
                }
            }
        } finally {
            arrivals = count;
            inbox.endBatch(last);
        }
        return worked;
    }

    /** Makes room for a message behind those in the ring; false if there is no memory for it. */
    private boolean hasRoomBehind(long callbacksBefore) {
        try {
            messages.makeRoom();
            precedence.note(messages.added(), callbacksBefore, messages.taken());
            return true;
        } catch (OutOfMemoryError full) {
            return false;
        }
    }

    /** Moves the callbacks that have arrived so far into their ring; false if there were none. Also within a turn. */
    boolean takeCallbacks() {
        QueueEntry last = callbackInbox.newest();
        if (last == null) {
            return false;
        }
        for (QueueEntry node = null; node != last; ) {
            if (!callbacks.hasRoom()) {
                return true; // those in the ring run first, which makes room
            }
            node = nextArrival();
            callbacks.add(node);
        }
        return true;
    }

    /**
     * Takes the next callback from the inbox. There is one, but its sender may be between the two steps of queueing it.
     * Callbacks keep their order and senders take no lock, so this thread has to wait: while a debugger, a signal or a
     * low priority holds such a sender, it occupies its processor and runs nothing.
     */
    private QueueEntry nextArrival() {
        for (int look = 0; ; look++) {
            QueueEntry node = callbackInbox.poll();
            if (node != null) {
                return node;
            }
            if (look < SPINS) {
                Thread.onSpinWait();
            } else {
                Thread.yield(); // the sender was preempted there
            }
        }
    }

    private boolean drainRings() {
        boolean worked = false;
        if (callbacks.isEmpty() && !callbackInbox.isReady()) {
            callbackQuota = quota;
        }
        for (int count = 0; count < quota; count++) {
            int run = runMessages(Math.min(untilLook, quota - count));
            if (run > 0) {
                worked = true;
                count += run - 1;
                ran(run);
                continue;
            }
            takeCallbacks();
            if (callbacks.isEmpty()) {
                return worked;
            }
            worked = true;
            boolean more = drainCallbacks();
            QueueEntry message = more ? messageAfterQuota() : messages.pollAndKeep();
            if (message != null) {
                serveKept(message);
                ran(1);
            }
            if (more) {
                return true; // timers and the inbox get their turn
            }
        }
        return worked;
    }

    /**
     * Runs messages of the ring as long as no callback is queued, at most the given number. This is the usual case: a
     * loop with as few steps per message as possible. A turn that queues a callback for this space, or halts it, allows
     * no further message.
     *
     * @return how many messages have run
     */
    private int runMessages(int most) {
        if (!callbacks.isEmpty()) {
            return 0;
        }
        callbackQuota = quota; // no callback precedes these messages
        EntryRing waiting = messages;
        EntryQueue arrivals = callbackInbox;
        QueueEntry lastArrival = arrivals.beginBatch(); // nothing is taken from there meanwhile
        long before = waiting.taken();
        waiting.allow(most);
        while (!arrivals.isReadyAfter(lastArrival)) {
            QueueEntry message = waiting.pollAllowed();
            if (message == null) {
                break;
            }
            serveKept(message);
        }
        return (int) (waiting.taken() - before);
    }

    /** Called when messages have run: checks the timers now and then. */
    private void ran(int count) {
        untilLook -= count;
        if (untilLook <= 0) {
            untilLook = lookAtTimers();
        }
    }

    /**
     * Takes the message that runs although callbacks are queued; null if there is none, or if one of the callbacks came
     * before it.
     */
    private @Nullable QueueEntry messageAfterQuota() {
        callbackQuota = quota;
        if (messages.isEmpty()) {
            drainInbox(false); // for a message that is still there
        }
        if (messages.isEmpty() || isHalted()) {
            return null;
        }
        long before = precedence.callbacksBefore(messages.taken()) - callbacks.taken();
        if (before > 0) {
            callbackQuota = (int) Math.min(quota, before);
            return null;
        }
        return messages.pollAndKeep();
    }

    /** Runs callbacks up to the quota; true if there may be more. */
    private boolean drainCallbacks() {
        for (int count = 0; count < callbackQuota; count++) {
            QueueEntry callback = callbacks.poll();
            if (callback == null) {
                callbackQuota = quota;
                return false;
            }
            serveOne(callback);
        }
        return true;
    }

    /**
     * How many callbacks of a space precede its messages, for messages that came from the inbox while other entries
     * were queued. Messages and callbacks are numbered from the creation of the space. On the space's thread.
     */
    private static final class Precedence {
        private static final int FEW = 16;

        private long[] messages = new long[FEW]; // ascending, like the callbacks
        private long[] callbacks = new long[FEW];
        private int first;
        private int end;
        private long newest;
        private long passed;

        /** Records that this number of callbacks precedes the message with that number, and all later messages. */
        void note(long message, long callbacksBefore, long messagesTaken) {
            if (callbacksBefore == newest) {
                return; // the same as for the message before
            }
            if (end == messages.length) {
                makeRoom(messagesTaken);
            }
            messages[end] = message;
            callbacks[end] = callbacksBefore;
            end++;
            newest = callbacksBefore;
        }

        /**
         * The number of callbacks that precede the message with that number; to be called with ascending numbers only.
         */
        long callbacksBefore(long message) {
            while (first < end && messages[first] <= message) {
                passed = callbacks[first++];
            }
            return passed;
        }

        private void makeRoom(long messagesTaken) {
            callbacksBefore(messagesTaken);
            int size = end - first;
            int length = Math.max(FEW, 2 * size);
            long[] freshCallbacks = Arrays.copyOf(Arrays.copyOfRange(callbacks, first, end), length);
            messages = Arrays.copyOf(Arrays.copyOfRange(messages, first, end), length);
            callbacks = freshCallbacks;
            first = 0;
            end = size;
        }
    }
}
