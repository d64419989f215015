package io.troupe.actor.model;

import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;
import org.jspecify.annotations.Nullable;

/** The queues of a space, as lists, and who is served when. */
final class ModelSpace {
    private static final int QUOTA = 256;

    /**
     * Something that waits.
     *
     * @param mail whether it waits in a mailbox or in a callback queue
     * @param ifClosed what happens instead when serving has ended; null = the same
     */
    record Task(boolean mail, Runnable action, @Nullable Runnable ifClosed) {
        static Task callback(Runnable action) {
            return new Task(false, action, null);
        }

        static Task call(Runnable action) {
            return new Task(true, action, null);
        }

        /** The space's own business, no call of an actor. */
        static Task entry(Runnable action, Runnable ifClosed) {
            return new Task(true, action, ifClosed);
        }
    }

    final History history = new History();
    final ModelTimers timers = new ModelTimers();
    final ModelRejections rejections = new ModelRejections(this);
    final Set<ModelActor> living = new LinkedHashSet<>();
    private final List<Task> inbox = new ArrayList<>();
    private final List<Task> callbacks = new ArrayList<>();
    private final List<Task> mails = new ArrayList<>();
    private final List<Runnable> ends = new ArrayList<>();
    private final List<Runnable> idle = new ArrayList<>();
    private final List<Runnable> detached = new ArrayList<>();
    boolean inside;
    boolean closing;
    boolean stopping;
    boolean closed;
    ModelActor.@Nullable Instance current;

    void enqueue(Task task) {
        if (inside) {
            (task.mail ? mails : callbacks).add(task);
            return;
        }
        inbox.add(task);
        if (closed) {
            inside = true;
            refuseAll();
            inside = false;
        }
    }

    /** A task of the user's; nobody has thought of what becomes of it if the space is closed. */
    void execute(Runnable action) {
        enqueue(Task.entry(action, this::refuseTask));
    }

    private void refuseTask() {
        history.add("dead letter a task to space: closed");
    }

    /** When the present turn is over, before anything else. */
    void afterTurn(Runnable action) {
        ends.add(action);
    }

    void whenIdle(Runnable action) {
        idle.add(action);
    }

    /** Runs something on behalf of an instance, or of nobody. */
    void as(ModelActor.@Nullable Instance who, Runnable action) {
        var before = current;
        current = who;
        action.run();
        current = before;
    }

    /** What a script without an actor throws. */
    void guarded(Runnable action) {
        try {
            action.run();
        } catch (History.Boom boom) {
            history.add("failed space " + boom.getMessage());
        }
    }

    /** A listener that belongs to no space, told outside: one after the other, never one in another. */
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
            if (!inbox.isEmpty() || !callbacks.isEmpty() || !mails.isEmpty() || timers.isDue()) {
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

    private boolean runIdle() {
        var now = List.copyOf(idle);
        idle.clear();
        now.forEach(each -> turn(() -> guarded(each)));
        return !now.isEmpty();
    }

    private boolean pass() {
        boolean worked = false;
        for (int i = 0; i < QUOTA && !stopping && !inbox.isEmpty(); i++) {
            Task task = inbox.removeFirst();
            worked = true;
            if (callbacks.isEmpty() && mails.isEmpty()) {
                turn(task.action);
            } else {
                (task.mail ? mails : callbacks).add(task);
            }
        }
        for (int i = 0; i < QUOTA && !stopping && !(callbacks.isEmpty() && mails.isEmpty()); i++) {
            worked = true;
            for (int k = 0; k < QUOTA && !callbacks.isEmpty(); k++) {
                turn(callbacks.removeFirst().action);
            }
            if (!mails.isEmpty()) {
                turn(mails.removeFirst().action);
            }
        }
        return !stopping && timers.runDue(this::turn) || worked;
    }

    private void turn(Runnable action) {
        as(null, action);
        while (!ends.isEmpty()) {
            ends.removeFirst().run();
        }
    }

    /** Serving ends with the turn of the entry that this queues; outside, that is waited for. */
    void close() {
        if (!closing) {
            closing = true;
            Runnable stop = () -> stopping = true;
            enqueue(Task.entry(stop, stop));
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
        while (!(callbacks.isEmpty() && mails.isEmpty() && inbox.isEmpty())) {
            var first = !callbacks.isEmpty() ? callbacks : !mails.isEmpty() ? mails : inbox;
            Task task = first.removeFirst();
            turn(task.ifClosed == null ? task.action : task.ifClosed);
        }
    }
}
