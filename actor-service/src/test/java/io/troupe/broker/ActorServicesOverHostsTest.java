package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.bus.Address;
import io.troupe.bus.BusException;
import io.troupe.bus.RemoteFailure;
import io.troupe.bus.internal.OwnName;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CancellationException;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;

/** Actors that are called by another process: the same interface, and what differs when a process is in between. */
class ActorServicesOverHostsTest extends HostsBench {
    private static final Duration LONG = Duration.ofSeconds(100);

    private final Host far = host("far");
    private final Host near = host("near");

    // ---- calls

    @Test
    void serviceMayHaveAnyNameThatHasNoCharacterOfOurOwnPorts() {
        var names = List.of("broker", "caller-1", "robots", "arbitrator", "bus", "camera-2");
        for (String name : names) {
            get(far.services.publish(test.space(), Parrot.class, name, List.of(), () -> far.parrot(name)));
        }
        test.runQueued();
        for (String name : names) {
            Parrot parrot = near.services
                    .connect(Parrot.class, Need.ofService("guest", name))
                    .actor();
            assertThat(get(parrot.say("hi"))).as(name).contains("hi");
        }
        get(near.services.publish(test.space(), Parrot.class, "caller-2", List.of(), () -> near.parrot("own")));
        test.runQueued();
        var beside = far.services
                .connect(Parrot.class, Need.ofService("guest", "caller-2"))
                .actor();
        assertThat(get(beside.say("hi"))).isEqualTo("own: hi");
    }

    @Test
    void actor_isStartedAtTheFirstNeed_andCalledByItsInterface() {
        far.publish("grey");
        assertThat(diary).isEmpty();
        var parrot = near.connected();
        parrot.hear("one way");
        assertThat(get(parrot.say("hello"))).isEqualTo("grey: hello");
        assertThat(get(parrot.sayTwice("hi"))).isEqualTo("grey: hi, grey: hi");
        assertThat(diary).startsWith("grey is made", "grey hears one way", "grey says hello");
        assertThat(get(parrot.say(null))).isEqualTo("grey: null");
        assertThat(pipe.bytesCarried()).isPositive();
    }

    @Test
    void exception_arrivesByClassNameAndMessage() {
        far.publish("grey");
        assertThat(test.error(near.connected().fail("not today")))
                .isInstanceOfSatisfying(RemoteFailure.class, failure -> {
                    assertThat(failure.type()).isEqualTo(UnsupportedOperationException.class.getName());
                    assertThat(failure.problem()).isEqualTo("not today");
                })
                .hasMessage("far/parrot failed to answer Parrot.fail(String):"
                        + " java.lang.UnsupportedOperationException: not today");
        assertThat(test.takeProblems()).isEmpty();
    }

    @Test
    void calls_ofOneCaller_areHandledInTheirOrder() {
        far.publish("grey");
        var parrot = near.connected();
        List<Promise<String>> answers = new ArrayList<>();
        for (int i = 0; i < 50; i++) {
            parrot.hear("n" + i);
            answers.add(parrot.say("" + i));
        }
        get(Promise.all(answers));
        var expected = new ArrayList<String>();
        for (int i = 0; i < 50; i++) {
            expected.addAll(List.of("grey hears n" + i, "grey says " + i));
        }
        assertThat(diary.subList(1, diary.size())).isEqualTo(expected);
    }

    /** Asks an actor of its process how much time it has. */
    interface Clerk {
        Promise<String> timeLeft();
    }

    @Test
    void timeLimit_isThatOfTheQuestionsThatTheProviderAsks_alsoIfTheCallWaitedForAProvider() {
        Duration limit = Duration.ofSeconds(3);
        Clerk helper = test.spawn(Clerk.class, () -> () -> Promise.of("" + ActorSpace.timeLeft()));
        var clerk = near.services
                .connect(Clerk.class, Need.ofService("robot 1", "clerk"))
                .actor();
        Promise<String> waited = test.space().within(limit, clerk::timeLeft);
        test.advance(Duration.ofSeconds(1));
        get(far.services.publish(test.space(), Clerk.class, "clerk", List.of(), () -> helper::timeLeft));
        assertThat(get(waited)).isEqualTo("" + limit.minusSeconds(1));
        assertThat(get(test.space().within(limit, clerk::timeLeft))).isEqualTo("" + limit);
        assertThat(get(clerk.timeLeft())).isEqualTo("null");
    }

