package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.Supervision;
import io.troupe.actor.TurnContext;
import io.troupe.actor.testkit.TestSpace;
import java.lang.ref.WeakReference;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CancellationException;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/** Actors as services: published, found, and called through the broker by their proxies. */
class ActorServicesTest extends BrokerBench {
    private static final Need PARROT = Need.ofService("robot 1", "parrot");
    private static final Duration LONG = Duration.ofSeconds(100);
    private static final ConnectionSettings PATIENT =
            ConnectionSettings.defaults().withWaitLimit(LONG).withAnswerLimit(LONG);

    private final ActorServices services = open();
    private Parrot.@Nullable Grey last;

    ActorServicesTest() {
        super(WITHOUT_RESTART);
    }

    /** Overridden to run the tests with other services; called by the constructor. */
    ActorServices open() {
        return broker.services();
    }

    private Parrot.Grey parrot(String name) {
        last = new Parrot.Grey(name, diary);
        return last;
    }

    private void publish(String name) {
        get(services.publish(test.space(), Parrot.class, "parrot", List.of("talks"), () -> parrot(name)));
    }

    private void publishSpawned(TestSpace spawnedOn, Parrot proxy) {
        get(services.publishSpawned(spawnedOn.space(), "parrot", List.of(), proxy));
    }

    private Promise<ServiceRecord> replace(String address, String by) {
        return services.replace(at(address), test.space(), Parrot.class, "parrot", List.of(), () -> parrot(by));
    }

    private void kill(String address) {
        test.space().stop(services.running(at(address)).proxy());
    }

    private Parrot connected() {
        return connected(ConnectionSettings.defaults());
    }

    private Parrot connected(ConnectionSettings settings) {
        return services.connect(Parrot.class, PARROT, settings).actor();
    }

    /** Gives the answer that the last parrot owes. */
    private void answer(String text) {
        last.later().remove().resolve(text);
    }

    private void assertServiceCallError(Promise<?> call, boolean mayHaveRun, String message) {
        assertThat(test.error(call))
                .hasMessage(message)
                .isInstanceOfSatisfying(
                        ServiceCallException.class,
                        error -> assertThat(error.mayHaveRun()).isEqualTo(mayHaveRun));
    }

    @Test
    void numbersOfAddresses_areNoNames() {
        for (var name : List.of("camera", "camera", "camera-2", "camera-2")) {
            get(services.publish(test.space(), Parrot.class, name, List.of(), () -> parrot("grey")));
        }
        assertThat(get(broker.registered()))
                .extracting(each -> each.provider().name())
                .containsExactly("camera", "camera#2", "camera-2", "camera-2#2");
    }

    /** It is a part of the address, which the message does not mention. */
    @Test
    void nameOfAService_hasNoSlash_andNoCharacterOfNumbersAndOurNames() {
        for (var name : List.of("a/b", " ", "a#2", "$a")) {
            assertThatThrownBy(
                            () -> services.publish(test.space(), Parrot.class, name, List.of(), () -> parrot("grey")))
                    .isInstanceOf(IllegalArgumentException.class)
                    .hasMessage("the name of a service is \"" + name
                            + "\", expected a name without / # $ and control characters");
        }
    }

    @Test
    void actorThatIsNotCreated_rejectsTheCall_whateverTheTextOfTheError() {
        get(services.publish(test.space(), Parrot.class, "grey", List.of(), () -> {
            throw new IllegalStateException() {
                private static final long serialVersionUID = 1L;

                @Override
                public String getMessage() {
                    throw new UnsupportedOperationException();
                }
            };
        }));
        var parrot = services.connect(Parrot.class, Need.ofService("robot 1", "grey"))
                .actor();
        var hello = parrot.say("hello");
        seconds(20); // with a bus, other nodes are asked first
        assertThat(test.error(hello))
                .isInstanceOf(ServiceCallException.class)
                .hasMessageContaining("what cannot be printed: java.lang.UnsupportedOperationException");
        assertThat(test.takeProblems()).hasSize(1);
    }

