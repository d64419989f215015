package io.troupe.services.bus;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.stream.IntStream;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** What every bus promises. The near and the far side may be one node or two. */
abstract class BusContract {
    record Ranges(int number, List<Double> metres, Map<String, Integer> names, Optional<String> note) {}

    record Count(int value) {}

    record Text(String value) {}

    static final Topic<Count> COUNTS = new Topic<>("counts", Count.class);
    static final Topic<Ranges> RANGES = new Topic<>("ranges", Ranges.class);
    static final Operation<Count, Text> SPELL =
            new Operation<>("spell", Count.class, Text.class, Operation.Kind.DATA);
    static final Operation<Count, Text> START =
            new Operation<>("start", Count.class, Text.class, Operation.Kind.CONTROL);
    static final Duration SECOND = Duration.ofSeconds(1);
    static final int CAPACITY = 4;

    final TestSpace test = new TestSpace();
    final List<Loss> losses = new ArrayList<>();
    final List<Message> passed = new ArrayList<>();
    final List<Throwable> failures = new ArrayList<>();

    abstract Bus near();

    abstract Bus far();

    abstract BusMetrics farMetrics();

    abstract BusMetrics nearMetrics();

    BusSettings settings() {
        return BusSettings.on(test.space()).withCapacity(CAPACITY).withObserver(new BusObserver() {
            @Override
            public void lost(Loss loss) {
                losses.add(loss);
            }

            @Override
            public void passed(Message message) {
                passed.add(message);
            }

            @Override
            public void failed(Message question, Throwable error) {
                failures.add(error);
            }
        });
    }

    @AfterEach
    void nothingIsLeft() {
        far().close();
        near().close();
        test.close();
        assertThat(losses).as("losses no test took").isEmpty();
        assertThat(failures).as("failures no test took").isEmpty();
    }

    final <T> List<T> take(List<T> from) {
        var taken = List.copyOf(from);
        from.clear();
        return taken;
    }

    final Loss theOnlyLoss() {
        assertThat(losses).hasSize(1);
        return losses.removeFirst();
    }

    final String refusalOf(Promise<?> promise) {
        Throwable error = test.error(promise);
        assertThat(error).isInstanceOf(BusException.class);
        return String.valueOf(error.getMessage());
    }

    /** Somebody listens, so that a rejection is not reported. */
    private static <T> Promise<T> heard(Promise<T> promise) {
        promise.handle((value, error) -> value);
        return promise;
    }

    private static Promise<Text> spelt(Count count) {
        return Promise.of(new Text("number " + count.value()));
    }

    // ---- publish and subscribe

    @Test
    void values_reachEverySubscriber_inTheOrderOfTheirPublisher_withItsAddress() {
        var publisher = near().attach("publisher");
        var heard = new ArrayList<String>();
        far().attach("a").subscribe(COUNTS, (count, from) -> heard.add("a" + count.value() + " " + from));
        far().attach("b").subscribe(COUNTS, (count, from) -> heard.add("b" + count.value() + " " + from));
        for (int i = 1; i <= 3; i++) {
            publisher.publish(COUNTS, new Count(i));
        }
        assertThat(heard).as("nothing runs on the publisher's stack").isEmpty();
        test.crank();
        String from = " " + publisher.address();
        assertThat(heard.stream().filter(each -> each.startsWith("a")))
                .containsExactly("a1" + from, "a2" + from, "a3" + from);
        assertThat(heard.stream().filter(each -> each.startsWith("b")))
                .containsExactly("b1" + from, "b2" + from, "b3" + from);
    }

    @Test
    void subscriber_hearsWhatIsPublishedFromThenOn_andNothingAfterItHasClosed() {
        var publisher = near().attach("publisher");
        var heard = new ArrayList<Integer>();
        publisher.publish(COUNTS, new Count(1));
        test.crank();
        var subscription = far().attach("a").subscribe(COUNTS, (count, from) -> heard.add(count.value()));
        publisher.publish(COUNTS, new Count(2));
        test.crank();
        subscription.close();
        publisher.publish(COUNTS, new Count(3));
        test.crank();
        assertThat(heard).containsExactly(2);
    }

