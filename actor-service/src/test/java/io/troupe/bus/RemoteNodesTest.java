package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.bus.BusMessage.Failure;
import io.troupe.bus.BusMessage.Purpose;
import io.troupe.bus.Operation.Kind;
import io.troupe.bus.internal.RecordCodec;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Optional;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** One node with other nodes behind a scripted engine: what it sends, and what it does with what arrives. */
class RemoteNodesTest {
    record Count(int value) {}

    record Text(String value) {}

    private static final BusTopic<Count> COUNTS = new BusTopic<>("counts", Count.class);
    private static final Operation<Count, Text> SPELL = new Operation<>("spell", Count.class, Text.class, Kind.DATA);
    private static final Duration SECOND = Duration.ofSeconds(1);
    private static final Address FAR = new Address("far", "b");
    private static final Address NEAR = new Address("near", "a");
    private static final long FAR_LIFE = 77;

    private final TestSpace test = new TestSpace();
    private final List<String> losses = new ArrayList<>();
    private final List<String> events = new ArrayList<>();
    private final ScriptedEngine engine = new ScriptedEngine();
    private final RecordCodec codec = new RecordCodec();
    private final Frames farFrames = new Frames(codec, test.clock(), FAR_LIFE);
    private final Bus bus = Bus.open("near", engine, settings());
    private final BusPort port = bus.attach("a");

    private BusSettings settings() {
        return BusSettings.on(test.space()).withCapacity(4).withObserver(new BusObserver() {
            @Override
            public void lost(Loss loss) {
                losses.add(loss.toString());
            }

            @Override
            public void failed(BusMessage request, Throwable error) {
                events.add(request.purpose() + " failed: " + error.getMessage());
            }

            @Override
            public void disconnected(String why) {
                events.add("disconnected: " + why);
            }

            @Override
            public void connected() {
                events.add("connected");
            }
        });
    }

    @AfterEach
    void everyLossWasExpected() {
        bus.close();
        assertThat(engine.closed).isTrue();
        test.runQueued();
        test.close();
        assertThat(losses).isEmpty();
        assertThat(events).isEmpty();
    }

    private static <T> List<T> take(List<T> from) {
        var taken = List.copyOf(from);
        from.clear();
        return taken;
    }

    private void arrives(byte[] frame) {
        engine.listener().frame(frame);
    }

    private byte[] publication(long series, int value) {
        var message = new BusMessage.Data(FAR, new Purpose.Publication("counts"), series, new Count(value));
        return farFrames.publication(message, "counts", series, 0);
    }

    private byte[] request(long number, Duration limit, Record payload) {
        var purpose = new Purpose.Request(NEAR, "spell");
        var message = new BusMessage.Data(FAR, purpose, number, payload);
        return farFrames.request(message, purpose, limit.toNanos() / 1_000, false);
    }

    private byte[] reply(long request, long toIncarnation, Record payload) {
        var purpose = new Purpose.Reply(NEAR, "spell", request);
        return farFrames.reply(new BusMessage.Data(FAR, purpose, 1, payload), purpose, toIncarnation);
    }

    /** The other node answers the request for its time, which is the last frame that was sent. */
    private void farAnswersItsTime() {
        farAnswersItsTime(farFrames);
    }

    private void farAnswersItsTime(Frames life) {
        var asked = engine.sent.removeLast();
        assertThat(Frames.read(asked.frame(), "far").body().purpose())
                .isEqualTo(new Purpose.Request(new Address("far", "$bus"), "time"));
        var purpose = new Purpose.Reply(new Address("near", "$bus"), "time", asked.number());
        var message = new BusMessage.Data(new Address("far", "$bus"), purpose, 1, FirstContacts.NOTHING);
        arrives(life.reply(message, purpose, engine.incarnation));
    }

    private List<Integer> subscribe(BusTopic<Count> topic) {
        var received = new ArrayList<Integer>();
        test.run(() -> port.subscribe(topic, (count, from) -> received.add(count.value())));
        return received;
    }

    private static <T> Promise<T> heard(Promise<T> promise) {
        promise.handle((value, error) -> value);
        return promise;
    }

    // ---- publications

    @Test
    void engine_isToldOfTheFirstAndLastSubscriptionToATopic() {
        var first = port.subscribe(COUNTS, (count, from) -> {});
        var second = bus.attach("c").subscribe(COUNTS, (count, from) -> {});
        assertThat(take(engine.topics)).containsExactly("+counts");
        first.close();
        assertThat(take(engine.topics)).isEmpty();
        second.close();
        assertThat(take(engine.topics)).containsExactly("-counts");
    }

