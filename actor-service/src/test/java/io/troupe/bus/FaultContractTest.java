package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.ArrayList;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedClass;
import org.junit.jupiter.params.provider.EnumSource;

/** Request handlers that hang, leave, are replaced or are overloaded; requesters that cancel. */
@ParameterizedClass
@EnumSource(BusContract.Wiring.class)
class FaultContractTest extends BusContract {
    FaultContractTest(Wiring wiring) {
        super(wiring);
    }

    @Test
    void handlerThatHangs_isRejectedWhenTheTimeIsOver_andItsAnswerIsReportedAsLate() {
        var handler = far().attach("speller");
        var kept = new Deferred<Text>(test.space());
        handler.answer(SPELL, count -> kept);
        var requester = near().attach("asker");
        var answer = requester.ask(handler.address(), SPELL, new Count(7), SECOND);
        test.crank();
        test.advance(SECOND.minusMillis(2));
        assertThat(answer.isDone()).isFalse();
        test.advance(Duration.ofMillis(5));
        assertThat(refusalOf(answer))
                .isEqualTo(requester.address() + " asked " + handler.address() + " for spell: no answer within PT1S");
        assertThat(answer.error()).isInstanceOf(BusTimeoutException.class);
        assertThat(losses).isEmpty();
        kept.resolve(new Text("at last"));
        test.crank();
        assertThat(theOnlyLoss()).isInstanceOfSatisfying(Loss.Late.class, late -> {
            assertThat(late.reply().payload()).isEqualTo(new Text("at last"));
            assertThat(late.reply().from()).isEqualTo(handler.address());
        });
        assertThat(nearMetrics().timedOut()).isEqualTo(1);
        assertThat(nearMetrics().late()).isEqualTo(1);
    }

    @Test
    void requestsThatWait_areRejectedAtOnce_whenTheHandlerLeaves() {
        var handler = far().attach("speller");
        var kept = new Deferred<Text>(test.space());
        handler.answer(SPELL, count -> kept);
        var requester = near().attach("asker");
        var begun = requester.ask(handler.address(), SPELL, new Count(1), SECOND);
        test.crank();
        var answers = new ArrayList<Promise<Text>>();
        test.run(() -> {
            answers.add(heard(requester.ask(handler.address(), SPELL, new Count(2), SECOND)));
            arrive();
            handler.close();
        });
        String expected = requester.address() + " asked " + handler.address()
                + " for spell: left before it answered: it has left the bus";
        assertThat(refusalOf(begun)).isEqualTo(expected);
        assertThat(refusalOf(answers.getFirst())).isEqualTo(expected);
        assertThat(take(losses)).hasSize(2).allMatch(Loss.Undeliverable.class::isInstance);
        kept.resolve(new Text("too late"));
        test.crank();
        assertThat(theOnlyLoss()).isInstanceOf(Loss.Late.class);
    }

    @Test
    void requestsThatWait_areRejectedAtOnce_whenTheSpaceOfTheHandlerIsClosed() {
        var other = ActorSpace.create(SpaceSettings.named("other").withHandCrank());
        var handler = far().attach("speller");
        other.execute(() -> handler.answer(SPELL, count -> new Deferred<>()));
        other.crank();
        var requester = near().attach("asker");
        var begun = requester.ask(handler.address(), SPELL, new Count(1), SECOND);
        test.crank();
        other.crank();
        assertThat(begun.isDone()).isFalse();
        other.close();
        assertThat(refusalOf(begun)).endsWith("left before it answered: space other was closed");
        var later = requester.ask(handler.address(), SPELL, new Count(2), SECOND);
        assertThat(refusalOf(later)).contains("it does not answer that");
        assertThat(take(losses)).hasSize(2).allMatch(Loss.Undeliverable.class::isInstance);
    }

