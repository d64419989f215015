package io.troupe.actor;

import io.troupe.actor.promise.Node;
import org.jspecify.annotations.Nullable;

/** Something to do on a space's thread that is no call of an actor. */
final class Entry extends Node {
    private final Runnable task;
    private final @Nullable Runnable ifClosed;
    private final boolean mail;

    private Entry(Runnable task, @Nullable Runnable ifClosed, boolean mail) {
        this.task = task;
        this.ifClosed = ifClosed;
        this.mail = mail;
    }

    /** In its turn among the mails. */
    Entry(Runnable task) {
        this(task, null, true);
    }

    /** In its turn among the mails; if the space is closed before, the other task runs instead. */
    Entry(Runnable task, Runnable ifClosed) {
        this(task, ifClosed, true);
    }

    /** Among the callbacks: before the mails that wait; if the space is closed before, the other task runs instead. */
    static Entry urgent(Runnable task, Runnable ifClosed) {
        return new Entry(task, ifClosed, false);
    }

    /** What to do when the space has been closed, or null if nobody has thought of it. */
    @Nullable
    Runnable ifClosed() {
        return ifClosed;
    }

    @Override
    protected void run() {
        task.run();
    }

    @Override
    protected boolean isMail() {
        return mail;
    }
}