    @Test
    void publications_areNumberedPerPortAndTopic_andMarkedOnceTheTopicIsQuiet() {
        var other = bus.attach("c");
        port.publish(COUNTS, new Count(1));
        other.publish(COUNTS, new Count(1));
        port.publish(COUNTS, new Count(2));
        port.publish(new BusTopic<>("others", Count.class), new Count(1));
        assertThat(engine.takeSent("far"))
                .containsExactly(
                        "publish counts: Published[purpose=publication on counts, series=1, ageMicros=0]",
                        "publish counts: Published[purpose=publication on counts, series=1, ageMicros=0]",
                        "publish counts: Published[purpose=publication on counts, series=2, ageMicros=0]",
                        "publish others: Published[purpose=publication on others, series=1, ageMicros=0]");
        test.advance(SECOND.plusMillis(1));
        assertThat(engine.takeSent("far"))
                .containsExactlyInAnyOrder(
                        "publish counts: Mark[purpose=publication on counts, series=1, begunMicros=OptionalLong[0]]",
                        "publish counts: Mark[purpose=publication on counts, series=2, begunMicros=OptionalLong[0]]",
                        "publish others: Mark[purpose=publication on others, series=1, begunMicros=OptionalLong[0]]");
        test.advance(SECOND);
        assertThat(engine.sent).isEmpty();
        for (int seconds : new int[] {2, 4, 8, 16}) { // again: a subscriber may have been cut off
            test.advance(SECOND.multipliedBy(seconds));
            assertThat(engine.takeSent("far")).hasSize(3).allMatch(each -> each.contains(": Mark["));
        }
        test.advance(SECOND.multipliedBy(100));
        assertThat(engine.sent).isEmpty();
        port.publish(COUNTS, new Count(3));
        port.close(); // nothing follows: the mark comes at once
        assertThat(engine.takeSent("far"))
                .containsExactly(
                        "publish counts: Published[purpose=publication on counts, series=3, ageMicros=0]",
                        "publish counts: Mark[purpose=publication on counts, series=3, begunMicros=OptionalLong[0]]");
        test.advance(SECOND.multipliedBy(2));
    }

    @Test
    void newSeries_isMarkedWhileItIsNotQuiet_andAgainAfterAWhile() {
        List<Integer> markedAfterTenths = new ArrayList<>();
        for (int tenths = 0; tenths <= 600; tenths++) {
            port.publish(COUNTS, new Count(tenths));
            if (engine.takeSent("far").stream().anyMatch(each -> each.contains(": Mark["))) {
                markedAfterTenths.add(tenths);
            }
            test.advance(Duration.ofMillis(100));
        }
        assertThat(markedAfterTenths).containsExactly(10, 30, 70, 150, 310);
    }

    @Test
    void topicThatIsNotQuietYet_isMarkedByALaterRound_andAllAtTheEndOfTheNode() {
        port.publish(COUNTS, new Count(1));
        test.advance(Duration.ofMillis(500));
        port.publish(new BusTopic<>("others", Count.class), new Count(1));
        engine.sent.clear();
        test.advance(Duration.ofMillis(501));
        assertThat(engine.takeSent("far"))
                .containsExactly(
                        "publish counts: Mark[purpose=publication on counts, series=1, begunMicros=OptionalLong[0]]");
        test.advance(SECOND);
        assertThat(engine.takeSent("far"))
                .containsExactly(
                        "publish others: Mark[purpose=publication on others, series=1, begunMicros=OptionalLong[500000]]");
        port.publish(COUNTS, new Count(2));
        engine.sent.clear();
        bus.close();
        assertThat(engine.takeSent("far"))
                .containsExactly(
                        "publish counts: Mark[purpose=publication on counts, series=2, begunMicros=OptionalLong[0]]");
        test.advance(SECOND.multipliedBy(2));
    }

    @Test
    void publication_whileDisconnected_isReported_andLeavesNoGap() {
        engine.why = "it is disconnected";
        port.publish(COUNTS, new Count(1));
        assertThat(take(losses))
                .containsExactly("publication on counts from near/a (number 1) cannot be delivered:"
                        + " the way from node near to the others failed: it is disconnected");
        engine.why = null;
        port.publish(COUNTS, new Count(2));
        assertThat(engine.takeSent("far"))
                .containsExactly("publish counts: Published[purpose=publication on counts, series=1, ageMicros=0]");
        test.advance(SECOND.multipliedBy(2));
    }

    @Test
    void value_thatIsTooLargeForAFrame_isReported_andDeliveredAtHome() {
        var texts = new BusTopic<>("texts", Text.class);
        var received = new ArrayList<Text>();
        port.subscribe(texts, (text, from) -> received.add(text));
        port.publish(texts, new Text("x".repeat(2_000)));
        test.runQueued();
        assertThat(received).hasSize(1);
        assertThat(take(losses))
                .singleElement()
                .asString()
                .contains("java.lang.IllegalArgumentException: it has ")
                .endsWith(" bytes, expected at most 1000");
    }

