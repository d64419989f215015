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
     * @param entry whether it is the space's own business, no call of an actor
     */
    record Task(boolean mail, boolean entry, Runnable action) {
        static Task callback(Runnable action) {
            return new Task(false, false, action);
        }

        static Task entry(Runnable action) {
            return new Task(true, true, action);
        }
    }

    /** When an actor that failed or stopped itself comes to its end. */
    enum End {
        /** At the end of the turn in which that happened, before anything else. */
        WITH_ITS_TURN,
        /** After the callbacks that already wait. */
        BEHIND_CALLBACKS
    }

    final History history = new History();
    final ModelTimers timers = new ModelTimers();
    final ModelRejections rejections = new ModelRejections(this);
    final Set<ModelActor> living = new LinkedHashSet<>();
    private final End end;
    private final List<Task> inbox = new ArrayList<>();
    private final List<Task> callbacks = new ArrayList<>();
    private final List<Task> mails = new ArrayList<>();
    private final List<Runnable> ends = new ArrayList<>();
    private final List<Runnable> idle = new ArrayList<>();
    boolean inside;
    boolean closing;
    boolean closed;
    int pendingDelays;
    ModelActor.@Nullable Instance current;

    ModelSpace(End end) {
        this.end = end;
    }

    void enqueue(Task task) {
        if (inside) {
            (task.mail ? mails : callbacks).add(task);
        } else {
            inbox.add(task);
        }
    }

    void atTheEnd(Runnable action) {
        if (end == End.WITH_ITS_TURN) {
            ends.add(action);
        } else {
            callbacks.add(new Task(false, true, action));
        }
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

    void crank() {
        inside = true;
        boolean working = true;
        while (working) {
            working = pass();
            rejections.report();
            if (inbox.isEmpty() && callbacks.isEmpty() && mails.isEmpty() && !timers.isDue()) {
                working |= !idle.isEmpty();
                var now = List.copyOf(idle);
                idle.clear();
                now.forEach(each -> turn(() -> guarded(each)));
            } else {
                working = true;
            }
        }
        inside = false;
    }

    private boolean pass() {
        boolean worked = false;
        for (int i = 0; i < QUOTA && !inbox.isEmpty(); i++) {
            Task task = inbox.removeFirst();
            worked = true;
            if (callbacks.isEmpty() && mails.isEmpty()) {
                turn(task.action);
            } else {
                (task.mail ? mails : callbacks).add(task);
            }
        }
        for (int i = 0; i < QUOTA && !(callbacks.isEmpty() && mails.isEmpty()); i++) {
            worked = true;
            for (int k = 0; k < QUOTA && !callbacks.isEmpty(); k++) {
                turn(callbacks.removeFirst().action);
            }
            if (!mails.isEmpty()) {
                turn(mails.removeFirst().action);
            }
        }
        return timers.runDue(this::turn) || worked;
    }

    private void turn(Runnable action) {
        as(null, action);
        while (!ends.isEmpty()) {
            ends.removeFirst().run();
        }
    }

    /** After a crank, so that nothing waits. */
    void close() {
        closing = true;
        inside = true;
        if (pendingDelays > 0) {
            history.unsettled();
        }
        List.copyOf(living).forEach(ModelActor::stop);
        closed = true;
        while (!(callbacks.isEmpty() && mails.isEmpty())) {
            Task task = callbacks.isEmpty() ? mails.removeFirst() : callbacks.removeFirst();
            if (task.entry) {
                history.add("dead letter a task to space: closed");
            } else {
                turn(task.action);
            }
        }
        rejections.reportAll();
        inside = false;
    }
}
