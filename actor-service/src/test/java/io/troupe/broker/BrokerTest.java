package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.testkit.TestSpace;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.Arguments;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.MethodSource;
import org.junit.jupiter.params.provider.ValueSource;

/** Providers that are registered, started on demand, checked, replaced and withdrawn. */
class BrokerTest extends ScriptedBroker {
    private static final String SCRIPTS = """
            -- started when it is needed, not before

            register_startsNothing
            offer p          |
            wait 5, health p | NOT_STARTED

            concurrentNeeds_startItOnce_andGetTheSame_andWhatRunsIsNotStartedAgain
            offer p, p.start hangs, require 1, require 2 | start p
            health p                                     | STARTING
            p answers                                    | require 1: p WELL, require 2: p WELL
            require 1                                    | require 1: p WELL

            startThatFails_throwsOrHangs_goesOnToTheNext
            offer a, offer b, offer c, offer d, a.start fails, b.start explodes, c.start hangs |
            require 1 | start a, a did not start, start b, b did not start, start c
            wait 10   | c did not start, stop c, start d, require 1: d WELL
            reasons   | a: java.lang.IllegalStateException: a is broken,
                      | b: java.lang.IllegalStateException: b exploded, c: node/c did not start within PT10S

            startThatComesLate_isReported_andStoppedAgain
            offer a, offer b, a.start hangs, require 1 | start a
            wait 10                                    | a did not start, stop a, start b, require 1: b WELL
            a answers                                  | late start of node/a, stop a
            health a                                   | FAILED

            failedProvider_isTriedAgainOnDemand_afterAllOthers
            never restart, offer a, a.start fails, require 1 | start a, a did not start, require 1: missing
            a.start works, wait 100, why | "robot 1" needs the service "player", which is offered,
                                         | but runs nowhere: node/a (java.lang.IllegalStateException: a is broken);
                                         | registered: player (failed)
            offer b, require 1           | start b, require 1: b WELL
            withdraw b                   | stop b, withdraw b: done
            require 1                    | start a, require 1: a WELL

            withdrawnWhileItStarts_isStopped_andTheNextIsUsed
            offer a, offer b, a.start hangs, require 1, withdraw a | start a
            a answers  | start b, stop a, require 1: b WELL, withdraw a: done
            registered | registered: [b WELL]

            noProviderLeft_isAnErrorThatNamesEachAndWhy
            offer a with drives, offer b, a.start fails, b.start hangs, require 1 | start a, a did not start, start b
            wait 10 | b did not start, stop b, require 1: missing
            why     | "robot 1" needs the service "player", which is offered,
                    | but runs nowhere: node/a (java.lang.IllegalStateException: a is broken),
                    | node/b (node/b did not start within PT10S); registered: player (drives; failed), player (failed)

            -- starts that complete when a later run has begun or ended: the provider must not run on because of them

            startAnsweredAfterALaterRunHasFailed_isStopped
            never restart, offer a, a.start hangs, require 1 | start a
            wait 10                  | a did not start, stop a, require 1: missing
            a.start fails, require 1 | start a, a did not start, require 1: missing
            a answers                | late start of node/a, stop a

            startAnsweredAfterALaterRunWasStopped_isStopped
            never restart, offer a, a.start hangs, require 1 | start a
            wait 10                  | a did not start, stop a, require 1: missing
            a.start works, require 1 | start a, require 1: a WELL
            withdraw a               | stop a, withdraw a: done
            a answers                | late start of node/a, stop a

            startAnsweredWhileALaterRunStarts_isStopped_ifThatFails
            never restart, offer a, a.start hangs, require 1 | start a
            wait 10   | a did not start, stop a, require 1: missing
            require 1 | start a
            a answers | late start of node/a
            a rejects | a did not start, stop a, require 1: missing

            startAnsweredWhileALaterRunStarts_isOneLifeWithIt_ifThatSucceeds
            never restart, offer a, a.start hangs, require 1 | start a
            wait 10               | a did not start, stop a, require 1: missing
            require 1             | start a
            a answers             | late start of node/a
            a answers             | require 1: a WELL
            withdraw a            | stop a, withdraw a: done

            startAnsweredWhileItIsBeingStopped_isStoppedOnceMore_beforeItIsStartedAgain
            never restart, offer a, a.start hangs, a.stop hangs, require 1 | start a
            wait 10                                | a did not start, stop a, require 1: missing
            require 1                              |
            a answers                              | late start of node/a
            a.start works, a.stop works, a answers | stop a, start a, require 1: a WELL

            startAnsweredWhileItIsBeingStopped_aLateAnswerToThatStopDoesNotCount
            never restart, offer a, a.start hangs, a.stop hangs, require 1 | start a
            wait 10                | a did not start, stop a, require 1: missing
            a answers, wait 10     | late start of node/a, stop a, a did not stop
            a answers, wait 10     | late stop of node/a
            a.stop works, shutDown | stop a, shutDown: []

            startAnsweredAfterShutDown_isStopped
            never restart, offer a, a.start hangs, require 1 | start a
            wait 10           | a did not start, stop a, require 1: missing
            shutDown          | shutDown: []
            a answers, wait 1 | late start of node/a, stop a

            -- providers with an object for each life: none begins beside an earlier one, and a late one is stopped by itself

            lives_haveAnObjectEach
            never restart, offerLives a, require 1 | start a1, require 1: a WELL
            a1 dies                                | a has failed
            require 1                              | start a2, require 1: a WELL
            withdraw a                             | stop a2, withdraw a: done

            lifeThatIsNotStopped_isStoppedAgain_andBlocksTheNext
            never restart, offerLives a, require 1  | start a1, require 1: a WELL
            a1.check fails, a1.stop fails, wait 1   | a has failed, stop a1, a did not stop
            require 1, run, why | stop a1, a did not stop, require 1: missing,
                                | "robot 1" needs the service "player", which is offered,
                                | but runs nowhere: node/a (node/a cannot start: its previous life could not be stopped:
                                | java.lang.IllegalStateException: a1 is broken); registered: player (failed)
            a1.stop works, require 1                | stop a1, start a2, require 1: a WELL
            withdraw a                              | stop a2, withdraw a: done

            lifeWhoseStopHangs_blocksTheNext_untilALateAnswer
            never restart, offerLives a, require 1 | start a1, require 1: a WELL
            a1.check fails, a1.stop hangs, wait 1  | a has failed, stop a1
            require 1, wait 5                      | a did not stop, require 1: missing
            a1 answers                             | late stop of node/a
            require 1                              | start a2, require 1: a WELL

            withdrawnLifeThatIsNotStopped_isStoppedByTheNextAtItsAddress
            never restart, offerLives a, require 1 | start a1, require 1: a WELL
            a1.stop fails, withdraw a              | stop a1, a did not stop, withdraw a: ProviderException: node/a has not
                                                   | stopped: java.lang.IllegalStateException: a1 is broken
            offerLives b at a, require 1           | stop a1, a did not stop, require 1: missing
            a1.stop works, require 1               | stop a1, start b1, require 1: a WELL

            lifeThatStartsLate_isStoppedByItself_whileTheNextRuns
            never restart, offerLives a, a.start hangs, require 1 | start a1
            wait 10                         | a did not start, stop a1, require 1: missing
            a.start works, require 1        | start a2, require 1: a WELL
            a1 answers                      | late start of node/a, stop a1
            health a                        | WELL
            withdraw a                      | stop a2, withdraw a: done

            lifeThatStartsLate_andCannotBeStopped_isStoppedAgainWithTheNext
            never restart, offerLives a, a.start hangs, require 1  | start a1
            wait 10                         | a did not start, stop a1, require 1: missing
            a.start works, require 1        | start a2, require 1: a WELL
            a1.stop fails, a1 answers       | late start of node/a, stop a1, a did not stop
            a1.stop works, withdraw a       | stop a2, stop a1, withdraw a: done

            -- what is found, and the error that lists what is registered, on one line

            connect_toWhatNobodyOffers_isRejected_andConnectsWhenSomebodyDoes
            connect 1 |
            offer p   | start p, 1: use p

            needThatNobodyOffers_isNamed_withWhatIsThere_andWhatIsSimilar
            offer p with senses+drives, offer w for spaceWanderer, require 1 | start p, require 1: p WELL
            require 2 for spaceWandrer, run, why      | require 2 for spaceWandrer: missing,
                                                        | "robot 2" needs the service "spaceWandrer",
                                                        | which no provider offers; did you mean "spaceWanderer"?
                                                        | registered: player (senses, drives; well),
                                                        | spaceWanderer (not started)
            require 2 with drive, run, why            | require 2 with drive: missing,
                                                        | "robot 2" needs the capability "drive",
                                                        | which no provider offers; did you mean "drives"? registered:
                                                        | player (senses, drives; well), spaceWanderer (not started)
            require 2 for player with flies, run, why | require 2 for player with flies: missing,
                                                        | "robot 2" needs the service "player" with the capability
                                                        | "flies", which no provider offers; registered: player (senses,
                                                        | drives; well), spaceWanderer (not started)

            find_isByNameAndByCapability_theBestFirst_andStartsNothing
            offer a for camera with senses, offer b with senses+drives, offer c with drives |
            find                                    | find: [b NOT_STARTED, c NOT_STARTED]
            find with senses                        | find with senses: [a NOT_STARTED, b NOT_STARTED]
            find for player with senses             | find for player with senses: [b NOT_STARTED]
            require 1, find with senses             | start b, require 1: b WELL, find with senses: [b WELL,
                                                    | a NOT_STARTED]
            require 1 for camera, find with senses  | start a, require 1 for camera: a WELL,
                                                    | find with senses: [a WELL, b WELL]
            a.check hangs, wait 2, find with senses | a is suspect, find with senses: [b WELL, a SUSPECT]

            addressThatIsTaken_isRefused
            offer p            |
            offer p for camera | offer p for camera: IllegalArgumentException: the address node/p is taken by the
                               | service "player", expected a free one
            withdraw q         | withdraw q: IllegalArgumentException: nothing is registered at node/q; registered:
                               | node/p

            -- checks, and clients of a failed provider

            providerThatHangs_isSuspect_thenFailed_andItsUsersGoOver
            offer a, offer b, connect 1     | start a, 1: use a
            a.check hangs, wait 2, health a | a is suspect, SUSPECT
            wait 3, health a                | SUSPECT
            wait 1, health a                | a has failed, stop a, start b, a is followed by b, 1: use b, FAILED

            answerToACheck_thatComesLate_isReported_andDoesNotCount
            offer a, require 1    | start a, require 1: a WELL
            a.check hangs, wait 2 | a is suspect
            a answers             | late check of node/a
            health a              | SUSPECT

            providerThatSaysItIsUnwell_orThrows_hasFailedAtOnce
            offer a, offer b, offer c, connect 1 | start a, 1: use a
            a.check fails, wait 1                | a has failed, stop a, start b, a is followed by b, 1: use b
            b.check explodes, wait 1             | b has failed, stop b, start c, b is followed by c, 1: use c
            reasons                              | a: java.lang.IllegalStateException: a is broken,
                                                 | b: java.lang.IllegalStateException: b exploded

            failedProvider_isStartedAgainWhileAConnectionWaits_afterPausesThatGrow
            restart after 1 to 4, offer a, connect 1 | start a, 1: use a
            a.start fails, a dies                    | a has failed, 1: lost
            wait 1                                   | start a, a did not start
            wait 1                                   |
            wait 1                                   | start a, a did not start
            wait 3                                   |
            wait 1                                   | start a, a did not start
            wait 4                                   | start a, a did not start
            a.start works, wait 3                    |
            wait 1                                   | start a, 1: use a
            wait 4, a dies, wait 1                   | a has failed, 1: lost, start a, 1: use a

            failedProvider_thatNobodyWaitsFor_isLeftAlone
            offer a, offer b, connect 1 | start a, 1: use a
            a dies                      | a has failed, start b, a is followed by b, 1: use b
            wait 200                    |

            restart_waitsForTheStopOfTheLifeBefore_orItsLimit
            never restart, offer a, require 1   | start a, require 1: a WELL
            a.check fails, a.stop hangs, wait 1 | a has failed, stop a
            a.check works, require 1, wait 4    |
            wait 1                              | a did not stop, start a, require 1: a WELL
            a.stop works, reasons               | a: java.lang.IllegalStateException: a is broken,
                                                | a: node/a did not stop within PT5S

            suspect_thatAnswers_isWellAgain_andItsMissesAreForgotten
            offer a, require 1              | start a, require 1: a WELL
            a.check hangs, wait 4, health a | a is suspect, SUSPECT
            a.check works, wait 1, health a | a is well again, WELL
            a.check hangs, wait 4, health a | a is suspect, SUSPECT
            a.check works, wait 1, health a | a is well again, WELL
            a.check hangs, wait 4, health a | a is suspect, SUSPECT
            a.check works, wait 1, health a | a is well again, WELL

            providerThatDies_isNoticedWithoutACheck_andFailoverGoesThroughAllThree
            never restart, offer a, offer b, offer c, connect 1 | start a, 1: use a
            a dies             | a has failed, start b, a is followed by b, 1: use b
            b dies             | b has failed, start c, b is followed by c, 1: use c
            c dies, run, why | c has failed, 1: lost, "robot 1" needs the service "player", which is offered,
                               | but runs nowhere: node/a (java.lang.IllegalStateException: power),
                               | node/b (java.lang.IllegalStateException: power),
                               | node/c (java.lang.IllegalStateException: power); registered: player (failed),
                               | player (failed), player (failed)
            wait 200           |
            require 1          | start a, 1: use a, require 1: a WELL
            count Connected    | 2

            providerThatFailsSoonAfterEachGoodCheck_isStartedAgainAfterPausesThatGrow
            restart after 1 to 4, offer a, connect 1 | start a, 1: use a
            wait 1, a dies                           | a has failed, 1: lost
            wait 1                                   | start a, 1: use a
            wait 1, a dies, wait 1                   | a has failed, 1: lost
            wait 1                                   | start a, 1: use a
            wait 1, a dies, wait 3                   | a has failed, 1: lost
            wait 1                                   | start a, 1: use a
            wait 1, a dies, wait 3                   | a has failed, 1: lost
            wait 1                                   | start a, 1: use a

            -- a connection ends when the actor that opened it stops

            actorThatHasConnected_andStops_isConnectedNoMore
            offer a, join  | start a, user: use a
            leave          |
            replace a by b | start b, user is gone, stop a, replace a by b: b WELL

            providerThatFails_isNotStartedAgain_forAUserThatHasStoppedMeanwhile
            offer a, join   | start a, user: use a
            a dies          | a has failed
            leave, wait 100 |

            providerThatFails_whenItsUserHasStopped_isNotFollowedByAnother
            offer a, offer b, join       | start a, user: use a
            leave                        |
            a dies, wait 100, count Lost | a has failed, user is gone, 0

            -- replaced, withdrawn and closed

            replace_startsTheNew_tellsTheUsers_stopsTheOld_inThisOrder
            offer a, offer z, connect 1, connect 2 | start a, 1: use a, 2: use a
            replace a by b                         | start b, a is followed by b, a is followed by b, 1: use b,
                                                   | 2: use b, stop a, replace a by b: b WELL
            registered, find with better           | registered: [b WELL, z NOT_STARTED], find with better: [b WELL]

            replacement_mayHaveTheAddressOfTheOld
            offer a, connect 1   | start a, 1: use a
            replace a by a' at a | start a', a is followed by a, 1: use a, stop a, replace a by a' at a: a WELL

            replacementThatDoesNotStart_isRefused_andTheOldStaysInUse
            offer a, connect 1                     | start a, 1: use a
            b.start fails, replace a by b          | start b, b did not start,
                                                   | replace a by b: ProviderException: node/b could not be started in
                                                   | the place of node/a,
                                                   | which stays in use: java.lang.IllegalStateException: b is broken
            b.start hangs, replace a by b, wait 10 | start b, b did not start, stop b,
                                                   | replace a by b: ProviderException: node/b could not be started in
                                                   | the place of node/a,
                                                   | which stays in use: node/b did not start within PT10S
            registered                             | registered: [a WELL]
            b.start works, replace a by b          | start b, a is followed by b, 1: use b, stop a,
                                                   | replace a by b: b WELL

            oldThatDoesNotStop_isReported_andTheReplacementHolds
            offer a, connect 1           | start a, 1: use a
            a.stop hangs, replace a by b | start b, a is followed by b, 1: use b, stop a
            wait 5                       | a did not stop, replace a by b: b WELL
            a answers                    | late stop of node/a

            withdraw_givesUsersTheNext_thenStops_andTellsThoseForWhomThereIsNone
            offer a, offer b, connect 1 | start a, 1: use a
            withdraw a                  | start b, a is followed by b, 1: use b, stop a, withdraw a: done
            withdraw b                  | 1: lost, stop b, withdraw b: done
            offer c                     | start c, 1: use c

            providerAtTheAddressOfAWithdrawnOne_isStartedWhenThatHasStopped
            offer a, require 1 | start a, require 1: a WELL
            a.stop hangs, withdraw a, offer a2 at a, withdraw a, offer a3 at a, require 1, wait 2 | stop a,
                               | withdraw a: done
            a answers          | withdraw a: done, start a3, require 1: a WELL

            providerAtTheAddressOfAReplacedOne_isStartedWhenThatHasStopped
            offer a, require 1 | start a, require 1: a WELL
            a.stop hangs, replace a by b, offer a2 for second at a, require 1 for second, wait 2 | start b, stop a
            a answers          | start a2, replace a by b: b WELL, require 1 for second: a WELL

            withdrawnProvider_whoseUserWaitsForTheNextAtItsAddress_isStoppedFirst
            never restart, offer a, offer b, connect 1 | start a, 1: use a
            b.start hangs, withdraw a, offer a2 at a   | start b
            b rejects                                  | b did not start, stop a, withdraw a: done, start a2,
                                                       | a is followed by a, 1: use a

            withdraw_ofWhatDoesNotStop_isRejected
            offer a, require 1               | start a, require 1: a WELL
            a.stop hangs, withdraw a, wait 5 | stop a, a did not stop,
                                             | withdraw a: ProviderException: node/a has not stopped: node/a did not
                                             | stop within PT5S
            a.stop works                     |

            shutDown_whileSomethingStarts_stopsThatToo
            offer a, a.start hangs, require 1 | start a
            close                             |
            a answers, shutDown               | require 1: missing, stop a, shutDown: []
            why                               | "robot 1" needs the service "player", and the broker is being closed

            shutDown_stopsInReverseOrderOfStarts_andSaysWhatDidNotStop
            offer a for one, offer b for two, offer c for three, offer d for four, require 1 for three | start c,
                                            | require 1 for three: c WELL
            require 1 for two               | start b, require 1 for two: b WELL
            require 1 for one               | start a, require 1 for one: a WELL
            b.stop hangs, connect 1 for one | 1: use a
            shutDown                        | 1: lost, stop a, stop b
            wait 5                          | b did not stop, stop c, shutDown: [b FAILED]
            require 1 for four, withdraw d, registered, find for four | require 1 for four: IllegalStateException: the
                                            | broker is closed,
                                            | withdraw d: IllegalStateException: the broker is closed,
                                            | registered: [a STOPPED, b FAILED, c STOPPED, d NOT_STARTED],
                                            | find for four: [d NOT_STARTED]
            """;

