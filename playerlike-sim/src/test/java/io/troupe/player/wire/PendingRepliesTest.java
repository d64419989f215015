package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.time.ManualClock;
import io.troupe.player.wire.PendingReplies.Request;
import org.junit.jupiter.api.Test;

/** Matching of replies to requests. */
class PendingRepliesTest {
    private static final DeviceAddress SIMULATION = new DeviceAddress(1, 2, 31, 0);

    private final ManualClock clock = new ManualClock();
    private final PendingReplies open = new PendingReplies(clock);

    private static WireMessage reply(int subtype, int sequence) {
        return new WireMessage(new Header(SIMULATION, MessageType.ACK, subtype, 0, sequence, 0), Content.NONE);
    }

    private boolean isAnswered(Request request) {
        return request.reply().isDone();
    }

    @Test
    void replyWithANumber_belongsToItsRequest_whateverCameLate() {
        Request first = open.add(SIMULATION, 1);
        Request second = open.add(SIMULATION, 1);
        assertThat(open.answer(reply(1, second.sequence()))).isTrue();
        assertThat(isAnswered(first)).isFalse();
        assertThat(isAnswered(second)).isTrue();

        open.giveUp(first);
        Request third = open.add(SIMULATION, 1);
        assertThat(open.answer(reply(1, first.sequence()))).as("late").isFalse();
        assertThat(isAnswered(third)).isFalse();
        assertThat(open.answer(reply(2, third.sequence())))
                .as("of another kind")
                .isFalse();
        assertThat(open.answer(reply(1, third.sequence()))).isTrue();
        assertThat(isAnswered(third)).isTrue();
    }

    @Test
    void replyWithoutANumber_comesInOrder_andTheLateOneGoesToNoRequest() {
        Request first = open.add(SIMULATION, 1);
        open.giveUp(first);
        Request second = open.add(SIMULATION, 1);
        assertThat(open.answer(reply(1, 0))).as("late").isFalse();
        assertThat(isAnswered(second)).isFalse();
        assertThat(open.answer(reply(1, 0))).isTrue();
        assertThat(isAnswered(second)).isTrue();
        assertThat(open.answer(reply(1, 0))).as("to nothing").isFalse();
    }

    @Test
    void severalLateReplies_withoutANumber_goToNoLaterRequest() {
        Request first = open.add(SIMULATION, 1);
        open.giveUp(first);
        Request second = open.add(SIMULATION, 1);
        assertThat(open.answer(reply(1, 0))).as("to the first, late").isFalse();
        open.giveUp(second);
        Request third = open.add(SIMULATION, 1);
        assertThat(open.answer(reply(1, 0))).as("to the second, late").isFalse();
        assertThat(isAnswered(third)).isFalse();
        assertThat(open.answer(reply(1, 0))).isTrue();
        assertThat(isAnswered(third)).isTrue();
    }

    @Test
    void requestThatTheServerHasDropped_spoilsTheNextOfItsKind_untilThereWasNoneForAWhile() {
        open.giveUp(open.add(SIMULATION, 1)); // never answered
        Request other = open.add(SIMULATION, 2);
        assertThat(open.answer(reply(2, 0))).isTrue();
        assertThat(isAnswered(other)).isTrue();

        for (int i = 0; i < 4; i++) {
            clock.advance(PendingReplies.QUIET.minusNanos(1));
            Request spoiled = open.add(SIMULATION, 1);
            assertThat(open.answer(reply(1, 0))).isFalse();
            open.giveUp(spoiled);
        }
        clock.advance(PendingReplies.QUIET);
        Request afterQuiet = open.add(SIMULATION, 1);
        assertThat(open.answer(reply(1, 0))).isTrue();
        assertThat(isAnswered(afterQuiet)).isTrue();
    }

    @Test
    void requestOfNoInterest_takesItsReply_andIsBounded() {
        for (int i = 0; i < 1_000; i++) {
            open.addUnawaited(SIMULATION, 1);
        }
        Request asked = open.add(SIMULATION, 1);
        for (int late = 0; late < 256; late++) {
            assertThat(open.answer(reply(1, 0))).isFalse();
        }
        assertThat(open.answer(reply(1, 0))).isTrue();
        assertThat(isAnswered(asked)).isTrue();
    }

    @Test
    void requestThatWasNotSent_isForgotten() {
        open.drop(open.add(SIMULATION, 1));
        Request next = open.add(SIMULATION, 1);
        assertThat(open.answer(reply(1, 0))).isTrue();
        assertThat(isAnswered(next)).isTrue();
    }

    @Test
    void requestsThatWereGivenUp_areBounded() {
        for (int i = 0; i < 1_000; i++) {
            open.giveUp(open.add(SIMULATION, 1));
        }
        Request last = open.add(SIMULATION, 1);
        int late = 0;
        while (!open.answer(reply(1, 0))) {
            late++;
        }
        assertThat(late).isEqualTo(256);
        assertThat(isAnswered(last)).isTrue();
    }
}
