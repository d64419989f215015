package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.bus.Address;
import java.time.Duration;
import java.util.List;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;

/** Brokers of a group, which share with no others, and stop what is not used. */
class SharingTest extends HostsBench {
    private static final Sharing GROUP = Sharing.defaults().withGroup("crew").withUnusedStopped();
    private static final Address LAPTOP_PARROT = new Address("laptop", "parrot");

    private final Host base = new Host("base", BrokerSettings.defaults().withoutRestart(), GROUP);
    private final Host laptop = new Host("laptop", BrokerSettings.defaults().withoutRestart(), GROUP);

    private void start() {
        laptop.publish("grey");
        test.runQueued();
        get(base.broker.require(PARROT));
        assertThat(laptopHealth()).isEqualTo(Health.WELL);
    }

    private @Nullable Health laptopHealth() {
        return laptop.health(LAPTOP_PARROT.toString());
    }

    @Test
    void brokersOfDifferentGroups_doNotMeet_andMayHaveOneBus() {
        laptop.publish("grey");
        Host alone = host("alone");
        var other = Broker.over(
                alone.bus,
                test.space(),
                BrokerSettings.defaults().withObserver(event -> {}),
                Sharing.defaults().withGroup("others"));
        test.runQueued();
        assertThat(base.found()).containsExactly("laptop/parrot");
        assertThat(alone.found()).isEmpty();
        assertThat(get(other.find(PARROT))).isEmpty();
        get(other.closeAsync());
    }

    @Test
    void provider_endsWithItsUse_andIsStartedAgain() {
        start();
        get(base.broker.withdraw(LAPTOP_PARROT));
        assertThat(laptopHealth()).isEqualTo(Health.STOPPED);
        assertThat(base.found()).isEmpty();
        Host second = new Host("second", BrokerSettings.defaults(), GROUP);
        test.runQueued();
        get(second.broker.require(PARROT));
        assertThat(laptopHealth()).isEqualTo(Health.WELL);
        get(second.broker.closeAsync());
        assertThat(laptopHealth()).isEqualTo(Health.STOPPED);
    }

    @Test
    void providerWhoseUserIsSilentForThreeSeconds_isStopped_andThisIsReported() {
        start();
        base.die();
        seconds(3);
        assertThat(laptopHealth()).isEqualTo(Health.WELL);
        seconds(2);
        assertThat(laptopHealth()).isEqualTo(Health.STOPPED);
        assertThat(laptop.events(BrokerEvent.Unused.class))
                .singleElement()
                .extracting(BrokerEvent.Unused::why)
                .isEqualTo("nothing has come from base for 3 s");
    }

    @Test
    void pauseOfThisProcess_isNoSilence() {
        start();
        test.advance(Duration.ofMinutes(1));
        seconds(5);
        assertThat(laptopHealth()).isEqualTo(Health.WELL);
    }

    @Test
    void userThatWasStartedAgain_keepsWhatItStarts_andWhatItDoesNotUseEnds() {
        start();
        laptop.publish("green"); // laptop/parrot#2
        test.runQueued();
        get(base.broker.withdraw(LAPTOP_PARROT));
        get(base.broker.require(PARROT));
        base.die();
        Host again = new Host("base", BrokerSettings.defaults().withoutRestart(), GROUP);
        test.runQueued();
        get(again.broker.require(PARROT)); // runs already, and is now used by the second life of base
        seconds(6);
        assertThat(laptop.events(BrokerEvent.Unused.class)).isEmpty();
        assertThat(laptop.events(BrokerEvent.Started.class)).hasSize(2);
    }

    @Test
    void stopOfAnEarlierLife_doesNotHitALaterOne() {
        start();
        laptop.kill("parrot");
        test.runQueued();
        get(base.broker.require(PARROT)); // its second life
        var port = base.bus.attach("test");
        var broker = new Address("laptop", "$broker:crew");
        for (int life = 1; life <= 2; life++) {
            assertThat(laptopHealth()).isEqualTo(Health.WELL);
            get(port.ask(broker, OfferMessages.STOP, new OfferMessages.Stop("parrot", life), Duration.ofSeconds(1)));
        }
        assertThat(laptopHealth()).isEqualTo(Health.STOPPED);
    }

