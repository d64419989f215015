package io.troupe.bench;

import java.util.concurrent.ExecutorService;

/** Ten closures that run on the executor. */
public final class ExecutorFamily implements Family {
    private final ExecutorService executor;
    private final Tally tally;

    public ExecutorFamily(ExecutorService executor, Tally tally) {
        this.executor = executor;
        this.tally = tally;
    }

    @Override
    public void send(int amount) {
        executor.execute(() -> tally.add(amount));
        executor.execute(() -> tally.add(2 * amount));
        executor.execute(() -> tally.add(3 * amount));
        executor.execute(() -> tally.add(4 * amount));
        executor.execute(() -> tally.add(5 * amount));
        executor.execute(() -> tally.add(6 * amount));
        executor.execute(() -> tally.add(7 * amount));
        executor.execute(() -> tally.add(8 * amount));
        executor.execute(() -> tally.add(9 * amount));
        executor.execute(() -> tally.add(10 * amount));
    }
}
