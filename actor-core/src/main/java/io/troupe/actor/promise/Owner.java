package io.troupe.actor.promise;

/**
 * On whose behalf something runs in a home: one life of an actor, or the home itself.
 *
 * <p><b>Role.</b> For the rooms of this library. <b>Threads.</b> {@link #end} on the home's thread, {@link #isOver} on any.
 */
public class Owner {
    private final Home home;
    private final boolean outside;
    private volatile boolean over;

    protected Owner(Home home) {
        this(home, false);
    }

    Owner(Home home, boolean outside) {
        this.home = home;
        this.outside = outside;
    }

    final Home home() {
        return home;
    }

    /** Whether it stands for threads that are no home at all, and whose listeners this home runs for them. */
    final boolean isOutside() {
        return outside;
    }

    /** Takes no callbacks any more: its listeners are cancelled. */
    protected void end() {
        over = true;
    }

    public final boolean isOver() {
        return over;
    }

    @Override
    public String toString() {
        return home.toString();
    }
}