    @Test
    void publishedActor_isSpawnedAtTheFirstNeed_andCalledByItsInterface() {
        publish("grey");
        assertThat(last).isNull();
        var parrot = connected();
        parrot.hear("one way");
        assertThat(get(parrot.say("hello"))).isEqualTo("grey: hello");
        assertThat(get(parrot.sayTwice("hi"))).isEqualTo("grey: hi, grey: hi");
        assertThat(diary).startsWith("grey hears one way", "grey says hello");
        assertThat(test.error(parrot.fail("not today")))
                .isInstanceOf(UnsupportedOperationException.class)
                .hasMessage("not today");
        assertThat(parrot.toString()).isEqualTo("parrot for robot 1");
        assertThat(parrot).isEqualTo(parrot).hasSameHashCodeAs(parrot);

        var probe = test.<Integer>callback();
        parrot.count(3, probe);
        test.runQueued();
        assertThat(probe.results()).as("to the caller, in order").containsExactly(1, 2, 3);
        probe.expectFinished();
    }

    @Test
    void connection_survivesFailoverAndReplacement_behindTheSameProxy() {
        publish("a");
        publish("b");
        var connection = services.connect(Parrot.class, PARROT);
        var parrot = get(connection.whenReady());
        assertThat(get(parrot.say("1"))).isEqualTo("a: 1");
        kill("parrot");
        assertThat(get(parrot.say("2"))).isEqualTo("b: 2");
        get(replace("parrot#2", "c"));
        assertThat(get(parrot.say("3"))).isEqualTo("c: 3");
        connection.close();
        assertThat(test.error(parrot.say("4")))
                .isInstanceOf(ServiceCallException.class)
                .hasMessage("Parrot.say(String) of parrot for robot 1 was not sent: the connection parrot for robot 1"
                        + " is closed");
    }

    @Test
    void actorsThatStopped_byThemselvesOrByTheirOwner_areNotKept() {
        publish("a");
        get(services.connect(Parrot.class, PARROT).whenReady());
        assertThat(services.running(at("parrot"))).isNotNull();
        kill("parrot");
        test.runQueued();
        assertThat(services.running(at("parrot"))).isNull();

        var proxy = test.spawn(Parrot.class, () -> parrot("b"));
        publishSpawned(test, proxy);
        get(services.connect(Parrot.class, PARROT).whenReady());
        assertThat(services.running(at("parrot#2"))).isNotNull();
        test.space().stop(proxy);
        test.runQueued();
        assertThat(services.running(at("parrot#2"))).isNull();
    }

    @Test
    void actorThatWasSpawnedBefore_isPublished_andLeftToItsOwner() {
        var proxy = test.spawn(Parrot.class, () -> parrot("mine"));
        publishSpawned(test, proxy);
        var parrot = connected();
        assertThat(get(parrot.say("1"))).isEqualTo("mine: 1");
        get(broker.withdraw(at("parrot")));
        assertThat(get(proxy.say("2"))).isEqualTo("mine: 2");
        publishSpawned(test, proxy);
        assertThat(get(parrot.say("3"))).isEqualTo("mine: 3");
        test.space().stop(proxy);
        test.runQueued();
        assertThat(health("parrot#2")).isEqualTo(Health.FAILED);
        assertThat(missing(broker.require(PARROT)))
                .contains("has stopped; this broker did not spawn it and cannot restart it");
    }

    @Test
    void call_waitsWhileThereIsNoProvider_andIsSentToTheFirst() {
        var settings = ConnectionSettings.defaults().withOneWayLimit(Duration.ofSeconds(5));
        var connection = services.connect(Parrot.class, PARROT, settings);
        var parrot = connection.actor();
        var answer = parrot.say("hello");
        parrot.hear("and this");
        assertThat(missing(connection.first())).contains("which no provider offers");
        seconds(4);
        publish("late");
        assertThat(get(answer)).isEqualTo("late: hello");
        test.runQueued();
        assertThat(diary).containsExactly("late says hello", "late hears and this");
    }

