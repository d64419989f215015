package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSettings;
import io.troupe.actor.Supervision;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;

/** Actors as services: published, found, and called through the broker by their proxies. */
class ActorServicesTest {
    private static final Need PARROT = Need.ofService("robot 1", "parrot");

    @Test
    void publishedActor_isSpawnedAtTheFirstNeed_andCalledByItsInterface() {
        try (var stage = new ServicesStage()) {
            stage.publish("grey");
            assertThat(stage.last).isNull();
            var parrot = stage.services.connect(Parrot.class, PARROT).actor();
            parrot.hear("one way");
            assertThat(stage.get(parrot.say("hello"))).isEqualTo("grey: hello");
            assertThat(stage.get(parrot.sayTwice("hi"))).isEqualTo("grey: hi, grey: hi");
            assertThat(stage.diary).startsWith("grey hears one way", "grey says hello");
            assertThat(stage.bench.test.error(parrot.fail("not today")))
                    .isInstanceOf(UnsupportedOperationException.class)
                    .hasMessage("not today");
            assertThat(parrot.toString()).isEqualTo("Parrot for \"robot 1\"");
            assertThat(parrot).isEqualTo(parrot).hasSameHashCodeAs(parrot);
        }
    }

    @Test
    void callbacks_comeToTheCaller_eachInItsOrder() {
        try (var stage = new ServicesStage()) {
            stage.publish("grey");
            var parrot = stage.services.connect(Parrot.class, PARROT).actor();
            var probe = stage.bench.test.<Integer>callback();
            parrot.count(3, probe);
            stage.bench.test.crank();
            assertThat(probe.results()).containsExactly(1, 2, 3);
            probe.expectFinished();
        }
    }

    @Test
    void connection_survivesFailoverAndReplacement_behindTheSameProxy() {
        try (var stage = new ServicesStage()) {
            stage.publish("a");
            stage.publish("b");
            var connection = stage.services.connect(Parrot.class, PARROT);
            var parrot = stage.get(connection.whenReady());
            assertThat(stage.get(parrot.say("1"))).isEqualTo("a: 1");
            stage.kill("parrot");
            assertThat(stage.get(parrot.say("2"))).isEqualTo("b: 2");
            stage.get(stage.services.replace(
                    BrokerBench.at("parrot-2"),
                    stage.bench.test.space(),
                    Parrot.class,
                    "parrot",
                    List.of(),
                    () -> stage.parrot("c")));
            assertThat(stage.get(parrot.say("3"))).isEqualTo("c: 3");
            connection.close();
            assertThat(stage.bench.test.error(parrot.say("4"))).hasMessageContaining("has stopped");
        }
    }

    @Test
    void actorsThatStopped_byThemselvesOrByTheirOwner_areNotKept() {
        try (var stage = new ServicesStage()) {
            stage.publish("a");
            stage.get(stage.services.connect(Parrot.class, PARROT).whenReady());
            assertThat(stage.services.running(BrokerBench.at("parrot"))).isNotNull();
            stage.kill("parrot");
            stage.bench.test.crank();
            assertThat(stage.services.running(BrokerBench.at("parrot"))).isNull();

            var proxy = stage.bench.test.spawn(Parrot.class, () -> stage.parrot("b"));
            stage.get(stage.services.publishSpawned(stage.bench.test.space(), "parrot", List.of(), proxy));
            stage.get(stage.services.connect(Parrot.class, PARROT).whenReady());
            assertThat(stage.services.running(BrokerBench.at("parrot-2"))).isNotNull();
            stage.bench.test.space().stop(proxy);
            stage.bench.test.crank();
            assertThat(stage.services.running(BrokerBench.at("parrot-2"))).isNull();
        }
    }

    @Test
    void call_waitsWhileThereIsNoProvider_andIsSentToTheFirst() {
        try (var stage = new ServicesStage()) {
            var connection = stage.services.connect(
                    Parrot.class, PARROT, ConnectionSettings.DEFAULT.withOneWayLimit(Duration.ofSeconds(5)));
            var parrot = connection.actor();
            var answer = parrot.say("hello");
            parrot.hear("and this");
            assertThat(stage.bench.missing(connection.first())).contains("which nobody offers");
            stage.bench.seconds(4);
            stage.publish("late");
            assertThat(stage.get(answer)).isEqualTo("late: hello");
            stage.bench.test.crank();
            assertThat(stage.diary).containsExactly("late says hello", "late hears and this");
        }
    }

