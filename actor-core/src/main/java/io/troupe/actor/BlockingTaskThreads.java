package io.troupe.actor;

import java.util.concurrent.ExecutorService;
import java.util.concurrent.SynchronousQueue;
import java.util.concurrent.ThreadPoolExecutor;
import java.util.concurrent.TimeUnit;
import org.jspecify.annotations.Nullable;

/**
 * Platform threads for work that must run even if all carriers of virtual threads are busy: bodies of
 * {@code sequential}, and stall listeners. Shared by all spaces, created on demand, one per concurrent task. They are
 * daemons, and end after {@value #IDLE_SECONDS} idle seconds.
 *
 * <p><b>Threads.</b> Any thread.
 */
final class BlockingTaskThreads {
    private static final long IDLE_SECONDS = 10;
    private static final String IDLE_NAME = "troupe-helper";

    /** With a core size of zero and no queue, a task gets an idle thread or a new one. */
    private static final ExecutorService POOL = new ThreadPoolExecutor(
            0,
            Integer.MAX_VALUE,
            IDLE_SECONDS,
            TimeUnit.SECONDS,
            new SynchronousQueue<>(),
            task -> CleanThreads.create(() -> Thread.ofPlatform()
                    .daemon()
                    .inheritInheritableThreadLocals(false)
                    .name(IDLE_NAME)
                    .unstarted(task)));

    private BlockingTaskThreads() {}

    /**
     * Runs a task on a thread that has this name and context class loader meanwhile.
     *
     * @throws OutOfMemoryError if no further thread can be created
     */
    static void run(String name, @Nullable ClassLoader loader, Runnable task) {
        POOL.execute(() -> runNamed(name, loader, task));
    }

    /**
     * Runs a task, then clears the interrupt flag and the class loader that it may have left; thread-locals cannot be
     * cleared.
     */
    private static void runNamed(String name, @Nullable ClassLoader loader, Runnable task) {
        Thread thread = Thread.currentThread();
        thread.setName(name);
        thread.setContextClassLoader(loader);
        try {
            task.run();
        } finally {
            Thread.interrupted();
            thread.setContextClassLoader(ClassLoader.getSystemClassLoader());
            thread.setName(IDLE_NAME);
        }
    }
}