    @Test
    void call_waitsForTheNextProvider_ifTheOneItIsNotifiedOfHasEndedMeanwhile() {
        try (var callers = new TestSpace();
                var providers = new TestSpace()) {
            var far = new ActorServices(broker, "node", callers.space(), event -> {}, null);
            for (String name : List.of("a", "b")) {
                far.publish(providers.space(), Parrot.class, "parrot", List.of(), () -> parrot(name));
            }
            Runnable runAll = () -> {
                for (int round = 0; round < 4; round++) {
                    test.runQueued();
                    providers.runQueued();
                    callers.runQueued();
                }
            };
            var connection = far.connect(Parrot.class, PARROT);
            var answer = connection.actor().say("hello");
            callers.runQueued(); // asks the broker
            test.runQueued(); // spawns a
            providers.runQueued(); // starts it
            test.runQueued(); // notifies the connection, which has not processed this yet
            providers.space().stop(far.running(at("parrot")).proxy());
            providers.runQueued(); // the broker has not been notified of this yet
            callers.runQueued();
            assertThat(answer.isDone()).isFalse();
            runAll.run();
            assertThat(callers.get(answer)).isEqualTo("b: hello");
            connection.close();
            callers.runQueued();
            broker.closeAsync();
            runAll.run();
        }
    }

    @Test
    void call_waitsOnlyWithinItsLimits_ofTimeAndNumber() {
        var settings = ConnectionSettings.defaults().withWaitLimit(Duration.ofSeconds(2));
        var connection = services.connect(Parrot.class, PARROT, settings.withCapacity(2));
        missing(connection.first());
        var parrot = connection.actor();
        var answer = parrot.say("hello");
        parrot.hear("one way");
        var tooMany = parrot.say("too many");
        assertThat(test.error(tooMany))
                .isInstanceOf(ServiceCallException.class)
                .hasMessageStartingWith("Parrot.say(String) of \"robot 1\", which needs the service \"parrot\", "
                        + "was rejected: 2 calls wait already, and ");
        seconds(2);
        assertServiceCallError(
                answer,
                false,
                "Parrot.say(String) of \"robot 1\", which needs the service \"parrot\", found no provider within PT2S: "
                        + "\"robot 1\" needs the service \"parrot\", which no provider offers; registered: nothing");
        assertThat(events(BrokerEvent.CallRejected.class))
                .extracting(BrokerEvent.CallRejected::call)
                .containsExactly("Parrot.hear(String)");
    }

    @Test
    void providerThatDiesWithTheCallUnderWay_rejectsIt_byName() {
        publish("a");
        publish("b");
        var answer = connected().sayLater("hello");
        test.runQueued();
        kill("parrot");
        assertServiceCallError(
                answer, true, "node/parrot ended while \"robot 1\" waited for its answer to Parrot.sayLater(String)");
        assertThat(diary).containsExactly("a begins hello"); // no other provider executes it again
    }

    @Test
    void answerThatComesLate_isRejectedBefore_andReportedToTheObserver_unlessThereIsNoLimit() {
        publish("a");
        var unlimited =
                connected(ConnectionSettings.defaults().withoutAnswerLimit()).sayLater("hello");
        var limited = connected().sayLater("hello");
        test.runQueued();
        seconds(5);
        assertThat(test.error(limited))
                .hasMessage("node/parrot did not answer Parrot.sayLater(String) to \"robot 1\" within PT5S");
        seconds(1000);
        answer("as long as its provider lives");
        assertThat(get(unlimited)).isEqualTo("as long as its provider lives");
        assertThat(events(BrokerEvent.Late.class)).isEmpty();
        answer("at last");
        test.runQueued();
        assertThat(events(BrokerEvent.Late.class))
                .containsExactly(new BrokerEvent.Late("node/parrot", "Parrot.sayLater(String)", null));
    }

    @Test
    void replacedProvider_answersWhatItWasAskedBefore() {
        publish("a");
        var parrot = connected();
        get(parrot.say("0"));
        var before = List.of(parrot.say("old 1"), parrot.say("old 2"), parrot.say("old 3"));
        var replaced = replace("parrot", "b");
        assertThat(get(Promise.all(before))).containsExactly("a: old 1", "a: old 2", "a: old 3");
        get(replaced);
        assertThat(get(parrot.say("new"))).isEqualTo("b: new");
    }

    interface Clock {
        Promise<Long> now();
    }

