package io.troupe.actor.internal.loop;

import java.util.function.Function;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * Identifies on whose behalf code runs in a home: one incarnation of an actor, or the home itself. Internal to this
 * library.
 *
 * <p><b>Threads.</b> {@link #end}, {@link #endAttachment} and {@link #failed} on the home's thread, the rest on any
 * thread.
 */
public class TurnOwner {
    private final Home home;
    private final boolean outside;
    private volatile boolean over;
    private @Nullable OpenRequests openRequests; // guarded by this; most owners have none
    private volatile @Nullable Attachment attachment; // written under this; most owners have none
    private boolean attachmentEnded; // guarded by this

    protected TurnOwner(Home home) {
        this(home, false);
    }

    TurnOwner(Home home, boolean outside) {
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

    /** Removes and returns the request that has begun first of those that are not settled, or null. */
    protected final @Nullable QueueEntry takeOpenRequest() {
        OpenRequests known;
        synchronized (this) {
            known = openRequests;
        }
        return known == null ? null : known.takeOldest();
    }

    /**
     * What was attached to this owner, created if there is nothing yet; ended immediately after {@link #endAttachment}.
     */
    public final Attachment attachment(Function<? super TurnOwner, ? extends Attachment> create) {
        Attachment known = attachment;
        return known == null ? attach(create) : known;
    }

    private synchronized Attachment attach(Function<? super TurnOwner, ? extends Attachment> create) {
        Attachment known = attachment;
        if (known == null) {
            known = create.apply(this);
            attachment = known;
            if (attachmentEnded) {
                known.end();
            }
        }
        return known;
    }

    /** Ends what is attached, now and later: this owner has ended, and its open requests were rejected. */
    public final void endAttachment() {
        Attachment known;
        synchronized (this) {
            attachmentEnded = true;
            known = attachment;
        }
        if (known != null) {
            known.end();
        }
    }

    /**
     * Runs a task on behalf of this owner, on the home's thread; what it throws is reported.
     *
     * @return false, without effect, if this owner has ended
     */
    public boolean run(String what, Runnable task) {
        home.runGuarded(task);
        return true;
    }

    /** Reports a failure of work that was done on behalf of this owner. */
    public void failed(String what, Throwable error) {
        throw QueueEntries.rethrow(error);
    }

    /** Called when a listener of this owner has thrown; true if that was reported as a failure of the owner. */
    public boolean listenerFailed(Throwable error) {
        return false;
    }

    @Override
    public String toString() {
        return home.toString();
    }

    /** Something that lives as long as its owner: the scope of its coroutines. */
    public interface Attachment {
        /** Called on the home's thread when the owner has ended. */
        void end();
    }

    /** Requests that have begun and are not settled; the promises keep this list. */
    public interface OpenRequests {
        /** Removes and returns the request that has begun first, or null. */
        @Nullable
        QueueEntry takeOldest();
    }
}
