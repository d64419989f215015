package io.troupe.petri.testkit;

import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.requests;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.catchThrowable;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.ManualClock;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.testkit.RingFinder;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.petri.testkit.StreetTest.Bank;
import io.troupe.petri.testkit.StreetTest.CornerShop;
import io.troupe.petri.testkit.StreetTest.Shop;
import io.troupe.petri.testkit.StreetTest.SmallBank;
import io.troupe.petri.wiring.Protocol;
import io.troupe.petri.wiring.Wiring;
import io.troupe.petri.wiring.WiringMonitor.ViolationException;
import java.lang.reflect.Proxy;
import java.time.Duration;
import java.util.ArrayList;
import java.util.function.Consumer;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.ExtensionContext;
import org.junit.jupiter.api.extension.RegisterExtension;

/** Tests that pass, and what the others end with. */
class FollowedActorsTest {
    @RegisterExtension
    final FollowedActors actors = FollowedActors.forRings();

    /** Sells one thing after the other. */
    private static final class BusyShop extends CornerShop {
        BusyShop(Bank bank) {
            super(bank);
        }

        @Override
        public Promise<String> buy(String what) {
            context().hold();
            return super.buy(what).thenApply(paid -> {
                context().release();
                return paid;
            });
        }
    }

    @Test
    void purchase_isPaid() {
        var test = actors.testSpace();
        Bank bank = test.spawn(Bank.class, SmallBank::new);
        Shop shop = test.spawn(Shop.class, () -> new CornerShop(bank));
        assertThat(test.get(shop.buy("lamp"))).isEqualTo("paid");
    }

    @Test
    void ringThatPasses_isListed() {
        purchase_isPaid();
        assertThat(actors.rings().rings())
                .singleElement()
                .satisfies(ring -> assertThat(ring.kind()).isEqualTo(RingFinder.Kind.PASSED));
    }

    /** What JUnit does with a test method. */
    private static Throwable ended(FollowedActors actors, Consumer<FollowedActors> test) {
        var context = (ExtensionContext) Proxy.newProxyInstance(
                FollowedActorsTest.class.getClassLoader(),
                new Class<?>[] {ExtensionContext.class},
                (proxy, it, with) -> {
                    throw new UnsupportedOperationException(it.getName());
                });
        actors.beforeEach(context);
        test.accept(actors);
        return catchThrowable(() -> actors.afterEach(context));
    }

    private static void sell(FollowedActors actors) {
        var test = actors.testSpace();
        Bank bank = test.spawn(Bank.class, SmallBank::new, ActorSettings.named("bank"));
        Shop shop = test.spawn(Shop.class, () -> new BusyShop(bank), ActorSettings.named("shop"));
        shop.buy("lamp");
    }

    private static final String RING = """
            shop is called while it waits for that call: a ring that blocks shop, bank
              - shop serves buy, which waits for bank.pay
              - bank serves pay, which waits for shop.price, which that has not begun: it holds its calls""";

    @Test
    void testWithARing_failsWithItsStory_andEachTestBeginsAnew() {
        var followed = FollowedActors.forRings();
        assertThat(ended(followed, FollowedActorsTest::sell))
                .isInstanceOf(AssertionError.class)
                .hasMessage(RING);
        assertThat(ended(followed, none -> {})).isNull();
    }

    @Test
    void ringInASpaceThatTheTestClosesItself_isFoundWhenItIsClosed() {
        assertThat(ended(FollowedActors.forRings(), followed -> {
                    var test = new TestSpace(followed.observer());
                    Bank bank = test.spawn(Bank.class, SmallBank::new, ActorSettings.named("bank"));
                    Shop shop = test.spawn(Shop.class, () -> new BusyShop(bank), ActorSettings.named("shop"));
                    shop.buy("lamp");
                    test.runQueued();
                    test.close(); // which sees nothing wrong
                }))
                .hasMessage(RING);
    }

    @Test
    void ringOnAThread_isFoundWhenItsSpaceHasComeToRest() {
        assertThat(ended(FollowedActors.forRings(), followed -> {
                    var space = followed.space(SpaceSettings.named("street"));
                    Bank bank = space.spawn(Bank.class, SmallBank::new, ActorSettings.named("bank"));
                    Shop shop = space.spawn(Shop.class, () -> new BusyShop(bank), ActorSettings.named("shop"));
                    shop.buy("lamp");
                }))
                .hasMessage(RING);
    }

    private static Wiring wiring() {
        return Wiring.of("street")
                .component(Protocol.of("shop", Shop.class)
                        .state("open", requests("bank.pay").then("open"))
                        .build())
                .component(Protocol.of("bank", Bank.class)
                        .state("open", provides("pay").then("open"))
                        .build())
                .build();
    }

    private static void sellAt(FollowedActors actors, Bank answering) {
        var test = actors.testSpace();
        Bank bank = test.spawn(Bank.class, () -> answering, ActorSettings.named("bank"));
        Shop shop = test.spawn(Shop.class, () -> new CornerShop(bank), ActorSettings.named("shop"));
        shop.buy("lamp");
        test.advance(Duration.ofSeconds(1));
    }