    @Test
    void subscriptionThatIsClosed_tellsHowManyValuesItDoesNotHear() {
        var publisher = near().attach("publisher");
        var subscription = far().attach("a").subscribe(COUNTS, (count, from) -> {
            throw new AssertionError("it has closed");
        });
        test.run(() -> {
            publisher.publish(COUNTS, new Count(1));
            publisher.publish(COUNTS, new Count(2));
            arrive();
            subscription.close();
        });
        assertThat(theOnlyLoss()).isInstanceOfSatisfying(Loss.Discarded.class, lost -> {
            assertThat(lost.subscriber()).isEqualTo(new Address(far().node(), "a"));
            assertThat(lost.count()).isEqualTo(2);
            assertThat(lost).hasToString(far().node()
                    + "/a does not hear 2 values of counts that waited: it does not subscribe any more");
        });
    }

    /** Brings to the far side what is under way, without a turn of the space in between. */
    abstract void arrive();

    @Test
    void value_thatItsPublisherChangesLater_isHeardAsItWas() {
        var publisher = near().attach("publisher");
        var heard = new ArrayList<Ranges>();
        far().attach("a").subscribe(RANGES, (ranges, from) -> heard.add(ranges));
        var metres = new ArrayList<>(List.of(1.0, 2.0));
        var value = new Ranges(1, metres, new java.util.HashMap<>(Map.of("left", 1)), Optional.of("first"));
        var asItWas = new Ranges(1, List.copyOf(metres), Map.copyOf(value.names()), Optional.of("first"));
        publisher.publish(RANGES, value);
        metres.clear();
        value.names().clear();
        test.crank();
        assertThat(heard).containsExactly(asItWas);
    }

    @Test
    void subscriberThatIsTooSlow_losesTheOldest_andTheObserverHearsOfEach() {
        var publisher = near().attach("publisher");
        var heard = new ArrayList<Integer>();
        var slow = far().attach("slow");
        slow.subscribe(COUNTS, (count, from) -> heard.add(count.value()));
        test.run(() -> {
            for (int i = 1; i <= CAPACITY + 2; i++) {
                publisher.publish(COUNTS, new Count(i));
            }
            arrive();
        });
        assertThat(heard).containsExactly(3, 4, 5, 6);
        assertThat(take(losses)).hasSize(2).allSatisfy(loss -> assertThat(loss)
                .isInstanceOfSatisfying(
                        Loss.Dropped.class,
                        dropped -> assertThat(dropped.subscriber()).isEqualTo(slow.address())));
        var metrics = farMetrics();
        assertThat(metrics.queued()).isEqualTo(metrics.delivered() + metrics.dropped()).isEqualTo(6);
        assertThat(metrics.dropped()).isEqualTo(2);
    }

    @Test
    void subscriberThatThrows_isToldToTheObserver_andTheOthersHearTheValue() {
        var publisher = near().attach("publisher");
        var heard = new ArrayList<Integer>();
        var broken = far().attach("broken");
        broken.subscribe(COUNTS, (count, from) -> {
            throw new IllegalStateException("cannot hear " + count.value());
        });
        far().attach("b").subscribe(COUNTS, (count, from) -> heard.add(count.value()));
        publisher.publish(COUNTS, new Count(1));
        test.crank();
        assertThat(heard).containsExactly(1);
        assertThat(theOnlyLoss()).isInstanceOfSatisfying(Loss.SubscriberFailed.class, lost -> {
            assertThat(lost.subscriber()).isEqualTo(broken.address());
            assertThat(lost.error()).hasMessage("cannot hear 1");
        });
    }

    // ---- request and reply

    @Test
    void question_isAnswered() {
        var answerer = far().attach("speller");
        answerer.answer(SPELL, BusContract::spelt);
        var answer = near().attach("asker").ask(answerer.address(), SPELL, new Count(7), SECOND);
        assertThat(test.get(answer)).isEqualTo(new Text("number 7"));
        assertThat(nearMetrics().answered()).isEqualTo(1);
    }

