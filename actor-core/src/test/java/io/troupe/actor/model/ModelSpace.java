package io.troupe.actor.model;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.IdentityHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import org.jspecify.annotations.Nullable;

/** The queues of a space, as lists, and the order in which they are drained; its timers, and lost rejections. */
final class ModelSpace {
    private static final int QUOTA = 256;
    private static final int GRACE_TICKS = 2_000;

    /**
     * A queued entry.
     *
     * @param message true if it is a message, false if it is a callback
     * @param ifClosed what runs instead after the space has stopped
     */
    record Task(boolean message, boolean onlyListener, Runnable action, Runnable ifClosed) {
        static Task callback(Runnable action) {
            return new Task(false, false, action, action);
        }

        /** The only listener of a request, which was answered just now. */
        static Task onlyListener(Runnable action) {
            return new Task(false, true, action, action);
        }

        static Task call(Runnable action) {
            return new Task(true, false, action, action);
        }

        /** A task of the space itself, not a call of an actor. */
        static Task entry(Runnable action, Runnable ifClosed) {
            return new Task(true, false, action, ifClosed);
        }
    }

    final History history = new History();
    final Set<ModelRun.ModelActor> living = new LinkedHashSet<>();
    private final List<Timer> timers = new ArrayList<>();
    private final List<ModelPromise> lost = new ArrayList<>();
    private final List<ModelPromise> held = new ArrayList<>();
    private final List<Task> inbox = new ArrayList<>();
    private final List<Task> callbackInbox = new ArrayList<>();
    private final List<Task> callbacks = new ArrayList<>();
    private final List<Task> messages = new ArrayList<>();
    private final Map<Task, Task> lastCallbackBefore = new IdentityHashMap<>();
    private int owed = QUOTA;
    final List<Runnable> ends = new ArrayList<>(); // run when the current turn is over, before anything else
    final List<Runnable> idle = new ArrayList<>();
    private final List<Runnable> detached = new ArrayList<>();
    boolean inside;
    boolean closing;
    boolean stopping;
    boolean closed;
    ModelRun.@Nullable Instance current;
    long now;

    void enqueue(Task task) {
        if (inside) {
            (task.message() ? messages : callbacks).add(task);
            return;
        }
        addFromOutside(task);
        if (closed) {
            inside = true;
            refuseAll();
            reportRejections();
            inside = false;
        }
    }

    private void addFromOutside(Task task) {
        (task.message() ? inbox : callbackInbox).add(task);
    }

    /** Queues a callback behind those of other threads, even if called inside. */
    void enqueueBehind(Task task) {
        if (inside) {
            addFromOutside(task);
        } else {
            enqueue(task);
        }
    }

    /** Queues a callback behind those that have arrived from other threads, which are taken first if called inside. */
    void enqueueBehindArrivals(Task task) {
        if (inside) {
            takeCallbacks();
        }
        enqueue(task);
    }

    /** A task of the user, without an alternative for a closed space. */
    void execute(Runnable action) {
        enqueue(Task.entry(action, this::refuseTask));
    }

    private void refuseTask() {
        history.add("dead letter a task to space: closed");
    }

