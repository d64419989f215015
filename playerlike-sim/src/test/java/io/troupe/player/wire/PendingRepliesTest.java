package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ManualClock;
import io.troupe.player.wire.PendingReplies.Request;
import org.junit.jupiter.api.Test;

/** Matching of replies to requests. */
class PendingRepliesTest {
    private static final DeviceAddress SIMULATION = new DeviceAddress(1, 2, 31, 0);

    private final ManualClock clock = new ManualClock();
    private final PendingReplies open = new PendingReplies(clock);

    /** Returns whether a request waited for the reply. */
    private boolean arrives(int subtype, int sequence) {
        var header = new Header(SIMULATION, MessageType.ACK, subtype, 0, sequence, 0);
        return open.answer(new WireMessage(header, Content.NONE));
    }

    private Request add() {
        return open.add(SIMULATION, 1);
    }

    private static void assertOpen(Request request) {
        assertThat(request.reply().isDone()).isFalse();
    }

    /** The next reply without a number is that of the request. */
    private void assertIsNext(Request request) {
        assertThat(arrives(1, 0)).isTrue();
        assertThat(request.reply().isDone()).isTrue();
    }

    @Test
    void replyWithANumber_belongsToItsRequest_whateverCameLate() {
        Request first = add();
        Request second = add();
        assertThat(arrives(1, second.sequence())).isTrue();
        assertOpen(first);
        assertThat(second.reply().isDone()).isTrue();

        open.giveUp(first);
        Request third = add();
        assertThat(arrives(1, first.sequence())).as("late").isFalse();
        assertOpen(third);
        assertThat(arrives(2, third.sequence())).as("of another kind").isFalse();
        assertThat(arrives(1, third.sequence())).isTrue();
        assertThat(third.reply().isDone()).isTrue();
    }

    @Test
    void lateReplies_withoutANumber_goToNoLaterRequest() {
        open.giveUp(add());
        Request second = add();
        assertThat(arrives(1, 0)).as("to the first, late").isFalse();
        assertOpen(second);
        open.giveUp(second);
        Request third = add();
        assertThat(arrives(1, 0)).as("to the second, late").isFalse();
        assertOpen(third);
        assertIsNext(third);
        assertThat(arrives(1, 0)).as("to nothing").isFalse();
    }

    @Test
    void requestThatTheServerHasDropped_spoilsTheNextOfItsKind_untilThereWasNoneForAWhile() {
        open.giveUp(add()); // never answered
        Request other = open.add(SIMULATION, 2);
        assertThat(arrives(2, 0)).isTrue();
        assertThat(other.reply().isDone()).isTrue();

        for (int i = 0; i < 4; i++) {
            clock.advance(PendingReplies.QUIET.minusNanos(1));
            Request spoiled = add();
            assertThat(arrives(1, 0)).isFalse();
            open.giveUp(spoiled);
        }
        clock.advance(PendingReplies.QUIET);
        assertIsNext(add());
    }

    @Test
    void requestsOfNoInterest_andThoseThatWereGivenUp_takeTheirReplies_andAreBounded() {
        for (boolean awaited : new boolean[] {false, true}) {
            for (int i = 0; i < 1_000; i++) {
                if (awaited) {
                    open.giveUp(add());
                } else {
                    open.addUnawaited(SIMULATION, 1);
                }
            }
            Request asked = add();
            for (int late = 0; late < 256; late++) {
                assertThat(arrives(1, 0)).isFalse();
            }
            assertIsNext(asked);
        }
    }

    @Test
    void requestThatWasNotSent_isForgotten() {
        open.drop(add());
        assertIsNext(add());
    }
}
