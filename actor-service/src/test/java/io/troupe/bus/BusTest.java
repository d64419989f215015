package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import java.lang.ref.WeakReference;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.logging.Level;
import java.util.logging.LogRecord;
import java.util.logging.Logger;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** Behaviour that is specific to one node, or to two nodes that exchange bytes. */
class BusTest extends BusContract {
    private final Bus bus = Bus.inProcess("robots", BusSettings.on(test.space()).withObserver(losses::add));

    BusTest() {
        super(Wiring.TWO_NODES);
    }

    @AfterEach
    void closeBus() {
        bus.close();
    }

    /** Values from code without type checks (unchecked casts). */
    @Test
    void nameWithACharacterOfOurOwnPorts_isRefused() {
        for (String name : List.of("$broker", "camera#2")) {
            assertThatThrownBy(() -> bus.attach(name))
                    .isInstanceOf(IllegalArgumentException.class)
                    .hasMessage("the name of a port is \"" + name + "\", expected a name without $ and #");
        }
    }

    @Test
    @SuppressWarnings({"unchecked", "rawtypes", "NullAway"})
    void valueThatIsRefused_leavesTheTypeOfItsTopicOpen() {
        var port = bus.attach("a");
        BusTopic counts = new BusTopic<>("open", Count.class);
        assertThatThrownBy(() -> port.publish(counts, new Text("no count"))).isInstanceOf(ClassCastException.class);
        assertThatThrownBy(() -> port.publish(counts, null)).isInstanceOf(NullPointerException.class);
        bus.attach("b").publish(new BusTopic<>("open", Text.class), new Text("a text"));
    }

    @Test
    void registrationOutsideEverySpace_meansOnTheSpaceOfTheSettings() {
        var here = new ArrayList<ActorSpace>();
        bus.attach("a").subscribe(COUNTS, (count, from) -> here.add(ActorSpace.current()));
        bus.attach("b").publish(COUNTS, new Count(1));
        test.runQueued();
        assertThat(here).containsExactly(test.space());
    }

    @Test
    void openWithoutSettings_usesTheGlobalSpace() {
        try (var global = Bus.inProcess("global")) {
            assertThat(global.node()).isEqualTo("global");
            assertThat(global).hasToString("bus global");
            assertThat(global.attach("a").address()).hasToString("global/a");
        }
    }

    @Test
    void settings_refuseWhatMakesNoSense() {
        assertThatThrownBy(() -> settings().withCapacity(0)).hasMessage("capacity is 0 messages, expected 1 or more");
        assertThatThrownBy(() -> Bus.inProcess("a/b")).hasMessageContaining("\"a/b\"");
        assertThatThrownBy(() -> bus.attach(" ")).hasMessageContaining("the name of an address is \" \"");
    }

    @Test
    void registrationOnASpaceThatIsClosed_isRefused() {
        var closed = ActorSpace.create(SpaceSettings.named("closed").withoutThread());
        try (var other = Bus.inProcess("other", BusSettings.on(closed))) {
            var port = other.attach("a");
            closed.close();
            assertThatThrownBy(() -> port.subscribe(COUNTS, (count, from) -> {}))
                    .isInstanceOf(BusException.class)
                    .hasMessage("other/a cannot subscribe to counts: space closed was closed");
            assertThatThrownBy(() -> port.answer(SPELL, count -> new Deferred<>()))
                    .hasMessage("other/a cannot answer spell: space closed was closed");
        }
    }

    @Test
    void request_isRejectedAtOnce_whenTheSpaceOfItsRequesterIsClosed() {
        var unheard = new ArrayList<Throwable>();
        var requesters = ActorSpace.create(
                SpaceSettings.named("askers").withoutThread().withOnError((where, error) -> unheard.add(error)));
        var handler = bus.attach("answerer");
        handler.answer(SPELL, count -> new Deferred<>());
        var requester = bus.attach("asker");
        var answers = new ArrayList<Promise<Text>>();
        requesters.execute(() -> answers.add(requester.ask(handler.address(), SPELL, new Count(1), SECOND)));
        requesters.runQueued();
        test.runQueued();
        requesters.close();
        assertThat(answers.getFirst().error())
                .hasMessage("robots/asker asked robots/answerer for spell: the space of the requester was closed");
        assertThat(unheard).containsExactly(answers.getFirst().error());
        handler.close();
        assertThat(losses).as("the answerer has forgotten it").isEmpty();
    }

