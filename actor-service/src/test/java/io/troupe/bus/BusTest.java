package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.bus.BusContract.Count;
import io.troupe.bus.BusContract.Text;
import java.lang.ref.WeakReference;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.logging.Handler;
import java.util.logging.Level;
import java.util.logging.LogRecord;
import java.util.logging.Logger;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

class BusTest {
    private final TestSpace test = new TestSpace();
    private final List<Loss> losses = new ArrayList<>();
    private final Bus bus = Bus.inProcess("robots", BusSettings.on(test.space()).withObserver(losses::add));

    @AfterEach
    void nothingIsLeft() {
        bus.close();
        test.close();
        assertThat(losses).isEmpty();
    }

    /** Values from code without type checks (unchecked casts). */
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
        bus.attach("a").subscribe(BusContract.COUNTS, (count, from) -> here.add(ActorSpace.current()));
        bus.attach("b").publish(BusContract.COUNTS, new Count(1));
        test.crank();
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
        assertThatThrownBy(() -> BusSettings.on(test.space()).withCapacity(0))
                .hasMessage("capacity is 0 messages, expected 1 or more");
        assertThatThrownBy(() -> Bus.inProcess("a/b")).hasMessageContaining("\"a/b\"");
        assertThatThrownBy(() -> bus.attach(" ")).hasMessageContaining("the name of an address is \" \"");
    }

    @Test
    void registrationOnASpaceThatIsClosed_isRefused() {
        var closed = ActorSpace.create(SpaceSettings.named("closed").withHandCrank());
        var other = Bus.inProcess("other", BusSettings.on(closed));
        var port = other.attach("a");
        closed.close();
        assertThatThrownBy(() -> port.subscribe(BusContract.COUNTS, (count, from) -> {}))
                .isInstanceOf(BusException.class)
                .hasMessage("other/a cannot subscribe to counts: space closed was closed");
        assertThatThrownBy(() -> port.answer(BusContract.SPELL, count -> new Deferred<>()))
                .hasMessage("other/a cannot answer spell: space closed was closed");
        other.close();
    }

    @Test
    void request_isRejectedAtOnce_whenTheSpaceOfItsRequesterIsClosed() {
        var unheard = new ArrayList<Throwable>();
        var requesters = ActorSpace.create(
                SpaceSettings.named("askers").withHandCrank().withOnError((where, error) -> unheard.add(error)));
        var handler = bus.attach("answerer");
        handler.answer(BusContract.SPELL, count -> new Deferred<>());
        var requester = bus.attach("asker");
        var answers = new ArrayList<Promise<Text>>();
        requesters.execute(() ->
                answers.add(requester.ask(handler.address(), BusContract.SPELL, new Count(1), BusContract.SECOND)));
        requesters.crank();
        test.crank();
        requesters.close();
        assertThat(answers.getFirst().error())
                .hasMessage("robots/asker asked robots/answerer for spell: the space of the asker was closed");
        assertThat(unheard).containsExactly(answers.getFirst().error());
        handler.close();
        assertThat(losses).as("the answerer has forgotten it").isEmpty();
    }

    @Test
    void requestsWhoseRequestersHaveGivenUp_makeRoomAtTheirHandler() {
        var small = Bus.inProcess(
                "small",
                BusSettings.on(test.space()).withCapacity(BusContract.CAPACITY).withObserver(losses::add));
        var handler = small.attach("answerer");
        handler.answer(BusContract.SPELL, count -> new Deferred<>());
        var requester = small.attach("asker");
        for (int round = 0; round < 3; round++) {
            List<Promise<Text>> answers = new ArrayList<>();
            for (int i = 0; i < BusContract.CAPACITY; i++) {
                answers.add(requester.ask(handler.address(), BusContract.SPELL, new Count(i), BusContract.SECOND));
            }
            test.crank();
            assertThat(answers).noneMatch(Promise::isDone);
            var tooMany = requester.ask(handler.address(), BusContract.SPELL, new Count(9), BusContract.SECOND);
            assertThat(test.error(tooMany)).hasMessageEndingWith("4 questions for spell are being answered");
            answers.removeFirst().cancel();
            var instead = requester.ask(handler.address(), BusContract.SPELL, new Count(9), BusContract.SECOND);
            test.crank();
            assertThat(instead.isDone()).as("the cancelled one has made room").isFalse();
            answers.add(instead);
            test.advance(BusContract.SECOND.multipliedBy(2));
            assertThat(answers)
                    .allSatisfy(each -> assertThat(test.error(each)).isInstanceOf(BusTimeoutException.class));
        }
        assertThat(losses).hasSize(3).allMatch(Loss.Undeliverable.class::isInstance);
        losses.clear();
        small.close();
    }

    @Test
    void requestsThatAreCancelled_areNotKeptUntilTheirLimit() {
        var handler = bus.attach("answerer");
        handler.answer(BusContract.SPELL, count -> new Deferred<>());
        var requester = bus.attach("asker");
        var questions = new ArrayList<WeakReference<Count>>();
        for (int i = 0; i < 20; i++) {
            var request = new Count(i);
            questions.add(new WeakReference<>(request));
            var answer = requester.ask(handler.address(), BusContract.SPELL, request, Duration.ofDays(1));
            test.crank();
            answer.cancel();
        }
        test.crank();
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
        var ofText = new BusTopic<>(BusContract.COUNTS.name(), Text.class);
        publisher.publish(BusContract.COUNTS, new Count(1));
        publisher.publish(BusContract.COUNTS, new Count(2));
        subscriber.subscribe(BusContract.COUNTS, (count, from) -> {}).close();
        publisher.close();
        assertThatThrownBy(() -> other.publish(ofText, new Text("1")))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("expected one type for one name");
        subscriber.close();
        other.publish(ofText, new Text("1"));
        assertThatThrownBy(() -> bus.attach("late").publish(BusContract.COUNTS, new Count(3)))
                .isInstanceOf(IllegalArgumentException.class);
    }

    @Test
    void errorsOfTheObserver_endNoSubscription_andNoAnswering() {
        var other = Bus.inProcess("other", new BusSettings(test.space(), 1, loss -> {
            throw new NoClassDefFoundError("observer");
        }));
        var heard = new ArrayList<Integer>();
        other.attach("a").subscribe(BusContract.COUNTS, (count, from) -> {
            heard.add(count.value());
            throw new StackOverflowError("subscriber");
        });
        var port = other.attach("b");
        port.answer(BusContract.SPELL, BusContract::spelt);
        var answers = new ArrayList<Promise<Text>>();
        logged(() -> {
            for (int round = 0; round < 3; round++) {
                for (int i = 0; i < 2; i++) { // the second exceeds the capacity
                    port.publish(BusContract.COUNTS, new Count(10 * round + i));
                    var answer = port.ask(port.address(), BusContract.SPELL, new Count(i), BusContract.SECOND);
                    answers.add(BusContract.heard(answer));
                }
                test.crank();
            }
        });
        assertThat(heard).containsExactly(1, 11, 21);
        assertThat(answers)
                .allMatch(Promise::isDone)
                .filteredOn(each -> !each.isRejected())
                .hasSize(3);
        other.close();
    }

    @Test
    void observerThatThrows_disturbsNobody() {
        var other = Bus.inProcess("other", BusSettings.on(test.space()).withObserver(new BusObserver() {
            @Override
            public void lost(Loss loss) {
                throw new IllegalStateException("broken");
            }

            @Override
            public void passed(BusMessage message) {
                throw new IllegalStateException("broken");
            }
        }));
        var heard = new ArrayList<Integer>();
        other.attach("a").subscribe(BusContract.COUNTS, (count, from) -> heard.add(count.value()));
        var records = logged(() -> {
            other.attach("b").publish(BusContract.COUNTS, new Count(1));
            test.crank();
        });
        assertThat(heard).containsExactly(1);
        assertThat(records).singleElement().satisfies(record -> {
            assertThat(record.getLevel()).isEqualTo(Level.SEVERE);
            assertThat(record.getMessage()).isEqualTo("the observer of a bus failed");
        });
        other.close();
    }

    @Test
    void loggingObserver_warnsOfLosses_ofDroppedOnesRarely() {
        var other = Bus.inProcess("other", BusSettings.on(test.space()).withCapacity(1));
        var heard = new ArrayList<Integer>();
        other.attach("a").subscribe(BusContract.COUNTS, (count, from) -> heard.add(count.value()));
        var publisher = other.attach("b");
        var records = logged(() -> {
            for (int i = 1; i <= 9; i++) {
                publisher.publish(BusContract.COUNTS, new Count(i));
            }
        });
        test.crank();
        assertThat(heard).containsExactly(9);
        assertThat(records).hasSize(4).allMatch(record -> record.getLevel() == Level.WARNING);
        assertThat(records.getFirst().getMessage())
                .isEqualTo("other/a is too slow: its oldest publication on counts from other/b (number 1) was dropped,"
                        + " 1 so far");
        assertThat(records.getLast().getMessage()).endsWith("8 so far");
        other.close();
    }

    private static List<LogRecord> logged(Runnable body) {
        var records = new ArrayList<LogRecord>();
        var logger = Logger.getLogger(Bus.class.getName());
        var handler = new Handler() {
            @Override
            public void publish(LogRecord record) {
                records.add(record);
            }

            @Override
            public void flush() {}

            @Override
            public void close() {}
        };
        logger.addHandler(handler);
        logger.setUseParentHandlers(false);
        try {
            body.run();
        } finally {
            logger.removeHandler(handler);
            logger.setUseParentHandlers(true);
        }
        return records;
    }

    @Test
    void fewMessagesAtATime_soThatOthersOnTheSpaceHaveTheirTurn() {
        var heard = new ArrayList<String>();
        var port = bus.attach("a");
        port.subscribe(BusContract.COUNTS, (count, from) -> heard.add("slow"));
        var publisher = bus.attach("b");
        for (int i = 0; i < 20; i++) {
            publisher.publish(BusContract.COUNTS, new Count(i));
        }
        port.subscribe(BusContract.COUNTS, (count, from) -> heard.add("other"));
        publisher.publish(BusContract.COUNTS, new Count(20));
        test.crank();
        assertThat(heard).hasSize(22);
        assertThat(heard.indexOf("other")).as("in the midst of the slow one's").isBetween(1, 19);
    }
}
