package io.troupe.demo.terminal;

import java.time.Duration;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicReference;

/**
 * Lets a command finish in order on Ctrl-C: the virtual machine ends when this is closed, or after half a minute.
 *
 * <p><b>Threads.</b> Ctrl-C is noticed on a thread of the virtual machine; the rest may be called on any.
 */
public final class Interruption implements AutoCloseable {
    /** Exit status of a command that Ctrl-C has ended, as shells have it. */
    public static final int STATUS = 130;

    private static final long CLOSING_SECONDS = 30;
    private static final long LAST_WORDS_MILLIS = 500;
    private static final Runnable NOTHING = () -> {};

    /** Ends what a command does when Ctrl-C was pressed; caught where it prints what it has. */
    public static final class InterruptedCommand extends RuntimeException {
        private static final long serialVersionUID = 1;

        private InterruptedCommand() {
            super("interrupted");
        }
    }

    private final Thread owner = Thread.currentThread();
    private final CountDownLatch closed = new CountDownLatch(1);
    private final AtomicReference<Runnable> atRequest = new AtomicReference<>(NOTHING);
    private final Thread hook = new Thread(this::await, "finish");
    private final CountDownLatch asked = new CountDownLatch(1);
    private volatile boolean requested;

    private Interruption() {}

    public static Interruption open() {
        var interruption = new Interruption();
        Runtime.getRuntime().addShutdownHook(interruption.hook);
        return interruption;
    }

    /** One that never comes. */
    public static Interruption none() {
        return new Interruption();
    }

    public boolean isRequested() {
        return requested;
    }

    /** Waits for a Ctrl-C that a child process noticed first: it goes to all processes of a terminal. */
    public boolean isRequestedWithin(Duration limit) {
        try {
            return asked.await(limit.toMillis(), TimeUnit.MILLISECONDS);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            return requested;
        }
    }

    /** @throws InterruptedCommand if Ctrl-C was pressed */
    public void check() {
        if (requested) {
            throw new InterruptedCommand();
        }
    }

    /** What ends a wait that cannot look at {@link #isRequested}; at once, if Ctrl-C was pressed before. */
    public void onRequest(Runnable action) {
        atRequest.set(action);
        if (requested) {
            action.run();
        }
    }

    /** As Ctrl-C does. */
    void request() {
        requested = true;
        asked.countDown();
        atRequest.get().run();
    }

    private void await() {
        request();
        try {
            if (closed.await(CLOSING_SECONDS, TimeUnit.SECONDS)) {
                owner.join(LAST_WORDS_MILLIS); // it may have to print what went wrong; its exit waits for this thread
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    @Override
    public void close() {
        closed.countDown();
        try {
            Runtime.getRuntime().removeShutdownHook(hook);
        } catch (IllegalStateException shuttingDown) {
            // it runs already, and that is what it is for
        }
    }
}