    sealed interface Shape {}

    record Circle(double radiusM) implements Shape {}

    record Path(List<Shape> parts) implements Shape {}

    enum Colour {
        RED
    }

    /** Values of all kinds. */
    interface Painter {
        Promise<Map<String, List<Shape>>> paint(Colour colour, List<Optional<Integer>> numbers, Shape shape, long n);

        Promise<Optional<String>> name(boolean has);
    }

    private static final class PainterActor implements Painter {
        @Override
        public Promise<Map<String, List<Shape>>> paint(
                Colour colour, List<Optional<Integer>> numbers, Shape shape, long n) {
            return Promise.of(Map.of(colour + " " + numbers + " " + n, List.of(shape)));
        }

        @Override
        public Promise<Optional<String>> name(boolean has) {
            return Promise.of(has ? Optional.of("Ada") : Optional.empty());
        }
    }

    @Test
    void argumentsAndResults_areValuesOfAnyType() {
        get(far.services.publish(test.space(), Painter.class, "painter", List.of(), PainterActor::new));
        var painter = near.services
                .connect(Painter.class, Need.ofService("user", "painter"))
                .actor();
        Shape shape = new Path(List.of(new Circle(2), new Path(List.of())));
        var numbers = List.of(Optional.of(1), Optional.<Integer>empty());
        assertThat(get(painter.paint(Colour.RED, numbers, shape, Long.MIN_VALUE)))
                .isEqualTo(Map.of("RED [Optional[1], Optional.empty] " + Long.MIN_VALUE, List.of(shape)));
        assertThat(get(painter.name(true))).contains("Ada");
        assertThat(get(painter.name(false))).isEmpty();
        var withNull = new ArrayList<Optional<Integer>>();
        withNull.add(null);
        assertCallError(
                painter.paint(Colour.RED, withNull, shape, 1),
                false,
                "Painter.paint(Colour, List, Shape, long) of \"user\", which needs the service \"painter\", was rejected:"
                        + " java.lang.IllegalArgumentException: argument 2 cannot be sent: a value of"
                        + " java.util.ArrayList cannot leave the process: a list in it has null at 0, expected values,"
                        + " and no null in lists and maps, in at most 500 levels of records, lists and maps");
    }

    @Test
    void wrongInterface_isReportedInPlainWords() {
        far.publish("grey");
        var connection = near.services.connect(Painter.class, PARROT);
        assertThat(test.error(connection.first()))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage(
                        "\"robot 1\" calls the service \"parrot\" as " + Painter.class.getName()
                                + ", and its provider far/parrot has no name(boolean), paint(Colour, List, Shape, long); it has"
                                + " count(int, Callback), fail(String), hear(String), say(String), sayLater(String), sayTwice(String)");
    }

    @Test
    void localActor_isCalledByReference() {
        near.publish("mine");
        long before = pipe.bytesCarried();
        var parrot = near.connected();
        get(parrot.say("hello"));
        var cause = test.error(parrot.fail("no"));
        assertThat(cause).isInstanceOf(UnsupportedOperationException.class);
        assertThat(pipe.bytesCarried() - before).as("offers only").isLessThan(3_000);
        assertThat(diary).contains("mine says hello");
    }

    // ---- what cannot be called

    interface TakesThread {
        void run(String name, Thread thread);
    }

    interface NestedThread {
        record Job(List<Thread> threads) {}

        Promise<String> run(Job job);
    }

    interface RawPromise {
        @SuppressWarnings("rawtypes")
        Promise now();
    }

    interface ThreadStream {
        void run(Callback<Thread> callback);
    }

    interface TwoOfOneName {
        void run(Circle circle);

        void run(Other.Circle circle);
    }

    interface Other {
        record Circle() {}
    }

    interface Generic<T> {
        Promise<T> get();
    }

    static class ClassActor extends Actor {
        public void run() {}
    }

