package io.troupe.actor;

import java.util.concurrent.Future;
import java.util.concurrent.ScheduledThreadPoolExecutor;
import java.util.concurrent.ThreadFactory;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.locks.LockSupport;
import org.jspecify.annotations.Nullable;

/**
 * Runs delayed tasks, which throw nothing, on one daemon thread, which starts on demand and ends after
 * {@value #IDLE_SECONDS} idle seconds.
 *
 * <p><b>Errors.</b> With a full heap the JDK's own code may fail before it has begun a task, which it then forgets, or
 * between two tasks, which ends the thread; and there is no memory for the next thread either. So the owner runs what
 * is overdue, and a thread that ends tries to start the next one until it succeeds.
 */
final class TimerThread extends ScheduledThreadPoolExecutor {
    private static final long IDLE_SECONDS = 10;
    private static final long PAUSE_NANOS = 100_000_000;

    private final Runnable runOverdue;

    /**
     * @param loader the context class loader of the tasks
     * @param runOverdue runs the tasks whose time has come, and which were not run
     */
    TimerThread(String name, @Nullable ClassLoader loader, Runnable runOverdue) {
        super(1);
        this.runOverdue = runOverdue;
        ThreadFactory threads = Thread.ofPlatform()
                .daemon()
                .inheritInheritableThreadLocals(false)
                .name(name)
                .factory();
        setThreadFactory(work -> {
            var thread = CleanThreads.create(() -> threads.newThread(() -> runAndReplace(work)));
            thread.setContextClassLoader(loader);
            return thread;
        });
        setRemoveOnCancelPolicy(true); // what a task refers to must not be retained here
        setKeepAliveTime(IDLE_SECONDS, TimeUnit.SECONDS);
        allowCoreThreadTimeOut(true); // not while a task is scheduled
    }

    @Override
    protected void afterExecute(Runnable task, @Nullable Throwable thrown) {
        if (thrown != null || task instanceof Future<?> future && future.state() == Future.State.FAILED) {
            throw new IllegalStateException("a task was not run", thrown); // it is the JDK's code that has failed
        }
    }

    private void runAndReplace(Runnable work) {
        try {
            work.run();
        } catch (Throwable end) { // not of a task: those throw nothing
            while (!hasSuccessor()) {
                LockSupport.parkNanos(this, PAUSE_NANOS);
            }
        }
    }

    private boolean hasSuccessor() {
        try {
            runOverdue.run();
            prestartCoreThread();
            return true;
        } catch (Throwable noMemory) {
            return isShutdown();
        }
    }
}
