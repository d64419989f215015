package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** Callbacks come first, but nobody starves. */
class FairnessTest {
    private final TestSpace test = new TestSpace();
    private final List<String> log = new ArrayList<>();
    private int callbacks;

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    /** Sends a message to itself, and hears of others. */
    public static class Worker extends Actor {
        private final FairnessTest outer;

        Worker(FairnessTest outer) {
            this.outer = outer;
        }

        public void poke() {
            outer.log.add("poked after " + outer.callbacks + " callbacks");
        }

        public void startTimer() {
            after(Duration.ofSeconds(1), () -> outer.log.add("timer after " + outer.callbacks + " callbacks"));
        }
    }

    @Test
    void endlessCallbacks_letAMessageOfAnotherThreadIn_after256() {
        Worker worker = test.spawn(Worker.class, () -> new Worker(this));
        test.run(() -> callbacksWithoutEnd(() -> {
            try {
                Thread.ofPlatform().start(worker::poke).join();
            } catch (InterruptedException e) {
                throw new IllegalStateException(e);
            }
        }));
        assertThat(callbacks).isLessThanOrEqualTo(10 + 256);
    }

    @Test
    void endlessCallbacks_letATimerIn_after256() {
        Worker worker = test.spawn(Worker.class, () -> new Worker(this));
        worker.startTimer();
        test.crank();
        test.run(() -> callbacksWithoutEnd(() -> test.clock().advance(Duration.ofSeconds(1))));
        assertThat(callbacks).isLessThanOrEqualTo(10 + 256);
    }

    /** Callback after callback, until somebody else has had a turn; the tenth runs an action. */
    private void callbacksWithoutEnd(Runnable atTheTenth) {
        Promise.done().thenRun(() -> {
            if (++callbacks == 10) {
                atTheTenth.run();
            }
            if (log.isEmpty() && callbacks < 1_000_000) {
                callbacksWithoutEnd(atTheTenth);
            }
        });
    }
}