    private <A> void assertRefused(Class<A> type, String reason) {
        assertThatThrownBy(() -> far.services.publish(test.space(), type, "x", List.of(), () -> {
                    throw new AssertionError();
                }))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageStartingWith(reason);
    }

    @Test
    void methodThatCannotBeCalledFromOtherHosts_isRefusedByName_whenItIsPublished() {
        assertRefused(
                TakesThread.class,
                "TakesThread.run(String, Thread) cannot be called from other hosts: parameter 2: Thread of type"
                        + " java.lang.Thread: expected primitives");
        assertRefused(
                NestedThread.class,
                "NestedThread.run(Job) cannot be called from other hosts: parameter 1: Job.threads[] of type"
                        + " java.lang.Thread: expected primitives");
        assertRefused(
                RawPromise.class,
                "RawPromise.now() cannot be called from other hosts: it has a io.troupe.actor.Promise, expected"
                        + " a Promise of a value");
        assertRefused(
                ThreadStream.class,
                "ThreadStream.run(Callback) cannot be called from other hosts: parameter 1: Thread of type");
        assertRefused(TwoOfOneName.class, "TwoOfOneName.run(Circle) cannot be called from other hosts: there is run(");
        assertRefused(
                Generic.class, "Generic.get() cannot be called from other hosts: result: T of type T: it is not known");
        assertRefused(
                ClassActor.class,
                ClassActor.class.getName()
                        + " cannot be called from other hosts: it is a class, expected an interface");
        var thread = test.spawn(TakesThread.class, () -> (name, t) -> {});
        assertThatThrownBy(() -> far.services.publishSpawned(test.space(), "x", List.of(), thread))
                .hasMessageStartingWith("TakesThread.run(String, Thread) cannot be called from other hosts");
    }

    // ---- whether a call was sent

    private String callOf(String method) {
        return "Parrot." + method + "(String) of \"robot 1\", which needs the service \"parrot\", was not delivered: ";
    }

    @Test
    void callToANodeThatIsGone_hasNotRun_andTheClientIsMovedAtOnce() {
        far.publish("a");
        host("third").publish("b");
        var parrot = near.connected();
        assertThat(get(parrot.say("1"))).isEqualTo("a: 1");
        seconds(3);
        far.die();
        assertCallError(
                parrot.say("2"),
                false,
                callOf("say") + "near/$caller-1 asked far/parrot for call: there is no way from node near to node far");
        assertThat(get(parrot.say("3"))).isEqualTo("b: 3");
        losses.clear();
    }

    @Test
    void callThatTheActorDidNotAnswerBeforeItsEnd_mayHaveRun() {
        far.publish("a");
        var answer = near.connected().sayLater("hello");
        test.runQueued();
        far.kill("parrot");
        assertThat(test.error(answer))
                .isInstanceOfSatisfying(
                        ServiceCallException.class,
                        error -> assertThat(error.mayHaveRun()).isTrue())
                .hasMessageContaining("far/parrot");
        losses.clear();
    }

    @Test
    void callWithoutAnAnswerInTime_mayHaveRun_andWithoutALimitItWaits() {
        far.publish("a");
        var unlimited = near.connect(ConnectionSettings.defaults().withoutAnswerLimit())
                .actor()
                .sayLater("for long");
        var limited = near.connected().sayLater("hello");
        test.runQueued();
        seconds(5);
        assertCallError(limited, true, "far/parrot did not answer Parrot.sayLater(String) to \"robot 1\" within PT5S");
        seconds(1_000);
        far.parrots.get("a").later().removeFirst().resolve("at last");
        assertThat(get(unlimited)).isEqualTo("at last");
        far.parrots.get("a").later().removeFirst().resolve("too late");
        test.runQueued();
        assertThat(losses).singleElement().asString().contains("is late: no caller waits for it any more");
        assertThat(near.events(BrokerEvent.Late.class)).isEmpty();
    }

    @Test
    void callWhoseNodeFallsSilent_endsWithTheWithdrawal_alsoWithoutALimit() {
        far.publish("a");
        var unlimited = near.connect(ConnectionSettings.defaults().withoutAnswerLimit())
                .actor()
                .sayLater("for long");
        test.runQueued();
        pipe.lose("far");
        seconds(15);
        assertThat(test.error(unlimited))
                .isInstanceOfSatisfying(
                        ServiceCallException.class,
                        error -> assertThat(error.mayHaveRun()).isTrue());
        pipe.loseNoMore("far");
        losses.clear();
    }

