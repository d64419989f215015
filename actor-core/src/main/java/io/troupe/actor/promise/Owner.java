package io.troupe.actor.promise;

import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * Identifies on whose behalf code runs in a home: one incarnation of an actor, or the home itself.
 *
 * <p><b>Role.</b> Internal to this library. <b>Threads.</b> {@link #end} on the home's thread, {@link #isOver} on any
 * thread.
 *
 * @hidden
 */
public class Owner {
    private static final int FEW = 8;

    private final Home home;
    private final boolean outside;
    private volatile boolean over;
    private @Nullable OpenRequest oldest; // guarded by this, as is the rest of the list
    private @Nullable OpenRequest newest;
    private int openAnswers;
    private int sweepAt = FEW;

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

    /** True for the owner that stands for threads outside every home; their listeners run on this home. */
    final boolean isOutside() {
        return outside;
    }

    /** Ends this owner: its listeners are cancelled, and no callback runs for it any more. */
    protected void end() {
        over = true;
    }

    public final boolean isOver() {
        return over;
    }

    /**
     * Adds a request that has begun and is not settled. Cancelled requests are removed whenever the number has doubled.
     */
    final synchronized void open(OpenRequest answer) {
        if (openAnswers >= sweepAt) {
            OpenRequest next;
            for (OpenRequest each = oldest; each != null; each = next) {
                next = each.after;
                if (each.isIdle()) {
                    unlink(each);
                }
            }
            sweepAt = Math.max(FEW, 2 * openAnswers);
        }
        answer.listed = true;
        answer.before = newest;
        if (newest == null) {
            oldest = answer;
        } else {
            newest.after = answer;
        }
        newest = answer;
        openAnswers++;
    }

    /** Called before a request is settled; any thread. */
    final synchronized void close(OpenRequest answer) {
        if (answer.listed) {
            unlink(answer);
        }
    }

    private void unlink(OpenRequest answer) {
        OpenRequest before = answer.before;
        OpenRequest after = answer.after;
        if (before == null) {
            oldest = after;
        } else {
            before.after = after;
        }
        if (after == null) {
            newest = before;
        } else {
            after.before = before;
        }
        answer.before = null;
        answer.after = null;
        answer.listed = false;
        openAnswers--;
    }

    /** Removes and returns the requests that have begun and are not settled, in the order in which they began. */
    protected final synchronized List<Promise<?>> takeOpenRequests() {
        var requests = new ArrayList<Promise<?>>(openAnswers);
        while (oldest != null) {
            requests.add((Promise<?>) oldest.promise);
            unlink(oldest);
        }
        return requests;
    }

    @Override
    public String toString() {
        return home.toString();
    }

    /**
     * Settles a request with the outcome of the promise that its method returned. Until then it is in the list of the
     * {@link Owner} that runs the request, and that owner rejects the request if it ends first.
     *
     * <p><b>Threads.</b> The links are guarded by the owner, because the promise may be settled on any thread.
     */
    static final class OpenRequest extends Follower {
        private final Owner owner;
        boolean listed;

        @Nullable
        OpenRequest before;

        @Nullable
        OpenRequest after;

        OpenRequest(Settleable<?> request, Owner owner) {
            super(request);
            this.owner = owner;
        }

        @Override
        void beforeSettling() {
            owner.close(this);
        }
    }
}
