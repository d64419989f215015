package io.troupe.actor;

import io.troupe.actor.promise.Node;
import io.troupe.actor.promise.NodeQueue;
import io.troupe.actor.time.TimerWheel;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * The queues of a space and the order in which they are served; on the space's thread, but for {@link #inbox} and {@link #served}.
 *
 * <p><b>Order.</b> Entries from outside wait in the inbox, entries from inside in two rings: callbacks and mails. An entry from the inbox
 * runs at once only if both rings are empty, else it queues up behind them; so calls of one sender to one receiver keep their order.
 * Callbacks come before mails, but after {@value #QUOTA} in a row one mail, the inbox and the timers have their turn, so that nobody starves. What an entry asked for
 * {@link #afterTurn} comes before everything else.
 */
final class Dispatcher {
    private static final int QUOTA = 256;
    private static final int RENEWAL = (1 << 10) - 1;

    final NodeQueue inbox;
    final TimerWheel timers;
    private final SpaceHome space;
    private final NodeRing callbacks;
    private final NodeRing mails;
    private final ArrayDeque<Runnable> afterTurn = new ArrayDeque<>();
    private final List<Runnable> idleActions = new ArrayList<>();
    private final Progress progress = new Progress();
    private int passes;
    private boolean turnLeavesWork;
    private int quota = QUOTA;

    Dispatcher(SpaceHome space, NodeQueue inbox, NodeRing callbacks, NodeRing mails, TimerWheel timers) {
        this.space = space;
        this.inbox = inbox;
        this.callbacks = callbacks;
        this.mails = mails;
        this.timers = timers;
    }

    /** Serves nothing more after the present turn. */
    void halt() {
        quota = 0;
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
        boolean worked = drainInbox();
        worked |= drainRings();
        worked |= quota > 0 && timers.runDue(this::runTask) > 0;
        return worked;
    }

    /** What is written at every turn must not grow old: see {@link NodeRing#renew}. */
    private void renew() {
        space.renewOwner();
        callbacks.renew();
        mails.renew();
    }

    /** Nothing waits, and no timer is due; between two turns. */
    boolean isQuiet() {
        return callbacks.isEmpty() && mails.isEmpty() && inbox.isEmpty() && !timers.isDue();
    }

    /** Runs what waited for quiet; false if nothing did. */
    boolean runIdleActions() {
        if (idleActions.isEmpty()) {
            return false;
        }
        takeIdleActions().forEach(this::runTask);
        return true;
    }

    List<Runnable> takeIdleActions() {
        var actions = List.copyOf(idleActions);
        idleActions.clear();
        return actions;
    }

    /** Takes out an entry that will not be served any more. */
    @Nullable
    Node pollLeftover() {
        Node node = callbacks.poll();
        if (node == null) {
            node = mails.poll();
        }
        return node != null ? node : inbox.poll();
    }

    /** How many entries have been served; from any thread, a little behind. */
    long served() {
        return progress.served();
    }

    /** How many entries wait in the rings; those in the inbox are not counted. */
    int inside() {
        return callbacks.size() + mails.size();
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

    /** The one place where anything that is thrown ends: whatever an entry does, the thread goes on. */
    void serve(Node node) {
        progress.step(); // before, so that a message that never ends is one that was seen to begin
        try {
            SpaceHome.runNode(node);
        } catch (Throwable thrown) {
            space.fail(node, thrown);
        }
        if (turnLeavesWork) {
            endTurn();
        }
    }

    /** A task that is no entry: a timer's, or one that waited for quiet. */
    void runTask(Runnable task) {
        progress.step();
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

    private boolean drainInbox() {
        Node last = inbox.beginBatch();
        int count = 0;
        try {
            for (; count < quota; count++) {
                Node node = inbox.takeAfter(last);
                if (node == null) {
                    break;
                }
                last = node;
                if (callbacks.isEmpty() && mails.isEmpty()) {
                    serve(node);
                } else if (SpaceHome.goesToMailbox(node)) {
                    mails.add(node);
                } else {
                    callbacks.add(node);
                }
            }
        } finally {
            inbox.endBatch(last);
        }
        return count > 0;
    }

    private boolean drainRings() {
        boolean worked = false;
        for (int count = 0; count < quota; count++) {
            boolean more = !callbacks.isEmpty() && drainCallbacks();
            Node mail = mails.poll();
            if (mail == null && more) {
                drainInbox(); // for a mail that waits there
                mail = mails.poll();
            }
            if (mail != null) {
                serve(mail);
            } else if (callbacks.isEmpty()) {
                return worked;
            }
            if (more) {
                return true; // timers and the inbox have their turn, too
            }
            worked = true;
        }
        return worked;
    }

    /** True if there may be more than were served. */
    private boolean drainCallbacks() {
        for (int count = 0; count < quota; count++) {
            Node callback = callbacks.poll();
            if (callback == null) {
                return false;
            }
            serve(callback);
        }
        return true;
    }
}
