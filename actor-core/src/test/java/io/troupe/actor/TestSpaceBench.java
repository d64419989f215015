package io.troupe.actor;

import io.troupe.actor.testkit.TestSpace;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import org.junit.jupiter.api.AfterEach;

/** A space and a log for each test; at the end of the test nothing may be left in the space. */
public abstract class TestSpaceBench {
    protected final TestSpace test = new TestSpace();
    protected final List<String> log = new ArrayList<>();

    @AfterEach
    protected final void nothingIsLeft() {
        test.close();
    }

    /** Runs a task on another thread, and returns when it has ended. */
    protected static void onAnotherThread(Runnable task) {
        try {
            Thread.ofPlatform().start(task).join();
        } catch (InterruptedException interrupted) {
            throw new IllegalStateException(interrupted);
        }
    }

    protected static void awaitLatch(CountDownLatch latch) {
        try {
            latch.await();
        } catch (InterruptedException interrupted) {
            throw new IllegalStateException(interrupted);
        }
    }
}
