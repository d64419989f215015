package io.troupe.actor.model;

import java.util.ArrayList;
import java.util.IdentityHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import org.jspecify.annotations.Nullable;

/** The queues of a space, as lists, and the order in which they are drained. */
final class ModelSpace {
    private static final int QUOTA = 256;

    final History history = new History();
    final ModelTimers timers = new ModelTimers();
    final ModelRejections rejections = new ModelRejections(this);
    final Set<ModelActor> living = new LinkedHashSet<>();
    private final List<ModelTask> inbox = new ArrayList<>();
    private final List<ModelTask> callbackInbox = new ArrayList<>();
    private final List<ModelTask> callbacks = new ArrayList<>();
    private final List<ModelTask> messages = new ArrayList<>();
    private final Map<ModelTask, ModelTask> lastCallbackBefore = new IdentityHashMap<>();
    private int owed = QUOTA;
    private final List<Runnable> ends = new ArrayList<>();
    private final List<Runnable> idle = new ArrayList<>();
    private final List<Runnable> detached = new ArrayList<>();
    boolean inside;
    boolean closing;
    boolean stopping;
    boolean closed;
    ModelActor.@Nullable Instance current;

    void enqueue(ModelTask task) {
        if (inside) {
            (task.message() ? messages : callbacks).add(task);
            return;
        }
        addFromOutside(task);
        if (closed) {
            inside = true;
            refuseAll();
            rejections.report();
            inside = false;
        }
    }

    private void addFromOutside(ModelTask task) {
        (task.message() ? inbox : callbackInbox).add(task);
    }

    /** Queues a callback behind those of other threads, even if called inside. */
    void enqueueBehind(ModelTask task) {
        if (inside) {
            addFromOutside(task);
        } else {
            enqueue(task);
        }
    }

    /** A task of the user, without an alternative for a closed space. */
    void execute(Runnable action) {
        enqueue(ModelTask.entry(action, this::refuseTask));
    }

    private void refuseTask() {
        history.add("dead letter a task to space: closed");
    }

    /** When the current turn is over, before anything else. */
    void afterTurn(Runnable action) {
        ends.add(action);
    }

    void whenIdle(Runnable action) {
        idle.add(action);
    }

    /** Runs an action on behalf of an instance, or of no actor. */
    void as(ModelActor.@Nullable Instance who, Runnable action) {
        var before = current;
        current = who;
        action.run();
        current = before;
    }

    /** Runs an action that belongs to no actor; what it throws is reported. */
    void guarded(Runnable action) {
        try {
            action.run();
        } catch (History.Boom boom) {
            history.add("failed space " + boom.getMessage());
        }
    }

    /** Runs a listener without a space, notified outside: one after the other, never nested. */
    void runDetached(Runnable listener) {
        detached.add(listener);
        if (detached.size() == 1) {
            while (!detached.isEmpty()) {
                detached.getFirst().run();
                detached.removeFirst();
            }
        }
    }

    void crank() {
        inside = true;
        boolean working = !closed;
        while (working && !stopping) {
            working = pass();
            rejections.report();
            if (somethingWaits() || timers.isDue()) {
                working = true;
            } else if (!stopping) {
                working |= runIdle();
            }
        }
        if (stopping && !closed) {
            shut();
        }
        inside = false;
    }

    private boolean somethingWaits() {
        return !(inbox.isEmpty() && callbackInbox.isEmpty() && callbacks.isEmpty() && messages.isEmpty());
    }

    private boolean runIdle() {
        var now = List.copyOf(idle);
        idle.clear();
        now.forEach(each -> turn(() -> guarded(each)));
        return !now.isEmpty();
    }

    private boolean pass() {
        boolean worked = drainInbox(true);
        worked |= drainQueues();
        return !stopping && timers.runDue(this::turn) || worked;
    }

    private boolean drainInbox(boolean withCallbacks) {
        boolean worked = takeCallbacks();
        for (int i = 0; i < QUOTA && !stopping && !inbox.isEmpty(); i++) {
            takeCallbacks();
            ModelTask lastBefore = callbacks.isEmpty() ? null : callbacks.getLast();
            while (withCallbacks && owed > 1 && !callbacks.isEmpty() && !stopping) {
                owed--;
                turn(callbacks.removeFirst().action());
                worked = true;
            }
            if (stopping) {
                break;
            }
            ModelTask message = inbox.removeFirst();
            worked = true;
            if (callbacks.isEmpty() && messages.isEmpty()) {
                owed = QUOTA;
                turn(message.action());
            } else {
                messages.add(message);
                if (lastBefore != null) {
                    lastCallbackBefore.put(message, lastBefore);
                }
            }
        }
        return worked;
    }

    /** Callbacks from outside do not wait for messages. */
    private boolean takeCallbacks() {
        boolean worked = !callbackInbox.isEmpty();
        callbacks.addAll(callbackInbox);
        callbackInbox.clear();
        return worked;
    }

    /**
     * After the quota of callbacks one message runs, unless a callback that came before it is left. Then the other
     * queues get their turn.
     */
    private boolean drainQueues() {
        boolean worked = false;
        for (int i = 0; i < QUOTA && !stopping; i++) {
            takeCallbacks();
            if (callbacks.isEmpty() && messages.isEmpty()) {
                break;
            }
            worked = true;
            int limit = Math.min(QUOTA, owed);
            owed = QUOTA;
            int served = 0;
            while (served < limit && !callbacks.isEmpty() && !stopping) {
                turn(callbacks.removeFirst().action());
                served++;
            }
            if (served == limit && messages.isEmpty()) {
                drainInbox(false);
            }
            if (!messages.isEmpty() && !stopping) {
                int before = callbacksBefore(messages.getFirst());
                if (before > 0) {
                    owed = before;
                    return true;
                }
                turn(messages.removeFirst().action());
            }
            if (served == limit) {
                return true;
            }
        }
        return worked;
    }

    private int callbacksBefore(ModelTask message) {
        ModelTask last = lastCallbackBefore.get(message);
        for (int index = 0; index < callbacks.size(); index++) {
            if (callbacks.get(index) == last) {
                return index + 1;
            }
        }
        return 0;
    }

    private void turn(Runnable action) {
        as(null, action);
        while (!ends.isEmpty()) {
            ends.removeFirst().run();
        }
    }

    /** Processing ends with the turn of the entry that this queues; a caller outside waits for it. */
    void close() {
        if (!closing) {
            closing = true;
            Runnable stop = () -> stopping = true;
            enqueue(ModelTask.entry(stop, stop));
        }
        if (!inside) {
            crank();
        }
    }

    private void shut() {
        List.copyOf(living).forEach(ModelActor::stop);
        timers.clear();
        closed = true;
        idle.forEach(each -> refuseTask());
        idle.clear();
        refuseAll();
        rejections.reportAll();
    }

    private void refuseAll() {
        while (somethingWaits()) {
            var inside = callbacks.isEmpty() ? messages : callbacks;
            var outside = callbackInbox.isEmpty() ? inbox : callbackInbox;
            ModelTask task = (inside.isEmpty() ? outside : inside).removeFirst();
            turn(task.ifClosed() == null ? task.action() : task.ifClosed());
        }
    }
}