    @Test
    void messages_ofOperations_areOfTheirKind() {
        var answerer = far().attach("speller");
        answerer.answer(SPELL, BusContract::spelt);
        answerer.answer(START, BusContract::spelt);
        var asker = near().attach("asker");
        test.get(asker.ask(answerer.address(), SPELL, new Count(7), SECOND));
        assertThat(take(passed)).isNotEmpty().allMatch(DataMessage.class::isInstance);
        test.get(asker.ask(answerer.address(), START, new Count(7), SECOND));
        assertThat(take(passed)).isNotEmpty().allMatch(ControlMessage.class::isInstance);
    }

    @Test
    void question_toNobody_isRejectedAtOnce_andNamesWhoIsSimilar() {
        far().attach("wall-follower");
        var to = new Address(far().node(), "wall-folower");
        var asker = near().attach("asker");
        assertThat(refusalOf(asker.ask(to, SPELL, new Count(7), SECOND)))
                .isEqualTo(asker.address() + " asked " + to
                        + " for spell: nobody is there; did you mean wall-follower?");
        assertThat(theOnlyLoss()).isInstanceOf(Loss.Undeliverable.class);
    }

    @Test
    void question_thatNobodyAnswersThere_isRejectedAtOnce_andNamesTheOperationsThereAre() {
        var answerer = far().attach("speller");
        answerer.answer(START, BusContract::spelt);
        var asker = near().attach("asker");
        assertThat(refusalOf(asker.ask(answerer.address(), SPELL, new Count(7), SECOND)))
                .isEqualTo(asker.address() + " asked " + answerer.address()
                        + " for spell: it does not answer that; there are start");
        assertThat(theOnlyLoss()).isInstanceOf(Loss.Undeliverable.class);
    }

    @Test
    void question_toANodeThatIsNotThere_isRejectedAtOnce_andNamesBoth() {
        var asker = near().attach("asker");
        assertThat(refusalOf(asker.ask(new Address("moon", "base"), SPELL, new Count(7), SECOND)))
                .isEqualTo(asker.address() + " asked moon/base for spell: there is no way from node "
                        + near().node() + " to node moon");
        assertThat(theOnlyLoss()).isInstanceOf(Loss.Undeliverable.class);
    }

    @Test
    void question_ofAnotherTypeThanIsAnswered_isRejected_andNamesBoth() {
        var answerer = far().attach("speller");
        answerer.answer(SPELL, BusContract::spelt);
        var other = new Operation<>("spell", Text.class, Text.class, Operation.Kind.DATA);
        assertThat(refusalOf(near().attach("asker").ask(answerer.address(), other, new Text("7"), SECOND)))
                .endsWith("the question is a " + Text.class.getName() + ", expected a " + Count.class.getName());
        assertThat(theOnlyLoss()).isInstanceOf(Loss.Undeliverable.class);
    }

    @Test
    void answer_ofAnotherTypeThanExpected_isRejected_andNamesBoth() {
        var answerer = far().attach("speller");
        answerer.answer(SPELL, BusContract::spelt);
        var other = new Operation<>("spell", Count.class, Count.class, Operation.Kind.DATA);
        assertThat(refusalOf(near().attach("asker").ask(answerer.address(), other, new Count(7), SECOND)))
                .endsWith("the answer is a " + Text.class.getName() + ", expected a " + Count.class.getName());
    }

    @Test
    void answererThatThrows_rejectsWithTheNameAndMessageOfItsError_withoutTheErrorItself() {
        var answerer = far().attach("speller");
        var error = new IllegalArgumentException("7 cannot be spelt", new RuntimeException("secret"));
        answerer.answer(SPELL, count -> {
            throw error;
        });
        var rejected = test.error(near().attach("asker").ask(answerer.address(), SPELL, new Count(7), SECOND));
        assertThat(rejected).isInstanceOfSatisfying(RemoteFailure.class, failure -> {
            assertThat(failure.type()).isEqualTo("java.lang.IllegalArgumentException");
            assertThat(failure)
                    .hasMessage(answerer.address()
                            + " failed to answer spell: java.lang.IllegalArgumentException: 7 cannot be spelt")
                    .hasNoCause()
                    .hasNoSuppressedExceptions();
        });
        assertThat(take(failures)).as("what stays where it happened").containsExactly(error);
    }

