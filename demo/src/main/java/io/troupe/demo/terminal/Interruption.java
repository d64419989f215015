package io.troupe.demo.terminal;

import java.time.Duration;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicReference;

/**
 * Lets a command finish in order after Ctrl-C. The virtual machine exits when this is closed, or after half a minute.
 *
 * <p><b>Threads.</b> Ctrl-C is handled by a shutdown hook on a separate thread. The methods may be called from any
 * thread.
 */
public final class Interruption implements AutoCloseable {
    /** Exit status of an interrupted command, by shell convention. */
    public static final int STATUS = 130;

    private static final long CLOSING_SECONDS = 30;
    private static final long LAST_OUTPUT_MILLIS = 500;
    private static final Runnable NOTHING = () -> {};

    /** Aborts the work of a command after Ctrl-C. The command catches it and prints its partial results. */
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

    /** An interruption that never occurs. */
    public static Interruption none() {
        return new Interruption();
    }

    public boolean isRequested() {
        return requested;
    }

    /** Waits for a Ctrl-C that may have reached a child process first: the terminal sends it to all processes. */
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

    /**
     * Registers an action that ends a wait that cannot poll {@link #isRequested}. It runs at once if Ctrl-C was pressed
     * before.
     */
    public void onRequest(Runnable action) {
        atRequest.set(action);
        if (requested) {
            action.run();
        }
    }

    /** Requests an interruption, as Ctrl-C does. */
    void request() {
        requested = true;
        asked.countDown();
        atRequest.get().run();
    }

    private void await() {
        request();
        try {
            if (closed.await(CLOSING_SECONDS, TimeUnit.SECONDS)) {
                // the owner may still print an error; its call of exit blocks until this hook ends
                owner.join(LAST_OUTPUT_MILLIS);
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
            // the hook is already running
        }
    }
}
