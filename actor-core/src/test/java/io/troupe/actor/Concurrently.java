package io.troupe.actor;

import java.time.Duration;
import java.util.concurrent.CountDownLatch;
import java.util.function.IntConsumer;
import java.util.stream.IntStream;

/** Threads of tests. */
public final class Concurrently {
    public static final Duration LONG = Duration.ofSeconds(30);

    private Concurrently() {}

    /** Runs a task on several threads, which begin at the same time, and waits for their end. */
    public static void onThreads(int count, IntConsumer task) {
        var begin = new CountDownLatch(1);
        var threads = IntStream.range(0, count)
                .mapToObj(number -> Thread.ofPlatform().start(() -> {
                    await(begin);
                    task.accept(number);
                }))
                .toList();
        begin.countDown();
        try {
            for (Thread thread : threads) {
                thread.join();
            }
        } catch (InterruptedException interrupted) {
            throw new IllegalStateException(interrupted);
        }
    }

    public static void onAnotherThread(Runnable task) {
        onThreads(1, number -> task.run());
    }

    public static void await(CountDownLatch latch) {
        try {
            latch.await();
        } catch (InterruptedException interrupted) {
            throw new IllegalStateException(interrupted);
        }
    }
}
