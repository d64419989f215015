package io.troupe.actor.promise;

import org.jspecify.annotations.Nullable;

/**
 * Settles a request with the outcome of the promise that its method returned. Until then it is in the list of the
 * {@link Owner} that runs the request, and that owner rejects the request if it ends first.
 *
 * <p><b>Threads.</b> The links are guarded by the owner, because the promise may be settled on any thread.
 */
final class OpenRequest extends Follower {
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
