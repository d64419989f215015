package io.troupe.actor.testkit;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.testkit.RingFinder.Kind;
import io.troupe.actor.testkit.RingFinder.Ring;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.List;
import java.util.function.Supplier;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** Rings of calls that were planted, and chains of calls that are none. */
class RingFinderTest {
    private final RingFinder rings = new RingFinder();
    private final TestSpace test = new TestSpace(rings);

    @AfterEach
    void close() {
        test.takeProblems();
        test.takeDeadLetters();
        test.space().close();
    }

    /** An account asks the other one, which may ask back. */
    interface Account {
        Promise<Integer> pay(Account to, int amount);

        Promise<Integer> payAndAsk(Account to, int amount);

        Promise<Integer> deposit(int amount);

        Promise<Integer> depositAndAsk(Account from, int amount);

        Promise<Integer> content();
    }

    private static class PlainAccount extends Actor implements Account {
        private int content = 10;

        /** What is done around a call of another account. */
        Promise<Integer> during(Supplier<Promise<Integer>> call) {
            return call.get();
        }

        @Override
        public Promise<Integer> pay(Account to, int amount) {
            return during(() -> to.deposit(amount).then(theirs -> content -= amount));
        }

        @Override
        public Promise<Integer> payAndAsk(Account to, int amount) {
            return during(() -> to.depositAndAsk(self(), amount).then(mine -> content = mine - amount));
        }

        @Override
        public Promise<Integer> deposit(int amount) {
            content += amount;
            return Promise.of(content);
        }

        @Override
        public Promise<Integer> depositAndAsk(Account from, int amount) {
            content += amount;
            return from.content();
        }

        @Override
        public Promise<Integer> content() {
            return Promise.of(content);
        }
    }

    /** Takes no call while it waits. */
    private static class CarefulAccount extends PlainAccount {
        @Override
        Promise<Integer> during(Supplier<Promise<Integer>> call) {
            context().hold();
            return call.get().eventually(() -> {
                context().release();
                return Promise.of(null);
            });
        }
    }

    /** Takes its calls one after the other by a private lock. */
    private static class LockedAccount extends PlainAccount {
        private Promise<?> last = Promise.of(0);

        private Promise<Integer> inTurn(Supplier<Promise<Integer>> call) {
            Promise<Integer> next = last.thenCompose(before -> call.get());
            last = next;
            return next;
        }

        @Override
        Promise<Integer> during(Supplier<Promise<Integer>> call) {
            return inTurn(call);
        }

        @Override
        public Promise<Integer> content() {
            return inTurn(super::content);
        }
    }

    private Account account(String name, Supplier<Account> factory) {
        return test.spawn(Account.class, factory, ActorSettings.named(name));
    }

    @Test
    void ringOfAnActorThatHoldsItsCalls_blocks() {
        Account one = account("one", CarefulAccount::new);
        Account two = account("two", PlainAccount::new);
        one.payAndAsk(two, 5);
        test.runQueued();
        rings.idle();
        assertThat(rings.rings()).singleElement().hasToString("""
                        one is called while it waits for that call: a ring that blocks one, two
                          - one serves payAndAsk, which waits for two.depositAndAsk
                          - two serves depositAndAsk, which waits for one.content, which that has not begun: it holds its calls""");
        assertThatThrownBy(rings::check).isInstanceOf(AssertionError.class).hasMessageStartingWith("one is called");
    }

    @Test
    void sameRingOfActorsThatTakeCallsMeanwhile_passes() {
        Account one = account("one", PlainAccount::new);
        Account two = account("two", PlainAccount::new);
        assertThat(test.get(one.payAndAsk(two, 5))).isPositive();
        rings.idle();
        assertThat(rings.rings()).singleElement().hasToString("""
                        one is called while it serves a call that waits for one, and answers
                          - one serves payAndAsk, which waits for two.depositAndAsk
                          - two serves depositAndAsk, which waits for one.content""");
        rings.check();
    }

    @Test
    void ringOfAnActorWithALockOfItsOwn_blocks() {
        Account one = account("one", LockedAccount::new);
        Account two = account("two", PlainAccount::new);
        one.payAndAsk(two, 5);
        test.runQueued();
        rings.idle();
        assertThat(rings.rings()).singleElement().hasToString("""
                        one is called while it waits for that call: a ring that blocks one, two
                          - one serves payAndAsk, which waits for two.depositAndAsk
                          - two serves depositAndAsk, which waits for one.content, which that has begun and does not answer""");
    }

    /** One after the other, so that nothing blocks in this run. */
    @Test
    void actorsThatHoldTheirCallsForEachOther_atDifferentTimes_areAPossibleRing() {
        Account one = account("one", CarefulAccount::new);
        Account two = account("two", CarefulAccount::new);
        assertThat(test.get(one.pay(two, 5))).isPositive();
        assertThat(test.get(two.pay(one, 5))).isPositive();
        rings.idle();
        assertThat(rings.rings()).singleElement().hasToString("""
                        one, two may come to wait for each other: each holds its calls meanwhile
                          - one serves pay, which waits for two.deposit, and holds its calls meanwhile
                          - two serves pay, which waits for one.deposit, and holds its calls meanwhile""");
        assertThatThrownBy(rings::check).hasMessageContaining("may come to wait for each other");
    }

