package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.MailboxBound.Overflow;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.CountDownLatch;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** A mailbox that drops the oldest call, with several senders and a receiver running concurrently. */
@Tag("threads")
@Timeout(60)
class DropOldestTest {
    private static final int SENDERS = 3;
    private static final int CALLS = 20_000;
    private static final int CAPACITY = 2;

    interface Sink {
        void take(int sender, int number);
    }

    @Test
    void dropOldest_underSeveralSenders_servesOrDropsEachCallOnce_andKeepsTheNewest() throws Exception {
        var dropped = new ConcurrentLinkedQueue<String>();
        var taken = new ArrayList<List<Integer>>();
        for (int sender = 0; sender < SENDERS; sender++) {
            taken.add(new ArrayList<>());
        }
        var space = ActorSpace.create(
                SpaceSettings.named("dropping").withOnDeadLetter(letter -> dropped.add(letter.message())));
        Sink sink = space.spawn(
                Sink.class,
                () -> (sender, number) -> taken.get(sender).add(number),
                ActorSettings.DEFAULT.withMailbox(CAPACITY, Overflow.DROP_OLDEST));
        var begin = new CountDownLatch(1);
        var threads = new ArrayList<Thread>();
        for (int sender = 0; sender < SENDERS; sender++) {
            int mine = sender;
            threads.add(Thread.ofPlatform().start(() -> {
                awaitQuietly(begin);
                for (int number = 0; number < CALLS; number++) {
                    sink.take(mine, number);
                }
            }));
        }
        begin.countDown();
        for (Thread thread : threads) {
            thread.join();
        }
        space.close();
        int handled = taken.stream().mapToInt(List::size).sum();
        assertThat(handled + dropped.size()).isEqualTo(SENDERS * CALLS);
        taken.forEach(numbers -> assertThat(numbers).isSorted());
        assertThat(taken.stream().anyMatch(numbers -> !numbers.isEmpty() && numbers.getLast() == CALLS - 1))
                .as("whoever sent last was not dropped: nobody came after it")
                .isTrue();
    }

    private static void awaitQuietly(CountDownLatch latch) {
        try {
            latch.await();
        } catch (InterruptedException e) {
            throw new IllegalStateException(e);
        }
    }
}