    @Test
    void call_waitsForTheNextProvider_ifTheOneItIsNotifiedOfHasEndedMeanwhile() {
        try (var callers = new TestSpace();
                var providers = new TestSpace();
                var brokers = new TestSpace()) {
            var broker = Broker.open(
                    brokers.space(), BrokerSettings.DEFAULT.withoutRestart().withObserver(event -> {}));
            var services = new ActorServices(broker, "node", callers.space(), event -> {});
            var diary = new ArrayList<String>();
            for (String name : List.of("a", "b")) {
                services.publish(
                        providers.space(), Parrot.class, "parrot", List.of(), () -> new Parrot.Grey(name, diary));
            }
            var connection = services.connect(Parrot.class, PARROT);
            var answer = connection.actor().say("hello");
            callers.crank(); // asks the broker
            brokers.crank(); // spawns a
            providers.crank(); // starts it
            brokers.crank(); // notifies the connection, which has not processed this yet
            providers.space().stop(services.running(BrokerBench.at("parrot")).proxy());
            providers.crank(); // the broker has not been notified of this yet
            callers.crank();
            assertThat(answer.isDone()).isFalse();
            for (int round = 0; round < 4; round++) {
                brokers.crank();
                providers.crank();
                callers.crank();
            }
            assertThat(callers.get(answer)).isEqualTo("b: hello");
            connection.close();
            callers.crank();
            broker.close();
            for (int round = 0; round < 4; round++) {
                brokers.crank();
                providers.crank();
                callers.crank();
            }
        }
    }

    @Test
    void call_waitsOnlyWithinItsLimits_ofTimeAndNumber() {
        try (var stage = new ServicesStage()) {
            var settings = ConnectionSettings.DEFAULT
                    .withWaitLimit(Duration.ofSeconds(2))
                    .withMostWaiting(2);
            var connection = stage.services.connect(Parrot.class, PARROT, settings);
            stage.bench.missing(connection.first());
            var parrot = connection.actor();
            var answer = parrot.say("hello");
            parrot.hear("one way");
            var tooMany = parrot.say("too many");
            assertThat(stage.bench.test.error(tooMany))
                    .isInstanceOf(ServiceCallException.class)
                    .hasMessageStartingWith("Parrot.say(String) of \"robot 1\", which needs the service \"parrot\", "
                            + "was refused: 2 calls wait already, and ");
            stage.bench.seconds(2);
            assertThat(stage.bench.test.error(answer))
                    .hasMessage(
                            "Parrot.say(String) of \"robot 1\", which needs the service \"parrot\", found no provider within PT2S: "
                                    + "\"robot 1\" needs the service \"parrot\", which nobody offers; registered: nothing");
            assertThat(((ServiceCallException) stage.bench.test.error(answer)).wasSent())
                    .isFalse();
            assertThat(stage.bench.events(BrokerEvent.Undelivered.class))
                    .extracting(BrokerEvent.Undelivered::call)
                    .containsExactly("Parrot.hear(String)");
        }
    }

    @Test
    void providerThatDiesWithTheCallUnderWay_rejectsIt_byName() {
        try (var stage = new ServicesStage()) {
            stage.publish("a");
            stage.publish("b");
            var parrot = stage.services.connect(Parrot.class, PARROT).actor();
            var answer = parrot.sayLater("hello");
            stage.bench.test.crank();
            stage.kill("parrot");
            assertThat(stage.bench.test.error(answer))
                    .isInstanceOf(ServiceCallException.class)
                    .hasMessage("node/parrot ended while \"robot 1\" waited for its answer to Parrot.sayLater(String)");
            assertThat(((ServiceCallException) stage.bench.test.error(answer)).wasSent())
                    .isTrue();
            assertThat(stage.diary).containsExactly("a begins hello"); // no other provider executes it again
        }
    }

    @Test
    void answerThatComesLate_isRejectedBefore_andReportedToTheObserver() {
        try (var stage = new ServicesStage()) {
            stage.publish("a");
            var parrot = stage.services.connect(Parrot.class, PARROT).actor();
            var answer = parrot.sayLater("hello");
            stage.bench.test.crank();
            stage.bench.seconds(5);
            assertThat(stage.bench.test.error(answer))
                    .hasMessage("node/parrot did not answer Parrot.sayLater(String) to \"robot 1\" within PT5S");
            stage.last.later.remove().resolve("at last");
            stage.bench.test.crank();
            assertThat(stage.bench.events(BrokerEvent.Late.class))
                    .containsExactly(new BrokerEvent.Late("node/parrot", "Parrot.sayLater(String)", null));
        }
    }

    @Test
    void withoutAnswerLimit_anAnswerMayTakeAsLongAsItsProviderLives() {
        try (var stage = new ServicesStage()) {
            stage.publish("a");
            var parrot = stage.services
                    .connect(Parrot.class, PARROT, ConnectionSettings.DEFAULT.withoutAnswerLimit())
                    .actor();
            var answer = parrot.sayLater("hello");
            stage.bench.test.crank();
            stage.bench.seconds(1000);
            stage.last.later.remove().resolve("at last");
            assertThat(stage.get(answer)).isEqualTo("at last");
        }
    }