    /** Runs an action on behalf of an instance, or of no actor. */
    void as(ModelRun.@Nullable Instance who, Runnable action) {
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

    void runQueued() {
        inside = true;
        boolean working = !closed;
        while (working && !stopping) {
            working = pass();
            reportRejections();
            if (somethingWaits() || !timersDueBy(now).isEmpty()) {
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
        return !stopping && runTimers() || worked;
    }

    private boolean drainInbox(boolean withCallbacks) {
        boolean worked = takeCallbacks();
        for (int i = 0; i < QUOTA && !stopping && !inbox.isEmpty(); i++) {
            takeCallbacks();
            Task lastBefore = callbacks.isEmpty() ? null : callbacks.getLast();
            while (withCallbacks && owed > 1 && !callbacks.isEmpty() && !stopping) {
                owed--;
                turn(callbacks.removeFirst().action());
                worked = true;
            }
            if (stopping) {
                break;
            }
            Task message = inbox.removeFirst();
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
                boolean isNext = callbacks.isEmpty();
                turn(messages.removeFirst().action());
                if (isNext && callbacks.size() == 1 && callbacks.getFirst().onlyListener() && !stopping) {
                    turn(callbacks.removeFirst().action()); // in the pass of the request that it listens to
                    owed = callbacks.isEmpty() ? QUOTA : QUOTA - 1;
                }
            }
            if (served == limit) {
                return true;
            }
        }
        return worked;
    }

    private int callbacksBefore(Task message) {
        Task last = lastCallbackBefore.get(message);
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
            enqueue(Task.entry(stop, stop));
        }
        if (!inside) {
            runQueued();
        }
    }

    private void shut() {
        List.copyOf(living).forEach(ModelRun.ModelActor::stop);
        var dropped = timersDueBy(Long.MAX_VALUE);
        dropped.forEach(Timer::cancel);
        dropped.forEach(each -> each.ifClosed.run());
        closed = true;
        idle.forEach(each -> refuseTask());
        idle.clear();
        refuseAll();
        lost.addAll(held);
        held.clear();
        reportRejections();
    }

    private void refuseAll() {
        while (somethingWaits()) {
            var inside = callbacks.isEmpty() ? messages : callbacks;
            var outside = callbackInbox.isEmpty() ? inbox : callbackInbox;
            Task task = (inside.isEmpty() ? outside : inside).removeFirst();
            turn(task.ifClosed());
        }
    }

    // ---- timers; time is counted in half milliseconds

    static final class Timer {
        private final Runnable task;
        private final Runnable ifClosed;
        private final int period;
        private long deadline;
        private boolean waiting = true;

        Timer(Runnable task, Runnable ifClosed, long deadline, int period) {
            this.task = task;
            this.ifClosed = ifClosed;
            this.deadline = deadline;
            this.period = period;
        }

        boolean cancel() {
            boolean inTime = waiting;
            waiting = false;
            return inTime;
        }
    }

    void begin(Timer timer) {
        timer.deadline = Math.max(now, timer.deadline);
        timers.add(timer);
    }

    /** By deadline, and then in the order in which they were set. */
    private List<Timer> timersDueBy(long until) {
        return timers.stream()
                .filter(each -> each.waiting && each.deadline <= until)
                .sorted(Comparator.comparingLong(each -> each.deadline))
                .toList();
    }

    /** Runs each due timer once. */
    private boolean runTimers() {
        var due = timersDueBy(now);
        for (var timer : due) {
            if (timer.waiting) {
                timer.waiting = timer.period > 0;
                timer.deadline += timer.period;
                turn(timer.task);
            }
        }
        return !due.isEmpty();
    }

    // ---- rejections without a listener

    /** One whose caller is outside is kept for a second before it is reported. */
    void rejected(ModelPromise promise) {
        boolean stopped = String.valueOf(promise.outcome).contains("ActorStopped");
        if (closed && (promise.madeOutside || stopped) || inside && stopping && stopped) {
            return;
        }
        if (!inside) {
            enqueue(Task.entry(() -> rejected(promise), () -> rejected(promise)));
        } else if (promise.madeOutside) {
            held.add(promise);
            Runnable lose = () -> {
                held.remove(promise);
                lost.add(promise);
            };
            begin(new Timer(lose, () -> {}, now + GRACE_TICKS, 0));
        } else {
            lost.add(promise);
        }
    }

    private void reportRejections() {
        var reported = List.copyOf(lost);
        lost.clear();
        for (var promise : reported) {
            if (!promise.heard) {
                history.addUnheard(String.valueOf(promise.outcome).substring(1));
            }
        }
    }
}
