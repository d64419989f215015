package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Promise;
import java.lang.ref.WeakReference;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CancellationException;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/** Calls that their callers cancel, and connections that are closed. */
class GivenUpCallsTest {
    private static final Need PARROT = Need.ofService("robot 1", "parrot");
    private static final ConnectionSettings PATIENT =
            ConnectionSettings.DEFAULT.withWaitLimit(Duration.ofSeconds(100)).withAnswerLimit(Duration.ofSeconds(100));

    /** The way in which a caller cancels a call. */
    private enum Manner {
        CANCEL {
            @Override
            Promise<?> giveUp(Promise<?> call) {
                call.cancel();
                return call;
            }
        },
        TIME_LIMIT {
            @Override
            Promise<?> giveUp(Promise<?> call) {
                return call.orTimeout(Duration.ofMillis(500));
            }
        },
        CANCEL_WHAT_FOLLOWS {
            @Override
            Promise<?> giveUp(Promise<?> call) {
                var next = call.handle((value, error) -> value);
                next.cancel();
                return next;
            }
        };

        /** Returns the promise that is rejected by this. */
        abstract Promise<?> giveUp(Promise<?> call);
    }

    private static void giveUp(ServicesStage stage, Manner manner, Promise<?> call) {
        List<Promise<?>> over = new ArrayList<>();
        stage.bench.test.run(() -> {
            var one = manner.giveUp(call);
            one.handle((value, error) -> error);
            over.add(one);
        });
        stage.bench.seconds(1);
        assertThat(over.getFirst().isRejected()).isTrue();
    }

    @ParameterizedTest
    @EnumSource(Manner.class)
    void callThatWasGivenUp_isNotCarriedOut_whenAProviderComesLater(Manner manner) {
        try (var stage = new ServicesStage()) {
            var parrot = stage.services.connect(Parrot.class, PARROT, PATIENT).actor();
            var unwanted = parrot.say("unwanted");
            var wanted = parrot.say("wanted");
            stage.bench.test.crank();
            giveUp(stage, manner, unwanted);
            stage.bench.seconds(3);
            stage.publish("late");
            assertThat(stage.get(wanted)).isEqualTo("late: wanted");
            assertThat(stage.diary).containsExactly("late says wanted");
            assertThat(unwanted.isDone())
                    .as("and nobody waits for it without end")
                    .isTrue();
        }
    }

    @Test
    void callWithATimeLimit_thatAnotherWaitsFor_isCarriedOut() {
        try (var stage = new ServicesStage()) {
            var parrot = stage.services.connect(Parrot.class, PARROT, PATIENT).actor();
            var call = parrot.say("wanted");
            var later = call.thenApply(text -> "then " + text);
            giveUp(stage, Manner.TIME_LIMIT, call);
            stage.publish("late");
            assertThat(stage.get(later)).isEqualTo("then late: wanted");
        }
    }

    @Test
    void callThatNobodyListensTo_isCarriedOut() {
        try (var stage = new ServicesStage()) {
            var parrot = stage.services.connect(Parrot.class, PARROT, PATIENT).actor();
            parrot.say("listened to by nobody");
            stage.bench.seconds(3);
            stage.publish("late");
            stage.bench.test.crank();
            assertThat(stage.diary).containsExactly("late says listened to by nobody");
        }
    }

    @ParameterizedTest
    @EnumSource(value = Manner.class, names = "CANCEL_WHAT_FOLLOWS", mode = EnumSource.Mode.EXCLUDE)
    void callThatWasGivenUp_makesRoomForAnother_atOnce(Manner manner) {
        try (var stage = new ServicesStage()) {
            var parrot = stage.services
                    .connect(Parrot.class, PARROT, PATIENT.withMostWaiting(1))
                    .actor();
            giveUp(stage, manner, parrot.say("unwanted"));
            var wanted = parrot.say("wanted");
            stage.publish("late");
            assertThat(stage.get(wanted)).isEqualTo("late: wanted");
        }
    }

    @Test
    void callThatWasCancelled_isNotBegunByItsProvider_andHasNoLateAnswer() {
        try (var stage = new ServicesStage();
                var providers = new io.troupe.actor.testkit.TestSpace()) {
            var parrots = providers.spawn(Parrot.class, () -> stage.parrot("far"));
            stage.get(stage.services.publishSpawned(providers.space(), "parrot", List.of(), parrots));
            var parrot = stage.services.connect(Parrot.class, PARROT, PATIENT).actor();
            var begun = parrot.sayLater("begun");
            stage.bench.test.crank();
            providers.crank();
            var waits = parrot.say("waits in the mailbox");
            stage.bench.test.crank();
            begun.cancel();
            waits.cancel();
            stage.bench.test.crank();
            providers.crank();
            stage.last.later.remove().resolve("for nobody");
            providers.crank();
            stage.bench.test.crank();
            assertThat(stage.diary).containsExactly("far begins begun");
            assertThat(stage.bench.events(BrokerEvent.Late.class)).isEmpty();
            assertThat(waits.error()).isInstanceOf(CancellationException.class);
        }
    }

    @Test
    void oneWayCall_thatFindsNoProviderWithinItsOwnLimit_isReported_andNotCarriedOutLater() {
        try (var stage = new ServicesStage()) {
            var parrot = stage.services.connect(Parrot.class, PARROT, PATIENT).actor();
            parrot.hear("old news");
            stage.bench.test.crank();
            stage.bench.test.advance(Duration.ofMillis(900));
            assertThat(stage.bench.events(BrokerEvent.Undelivered.class)).isEmpty();
            stage.bench.test.advance(Duration.ofMillis(200));
            assertThat(stage.bench.events(BrokerEvent.Undelivered.class))
                    .extracting(event -> event.call() + " " + event.why().getMessage())
                    .singleElement()
                    .asString()
                    .startsWith("Parrot.hear(String) Parrot.hear(String) of \"robot 1\"")
                    .contains("found no provider within PT1S");
            stage.publish("late");
            stage.bench.seconds(2);
            assertThat(stage.diary).isEmpty();
        }
    }

    @Test
    void connectionThatIsClosed_leavesNothingBehind_whileItsProviderLives() {
        try (var stage = new ServicesStage()) {
            stage.publish("a");
            var references = new ArrayList<WeakReference<Need>>();
            var open = new ArrayList<ActorConnection<Parrot>>();
            for (int i = 0; i < 20; i++) {
                var need = Need.ofService("robot " + i, "parrot"); // one need per connection
                references.add(new WeakReference<>(need));
                open.add(connected(stage, need)); // overlapping: the last ones are open when the first are closed
            }
            while (open.size() > 1) {
                open.removeFirst().close();
            }
            stage.bench.test.crank();
            stage.bench.events.clear(); // events refer to needs
            int most = 2; // the open one, and the last closed one, which an idle space may keep from its last turn
            for (int tries = 0; tries < 20 && count(references) > most; tries++) {
                System.gc();
            }
            assertThat(count(references)).as("connections in memory").isBetween(1L, (long) most);
            assertThat(stage.get(open.getFirst().actor().say("hi"))).isEqualTo("a: hi");
        }
    }

    private static ActorConnection<Parrot> connected(ServicesStage stage, Need need) {
        var connection = stage.services.connect(Parrot.class, need);
        stage.get(connection.whenReady().thenCompose(parrot -> parrot.say("hello")));
        return connection;
    }

    private static long count(List<WeakReference<Need>> references) {
        return references.stream().filter(each -> each.get() != null).count();
    }
}