    @Test
    void replacedProvider_answersWhatItWasAskedBefore() {
        try (var stage = new ServicesStage()) {
            stage.publish("a");
            var parrot = stage.services.connect(Parrot.class, PARROT).actor();
            stage.get(parrot.say("0"));
            var before = new ArrayList<Promise<String>>();
            for (int i = 1; i <= 3; i++) {
                before.add(parrot.say("old " + i));
            }
            var replaced = stage.services.replace(
                    BrokerBench.at("parrot"),
                    stage.bench.test.space(),
                    Parrot.class,
                    "parrot",
                    List.of(),
                    () -> stage.parrot("b"));
            assertThat(stage.get(Promise.all(before))).containsExactly("a: old 1", "a: old 2", "a: old 3");
            stage.get(replaced);
            assertThat(stage.get(parrot.say("new"))).isEqualTo("b: new");
        }
    }

    @Test
    void wrongInterface_isReportedInPlainWords() {
        try (var stage = new ServicesStage()) {
            stage.publish("a");
            var connection = stage.services.connect(Clock.class, PARROT);
            var answer = connection.actor().now();
            assertThat(stage.bench.test.error(connection.first()))
                    .isInstanceOf(IllegalArgumentException.class)
                    .hasMessage("\"robot 1\" calls the service \"parrot\" as " + Clock.class.getName()
                            + ", and its provider node/parrot is a " + Parrot.class.getName());
            assertThat(stage.bench.test.error(answer)).isSameAs(stage.bench.test.error(connection.first()));
            assertThatThrownBy(() -> stage.services.connect(List.class, PARROT))
                    .isInstanceOf(IllegalArgumentException.class)
                    .hasMessageContaining("expected void (a one-way message) or Promise (a request)");
            assertThatThrownBy(() -> stage.services.connect(String.class, PARROT))
                    .hasMessageContaining("java.lang.String is a class");
        }
    }

    interface Clock {
        Promise<Long> now();
    }

    @Test
    void actorWhoseFactoryThrows_isNotStarted_andTheReasonIsNamed() {
        try (var stage = new ServicesStage()) {
            stage.get(stage.services.publish(stage.bench.test.space(), Parrot.class, "parrot", List.of(), () -> {
                throw new IllegalStateException("no feathers");
            }));
            stage.publish("b");
            var parrot = stage.services.connect(Parrot.class, PARROT).actor();
            assertThat(stage.get(parrot.say("hi"))).isEqualTo("b: hi");
            assertThat(stage.bench.events(BrokerEvent.StartFailed.class))
                    .extracting(event -> event.why().getMessage())
                    .containsExactly(
                            "node/parrot stopped when it was started: java.lang.IllegalStateException: no feathers");
            assertThat(stage.bench.test.takeProblems()).hasSize(1);
        }
    }

    @Test
    void actorThatThrows_isFailedOver_ifItsSupervisionStopsIt() {
        try (var stage = new ServicesStage()) {
            var address = BrokerBench.at("brittle");
            stage.get(stage.bench.broker.register(
                    "parrot",
                    List.of(),
                    address,
                    stage.services.provider(
                            address,
                            stage.bench.test.space(),
                            Brittle.class,
                            () -> () -> {
                                throw new IllegalStateException("broke");
                            },
                            ActorSettings.DEFAULT.withSupervision(Supervision.STOP))));
            var heard = stage.bench.connect("robot 1", "parrot");
            stage.services.connect(Brittle.class, PARROT).actor().poke();
            stage.bench.test.crank();
            assertThat(heard).containsExactly("use brittle", "lost");
            assertThat(stage.bench.test.takeProblems()).hasSize(1);
        }
    }

    interface Brittle {
        void poke();
    }

    @Test
    void actorThatWasSpawnedBefore_isPublished_andLeftToItsOwner() {
        try (var stage = new ServicesStage()) {
            var space = stage.bench.test.space();
            var proxy = stage.bench.test.spawn(Parrot.class, () -> stage.parrot("mine"));
            stage.get(stage.services.publishSpawned(space, "parrot", List.of(), proxy));
            var parrot = stage.services.connect(Parrot.class, PARROT).actor();
            assertThat(stage.get(parrot.say("1"))).isEqualTo("mine: 1");
            stage.get(stage.bench.broker.withdraw(BrokerBench.at("parrot")));
            assertThat(stage.get(proxy.say("2"))).isEqualTo("mine: 2");
            stage.get(stage.services.publishSpawned(space, "parrot", List.of(), proxy));
            assertThat(stage.get(parrot.say("3"))).isEqualTo("mine: 3");
            space.stop(proxy);
            stage.bench.test.crank();
            assertThat(stage.bench.health("parrot-2")).isEqualTo(Health.FAILED);
            assertThat(stage.bench.missing(stage.bench.broker.require(PARROT)))
                    .contains("has stopped, and only who spawned it can spawn it again");
        }
    }
}
