package io.troupe.actor;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.concurrent.CancellationException;
import org.jspecify.annotations.Nullable;

/** A promise that is fulfilled by a timer; cancelling it cancels the timer. */
final class Delay {
    private final Deferred<@Nullable Void> over;
    private volatile @Nullable Runnable withdraw;

    private Delay(ActorSpace space) {
        over = space.deferred(this::withdraw);
    }

    static Promise<@Nullable Void> start(ActorSpace space, Duration duration) {
        var delay = new Delay(space);
        delay.withdraw = space.schedule(
                SpaceHome.countedNanos(duration),
                () -> delay.over.resolve(null),
                () -> delay.over.reject(new CancellationException(
                        "space " + space + " was closed before the delay of " + duration + " was over")));
        return delay.over;
    }

    private void withdraw() {
        Runnable timer = withdraw;
        if (timer != null) {
            timer.run();
        }
    }
}
