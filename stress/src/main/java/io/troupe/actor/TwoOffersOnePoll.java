package io.troupe.actor;

import io.troupe.actor.internal.loop.EntryQueue;
import io.troupe.actor.internal.loop.QueueEntry;
import org.openjdk.jcstress.annotations.Actor;
import org.openjdk.jcstress.annotations.Arbiter;
import org.openjdk.jcstress.annotations.Expect;
import org.openjdk.jcstress.annotations.JCStressTest;
import org.openjdk.jcstress.annotations.Outcome;
import org.openjdk.jcstress.annotations.State;
import org.openjdk.jcstress.infra.results.III_Result;

/**
 * Two threads offer one entry each while a third polls: every entry is taken exactly once, together with its thread's
 * earlier writes; needs three processors.
 */
@JCStressTest
@Outcome(
        id = {"0, 1, 2", "1, 1, 2"},
        expect = Expect.ACCEPTABLE,
        desc = "Both arrived.")
@Outcome(id = "2, 1, 2", expect = Expect.ACCEPTABLE, desc = "Both arrived, the second one was polled meanwhile.")
@Outcome(expect = Expect.FORBIDDEN, desc = "A node was lost, doubled, or came without its content.")
@State
public class TwoOffersOnePoll {
    private static final class Letter extends QueueEntry {
        int content;
    }

    private final EntryQueue queue = new EntryQueue();
    private final Letter first = new Letter();
    private final Letter second = new Letter();
    private int sumPolled;

    @Actor
    public void offerFirst() {
        first.content = 1;
        queue.offer(first);
    }

    @Actor
    public void offerSecond() {
        second.content = 2;
        queue.offer(second);
    }

    @Actor
    public void poll(III_Result result) {
        var letter = (Letter) queue.poll();
        result.r1 = letter == null ? 0 : letter.content;
        sumPolled = letter == null ? 0 : letter.content;
    }

    @Arbiter
    public void drain(III_Result result) {
        int ones = sumPolled == 1 ? 1 : 0;
        int twos = sumPolled == 2 ? 2 : 0;
        for (var letter = (Letter) queue.poll(); letter != null; letter = (Letter) queue.poll()) {
            ones += letter.content == 1 ? 1 : 0;
            twos += letter.content == 2 ? 2 : 0;
        }
        result.r2 = ones;
        result.r3 = twos;
    }
}