    static Stream<Arguments> scripts() {
        return Stream.of(SCRIPTS.replaceAll("(?m)^--.*\\R", "").strip().split("\\R\\R+"))
                .map(script -> script.split("\\R", 2))
                .map(nameAndLines -> Arguments.of(nameAndLines[0], nameAndLines[1]));
    }

    @ParameterizedTest(name = "{0}")
    @MethodSource
    void scripts(String name, String script) {
        play(script);
    }

    @Test
    void nothingRegistered_isSaid_andLineBreaksAreNot() {
        var need = broker.require(Need.ofService("robot\n2", "map"));
        assertThat(missing(need))
                .isEqualTo("\"robot 2\" needs the service \"map\", which no provider offers; registered: nothing");
        assertThat(((MissingServiceException) test.error(need)).need().service())
                .isEqualTo("map");
    }

    @Test
    void messageAboutManyProviders_namesSome_andSaysHowManyMoreThereAre() {
        for (int i = 0; i < 2_000; i++) {
            take("offer", "p" + i, "with", "drives");
            take("p" + i + ".start", "fails");
        }
        assertThat(missing(broker.require(Need.ofService("x", "camera"))))
                .startsWith(
                        "\"x\" needs the service \"camera\", which no provider offers; registered: player (drives; ")
                .endsWith(" and 1980 more")
                .hasSizeLessThan(1_000);
        var broken = broker.require(Need.ofService("x", "player"));
        assertThat(missing(broken))
                .contains("node/p19 (java.lang.IllegalStateException: p19 is broken) and 1980 more; registered: ")
                .doesNotContain("node/p20 ")
                .hasSizeLessThan(4_000);
        assertThat(test.error(broken).getSuppressed()).hasSize(20);
        assertThat(test.error(broker.withdraw(at("q")))).hasMessageEndingWith("node/p19 and 1980 more");
    }

