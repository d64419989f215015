package io.troupe.actor;

import io.troupe.actor.promise.Node;
import io.troupe.actor.promise.NodeQueue;
import io.troupe.actor.time.Clock;
import io.troupe.actor.time.TimerWheel;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.List;
import java.util.Objects;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * The queues of a space and the order in which they are served; on the space's thread, but for the inboxes and
 * {@link #served}.
 *
 * <p><b>Order.</b> Entries from outside wait in two inboxes, entries from inside in two rings: callbacks and mails.
 * Before each mail the inbox of callbacks is looked at, and what is there joins the ring of callbacks: an answer of
 * another space does not wait for mails, and no mail overtakes a callback that its sender queued before it. A mail from
 * the inbox runs at once only if both rings are empty, else it queues up behind them; so calls of one sender to one
 * receiver keep their order. A request whose answer has one listener hands that on: it is served next, as it would be
 * from its ring. Callbacks come before mails, those of the inbox too, but after {@value #QUOTA} in a row (and one that
 * was handed on) one mail, the inbox and the timers have their turn; a mail from the inbox only if no callback is left
 * that came before it. What an entry asked for {@link #afterTurn} comes before everything else.
 *
 * <p>Timers have their turn after each pass, and within it after {@value #STRIDE} mails, or after each mail while mails
 * take longer than a millisecond. By a clock that is moved by hand no timer is ever late, so there the end of the pass
 * is soon enough.
 */
final class Dispatcher {
    private static final int QUOTA = 256;
    private static final int RENEWAL = (1 << 10) - 1;
    private static final int STRIDE = 16;
    private static final long LONG_STRIDE_NANOS = 1_000_000;
    private static final int SPINS = 1_000;

    final NodeQueue inbox;
    final NodeQueue callbackInbox;
    final TimerWheel timers;
    private final SpaceHome space;
    private final Clock clock;
    private final Consumer<Runnable> runTask = this::runTask; // made once: a pass must not need memory
    private final NodeRing callbacks;
    private final NodeRing mails;
    private final Precedence precedence = new Precedence();
    private final ArrayDeque<Runnable> afterTurn = new ArrayDeque<>();
    private final List<Runnable> idleActions = new ArrayList<>();
    private final Progress direct = new Progress(); // of what was served and in no ring
    private int passes;
    private boolean turnLeavesWork;
    private int quota = QUOTA;
    private int callbackQuota = QUOTA; // less amid a row of callbacks, or if a mail waits for that many only
    private int stride = STRIDE;
    private long lastLookNanos;

    Dispatcher(
            SpaceHome space,
            NodeQueue inbox,
            NodeQueue callbackInbox,
            NodeRing callbacks,
            NodeRing mails,
            TimerWheel timers,
            Clock clock) {
        this.space = space;
        this.inbox = inbox;
        this.callbackInbox = callbackInbox;
        this.callbacks = callbacks;
        this.mails = mails;
        this.timers = timers;
        this.clock = clock;
    }

    /** Serves nothing more after the present turn. */
    void halt() {
        quota = 0;
        callbackQuota = 0;
    }

    /** Runs an action when the entry that is being served has returned. */
    void afterTurn(Runnable action) {
        turnLeavesWork = true;
        afterTurn.add(action);
    }

    void addIdleAction(Runnable action) {
        idleActions.add(action);
    }

    /** One round through the queues; false if nothing was there to do. */
    boolean pass() {
        if ((++passes & RENEWAL) == 0) {
            renew();
        }
        boolean worked = drainInbox(true);
        worked |= drainRings();
        worked |= quota > 0 && timers.runDue(runTask) > 0;
        if (!worked && space.isCrankedByHand()) { // one with a thread does so before it sleeps
            forgetServed();
        }
        return worked;
    }

    /** Lets go of what was served last; to be called when nothing waits. */
    void forgetServed() {
        inbox.forgetLast();
        callbackInbox.forgetLast();
    }

    /** What is written at every turn must not grow old: see {@link NodeRing#renew}. */
    private void renew() {
        space.renewOwner();
        callbacks.renew();
        mails.renew();
    }

    /** Nothing waits, and no timer is due; between two turns. */
    boolean isQuiet() {
        return callbacks.isEmpty() && mails.isEmpty() && inbox.isEmpty() && callbackInbox.isEmpty() && !timers.isDue();
    }

    /** Whether something has arrived from outside; does not look where other threads write. */
    boolean isReady() {
        return inbox.isReady() || callbackInbox.isReady();
    }

    /** Whether something from outside waits, or is about to. */
    boolean hasArrivals() {
        return !inbox.isEmpty() || !callbackInbox.isEmpty();
    }

    /** Runs what waited for quiet; false if nothing did. */
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

    /** Takes out an entry that will not be served any more; those of the rings are counted as served. */
    @Nullable
    Node pollLeftover() {
        Node node = callbacks.poll();
        if (node == null) {
            node = mails.poll();
        }
        if (node == null) {
            node = callbackInbox.poll();
        }
        return node != null ? node : inbox.poll();
    }

    /** How many entries have been served; from any thread, a little behind. */
    long served() {
        return direct.served() + callbacks.taken() + mails.taken();
    }

    /** How many entries wait; between two turns. Takes time in the number of those from outside. */
    long waiting() {
        return (long) callbacks.size() + mails.size() + inbox.size() + callbackInbox.size();
    }

    /** How many mails wait in front of one; -1 if it is not among the first so many. */
    int mailsBefore(Node mail, int limit) {
        int inside = Math.min(limit, mails.size());
        for (int index = 0; index < inside; index++) {
            if (mails.get(index) == mail) {
                return index;
            }
        }
        int behind = inbox.indexOf(mail, limit - inside);
        return behind < 0 ? -1 : inside + behind;
    }

    /** Whether more entries than that wait. Takes time in the limit. */
    boolean isLongerThan(int limit) {
        int inside = mails.size();
        return inside > limit || inbox.isLongerThan(limit - inside);
    }

    /** Serves an entry and the listener that it hands on. */
    void serve(Node node) {
        Node next = serveOne(node);
        if (next != null) {
            serveNext(next);
        }
    }

    /**
     * The one place where anything that is thrown ends: whatever an entry does, the thread goes on. The entry has been
     * counted before, by its ring or by {@link #direct}, so that one that never ends was seen to begin;
     * {@link Watchdog} looks for this method.
     *
     * @return the listener that it hands on
     */
    private @Nullable Node serveOne(Node node) {
        Node next = null;
        try {
            next = SpaceHome.serveNode(node);
        } catch (Throwable thrown) {
            space.fail(node, thrown);
        }
        if (turnLeavesWork) {
            try {
                endTurn();
            } catch (Throwable noMemoryForTheReport) {
                if (next != null) {
                    space.enqueueCallback(next);
                }
                throw noMemoryForTheReport;
            }
        }
        return next;
    }

    /**
     * The one listener of the answer that was just given, which would have been the next callback in its ring; none
     * follows it this way.
     */
    private void serveNext(Node callback) {
        if (quota == 0) { // the turn has halted this dispatcher
            space.enqueueCallback(callback);
        } else {
            direct.step();
            callbackQuota = quota - 1;
            serveOne(callback);
            if (callbacks.isEmpty() && !callbackInbox.isReady()) {
                callbackQuota = quota; // a mail comes next
            }
        }
    }

    /**
     * Between two mails. Reads the clock only if there are timers: that costs as much as a few messages.
     *
     * @return how many mails later to look again
     */
    private int lookAtTimers() {
        if (!timers.isEmpty() && clock.runsByItself() && quota > 0) {
            long now = clock.nanos();
            stride = now - lastLookNanos > LONG_STRIDE_NANOS ? 1 : Math.min(STRIDE, 2 * stride);
            lastLookNanos = now;
            if (timers.nextDeadline() <= now) {
                timers.runDue(runTask);
            }
        }
        return stride;
    }

    /** A task that is no entry: a timer's, or one that waited for quiet. */
    void runTask(Runnable task) {
        direct.step();
        space.runGuarded(task);
        if (turnLeavesWork) {
            endTurn();
        }
    }

    private void endTurn() {
        turnLeavesWork = false;
        for (Runnable action = afterTurn.poll(); action != null; action = afterTurn.poll()) {
            space.runGuarded(action);
        }
    }

    /**
     * @param withCallbacks whether callbacks may be served between the mails; else the mails behind them join their
     *     ring
     */
    private boolean drainInbox(boolean withCallbacks) {
        boolean worked = takeCallbacks();
        Node last = inbox.beginBatch();
        int untilLook = stride;
        try {
            for (int count = 0; count < quota && inbox.isReadyAfter(last); count++) {
                takeCallbacks(); // among them is what the mail's sender queued before it
                long callbacksBefore = callbacks.added();
                boolean callbacksFirst = withCallbacks && !callbacks.isEmpty();
                if (callbacksFirst) {
                    inbox.endBatch(last); // a callback may look at what waits
                }
                while (withCallbacks && callbackQuota > 1 && !callbacks.isEmpty()) {
                    callbackQuota--;
                    serveOne(Objects.requireNonNull(callbacks.poll()));
                    worked = true;
                }
                if (quota == 0) {
                    break; // a callback has halted this dispatcher
                }
                boolean behind = !callbacks.isEmpty() || !mails.isEmpty();
                if (behind) {
                    mails.makeRoom(); // before the mail is taken: it must not be lost when memory is short
                    precedence.note(mails.added(), callbacksBefore, mails.taken());
                }
                last = inbox.takeAfter(last);
                worked = true;
                if (behind) {
                    mails.add(last);
                } else {
                    if (callbacksFirst) {
                        callbackQuota = quota; // it is their mail that comes now
                    }
                    direct.step();
                    serve(last);
                    if (--untilLook == 0) {
                        inbox.endBatch(last); // a timer's task may look at what waits
                        untilLook = lookAtTimers();
                    }
                }
            }
        } finally {
            inbox.endBatch(last);
        }
        return worked;
    }

    /** Moves the callbacks that have come from outside until now into their ring; false if there were none. */
    private boolean takeCallbacks() {
        Node last = callbackInbox.newest();
        if (last == null) {
            return false;
        }
        for (Node node = null; node != last; ) {
            callbacks.makeRoom();
            node = nextArrival();
            callbacks.add(node);
        }
        return true;
    }

    /** The next callback from outside; one is there, but its sender may be between the two steps of queueing it. */
    private Node nextArrival() {
        for (int look = 0; ; look++) {
            Node node = callbackInbox.poll();
            if (node != null) {
                return node;
            }
            if (look < SPINS) {
                Thread.onSpinWait();
            } else {
                Thread.yield(); // it lost its processor there
            }
        }
    }

    private boolean drainRings() {
        boolean worked = false;
        int untilLook = stride;
        if (callbacks.isEmpty() && !callbackInbox.isReady()) {
            callbackQuota = quota;
        }
        for (int count = 0; count < quota; count++) {
            if (callbackInbox.isReady()) {
                takeCallbacks();
            }
            boolean more = !callbacks.isEmpty() && drainCallbacks();
            Node mail = more ? mailAfterQuota() : mails.poll();
            if (mail != null) {
                serve(mail);
                if (--untilLook == 0) {
                    untilLook = lookAtTimers();
                }
            } else if (callbacks.isEmpty() && !callbackInbox.isReady()) { // a callback may have queued one there
                return worked;
            }
            if (more) {
                return true; // timers and the inbox have their turn, too
            }
            worked = true;
        }
        return worked;
    }

    /** The mail that has its turn though callbacks wait; null if there is none, or if one of them came before it. */
    private @Nullable Node mailAfterQuota() {
        callbackQuota = quota;
        if (mails.isEmpty()) {
            drainInbox(false); // for a mail that waits there
        }
        if (mails.isEmpty() || quota == 0) {
            return null;
        }
        long before = precedence.callbacksBefore(mails.taken()) - callbacks.taken();
        if (before > 0) {
            callbackQuota = (int) Math.min(quota, before);
            return null;
        }
        return mails.poll();
    }

    /** True if there may be more than were served. */
    private boolean drainCallbacks() {
        for (int count = 0; count < callbackQuota; count++) {
            Node callback = callbacks.poll();
            if (callback == null) {
                callbackQuota = quota;
                return false;
            }
            serveOne(callback);
        }
        return true;
    }
}
