package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Promise;
import io.troupe.bus.Address;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;

/** The brokers of several processes: what they offer each other, and what happens when one is cut off. */
class OffersTest extends HostsBench {
    private final Host a = host("a");
    private final Host b = host("b");
    private final Host c = host("c");

    private String missing(Promise<?> promise) {
        assertThat(test.error(promise)).isInstanceOf(MissingServiceException.class);
        return String.valueOf(test.error(promise).getMessage());
    }

    // ---- offers

    @Test
    void offers_areKnownEverywhereAtOnce_alsoToALaterProcess() {
        a.publish("grey");
        test.runQueued();
        assertThat(b.health("a/parrot")).isEqualTo(Health.NOT_STARTED);
        get(a.broker.require(PARROT));
        assertThat(b.health("a/parrot")).isEqualTo(Health.WELL);
        var later = host("later");
        assertThat(later.health("a/parrot")).isEqualTo(Health.WELL);
        get(a.broker.withdraw(new Address("a", "parrot")));
        test.runQueued();
        assertThat(b.health("a/parrot")).isNull();
        assertThat(later.health("a/parrot")).isNull();
    }

    // ---- a survey

    private final List<String> shown = new ArrayList<>();

    private void show(String text) {
        shown.add(text);
    }

    /** The offers as one process finds them with a limit of 500 ms. */
    private List<ServiceOffer> survey(Host host) {
        Promise<List<ServiceOffer>> offers = host.services.offers(Duration.ofMillis(500));
        for (int wait = 0; wait < 2; wait++) {
            test.runQueued();
            test.advance(Duration.ofMillis(500));
        }
        return get(offers);
    }

    @Test
    void survey_hasTheOffersOfAllProcesses_withTheirState_evenForAProcessThatHasJustCome() {
        a.publish("grey");
        b.publish("green");
        get(a.broker.require(PARROT));
        get(b.broker.register("anchor", List.of(), new Address("b", "anchor"), new Unstartable()));
        var later = new Host("later", BrokerSettings.defaults(), 5);
        later.publish("blue");
        List<ServiceOffer> all = survey(later);
        assertThat(all)
                .extracting(each ->
                        each.provider().provider() + " " + each.provider().health() + " " + each.life())
                .containsExactly(
                        "b/anchor NOT_STARTED 0",
                        "a/parrot WELL 1",
                        "b/parrot NOT_STARTED 0",
                        "later/parrot NOT_STARTED 0");
        assertThat(all).extracting(ServiceOffer::rank).containsExactly(0, 0, 0, 5);
        assertThat(all.get(1).provider().capabilities()).containsExactly("talks");
        assertThat(all).extracting(ServiceOffer::roundTrip).containsOnly(Duration.ZERO); // the clock stands still
        assertThat(diary).doesNotContain("green is made");
        var services = c.services;
        services.offers(Duration.ofMillis(500))
                .then(offers -> offers.forEach(offer -> show(offer.provider() + ", life " + offer.life())));
        test.runQueued();
        assertThat(shown).isEmpty();
        test.advance(Duration.ofMillis(500));
        test.runQueued();
        assertThat(shown).hasSize(4).first().asString().endsWith(", life 0");
    }

    @Test
    void survey_withoutOffers_isEmpty_andAProcessThatDoesNotAnswer_isSuspect() {
        assertThat(survey(c)).isEmpty();
        a.publish("grey");
        get(a.broker.require(PARROT));
        test.runQueued();
        pipe.lose("a");
        ServiceOffer lost = survey(c).getFirst();
        assertThat(lost.provider().health()).isEqualTo(Health.SUSPECT);
        assertThat(lost.roundTrip()).isNull();
        assertThat(lost.age()).isEqualTo(Duration.ofSeconds(1));
        seconds(10);
        assertThat(survey(c)).isEmpty();
        pipe.loseNoMore("a");
    }

    @Test
    void survey_needsABusAndABroker() {
        var alone = Broker.open(test.space(), BrokerSettings.defaults()).services();
        assertThatThrownBy(() -> alone.offers(Duration.ofSeconds(1)))
                .isInstanceOf(IllegalStateException.class)
                .hasMessage("these services have no bus: use Broker.over");
        get(b.broker.closeAsync());
        test.runQueued();
        assertThat(test.error(b.services.offers(Duration.ofSeconds(1)))).isInstanceOf(IllegalStateException.class);
    }

    @Test
    void missingService_isNamedAtOnce_withWhatIsRegisteredWhere_andWhatIsSimilar() {
        a.publish("grey");
        get(a.broker.require(PARROT));
        get(b.broker.register("piano", List.of("sounds"), new Address("b", "piano"), new Unstartable()));
        assertThat(missing(c.broker.require(Need.ofService("user", "parot"))))
                .isEqualTo("\"user\" needs the service \"parot\", which no provider offers; did you mean \"parrot\"?"
                        + " registered: parrot at a (talks; well), piano at b (sounds; not started)");
        assertThat(missing(c.broker.require(Need.ofService("user", "piano"))))
                .startsWith("\"user\" needs the service \"piano\", which is offered, but runs nowhere: b/piano (out of"
                        + " order); registered: ");
    }