    @Test
    void callThatIsTooLarge_hasNotRun_andAnAnswerThatIs_mayHaveRun() {
        far.publish("a");
        var parrot = near.connected();
        String big = "x".repeat(2_000_000);
        assertThat(test.error(parrot.say(big)))
                .isInstanceOfSatisfying(
                        ServiceCallException.class,
                        error -> assertThat(error.mayHaveRun()).isFalse())
                .hasMessageContaining("expected at most 1048576");
        var later = parrot.sayLater("x");
        test.runQueued();
        far.parrots.get("a").later().remove().resolve(big);
        assertThat(test.error(later))
                .isInstanceOfSatisfying(
                        ServiceCallException.class,
                        error -> assertThat(error.mayHaveRun()).isTrue())
                .hasMessageContaining("the answer could not be sent");
        assertThat(get(parrot.say("still there"))).isEqualTo("a: still there");
        losses.clear();
    }

    @Test
    void callsToASpaceThatHangs_areRejectedWhenItsQueueIsFull_andWereNotSent() {
        try (var slow = new TestSpace()) {
            get(far.services.publishSpawned(
                    slow.space(), "parrot", List.of(), slow.spawn(Parrot.class, () -> far.parrot("slow"))));
            var connection = near.connect(ConnectionSettings.defaults());
            slowly(slow, connection.whenReady());
            var parrot = connection.actor();
            List<Promise<String>> answers = new ArrayList<>();
            for (int i = 0; i < 1_025; i++) {
                answers.add(parrot.say("" + i));
            }
            assertThat(test.error(answers.getLast()))
                    .isInstanceOfSatisfying(
                            ServiceCallException.class,
                            error -> assertThat(error.mayHaveRun()).isFalse())
                    .hasMessageContaining("is too busy: 1024 questions for call wait there");
            slow.runQueued();
            assertThat(slowly(slow, answers.getFirst())).isEqualTo("slow: 0");
            losses.clear();
            get(far.broker.closeAsync());
            slow.runQueued();
        }
    }

    private <T extends @Nullable Object> T slowly(TestSpace slow, Promise<T> promise) {
        for (int round = 0; round < 10; round++) {
            test.runQueued();
            slow.runQueued();
        }
        return get(promise);
    }

    private int ports;

    /** Calls a method of the parrot with a text, without a connection. */
    private Promise<CallMessages.Result> call(String method) {
        var port = near.bus.attach("test" + ++ports);
        var sayLater = new CallableInterfaces().of(Parrot.class).method("sayLater(String)");
        var arguments = sayLater.encode(new Object[] {"hello"}, parameter -> 0);
        var call = new CallMessages.Call(port.address(), method, arguments);
        return port.ask(new Address("far", "parrot"), CallMessages.CALL, call, LONG);
    }

    @Test
    void callOfAMethodThatTheActorDoesNotHave_isRejectedByItsName() {
        far.publish("a");
        get(near.connected().say("1"));
        assertThat(test.error(call("sayLatter(String)")))
                .isInstanceOfSatisfying(
                        BusException.class,
                        error -> assertThat(error.mayHaveRun()).isFalse())
                .hasMessageContaining("it has no method sayLatter(String); did you mean sayLater(String)?");
        losses.clear();
    }

    @Test
    void endOfTheActor_isNoAnswerOfIt_andTheEndOfAnotherActorIs() {
        far.publish("a");
        get(near.connected().say("1"));
        var other = test.spawn(Parrot.class, () -> far.parrot("other"));
        var lost = other.sayLater("x");
        test.runQueued();
        test.space().stop(other);
        assertThat(test.error(lost)).isInstanceOf(ActorStoppedException.class);
        var answered = call("sayLater(String)");
        test.runQueued();
        far.parrots.get("a").later().remove().reject(test.error(lost));
        assertThat(test.error(answered))
                .isInstanceOf(RemoteFailure.class)
                .hasMessageContaining("ActorStoppedException");
        var unanswered = call("sayLater(String)");
        test.runQueued();
        far.kill("parrot");
        assertThat(test.error(unanswered))
                .isInstanceOfSatisfying(
                        BusException.class,
                        error -> assertThat(error.mayHaveRun()).isTrue());
        losses.clear();
    }