    @Test
    void gap_inPublications_isReportedWithItsSize_alsoAtTheEnd_andNotForTheFirstValueOrANewLife() {
        var received = subscribe(COUNTS);
        arrives(publication(5, 5));
        farAnswersItsTime();
        arrives(publication(6, 6));
        assertThat(losses).isEmpty();
        arrives(publication(9, 9));
        assertThat(take(losses)).containsExactly("2 values of counts from far/b have not arrived");
        arrives(farFrames.mark(FAR, "counts", 9, 0));
        assertThat(losses).isEmpty();
        arrives(farFrames.mark(FAR, "counts", 13, 0));
        assertThat(take(losses)).containsExactly("4 values of counts from far/b have not arrived");
        var message = new BusMessage.Data(FAR, new Purpose.Publication("counts"), 1, new Count(20));
        var newLife = new Frames(codec, test.clock(), FAR_LIFE + 1);
        arrives(newLife.publication(message, "counts", 20, 0));
        farAnswersItsTime(newLife);
        test.runQueued();
        assertThat(received).containsExactly(5, 6, 9, 20);
        assertThat(bus.metrics().missed()).isEqualTo(6);
    }

    @Test
    void firstValuesOfANodeThatWasOpenedAfterTheSubscription_areMissed() {
        var received = subscribe(COUNTS);
        test.advance(SECOND);
        var late = new Frames(codec, test.clock(), FAR_LIFE + 1);
        var message = new BusMessage.Data(FAR, new Purpose.Publication("counts"), 1, new Count(4));
        byte[] heldUp = late.publication(message, "counts", 4, 0);
        test.advance(SECOND);
        arrives(heldUp);
        farAnswersItsTime(late);
        test.runQueued();
        assertThat(received).containsExactly(4);
        assertThat(take(losses)).containsExactly("3 values of counts from far/b have not arrived");
    }

    @Test
    void firstValuesOfASeriesThatBeganAfterTheSubscription_areMissed_onceAMarkArrives() {
        var received = subscribe(COUNTS); // the other node is open already
        test.advance(SECOND);
        long begunNanos = test.clock().nanos();
        test.advance(SECOND);
        arrives(publication(4, 4));
        farAnswersItsTime();
        arrives(publication(5, 5));
        assertThat(losses).as("when values 1 to 3 were published is not known").isEmpty();
        arrives(markWithoutBegin(5));
        assertThat(losses).as("of a small node").isEmpty();
        arrives(farFrames.mark(FAR, "counts", 6, begunNanos)); // earlier ones may have been lost
        assertThat(take(losses)).containsExactly("4 values of counts from far/b have not arrived");
        arrives(farFrames.mark(FAR, "counts", 6, begunNanos));
        arrives(publication(7, 7));
        test.runQueued();
        assertThat(losses).as("each is reported once").isEmpty();
        assertThat(received).containsExactly(4, 5, 7);
        assertThat(bus.metrics().missed()).isEqualTo(4);
    }

    @Test
    void firstValuesOfASeriesThatBeganBeforeTheSubscription_areNotMissed() {
        long begunNanos = test.clock().nanos();
        test.advance(SECOND);
        subscribe(COUNTS);
        arrives(publication(4, 4));
        farAnswersItsTime();
        arrives(farFrames.mark(FAR, "counts", 4, begunNanos));
        test.runQueued();
        assertThat(losses).isEmpty();
    }

    @Test
    void onlyValueOfASeries_isMissed_alsoIfItsMarkIsTheFirstFrameOfItsNode_andWasHeldUp() {
        subscribe(COUNTS);
        test.advance(SECOND);
        byte[] heldUp = farFrames.mark(FAR, "counts", 1, test.clock().nanos());
        test.advance(SECOND);
        arrives(heldUp);
        assertThat(losses).isEmpty();
        farAnswersItsTime();
        assertThat(take(losses)).containsExactly("1 values of counts from far/b have not arrived");
    }

    @Test
    void onlyValueOfASeriesBeforeTheSubscription_isNotMissed_whenItsMarkWasHeldUp() {
        byte[] heldUp = farFrames.mark(FAR, "counts", 1, test.clock().nanos());
        test.advance(SECOND);
        subscribe(COUNTS);
        test.advance(SECOND);
        arrives(heldUp);
        farAnswersItsTime();
        assertThat(losses).isEmpty();
    }

    /** As nodes in other languages may send it. */
    private byte[] markWithoutBegin(long last) {
        byte[] mark = farFrames.mark(FAR, "counts", last, 0);
        byte[] shorter = Arrays.copyOf(mark, mark.length - 1); // the number 0 is one byte
        shorter[0]--; // an array with one element fewer
        return shorter;
    }

    @Test
    void valuesMissedWhileNothingWasSubscribed_areNoGap() {
        var subscription = port.subscribe(COUNTS, (count, from) -> {});
        arrives(publication(1, 1));
        subscription.close();
        assertThat(take(losses))
                .containsExactly("1 values of counts for near/a were dropped: it does not subscribe any more");
        subscribe(COUNTS);
        arrives(publication(9, 9));
        test.runQueued();
        assertThat(losses).isEmpty();
    }

