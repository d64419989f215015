package io.troupe.actor;

import io.troupe.actor.promise.Node;

/** Something to do on a space's thread that is no call of an actor. */
final class Entry extends Node {
    private final Runnable task;
    private final boolean mail;

    private Entry(Runnable task, boolean mail) {
        this.task = task;
        this.mail = mail;
    }

    /** In its turn among the mails. */
    Entry(Runnable task) {
        this(task, true);
    }

    /** Among the callbacks: before the mails that wait. */
    static Entry urgent(Runnable task) {
        return new Entry(task, false);
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
