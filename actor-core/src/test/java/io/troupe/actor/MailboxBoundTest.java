package io.troupe.actor;

import static io.troupe.actor.Concurrently.await;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSettings.Overflow;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.atomic.AtomicBoolean;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

class MailboxBoundTest extends InTestSpace {
    static class Sink extends Actor {
        private final List<Integer> taken = new ArrayList<>();

        public void take(int number) {
            taken.add(number);
        }

        public Promise<List<Integer>> taken() {
            return Promise.of(List.copyOf(taken));
        }
    }

    private static ActorSettings roomForThree(Overflow overflow) {
        return ActorSettings.named("sink").withMailbox(3, overflow);
    }

    private Sink spawn(Overflow overflow) {
        return test.spawn(Sink.class, Sink::new, roomForThree(overflow));
    }

    private static void takeFive(Sink sink) {
        for (int number = 1; number <= 5; number++) {
            sink.take(number);
        }
    }

    private List<@Nullable Object> lost() {
        return test.takeDeadLetters().stream()
                .map(letter -> letter.arguments().getFirst())
                .toList();
    }

    @Test
    void reject_rejectsTheNewest() {
        Sink sink = spawn(Overflow.REJECT);
        takeFive(sink);
        assertThat(test.error(sink.taken()))
                .isInstanceOf(MailboxFullException.class)
                .hasMessage("Sink.taken() of sink was not begun: its mailbox is full (3 calls, REJECT)");
        assertThat(test.get(sink.taken())).containsExactly(1, 2, 3);
        assertThat(lost()).containsExactly(4, 5);
    }

    @Test
    void dropOldest_makesRoomForTheNewest() {
        Sink sink = spawn(Overflow.DROP_OLDEST);
        takeFive(sink);
        assertThat(test.get(sink.taken())).containsExactly(4, 5);
        assertThat(lost()).containsExactly(1, 2, 3);
    }

    @Test
    void block_onAnActorSpaceOrWithoutAThread_rejectsInstead() {
        Sink sink = spawn(Overflow.BLOCK);
        test.run(() -> takeFive(sink));
        takeFive(sink); // from outside, where it would wait for ever
        test.runQueued();
        assertThat(test.get(sink.taken())).containsExactly(1, 2, 3, 1, 2, 3);
        assertThat(lost()).containsExactly(4, 5, 4, 5);
    }

    @Test
    void cancelledRequest_holdsItsPlaceUntilItsTurn() {
        Sink sink = spawn(Overflow.REJECT);
        for (int request = 0; request < 3; request++) {
            sink.taken().cancel();
        }
        assertThat(test.error(sink.taken())).isInstanceOf(MailboxFullException.class);
        assertThat(test.get(sink.taken())).isEmpty();
    }

    @Test
    void capacityBelowOne_isRejected() {
        assertThatThrownBy(() -> ActorSettings.defaults().withMailbox(0, Overflow.REJECT))
                .hasMessage("the capacity of the mailbox is 0, expected 1 or more, or withoutMailboxLimit()");
    }

    /** Runs a task on a thread until it waits for room in a mailbox, while the space waits for the gate. */
    private static Thread waitingForRoom(ActorSpace space, CountDownLatch gate, Runnable task) {
        space.execute(() -> await(gate));
        Thread sender = Thread.ofPlatform().start(task);
        while (sender.getState() != Thread.State.WAITING) {
            Thread.onSpinWait();
        }
        return sender;
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void block_outside_waitsForRoom_andLosesNothing() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("bounded"))) {
            var gate = new CountDownLatch(1);
            Sink sink = space.spawn(Sink.class, Sink::new, roomForThree(Overflow.BLOCK));
            var sender = waitingForRoom(space, gate, () -> {
                for (int number = 0; number < 1_000; number++) {
                    sink.take(number);
                }
            });
            gate.countDown();
            sender.join();
            assertThat(sink.taken().get(Duration.ofSeconds(30))).hasSize(1_000).isSorted();
        }
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void block_interruptedCaller_isRejected_andStaysInterrupted() throws Exception {
        var letters = new LinkedBlockingQueue<DeadLetter>();
        try (var space = ActorSpace.create(SpaceSettings.named("bounded").withOnDeadLetter(letters::add))) {
            var gate = new CountDownLatch(1);
            Sink sink = space.spawn(Sink.class, Sink::new, roomForThree(Overflow.BLOCK));
            var interrupted = new AtomicBoolean();
            var sender = waitingForRoom(space, gate, () -> {
                takeFive(sink);
                interrupted.set(Thread.currentThread().isInterrupted());
            });
            sender.interrupt();
            sender.join();
            assertThat(interrupted).isTrue();
            assertThat(letters.take().reason())
                    .isEqualTo("its mailbox is full (3 calls, BLOCK), and its caller was interrupted while it waited"
                            + " for room");
            gate.countDown();
            assertThat(sink.taken().get(Duration.ofSeconds(30))).containsExactly(1, 2, 3);
            assertThat(letters.take().arguments()).containsExactly(5);
        }
    }
}