    @Test
    void startThatTakesTooLong_isStoppedThereToo_whenItCompletes() {
        Deferred<@Nullable Void> started = Deferred.unbound();
        var slow = new Provider() {
            @Override
            public Promise<@Nullable Void> start() {
                diary.add("start");
                return started;
            }

            @Override
            public Promise<@Nullable Void> stop() {
                diary.add("stop");
                return Promise.done();
            }

            @Override
            public Promise<@Nullable Void> check() {
                return Promise.done();
            }
        };
        get(laptop.broker.register("parrot", List.of(), LAPTOP_PARROT, slow));
        test.runQueued();
        var required = base.broker.require(PARROT);
        seconds(9); // three quarters of its limit
        assertThat(test.error(required)).isInstanceOf(MissingServiceException.class);
        assertThat(diary).containsExactly("start");
        started.resolve(null);
        test.runQueued();
        assertThat(diary).containsExactly("start", "stop");
        assertThat(laptopHealth()).isEqualTo(Health.STOPPED);
    }

    @Test
    void providerOfAnotherProcess_isPutInThePlaceOfOneHere_underThatService_ifItIsNotInUse() {
        get(laptop.broker.register("idle", List.of(), new Address("laptop", "songbird"), parrot("songbird")));
        base.publish("grey");
        test.runQueued();
        get(base.broker.require(PARROT));
        var songbird = new Address("laptop", "songbird");
        var replaced = get(base.broker.replace(new Address("base", "parrot"), "parrot", List.of("sings"), songbird));
        assertThat(replaced.provider()).isEqualTo(songbird);
        assertThat(base.found()).containsExactly("laptop/songbird");
        assertThat(base.health("base/parrot")).isNull();
        base.publish("blue");
        assertThat(test.error(
                        base.broker.replace(new Address("base", "parrot#2"), "parrot", List.of("sings"), songbird)))
                .hasMessage("laptop/songbird is in use, expected a provider that is not");
        assertThat(test.error(base.broker.replace(
                        new Address("base", "parrot#2"), "parrot", List.of(), new Address("laptop", "crow"))))
                .hasMessageStartingWith("no other process offers laptop/crow; offered: [laptop/songbird]");
    }

    @Test
    void replacementByAProviderOfAnotherProcess_thatDoesNotStart_leavesBothAsTheyWere() {
        var broken = new Address("laptop", "broken");
        get(laptop.broker.register("idle", List.of(), broken, (java.util.function.Supplier<Provider>) () -> {
            throw new IllegalStateException("no feathers");
        }));
        base.publish("grey");
        test.runQueued();
        get(base.broker.require(PARROT));
        assertThat(test.error(base.broker.replace(new Address("base", "parrot"), "parrot", List.of(), broken)))
                .hasMessageContaining("no feathers");
        assertThat(base.found()).containsExactly("base/parrot");
        assertThat(base.health("laptop/broken")).isEqualTo(Health.FAILED); // there
    }

    @Test
    void replacementByAProviderOfAnotherProcess_thatIsOfferedAnewWhileItStarts_usesTheNewOne() {
        var songbird = new Address("laptop", "songbird");
        Deferred<@Nullable Void> hatched = Deferred.unbound();
        get(laptop.broker.register("idle", List.of(), songbird, bird("first", hatched)));
        base.publish("grey");
        test.runQueued();
        get(base.broker.require(PARROT));
        var replaced = base.broker.replace(new Address("base", "parrot"), "parrot", List.of(), songbird);
        test.runQueued();
        var withdrawn = laptop.broker.withdraw(songbird); // it waits for the start
        get(laptop.broker.register("idle", List.of(), songbird, parrot("second")));
        test.runQueued();
        hatched.resolve(null);
        get(replaced);
        get(withdrawn);
        test.runQueued();
        assertThat(base.found()).containsExactly("laptop/songbird");
        get(base.broker.require(PARROT));
        assertThat(laptop.health("laptop/songbird")).isEqualTo(Health.WELL);
    }

    private static Provider parrot(String name) {
        return bird(name, Promise.done());
    }

    private static Provider bird(String name, Promise<@Nullable Void> started) {
        return new Provider() {
            @Override
            public Promise<@Nullable Void> start() {
                return started;
            }

            @Override
            public Promise<@Nullable Void> stop() {
                return Promise.done();
            }

            @Override
            public Promise<@Nullable Void> check() {
                return Promise.done();
            }

            @Override
            public String toString() {
                return name;
            }
        };
    }
}