    interface Lists {
        Promise<List<Integer>> get();
    }

    @Test
    void resultThatCannotBeSent_isAnError() {
        get(far.services.publish(test.space(), Lists.class, "lists", List.of(), () -> () -> Promise.of(withNull())));
        var lists = near.services
                .connect(Lists.class, Need.ofService("user", "lists"))
                .actor();
        assertThat(test.error(lists.get())).isInstanceOf(RemoteFailure.class).hasMessageContaining("null");
    }

    // ---- cancellation

    @Test
    void cancelledCall_thatStillWaitsThere_isNotHandled() {
        try (var slow = new TestSpace()) {
            get(far.services.publishSpawned(
                    slow.space(), "parrot", List.of(), slow.spawn(Parrot.class, () -> far.parrot("slow"))));
            var connection = near.connect(
                    ConnectionSettings.defaults().withAnswerLimit(LONG).withWaitLimit(LONG));
            slowly(slow, connection.whenReady());
            var parrot = connection.actor();
            var unwanted = parrot.say("unwanted");
            var wanted = parrot.say("wanted");
            test.runQueued();
            unwanted.cancel();
            assertThat(slowly(slow, wanted)).isEqualTo("slow: wanted");
            assertThat(diary).containsExactly("slow is made", "slow says wanted");
            assertThat(unwanted.error()).isInstanceOf(CancellationException.class);
            connection.close();
            get(far.broker.closeAsync());
            slow.runQueued();
        }
    }

    // ---- streams

    interface Counter {
        void count(int to, Callback<Integer> callback);

        void give(Callback<Integer> callback);

        Promise<@Nullable Void> watch(Callback<List<Double>> callback);
    }

    private static final class CounterActor implements Counter {
        private final List<Callback<Integer>> given;

        CounterActor(List<Callback<Integer>> given) {
            this.given = given;
        }

        @Override
        public void count(int to, Callback<Integer> callback) {
            for (int i = 1; i <= to; i++) {
                callback.next(i);
            }
            callback.finish();
        }

        @Override
        public void give(Callback<Integer> callback) {
            given.add(callback);
        }

        @Override
        public Promise<@Nullable Void> watch(Callback<List<Double>> callback) {
            callback.next(List.of(1.5, 2.0));
            return Promise.done();
        }
    }

    private final List<Callback<Integer>> given = new ArrayList<>();

    private Counter counter() {
        get(far.services.publish(test.space(), Counter.class, "counter", List.of(), () -> new CounterActor(given)));
        var connection = near.services.connect(Counter.class, Need.ofService("user", "counter"));
        get(connection.whenReady());
        return connection.actor();
    }

    private Callback<Integer> given(Counter counter, Callback<Integer> callback) {
        counter.give(callback);
        test.runQueued();
        return given.getLast();
    }

    @Test
    void stream_arrivesInOrder_andEnds() {
        var counter = counter();
        var probe = test.<Integer>callback();
        counter.count(1_000, probe);
        test.runQueued();
        assertThat(probe.results()).hasSize(1_000).isSorted().startsWith(1).endsWith(1_000);
        probe.expectFinished();
        var lists = test.<List<Double>>callback();
        assertThat(get(counter.watch(lists))).isNull();
        assertThat(lists.results()).containsExactly(List.of(1.5, 2.0));
        lists.expectOpen();
    }

    @Test
    void stream_endsWithTheErrorOfTheActor() {
        var probe = test.<Integer>callback();
        var sender = given(counter(), probe);
        sender.next(1);
        sender.fail(new IllegalStateException("no more"));
        assertThat(probe.results()).containsExactly(1);
        assertThat(probe.expectFailed())
                .isInstanceOf(RemoteFailure.class)
                .hasMessage("far/counter failed to answer Counter.give(Callback): java.lang.IllegalStateException: no"
                        + " more");
        assertThat(sender.isCancelled()).isTrue();
    }