    @Test
    void actorsThatHoldTheirCallsForEachOther_atTheSameTime_block() {
        Account one = account("one", CarefulAccount::new);
        Account two = account("two", CarefulAccount::new);
        test.run(() -> {
            one.pay(two, 5);
            two.pay(one, 5);
        });
        rings.idle();
        assertThat(rings.rings()).singleElement().hasToString("""
                        one is called while it waits for that call: a ring that blocks one, two
                          - one serves pay, which waits for two.deposit, which that has not begun: it holds its calls
                          - two serves pay, which waits for one.deposit, which that has not begun: it holds its calls""");
    }

    @Test
    void ringThatATimeLimitEnds_hasBlocked() {
        Account one = account("one", CarefulAccount::new);
        Account two = account("two", () -> new PlainAccount() {
            @Override
            public Promise<Integer> depositAndAsk(Account from, int amount) {
                return super.depositAndAsk(from, amount).orTimeout(Duration.ofSeconds(1));
            }
        });
        Promise<Integer> paid = one.payAndAsk(two, 5);
        test.advance(Duration.ofSeconds(2));
        test.error(paid);
        rings.idle();
        assertThat(rings.rings()).extracting(Ring::kind).containsExactly(Kind.BLOCKED);
    }

    @Test
    void actorThatAsksWhileItStarts_andIsAskedBack_blocks() {
        Account two = account("two", PlainAccount::new);
        account("one", () -> new CarefulAccount() {
            @Override
            protected void started() {
                during(() -> two.depositAndAsk(self(), 1));
            }
        });
        rings.idle();
        assertThat(rings.rings())
                .singleElement()
                .satisfies(ring -> assertThat(ring.waits())
                        .extracting(RingFinder.Wait::asks)
                        .containsExactly("two.depositAndAsk", "one.content"));
    }

    /** The chain goes through a sequential body, and through a second space. */
    @Test
    void ringOverTwoSpaces_throughASequentialBody_blocks() {
        try (var other = ActorSpace.create(SpaceSettings.named("other")
                .withClock(test.clock())
                .withCallObserver(rings)
                .withoutThread())) {
            Account two = other.spawn(
                    Account.class,
                    () -> new PlainAccount() {
                        @Override
                        public Promise<Integer> depositAndAsk(Account from, int amount) {
                            return context().space().sequential(() -> {
                                int first = from.content().await();
                                return first + from.content().await();
                            });
                        }
                    },
                    ActorSettings.named("two"));
            Account free = account("free", PlainAccount::new);
            Promise<Integer> paid = free.payAndAsk(two, 5);
            for (int round = 0; round < 10; round++) {
                test.runQueued();
                other.runQueued();
            }
            assertThat(test.get(paid)).isPositive();
            assertThat(rings.rings()).extracting(Ring::kind).containsExactly(Kind.PASSED); // seen twice, known once

            Account one = account("one", CarefulAccount::new);
            one.payAndAsk(two, 5);
            for (int round = 0; round < 10; round++) {
                test.runQueued();
                other.runQueued();
            }
            rings.idle();
            assertThat(rings.rings()).extracting(Ring::kind).containsExactly(Kind.PASSED, Kind.BLOCKED);
        }
    }

    @Test
    void unnamedActorsOfOneType_areDifferentActors() {
        Account one = test.spawn(Account.class, CarefulAccount::new);
        Account two = test.spawn(Account.class, PlainAccount::new);
        Account three = test.spawn(Account.class, PlainAccount::new);
        test.get(one.pay(two, 1));
        test.get(two.payAndAsk(three, 1));
        assertThat(rings.rings()).extracting(Ring::toString).containsExactly("""
                        Account#2 is called while it serves a call that waits for Account#2, and answers
                          - Account#2 serves payAndAsk, which waits for Account#3.depositAndAsk
                          - Account#3 serves depositAndAsk, which waits for Account#2.content""");
    }

    @Test
    void sampleOfTheGuide() {
        var rings = new RingFinder();
        try (var test = new TestSpace(rings)) {
            Account one = test.spawn(Account.class, CarefulAccount::new, ActorSettings.named("one"));
            Account two = test.spawn(Account.class, CarefulAccount::new, ActorSettings.named("two"));
            test.get(one.pay(two, 5));
            test.get(two.pay(one, 5));
        }
        rings.idle();
        assertThatThrownBy(rings::check).hasMessageContaining("may come to wait for each other");
    }

    /** The first call is answered before the one that comes back, so it has not waited for that. */
    @Test
    void callThatNobodyWaitsFor_isNoRing() {
        Account one = account("one", PlainAccount::new);
        var late = new Deferred<Integer>();
        Account two = account("two", () -> new PlainAccount() {
            @Override
            public Promise<Integer> depositAndAsk(Account from, int amount) {
                from.content();
                return Promise.of(0);
            }
        });
        test.get(one.payAndAsk(two, 5));
        Account slow = account("slow", () -> new PlainAccount() {
            @Override
            public Promise<Integer> deposit(int amount) {
                return late;
            }
        });
        one.pay(slow, 1);
        test.runQueued();
        rings.idle();
        assertThat(rings.rings()).isEmpty();
        late.resolve(1);
    }