    @Test
    void answererThatRejects_orReturnsNothing_rejectsTheQuestion() {
        var answerer = far().attach("speller");
        answerer.answer(SPELL, count -> Promise.failed(new IllegalStateException()));
        answerer.answer(START, count -> BusContract.nothing());
        var asker = near().attach("asker");
        assertThat(test.error(asker.ask(answerer.address(), SPELL, new Count(7), SECOND)))
                .isInstanceOf(RemoteFailure.class)
                .hasMessageEndingWith("java.lang.IllegalStateException: (no message)");
        assertThat(test.error(asker.ask(answerer.address(), START, new Count(7), SECOND)))
                .isInstanceOf(RemoteFailure.class)
                .hasMessageContaining("returned null, expected a promise");
        assertThat(take(failures)).hasSize(2);
    }

    @SuppressWarnings("NullAway") // what a careless answerer does
    private static Promise<Text> nothing() {
        return null;
    }

    @Test
    void answererThatHangs_isRejectedWhenTheTimeIsOver_andItsAnswerIsToldAsLate() {
        var answerer = far().attach("speller");
        var kept = new Deferred<Text>(test.space());
        answerer.answer(SPELL, count -> kept);
        var asker = near().attach("asker");
        var answer = asker.ask(answerer.address(), SPELL, new Count(7), SECOND);
        test.crank();
        test.advance(SECOND.minusMillis(2));
        assertThat(answer.isDone()).isFalse();
        test.advance(Duration.ofMillis(5));
        assertThat(refusalOf(answer))
                .isEqualTo(asker.address() + " asked " + answerer.address() + " for spell: no answer within PT1S");
        assertThat(losses).isEmpty();
        kept.resolve(new Text("at last"));
        test.crank();
        assertThat(theOnlyLoss()).isInstanceOfSatisfying(Loss.Late.class, late -> {
            assertThat(late.answer().payload()).isEqualTo(new Text("at last"));
            assertThat(late.answer().from()).isEqualTo(answerer.address());
        });
        assertThat(nearMetrics().timedOut()).isEqualTo(1);
        assertThat(nearMetrics().late()).isEqualTo(1);
    }

    @Test
    void questionsThatWait_areRejectedAtOnce_whenTheAnswererLeaves() {
        var answerer = far().attach("speller");
        var kept = new Deferred<Text>(test.space());
        answerer.answer(SPELL, count -> kept);
        var asker = near().attach("asker");
        var begun = asker.ask(answerer.address(), SPELL, new Count(1), SECOND);
        test.crank();
        var answers = new ArrayList<Promise<Text>>();
        test.run(() -> {
            answers.add(heard(asker.ask(answerer.address(), SPELL, new Count(2), SECOND)));
            arrive();
            answerer.close();
        });
        String expected = asker.address() + " asked " + answerer.address()
                + " for spell: left before it answered: it has left the bus";
        assertThat(refusalOf(begun)).isEqualTo(expected);
        assertThat(refusalOf(answers.getFirst())).isEqualTo(expected);
        assertThat(take(losses)).hasSize(2).allMatch(Loss.Undeliverable.class::isInstance);
        kept.resolve(new Text("too late"));
        test.crank();
        assertThat(theOnlyLoss()).isInstanceOf(Loss.Late.class);
    }

    @Test
    void questionsThatWait_areRejectedAtOnce_whenTheSpaceOfTheAnswererIsClosed() {
        var other = ActorSpace.create(SpaceSettings.named("other").withHandCrank());
        var answerer = far().attach("speller");
        other.execute(() -> answerer.answer(SPELL, count -> new Deferred<>()));
        other.crank();
        var asker = near().attach("asker");
        var begun = asker.ask(answerer.address(), SPELL, new Count(1), SECOND);
        test.crank();
        other.crank();
        assertThat(begun.isDone()).isFalse();
        other.close();
        assertThat(refusalOf(begun)).endsWith("left before it answered: space other was closed");
        var later = asker.ask(answerer.address(), SPELL, new Count(2), SECOND);
        assertThat(refusalOf(later)).contains("it does not answer that");
        assertThat(take(losses)).hasSize(2).allMatch(Loss.Undeliverable.class::isInstance);
    }

