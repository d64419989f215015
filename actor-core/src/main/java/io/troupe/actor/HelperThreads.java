package io.troupe.actor;

import java.util.concurrent.ExecutorService;
import java.util.concurrent.SynchronousQueue;
import java.util.concurrent.ThreadPoolExecutor;
import java.util.concurrent.TimeUnit;

/**
 * Platform threads for what must run however busy the carriers of virtual threads are: bodies of {@code sequential},
 * and listeners of stalls. Shared by all spaces, made when needed, as many as run at a time. They are daemons, and end
 * when they have had nothing to do for {@value #IDLE_SECONDS} seconds.
 *
 * <p><b>Threads.</b> Any thread.
 */
final class HelperThreads {
    private static final long IDLE_SECONDS = 10;
    private static final String IDLE_NAME = "troupe-helper";

    /** Made with a core of none and no queue: a task gets an idle thread, or a new one. */
    private static final ExecutorService POOL = new ThreadPoolExecutor(
            0,
            Integer.MAX_VALUE,
            IDLE_SECONDS,
            TimeUnit.SECONDS,
            new SynchronousQueue<>(),
            Thread.ofPlatform()
                    .daemon()
                    .inheritInheritableThreadLocals(false)
                    .name(IDLE_NAME)
                    .factory());

    private HelperThreads() {}

    /**
     * Runs a task on a thread that has this name meanwhile.
     *
     * @throws OutOfMemoryError if the machine has no further thread
     */
    static void run(String name, Runnable task) {
        POOL.execute(() -> runNamed(name, task));
    }

    /** The next task must not find an interrupt or a class loader of this one; thread-locals cannot be taken away. */
    private static void runNamed(String name, Runnable task) {
        Thread thread = Thread.currentThread();
        thread.setName(name);
        try {
            task.run();
        } finally {
            Thread.interrupted();
            thread.setContextClassLoader(ClassLoader.getSystemClassLoader());
            thread.setName(IDLE_NAME);
        }
    }
}