    @Test
    void wrongInterface_isReportedInPlainWords() {
        publish("a");
        var connection = services.connect(Clock.class, PARROT);
        var answer = connection.actor().now();
        assertThat(test.error(connection.first()))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("\"robot 1\" calls the service \"parrot\" as " + Clock.class.getName()
                        + ", and its provider node/parrot is a " + Parrot.class.getName());
        assertThat(test.error(answer)).isSameAs(test.error(connection.first()));
        assertThatThrownBy(() -> services.connect(String.class, PARROT))
                .hasMessageContaining("java.lang.String is a class");
    }

    @Test
    void actorWhoseFactoryThrows_isNotStarted_andTheReasonIsNamed() {
        get(services.publish(test.space(), Parrot.class, "parrot", List.of(), () -> {
            throw new IllegalStateException("no feathers");
        }));
        publish("b");
        assertThat(get(connected().say("hi"))).isEqualTo("b: hi");
        assertThat(events(BrokerEvent.StartFailed.class))
                .extracting(event -> event.why().getMessage())
                .containsExactly(
                        "node/parrot stopped when it was started: java.lang.IllegalStateException: no feathers");
        assertThat(test.takeProblems()).hasSize(1);
    }

    interface Brittle {
        void poke();
    }

    @Test
    void actorThatThrows_isFailedOver_ifItsSupervisionStopsIt() {
        Brittle brittle = () -> {
            throw new IllegalStateException("broke");
        };
        var stopping = ActorSettings.defaults().withSupervision(Supervision.STOP);
        var address = at("brittle");
        var provider = services.provider(address, test.space(), Brittle.class, () -> brittle, stopping);
        get(broker.register("parrot", List.of(), address, provider));
        connect(PARROT, diary::add);
        services.connect(Brittle.class, PARROT).actor().poke();
        test.runQueued();
        assertThat(diary).containsExactly("use brittle", "lost");
        assertThat(test.takeProblems()).hasSize(1);
    }

    // ---- calls that their callers cancel, and connections that are closed

    /** The way in which a caller cancels a call. */
    private enum Manner {
        CANCEL,
        TIME_LIMIT,
        CANCEL_WHAT_FOLLOWS;

        /** Returns the promise that is rejected by this. */
        Promise<?> giveUp(Promise<?> call) {
            if (this == TIME_LIMIT) {
                return call.orTimeout(Duration.ofMillis(500));
            }
            var cancelled = this == CANCEL ? call : call.handle((value, error) -> value);
            cancelled.cancel();
            return cancelled;
        }
    }

    private void giveUp(Manner manner, Promise<?> call) {
        List<Promise<?>> over = new ArrayList<>();
        test.run(() -> {
            over.add(manner.giveUp(call));
            over.getFirst().handle((value, error) -> error);
        });
        seconds(1);
        assertThat(over.getFirst().isRejected()).isTrue();
    }

    @ParameterizedTest
    @EnumSource
    void callThatWasGivenUp_isNotCarriedOut_whenAProviderComesLater(Manner manner) {
        var parrot = connected(PATIENT);
        var unwanted = parrot.say("unwanted");
        var wanted = parrot.say("wanted");
        parrot.say("listened to by nobody");
        test.runQueued();
        giveUp(manner, unwanted);
        seconds(3);
        publish("late");
        assertThat(get(wanted)).isEqualTo("late: wanted");
        assertThat(diary).containsExactly("late says wanted", "late says listened to by nobody");
        assertThat(unwanted.isDone()).as("and nobody waits for it without end").isTrue();
    }

    @Test
    void callWithATimeLimit_thatAnotherWaitsFor_isCarriedOut() {
        var call = connected(PATIENT).say("wanted");
        var later = call.thenApply(text -> "then " + text);
        giveUp(Manner.TIME_LIMIT, call);
        publish("late");
        assertThat(get(later)).isEqualTo("then late: wanted");
    }

    @ParameterizedTest
    @EnumSource(value = Manner.class, names = "CANCEL_WHAT_FOLLOWS", mode = EnumSource.Mode.EXCLUDE)
    void callThatWasGivenUp_makesRoomForAnother_atOnce(Manner manner) {
        var parrot = connected(PATIENT.withCapacity(1));
        giveUp(manner, parrot.say("unwanted"));
        var wanted = parrot.say("wanted");
        publish("late");
        assertThat(get(wanted)).isEqualTo("late: wanted");
    }