    @Test
    void topicWithAnAgeLimit_dropsWhatWasHeldUp_onTheWayOrInTheQueue() {
        var drive = COUNTS.withMaxAge(Duration.ofMillis(300));
        var received = subscribe(drive);
        arrives(publication(1, 1));
        farAnswersItsTime();
        byte[] heldUp = publication(2, 2);
        test.advance(Duration.ofMillis(301));
        arrives(heldUp);
        arrives(publication(3, 3));
        test.runQueued();
        assertThat(received).containsExactly(1, 3);
        assertThat(take(losses))
                .containsExactly(
                        "near/a does not receive publication on counts from far/b (number 2): it is 301 ms old");
        assertThat(bus.metrics().stale()).isEqualTo(1);
        assertThatThrownBy(() -> COUNTS.withMaxAge(Duration.ZERO))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("the greatest age of values of topic counts is PT0S, expected more than zero");
    }

    @Test
    void firstFramesOfANode_thatWereAllHeldUp_areAsOldAsTheyAre() {
        var received = subscribe(COUNTS.withMaxAge(Duration.ofMillis(300)));
        List<byte[]> heldUp = new ArrayList<>();
        for (int value = 1; value <= 3; value++) {
            heldUp.add(publication(value, value));
            test.advance(Duration.ofMillis(100));
        }
        test.advance(Duration.ofSeconds(5));
        heldUp.forEach(this::arrives);
        arrives(publication(4, 4));
        test.runQueued();
        assertThat(received).as("held until their age is known").isEmpty();
        farAnswersItsTime();
        test.runQueued();
        assertThat(received).containsExactly(4);
        assertThat(take(losses))
                .hasSize(3)
                .last()
                .isEqualTo("near/a does not receive publication on counts from far/b (number 3): it is 5100 ms old");
        arrives(publication(5, 5));
        test.runQueued();
        assertThat(received).containsExactly(4, 5);
        assertThat(engine.sent).isEmpty();
    }

    @Test
    void nodeWhoseAgesMatter_isAskedAgain_whileItsAnswerIsSlow_missing_orThatOfAnotherLife() {
        var received = subscribe(COUNTS.withMaxAge(SECOND));
        arrives(publication(1, 1));
        test.advance(Duration.ofMillis(200));
        farAnswersItsTime();
        assertThat(engine.sent).as("asked again, because the answer was slow").hasSize(1);
        engine.listener().unreachable("far", engine.sent.removeLast().number(), "no such node");
        test.advance(Duration.ofMillis(500));
        var asked = engine.sent.getLast();
        var other = new Frames(codec, test.clock(), FAR_LIFE + 1);
        var rejection = new Purpose.Rejection(new Address("near", "$bus"), "time", asked.number());
        var ofOther = new BusMessage.Data(FAR, rejection, 1, new BusMessage.Failure.NotDelivered("no"));
        arrives(other.rejection(ofOther, rejection, engine.incarnation));
        test.runQueued();
        assertThat(received).isEmpty();
        engine.sent.removeLast();
        arrives(farFrames.rejection(ofOther, rejection, engine.incarnation)); // a small node that knows no such request
        test.runQueued();
        assertThat(received).containsExactly(1);
    }

    @Test
    void nodeThatDoesNotAnswerHowOldItsFramesAre_losesThem_withTheirCount() {
        var received = subscribe(COUNTS.withMaxAge(SECOND));
        for (int value = 1; value <= 1_002; value++) {
            arrives(publication(value, value));
        }
        for (int attempt = 1; attempt <= 6; attempt++) {
            assertThat(take(losses)).isEmpty();
            test.advance(Duration.ofMillis(500));
        }
        assertThat(take(losses))
                .containsExactly("1002 messages were lost: node far does not answer how old its messages are");
        assertThat(engine.sent).hasSize(6);
        assertThat(received).isEmpty();
        engine.sent.clear();
        arrives(publication(1_003, 1_003));
        farAnswersItsTime();
        test.runQueued();
        assertThat(received).containsExactly(1_003);
    }

    @Test
    void requestForTheTime_isAnsweredAtOnce() {
        var purpose = new Purpose.Request(new Address("near", "$bus"), "time");
        arrives(farFrames.request(new BusMessage.Data(FAR, purpose, 9, FirstContacts.NOTHING), purpose, 0, false));
        assertThat(engine.takeSent("far"))
                .containsExactly("reply far: Replied[purpose=reply to far/b for time, kind=CONTROL, toIncarnation=77]");
    }

    @Test
    void topicThatKeepsOnlyTheLatest_replacesWhatWaits() {
        var received = subscribe(COUNTS.withCapacity(1));
        for (int value = 1; value <= 3; value++) {
            arrives(publication(value, value));
        }
        test.runQueued();
        assertThat(received).containsExactly(3);
        assertThat(bus.metrics().replaced()).isEqualTo(2);
        assertThat(bus.metrics().dropped()).isZero();
    }

    // ---- requests

