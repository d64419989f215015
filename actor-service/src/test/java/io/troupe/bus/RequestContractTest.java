package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.promise.Promise;
import java.time.Duration;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedClass;
import org.junit.jupiter.params.provider.EnumSource;

/** Request and reply, on every kind of bus. */
@ParameterizedClass
@EnumSource(BusContract.Wiring.class)
class RequestContractTest extends BusContract {
    RequestContractTest(Wiring wiring) {
        super(wiring);
    }

    @Test
    void request_isAnswered() {
        var handler = far().attach("speller");
        handler.answer(SPELL, BusContract::spelt);
        var answer = near().attach("asker").ask(handler.address(), SPELL, new Count(7), SECOND);
        assertThat(test.get(answer)).isEqualTo(new Text("number 7"));
        assertThat(nearMetrics().answered()).isEqualTo(1);
    }

    @Test
    void messages_ofOperations_areOfTheirKind() {
        var handler = far().attach("speller");
        handler.answer(SPELL, BusContract::spelt);
        handler.answer(START, BusContract::spelt);
        var requester = near().attach("asker");
        test.get(requester.ask(handler.address(), SPELL, new Count(7), SECOND));
        assertThat(take(passed)).isNotEmpty().allMatch(BusMessage.Data.class::isInstance);
        test.get(requester.ask(handler.address(), START, new Count(7), SECOND));
        assertThat(take(passed)).isNotEmpty().allMatch(BusMessage.Control.class::isInstance);
    }

    @Test
    void request_toAnUnknownPort_isRejectedAtOnce_andNamesWhoIsSimilar() {
        far().attach("wall-follower");
        var to = new Address(far().node(), "wall-folower");
        var requester = near().attach("asker");
        assertThat(refusalOf(requester.ask(to, SPELL, new Count(7), SECOND)))
                .isEqualTo(requester.address() + " asked " + to
                        + " for spell: nobody is there; did you mean wall-follower?");
        assertThat(theOnlyLoss()).isInstanceOf(Loss.Undeliverable.class);
    }

    @Test
    void request_forAnUnknownOperation_isRejectedAtOnce_andNamesTheOperationsThereAre() {
        var handler = far().attach("speller");
        handler.answer(START, BusContract::spelt);
        var requester = near().attach("asker");
        assertThat(refusalOf(requester.ask(handler.address(), SPELL, new Count(7), SECOND)))
                .isEqualTo(requester.address() + " asked " + handler.address()
                        + " for spell: it does not answer that; there are start");
        assertThat(theOnlyLoss()).isInstanceOf(Loss.Undeliverable.class);
    }

    @Test
    void request_toANodeThatIsNotThere_isRejectedAtOnce_andNamesBoth() {
        var requester = near().attach("asker");
        assertThat(refusalOf(requester.ask(new Address("moon", "base"), SPELL, new Count(7), SECOND)))
                .isEqualTo(requester.address() + " asked moon/base for spell: there is no way from node "
                        + near().node() + " to node moon");
        assertThat(theOnlyLoss()).isInstanceOf(Loss.Undeliverable.class);
    }

    @Test
    void request_ofAnotherTypeThanIsAnswered_isRejected_andNamesBoth() {
        var handler = far().attach("speller");
        handler.answer(SPELL, BusContract::spelt);
        var other = new Operation<>("spell", Text.class, Text.class, Operation.Kind.DATA);
        assertThat(refusalOf(near().attach("asker").ask(handler.address(), other, new Text("7"), SECOND)))
                .endsWith("the question is a " + Text.class.getName() + ", expected a " + Count.class.getName());
        assertThat(theOnlyLoss()).isInstanceOf(Loss.Undeliverable.class);
    }

    @Test
    void answer_ofAnotherTypeThanExpected_isRejected_andNamesBoth() {
        var handler = far().attach("speller");
        handler.answer(SPELL, BusContract::spelt);
        var other = new Operation<>("spell", Count.class, Count.class, Operation.Kind.DATA);
        assertThat(refusalOf(near().attach("asker").ask(handler.address(), other, new Count(7), SECOND)))
                .endsWith("the answer is a " + Text.class.getName() + ", expected a " + Count.class.getName());
    }

