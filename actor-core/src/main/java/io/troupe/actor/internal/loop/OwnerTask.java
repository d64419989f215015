package io.troupe.actor.internal.loop;

import org.jspecify.annotations.Nullable;

/**
 * A callback that runs a task on behalf of an owner, unless the owner or its home has ended. Internal to this library.
 */
public final class OwnerTask extends QueueEntry {
    private final TurnOwner owner;
    private final Runnable task;

    private OwnerTask(TurnOwner owner, Runnable task) {
        this.owner = owner;
        this.task = task;
    }

    /** Queues a task, from any thread. */
    public static void enqueue(TurnOwner owner, Runnable task) {
        owner.home().enqueue(new OwnerTask(owner, task));
    }

    @Override
    protected @Nullable QueueEntry serve() {
        if (!owner.home().isEnding()) {
            owner.run("a listener", task);
        }
        return null;
    }
}