    @Test
    void request_carriesItsLimit_andIsCancelledThere_whenItIsOver() {
        var answer = heard(port.ask(FAR, SPELL, new Count(1), SECOND));
        assertThat(engine.takeSent("far"))
                .containsExactly(
                        "send far: Requested[purpose=request to far/b for spell, kind=DATA, limitMicros=1000000,"
                                + " isShared=false]");
        test.runQueued();
        test.advance(SECOND.plusMillis(1));
        assertThat(answer.error()).isInstanceOf(BusTimeoutException.class);
        assertThat(engine.takeSent("far")).containsExactly("send far: Cancelled[purpose=request to far/b for spell]");
    }

    @Test
    void request_withoutALimit_carriesNone() {
        var answer = heard(port.ask(FAR, SPELL, new Count(1), null));
        assertThat(engine.takeSent("far"))
                .containsExactly("send far: Requested[purpose=request to far/b for spell, kind=DATA, limitMicros=0,"
                        + " isShared=false]");
        engine.why = "it is disconnected";
        answer.cancel();
        assertThat(engine.sent).as("no cancellation while disconnected").isEmpty();
    }

    @Test
    void request_inATurnWithALimit_carriesTheRestOfIt_andThatItIsShared() {
        List<Promise<Text>> asked = new ArrayList<>();
        test.space()
                .within(SECOND, () -> {
                    test.clock().advance(Duration.ofMillis(400));
                    asked.add(heard(port.ask(FAR, SPELL, new Count(1), SECOND)));
                    return asked.getFirst();
                })
                .exceptionally(late -> new Text(""));
        test.runQueued();
        assertThat(engine.takeSent("far"))
                .containsExactly("send far: Requested[purpose=request to far/b for spell, kind=DATA,"
                        + " limitMicros=600000, isShared=true]");
        test.advance(SECOND);
        assertThat(asked.getFirst().error()).isInstanceOf(BusTimeoutException.class);
        engine.sent.clear();
    }

    @Test
    void requestWithASharedLimit_isHandledInATurnWithTheRestOfIt_alsoOnThisNode() {
        List<Optional<Duration>> left = new ArrayList<>();
        port.answer(SPELL, count -> {
            left.add(Optional.ofNullable(ActorSpace.timeLeft()));
            if (count.value() < 0) {
                throw new IllegalStateException("not that");
            }
            return Promise.of(new Text("" + count.value()));
        });
        arrives(request(1, SECOND, new Count(1)));
        farAnswersItsTime();
        var purpose = new Purpose.Request(NEAR, "spell");
        var message = new BusMessage.Data(FAR, purpose, 2, new Count(2));
        arrives(farFrames.request(message, purpose, 1_000_000, true));
        test.clock().advance(Duration.ofMillis(400));
        test.runQueued();
        var here = test.space().within(SECOND, () -> port.ask(NEAR, SPELL, new Count(3), SECOND.multipliedBy(2)));
        assertThat(test.get(here)).isEqualTo(new Text("3"));
        var failing = test.space().within(SECOND, () -> port.ask(NEAR, SPELL, new Count(-1), SECOND));
        assertThat(test.error(failing)).isInstanceOf(RemoteFailure.class);
        assertThat(left)
                .containsExactly(
                        Optional.empty(),
                        Optional.of(Duration.ofMillis(600)),
                        Optional.of(SECOND),
                        Optional.of(SECOND));
        engine.sent.clear();
        assertThat(take(events)).containsExactly("request to near/a for spell failed: not that");
    }

    @Test
    void requestThatWasHeldUpOnItsWay_hasOnlyTheRestOfItsLimit() {
        var handled = new ArrayList<Integer>();
        port.answer(SPELL, count -> {
            handled.add(count.value());
            return Promise.of(new Text(""));
        });
        arrives(request(1, SECOND, new Count(1)));
        farAnswersItsTime();
        byte[] heldUp = request(2, SECOND, new Count(2));
        test.advance(Duration.ofMillis(600));
        arrives(heldUp);
        test.clock().advance(Duration.ofMillis(500));
        test.runQueued();
        assertThat(handled).containsExactly(1);
        assertThat(take(losses)).singleElement().asString().contains("got to it after the limit");
        engine.sent.clear();
    }

    @Test
    void requestFromAnotherNode_isHandled_rejectedWhenItComesTooLate_andNotHandledWhenItWasCancelled() {
        var handled = new ArrayList<Integer>();
        port.answer(SPELL, count -> {
            handled.add(count.value());
            return Promise.of(new Text("number " + count.value()));
        });
        arrives(request(1, SECOND, new Count(1)));
        farAnswersItsTime();
        test.runQueued();
        assertThat(engine.takeSent("far"))
                .containsExactly("reply far: Replied[purpose=reply to far/b for spell, kind=DATA, toIncarnation=77]");
        arrives(request(2, SECOND, new Count(2)));
        test.clock().advance(SECOND.plusMillis(1));
        test.runQueued();
        assertThat(engine.takeSent("far"))
                .containsExactly(
                        "reply far: Rejected[purpose=rejection to far/b for spell, kind=DATA, toIncarnation=77]");
        assertThat(take(losses)).singleElement().asString().endsWith("got to it after the limit of 1000 ms");
        arrives(request(3, SECOND, new Count(3)));
        var purpose = new Purpose.Request(NEAR, "spell");
        arrives(farFrames.cancellation(new BusMessage.Data(FAR, purpose, 3, new Count(3)), purpose));
        test.runQueued();
        assertThat(engine.sent).isEmpty();
        assertThat(handled).containsExactly(1);
    }