    private static final class Unstartable implements Provider {
        @Override
        public Promise<@Nullable Void> start() {
            return Promise.failed(new ProviderException("out of order"));
        }

        @Override
        public Promise<@Nullable Void> stop() {
            return Promise.done();
        }

        @Override
        public Promise<@Nullable Void> check() {
            return Promise.done();
        }
    }

    @Test
    void service_isStartedOnce_howeverManyProcessesNeedIt() {
        a.publish("grey");
        test.runQueued();
        var inB = b.connected().say("1");
        var inC = c.connected().say("2");
        assertThat(List.of(get(inB), get(inC))).containsExactly("grey: 1", "grey: 2");
        assertThat(diary).containsOnlyOnce("grey is made");
        get(b.broker.closeAsync());
        assertThat(get(c.connected().say("3"))).as("a stop by one user").isEqualTo("grey: 3");
    }

    @Test
    void equalProviders_areOrderedByRankAndNode_alikeInEveryProcess() {
        var third = new Host("z", BrokerSettings.defaults(), -1);
        c.publish("c1");
        c.publish("c2");
        a.publish("a");
        third.publish("z");
        b.publish("b");
        test.runQueued();
        for (Host host : hosts.values()) {
            assertThat(host.found())
                    .as(host.name)
                    .containsExactly("z/parrot", "a/parrot", "b/parrot", "c/parrot", "c/parrot#2");
        }
        get(c.broker.require(new Need("user", "parrot", "talks")));
        assertThat(diary).containsExactly("z is made");
        get(b.broker.withdraw(new Address("b", "parrot")));
        test.runQueued();
        get(third.broker.withdraw(new Address("z", "parrot")));
        c.connected();
        test.runQueued();
        get(a.broker.require(PARROT));
        assertThat(a.found()).as("one that runs is first").startsWith("a/parrot");
        assertThat(c.found()).startsWith("a/parrot");
    }

    // ---- failover

    @Test
    void providerThatEnds_isFollowedByOneOfAnotherNode_atOnce() {
        a.publish("a1");
        b.publish("b1");
        var parrot = c.connected();
        assertThat(get(parrot.say("1"))).isEqualTo("a1: 1");
        a.kill("parrot");
        test.runQueued();
        assertThat(get(parrot.say("2"))).isEqualTo("b1: 2");
        assertThat(c.events(BrokerEvent.FailedOver.class))
                .extracting(
                        event -> event.from().provider() + " > " + event.to().provider())
                .containsExactly("a/parrot > b/parrot");
    }

    @Test
    void processThatIsStartedAgain_isAnotherOne() {
        a.publish("a1");
        var parrot = c.connected();
        assertThat(get(parrot.say("1"))).isEqualTo("a1: 1");
        a.die();
        var again = host("a");
        again.publish("a2");
        assertThat(get(parrot.say("2"))).isEqualTo("a2: 2");
        losses.clear();
    }

    @Test
    void brokerThatIsShutDown_withdrawsItsOffers_atOnce() {
        a.publish("a1");
        b.publish("b1");
        var parrot = c.connected();
        get(parrot.say("1"));
        get(a.broker.closeAsync());
        assertThat(get(parrot.say("2"))).isEqualTo("b1: 2");
        assertThat(c.health("a/parrot")).isNull();
    }

    // ---- silence

    @Test
    void silentProcess_isSuspect_thenItsProvidersAreWithdrawn() {
        a.publish("a1");
        b.publish("b1");
        test.runQueued();
        pipe.lose("a");
        seconds(3);
        assertThat(c.health("a/parrot")).isEqualTo(Health.NOT_STARTED);
        seconds(1);
        assertThat(c.health("a/parrot")).isEqualTo(Health.SUSPECT);
        assertThat(c.found()).containsExactly("b/parrot", "a/parrot");
        seconds(6);
        assertThat(c.health("a/parrot")).isEqualTo(Health.SUSPECT);
        seconds(1);
        assertThat(c.health("a/parrot")).isNull();
        pipe.loseNoMore("a");
        seconds(1);
        assertThat(c.health("a/parrot")).isEqualTo(Health.NOT_STARTED);
        losses.clear();
    }

    @Test
    void usedProviderOfASilentProcess_isFollowedByAnother_afterItsMissedChecks() {
        a.publish("a1");
        b.publish("b1");
        var parrot = c.connected();
        get(parrot.say("1"));
        pipe.lose("a");
        seconds(8);
        assertThat(get(parrot.say("2"))).isEqualTo("b1: 2");
        assertThat(c.events(BrokerEvent.Suspect.class)).hasSize(1);
        pipe.loseNoMore("a");
        losses.clear();
    }

