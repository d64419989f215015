package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.util.ArrayList;
import org.junit.jupiter.api.Test;

/** Behaviour that is specific to two nodes that exchange bytes. */
class TwoNodesTest extends BusContract {
    TwoNodesTest() {
        super(Wiring.TWO_NODES);
    }

    @Test
    void messages_goAsBytes() {
        near().attach("a").publish(COUNTS, new Count(1));
        assertThat(bytesCarried()).isZero();
        test.crank();
        assertThat(bytesCarried()).isPositive();
    }

    @Test
    void transportThatFails_rejectsTheRequest_andIsReportedForAPublication() {
        var broken = new Bus("broken", settings(), new Bus.Transport() {
            @Override
            public boolean reaches(String node) {
                return true;
            }

            @Override
            public void send(String node, BusMessage message) {
                throw new IllegalStateException("cable cut");
            }

            @Override
            public void broadcast(BusMessage publication) {
                throw new IllegalStateException("cable cut");
            }

            @Override
            public void close() {}
        });
        var port = broken.attach("a");
        port.publish(COUNTS, new Count(1));
        assertThat(refusalOf(port.ask(new Address("far", "b"), SPELL, new Count(1), SECOND)))
                .isEqualTo("broken/a asked far/b for spell: the way from node broken to node far failed:"
                        + " java.lang.IllegalStateException: cable cut");
        assertThat(take(losses)).hasSize(2).allMatch(Loss.Undeliverable.class::isInstance);
        broken.close();
    }

    @Test
    void answerThatCannotBeSent_isFollowedByARefusal() {
        var sent = new ArrayList<BusMessage>();
        var node = new Bus("far-away", settings(), new Bus.Transport() {
            @Override
            public boolean reaches(String node) {
                return true;
            }

            @Override
            public void send(String node, BusMessage message) {
                if (message.purpose() instanceof BusMessage.Purpose.Reply) {
                    throw new StackOverflowError("in the codec");
                }
                sent.add(message);
            }

            @Override
            public void broadcast(BusMessage publication) {}

            @Override
            public void close() {}
        });
        var handler = node.attach("a");
        handler.answer(SPELL, BusContract::spelt);
        var requester = new Address("near", "b");
        node.receive(new BusMessage.Data(
                requester, new BusMessage.Purpose.Request(handler.address(), SPELL.name()), 7, new Count(1)));
        test.crank();
        assertThat(sent)
                .singleElement()
                .satisfies(rejection -> assertThat(rejection.purpose())
                        .isEqualTo(new BusMessage.Purpose.Rejection(requester, SPELL.name(), 7)));
        assertThat(sent.getFirst().payload())
                .asString()
                .contains("the answer could not be sent: the way from node far-away to node near failed");
        assertThat(theOnlyLoss()).isInstanceOf(Loss.Undeliverable.class);
        node.close();
    }

    @Test
    void replyToAnotherRequestOfThatNumber_settlesNothing() {
        var sent = new ArrayList<BusMessage>();
        var node = new Bus("near", settings(), new Bus.Transport() {
            @Override
            public boolean reaches(String node) {
                return true;
            }

            @Override
            public void send(String node, BusMessage message) {
                sent.add(message);
            }

            @Override
            public void broadcast(BusMessage publication) {}

            @Override
            public void close() {}
        });
        var requester = node.attach("a");
        var asked = new Address("far", "b");
        var answer = heard(requester.ask(asked, SPELL, new Count(1), SECOND));
        long number = sent.getFirst().sequence();
        var ofAnother = new BusMessage.Purpose.Reply(requester.address(), SPELL.name(), number);
        node.receive(new BusMessage.Data(new Address("far", "c"), ofAnother, 1, new Text("c")));
        var ofAnotherOperation = new BusMessage.Purpose.Reply(requester.address(), START.name(), number);
        node.receive(new BusMessage.Data(asked, ofAnotherOperation, 2, new Text("started")));
        assertThat(answer.isDone()).isFalse();
        assertThat(take(losses)).hasSize(2).allMatch(Loss.Late.class::isInstance);
        node.receive(new BusMessage.Data(asked, ofAnother, 3, new Text("b")));
        assertThat(test.get(answer)).isEqualTo(new Text("b"));
        node.close();
    }

    @Test
    void requestsWhoseRequestersHaveGivenUp_makeRoomAtTheirHandler_theOldestFirst() {
        var handler = far().attach("a");
        var kept = new ArrayList<Deferred<Text>>();
        handler.answer(SPELL, count -> {
            kept.add(new Deferred<>(test.space()));
            return kept.getLast();
        });
        var here = far().attach("near-by");
        var ownAnswer = heard(here.ask(handler.address(), SPELL, new Count(0), SECOND.multipliedBy(100)));
        var requester = near().attach("b");
        for (int round = 0; round < 3; round++) {
            for (int i = 0; i < CAPACITY - 1; i++) {
                var unanswered = heard(requester.ask(handler.address(), SPELL, new Count(i), SECOND));
                test.crank();
                assertThat(unanswered.isDone()).isFalse();
                test.advance(SECOND);
                assertThat(test.error(unanswered)).isInstanceOf(BusTimeoutException.class);
            }
        }
        assertThat(kept).hasSize(1 + 3 * (CAPACITY - 1));
        take(losses); // six requests rejected to make room, and the refusals, which are late
        var answer = heard(requester.ask(handler.address(), SPELL, new Count(7), SECOND));
        test.crank();
        take(losses);
        kept.forEach(each -> each.resolve(new Text("at last")));
        assertThat(test.get(answer)).isEqualTo(new Text("at last"));
        assertThat(test.get(ownAnswer)).as("of the node itself").isEqualTo(new Text("at last"));
        assertThat(take(losses)).hasSize(3 * (CAPACITY - 1)).allMatch(Loss.Late.class::isInstance);
    }

    @Test
    void messages_areTheSame_onBothSidesOfTheBytes() {
        far().attach("a").answer(SPELL, count -> Promise.of(new Text("x")));
        test.get(near().attach("b").ask(new Address("far", "a"), SPELL, new Count(1), SECOND));
        var seen = take(passed);
        assertThat(seen).hasSize(4);
        assertThat(seen.get(1)).isEqualTo(seen.get(0)).isNotSameAs(seen.get(0));
        assertThat(seen.get(3)).isEqualTo(seen.get(2)).isNotSameAs(seen.get(2));
    }
}