    @Test
    void requestsOfALifeThatHasEnded_areNotAwaited() {
        var kept = new ArrayList<Deferred<Text>>();
        port.answer(SPELL, count -> {
            kept.add(test.space().deferred());
            return kept.getLast();
        });
        arrives(request(1, SECOND, new Count(1)));
        farAnswersItsTime();
        test.runQueued();
        engine.listener().gone("far", FAR_LIFE + 1);
        engine.listener().gone("far", FAR_LIFE);
        kept.getFirst().resolve(new Text("late"));
        test.runQueued();
        assertThat(engine.sent).isEmpty();
        assertThat(take(losses)).singleElement().asString().endsWith("is late: no caller waits for it any more");
    }

    @Test
    void requestToANodeThatDoesNotExist_isRejectedAtOnce() {
        var answer = heard(port.ask(FAR, SPELL, new Count(1), SECOND));
        engine.listener().unreachable("far", engine.sent.getFirst().number(), "no such node");
        assertThat(answer.error())
                .isInstanceOf(BusException.class)
                .hasMessage("near/a asked far/b for spell: no such node");
        assertThat(take(losses))
                .containsExactly("request to far/b for spell from near/a (number 1) cannot be delivered: no such node");
        assertThat(engine.takeSent("far")).as("no cancellation").hasSize(1);
    }

    @Test
    void whatWasSentToANodeThatIsRefused_isRejectedOrReported_andOtherNodesAreNot() {
        var answer = heard(port.ask(FAR, SPELL, new Count(1), SECOND));
        var other = heard(port.ask(new Address("third", "b"), SPELL, new Count(1), SECOND));
        port.send(FAR, SPELL, new Count(2));
        port.send(new Address("third", "b"), SPELL, new Count(2));
        engine.listener().rejected("far", "no permission");
        assertThat(answer.error()).hasMessage("near/a asked far/b for spell: no permission");
        assertThat(other.isDone()).isFalse();
        assertThat(take(losses))
                .containsExactlyInAnyOrder(
                        "request to far/b for spell from near/a (number 1) cannot be delivered: no permission",
                        "notice to far/b for spell from near/a (number 3) cannot be delivered: no permission");
        engine.listener().rejected("far", "no permission");
        assertThat(losses).as("each is reported once").isEmpty();
        other.cancel();
        engine.sent.clear();
    }

    @Test
    void reply_toAnEarlierLife_orFromAnotherAddress_settlesNothing() {
        var answer = port.ask(FAR, SPELL, new Count(1), SECOND);
        long number = engine.sent.getFirst().number();
        arrives(reply(number, engine.incarnation + 1, new Text("earlier")));
        var purpose = new Purpose.Reply(NEAR, "spell", number);
        var other = new BusMessage.Data(new Address("far", "c"), purpose, 1, new Text("other"));
        arrives(farFrames.reply(other, purpose, engine.incarnation));
        var start = new Purpose.Reply(NEAR, "start", number);
        arrives(farFrames.reply(new BusMessage.Data(FAR, start, 1, new Text("started")), start, engine.incarnation));
        assertThat(answer.isDone()).isFalse();
        assertThat(take(losses)).hasSize(3).allMatch(each -> each.contains("is late: it is for a"));
        arrives(reply(number, engine.incarnation, new Text("one")));
        assertThat(test.get(answer)).isEqualTo(new Text("one"));
    }

    @Test
    void failureThere_isARemoteFailureHere() {
        var answer = heard(port.ask(FAR, SPELL, new Count(1), SECOND));
        var purpose =
                new Purpose.Rejection(NEAR, "spell", engine.sent.getFirst().number());
        var failure = new Failure.Failed("java.lang.IllegalStateException", "motor");
        arrives(farFrames.rejection(new BusMessage.Data(FAR, purpose, 1, failure), purpose, engine.incarnation));
        assertThat(answer.error()).isInstanceOf(RemoteFailure.class).hasMessageContaining("motor");
    }

    @Test
    void replyThatIsTooLarge_isFollowedByARejectionThatSaysSo() {
        port.answer(SPELL, count -> Promise.of(new Text("x".repeat(2_000))));
        arrives(request(1, SECOND, new Count(1)));
        farAnswersItsTime();
        test.runQueued();
        assertThat(engine.sent).hasSize(1);
        var frame = Frames.read(engine.sent.getFirst().frame(), "far");
        assertThat(frame.message(codec, Failure.class).payload())
                .asString()
                .contains("the answer could not be sent: the way from node near to node far failed")
                .contains("bytes, expected at most 1000");
        assertThat(take(losses)).hasSize(1);
        engine.sent.clear();
    }

