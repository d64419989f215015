package io.troupe.actor;

import java.util.concurrent.ScheduledThreadPoolExecutor;
import java.util.concurrent.ThreadFactory;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.locks.LockSupport;

/**
 * Runs delayed and periodic tasks on one daemon thread, which starts on demand and ends after {@value #IDLE_SECONDS}
 * idle seconds.
 *
 * <p><b>Errors.</b> A full heap may end the thread between two tasks, in the code of the JDK; there is then no memory
 * for the next thread either. So the thread that ends tries to start the next one until it succeeds.
 */
final class TimerThread extends ScheduledThreadPoolExecutor {
    private static final long IDLE_SECONDS = 10;
    private static final long PAUSE_NANOS = 100_000_000;

    TimerThread(String name) {
        super(1);
        ThreadFactory threads = Thread.ofPlatform()
                .daemon()
                .inheritInheritableThreadLocals(false)
                .name(name)
                .factory();
        setThreadFactory(work -> threads.newThread(() -> runAndReplace(work)));
        setRemoveOnCancelPolicy(true); // what a task refers to must not be retained here
        setKeepAliveTime(IDLE_SECONDS, TimeUnit.SECONDS);
        allowCoreThreadTimeOut(true); // not while a task is scheduled
    }

    private void runAndReplace(Runnable work) {
        try {
            work.run();
        } catch (Throwable end) { // not of a task: those catch what they throw
            while (!hasSuccessor()) {
                LockSupport.parkNanos(this, PAUSE_NANOS);
            }
        }
    }

    private boolean hasSuccessor() {
        try {
            prestartCoreThread();
            return true;
        } catch (Throwable noMemory) {
            return isShutdown();
        }
    }
}
