package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.LibraryAccess;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.function.Function;
import java.util.stream.IntStream;
import org.assertj.core.api.AbstractThrowableAssert;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedClass;
import org.junit.jupiter.params.provider.EnumSource;

/** What every kind of bus does: each test runs on one node, and on two. */
@ParameterizedClass
@EnumSource(BusContract.Wiring.class)
class BusContractTest extends BusContract {
    private final BusPort publisher = near.attach("publisher");
    private final BusPort asker = near.attach("asker");
    private final List<Integer> received = new ArrayList<>();

    BusContractTest(Wiring wiring) {
        super(wiring);
    }

    private void publish(int... values) {
        IntStream.of(values).forEach(value -> publisher.publish(COUNTS, new Count(value)));
    }

    private BusPort.Subscription subscribe(String port) {
        return far.attach(port).subscribe(COUNTS, (count, from) -> received.add(count.value()));
    }

    // ---- publish and subscribe

    @Test
    void values_reachEverySubscriber_inTheOrderOfTheirPublisher_withItsAddress() {
        var texts = new ArrayList<String>();
        far.attach("a").subscribe(COUNTS, (count, from) -> texts.add("a" + count.value() + " " + from));
        far.attach("b").subscribe(COUNTS, (count, from) -> texts.add("b" + count.value() + " " + from));
        publish(1, 2, 3);
        assertThat(texts).as("nothing runs on the publisher's stack").isEmpty();
        test.runQueued();
        String from = " " + publisher.address();
        assertThat(texts)
                .filteredOn(each -> each.startsWith("a"))
                .containsExactly("a1" + from, "a2" + from, "a3" + from);
        assertThat(texts)
                .filteredOn(each -> each.startsWith("b"))
                .containsExactly("b1" + from, "b2" + from, "b3" + from);
    }

    @Test
    void subscriber_receivesWhatIsPublishedFromThenOn_andNothingAfterItHasClosed() {
        publish(1);
        test.runQueued();
        var subscription = subscribe("a");
        publish(2);
        test.runQueued();
        subscription.close();
        publish(3);
        test.runQueued();
        assertThat(received).containsExactly(2);
    }

    @Test
    void subscriptionThatIsClosed_reportsHowManyValuesItDidNotReceive() {
        var subscription = subscribe("a");
        test.run(() -> {
            publish(1, 2);
            pipe.carryAll();
            subscription.close();
        });
        assertThat(received).isEmpty();
        assertThat(theOnlyLoss())
                .isEqualTo(new Loss.DroppedAtEnd(
                        new Address(far.node(), "a"), "counts", 2, "it does not subscribe any more"))
                .hasToString(
                        "2 values of counts for " + far.node() + "/a were dropped: it does not subscribe any more");
    }

    @Test
    void value_thatItsPublisherChangesLater_isReceivedAsItWas() {
        var ranges = new ArrayList<Ranges>();
        far.attach("a").subscribe(RANGES, (value, from) -> ranges.add(value));
        var metres = new ArrayList<>(List.of(1.0, 2.0));
        var value = new Ranges(1, metres, new HashMap<>(Map.of("left", 1)), Optional.of("first"));
        var asItWas = new Ranges(1, List.copyOf(metres), Map.copyOf(value.names()), Optional.of("first"));
        publisher.publish(RANGES, value);
        metres.clear();
        value.names().clear();
        test.runQueued();
        assertThat(ranges).containsExactly(asItWas);
    }

    @Test
    void subscriberThatIsTooSlow_losesTheOldest_andTheObserverIsNotifiedOfEach() {
        subscribe("slow");
        test.run(() -> {
            publish(1, 2, 3, 4, 5, 6);
            pipe.carryAll();
        });
        assertThat(received).containsExactly(3, 4, 5, 6);
        assertThat(take(losses))
                .hasSize(2)
                .allSatisfy(loss ->
                        assertThat(((Loss.Dropped) loss).subscriber()).isEqualTo(new Address(far.node(), "slow")));
        var metrics = far.metrics();
        assertThat(List.of(metrics.queued(), metrics.delivered(), metrics.dropped()))
                .containsExactly(6L, 4L, 2L);
    }