    @Test
    void callThatWasCancelled_isNotBegunByItsProvider_andHasNoLateAnswer() {
        try (var providers = new TestSpace()) {
            publishSpawned(providers, providers.spawn(Parrot.class, () -> parrot("far")));
            var parrot = connected(PATIENT);
            var begun = parrot.sayLater("begun");
            for (int round = 0; round < 3; round++) { // with a bus, it has a separate space
                test.runQueued();
                providers.runQueued();
            }
            var waits = parrot.say("waits in the mailbox");
            test.runQueued();
            begun.cancel();
            waits.cancel();
            test.runQueued();
            providers.runQueued();
            answer("for nobody");
            providers.runQueued();
            test.runQueued();
            assertThat(diary).containsExactly("far begins begun");
            assertThat(events(BrokerEvent.Late.class)).isEmpty();
            assertThat(waits.error()).isInstanceOf(CancellationException.class);
        }
    }

    @Test
    void oneWayCall_thatFindsNoProviderWithinItsOwnLimit_isReported_andNotCarriedOutLater() {
        connected(PATIENT).hear("old news");
        test.runQueued();
        test.advance(Duration.ofMillis(900));
        assertThat(events(BrokerEvent.CallRejected.class)).isEmpty();
        test.advance(Duration.ofMillis(200));
        assertThat(events(BrokerEvent.CallRejected.class))
                .extracting(event -> event.call() + " " + event.why().getMessage())
                .singleElement()
                .asString()
                .startsWith("Parrot.hear(String) Parrot.hear(String) of \"robot 1\"")
                .contains("found no provider within PT1S");
        publish("late");
        seconds(2);
        assertThat(diary).isEmpty();
    }

    @Test
    void connectionThatIsClosed_leavesNothingBehind_whileItsProviderLives() {
        publish("a");
        var references = new ArrayList<WeakReference<Need>>();
        var open = new ArrayList<ActorConnection<Parrot>>();
        for (int i = 0; i < 20; i++) {
            var need = Need.ofService("robot " + i, "parrot"); // one need per connection
            references.add(new WeakReference<>(need));
            var connection = services.connect(Parrot.class, need);
            get(connection.whenReady().thenCompose(parrot -> parrot.say("hello")));
            open.add(connection); // overlapping: the last ones are open when the first are closed
        }
        while (open.size() > 1) {
            open.removeFirst().close();
        }
        test.runQueued();
        events.clear(); // events refer to needs
        int most = 2; // the open one, and the last closed one, which an idle space may keep from its last turn
        for (int tries = 0; tries < 20 && count(references) > most; tries++) {
            System.gc();
        }
        assertThat(count(references)).as("connections in memory").isBetween(1L, (long) most);
        assertThat(get(open.getFirst().actor().say("hi"))).isEqualTo("a: hi");
    }

    private static long count(List<WeakReference<Need>> references) {
        return references.stream().filter(each -> each.get() != null).count();
    }

    /** As one that is passed on at once. */
    @Test
    void callThatWaits_isSentInTheContextOfItsCaller() {
        var user = new AtomicReference<@Nullable String>();
        var hook = new TurnContext<String>() {
            @Override
            public @Nullable String capture() {
                return user.get();
            }

            @Override
            public Runnable restore(String captured) {
                String before = user.getAndSet(captured);
                return () -> user.set(before);
            }
        };
        var users = new ArrayList<@Nullable String>();
        try (var own =
                ActorSpace.create(SpaceSettings.named("own").withContext(hook).withoutThread())) {
            ActorServices ours = Broker.open(own, BrokerSettings.defaults().withObserver(event -> {}))
                    .services();
            Bell bell =
                    ours.connect(Bell.class, Need.ofService("robot 1", "bell")).actor();
            own.runQueued();
            for (var name : List.of("ann", "bob")) {
                user.set(name);
                bell.ring();
                user.set(null);
                own.runQueued();
            }
            ours.publish(own, Bell.class, "bell", List.of(), () -> () -> users.add(user.get()));
            own.runQueued();
        }
        assertThat(users).containsExactly("ann", "bob");
    }

    interface Bell {
        void ring();
    }
}