    @Test
    void questionsOfAnAskerThatLeaves_areRejectedAtOnce_andTheirAnswersAreLate() {
        var answerer = far().attach("speller");
        var kept = new Deferred<Text>(test.space());
        answerer.answer(SPELL, count -> kept);
        var asker = near().attach("asker");
        var answer = asker.ask(answerer.address(), SPELL, new Count(1), SECOND);
        test.crank();
        asker.close();
        assertThat(refusalOf(answer)).endsWith("for spell: the asker has left: it has left the bus");
        kept.resolve(new Text("for nobody"));
        test.crank();
        assertThat(theOnlyLoss()).isInstanceOf(Loss.Late.class);
    }

    @Test
    void answererThatIsReplaced_answersUnderTheSameName() {
        var first = far().attach("speller");
        first.answer(SPELL, count -> Promise.of(new Text("first")));
        var asker = near().attach("asker");
        var address = first.address();
        assertThat(test.get(asker.ask(address, SPELL, new Count(1), SECOND))).isEqualTo(new Text("first"));
        first.close();
        far().attach("speller").answer(SPELL, count -> Promise.of(new Text("second")));
        assertThat(test.get(asker.ask(address, SPELL, new Count(1), SECOND))).isEqualTo(new Text("second"));
    }

    @Test
    void answererWithTooManyQuestions_refusesTheNewest() {
        var answerer = far().attach("speller");
        answerer.answer(SPELL, BusContract::spelt);
        var asker = near().attach("asker");
        var answers = new ArrayList<Promise<Text>>();
        test.run(() -> {
            for (int i = 0; i <= CAPACITY; i++) {
                answers.add(heard(asker.ask(answerer.address(), SPELL, new Count(i), SECOND)));
            }
            arrive();
        });
        assertThat(refusalOf(answers.removeLast()))
                .endsWith("for spell: is too busy: 4 questions for spell wait there");
        assertThat(answers).hasSize(CAPACITY).allSatisfy(each -> assertThat(each.isDone()).isTrue());
        assertThat(theOnlyLoss()).isInstanceOf(Loss.Undeliverable.class);
    }

    @Test
    void questionThatIsCancelled_findsItsAnswerLate() {
        var answerer = far().attach("speller");
        answerer.answer(SPELL, BusContract::spelt);
        var answer = near().attach("asker").ask(answerer.address(), SPELL, new Count(1), SECOND);
        answer.cancel();
        test.crank();
        assertThat(theOnlyLoss()).isInstanceOfSatisfying(Loss.Late.class, late -> assertThat(late.why())
                .isEqualTo("the asker has cancelled"));
    }

    // ---- actors

    interface Listener {
        void listen(BusPort port);

        void askAndForget(BusPort port, Address to);
    }

    static final class ListenerActor extends Actor implements Listener {
        private final List<Integer> heard;

        ListenerActor(List<Integer> heard) {
            this.heard = heard;
        }

        @Override
        public void listen(BusPort port) {
            port.subscribe(COUNTS, (count, from) -> heard.add(count.value()));
        }

        @Override
        public void askAndForget(BusPort port, Address to) {
            port.ask(to, SPELL, new Count(1), SECOND).thenAccept(text -> heard.add(1));
        }
    }

    @Test
    void actorThatHasStopped_hearsNothingAnyMore() {
        var heard = new ArrayList<Integer>();
        var listener = test.spawn(Listener.class, () -> new ListenerActor(heard));
        var port = far().attach("a");
        listener.listen(port);
        test.crank();
        var publisher = near().attach("publisher");
        publisher.publish(COUNTS, new Count(1));
        test.crank();
        test.space().stop(listener);
        test.crank();
        publisher.publish(COUNTS, new Count(2));
        test.crank();
        assertThat(heard).containsExactly(1);
        assertThat(take(losses)).singleElement().isInstanceOf(Loss.Discarded.class);
        publisher.publish(COUNTS, new Count(3));
        test.crank();
    }