    @Test
    void requestsOfARequesterThatLeaves_areRejectedAtOnce_andTheirAnswersAreLate() {
        var handler = far().attach("speller");
        var kept = new Deferred<Text>(test.space());
        handler.answer(SPELL, count -> kept);
        var requester = near().attach("asker");
        var answer = requester.ask(handler.address(), SPELL, new Count(1), SECOND);
        test.crank();
        requester.close();
        assertThat(refusalOf(answer)).endsWith("for spell: the asker has left: it has left the bus");
        kept.resolve(new Text("for nobody"));
        test.crank();
        assertThat(theOnlyLoss()).isInstanceOf(Loss.Late.class);
    }

    @Test
    void handlerThatIsReplaced_answersUnderTheSameName() {
        var first = far().attach("speller");
        first.answer(SPELL, count -> Promise.of(new Text("first")));
        var requester = near().attach("asker");
        var address = first.address();
        assertThat(test.get(requester.ask(address, SPELL, new Count(1), SECOND)))
                .isEqualTo(new Text("first"));
        first.close();
        far().attach("speller").answer(SPELL, count -> Promise.of(new Text("second")));
        assertThat(test.get(requester.ask(address, SPELL, new Count(1), SECOND)))
                .isEqualTo(new Text("second"));
    }

    @Test
    void handlerWithTooManyRequests_refusesTheNewest() {
        var handler = far().attach("speller");
        handler.answer(SPELL, BusContract::spelt);
        var requester = near().attach("asker");
        var answers = new ArrayList<Promise<Text>>();
        test.run(() -> {
            for (int i = 0; i <= CAPACITY; i++) {
                answers.add(heard(requester.ask(handler.address(), SPELL, new Count(i), SECOND)));
            }
            arrive();
        });
        assertThat(refusalOf(answers.removeLast()))
                .endsWith("for spell: is too busy: 4 questions for spell wait there");
        assertThat(answers)
                .hasSize(CAPACITY)
                .allSatisfy(each -> assertThat(each.isDone()).isTrue());
        assertThat(theOnlyLoss()).isInstanceOf(Loss.Undeliverable.class);
    }

    /** A request from another node is evicted, because its requester may have cancelled unnoticed. */
    @Test
    void handlerThatNeverAnswers_refusesTheOldestOfAnotherNode_elseTheNewest_whenItHasBegunTooMany() {
        boolean apart = !near().node().equals(far().node());
        var handler = far().attach("speller");
        var kept = new ArrayList<Deferred<Text>>();
        handler.answer(SPELL, count -> {
            kept.add(new Deferred<>(test.space()));
            return kept.getLast();
        });
        var requester = near().attach("asker");
        var answers = new ArrayList<Promise<Text>>();
        for (int i = 0; i <= CAPACITY; i++) {
            answers.add(heard(requester.ask(handler.address(), SPELL, new Count(i), SECOND)));
            test.crank();
        }
        assertThat(refusalOf(apart ? answers.removeFirst() : answers.removeLast()))
                .endsWith("for spell: is too busy: 4 questions for spell are being answered");
        assertThat(theOnlyLoss()).isInstanceOf(Loss.Undeliverable.class);
        kept.forEach(each -> each.resolve(new Text("done")));
        test.crank();
        assertThat(answers)
                .hasSize(CAPACITY)
                .allSatisfy(each -> assertThat(test.get(each)).isEqualTo(new Text("done")));
        if (apart) {
            assertThat(theOnlyLoss()).isInstanceOf(Loss.Late.class);
        }
        var next = requester.ask(handler.address(), SPELL, new Count(5), SECOND);
        test.crank();
        kept.getLast().resolve(new Text("next"));
        assertThat(test.get(next)).isEqualTo(new Text("next"));
    }

    @Test
    void requestThatIsCancelled_findsItsAnswerLate() {
        var handler = far().attach("speller");
        handler.answer(SPELL, BusContract::spelt);
        var answer = near().attach("asker").ask(handler.address(), SPELL, new Count(1), SECOND);
        answer.cancel();
        test.crank();
        assertThat(theOnlyLoss())
                .isInstanceOfSatisfying(
                        Loss.Late.class, late -> assertThat(late.why()).isEqualTo("nobody waits for it any more"));
    }
}