    interface Feed {
        void feed(Callback<List<Integer>> callback, List<Integer> first);
    }

    private static List<Integer> withNull() {
        var list = new ArrayList<Integer>();
        list.add(null);
        return list;
    }

    @Test
    void valueThatCannotBeSent_endsTheStream_onBothSides() {
        List<Callback<List<Integer>>> senders = new ArrayList<>();
        Feed actor = (callback, first) -> senders.add(callback);
        get(far.services.publish(test.space(), Feed.class, "feed", List.of(), () -> actor));
        var connection = near.services.connect(Feed.class, Need.ofService("user", "feed"));
        var feed = get(connection.whenReady());
        var refused = test.<List<Integer>>callback();
        feed.feed(refused, withNull());
        assertThat(refused.expectFailed()).hasMessageContaining("argument 2 cannot be sent");
        assertThat(near.events(BrokerEvent.CallRejected.class)).hasSize(1);
        assertThat(senders).isEmpty();
        var probe = test.<List<Integer>>callback();
        feed.feed(probe, List.of());
        test.runQueued();
        senders.getLast().next(withNull());
        test.runQueued();
        assertThat(test.takeProblems()).hasSize(1);
        assertThat(probe.expectFailed()).hasMessageContaining("null");
        assertThat(senders.getLast().isCancelled()).isTrue();
        connection.close();
        test.runQueued();
        near.bus.attach(new OwnName("$caller-1")).close(); // the name of its port is free again
    }

    /** An end that cannot be sent would leave its reader waiting for ever. */
    @Test
    void errorsWithLongTexts_endStreamsAndCalls() {
        far.publish("a");
        var later = near.connected().sayLater("x");
        test.runQueued();
        far.parrots.get("a").later().remove().reject(new IllegalStateException("x".repeat(2_000_000) + "\ud83d"));
        assertThat(test.error(later)).hasMessageContaining("xxx .. (2000001 characters)");
        var end = new ArrayList<@Nullable Throwable>();
        var sender = given(counter(), new Callback.Stream<Integer>(i -> {}, end::add));
        sender.accept(null, new IllegalStateException("y".repeat(2_000_000)));
        test.runQueued();
        seconds(1);
        assertThat(end).singleElement().asString().contains("yyy .. (2000000 characters)");
        losses.clear();
    }

    @Test
    void streamThatItsReaderCancels_stopsTheSender() {
        var got = new ArrayList<Integer>();
        var stream = new Callback.Stream<Integer>(got::add, end -> {});
        var sender = given(counter(), stream);
        sender.next(1);
        test.runQueued();
        stream.cancel();
        assertThat(sender.isCancelled()).isFalse();
        sender.next(2);
        test.runQueued();
        assertThat(sender.isCancelled()).as("told with the next item").isTrue();
        assertThat(got).containsExactly(1);
    }

    @Test
    void streamWithALostItem_endsWithTheirNumber_onBothSides() {
        var probe = test.<Integer>callback();
        var sender = given(counter(), probe);
        sender.next(1);
        test.runQueued();
        pipe.loseNext(2);
        sender.next(2);
        sender.next(3);
        test.runQueued();
        sender.next(4);
        test.runQueued();
        assertThat(probe.results()).containsExactly(1);
        assertThat(probe.expectFailed())
                .hasMessage("2 items of the stream of Counter.give(Callback) from far/counter were lost, before"
                        + " number 4");
        assertThat(sender.isCancelled()).isTrue();
        seconds(11);
        losses.clear();
    }