    @Test
    void observerThatThrows_isReported_andChangesNothing() {
        get(broker.closeAsync());
        broker = Broker.open(test.space(), BrokerSettings.defaults().withObserver(event -> {
            throw new IllegalStateException("observer");
        }));
        play("offer p, require 1 | start p, require 1: p WELL");
        assertThat(test.takeProblems()).hasSize(3); // registered, starting, started
        get(broker.closeAsync());
        test.takeProblems();
    }

    @Test
    void usersThatCameAndWent_areForgotten_whenOthersConnect() {
        play("offer a, join | start a, user: use a");
        for (int i = 0; i < 200; i++) {
            take("leave");
            test.runQueued();
            take("join");
            test.runQueued();
        }
        assertThat(events(BrokerEvent.UserGone.class)).hasSizeGreaterThan(100);
    }

    @ParameterizedTest
    @CsvSource({"b, c", "a, a", "a, c"})
    void secondReplacement_whileTheFirstStarts_isRefused_andOnlyOneRuns(String first, String second) {
        play("""
                offer a, connect 1                | start a, 1: use a
                one.start hangs, replace a by one at %1$s | start one
                replace a by two at %2$s          | replace a by two at %2$s: IllegalStateException: node/a is being
                                                  | replaced already, expected one replacement at a time
                one answers, run, registered    | a is followed by %1$s, 1: use %1$s, stop a,
                                                  | replace a by one at %1$s: %1$s WELL, registered: [%1$s WELL]
                replace %1$s by three at %2$s, run, registered | start three, %1$s is followed by %2$s, 1: use %2$s,
                                                  | stop one, replace %1$s by three at %2$s: %2$s WELL,
                                                  | registered: [%2$s WELL]
                """.formatted(first, second));
    }