    @Test
    void requestsWhoseRequestersHaveGivenUp_makeRoomAtTheirHandler() {
        try (var small = Bus.inProcess("small", settings())) {
            var handler = small.attach("answerer");
            handler.answer(SPELL, count -> new Deferred<>());
            var requester = small.attach("asker");
            for (int round = 0; round < 3; round++) {
                List<Promise<Text>> answers = new ArrayList<>();
                for (int i = 0; i < CAPACITY; i++) {
                    answers.add(ask(requester, handler, i));
                }
                test.runQueued();
                assertThat(answers).noneMatch(Promise::isDone);
                assertThat(test.error(ask(requester, handler, 9)))
                        .hasMessageEndingWith("4 questions for spell are being answered");
                answers.removeFirst().cancel();
                answers.add(ask(requester, handler, 9));
                test.runQueued();
                assertThat(answers).as("the cancelled one has made room").noneMatch(Promise::isDone);
                test.advance(SECOND.multipliedBy(2));
                assertThat(answers).extracting(test::error).hasOnlyElementsOfType(BusTimeoutException.class);
            }
            assertTakenLosses(3, Loss.Undeliverable.class);
        }
    }

    @Test
    void requestsThatAreCancelled_areNotKeptUntilTheirLimit() {
        var handler = bus.attach("answerer");
        handler.answer(SPELL, count -> new Deferred<>());
        var requester = bus.attach("asker");
        var questions = new ArrayList<WeakReference<Count>>();
        for (int i = 0; i < 20; i++) {
            var request = new Count(i);
            questions.add(new WeakReference<>(request));
            var answer = requester.ask(handler.address(), SPELL, request, Duration.ofDays(1));
            test.runQueued();
            answer.cancel();
        }
        test.runQueued();
        for (int tries = 0; tries < 20 && count(questions) > 1; tries++) {
            System.gc();
        }
        assertThat(count(questions)).as("in memory, but for the last one").isLessThanOrEqualTo(1);
    }

    private static long count(List<WeakReference<Count>> references) {
        return references.stream().filter(each -> each.get() != null).count();
    }

    @Test
    void topic_mayHaveAnotherType_whenAllPortsThatUsedItAreClosed() {
        var publisher = bus.attach("publisher");
        var subscriber = bus.attach("subscriber");
        var other = bus.attach("other");
        var ofText = new BusTopic<>(COUNTS.name(), Text.class);
        publisher.publish(COUNTS, new Count(1));
        publisher.publish(COUNTS, new Count(2));
        subscriber.subscribe(COUNTS, (count, from) -> {}).close();
        publisher.close();
        assertThatThrownBy(() -> other.publish(ofText, new Text("1")))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("expected one type for one name");
        subscriber.close();
        other.publish(ofText, new Text("1"));
        assertThatThrownBy(() -> bus.attach("late").publish(COUNTS, new Count(3)))
                .isInstanceOf(IllegalArgumentException.class);
    }

    @Test
    void fewMessagesAtATime_soThatOthersOnTheSpaceHaveTheirTurn() {
        var received = new ArrayList<String>();
        var port = bus.attach("a");
        port.subscribe(COUNTS, (count, from) -> received.add("slow"));
        var publisher = bus.attach("b");
        for (int i = 0; i < 20; i++) {
            publisher.publish(COUNTS, new Count(i));
        }
        port.subscribe(COUNTS, (count, from) -> received.add("other"));
        publisher.publish(COUNTS, new Count(20));
        test.runQueued();
        assertThat(received).hasSize(22);
        assertThat(received.indexOf("other"))
                .as("in the midst of the slow one's")
                .isBetween(1, 19);
    }

    // ---- observers

    @Test
    void errorsOfTheObserver_endNoSubscription_andNoAnswering() {
        var received = new ArrayList<Integer>();
        var answers = new ArrayList<Promise<Text>>();
        try (var other = Bus.inProcess(
                "other", BusSettings.on(test.space()).withCapacity(1).withObserver(loss -> {
                    throw new NoClassDefFoundError("observer");
                }))) {
            other.attach("a").subscribe(COUNTS, (count, from) -> {
                received.add(count.value());
                throw new StackOverflowError("subscriber");
            });
            var port = other.attach("b");
            port.answer(SPELL, BusContract::spelt);
            logged(() -> {
                for (int round = 0; round < 3; round++) {
                    for (int i = 0; i < 2; i++) { // the second exceeds the capacity
                        port.publish(COUNTS, new Count(10 * round + i));
                        answers.add(ask(port, port, i));
                    }
                    test.runQueued();
                }
            });
            assertThat(received).containsExactly(1, 11, 21);
            assertThat(answers)
                    .allMatch(Promise::isDone)
                    .filteredOn(each -> !each.isRejected())
                    .hasSize(3);
        }
    }