    private final List<Throwable> failures = new ArrayList<>();

    private Failure rejectionOf(Throwable error, int maxFrameBytes) {
        engine.maxFrameBytes = maxFrameBytes;
        failures.add(error);
        if (failures.size() == 1) {
            port.answer(SPELL, count -> Promise.failed(failures.getLast()));
        }
        arrives(request(failures.size(), SECOND, new Count(1)));
        if (failures.size() == 1) {
            farAnswersItsTime();
        }
        test.runQueued();
        var frame = Frames.read(engine.sent.removeLast().frame(), "far");
        assertThat(frame.body()).isInstanceOf(Frames.Body.Rejected.class);
        return (Failure) frame.message(codec, Failure.class).payload();
    }

    /** Its text is cut, and half a surrogate pair, which no text of CBOR has, is replaced. */
    @Test
    void rejectionOfAnyText_isSent() {
        var long2 = rejectionOf(new IllegalStateException("x".repeat(2_000_000)), 1 << 20);
        assertThat(long2)
                .isEqualTo(new Failure.Failed(
                        "java.lang.IllegalStateException", "x".repeat(8_192) + " .. (2000000 characters)"));
        assertThat(take(losses)).isEmpty();
        assertThat(rejectionOf(new IllegalStateException("half \ud83d"), 1 << 20))
                .isEqualTo(new Failure.Failed("java.lang.IllegalStateException", "half ?"));
        assertThat(take(losses)).isEmpty();
        assertThat(rejectionOf(new IllegalStateException("x".repeat(5_000)), 1_000))
                .isInstanceOfSatisfying(
                        Failure.Unanswered.class,
                        short2 -> assertThat(short2.why())
                                .startsWith("the reason could not be sent: ")
                                .contains("bytes, expected at most 1000"));
        assertThat(take(losses)).hasSize(1);
        assertThat(take(events)).hasSize(3);
    }

    /** A value for which there is not enough memory. */
    record Deep(String text) {
        private static final ThreadLocal<Boolean> FAILS = ThreadLocal.withInitial(() -> false);

        Deep {
            if (FAILS.get()) {
                throw new OutOfMemoryError("of the test");
            }
        }
    }

    @Test
    void valueThatAnErrorKeepsFromBeingRead_rejectsItsRequest() {
        var operation = new Operation<>("spell", Deep.class, Deep.class, Kind.DATA);
        var answer = heard(port.ask(FAR, operation, new Deep("q"), SECOND));
        byte[] reply = reply(engine.sent.getFirst().number(), engine.incarnation, new Deep("a"));
        port.answer(operation, Promise::of);
        byte[] request = request(5, SECOND, new Deep("q"));
        Deep.FAILS.set(true);
        try {
            assertThatThrownBy(() -> arrives(reply)).isInstanceOf(OutOfMemoryError.class);
            assertThat(answer.error()).hasMessageContaining("the answer cannot be read: java.lang.OutOfMemoryError");
            engine.sent.clear();
            assertThatThrownBy(() -> {
                        arrives(request);
                        farAnswersItsTime();
                    })
                    .isInstanceOf(OutOfMemoryError.class);
        } finally {
            Deep.FAILS.remove();
        }
        test.runQueued();
        assertThat(engine.takeSent("far"))
                .containsExactly(
                        "reply far: Rejected[purpose=rejection to far/b for spell, kind=DATA, toIncarnation=77]");
        losses.clear();
    }

    @Test
    void replyThatAnErrorKeepsFromBeingSent_isFollowedByARejection() {
        port.answer(SPELL, count -> Promise.of(new Text("one")));
        engine.replyError = new StackOverflowError("in the engine");
        arrives(request(1, SECOND, new Count(1)));
        farAnswersItsTime();
        test.runQueued();
        assertThat(engine.takeSent("far"))
                .containsExactly(
                        "reply far: Rejected[purpose=rejection to far/b for spell, kind=DATA, toIncarnation=77]");
        assertThat(take(losses)).singleElement().asString().contains("java.lang.StackOverflowError: in the engine");
    }

    /** A value that cannot be sent, and whose error has no text. */
    record Fragile(String text) {
        @Override
        public String text() {
            throw new ArithmeticException() {
                private static final long serialVersionUID = 1L;

                @Override
                public String getMessage() {
                    throw new UnsupportedOperationException();
                }
            };
        }
    }

    @Test
    void valueThatCannotBeSent_rejectsItsRequest_whateverTheTextOfTheError() {
        var operation = new Operation<>("spell", Fragile.class, Text.class, Kind.DATA);
        var answer = heard(port.ask(FAR, operation, new Fragile("q"), SECOND));
        assertThat(answer.error())
                .isInstanceOf(BusException.class)
                .hasMessageContaining("what cannot be printed: java.lang.UnsupportedOperationException");
        assertThat(take(losses)).hasSize(1);
    }