    @Test
    void userThatThrows_orDoesNotReturn_doesNotHoldUpTheOthers() {
        play("offer a |");
        broker.connect(Need.ofService("bad", "player"), (Client) provider -> {
            throw new IllegalStateException("no, thanks");
        });
        play("""
                connect good   | start a, bad fails: no, thanks, good: use a
                replace a by b | start b, a is followed by b, a is followed by b, good: use b, bad fails: no, thanks,
                               | stop a, replace a by b: b WELL
                """);
    }

    @Test
    void userThatThrowsAnError_isReportedWithIt_andNotAsSlow() {
        play("offer a |");
        broker.connect(Need.ofService("bad", "player"), (Client) provider -> {
            throw new AssertionError("no class for " + provider.provider());
        });
        play("wait 2 | start a, bad fails: no class for node/a");
        assertThat(test.takeProblems())
                .extracting(problem -> problem.error().getMessage())
                .containsExactly("no class for node/a");
    }

    @ParameterizedTest
    @ValueSource(strings = {"a", "elsewhere"})
    void placeThatIsGivenBack_beforeTheUserIsNotified_isServedByANewLife(String address) {
        try (var busy = new TestSpace()) {
            play("offer a |");
            busy.space().execute(() -> take("connect", "1"));
            runInTurn(busy);
            assertThat(diary).containsExactly("start a", "1: use a");
            play("replace a by b | start b, a is followed by b"); // the client's space is busy until it is run
            take("replace", "b", "by", "a", "at", address);
            test.runQueued();
            runInTurn(busy);
            assertThat(diary)
                    .containsExactly(
                            "start b",
                            "a is followed by b",
                            "stop a",
                            "start a",
                            "replace a by b: b WELL",
                            "b is followed by " + address,
                            "1: use b",
                            "1: use " + address,
                            "stop b",
                            "replace b by a at " + address + ": " + address + " WELL");
            play("health " + address + " | WELL");
            take("shutDown");
            runInTurn(busy);
        }
    }