    @Test
    void handlerThatThrows_rejectsWithTheNameAndMessageOfItsError_withoutTheErrorItself() {
        var handler = far().attach("speller");
        var error = new IllegalArgumentException("7 cannot be spelt", new RuntimeException("secret"));
        handler.answer(SPELL, count -> {
            throw error;
        });
        var rejected = test.error(near().attach("asker").ask(handler.address(), SPELL, new Count(7), SECOND));
        assertThat(rejected).isInstanceOfSatisfying(RemoteFailure.class, failure -> {
            assertThat(failure.type()).isEqualTo("java.lang.IllegalArgumentException");
            assertThat(failure)
                    .hasMessage(handler.address()
                            + " failed to answer spell: java.lang.IllegalArgumentException: 7 cannot be spelt")
                    .hasNoCause()
                    .hasNoSuppressedExceptions();
        });
        assertThat(take(failures)).as("what stays where it happened").containsExactly(error);
    }

    @Test
    void handlerThatRejects_orReturnsNothing_rejectsTheRequest() {
        var handler = far().attach("speller");
        handler.answer(SPELL, count -> Promise.failed(new IllegalStateException()));
        handler.answer(START, count -> nothing());
        var requester = near().attach("asker");
        assertThat(test.error(requester.ask(handler.address(), SPELL, new Count(7), SECOND)))
                .isInstanceOf(RemoteFailure.class)
                .hasMessageEndingWith("java.lang.IllegalStateException: (no message)");
        assertThat(test.error(requester.ask(handler.address(), START, new Count(7), SECOND)))
                .isInstanceOf(RemoteFailure.class)
                .hasMessageContaining("returned null, expected a promise");
        var empty = far().attach("empty");
        empty.answer(SPELL, count -> promiseOfNothing());
        assertThat(test.error(requester.ask(empty.address(), SPELL, new Count(7), SECOND)))
                .isInstanceOf(RemoteFailure.class)
                .hasMessageEndingWith("the answer is null, expected a " + Text.class.getName());
        assertThat(take(failures)).hasSize(3);
    }

    @Test
    void answerThatIsNestedTooDeep_rejectsTheRequest_byName() {
        var smith = far().attach("smith");
        smith.answer(FORGE, count -> Promise.of(Chain.of(count.value())));
        var requester = near().attach("asker");
        assertThat(test.get(requester.ask(smith.address(), FORGE, new Count(100), SECOND))
                        .value())
                .isEqualTo(99);
        assertThat(test.error(requester.ask(smith.address(), FORGE, new Count(200_000), SECOND)))
                .isInstanceOf(RemoteFailure.class)
                .hasMessageContaining("a value of " + Chain.class.getName()
                        + " cannot leave the process: it is nested deeper than 500 levels");
        assertThat(take(failures)).hasSize(1);
    }

    @Test
    void handlerWhoseErrorHasNoMessageToRead_rejectsTheRequest() {
        var handler = far().attach("speller");
        handler.answer(SPELL, count -> Promise.failed(new Unreadable()));
        assertThat(test.error(near().attach("asker").ask(handler.address(), SPELL, new Count(7), SECOND)))
                .isInstanceOf(RemoteFailure.class)
                .hasMessageEndingWith("(its message could not be read: java.lang.UnsupportedOperationException)");
        assertThat(take(failures)).hasSize(1);
    }

    private static final class Unreadable extends RuntimeException {
        private static final long serialVersionUID = 1L;

        @Override
        public String getMessage() {
            throw new UnsupportedOperationException();
        }
    }

    @SuppressWarnings("NullAway") // an incorrect request handler
    private static Promise<Text> promiseOfNothing() {
        return Promise.of(null);
    }

    @SuppressWarnings("NullAway") // an incorrect request handler
    private static Promise<Text> nothing() {
        return null;
    }

    @Test
    void operation_thatIsAnsweredAlready_orWithoutATimeLimit_isRefused() {
        var port = far().attach("a");
        port.answer(SPELL, BusContract::spelt);
        assertThatThrownBy(() -> port.answer(SPELL, BusContract::spelt))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage(port.address() + " answers spell already");
        assertThatThrownBy(() -> port.ask(port.address(), SPELL, new Count(1), Duration.ZERO))
                .hasMessage("the limit for spell is PT0S, expected more than zero");
    }
}