    @Test
    void observerThatThrows_disturbsNobody() {
        var received = new ArrayList<Integer>();
        var observer = new BusObserver() {
            @Override
            public void lost(Loss loss) {
                throw new IllegalStateException("broken");
            }

            @Override
            public void passed(BusMessage message) {
                throw new IllegalStateException("broken");
            }
        };
        try (var other = Bus.inProcess("other", BusSettings.on(test.space()).withObserver(observer))) {
            other.attach("a").subscribe(COUNTS, (count, from) -> received.add(count.value()));
            var records = logged(() -> {
                other.attach("b").publish(COUNTS, new Count(1));
                test.runQueued();
            });
            assertThat(received).containsExactly(1);
            assertThat(records)
                    .extracting(record -> record.getLevel() + " " + record.getMessage())
                    .containsExactly(Level.SEVERE + " the observer of a bus failed");
        }
    }

    @Test
    void loggingObserver_warnsOfLosses_ofDroppedOnesRarely() {
        var received = new ArrayList<Integer>();
        try (var other = Bus.inProcess("other", BusSettings.on(test.space()).withCapacity(1))) {
            other.attach("a").subscribe(COUNTS, (count, from) -> received.add(count.value()));
            var publisher = other.attach("b");
            var records = logged(() -> {
                for (int i = 1; i <= 9; i++) {
                    publisher.publish(COUNTS, new Count(i));
                }
            });
            test.runQueued();
            assertThat(received).containsExactly(9);
            assertThat(records).hasSize(4).allMatch(record -> record.getLevel() == Level.WARNING);
            assertThat(records.getFirst().getMessage())
                    .isEqualTo("other/a is too slow: its oldest publication on counts from other/b (number 1)"
                            + " was dropped, 1 so far");
            assertThat(records.getLast().getMessage()).endsWith("8 so far");
        }
    }

    private static List<LogRecord> logged(Runnable body) {
        var records = new ArrayList<LogRecord>();
        var logger = Logger.getLogger(Bus.class.getName());
        logger.setFilter(record -> !records.add(record)); // recorded, and not shown
        try {
            body.run();
        } finally {
            logger.setFilter(null);
        }
        return records;
    }

    // ---- two nodes

    @Test
    void messages_goAsBytes_andAreTheSame_onBothSides() {
        var bytes = (BytePipe) pipe;
        var port = near.attach("b");
        var handler = far.attach("a");
        handler.subscribe(COUNTS, (count, from) -> {});
        port.publish(COUNTS, new Count(1));
        assertThat(bytes.bytesCarried()).isZero();
        test.runQueued();
        assertThat(bytes.bytesCarried()).isPositive();
        take(passed);
        handler.answer(SPELL, count -> Promise.of(new Text("x")));
        test.get(port.ask(handler.address(), SPELL, new Count(1), SECOND));
        var seen = take(passed);
        assertThat(seen).hasSize(4);
        assertThat(seen.get(1)).isEqualTo(seen.get(0)).isNotSameAs(seen.get(0));
        assertThat(seen.get(3)).isEqualTo(seen.get(2)).isNotSameAs(seen.get(2));
    }

    @Test
    void requestsWhoseRequestersHaveGivenUp_makeRoomAtTheirHandler_onAnotherNode() {
        var kept = new ArrayList<Deferred<Text>>();
        var handler = speller(count -> {
            kept.add(test.space().deferred());
            return kept.getLast();
        });
        var here = far.attach("near-by");
        var ownAnswer = here.ask(handler.address(), SPELL, new Count(0), SECOND.multipliedBy(100));
        var requester = near.attach("b");
        for (int round = 0; round < 3; round++) {
            for (int i = 0; i < CAPACITY - 1; i++) {
                var unanswered = ask(requester, handler, i);
                test.runQueued();
                assertThat(unanswered.isDone()).isFalse();
                test.advance(SECOND);
                assertThat(test.error(unanswered)).isInstanceOf(BusTimeoutException.class);
            }
        }
        assertThat(kept).hasSize(1 + 3 * (CAPACITY - 1));
        var answer = ask(requester, handler, 7);
        test.runQueued();
        assertThat(losses).isEmpty();
        kept.forEach(each -> each.resolve(new Text("at last")));
        assertThat(test.get(answer)).isEqualTo(new Text("at last"));
        assertThat(test.get(ownAnswer)).as("of the node itself").isEqualTo(new Text("at last"));
        assertTakenLosses(3 * (CAPACITY - 1), Loss.Late.class);
    }
}
