package io.troupe.demo.monitor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSettings;
import io.troupe.actor.Promise;
import io.troupe.actor.testkit.RingFinder;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.broker.ActorServices;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.ConnectionSettings;
import io.troupe.broker.Need;
import io.troupe.petri.wiring.WiringCheck;
import io.troupe.petri.wiring.WiringMonitor;
import io.troupe.petri.wiring.WiringObserver;
import io.troupe.petri.wiring.WiringRecorder;
import io.troupe.petri.wiring.WiringResult;
import java.time.Duration;
import java.util.List;
import java.util.function.Function;
import org.junit.jupiter.api.Test;

/** Actors that call each other as services, through a broker and connections. */
class RecordedServicesTest {
    interface Shop {
        Promise<String> buy(String what);

        Promise<Integer> price(String what);
    }

    interface Bank {
        Promise<String> pay(String what);
    }

    interface Customer {
        Promise<String> shop();
    }

    private static class CornerShop extends Actor implements Shop {
        private final Bank bank;

        CornerShop(ActorServices services) {
            bank = services.connect(Bank.class, Need.ofService("shop", "bank")).actor();
        }

        @Override
        public Promise<String> buy(String what) {
            return bank.pay(what);
        }

        @Override
        public Promise<Integer> price(String what) {
            return Promise.of(5);
        }
    }

    /** Serves one customer after the other. */
    private static final class BusyShop extends CornerShop {
        BusyShop(ActorServices services) {
            super(services);
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

    private static final class AskingBank implements Bank {
        private final Shop shop;

        AskingBank(ActorServices services) {
            shop = services.connect(Shop.class, Need.ofService("bank", "shop")).actor();
        }

        @Override
        public Promise<String> pay(String what) {
            return shop.price(what).thenApply(price -> "paid " + price);
        }
    }

    private static Promise<String> shop(TestSpace test, Function<ActorServices, Shop> shop, Runnable then) {
        Broker broker = Broker.open(test.space(), BrokerSettings.defaults().withObserver(event -> {}));
        ActorServices services = broker.services();
        test.get(services.publish(test.space(), Shop.class, "shop", List.of(), () -> shop.apply(services)));
        test.get(services.publish(test.space(), Bank.class, "bank", List.of(), () -> new AskingBank(services)));
        Shop connected =
                services.connect(Shop.class, Need.ofService("customer", "shop")).actor();
        Customer customer =
                test.spawn(Customer.class, () -> () -> connected.buy("lamp"), ActorSettings.named("customer"));
        Promise<String> first = customer.shop();
        test.runQueued();
        then.run();
        test.takeProblems();
        test.takeDeadLetters();
        test.space().close();
        return first;
    }

    @Test
    void recordedServices_areThoseThatCalledEachOther_notTheirConnections() {
        var recorder = new WiringRecorder("street");
        shop(new TestSpace(recorder), CornerShop::new, () -> {});
        assertThat(recorder.problems()).isEmpty();
        assertThat(recorder.wiring().components()).containsExactly("bank", "customer", "shop");
        assertThat(WiringCheck.check(recorder.wiring())).isInstanceOf(WiringResult.Proved.class);

        var again = monitor(recorder);
        shop(new TestSpace(new WiringObserver(again)), CornerShop::new, again::idle);
        again.check();
        assertThat(again.count()).isGreaterThan(8);

        var changed = monitor(recorder);
        shop(new TestSpace(new WiringObserver(changed)), BusyShop::new, changed::idle);
        assertThat(changed.violation()).isPresent();
    }

    private static WiringMonitor monitor(WiringRecorder recorder) {
        var wiring = recorder.wiring();
        return WiringMonitor.of(wiring).observing(WiringObserver.stepsFromOutside(wiring));
    }

    @Test
    void ringThroughConnections_isFound() {
        var rings = new RingFinder();
        shop(new TestSpace(rings), CornerShop::new, rings::idle);
        assertThat(rings.rings()).extracting(RingFinder.Ring::kind).containsExactly(RingFinder.Kind.PASSED);

        var blocked = new RingFinder();
        shop(new TestSpace(blocked), BusyShop::new, blocked::idle);
        assertThat(blocked.rings()).singleElement().hasToString("""
                        test-space/shop is called while it waits for that call: a ring that blocks test-space/shop, test-space/bank
                          - test-space/shop serves buy, which waits for test-space/bank.pay
                          - test-space/bank serves pay, which waits for test-space/shop.price, which that has not begun: it holds its calls""");
    }

    private static final List<String> BANK_CALLERS = List.of("one", "two");

    /** Calls of two actors, which a connection holds back; the first is given up when the provider comes. */
    private static void heldCalls(TestSpace test, boolean isFirstGivenUp) {
        Broker broker = Broker.open(test.space(), BrokerSettings.defaults().withObserver(event -> {}));
        ActorServices services = broker.services();
        Bank bank = services.connect(
                        Bank.class,
                        Need.ofService("customers", "bank"),
                        ConnectionSettings.defaults().withWaitLimit(Duration.ofSeconds(3)))
                .actor();
        test.runQueued();
        for (String name : BANK_CALLERS) {
            test.spawn(Customer.class, () -> () -> bank.pay("lamp"), ActorSettings.named(name))
                    .shop();
            test.runQueued();
            if (isFirstGivenUp && name.equals("one")) {
                test.advance(Duration.ofSeconds(4));
            }
        }
        services.publish(test.space(), Bank.class, "bank", List.of(), () -> what -> Promise.of("paid"));
        test.advance(Duration.ofSeconds(2));
        test.takeProblems();
        test.takeDeadLetters();
        test.space().close();
    }

    @Test
    void callsThatAConnectionHasHeldBack_areThoseOfTheirCallers() {
        var both = new WiringRecorder("street");
        heldCalls(new TestSpace(both), false);
        assertThat(both.wiring().components()).containsExactly("bank", "one", "two");
        var second = new WiringRecorder("street");
        heldCalls(new TestSpace(second), true);
        assertThat(second.wiring().components()).containsExactly("bank", "two");
    }

    @Test
    void ringThroughAConnectionThatHeldACallBack_isFound() {
        var rings = new RingFinder();
        var test = new TestSpace(rings);
        Broker broker = Broker.open(test.space(), BrokerSettings.defaults().withObserver(event -> {}));
        ActorServices services = broker.services();
        test.get(services.publish(test.space(), Shop.class, "shop", List.of(), () -> new BusyShop(services)));
        Shop connected =
                services.connect(Shop.class, Need.ofService("customer", "shop")).actor();
        connected.buy("lamp");
        test.runQueued(); // the shop waits for a bank
        services.publish(test.space(), Bank.class, "bank", List.of(), () -> new AskingBank(services));
        test.runQueued();
        rings.idle();
        test.takeProblems();
        test.takeDeadLetters();
        test.space().close();
        assertThat(rings.rings()).extracting(RingFinder.Ring::kind).containsExactly(RingFinder.Kind.BLOCKED);
    }
}