    @Test
    void otherSpace_hearsOnItsOwnThread_andHasItsOwnClock() {
        var other = new TestSpace();
        var port = far().attach("a");
        var heard = new ArrayList<Integer>();
        other.run(() -> port.subscribe(COUNTS, (count, from) -> {
            assertThat(ActorSpace.current()).isSameAs(other.space());
            heard.add(count.value());
        }));
        near().attach("publisher").publish(COUNTS, new Count(1));
        test.crank();
        assertThat(heard).isEmpty();
        other.crank();
        assertThat(heard).containsExactly(1);
        var hanging = far().attach("hanging");
        hanging.answer(SPELL, count -> new Deferred<>());
        var asker = near().attach("asker");
        var answers = new ArrayList<Promise<Text>>();
        other.run(() -> answers.add(heard(asker.ask(hanging.address(), SPELL, new Count(1), SECOND))));
        test.advance(SECOND.multipliedBy(2));
        assertThat(answers.getFirst().isDone()).isFalse();
        other.advance(SECOND.multipliedBy(2));
        assertThat(other.error(answers.getFirst())).hasMessageEndingWith("no answer within PT1S");
        far().close();
        test.crank();
        take(losses);
        other.close();
    }

    // ---- names and ends

    @Test
    void name_canBeTakenOnce_andIsFreeAgainWhenItsPortIsClosed() {
        var port = far().attach("a");
        assertThatThrownBy(() -> far().attach("a"))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("the name " + far().node() + "/a is taken; there are a on node");
        port.close();
        port.close();
        assertThat(far().attach("a").address()).isEqualTo(port.address());
    }

    @Test
    void port_thatIsClosed_refusesByName() {
        var port = near().attach("a");
        port.close();
        assertThatThrownBy(() -> port.publish(COUNTS, new Count(1)))
                .isInstanceOf(BusException.class)
                .hasMessage(port.address() + " cannot publish on counts: it has left the bus");
        assertThatThrownBy(() -> port.subscribe(COUNTS, (count, from) -> {})).isInstanceOf(BusException.class);
        assertThatThrownBy(() -> port.answer(SPELL, BusContract::spelt)).isInstanceOf(BusException.class);
        assertThat(refusalOf(port.ask(port.address(), SPELL, new Count(1), SECOND)))
                .endsWith("the asker has left: it has left the bus");
    }

    @Test
    void busThatIsClosed_rejectsWhatWaits_andTakesNobody() {
        var answerer = far().attach("speller");
        answerer.answer(SPELL, count -> new Deferred<>());
        var asker = near().attach("asker");
        var answer = asker.ask(answerer.address(), SPELL, new Count(1), SECOND);
        test.crank();
        near().close();
        assertThat(refusalOf(answer)).contains("the bus " + near().node() + " is closed");
        assertThatThrownBy(() -> near().attach("b"))
                .isInstanceOf(BusException.class)
                .hasMessageContaining("is closed");
        far().close();
        test.crank();
        take(losses);
    }

    @Test
    void topic_withTwoTypes_isRefused_andNamesBoth() {
        var port = near().attach("a");
        port.subscribe(COUNTS, (count, from) -> {});
        assertThatThrownBy(() -> port.publish(new Topic<>("counts", Text.class), new Text("1")))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("topic counts is of " + Count.class.getName() + " and of " + Text.class.getName());
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

    @Test
    void messages_ofOneNode_areNumberedUpward() {
        var publisher = near().attach("publisher");
        IntStream.range(0, 3).forEach(i -> publisher.publish(COUNTS, new Count(i)));
        assertThat(take(passed).stream().filter(each -> each.from().equals(publisher.address())).distinct())
                .extracting(Message::sequence)
                .containsExactly(1L, 2L, 3L);
        test.crank();
    }
}