    @Test
    void streamForASlowReader_isBuffered_andThenEndsWithTheCounts() {
        try (var readers = new TestSpace()) {
            var counter = counter();
            var reading = near.services.connect(Counter.class, Need.ofService("user", "counter"));
            get(reading.whenReady());
            assertThat(counter).isNotNull();
            var probe = readers.<Integer>callback();
            // the connection lives on the space of its reader, which hangs
            List<ActorConnection<Counter>> connection = new ArrayList<>();
            readers.run(
                    () -> connection.add(near.services.connect(Counter.class, Need.ofService("reader", "counter"))));
            for (int round = 0; round < 5; round++) {
                test.runQueued();
                readers.runQueued();
            }
            readers.run(() -> connection.getFirst().actor().give(probe));
            test.runQueued();
            var sender = given.getLast();
            for (int i = 1; i <= 256 + 1_024; i++) {
                sender.next(i);
            }
            test.runQueued();
            assertThat(sender.isCancelled()).isFalse();
            for (int round = 0; round < 20; round++) {
                readers.runQueued();
                test.runQueued();
            }
            assertThat(probe.results()).hasSize(1_280).isSorted();
            for (int i = 1; i <= 256 + 1_024 + 1; i++) {
                sender.next(i);
            }
            test.runQueued();
            assertThat(sender.isCancelled()).isTrue();
            readers.runQueued();
            assertThat(probe.results()).hasSize(1_280 + 256);
            assertThat(probe.expectFailed())
                    .hasMessageEndingWith(
                            "the reader is too slow: 256 items have no answer, and 1024 more waited and" + " are lost");
            connection.getFirst().close();
            readers.runQueued();
            test.runQueued();
        }
    }

    @Test
    void streamWhoseReaderIsGone_stopsTheSender() {
        var third = host("third");
        counter();
        var connection = third.services.connect(Counter.class, Need.ofService("guest", "counter"));
        get(connection.whenReady());
        var sender = given(connection.actor(), (value, error) -> {});
        sender.next(1);
        test.runQueued();
        assertThat(sender.isCancelled()).isFalse();
        third.die();
        sender.next(2);
        test.runQueued();
        assertThat(sender.isCancelled()).isTrue();
        losses.clear();
    }

    @Test
    void streamWhoseConnectionIsClosed_endsWithAnError_andStopsTheSender() {
        counter();
        var connection = near.services.connect(Counter.class, Need.ofService("guest", "counter"));
        get(connection.whenReady());
        var probe = test.<Integer>callback();
        var sender = given(connection.actor(), probe);
        connection.close();
        assertThat(probe.expectFailed()).hasMessage("the connection of \"guest\" was closed");
        sender.next(1);
        test.runQueued();
        assertThat(sender.isCancelled()).isTrue();
        losses.clear();
    }

    @Test
    void streamOfACallThatIsNotDelivered_endsWithAnError() {
        var counter = counter();
        seconds(3);
        far.die();
        var probe = test.<Integer>callback();
        counter.count(3, probe);
        assertThat(probe.expectFailed()).hasMessageContaining("there is no way from node near to node far");
        losses.clear();
    }

    @Test
    void streamOfANodeThatDies_endsWithAnError() {
        var probe = test.<Integer>callback();
        given(counter(), probe).next(1);
        seconds(3);
        far.die();
        seconds(1);
        assertThat(probe.expectFailed()).hasMessage("far/counter ended before its stream");
        losses.clear();
    }

    @Test
    void streamOfACallThatFindsNoProvider_endsWithAnError() {
        var connection = near.services.connect(Counter.class, Need.ofService("guest", "counter"));
        connection.first().handle((provider, missing) -> null);
        var probe = test.<Integer>callback();
        connection.actor().give(probe);
        seconds(2);
        assertThat(probe.expectFailed())
                .isInstanceOfSatisfying(
                        ServiceCallException.class,
                        error -> assertThat(error.mayHaveRun()).isFalse())
                .hasMessageContaining("found no provider within PT1S");
    }

    @Test
    void streamOfACallThatIsLost_endsWithAnError() {
        var counter = counter();
        var probe = test.<Integer>callback();
        pipe.loseNext(1);
        counter.count(3, probe);
        seconds(6);
        assertThat(probe.expectFailed()).hasMessageContaining("no answer within");
    }

    @Test
    void streamWhoseEndIsLost_getsItAgain() {
        var probe = test.<Integer>callback();
        var sender = given(counter(), probe);
        sender.next(1);
        test.runQueued();
        pipe.loseNext(1);
        sender.finish();
        seconds(3);
        assertThat(probe.results()).containsExactly(1);
        probe.expectFinished();
    }

