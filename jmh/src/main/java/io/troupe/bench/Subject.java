package io.troupe.bench;

import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CyclicBarrier;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import org.jspecify.annotations.Nullable;

/** A contender, with the helpers that some workloads need. */
final class Subject implements AutoCloseable {
    private final Contender contender;
    private final FourSenders four = new FourSenders();
    private @Nullable Families families;

    Subject(Contender contender) {
        this.contender = contender;
    }

    Contender contender() {
        return contender;
    }

    void tell(int messages) throws Exception {
        contender.tell(messages, Contender.Senders.ONE);
    }

    void tellFromFour(int messages) throws Exception {
        contender.tell(messages, four);
    }

    void tellOfMany(int messages) throws Exception {
        families().tell(messages);
    }

    /**
     * Creates the families as late as possible: code compiled after two hundred message types were met is slower than
     * code compiled after ten.
     */
    Families families() throws Exception {
        if (families == null) {
            families = new Families(contender);
        }
        return families;
    }

    @Override
    public void close() {
        four.close();
        contender.close();
    }

    /**
     * Four threads that start together and send a quarter of the messages each. They live through all turns, and park
     * between two of them.
     */
    static final class FourSenders implements Contender.Senders, AutoCloseable {
        private static final int COUNT = 4;

        private final ExecutorService threads = Executors.newFixedThreadPool(
                COUNT, Thread.ofPlatform().daemon().name("sender-", 1).factory());

        /** Without it a thread that ends early could send the quarter of one that wakes late. */
        private final CyclicBarrier start = new CyclicBarrier(COUNT);

        @Override
        public void send(int messages, Loop loop) throws Exception {
            List<Future<?>> quarters = new ArrayList<>();
            for (int i = 0; i < COUNT; i++) {
                int share = messages / COUNT + (i < messages % COUNT ? 1 : 0);
                quarters.add(threads.submit(() -> {
                    start.await();
                    loop.send(share);
                    return null;
                }));
            }
            for (Future<?> quarter : quarters) {
                quarter.get();
            }
        }

        @Override
        public void close() {
            threads.shutdown();
        }
    }
}
