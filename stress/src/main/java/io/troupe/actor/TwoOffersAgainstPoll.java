package io.troupe.actor;

import io.troupe.actor.internal.loop.EntryQueue;
import io.troupe.actor.internal.loop.QueueEntry;
import org.openjdk.jcstress.annotations.Actor;
import org.openjdk.jcstress.annotations.Arbiter;
import org.openjdk.jcstress.annotations.Expect;
import org.openjdk.jcstress.annotations.JCStressTest;
import org.openjdk.jcstress.annotations.Outcome;
import org.openjdk.jcstress.annotations.State;
import org.openjdk.jcstress.infra.results.II_Result;

/**
 * What one thread offers while another polls is taken once, in order, together with earlier writes; runs on two
 * processors.
 */
@JCStressTest
@Outcome(
        id = {"0, 12", "1, 12"},
        expect = Expect.ACCEPTABLE,
        desc = "Both arrived, in order.")
@Outcome(expect = Expect.FORBIDDEN, desc = "A node was lost, doubled, out of order, or came without its content.")
@State
public class TwoOffersAgainstPoll {
    private static final class Letter extends QueueEntry {
        int content;
    }

    private final EntryQueue queue = new EntryQueue();
    private final Letter first = new Letter();
    private final Letter second = new Letter();
    private int polled;

    @Actor
    public void offer() {
        first.content = 1;
        queue.offer(first);
        second.content = 2;
        queue.offer(second);
    }

    @Actor
    public void poll(II_Result result) {
        var letter = (Letter) queue.poll();
        polled = letter == null ? 0 : letter.content;
        result.r1 = polled;
    }

    @Arbiter
    public void drain(II_Result result) {
        int digits = polled;
        for (var letter = (Letter) queue.poll(); letter != null; letter = (Letter) queue.poll()) {
            digits = 10 * digits + letter.content;
        }
        result.r2 = digits;
    }
}
