package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CyclicBarrier;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

class WhenClosedTest {
    private static final Duration LONG = Duration.ofSeconds(30);

    private final List<String> log = new ArrayList<>();
    private final List<DeadLetter> deadLetters = new ArrayList<>();
    private final ActorSpace space = ActorSpace.create(SpaceSettings.named("short-lived")
            .withoutThread()
            .withOnDeadLetter(deadLetters::add)
            .withOnError((where, error) -> log.add(where + ": " + error)));

    /** Records its end. */
    class Resident extends Actor {
        public void greet() {
            log.add("greeted");
        }

        @Override
        protected void stopped() {
            log.add("actor stopped");
        }
    }

    @Test
    void whenClosed_isFulfilledAfterTheActorsHaveStopped_onTheSpacesThread() {
        var resident = space.spawn(Resident.class, Resident::new);
        var closed = space.whenClosed();
        closed.thenRun(() -> log.add("closed, on " + ActorSpace.current()));
        resident.greet();
        space.runQueued();
        assertThat(closed.isDone()).isFalse();
        space.close();
        assertThat(log).containsExactly("greeted", "actor stopped", "closed, on short-lived");
        assertThat(space.whenClosed().isDone()).as("of a space that is closed").isTrue();
    }

    @Test
    void whenClosed_canBeCancelledByOneWatcher_andTheOthersAreStillNotified() {
        var mine = space.whenClosed();
        var others = space.whenClosed();
        mine.cancel();
        space.close();
        assertThat(mine.isCancelled()).isTrue();
        assertThat(others.isDone() && !others.isRejected()).isTrue();
    }

    @Test
    @Timeout(60)
    void close_onTheThreadOfAnotherSpace_doesNotWait() throws Exception {
        var left = ActorSpace.create(SpaceSettings.named("left"));
        var right = ActorSpace.create(SpaceSettings.named("right"));
        var bothHold = new CyclicBarrier(2);
        var fromLeft = new Deferred<String>();
        var fromRight = new Deferred<String>();
        left.execute(() -> closeWhileTheOtherCloses(bothHold, right, fromLeft));
        right.execute(() -> closeWhileTheOtherCloses(bothHold, left, fromRight));
        assertThat(fromLeft.get(LONG)).contains("close(PT1S) of space right would stop space left", "whenClosed()");
        assertThat(fromRight.get(LONG)).contains("close(PT1S) of space left would stop space right");
        left.whenClosed().get(LONG);
        right.whenClosed().get(LONG);
    }

    /** Both threads are blocked until both have called close(); waiting would deadlock them. */
    private static void closeWhileTheOtherCloses(CyclicBarrier bothHold, ActorSpace other, Deferred<String> told) {
        try {
            bothHold.await();
            try {
                other.close(Duration.ofSeconds(1));
            } catch (IllegalStateException refused) {
                told.resolve(String.valueOf(refused.getMessage()));
            }
            other.close();
            bothHold.await();
        } catch (Exception broken) {
            told.reject(broken);
        }
    }

    @Test
    void watcher_mayCallStoppedActors_andIsTurnedAway() {
        var resident = space.spawn(Resident.class, Resident::new);
        space.whenClosed().thenRun(() -> {
            resident.greet();
            space.execute(() -> log.add("never"));
        });
        space.close();
        assertThat(log).containsExactly("actor stopped");
        assertThat(deadLetters).hasSize(2);
        assertThat(space.isQuiet()).isTrue();
    }
}
