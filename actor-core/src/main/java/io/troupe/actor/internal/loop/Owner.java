package io.troupe.actor.internal.loop;

import java.util.List;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * Identifies on whose behalf code runs in a home: one incarnation of an actor, or the home itself. Internal to this
 * library.
 *
 * <p><b>Threads.</b> {@link #end} on the home's thread, the rest on any thread.
 */
public class Owner {
    private final Home home;
    private final boolean outside;
    private volatile boolean over;
    private @Nullable OpenRequests openRequests; // guarded by this; most owners have none

    protected Owner(Home home) {
        this(home, false);
    }

    Owner(Home home, boolean outside) {
        this.home = home;
        this.outside = outside;
    }

    public final Home home() {
        return home;
    }

    /** True for the owner that stands for threads outside every home; their listeners run on this home. */
    public final boolean isOutside() {
        return outside;
    }

    /** Ends this owner: its listeners are cancelled, and no callback runs for it any more. */
    protected void end() {
        over = true;
    }

    public final boolean isOver() {
        return over;
    }

    /** The requests of this owner that have begun and are not settled; the list is created if there is none. */
    public final synchronized OpenRequests openRequests(Supplier<? extends OpenRequests> create) {
        OpenRequests known = openRequests;
        return known == null ? openRequests = create.get() : known;
    }

    /** Removes and returns the requests that have begun and are not settled, in the order in which they began. */
    protected final List<? extends Node> takeOpenRequests() {
        OpenRequests known;
        synchronized (this) {
            known = openRequests;
        }
        return known == null ? List.of() : known.takeAll();
    }

    @Override
    public String toString() {
        return home.toString();
    }

    /** Requests that have begun and are not settled; the promises keep this list. */
    public interface OpenRequests {
        /** Removes and returns the requests, in the order in which they began. */
        List<? extends Node> takeAll();
    }
}