    @Test
    void streamToAnEarlierLifeOfItsReader_endsNoneOfTheNewOne() {
        counter();
        var earlier = host("third");
        var old = earlier.services.connect(Counter.class, Need.ofService("guest", "counter"));
        get(old.whenReady());
        var toOld = given(old.actor(), (value, error) -> {});
        earlier.die();
        var later = host("third");
        var next = later.services.connect(Counter.class, Need.ofService("guest", "counter"));
        get(next.whenReady());
        var probe = test.<Integer>callback();
        var toNew = given(next.actor(), probe);
        toOld.next(17);
        toNew.next(1);
        test.runQueued();
        assertThat(probe.results()).containsExactly(1);
        probe.expectOpen();
        assertThat(toOld.isCancelled()).isTrue();
        assertThat(toNew.isCancelled()).isFalse();
    }

    // ---- providers of this process

    @Test
    void actorThatWasSpawnedBefore_isLeftToItsOwner_andRejectsCallsWhileItIsWithdrawn() {
        var mine = test.spawn(Parrot.class, () -> far.parrot("mine"));
        get(far.services.publishSpawned(test.space(), "parrot", List.of(), mine));
        var parrot = near.connected();
        assertThat(get(parrot.say("1"))).isEqualTo("mine: 1");
        get(far.broker.withdraw(new Address("far", "parrot")));
        assertThat(get(mine.say("2"))).isEqualTo("mine: 2");
        var port = near.bus.attach("test");
        var call = new CallMessages.Call(
                port.address(), "hear(String)", new CallableMethods.Values().encode(int.class, 1));
        assertThat(test.error(port.ask(new Address("far", "parrot"), CallMessages.CALL, call, LONG)))
                .hasMessageEndingWith("it was withdrawn");
        losses.clear();
        get(far.services.publishSpawned(test.space(), "parrot", List.of(), mine));
        assertThat(get(parrot.say("3"))).isEqualTo("mine: 3");
        test.space().stop(mine);
        test.runQueued();
        assertThat(far.health("far/parrot#2")).isEqualTo(Health.FAILED);
    }

    @Test
    void replacedActor_answersWhatItWasAskedBefore() {
        far.publish("a");
        var parrot = near.connected();
        get(parrot.say("0"));
        var before = new ArrayList<Promise<String>>();
        for (int i = 1; i <= 3; i++) {
            before.add(parrot.say("old " + i));
        }
        var replaced = far.services.replace(
                new Address("far", "parrot"), test.space(), Parrot.class, "parrot", List.of(), () -> far.parrot("b"));
        assertThat(get(Promise.all(before))).containsExactly("a: old 1", "a: old 2", "a: old 3");
        get(replaced);
        assertThat(get(parrot.say("new"))).isEqualTo("b: new");
    }

    @Test
    void callUnderWay_toAnActorThatIsWithdrawn_isStillAnswered() {
        var mine = test.spawn(Parrot.class, () -> far.parrot("mine"));
        get(far.services.publishSpawned(test.space(), "parrot", List.of(), mine));
        var answer = near.connected().sayLater("hello");
        test.runQueued();
        get(far.broker.withdraw(new Address("far", "parrot")));
        seconds(2);
        assertThat(near.health("far/parrot")).isNull();
        far.parrots.get("mine").later().remove().resolve("yes");
        assertThat(get(answer)).isEqualTo("yes");
    }

    @Test
    void actorWhosePortNameIsTaken_isNotStarted_andTheReasonIsNamed() {
        far.bus.attach("parrot");
        far.publish("a");
        var connection = near.connect(ConnectionSettings.defaults());
        assertThat(test.error(connection.first()))
                .hasMessageContaining("far/parrot was not started: the name far/parrot is taken");
    }

    @Test
    void callUnderWay_ofAConnectionThatIsClosed_isRejected() {
        far.publish("a");
        var connection = near.connect(ConnectionSettings.defaults());
        var answer = connection.actor().sayLater("x");
        test.runQueued();
        connection.close();
        assertCallError(
                answer,
                true,
                "the connection of \"robot 1\" was closed while it waited for the answer of far/parrot to"
                        + " Parrot.sayLater(String)");
        far.parrots.get("a").later().forEach(each -> each.resolve("late"));
        test.runQueued();
        losses.clear();
    }
}