    /** Asks one without waiting for it, and holds its calls for another one. */
    private static final class HastyAccount extends CarefulAccount {
        private final Account bank;

        HastyAccount(Account bank) {
            this.bank = bank;
        }

        @Override
        public Promise<Integer> pay(Account to, int amount) {
            to.deposit(amount);
            return during(bank::content);
        }
    }

    @Test
    void callsThatAHoldDoesNotWaitFor_areNoPossibleRing() {
        var answers = new ArrayDeque<Deferred<Integer>>();
        Account bank = account("bank", () -> new PlainAccount() {
            @Override
            public Promise<Integer> content() {
                answers.add(new Deferred<>());
                return answers.getLast();
            }
        });
        Account one = account("one", () -> new HastyAccount(bank));
        Account two = account("two", () -> new HastyAccount(bank));
        for (var from : List.of(one, two)) {
            Promise<Integer> paid = from.pay(from == one ? two : one, 5);
            test.runQueued(); // what was paid in has arrived, and the bank has not answered
            answers.remove().resolve(1);
            assertThat(test.get(paid)).isEqualTo(1);
        }
        rings.idle();
        rings.check();
        assertThat(rings.rings()).isEmpty();
    }

    /** The call comes first, and the hold is for it. */
    @Test
    void callsThatAreMadeDirectlyBeforeAHold_areAPossibleRing() {
        Supplier<Account> holding = () -> new PlainAccount() {
            @Override
            Promise<Integer> during(Supplier<Promise<Integer>> call) {
                Promise<Integer> made = call.get();
                context().hold();
                return made.eventually(() -> {
                    context().release();
                    return Promise.of(null);
                });
            }
        };
        Account one = account("one", holding);
        Account two = account("two", holding);
        test.get(one.pay(two, 5));
        test.get(two.pay(one, 5));
        assertThat(rings.rings()).extracting(Ring::kind).containsExactly(Kind.POSSIBLE);
    }

    /** A call that is served while the actor holds its calls for another one has its own calls. */
    @Test
    void callsOnBehalfOfOtherCalls_areNoPossibleRing() {
        var answers = new ArrayDeque<Deferred<Integer>>();
        Account bank = account("bank", () -> new PlainAccount() {
            @Override
            public Promise<Integer> content() {
                answers.add(new Deferred<>());
                return answers.getLast();
            }
        });
        Supplier<Account> both = () -> new CarefulAccount() {
            @Override
            public Promise<Integer> pay(Account to, int amount) {
                return to.deposit(amount); // without a hold
            }

            @Override
            public Promise<Integer> depositAndAsk(Account from, int amount) {
                return during(bank::content);
            }
        };
        Account one = account("one", both);
        Account two = account("two", both);
        for (var from : List.of(one, two)) {
            Account to = from == one ? two : one;
            test.run(() -> {
                from.pay(to, 5);
                from.depositAndAsk(to, 5);
            });
            answers.remove().resolve(1);
            test.runQueued();
        }
        rings.check();
        assertThat(rings.rings()).isEmpty();
    }

    @Test
    void ringWhoseCallerGivesUp_whileTheLastCallIsMerelySlow_hasNotBlocked() {
        var late = new Deferred<Integer>();
        Account one = account("one", () -> new PlainAccount() {
            @Override
            public Promise<Integer> content() {
                return late;
            }
        });
        Account two = account("two", PlainAccount::new);
        Promise<Integer> paid = one.payAndAsk(two, 5);
        test.runQueued();
        paid.cancel();
        test.runQueued();
        assertThat(rings.rings()).isEmpty();
        Promise<Integer> limited = one.payAndAsk(two, 5).orTimeout(Duration.ofSeconds(1));
        test.advance(Duration.ofSeconds(2));
        test.error(limited);
        assertThat(rings.rings()).isEmpty();
        late.resolve(1);
        test.runQueued();
        rings.idle();
        rings.check();
    }

    @Test
    void actorsOfTwoSpacesOfOneName_areDifferentActors() {
        try (var second = new TestSpace(rings)) {
            Account one = test.spawn(Account.class, PlainAccount::new);
            Account other = second.spawn(Account.class, PlainAccount::new);
            Account named = account("account", CarefulAccount::new);
            Account otherNamed = second.spawn(Account.class, PlainAccount::new, ActorSettings.named("account"));
            assertThat(one).hasToString(other.toString());
            for (var pair : List.of(List.of(one, other), List.of(named, otherNamed))) {
                Promise<Integer> paid = pair.getFirst().pay(pair.getLast(), 5);
                for (int round = 0; round < 3; round++) {
                    test.runQueued();
                    second.runQueued();
                }
                assertThat(test.get(paid)).isPositive();
            }
            rings.idle();
            assertThat(rings.rings()).isEmpty();
        }
    }
}