    @Test
    void testThatLeavesItsDeclaration_failsWithTheStory() {
        assertThat(ended(
                        FollowedActors.through(wiring()),
                        followed -> sellAt(followed, (shop, amount) -> Promise.of("paid"))))
                .isNull();
        assertThat(ended(FollowedActors.through(wiring()), followed -> sellAt(followed, new SmallBank())))
                .isInstanceOf(ViolationException.class)
                .hasMessageContaining("bank asks shop.price is not allowed");
        assertThat(ended(
                        FollowedActors.through(wiring()),
                        followed -> sellAt(followed, (shop, amount) -> new Deferred<>())))
                .isInstanceOf(ViolationException.class)
                .hasMessageContaining("shop waits for the answer of bank.pay, and nothing happens any more");
    }

    @Test
    void monitorWithoutAWiring_isRefused() {
        assertThatThrownBy(actors::monitor).hasMessageContaining("expected FollowedActors.through(wiring)");
    }

    /** Answers after a second. */
    private static final class SlowShop extends CornerShop {
        SlowShop(Bank bank) {
            super(bank);
        }

        @Override
        public Promise<Integer> price(String what) {
            return context().space().delay(Duration.ofSeconds(1)).thenApply(none -> 5);
        }
    }

    @Test
    void whatATimerWillAnswer_isNotBlocked() {
        assertThat(ended(FollowedActors.forRings(), followed -> {
                    var test = followed.testSpace();
                    Bank bank = test.spawn(Bank.class, SmallBank::new, ActorSettings.named("bank"));
                    test.spawn(Shop.class, () -> new SlowShop(bank), ActorSettings.named("shop"))
                            .buy("lamp");
                }))
                .isNull();
        var clock = new ManualClock();
        assertThat(ended(FollowedActors.through(wiring()), followed -> {
                    var space = followed.space(SpaceSettings.named("street").withClock(clock));
                    Bank bank = space.spawn(Bank.class, () -> new SlowBank(space), ActorSettings.named("bank"));
                    space.spawn(Shop.class, () -> new CornerShop(bank), ActorSettings.named("shop"))
                            .buy("lamp");
                }))
                .isNull();
    }

    private record SlowBank(ActorSpace space) implements Bank {
        @Override
        public Promise<String> pay(Shop shop, int amount) {
            return space.delay(Duration.ofSeconds(1)).thenApply(none -> "paid");
        }
    }

    /** An alarm is set that has nothing to do with the ring. */
    @Test
    void ringOfAnActorThatHoldsItsCalls_isFoundWhateverTimersAreSet() {
        assertThat(ended(FollowedActors.forRings(), followed -> {
                    followed.testSpace().space().delay(Duration.ofHours(1));
                    sell(followed);
                }))
                .hasMessage(RING);
    }

    @Test
    void spaceThatTheTestHasClosed_endsNothingElse() {
        var open = new ArrayList<ActorSpace>();
        var failure = ended(FollowedActors.forRings(), followed -> {
            try (var closed = followed.space(SpaceSettings.named("closed"))) {
                assertThat(closed.isQuiet()).isTrue();
            }
            open.add(followed.space(SpaceSettings.named("open")));
            sell(followed);
        });
        assertThat(failure).hasMessage(RING);
        assertThat(open.getFirst().whenClosed().isDone()).isTrue();
        var other = ended(FollowedActors.forRings(), followed -> {
            sell(followed);
            followed.testSpace().runQueued();
            followed.testSpace().close();
            open.add(followed.space(SpaceSettings.named("open")));
        });
        assertThat(other).hasMessage(RING);
        assertThat(open.getLast().whenClosed().isDone()).isTrue();
    }

    @Test
    void interruptedTest_isCheckedAndClosed_andStaysInterrupted() {
        var open = new ArrayList<ActorSpace>();
        var failure = ended(FollowedActors.forRings(), followed -> {
            open.add(followed.space(SpaceSettings.named("open")));
            sell(followed);
            followed.testSpace().runQueued();
            Thread.currentThread().interrupt();
        });
        assertThat(Thread.interrupted()).isTrue();
        assertThat(failure).isInstanceOf(InterruptedException.class);
        assertThat(failure.getSuppressed()).anySatisfy(ring -> assertThat(ring).hasMessage(RING));
        assertThat(open.getFirst().whenClosed().isDone()).isTrue();
    }

    interface Player {
        void play(Player back);
    }

    private static final class TennisPlayer extends Actor implements Player {
        @Override
        public void play(Player back) {
            back.play(self());
        }
    }

    @Test
    void spacesThatNeverComeToRest_failTheTest() {
        var failure = ended(FollowedActors.forRings(), followed -> {
            var space = followed.space(SpaceSettings.named("court"));
            Player far = space.spawn(Player.class, TennisPlayer::new);
            followed.testSpace().spawn(Player.class, TennisPlayer::new).play(far);
        });
        assertThat(failure)
                .isInstanceOf(AssertionError.class)
                .hasMessageContaining("still call each other after 1000 rounds, expected them to come to rest");
    }
}
