package io.troupe.bench;

import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;

/** The plain JDK: tasks on a single-thread executor, answers as {@code CompletableFuture}. */
final class ExecutorContender implements Contender {
    private final CompletionLatch finish = new CompletionLatch();
    private final ExecutorService executor =
            Executors.newSingleThreadExecutor(Thread.ofPlatform().daemon().factory());
    private final Counter counter = new Counter();
    private final Counter other = new Counter();
    private final List<Counter> created = new ArrayList<>();

    private final class Counter {
        private int sum;
        private int left;

        void add(int amount) {
            sum += amount;
            if (--left == 0) {
                finish.reach();
            }
        }

        void ping(Counter partner, int hops) {
            if (hops == 0) {
                finish.reach();
            } else {
                executor.execute(() -> partner.ping(this, hops - 1));
            }
        }

        CompletableFuture<Integer> sum() {
            return CompletableFuture.supplyAsync(() -> sum, executor);
        }

        void askPartner(Counter partner, int asks) {
            partner.sum().thenAccept(answer -> {
                if (asks == 1) {
                    finish.reach();
                } else {
                    askPartner(partner, asks - 1);
                }
            });
        }

        void begin(AtomicInteger beginners) {
            sum++;
            if (beginners.decrementAndGet() == 0) {
                finish.reach();
            }
        }
    }

    @Override
    public void tell(int messages, Senders senders) throws Exception {
        finish.reset();
        executor.execute(() -> counter.left = messages);
        senders.send(messages, share -> {
            for (int i = 0; i < share; i++) {
                int amount = i;
                executor.execute(() -> counter.add(amount));
            }
        });
        finish.await();
    }

    @Override
    public Family newFamily(Tally tally) throws Exception {
        return Families.copy(ExecutorFamily.class, executor, tally);
    }

    @Override
    public void pingPong(int hops) {
        finish.reset();
        executor.execute(() -> counter.ping(other, hops));
        finish.await();
    }

    @Override
    public void askPipelined(int asks) {
        finish.reset();
        var left = new AtomicInteger(asks);
        for (int i = 0; i < asks; i++) {
            counter.sum().thenAccept(answer -> {
                if (left.decrementAndGet() == 0) {
                    finish.reach();
                }
            });
        }
        finish.await();
    }

    @Override
    public void askChain(int asks) {
        finish.reset();
        executor.execute(() -> counter.askPartner(other, asks));
        finish.await();
    }

    @Override
    public void askOnce(int asks) throws Exception {
        for (int i = 0; i < asks; i++) {
            counter.sum().get(30, TimeUnit.SECONDS);
        }
    }

    @Override
    public void create(int actors) {
        finish.reset();
        var beginners = new AtomicInteger(actors);
        for (int i = 0; i < actors; i++) {
            var newcomer = new Counter();
            created.add(newcomer);
            executor.execute(() -> newcomer.begin(beginners));
        }
        finish.await();
    }

    @Override
    public void clear() {
        created.clear();
    }

    @Override
    public void close() {
        executor.shutdown();
    }
}