    @Test
    void ownPause_makesNoProcessSuspect() {
        a.publish("a1");
        test.runQueued();
        test.clock()
                .advanceToAtLeast(test.clock().nanos() + Duration.ofSeconds(30).toNanos());
        pipe.lose("a"); // its offers come a little later than those of this process are checked
        test.runQueued();
        assertThat(c.health("a/parrot")).isEqualTo(Health.NOT_STARTED);
        pipe.loseNoMore("a");
        seconds(2);
        assertThat(c.health("a/parrot")).isEqualTo(Health.NOT_STARTED);
        assertThat(c.events(BrokerEvent.Withdrawn.class)).isEmpty();
        losses.clear();
    }

    @Test
    void falseAlarmSoonAfterAReconnection_doesNotMoveAClient() {
        a.publish("a1");
        b.publish("b1");
        var parrot = c.connected();
        get(parrot.say("1"));
        seconds(3);
        pipe.disconnect("c");
        pipe.reconnect("c");
        pipe.disconnect("a"); // its process is not connected again yet
        var refused = parrot.say("2");
        assertThat(test.error(refused))
                .isInstanceOfSatisfying(
                        ServiceCallException.class,
                        error -> assertThat(error.mayHaveRun()).isFalse());
        seconds(1);
        assertThat(c.health("a/parrot")).isEqualTo(Health.SUSPECT);
        pipe.reconnect("a");
        seconds(2);
        assertThat(get(parrot.say("3"))).isEqualTo("a1: 3");
        assertThat(c.health("a/parrot")).isEqualTo(Health.WELL);
        assertThat(c.events(BrokerEvent.FailedOver.class)).isEmpty();
        losses.clear();
    }

    @Test
    void processThatWasCutOff_findsTheOthersAgain() {
        a.publish("a1");
        var parrot = c.connected();
        get(parrot.say("1"));
        pipe.disconnect("c");
        seconds(20);
        assertThat(c.health("a/parrot")).isNull();
        pipe.reconnect("c");
        seconds(2);
        assertThat(get(parrot.say("2"))).isEqualTo("a1: 2");
        losses.clear();
    }

    // ---- lives

    @Test
    void check_ofAnEarlierLife_isNotAnsweredForALaterOne() {
        a.publish("a1");
        get(c.connected().say("1"));
        a.kill("parrot");
        test.runQueued();
        get(a.broker.require(PARROT)); // its second life
        var port = b.bus.attach("test");
        var broker = new Address("a", "$broker");
        var limit = Duration.ofSeconds(1);
        assertThat(test.error(port.ask(broker, OfferMessages.CHECK, new OfferMessages.Check("parrot", 1), limit)))
                .hasMessageContaining("life 1 of a/parrot has ended");
        assertThat(get(port.ask(broker, OfferMessages.CHECK, new OfferMessages.Check("parrot", 2), limit))
                        .suspect())
                .isFalse();
    }

    @Test
    void lateOffers_ofAnEarlierLife_doNotEndALaterOne() {
        a.publish("a1");
        var parrot = c.connected();
        get(parrot.say("1"));
        var port = b.bus.attach("test");
        var earlier = new OfferMessages.Offer(
                "parrot", "parrot", List.of("talks"), Health.FAILED, 0, 0, List.of("say(String)"));
        List<OfferMessages.Offers> heard = new ArrayList<>();
        port.subscribe(MESSAGES.offers, (offers, from) -> {
            if (from.node().equals("a")) {
                heard.add(offers);
            }
        });
        seconds(1);
        var now = heard.getLast();
        assertThat(now.offers()).singleElement().satisfies(offer -> {
            assertThat(offer.life()).isEqualTo(1);
            assertThat(offer.health()).isEqualTo(Health.WELL);
        });
        var forged = a.bus.attach("forger"); // as if it had been held up on its way
        for (var offers : List.of(List.of(earlier), List.<OfferMessages.Offer>of())) {
            forged.publish(MESSAGES.offers, new OfferMessages.Offers(now.incarnation(), now.count() - 1, offers));
            test.runQueued();
        }
        forged.publish(
                MESSAGES.offers,
                new OfferMessages.Offers(
                        now.incarnation(),
                        now.count() + 1,
                        now.offers().stream()
                                .map(offer -> new OfferMessages.Offer(
                                        offer.name(),
                                        offer.service(),
                                        offer.capabilities(),
                                        Health.FAILED,
                                        0,
                                        0,
                                        offer.methods()))
                                .toList()));
        test.runQueued();
        assertThat(c.events(BrokerEvent.Failed.class)).isEmpty();
        assertThat(c.events(BrokerEvent.Withdrawn.class)).isEmpty();
        assertThat(get(parrot.say("2"))).isEqualTo("a1: 2");
    }
}