    private void runInTurn(TestSpace user) {
        for (int i = 0; i < 5; i++) { // several round trips
            user.runQueued();
            test.runQueued();
        }
    }

    @ParameterizedTest
    @ValueSource(booleans = {false, true})
    void manyThatAreWithdrawn_whileTheFirstAtTheirAddressStops_takeNoStack(boolean needed) {
        play("""
                offer a, require 1       | start a, require 1: a WELL
                a.stop hangs, withdraw a | stop a
                """);
        int many = needed ? 2_000 : 20_000;
        int refused = 0;
        for (int i = 0; i < many; i++) {
            take("offer", "passing", "at", "a");
            var need = needed ? broker.require(Need.ofService("x", "player")) : null;
            broker.withdraw(at("a"));
            if (need != null) {
                refused += test.error(need) instanceof MissingServiceException ? 1 : 0;
            }
        }
        assertThat(refused).isEqualTo(needed ? many : 0);
        assertThat(diary).as("none of them has run").containsExactly("stop a");
        play("""
                offer last at a, require 1 |
                a answers                  | withdraw a: done, start last, require 1: a WELL
                """);
        assertThat(test.takeProblems()).isEmpty();
    }

    @Test
    void disconnected_receivesNothingAnyMore() {
        play("offer a |");
        Client client = provider -> diary.add("x: use " + provider.provider().name());
        get(broker.connect(Need.ofService("x", "player"), client));
        assertThat(diary).containsExactly("start a", "x: use a");
        get(broker.disconnect(client));
        play("replace a by b | start b, stop a, replace a by b: b WELL");
    }

    @Test
    void spaceThatIsClosedBeforeItsBroker_tellsWhatMayGoOn() {
        var bench = new BrokerTest();
        bench.play("offer a, require 1 | start a, require 1: a WELL");
        bench.test.close();
        assertThat(bench.events(BrokerEvent.LeftRunning.class))
                .extracting(event -> event.provider().provider().name())
                .containsExactly("a");
    }
}