    @Test
    void subscriberThatThrows_isReportedToTheObserver_andTheOthersReceiveTheValue() {
        var broken = far.attach("broken");
        broken.subscribe(COUNTS, (count, from) -> {
            throw new IllegalStateException("cannot hear " + count.value());
        });
        subscribe("b");
        publish(1);
        test.runQueued();
        assertThat(received).containsExactly(1);
        assertThat(theOnlyLoss()).isInstanceOfSatisfying(Loss.SubscriberFailed.class, lost -> {
            assertThat(lost.subscriber()).isEqualTo(broken.address());
            assertThat(lost.error()).hasMessage("cannot hear 1");
        });
    }

    @Test
    void errorOfASubscriber_whoseTextThrows_isReportedWithAnother() {
        subscribe("b");
        far.attach("broken").subscribe(COUNTS, (count, from) -> {
            throw new Unreadable();
        });
        publish(1);
        test.runQueued();
        assertThat(received).containsExactly(1);
        assertThat(theOnlyLoss().toString())
                .endsWith(": what cannot be printed: java.lang.UnsupportedOperationException");
    }

    @Test
    void publication_thatIsNestedTooDeep_orOfASecondType_isRefused_byName() {
        assertThatThrownBy(() -> publisher.publish(CHAINS, Chain.of(200_000)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("a value of " + Chain.class.getName()
                        + " cannot leave the process: it is nested deeper than 500 levels");
        publisher.subscribe(COUNTS, (count, from) -> {});
        assertThatThrownBy(() -> publisher.publish(new BusTopic<>("counts", Text.class), new Text("1")))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining(
                        "topic counts is of " + Count.class.getName() + " and of " + Text.class.getName());
    }

    @Test
    void messages_ofOneNode_areNumberedUpward() {
        publish(0, 1, 2);
        assertThat(take(passed).stream()
                        .filter(each -> each.from().equals(publisher.address()))
                        .distinct())
                .extracting(BusMessage::sequence)
                .containsExactly(1L, 2L, 3L);
        test.runQueued();
    }

    // ---- request and reply

    @Test
    void request_isAnswered_byMessagesOfTheKindOfItsOperation() {
        var speller = speller(BusContract::spelt);
        speller.answer(START, BusContract::spelt);
        assertThat(test.get(ask(asker, speller, 7))).isEqualTo(new Text("number 7"));
        assertThat(near.metrics().answered()).isEqualTo(1);
        assertThat(take(passed)).isNotEmpty().allMatch(BusMessage.Data.class::isInstance);
        test.get(asker.ask(speller.address(), START, new Count(7), SECOND));
        assertThat(take(passed)).isNotEmpty().allMatch(BusMessage.Control.class::isInstance);
    }

    @Test
    void request_thatCannotBeDelivered_isRejectedAtOnce_andNamesWhatThereIs() {
        far.attach("wall-follower");
        var starter = far.attach("starter");
        starter.answer(START, BusContract::spelt);
        var reasons = Map.of(
                new Address(far.node(), "wall-folower"),
                "there is no such port; did you mean wall-follower?",
                starter.address(),
                "it does not answer that; there are start",
                new Address("moon", "base"),
                noWayTo("moon"));
        reasons.forEach((to, reason) -> {
            assertThat(refusalOf(asker.ask(to, SPELL, new Count(7), SECOND)))
                    .isEqualTo(asker.address() + " asked " + to + " for spell: " + reason);
            assertThat(theOnlyLoss()).isInstanceOf(Loss.Undeliverable.class);
        });
    }

    @Test
    void request_orAnswer_ofAnotherTypeThanExpected_isRejected_andNamesBoth() {
        var speller = speller(BusContract::spelt).address();
        var ofText = new Operation<>("spell", Text.class, Text.class, Operation.Kind.DATA);
        boolean bytes = near != far; // which carry no type
        String unreadable = "read it: Count.value: expected a whole number, not a text";
        assertThat(refusalOf(asker.ask(speller, ofText, new Text("7"), SECOND)))
                .endsWith(
                        bytes
                                ? "cannot " + unreadable
                                : "the request is a " + Text.class.getName() + ", expected a " + Count.class.getName());
        assertThat(theOnlyLoss()).isInstanceOf(Loss.Undeliverable.class);
        var toCount = new Operation<>("spell", Count.class, Count.class, Operation.Kind.DATA);
        assertThat(refusalOf(asker.ask(speller, toCount, new Count(7), SECOND)))
                .endsWith(
                        bytes
                                ? "the answer cannot be " + unreadable.replace(" it", "")
                                : "the answer is a " + Text.class.getName() + ", expected a " + Count.class.getName());
        assertTakenLosses(bytes ? 1 : 0, Loss.Unreadable.class);
    }

    @Test
    void handlerThatThrows_rejectsWithTheNameAndMessageOfItsError_withoutTheErrorItself() {
        var error = new IllegalArgumentException("7 cannot be spelt", new RuntimeException("secret"));
        var speller = speller(count -> {
            throw error;
        });
        assertThat(test.error(ask(asker, speller, 7)))
                .hasMessage(speller.address()
                        + " failed to answer spell: java.lang.IllegalArgumentException: 7 cannot be spelt")
                .hasNoCause()
                .hasNoSuppressedExceptions()
                .isInstanceOfSatisfying(
                        RemoteFailure.class,
                        failure -> assertThat(failure.type()).isEqualTo("java.lang.IllegalArgumentException"));
        assertThat(take(failures)).as("what stays where it happened").containsExactly(error);
    }

    @SuppressWarnings("NullAway") // incorrect request handlers
    @Test
    void handlerThatRejects_orReturnsNothing_rejectsTheRequest() {
        assertThatFailure(count -> Promise.failed(new IllegalStateException()))
                .hasMessageEndingWith("java.lang.IllegalStateException: (no message)");
        assertThatFailure(count -> null).hasMessageContaining("returned null, expected a promise");
        assertThatFailure(count -> Promise.of(null))
                .hasMessageEndingWith("the answer is null, expected a " + Text.class.getName());
        assertThatFailure(count -> Promise.failed(new Unreadable()))
                .hasMessageEndingWith("(its message could not be read: java.lang.UnsupportedOperationException)");
    }

    private AbstractThrowableAssert<?, ?> assertThatFailure(Function<Count, Promise<Text>> handler) {
        try (var speller = speller(handler)) {
            var error = test.error(ask(asker, speller, 7));
            assertThat(take(failures)).hasSize(1);
            return assertThat(error).isInstanceOf(RemoteFailure.class);
        }
    }

    private static final class Unreadable extends RuntimeException {
        private static final long serialVersionUID = 1L;

        @Override
        public String getMessage() {
            throw new UnsupportedOperationException();
        }
    }

    @Test
    void answerThatIsNestedTooDeep_rejectsTheRequest_byName() {
        var smith = far.attach("smith");
        smith.answer(FORGE, count -> Promise.of(Chain.of(count.value())));
        var forged = test.get(asker.ask(smith.address(), FORGE, new Count(100), SECOND));
        assertThat(forged.value()).isEqualTo(99);
        assertThat(test.error(asker.ask(smith.address(), FORGE, new Count(200_000), SECOND)))
                .isInstanceOf(RemoteFailure.class)
                .hasMessageContaining("a value of " + Chain.class.getName()
                        + " cannot leave the process: it is nested deeper than 500 levels");
        assertThat(take(failures)).hasSize(1);
    }

    @Test
    void operation_thatIsAnsweredAlready_orWithoutATimeLimit_isRefused() {
        var port = speller(BusContract::spelt);
        assertThatThrownBy(() -> port.answer(SPELL, BusContract::spelt))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage(port.address() + " answers spell already");
        assertThatThrownBy(() -> port.ask(port.address(), SPELL, new Count(1), Duration.ZERO))
                .hasMessage("the limit for spell is PT0S, expected more than zero");
    }

    // ---- request handlers that hang, leave, are replaced or are overloaded; requesters that cancel

    @Test
    void handlerThatHangs_isRejectedWhenTheTimeIsOver_andItsAnswerIsReportedAsLate() {
        Deferred<Text> kept = test.space().deferred();
        var handler = speller(count -> kept);
        var answer = ask(asker, handler, 7);
        test.runQueued();
        test.advance(SECOND.minusMillis(2));
        assertThat(answer.isDone()).isFalse();
        test.advance(Duration.ofMillis(5));
        assertThat(test.error(answer))
                .isInstanceOf(BusTimeoutException.class)
                .hasMessage(asker.address() + " asked " + handler.address() + " for spell: no answer within PT1S");
        assertThat(losses).isEmpty();
        kept.resolve(new Text("at last"));
        test.runQueued();
        assertThat(theOnlyLoss()).isInstanceOfSatisfying(Loss.Late.class, late -> {
            assertThat(late.reply().payload()).isEqualTo(new Text("at last"));
            assertThat(late.reply().from()).isEqualTo(handler.address());
        });
        assertThat(near.metrics().timedOut()).isEqualTo(1);
        assertThat(far.metrics().late()).isEqualTo(1);
    }

    @Test
    void requestsThatWait_areRejectedAtOnce_whenTheHandlerLeaves() {
        Deferred<Text> kept = test.space().deferred();
        var handler = speller(count -> kept);
        var answers = new ArrayList<>(List.of(ask(asker, handler, 1)));
        test.runQueued();
        test.run(() -> {
            answers.add(ask(asker, handler, 2));
            pipe.carryAll();
            handler.close();
        });
        assertThat(answers)
                .extracting(this::refusalOf)
                .containsOnly(asker.address() + " asked " + handler.address()
                        + " for spell: left before it answered: it has left the bus");
        assertTakenLosses(2, Loss.Undeliverable.class);
        kept.resolve(new Text("too late"));
        test.runQueued();
        assertTakenLosses(1, Loss.Late.class);
    }

    /** Returns the answer of the error of a rejected request. */
    private boolean mayHaveRun(Promise<?> request) {
        refusalOf(request);
        return ((BusException) test.error(request)).mayHaveRun();
    }

    @Test
    void rejectedRequest_saysWhetherItMayHaveBeenHandled() {
        Deferred<Text> kept = test.space().deferred();
        var handler = speller(count -> kept);
        var noHandler = far.attach("idle");
        var nobody = new Address(handler.address().node(), "nobody");
        var nowhere = new Address("nowhere", "speller");
        assertThat(mayHaveRun(ask(asker, noHandler, 1))).isFalse();
        assertThat(mayHaveRun(asker.ask(nobody, SPELL, new Count(1), SECOND))).isFalse();
        assertThat(mayHaveRun(asker.ask(nowhere, SPELL, new Count(1), SECOND))).isFalse();
        var begun = ask(asker, handler, 1);
        test.runQueued();
        List<Promise<Text>> waits = new ArrayList<>();
        test.run(() -> {
            for (int i = 0; i <= CAPACITY; i++) {
                waits.add(ask(asker, handler, i));
            }
            pipe.carryAll();
            handler.close();
        });
        assertThat(mayHaveRun(waits.removeLast())).as("the queue was full").isFalse();
        assertThat(waits).noneMatch(this::mayHaveRun);
        assertThat(mayHaveRun(begun)).isTrue();
        kept.resolve(new Text("too late"));

        var hanging = speller(count -> new Deferred<>());
        var overdue = ask(asker, hanging, 1);
        test.runQueued();
        test.advance(SECOND);
        assertThat(mayHaveRun(overdue)).isTrue();
        var left = ask(asker, hanging, 2);
        test.runQueued();
        asker.close();
        assertThat(mayHaveRun(left)).isTrue();
        assertThat(mayHaveRun(asker.ask(hanging.address(), SPELL, new Count(1), SECOND)))
                .as("never sent")
                .isFalse();
        losses.clear();
    }

    @Test
    void connection_hasBeenThereSinceItsLastBreak() {
        test.advance(SECOND.multipliedBy(5));
        assertThat(near.connectedFor()).isEqualTo(SECOND.multipliedBy(5));
        if (near != far && pipe instanceof BytePipe bytes) {
            bytes.disconnect("near");
            assertThat(near.connectedFor()).isZero();
            test.advance(SECOND);
            bytes.reconnect("near");
            test.advance(SECOND);
            assertThat(near.connectedFor()).isEqualTo(SECOND);
            assertThat(far.connectedFor()).isEqualTo(SECOND.multipliedBy(7));
        }
    }

    @Test
    void requestsThatWait_areRejectedAtOnce_whenTheSpaceOfTheHandlerIsClosed() {
        var other = ActorSpace.create(SpaceSettings.named("other").withoutThread());
        var handler = far.attach("speller");
        other.execute(() -> handler.answer(SPELL, count -> new Deferred<>()));
        other.runQueued();
        var begun = ask(asker, handler, 1);
        test.runQueued();
        other.runQueued();
        assertThat(begun.isDone()).isFalse();
        other.close();
        assertThat(refusalOf(begun)).endsWith("left before it answered: space other was closed");
        assertThat(refusalOf(ask(asker, handler, 2))).contains("it does not answer that");
        assertTakenLosses(2, Loss.Undeliverable.class);
    }

    @Test
    void requestsOfARequesterThatLeaves_areRejectedAtOnce_andTheirAnswersAreLate() {
        Deferred<Text> kept = test.space().deferred();
        var answer = ask(asker, speller(count -> kept), 1);
        test.runQueued();
        asker.close();
        assertThat(refusalOf(answer)).endsWith("for spell: the port of the requester was closed: it has left the bus");
        kept.resolve(new Text("for nobody"));
        test.runQueued();
        assertTakenLosses(1, Loss.Late.class);
    }

    @Test
    void handlerThatIsReplaced_answersUnderTheSameName() {
        for (var text : List.of(new Text("first"), new Text("second"))) {
            try (var handler = speller(count -> Promise.of(text))) {
                assertThat(test.get(ask(asker, handler, 1))).isEqualTo(text);
            }
        }
    }

    @Test
    void handlerWithTooManyRequests_refusesTheNewest() {
        var handler = speller(BusContract::spelt);
        var answers = new ArrayList<Promise<Text>>();
        test.run(() -> {
            for (int i = 0; i <= CAPACITY; i++) {
                answers.add(ask(asker, handler, i));
            }
            pipe.carryAll();
        });
        assertThat(refusalOf(answers.removeLast()))
                .endsWith("for spell: is too busy: 4 questions for spell wait there");
        assertThat(answers).hasSize(CAPACITY).allMatch(Promise::isDone);
        assertTakenLosses(1, Loss.Undeliverable.class);
    }

    @Test
    void handlerThatNeverAnswers_refusesTheNewest_whenItHasBegunTooMany() {
        var kept = new ArrayList<Deferred<Text>>();
        var handler = speller(count -> {
            kept.add(test.space().deferred());
            return kept.getLast();
        });
        var answers = new ArrayList<Promise<Text>>();
        for (int i = 0; i <= CAPACITY; i++) {
            answers.add(ask(asker, handler, i));
            test.runQueued();
        }
        assertThat(refusalOf(answers.removeLast()))
                .endsWith("for spell: is too busy: 4 questions for spell are being answered");
        assertTakenLosses(1, Loss.Undeliverable.class);
        kept.forEach(each -> each.resolve(new Text("done")));
        test.runQueued();
        assertThat(answers)
                .hasSize(CAPACITY)
                .allSatisfy(each -> assertThat(test.get(each)).isEqualTo(new Text("done")));
        var next = ask(asker, handler, 5);
        test.runQueued();
        kept.getLast().resolve(new Text("next"));
        assertThat(test.get(next)).isEqualTo(new Text("next"));
    }

    @Test
    void requestThatIsCancelled_isNotHandledIfItStillWaits_elseItsReplyIsLate() {
        var begun = new ArrayList<Deferred<Text>>();
        var speller = speller(count -> {
            begun.add(test.space().deferred());
            return begun.getLast();
        });
        ask(asker, speller, 1).cancel();
        test.runQueued();
        assertThat(begun).isEmpty();
        var answer = ask(asker, speller, 2);
        test.runQueued();
        answer.cancel();
        test.runQueued();
        begun.getFirst().resolve(new Text("two"));
        test.runQueued();
        assertThat(theOnlyLoss())
                .isInstanceOfSatisfying(
                        Loss.Late.class, late -> assertThat(late.why()).isEqualTo("no caller waits for it any more"));
    }

    private record Speller(Promise<Text> work) implements LibraryAccess.Work {
        @Override
        public void run() {
            work.cancel();
        }

        Promise<Text> answer() {
            Deferred<Text> answer = LibraryAccess.deferred(null, this);
            answer.resolveFrom(work);
            return answer;
        }
    }

    @Test
    void answerThatCanBeCancelled_isCancelledWithItsRequest_alsoWhileItsHandlerRuns() {
        var asked = new ArrayList<Promise<Text>>();
        var work = new ArrayList<Deferred<Text>>();
        var speller = speller(count -> {
            work.add(test.space().deferred());
            if (count.value() == 2) {
                asked.getLast().cancel();
            }
            return new Speller(work.getLast()).answer();
        });
        asked.add(ask(asker, speller, 1));
        test.runQueued();
        asked.getFirst().cancel();
        test.runQueued();
        assertThat(work.getFirst().isCancelled()).isTrue();
        asked.add(ask(asker, speller, 2));
        test.runQueued();
        assertThat(work.getLast().isCancelled()).isTrue();
        asked.add(ask(asker, speller, 3));
        test.runQueued();
        work.getLast().resolve(new Text("three"));
        assertThat(test.get(asked.getLast())).isEqualTo(new Text("three"));
    }

    // ---- ports, actors and spaces that are opened and closed

    interface Listener {
        void listen(BusPort port);

        void listenOnce(BusPort port);
    }

    private final class ListenerActor extends Actor implements Listener {
        @Override
        public void listen(BusPort port) {
            port.subscribe(COUNTS, (count, from) -> received.add(count.value()));
        }

        @Override
        public void listenOnce(BusPort port) {
            port.subscribe(COUNTS, (count, from) -> {
                received.add(count.value());
                context().stop();
            });
        }
    }

    @Test
    void actorThatHasStopped_receivesNothingAnyMore() {
        var listener = test.spawn(Listener.class, ListenerActor::new);
        listener.listen(far.attach("a"));
        test.runQueued();
        publish(1);
        test.runQueued();
        test.space().stop(listener);
        test.runQueued();
        publish(2);
        test.runQueued();
        assertThat(received).containsExactly(1);
        assertTakenLosses(1, Loss.DroppedAtEnd.class);
        publish(3);
        test.runQueued();
    }

    @Test
    void actorThatStopsWithValuesOnTheirWay_isMissedWithTheNextValue_andAllAreReported() {
        var listener = test.spawn(Listener.class, ListenerActor::new);
        var port = near.attach("a");
        listener.listenOnce(port);
        listener.listenOnce(port);
        test.runQueued();
        publish(1);
        test.runQueued();
        assertThat(received)
                .as("heard by the first subscription, whose actor stopped then")
                .containsExactly(1);
        publish(2);
        assertThat(take(losses).stream().map(loss -> ((Loss.DroppedAtEnd) loss).count()))
                .as("unheard by the first and by the second")
                .containsExactly(1, 2);
        test.runQueued();
    }

    @Test
    void otherSpace_receivesOnItsThread_andHasItsClock() {
        var other = new TestSpace();
        var port = far.attach("a");
        var spaces = new ArrayList<ActorSpace>();
        other.run(() -> port.subscribe(COUNTS, (count, from) -> spaces.add(ActorSpace.current())));
        publish(1);
        test.runQueued();
        assertThat(spaces).isEmpty();
        other.runQueued();
        assertThat(spaces).containsExactly(other.space());
        var hanging = speller(count -> new Deferred<>());
        var answers = new ArrayList<Promise<Text>>();
        other.run(() -> answers.add(ask(asker, hanging, 1)));
        test.advance(SECOND.multipliedBy(2));
        assertThat(answers.getFirst().isDone()).isFalse();
        other.advance(SECOND.multipliedBy(2));
        assertThat(other.error(answers.getFirst())).hasMessageEndingWith("no answer within PT1S");
        far.close();
        test.runQueued();
        take(losses);
        other.close();
    }

    @Test
    void name_canBeTakenOnce_andIsFreeAgainWhenItsPortIsClosed() {
        var port = speller(BusContract::spelt);
        String others = near == far ? "asker, publisher, " : "";
        assertThatThrownBy(() -> far.attach("speller"))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining(
                        "the name " + far.node() + "/speller is taken; there are " + others + "speller on node");
        port.close();
        port.close();
        assertThat(far.attach("speller").address()).isEqualTo(port.address());
    }

    @Test
    void port_thatIsClosed_refusesByName() {
        asker.close();
        assertThatThrownBy(() -> asker.publish(COUNTS, new Count(1)))
                .isInstanceOf(BusException.class)
                .hasMessage(asker.address() + " cannot publish on counts: it has left the bus");
        assertThatThrownBy(() -> asker.subscribe(COUNTS, (count, from) -> {})).isInstanceOf(BusException.class);
        assertThatThrownBy(() -> asker.answer(SPELL, BusContract::spelt)).isInstanceOf(BusException.class);
        assertThat(refusalOf(ask(asker, asker, 1)))
                .endsWith("the port of the requester was closed: it has left the bus");
    }

    @Test
    void busThatIsClosed_rejectsWhatWaits_andTakesNobody() {
        var answer = ask(asker, speller(count -> new Deferred<>()), 1);
        test.runQueued();
        near.close();
        assertThat(refusalOf(answer)).contains("the bus " + near.node() + " is closed");
        assertThatThrownBy(() -> near.attach("b"))
                .isInstanceOf(BusException.class)
                .hasMessageContaining("is closed");
        far.close();
        test.runQueued();
        take(losses);
    }
}