    // ---- notices

    @Test
    void notice_isHandledWithoutAReply_andItsFailureIsReportedWhereItFails() {
        port.send(FAR, SPELL, new Count(1));
        assertThat(engine.takeSent("far"))
                .containsExactly("send far: Noticed[purpose=notice to far/b for spell, kind=DATA]");
        var handled = new ArrayList<Integer>();
        port.answer(SPELL, count -> {
            handled.add(count.value());
            return count.value() == 1 ? Promise.of(new Text("")) : Promise.failed(new IllegalStateException("two"));
        });
        for (int value = 1; value <= 2; value++) {
            var purpose = new Purpose.Notice(NEAR, "spell");
            arrives(farFrames.notice(new BusMessage.Data(FAR, purpose, value, new Count(value)), purpose));
        }
        test.runQueued();
        assertThat(handled).containsExactly(1, 2);
        assertThat(engine.sent).isEmpty();
        assertThat(take(events)).containsExactly("notice to near/a for spell failed: two");
    }

    @Test
    void notice_thatNobodyReceives_isReported() {
        port.send(FAR, SPELL, new Count(1));
        port.send(FAR, SPELL, new Count(2));
        long number = engine.sent.getFirst().number();
        engine.listener().unreachable("far", number, "no such node");
        assertThat(take(losses))
                .containsExactly("notice to far/b for spell from near/a (number 1) cannot be delivered: no such node");
        engine.listener().unreachable("far", number, "no such node");
        assertThat(losses).as("each is reported once").isEmpty();
        var purpose = new Purpose.Notice(new Address("near", "z"), "spell");
        arrives(farFrames.notice(new BusMessage.Data(FAR, purpose, 1, new Count(1)), purpose));
        assertThat(take(losses)).singleElement().asString().contains("there is no such port");
        engine.sent.clear();
    }

    // ---- faults

    @Test
    void unreadableBytes_areReported_andARequestIsRejected() {
        subscribe(COUNTS);
        port.answer(SPELL, count -> Promise.of(new Text("")));
        arrives(new byte[] {1, 2, 3});
        assertThat(take(losses))
                .containsExactly("a frame of 3 bytes cannot be read: expected a list, not a whole number");
        var text = new BusMessage.Data(FAR, new Purpose.Publication("counts"), 1, new Text("x"));
        arrives(farFrames.publication(text, "counts", 1, 0));
        assertThat(take(losses))
                .containsExactly("publication on counts from far/b cannot be read:"
                        + " Count.value: expected a whole number, not a text");
        arrives(request(1, SECOND, new Text("x")));
        farAnswersItsTime();
        assertThat(engine.takeSent("far")).singleElement().asString().startsWith("reply far: Rejected");
        assertThat(take(losses))
                .singleElement()
                .asString()
                .contains("cannot read it: Count.value: expected a whole number");
        var answer = heard(port.ask(FAR, SPELL, new Count(1), SECOND));
        arrives(reply(engine.sent.getFirst().number(), engine.incarnation, new Count(1)));
        assertThat(answer.error())
                .hasMessageEndingWith("the answer cannot be read: Text.value: expected a text, not a whole number");
        assertThat(take(losses)).hasSize(1);
        assertThat(bus.metrics().unreadable()).isEqualTo(3);
    }

    @Test
    void secondProcessOfTheSameName_isReported() {
        var own = new BusMessage.Data(NEAR, new Purpose.Publication("counts"), 1, new Count(1));
        arrives(new Frames(codec, test.clock(), engine.incarnation + 1).publication(own, "counts", 1, 0));
        assertThat(take(losses))
                .containsExactly(
                        "a message from near/a cannot be read: another process has the name of this node, near");
    }

    @Test
    void engineThatFails_rejectsRequests_andItsEventsAreReported() {
        engine.failure = new IllegalArgumentException("cable cut");
        var answer = heard(port.ask(FAR, SPELL, new Count(1), SECOND));
        assertThat(answer.error())
                .hasMessage("near/a asked far/b for spell: the way from node near to node far failed:"
                        + " java.lang.IllegalArgumentException: cable cut");
        port.publish(COUNTS, new Count(1));
        assertThat(take(losses)).hasSize(2);
        engine.failure = null;
        engine.listener().disconnected("cable cut");
        engine.listener().connected();
        engine.listener().lost(3, "too slow");
        assertThat(take(events)).containsExactly("disconnected: cable cut", "connected");
        assertThat(take(losses)).containsExactly("3 messages were lost: too slow");
    }

    @Test
    void engineThatCannotStart_closesTheBus() {
        var broken = new ScriptedEngine();
        broken.failure = new BusException("no server");
        assertThatThrownBy(() -> Bus.open("near", broken, settings())).hasMessage("no server");
        assertThat(broken.closed).isTrue();
    }
}
